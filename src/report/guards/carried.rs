//! Results that are carried over.

use super::{Guard, Look};
use literate::experiments::deep::Carriage;

pub const GUARDS: &[Guard] =
    &[Guard { name: "carried_results_audited", ids: &["carried.*"], find: audited }];

/// A committed result that this program does not give is stale.
fn audited(look: Look<'_>) -> Option<String> {
    let mut audits = look.results.audits.iter();
    let (name, _) = audits.find(|(_, audit)| audit.verdict == Carriage::Failed)?;
    Some(format!("the committed result {name} is stale: run `make deep`"))
}
