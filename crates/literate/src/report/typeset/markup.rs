//! The tree → the typesetter's markup. Numbers of sections, equations, figures and tables come from
//! the tree; the typesetter counts nothing.

use super::maths;
use crate::report::Error;
use crate::report::document::{Align, Block, Inline, continues, is_equation};
use crate::report::valued::bare;

/// The whole body.
pub fn report(blocks: &[Block]) -> Result<String, Error> {
    Ok(write(blocks)? + &listings(blocks)?)
}

fn write(blocks: &[Block]) -> Result<String, Error> {
    let mut out = String::new();
    for (i, block) in blocks.iter().enumerate() {
        // An equation belongs to the sentence around it.
        let beside = |j: usize| blocks.get(j).is_some_and(is_equation);
        let joined = beside(i) || i > 0 && beside(i - 1) && continues(block);
        out.push_str(if joined || out.is_empty() { "\n" } else { "\n\n" });
        out.push_str(write_block(block)?.trim());
    }
    Ok(out + "\n")
}

/// A string literal.
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

fn label(id: &str) -> String {
    format!("#label({})", quoted(id))
}

/// A place that a link finds.
fn place(id: &str) -> String {
    format!("#[#metadata(none) {}];", label(id))
}

fn labelled(id: Option<&str>) -> String {
    id.map(|id| format!(" {}", label(id))).unwrap_or_default()
}

fn write_block(block: &Block) -> Result<String, Error> {
    Ok(match block {
        // The title belongs to the shell.
        Block::Heading { level: 1, .. } => String::new(),
        Block::Heading { level, number, id, text } => format!(
            "#heading(level: {}, numbering: {})[{}]{}",
            level - 1,
            numbering(number.as_deref()),
            inlines(text)?,
            labelled(id.as_deref())
        ),
        Block::Paragraph(text) => inlines(text)?,
        Block::Figure { id, number, path, alt, caption, .. } => format!(
            "#figure(image({}, alt: {}, width: 82%), kind: image, supplement: [Figure], \
             numbering: {}, placement: auto, caption: [{}]){}",
            quoted(path),
            quoted(alt),
            numbering(Some(number)),
            inlines(caption)?,
            labelled(Some(id))
        ),
        Block::Table { id, number, caption, columns, head, rows } => {
            let table = table(columns, head, rows)?;
            let Some(number) = number else { return Ok(format!("#{table}")) };
            let figure = format!(
                "#figure({table}, kind: table, supplement: [Table], numbering: {}, caption: [{}]){}",
                numbering(Some(number)),
                inlines(caption)?,
                labelled(id.as_deref())
            );
            let across = columns.len() > MOST_COLUMNS;
            if across { format!("#page(flipped: true)[{figure}]") } else { figure }
        }
        Block::List { start, items } => {
            let items: String = items
                .iter()
                .map(|item| Ok(format!("[{}], ", write(item)?.trim())))
                .collect::<Result<_, Error>>()?;
            match start {
                Some(start) => format!("#enum(start: {start}, {items})"),
                None => format!("#list({items})"),
            }
        }
        Block::Quote(blocks) => format!("#quote(block: true)[{}]", write(blocks)?.trim()),
        Block::Code { language, text } => {
            let language = if language.is_empty() { "none".into() } else { quoted(language) };
            format!("#raw(block: true, lang: {language}, {})", quoted(text.trim_end()))
        }
        // On paper nothing unfolds: it stands behind the text.
        Block::Listing { .. } => String::new(),
        // Nothing moves on paper.
        Block::Scene { .. } => String::new(),
        Block::Bibliography(entries) => {
            let mut out = String::new();
            for entry in entries {
                let (text, place) = (inlines(&entry.text)?, place(&format!("ref:{}", entry.key)));
                out.push_str(&format!("#block(inset: (left: 1.5em))[#h(-1.5em);{place}{text}]\n"));
            }
            out
        }
    })
}

/// The listings, which stand behind the text; empty if there are none.
fn listings(blocks: &[Block]) -> Result<String, Error> {
    let mut out = String::new();
    for block in blocks {
        let Block::Listing { id, number, caption, item, file, text } = block else { continue };
        if out.is_empty() {
            out.push_str("\n#heading(numbering: none)[Listings]\n");
        }
        out.push_str(&format!(
            "\n#block(sticky: true)[#set par(justify: false);{}#strong[Listing {number}.] {} #raw({}), from #raw({}).]\n\n\
             #raw(block: true, lang: \"rust\", {})\n",
            place(id),
            inlines(caption)?,
            quoted(item),
            quoted(file),
            quoted(text.trim_end())
        ));
    }
    Ok(out)
}

/// A table with more columns stands across the page.
const MOST_COLUMNS: usize = 6;

/// Always the number of the tree.
fn numbering(number: Option<&str>) -> String {
    number.map_or("none".into(), |number| format!("(..) => {}", quoted(number)))
}

fn table(
    columns: &[Align],
    head: &[Vec<Inline>],
    rows: &[Vec<Vec<Inline>>],
) -> Result<String, Error> {
    let align: String = columns
        .iter()
        .map(|align| match align {
            Align::Left => "left, ",
            Align::Centre => "center, ",
            Align::Right => "right, ",
        })
        .collect();
    let cells = |row: &[Vec<Inline>]| -> Result<String, Error> {
        row.iter().map(|cell| Ok(format!("[{}], ", inlines(cell)?))).collect()
    };
    let mut out = format!(
        "table(columns: {}, align: ({align}), table.header({}),\n",
        columns.len(),
        cells(&head.iter().map(|cell| unlinked(cell)).collect::<Vec<_>>())?
    );
    for row in rows {
        out.push_str(&format!("{}\n", cells(row)?));
    }
    Ok(out + ")")
}

/// A head is repeated on each page, and what is repeated may hold no link.
fn unlinked(cell: &[Inline]) -> Vec<Inline> {
    let one = |inline: &Inline| match inline {
        Inline::Value { shown, .. } | Inline::Link { shown, .. } => shown.clone(),
        Inline::Reference { shown, .. } => vec![Inline::Text(shown.clone())],
        other => vec![other.clone()],
    };
    cell.iter().flat_map(one).collect()
}

fn inlines(list: &[Inline]) -> Result<String, Error> {
    list.iter().map(inline).collect()
}

/// Every piece of code ends with `;`, so that what follows is never taken for its argument.
fn inline(inline: &Inline) -> Result<String, Error> {
    Ok(match inline {
        Inline::Text(text) => format!("#{};", quoted(&text.replace('\'', "’"))),
        Inline::Soft => "\n".into(),
        Inline::Break => "#linebreak();".into(),
        Inline::Code(code) => format!("#raw({});", quoted(code)),
        Inline::Emphasis(inner) => format!("#emph[{}];", inlines(inner)?),
        Inline::Raised(inner) => format!("#super[{}];", inlines(inner)?),
        Inline::Strong(inner) => format!("#strong[{}];", inlines(inner)?),
        Inline::Maths(tex) => {
            let tex = &bare(tex);
            format!("#math.equation(alt: {}, ${}$.body);", quoted(tex), maths::write(tex, false)?)
        }
        Inline::Display { tex, tag } => {
            let tex = &bare(tex);
            let number = tag.as_ref().map(|tag| format!("({tag})"));
            let id = tag.as_ref().map(|tag| format!("eq:{tag}"));
            format!(
                "\n#math.equation(block: true, numbering: {}, alt: {}, $ {} $.body){}\n",
                numbering(number.as_deref()),
                quoted(tex),
                maths::write(tex, true)?,
                labelled(id.as_deref())
            )
        }
        // On paper nothing opens.
        Inline::Value { shown, .. } => inlines(shown)?,
        Inline::Link { to, shown } if to.contains("://") => {
            format!("#link({})[{}];", quoted(to), inlines(shown)?)
        }
        // Files beside the report: the path in words, a PDF travels without them.
        Inline::Link { shown, .. } => inlines(shown)?,
        Inline::Reference { to, within: None, shown } => {
            format!("#link(label({}))[#{};];", quoted(to), quoted(shown))
        }
        // A PDF travels without the other documents.
        Inline::Reference { shown, .. } => format!("#{};", quoted(shown)),
        Inline::Anchor { id, number } => format!("{}#{};", place(id), quoted(number)),
        Inline::Unresolved(ids) => return Err(Error::Reference(ids.join("; "))),
    })
}
