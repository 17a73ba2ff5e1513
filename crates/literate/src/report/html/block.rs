//! Blocks → HTML.

use super::{Page, escape};
use crate::report::Error;
use crate::report::document::{Align, Block, Inline, plain, spelt};
use std::fmt::Write as _;

/// Columns whose cells have more characters than this are no towers: they have a least width.
const WIDTHS: [(usize, &str); 3] =
    [(300, " class=\"long\""), (TEXT, " class=\"text\""), (40, " class=\"words\"")];

/// So many columns do not stand side by side on a narrow screen, nor more than a few if one of them is of text.
const MANY: usize = 6;
const FEW: usize = 3;
/// Characters of a cell that is text.
const TEXT: usize = 100;

impl Page<'_> {
    /// All blocks.
    pub(super) fn blocks(&self, blocks: &[Block]) -> Result<String, Error> {
        blocks.iter().map(|block| self.block(block)).collect()
    }

    fn block(&self, block: &Block) -> Result<String, Error> {
        Ok(match block {
            // The title belongs to the shell.
            Block::Heading { level: 1, .. } => String::new(),
            Block::Heading { level, number, id, text } => {
                let number = number.as_ref().map(|n| format!("<span>{n}</span> "));
                let number = number.unwrap_or_default();
                if *level > 2 && id.is_none() {
                    return Ok(format!("<h{level}>{number}{}</h{level}>\n", self.inlines(text)?));
                }
                let (id, text) = (self.id_of(id.as_deref(), text), self.inlines(text)?);
                format!("<h{level} id=\"{id}\"><a href=\"#{id}\">{number}{text}</a></h{level}>\n")
            }
            Block::Paragraph(text) => self.paragraph(text)?,
            Block::Figure { .. } => self.figure(block)?,
            Block::Lab { lab, caption } => self.lab(lab, caption)?,
            Block::Table { id, number, caption, columns, head, rows } => {
                let mut text = String::from("<figure class=\"table\"");
                if let Some(id) = id {
                    let _ = write!(text, " id=\"{}\"", escape::id(id));
                }
                text.push('>');
                let name = match number {
                    Some(number) => {
                        let caption = self.inlines(caption)?;
                        let _ = write!(
                            text,
                            "<figcaption><strong>Table {number}.</strong> {caption}</figcaption>"
                        );
                        format!("Table {number}")
                    }
                    None => "Table".into(),
                };
                let _ = write!(
                    text,
                    "<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{name}\">"
                );
                text + &self.table(columns, head, rows)? + "</div></figure>\n"
            }
            Block::List { start, items } => {
                let (open, close) = match start {
                    Some(1) => ("<ol>".to_string(), "</ol>"),
                    Some(n) => (format!("<ol start=\"{n}\">"), "</ol>"),
                    None => ("<ul>".to_string(), "</ul>"),
                };
                let mut out = format!("{open}\n");
                for item in items {
                    let _ = writeln!(out, "<li>{}</li>", self.item(item)?);
                }
                out + close + "\n"
            }
            Block::Quote(blocks) => {
                format!("<blockquote>\n{}</blockquote>\n", self.blocks(blocks)?)
            }
            Block::Code { text, .. } => format!(
                "<pre tabindex=\"0\"><code>{}</code></pre>\n",
                escape::text(text.trim_end())
            ),
            Block::Listing { id, number, caption, item, file, text } => {
                let caption = self.inlines(caption)?;
                let item = self.inlines(&[Inline::Code(item.clone())])?;
                let text = escape::text(text.trim_end());
                format!(
                    "<div class=\"listing\" id=\"{}\"><p><strong>Listing {number}.</strong> {caption}</p>\n\
                     <details><summary>{item}</summary>\n\
                     <pre tabindex=\"0\"><code>{text}</code></pre>\n\
                     <p class=\"origin\">From <a href=\"../{file}\">{file}</a>.</p></details></div>\n",
                    escape::id(id)
                )
            }
            Block::Bibliography(entries) => {
                let mut out = String::from("<ul class=\"references\">\n");
                for entry in entries {
                    let id = escape::id(&format!("ref:{}", entry.key));
                    let _ = writeln!(out, "<li id=\"{id}\">{}</li>", self.inlines(&entry.text)?);
                }
                out + "</ul>\n"
            }
        })
    }

    /// One paragraph of an item stands without `<p>`.
    fn item(&self, blocks: &[Block]) -> Result<String, Error> {
        match blocks {
            [Block::Paragraph(text)] => self.inlines(text),
            _ => self.blocks(blocks),
        }
    }

    /// HTML lets no equation stand inside a `<p>`: the sentence goes on in the next one.
    fn paragraph(&self, text: &[Inline]) -> Result<String, Error> {
        let mut out = String::new();
        let is_display = |inline: &Inline| matches!(inline, Inline::Display { .. });
        let mut rest = text;
        let mut goes_on = false;
        while !rest.is_empty() {
            let end = rest.iter().position(is_display).unwrap_or(rest.len());
            let words = self.inlines(&rest[..end])?;
            if !words.trim().is_empty() {
                let class = if goes_on { " class=\"on\"" } else { "" };
                let _ = writeln!(out, "<p{class}>{}</p>", words.trim());
            }
            if let Some(equation) = rest.get(end) {
                out.push_str(&self.inlines(std::slice::from_ref(equation))?);
            }
            goes_on = true;
            rest = &rest[rest.len().min(end + 1)..];
        }
        Ok(out)
    }

    fn table(
        &self,
        columns: &[Align],
        head: &[Vec<Inline>],
        rows: &[Vec<Vec<Inline>>],
    ) -> Result<String, Error> {
        let longest =
            |i: usize| rows.iter().filter_map(|row| row.get(i)).map(|c| plain(c).len()).max();
        let longest: Vec<usize> = (0..columns.len()).filter_map(longest).collect();
        let class = |i: usize| match (columns.get(i), longest.get(i)) {
            (Some(Align::Right), _) => " class=\"right\"",
            (Some(Align::Centre), _) => " class=\"centre\"",
            (_, Some(&length)) => {
                WIDTHS.iter().find(|(least, _)| length > *least).map_or("", |(_, class)| class)
            }
            _ => "",
        };
        // On a narrow screen rows of many columns become lists, with the heads as names, or at
        // least scroll sideways as lines and not as towers.
        let names: Vec<String> = head.iter().map(|cell| spelt(cell)).collect();
        let is_word = |inline: &Inline| match inline {
            Inline::Text(text) => text.chars().any(char::is_alphabetic),
            _ => false,
        };
        let has_words = |cell: &Vec<Inline>| cell.iter().any(is_word);
        let texts = longest.iter().any(|length| *length > TEXT) && columns.len() > FEW;
        let many = columns.len() >= MANY || texts;
        let lists = many && head.iter().all(has_words);
        // A browser forgets that these are tables once style sheets lay them out as lists.
        let [table, line, field] = match (lists, many) {
            (true, _) => [" class=\"lists\" role=\"table\"", " role=\"row\"", " role=\"cell\""],
            (false, true) => [" class=\"many\"", "", ""],
            (false, false) => [""; 3],
        };
        let mut out = format!("<table{table}>\n<thead><tr{line}>");
        for (i, cell) in head.iter().enumerate() {
            let mut text = self.inlines(cell)?;
            // Some readers of screens see no words in mathematics.
            if matches!(cell.as_slice(), [Inline::Maths(_)]) {
                let words = escape::text(&spelt(cell));
                text = format!(
                    "<span aria-hidden=\"true\">{text}</span><span class=\"unseen\">{words}</span>"
                );
            }
            // A head without words is no head.
            let tag = match (text.trim().is_empty(), lists) {
                (true, _) => "td",
                (false, true) => "th scope=\"col\" role=\"columnheader\"",
                (false, false) => "th scope=\"col\"",
            };
            let end = &tag[..2];
            let _ = write!(out, "<{tag}{}>{text}</{end}>", class(i));
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        for row in rows {
            let _ = write!(out, "<tr{line}>");
            for (i, cell) in row.iter().enumerate() {
                let name = match names.get(i).filter(|_| lists) {
                    Some(name) => format!(" data-name=\"{}\"", escape::text(name)),
                    None => String::new(),
                };
                let text = self.inlines(cell)?;
                let _ = write!(out, "<td{field}{}{name}>{text}</td>", class(i));
            }
            out.push_str("</tr>\n");
        }
        Ok(out + "</tbody>\n</table>")
    }
}
