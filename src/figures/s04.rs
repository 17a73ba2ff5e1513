//! Fig. S4: chains from rest and from above after several transients.

use super::FORCING;
use super::prelude::*;
use crate::experiments::Results;
use crate::experiments::branches::{self, Both, share};
use literate::table::Table;

/// The window of the half heights.
const WINDOW: f64 = 200.0;

/// The branches: column, name, colour.
const BRANCHES: [(&str, &str, RGBColor); 2] =
    [("from_rest", "from rest", BLUE), ("from_above", "from above", RED)];

pub fn draw(results: &Results) -> Result<Figure, Error> {
    let both = results.table("branches.half_heights")?;
    let sheet = Sheet::new(8800);
    half_heights(&sheet, results, both)?;
    shares(&sheet, &branches::both(results.of(&crate::experiments::BRANCHES)?))?;
    Ok(sheet.finish("Chains from rest and from above", description(both)))
}

fn half_heights(sheet: &Sheet, results: &Results, both: &Table) -> Drawn {
    let x = Axis::decades(1, 6, 1, "transient *T* (1/*ω*)").between(10.0, 7e5);
    let y = Axis::linear(0.06, 0.14, 0.01, 2, "*σ*_{1/2} (*d ω*^{2})")
        .column("half_height (d omega^2)");
    let panel = sheet.lettered(LETTERS[0], Frame::new(1150, 430, 8150, 3930), x, y)?;
    let bound = results.number("theory.relation.sigma_kept_half")?;
    panel.level("bound by seeds", bound, Stroke::dashed(INK, THIN, Dash::Dotted))?;
    panel.label("bound from rest, *n* = 100", (10.0, bound), (1, 1), INK)?;
    let map = results.table("protocol.cells")?;
    let map = map.points(&[("window", WINDOW)], "transient", "half_height_all");
    panel.curve("from rest, n = 100", &map, Stroke::solid(GREY, LINE), Outside::Cut)?;
    let start = map.get(3).copied().unwrap_or((10.0, bound));
    panel.label_nearby("from rest, *n* = 100", start, (1, -1), GREY)?;
    for (column, name, colour) in BRANCHES {
        let look = (Symbol::Disc, MEDIUM, Stroke::solid(colour, THIN));
        let halves = both.estimates(&[], "transient", column);
        panel.joined_estimates(name, &halves, look)?;
        if let Some((time, half)) = halves.last() {
            panel.label(name, (*time, half.value), (2, 0), colour)?;
        }
    }
    Ok(())
}

/// Shares after the first transient and after the last.
fn shares(sheet: &Sheet, both: &[Both<'_>]) -> Drawn {
    let x = Axis::linear(0.03, 0.145, 0.02, 2, FORCING);
    let y = Axis::linear(0.0, 1.0, 0.2, 2, "share of active gaps");
    let panel = sheet.lettered(LETTERS[1], Frame::new(1150, 5250, 8150, 8000), x, y)?;
    let early = (both.first(), Dash::Short, Symbol::Ring);
    for (pair, dash, mark) in [early, (both.last(), Dash::Solid, Symbol::Disc)] {
        let Some(pair) = pair else { continue };
        // Early curves are named at the side that the others do not reach; late ones have their
        // time.
        let places = [((0.145, 0.07), (-1, 0)), ((0.03, 0.53), (1, 0))];
        let branches = BRANCHES.into_iter().zip([pair.rest, pair.above]).zip(places);
        for (((start, name, colour), branch), (corner, side)) in branches {
            let digits = pair.transient().to_string();
            let time = match digits.strip_prefix('1').filter(|rest| rest.len() > 4) {
                Some(zeros) if zeros.trim_matches('0').is_empty() => {
                    format!("*T* = 10^{{{}}}", zeros.len())
                }
                _ => format!("*T* = {digits}"),
            };
            let (start_name, name) = (name, format!("{name}, {time}"));
            let at = |&sigma: &f64| Some((sigma, share(branch, sigma)?));
            let points: Vec<_> = branch.0.ensemble.sigmas.iter().filter_map(at).collect();
            panel.joined_estimates(
                &name,
                &points,
                (mark, MEDIUM, Stroke::dashed(colour, THIN, dash)),
            )?;
            let late = points.iter().find(|point| point.1.value >= 0.1 && point.0 > 0.06);
            if mark == Symbol::Ring {
                panel.label_nearby(&name, corner, side, colour)?;
            } else if start == "from_rest" {
                let last = points.last().map_or(corner, |point| (point.0, point.1.value));
                panel.label_nearby(start_name, last, (2, -1), colour)?;
                panel.label_nearby(&time, last, (2, 1), colour)?;
            } else if let Some((sigma, at)) = late {
                panel.label_nearby(&name, (*sigma, at.value), (-4, 0), colour)?;
            }
        }
    }
    Ok(())
}

fn description(both: &Table) -> Description {
    let ends = |column| {
        let places = both.points(&[], "transient", column);
        let ends = places.first().zip(places.last());
        ends.map_or("none".into(), |(first, last)| {
            format!("from {} to {}", short(first.1, 3), short(last.1, 3))
        })
    };
    describe!(
        "(a) Half height against T: from rest it falls, {}; from above it rises, {}. (b) Share of gaps with an impact against σ, \
         early and late: two curves far apart that approach.",
        ends("from_rest"),
        ends("from_above"),
    )
}
