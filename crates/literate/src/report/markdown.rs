//! Writes the tree as Markdown, for GitHub and similar sites.
//!
//! These sites read `$…$` after Markdown has read the characters inside, so mathematics is
//! respelled where Markdown would eat or misread it: `\,` becomes `\thinspace`, `\{` `\lbrace`,
//! `\\` `\cr`, `*` `\ast`, `<` `\lt`; a `_` that could open emphasis gets a space behind it; and
//! what follows a closing `$` without a space (`$n$-th`) moves inside.

use super::document::{self, Block, Inline, Table, place_on_page};
use super::tex;
use pulldown_cmark::Alignment;
use std::collections::BTreeMap;
use std::sync::LazyLock;

pub fn write(blocks: &[Block]) -> String {
    let blocks = blocks.iter().map(|one| block(one).trim_end().to_string());
    blocks.filter(|text| !text.is_empty()).collect::<Vec<_>>().join("\n\n") + "\n"
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
        Block::Table(data) => {
            let mut text = data.id.as_deref().map_or(String::new(), anchor);
            if let Some(number) = &data.number {
                text.push_str(&format!("**Table {number}.** {}\n\n", inlines(&data.caption)));
            }
            text + &table(data)
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
    let row = |cells: &[Vec<Inline>]| {
        let cells: Vec<String> = cells.iter().map(|cell| inlines(cell)).collect();
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
    out.extend(table.rows.iter().map(|cells| row(cells)));
    out
}

/// Returns a fence of at least this many grave accents, longer than any in the code.
fn fence(code: &str, least: usize) -> String {
    let longest = code.split(|c| c != '`').map(str::len).max().unwrap_or_default();
    "`".repeat(least.max(longest + 1))
}

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
            words => write_text(&document::plain(&[words]), &mut out),
        }
    }
    out
}

pub fn inlines(list: &[Inline]) -> String {
    // Values are text and formulas, so that neighbours of mathematics are seen.
    let flat = list.iter().flat_map(|inline| match inline {
        Inline::Value { shown, .. } => document::printed(shown),
        other => vec![other.clone()],
    });
    let (mut out, mut in_formula) = (String::new(), false);
    for inline in flat {
        match &inline {
            Inline::Maths(formula) => {
                out.push_str(if in_formula { "" } else { "$" });
                out.push_str(&maths(&formula.digits()));
                in_formula = true;
            }
            // Words that touch the closing dollar move inside, and so does a formula behind them.
            Inline::Text(words) if in_formula => {
                let (glued, rest) = words.split_at(glued(words));
                if !glued.is_empty() {
                    out.push_str(&format!(r"\text{{{glued}}}"));
                }
                if !rest.is_empty() {
                    out.push('$');
                    write_text(rest, &mut out);
                    in_formula = false;
                }
            }
            other => {
                out.push_str(if in_formula { "$" } else { "" });
                write_inline(other, &mut out);
                in_formula = false;
            }
        }
    }
    out + if in_formula { "$" } else { "" }
}

fn write_inline(inline: &Inline, out: &mut String) {
    match inline {
        Inline::Text(text) => write_text(text, out),
        Inline::Soft if out.ends_with('\n') => (),
        Inline::Soft => out.push('\n'),
        Inline::Code(code) => {
            let fence = fence(code, 1);
            let blank = if code.starts_with('`') || code.ends_with('`') { " " } else { "" };
            out.push_str(&format!("{fence}{blank}{code}{blank}{fence}"));
        }
        Inline::Emphasis(inner) => out.push_str(&format!("*{}*", inlines(inner))),
        Inline::Raised(inner) => out.push_str(&format!("<sup>{}</sup>", inlines(inner))),
        Inline::Strong(inner) => out.push_str(&format!("**{}**", inlines(inner))),
        Inline::Display { formula, id, number } => {
            out.truncate(out.trim_end_matches([' ', '\n']).len());
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
        Inline::Link { to, shown } => out.push_str(&format!("[{}]({to})", inlines(shown))),
        Inline::Reference { to, within, shown } => {
            let file = within.map_or("", |document| document.markdown);
            out.push('[');
            write_text(shown, out);
            out.push_str(&format!("]({file}#{})", place_on_page(to)));
        }
        Inline::Anchor { id, number } => out.push_str(&format!("{}{number}", anchor(id))),
        Inline::Unresolved { ids, .. } => out.push_str(&ids.join("; ")),
        Inline::Maths(_) | Inline::Value { .. } => (),
    }
}

fn write_text(text: &str, out: &mut String) {
    // After a displayed equation the line starts anew.
    let text = if out.ends_with('\n') { text.trim_start() } else { text };
    let starts_line = out.is_empty() || out.ends_with('\n');
    let chars: Vec<char> = text.chars().collect();
    let marker = if starts_line { marker_length(&chars) } else { None };
    let is_word = |c: Option<&char>| c.is_some_and(|c| c.is_alphanumeric());
    for (i, &c) in chars.iter().enumerate() {
        let (before, after) = (i.checked_sub(1).map(|i| &chars[i]), &chars[i + 1..]);
        let escape = match c {
            '\\' | '*' | '`' | '<' | '$' | '~' | '|' => true,
            // Not what names a character.
            '&' => after.iter().find(|c| !c.is_alphanumeric() && **c != '#') == Some(&';'),
            // Not what defines a link.
            '[' => starts_line && i == 0 && text.contains("]:"),
            '_' => !(is_word(before) && is_word(after.first())),
            '(' => before == Some(&']'),
            _ => marker == Some(i),
        };
        out.extend(escape.then_some('\\'));
        out.push(c);
    }
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

/// What Markdown would read in a formula, and macros with the same meaning.
static RESPELT: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    tex::pairs(
        r"\, \thinspace  \: \thinspace  \; \thinspace  \> \thinspace  \! \negthinspace
          \{ \lbrace  \} \rbrace  \| \Vert  \\ \cr  * \ast  < \lt  > \gt  | \vert",
    )
});

fn maths(tex: &str) -> String {
    let signs: Vec<&str> = tex::signs(tex).collect();
    let mut out = String::with_capacity(tex.len());
    for (i, sign) in signs.iter().enumerate() {
        let next = signs.get(i + 1).and_then(|next| next.chars().next());
        let respelt = RESPELT.get(sign).filter(|_| (*sign, next) != (r"\\", Some('[')));
        out.push_str(respelt.unwrap_or(sign));
        let is_word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        let before = i.checked_sub(1).and_then(|before| signs[before].chars().next_back());
        let splits = match respelt {
            Some(_) => next.is_some_and(|next| next.is_ascii_alphabetic()),
            None => *sign == "_" && is_word(next) && !is_word(before),
        };
        out.extend(splits.then_some(' '));
    }
    out
}
