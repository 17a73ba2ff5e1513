//! The tree → report.pdf, typeset inside the program (feature `pdf`), by way of a markup that needs
//! no typesetter to be written.

mod markup;
mod maths;
#[cfg(feature = "pdf")]
mod pdf;
#[cfg(feature = "pdf")]
mod world;

use super::Error;
use super::document::{Block, plain, title};
use super::templates::Templates;

#[cfg(feature = "pdf")]
pub use pdf::pdf;

/// The report as the typesetter's source.
pub fn source(blocks: &[Block], templates: &Templates) -> Result<String, Error> {
    let shell = templates.text("report.typ")?;
    Ok(shell
        .replace("«title»", &markup::quoted(&plain(title(blocks)?)))
        .replace("«body»", &markup::report(blocks)?))
}
