//! Fills the templates by Tera: values become marks (`mark`), which the parser replaces by digits.
//! The manual ([`crate::manual`]) lists what a template may write.

use super::edition::Document;
use super::error::Error;
use super::filled::Filled;
use super::lint::Declared;
use super::mark::{self, Piece, marked, pieces};
use super::values::{Number, Registry, Value};
use crate::decimal::MAX_DIGITS;
use crate::input::{line_and_column, plain};
use crate::prose::Templates;
use crate::table::{Table, nearest};
use serde_json::Value as Json;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, OnceLock};
use tera::{Context, Delimiters, ErrorKind, Kwargs, State, Tera};

/// Tera, set up with the templates, and the names that they may use.
#[derive(Clone, Debug)]
pub struct Filler {
    tera: Tera,
    templates: Templates,
    /// Phrases with numbers that the prose may have.
    pub declared: Declared,
    context: Context,
    /// Ids of the values and cells that have no number.
    empty: Arc<OnceLock<BTreeSet<String>>>,
    /// Values and tables, as the context has them.
    names: Json,
}

impl Filler {
    /// Sets Tera up with all `.md`, `.tex` and `.html` files, without values yet.
    pub fn new(templates: &Templates) -> Result<Self, Error> {
        let mut tera = Tera::new();
        let delimiters = Delimiters {
            block_start: "<%".into(),
            block_end: "%>".into(),
            variable_start: "«".into(),
            variable_end: "»".into(),
            comment_start: "<#".into(),
            comment_end: "#>".into(),
        };
        let set = tera.set_delimiters(delimiters);
        tera.autoescape_on(Vec::<&str>::new());
        let empty = Arc::default();
        register(&mut tera, &empty);
        let declared = Declared::read(templates.text("literals.toml")?)
            .map_err(|error| Error::Template(templates.place(&error.to_string())))?;
        let (context, names) = (Context::new(), Json::Null);
        let templates = templates.clone();
        let mut filler = Filler { tera, templates, declared, context, empty, names };
        set.map_err(|error| filler.failure(&error))?;
        let sources: Vec<(String, String)> = filler.templates.iter().filter_map(source).collect();
        filler.tera.add_raw_templates(sources).map_err(|error| filler.failure(&error))?;
        Ok(filler)
    }

    /// Adds values: `v.name` and `group.name` are marks, `raw.name` and `raw.group.name` plain
    /// numbers. Cells of tables are `table["row"].column`, their keys `keys.table.key` and
    /// `keys.table.rows`.
    pub fn with(mut self, values: &Registry) -> Self {
        // Tables for figures alone are long, and no template needs them.
        let named =
            |table: &&Table| self.templates.iter().any(|(_, text)| text.contains(table.name()));
        let (mut marks, mut numbers, mut keys) = (Json::Null, Json::Null, Json::Null);
        let cells = values.tables().filter(named).flat_map(Table::cells);
        let empty = values.iter().chain(cells).filter(|value| value.number == Number::None);
        let _ = self.empty.set(empty.map(|value| value.id.clone()).collect());
        for value in values.iter() {
            let name = &value.id;
            let group = if name.contains('.') { "" } else { "v." };
            put(&mut marks, &format!("{group}{name}"), as_mark(value));
            put(&mut numbers, name, raw(value));
        }
        for table in values.tables().filter(named) {
            let rows = |cell_json: fn(&Value) -> Json| {
                let row = |cells: BTreeMap<&str, &Value>| {
                    cells
                        .into_iter()
                        .map(|(column, cell)| (column.to_string(), cell_json(cell)))
                        .collect()
                };
                let mut rows: BTreeMap<String, Json> =
                    table.named().into_iter().map(|(name, cells)| (name, row(cells))).collect();
                // A table of one row without keys is that row.
                rows.remove("").unwrap_or_else(|| rows.into_iter().collect())
            };
            put(&mut marks, table.name(), rows(as_mark));
            put(&mut numbers, table.name(), rows(raw));
            put(&mut keys, &format!("{}.rows", table.name()), table.rows().collect());
            for key in table.keys() {
                put(&mut keys, &format!("{}.{key}", table.name()), table.called(key).into());
            }
        }
        (marks["raw"], marks["keys"]) = (numbers, keys);
        for (group, names) in marks.as_object().into_iter().flatten() {
            self.context.insert(group.clone(), names);
        }
        self.names = marks;
        self
    }

    /// Adds a name that is no value: the rows of the claims, the list of figures.
    pub fn insert<T: serde::Serialize>(&mut self, name: &'static str, rows: &T) {
        self.context.insert(name, rows);
    }

    /// Fills one template that is no prose.
    pub fn fill(&self, path: &str) -> Result<String, Error> {
        self.tera.render(path, &self.context).map_err(|error| self.failure(&error))
    }

    /// Fills the prose of a document, and keeps where each piece of it stands.
    pub fn prose(&self, document: &Document) -> Result<Filled, Error> {
        let files = document.files(&self.templates);
        if files.is_empty() {
            let what = "no such file in the templates; write the document";
            return Err(Error::Template(format!("{}.md: {what}", document.prose)));
        }
        let mut filled = Filled::default();
        for path in files {
            let text = self.templates.text(path)?;
            self.conditions(path, text)?;
            filled.add(&self.templates.place(path), text, &self.fill(path)?);
        }
        Ok(filled)
    }

    /// Checks the names of numbers in conditions, since Tera takes an unknown name for *false*, and
    /// that no plain number is shown.
    fn conditions(&self, path: &str, text: &str) -> Result<(), Error> {
        let fault = |at, what: String| {
            let place = line_and_column(text, at);
            Err(Error::Template(self.templates.place(&format!("{path}:{place}: {what}"))))
        };
        for (at, _) in text.match_indices('«') {
            let inside = text[at..].trim_start_matches(['«', '-', ' ']);
            if let Some(rest) = inside.strip_prefix("raw.") {
                let end = steps(rest).last().map_or(0, |step| step.end);
                let (name, group) =
                    (&rest[..end], if rest[..end].contains('.') { "" } else { "v." });
                let what = "is a plain number, for conditions";
                let what = format!("raw.{name} {what}; write «{group}{name}» to show it");
                return fault(text.len() - inside.len(), what);
            }
        }
        let uses = |group| text.match_indices(group).map(|(at, _)| at);
        for at in uses("raw.").chain(uses("keys.")) {
            let begins = !text[..at].ends_with(|c: char| c.is_alphanumeric() || "._".contains(c));
            if let Some(what) = self.missing(&text[at..]).filter(|_| begins) {
                return fault(at, what);
            }
        }
        Ok(())
    }

    /// Returns which part of a name, `table["row"].column`, does not exist, with the nearest that
    /// does; none if the name is right or names no value. A computed row may be any row.
    fn missing(&self, expression: &str) -> Option<String> {
        let mut here = &self.names;
        for (at, Step { key, is_row, end }) in steps(expression).into_iter().enumerate() {
            let names = here.as_object()?;
            match key.map_or(names.values().next(), |key| names.get(key)) {
                Some(next) => here = next,
                // A name of Tera, as a variable of a loop.
                None if at == 0 => return None,
                None => {
                    let key = key.filter(|key| !key.is_empty())?;
                    let (whole, kind) = (&expression[..end], if is_row { "row" } else { "name" });
                    let nearest = nearest(key, names.keys().map(String::as_str)).join(", ");
                    return Some(format!("{whole}: there is no such {kind}; nearest: {nearest}"));
                }
            }
        }
        None
    }

    /// Lists the plain numbers that an expression names: `raw.a is 0.12, raw.b is 0.11`.
    fn numbers(&self, expression: &str) -> String {
        let mut found = Vec::new();
        for (at, _) in expression.match_indices("raw.") {
            let steps = steps(&expression[at..]);
            let Some(Step { end, .. }) = steps.last() else { continue };
            let number = steps.iter().try_fold(&self.names, |here, step| here.get(step.key?));
            if let Some(number) = number {
                found.push(format!("{} is {number}", &expression[at..at + end]));
            }
        }
        found.join(", ")
    }

    /// An error of Tera in one line: file, line, column, what is wrong.
    fn failure(&self, error: &tera::Error) -> Error {
        let (ErrorKind::RenderingError(report) | ErrorKind::SyntaxError(report)) = error.kind()
        else {
            // For unknown filters and functions Tera writes a message, an arrow to the place, and
            // the line.
            let message = error.to_string();
            let what = message.split(" --> ").next().unwrap_or_default().replace("error: ", "");
            let place = message.split("--> ").nth(1).and_then(|rest| rest.lines().next());
            let place = place.map(|place| self.templates.place(&format!("{place}: ")));
            let place = place.unwrap_or_default();
            return Error::Template(format!("{place}{}", what.trim()));
        };
        let path = report.filename();
        let text = self.templates.text(path).unwrap_or_default();
        let (line, column) = (report.span().start_line, report.span().start_col);
        // The columns are those of the text with its place marks.
        let begun = text.split_inclusive('\n').take(line - 1).map(str::len).sum::<usize>();
        let marked = if path.ends_with(".md") { marked(text) } else { text.into() };
        let before = marked.lines().nth(line - 1).unwrap_or_default().chars().take(column);
        let typed = |piece| match piece {
            Piece::Text(text) => text.len(),
            Piece::Value { .. } => 0,
        };
        let at = begun + pieces(&before.collect::<String>()).into_iter().map(typed).sum::<usize>();
        let place = line_and_column(text, at);
        let tag = text.get(..at).and_then(|before| before.rfind('«')).unwrap_or(at);
        let inside = text[tag..].trim_start_matches(['«', '-', ' ']);
        let (inside, closed) = match inside.find(['«', '»', '\n']) {
            Some(end) => (&inside[..end], inside[end..].starts_with('»')),
            None => (inside, false),
        };
        if text[tag..].starts_with('«') && !closed {
            let place = line_and_column(text, tag);
            let what = "this « has no » on its line; close it";
            return Error::Template(self.templates.place(&format!("{path}:{place}: {what}")));
        }
        let what = self.missing(inside).unwrap_or_else(|| {
            if report.message().contains(NOT_TRUE) {
                return format!(
                    "{NOT_TRUE}: {inside}, where {}; correct the sentence",
                    self.numbers(inside)
                );
            }
            let what =
                plain(report.message().split(" Available fields: ").next().unwrap_or_default());
            // Tera names its usual signs.
            let ours = |what: String, (theirs, ours): &(&str, &str)| what.replace(theirs, ours);
            [("%}", "%>"), ("{%", "<%"), ("}}", "»"), ("{{", "«")].iter().fold(what, ours)
        });
        Error::Template(self.templates.place(&format!("{path}:{place}: {what}")))
    }
}

/// A part of a name: `table`, `["row"]`, `.column`.
struct Step<'a> {
    /// None of a row that is computed.
    key: Option<&'a str>,
    is_row: bool,
    /// Where it ends in the expression.
    end: usize,
}

/// Reads the parts of the name with which an expression begins.
fn steps(expression: &str) -> Vec<Step<'_>> {
    let (mut steps, mut rest) = (Vec::new(), expression);
    loop {
        let (key, is_row, after) = if let Some(inner) = rest.strip_prefix('[') {
            let Some((key, after)) = inner.split_once(']') else { return steps };
            let quoted = key.strip_prefix('"').and_then(|key| key.strip_suffix('"'));
            (quoted.filter(|key| !key.contains('"')), true, after)
        } else {
            let name = rest.strip_prefix('.').unwrap_or(rest);
            let other = |c: char| !(c.is_alphanumeric() || c == '_');
            let (key, after) = name.split_at(name.find(other).unwrap_or(name.len()));
            (Some(key), false, after)
        };
        steps.push(Step { key, is_row, end: expression.len() - after.len() });
        if !after.starts_with(['.', '[']) {
            return steps;
        }
        rest = after;
    }
}

/// What `holds` says when the words that it stands behind are no longer true.
const NOT_TRUE: &str = "the words before are no longer true";

/// A file that Tera fills; prose with its place marks.
fn source((path, text): (&str, &str)) -> Option<(String, String)> {
    match path.rsplit_once('.')?.1 {
        "md" => Some((path.into(), marked(text))),
        "tex" | "html" => Some((path.into(), text.into())),
        _ => None,
    }
}

fn raw(value: &Value) -> Json {
    match &value.number {
        Number::None => Json::Null,
        Number::Integer(n) => serde_json::json!(n),
        Number::Real { value, .. } => (*value).into(),
        Number::Text(text) => text.clone().into(),
    }
}

fn as_mark(value: &Value) -> Json {
    mark::framed(&value.id, "").into()
}

/// Puts something under a name with dots into a tree of objects.
fn put(tree: &mut Json, name: &str, thing: Json) {
    let place = name.split('.').fold(tree, |tree, part| &mut tree[part]);
    *place = thing;
}

/// Registers the filters on values, of which `otherwise` has words in place of no number;
/// `literal` for a number that the prose may type with a reason; `holds` for a condition on which
/// words rest; and `code` for an item of the source, which [`super::parse`] makes a listing.
fn register(tera: &mut Tera, empty: &Arc<OnceLock<BTreeSet<String>>>) {
    let with = |text: &str, word: &str| {
        let what =
            || tera::Error::message(format!("`{word}` is a filter for values such as v.name"));
        mark::with(text, word).ok_or_else(what)
    };
    tera.register_filter("percent", move |text: &str, _: Kwargs, _: &State| with(text, "percent"));
    tera.register_filter("significant", move |text: &str, arguments: Kwargs, _: &State| {
        match arguments.must_get("digits") {
            Ok(digits @ 0..=MAX_DIGITS) => with(text, &format!("significant{digits}")),
            _ => Err(tera::Error::message(
                "`significant` needs a number of digits, as in significant(digits=2)",
            )),
        }
    });
    let empty = empty.clone();
    tera.register_filter("otherwise", move |text: &str, arguments: Kwargs, _: &State| {
        let words: String = arguments.must_get("words")?;
        let is_empty = |id| empty.get().is_some_and(|empty| empty.contains(&id));
        Ok::<_, tera::Error>(if mark::ids(text).any(is_empty) { words } else { text.into() })
    });
    tera.register_function("literal", |arguments: Kwargs, _: &State| {
        let text: String = arguments.must_get("text")?;
        let why: String = arguments.must_get("why")?;
        match text.trim().is_empty() || why.trim().is_empty() {
            true => Err(tera::Error::message(
                "`literal` needs a number in `text` and its reason in `why`",
            )),
            false => Ok(text),
        }
    });
    tera.register_function("holds", |arguments: Kwargs, _: &State| {
        match arguments.must_get::<bool>("that")? {
            true => Ok(String::new()),
            false => Err(tera::Error::message(NOT_TRUE)),
        }
    });
    tera.register_function("code", |arguments: Kwargs, _: &State| {
        let item: String = arguments.must_get("item")?;
        Ok::<_, tera::Error>(format!("```rust {item}\n```"))
    });
}
