//! What the past of a chain does to the count.

use super::places::between;
use super::{Guard, Look, far, unless};
use crate::experiments::history::{History, Lowered};
use crate::report::values::cell;

pub const GUARDS: &[Guard] = &[
    Guard { name: "history_of_counts", ids: &["history.s*", "history_coldest*"], find: counts },
    Guard {
        name: "history_half_heights",
        ids: &["history.half_*", "history_half_*", "history_rest_*"],
        find: halves,
    },
    Guard { name: "history_as_run", ids: &["history.t*", "history_*"], find: as_run },
    Guard { name: "no_seed_without_a_past", ids: &["history.s*"], find: more_than_rest },
];

fn history(look: Look<'_>) -> Option<&History> {
    look.results.history().ok()
}

fn mean(counts: &[u64]) -> f64 {
    counts.iter().sum::<u64>() as f64 / counts.len() as f64
}

fn id(row: &Lowered, column: &str) -> String {
    cell("history", row.sigma, column)
}

/// Means are those of the counts, and the table has them.
fn counts(look: Look<'_>) -> Option<String> {
    let history = history(look)?;
    let transients = &history.parameters.transients;
    let row = |row: &Lowered| {
        let swept = look.results.sweep().ok()?.rows.iter().find(|own| own.sigma == row.sigma);
        let rest = || {
            let own = swept?;
            let all: u32 = own.counts.iter().sum();
            let sum: f64 =
                (0_u32..).zip(&own.counts).map(|(k, &c)| f64::from(k) * f64::from(c)).sum();
            look.is(&id(row, "rest"), sum / f64::from(all))
        };
        let cell = |(i, transient): (usize, &f64)| {
            let alive = row.counts[i].iter().filter(|&&k| k > 0).count() as u64;
            far("a mean after heating", row.means[i]?.value, mean(&row.counts[i]))
                .or_else(|| look.is(&id(row, &format!("t{transient}")), mean(&row.counts[i])))
                .or_else(|| {
                    unless(alive == row.alive[i], || format!("{alive} chains with impacts"))
                })
        };
        look.is(&id(row, "sigma"), row.sigma)
            .or_else(rest)
            .or_else(|| transients.iter().enumerate().find_map(cell))
    };
    let coldest = || {
        let first = history.rows.first()?;
        look.is("history_coldest", first.sigma)
            .or_else(|| look.is("history_coldest_count", mean(first.counts.last()?)))
    };
    history.rows.iter().find_map(row).or_else(coldest)
}

/// At half height the curve through the means has half of all gaps.
fn halves(look: Look<'_>) -> Option<String> {
    let history = history(look)?;
    let transients = &history.parameters.transients;
    let half = 0.5 * history.parameters.chain.gaps() as f64;
    let one = |(i, transient): (usize, &f64)| {
        let points: Vec<(f64, f64)> =
            history.rows.iter().map(|row| (row.sigma, mean(&row.counts[i]))).collect();
        let found = history.half_heights[i]?.value;
        match between(&points, found) {
            Some(height) => far("the count at half height", height, half),
            None => Some(format!("no count at half height {found}")),
        }
        .or_else(|| look.is(&format!("history.half_t{transient}"), found))
    };
    let named = |(letter, i): (&str, usize)| {
        let rest = || {
            let map = look.results.protocol().ok()?;
            let cell = map.cell(transients[i], history.parameters.window)?;
            look.is(&format!("history_rest_{letter}"), cell.half_height_all?.value)
        };
        look.is(&format!("history_half_{letter}"), history.half_heights[i]?.value).or_else(rest)
    };
    transients
        .iter()
        .enumerate()
        .find_map(one)
        .or_else(|| named(("a", 0)))
        .or_else(|| named(("b", transients.len() - 1)))
}

/// Sizes are those of what was run.
fn as_run(look: Look<'_>) -> Option<String> {
    let history = history(look)?;
    let parameters = &history.parameters;
    let runs = |row: &Lowered| {
        let ran = row.counts.first()?.len() as u64 + row.failed;
        look.is("history_realisations", ran as f64)
    };
    // The first column is read with the protocol of the main sweep, beside which it stands.
    let protocol = look.results.sweep().ok()?.parameters.protocol;
    let heads = parameters.transients.iter();
    let mut heads = heads.map(|time| look.is(&format!("history.t{}", *time as u64), *time));
    history
        .rows
        .iter()
        .find_map(runs)
        .or_else(|| heads.find_map(|off| off))
        .or_else(|| look.is("history_window", protocol.window))
        .or_else(|| look.is("history_transient_a", protocol.transient))
        .or_else(|| look.is("history_transient_b", *parameters.transients.last()?))
}

/// Who was heated has at least as many impacts as who starts from rest, but for chance: five standard
/// errors of both.
fn more_than_rest(look: Look<'_>) -> Option<String> {
    let history = history(look)?;
    history.rows.iter().find_map(|row| {
        let swept = look.results.sweep().ok()?.rows.iter().find(|own| own.sigma == row.sigma)?;
        let [rest, error] = crate::experiments::sweep::tables::mean_all(swept)?;
        let own = row.means.first().copied()??;
        let room = 5.0 * (error * error + own.error * own.error).sqrt();
        unless(own.value >= rest - room, || {
            format!("{} after heating, {rest} from rest, at {}", own.value, row.sigma)
        })
    })
}
