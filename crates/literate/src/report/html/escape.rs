//! Text and addresses for HTML that is XML too.

pub use crate::figures::escape as text;

/// `fig:3` → `fig-3`, `card:printed.p_15` → `card-printed-p_15`.
pub fn id(id: &str) -> String {
    id.replace([':', '.', '[', ']', '=', ','], "-")
}
