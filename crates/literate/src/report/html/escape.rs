//! Text and addresses for HTML that is XML too.

pub use crate::figures::escape as text;

/// JSON for a `<script>`: nothing in it ends the element or is markup of XML.
pub fn data(value: &impl serde::Serialize) -> String {
    let json = serde_json::to_string(value).unwrap_or_default();
    json.replace('&', "\\u0026").replace('<', "\\u003c").replace('>', "\\u003e")
}

/// `fig:3` → `fig-3`, `card:printed.p_15` → `card-printed-p_15`.
pub fn id(id: &str) -> String {
    id.replace([':', '.', '[', ']', '=', ','], "-")
}
