//! Draws a plot of one panel whose ranges, ticks, frame and names at the ends of curves follow from
//! its data; [`Sheet`] and [`Panel`] are for figures that place these by hand.

use super::axis::{self, Axis};
use super::drawing::Frame;
use super::error::{Error, Fault};
use super::figure::{Description, Figure};
use super::font;
use super::panel::{self, Outside, Panel, Sheet};
use super::style::*;
use impact_numerics::estimates::with_error;
use impact_numerics::statistics::Estimate;
use plotters::style::RGBColor;
use pxfm::f_log10;

type Function = Box<dyn Fn(f64) -> f64>;

struct Series {
    name: String,
    /// None for a line.
    symbol: Option<Symbol>,
    function: Option<Function>,
    /// With an error of zero where there is none.
    points: Vec<(f64, Estimate)>,
    /// Places of the points before which the line is broken.
    breaks: Vec<usize>,
}

#[derive(Default)]
struct AxisOptions {
    label: String,
    is_log: bool,
    range: Option<[f64; 2]>,
}

/// A plot in the making. Series of one name have one colour and are named once, at their right end.
#[derive(Default)]
pub struct Plot {
    x: AxisOptions,
    y: AxisOptions,
    series: Vec<Series>,
    mark_size: i32,
}

const COLOURS: [RGBColor; 6] = [INK, BLUE, RED, GREEN, ORANGE, PURPLE];
const DASHES: [Dash; 4] = [SOLID, LONG, SHORT, ALTERNATE];

impl Plot {
    /// Makes an empty plot with linear axes.
    pub fn new() -> Self {
        Plot { mark_size: MEDIUM, ..Plot::default() }
    }

    /// Labels the horizontal axis, with its unit in brackets at the end: `*σ* (N/kg)`.
    pub fn x(mut self, label: &str) -> Self {
        self.x.label = label.into();
        self
    }

    /// Labels the vertical axis, as [`Plot::x`] does the other.
    pub fn y(mut self, label: &str) -> Self {
        self.y.label = label.into();
        self
    }

    /// Labels the horizontal axis and makes it logarithmic; only positive numbers are shown.
    pub fn log_x(mut self, label: &str) -> Self {
        self.x.is_log = true;
        self.x(label)
    }

    /// Labels the vertical axis and makes it logarithmic.
    pub fn log_y(mut self, label: &str) -> Self {
        self.y.is_log = true;
        self.y(label)
    }

    /// Shows x from `low` to `high`, whatever the data; what lies outside is cut.
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.x.range = Some([low, high]);
        self
    }

    /// Shows y from `low` to `high`; what lies outside is cut.
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.y.range = Some([low, high]);
        self
    }

    /// Sets half the width of marks, in hundredths of a millimetre; it is [`MEDIUM`] otherwise.
    pub fn mark_size(mut self, half_width: i32) -> Self {
        self.mark_size = half_width;
        self
    }

    fn add(
        mut self,
        name: &str,
        points: Vec<(f64, Estimate)>,
        symbol: Option<Symbol>,
        function: Option<Function>,
    ) -> Self {
        let (name, breaks) = (name.into(), Vec::new());
        self.series.push(Series { name, points, symbol, function, breaks });
        self
    }

    /// Adds a line through points (x, y).
    pub fn line(self, name: &str, points: &[(f64, f64)]) -> Self {
        self.add(name, without_errors(points), None, None)
    }

    /// Adds symbols at points (x, y).
    pub fn points(self, name: &str, points: &[(f64, f64)], symbol: Symbol) -> Self {
        self.add(name, without_errors(points), Some(symbol), None)
    }

    /// Adds discs at estimates with bars of one standard error, as a table gives them.
    pub fn estimates(self, name: &str, estimates: &[(f64, Estimate)]) -> Self {
        self.add(name, estimates.to_vec(), Some(Symbol::Disc), None)
    }

    /// Adds a function of x across the plot; the range of y follows from other data, if any. The
    /// line is broken where the function is not finite, and at a pole.
    pub fn curve(self, name: &str, function: impl Fn(f64) -> f64 + 'static) -> Self {
        self.add(name, Vec::new(), None, Some(Box::new(function)))
    }

    fn has_place(&self, (x, y): (f64, f64)) -> bool {
        (x > 0.0 || !self.x.is_log) && (y > 0.0 || !self.y.is_log)
    }

    /// Returns all points that the axes have a place for, with the ends of bars.
    fn data(&self) -> Vec<(f64, f64)> {
        let points = self.series.iter().flat_map(|series| &series.points);
        let ends = points.flat_map(|(x, y)| [0.0, -y.error, y.error].map(|by| (*x, y.value + by)));
        ends.filter(|point| self.has_place(*point)).collect()
    }

    /// Returns the axes that hold all data, after evaluating the functions at 401 places.
    fn axes(&mut self) -> (Axis, Axis) {
        let mut data = self.data();
        let x = self.x.axis(data.iter().map(|point| point.0));
        let (from, to) = x.ends();
        for series in &mut self.series {
            if let Some(function) = &series.function {
                let place = |i: f64| x.value(from + (to - from) * i / 400.0);
                let value = |i: f64| (place(i), function(place(i)));
                for i in (0..=400).map(f64::from) {
                    let (at, y) = value(i);
                    let before = series.points.last().map_or(y, |(_, before)| before.value);
                    // At a pole the sign changes, and a value between lies beyond both.
                    let between = function(place(i - 0.5));
                    let is_within = before.min(y) <= between && between <= before.max(y);
                    let is_pole = before * y < 0.0 && !is_within;
                    if is_pole || !y.is_finite() {
                        series.breaks.push(series.points.len());
                    }
                    if y.is_finite() {
                        series.points.push((at, with_error(y, 0.0)));
                    }
                }
            }
        }
        if data.is_empty() {
            data = self.data();
        }
        let y = self.y.axis(data.iter().map(|point| point.1));
        (x, y)
    }

    /// Draws the figure. A number that is not finite, or a character that no font has, is an error.
    pub fn finish(self, title: &str, description: Description) -> Result<Figure, Error> {
        let (sheet, _) = self.draw()?;
        Ok(sheet.finish(title, description))
    }

    /// Draws the plot and returns sheet and panel, to which plotters can add series and elements.
    pub fn draw(mut self) -> Result<(Sheet, Panel), Error> {
        let (x, y) = self.axes();
        let first = self.series.first().ok_or(Error(Fault::NoSeries))?;
        for (at, series) in self.series.iter().enumerate() {
            let is_same = |other: &Series| {
                (&other.name, other.symbol.is_some()) == (&series.name, series.symbol.is_some())
            };
            if self.series[..at].iter().any(is_same) {
                return Err(Error(Fault::SameName(series.name.clone())));
            }
        }
        let has_names = self.series.iter().any(|series| series.name != first.name);
        let left = panel::widest_number(&y)? + panel::LABEL_LEFT + 2 * TEXT;
        let mut right = WIDTH as i32 - 150 - panel::widest_number(&x)? / 2;
        for Series { name, points, .. } in &self.series {
            if !points.iter().any(|(x, y)| self.has_place((*x, y.value))) {
                return Err(Error(Fault::Empty(name.clone())));
            }
            if has_names {
                right = right.min(WIDTH as i32 - font::width(name, SMALL)? - 200);
            }
        }
        let frame = Frame::new(left, 250, right, 4250);
        let sheet = Sheet::new((frame.bottom + panel::LABEL_BELOW + 2 * TEXT) as u32);
        let panel = sheet.panel(frame, x, y)?.outside(Outside::Cut);
        let mut ends: Vec<(String, Vec<_>, _)> = Vec::new();
        for Series { name, symbol, points, breaks, .. } in self.series {
            if !points.iter().any(|(x, y)| panel.contains((*x, y.value))) {
                return Err(Error(Fault::Empty(name)));
            }
            let place = ends.iter().position(|end| end.0 == name).unwrap_or(ends.len());
            let colour = COLOURS[place % COLOURS.len()];
            let stroke = Stroke::dashed(colour, LINE, DASHES[place % DASHES.len()]);
            let thin = Stroke::solid(colour, THIN);
            let places: Vec<(f64, f64)> = points.iter().map(|(x, y)| (*x, y.value)).collect();
            match symbol.map(|symbol| (symbol, self.mark_size, thin)) {
                None => {
                    let ends = [&[0], breaks.as_slice(), &[places.len()]].concat();
                    for part in ends.windows(2).filter(|part| part[0] < part[1]) {
                        panel.curve(&name, &places[part[0]..part[1]], stroke)?;
                    }
                }
                Some(marker) if points.iter().all(|(_, y)| y.error == 0.0) => {
                    panel.markers(&name, &places, marker)?;
                }
                Some(marker) => panel.estimates(&name, &points, marker)?,
            }
            if place == ends.len() {
                ends.push((name, places, colour));
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
    /// Makes the axis of the range that was asked for, or of whole decades or a margin around the
    /// values. It has up to six numbers, or 1, 2 and 5 of less than two decades.
    fn axis(&self, values: impl Iterator<Item = f64>) -> Axis {
        let found = axis::range(values.filter(|value| value.is_finite()));
        let [low, high] = self.range.or(found).unwrap_or([0.1, 1.0]);
        if self.is_log {
            let decades = f_log10(high) - f_log10(low);
            let every = decades.ceil() as i32 / 8 + 1;
            let axis = Axis::decades_around([low, high].into_iter(), every, &self.label);
            return match self.range {
                None => axis,
                Some(_) if decades < 2.0 => axis.between(low, high).label_1_2_5(),
                Some(_) => axis.between(low, high),
            };
        }
        let margin = match self.range {
            Some(_) => 0.0,
            None if high > low => (high - low) / 25.0,
            // A constant stands in the middle.
            None if low == 0.0 => 0.5,
            None => low.abs() / 2.0,
        };
        let span = if high > low { high - low } else { 2.0 * margin };
        Axis::linear(low - margin, high + margin, axis::round_step(span), 2, &self.label)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::describe;
    use crate::figures::axis::Tick;
    use crate::figures::drawing::Element;

    /// The axis of these values, with its numbers.
    fn axis(is_log: bool, values: &[f64]) -> (Axis, String) {
        let options = AxisOptions { label: "*x* (s)".into(), is_log, range: None };
        let axis = options.axis(values.iter().copied());
        let labels = axis.ticks.iter().filter_map(|tick| tick.label.as_deref());
        let labels = labels.collect::<Vec<_>>().join(" ");
        (axis, labels)
    }

    #[test]
    fn numbers_of_an_axis_are_exact_and_differ_or_its_range_is_refused() {
        for (is_log, values, numbers) in [
            (false, &[0.3, 12.8, f64::NAN][..], "0 2.5 5.0 7.5 10.0 12.5"),
            (false, &[1e-2, 9e-2], "0.02 0.04 0.06 0.08"),
            (false, &[3.0, 3.0], "2 3 4"),
            (false, &[-3.0, 0.5], "−3 −2 −1 0"),
            (false, &[1e-10, 5e-10], "1·10^{−10} 2·10^{−10} 3·10^{−10} 4·10^{−10} 5·10^{−10}"),
            (false, &[1e25, 3e25], "1.0·10^{25} 1.5·10^{25} 2.0·10^{25} 2.5·10^{25} 3.0·10^{25}"),
            (true, &[0.02, 30.0], "10^{−2} 10^{−1} 10^{0} 10^{1} 10^{2}"),
        ] {
            let (axis, shown) = axis(is_log, values);
            axis.check().unwrap();
            assert_eq!((axis.label.as_str(), shown.as_str()), ("*x* (s)", numbers));
        }
        // Numbers that would be long count from one of them.
        let (near, numbers) = axis(false, &[1.0, 1.00000000001]);
        let expected = "0 0.25·10^{−11} 0.50·10^{−11} 0.75·10^{−11} 1.00·10^{−11}";
        assert_eq!((near.label.as_str(), numbers.as_str()), ("*x* − 1 (s)", expected));
        assert_eq!(near.column_name(), "x (s)");
        for ends in [[-1.7e308, 1.7e308], [1.0, 1.0 + f64::EPSILON], [1e17, 1e17 + 64.0]] {
            let refused = axis(false, &ends).0.check();
            assert!(matches!(refused, Err(Error(Fault::Axis { .. }))), "{ends:?}");
        }
        // Ranges of all sizes, some far from zero, against their numbers read back.
        let number = |text: &str| {
            text.replace("·10^{", "e").replace('}', "").replace('−', "-").parse::<f64>().unwrap()
        };
        for power in -300..300 {
            for (low, width) in [(0.0, 1.0), (-0.37, 0.9), (123.0, 4.5), (7e6, 3.0)] {
                let size = number(&format!("1e{power}"));
                let (axis, _) = axis(false, &[low * size, (low + width) * size]);
                axis.check().unwrap();
                let from = axis.label.replace("*x* − ", "").replace(" (s)", "");
                let from = if from == "*x*" { 0.0 } else { number(&from) };
                assert!(axis.ticks.len() > 2, "{axis:?}");
                for Tick { at, label } in axis.ticks {
                    let wrong = label.map_or(0.0, |label| (from + number(&label) - at).abs());
                    assert!(wrong <= 4.0 * f64::EPSILON * at.abs(), "{at}");
                }
            }
        }
    }

    #[test]
    fn a_line_is_broken_where_there_is_no_data() {
        let parts = |plot: Plot| {
            let (sheet, _) = plot.draw().unwrap();
            let figure = sheet.finish("A", describe!("A"));
            let elements = figure.drawing.elements;
            let opened = elements.iter().skip_while(|one| !matches!(one, Element::Open(..)));
            let shapes = opened.filter(|one| matches!(one, Element::Shape(_, None, Some(_))));
            shapes.count()
        };
        let through = |y: f64| [(1.0, 1.0), (2.0, 2.0), (3.0, y), (4.0, 4.0), (5.0, 5.0)];
        let whole = parts(Plot::new().log_y("y").line("a", &through(3.0)));
        assert_eq!(parts(Plot::new().log_y("y").line("a", &through(0.0))), whole + 1);
        let whole = parts(Plot::new().x_range(-5.0, 6.0).curve("a", |x| x));
        assert_eq!(parts(Plot::new().x_range(-5.0, 6.0).curve("a", |x| 1.0 / x)), whole + 1);
        assert_eq!(parts(Plot::new().x_range(-5.0, 5.0).curve("a", |x| 1.0 / x)), whole + 1);
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
        let small = Plot::new().line("a", &[(1.0, 1e-10), (1.00000000001, 5e-10)]);
        small.finish("A", describe!("A")).unwrap();
        let fails = |plot: Plot| plot.finish("A", describe!("A")).unwrap_err();
        let wrong = fails(Plot::new().line("*σ*", &[(0.0, 1.0), (5.0, f64::NAN)])).to_string();
        assert!(wrong.starts_with("row 2 of the series \"sigma\", (5, NaN), is not finite"));
        let same = fails(Plot::new().line("a", &points).line("a", &points));
        assert!(matches!(same, Error(Fault::SameName(_))), "{same}");
        let missing = fails(Plot::new().line("a", &points).line("⌊k⌋", &points));
        assert!(matches!(missing, Error(Fault::Glyph { character: '⌊', .. })));
        let wide = fails(Plot::new().line("a", &[(0.0, -1.7e308), (1.0, 1.7e308)]));
        assert!(matches!(wide, Error(Fault::Axis { .. })));
        // Words that leave the sheet, and names that no place is left for.
        let long = fails(Plot::new().y(&"a long label ".repeat(9)).line("a", &points));
        assert!(matches!(long, Error(Fault::OffSheet(_))), "{long}");
        let names = (0..30).map(|i| format!("curve {i}"));
        let full = fails(names.fold(Plot::new(), |plot, name| plot.line(&name, &points)));
        assert!(matches!(full, Error(Fault::NoRoom(30))), "{full}");
        let negative = fails(Plot::new().estimates("a", &[(2.0, with_error(1.0, -0.5))]));
        assert!(matches!(negative, Error(Fault::NegativeError { row: 1, .. })), "{negative}");
        // What would be an empty frame.
        let away = Plot::new().x_range(500.0, 600.0).line("a", &points);
        assert!(matches!(fails(away), Error(Fault::Empty(_))));
        for plot in [Plot::new().line("a", &[]), Plot::new().log_y("b").line("a", &[(1.0, -2.0)])] {
            assert!(matches!(fails(plot), Error(Fault::Empty(_))));
        }
        assert!(matches!(fails(Plot::new()), Error(Fault::NoSeries)));
        let plot = Plot::new().log_x("*k*").x_range(2.0, 60.0).y_range(0.0, 1.0).mark_size(80);
        let (_, panel) = plot.points("a", &[(5.0, 0.5), (70.0, 0.5)], Symbol::Ring).draw().unwrap();
        assert_eq!((panel.x.lo, panel.x.hi, panel.y.lo, panel.y.hi), (2.0, 60.0, 0.0, 1.0));
        assert_eq!(panel.x.ticks.iter().filter(|tick| tick.label.is_some()).count(), 5);
    }
}
