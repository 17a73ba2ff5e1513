//! Fig. S13: digits of the ways to compute p(σ) and P(X = k).

use super::FORCING;
use super::prelude::*;
use crate::experiments::accuracy::analytic::{Analytic, Route, Way};

/// Errors are drawn from here on, and up to one: a larger error has no digit left either.
const LOWEST: i32 = -18;

/// Smaller errors are luck.
const FLOOR: f64 = 1e-17;

fn route(route: Route) -> (String, Stroke) {
    match route {
        Route::DoubleIntegral { panels: 1 } => {
            ("one minus the double integral".into(), Stroke::dashed(ORANGE, LINE, Dash::Short))
        }
        Route::DoubleIntegral { panels } => (
            format!("the same, {panels} × {panels} panels"),
            Stroke::dashed(BLUE, LINE, Dash::Long),
        ),
        Route::SingleIntegral => {
            ("one minus a single integral".into(), Stroke::dashed(GREEN, LINE, Dash::Dotted))
        }
        Route::ClosedForm => ("closed form".into(), Stroke::solid(RED, LINE)),
    }
}

fn way(way: Way) -> (&'static str, Colour, Mark) {
    match way {
        Way::Factorials => ("factorials", ORANGE, Mark::Square),
        Way::LogGamma => ("log-gamma", BLUE, Mark::Ring),
        Way::Ratios => ("ratios of terms", GREEN, Mark::Diamond),
        Way::Products => ("products, 106 bits", RED, Mark::Disc),
    }
}

pub fn draw(analytic: &Analytic) -> Result<Figure, Error> {
    let sheet = Sheet::new(10_300);
    let errors = |highest: i32| Axis::decades(LOWEST, highest, 3, "relative error");
    let sigmas = analytic.parameters.sigmas.iter().copied();
    let sigma = Axis::around(sigmas, 1, FORCING);
    let relation = Frame::new(1250, 430, 8150, 3330);
    let relation = sheet.lettered(LETTERS[0], relation, sigma, errors(1))?;
    let shown = |error: f64| error.clamp(FLOOR, 1.0);
    let mut entries = Vec::new();
    for own in &analytic.relation {
        let (name, stroke) = route(own.route);
        let points: Vec<_> = own.points.iter().map(|p| (p.0, shown(p.1))).collect();
        relation.curve(&name, &points, stroke, Outside::Edge)?;
        entries.push(Entry::line(stroke, &name));
    }
    sheet.legend_in_columns((400, 4500), (SMALL, 370), (2, 4250), &entries)?;

    let sizes = analytic.parameters.sizes.iter().map(|&n| n as f64);
    let big_n = Axis::around(sizes, 1, "number of vertices *N*");
    let distribution = Frame::new(1250, 5700, 8150, 8600);
    let distribution = sheet.lettered(LETTERS[1], distribution, big_n, errors(-6))?;
    let mut entries = Vec::new();
    for own in &analytic.distribution {
        let (name, colour, mark) = way(own.way);
        let points = own.points.iter().filter_map(|p| Some((p.big_n as f64, shown(p.error?))));
        let points: Vec<_> = points.collect();
        let look = (mark, 58, Stroke::solid(colour, THIN));
        distribution.marked(name, &points, (look.2, look), Outside::Edge)?;
        entries.push(Entry::mark(look, name));
    }
    sheet.legend_in_columns((400, 9750), (SMALL, 370), (2, 4250), &entries)?;
    Ok(sheet.finish("s13", "Digits of the analytic methods", description(analytic)))
}

fn description(analytic: &Analytic) -> String {
    format!(
        "Relative errors on logarithmic axes. (a) Of p(σ) against σ: the closed form is level at rounding; one minus an integral loses \
         all digits towards small σ. (b) Of P(X = k) and its mean against N, N p = {}: factorials end early, logarithms of \
         the gamma function lose digits with N, ratios of terms and products keep theirs.",
        analytic.parameters.mean_degree,
    )
}
