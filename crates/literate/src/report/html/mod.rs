//! The tree → the parts of report.html; its shell and its style sheet are templates.
//!
//! One file, readable from a disk: pictures, fonts and styles are inside it, nothing is loaded and
//! no script is needed. It is well-formed XML too, so that tests can read it.

mod block;
mod card;
mod contents;
mod escape;
mod figure;
mod fonts;
mod inline;
mod keep;
mod lab;
mod lines;
mod maths;
mod picture;

pub use fonts::base64;
pub use maths::LONGEST;

use super::Error;
use super::card::Cards;
use super::document::{Block, plain, title};
use super::documents::Document;
use super::labels::Labels;
use super::origin::next_tag;
use crate::figures::{Figure, Glyphs};
use crate::source::Program;
use serde::Serialize;
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Whether a browser can show this TeX.
pub fn reads(tex: &str) -> Result<(), Error> {
    maths::displayed(tex).map(|_| ())
}

/// Whether a page is well-formed: what the shell opens is closed.
pub fn is_whole(page: &str) -> Result<(), Error> {
    let told = |error| Error::Template(format!("report.html: the page is not whole: {error}"));
    // What a style has is no markup.
    let (head, rest) = page.split_once("<style>").unwrap_or((page, ""));
    let (_, rest) = rest.split_once("</style>").unwrap_or(("", rest));
    well_formed(&format!("{head}{rest}")).map_err(told)
}

/// Whether the shell of the pages is well-formed, before anything is filled in.
///
/// # Errors
/// The line of report.html.
pub fn is_shell(template: &str) -> Result<(), Error> {
    let (mut bare, mut at) = (String::new(), 0);
    while let Some((start, end)) = next_tag(template, at) {
        bare.push_str(&template[at..start]);
        bare.extend(template[start..end].chars().filter(|c| *c == '\n'));
        at = end;
    }
    bare.push_str(&template[at..]);
    well_formed(&bare).map_err(|error| {
        let (what, row) = (error.to_string(), error.pos().row);
        let what = what.split(" at ").next().unwrap_or_default();
        let remedy = "write &amp; for &, and close each tag, as <br/>";
        Error::Template(format!("report.html:{row}: {what}; {remedy}"))
    })
}

fn well_formed(page: &str) -> Result<(), roxmltree::Error> {
    let options = roxmltree::ParsingOptions { allow_dtd: true, ..Default::default() };
    roxmltree::Document::parse_with_options(page, options).map(drop)
}

/// What a page knows beside its text.
#[derive(Clone, Copy, Debug)]
pub struct Site<'a> {
    /// The document that it is.
    pub here: Document,
    /// The places of all documents.
    pub labels: &'a Labels,
    /// Whether lab.js lies beside the pages, by which readers run the program themselves.
    pub lab: bool,
}

/// What the shell has places for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parts {
    /// What the head says of the document, as elements.
    pub about: String,
    /// Version, date and licence, and where the data is; empty if that is not known.
    pub imprint: String,
    /// How to cite the document, as BibTeX; empty if that is not known.
    pub cite: String,
    /// Links to all documents, as items of a list; empty if there is one only.
    pub documents: String,
    /// The title as words.
    pub title: String,
    /// The title with its mathematics.
    pub heading: String,
    /// The table of contents.
    pub contents: String,
    /// The text.
    pub body: String,
    /// The cards of the values, as data for the script.
    pub cards: String,
    /// The outlines that figures share.
    pub glyphs: String,
    /// Fonts and colours of the figures as CSS.
    pub style: String,
}

/// A page in the making: what its pieces share.
struct Page<'a> {
    figures: &'a [Figure],
    site: Site<'a>,
    program: Program,
    /// Values that were shown, so that each gets its card.
    named: RefCell<BTreeSet<String>>,
    glyphs: RefCell<Glyphs>,
}

/// Writes all parts of the page.
pub fn write(
    blocks: &[Block],
    figures: &[Figure],
    site: Site<'_>,
    cards: Cards<'_>,
) -> Result<Parts, Error> {
    let program = cards.program;
    let page =
        Page { figures, site, program, named: RefCell::default(), glyphs: RefCell::default() };
    let text = title(blocks)?;
    let heading = page.inlines(text)?;
    let body = page.blocks(blocks)?;
    let contents = page.contents(blocks)?;
    Ok(Parts {
        about: page.about(),
        imprint: page.imprint(),
        cite: page.cite(&plain(text)),
        documents: page.documents(),
        title: escape::text(&plain(text)),
        heading,
        contents,
        cards: page.cards(cards)?,
        glyphs: picture::shared(&page.glyphs.borrow()),
        style: fonts::rules(&body) + &picture::rules(),
        body,
    })
}
