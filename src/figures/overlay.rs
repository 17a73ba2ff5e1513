//! Data before and after over each other, for `diff`: a band with a line in it. No figure of the
//! report, so it takes any columns and finds its axes itself.

use plotters::style::text_anchor::{HPos, VPos};

use super::Error;
use super::axis::{Axis, log};
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{GREY, INK, Mark, PALE, RED, SMALL, Stroke, TEXT, THIN};

/// What is drawn.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// What it is.
    pub title: String,
    /// Name of the horizontal axis.
    pub x: String,
    /// One above the other.
    pub panes: Vec<OverlayPane>,
    /// A line at the foot.
    pub more: Option<String>,
}

/// One column of data.
#[derive(Clone, Debug)]
pub struct OverlayPane {
    /// Its name.
    pub label: String,
    /// Curves before.
    pub before: Vec<Vec<(f64, f64)>>,
    /// Curves now.
    pub after: Vec<Vec<(f64, f64)>>,
    /// Words above its right corner.
    pub note: String,
}

/// Up to here single points are marked.
const MARKED: usize = 150;

/// Of a pane and of what stands below it.
const HEIGHT: i32 = 2700;
const STEP: i32 = 4050;
const TOP: i32 = 1550;

const BEFORE: Stroke = Stroke::solid(PALE, 130);
const BEFORE_MARK: (Mark, i32, Stroke) = (Mark::Ring, 75, Stroke::solid(GREY, 40));
const AFTER: Stroke = Stroke::solid(RED, THIN);
const AFTER_MARK: (Mark, i32, Stroke) = (Mark::Cross, 45, Stroke::solid(RED, THIN));

/// Draws it, as an SVG document.
///
/// # Errors
/// If drawing fails.
pub fn overlay(what: &Overlay) -> Result<String, Error> {
    let height = TOP + STEP * what.panes.len() as i32 - 150;
    let more = what.more.as_deref().map(words);
    let sheet = Sheet::new(height as u32, more.as_deref())?;
    let title = words(&what.title);
    sheet.text(&title, (1400, 500), (TEXT, INK, HPos::Left, VPos::Bottom))?;
    sheet.legend((1400, 800), (SMALL, 400), &[entry(BEFORE, BEFORE_MARK, "before")])?;
    sheet.legend((3700, 800), (SMALL, 400), &[entry(AFTER, AFTER_MARK, "now")])?;
    let xs = Scale::of(what.panes.iter().flat_map(OverlayPane::points).map(|p| p.0));
    for (i, pane) in what.panes.iter().enumerate() {
        let top = TOP + STEP * i as i32;
        let ys = Scale::of(pane.points().map(|p| p.1));
        let frame = Frame::new(1400, top, 8150, top + HEIGHT);
        let panel = sheet.panel(frame, xs.axis(&what.x), ys.axis(""))?;
        let above = |x, text: &str, side| {
            sheet.text(&words(text), (x, top - 110), (SMALL, INK, side, VPos::Bottom))
        };
        above(1400, &ys.label(&pane.label), HPos::Left)?;
        above(8150, &pane.note, HPos::Right)?;
        let few = pane.points().count() <= 2 * MARKED;
        for (name, curves, stroke, mark) in
            [("before", &pane.before, BEFORE, BEFORE_MARK), ("now", &pane.after, AFTER, AFTER_MARK)]
        {
            for curve in curves {
                let shown: Vec<_> = curve.iter().map(|p| (xs.at(p.0), ys.at(p.1))).collect();
                panel.curve(name, &shown, stroke, Outside::Refuse)?;
                if few {
                    panel.marks(name, &shown, mark, Outside::Refuse)?;
                }
            }
        }
    }
    let description = "Grey, broad: before. Red, thin: now.";
    Ok(sheet.document("overlay", &what.title, description))
}

fn entry(line: Stroke, mark: (Mark, i32, Stroke), text: &str) -> Entry {
    Entry { line: Some(line), mark: Some(mark), text: text.into() }
}

/// Words without mark-up, in characters that the fonts have.
fn words(text: &str) -> String {
    let one = |c: char| match c {
        '*' | '\\' | '_' | '^' | '{' | '}' => vec!['\\', c],
        ' '..='~' => vec![c],
        _ => vec!['?'],
    };
    text.chars().flat_map(one).collect()
}

impl OverlayPane {
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.before.iter().chain(&self.after).flatten().copied()
    }
}

/// How numbers of any size come onto an axis: by their logarithms, or over a power of ten.
#[derive(Clone, Copy, Debug)]
struct Scale {
    lo: f64,
    hi: f64,
    logarithmic: bool,
    /// What is drawn is the number over ten to this power.
    exponent: i32,
}

impl Scale {
    fn of(numbers: impl Iterator<Item = f64>) -> Self {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (lo, hi) = numbers.fold(ends, |(lo, hi), v| (lo.min(v), hi.max(v)));
        let (lo, hi) = if lo <= hi { (lo, hi) } else { (0.0, 1.0) };
        let logarithmic = lo > 0.0 && hi / lo > 1e3;
        let size = decade(lo.abs().max(hi.abs()));
        let exponent = if logarithmic || (-2..=4).contains(&size) { 0 } else { size };
        Scale { lo, hi, logarithmic, exponent }
    }

    fn at(&self, value: f64) -> f64 {
        if self.logarithmic { log(value) } else { value / power(self.exponent) }
    }

    fn label(&self, name: &str) -> String {
        if self.exponent == 0 { name.into() } else { format!("{name}, over 10^{}", self.exponent) }
    }

    fn axis(&self, label: &str) -> Axis {
        let label = if label.is_empty() { String::new() } else { words(&self.label(label)) };
        let (lo, hi) = (self.at(self.lo), self.at(self.hi));
        if self.logarithmic {
            let (lo, hi) = (lo.floor() as i32, hi.ceil() as i32);
            return Axis::decades(lo, hi, (hi - lo).div_euclid(8) + 1, &label);
        }
        // A line that is level still has a place between two ticks.
        let slack = if hi > lo { 0.0 } else { (hi.abs() / 10.0).max(0.1) };
        let (lo, hi) = (lo - slack, hi + slack);
        let unit = power(decade(hi - lo));
        let steps = |step: f64| (hi / step).ceil() - (lo / step).floor();
        let fine = [0.1, 0.2, 0.5, 1.0, 2.0].map(|part| part * unit);
        let step = fine.into_iter().find(|step| steps(*step) <= 6.0).unwrap_or(5.0 * unit);
        Axis::linear((lo / step).floor() * step, (hi / step).ceil() * step, step, 1, &label)
    }
}

/// The power of ten at or below a number; that of one for zero.
fn decade(value: f64) -> i32 {
    let digits = format!("{value:e}");
    let exponent = digits.split('e').nth(1).and_then(|e| e.parse().ok()).unwrap_or(0);
    if value == 0.0 { 0 } else { exponent }
}

/// Ten to a power, as read from its decimal.
fn power(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(before: &[(f64, f64)], after: &[(f64, f64)]) -> String {
        let pane = OverlayPane {
            label: "a_b (☃)".into(),
            before: vec![before.to_vec()],
            after: vec![after.to_vec()],
            note: String::new(),
        };
        let (title, x) = ("data/x.csv".into(), "x_{".into());
        overlay(&Overlay { title, x, panes: vec![pane], more: Some("*".into()) }).unwrap()
    }

    #[test]
    fn numbers_of_any_size_are_drawn() {
        for size in [0.0, 1e-300, 1e-9, 0.37, 12.0, 1e7, 1e300] {
            for (a, b) in [(size, size), (-size, size), (size, 1.001 * size), (size, 1e5 * size)] {
                let svg = drawn(&[(0.0, a), (1.0, b)], &[(0.0, b), (size, a)]);
                assert!(svg.contains("data-name=\"before\"") && svg.contains("data-name=\"now\""));
                roxmltree::Document::parse(&svg).unwrap();
            }
        }
        roxmltree::Document::parse(&drawn(&[], &[])).unwrap();
        drawn(&[(f64::MIN_POSITIVE, -f64::MAX)], &[(1.0, f64::MAX)]);
    }

    #[test]
    fn axes_hold_their_data_between_few_ticks() {
        for (lo, hi) in [(0.0, 100.0), (0.37, 0.41), (-3.0, 7.0), (99.9, 100.1), (1e-12, 3e-12)] {
            let scale = Scale::of([lo, hi].into_iter());
            let axis = scale.axis("x");
            assert!(axis.holds(scale.at(lo)) && axis.holds(scale.at(hi)), "{axis:?}");
            assert!((2..=7).contains(&axis.ticks.len()), "{axis:?}");
        }
    }
}
