//! Writes the tree as a page in HTML; what surrounds it is the template report.html.
//!
//! Style sheet, script, fonts and cards lie in the folder of the page, which can be opened from a
//! disk. A page is well-formed XML, so that tests can read it.

pub(super) mod shared;
mod table;

use super::document::{self, Block, Formula, Inline, Reference};
use super::document::{heading_place, place_on_page, to_spelt_text};
use super::error::Error;
use super::filled::Part;
use super::input::Input;
use super::{latex, mathml};
use crate::claims::Verdict;
use crate::figures::{Glyphs, escape, outlines};
use crate::print::{Numeral, Printed};
use math_core::MathDisplay;
use serde_json::{Value as Json, json};
use std::cell::RefCell;
use std::collections::BTreeSet;

/// Returns what report.html inserts, the ids of the cards that the page opens, and errors.
pub fn write(part: &Part<'_>, input: &Input<'_>) -> (Json, BTreeSet<String>, Vec<Error>) {
    let Part { document: here, blocks, .. } = part;
    let (page, edition, sources) = (Page::new(input), input.edition, &input.project.sources);
    let title = document::title(blocks).unwrap_or_default();
    let (heading, body) = (page.inlines(title), page.blocks(blocks));
    let (mut sections, mut figures) = (Vec::new(), Vec::new());
    for block in blocks {
        match block {
            Block::Heading { level: level @ 2.., number, id, text } => sections.push([
                heading_place(id.as_deref(), number.as_deref(), text),
                number.clone().unwrap_or_default(),
                page.inlines(text),
                level.to_string(),
            ]),
            // What is shown again has its place elsewhere.
            Block::Figure { id, number, name, .. } if !here.repeats => {
                let name =
                    input.figure(name).map_or(String::new(), |figure| escaped(&figure.title));
                figures.push([place_on_page(id), number.clone(), name]);
            }
            _ => (),
        }
    }
    let year = edition.date.split('-').next().unwrap_or_default();
    let key = format!("{}{year}{}", sources.name, here.prose);
    let key: String = key.chars().filter(char::is_ascii_alphanumeric).collect();
    let documents = edition.documents.iter().map(|of| (of.page, escaped(of.name)));
    // Its first words, for those who have only a link to it.
    let description = blocks.iter().find_map(|block| match block {
        Block::Paragraph(text) => Some(to_spelt_text(text)),
        _ => None,
    });
    let link = |(name, to): &(&str, &str)| {
        let link = Inline::Link { to: to.to_string(), words: vec![Inline::Text(name.to_string())] };
        page.inlines(&document::relative_link(link, input.top))
    };
    let parts = json!({
        "file": here.page,
        "markdown": here.markdown,
        "name": escaped(sources.name),
        "version": escaped(sources.version),
        "license": escaped(edition.license),
        "description": escaped(&description.unwrap_or_default()),
        "picture": edition.cover,
        "links": edition.links.iter().map(link).collect::<Vec<_>>(),
        "date": escaped(edition.date),
        "authors": edition.authors.iter().map(|(name, _)| escaped(name)).collect::<Vec<_>>(),
        "documents": documents.collect::<Vec<_>>(),
        "title": escaped(&to_spelt_text(title)),
        "key": key,
        "address": escaped(edition.address),
        "doi": escaped(edition.doi),
        "bibtex": [escaped(&edition.bibtex_authors()), escaped(&latex::inlines(title))],
        "heading": heading,
        "byline": escaped(&edition.byline(*here)),
        "sections": sections,
        "figures": figures,
        "body": body,
        "glyphs": outlines(&page.glyphs.borrow()),
    });
    (parts, page.cards.into_inner(), page.errors.into_inner())
}

const OPENING: [char; 4] = ['(', '[', '“', '‘'];
const CLOSING: [char; 12] = ['.', ',', ';', ':', '!', '?', ')', ']', '”', '’', '%', '-'];

pub(super) struct Page<'a> {
    input: &'a Input<'a>,
    cards: RefCell<BTreeSet<String>>,
    glyphs: RefCell<Glyphs>,
    errors: RefCell<Vec<Error>>,
}

impl<'a> Page<'a> {
    fn new(input: &'a Input<'a>) -> Self {
        let (cards, glyphs, errors) = Default::default();
        Page { input, cards, glyphs, errors }
    }

    fn blocks(&self, blocks: &[Block]) -> String {
        let (mut html, mut end) = (String::new(), "");
        for block in blocks {
            if matches!(block, Block::Heading { .. } | Block::Figure { .. }) {
                html += std::mem::take(&mut end);
            }
            if document::is_abstract(block) {
                (html, end) = (html + "<section class=\"abstract\">\n", "</section>\n");
            }
            html += &self.block(block);
        }
        html + end
    }

    fn block(&self, block: &Block) -> String {
        match block {
            // The template has the title.
            Block::Heading { level: 1, .. } => String::new(),
            Block::Heading { level, number, id, text } => {
                let id = heading_place(id.as_deref(), number.as_deref(), text);
                let number = number.as_ref().map(|n| format!("<span class=\"number\">{n}</span> "));
                let words = number.unwrap_or_default() + &self.inlines(text);
                format!("<h{level} id=\"{id}\"><a href=\"#{id}\">{words}</a></h{level}>\n")
            }
            Block::Paragraph(text) => self.paragraph(text),
            Block::Figure { id, number, name, files: [file, _], origin, caption, .. } => {
                let picture = self.input.figure(name).map_or(String::new(), |figure| {
                    self.glyphs.borrow_mut().extend(figure.drawing.glyphs.clone());
                    figure.on_page()
                });
                format!(
                    "<figure id=\"{}\">{}<figcaption><strong>Figure {number}.</strong> {} <span class=\"origin\">\
                     Picture: <a href=\"figures/{file}\">{file}</a>. {}</span></figcaption></figure>\n",
                    place_on_page(id),
                    scrollable(&format!("Figure {number}"), &picture),
                    self.inlines(caption),
                    self.inlines(origin)
                )
            }
            Block::Lab { .. } if self.input.lab.is_none() => String::new(),
            Block::Lab { lab, caption } => format!(
                "<figure class=\"lab\" id=\"lab-{lab}\" data-lab=\"{lab}\" hidden=\"\"><div class=\"controls\">\
                 <button type=\"button\">Run it here</button><span role=\"status\"></span></div>\
                 <figcaption><strong>Live.</strong> {}</figcaption></figure>\n",
                self.inlines(caption)
            ),
            Block::Table(table) => {
                let id = table.id.as_ref().map(|id| format!(" id=\"{}\"", place_on_page(id)));
                let mut html = format!("<figure class=\"table\"{}>", id.unwrap_or_default());
                let mut name = String::from("Table");
                if let Some(number) = &table.number {
                    name += &format!(" {number}");
                    let caption = self.inlines(&table.caption);
                    html += &format!("<figcaption><strong>{name}.</strong> {caption}</figcaption>");
                }
                html + &scrollable(&name, &self.table(table)) + "</figure>\n"
            }
            Block::List { start, items } => {
                let item = |item: &Vec<Block>| {
                    // One paragraph stands without `<p>`.
                    let words = match item.as_slice() {
                        [Block::Paragraph(text)] => self.inlines(text),
                        blocks => self.blocks(blocks),
                    };
                    format!("<li>{words}</li>\n")
                };
                let items: String = items.iter().map(item).collect();
                match start {
                    Some(n) => format!("<ol start=\"{n}\">\n{items}</ol>\n"),
                    None => format!("<ul>\n{items}</ul>\n"),
                }
            }
            Block::Quote(blocks) => {
                format!("<blockquote>\n{}</blockquote>\n", self.blocks(blocks))
            }
            Block::Code { code, .. } => code_to_html(code),
            Block::Listing { id, number, caption, item, origin, code, .. } => format!(
                "<div class=\"listing\" id=\"{}\"><p><strong>Listing {number}.</strong> {}</p>\n<details><summary>{}\
                 </summary>\n{}<p class=\"origin\">{}</p></details></div>\n",
                place_on_page(id),
                self.inlines(caption),
                self.inline(&Inline::Code(item.clone())),
                code_to_html(code),
                self.inlines(origin)
            ),
            Block::Bibliography(entries) => {
                let entry = |entry: &Reference| {
                    let id = place_on_page(&format!("ref:{}", entry.key));
                    format!("<li id=\"{id}\">{}</li>\n", self.inlines(&entry.to_inlines()))
                };
                let entries: String = entries.iter().map(entry).collect();
                format!("<ul class=\"references\">\n{entries}</ul>\n")
            }
        }
    }

    /// Writes a paragraph. No equation can stand inside a `<p>`: the sentence goes on in the next.
    fn paragraph(&self, text: &[Inline]) -> String {
        let mut html = String::new();
        let is_display = |inline: &Inline| matches!(inline, Inline::Display { .. });
        for (i, words) in text.split(is_display).enumerate() {
            let equation = text.iter().filter(|inline| is_display(inline)).nth(i);
            let words = self.inlines(words);
            if !words.trim().is_empty() {
                let class = if i > 0 { " class=\"on\"" } else { "" };
                html += &format!("<p{class}>{}</p>\n", words.trim());
            }
            html += &equation.map_or(String::new(), |equation| self.inline(equation));
        }
        html
    }

    /// Writes running text. Browsers break lines around a formula, but for what is kept with it.
    fn inlines(&self, list: &[Inline]) -> String {
        // Pieces, and whether each stays with the one before.
        let mut pieces: Vec<(String, bool)> = Vec::new();
        for (i, piece) in list.iter().enumerate() {
            let before = i.checked_sub(1).and_then(|before| list.get(before));
            let after_maths = matches!(before, Some(Inline::Maths(_)));
            match piece {
                // `$x =$ 3`.
                Inline::Text(words) if words == " " && before.is_some_and(ends_in_relation) => {
                    pieces.push(("\u{a0}".into(), true));
                }
                Inline::Text(words) => {
                    let rest = if after_maths { words.trim_start_matches(CLOSING) } else { words };
                    let (closing, rest) = words.split_at(words.len() - rest.len());
                    let (rest, opening) = rest.split_at(rest.trim_end_matches(OPENING).len());
                    let parts = [(closing, true), (rest, false), (opening, false)];
                    let parts = parts.into_iter().filter(|(words, _)| !words.is_empty());
                    pieces.extend(parts.map(|(words, stays)| (escaped(words), stays)));
                }
                piece => {
                    let last = pieces.last().map_or("", |(html, _)| html);
                    let opens = last.ends_with(OPENING) || last == "\u{a0}";
                    let stays = match piece {
                        Inline::Maths(_) => opens || matches!(before, Some(Inline::Value { .. })),
                        Inline::Value { .. } => opens || after_maths,
                        _ => false,
                    };
                    pieces.push((self.inline(piece), stays));
                }
            }
        }
        let together = pieces.chunk_by(|_, (_, stays)| *stays);
        let group = |group: &[(String, bool)]| match group {
            [(html, _)] => html.clone(),
            several => {
                let several: String = several.iter().map(|(html, _)| html.as_str()).collect();
                format!("<span class=\"keep\">{several}</span>")
            }
        };
        together.map(group).collect()
    }

    fn inline(&self, inline: &Inline) -> String {
        match inline {
            Inline::Text(words) => escaped(words),
            Inline::Soft => "\n".into(),
            // Long paths may break at their joints.
            Inline::Code(code) => {
                let code = escaped(code).replace('/', "/\0").replace("::", "::\0");
                let code = code.replace(',', ",\0").replace('[', "\0[");
                format!("<code>{}</code>", code.replace('\0', "<wbr/>"))
            }
            Inline::Emphasis(inner) => format!("<em>{}</em>", self.inlines(inner)),
            Inline::Raised(inner) => format!("<sup>{}</sup>", self.inlines(inner)),
            Inline::Strong(inner) => format!("<strong>{}</strong>", self.inlines(inner)),
            Inline::Maths(formula) => self.formula(formula, MathDisplay::Inline),
            Inline::Display { formula, id, number } => {
                let formula = self.formula(formula, MathDisplay::Block);
                let Some(id) = id.as_deref().map(place_on_page) else {
                    let formula = scrollable("Equation without number", &formula);
                    return format!("<div class=\"equation\">{formula}</div>\n");
                };
                let formula = scrollable(&format!("Equation {number}"), &formula);
                // An equation of the ledger opens its card, which has the line of its code.
                let mut equations = self.input.edition.equations.iter();
                let is_listed = equations.any(|of| id == format!("eq-{}", of.number));
                let card =
                    if is_listed { self.card(&format!("eq:{number}")) } else { String::new() };
                let tag = format!("<a class=\"number\" href=\"#{id}\"{card}>({number})</a>");
                format!("<div class=\"equation\" id=\"{id}\">{formula}{tag}</div>\n")
            }
            Inline::Value { id, printed } => self.value(id, printed, '\u{a0}'),
            Inline::Link { to, words } => {
                // A document is another file here, and a host shows no folder.
                let of = self.input.edition.documents.iter().find(|of| of.markdown == to);
                let folder = (to == "data").then_some("data/index.html");
                let to = document::address(of.map(|of| of.page).or(folder).unwrap_or(to));
                format!("<a href=\"{}\">{}</a>", escape(&to), self.inlines(words))
            }
            Inline::Reference { to, within, label } => {
                let file = within.map_or("", |document| document.page);
                let sign = label.chars().next();
                let verdict = Verdict::ALL.iter().find(|verdict| Some(verdict.sign()) == sign);
                // Elsewhere than in the ledger it opens the card of its statement.
                let class = verdict.map_or(String::new(), |verdict| {
                    let words = verdict.words();
                    let name = words.replace(' ', "-");
                    let card = within.filter(|_| to.starts_with("claim:")).map(|_| self.card(to));
                    let card = card.unwrap_or_default();
                    format!(" class=\"verdict {name}\" title=\"{words}\"{card}")
                });
                format!("<a href=\"{file}#{}\"{class}>{}</a>", place_on_page(to), escaped(label))
            }
            Inline::Anchor { id, number } => {
                format!("<span id=\"{}\">{number}</span>", place_on_page(id))
            }
            Inline::Unresolved { ids, .. } => escaped(&ids.join("; ")),
        }
    }

    fn formula(&self, formula: &Formula, display: MathDisplay) -> String {
        let value = |id: &str, printed: &Printed| self.value(id, printed, '\u{202f}');
        mathml::write(formula, display, value).unwrap_or_else(|problem| {
            // The error names the whole formula, by which its place is found.
            self.errors.borrow_mut().push(Error::formula(formula.to_tex(), &problem));
            String::new()
        })
    }

    /// Writes a value, which opens its card. (Browsers break lines around a `<button>`.)
    fn value(&self, id: &str, printed: &Printed, blank: char) -> String {
        let card = self.card(id);
        let (class, html) = match printed {
            Printed::Words(_) => ("value phrase", self.inlines(&document::to_inlines(printed))),
            Printed::Number(numeral) => ("value", number_to_html(numeral, blank)),
        };
        format!("<span class=\"{class}\"{card}>{html}</span>")
    }

    /// Notes that the page opens the card with this id, and returns the attribute that names it.
    fn card(&self, id: &str) -> String {
        self.cards.borrow_mut().insert(id.to_string());
        // A line that ends in an attribute would be read as a blank.
        format!(" data-card=\"{}\"", escape(id).replace('\n', "&#10;"))
    }
}

/// Writes a printed number as text, with its power raised.
fn number_to_html(numeral: &Numeral, blank: char) -> String {
    let mut html = String::new();
    if !numeral.is_power_alone() {
        html += &numeral.signed("−");
    }
    if let Some(exponent) = numeral.exponent {
        let times = if html.is_empty() { "" } else { "\u{202f}×\u{202f}" };
        let minus = if exponent < 0 { "−" } else { "" };
        html += &format!("{times}10<sup>{minus}{}</sup>", exponent.unsigned_abs());
    }
    if numeral.in_percent {
        html.extend([blank, '%']);
    }
    html
}

/// Wraps what scrolls sideways where it is too wide.
fn scrollable(name: &str, inner: &str) -> String {
    format!("<div class=\"scroll\" role=\"group\" aria-label=\"{name}\">{inner}</div>")
}

fn code_to_html(code: &str) -> String {
    format!("<pre><code>{}</code></pre>\n", escaped(code.trim_end()))
}

/// Escapes words; a number and its sign of per cent stay on one line.
fn escaped(words: &str) -> String {
    escape(words).replace(" %", "\u{a0}%")
}

/// Returns whether it is a formula that ends before its right side.
fn ends_in_relation(inline: &Inline) -> bool {
    let Inline::Maths(formula) = inline else { return false };
    let ends = ["=", "<", ">", r"\approx", r"\le", r"\ge", r"\lt", r"\gt", r"\pm"];
    let tex = formula.to_tex();
    ends.iter().any(|end| tex.trim_end().ends_with(end))
}
