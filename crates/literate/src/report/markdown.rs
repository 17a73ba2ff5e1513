//! Writes the tree as Markdown, for GitHub and similar sites.
//!
//! These sites read `$…$` after Markdown has read the characters inside, so mathematics is
//! respelled where Markdown would eat or misread it: `\,` becomes `\thinspace`, `\{` `\lbrace`,
//! `\\` `\cr`, `*` `\ast`, `<` `\lt`; a `_` that could open emphasis gets a space behind it; and
//! what follows a closing `$` without a space (`$n$-th`) moves inside.

mod escape;

use super::document::{self, Block, Inline, Table, place_on_page};
use super::tex;
use escape::{Within, fence};
use pulldown_cmark::Alignment;
use std::collections::BTreeMap;
use std::sync::LazyLock;

pub fn write(blocks: &[Block]) -> String {
    let (mut texts, mut before): (Vec<String>, Option<&Block>) = (Vec::new(), None);
    for one in blocks {
        let text = block(one).trim_end().to_string();
        let is_list = |block: &Block| matches!(block, Block::List { .. });
        // Without a comment between, Markdown makes one list of two.
        texts.extend((before.is_some_and(is_list) && is_list(one)).then(|| "<!-- -->".into()));
        texts.extend(Some(text).filter(|text| !text.is_empty()));
        before = Some(one);
    }
    texts.join("\n\n") + "\n"
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
            let mut words = inlines(text).trim_end().to_string();
            // Signs at the end would close the heading.
            let kept = words.trim_end_matches('#').len();
            if kept < words.len() && words[..kept].ends_with(' ') {
                words.insert(kept, '\\');
            }
            format!("{hashes} {}{number}{words}", id.unwrap_or_default())
        }
        // Four blanks begin a block of code.
        Block::Paragraph(text) => inlines(text).trim_start_matches(' ').into(),
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

const CELL: Within = Within { link: false, cell: true };

fn table(table: &Table) -> String {
    let row = |cells: &[Vec<Inline>]| {
        let cells: Vec<String> = cells.iter().map(|cell| inlines_in(cell, CELL)).collect();
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

fn anchor(id: &str) -> String {
    format!("<a id=\"{}\"></a>", place_on_page(id))
}

/// Alternative text, in one line.
fn alternative(text: &str) -> String {
    let (line, mut out) = (text.split_whitespace().collect::<Vec<_>>().join(" "), "[".to_string());
    escape::words(&line, Within { link: true, cell: false }, &mut out);
    // One star alone is a star.
    let out = if line.matches('*').count() == 1 { out.replace(r"\*", "*") } else { out };
    out[1..].into()
}

/// Returns a text of an author as Markdown that shows just its words and formulas.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for piece in document::words_and_maths(text) {
        match piece {
            // A bar would end a cell.
            Inline::Maths(tex) => out += &format!("${}$", tex.digits().replace('|', r"\vert{}")),
            // The prose into which it goes has more signs.
            words => {
                let written = out.len();
                escape::words(
                    &document::plain(&[words]),
                    Within { link: true, cell: false },
                    &mut out,
                );
                for c in out.split_off(written).chars() {
                    out.extend("{}^@".contains(c).then_some('\\'));
                    out.push(c);
                }
            }
        }
    }
    out
}

pub fn inlines(list: &[Inline]) -> String {
    inlines_in(list, Within::default())
}

fn inlines_in(list: &[Inline], within: Within) -> String {
    // Values are text and formulas, so that neighbours are seen; words that touch are one text.
    let mut flat: Vec<Inline> = Vec::new();
    let shown = list.iter().flat_map(|inline| match inline {
        Inline::Value { shown, .. } => document::printed(shown),
        other => vec![other.clone()],
    });
    for inline in shown {
        match (flat.last_mut(), &inline) {
            (Some(Inline::Text(before)), Inline::Text(words)) => before.push_str(words),
            _ => flat.push(inline),
        }
    }
    let (mut out, mut in_formula) = (String::new(), false);
    for (i, inline) in flat.iter().enumerate() {
        match inline {
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
                    escape::words(rest, within, &mut out);
                    in_formula = false;
                }
            }
            other => {
                out.push_str(if in_formula { "$" } else { "" });
                write_inline(other, flat.get(i + 1), within, &mut out);
                in_formula = false;
            }
        }
    }
    out + if in_formula { "$" } else { "" }
}

/// Writes emphasis, by a tag where stars would be read as stars: beside a letter a star needs a
/// letter on its other side too.
fn enclosed(inner: &str, [sign, tag]: [&str; 2], next: Option<&Inline>, out: &mut String) {
    let words = inner.trim_matches(' ');
    let (Some(first), Some(last)) = (words.chars().next(), words.chars().next_back()) else {
        return out.push_str(inner);
    };
    let [blank, blank_after] = [inner.starts_with(' '), inner.ends_with(' ')];
    out.extend(blank.then_some(' '));
    let next = match next {
        Some(Inline::Text(words)) if !blank_after => words.chars().next().unwrap_or(' '),
        Some(Inline::Emphasis(_) | Inline::Strong(_)) if !blank_after => '*',
        _ => ' ',
    };
    let fits = |inner: char, outer: char| {
        let both = !inner.is_whitespace() && inner != '*' && outer != '*';
        both && (inner.is_alphanumeric() || !outer.is_alphanumeric())
    };
    let before = out.chars().next_back().unwrap_or(' ');
    if fits(first, before) && fits(last, next) {
        out.push_str(&format!("{sign}{words}{sign}"));
    } else {
        out.push_str(&format!("<{tag}>{words}</{tag}>"));
    }
    out.extend(blank_after.then_some(' '));
}

fn write_inline(inline: &Inline, next: Option<&Inline>, within: Within, out: &mut String) {
    let linked = |shown: &[Inline]| inlines_in(shown, Within { link: true, ..within });
    match inline {
        Inline::Text(text) => escape::words(text, within, out),
        Inline::Soft => {
            // Two blanks would end the line.
            out.truncate(out.trim_end_matches(' ').len());
            out.push_str(if out.ends_with('\n') { "" } else { "\n" });
        }
        Inline::Code(code) => escape::code(code, within, out),
        Inline::Emphasis(inner) => enclosed(&inlines_in(inner, within), ["*", "em"], next, out),
        Inline::Strong(inner) => enclosed(&inlines_in(inner, within), ["**", "strong"], next, out),
        Inline::Raised(inner) => out.push_str(&format!("<sup>{}</sup>", inlines_in(inner, within))),
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
        Inline::Link { to, shown } => escape::link(&linked(shown), to, out),
        Inline::Reference { to, within, shown } => {
            let file = within.map_or("", |document| document.markdown);
            let to = format!("{file}#{}", place_on_page(to));
            escape::link(&linked(&[Inline::Text(shown.clone())]), &to, out);
        }
        Inline::Anchor { id, number } => out.push_str(&format!("{}{number}", anchor(id))),
        Inline::Unresolved { ids, .. } => out.push_str(&ids.join("; ")),
        Inline::Maths(_) | Inline::Value { .. } => (),
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
