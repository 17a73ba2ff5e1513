//! Defines the tree of a document, which stands between the prose and its formats.
//!
//! [`super::parse`] makes it from filled Markdown, [`super::labels`] adds numbers and resolves
//! references, and each format has one writer that walks it. Writers decide on markup only.

use super::edition::Document;
use super::error::Error;
use super::tex;
use crate::print::Shown;
use pulldown_cmark::Alignment;

/// A block, with ids such as `sec:protocol`, and numbers as "2.1", which labels give.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading; level 1 is the title. It has no number, nor have unnumbered sections.
    Heading {
        level: u8,
        number: Option<String>,
        id: Option<String>,
        text: Vec<Inline>,
    },
    /// A paragraph; displayed equations stand inside it.
    Paragraph(Vec<Inline>),
    /// A figure, with the names of its files for pages and for LaTeX (the path in the prose until
    /// the figure is found); the origin says where its data and code are.
    Figure {
        id: String,
        number: String,
        name: String,
        files: [String; 2],
        alt: String,
        origin: Vec<Inline>,
        caption: Vec<Inline>,
    },
    Table(Table),
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
    /// A piece of the source: the path of the item, its file, and a link to that.
    Listing {
        id: String,
        number: String,
        caption: Vec<Inline>,
        item: String,
        file: String,
        origin: Vec<Inline>,
        text: String,
    },
    /// A function that readers of a page can run, by its name.
    Lab {
        lab: String,
        caption: Vec<Inline>,
    },
    /// The place of the list of references, which `Labels::resolve` fills.
    Bibliography(Vec<Reference>),
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    pub id: Option<String>,
    pub number: Option<String>,
    pub caption: Vec<Inline>,
    pub columns: Vec<Alignment>,
    pub head: Vec<Vec<Inline>>,
    pub rows: Vec<Vec<Vec<Inline>>>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    pub key: String,
    /// The authors as a citation names them: "Homer & Hogan".
    pub names: String,
    /// Year of a citation, with a letter where several would look alike: "1954a".
    pub year: String,
    /// All authors, as the list shows them before the year in brackets.
    pub authors: String,
    pub rest: Vec<Inline>,
}

impl Reference {
    pub fn text(&self) -> Vec<Inline> {
        let mut text = vec![Inline::Text(format!("{} ({}).", self.authors, self.year))];
        text.extend(self.rest.iter().cloned());
        text
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Words; no markup inside.
    Text(String),
    Soft,
    Code(String),
    Emphasis(Vec<Inline>),
    Strong(Vec<Inline>),
    /// Small and raised, as the number of a note: verdicts after a statement.
    Raised(Vec<Inline>),
    Maths(Formula),
    /// A displayed equation without its tag; one without an id has no number.
    Display {
        formula: Formula,
        id: Option<String>,
        number: String,
    },
    Value {
        id: String,
        shown: Shown,
    },
    /// A link out of the report, or to a file next to it.
    Link {
        to: String,
        shown: Vec<Inline>,
    },
    /// References `[@fig:3; @fig:8]` and citations `[@rice1945]`, or one of them without brackets
    /// in a sentence, until they are resolved.
    Unresolved {
        ids: Vec<String>,
        in_sentence: bool,
    },
    /// A resolved reference to `fig:3` or `ref:rice1945`, and the other document that has it.
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

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Formula(pub Vec<Part>);

#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    Tex(String),
    Value { id: String, shown: Shown },
}

impl Formula {
    /// Returns the whole formula as TeX, in which `value` writes the values.
    pub fn tex(&self, value: impl Fn(&str, &Shown) -> String) -> String {
        let part = |part: &Part| match part {
            Part::Tex(tex) => tex.clone(),
            Part::Value { id, shown } => value(id, shown),
        };
        self.0.iter().map(part).collect()
    }

    pub fn digits(&self) -> String {
        self.tex(|_, shown| shown.tex())
    }
}

impl From<&str> for Formula {
    fn from(tex: &str) -> Formula {
        Formula(vec![Part::Tex(tex.into())])
    }
}

/// Returns a printed value as text, with its formulas, or as a formula where it has a power of ten.
pub fn printed(shown: &Shown) -> Vec<Inline> {
    let numeral = match shown {
        Shown::Words(words) => {
            let line = in_one_line(words);
            return if has_formulas(&line) {
                words_and_maths(&line)
            } else {
                vec![Inline::Text(line)]
            };
        }
        Shown::Number(numeral) => numeral,
    };
    let percent = if numeral.percent { "\u{a0}%" } else { "" };
    match numeral.tex_power() {
        Some(power) => vec![Inline::Maths(power.as_str().into()), Inline::Text(percent.into())],
        None => vec![Inline::Text(numeral.signed("−") + percent)],
    }
}

/// Whether words from data are written with formulas, `at $h = 0.3$`: each of their dollar signs
/// begins one behind a blank or ends one before no letter. Else, as in `^a$|^b$`, they are signs.
pub fn has_formulas(words: &str) -> bool {
    let parts: Vec<&str> = words.split('$').collect();
    let is_formula = |at: usize| {
        let [before, tex, after] = [at - 1, at, at + 1].map(|at| parts[at]);
        let opens = before.ends_with([' ', '(', '[', '“']) || before.is_empty() && at == 1;
        let closes =
            !tex.is_empty() && tex.trim() == tex && !after.starts_with(char::is_alphanumeric);
        opens && closes && tex::refused(tex).is_none()
    };
    parts.len() % 2 == 1 && parts.len() > 1 && (1..parts.len()).step_by(2).all(is_formula)
}

pub fn in_one_line(words: &str) -> String {
    words.replace("\r\n", " ").replace(['\n', '\r', '\t'], " ")
}

/// Splits a text of an author, `3 $\times$ 4`, into words and formulas. A dollar sign alone, and
/// one that Markdown would not take for mathematics, as in `$5 and $6`, is a word.
pub fn words_and_maths(text: &str) -> Vec<Inline> {
    let formula = |text: &str| {
        text.match_indices('$').find_map(|(at, _)| {
            let (tex, beyond) = text[at + 1..].split_once('$')?;
            let fits = !tex.is_empty() && tex.trim() == tex;
            let is_price = beyond.starts_with(|c: char| c.is_ascii_digit());
            (fits && !is_price).then_some((at, tex.len()))
        })
    };
    let (mut out, mut rest) = (Vec::new(), text);
    while let Some((at, length)) = formula(rest) {
        out.push(Inline::Text(rest[..at].into()));
        out.push(Inline::Maths(rest[at + 1..][..length].into()));
        rest = &rest[at + length + 2..];
    }
    out.push(Inline::Text(rest.into()));
    out.retain(|piece| *piece != Inline::Text(String::new()));
    out
}

pub fn title(blocks: &[Block]) -> Result<&[Inline], Error> {
    let found = blocks.iter().find_map(|block| match block {
        Block::Heading { level: 1, text, .. } => Some(text.as_slice()),
        _ => None,
    });
    found.ok_or_else(|| Error::Markup("a report begins with its title, `# Words`".into()))
}

/// Whether it is the heading of the abstract, which extends to the next heading or figure.
pub fn is_abstract(block: &Block) -> bool {
    matches!(block, Block::Heading { text, .. } if plain(text) == "Abstract")
}

/// Returns the id of a heading on a page: its own, or `sec-2-1` by its number, or its words.
pub fn heading_place(id: Option<&str>, number: Option<&str>, words: &[Inline]) -> String {
    match (id, number) {
        (Some(id), _) => place_on_page(id),
        (None, Some(number)) => place_on_page(&format!("sec:{number}")),
        (None, None) => {
            let words = plain(words).to_lowercase();
            let words = words.split(|c: char| !c.is_ascii_alphanumeric());
            words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
        }
    }
}

/// Returns the id of a place on a page: `fig-3` for `fig:3`.
pub fn place_on_page(id: &str) -> String {
    place(id).replace([':', '.'], "-")
}

/// Writes what no address has, and brackets without their pairs, as `%7C`: every format has such
/// signs for itself.
pub fn address(to: &str) -> String {
    let deeper =
        |depth: i32, c| Some(depth + i32::from(c == '(') - i32::from(c == ')')).filter(|d| *d >= 0);
    let in_pairs = to.chars().try_fold(0, deeper) == Some(0);
    let is_own = |c: char| c.is_ascii_alphanumeric() || "-._~:/?#[]@!$&'*+,;=%".contains(c);
    let mut out = String::new();
    for c in to.chars() {
        if is_own(c) || in_pairs && "()".contains(c) {
            out.push(c);
        } else {
            out.extend(c.encode_utf8(&mut [0; 4]).bytes().map(|byte| format!("%{byte:02X}")));
        }
    }
    out
}

/// Returns an id without signs that TeX or a page would read: a key may have them.
pub fn place(id: &str) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || ":-_.".contains(c);
    let escaped = |c| if is_safe(c) { c.to_string() } else { format!("-{:x}", u32::from(c)) };
    id.chars().map(escaped).collect()
}

/// Whether a sentence continues from one paragraph to the next, with or after a displayed equation.
pub fn goes_on(before: &Block, next: &Block) -> bool {
    let (Block::Paragraph(before), Block::Paragraph(next)) = (before, next) else { return false };
    match (before.as_slice(), next.as_slice()) {
        (_, [Inline::Display { .. }]) => true,
        ([Inline::Display { .. }], [Inline::Text(text), ..]) => {
            text.starts_with(char::is_lowercase)
        }
        _ => false,
    }
}

/// All running texts of a block, in reading order, nested ones too.
fn texts(block: &mut Block) -> Vec<&mut Vec<Inline>> {
    match block {
        Block::Heading { text, .. } | Block::Paragraph(text) => vec![text],
        Block::Lab { caption, .. } => vec![caption],
        Block::Figure { caption, origin, .. } | Block::Listing { caption, origin, .. } => {
            vec![caption, origin]
        }
        Block::Table(Table { caption, head, rows, .. }) => {
            [caption].into_iter().chain(head).chain(rows.iter_mut().flatten()).collect()
        }
        Block::List { items, .. } => items.iter_mut().flatten().flat_map(texts).collect(),
        Block::Quote(blocks) => blocks.iter_mut().flat_map(texts).collect(),
        Block::Code { .. } | Block::Bibliography(_) => Vec::new(),
    }
}

/// Calls `visit` on each piece of running text of the blocks, nested ones too.
pub fn visit(blocks: &mut [Block], visit: &mut impl FnMut(&mut Inline)) {
    rewrite(blocks, &mut |mut inline| {
        visit(&mut inline);
        vec![inline]
    });
}

/// Replaces each piece of running text of the blocks by what `change` returns for it.
pub fn rewrite(blocks: &mut [Block], change: &mut impl FnMut(Inline) -> Vec<Inline>) {
    for text in blocks.iter_mut().flat_map(texts) {
        rewrite_inlines(text, change);
    }
}

fn rewrite_inlines(inlines: &mut Vec<Inline>, change: &mut impl FnMut(Inline) -> Vec<Inline>) {
    for mut inline in std::mem::take(inlines) {
        match &mut inline {
            Inline::Emphasis(inner) | Inline::Strong(inner) | Inline::Raised(inner) => {
                rewrite_inlines(inner, change);
            }
            Inline::Link { shown, .. } => rewrite_inlines(shown, change),
            _ => {}
        }
        inlines.extend(change(inline));
    }
}

/// Makes a link to a file of the project, `../src/main.rs`, relative to the folder of the report,
/// where `top` is the path to the project; only its words are left if there is no such path.
pub fn relative_link(inline: Inline, top: Option<&str>) -> Vec<Inline> {
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
    words(inlines, &|tex| tex.into())
}

/// The words for a terminal, mathematics among them.
pub fn spelt(inlines: &[Inline]) -> String {
    words(inlines, &tex::spell)
}

fn words(inlines: &[Inline], maths: &dyn Fn(&str) -> String) -> String {
    let mut out = String::new();
    for inline in inlines {
        out += &match inline {
            Inline::Text(text) | Inline::Code(text) => text.clone(),
            Inline::Maths(formula) | Inline::Display { formula, .. } => maths(&formula.digits()),
            Inline::Soft => " ".into(),
            Inline::Reference { shown, .. } => shown.clone(),
            Inline::Anchor { number, .. } => number.clone(),
            Inline::Value { shown, .. } => words(&printed(shown), maths),
            Inline::Emphasis(inner) | Inline::Strong(inner) | Inline::Raised(inner) => {
                words(inner, maths)
            }
            Inline::Link { shown, .. } => words(shown, maths),
            Inline::Unresolved { .. } => String::new(),
        };
    }
    out
}
