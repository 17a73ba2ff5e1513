//! The report as a tree, between one prose and several formats.
//!
//! [`super::parse`] makes it from filled Markdown, [`super::labels`] numbers what can be referred
//! to and resolves references, and each format has one writer that walks it. Writers decide on
//! markup only: numbers, words of references and digits of values are in the tree already.

use super::mark::bare;
use super::templates::Document;
use super::{Error, tex};
use pulldown_cmark::Alignment;

/// A block of the report. Ids are written as `sec:protocol`, numbers as "2.1" or "S1"; a number is empty until it is given.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading. Level 1 is the title; sections start at level 2. It and unnumbered sections have no number.
    Heading {
        level: u8,
        number: Option<String>,
        id: Option<String>,
        text: Vec<Inline>,
    },
    /// A paragraph; displayed equations stand inside it.
    Paragraph(Vec<Inline>),
    /// A figure by its name: its picture is `figures/NAME.svg`. Its description is for those who do not see it; the origin
    /// is where its data is, and the code that draws it.
    Figure {
        id: String,
        number: String,
        name: String,
        alt: String,
        origin: Vec<Inline>,
        caption: Vec<Inline>,
    },
    /// A table; one with a caption has a number.
    Table {
        id: Option<String>,
        number: Option<String>,
        caption: Vec<Inline>,
        columns: Vec<Alignment>,
        head: Vec<Vec<Inline>>,
        rows: Vec<Vec<Vec<Inline>>>,
    },
    /// A list; an ordered one has the number with which it starts.
    List {
        start: Option<u64>,
        items: Vec<Vec<Block>>,
    },
    Quote(Vec<Block>),
    Code {
        language: String,
        text: String,
    },
    /// A piece of the program's source, folded or put aside where a format can do that: the path of the item, its file from
    /// the top of the project, and the same in words as a link.
    Listing {
        id: String,
        number: String,
        caption: Vec<Inline>,
        item: String,
        file: String,
        origin: Vec<Inline>,
        text: String,
    },
    /// What a reader runs there, by the name of the function that runs it, in formats in which that is possible.
    Lab {
        lab: String,
        caption: Vec<Inline>,
    },
    /// The place of the list of references; filled by [`Labels::resolve`](super::labels::Labels::resolve).
    Bibliography(Vec<Entry>),
}

/// One entry of the list of references.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Key as in references.bib.
    pub key: String,
    /// Label as "Rice, 1945".
    pub label: String,
    pub text: Vec<Inline>,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Words; no markup inside.
    Text(String),
    /// A line break, which is a space.
    Soft,
    Code(String),
    Emphasis(Vec<Inline>),
    Strong(Vec<Inline>),
    /// Small and raised, as the number of a note: verdicts behind a statement.
    Raised(Vec<Inline>),
    /// Mathematics in the line, as TeX; values in it are framed (see [`super::mark`]).
    Maths(String),
    /// A displayed equation, as TeX without its tag; one without an id has no number.
    Display {
        tex: String,
        id: Option<String>,
        number: String,
    },
    /// A value: the words and mathematics that show it.
    Value {
        id: String,
        shown: Vec<Inline>,
    },
    /// A link out of the report, or to a file next to it.
    Link {
        to: String,
        shown: Vec<Inline>,
    },
    /// References `[@fig:3; @eq:18]` and citations `[@rice1945]`, until they are resolved.
    Unresolved(Vec<String>),
    /// A resolved reference to `fig:3` or `ref:rice1945`, and the document that has it, if it is another.
    Reference {
        to: String,
        within: Option<Document>,
        shown: String,
    },
    /// A place that can be referred to, `[!claim:rise]`; shows its number.
    Anchor {
        id: String,
        number: String,
    },
}

/// The words of the title, the first heading of level 1.
pub fn title(blocks: &[Block]) -> Result<&[Inline], Error> {
    let found = blocks.iter().find_map(|block| match block {
        Block::Heading { level: 1, text, .. } => Some(text.as_slice()),
        _ => None,
    });
    found.ok_or_else(|| Error::Markup("a report begins with its title, `# Words`".into()))
}

/// Is it a displayed equation alone?
pub fn is_equation(block: &Block) -> bool {
    matches!(block, Block::Paragraph(inlines) if matches!(inlines[..], [Inline::Display { .. }]))
}

/// Is it the heading of the abstract, which goes to the next heading?
pub fn is_abstract(block: &Block) -> bool {
    matches!(block, Block::Heading { text, .. } if plain(text) == "Abstract")
}

/// Does this paragraph go on with the sentence before it?
pub fn continues(block: &Block) -> bool {
    let Block::Paragraph(inlines) = block else { return false };
    matches!(inlines.first(), Some(Inline::Text(text)) if text.starts_with(char::is_lowercase))
}

/// All running texts of a block, in reading order, nested ones too.
fn texts(block: &mut Block) -> Vec<&mut Vec<Inline>> {
    match block {
        Block::Heading { text, .. } | Block::Paragraph(text) => vec![text],
        Block::Lab { caption, .. } => vec![caption],
        Block::Figure { caption, origin, .. } | Block::Listing { caption, origin, .. } => {
            vec![caption, origin]
        }
        Block::Table { caption, head, rows, .. } => {
            let cells = head.iter_mut().chain(rows.iter_mut().flatten());
            [caption].into_iter().chain(cells).collect()
        }
        Block::List { items, .. } => items.iter_mut().flatten().flat_map(texts).collect(),
        Block::Quote(inner) => inner.iter_mut().flat_map(texts).collect(),
        Block::Code { .. } | Block::Bibliography(_) => Vec::new(),
    }
}

/// Calls `visit` on each piece of running text of the blocks, nested ones too.
pub fn visit(blocks: &[Block], visit: &mut impl FnMut(&Inline)) {
    let mut each = |inline: Inline| {
        visit(&inline);
        Ok::<_, std::convert::Infallible>(vec![inline])
    };
    let Ok(()) = rewrite(&mut blocks.to_vec(), &mut each);
}

fn inner(inline: &Inline) -> &[Inline] {
    match inline {
        Inline::Emphasis(inner) | Inline::Strong(inner) | Inline::Raised(inner) => inner,
        Inline::Link { shown, .. } | Inline::Value { shown, .. } => shown,
        _ => &[],
    }
}

/// Replaces each piece of running text of the blocks by the pieces that `change` makes of it.
pub fn rewrite<E>(
    blocks: &mut [Block],
    change: &mut impl FnMut(Inline) -> Result<Vec<Inline>, E>,
) -> Result<(), E> {
    let mut texts = blocks.iter_mut().flat_map(texts);
    texts.try_for_each(|text| rewrite_inlines(text, change))
}

fn rewrite_inlines<E>(
    inlines: &mut Vec<Inline>,
    change: &mut impl FnMut(Inline) -> Result<Vec<Inline>, E>,
) -> Result<(), E> {
    let mut out = Vec::with_capacity(inlines.len());
    for mut inline in std::mem::take(inlines) {
        match &mut inline {
            Inline::Emphasis(inner) | Inline::Strong(inner) | Inline::Raised(inner) => {
                rewrite_inlines(inner, change)?;
            }
            Inline::Link { shown, .. } | Inline::Value { shown, .. } => {
                rewrite_inlines(shown, change)?;
            }
            _ => {}
        }
        out.extend(change(inline)?);
    }
    *inlines = out;
    Ok(())
}

/// A link to a file of the project, `../src/main.rs` as from paper/, as it leads from where the report is written;
/// where no way leads there, its words alone.
pub fn led(inline: Inline, top: Option<&str>) -> Vec<Inline> {
    match inline {
        Inline::Link { to, shown } if to.starts_with("../") => match top {
            Some(top) => vec![Inline::Link { to: to.replacen("../", top, 1), shown }],
            None => shown,
        },
        other => vec![other],
    }
}

/// The words alone, for alternative text and widths of columns.
pub fn plain(inlines: &[Inline]) -> String {
    words(inlines, &bare)
}

/// The words for a terminal, mathematics among them.
pub fn spelt(inlines: &[Inline]) -> String {
    words(inlines, &|tex| tex::spell(&bare(tex)))
}

fn words(inlines: &[Inline], maths: &dyn Fn(&str) -> String) -> String {
    let word = |inline: &Inline| match inline {
        Inline::Text(text) | Inline::Code(text) => text.clone(),
        Inline::Maths(tex) | Inline::Display { tex, .. } => maths(tex),
        Inline::Soft => " ".into(),
        Inline::Reference { shown: text, .. } | Inline::Anchor { number: text, .. } => text.clone(),
        other => words(inner(other), maths),
    };
    inlines.iter().map(word).collect()
}
