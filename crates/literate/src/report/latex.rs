//! Writes the tree as a document for LaTeX; what surrounds it is the template report.tex.

use super::document::{Block, Formula, Inline, title};
use super::document::{continues, is_abstract, is_equation, plain, printed, spelt};
use super::edition::Document;
use super::error::{Error, unresolved};
use super::tex;
use pulldown_cmark::Alignment;
use serde_json::{Value as Json, json};

/// Returns what the template report.tex inserts.
pub fn write(blocks: &[Block], document: Document) -> Result<Json, Error> {
    let title = title(blocks)?;
    Ok(json!({
        "letter": document.letter,
        "page": document.page,
        "title": inlines(title)?,
        "bookmark": bookmark(title)?,
        "body": body(blocks)?,
        "listings": listings(blocks)?,
    }))
}

fn body(blocks: &[Block]) -> Result<String, Error> {
    let (mut out, mut errors) = (String::new(), Vec::new());
    let (mut before, mut end): (Option<&Block>, _) = (None, "");
    for block in blocks {
        if matches!(block, Block::Heading { .. }) {
            out.push_str(std::mem::take(&mut end));
        }
        if is_abstract(block) {
            out.push_str("\n\\begin{abstract}\n");
            (before, end) = (None, "\\end{abstract}\n");
            continue;
        }
        // An equation belongs to the sentence around it: no paragraph begins before it, nor after
        // it when the sentence goes on.
        let goes_on = before.is_some_and(|before| {
            matches!(before, Block::Paragraph(_)) && is_equation(block)
                || is_equation(before) && continues(block)
        });
        out.push_str(if out.is_empty() || goes_on { "" } else { "\n" });
        match write_block(block) {
            Ok(text) if text.is_empty() => (),
            Ok(text) => out = out + text.trim_matches('\n') + "\n",
            Err(error) => errors.push(error),
        }
        before = Some(block);
    }
    Error::all(errors)?;
    Ok(out + end)
}

fn listings(blocks: &[Block]) -> Result<String, Error> {
    let mut out = String::new();
    for block in blocks {
        let Block::Listing { id, number, caption, item, file, text, .. } = block else { continue };
        if out.is_empty() {
            out.push_str(LISTINGS);
        }
        let (item, file) = (breakable(&tex::text(item)?), breakable(&tex::text(file)?));
        out.push_str(&format!(
            "\n\\begin{{samepage}}\n\\noindent{}\\textbf{{Listing {number}.}} {} \
             \\texttt{{{item}}}, from \\texttt{{{file}}}.\n\\end{{samepage}}\n\
             {{\\scriptsize\\begin{{alltt}}\n{}\n\\end{{alltt}}}}\n",
            label(id),
            inlines(caption)?,
            tex::code(text.trim_end())?
        ));
    }
    Ok(out)
}

const LISTINGS: &str = "\\clearpage\n\\phantomsection\\section*{Listings}\n\
                        \\addcontentsline{toc}{section}{Listings}\n";

fn write_block(block: &Block) -> Result<String, Error> {
    Ok(match block {
        // The template has the title.
        Block::Heading { level: 1, .. } => String::new(),
        Block::Heading { level, number, id, text } => {
            let command = ["section", "subsection", "subsubsection"];
            let command = command.get(usize::from(*level) - 2).unwrap_or(&"paragraph");
            let label = id.as_deref().map(|id| format!("\\label{{{id}}}")).unwrap_or_default();
            let mut words = inlines(text)?;
            if words != bookmark(text)? {
                words = format!("\\texorpdfstring{{{words}}}{{{}}}", bookmark(text)?);
            }
            match number {
                Some(_) => format!("\\{command}{{{words}}}{label}"),
                None => format!(
                    "\\phantomsection{label}\\{command}*{{{words}}}\n\
                     \\addcontentsline{{toc}}{{{command}}}{{{words}}}"
                ),
            }
        }
        Block::Paragraph(text) => inlines(text)?.trim_end().to_string(),
        Block::Figure { id, number, files: [_, file], caption, .. } => format!(
            "\\begin{{figure}}[htbp]\n\\centering\n\
             \\includegraphics[width=0.8\\linewidth,height=0.62\\textheight,keepaspectratio]{{figures/{file}}}\n\
             \\renewcommand{{\\thefigure}}{{{number}}}\n\\caption{{{}}}\\label{{{id}}}\n\\end{{figure}}",
            inlines(caption)?
        ),
        Block::Table { id, number, caption, columns, head, rows } => {
            table(id.as_deref(), number.is_some(), caption, columns, head, rows)?
        }
        Block::List { start, items } => {
            let kind = if start.is_some() { "enumerate" } else { "itemize" };
            let mut out = format!("\\begin{{{kind}}}\n");
            if let Some(start) = start.filter(|start| *start != 1) {
                out.push_str(&format!("\\setcounter{{enumi}}{{{}}}\n", start.saturating_sub(1)));
            }
            for item in items {
                out.push_str(&format!("\\item {}\n", separated(body(item)?.trim_end())));
            }
            format!("{out}\\end{{{kind}}}")
        }
        Block::Quote(blocks) => format!("\\begin{{quote}}\n{}\\end{{quote}}", body(blocks)?),
        Block::Code { text, .. } => {
            format!("{{\\small\\begin{{alltt}}\n{}\n\\end{{alltt}}}}", tex::code(text.trim_end())?)
        }
        // Listings stand after the text, and paper runs nothing.
        Block::Listing { .. } | Block::Lab { .. } => String::new(),
        Block::Bibliography(entries) => {
            let mut out = String::from(HANGING);
            for entry in entries {
                let text = inlines(&entry.text())?;
                let name = label(&format!("ref:{}", entry.key));
                out.push_str(&format!("\\item {name}{text}\n"));
            }
            out + "\\end{list}"
        }
    })
}

/// Words as bookmarks of a PDF show them: ASCII without markup.
fn bookmark(text: &[Inline]) -> Result<String, Error> {
    let mut words = String::new();
    for c in spelt(text).chars() {
        match c {
            '–' => words.push('-'),
            '\u{a0}' => words.push(' '),
            c if c.is_ascii() => words.push(c),
            c => words += tex::letter(c).unwrap_or_default(),
        }
    }
    tex::text(&words)
}

/// The list of references: its second lines are indented.
const HANGING: &str = "\\begin{list}{}{\\leftmargin=1.5em\\itemindent=-1.5em\\itemsep=0.3ex}\n";

/// A place that `\hyperref[…]` finds.
fn label(id: &str) -> String {
    format!("\\phantomsection\\label{{{}}}", place(id))
}

/// An id without signs that TeX would read, which a key of references.bib may have.
fn place(id: &str) -> String {
    let mut place = String::new();
    for c in id.chars() {
        match c {
            c if c.is_ascii_alphanumeric() || ":-_.".contains(c) => place.push(c),
            c => place += &format!("-{:x}", u32::from(c)),
        }
    }
    place
}

/// Running text.
pub fn inlines(list: &[Inline]) -> Result<String, Error> {
    let mut out = String::new();
    for (i, piece) in list.iter().enumerate() {
        // A blank line around an equation would begin a paragraph.
        let is_display = |j: usize| matches!(list.get(j), Some(Inline::Display { .. }));
        if *piece == Inline::Soft && (is_display(i + 1) || i > 0 && is_display(i - 1)) {
            continue;
        }
        out.push_str(&inline(piece)?);
    }
    Ok(out)
}

/// Separates a bracket or a star from `\\` or `\item`, which would take it as an argument.
fn separated(text: &str) -> String {
    let taken = text.starts_with(['[', '*']);
    if taken { format!("{{}}{text}") } else { text.to_string() }
}

fn inline(inline: &Inline) -> Result<String, Error> {
    Ok(match inline {
        Inline::Text(text) => tex::text(text)?,
        Inline::Soft => "\n".into(),
        Inline::Code(code) => {
            // Two hyphens in a row are set as a dash.
            let code = tex::text(code)?.replace("--", "-{}-");
            format!("\\texttt{{{}}}", breakable(&code))
        }
        Inline::Emphasis(inner) => format!("\\emph{{{}}}", inlines(inner)?),
        Inline::Raised(inner) => format!("\\textsuperscript{{{}}}", inlines(inner)?),
        Inline::Strong(inner) => format!("\\textbf{{{}}}", inlines(inner)?),
        Inline::Maths(formula) => format!("${}$", maths(formula)?),
        Inline::Display { formula, id, number } => {
            let maths = maths(formula)?;
            match id {
                Some(id) => format!(
                    "\n\\begin{{equation}}\n{maths}\n\\tag{{{number}}}\\label{{{id}}}\n\\end{{equation}}\n"
                ),
                None => format!("\n\\begin{{equation*}}\n{maths}\n\\end{{equation*}}\n"),
            }
        }
        Inline::Value { id, shown } => tex::value(id, &inlines(&printed(shown))?),
        Inline::Link { to, shown } if to.contains("://") => {
            let shown = inlines(shown)?;
            let bare = shown.starts_with("http");
            let shown = if bare { breakable(&shown).replace('(', "\\allowbreak(") } else { shown };
            format!("\\href{{{}}}{{{}}}", address(to), shown)
        }
        // A PDF is read without the files of the report, so only the words are shown.
        Inline::Link { shown, .. } => inlines(shown)?,
        Inline::Reference { to, within: None, shown } => {
            format!("\\hyperref[{}]{{{}}}", place(to), tex::text(shown)?)
        }
        // A PDF is read without the other documents.
        Inline::Reference { shown, .. } => tex::text(shown)?,
        Inline::Anchor { id, number } => format!("{}{number}", label(id)),
        Inline::Unresolved { ids, .. } => return Err(unresolved(ids)),
    })
}

fn maths(formula: &Formula) -> Result<String, Error> {
    tex::maths(&formula.tex(|id, shown| tex::value(id, &shown.tex())))
}

/// Long paths and addresses in code may break after `::`, `/`, `\_`, `,` and `]`, and before `[`.
fn breakable(code: &str) -> String {
    code.replace("::", "::\\allowbreak{}")
        .replace('/', "/\\allowbreak{}")
        .replace(r"\_", r"\_\allowbreak{}")
        .replace(',', r",\allowbreak{}")
        .replace('[', r"\allowbreak{}[")
        .replace(']', r"]\allowbreak{}")
}

fn address(to: &str) -> String {
    to.replace('\\', "").replace('%', r"\%").replace('#', r"\#").replace('&', r"\&")
}

/// Characters that fit into a line of the page in the size of tables.
const LINE: usize = 92;

/// A table whose longest cells have more characters than this together is turned on its side.
const ACROSS: usize = 4 * LINE;

fn table(
    id: Option<&str>,
    captioned: bool,
    caption: &[Inline],
    columns: &[Alignment],
    head: &[Vec<Inline>],
    rows: &[Vec<Vec<Inline>>],
) -> Result<String, Error> {
    let largest = |measure: fn(&str) -> usize| -> Vec<usize> {
        let column = |i: usize| {
            let cells = rows.iter().map(Vec::as_slice).chain([head]).filter_map(|row| row.get(i));
            cells.map(|cell| measure(&plain(cell))).max().unwrap_or(0)
        };
        (0..columns.len()).map(column).collect()
    };
    let widths = largest(|cell| cell.chars().count().max(3));
    let words = largest(|cell| {
        cell.split_whitespace().map(|word| word.chars().count()).max().unwrap_or(0).min(24)
    });
    let total: usize = widths.iter().map(|w| w + 2).sum();
    let least: usize = (0..columns.len()).map(|i| least_width(widths[i], words[i])).sum();
    let gaps = GAPS * columns.len() as f64;
    let fits = |gaps: f64| total <= ACROSS && least as f64 + gaps <= LINE as f64;
    // Gaps are halved before a table is turned on its side.
    let (tight, across) = (!fits(gaps) && fits(0.5 * gaps), !fits(0.5 * gaps));
    let line = if across { LINE * 3 / 2 } else { LINE };
    let row = |cells: &[Vec<Inline>]| -> Result<String, Error> {
        let cells: Vec<String> =
            cells.iter().map(|cell| inlines(cell)).collect::<Result<_, _>>()?;
        Ok(format!("{} \\\\\n", separated(&cells.join(" & ").replace('\n', " "))))
    };
    let mut out = String::from(if across { "\\begin{landscape}\n" } else { "" });
    let layout = layout(columns, &widths, &words, line);
    let gap = if tight { "\\setlength{\\tabcolsep}{3pt}\n" } else { "" };
    out.push_str(&format!("{{\\footnotesize\n{gap}\\begin{{longtable}}{{{layout}}}\n"));
    if captioned {
        let label = id.map(|id| format!("\\label{{{id}}}")).unwrap_or_default();
        out.push_str(&format!("\\caption{{{}}}{label}\\\\\n", inlines(caption)?));
    }
    let head = row(head)?;
    out.push_str(&format!("\\toprule\n{head}\\midrule\n\\endfirsthead\n"));
    out.push_str(&format!("\\toprule\n{head}\\midrule\n\\endhead\n\\bottomrule\n\\endlastfoot\n"));
    // Rows of several lines get a space between them.
    let wraps = total > line;
    for cells in rows {
        out.push_str(&row(cells)?);
        out.push_str(if wraps { "\\addlinespace[2pt]\n" } else { "" });
    }
    out.push_str("\\end{longtable}}");
    Ok(out + if across { "\n\\end{landscape}" } else { "" })
}

/// A column that never wraps is at most this wide.
const SHORT: usize = 12;

/// The two gaps of a column, 6 pt each, in characters of which 455 pt hold [`LINE`].
const GAPS: f64 = 0.027 * LINE as f64;

/// How narrow a column can be: a short one does not wrap, a long one keeps its longest word whole.
fn least_width(width: usize, longest_word: usize) -> usize {
    if width <= SHORT { width } else { longest_word + 1 }
}

/// Lays out columns as wide as their words while all fit; else long ones are at least as wide as
/// their longest words and share the rest.
fn layout(columns: &[Alignment], widths: &[usize], words: &[usize], line: usize) -> String {
    let letter = |align: &Alignment| match align {
        Alignment::Left | Alignment::None => "l",
        Alignment::Center => "c",
        Alignment::Right => "r",
    };
    if widths.iter().map(|w| w + 2).sum::<usize>() <= line {
        return columns.iter().map(letter).collect();
    }
    let short = |i: &usize| widths[*i] <= SHORT;
    let least: usize = (0..columns.len()).map(|i| least_width(widths[i], words[i])).sum();
    let free = (line as f64 - GAPS * columns.len() as f64 - least as f64).max(0.0);
    // Long cells wrap: the square root keeps a very long one from starving the others.
    let weight = |i: usize| (widths[i] as f64).sqrt();
    let weights: f64 = (0..columns.len()).filter(|i| !short(i)).map(weight).sum();
    let share = |i: usize| {
        (least_width(widths[i], words[i]) as f64 + free * weight(i) / weights) / line as f64
    };
    let column = |(i, align): (usize, &Alignment)| {
        if short(&i) {
            return letter(align).to_string();
        }
        format!(">{{\\raggedright\\arraybackslash}}p{{{:.3}\\linewidth}}", share(i))
    };
    columns.iter().enumerate().map(column).collect()
}
