//! Filled Markdown → the tree of [`super::document`].
//!
//! The prose is CommonMark with tables, `$…$` and `$$…$$`, and these forms of our own:
//!
//! - `## Words {#sec:id}`: a section; numbers are given in order; `{#sec:id .unnumbered}` has none.
//! - `$$ … \tag{18} $$`: a numbered equation; its id is `eq:18`.
//! - `![caption](figures/fig03.svg)` alone in a paragraph: a figure; its id is `fig:3`.
//! - `Table: caption {#tab:id}`, a paragraph right before a table: its caption.
//! - `Listing: caption {#lst:id}`, a paragraph right before `«code(item="path::of::item")»`: a
//!   listing of that item of the source.
//! - `Lab name: caption`, a paragraph: what readers run themselves, where a format can, else nothing.
//! - `[!claim:id]`: a place that can be referred to; it shows its number.
//! - `[@eq:18]`, `[@fig:2; @fig:3]`, `[@sec:id]`, `[@tab:id]`, `[@lst:id]`, `[@claim:id]`: references, written
//!   out as "Eq. (18)" and so on; with a capital, as `[@Fig:2]`, in full as at the start of a sentence.
//! - `[@row:id]`: the verdict on a statement and the number of its row, small behind the sentence; `[@mark:id]`: the same
//!   in a line; `[@sign:id]`: the sign of the verdict alone.
//! - `[@rice1945]`: a citation of `references.bib`.
//! - `[@bibliography]` alone in a paragraph: the list of what was cited.
//!
//! Signs of markup that are left over as text are errors; one that is meant has a backslash before it.

mod inlines;
mod leftover;
mod written;

use super::Error;
use super::captions::{join, listing, opens_caption, paragraph, stands_within};
use super::document::{Align, Block, Inline, plain};
use super::labels::of_kind;
use super::origin::{Filled, Places};
use super::values::Registry;
use crate::source::Program;
use pulldown_cmark::{Alignment, BrokenLink, CowStr, Event, Options, Parser, Tag};
use std::ops::Range;
use written::{attributes, cells_of, comment, markup};

/// Parses filled Markdown; `values` turn marks into what is shown. The places are those of what has an id
/// and of what names one.
pub fn parse<'a>(
    filled: &'a Filled,
    values: &'a Registry,
    program: Program,
) -> Result<(Vec<Block>, Places<'a>), Error> {
    let options =
        Options::ENABLE_MATH | Options::ENABLE_TABLES | Options::ENABLE_HEADING_ATTRIBUTES;
    let callback = |link: BrokenLink<'_>| {
        let own = link.reference.starts_with('@') || link.reference.starts_with('!');
        own.then(|| (CowStr::from(link.reference.to_string()), CowStr::from("")))
    };
    let parser = Parser::new_with_broken_link_callback(&filled.text, options, Some(callback));
    if let Some((_, definition)) = parser.reference_definitions().iter().next() {
        let error = Error::Markup("a definition of a link is shown nowhere".into());
        return Err(error.at(filled.place(definition.span.start)));
    }
    let events: Vec<(Event<'_>, Range<usize>)> = parser.into_offset_iter().collect();
    let mut reader = Reader {
        events: events.into_iter().peekable(),
        filled,
        values,
        program,
        at: 0,
        attribute: None,
        inside: 0,
        within: 0,
        titled: false,
        level: 1,
        places: Places::of(filled),
    };
    match reader.shallow().and_then(|()| reader.blocks()) {
        Ok(blocks) => Ok((blocks, reader.places)),
        Err(error) => Err(error.at(filled.place(reader.at))),
    }
}

/// Lists, quotations and spans within each other, at most: what reads and writes them calls itself.
const DEEPEST: usize = 40;

struct Reader<'a> {
    events: std::iter::Peekable<std::vec::IntoIter<(Event<'a>, Range<usize>)>>,
    filled: &'a Filled,
    program: Program,
    values: &'a Registry,
    /// Where in the filled text what is being read begins.
    at: usize,
    /// Where the last `{#id}` stands that nothing has taken yet.
    attribute: Option<usize>,
    /// Emphasis and links about what is being read.
    inside: usize,
    /// Lists and quotations about it.
    within: usize,
    /// Whether there is a title already, and the level of the last heading.
    titled: bool,
    level: u8,
    places: Places<'a>,
}

impl<'a> Reader<'a> {
    /// Refuses what is nested deeper than any prose.
    fn shallow(&mut self) -> Result<(), Error> {
        let mut depth: usize = 0;
        for (event, range) in self.events.clone() {
            match event {
                Event::Start(_) => depth += 1,
                Event::End(_) => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth > DEEPEST {
                self.at = range.start;
                return Err(markup(format!("more than {DEEPEST} levels within each other")));
            }
        }
        Ok(())
    }

    fn peek(&mut self) -> Option<&Event<'a>> {
        self.events.peek().map(|(event, _)| event)
    }

    /// The next event; what is wrong with it stands where it begins.
    fn next(&mut self) -> Option<(Event<'a>, Range<usize>)> {
        let found = self.events.next()?;
        if !matches!(found.0, Event::End(_)) {
            self.at = found.1.start;
        }
        Some(found)
    }

    /// The source of a part of the filled text.
    fn source(&self, range: &Range<usize>) -> &'a str {
        &self.filled.text[range.clone()]
    }

    /// Blocks up to the end of what contains them.
    fn blocks(&mut self) -> Result<Vec<Block>, Error> {
        let mut blocks = Vec::new();
        // Where a caption begins that waits for its table or listing.
        let mut caption = None;
        while let Some(event) = self.peek() {
            let new = match event {
                Event::End(_) => break,
                Event::Start(tag) if is_block(tag) => match self.next() {
                    Some((Event::Start(tag), range)) => self.block(tag, range)?,
                    _ => None,
                },
                Event::Rule => {
                    self.next();
                    return Err(markup("a line across the page is shown nowhere"));
                }
                // Text right inside an item of a tight list.
                _ => {
                    let begun = self.events.peek().map_or(self.at, |(_, range)| range.start);
                    Some(self.paragraph(begun)?)
                }
            };
            let Some(mut block) = new else { continue };
            let begun = self.at;
            if let (Some(Block::List { start: one, .. }), Block::List { start: other, .. }) =
                (blocks.last(), &block)
                && one.is_some() == other.is_some()
            {
                return Err(markup(
                    "two lists without words between them are read as one; make them one",
                ));
            }
            let is_list = |block: &Block| matches!(block, Block::Bibliography(_));
            if is_list(&block) && blocks.iter().any(is_list) {
                return Err(markup("a second [@bibliography]; a document has one"));
            }
            if self.within > 0 && !stands_within(&block) {
                return Err(markup(
                    "what has a number or a place of its own stands in no list and no quotation",
                ));
            }
            self.at = caption.unwrap_or(begun);
            let joined = join(&mut blocks, &mut block)?;
            if let (Some(id), Some(offset)) = (&joined, caption) {
                self.attribute = None;
                self.at = offset;
                let kind = if matches!(block, Block::Table { .. }) { "tab" } else { "lst" };
                id.iter().try_for_each(|id| of_kind(kind, id))?;
                id.iter().for_each(|id| self.places.add(format!("#{id}"), offset));
            } else if let Some(offset) = caption {
                self.at = offset;
                return Err(markup("a caption without its table or code right behind it"));
            }
            caption = opens_caption(&block).then_some(begun);
            if let Some(offset) = self.attribute.filter(|_| caption.is_none()) {
                self.at = offset;
                return Err(markup(
                    "an id {#…} stands behind a heading or at the end of a caption",
                ));
            }
            blocks.push(block);
        }
        match caption {
            None => Ok(blocks),
            Some(offset) => {
                self.at = offset;
                Err(markup("a caption without its table or code right behind it"))
            }
        }
    }

    /// Blocks of an item of a list, or of a quotation.
    fn inner(&mut self) -> Result<Vec<Block>, Error> {
        self.within += 1;
        let blocks = self.blocks()?;
        self.within -= 1;
        Ok(blocks)
    }

    fn block(&mut self, tag: Tag<'_>, range: Range<usize>) -> Result<Option<Block>, Error> {
        let block = match tag {
            Tag::Paragraph => {
                let text = self.source(&range).trim();
                let begins = text.starts_with('[') && !text.starts_with("[@");
                if begins && text.contains("](figures/") && text.ends_with(".svg)") {
                    return Err(markup(
                        "a picture has ! before its brackets, ![caption](figures/…)",
                    ));
                }
                self.paragraph(range.start)?
            }
            Tag::Heading { level, id, classes, attrs } => {
                let level = level as u8;
                let unnumbered = classes.iter().any(|class| &**class == "unnumbered");
                let own = id
                    .iter()
                    .map(|id| format!("#{id}"))
                    .chain(unnumbered.then(|| ".unnumbered".into()));
                let written = attributes(self.source(&range));
                if !attrs.is_empty() || (!written.is_empty() && written != own.collect::<Vec<_>>())
                {
                    return Err(markup(
                        "a heading has {#sec:id .unnumbered} behind it, or one of both, and nothing else",
                    ));
                }
                id.iter().try_for_each(|id| of_kind("sec", id))?;
                if level == 1 && std::mem::replace(&mut self.titled, true) {
                    return Err(markup("a second title: sections begin with ##"));
                }
                if level > self.level + 1 {
                    return Err(markup("a heading steps over a level"));
                }
                self.level = level;
                let text = self.without_pictures()?;
                self.at = range.start;
                let leads =
                    |inline: &Inline| matches!(inline, Inline::Link { .. } | Inline::Unresolved(_));
                if text.iter().any(leads) {
                    return Err(markup("a heading leads nowhere else; put the link into the text"));
                }
                if plain(&text).trim().is_empty() {
                    return Err(markup("a heading without words"));
                }
                let id = id.map(|id| id.to_string());
                id.iter().for_each(|id| self.places.add(format!("#{id}"), range.start));
                let number = (!unnumbered && matches!(level, 2 | 3)).then(String::new);
                Block::Heading { level, number, id, text }
            }
            Tag::BlockQuote(_) => Block::Quote(self.inner()?),
            Tag::List(start) => {
                let mut items = Vec::new();
                while let Some(Event::Start(Tag::Item)) = self.peek() {
                    self.next();
                    items.push(self.inner()?);
                    self.next();
                }
                Block::List { start, items }
            }
            Tag::CodeBlock(kind) => {
                let fenced = kind.is_fenced();
                let language = match kind {
                    pulldown_cmark::CodeBlockKind::Fenced(language) => language.to_string(),
                    pulldown_cmark::CodeBlockKind::Indented => String::new(),
                };
                let mut text = String::new();
                while let Some(Event::Text(piece)) = self.peek() {
                    text.push_str(piece);
                    self.next();
                }
                self.at = range.start;
                if !fenced {
                    return Err(markup(
                        "words set in by four blanks are code; put it between ```, or set them less",
                    ));
                }
                let last = self.source(&range).trim_end().lines().skip(1).last();
                if !last.is_some_and(|line| line.trim_start().starts_with(['`', '~'])) {
                    return Err(markup("a block of code without its end"));
                }
                let word = language.split(' ').next().unwrap_or_default();
                if word == "math" || word.contains(|c: char| !c.is_ascii_alphanumeric()) {
                    let what = "code of a language is named by a word; a formula stands between $$";
                    return Err(markup(format!("{what}, and not in {word}")));
                }
                match language.split_once(' ') {
                    Some((_, item)) => listing(item, &self.program)?,
                    None => Block::Code { language, text: self.written(&text)? },
                }
            }
            Tag::Table(columns) => {
                let table = self.table(&columns)?;
                self.at = range.start;
                table
            }
            Tag::HtmlBlock => {
                // Comments are for writers; other HTML has no place in four formats.
                let mut html = String::new();
                while let Some(Event::Html(piece)) = self.peek() {
                    html.push_str(piece);
                    self.next();
                }
                self.at = range.start;
                comment(html.trim())?;
                self.next();
                return Ok(None);
            }
            other => return Err(markup(format!("no such markup: {other:?}"))),
        };
        self.next();
        Ok(Some(block))
    }

    /// A paragraph that begins there, or what stands alone in it.
    fn paragraph(&mut self, begun: usize) -> Result<Block, Error> {
        let inlines = self.inlines()?;
        self.at = begun;
        let block = paragraph(inlines)?;
        match &block {
            Block::Figure { id, path, .. } => {
                self.places.add(format!("#{id}"), begun);
                self.places.add(format!("({path}"), begun);
            }
            Block::Lab { lab, .. } => self.places.add(format!("Lab {lab}"), begun),
            _ => {}
        }
        Ok(block)
    }

    fn table(&mut self, columns: &[Alignment]) -> Result<Block, Error> {
        let mut rows = Vec::new();
        while let Some(Event::Start(Tag::TableHead | Tag::TableRow)) = self.peek() {
            let Some((_, range)) = self.next() else { break };
            // Markdown cuts and fills rows in silence.
            let (own, all) = (cells_of(self.source(&range)), columns.len());
            if own != all {
                return Err(markup(format!(
                    "a row of {own} cells in a table of {all} columns; a bar in a cell is \\|"
                )));
            }
            let mut cells = Vec::new();
            while let Some(Event::Start(Tag::TableCell)) = self.peek() {
                self.next();
                cells.push(self.without_pictures()?);
                self.next();
            }
            self.next();
            rows.push(cells);
        }
        let align = |column: &Alignment| match column {
            Alignment::Right => Align::Right,
            Alignment::Center => Align::Centre,
            Alignment::Left | Alignment::None => Align::Left,
        };
        let columns = columns.iter().map(align).collect();
        let head = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
        Ok(Block::Table { id: None, number: None, caption: Vec::new(), columns, head, rows })
    }
}

fn is_block(tag: &Tag<'_>) -> bool {
    use Tag::{BlockQuote, CodeBlock, Heading, HtmlBlock, Item, List, Paragraph, Table};
    matches!(
        tag,
        Paragraph
            | Heading { .. }
            | BlockQuote(_)
            | CodeBlock(_)
            | HtmlBlock
            | List(_)
            | Item
            | Table(_)
    )
}
