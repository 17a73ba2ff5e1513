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
    let (mut pieces, mut before): (Vec<String>, Option<&Block>) = (Vec::new(), None);
    for next in blocks {
        let markdown = block(next).trim_end().to_string();
        let is_list = |block: &Block| matches!(block, Block::List { .. });
        // Without a comment between, Markdown makes one list of two.
        pieces.extend((before.is_some_and(is_list) && is_list(next)).then(|| "<!-- -->".into()));
        pieces.extend(Some(markdown).filter(|markdown| !markdown.is_empty()));
        before = Some(next);
    }
    pieces.join("\n\n") + "\n"
}

fn prefix_lines(text: &str, before: &str) -> String {
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
            let length = words.trim_end_matches('#').len();
            if length < words.len() && words[..length].ends_with(' ') {
                words.insert(length, '\\');
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
                let deeper = prefix_lines(&write(item), &" ".repeat(marker.len()));
                marker + deeper.trim_start()
            };
            items.iter().enumerate().map(item).collect::<Vec<_>>().join("\n")
        }
        Block::Quote(blocks) => prefix_lines(&write(blocks), "> "),
        Block::Code { language, code } => {
            let fence = fence(code, 3);
            format!("{fence}{language}\n{}\n{fence}", code.trim_end())
        }
        // After a blank line Markdown goes on inside `details`.
        Block::Listing { id, number, caption, item, origin, code, .. } => format!(
            "{}**Listing {number}.** {}\n\n<details>\n<summary><code>{item}</code></summary>\n\n\
             {fence}rust\n{}\n{fence}\n\n<sub>{}</sub>\n\n</details>",
            anchor(id),
            inlines(caption),
            code.trim_end(),
            inlines(origin),
            fence = fence(code, 3)
        ),
        Block::Lab { .. } => String::new(),
        Block::Bibliography(entries) => {
            let entry = |entry: &document::Reference| {
                let place = anchor(&format!("ref:{}", entry.key));
                format!("- {place}{}", inlines(&entry.to_inlines()))
            };
            entries.iter().map(entry).collect::<Vec<_>>().join("\n")
        }
    }
}

const CELL: Within = Within { link: false, cell: true, plain: false };
const PLAIN: Within = Within { link: true, cell: false, plain: true };

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
    let mut markdown = row(&table.head);
    markdown.push_str(&format!("|{}|\n", rules.join("|")));
    markdown.extend(table.rows.iter().map(|cells| row(cells)));
    markdown
}

fn anchor(id: &str) -> String {
    format!("<a id=\"{}\"></a>", place_on_page(id))
}

/// Writes an alternative text in one line.
fn alternative(text: &str) -> String {
    let (line, mut escaped) =
        (text.split_whitespace().collect::<Vec<_>>().join(" "), "[".to_string());
    escape::push_words(&line, PLAIN, &mut escaped);
    // One star alone is a star.
    let escaped =
        if line.matches('*').count() == 1 { escaped.replace(r"\*", "*") } else { escaped };
    escaped[1..].into()
}

/// Returns a text of an author as Markdown that shows just its words and formulas.
pub fn escape_text(text: &str) -> String {
    let mut markdown = String::new();
    for piece in document::words_and_maths(text) {
        match piece {
            // A bar would end a cell.
            Inline::Maths(tex) => {
                markdown += &format!("${}$", tex.to_tex().replace('|', r"\vert{}"))
            }
            // The prose into which it goes has more signs.
            words => {
                let written = markdown.len();
                escape::push_words(&document::to_plain_text(&[words]), PLAIN, &mut markdown);
                for c in markdown.split_off(written).chars() {
                    markdown.extend("{}^@".contains(c).then_some('\\'));
                    markdown.push(c);
                }
            }
        }
    }
    markdown
}

pub fn inlines(list: &[Inline]) -> String {
    inlines_in(list, Within::default())
}

fn inlines_in(list: &[Inline], within: Within) -> String {
    // Values are text and formulas, so that neighbours are seen.
    let mut flat: Vec<Inline> = Vec::new();
    let expanded = list.iter().flat_map(|inline| match inline {
        Inline::Value { printed, .. } => document::to_inlines(printed),
        other => vec![other.clone()],
    });
    expanded.for_each(|inline| document::push(&mut flat, inline));
    let (mut markdown, mut in_formula) = (String::new(), false);
    for (i, inline) in flat.iter().enumerate() {
        match inline {
            Inline::Maths(formula) => {
                markdown.push_str(if in_formula { "" } else { "$" });
                markdown.push_str(&formula_to_markdown(&formula.to_tex()));
                in_formula = true;
            }
            // Words that touch the closing dollar would stop GitHub from rendering it. They move
            // inside, and so does a formula behind them.
            Inline::Text(words) if in_formula => {
                let touches = |c: char| c.is_alphanumeric() || "-–’'“”".contains(c);
                let rest = words.trim_start_matches(touches);
                let glued = &words[..words.len() - rest.len()];
                if !glued.is_empty() {
                    markdown.push_str(&format!(r"\text{{{glued}}}"));
                }
                if !rest.is_empty() {
                    markdown.push('$');
                    escape::push_words(rest, within, &mut markdown);
                    in_formula = false;
                }
            }
            other => {
                markdown.push_str(if in_formula { "$" } else { "" });
                write_inline(other, flat.get(i + 1), within, &mut markdown);
                in_formula = false;
            }
        }
    }
    markdown + if in_formula { "$" } else { "" }
}

/// Writes emphasis, by a tag where stars would be read as stars: beside a letter a star needs a
/// letter on its other side too.
fn enclosed(inner: &str, [sign, tag]: [&str; 2], next: Option<&Inline>, markdown: &mut String) {
    let words = inner.trim_matches(' ');
    let (Some(first), Some(last)) = (words.chars().next(), words.chars().next_back()) else {
        return markdown.push_str(inner);
    };
    let [blank, blank_after] = [inner.starts_with(' '), inner.ends_with(' ')];
    markdown.extend(blank.then_some(' '));
    let next = match next {
        Some(Inline::Text(words)) if !blank_after => words.chars().next().unwrap_or(' '),
        Some(Inline::Emphasis(_) | Inline::Strong(_)) if !blank_after => '*',
        _ => ' ',
    };
    let fits = |inner: char, outer: char| {
        let both = !inner.is_whitespace() && inner != '*' && outer != '*';
        both && (inner.is_alphanumeric() || !outer.is_alphanumeric())
    };
    let before = markdown.chars().next_back().unwrap_or(' ');
    // Stars between letters would begin and end emphasis there.
    let splits_word = words.match_indices('*').any(|(i, _)| {
        let [left, right] = [words[..i].trim_end_matches('*'), words[i..].trim_start_matches('*')];
        left.ends_with(char::is_alphanumeric) && right.starts_with(char::is_alphanumeric)
    });
    if fits(first, before) && fits(last, next) && !splits_word {
        markdown.push_str(&format!("{sign}{words}{sign}"));
    } else {
        markdown.push_str(&format!("<{tag}>{words}</{tag}>"));
    }
    markdown.extend(blank_after.then_some(' '));
}

fn write_inline(inline: &Inline, next: Option<&Inline>, within: Within, out: &mut String) {
    let linked = |words: &[Inline]| inlines_in(words, Within { link: true, ..within });
    match inline {
        Inline::Text(text) => escape::push_words(text, within, out),
        Inline::Soft => {
            // Two blanks would end the line.
            out.truncate(out.trim_end_matches(' ').len());
            out.push_str(if out.ends_with('\n') { "" } else { "\n" });
        }
        Inline::Code(code) => escape::push_code(code, within, out),
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
            out.push_str(&format!("$$\n{}{tag}\n$$\n\n", formula_to_markdown(&formula.to_tex())));
        }
        Inline::Link { to, words } => escape::push_link(&linked(words), to, out),
        Inline::Reference { to, within, label } => {
            let file = within.map_or("", |document| document.markdown);
            let to = format!("{file}#{}", place_on_page(to));
            escape::push_link(&linked(&[Inline::Text(label.clone())]), &to, out);
        }
        Inline::Anchor { id, number } => out.push_str(&format!("{}{number}", anchor(id))),
        Inline::Unresolved { ids, .. } => out.push_str(&ids.join("; ")),
        Inline::Maths(_) | Inline::Value { .. } => (),
    }
}

/// What Markdown would read in a formula, and macros with the same meaning.
static RESPELT: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    tex::pairs(
        r"\, \thinspace  \: \thinspace  \; \thinspace  \> \thinspace  \! \negthinspace
          \{ \lbrace  \} \rbrace  \| \Vert  \\ \cr  * \ast  < \lt  > \gt  | \vert",
    )
});

fn formula_to_markdown(tex: &str) -> String {
    let signs: Vec<&str> = tex::signs(tex).collect();
    let mut markdown = String::with_capacity(tex.len());
    for (i, sign) in signs.iter().enumerate() {
        let next = signs.get(i + 1).and_then(|next| next.chars().next());
        let respelt = RESPELT.get(sign).filter(|_| (*sign, next) != (r"\\", Some('[')));
        markdown.push_str(respelt.unwrap_or(sign));
        let is_word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        let before = i.checked_sub(1).and_then(|before| signs[before].chars().next_back());
        let splits = match respelt {
            Some(_) => next.is_some_and(|next| next.is_ascii_alphabetic()),
            None => *sign == "_" && is_word(next) && !is_word(before),
        };
        markdown.extend(splits.then_some(' '));
    }
    markdown
}
