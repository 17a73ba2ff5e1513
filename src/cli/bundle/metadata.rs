//! ro-crate-metadata.json: what the archive is, for machines (RO-Crate 1.2).

use super::super::Failure;
use super::PAPER;
use super::archive::Archive;
use impact_paper::input;
use serde_json::{Value, json};
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
    // Folders count as wholes; single files are those at the top and those of the report.
    let mut folders = std::collections::BTreeSet::new();
    let mut files = Vec::new();
    for path in archive.paths() {
        match path.split_once('/') {
            Some((folder, _)) if folder != PAPER => {
                folders.insert(format!("{folder}/"));
            }
            _ => files.push(path.to_string()),
        }
    }
    let outputs: Vec<Value> =
        files.iter().filter(|path| path.starts_with(PAPER)).map(|path| id(path)).collect();
    let parts: Vec<Value> =
        folders.iter().chain(&files).map(|path| id(path)).chain([id(SUMS)]).collect();
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
            "name": concat!("impact-paper ", env!("CARGO_PKG_VERSION")),
            "description": env!("CARGO_PKG_DESCRIPTION"),
            "datePublished": released,
            "version": env!("CARGO_PKG_VERSION"),
            "identifier": format!("git:{revision}"),
            "author": id(AUTHORS),
            "publisher": id(AUTHORS),
            "license": [id(MIT), id(APACHE)],
            "mainEntity": id("#program"),
            "citation": id("#paper"),
            "mentions": id("#run"),
            "hasPart": parts,
        }),
        json!({
            "@id": AUTHORS,
            "@type": "Organization",
            "name": env!("CARGO_PKG_AUTHORS"),
        }),
        json!({
            "@id": "#program",
            "@type": ["SoftwareSourceCode", "SoftwareApplication"],
            "name": env!("CARGO_PKG_NAME"),
            "version": env!("CARGO_PKG_VERSION"),
            "description": env!("CARGO_PKG_DESCRIPTION"),
            "programmingLanguage": id("#rust"),
            "license": [id(MIT), id(APACHE)],
            "author": id(AUTHORS),
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
            "version": env!("CARGO_PKG_RUST_VERSION"),
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
            "instrument": id("#program"),
            "object": id("templates/"),
            "result": outputs,
            "endTime": released,
            "actionStatus": id("http://schema.org/CompletedActionStatus"),
        }),
    ];
    graph.extend(folders.iter().map(|folder| {
        let (name, description) = told_of_folder(folder);
        json!({ "@id": folder, "@type": "Dataset", "name": name, "description": description })
    }));
    graph.extend(files.iter().map(|path| {
        let mut file = json!({
            "@id": path,
            "@type": "File",
            "name": path,
            "encodingFormat": format(path),
        });
        if let Some((digest, size)) = archive.get(path) {
            file["contentSize"] = json!(size.to_string());
            file["sha256"] = json!(digest);
        }
        file
    }));
    graph.push(json!({
        "@id": SUMS,
        "@type": "File",
        "name": SUMS,
        "description": "SHA-256 of every other file",
        "encodingFormat": "text/plain",
    }));
    let context = "https://w3id.org/ro/crate/1.2/context";
    let whole = json!({ "@context": context, "@graph": graph });
    format!("{whole:#}\n")
}

const AUTHORS: &str = "#authors";
const MIT: &str = "https://spdx.org/licenses/MIT";
const APACHE: &str = "https://spdx.org/licenses/Apache-2.0";
const SUMS: &str = impact_paper::report::sums::NAME;

/// What a folder at the top is.
fn told_of_folder(folder: &str) -> (&str, &str) {
    match folder {
        "src/" => ("source", "The program: experiments, calculations, figures, report, checks."),
        "build/" => ("build script", "Finds the homes of equations and what results depend on."),
        "templates/" => {
            ("templates", "The prose with places for numbers, and the printed numbers.")
        }
        "tests/" => ("tests", "What proves the program."),
        "benches/" => ("benchmarks", "How fast the engine and other projects are."),
        "vendor/" => ("crates", "The source of every crate that the program is built of."),
        "results/" => ("results", "Saved results of the long experiments."),
        _ => (folder, "Settings."),
    }
}

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
        _ => "text/plain",
    }
}
