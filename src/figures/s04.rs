//! Fig. S4: chains from rest and from above after several transients.

use super::FORCING;
use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::branches::{self, Both, share};
use literate::table::Table;

/// The window of the half heights.
const WINDOW: f64 = 200.0;

/// The branches: column, name, colour.
const BRANCHES: [(&str, &str, Colour); 2] =
    [("from_rest", "from rest", BLUE), ("from_above", "from above", RED)];

/// Marks and colours of the other lengths, all from rest.
const LENGTHS: [(Mark, Colour); 3] =
    [(Mark::Ring, PURPLE), (Mark::OpenSquare, GREEN), (Mark::Diamond, ORANGE)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let both = results.table("branches.half_heights")?;
    let sheet = Sheet::new(6050);
    half_heights(&sheet, results, both)?;
    shares(&sheet, &branches::both(results.of(&crate::experiments::BRANCHES)?))?;
    Ok(sheet.finish("s04", "Chains from rest and from above", description(both)))
}

fn half_heights(sheet: &Sheet, results: &Results, both: &Table) -> Result<(), Error> {
    let x = Axis::decades(1, 6, 1, "transient *T* (1/*ω*)").from(30.0, 5e5);
    let y = Axis::linear(0.06, 0.14, 0.01, 2, "*σ*_{1/2} (*d ω*^{2})")
        .column("half_height (d omega^2)");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 4250, 3930), x, y)?;
    let bound = Stroke::dashed(INK, THIN, Dash::Dotted);
    panel.level("bound by seeds", results.number("theory.relation.sigma_kept_half")?, bound)?;
    let map = results.table("protocol.cells")?;
    let map = map.points(&[("window", WINDOW)], "transient", "half_height_all");
    let line = Stroke::solid(PURPLE, HAIR);
    panel.curve("map, n = 100", &map, line, Outside::Cut)?;
    let mut entries = Vec::new();
    for (column, name, colour) in BRANCHES {
        let look = (Mark::Disc, MEDIUM, Stroke::solid(colour, THIN));
        panel.joined(name, &both.estimates(&[], "transient", column), look)?;
        entries.push(Entry::both(look.2, look, &format!("{name}, long chains")));
    }
    let lengths = results.table("branches.lengths")?;
    for (masses, (mark, colour)) in lengths.values("masses").into_iter().zip(LENGTHS) {
        let look = (mark, LARGE, Stroke::solid(colour, THIN));
        let (name, keys) =
            (format!("from rest, *n* = {masses}"), [("masses", masses), ("window", WINDOW)]);
        panel.estimates(&name, &lengths.estimates(&keys, "transient", "half_height"), look)?;
        entries.push(Entry::mark(look, &name));
    }
    entries.push(Entry::line(line, "the map, *n* = 100"));
    entries.push(Entry::line(bound, "bound from rest, *n* = 100"));
    sheet.legend((1150, 4800), (SMALL, 340), (4, 3900), &entries)
}

/// Shares after the first transient and after the last.
fn shares(sheet: &Sheet, both: &[Both<'_>]) -> Result<(), Error> {
    let x = Axis::linear(0.03, 0.145, 0.02, 2, FORCING);
    let y = Axis::linear(0.0, 1.0, 0.2, 2, "share of the gaps");
    let panel = sheet.lettered(LETTERS[1], Frame::new(5150, 430, 8250, 3930), x, y)?;
    let ends = [both.first(), both.last()].into_iter().flatten();
    for (own, (dash, mark)) in ends.zip([(Dash::Short, Mark::Ring), (Dash::Solid, Mark::Disc)]) {
        for ((_, name, colour), branch) in BRANCHES.into_iter().zip([own.rest, own.above]) {
            let name = format!("{name}, *T* = {}", own.transient());
            let at = |&sigma: &f64| Some((sigma, share(branch, sigma)?));
            let points: Vec<_> = branch.0.ensemble.sigmas.iter().filter_map(at).collect();
            panel.joined(&name, &points, (mark, MEDIUM, Stroke::dashed(colour, THIN, dash)))?;
        }
    }
    Ok(())
}

fn description(both: &Table) -> Seen {
    let ends = |column| {
        let places = both.points(&[], "transient", column);
        let ends = places.first().zip(places.last());
        ends.map_or("none".into(), |(first, last)| {
            format!("from {} to {}", short(first.1, 3), short(last.1, 3))
        })
    };
    seen!(
        "(a) Half height against T: from rest it falls, {}; from above it rises, {}. (b) Share of gaps with an impact against σ, \
         early and late: two curves far apart that approach.",
        ends("from_rest"),
        ends("from_above"),
    )
}
