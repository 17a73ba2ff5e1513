//! Fills the templates by Tera: values become marks (`mark`), which the parser replaces by digits.
//! The manual ([`crate::manual`]) lists what a template may write.

use super::edition::Document;
use super::error::Error;
use super::filled::Filled;
use super::lint::Declared;
use super::mark::{self, Piece, marked, pieces};
use super::values::{Number, Registry, Value};
use crate::input::{line_and_column, plain};
use crate::prose::Templates;
use crate::table::{Table, nearest};
use serde_json::Value as Json;
use std::collections::BTreeSet;
use tera::{Context, Delimiters, Kwargs, State, Tera};

#[derive(Clone, Debug)]
pub struct Filler {
    tera: Tera,
    templates: Templates,
    pub declared: Declared,
    context: Context,
    /// Values and tables, as the context has them.
    names: Json,
}

impl Filler {
    /// Sets Tera up with all `.md`, `.tex` and `.html` files, and with values: `v.name` and
    /// `group.name` are marks, `raw.name` and `raw.group.name` plain numbers. Cells of tables are
    /// `table["row"].column`, their keys `keys.table.key` and `keys.table.rows`.
    pub fn new(templates: &Templates, values: &Registry) -> Result<Self, Error> {
        let declared = Declared::read(templates.text("literals.toml")?)
            .map_err(|error| Error::Template(templates.place(&error.to_string())))?;
        // Tables for figures alone are long, and no template needs them.
        let named = |table: &&Table| templates.iter().any(|(_, text)| text.contains(table.name()));
        let tables: Vec<&Table> = values.tables().filter(named).collect();
        let cells = tables.iter().copied().flat_map(Table::cells);
        let empty = values.iter().chain(cells).filter(|value| value.number == Number::None);
        let mut tera = Tera::new();
        register(&mut tera, empty.map(|value| value.id.clone()).collect());
        let delimiters = Delimiters {
            block_start: "<%".into(),
            block_end: "%>".into(),
            variable_start: "«".into(),
            variable_end: "»".into(),
            comment_start: "<#".into(),
            comment_end: "#>".into(),
        };
        // Tera reads what follows each of them within it.
        let long = |(path, text): (&str, &str)| {
            Some((path.to_string(), text.match_indices("elif").nth(200)?.0))
        };
        if let Some((path, at)) = templates.iter().find_map(long) {
            return Err(fault(
                templates,
                &path,
                at,
                "more than 200 `elif` in a file; write a table",
            ));
        }
        let set = tera.set_delimiters(delimiters);
        tera.autoescape_on(Vec::<&str>::new());
        let names = names(values, &tables);
        let mut context = Context::new();
        for (group, names) in names.as_object().into_iter().flatten() {
            context.insert(group.clone(), names);
        }
        let mut filler = Filler { tera, templates: templates.clone(), declared, context, names };
        let sources: Vec<(String, String)> = templates.iter().filter_map(source).collect();
        let added = set.and_then(|()| filler.tera.add_raw_templates(sources));
        added.map_err(|error| filler.failure(&error))?;
        Ok(filler)
    }

    /// Adds a name that is no value: the rows of the claims, the list of figures.
    pub fn insert<T: serde::Serialize>(&mut self, name: &'static str, rows: &T) {
        self.context.insert(name, rows);
    }

    pub fn fill(&self, path: &str) -> Result<String, Error> {
        let mut written = Written(Vec::new());
        let made = self.tera.render_to(path, &self.context, &mut written);
        let text = String::from_utf8(written.0).unwrap_or_default();
        if text.len() > MOST {
            let what = format!("this writes more than {} MiB; end the loop earlier", MOST >> 20);
            let place = text.rsplit(mark::OPEN).find_map(mark::place_of);
            return Err(self.fault(path, place.unwrap_or_default(), &what));
        }
        made.map(|()| text).map_err(|error| self.failure(&error))
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

    /// Refuses unknown names in conditions, which Tera takes for *false*, and plain numbers.
    fn conditions(&self, path: &str, text: &str) -> Result<(), Error> {
        let uses = |group| text.match_indices(group).map(|(at, _)| at);
        for at in uses("raw.").chain(uses("keys.")) {
            if text[at..].starts_with("raw.")
                && text[..at].trim_end_matches(['-', ' ']).ends_with('«')
            {
                let what = "a plain number is for conditions; write the value, as «v.name»";
                return Err(self.fault(path, at, what));
            }
            let begins = !text[..at].ends_with(|c: char| c.is_alphanumeric() || "._".contains(c));
            if let Some(what) = self.missing(&text[at..]).filter(|_| begins) {
                return Err(self.fault(path, at, &what));
            }
        }
        Ok(())
    }

    fn fault(&self, path: &str, at: usize, what: &str) -> Error {
        fault(&self.templates, path, at, what)
    }

    /// Returns which part of a name, `table["row"].column`, does not exist, with the nearest that
    /// does; none if the name is right or names no value. A computed row may be any row.
    fn missing(&self, expression: &str) -> Option<String> {
        let mut here = &self.names;
        for (at, (key, end)) in steps(expression).into_iter().enumerate() {
            let names = here.as_object()?;
            match key.map_or(names.values().next(), |key| names.get(key)) {
                Some(next) => here = next,
                // A name of Tera, as a variable of a loop.
                None if at == 0 => return None,
                None => {
                    let key = key.filter(|key| !key.is_empty())?;
                    let nearest = nearest(key, names.keys().map(String::as_str)).join(", ");
                    let whole = &expression[..end];
                    return Some(format!("{whole}: there is no such name; nearest: {nearest}"));
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
            let end = steps.last().map_or(0, |(_, end)| *end);
            let number = steps.iter().try_fold(&self.names, |here, (key, _)| here.get((*key)?));
            found.extend(number.map(|number| format!("{} is {number}", &expression[at..at + end])));
        }
        found.join(", ")
    }

    /// An error of Tera in one line. Tera writes a message, an arrow to the place, and the line.
    fn failure(&self, error: &tera::Error) -> Error {
        let report = error.to_string();
        let (what, place) = report.split_once("--> ").unwrap_or((&report, ""));
        let what = what.split(" Available fields: ").next().unwrap_or_default();
        let what = plain(what.trim_start_matches("error: ").trim_end());
        let signs = [("%}", "%>"), ("{%", "<%"), ("}}", "»"), ("{{", "«")];
        let what = signs.iter().fold(what, |what, (theirs, ours)| what.replace(theirs, ours));
        let place: Vec<&str> = place.lines().next().unwrap_or_default().split(':').collect();
        let [path, line, column] = place[..] else { return Error::Template(what) };
        let text = self.templates.text(path).unwrap_or_default();
        let [line, column] = [line, column].map(|from_one| from_one.parse().unwrap_or(1) - 1);
        // The columns are those of the text with its place marks.
        let begun = text.split_inclusive('\n').take(line).map(str::len).sum::<usize>();
        let marked = if path.ends_with(".md") { marked(text) } else { text.into() };
        let before = marked.lines().nth(line).unwrap_or_default().chars().take(column);
        let typed = |piece| match piece {
            Piece::Text(text) => text.len(),
            Piece::Value { .. } => 0,
        };
        let at = begun + pieces(&before.collect::<String>()).into_iter().map(typed).sum::<usize>();
        let Some(tag) = text.get(..at).and_then(|before| before.rfind('«')) else {
            return self.fault(path, at, &what);
        };
        let inside = text[tag..].trim_start_matches(['«', '-', ' ']);
        let (inside, rest) = inside.split_at(inside.find(['«', '»', '\n']).unwrap_or(inside.len()));
        if !rest.starts_with('»') {
            return self.fault(path, tag, "this « has no » on its line; close it");
        }
        let what = match self.missing(inside) {
            Some(missing) => missing,
            None if what.contains(NOT_TRUE) => {
                format!("{what}: {inside}, where {}; correct the sentence", self.numbers(inside))
            }
            None => what,
        };
        self.fault(path, at, &what)
    }
}

fn fault(templates: &Templates, path: &str, at: usize, what: &str) -> Error {
    let place = line_and_column(templates.text(path).unwrap_or_default(), at);
    Error::Template(templates.place(&format!("{path}:{place}: {what}")))
}

/// A template writes at most this many bytes.
const MOST: usize = 64 << 20;

struct Written(Vec<u8>);

impl std::io::Write for Written {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.extend_from_slice(bytes);
        let is_full = self.0.len() > MOST;
        if is_full { Err(std::io::ErrorKind::OutOfMemory.into()) } else { Ok(bytes.len()) }
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Reads the name that begins an expression: each key, none of a computed row, and where it ends.
fn steps(expression: &str) -> Vec<(Option<&str>, usize)> {
    let (mut steps, mut end) = (Vec::new(), 0);
    loop {
        let rest = &expression[end..];
        let key = if let Some(inner) = rest.strip_prefix('[') {
            let Some((key, _)) = inner.split_once(']') else { return steps };
            end += key.len() + 2;
            let quoted = key.strip_prefix('"').and_then(|key| key.strip_suffix('"'));
            quoted.filter(|key| !key.contains('"'))
        } else {
            let name = rest.strip_prefix('.').unwrap_or(rest);
            let other = |c: char| !(c.is_alphanumeric() || c == '_');
            let name = &name[..name.find(other).unwrap_or(name.len())];
            end += usize::from(rest.starts_with('.')) + name.len();
            Some(name)
        };
        steps.push((key, end));
        if !expression[end..].starts_with(['.', '[']) {
            return steps;
        }
    }
}

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
        // Templates have integers of 64 bits.
        Number::Integer(n) => serde_json::to_value(n).unwrap_or_else(|_| (*n as f64).into()),
        Number::Real { value, .. } => (*value).into(),
        Number::Text(text) => text.clone().into(),
    }
}

fn names(values: &Registry, tables: &[&Table]) -> Json {
    let mut names = Json::Null;
    let mut add = |path: &[&str], value: Option<&Value>| {
        let group: &[&str] = if path.len() == 1 { &["v"] } else { &[] };
        let mark = value.map(|value| mark::framed(&value.id, ""));
        put(&mut names, &[group, path].concat(), mark.into());
        put(&mut names, &[&["raw"], path].concat(), value.map_or(Json::Null, raw));
    };
    for value in values.iter() {
        add(&value.id.split('.').collect::<Vec<_>>(), Some(value));
    }
    for table in tables {
        let name: Vec<&str> = table.name().split('.').collect();
        // A table without rows has a name too.
        add(&name, None);
        for (row, cells) in table.named() {
            for (column, cell) in cells {
                // A table of one row without keys is that row.
                let row: &[&str] = if row.is_empty() { &[] } else { &[&row] };
                add(&[&name, row, &[column]].concat(), Some(cell));
            }
        }
    }
    for table in tables {
        let name: Vec<&str> = ["keys"].into_iter().chain(table.name().split('.')).collect();
        put(&mut names, &[&name[..], &["rows"]].concat(), table.rows().collect());
        for key in table.keys() {
            put(&mut names, &[&name[..], &[key]].concat(), table.called(key).into());
        }
    }
    names
}

fn put(tree: &mut Json, path: &[&str], thing: Json) {
    *path.iter().fold(tree, |tree, part| &mut tree[*part]) = thing;
}

/// Registers the filters and functions that the manual lists; the values `empty` have no number.
fn register(tera: &mut Tera, empty: BTreeSet<String>) {
    let with = |text: &str, word: &str| {
        let what = || tera::Error::message(format!("`{word}` is a filter for values, as v.name"));
        mark::with(text, word).ok_or_else(what)
    };
    tera.register_filter("percent", move |text: &str, _: Kwargs, _: &State| with(text, "percent"));
    tera.register_filter("significant", move |text: &str, arguments: Kwargs, _: &State| {
        match arguments.must_get("digits") {
            Ok(digits @ 1..=17) => with(text, &format!("significant{digits}")),
            _ => Err(tera::Error::message("`significant` needs 1 to 17: significant(digits=2)")),
        }
    });
    tera.register_filter("otherwise", move |text: &str, arguments: Kwargs, _: &State| {
        let words: String = arguments.must_get("words")?;
        let is_empty = |id| empty.contains(&id);
        Ok::<_, tera::Error>(if mark::ids(text).any(is_empty) { words } else { text.into() })
    });
    tera.register_function("literal", |arguments: Kwargs, _: &State| {
        let text: String = arguments.must_get("text")?;
        let why: String = arguments.must_get("why")?;
        if text.trim().is_empty() || why.trim().is_empty() {
            let what = "`literal` needs a number in `text` and its reason in `why`";
            return Err(tera::Error::message(what));
        }
        Ok(text)
    });
    tera.register_function("holds", |arguments: Kwargs, _: &State| {
        let holds: bool = arguments.must_get("that")?;
        if holds { Ok(String::new()) } else { Err(tera::Error::message(NOT_TRUE)) }
    });
    tera.register_function("code", |arguments: Kwargs, _: &State| {
        let item: String = arguments.must_get("item")?;
        Ok::<_, tera::Error>(format!("```rust {item}\n```"))
    });
}
