//! Fig. S16: digits of the ways to compute p(σ) and P(X = k).

use super::axis::{Axis, log};
use super::chart::LETTERS;
use super::data::cells;
use super::panel::Frame;
use super::rivals::decades_around;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Colour, Dash, GREEN, LINE, Mark, ORANGE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::accuracy::analytic::{Analytic, Route, Way};

/// Errors are drawn from here to one; an error above one has no digit left.
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

/// Draws the figure.
pub fn draw(analytic: &Analytic, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(10_300, note)?;
    let errors = || Axis::decades(LOWEST, 0, 3, "relative error");
    let sigmas = analytic.parameters.sigmas.iter().copied();
    let sigma = decades_around(sigmas, 1, "standard deviation *σ* of the forcing");
    let relation = sheet.panel(Frame::new(1250, 430, 8150, 3330), sigma, errors())?;
    relation.letter(LETTERS[0])?;
    let shown = |error: f64| log(error.max(FLOOR)).min(0.0);
    let mut entries = Vec::new();
    for own in &analytic.relation {
        let (name, stroke) = route(own.route);
        let points: Vec<_> = own.points.iter().map(|p| (log(p.0), shown(p.1))).collect();
        relation.curve(&name, &points, stroke, Outside::Refuse)?;
        entries.push(Entry::line(stroke, &name));
    }
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((400 + 4250 * i as i32, 4500), (SMALL, 370), column)?;
    }

    let sizes = analytic.parameters.sizes.iter().map(|&n| n as f64);
    let big_n = decades_around(sizes, 1, "number of vertices *N*");
    let distribution = sheet.panel(Frame::new(1250, 5700, 8150, 8600), big_n, errors())?;
    distribution.letter(LETTERS[1])?;
    let mut entries = Vec::new();
    for own in &analytic.distribution {
        let (name, colour, mark) = way(own.way);
        let points: Vec<_> = own
            .points
            .iter()
            .filter_map(|p| Some((log(p.big_n as f64), shown(p.error?))))
            .collect();
        let look = (mark, 58, Stroke::solid(colour, THIN));
        distribution.curve(name, &points, Stroke::solid(colour, THIN), Outside::Refuse)?;
        distribution.marks(name, &points, look, Outside::Refuse)?;
        entries.push(Entry::mark(mark, 58, look.2, name));
    }
    for (i, column) in entries.chunks(2).enumerate() {
        sheet.legend((400 + 4250 * i as i32, 9750), (SMALL, 370), column)?;
    }
    let files = tables(analytic);
    Ok(sheet.finish("s16", "Digits of the analytic methods", description(analytic), files))
}

fn description(analytic: &Analytic) -> String {
    format!(
        "Relative errors on logarithmic axes. (a) Of p(σ) against σ: the closed form is level at rounding; one minus an integral loses \
         all digits towards small σ. (b) Of P(X = k) and its mean against N, N p = {}: factorials end early, logarithms of \
         the gamma function lose digits with N, ratios of terms and products keep theirs.",
        analytic.parameters.mean_degree,
    )
}

fn tables(analytic: &Analytic) -> Vec<DataFile> {
    let mut relation = DataFile::new(
        "s16a.csv",
        &["way (text)", "evaluations (1)", "sigma (d omega^2)", "relative_error (1)"],
    );
    for own in &analytic.relation {
        for &(sigma, error) in &own.points {
            let name = route(own.route).0;
            relation.row(cells![name.as_str(), own.evaluations, sigma, error]);
        }
    }
    let mut distribution =
        DataFile::new("s16b.csv", &["way (text)", "N (1)", "terms (1)", "relative_error (1)"]);
    for own in &analytic.distribution {
        for point in &own.points {
            distribution.row(cells![way(own.way).0, point.big_n, point.terms, point.error]);
        }
    }
    vec![relation, distribution]
}
