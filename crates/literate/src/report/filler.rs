//! Filling the templates by Tera.
//!
//! Delimiters are `«value»`, `<% tag %>` and `<# comment #>`, because Tera's own ones break TeX.
//! Autoescape is off: the result is Markdown.
//!
//! In a template `«v.half_height»` does not become digits yet but a *mark* that carries the id,
//! and filters change the mark: `«v.kept | percent»`, `«v.p_jump | significant(digits=10)»`,
//! `«v.x | no_error»`. The writers turn marks into digits, each in its own markup and knowing whether the mark stands in
//! prose or in mathematics; and they know which values were named. For conditions there are plain
//! numbers: `<% if raw.half_height < raw.printed.threshold %>`.
//! A cell of a table is named by the keys of its row and its column, `«run.rise["r=0.8,x=0.3"].mean»`,
//! and `first`, `last` and `last-1` stand for values of a key ([`crate::table::Table::named`]); a loop goes through the
//! values of a key by `<% for r in keys.run.rise.r %>`, and the names of all rows by `keys.run.rise.rows`.
//! `«code(item="module::Type::method")»` is an item of the source, see [`Program::item`].

use super::documents::Document;
use super::mark;
use super::origin::{Filled, marked, next_tag};
use super::print::MOST_DIGITS;
use super::values::{Number, Registry, Value};
use super::{Error, Templates, lint};
use crate::input::{Bounded, line_and_column, plain};
use crate::source::Program;
use crate::table::Table;
use serde_json::Value as Json;
use std::collections::{BTreeMap, BTreeSet};
use tera::{Context, Delimiters, Kwargs, State, Tera};

/// What conditions and loops have besides names.
const WORDS: &str = "if elif else endif for in endfor and or not is defined starting_with ending_with containing pat \
    true false loop";

/// Bytes at most that a template makes: the longest of ours makes a tenth of a million.
const LONGEST: u64 = 4 << 20;

/// Fills a template of `tera`.
fn render(tera: &Tera, name: &str, of: &Filler) -> Result<String, Error> {
    let mut text = Bounded::new(LONGEST);
    let rendered = tera.render_to(name, &of.context, &mut text);
    rendered.map_err(|error| match error.kind() {
        tera::ErrorKind::Io(_) => {
            let most = LONGEST >> 20;
            Error::Template(format!(
                "{name}: it makes more than {most} MiB; look for a loop that is too long"
            ))
        }
        _ => failure(&error, &of.templates),
    })?;
    String::from_utf8(text.bytes).map_err(|_| Error::Template(format!("{name}: it makes no text")))
}

/// Tera, set up with the templates and the values.
#[derive(Clone)]
pub struct Filler {
    tera: Tera,
    /// The prose, and the same set up with marks that tell where it stands.
    templates: Templates,
    marked: Tera,
    context: Context,
    /// Names of values that templates may use, and what stands before their dots.
    names: BTreeSet<String>,
    roots: BTreeSet<String>,
}

impl Filler {
    /// Sets Tera up with all `.md`, `.tex` and `.html` files.
    pub fn new(templates: &Templates, values: &Registry, program: Program) -> Result<Self, Error> {
        lint::form(templates)?;
        let mut tera = Tera::new();
        let failure = |error| failure(&error, templates);
        let delimiters = Delimiters {
            block_start: "<%".into(),
            block_end: "%>".into(),
            variable_start: "«".into(),
            variable_end: "»".into(),
            comment_start: "<#".into(),
            comment_end: "#>".into(),
        };
        tera.set_delimiters(delimiters).map_err(failure)?;
        tera.autoescape_on(Vec::<&str>::new());
        register(&mut tera, program);
        let prose = |path: &str| [".md", ".tex", ".html"].iter().any(|end| path.ends_with(end));
        let mut with_marks = tera.clone();
        let sources: Vec<_> = templates.iter().filter(|(path, _)| prose(path)).collect();
        tera.add_raw_templates(sources.iter().copied()).map_err(failure)?;
        let sources = sources.iter().map(|(path, text)| (*path, marked(text)));
        with_marks.add_raw_templates(sources).map_err(failure)?;
        let templates = templates.clone();
        // Tables for figures alone are long, and no template needs them.
        let named = |table: &&Table| templates.iter().any(|(_, text)| text.contains(table.name()));
        let tables: Vec<&Table> = values.tables().filter(named).collect();
        let names = names(values, &tables);
        let root = |name: &String| name.split('.').next().unwrap_or_default().to_string();
        let roots = names.iter().map(root).collect();
        let context = context(values, &tables);
        Ok(Filler { tera, templates, marked: with_marks, context, names, roots })
    }

    /// Adds a name that is no value: the rows of the claims, the list of figures.
    pub fn insert<T: serde::Serialize>(&mut self, name: &'static str, rows: &T) {
        self.context.insert(name, rows);
    }

    /// Holds names in tags against what there is: in a condition Tera takes one that it does not have for *false*.
    fn known(&self) -> Result<(), Error> {
        for (path, text) in self.templates.iter().filter(|(path, _)| path.ends_with(".md")) {
            // What loops name, anywhere in the file.
            let mut own = BTreeSet::new();
            let mut at = 0;
            while let Some((start, end)) = next_tag(text, at) {
                at = end;
                if let Some(what) = self.unknown(&text[start..end], &mut own) {
                    let place = line_and_column(text, start);
                    return Err(Error::Template(format!("{path}:{place}: {what}")));
                }
            }
        }
        Ok(())
    }

    /// What a tag names and there is not, in words; `own` are the names that loops before it gave.
    fn unknown<'t>(&self, tag: &'t str, own: &mut BTreeSet<&'t str>) -> Option<String> {
        if tag.starts_with("<#") {
            return None;
        }
        // What is quoted is no name.
        let other = |c: char| !(c.is_ascii_alphanumeric() || c == '_' || c == '.');
        let words: Vec<&str> =
            tag.split('"').step_by(2).flat_map(|part| part.split(other)).collect();
        let root = |word: &str| word.split('.').next().unwrap_or_default().to_string();
        let value = |word: &&&str| word.contains('.') && self.roots.contains(&root(word));
        if let Some(word) = words.iter().filter(value).find(|word| !self.names.contains(**word)) {
            return Some(format!("there is no value {word}; `explain` lists all"));
        }
        if !tag.starts_with("<%") {
            return None;
        }
        if words.contains(&"for") {
            own.extend(words.iter().take_while(|word| **word != "in"));
        }
        let known = |word: &&&str| {
            let root = root(word);
            let number = root.is_empty() || root.starts_with(|c: char| c.is_ascii_digit());
            let word = WORDS.split_whitespace().any(|word| word == root);
            number || word || own.contains(root.as_str()) || self.context.contains_key(&root)
        };
        if let Some(word) = words.iter().find(|word| !known(word)) {
            return Some(format!("there is no name {word}; correct it"));
        }
        let judged = words.iter().any(|word| ["if", "elif"].contains(word));
        let shown = |word: &&&str| value(word) && !["raw", "keys"].contains(&root(word).as_str());
        if let Some(word) = words.iter().find(|word| judged && shown(word)) {
            return Some(format!("{word} is what is shown, a text; a condition has raw.{word}"));
        }
        let (bare, quoted) = (tag.split('"').step_by(2), tag.split('"').skip(1).step_by(2));
        let compared =
            |part: &str| part.trim_end().ends_with(['=', '<', '>']) && !part.ends_with("pat=");
        let mut pairs = bare.zip(quoted).filter(|(before, _)| compared(before));
        let (_, number) = pairs.find(|(_, text)| text.parse::<f64>().is_ok())?;
        Some(format!("a number in quotes, {number:?}, equals no number; write it without"))
    }

    /// Fills one template; values are marks in the result.
    pub fn fill(&self, path: &str) -> Result<String, Error> {
        render(&self.tera, path, self)
    }

    /// Fills the prose of a document, and keeps where each piece of it stands.
    pub fn prose(&self, document: &Document) -> Result<Filled, Error> {
        let files = document.files(&self.templates);
        if files.is_empty() {
            let Document { prose, .. } = document;
            let what = format!("{prose}.md: no such file in the templates; write the document");
            return Err(Error::Template(what));
        }
        let filled = files.into_iter().try_fold(Filled::default(), |all, path| {
            self.prose_of_any_name(path).map(|one| all.then(one))
        })?;
        self.known()?;
        filled.refuse_dumps().map(|()| filled)
    }

    fn prose_of_any_name(&self, path: &str) -> Result<Filled, Error> {
        match render(&self.marked, path, self) {
            Ok(filled) => Ok(Filled::read(path, self.templates.text(path)?, &filled)),
            // Without marks the same error has the right column.
            Err(error) => self.fill(path).map_or_else(Err, |_| Err(error)),
        }
    }
}

/// One line: file, line, column, what is wrong, and names that begin alike.
fn failure(error: &tera::Error, templates: &Templates) -> Error {
    use tera::ErrorKind::{Msg, RenderingError, SyntaxError};
    let text = |path: &str| templates.text(path).unwrap_or_default();
    let (RenderingError(report) | SyntaxError(report)) = error.kind() else {
        let told = error.to_string();
        // Of unknown filters, functions and files Tera makes a picture: what, and an arrow to the place.
        let picture = || {
            let (what, rest) = told.strip_prefix("error: ")?.split_once("--> ")?;
            Some(format!("{}: {}", rest.lines().next()?, what.trim()))
        };
        return Error::Template(match error.kind() {
            Msg(_) => picture().unwrap_or(told),
            _ => told,
        });
    };
    let (line, column) = (report.span().start_line, report.span().start_col);
    let place = format!("{}:{line}:{}", report.filename(), column + 1);
    // Tera lists every name that there is: too many to read.
    let Some((what, names)) = report.message().split_once(" Available fields: ") else {
        // Tera names its usual signs.
        let ours = |text: String, (theirs, ours): &(&str, &str)| text.replace(theirs, ours);
        let signs = [("%}", "%>"), ("{%", "<%"), ("}}", "»"), ("{{", "«")];
        let what = signs.iter().fold(plain(report.message()), ours);
        let hint = if what.contains("nexpected end of input") {
            "; a tag before has no end: <% endif %>, <% endfor %> or the like".into()
        } else if what == "Unknown tag" {
            let line = text(report.filename()).lines().nth(line - 1).unwrap_or_default();
            let tag = line.chars().skip(column).take_while(|c| c.is_alphanumeric());
            format!(" {}: it ends nothing; remove it", tag.collect::<String>())
        } else {
            String::new()
        };
        return Error::Template(format!("{place}: {what}{hint}"));
    };
    let asked = what.split('`').nth(1).unwrap_or_default();
    let start: String = asked.chars().take(2).collect();
    let alike: Vec<&str> = names.split(", ").filter(|name| name.starts_with(&start)).collect();
    let alike = match alike.as_slice() {
        [] => String::new(),
        names => format!(" Names that begin alike: {}.", names.join(", ")),
    };
    Error::Template(format!("{place}: {what}{alike}"))
}

/// All names with a dot that [`context`] has.
fn names(values: &Registry, tables: &[&Table]) -> BTreeSet<String> {
    let both = |value: &Value| {
        let name = &value.id;
        let mark = if name.contains('.') { name.clone() } else { format!("v.{name}") };
        [mark, format!("raw.{name}")]
    };
    let keys = |table: &&Table| {
        let name = table.name();
        let rows = [name.to_string(), format!("raw.{name}")];
        let single = table.named().remove("").into_iter().flatten();
        let cells = single.flat_map(move |(column, _)| {
            [format!("{name}.{column}"), format!("raw.{name}.{column}")]
        });
        let keys = table.keys().chain(["rows"]).map(move |key| format!("keys.{name}.{key}"));
        rows.into_iter().chain(cells).chain(keys).collect::<Vec<_>>()
    };
    values.iter().flat_map(both).chain(tables.iter().flat_map(keys)).collect()
}

fn raw(value: &Value) -> Json {
    match &value.number {
        Number::Integer(n) => (*n).into(),
        Number::Real { value, .. } => (*value).into(),
        Number::Interval { low, high } => vec![*low, *high].into(),
        Number::Text(text) => text.clone().into(),
    }
}

fn marked_value(value: &Value) -> Json {
    mark::framed(&value.id, "").into()
}

/// Puts something under a name with dots into a tree of objects.
fn put(tree: &mut Json, name: &str, thing: Json) {
    let place = name.split('.').fold(tree, |tree, part| &mut tree[part]);
    *place = thing;
}

/// `v.name` and `group.name` are marks, `raw.name` and `raw.group.name` plain numbers; tables stand beside them.
fn context(values: &Registry, tables: &[&Table]) -> Context {
    let (mut marks, mut numbers, mut keys) = (Json::Null, Json::Null, Json::Null);
    for value in values.iter() {
        let name = &value.id;
        let group = if name.contains('.') { "" } else { "v." };
        put(&mut marks, &format!("{group}{name}"), marked_value(value));
        put(&mut numbers, name, raw(value));
    }
    for table in tables {
        let rows = |of: fn(&Value) -> Json| {
            let row = |cells: BTreeMap<&str, &Value>| {
                cells.into_iter().map(|(column, cell)| (column.to_string(), of(cell))).collect()
            };
            let mut rows: BTreeMap<String, Json> =
                table.named().into_iter().map(|(name, cells)| (name, row(cells))).collect();
            // A table of one row without keys is that row.
            rows.remove("").unwrap_or_else(|| rows.into_iter().collect())
        };
        put(&mut marks, table.name(), rows(marked_value));
        put(&mut numbers, table.name(), rows(raw));
        put(&mut keys, &format!("{}.rows", table.name()), table.rows().collect());
        for key in table.keys() {
            put(&mut keys, &format!("{}.{key}", table.name()), table.called(key).into());
        }
    }
    let mut context = Context::new();
    for (group, names) in marks.as_object().into_iter().flatten() {
        context.insert(group.clone(), names);
    }
    context.insert("raw", &numbers);
    context.insert("keys", &keys);
    context
}

/// How many digits a filter asks for.
fn digits(arguments: &Kwargs) -> tera::TeraResult<usize> {
    let wrong = || format!("it takes how many digits, as in (digits=2), {MOST_DIGITS} at most");
    let asked = arguments.must_get("digits").ok().filter(|digits| *digits <= MOST_DIGITS);
    asked.ok_or_else(|| tera::Error::message(wrong()))
}

/// The filters on values; `literal` for a number that the prose may type with a reason; and `code`
/// for an item of the source, which [`super::parse`] makes a listing.
fn register(tera: &mut Tera, program: Program) {
    for name in ["percent", "no_error", "significant"] {
        tera.register_filter(name, move |text: &str, arguments: Kwargs, _: &State| {
            let word = match name {
                "significant" => format!("{name}{}", digits(&arguments)?),
                _ => name.to_string(),
            };
            let what = || format!("`{name}` is a filter of values such as v.p_crit");
            mark::with(text, &word).ok_or_else(|| tera::Error::message(what()))
        });
    }
    tera.register_function("literal", |arguments: Kwargs, _: &State| {
        let text: String = arguments.must_get("text")?;
        let why: String = arguments.must_get("why")?;
        if text.trim().is_empty() {
            return Err(tera::Error::message("`literal` needs a number in `text`"));
        }
        if why.trim().is_empty() {
            return Err(tera::Error::message("`literal` needs its reason in `why`"));
        }
        Ok(text)
    });
    tera.register_function("code", move |arguments: Kwargs, _: &State| {
        let item: String = arguments.must_get("item")?;
        program.item(&item).map_err(tera::Error::message)?;
        Ok::<_, tera::Error>(format!("```rust {item}\n```"))
    });
}

#[cfg(test)]
mod tests {
    use super::super::Value;
    use super::super::mark::Piece;
    use super::*;
    use crate::source::TOY;

    fn fill(text: &str) -> Result<String, Error> {
        let mut values = Registry::new();
        values.add(Value::real("p_crit", 0.0122, 3)).unwrap();
        values.add(Value::printed("printed.rise", "0.12", "Sec. 2")).unwrap();
        let templates = Templates::of([("report.md", text)]);
        Filler::new(&templates, &values, TOY)?.fill("report.md")
    }

    #[test]
    fn a_value_is_a_mark_that_filters_change() {
        let filled =
            fill(r"$x^{{2}}$ {% «v.p_crit» and «printed.rise | percent | significant(digits=1)»")
                .unwrap();
        let value = |id: &str, shown| Piece::Value { id: id.into(), shown };
        let rise = value("printed.rise", " percent significant1");
        let pieces =
            [Piece::Text(r"$x^{{2}}$ {% "), value("p_crit", ""), Piece::Text(" and "), rise];
        assert_eq!(mark::pieces(&filled), pieces);
    }

    #[test]
    fn a_literal_needs_its_reason() {
        let text = "«literal(text=\"2007\", why=\"year of the paper\")»";
        assert_eq!(fill(text).unwrap(), "2007");
        assert!(fill("«literal(text=\"2007\", why=\" \")»").is_err());
    }
}
