//! The map of README.md: where each section, equation, figure and statement of the paper lives.
//!
//! `tests/report/structure.rs` compares it with the README; with `IMPACT_PAPER_REWRITE=1` in the
//! environment that test writes it.

use super::PROGRAM;
use super::equations::{EQUATIONS, homes};
use crate::claims::{self, PublishedError};
use std::fmt::Write as _;

struct Section {
    number: u32,
    title: &'static str,
    /// Modules beside those where its equations live.
    modules: &'static [&'static str],
    figures: &'static [u32],
}

const fn section(
    number: u32,
    title: &'static str,
    modules: &'static [&'static str],
    figures: &'static [u32],
) -> Section {
    Section { number, title, modules, figures }
}

const SECTIONS: [Section; 10] = [
    section(1, "The chain", &[], &[1]),
    section(
        2,
        "Simulations",
        &["crates/impact-chain/src/engine.rs", "src/experiments/sweep/mod.rs"],
        &[2, 3],
    ),
    section(
        3,
        "The graph",
        &["crates/circuits/src/graph.rs", "src/experiments/segments.rs"],
        &[4, 5, 6],
    ),
    section(4, "Periodic orbits", &["crates/circuits/src/graph.rs"], &[]),
    section(5, "Distribution of orbits", &[], &[7]),
    section(6, "Probability", &[], &[8, 9]),
    section(7, "The jump", &[], &[10]),
    section(8, "A relation between σ and p", &[], &[11, 12]),
    section(9, "Circuits that are not simple", &[], &[13, 14, 15]),
    section(10, "Conclusions", &[], &[]),
];

/// The two tables, as Markdown with links relative to the top of the repository.
pub fn markdown() -> Result<String, PublishedError> {
    let published = claims::published()?;
    let mut out = String::from(
        "| Section of the paper | Equations | Code | Figures | Statements |\n|---|---|---|---|---|\n",
    );
    for section in SECTIONS {
        let numbers: Vec<u32> =
            EQUATIONS.iter().filter(|e| e.section == section.number).map(|e| e.number).collect();
        let range = match numbers.as_slice() {
            [] => String::new(),
            [one] => format!("({one})"),
            [first, .., last] => format!("({first})–({last})"),
        };
        let mut files: Vec<&str> = numbers.iter().flat_map(|n| homes(*n)).map(|h| h.file).collect();
        files.extend(section.modules);
        files.sort_unstable();
        files.dedup();
        let code: Vec<String> = files.iter().map(|file| link(file)).collect();
        let figure = |n: &u32| format!("[{n}](paper/figures/fig{n:02}.svg)");
        let figures: Vec<String> = section.figures.iter().map(figure).collect();
        let prefix = format!("sec{}_", section.number);
        let claims = published.statements.iter().filter(|s| s.id.starts_with(&prefix)).count();
        let claims =
            if claims == 0 { String::new() } else { format!("[{claims}](paper/ledger.md)") };
        let _ = writeln!(
            out,
            "| {} {} | {range} | {} | {} | {claims} |",
            section.number,
            section.title,
            code.join("<br>"),
            figures.join(", ")
        );
    }
    out.push_str("\n| Equation | What it says | Home |\n|---|---|---|\n");
    for equation in EQUATIONS {
        let home = |home: super::equations::Home| {
            let step = home.step_towards().map(|n| format!(" (step towards {n})"));
            format!("[`{}`]({}){}", home.item, home.file, step.unwrap_or_default())
        };
        let homes: Vec<String> = homes(equation.number).map(home).collect();
        let what = super::markdown::escaped(equation.what);
        let _ = writeln!(out, "| ({}) | {what} | {} |", equation.number, homes.join(", "));
    }
    Ok(out)
}

/// `crates/circuits/src/jump.rs` → a link that is called `circuits::jump`.
fn link(file: &str) -> String {
    let module =
        PROGRAM.sources.iter().find(|(_, own, _)| *own == file).map_or(file, |(module, ..)| module);
    format!("[`{module}`]({file})")
}
