//! Places values on an axis: its scale, range, ticks and labels, all in units of the data.
//!
//! An axis is a coordinate of plotters: `map` gives the place on the sheet, `key_points` the ticks.
//! The logarithmic coordinate of plotters takes the platform's logarithm; ours is a linear one over
//! log10 of the data, taken with a portable function.

use super::markup::spelled;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged};
use plotters::coord::types::RangedCoordf64;
use pxfm::{f_exp10, f_log10};
use std::ops::Range;

/// A tick; minor ones have no label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    pub at: f64,
    /// With mark-up.
    pub label: Option<String>,
}

impl Tick {
    /// Returns its label, empty if there is none.
    pub(super) fn name(&self) -> &str {
        self.label.as_deref().unwrap_or_default()
    }
}

/// One axis of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    pub lo: f64,
    pub hi: f64,
    /// Whether values lie by their logarithm; one that is not positive lies below every range.
    pub is_log: bool,
    /// With mark-up; empty for none.
    pub label: String,
    /// Name and unit of its column in data files, if they are not in the label.
    pub column: Option<String>,
    /// From low to high.
    pub ticks: Vec<Tick>,
}

/// Formats a number as a tick label: fixed decimals, a true minus, `0` for zero.
pub fn number(value: f64, decimals: usize) -> String {
    let shown = format!("{value:.decimals$}");
    if shown.trim_start_matches(['-', '0', '.']).is_empty() {
        return "0".into();
    }
    shown.replace('-', "−")
}

impl Axis {
    /// Makes a linear axis with labelled ticks every `step` and `minor` intervals between two of
    /// them.
    pub fn linear(lo: f64, hi: f64, step: f64, minor: u32, label: &str) -> Self {
        let minor = minor.max(1);
        let fine = step / f64::from(minor);
        let is_whole = |value: f64| (value - value.round()).abs() < 1e-6;
        let decimals = (0..8).find(|&d| is_whole(step * decimal(1, d))).unwrap_or(8) as usize;
        let slack = 1e-9;
        let (first, last) = ((lo / fine - slack).ceil() as i64, (hi / fine + slack).floor() as i64);
        let ticks = (first..=last)
            .map(|i| {
                let major = i % i64::from(minor) == 0;
                let at = if major { (i / i64::from(minor)) as f64 * step } else { i as f64 * fine };
                Tick { at: at.clamp(lo, hi), label: major.then(|| number(at, decimals)) }
            })
            .collect();
        Axis::new(false, [lo, hi], label, ticks)
    }

    fn new(is_log: bool, [lo, hi]: [f64; 2], label: &str, ticks: Vec<Tick>) -> Self {
        Axis { lo, hi, is_log, label: label.into(), column: None, ticks }
    }

    /// Makes a logarithmic axis from 10^`lo` to 10^`hi`, labelled every `every` decades. If `every`
    /// exceeds five, the decades between two labels have no tick.
    pub fn decades(lo: i32, hi: i32, every: i32, label: &str) -> Self {
        let mut ticks = Vec::new();
        for exponent in lo..=hi {
            let labelled = (exponent - lo) % every == 0;
            if !labelled && every > 5 {
                continue;
            }
            let name = format!("10^{{{}}}", exponent.to_string().replace('-', "−"));
            ticks.push(Tick { at: decimal(1, exponent), label: labelled.then_some(name) });
            if every == 1 && exponent < hi {
                ticks.extend((2..10).map(|m| Tick { at: decimal(m, exponent), label: None }));
            }
        }
        Axis::new(true, [lo, hi].map(|end| decimal(1, end)), label, ticks)
    }

    /// Makes a logarithmic axis of the decades that hold all values, labelled every `every`.
    pub fn decades_around(values: impl Iterator<Item = f64>, every: i32, label: &str) -> Self {
        let [low, high] = range(values.map(f_log10)).unwrap_or([0.0, 1.0]);
        let (low, high) = (low.floor() as i32, high.ceil() as i32);
        Axis::decades(low, high.max(low + 1), every, label)
    }

    /// Returns the part of the axis from `lo` to `hi`.
    pub fn between(mut self, lo: f64, hi: f64) -> Self {
        (self.lo, self.hi) = (lo, hi);
        self.ticks.retain(|tick| (lo..=hi).contains(&tick.at));
        self
    }

    /// Labels 1, 2 and 5 of each decade, for a short logarithmic axis.
    pub fn label_1_2_5(mut self) -> Self {
        for tick in &mut self.ticks {
            let number = tick.at.to_string();
            let round = number.trim_start_matches(['0', '.']).starts_with(['1', '2', '5']);
            tick.label = round.then_some(number);
        }
        self
    }

    /// Sets the name and unit of its column in data files, such as `sigma (d omega^2)`.
    pub fn column(mut self, column: &str) -> Self {
        self.column = Some(column.into());
        self
    }

    /// Returns the name and the unit of its column in data files: as given, or from the label in
    /// plain text. A unit stands in brackets at the end; without one the unit is `1`.
    pub fn name_and_unit(&self) -> (String, String) {
        let words = self.column.clone().unwrap_or_else(|| spelled(&self.label));
        let unit = words.strip_suffix(')').and_then(|words| words.rsplit_once(" ("));
        let (name, unit) = unit.unwrap_or((&words, "1"));
        (name.into(), unit.into())
    }

    /// Returns where a value lies on the scale: the value or its logarithm.
    pub fn position(&self, value: f64) -> f64 {
        match self.is_log {
            false => value,
            true if value <= 0.0 => f64::NEG_INFINITY,
            true => f_log10(value),
        }
    }

    /// Returns the value at a position.
    pub fn value(&self, position: f64) -> f64 {
        if self.is_log { f_exp10(position) } else { position }
    }

    /// Returns the positions of both ends.
    pub fn ends(&self) -> (f64, f64) {
        (self.position(self.lo), self.position(self.hi))
    }

    /// Tells whether a value lies on the axis; an end touched within rounding is inside.
    pub fn contains(&self, value: f64) -> bool {
        let at = self.position(value);
        let (lo, hi) = self.ends();
        let slack = 1e-9 * (hi - lo);
        lo - slack <= at && at <= hi + slack
    }

    /// Tells whether the tick at a value is a major one: has a label, if only an empty one.
    pub(super) fn is_major(&self, value: f64) -> bool {
        self.ticks.iter().any(|tick| tick.at == value && tick.label.is_some())
    }

    /// Removes label and numbers, for a panel that shares the axis of the panel below.
    pub fn without_numbers(mut self) -> Self {
        let (name, unit) = self.name_and_unit();
        self.column = Some(format!("{name} ({unit})"));
        self.label.clear();
        for tick in &mut self.ticks {
            tick.label = tick.label.take().map(|_| String::new());
        }
        self
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let (lo, hi) = self.ends();
        RangedCoordf64::from(lo..hi).map(&self.position(*value), limit)
    }

    /// Returns the ticks, or those with a label if bold points are asked for.
    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let all = hint.weight().allow_light_points();
        let ticks = self.ticks.iter().filter(|tick| all || tick.label.is_some());
        ticks.map(|tick| tick.at).take(hint.max_num_points()).collect()
    }

    fn range(&self) -> Range<f64> {
        self.lo..self.hi
    }
}

/// Returns the smallest and the largest value; none if there is no value.
pub(super) fn range(mut values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let first = values.next()?;
    let (mut low, mut high) = (first, first);
    for value in values {
        (low, high) = (low.min(value), high.max(value));
    }
    Some([low, high])
}

/// Returns m · 10^exponent with the bits of the literal.
fn decimal(m: i32, exponent: i32) -> f64 {
    format!("{m}e{exponent}").parse().unwrap_or(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn ticks_are_exact_multiples_and_powers() {
        let axis = Axis::linear(0.0, 0.4, 0.1, 2, "σ");
        assert_eq!((labels(&axis), axis.ticks.len()), (vec!["0", "0.1", "0.2", "0.3", "0.4"], 9));
        let axis = Axis::linear(-1.0, 1.0, 0.5, 1, "");
        assert_eq!(labels(&axis), ["−1.0", "−0.5", "0", "0.5", "1.0"]);
        let axis = Axis::decades(-3, 0, 1, "p");
        assert_eq!(labels(&axis), ["10^{−3}", "10^{−2}", "10^{−1}", "10^{0}"]);
        assert_eq!(axis.ticks.len(), 4 + 3 * 8);
        let short = Axis::decades(-1, 1, 1, "").between(0.2, 2.0).label_1_2_5();
        assert_eq!((short.lo, labels(&short)), (0.2, vec!["0.2", "0.5", "1", "2"]));
        let axis = Axis::decades(-20, 7, 1, "");
        let whole = axis.ticks.iter().filter(|tick| tick.label.is_some());
        assert!(whole.zip(-20..).all(|(tick, power)| axis.position(tick.at) == f64::from(power)));
        assert!(!axis.contains(0.0) && !axis.contains(-1.0) && !axis.contains(f64::NAN));
        let around = Axis::decades_around([0.02, 30.0].into_iter(), 1, "");
        assert_eq!((around.lo, around.hi), (0.01, 100.0));
    }
}
