//! Fills the templates by Tera: values become marks (`mark`), which the parser replaces by digits.
//! The manual ([`crate::manual`]) lists what a template may write.

use super::edition::Document;
use super::error::Error;
use super::filled::Filled;
use super::lint::Declared;
use super::mark::{self, Piece, pieces, with_places};
use super::values::{Number, Value, ValueRegistry};
use crate::input::{Place, in_plain_words};
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
    /// Values and tables, and what is no value: the rows of the claims, the list of figures.
    pub context: Context,
    /// Values and tables, as the context has them.
    names: Json,
}

impl Filler {
    /// Sets Tera up with all `.md`, `.tex` and `.html` files.
    pub fn new(templates: &Templates) -> Result<Self, Error> {
        let declared = Declared::read(templates.text("literals.toml")?)
            .map_err(|error| Error::Message(templates.place(&error.to_string())))?;
        let mut tera = Tera::new();
        register(&mut tera);
        let delimiters = Delimiters {
            block_start: "<%".into(),
            block_end: "%>".into(),
            variable_start: "«".into(),
            variable_end: "»".into(),
            comment_start: "<#".into(),
            comment_end: "#>".into(),
        };
        // Tera reads what follows each of them within it.
        for (path, text) in templates.iter() {
            if let Some((offset, _)) = text.match_indices("elif").nth(200) {
                let problem = "more than 200 `elif` in a file; write a table";
                return Err(fault(templates, path, offset, problem));
            }
        }
        let set = tera.set_delimiters(delimiters);
        tera.autoescape_on(Vec::<&str>::new());
        let sources = templates.iter().filter_map(|(path, text)| match path.rsplit_once('.')?.1 {
            "md" => Some((path, with_places(text))),
            "tex" | "html" => Some((path, text.to_string())),
            _ => None,
        });
        let added = set.and_then(|()| tera.add_raw_templates(sources));
        let (templates, context) = (templates.clone(), Context::new());
        let filler = Filler { tera, templates, declared, context, names: Json::Null };
        added.map_err(|error| filler.translate(&error))?;
        Ok(filler)
    }

    /// Adds values: `v.name` and `group.name` are marks, `raw.name` and `raw.group.name` plain
    /// numbers. Cells of tables are `table["row"].column`, their keys `keys.table.key` and
    /// `keys.table.rows`.
    pub fn insert_values(&mut self, values: &ValueRegistry) {
        // Tables for figures alone are long, and no template needs them.
        let named = |table: &&Table| {
            let mut filled =
                self.templates.iter().filter(|(path, _)| self.tera.contains_template(path));
            filled.any(|(_, text)| text.contains(table.name()))
        };
        let tables: Vec<&Table> = values.tables().filter(named).collect();
        let cells = tables.iter().copied().flat_map(Table::cells);
        let empty = values.iter().chain(cells).filter(|value| value.number == Number::None);
        register_otherwise(&mut self.tera, empty.map(|value| value.id.clone()).collect());
        self.names = context_names(values, &tables);
        self.context = Context::from_serialize(&self.names).unwrap_or_default();
    }

    pub fn fill(&self, path: &str) -> Result<String, Error> {
        // No memory is taken for what stays empty.
        let mut buffer = vec![0; MOST];
        let mut free = &mut buffer[..];
        let outcome = self.tera.render_to(path, &self.context, &mut free);
        let left = free.len();
        let output = String::from_utf8_lossy(&buffer[..MOST - left]).into_owned();
        if left == 0 {
            let problem = format!("this writes more than {} MiB; end the loop earlier", MOST >> 20);
            let offset = output.rsplit(mark::OPEN).find_map(mark::offset_in);
            return Err(fault(&self.templates, path, offset.unwrap_or_default(), &problem));
        }
        outcome.map(|()| output).map_err(|error| self.translate(&error))
    }

    /// Fills the prose of a document, and keeps where each piece of it stands.
    pub fn prose(&self, document: &Document) -> Result<Filled, Error> {
        let files = document.files(&self.templates);
        if files.is_empty() {
            let problem = "no such file in the templates; write the document";
            return Err(Error::Message(format!("{}.md: {problem}", document.prose)));
        }
        let mut filled = Filled::default();
        for path in files {
            let template = self.templates.text(path)?;
            self.conditions(path, template)?;
            filled.add(&self.templates.place(path), template, &self.fill(path)?);
        }
        Ok(filled)
    }

    /// Refuses names in conditions that do not exist, which Tera takes for *false*, plain numbers
    /// outside of conditions, and filters on values that take plain numbers or words.
    fn conditions(&self, path: &str, template: &str) -> Result<(), Error> {
        let uses = |group| template.match_indices(group);
        for (offset, group) in uses("raw.").chain(uses("keys.")) {
            let (before, name) = template.split_at(offset);
            if group == "raw." && before.trim_end_matches(['-', ' ']).ends_with('«') {
                let problem = "a plain number is for conditions; write the value, as «v.name»";
                return Err(fault(&self.templates, path, offset, problem));
            }
            let begins = !before.ends_with(|c: char| c.is_alphanumeric() || "._".contains(c));
            if let Some(problem) = self.describe_missing(name).filter(|_| begins) {
                return Err(fault(&self.templates, path, offset, &problem));
            }
        }
        for (offset, _) in template.match_indices('«') {
            let tag = template[offset..].split('»').next().unwrap_or_default();
            let group = tag.trim_start_matches(['«', '-', ' ']).split(['.', '[']).next();
            let is_value =
                |name| self.names.get(name).is_some() && !["raw", "keys"].contains(&name);
            // Words in quotation marks may have bars.
            let bare: String = tag.split('"').step_by(2).collect();
            let filters = bare.split('|').skip(1).filter_map(|rest| rest.trim().split('(').next());
            let mut filters = filters.map(str::trim).filter(|_| group.is_some_and(is_value));
            if let Some(other) = filters.find(|filter| !FILTERS.contains(filter)) {
                let problem = "is no filter for values; write «… | significant(digits=2)»";
                return Err(fault(&self.templates, path, offset, &format!("`{other}` {problem}")));
            }
        }
        Ok(())
    }

    /// Describes which part of a name, `table["row"].column`, does not exist, with the most similar
    /// names, or returns `None` if the name is right or names no value. A computed row may be any.
    fn describe_missing(&self, expression: &str) -> Option<String> {
        let mut here = &self.names;
        for (depth, (key, end)) in steps(expression).into_iter().enumerate() {
            let names = here.as_object()?;
            match key.map_or(names.values().next(), |key| names.get(key)) {
                Some(next) => here = next,
                // A name of Tera, as a variable of a loop.
                None if depth == 0 => return None,
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
    fn list_numbers(&self, expression: &str) -> String {
        let numbers = expression.match_indices("raw.").filter_map(|(offset, _)| {
            let steps = steps(&expression[offset..]);
            let number = steps.iter().try_fold(&self.names, |here, (key, _)| here.get((*key)?))?;
            Some(format!("{} is {number}", &expression[offset..offset + steps.last()?.1]))
        });
        numbers.collect::<Vec<_>>().join(", ")
    }

    /// Translates an error of Tera, which is a message, an arrow to the place, and the line there.
    fn translate(&self, error: &tera::Error) -> Error {
        let report = error.to_string();
        let (problem, place) = report.split_once("--> ").unwrap_or((&report, ""));
        let problem = problem.split(" Available fields: ").next().unwrap_or_default();
        let problem = in_plain_words(problem.trim_start_matches("error: ").trim_end());
        let signs = [("%}", "%>"), ("{%", "<%"), ("}}", "»"), ("{{", "«")];
        let problem =
            signs.iter().fold(problem, |problem, (theirs, ours)| problem.replace(theirs, ours));
        let place: Vec<&str> = place.lines().next().unwrap_or_default().split(':').collect();
        let [path, line, column] = place[..] else { return Error::Message(problem) };
        let template = self.templates.text(path).unwrap_or_default();
        let [line, column] = [line, column].map(|from_one| from_one.parse().unwrap_or(1) - 1);
        // The columns are those of the text with its place marks.
        let begun = template.split_inclusive('\n').take(line).map(str::len).sum::<usize>();
        let marked = if path.ends_with(".md") { with_places(template) } else { template.into() };
        let before = marked.lines().nth(line).unwrap_or_default().chars().take(column);
        let typed = |piece| match piece {
            Piece::Text(template) => template.len(),
            Piece::Value { .. } => 0,
        };
        let before = before.collect::<String>();
        let offset = begun + pieces(&before).into_iter().map(typed).sum::<usize>();
        let Some(tag) = template.get(..offset).and_then(|before| before.rfind('«')) else {
            return fault(&self.templates, path, offset, &problem);
        };
        let inside = template[tag..].trim_start_matches(['«', '-', ' ']);
        let (inside, rest) = inside.split_at(inside.find(['«', '»', '\n']).unwrap_or(inside.len()));
        if !rest.starts_with('»') {
            return fault(&self.templates, path, tag, "this « has no » on its line; close it");
        }
        let problem = match self.describe_missing(inside) {
            Some(missing) => missing,
            None if problem.contains(NOT_TRUE) => {
                let numbers = self.list_numbers(inside);
                format!("{problem}: {inside}, where {numbers}; correct the sentence")
            }
            None => problem,
        };
        fault(&self.templates, path, offset, &problem)
    }
}

fn fault(templates: &Templates, path: &str, offset: usize, problem: &str) -> Error {
    let template = templates.text(path).unwrap_or_default();
    let place = Place::in_text(templates.place(path), template, offset);
    Error::Message(problem.into()).with_place(place)
}

/// A template writes at most this many bytes.
const MOST: usize = 64 << 20;

/// Splits the name that begins an expression into keys with their ends; a computed row has no key.
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
            let is_other = |c: char| !(c.is_alphanumeric() || c == '_');
            let name = &name[..name.find(is_other).unwrap_or(name.len())];
            end += usize::from(rest.starts_with('.')) + name.len();
            Some(name)
        };
        steps.push((key, end));
        if !expression[end..].starts_with(['.', '[']) {
            return steps;
        }
    }
}

const FILTERS: [&str; 3] = ["percent", "significant", "otherwise"];
const NOT_TRUE: &str = "the words before are no longer true";

fn plain_number(value: &Value) -> Json {
    match &value.number {
        Number::None => Json::Null,
        // Templates have integers of 64 bits.
        Number::Integer(n) => serde_json::to_value(n).unwrap_or_else(|_| (*n as f64).into()),
        Number::Real { value, .. } => (*value).into(),
        Number::Text(text) => text.clone().into(),
    }
}

fn context_names(values: &ValueRegistry, tables: &[&Table]) -> Json {
    let mut names = Json::Null;
    let mut add = |path: &[&str], value: Option<&Value>| {
        let group: &[&str] = if path.len() == 1 { &["v"] } else { &[] };
        let mark = value.map(|value| mark::framed(&value.id, ""));
        insert_at(&mut names, &[group, path].concat(), mark.into());
        insert_at(&mut names, &[&["raw"], path].concat(), value.map_or(Json::Null, plain_number));
    };
    for value in values.iter() {
        add(&value.id.split('.').collect::<Vec<_>>(), Some(value));
    }
    for table in tables {
        let name: Vec<&str> = table.name().split('.').collect();
        // A table without rows has a name too.
        add(&name, None);
        for (row, cells) in table.rows_by_name() {
            for (column, cell) in cells {
                // A table of one row without keys is that row.
                let row: &[&str] = if row.is_empty() { &[] } else { &[&row] };
                add(&[&name, row, &[column]].concat(), Some(cell));
            }
        }
    }
    for table in tables {
        let name: Vec<&str> = ["keys"].into_iter().chain(table.name().split('.')).collect();
        insert_at(&mut names, &[&name[..], &["rows"]].concat(), table.rows().collect());
        for key in table.keys() {
            insert_at(&mut names, &[&name[..], &[key]].concat(), table.key_values(key).into());
        }
    }
    names
}

fn insert_at(tree: &mut Json, path: &[&str], value: Json) {
    *path.iter().fold(tree, |tree, part| &mut tree[*part]) = value;
}

/// Registers the filter `otherwise`; the values `empty` have no number.
fn register_otherwise(tera: &mut Tera, empty: BTreeSet<String>) {
    tera.register_filter("otherwise", move |mark: &str, arguments: Kwargs, _: &State| {
        let words: String = arguments.must_get("words")?;
        let is_empty = |(id, ..): (String, _, _)| empty.contains(&id);
        Ok::<_, tera::Error>(if mark::values(mark).any(is_empty) { words } else { mark.into() })
    });
}

/// Registers the filters and functions that the manual lists.
fn register(tera: &mut Tera) {
    register_otherwise(tera, BTreeSet::new());
    let with = |mark: &str, word: &str| match &pieces(mark)[..] {
        [Piece::Value { id, filters }] => Ok(mark::framed(id, &format!("{filters} {word}"))),
        _ => Err(tera::Error::message(format!("`{word}` is a filter for values, as v.name"))),
    };
    tera.register_filter("percent", move |mark: &str, _: Kwargs, _: &State| with(mark, "percent"));
    tera.register_filter("significant", move |mark: &str, arguments: Kwargs, _: &State| {
        match arguments.must_get("digits") {
            Ok(digits @ 1..=17) => with(mark, &format!("significant{digits}")),
            _ => Err(tera::Error::message("`significant` needs 1 to 17: significant(digits=2)")),
        }
    });
    tera.register_function("literal", |arguments: Kwargs, _: &State| {
        let literal: String = arguments.must_get("text")?;
        let why: String = arguments.must_get("why")?;
        if literal.trim().is_empty() || why.trim().is_empty() {
            let problem = "`literal` needs a number in `text` and its reason in `why`";
            return Err(tera::Error::message(problem));
        }
        Ok(literal)
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
