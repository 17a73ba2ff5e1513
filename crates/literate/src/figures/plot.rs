//! A plot of one panel whose ranges, ticks, frame and names at the ends of curves follow from its data; [`super::panel`]
//! is for figures that place these by hand.
//!
//! ```
//! use literate::prelude::*;
//!
//! let found = [(1.0, 0.26, 0.02), (2.0, 0.98, 0.05), (4.0, 4.1, 0.2)];
//! let found = found.map(|(k, mean, error)| (k, with_error(mean, error)));
//! let figure = Plot::new()
//!     .x("*k*")
//!     .log_y("mean square distance (1/s)")
//!     .estimates("simulated", &found)
//!     .curve("random phases", |k| k * k / 4.0)
//!     .finish("Spread of the balls", describe!("Both rise as the square of k."))?;
//! # Ok::<(), FigureError>(())
//! ```

use super::axis::{self, Axis};
use super::drawing::Frame;
use super::error::Error;
use super::figure::{Description, Figure};
use super::font;
use super::panel::{self, Sheet};
use super::series::Outside;
use super::style::*;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use pxfm::{f_exp10, f_log10};

enum Shown {
    Line,
    Marks(Symbol),
    Curve(Box<dyn Fn(f64) -> f64>),
}

/// A series: its name, how it is shown, and its points, with an error of zero where there is none.
struct Series(String, Shown, Vec<(f64, Estimate)>);

#[derive(Default)]
struct Along {
    label: String,
    is_log: bool,
}

/// A plot in the making. Series of one name have one colour and are named once, at their right end.
#[derive(Default)]
pub struct Plot {
    x: Along,
    y: Along,
    series: Vec<Series>,
}

const COLOURS: [Colour; 6] = [INK, BLUE, RED, GREEN, ORANGE, PURPLE];
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::Short, Dash::Alternate];

impl Plot {
    /// A plot without data.
    pub fn new() -> Self {
        Plot::default()
    }

    /// The label of the horizontal axis, with its unit in brackets behind it: `*σ* (N/kg)`.
    pub fn x(mut self, label: &str) -> Self {
        self.x.label = label.into();
        self
    }

    /// The label of the vertical axis.
    pub fn y(mut self, label: &str) -> Self {
        self.y.label = label.into();
        self
    }

    /// The label of a horizontal axis that is logarithmic: numbers that are not positive are left out.
    pub fn log_x(mut self, label: &str) -> Self {
        self.x.is_log = true;
        self.x(label)
    }

    /// The label of a vertical axis that is logarithmic.
    pub fn log_y(mut self, label: &str) -> Self {
        self.y.is_log = true;
        self.y(label)
    }

    fn add(mut self, name: &str, shown: Shown, points: &[(f64, f64)]) -> Self {
        let points = points.iter().map(|(x, y)| (*x, with_error(*y, 0.0))).collect();
        self.series.push(Series(name.into(), shown, points));
        self
    }

    /// A line through points (x, y).
    pub fn line(self, name: &str, points: &[(f64, f64)]) -> Self {
        self.add(name, Shown::Line, points)
    }

    /// Markers at points (x, y).
    pub fn points(self, name: &str, points: &[(f64, f64)], mark: Symbol) -> Self {
        self.add(name, Shown::Marks(mark), points)
    }

    /// Discs at estimates with bars of one standard error, as a table gives them.
    pub fn estimates(mut self, name: &str, estimates: &[(f64, Estimate)]) -> Self {
        self.series.push(Series(name.into(), Shown::Marks(Symbol::Disc), estimates.to_vec()));
        self
    }

    /// A function of x across the plot; the range of y follows from it only where there is no other data.
    pub fn curve(self, name: &str, of: impl Fn(f64) -> f64 + 'static) -> Self {
        self.add(name, Shown::Curve(Box::new(of)), &[])
    }

    /// All points that have a place, with the ends of bars.
    fn data(&self) -> Vec<(f64, f64)> {
        let points = self.series.iter().flat_map(|series| &series.2);
        let ends =
            points.flat_map(|(x, own)| [0.0, -own.error, own.error].map(|by| (*x, own.value + by)));
        ends.filter(|p| (p.0 > 0.0 || !self.x.is_log) && (p.1 > 0.0 || !self.y.is_log)).collect()
    }

    /// Draws the figure.
    ///
    /// # Errors
    /// For a number that is not finite, and for a label with a character that the shipped fonts lack.
    pub fn finish(mut self, title: &str, description: Description) -> Result<Figure, Error> {
        let mut data = self.data();
        let x = self.x.axis(data.iter().map(|point| point.0));
        let (from, to) = x.ends();
        let place = |i: i32| from + (to - from) * f64::from(i) / 400.0;
        let value = |at: f64| if self.x.is_log { f_exp10(at) } else { at };
        for Series(_, shown, points) in &mut self.series {
            if let Shown::Curve(of) = shown {
                let grid = (0..=400).map(|i| value(place(i))).map(|x| (x, with_error(of(x), 0.0)));
                *points = grid.filter(|(_, own)| own.value.is_finite()).collect();
            }
        }
        if data.is_empty() {
            data = self.data();
        }
        let y = self.y.axis(data.iter().map(|point| point.1));

        let mut names: Vec<&str> = self.series.iter().map(|series| &*series.0).collect();
        let mut seen = std::collections::BTreeSet::new();
        names.retain(|name| seen.insert(*name));
        let wide = |text: &str| Ok::<i32, Error>(font::set(text)?.width * SMALL / font::EM);
        let labels = |axis: &Axis| -> Result<Vec<i32>, Error> {
            axis.ticks.iter().flat_map(|tick| &tick.label).map(|own| wide(own)).collect()
        };
        let left = labels(&y)?.into_iter().max().unwrap_or(0) + panel::BESIDE + 2 * TEXT;
        let mut right = WIDTH as i32 - 150 - labels(&x)?.last().map_or(0, |width| width / 2);
        for name in names.iter().filter(|_| names.len() > 1) {
            right = right.min(WIDTH as i32 - wide(name)? - 200);
        }
        let frame = Frame::new(left, 250, right, 4250);
        let sheet = Sheet::new((frame.bottom + panel::BELOW + 2 * TEXT) as u32);
        let panel = sheet.panel(frame, x, y)?;
        let looks = |name: &str| {
            let i = names.iter().position(|own| *own == name).unwrap_or_default();
            let colour = COLOURS[i % COLOURS.len()];
            let line = Stroke::dashed(colour, LINE, DASHES[i % DASHES.len()]);
            (line, move |mark| (mark, MEDIUM, Stroke::solid(colour, THIN)))
        };
        for Series(name, shown, points) in &self.series {
            let (line, marker) = looks(name);
            let places = places(points);
            match shown {
                Shown::Line | Shown::Curve(_) => panel.curve(name, &places, line, Outside::Cut)?,
                Shown::Marks(mark) if points.iter().all(|(_, own)| own.error == 0.0) => {
                    panel.markers(name, &places, marker(*mark), Outside::Cut)?;
                }
                Shown::Marks(mark) => panel.estimates(name, points, marker(*mark))?,
            }
        }
        let named = |name: &&str| {
            let mut own = self.series.iter().filter(|own| own.0 == **name).map(|own| &own.2);
            let points =
                own.find(|points| !points.is_empty()).map_or(Vec::new(), |own| places(own));
            (name.to_string(), points, looks(name).0.colour)
        };
        if names.len() > 1 {
            panel.label_ends(&names.iter().map(named).collect::<Vec<_>>())?;
        }
        Ok(sheet.finish(title, description))
    }
}

fn places(points: &[(f64, Estimate)]) -> Vec<(f64, f64)> {
    points.iter().map(|(x, own)| (*x, own.value)).collect()
}

impl Along {
    /// The axis that holds these values: whole decades, or a margin of a twenty-fifth and ticks at 1, 2 or 5 times a power
    /// of ten.
    fn axis(&self, values: impl Iterator<Item = f64>) -> Axis {
        let ends = axis::range(values.filter(|value| value.is_finite()));
        let [low, high] = ends.unwrap_or([0.1, 1.0]);
        if self.is_log {
            let [low_power, high_power] = [low, high].map(f_log10);
            let every = (high_power - low_power).ceil() as i32 / 8 + 1;
            return Axis::decades_around([low, high].into_iter(), every, &self.label);
        }
        // What does not vary stands in the middle.
        let (span, margin) = match high > low {
            true => (high - low, (high - low) / 25.0),
            false => (low.abs().max(1.0), low.abs().max(1.0) / 2.0),
        };
        let rough = format!("{:e}", span / 5.0);
        let (digits, power) = rough.split_once('e').unwrap_or(("1", "0"));
        let (step, minor) = match digits.parse().unwrap_or(1.0) {
            d if d < 1.5 => ("1", 5),
            d if d < 3.5 => ("2", 2),
            d if d < 7.5 => ("5", 5),
            _ => ("10", 5),
        };
        let step = format!("{step}e{power}").parse().unwrap_or(span);
        Axis::linear(low - margin, high + margin, step, minor, &self.label)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::describe;

    fn labels(along: &Along, values: &[f64]) -> (f64, f64, Vec<String>) {
        let axis = along.axis(values.iter().copied());
        (axis.lo, axis.hi, axis.ticks.into_iter().filter_map(|tick| tick.label).collect())
    }

    #[test]
    fn ranges_and_ticks_follow_from_the_data() {
        let [linear, log] = [false, true].map(|is_log| Along { is_log, ..Along::default() });
        let (low, high, ticks) = labels(&linear, &[0.3, 12.8, f64::NAN]);
        assert_eq!((low, high), (0.3 - 0.5, 12.8 + 0.5));
        assert_eq!(ticks, ["0", "2", "4", "6", "8", "10", "12"]);
        assert_eq!(labels(&linear, &[1e-2, 9e-2]).2, ["0.02", "0.04", "0.06", "0.08"]);
        assert_eq!(
            labels(&linear, &[3.0, 3.0]).2,
            ["1.5", "2.0", "2.5", "3.0", "3.5", "4.0", "4.5"]
        );
        assert_eq!(
            labels(&log, &[0.02, 30.0]).2,
            ["10^{−2}", "10^{−1}", "10^{0}", "10^{1}", "10^{2}"]
        );
        assert_eq!(labels(&log, &[1e-20, 1.0]).2.len(), 7);
    }

    #[test]
    fn all_of_a_plot_lies_on_its_sheet() {
        let points = [(1.0, 0.5), (20.0, 3e4), (300.0, 0.0)];
        let plot = Plot::new().log_x("*k*").log_y("*D* (m²)").line("line", &points);
        let found = [(2.0, with_error(1.0, 1.5))];
        let plot = plot.points("line", &points, Symbol::Ring).estimates("found", &found);
        let plot = plot.curve("theory", |k| k * k);
        let figure = plot.finish("Spread", describe!("It rises.")).unwrap();
        let series: Vec<&str> = figure.data[0].rows.iter().map(|row| row[0].as_str()).collect();
        assert_eq!(
            (series.iter().filter(|own| **own == "line").count(), series.len()),
            (2, 2 + 1 + 401)
        );
        let high = figure.drawing.height as i32;
        for element in &figure.drawing.elements {
            let super::super::drawing::Element::Label(label) = element else { continue };
            let (x, y) = label.at;
            assert!((1..WIDTH as i32).contains(&x) && (1..high).contains(&y), "{}", label.words);
        }
        let wrong = Plot::new().line("a", &[(0.0, f64::NAN)]).finish("A", describe!("A"));
        assert!(matches!(wrong, Err(Error::Outside { .. })));
    }
}
