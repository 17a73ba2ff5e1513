//! Makes a whole second paper: the constants of period doubling, found again from the logistic map.
//!
//! It shows what a paper adds to [`literate`]: an experiment, its tables, figures, verdicts on what
//! was printed, and prose. All of the paper is in this folder.

use literate::double_double::DoubleDouble;
use literate::prelude::*;

/// How far the cascade of period doublings is followed.
#[derive(PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Depth {
    /// The last orbit has a period of two to this power.
    deepest: u32,
}

/// An orbit that passes through the maximum of the map, x = 1/2.
#[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Orbit {
    /// The period is two to this power.
    n: u32,
    /// The parameter R_n of the map at which it is there.
    parameter: f64,
    /// R_n − R_{n−1}; none for n = 0.
    step: Option<f64>,
    /// How far the orbit, half a period on, is from x = 1/2; none for n = 0.
    distance: Option<f64>,
}

pub const CASCADE: Experiment<Depth, Vec<Orbit>> =
    Experiment::new("cascade", |_| Depth { deepest: 16 }, cascade, |cascade| tables(cascade));

/// The orbit of x = 1/2 after so many steps of x → r x (1 − x), and its derivative by r.
fn orbit(r: DoubleDouble, steps: u64) -> [DoubleDouble; 2] {
    let one = DoubleDouble::from(1.0);
    (0..steps).fold([DoubleDouble::from(0.5), DoubleDouble::from(0.0)], |[x, slope], _| {
        let parabola = x * (one - x);
        [r * parabola, parabola + r * (one - x * 2.0) * slope]
    })
}

// listing: cascade
/// Newton's method for each R_n, with 32 digits; the steps before tell where the next begins.
fn cascade(depth: &Depth, progress: &Progress) -> Result<Vec<Orbit>, Error> {
    let half = DoubleDouble::from(0.5);
    let mut all = vec![Orbit { n: 0, parameter: 2.0, step: None, distance: None }];
    let (mut before, mut step) = (DoubleDouble::from(2.0), DoubleDouble::from(5.5));
    for n in 1..=depth.deepest {
        progress.check()?;
        let mut r = before + step * (1.0 / 4.67);
        for _ in 0..20 {
            let [x, slope] = orbit(r, 1 << n);
            r = r - (x - half) / slope;
        }
        step = r - before;
        let distance = (orbit(r, 1 << (n - 1))[0] - half).to_f64();
        let (parameter, distance) = (r.to_f64(), Some(distance));
        all.push(Orbit { n, parameter, step: Some(step.to_f64()), distance });
        before = r;
    }
    Ok(all)
}
// end

/// What follows from the cascade: two numbers for each orbit, and their limits.
fn tables(cascade: &[Orbit]) -> Vec<Table> {
    let of = |n: u32| cascade.iter().find(|orbit| orbit.n == n);
    let before = |orbit: &Orbit| orbit.n.checked_sub(1).and_then(of);
    // The first orbits have no step or distance before theirs, and so no ratio.
    let delta = |orbit: &Orbit| Some(before(orbit)?.step? / orbit.step?);
    let alpha = |orbit: &Orbit| Some(-before(orbit)?.distance? / orbit.distance?);
    let orbits = Table::builder("cascade.orbits", cascade, |_| 1)
        .key("n", "1", |orbit| orbit.n)
        .real("parameter", "1", 10, "The parameter $R_n$.", |orbit| orbit.parameter)
        .real("delta", "1", 8, "Ratio of neighbouring steps.", delta)
        .real("alpha", "1", 8, "Ratio of neighbouring distances.", alpha)
        .done();
    let last = cascade.last().into_iter().cloned().collect::<Vec<_>>();
    // The steps that are left are a geometric series.
    let onset = |orbit: &Orbit| Some(orbit.parameter + orbit.step? / (delta(orbit)? - 1.0));
    let limit = Table::builder("cascade.limit", &last, |_| 1)
        .chosen("n", "1", "The last orbit.", |orbit| orbit.n)
        .real("delta", "1", 8, "Its ratio of steps.", delta)
        .real("alpha", "1", 9, "Its ratio of distances.", alpha)
        .real("onset", "1", 8, "Where the periods are infinite.", onset)
        .done();
    vec![orbits, limit]
}

/// Fig. 1: where orbits go, against the parameter.
fn diagram(results: &Results) -> Result<Figure, FigureError> {
    let limit = results.table("cascade.limit")?;
    let mut points = Vec::new();
    for i in 0..=200 {
        let r = 2.8 + 1.2 * f64::from(i) / 200.0;
        let mut x = 0.5;
        for step in 0..540 {
            x = r * x * (1.0 - x);
            if step >= 500 {
                points.push((r, x));
            }
        }
    }
    let plot = Plot::new().x("parameter *r*").x_range(2.8, 4.0).y("*x*").y_range(0.0, 1.0);
    let (sheet, panel) = plot.points("orbits", &points, Symbol::Disc).mark_size(9).draw()?;
    let onset = limit.number(&[], "onset")?;
    let line = [(onset, 0.0), (onset, 1.0)];
    panel.guide("onset", &line, Stroke::solid(BLUE, THIN))?;
    let words = describe!(
        "Points of orbits against the parameter r. A single branch splits, its branches split again, and so on; \
         from r = {onset:.3}, marked by a line, whole ranges of x are covered, with windows between."
    );
    Ok(sheet.finish("Period doubling", words))
}

/// Fig. 2: how fast the two ratios settle.
fn convergence(results: &Results) -> Result<Figure, FigureError> {
    let [orbits, limit] = [results.table("cascade.orbits")?, results.table("cascade.limit")?];
    let last = orbits.distinct("n")?.last().copied().unwrap_or(1.0);
    let mut plot = Plot::new().x("*n*").log_y("distance from the last ratio");
    for (column, mark) in [("delta", Symbol::Disc), ("alpha", Symbol::Ring)] {
        let end = limit.number(&[], column)?;
        let far = |(n, ratio): (f64, f64)| (n, (ratio - end).abs());
        let points: Vec<_> = orbits.curve(&[], "n", column)?.into_iter().map(far).collect();
        plot = plot.line(column, &points).points(column, &points, mark);
    }
    let words = describe!(
        "Distances of the ratios from those of the last orbit, n = {}, against n, on a logarithmic axis. Soon \
         both fall along one straight line, by the ratio delta from orbit to orbit.",
        number(last, 0)
    );
    plot.finish("Convergence of the ratios", words)
}

pub fn paper() -> Paper {
    let sources = sources!("examples/feigenbaum");
    let paper = Paper::new("The constants of period doubling, found again", sources)
        .experiment(&CASCADE)
        .figure("orbits", &[&CASCADE], diagram)
        .figure("convergence", &[&CASCADE], convergence)
        .check("delta", |e| e.cell("cascade.limit.delta"))
        .check("alpha", |e| e.cell("cascade.limit.alpha"))
        .check("onset", |e| {
            // The explanation can fail: ours, rounded to three decimals, must be what is printed.
            let rounded = (e.number("cascade.limit.onset")? * 1000.0).round() / 1000.0;
            let why = "printed is the number rounded to three decimals, and a zero";
            let holds = Some(rounded) == e.statement.value;
            Ok(e.cell("cascade.limit.onset")?.explained(why, holds))
        });
    Paper { prose: "examples/feigenbaum", ..paper }
}

fn main() -> std::process::ExitCode {
    paper().cli()
}
