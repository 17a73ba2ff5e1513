//! Makes a report from prose, values, checks and figures: its documents as Markdown, LaTeX and
//! HTML, and its data.
//!
//! 1. `values` collects the numbers, and `filler` puts a mark for each into the prose.
//! 2. `parse` reads the prose into the tree of `document`; `lint` refuses hard-coded numbers.
//! 3. `labels` numbers figures, equations and sections, and resolves references and citations.
//! 4. `markdown`, `latex` and `html` write the tree, `search` indexes it, `card` explains.
//! 5. `assemble` returns every file as bytes; `folder` writes and compares them.

pub(crate) mod assemble;
mod bibliography;
mod bibtex;
pub(crate) mod card;
pub(crate) mod claims;
mod coded;
pub(crate) mod document;
pub(crate) mod edition;
pub(crate) mod error;
mod filled;
pub(crate) mod filler;
pub(crate) mod folder;
mod html;
mod input;
mod labels;
mod latex;
pub(crate) mod ledger;
pub(crate) mod lint;
pub(crate) mod mark;
mod markdown;
mod mathml;
mod parse;
mod search;
pub(crate) mod tex;
pub(crate) mod values;

pub(crate) use assemble::{assemble, files_of};
pub use edition::{Document, Edition};
pub(crate) use error::Error;
pub use folder::Files;
pub(crate) use input::Input;
pub use ledger::EquationEntry;
pub use mark::framed;
pub(crate) use values::ValueRegistry;

#[cfg(test)]
mod tests;
