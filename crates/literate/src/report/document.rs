//! Defines the tree of a document, which stands between the prose and its formats.
//!
//! [`super::parse`] makes it from filled Markdown, [`super::labels`] adds numbers and resolves
//! references, and each format has one writer that walks it. Writers decide on markup only.

use super::edition::Document;
use super::tex;
use crate::print::Printed;
use pulldown_cmark::Alignment;

/// A block, with ids such as `sec:protocol`, and numbers as "2.1", which labels give.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A heading; level 1 is the title. It has no number, nor have unnumbered sections.
    Heading { level: u8, number: Option<String>, id: Option<String>, text: Vec<Inline> },
    /// A paragraph; displayed equations stand inside it.
    Paragraph(Vec<Inline>),
    /// A figure, with its files for pages and for LaTeX; the origin leads to its data and code.
    Figure {
        id: String,
        number: String,
        name: String,
        files: [String; 2],
        alt: String,
        origin: Vec<Inline>,
        caption: Vec<Inline>,
    },
    /// A table, which has a number if it has a caption.
    Table(Table),
    /// A list; an ordered one has the number with which it starts.
    List { start: Option<u64>, items: Vec<Vec<Block>> },
    /// A quotation.
    Quote(Vec<Block>),
    /// A block of code.
    Code { language: String, code: String },
    /// A piece of the source: the path of the item, its file, and a link to that.
    Listing {
        id: String,
        number: String,
        caption: Vec<Inline>,
        item: String,
        file: String,
        origin: Vec<Inline>,
        code: String,
    },
    /// A function that readers of a page can run, by its name.
    Lab { lab: String, caption: Vec<Inline> },
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
    pub fn to_inlines(&self) -> Vec<Inline> {
        let mut inlines = vec![Inline::Text(format!("{} ({}).", self.authors, self.year))];
        inlines.extend(self.rest.iter().cloned());
        inlines
    }
}

#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Words; no markup inside.
    Text(String),
    /// The end of a line in the prose.
    Soft,
    /// Code within a line.
    Code(String),
    /// Slanted words.
    Emphasis(Vec<Inline>),
    /// Bold words.
    Strong(Vec<Inline>),
    /// Small and raised, as the number of a note: verdicts after a statement.
    Raised(Vec<Inline>),
    /// A formula within a line.
    Maths(Formula),
    /// A displayed equation without its tag; one without an id has no number.
    Display { formula: Formula, id: Option<String>, number: String },
    /// A value, which leads to its card.
    Value { id: String, printed: Printed },
    /// A link out of the report, or to a file next to it.
    Link { to: String, words: Vec<Inline> },
    /// References `[@fig:3; @fig:8]` and citations `[@rice1945]`, or one of them without brackets
    /// in a sentence, until they are resolved.
    Unresolved { ids: Vec<String>, in_sentence: bool },
    /// A resolved reference to `fig:3` or `ref:rice1945`, and the other document that has it.
    Reference { to: String, within: Option<Document>, label: String },
    /// A place that can be referred to, `[!claim:rise]`; shows its number.
    Anchor { id: String, number: String },
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Formula(pub Vec<Part>);

#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    Tex(String),
    Value { id: String, printed: Printed },
}

impl Formula {
    /// Returns the whole formula as TeX, in which `value` writes the values.
    pub fn to_tex_with(&self, value: impl Fn(&str, &Printed) -> String) -> String {
        let part = |part: &Part| match part {
            Part::Tex(tex) => tex.clone(),
            Part::Value { id, printed } => value(id, printed),
        };
        self.0.iter().map(part).collect()
    }

    pub fn to_tex(&self) -> String {
        self.to_tex_with(|_, printed| printed.to_tex())
    }
}

impl From<&str> for Formula {
    fn from(tex: &str) -> Formula {
        Formula(vec![Part::Tex(tex.into())])
    }
}

/// Adds a piece of running text; words that touch are one text.
pub fn push(inlines: &mut Vec<Inline>, next: Inline) {
    match (inlines.last_mut(), next) {
        (Some(Inline::Text(before)), Inline::Text(words)) => before.push_str(&words),
        (_, next) => inlines.push(next),
    }
}

/// Returns a printed value as text, with its formulas, or as a formula where it has a power of ten.
pub fn to_inlines(printed: &Printed) -> Vec<Inline> {
    let numeral = match printed {
        Printed::Words(words) if has_formulas(&in_one_line(words)) => {
            return words_and_maths(&in_one_line(words));
        }
        Printed::Words(words) => return vec![Inline::Text(in_one_line(words))],
        Printed::Number(numeral) => numeral,
    };
    let percent = if numeral.in_percent { "\u{a0}%" } else { "" };
    match numeral.power_to_tex() {
        Some(power) => vec![Inline::Maths(power.as_str().into()), Inline::Text(percent.into())],
        None => vec![Inline::Text(numeral.signed("−") + percent)],
    }
}

/// Returns whether words from data have formulas, `at $h = 0.3$`: each of their dollar signs begins
/// one behind a blank or ends one before no letter. Otherwise, `^a$|^b$`, they are signs.
pub fn has_formulas(words: &str) -> bool {
    let parts: Vec<&str> = words.split('$').collect();
    let is_formula = |index: usize| {
        let [before, tex, after] = [index - 1, index, index + 1].map(|index| parts[index]);
        let opens = before.ends_with([' ', '(', '[', '“']) || before.is_empty() && index == 1;
        let closes =
            !tex.is_empty() && tex.trim() == tex && !after.starts_with(char::is_alphanumeric);
        opens && closes && tex::unsupported(tex).is_none()
    };
    parts.len() % 2 == 1 && parts.len() > 1 && (1..parts.len()).step_by(2).all(is_formula)
}

pub fn in_one_line(words: &str) -> String {
    words.replace("\r\n", " ").replace(['\n', '\r', '\t'], " ")
}

/// Splits a text of an author, `3 $\times$ 4`, into words and formulas. A dollar sign alone, and
/// one that Markdown would not take for mathematics, as in `$5 and $6`, is a word.
pub fn words_and_maths(words: &str) -> Vec<Inline> {
    let formula = |words: &str| {
        words.match_indices('$').find_map(|(begin, _)| {
            let (tex, beyond) = words[begin + 1..].split_once('$')?;
            let fits = !tex.is_empty() && tex.trim() == tex;
            let is_price = beyond.starts_with(|c: char| c.is_ascii_digit());
            (fits && !is_price).then_some((begin, tex.len()))
        })
    };
    let (mut inlines, mut rest) = (Vec::new(), words);
    while let Some((begin, length)) = formula(rest) {
        inlines.push(Inline::Text(rest[..begin].into()));
        inlines.push(Inline::Maths(rest[begin + 1..][..length].into()));
        rest = &rest[begin + length + 2..];
    }
    inlines.push(Inline::Text(rest.into()));
    inlines.retain(|piece| *piece != Inline::Text(String::new()));
    inlines
}

/// Returns the title, which the parser and `assemble` see to.
pub fn title(blocks: &[Block]) -> Option<&[Inline]> {
    blocks.iter().find_map(|block| match block {
        Block::Heading { level: 1, text, .. } => Some(text.as_slice()),
        _ => None,
    })
}

/// Returns whether the abstract begins, which extends to the next heading or figure.
pub fn is_abstract(block: &Block) -> bool {
    matches!(block, Block::Heading { text, .. } if to_plain_text(text) == "Abstract")
}

/// Returns the id of a heading on a page: its own, or `sec-2-1` by its number, or its words.
pub fn heading_place(id: Option<&str>, number: Option<&str>, words: &[Inline]) -> String {
    match (id, number) {
        (Some(id), _) => place_on_page(id),
        (None, Some(number)) => place_on_page(&format!("sec:{number}")),
        (None, None) => {
            let words = to_plain_text(words).to_lowercase();
            let words = words.split(|c: char| !c.is_ascii_alphanumeric());
            words.filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
        }
    }
}

/// Returns the id of a place on a page: `fig-3` for `fig:3`.
pub fn place_on_page(id: &str) -> String {
    place(id).replace([':', '.'], "-")
}

/// Encodes an address as a link needs it: other characters, and brackets without their pairs, as
/// `%7C`, since formats read them as markup.
pub fn address(to: &str) -> String {
    let deeper =
        |depth: i32, c| Some(depth + i32::from(c == '(') - i32::from(c == ')')).filter(|d| *d >= 0);
    let in_pairs = to.chars().try_fold(0, deeper) == Some(0);
    let is_own = |c: char| c.is_ascii_alphanumeric() || "-._~:/?#[]@!$&'*+,;=%".contains(c);
    let mut encoded = String::new();
    for c in to.chars() {
        if is_own(c) || in_pairs && "()".contains(c) {
            encoded.push(c);
        } else {
            encoded.extend(c.encode_utf8(&mut [0; 4]).bytes().map(|byte| format!("%{byte:02X}")));
        }
    }
    encoded
}

/// Returns an id in which other characters than letters, digits and `:-_.` are replaced by their
/// codes: TeX or a page would read them, and a key may have them.
pub fn place(id: &str) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || ":-_.".contains(c);
    let escaped = |c| if is_safe(c) { c.to_string() } else { format!("-{:x}", u32::from(c)) };
    id.chars().map(escaped).collect()
}

/// Returns whether a sentence continues from a paragraph to the next, over a displayed equation.
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

/// Returns the running texts of a block, nested ones too, in reading order.
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
            Inline::Link { words, .. } => rewrite_inlines(words, change),
            _ => {}
        }
        inlines.extend(change(inline));
    }
}

/// Makes a link to a file of the project, `../src/main.rs`, relative to the folder of the report,
/// where `top` is the path to the project; only its words are left if there is no such path.
pub fn relative_link(inline: Inline, top: Option<&str>) -> Vec<Inline> {
    match inline {
        Inline::Link { to, words } if to.starts_with("../") => match top {
            Some(top) => vec![Inline::Link { to: to.replacen("../", top, 1), words }],
            None => words,
        },
        other => vec![other],
    }
}

/// Returns the words alone, with formulas in TeX, for alternative texts and widths of columns.
pub fn to_plain_text(inlines: &[Inline]) -> String {
    to_text(inlines, &|tex| tex.into())
}

/// Returns the words for a terminal, with formulas spelt in characters.
pub fn to_spelt_text(inlines: &[Inline]) -> String {
    to_text(inlines, &tex::spell)
}

fn to_text(inlines: &[Inline], maths: &dyn Fn(&str) -> String) -> String {
    let mut text = String::new();
    for inline in inlines {
        text += &match inline {
            Inline::Text(text) | Inline::Code(text) => text.clone(),
            Inline::Maths(formula) | Inline::Display { formula, .. } => maths(&formula.to_tex()),
            Inline::Soft => " ".into(),
            Inline::Reference { label, .. } => label.clone(),
            Inline::Anchor { number, .. } => number.clone(),
            Inline::Value { printed, .. } => to_text(&to_inlines(printed), maths),
            Inline::Emphasis(inner) | Inline::Strong(inner) | Inline::Raised(inner) => {
                to_text(inner, maths)
            }
            Inline::Link { words: shown, .. } => to_text(shown, maths),
            Inline::Unresolved { .. } => String::new(),
        };
    }
    text
}
