//! What a file or folder of the archive is, in a few words.

use super::PAPER;
use impact_paper::report::{Document, PROGRAM};

/// A path; a folder ends with a slash.
pub fn description(path: &str) -> String {
    if let Some(output) = path.strip_prefix(PAPER).and_then(|path| path.strip_prefix('/')) {
        return of_output(output);
    }
    let what = match path {
        "src/" => "The program: experiments, calculations, figures, report, checks.",
        "build/" => "The build script: homes of equations, and what results depend on.",
        "crates/" => {
            "What the program is built on, its mathematics and the simulation of chains; and the project's tools."
        }
        "templates/" => {
            "The prose with places for numbers, the numbers that the paper printed, fonts."
        }
        "tests/" => "What proves the program.",
        "benches/" => "How fast the engine and other projects are.",
        "vendor/" => "The source of every crate that the program is built of.",
        "results/" => "Saved results of the long experiments.",
        "src/main.rs" => "The program that makes the report; all of src/ belongs to it.",
        "Cargo.toml" => "What the program is built of.",
        "Cargo.lock" => "The exact version of every crate.",
        "rust-toolchain.toml" => "The version of Rust.",
        "Makefile" => "The commands, one line each.",
        "README.md" => "How to run it.",
        "DESIGN.md" => "Why things are as they are.",
        "CHANGELOG.md" => "What changed.",
        "CITATION.cff" => "How to cite it.",
        "LICENSE-MIT" | "LICENSE-APACHE" => "Licence, at the choice of who uses it.",
        "SHA256SUMS" => "SHA-256 of every other file.",
        _ => match path.split_once('/').map(|(folder, _)| folder) {
            Some("src" | "build" | "crates") => "Source of the program.",
            Some("tests" | "benches") => "Source of a test or benchmark.",
            Some("templates") => "Prose, printed numbers, fonts or scenarios.",
            Some("results") => "Saved result of an experiment, with all that it was made of.",
            _ => "Settings.",
        },
    };
    what.into()
}

/// A file of the report.
fn of_output(path: &str) -> String {
    for Document { name, markdown, page, print, .. } in PROGRAM.documents {
        let printed = |ending: &str| print.is_some_and(|stem| path == format!("{stem}.{ending}"));
        match path {
            _ if path == *markdown => return format!("{name}, as hosts show it."),
            _ if path == *page => {
                return format!("{name}, for browsers; each number opens its origin.");
            }
            _ if printed("tex") => return format!("{name}, for LaTeX."),
            _ if printed("pdf") => return format!("{name}, typeset."),
            _ => (),
        }
    }
    let what = match path {
        "" => "The report: figures, data, every number.",
        "values.json" => "Every number that the report states, with its origin.",
        "ledger.json" => "Every claim of the paper with its verdict.",
        "SHA256SUMS" => "SHA-256 of every other file of the report.",
        "SHA256SUMS.local" => "SHA-256 of what is built beside the report.",
        _ => {
            let name = path.rsplit('/').next().unwrap_or(path);
            let figure = figure(name);
            return match (path.split('/').next(), figure) {
                (Some("figures"), Some(figure)) => format!("{figure}."),
                (Some("data"), Some(figure)) => format!("Data of {figure}."),
                (Some("data"), None) => "A table of an experiment, whole.".into(),
                _ => "A part of the report.".into(),
            };
        }
    };
    what.into()
}

/// `fig03.svg` is Figure 3 of the paper, `s01a.csv` Figure S1 of this edition.
fn figure(name: &str) -> Option<String> {
    let (digits, own) = match name.strip_prefix("fig") {
        Some(digits) => (digits, false),
        None => (name.strip_prefix('s')?, true),
    };
    let number: u8 = digits.get(..2)?.parse().ok()?;
    Some(if own {
        format!("Figure S{number} of this edition")
    } else {
        format!("Figure {number} of the paper")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_told_by_their_number() {
        assert_eq!(description("paper/figures/fig03.svg"), "Figure 3 of the paper.");
        assert_eq!(description("paper/data/fig10a-phi.csv"), "Data of Figure 10 of the paper.");
        assert_eq!(description("paper/data/s01a.csv"), "Data of Figure S1 of this edition.");
        assert_eq!(description("paper/data/seeds-waits.csv"), "A table of an experiment, whole.");
        assert_eq!(description("paper/figures/salt.svg"), "A part of the report.");
        assert_eq!(description("paper/"), "The report: figures, data, every number.");
        assert_eq!(description("papers"), "Settings.");
    }
}
