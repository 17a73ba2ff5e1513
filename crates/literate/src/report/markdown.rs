//! Writes the tree as Markdown, for GitHub and similar sites.
//!
//! These sites read `$…$` after Markdown has read the characters inside, so mathematics is
//! respelled where Markdown would eat or misread it: `\,` becomes `\thinspace`, `\{` `\lbrace`,
//! `\\` `\cr`, `*` `\ast`, `<` `\lt`; a `_` that could open emphasis gets a space behind it; and
//! what follows a closing `$` without a space (`$n$-th`) moves inside.

use super::document::{self, Block, Inline, Table, place_on_page};
use pulldown_cmark::Alignment;
use std::borrow::Cow;

/// Writes a document.
pub fn write(blocks: &[Block]) -> String {
    let blocks = blocks.iter().map(|one| block(one).trim_end().to_string());
    blocks.filter(|text| !text.is_empty()).collect::<Vec<_>>().join("\n\n") + "\n"
}

/// Writes running text.
pub fn inlines(inlines: &[Inline]) -> String {
    Writer { in_table: false }.all(inlines)
}

fn lines(text: &str, before: &str) -> String {
    let line = |line: &str| format!("{before}{line}").trim_end().to_string();
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

fn block(block: &Block) -> String {
    match block {
        Block::Heading { level, number, id, text } => {
            let number = number.as_ref().map(|n| format!("{n} ")).unwrap_or_default();
            let (hashes, id) = ("#".repeat(usize::from(*level)), id.as_deref().map(anchor));
            format!("{hashes} {}{number}{}", id.unwrap_or_default(), inlines(text))
        }
        Block::Paragraph(text) => inlines(text),
        Block::Figure { id, number, files: [file, _], alt, origin, caption, .. } => {
            let (caption, origin) = (inlines(caption), inlines(origin));
            let origin = if origin.is_empty() { origin } else { format!("\n<sub>{origin}</sub>") };
            let (id, alt) = (anchor(id), alternative(alt));
            format!("{id}\n![{alt}](figures/{file})\n\n**Figure {number}.** {caption}{origin}")
        }
        Block::Table(own) => {
            let mut text = own.id.as_deref().map_or(String::new(), anchor);
            if let Some(number) = &own.number {
                text.push_str(&format!("**Table {number}.** {}\n\n", inlines(&own.caption)));
            }
            text + &table(own)
        }
        Block::List { start, items } => {
            let item = |(i, item): (usize, &Vec<Block>)| {
                let marker = start.map_or("- ".into(), |start| format!("{}. ", start + i as u64));
                let deeper = lines(&write(item), &" ".repeat(marker.len()));
                marker + deeper.trim_start()
            };
            items.iter().enumerate().map(item).collect::<Vec<_>>().join("\n")
        }
        Block::Quote(blocks) => lines(&write(blocks), "> "),
        Block::Code { language, text } => {
            let fence = fence(text, 3);
            format!("{fence}{language}\n{}\n{fence}", text.trim_end())
        }
        // After a blank line Markdown goes on inside `details`.
        Block::Listing { id, number, caption, item, origin, text, .. } => format!(
            "{}**Listing {number}.** {}\n\n<details>\n<summary><code>{item}</code></summary>\n\n\
             {fence}rust\n{}\n{fence}\n\n<sub>{}</sub>\n\n</details>",
            anchor(id),
            inlines(caption),
            text.trim_end(),
            inlines(origin),
            fence = fence(text, 3)
        ),
        // Markdown runs nothing.
        Block::Lab { .. } => String::new(),
        Block::Bibliography(entries) => {
            let entry = |entry: &document::Reference| {
                format!("- {}{}", anchor(&format!("ref:{}", entry.key)), inlines(&entry.text()))
            };
            entries.iter().map(entry).collect::<Vec<_>>().join("\n")
        }
    }
}

fn table(table: &Table) -> String {
    let writer = Writer { in_table: true };
    let row = |cells: &[Vec<Inline>]| {
        let cells: Vec<String> = cells.iter().map(|cell| writer.all(cell)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rule = |align: &Alignment| match align {
        Alignment::Left | Alignment::None => "---",
        Alignment::Center => ":-:",
        Alignment::Right => "--:",
    };
    let rules: Vec<&str> = table.columns.iter().map(rule).collect();
    let mut out = row(&table.head);
    out.push_str(&format!("|{}|\n", rules.join("|")));
    for cells in &table.rows {
        out.push_str(&row(cells));
    }
    out
}

/// Returns a fence of at least so many grave accents, longer than any in the code.
fn fence(code: &str, least: usize) -> String {
    let longest = code.split(|c| c != '`').map(str::len).max().unwrap_or_default();
    let fits = |length: usize| !code.contains('`') || length > longest;
    let length = if fits(least) { least } else { longest + 1 };
    "`".repeat(length)
}

/// Returns an HTML anchor, `fig-3` for `fig:3`.
fn anchor(id: &str) -> String {
    format!("<a id=\"{}\"></a>", place_on_page(id))
}

/// Alternative text: one line, without characters that Markdown would read.
fn alternative(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    line.replace('\\', r"\\").replace('[', r"\[").replace(']', r"\]").replace('_', r"\_")
}

/// Returns a text of an author as Markdown that shows just its words and formulas.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for piece in document::words_and_maths(text) {
        match piece {
            // A bar would end a cell.
            Inline::Maths(tex) => out += &format!("${}$", tex.digits().replace('|', r"\vert{}")),
            words => Writer { in_table: true }.text(&document::plain(&[words]), &mut out),
        }
    }
    out
}

struct Writer {
    in_table: bool,
}

impl Writer {
    fn all(&self, inlines: &[Inline]) -> String {
        let mut out = String::new();
        let flat = flat(inlines);
        let mut i = 0;
        while i < flat.len() {
            if let Inline::Maths(formula) = &*flat[i] {
                // Words that touch the closing dollar move inside.
                let mut formula = maths(&formula.digits());
                let mut rest = "";
                while let Some(Inline::Text(text)) = flat.get(i + 1).map(Cow::as_ref) {
                    let (glued, after) = text.split_at(glued(text));
                    (i, rest) = (i + 1, after);
                    if !glued.is_empty() {
                        formula.push_str(&format!(r"\text{{{glued}}}"));
                    }
                    // And so does a formula behind them.
                    match flat.get(i + 1).map(Cow::as_ref) {
                        Some(Inline::Maths(next)) if rest.is_empty() => {
                            formula.push_str(&maths(&next.digits()))
                        }
                        _ => break,
                    }
                    i += 1;
                }
                out.push_str(&format!("${formula}$"));
                self.text(rest, &mut out);
            } else {
                self.one(&flat[i], &mut out);
            }
            i += 1;
        }
        out
    }

    fn one(&self, inline: &Inline, out: &mut String) {
        match inline {
            Inline::Text(text) => self.text(text, out),
            Inline::Soft if self.in_table => out.push(' '),
            Inline::Soft if out.ends_with('\n') => (),
            Inline::Soft => out.push('\n'),
            Inline::Code(code) => {
                let fence = fence(code, 1);
                let blank = if code.starts_with('`') || code.ends_with('`') { " " } else { "" };
                out.push_str(&format!("{fence}{blank}{code}{blank}{fence}"));
            }
            Inline::Emphasis(inner) => out.push_str(&format!("*{}*", self.all(inner))),
            Inline::Raised(inner) => out.push_str(&format!("<sup>{}</sup>", self.all(inner))),
            Inline::Strong(inner) => out.push_str(&format!("**{}**", self.all(inner))),
            Inline::Display { formula, id, number } => {
                while out.ends_with([' ', '\n']) {
                    out.pop();
                }
                if !out.is_empty() {
                    out.push_str("\n\n");
                }
                let mut tag = String::new();
                if let Some(id) = id {
                    out.push_str(&format!("{}\n\n", anchor(id)));
                    tag = format!("\n\\tag{{{number}}}");
                }
                out.push_str(&format!("$$\n{}{tag}\n$$\n\n", maths(&formula.digits())));
            }
            // Formulas are written above, and values are flat.
            Inline::Maths(_) | Inline::Value { .. } => (),
            Inline::Link { to, shown } => out.push_str(&format!("[{}]({to})", self.all(shown))),
            Inline::Reference { to, within, shown } => {
                let file = within.map_or("", |document| document.markdown);
                let place = place_on_page(to);
                out.push('[');
                self.text(shown, out);
                out.push_str(&format!("]({file}#{place})"));
            }
            Inline::Anchor { id, number } => out.push_str(&format!("{}{number}", anchor(id))),
            Inline::Unresolved { ids, .. } => out.push_str(&ids.join("; ")),
        }
    }

    fn text(&self, text: &str, out: &mut String) {
        // After a displayed equation the line starts anew.
        let text = if out.ends_with('\n') { text.trim_start() } else { text };
        let starts_line = out.is_empty() || out.ends_with('\n');
        let chars: Vec<char> = text.chars().collect();
        let marker = if starts_line { marker_length(&chars) } else { None };
        for (i, &c) in chars.iter().enumerate() {
            let inside_word = i > 0
                && chars[i - 1].is_alphanumeric()
                && chars.get(i + 1).is_some_and(|next| next.is_alphanumeric());
            let escape = match c {
                '\\' | '*' | '`' | '<' | '$' | '~' => true,
                // Not what names a character.
                '&' => {
                    chars[i + 1..].iter().find(|c| !c.is_alphanumeric() && **c != '#') == Some(&';')
                }
                // Not what defines a link.
                '[' => starts_line && i == 0 && text.contains("]:"),
                '_' => !inside_word,
                '|' => self.in_table,
                '(' => i > 0 && chars[i - 1] == ']',
                _ => marker == Some(i),
            };
            if escape {
                out.push('\\');
            }
            out.push(c);
        }
    }
}

/// The pieces with values as text and formulas, so that neighbours of mathematics are seen.
fn flat(inlines: &[Inline]) -> Vec<Cow<'_, Inline>> {
    let mut out = Vec::with_capacity(inlines.len());
    for inline in inlines {
        match inline {
            Inline::Value { shown, .. } => {
                out.extend(document::printed(shown).into_iter().map(Cow::Owned));
            }
            other => out.push(Cow::Borrowed(other)),
        }
    }
    out
}

/// Where a backslash stops words at the start of a line from becoming a list, a heading, a quote.
fn marker_length(chars: &[char]) -> Option<usize> {
    let digits = chars.iter().take_while(|c| c.is_ascii_digit()).count();
    let next_is_space = |i: usize| chars.get(i + 1).is_none_or(|c| *c == ' ');
    match chars.get(digits)? {
        '.' | ')' if digits > 0 && next_is_space(digits) => Some(digits),
        '-' | '+' if digits == 0 && next_is_space(0) => Some(0),
        '#' | '>' | '=' if digits == 0 => Some(0),
        _ => None,
    }
}

/// Returns the length of what touches the closing dollar and would stop GitHub from rendering it.
fn glued(text: &str) -> usize {
    let touches = |c: char| c.is_alphanumeric() || matches!(c, '-' | '–' | '’' | '\'' | '“' | '”');
    text.find(|c| !touches(c)).unwrap_or(text.len())
}

/// TeX that survives Markdown.
fn maths(tex: &str) -> String {
    let chars: Vec<char> = tex.chars().collect();
    let mut out = String::with_capacity(tex.len());
    let mut i = 0;
    let word = |out: &mut String, name: &str, next: Option<&char>| {
        out.push_str(name);
        if next.is_some_and(char::is_ascii_alphabetic) {
            out.push(' ');
        }
    };
    while i < chars.len() {
        let next = chars.get(i + 1);
        let after = chars.get(i + 2);
        match (chars[i], next) {
            ('\\', Some(c)) => {
                i += 1;
                match c {
                    ',' | ':' | ';' | '>' => word(&mut out, r"\thinspace", after),
                    '!' => word(&mut out, r"\negthinspace", after),
                    '{' => word(&mut out, r"\lbrace", after),
                    '}' => word(&mut out, r"\rbrace", after),
                    '|' => word(&mut out, r"\Vert", after),
                    '\\' if after != Some(&'[') => word(&mut out, r"\cr", after),
                    c => out.extend(['\\', *c]),
                }
            }
            ('*', next) => word(&mut out, r"\ast", next),
            ('<', next) => word(&mut out, r"\lt", next),
            ('>', next) => word(&mut out, r"\gt", next),
            ('|', next) => word(&mut out, r"\vert", next),
            ('_', Some(next)) => {
                out.push('_');
                let before = i.checked_sub(1).map(|j| chars[j]);
                if next.is_alphanumeric() && !before.is_some_and(char::is_alphanumeric) {
                    out.push(' ');
                }
            }
            (c, _) => out.push(c),
        }
        i += 1;
    }
    out
}
