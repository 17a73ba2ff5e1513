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
//! - `Scene: caption`, a paragraph: the moving masses, where a format can show them, else nothing.
//! - `[!claim:id]`: a place that can be referred to; it shows its number.
//! - `[@eq:18]`, `[@fig:2; @fig:3]`, `[@sec:id]`, `[@tab:id]`, `[@lst:id]`, `[@claim:id]`: references, written
//!   out as "Eq. (18)" and so on; with a capital, as `[@Fig:2]`, in full as at the start of a sentence.
//! - `[@rice1945]`: a citation of `references.bib`.
//! - `[@bibliography]` alone in a paragraph: the list of what was cited.

use super::card::words_and_maths;
use super::document::{Align, Block, Inline};
use super::mark::Mark;
use super::print::print;
use super::valued::framed;
use super::values::Registry;
use super::{Error, literate};
use pulldown_cmark::{Alignment, BrokenLink, CowStr, Event, LinkType, Options, Parser, Tag};

/// Parses filled Markdown; `values` turn marks into what is shown.
///
/// # Errors
/// Markup that the report does not have, with the text near it.
pub fn parse(text: &str, values: &Registry) -> Result<Vec<Block>, Error> {
    let options =
        Options::ENABLE_MATH | Options::ENABLE_TABLES | Options::ENABLE_HEADING_ATTRIBUTES;
    let callback = |link: BrokenLink<'_>| {
        let own = link.reference.starts_with('@') || link.reference.starts_with('!');
        own.then(|| (CowStr::from(link.reference.to_string()), CowStr::from("")))
    };
    let parser = Parser::new_with_broken_link_callback(text, options, Some(callback));
    let events: Vec<Event<'_>> = parser.collect();
    shallow(&events)?;
    let mut reader = Reader { events: events.into_iter().peekable(), values };
    let mut blocks = reader.blocks()?;
    captions(&mut blocks)?;
    Ok(blocks)
}

/// Lists, quotations and spans within each other, at most: what reads and writes them calls itself.
const DEEPEST: usize = 40;

/// Refuses what is nested deeper than any prose.
fn shallow(events: &[Event<'_>]) -> Result<(), Error> {
    let mut depth: usize = 0;
    for event in events {
        match event {
            Event::Start(_) => depth += 1,
            Event::End(_) => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(Error::Markup(format!("more than {DEEPEST} levels within each other")));
        }
    }
    Ok(())
}

struct Reader<'a> {
    events: std::iter::Peekable<std::vec::IntoIter<Event<'a>>>,
    values: &'a Registry,
}

impl Reader<'_> {
    /// Blocks up to the end of what contains them.
    fn blocks(&mut self) -> Result<Vec<Block>, Error> {
        let mut blocks = Vec::new();
        while let Some(event) = self.events.peek() {
            match event {
                Event::End(_) => break,
                Event::Start(tag) if is_block(tag) => {
                    if let Some(Event::Start(tag)) = self.events.next() {
                        blocks.extend(self.block(tag)?);
                    }
                }
                Event::Rule => {
                    self.events.next();
                }
                Event::Html(html) => return Err(Error::Markup(html.to_string())),
                // Text right inside an item of a tight list.
                _ => blocks.push(Block::Paragraph(self.inlines()?)),
            }
        }
        Ok(blocks)
    }

    fn block(&mut self, tag: Tag<'_>) -> Result<Option<Block>, Error> {
        let block = match tag {
            Tag::Paragraph => paragraph(self.inlines()?)?,
            Tag::Heading { level, id, classes, .. } => {
                let unnumbered = classes.iter().any(|class| &**class == "unnumbered");
                let number = (!unnumbered && level as u8 > 1).then(String::new);
                let text = self.inlines()?;
                Block::Heading { level: level as u8, number, id: id.map(|i| i.to_string()), text }
            }
            Tag::BlockQuote(_) => Block::Quote(self.blocks()?),
            Tag::List(start) => {
                let mut items = Vec::new();
                while let Some(Event::Start(Tag::Item)) = self.events.peek() {
                    self.events.next();
                    items.push(self.blocks()?);
                    self.events.next();
                }
                Block::List { start, items }
            }
            Tag::CodeBlock(kind) => {
                let language = match kind {
                    pulldown_cmark::CodeBlockKind::Fenced(language) => language.to_string(),
                    pulldown_cmark::CodeBlockKind::Indented => String::new(),
                };
                let mut text = String::new();
                while let Some(Event::Text(piece)) = self.events.peek() {
                    text.push_str(piece);
                    self.events.next();
                }
                match language.split_once(' ') {
                    Some((_, item)) => listing(item)?,
                    None => Block::Code { language, text: self.written(&text)? },
                }
            }
            Tag::Table(columns) => self.table(&columns)?,
            Tag::HtmlBlock => {
                // Comments are for writers; other HTML has no place in four formats.
                let mut html = String::new();
                while let Some(Event::Html(piece)) = self.events.peek() {
                    html.push_str(piece);
                    self.events.next();
                }
                if !html.trim_start().starts_with("<!--") {
                    return Err(Error::Markup(html));
                }
                self.events.next();
                return Ok(None);
            }
            other => return Err(Error::Markup(format!("{other:?}"))),
        };
        self.events.next();
        Ok(Some(block))
    }

    fn table(&mut self, columns: &[Alignment]) -> Result<Block, Error> {
        let columns = columns
            .iter()
            .map(|column| match column {
                Alignment::Right => Align::Right,
                Alignment::Center => Align::Centre,
                Alignment::Left | Alignment::None => Align::Left,
            })
            .collect();
        let mut rows = Vec::new();
        while let Some(Event::Start(Tag::TableHead | Tag::TableRow)) = self.events.peek() {
            self.events.next();
            let mut cells = Vec::new();
            while let Some(Event::Start(Tag::TableCell)) = self.events.peek() {
                self.events.next();
                cells.push(self.inlines()?);
                self.events.next();
            }
            self.events.next();
            rows.push(cells);
        }
        let head = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
        Ok(Block::Table { id: None, number: None, caption: Vec::new(), columns, head, rows })
    }

    /// Running text up to the end of what contains it, or the next block.
    fn inlines(&mut self) -> Result<Vec<Inline>, Error> {
        let mut out = Vec::new();
        while let Some(event) = self.events.peek() {
            match event {
                Event::End(_) => break,
                Event::Start(tag) if is_block(tag) => break,
                _ => {}
            }
            let Some(event) = self.events.next() else { break };
            match event {
                Event::Text(text) => self.text(&text, &mut out)?,
                Event::Code(text) => out.push(Inline::Code(self.written(&text)?)),
                Event::InlineMath(tex) => out.push(Inline::Maths(self.maths(&tex)?)),
                Event::DisplayMath(tex) => out.push(display(&self.maths(&tex)?)?),
                Event::SoftBreak => out.push(Inline::Soft),
                Event::HardBreak => out.push(Inline::Break),
                Event::InlineHtml(html) if html.starts_with("<!--") => {}
                Event::Start(tag) => out.push(self.span(tag)?),
                other => return Err(Error::Markup(format!("{other:?}"))),
            }
        }
        Ok(out)
    }

    fn span(&mut self, tag: Tag<'_>) -> Result<Inline, Error> {
        let inner = self.inlines()?;
        self.events.next();
        Ok(match tag {
            Tag::Emphasis => Inline::Emphasis(inner),
            Tag::Strong => Inline::Strong(inner),
            Tag::Link { link_type: LinkType::ShortcutUnknown, dest_url, .. } => {
                own_link(&dest_url)?
            }
            Tag::Link { dest_url, .. } => {
                Inline::Link { to: self.written(&dest_url)?, shown: inner }
            }
            // Becomes a figure if it stands alone in its paragraph, else an error there.
            Tag::Image { dest_url, .. } => {
                Inline::Link { to: format!("{IMAGE}{dest_url}"), shown: inner }
            }
            other => return Err(Error::Markup(format!("{other:?}"))),
        })
    }

    /// Text with marks → words and values.
    fn text(&self, text: &str, out: &mut Vec<Inline>) -> Result<(), Error> {
        for piece in Mark::split(text) {
            match piece {
                Err(words) => match out.last_mut() {
                    Some(Inline::Text(before)) => before.push_str(words),
                    _ => out.push(Inline::Text(words.to_string())),
                },
                Ok(mark) => {
                    let shown = words_and_maths(&self.shown(&mark, Target::Prose)?);
                    out.push(Inline::Value { id: mark.id, shown });
                }
            }
        }
        Ok(())
    }

    fn maths(&self, tex: &str) -> Result<String, Error> {
        self.replaced(tex, Target::Maths)
    }

    fn written(&self, text: &str) -> Result<String, Error> {
        self.replaced(text, Target::Plain)
    }

    fn replaced(&self, text: &str, target: Target) -> Result<String, Error> {
        let one = |piece| match piece {
            Ok(mark) => self.shown(&mark, target),
            Err(text) => Ok(str::to_string(text)),
        };
        Mark::split(text).into_iter().map(one).collect()
    }

    fn shown(&self, mark: &Mark, target: Target) -> Result<String, Error> {
        let unknown = || Error::Template(format!("there is no value {}", mark.id));
        let value = self.values.get(&mark.id).ok_or_else(unknown)?;
        let printed = print(&value.number, mark.style);
        let unit = if mark.style.with_unit { value.unit.as_str() } else { "" };
        Ok(match (target, unit) {
            (Target::Prose, "") => printed.markdown(),
            (Target::Prose, unit) => format!("{}\u{a0}{unit}", printed.markdown()),
            (Target::Maths, "") => framed(&mark.id, &printed.maths()),
            (Target::Maths, unit) => {
                format!(r"{}\,{}", framed(&mark.id, &printed.maths()), unit.trim_matches('$'))
            }
            (Target::Plain, "") => printed.plain(),
            (Target::Plain, unit) => format!("{} {unit}", printed.plain()),
        })
    }
}

#[derive(Clone, Copy)]
enum Target {
    Prose,
    Maths,
    Plain,
}

const IMAGE: &str = "image:";

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

/// Cuts `\tag{18}` out of an equation.
fn display(tex: &str) -> Result<Inline, Error> {
    let Some((before, after)) = tex.split_once(r"\tag{") else {
        return Ok(Inline::Display { tex: tex.trim().to_string(), tag: None });
    };
    let (tag, after) = after.split_once('}').ok_or_else(|| Error::Markup(tex.to_string()))?;
    let tex = format!("{}{}", before.trim(), after.trim_end());
    Ok(Inline::Display { tex: tex.trim().to_string(), tag: Some(tag.to_string()) })
}

/// `@fig:2; @fig:3` or `!claim:rise`.
fn own_link(reference: &str) -> Result<Inline, Error> {
    if let Some(id) = reference.strip_prefix('!') {
        return Ok(Inline::Anchor { id: id.to_string(), number: String::new() });
    }
    let one = |id: &str| {
        let id = id.trim().strip_prefix('@').map(str::to_string);
        id.ok_or_else(|| Error::Reference(reference.to_string()))
    };
    reference.split(';').map(one).collect::<Result<_, _>>().map(Inline::Unresolved)
}

/// A paragraph, or the figure or the list of references that stands alone in it.
fn paragraph(mut inlines: Vec<Inline>) -> Result<Block, Error> {
    if let [Inline::Unresolved(ids)] = inlines.as_slice()
        && ids == &["bibliography"]
    {
        return Ok(Block::Bibliography(Vec::new()));
    }
    if let Some(Inline::Text(first)) = inlines.first_mut()
        && let Some(words) = first.strip_prefix("Scene: ")
    {
        *first = words.to_string();
        return Ok(Block::Scene { caption: inlines });
    }
    let image =
        |inline: &Inline| matches!(inline, Inline::Link { to, .. } if to.starts_with(IMAGE));
    if inlines.iter().any(image) {
        let (Some(Inline::Link { to, shown }), true) = (inlines.pop(), inlines.is_empty()) else {
            return Err(Error::Markup("a picture stands alone in its paragraph".into()));
        };
        let path = to.trim_start_matches(IMAGE).to_string();
        let number = number_of_figure(&path);
        let id = format!("fig:{number}");
        let (alt, data, experiments) = (String::new(), Vec::new(), Vec::new());
        return Ok(Block::Figure { id, number, path, alt, data, experiments, caption: shown });
    }
    Ok(Block::Paragraph(inlines))
}

/// figures/fig03.svg → 3, figures/s01.svg → S1.
fn number_of_figure(path: &str) -> String {
    let stem = path.rsplit('/').next().unwrap_or(path);
    let stem = stem.split('.').next().unwrap_or(stem);
    let digits = stem.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let prefix = &stem[..stem.len() - digits.len()];
    let digits = digits.trim_start_matches('0');
    if prefix == "fig" { digits.to_string() } else { format!("{}{digits}", prefix.to_uppercase()) }
}

/// The listing of an item; its caption stands before it.
fn listing(path: &str) -> Result<Block, Error> {
    let found = literate::item(path).map_err(Error::Markup)?;
    Ok(Block::Listing {
        id: String::new(),
        number: String::new(),
        caption: Vec::new(),
        item: path.to_string(),
        file: found.file.to_string(),
        text: found.text,
    })
}

/// Joins `Table: …` and `Listing: …` paragraphs to what stands behind them.
fn captions(blocks: &mut Vec<Block>) -> Result<(), Error> {
    let mut out: Vec<Block> = Vec::with_capacity(blocks.len());
    for mut block in std::mem::take(blocks) {
        match &mut block {
            Block::Table { id, number, caption, .. } => {
                if let Some((words, attribute)) = caption_before(&mut out, "Table: ") {
                    (*caption, *id) = (words, attribute);
                    *number = Some(String::new());
                }
            }
            Block::Listing { id, caption, item, .. } => {
                let Some((words, Some(attribute))) = caption_before(&mut out, "Listing: ") else {
                    return Err(Error::Markup(format!(
                        "code of `{item}` without the paragraph `Listing: caption {{#lst:id}}` before it"
                    )));
                };
                (*caption, *id) = (words, attribute);
            }
            _ => {}
        }
        out.push(block);
    }
    *blocks = out;
    Ok(())
}

/// Takes the last block if it is a paragraph that begins so: its words and its `{#id}`.
fn caption_before(blocks: &mut Vec<Block>, opening: &str) -> Option<(Vec<Inline>, Option<String>)> {
    let Some(Block::Paragraph(words)) = blocks.last_mut() else { return None };
    let Some(Inline::Text(first)) = words.first_mut() else { return None };
    *first = first.strip_prefix(opening)?.to_string();
    let mut id = None;
    if let Some(Inline::Text(last)) = words.last_mut()
        && let Some((before, attribute)) = last.trim_end().rsplit_once("{#")
    {
        id = Some(attribute.trim_end_matches('}').to_string());
        *last = before.trim_end().to_string();
    }
    let words = std::mem::take(words);
    blocks.pop();
    Some((words, id))
}
