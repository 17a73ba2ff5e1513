//! Writes the tree as a document for LaTeX; what surrounds it is the template report.tex.

use super::document::{self, Block, Formula, Inline, Reference, Table, title};
use super::document::{goes_on, is_abstract, place, to_inlines, to_plain_text, to_spelt_text};
use super::edition::{Document, Edition};
use super::tex;
use pulldown_cmark::Alignment;
use serde_json::{Value as Json, json};

/// Returns what report.tex inserts.
pub fn write(blocks: &[Block], document: Document, edition: &Edition) -> Json {
    let title = title(blocks).unwrap_or_default();
    let authors = edition.authors.iter().map(|(name, of)| [tex::escape(name), tex::escape(of)]);
    json!({
        "letter": document.letter,
        "page": document.page,
        "title": inlines(title),
        "bookmark": bookmark(title),
        "authors": authors.collect::<Vec<_>>(),
        "date": edition.date,
        "body": body(blocks),
        "listings": listings(blocks),
    })
}

fn body(blocks: &[Block]) -> String {
    let mut latex = String::new();
    let (mut before, mut end): (Option<&Block>, _) = (None, "");
    for block in blocks {
        if matches!(block, Block::Heading { .. } | Block::Figure { .. }) {
            latex.push_str(std::mem::take(&mut end));
        }
        if is_abstract(block) {
            latex.push_str("\n\\begin{abstract}\n");
            (before, end) = (None, "\\end{abstract}\n");
            continue;
        }
        // No paragraph begins before an equation, nor after it when the sentence goes on.
        let goes_on = before.is_some_and(|before| goes_on(before, block));
        latex.push_str(if latex.is_empty() || goes_on { "" } else { "\n" });
        let written = write_block(block);
        if !written.is_empty() {
            latex = latex + written.trim_matches('\n') + "\n";
        }
        before = Some(block);
    }
    latex + end
}

fn listings(blocks: &[Block]) -> String {
    let listing = |block: &Block| {
        let Block::Listing { id, number, caption, item, file, code, .. } = block else {
            return None;
        };
        let (item, file) = (breakable(&tex::escape(item)), breakable(&tex::escape(file)));
        Some(format!(
            "\n\\begin{{samepage}}\n\\noindent{}\\textbf{{Listing {number}.}} {} \
             \\texttt{{{item}}}, from \\texttt{{{file}}}.\n\\end{{samepage}}\n\
             {{\\scriptsize\\begin{{alltt}}\n{}\n\\end{{alltt}}}}\n",
            label(id),
            inlines(caption),
            tex::escape_code(code.trim_end())
        ))
    };
    blocks.iter().filter_map(listing).collect()
}

fn write_block(block: &Block) -> String {
    match block {
        // The template has the title.
        Block::Heading { level: 1, .. } => String::new(),
        Block::Heading { level, number, id, text } => {
            let command = if *level == 2 { "section" } else { "subsection" };
            let label = id.as_deref().map(|id| format!("\\label{{{id}}}")).unwrap_or_default();
            let (mut words, bookmark) = (inlines(text), bookmark(text));
            if words != bookmark {
                words = format!("\\texorpdfstring{{{words}}}{{{bookmark}}}");
            }
            match number {
                Some(_) => format!("\\{command}{{{words}}}{label}"),
                None => format!(
                    "\\phantomsection{label}\\{command}*{{{words}}}\n\
                     \\addcontentsline{{toc}}{{{command}}}{{{words}}}"
                ),
            }
        }
        Block::Paragraph(text) => inlines(text).trim_end().to_string(),
        Block::Figure { id, number, files: [_, file], caption, .. } => format!(
            "\\begin{{figure}}[htbp]\n\\centering\n\
             \\includegraphics[width=0.8\\linewidth,height=0.62\\textheight,keepaspectratio]{{figures/{file}}}\n\
             \\renewcommand{{\\thefigure}}{{{number}}}\n\\caption{{{}}}\\label{{{id}}}\n\\end{{figure}}",
            inlines(caption)
        ),
        Block::Table(data) => table(data),
        Block::List { start, items } => {
            let kind = if start.is_some() { "enumerate" } else { "itemize" };
            let mut latex = format!("\\begin{{{kind}}}\n");
            if let Some(start) = start.filter(|start| *start != 1) {
                let before = start.saturating_sub(1);
                let counter = r"\csname @enumctr\endcsname";
                latex.push_str(&format!("\\setcounter{{{counter}}}{{{before}}}\n"));
            }
            for item in items {
                latex.push_str(&format!("\\item {}\n", separated(body(item).trim_end())));
            }
            format!("{latex}\\end{{{kind}}}")
        }
        Block::Quote(blocks) => format!("\\begin{{quote}}\n{}\\end{{quote}}", body(blocks)),
        Block::Code { code, .. } => {
            let code = tex::escape_code(code.trim_end());
            format!("{{\\small\\begin{{alltt}}\n{code}\n\\end{{alltt}}}}")
        }
        // Listings stand after the text, and paper runs nothing.
        Block::Listing { .. } | Block::Lab { .. } => String::new(),
        Block::Bibliography(entries) => {
            let item = |entry: &Reference| {
                let place = label(&format!("ref:{}", entry.key));
                format!("\\item {place}{}\n", inlines(&entry.to_inlines()))
            };
            // Second lines are indented.
            let list = r"\begin{list}{}{\leftmargin=1.5em\itemindent=-1.5em\itemsep=0.3ex}";
            format!("{list}\n{}\\end{{list}}", entries.iter().map(item).collect::<String>())
        }
    }
}

/// Returns words as bookmarks of a PDF show them: ASCII without markup.
fn bookmark(text: &[Inline]) -> String {
    let ascii = |c: char| match c {
        '–' => "-".into(),
        '\u{a0}' => " ".into(),
        c if c.is_ascii() => c.to_string(),
        c => tex::letter_name(c).unwrap_or_default().into(),
    };
    tex::escape(&to_spelt_text(text).chars().map(ascii).collect::<String>())
}

/// A place that `\hyperref[…]` finds.
fn label(id: &str) -> String {
    format!("\\phantomsection\\label{{{}}}", place(id))
}

pub fn inlines(list: &[Inline]) -> String {
    let mut latex = String::new();
    for (i, piece) in list.iter().enumerate() {
        // A blank line around an equation would begin a paragraph.
        let is_display = |j: usize| matches!(list.get(j), Some(Inline::Display { .. }));
        if *piece == Inline::Soft && (is_display(i + 1) || i > 0 && is_display(i - 1)) {
            continue;
        }
        latex.push_str(&inline(piece));
    }
    latex
}

/// Separates a bracket or a star from `\\` or `\item`, which would take it as an argument.
fn separated(text: &str) -> String {
    let taken = text.starts_with(['[', '*']);
    if taken { format!("{{}}{text}") } else { text.to_string() }
}

fn inline(inline: &Inline) -> String {
    match inline {
        Inline::Text(text) => tex::escape(text),
        Inline::Soft => "\n".into(),
        Inline::Code(code) => {
            // Two hyphens in a row are set as a dash.
            let code = tex::escape(code).replace("--", "-{}-");
            format!("\\texttt{{{}}}", breakable(&code))
        }
        Inline::Emphasis(inner) => format!("\\emph{{{}}}", inlines(inner)),
        Inline::Raised(inner) => format!("\\textsuperscript{{{}}}", inlines(inner)),
        Inline::Strong(inner) => format!("\\textbf{{{}}}", inlines(inner)),
        Inline::Maths(formula) => format!("${}$", formula_to_latex(formula)),
        Inline::Display { formula, id, number } => {
            let maths = formula_to_latex(formula);
            match id {
                Some(id) => format!(
                    "\n\\begin{{equation}}\n{maths}\n\\tag{{{number}}}\\label{{{id}}}\n\\end{{equation}}\n"
                ),
                None => format!("\n\\begin{{equation*}}\n{maths}\n\\end{{equation*}}\n"),
            }
        }
        Inline::Value { id, printed } => tex::origin_link(id, &inlines(&to_inlines(printed))),
        Inline::Link { to, words } if to.contains("://") => {
            let mut words = inlines(words);
            if words.starts_with("http") {
                words = breakable(&words).replace('(', "\\allowbreak(");
            }
            let to = document::address(to).replace('%', r"\%").replace('#', r"\#");
            format!("\\href{{{}}}{{{words}}}", to.replace('&', r"\&"))
        }
        // A PDF is read without the files of the report, so only the words are shown.
        Inline::Link { words, .. } => inlines(words),
        Inline::Reference { to, within: None, label: words } => {
            format!("\\hyperref[{}]{{{}}}", place(to), tex::escape(words))
        }
        Inline::Reference { label, .. } => tex::escape(label),
        Inline::Anchor { id, number } => format!("{}{number}", label(id)),
        Inline::Unresolved { ids, .. } => tex::escape(&ids.join("; ")),
    }
}

fn formula_to_latex(formula: &Formula) -> String {
    tex::escape_formula(&formula.to_tex_with(|id, printed| tex::origin_link(id, &printed.to_tex())))
}

/// Allows long paths in code to break after `::`, `/`, `\_`, `,` and `]`, and before `[`.
fn breakable(code: &str) -> String {
    code.replace("::", "::\\allowbreak{}")
        .replace('/', "/\\allowbreak{}")
        .replace(r"\_", r"\_\allowbreak{}")
        .replace(',', r",\allowbreak{}")
        .replace('[', r"\allowbreak{}[")
        .replace(']', r"]\allowbreak{}")
}

/// Characters of a table in a line of the page, of one on its side, and there in small letters.
const LINES: [usize; 3] = [LINE, LINE * 3 / 2, LINE * 2];
const LINE: usize = 92;

/// A table whose longest cells have more characters than this together is turned on its side.
const ACROSS: usize = 4 * LINE;

/// A column that never wraps is at most this wide.
const SHORT: usize = 12;

/// The two gaps of a column, 6 pt each, in characters of which 455 pt hold [`LINE`].
const GAPS: f64 = 0.027 * LINE as f64;

struct Column {
    letter: &'static str,
    width: usize,
    /// How narrow it can be: a short one does not wrap, a long one keeps its longest word whole.
    least: usize,
}

fn columns(table: &Table) -> Vec<Column> {
    let column = |(i, align): (usize, &Alignment)| {
        let rows = table.rows.iter().chain([&table.head]);
        let cells: Vec<String> = rows.map(|row| to_plain_text(&row[i])).collect();
        let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0).max(3);
        let words = cells.iter().flat_map(|cell| cell.split_whitespace());
        let word = words.map(|word| word.chars().count()).max().unwrap_or(0).min(24);
        let letter = match align {
            Alignment::Left | Alignment::None => "l",
            Alignment::Center => "c",
            Alignment::Right => "r",
        };
        Column { letter, width, least: if width <= SHORT { width } else { word + 1 } }
    };
    table.columns.iter().enumerate().map(column).collect()
}

/// Returns in which of the lines a table fits with gaps that may be halved, or `None` if in none.
pub fn line_of(table: &Table) -> Option<usize> {
    let columns = columns(table);
    let first = usize::from(total(&columns) > ACROSS);
    (first..LINES.len()).find(|line| least(&columns, 0.5) <= LINES[*line] as f64)
}

fn total(columns: &[Column]) -> usize {
    columns.iter().map(|column| column.width + 2).sum()
}

/// Returns how narrow columns can be together, with a share of the usual gaps.
fn least(columns: &[Column], gap: f64) -> f64 {
    let least: usize = columns.iter().map(|column| column.least).sum();
    least as f64 + gap * GAPS * columns.len() as f64
}

fn table(table: &Table) -> String {
    let (columns, place) = (columns(table), line_of(table).unwrap_or(LINES.len() - 1));
    let (across, small, line) = (place > 0, place > 1, LINES[place] as f64);
    let wraps = total(&columns) as f64 > line;
    let layout = if wraps {
        shared_layout(&columns, line)
    } else {
        columns.iter().map(|column| column.letter).collect()
    };
    let row = |cells: &[Vec<Inline>]| {
        let cells: Vec<String> = cells.iter().map(|cell| inlines(cell)).collect();
        format!("{} \\\\\n", separated(&cells.join(" & ").replace('\n', " ")))
    };
    let mut latex = String::from(if across { "\\begin{landscape}\n" } else { "" });
    let size = if small { "tiny" } else { "footnotesize" };
    let is_tight = least(&columns, 1.0) > line;
    let gap = if is_tight { "\\setlength{\\tabcolsep}{3pt}\n" } else { "" };
    latex.push_str(&format!("{{\\{size}\n{gap}\\begin{{longtable}}{{{layout}}}\n"));
    if table.number.is_some() {
        let label = table.id.as_ref().map(|id| format!("\\label{{{id}}}")).unwrap_or_default();
        latex.push_str(&format!("\\caption{{{}}}{label}\\\\\n", inlines(&table.caption)));
    }
    let head = row(&table.head);
    for end in ["\\endfirsthead\n", "\\endhead\n\\bottomrule\n\\endlastfoot\n"] {
        latex.push_str(&format!("\\toprule\n{head}\\midrule\n{end}"));
    }
    for cells in &table.rows {
        latex.push_str(&row(cells));
        latex.push_str(if wraps { "\\addlinespace[2pt]\n" } else { "" });
    }
    latex.push_str("\\end{longtable}}");
    latex + if across { "\n\\end{landscape}" } else { "" }
}

/// Lays out columns that do not all fit: short ones keep their width, and the long ones share what
/// is free beyond their longest words, by the square roots of their widths.
fn shared_layout(columns: &[Column], line: f64) -> String {
    let free = (line - least(columns, 1.0)).max(0.0);
    let long = columns.iter().filter(|column| column.width > SHORT);
    let weights: f64 = long.map(|column| (column.width as f64).sqrt()).sum();
    let column = |Column { letter, width, least }: &Column| {
        if *width <= SHORT {
            return letter.to_string();
        }
        let share = (*least as f64 + free * (*width as f64).sqrt() / weights) / line;
        format!(">{{\\raggedright\\arraybackslash}}p{{{share:.3}\\linewidth}}")
    };
    columns.iter().map(column).collect()
}
