//! The ledger: every claim, figure and numbered equation of the paper, and its status.

use super::claims::plain;
use super::equations::{EQUATIONS, Equation, Home, homes};
use super::markdown::escaped;
use crate::claims::Claim;
use crate::figures::Figure;
use serde::Serialize;

#[derive(Serialize)]
struct Ledger<'a> {
    claims: Vec<ClaimEntry<'a>>,
    figures: Vec<FigureEntry<'a>>,
    equations: Vec<EquationEntry>,
}

#[derive(Serialize)]
struct ClaimEntry<'a> {
    id: &'a str,
    place: &'a str,
    statement: &'a str,
    printed: &'a str,
    ours: String,
    tolerance: String,
    reason: &'a str,
    verdict: &'static str,
    note: String,
}

#[derive(Serialize)]
struct FigureEntry<'a> {
    id: &'a str,
    title: &'a str,
    picture: String,
    data: Vec<String>,
    source: String,
}

#[derive(Serialize)]
struct EquationEntry {
    number: u32,
    section: u32,
    what: &'static str,
    home: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    step_towards: Option<&'static str>,
}

fn ledger<'a>(claims: &'a [Claim], figures: &'a [Figure]) -> Ledger<'a> {
    let claim = |claim: &'a Claim| ClaimEntry {
        id: &claim.id,
        place: &claim.place,
        statement: &claim.statement,
        printed: &claim.printed,
        ours: plain(&claim.ours),
        tolerance: plain(&claim.tolerance),
        reason: &claim.reason,
        verdict: claim.verdict.words(),
        note: plain(&claim.note),
    };
    let figure = |figure: &'a Figure| FigureEntry {
        id: &figure.id,
        title: &figure.title,
        picture: format!("figures/{}.svg", figure.id),
        data: figure.data.iter().map(|data| format!("data/{}", data.name)).collect(),
        source: format!("figures::{}", figure.id),
    };
    let entry = |equation: Equation, home: Home| EquationEntry {
        number: equation.number,
        section: equation.section,
        what: equation.what,
        home: home.item,
        step_towards: home.step_towards(),
    };
    let of = |equation: Equation| homes(equation.number).map(move |home| entry(equation, home));
    Ledger {
        claims: claims.iter().map(claim).collect(),
        figures: figures.iter().map(figure).collect(),
        equations: EQUATIONS.into_iter().flat_map(of).collect(),
    }
}

/// ledger.json.
pub fn json(claims: &[Claim], figures: &[Figure]) -> serde_json::Result<String> {
    Ok(serde_json::to_string_pretty(&ledger(claims, figures))? + "\n")
}

/// ledger.md.
pub fn markdown(claims: &[Claim], figures: &[Figure]) -> String {
    let ledger = ledger(claims, figures);
    let mut out = String::from(
        "# Ledger\n\nEvery quantitative statement, figure and numbered equation of the paper, and \
         what became of it here. Written by the program, as [ledger.json](ledger.json) is.\n\n\
         ## Statements\n\n| Place | Statement | Printed | Ours | Verdict | Id |\n|---|---|---|---|---|---|\n",
    );
    for claim in &ledger.claims {
        let words = [claim.place, claim.statement, claim.printed, &claim.ours];
        let cells = words.map(escaped).join(" | ");
        out.push_str(&format!("| {cells} | {} | `{}` |\n", claim.verdict, claim.id));
    }
    out.push_str("\n## Figures\n\n| Figure | Title | Data | Drawn by |\n|---|---|---|---|\n");
    for figure in &ledger.figures {
        let link = |path: &String| format!("[{path}]({path})");
        let data: Vec<String> = figure.data.iter().map(link).collect();
        let (title, picture) = (escaped(figure.title), &figure.picture);
        let data = data.join(", ");
        out.push_str(&format!(
            "| [{}]({picture}) | {title} | {data} | `{}` |\n",
            figure.id, figure.source
        ));
    }
    out.push_str(
        "\n## Equations\n\n| Equation | Section | What it says | Home |\n|---|---|---|---|\n",
    );
    for equation in &ledger.equations {
        let step = equation.step_towards.map(|n| format!(", step towards {n}")).unwrap_or_default();
        let (number, section, what) = (equation.number, equation.section, escaped(equation.what));
        out.push_str(&format!("| ({number}) | {section} | {what} | `{}`{step} |\n", equation.home));
    }
    out
}
