//! Judges statements of a paper, and relations between its numbers: [`Judge`].

mod check;
mod evidence;
mod level;
mod numeral;
mod published;
mod rule;
mod texts;
mod wrong;

pub(crate) use check::score;
pub use check::{Basis, Check, Kind, Verdict};
pub use evidence::{Error, Evidence, Judged};
pub use level::{CheckLevel, FAMILY_LEVEL};
pub use published::{Published, PublishedError, Statement};
pub(crate) use rule::check_rules;
pub use rule::{Judge, Rule, level_of};
pub use texts::{Numbers, Text};
pub(crate) use texts::{Words, text};
pub(crate) use wrong::is_trying;
