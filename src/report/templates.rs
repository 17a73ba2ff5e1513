//! The templates: people's prose, read at run time and filled by Tera.
//!
//! Delimiters are `«value»`, `<% tag %>` and `<# comment #>`, because Tera's own ones break TeX.
//! Autoescape is off: the result is Markdown.
//!
//! In a template `«v.half_height»` does not become digits yet but a *mark* that carries the id,
//! and filters change the mark: `«v.kept | percent»`, `«v.p_jump | significant(digits=10)»`,
//! `«v.p_jump | full»`, `«v.x | fixed(digits=2)»`, `«v.x | no_error»`, `«v.x | with_unit»`. The
//! writers turn marks into digits, each in its own markup and knowing whether the mark stands in
//! prose or in mathematics; and they know which values were named. For conditions there are plain
//! numbers: `<% if raw.half_height < raw.printed.threshold %>`.
//! `«code(item="circuits::jump::p_jump")»` is an item of the source, see [`super::literate`].

use super::print::{Asked, MOST_DIGITS, Style};
use super::values::{Number, Registry};
use super::{Error, literate};
use crate::input::{self, LARGEST};
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use tera::{Context, Delimiters, Kwargs, State, Tera};

/// The copy that is built into the program: path relative to `templates/`, and text.
const EMBEDDED: &[(&str, &str)] = &[
    ("literals.toml", include_str!("../../templates/literals.toml")),
    ("unguarded.toml", include_str!("../../templates/unguarded.toml")),
    ("published.toml", include_str!("../../templates/published.toml")),
    ("references.bib", include_str!("../../templates/references.bib")),
    ("report.css", include_str!("../../templates/report.css")),
    ("report.html", include_str!("../../templates/report.html")),
    ("report.md", include_str!("../../templates/report.md")),
    ("report.tex", include_str!("../../templates/report.tex")),
    ("report.typ", include_str!("../../templates/report.typ")),
    ("scene.js", include_str!("../../templates/scene.js")),
    ("scenarios/fig05.json", include_str!("../../templates/scenarios/fig05.json")),
    ("scenarios/fig06.json", include_str!("../../templates/scenarios/fig06.json")),
];

/// Endings of the files that are templates or data for them (fonts live there too).
const TEXT: [&str; 9] = [".md", ".tex", ".typ", ".bib", ".toml", ".html", ".css", ".js", ".json"];

/// All template files, by path relative to their folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Templates(BTreeMap<String, String>);

impl Templates {
    /// The copy that is built into the program.
    pub fn embedded() -> Self {
        Templates::of(EMBEDDED.iter().copied())
    }

    /// Templates from texts.
    pub fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let own = |(path, text): (&str, &str)| (path.to_string(), text.to_string());
        Templates(files.into_iter().map(own).collect())
    }

    /// Reads all templates of a folder.
    ///
    /// # Errors
    /// When a file or folder cannot be read.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let mut walk = Walk::default();
        walk.folder(folder, "")?;
        Ok(Templates(walk.files))
    }

    /// The given folder; without one `./templates` if it is there, else the embedded copy.
    ///
    /// # Errors
    /// As [`Templates::read`].
    pub fn find(folder: Option<&Path>) -> Result<Self, Error> {
        let default = Path::new("templates");
        match folder {
            Some(folder) => Templates::read(folder),
            None if default.join("report.md").is_file() => Templates::read(default),
            None => Ok(Templates::embedded()),
        }
    }

    /// The text of one file.
    ///
    /// # Errors
    /// When there is none of that name.
    pub fn text(&self, path: &str) -> Result<&str, Error> {
        let missing = || Error::Template(format!("{path}: no such file in the templates"));
        self.0.get(path).map(String::as_str).ok_or_else(missing)
    }

    /// Paths and texts, sorted.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(path, text)| (path.as_str(), text.as_str()))
    }
}

/// A folder being read.
#[derive(Default)]
struct Walk {
    files: BTreeMap<String, String>,
    bytes: usize,
    /// Folders so far: symbolic links may lead to one of them again, without end.
    folders: BTreeSet<PathBuf>,
}

impl Walk {
    fn folder(&mut self, folder: &Path, prefix: &str) -> Result<(), Error> {
        let fail = |path: &Path, source| Error::Read { path: path.display().to_string(), source };
        let refuse = |path: &Path, kind, what: &str| Err(fail(path, io::Error::new(kind, what)));
        if !self.folders.insert(folder.canonicalize().map_err(|e| fail(folder, e))?) {
            return refuse(
                folder,
                io::ErrorKind::Other,
                "it leads to a folder that was read before",
            );
        }
        for entry in std::fs::read_dir(folder).map_err(|e| fail(folder, e))? {
            let path = entry.map_err(|e| fail(folder, e))?.path();
            let Some(name) = path.file_name().and_then(|name| name.to_str()) else { continue };
            let relative = format!("{prefix}{name}");
            if path.is_dir() {
                self.folder(&path, &format!("{relative}/"))?;
            } else if TEXT.iter().any(|end| name.ends_with(end)) {
                // Whoever opens a pipe waits for its other end.
                if std::fs::metadata(&path).is_ok_and(|found| !found.is_file()) {
                    return refuse(&path, io::ErrorKind::InvalidInput, "it is no regular file");
                }
                let text = input::read(&path).map_err(|e| fail(&path, e))?;
                self.bytes += text.len();
                if self.bytes as u64 > LARGEST {
                    let what = format!("the templates are longer than {} MiB", LARGEST >> 20);
                    return refuse(&path, io::ErrorKind::FileTooLarge, &what);
                }
                self.files.insert(relative, text);
            }
        }
        Ok(())
    }
}

/// What a template makes, up to the bound of what is read: loops and doubled texts grow fast.
#[derive(Default)]
struct Bounded(Vec<u8>);

impl io::Write for Bounded {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if (self.0.len() + bytes.len()) as u64 > LARGEST {
            let what = format!("it makes more than {} MiB", LARGEST >> 20);
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, what));
        }
        self.0.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Fills a template of `tera`.
fn render(tera: &Tera, name: &str, context: &Context) -> Result<String, Error> {
    let mut text = Bounded::default();
    tera.render_to(name, context, &mut text).map_err(failure)?;
    String::from_utf8(text.0).map_err(|_| Error::Template(format!("{name}: it makes no text")))
}

/// Tera, set up with the templates and the values.
#[derive(Clone)]
pub struct Filler {
    tera: Tera,
    context: Context,
}

impl Filler {
    /// Sets Tera up: all `.md`, `.tex` and `.html` files can be included by their relative path.
    ///
    /// # Errors
    /// A template that does not parse, with file, line and column.
    pub fn new(templates: &Templates, values: &Registry) -> Result<Self, Error> {
        let mut tera = Tera::new();
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
        register(&mut tera);
        let prose = |path: &str| [".md", ".tex", ".html"].iter().any(|end| path.ends_with(end));
        let sources = templates.iter().filter(|(path, _)| prose(path));
        tera.add_raw_templates(sources).map_err(failure)?;
        Ok(Filler { tera, context: context(values) })
    }

    /// Adds a name that is no value: the rows of the claims, the list of figures.
    pub fn insert<T: serde::Serialize>(&mut self, name: &'static str, rows: &T) {
        self.context.insert(name, rows);
    }

    /// Fills one template; values are marks in the result.
    ///
    /// # Errors
    /// An unknown name or a wrong filter, with file, line and column.
    pub fn fill(&self, path: &str) -> Result<String, Error> {
        render(&self.tera, path, &self.context)
    }

    /// Fills a text that is no file (a field of a claim); `name` stands for it in errors.
    ///
    /// # Errors
    /// As [`Filler::fill`].
    pub fn fill_text(&self, name: &str, text: &str) -> Result<String, Error> {
        let mut tera = self.tera.clone();
        tera.add_raw_template(name, text).map_err(failure)?;
        render(&tera, name, &self.context)
    }
}

/// One line: file, line, column, what is wrong, and names that begin alike.
fn failure(error: tera::Error) -> Error {
    use tera::ErrorKind::{RenderingError, SyntaxError};
    let (RenderingError(report) | SyntaxError(report)) = error.kind() else {
        return Error::Template(error.to_string());
    };
    let place = format!(
        "{}:{}:{}",
        report.filename(),
        report.span().start_line,
        report.span().start_col + 1
    );
    // Tera lists every name that there is: too many to read.
    let Some((what, names)) = report.message().split_once(" Available fields: ") else {
        return Error::Template(format!("{place}: {}", report.message()));
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

/// `v.name` and `group.name` are marks, `raw.name` and `raw.group.name` plain numbers.
fn context(values: &Registry) -> Context {
    let mut marks: BTreeMap<&str, BTreeMap<&str, String>> = BTreeMap::new();
    let mut raw: BTreeMap<&str, serde_json::Value> = BTreeMap::new();
    for value in values.iter() {
        let number = match &value.number {
            Number::Integer(n) => (*n).into(),
            Number::Real { value, .. } => (*value).into(),
            Number::Interval { low, high } => vec![*low, *high].into(),
            Number::Text(text) => text.clone().into(),
        };
        let mark = Mark { id: value.id.clone(), style: Style::default() }.write();
        match value.id.split_once('.') {
            None => {
                marks.entry("v").or_default().insert(&value.id, mark);
                raw.insert(&value.id, number);
            }
            Some((group, name)) => {
                marks.entry(group).or_default().insert(name, mark);
                raw.entry(group).or_insert_with(|| serde_json::json!({}))[name] = number;
            }
        }
    }
    let mut context = Context::new();
    for (group, names) in marks {
        context.insert(group.to_string(), &names);
    }
    context.insert("raw", &raw);
    context
}

/// The place of a value in filled text. Private-use characters frame it, so that neither Tera nor
/// Markdown reads anything into it, and no prose can contain one by accident.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mark {
    /// Id of the value.
    pub id: String,
    /// What the filters asked for.
    pub style: Style,
}

const OPEN: char = '\u{e000}';
const CLOSE: char = '\u{e001}';
const NEXT: char = '\u{e002}';

impl Mark {
    /// The mark as text.
    pub fn write(&self) -> String {
        let mut out = format!("{OPEN}{}", self.id);
        let mut flag = |text: String| {
            out.push(NEXT);
            out.push_str(&text);
        };
        if self.style.percent {
            flag("percent".into());
        }
        match self.style.digits {
            Some(Asked::Full) => flag("full".into()),
            Some(Asked::Fixed(n)) => flag(format!("fixed{n}")),
            Some(Asked::Significant(n)) => flag(format!("significant{n}")),
            None => {}
        }
        if self.style.no_error {
            flag("noerror".into());
        }
        if self.style.with_unit {
            flag("unit".into());
        }
        out.push(CLOSE);
        out
    }

    /// Reads what [`Mark::write`] wrote; None for anything else.
    pub fn read(text: &str) -> Option<Mark> {
        let inner = text.strip_prefix(OPEN)?.strip_suffix(CLOSE)?;
        let mut parts = inner.split(NEXT);
        let id = parts.next()?.to_string();
        let mut style = Style::default();
        for flag in parts {
            let number = |prefix: &str| flag.strip_prefix(prefix)?.parse().ok();
            match flag {
                "percent" => style.percent = true,
                "full" => style.digits = Some(Asked::Full),
                "noerror" => style.no_error = true,
                "unit" => style.with_unit = true,
                _ => {
                    let fixed = number("fixed").map(Asked::Fixed);
                    style.digits = Some(fixed.or(number("significant").map(Asked::Significant))?);
                }
            }
        }
        (!id.contains(OPEN)).then_some(Mark { id, style })
    }

    /// Cuts text at its marks: Ok is a mark, Err is text between marks.
    pub fn split(text: &str) -> Vec<Result<Mark, &str>> {
        let mut pieces = Vec::new();
        let mut rest = text;
        while let Some(start) = rest.find(OPEN) {
            let Some(length) = rest[start..].find(CLOSE) else { break };
            let end = start + length + CLOSE.len_utf8();
            if start > 0 {
                pieces.push(Err(&rest[..start]));
            }
            pieces.push(Mark::read(&rest[start..end]).ok_or(&rest[start..end]));
            rest = &rest[end..];
        }
        if !rest.is_empty() {
            pieces.push(Err(rest));
        }
        pieces
    }
}

/// How many digits a filter asks for.
fn digits(arguments: &Kwargs) -> tera::TeraResult<usize> {
    match arguments.must_get("digits")? {
        digits if digits <= MOST_DIGITS => Ok(digits),
        _ => Err(tera::Error::message(format!("no number has more than {MOST_DIGITS} digits"))),
    }
}

/// The filters on values; `literal` for a number that the prose may type with a reason; and `code`
/// for an item of the source, which [`super::parse`] makes a listing.
fn register(tera: &mut Tera) {
    type Change = fn(&mut Style, &Kwargs) -> tera::TeraResult<()>;
    let changes: [(&str, Change); 6] = [
        ("percent", |style, _| {
            style.percent = true;
            Ok(())
        }),
        ("full", |style, _| {
            style.digits = Some(Asked::Full);
            Ok(())
        }),
        ("no_error", |style, _| {
            style.no_error = true;
            Ok(())
        }),
        ("with_unit", |style, _| {
            style.with_unit = true;
            Ok(())
        }),
        ("fixed", |style, arguments| {
            style.digits = Some(Asked::Fixed(digits(arguments)?));
            Ok(())
        }),
        ("significant", |style, arguments| {
            style.digits = Some(Asked::Significant(digits(arguments)?));
            Ok(())
        }),
    ];
    for (name, change) in changes {
        tera.register_filter(name, move |text: &str, arguments: Kwargs, _: &State| {
            let mut mark = Mark::read(text).ok_or_else(|| {
                tera::Error::message(format!("`{name}` is a filter of values such as v.p_crit"))
            })?;
            change(&mut mark.style, &arguments)?;
            Ok::<_, tera::Error>(mark.write())
        });
    }
    tera.register_function("literal", |arguments: Kwargs, _: &State| {
        let text: String = arguments.must_get("text")?;
        let why: String = arguments.must_get("why")?;
        if why.trim().is_empty() {
            return Err(tera::Error::message("`literal` needs its reason in `why`"));
        }
        Ok(text)
    });
    tera.register_function("code", |arguments: Kwargs, _: &State| {
        let item: String = arguments.must_get("item")?;
        literate::item(&item).map_err(tera::Error::message)?;
        Ok::<_, tera::Error>(format!("```rust {item}\n```"))
    });
}

#[cfg(test)]
mod tests {
    use super::super::Value;
    use super::*;

    fn fill(text: &str) -> Result<String, Error> {
        let mut values = Registry::new();
        values.add(Value::real("p_crit", 0.0122, 3)).unwrap();
        values.add(Value::printed("printed.rise", "0.12", "Sec. 2")).unwrap();
        let templates = Templates::of([("report.md", text)]);
        Filler::new(&templates, &values)?.fill("report.md")
    }

    #[test]
    fn the_embedded_copy_is_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("templates");
        assert_eq!(Templates::embedded(), Templates::read(&folder).unwrap());
    }

    #[test]
    fn a_value_is_a_mark_that_filters_change() {
        let filled =
            fill(r"$x^{{2}}$ {% «v.p_crit» and «printed.rise | percent | fixed(digits=1)»")
                .unwrap();
        let pieces = Mark::split(&filled);
        assert_eq!(pieces.len(), 4);
        assert_eq!(pieces[0], Err(r"$x^{{2}}$ {% "));
        assert_eq!(pieces[1], Ok(Mark { id: "p_crit".into(), style: Style::default() }));
        let style = Style { percent: true, digits: Some(Asked::Fixed(1)), ..Style::default() };
        assert_eq!(pieces[3], Ok(Mark { id: "printed.rise".into(), style }));
    }

    #[test]
    fn conditions_see_plain_numbers() {
        let text = "<% if raw.p_crit < raw.printed.rise %>below<% else %>above<% endif %>";
        assert_eq!(fill(text).unwrap(), "below");
    }

    #[test]
    fn an_unknown_name_is_an_error_with_its_place() {
        for text in
            ["one\n  «v.p_krit»", "one\n  «w.p_crit»", "one\n  <% if raw.nix > 1 %>x<% endif %>"]
        {
            let error = fill(text).unwrap_err().to_string();
            assert!(error.starts_with("report.md:2:"), "{error}");
            assert!(!error.contains('\n'), "{error}");
        }
        let error = fill("«v.p_krit»").unwrap_err().to_string();
        assert!(error.ends_with("Names that begin alike: p_crit."), "{error}");
    }

    #[test]
    fn a_wrong_filter_is_an_error_with_its_place() {
        for text in ["\n«v.p_crit | percents»", "\n«v.p_crit | fixed»", "\n«\"text\" | percent»"]
        {
            let error = fill(text).unwrap_err().to_string();
            assert!(error.contains("report.md:2:"), "{error}");
        }
    }

    #[test]
    fn an_item_that_is_gone_is_an_error_with_its_place() {
        assert!(fill("«code(item=\"circuits::jump::p_jump\")»").is_ok());
        let error =
            fill("one\n\n  «code(item=\"circuits::jump::p_yump\")»").unwrap_err().to_string();
        assert!(error.starts_with("report.md:3:"), "{error}");
        assert!(error.contains("no item `circuits::jump::p_yump`"), "{error}");
        assert!(!error.contains('\n'), "{error}");
    }

    #[test]
    fn a_literal_needs_its_reason() {
        let text = "«literal(text=\"2007\", why=\"year of the paper\")»";
        assert_eq!(fill(text).unwrap(), "2007");
        assert!(fill("«literal(text=\"2007\", why=\" \")»").is_err());
    }
}
