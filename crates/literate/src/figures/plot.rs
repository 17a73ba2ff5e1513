//! Draws a plot of one panel whose ranges, ticks, frame and names at the ends of curves follow from
//! its data; [`Sheet`] and [`Panel`] are for figures that place these by hand.

use super::axis::{self, Axis};
use super::drawing::Frame;
use super::elements::Marker;
use super::error::Error;
use super::figure::{Description, Figure};
use super::font;
use super::panel::{self, Panel};
use super::series::Outside;
use super::sheet::Sheet;
use super::style::*;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use plotters::style::RGBColor;
use pxfm::f_log10;

enum SeriesKind {
    Line,
    Markers(Symbol),
    Curve(Box<dyn Fn(f64) -> f64>),
}

struct Series {
    /// Its place in the list of names.
    name: usize,
    kind: SeriesKind,
    /// With an error of zero where there is none.
    points: Vec<(f64, Estimate)>,
}

#[derive(Default)]
struct AxisOptions {
    label: String,
    is_log: bool,
}

/// A plot in the making. Series of one name have one colour and are named once, at their right end.
#[derive(Default)]
pub struct Plot {
    x: AxisOptions,
    y: AxisOptions,
    names: Vec<String>,
    series: Vec<Series>,
}

const COLOURS: [RGBColor; 6] = [INK, BLUE, RED, GREEN, ORANGE, PURPLE];
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::Short, Dash::Alternate];

impl Plot {
    pub fn new() -> Self {
        Plot::default()
    }

    /// Labels the horizontal axis, with its unit in brackets at the end: `*σ* (N/kg)`.
    pub fn x(mut self, label: &str) -> Self {
        self.x.label = label.into();
        self
    }

    /// Labels the vertical axis.
    pub fn y(mut self, label: &str) -> Self {
        self.y.label = label.into();
        self
    }

    /// Labels the horizontal axis and makes it logarithmic: numbers that are not positive are left
    /// out.
    pub fn log_x(mut self, label: &str) -> Self {
        self.x.is_log = true;
        self.x(label)
    }

    /// Labels the vertical axis and makes it logarithmic.
    pub fn log_y(mut self, label: &str) -> Self {
        self.y.is_log = true;
        self.y(label)
    }

    fn add(mut self, name: &str, kind: SeriesKind, points: Vec<(f64, Estimate)>) -> Self {
        if !self.names.iter().any(|known| known == name) {
            self.names.push(name.into());
        }
        let name = self.names.iter().position(|known| known == name).unwrap_or_default();
        self.series.push(Series { name, kind, points });
        self
    }

    /// Adds a line through points (x, y).
    pub fn line(self, name: &str, points: &[(f64, f64)]) -> Self {
        self.add(name, SeriesKind::Line, without_errors(points))
    }

    /// Adds symbols at points (x, y).
    pub fn points(self, name: &str, points: &[(f64, f64)], symbol: Symbol) -> Self {
        self.add(name, SeriesKind::Markers(symbol), without_errors(points))
    }

    /// Adds discs at estimates with bars of one standard error, as a table gives them.
    pub fn estimates(self, name: &str, estimates: &[(f64, Estimate)]) -> Self {
        self.add(name, SeriesKind::Markers(Symbol::Disc), estimates.to_vec())
    }

    /// Adds a function of x across the plot; the range of y follows from it only where there is no
    /// other data.
    pub fn curve(self, name: &str, function: impl Fn(f64) -> f64 + 'static) -> Self {
        self.add(name, SeriesKind::Curve(Box::new(function)), Vec::new())
    }

    /// Returns all points that the axes have a place for, with the ends of bars.
    fn data(&self) -> Vec<(f64, f64)> {
        let mut data = Vec::new();
        for (x, y) in self.series.iter().flat_map(|series| &series.points) {
            data.extend([0.0, -y.error, y.error].map(|by| (*x, y.value + by)));
        }
        data.retain(|(x, y)| (*x > 0.0 || !self.x.is_log) && (*y > 0.0 || !self.y.is_log));
        data
    }

    /// Returns the axes that hold all data, after evaluating the functions at 401 places.
    fn axes(&mut self) -> (Axis, Axis) {
        let mut data = self.data();
        let x = self.x.axis(data.iter().map(|point| point.0));
        let (from, to) = x.ends();
        for series in &mut self.series {
            if let SeriesKind::Curve(function) = &series.kind {
                let places = (0..=400).map(|i| from + (to - from) * f64::from(i) / 400.0);
                let values = places.map(|place| x.value(place));
                let points = values.map(|x| (x, with_error(function(x), 0.0)));
                series.points = points.filter(|(_, y)| y.value.is_finite()).collect();
            }
        }
        if data.is_empty() {
            data = self.data();
        }
        let y = self.y.axis(data.iter().map(|point| point.1));
        (x, y)
    }

    /// Draws the figure. Fails for a number that is not finite, and for a label with a character
    /// that the shipped fonts lack.
    pub fn finish(self, title: &str, description: Description) -> Result<Figure, Error> {
        let (sheet, _) = self.draw()?;
        Ok(sheet.finish(title, description))
    }

    /// Draws the plot and returns the sheet and the panel, whose `area` takes any series or element
    /// of plotters.
    pub fn draw(mut self) -> Result<(Sheet, Panel), Error> {
        let (x, y) = self.axes();
        let has_names = self.names.len() > 1;
        let left = panel::widest_number(&y)? + panel::LABEL_LEFT + 2 * TEXT;
        let mut right = WIDTH as i32 - 150 - panel::widest_number(&x)? / 2;
        let mut ends = Vec::new();
        for (name, colour) in self.names.into_iter().zip(COLOURS.into_iter().cycle()) {
            if has_names {
                right = right.min(WIDTH as i32 - font::width(&name, SMALL)? - 200);
            }
            ends.push((name, Vec::new(), colour));
        }
        let frame = Frame::new(left, 250, right, 4250);
        let sheet = Sheet::new((frame.bottom + panel::LABEL_BELOW + 2 * TEXT) as u32);
        let panel = sheet.panel(frame, x, y)?;
        for Series { name: place, kind, points } in &self.series {
            let (name, named, colour) = &mut ends[*place];
            let places: Vec<(f64, f64)> = points.iter().map(|(x, y)| (*x, y.value)).collect();
            let stroke = Stroke::dashed(*colour, LINE, DASHES[place % DASHES.len()]);
            let marker = |symbol| -> Marker { (symbol, MEDIUM, Stroke::solid(*colour, THIN)) };
            match kind {
                SeriesKind::Line | SeriesKind::Curve(_) => {
                    panel.curve(name, &places, stroke, Outside::Cut)?;
                }
                SeriesKind::Markers(symbol) if points.iter().all(|(_, y)| y.error == 0.0) => {
                    panel.markers(name, &places, marker(*symbol), Outside::Cut)?;
                }
                SeriesKind::Markers(symbol) => panel.estimates(name, points, marker(*symbol))?,
            }
            if named.is_empty() {
                *named = places;
            }
        }
        if has_names {
            panel.label_ends(&ends)?;
        }
        Ok((sheet, panel))
    }
}

fn without_errors(points: &[(f64, f64)]) -> Vec<(f64, Estimate)> {
    points.iter().map(|(x, y)| (*x, with_error(*y, 0.0))).collect()
}

impl AxisOptions {
    /// Makes the axis that holds these values: whole decades, or a margin of a twenty-fifth and
    /// ticks at 1, 2 or 5 times a power of ten.
    fn axis(&self, values: impl Iterator<Item = f64>) -> Axis {
        let ends = axis::range(values.filter(|value| value.is_finite()));
        let [low, high] = ends.unwrap_or([0.1, 1.0]);
        if self.is_log {
            let [low_power, high_power] = [low, high].map(f_log10);
            let every = (high_power - low_power).ceil() as i32 / 8 + 1;
            return Axis::decades_around([low, high].into_iter(), every, &self.label);
        }
        // A constant stands in the middle.
        let (span, margin) = if high > low {
            (high - low, (high - low) / 25.0)
        } else {
            (low.abs().max(1.0), low.abs().max(1.0) / 2.0)
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
    use crate::figures::drawing::Element;

    fn labels(options: &AxisOptions, values: &[f64]) -> (f64, f64, Vec<String>) {
        let axis = options.axis(values.iter().copied());
        (axis.lo, axis.hi, axis.ticks.into_iter().filter_map(|tick| tick.label).collect())
    }

    #[test]
    fn ranges_and_ticks_follow_from_the_data() {
        let [linear, log] =
            [false, true].map(|is_log| AxisOptions { is_log, ..AxisOptions::default() });
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
        let plot = plot.points("line", &points, Symbol::Ring);
        let plot = plot.estimates("found", &[(2.0, with_error(1.0, 1.5))]);
        let figure = plot.curve("theory", |k| k * k).finish("Spread", describe!("It rises."));
        let figure = figure.unwrap();
        // A line and its symbols are one series; zero has no place on the axis.
        assert_eq!(figure.data[0].rows.len(), 2 + 1 + 401);
        for element in &figure.drawing.elements {
            let Element::Label(label) = element else { continue };
            let (x, y) = label.at;
            let high = figure.drawing.height as i32;
            assert!((1..WIDTH as i32).contains(&x) && (1..high).contains(&y), "{}", label.words);
        }
        let wrong = Plot::new().line("a", &[(0.0, f64::NAN)]).finish("A", describe!("A"));
        assert!(matches!(wrong, Err(Error::Outside { .. })));
    }
}
