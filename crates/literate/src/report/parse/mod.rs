//! Reads filled Markdown into the tree of `document`, and looks for hard-coded numbers.
//!
//! The manual ([`crate::manual`]) lists all markup. Whatever else Markdown reads is refused, and so
//! is markup that is not closed.

mod brackets;
mod inlines;

use super::card::links;
use super::document::{Block, Inline, Table, to_plain_text};
use super::edition::Document;
use super::error::{Error, Thing, fault};
use super::filled::{Filled, Part};
use super::input::Input;
use super::latex;
use crate::input::one_line;
use pulldown_cmark::{
    Alignment, BrokenLink, CodeBlockKind, CowStr, Event, Options, Parser, Tag, TagEnd,
};
use std::ops::Range;

/// Parses the filled Markdown of a document.
pub fn parse<'a>(filled: &'a Filled, document: Document, input: &Input<'a>) -> Part<'a> {
    let options =
        Options::ENABLE_MATH | Options::ENABLE_TABLES | Options::ENABLE_HEADING_ATTRIBUTES;
    let callback = |link: BrokenLink<'_>| {
        let is_reference = link.reference.starts_with(['@', '!']);
        is_reference.then(|| (CowStr::from(link.reference.to_string()), CowStr::from("")))
    };
    let parser = Parser::new_with_broken_link_callback(&filled.text, options, Some(callback));
    let events: Vec<(Event<'_>, Range<usize>)> = parser.into_offset_iter().collect();
    let mut reader = Reader {
        events: events.into_iter().peekable(),
        filled,
        input: *input,
        id_at: 0..0,
        end_of_cut_formula: 0,
        depth: Depth::default(),
        has_title: false,
        is_in_cell: false,
        offsets: Vec::new(),
        errors: Vec::new(),
    };
    let blocks = reader.blocks().unwrap_or_default();
    if reader.errors.is_empty() && !reader.has_title {
        reader.note_error(0, fault("a report begins with its title, `# Words`"));
    }
    let is_hidden = |(_, c): &(usize, char)| c.is_control() && !['\n', '\t'].contains(c);
    if let Some((offset, c)) = filled.text.char_indices().find(is_hidden) {
        reader.note_error(offset, Error::no_latex(c));
    }
    let Reader { offsets, errors, .. } = reader;
    Part { document, blocks, errors, filled, values: input.values, offsets }
}

/// Numbers of what stands around the text that is being read.
#[derive(Clone, Copy, Default)]
struct Depth {
    lists: usize,
    quotes: usize,
    /// Emphasis and links.
    spans: usize,
    /// Those of them in which GitHub renders no formula.
    without_formulas: usize,
}

struct Reader<'a> {
    events: std::iter::Peekable<std::vec::IntoIter<(Event<'a>, Range<usize>)>>,
    filled: &'a Filled,
    input: Input<'a>,
    /// Where an id begins and ends that is no text: behind a caption, a picture or an equation.
    id_at: Range<usize>,
    /// Where a formula ends that Markdown has cut; only its first error is reported.
    end_of_cut_formula: usize,
    depth: Depth,
    has_title: bool,
    /// Whether it is a cell of a table, where a dash stands for no number.
    is_in_cell: bool,
    offsets: Vec<(Thing, String, usize)>,
    errors: Vec<Error>,
}

/// How a caption begins, as `Table: words {#tab:id}`, and the kind of its id.
const CAPTIONS: [(&str, &str); 2] = [("Table: ", "tab"), ("Listing: ", "lst")];

impl<'a> Reader<'a> {
    /// Goes on behind the next event if that begins this, and returns where it stands.
    fn begins(&mut self, begun: impl Fn(&Tag<'_>) -> bool) -> Option<Range<usize>> {
        let next = |(event, _): &(Event<'_>, _)| matches!(event, Event::Start(tag) if begun(tag));
        self.events.next_if(next).map(|(_, range)| range)
    }

    fn source(&self, range: &Range<usize>) -> &'a str {
        &self.filled.text[range.clone()]
    }

    fn note_error(&mut self, offset: usize, error: Error) {
        self.errors.push(error.with_place(self.filled.place(offset)));
    }

    /// Keeps where an id stands; refuses one that does not begin with the kind of what it names.
    fn add_id(&mut self, kind: &str, id: &str, offset: usize) -> Result<(), Error> {
        self.offsets.push((Thing::Id, id.into(), offset));
        let is_plain = |c: char| c.is_ascii_alphanumeric() || ":-_.".contains(c);
        let name = id.strip_prefix(kind).and_then(|name| name.strip_prefix(':'));
        if name.is_some_and(|name| !name.is_empty() && name.chars().all(is_plain)) {
            return Ok(());
        }
        let problem = "followed by letters, digits or any of : - _ .";
        Err(fault(format!("the id {id:?} is not valid: write {kind}: {problem}")))
    }

    /// Reads blocks up to the end of what contains them. After an error reading goes on with the
    /// next block, except in lists and quotations.
    fn blocks(&mut self) -> Result<Vec<Block>, Error> {
        let (mut blocks, within) = (Vec::new(), self.depth.lists + self.depth.quotes > 0);
        while let Some((event, Range { start, end })) = self.events.peek().cloned() {
            if matches!(event, Event::End(_)) {
                break;
            }
            let block = self.block().and_then(|block| may_stand(block, within));
            match block.map_err(|error| error.with_place(self.filled.place(start))) {
                Ok(block) => blocks.push(block),
                Err(error) if within => return Err(error),
                Err(error) => {
                    self.errors.push(error);
                    self.depth = Depth::default();
                    // Cells that Markdown adds to a row are empty and begin at its end.
                    let is_inside = |range: &Range<usize>| range.start < end || range.end <= end;
                    while self.events.next_if(|(_, range)| is_inside(range)).is_some() {}
                }
            }
        }
        Ok(blocks)
    }

    /// Reads blocks that stand within one more list or quotation.
    fn inner(&mut self, depth: Depth) -> Result<Vec<Block>, Error> {
        if depth.lists > 4 || depth.lists + depth.quotes > 6 {
            let problem = "lists stand at most four deep in LaTeX, and with quotations six deep";
            return Err(fault(problem));
        }
        let outer = std::mem::replace(&mut self.depth, depth);
        let blocks = self.blocks()?;
        self.depth = outer;
        Ok(blocks)
    }

    fn block(&mut self) -> Result<Block, Error> {
        let begins = |event: &Event<'_>| matches!(event, Event::Start(tag) if is_block(tag));
        let begun = self.events.next_if(|(event, _)| begins(event));
        let Some((Event::Start(tag), range)) = begun else {
            // Text right inside an item of a tight list.
            let range = self.events.peek().map_or(0..0, |(_, range)| range.clone());
            return self.paragraph(range);
        };
        let block = match tag {
            Tag::Paragraph => {
                let block = self.paragraph(range);
                // A caption has gone on with what it belongs to.
                self.events.next_if(|(event, _)| matches!(event, Event::End(TagEnd::Paragraph)));
                return block;
            }
            Tag::Heading { level, id, classes, attrs } => {
                let level = level as u8;
                let unnumbered = classes.iter().any(|class| &**class == "unnumbered");
                if !attrs.is_empty() || classes.len() > usize::from(unnumbered) {
                    return Err(fault("a heading may be followed by {#sec:id .unnumbered} only"));
                }
                let id = id.map(|id| id.to_string());
                id.iter().try_for_each(|id| self.add_id("sec", id, range.start))?;
                if level > 3 || level == 1 && std::mem::replace(&mut self.has_title, true) {
                    return Err(fault("a document has one title (#) and sections with ## and ###"));
                }
                let text = self.inlines_in_line()?;
                let leads = |inline: &Inline| {
                    matches!(inline, Inline::Link { .. } | Inline::Unresolved { .. })
                };
                if text.is_empty() || text.iter().any(leads) {
                    return Err(fault("a heading needs words, and may have no link or reference"));
                }
                let bare = unnumbered || level == 1 || to_plain_text(&text) == "Abstract";
                let number = (!bare).then(String::new);
                Block::Heading { level, number, id, text }
            }
            Tag::BlockQuote(_) => {
                Block::Quote(self.inner(Depth { quotes: self.depth.quotes + 1, ..self.depth })?)
            }
            Tag::List(start) => {
                let mut items = Vec::new();
                while self.begins(|tag| *tag == Tag::Item).is_some() {
                    items.push(self.inner(Depth { lists: self.depth.lists + 1, ..self.depth })?);
                    self.events.next();
                }
                Block::List { start, items }
            }
            Tag::CodeBlock(kind) => self.code(kind, &range)?,
            Tag::Table(columns) => self.table(columns)?,
            _ => return Err(fault(UNSUPPORTED_MARKUP)),
        };
        self.events.next();
        Ok(block)
    }

    fn paragraph(&mut self, range: Range<usize>) -> Result<Block, Error> {
        let source = self.source(&range).trim_end();
        let with_id = source.strip_suffix('}').and_then(|source| source.rsplit_once("{#"));
        let id_at = with_id.map_or(0..0, |(words, _)| range.start + words.len()..range.end);
        let id = with_id.map(|(_, id)| id.to_string());
        if let Some((Event::Start(Tag::Image { dest_url, .. }), _)) = self.events.peek() {
            let path = dest_url.to_string();
            self.events.next();
            self.id_at = id_at;
            return self.figure(&path, range.start, id);
        }
        let caption = CAPTIONS.iter().find(|(word, _)| source.starts_with(word));
        self.id_at = if caption.is_some() { id_at } else { 0..0 };
        let mut inlines = self.inlines()?;
        if let Some((word, kind)) = caption {
            id.iter().try_for_each(|id| self.add_id(kind, id, range.start))?;
            if let Some(Inline::Text(last)) = inlines.last_mut() {
                last.truncate(last.trim_end().len());
            }
            self.events.next_if(|(event, _)| matches!(event, Event::End(TagEnd::Paragraph)));
            let Some(Inline::Text(first)) = inlines.first_mut() else {
                return Err(fault(UNSUPPORTED_MARKUP));
            };
            *first = first.trim_start_matches(word).to_string();
            let problem = "a caption must be followed by its table, or have an id {#lst:…} and be followed by its code";
            let mut block = self.block()?;
            match (&mut block, id) {
                (Block::Table(table), id) if *kind == "tab" => {
                    (table.id, table.number, table.caption) = (id, Some(String::new()), inlines);
                }
                (Block::Listing { id: listing_id, caption, .. }, Some(id)) if *kind == "lst" => {
                    (*listing_id, *caption) = (id, inlines);
                }
                _ => return Err(fault(problem)),
            }
            return Ok(block);
        }
        if matches!(&inlines[..], [Inline::Unresolved { ids, .. }] if *ids == ["bibliography"]) {
            return Ok(Block::Bibliography(Vec::new()));
        }
        if let Some(Inline::Text(first)) = inlines.first_mut()
            && let Some((lab, words)) =
                first.strip_prefix("Lab ").and_then(|rest| rest.split_once(": "))
        {
            let (lab, words) = (lab.to_string(), words.to_string());
            *first = words;
            return Ok(Block::Lab { lab, caption: inlines });
        }
        Ok(Block::Paragraph(inlines))
    }

    /// Reads a figure, which stands alone in its paragraph, followed by its id; without one the id
    /// of `figures/NAME.svg` is `fig:NAME`. The id may give the number, as `fig:S1` does.
    fn figure(&mut self, path: &str, at: usize, id: Option<String>) -> Result<Block, Error> {
        let caption = self.inlines_in_line()?;
        self.events.next();
        let behind = self.inlines()?;
        if !to_plain_text(&behind).trim().is_empty() {
            return Err(fault(FIGURE_NOT_ALONE));
        }
        let Input { figures, project, .. } = self.input;
        let paths: Vec<String> =
            figures.iter().map(|figure| format!("figures/{}", figure.names()[0])).collect();
        let Some(index) = paths.iter().position(|known| known == path) else {
            let problem = format!(
                "there is no figure {}; use figures/NAME.svg of a figure of the paper; a file becomes one by Figure::picture",
                one_line(path, 200)
            );
            let paths = paths.iter().map(String::as_str);
            return Err(Error::unknown(Thing::Link, path, &problem, paths));
        };
        let figure = &figures[index];
        let (name, files, alt) =
            (figure.id.clone(), figure.names(), figure.description.text.clone());
        let data: Vec<String> =
            figure.data.iter().map(|file| format!("data/{}", file.name)).collect();
        let code = project.sources.file(&figure.source).map(|file| format!("../{file}"));
        let mut origin = Vec::new();
        for (name, files) in [("Data: ", data), ("Code: ", code.into_iter().collect())] {
            if !files.is_empty() {
                let blank = if origin.is_empty() { "" } else { " " };
                origin.push(Inline::Text(format!("{blank}{name}")));
                origin.extend(links(&files));
                origin.push(Inline::Text(".".into()));
            }
        }
        let id = id.unwrap_or_else(|| format!("fig:{name}"));
        self.add_id("fig", &id, at)?;
        let given = id.trim_start_matches("fig:");
        let digits = given.trim_start_matches(|c: char| c.is_ascii_uppercase());
        let number = if digits.parse::<u32>().is_ok() { given.into() } else { String::new() };
        Ok(Block::Figure { id, number, name, files, alt, origin, caption })
    }

    fn code(&mut self, kind: CodeBlockKind<'_>, range: &Range<usize>) -> Result<Block, Error> {
        let opened = self.source(range).find('\n').unwrap_or(range.len());
        let (mut code, mut end) = (String::new(), range.start + opened);
        while let Some((Event::Text(piece), piece_at)) = self.events.peek() {
            code.push_str(piece);
            end = piece_at.end;
            self.events.next();
        }
        // Behind the code stands nothing but its fence.
        let closed = self.source(&(end..range.end)).contains(['`', '~']);
        let CodeBlockKind::Fenced(language) = kind else { return Err(fault(FENCE)) };
        match language.split_once(' ') {
            _ if !closed => Err(fault(FENCE)),
            Some((_, item)) => {
                let listing = self.input.project.sources.listing(item).map_err(fault)?;
                let (id, number, caption) = (String::new(), String::new(), Vec::new());
                let file = self.input.project.sources.file(item).unwrap_or_default().to_string();
                let (item, code) = (item.to_string(), listing);
                let words = |words: &str| Inline::Text(words.into());
                let link = Inline::Link { to: format!("../{file}"), words: vec![words(&file)] };
                let origin = vec![words("From "), link, words(".")];
                Ok(Block::Listing { id, number, caption, item, file, origin, code })
            }
            None => Ok(Block::Code {
                language: self.to_plain_text(&language)?,
                code: self.to_plain_text(&code)?,
            }),
        }
    }

    fn table(&mut self, columns: Vec<Alignment>) -> Result<Block, Error> {
        let mut rows = Vec::new();
        let is_row = |tag: &Tag<'_>| matches!(tag, Tag::TableHead | Tag::TableRow);
        while let Some(range) = self.begins(is_row) {
            let (count, expected) = (cells_of(self.source(&range)), columns.len());
            if count != expected {
                let remedy = "write all of them, also empty ones, and a bar within one as \\|";
                let problem = format!("a row has {count} of {expected} cells; {remedy}");
                return Err(fault(problem).with_place(self.filled.place(range.start)));
            }
            let mut cells = Vec::new();
            while self.begins(|tag| *tag == Tag::TableCell).is_some() {
                self.is_in_cell = true;
                cells.push(self.inlines_in_line()?);
                self.is_in_cell = false;
                self.events.next();
            }
            self.events.next();
            rows.push(cells);
        }
        let head = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
        let table = Table { columns, head, rows, ..Table::default() };
        if latex::line_of(&table).is_none() {
            let problem = "columns do not fit on a page of LaTeX, on its side and in small letters";
            return Err(fault(format!("its {} {problem}; leave some out", table.columns.len())));
        }
        Ok(Block::Table(table))
    }
}

const UNSUPPORTED_MARKUP: &str = "this markup is not supported by every format";
const FIGURE_NOT_ALONE: &str = "a figure must stand alone in its paragraph";
const FENCE: &str = "a block of code must stand between two lines ```";

fn cells_of(row: &str) -> usize {
    let row = row.trim();
    let row = row.strip_prefix('|').unwrap_or(row);
    let row = row.strip_suffix('|').filter(|rest| !rest.ends_with('\\')).unwrap_or(row);
    row.matches('|').count() - row.matches(r"\|").count() + 1
}

/// Refuses a listing without a caption, and in lists and quotations what has a number.
fn may_stand(block: Block, within: bool) -> Result<Block, Error> {
    match &block {
        Block::Listing { id, item, .. } if id.is_empty() => Err(fault(format!(
            "the listing of `{item}` needs a paragraph `Listing: caption {{#lst:id}}` right before it"
        ))),
        Block::Paragraph(_) | Block::List { .. } | Block::Quote(_) | Block::Code { .. } => {
            Ok(block)
        }
        Block::Table(Table { number: None, .. }) => Ok(block),
        _ if within => Err(fault(
            "a heading, figure, listing or captioned table cannot stand in a list or quotation",
        )),
        _ => Ok(block),
    }
}

fn is_block(tag: &Tag<'_>) -> bool {
    !matches!(tag, Tag::Emphasis | Tag::Strong | Tag::Link { .. } | Tag::Image { .. })
}
