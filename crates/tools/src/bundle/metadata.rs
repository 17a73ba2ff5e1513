//! ro-crate-metadata.json: what the archive is, for machines (RO-Crate 1.2).

use super::archive::Archive;
use super::told::description;
use impact_paper::input;
use impact_paper::program::{Failure, about};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// The name that RO-Crate demands.
pub const NAME: &str = "ro-crate-metadata.json";

/// The day of release, from CITATION.cff: an archive knows no clock.
///
/// # Errors
/// Exit code 2 if that file names none.
pub fn released(root: &Path) -> Result<String, Failure> {
    let fault = |what: &str| {
        Failure::input(format!("CITATION.cff: {what}; name the day as `date-released: 2026-01-31`"))
    };
    let text = input::read(&root.join("CITATION.cff")).map_err(|e| fault(&e.to_string()))?;
    let line = text.lines().find_map(|line| line.strip_prefix("date-released:"));
    let day = line.map(|day| day.trim().trim_matches(['"', '\'']));
    let day = day.ok_or_else(|| fault("there is no date-released"))?;
    let form = |(i, c): (usize, char)| if i == 4 || i == 7 { c == '-' } else { c.is_ascii_digit() };
    if day.len() != 10 || !day.chars().enumerate().all(form) {
        return Err(fault("date-released is no day"));
    }
    Ok(day.into())
}

/// The metadata of an archive that has all its other files.
pub fn text(archive: &Archive, revision: &str, released: &str) -> String {
    let id = |id: &str| json!({ "@id": id });
    // A folder at the top is a part of the whole, with its files; of the crates there are too many.
    let mut folders: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    let mut files = Vec::new();
    let mut single = Vec::new();
    for path in archive.paths() {
        match path.split_once('/') {
            Some(("vendor", _)) => drop(folders.entry("vendor/".into()).or_default()),
            Some((folder, _)) => {
                folders.entry(format!("{folder}/")).or_default().push(path);
                files.push(path);
            }
            None => {
                single.push(path);
                files.push(path);
            }
        }
    }
    let parts = |paths: &[&str]| -> Vec<Value> { paths.iter().map(|path| id(path)).collect() };
    let outputs = parts(folders.get("paper/").map_or(&[], Vec::as_slice));
    let mut whole: Vec<Value> = folders.keys().map(|path| id(path)).collect();
    whole.extend(parts(&single));
    whole.push(id(SUMS));
    let mut graph = vec![
        json!({
            "@id": NAME,
            "@type": "CreativeWork",
            "about": id("./"),
            "conformsTo": id("https://w3id.org/ro/crate/1.2"),
        }),
        json!({
            "@id": "./",
            "@type": "Dataset",
            "name": format!("impact-paper {}", about::VERSION),
            "description": about::DESCRIPTION,
            "datePublished": released,
            "version": about::VERSION,
            "identifier": id("#revision"),
            "author": id(AUTHORS),
            "publisher": id(AUTHORS),
            "license": [id(MIT), id(APACHE)],
            "mainEntity": id(PROGRAM),
            "isBasedOn": id("#paper"),
            "mentions": id("#run"),
            "hasPart": whole,
        }),
        json!({
            "@id": "#revision",
            "@type": "PropertyValue",
            "name": "git commit",
            "propertyID": "https://git-scm.com/docs/gitglossary#def_SHA1",
            "value": revision,
        }),
        json!({
            "@id": AUTHORS,
            "@type": "Organization",
            "name": about::AUTHORS,
        }),
        json!({
            "@id": MIT,
            "@type": "CreativeWork",
            "name": "MIT License",
            "description": "At the choice of who uses it; the text is in LICENSE-MIT.",
        }),
        json!({
            "@id": APACHE,
            "@type": "CreativeWork",
            "name": "Apache License 2.0",
            "description": "At the choice of who uses it; the text is in LICENSE-APACHE.",
        }),
        json!({
            "@id": "#rust",
            "@type": "ComputerLanguage",
            "name": "Rust",
            "version": about::RUST_VERSION,
            "url": id("https://www.rust-lang.org/"),
        }),
        json!({
            "@id": "https://www.rust-lang.org/",
            "@type": "WebSite",
            "name": "Rust",
        }),
        json!({
            "@id": "#paper",
            "@type": "ScholarlyArticle",
            "name": "Impact Dynamics of Large Dimensional Systems",
            "author": [id("#homer"), id("#hogan")],
            "datePublished": "2007",
            "isPartOf": id("#journal"),
        }),
        json!({ "@id": "#homer", "@type": "Person", "name": "Martin Homer" }),
        json!({ "@id": "#hogan", "@type": "Person", "name": "S. John Hogan" }),
        json!({
            "@id": "#journal",
            "@type": "Periodical",
            "name": "International Journal of Bifurcation and Chaos",
        }),
        json!({
            "@id": "#run",
            "@type": "CreateAction",
            "name": "impact-paper paper",
            "description": "Ran every experiment, drew every figure and wrote the report.",
            "instrument": id(PROGRAM),
            "object": id("templates/"),
            "result": outputs,
            "endTime": released,
        }),
    ];
    graph.extend(folders.iter().map(|(folder, files)| {
        let mut dataset = json!({
            "@id": folder,
            "@type": "Dataset",
            "name": folder,
            "description": description(folder),
        });
        match files.as_slice() {
            [] => (),
            [one] => dataset["hasPart"] = id(one),
            all => dataset["hasPart"] = json!(parts(all)),
        }
        dataset
    }));
    let file = |path: &str, size: usize| {
        json!({
            "@id": path,
            "@type": "File",
            "name": path,
            "description": description(path),
            "encodingFormat": format(path),
            "contentSize": size.to_string(),
        })
    };
    for path in files {
        let Some((digest, size)) = archive.get(path) else { continue };
        let mut file = file(path, *size);
        file["sha256"] = json!(digest);
        if path == PROGRAM {
            file["@type"] = json!(["File", "SoftwareSourceCode"]);
            file["version"] = json!(about::VERSION);
            file["programmingLanguage"] = id("#rust");
        }
        graph.push(file);
    }
    // The list of digests comes last and lists this file too: 64 digits, two blanks, path, line end.
    let listed = archive.paths().chain([NAME]).map(|path| 64 + 2 + path.len() + 1).sum();
    graph.push(file(SUMS, listed));
    let context = "https://w3id.org/ro/crate/1.2/context";
    let whole = json!({ "@context": context, "@graph": graph });
    format!("{whole:#}\n")
}

/// Where the program begins.
const PROGRAM: &str = "src/main.rs";
const AUTHORS: &str = "#authors";
const MIT: &str = "https://spdx.org/licenses/MIT";
const APACHE: &str = "https://spdx.org/licenses/Apache-2.0";
const SUMS: &str = impact_paper::report::sums::NAME;

/// The media type of a file, by its name.
fn format(path: &str) -> &'static str {
    match path.rsplit_once('.').map(|(_, end)| end) {
        Some("md") => "text/markdown",
        Some("svg") => "image/svg+xml",
        Some("csv") => "text/csv",
        Some("json") => "application/json",
        Some("tex") => "application/x-tex",
        Some("html") => "text/html",
        Some("pdf") => "application/pdf",
        Some("toml") => "application/toml",
        Some("cff" | "yml") => "application/yaml",
        Some("rs") => "text/x-rust",
        Some("js") => "text/javascript",
        Some("css") => "text/css",
        Some("ttf" | "otf") => "font/sfnt",
        Some("py") => "text/x-python",
        _ => "text/plain",
    }
}
