//! Places values on an axis: its scale, range, ticks and labels, all in units of the data.
//!
//! An axis is a coordinate of plotters: `map` gives the place on the sheet, `key_points` the ticks.
//! A logarithmic one is linear over log10 of the data, taken with a portable function.

use super::error::{Error, Fault};
use super::markup::spelled;
use crate::decimal::Decimal;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged};
use plotters::coord::types::RangedCoordf64;
use pxfm::{f_exp10, f_log10};
use std::collections::BTreeSet;
use std::ops::Range;

/// A tick; minor ones have no label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Its value on the axis.
    pub at: f64,
    /// With mark-up.
    pub label: Option<String>,
}

impl Tick {
    pub(super) fn name(&self) -> &str {
        self.label.as_deref().unwrap_or_default()
    }
}

/// An axis: its range, scale, label and ticks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// The value at the left or lower end.
    pub lo: f64,
    /// The value at the other end.
    pub hi: f64,
    /// Whether the scale is logarithmic; a value that is not positive lies below every range.
    pub is_log: bool,
    /// With mark-up; empty for none.
    pub label: String,
    /// Name and unit of its column in data files, if they are not in the label.
    pub(crate) column: Option<String>,
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
    /// Makes a linear axis with a labelled tick every `step` of up to twelve digits, and `minor`
    /// intervals between two. Labels are exact; long ones count from a tick, as the label says.
    pub fn linear(lo: f64, hi: f64, step: f64, minor: u32, label: &str) -> Self {
        let minor = i64::from(minor.max(1));
        let fine = step / minor as f64;
        let slack = 1e-9;
        let (first, last) = ((lo / fine - slack).ceil(), (hi / fine + slack).floor());
        let mut axis = Axis { lo, hi, label: label.into(), ..Axis::default() };
        let (count, farthest) = (last - first, first.abs().max(last.abs()));
        let Some((digits, power)) = decimal_of(step) else { return axis };
        if !count.is_finite() || count > 1e4 || farthest > 1e15 {
            return axis;
        }
        let mut numbers = Vec::new();
        for i in first as i64..=last as i64 {
            let mut at = i as f64 * fine;
            if i % minor == 0 {
                let number = digits * i128::from(i / minor);
                at = format!("{number}e{power}").parse().unwrap_or(at);
                numbers.push(number);
            }
            let label = (i % minor == 0).then(String::new);
            axis.ticks.push(Tick { at: at.clamp(lo, hi), label });
        }
        if leading(&numbers) > 5 && !numbers.contains(&0) {
            let from = numbers.iter().copied().max_by_key(|number| zeros(*number)).unwrap_or(0);
            numbers.iter_mut().for_each(|number| *number -= from);
            axis = axis.counted_from(from, power);
        }
        let most = leading(&numbers) + power;
        let labels = axis.ticks.iter_mut().filter_map(|tick| tick.label.as_mut());
        for (label, number) in labels.zip(numbers) {
            *label = exact(number, power, most);
        }
        axis
    }

    /// Says in the label that the numbers count from n · 10^power; those of data files do not.
    fn counted_from(mut self, n: i128, power: i32) -> Self {
        self.column = Some(self.column_name());
        let (n, power) = (n / 10_i128.pow(zeros(n)), power + zeros(n) as i32);
        let sign = if n < 0 { '+' } else { '−' };
        let from = format!(" {sign} {}", exact(n.abs(), power, leading(&[n]) + power));
        let unit = self.label.rfind(" (").filter(|_| self.label.ends_with(')'));
        self.label.insert_str(unit.unwrap_or(self.label.len()), &from);
        self
    }

    /// Checks that it has a range, ticks in rising order, and labels that differ.
    pub(super) fn check(&self) -> Result<(), Error> {
        let (low, high) = self.ends();
        let is_range = low < high && (high - low).is_finite();
        let rises = self.ticks.windows(2).all(|pair| pair[0].at < pair[1].at);
        let mut labels = self.ticks.iter().map(Tick::name).filter(|label| !label.is_empty());
        let mut seen = BTreeSet::new();
        let differ = labels.all(|label| seen.insert(label));
        if is_range && rises && differ && !self.ticks.is_empty() {
            return Ok(());
        }
        Err(Error(Fault::Axis { label: spelled(&self.label), low: self.lo, high: self.hi }))
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
            let label = labelled.then(|| power_of_ten(exponent));
            ticks.push(Tick { at: decimal(1, exponent), label });
            if every == 1 && exponent < hi {
                ticks.extend((2..10).map(|m| Tick { at: decimal(m, exponent), label: None }));
            }
        }
        let [lo, hi] = [lo, hi].map(|end| decimal(1, end));
        Axis { lo, hi, is_log: true, label: label.into(), column: None, ticks }
    }

    /// Makes a logarithmic axis of the decades that hold all positive values.
    pub fn decades_around(values: impl Iterator<Item = f64>, every: i32, label: &str) -> Self {
        let values = values.filter(|value| *value > 0.0 && value.is_finite());
        let [low, high] = range(values.map(f_log10)).unwrap_or([0.0, 1.0]);
        let (low, high) = (low.floor() as i32, high.ceil() as i32);
        Axis::decades(low, high.max(low + 1), every, label)
    }

    /// Makes an axis from zero up to a round number at or above `largest`.
    pub fn up_to(largest: f64, label: &str) -> Self {
        let step = round_step(largest);
        Axis::linear(0.0, (largest / step - 1e-9).ceil() * step, step, 1, label)
    }

    /// Returns the part of the axis from `lo` to `hi`.
    pub fn between(mut self, lo: f64, hi: f64) -> Self {
        (self.lo, self.hi) = (lo, hi);
        self.ticks.retain(|tick| (lo..=hi).contains(&tick.at));
        self
    }

    /// Labels 1, 2 and 5 of each decade, for a short logarithmic axis.
    pub(crate) fn label_1_2_5(mut self) -> Self {
        for tick in &mut self.ticks {
            let (n, power) = decimal_of(tick.at).unwrap_or_default();
            tick.label = [1, 2, 5].contains(&n).then(|| exact(n, power, power));
        }
        self
    }

    /// Sets the name and unit of its column in data files, such as `sigma (d omega^2)`.
    pub fn column(mut self, column: &str) -> Self {
        self.column = Some(column.into());
        self
    }

    /// Returns the name of its column in data files, with the unit in brackets at the end: as
    /// given, or from the label in plain text. Without one the unit is `1`.
    pub(crate) fn column_name(&self) -> String {
        let words = self.column.clone().unwrap_or_else(|| spelled(&self.label));
        if words.ends_with(')') && words.contains(" (") { words } else { words + " (1)" }
    }

    /// Returns where a value lies on the scale: the value or its logarithm.
    pub(crate) fn position(&self, value: f64) -> f64 {
        if !self.is_log {
            return value;
        }
        if value <= 0.0 { f64::NEG_INFINITY } else { f_log10(value) }
    }

    pub(crate) fn value(&self, position: f64) -> f64 {
        if self.is_log { f_exp10(position) } else { position }
    }

    pub(crate) fn ends(&self) -> (f64, f64) {
        (self.position(self.lo), self.position(self.hi))
    }

    /// Returns whether a value lies on the axis; an end touched within rounding is inside.
    pub fn contains(&self, value: f64) -> bool {
        let at = self.position(value);
        let (lo, hi) = self.ends();
        let slack = 1e-9 * (hi - lo);
        lo - slack <= at && at <= hi + slack
    }

    /// Removes label and numbers, for a panel that shares the axis of the panel below.
    pub fn without_numbers(mut self) -> Self {
        self.column = Some(self.column_name());
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

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        self.ticks.iter().map(|tick| tick.at).take(hint.max_num_points()).collect()
    }

    fn range(&self) -> Range<f64> {
        self.lo..self.hi
    }
}

/// Returns the smallest and the largest value, or `None` if there is no value.
pub(super) fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values
        .map(|value| [value; 2])
        .reduce(|[low, high], [value, _]| [low.min(value), high.max(value)])
}

/// Returns a round number of which at most five make a span.
pub(super) fn round_step(span: f64) -> f64 {
    let unit = decimal(1, Decimal::shortest(span).exponent());
    let steps = [0.2, 0.25, 0.5, 1.0, 2.0].map(|step| step * unit);
    steps.into_iter().find(|step| span / step - 1e-9 <= 5.0).unwrap_or(2.5 * unit)
}

/// Returns m · 10^exponent with the bits of the literal.
pub(super) fn decimal(m: i32, exponent: i32) -> f64 {
    format!("{m}e{exponent}").parse().unwrap_or(f64::MIN_POSITIVE)
}

/// Returns a positive number as n · 10^power, rounded to twelve digits, or `None` if not finite.
fn decimal_of(number: f64) -> Option<(i128, i32)> {
    let Decimal { digits, places } = Decimal::exact(number).significant(12);
    let kept = digits.trim_end_matches('0');
    Some((kept.parse().ok()?, (digits.len() - kept.len()) as i32 - places))
}

/// Returns the number of zeros at the end of a number that is not zero.
fn zeros(n: i128) -> u32 {
    let digits = n.to_string();
    (digits.len() - digits.trim_end_matches('0').len()) as u32
}

/// Returns the power of ten of the first digit of the largest number.
fn leading(numbers: &[i128]) -> i32 {
    let largest = numbers.iter().map(|number| number.abs()).max();
    Decimal::integer(largest.unwrap_or(0)).exponent()
}

/// Writes n · 10^power on an axis whose largest number has its first digit at 10^`most`.
fn exact(n: i128, power: i32, most: i32) -> String {
    if n == 0 {
        return "0".into();
    }
    let sign = if n < 0 { "−" } else { "" };
    let is_plain = power >= -5 && most <= 5;
    let power = if is_plain { power } else { power - most };
    let digits = Decimal::integer(n).times_ten(power).written();
    if is_plain {
        sign.to_owned() + &digits
    } else {
        format!("{sign}{digits}·{}", power_of_ten(most))
    }
}

/// Writes a number exactly, with a power of ten where it would be long.
pub fn in_powers(number: f64) -> String {
    match decimal_of(number) {
        Some((1, power)) if !(-2..4).contains(&power) => power_of_ten(power),
        Some((n, power)) if !(-2..4).contains(&power) => format!("{n}·{}", power_of_ten(power)),
        _ => number.to_string(),
    }
}

/// Writes a power of ten with mark-up, `10^{−3}`.
pub fn power_of_ten(exponent: i32) -> String {
    format!("10^{{{}}}", exponent.to_string().replace('-', "−"))
}

/// Formats a number with about `digits` significant digits; a tiny one with a power of ten.
pub fn short(value: f64, digits: usize) -> String {
    if value != 0.0 && value.abs() < 1e-3 {
        let shown = format!("{:.*e}", digits.saturating_sub(1), value);
        return shown.replace('-', "−").replace('e', "·10^");
    }
    let decimals = digits as i32 - 1 - Decimal::shortest(value).exponent();
    let shown = number(value, decimals.max(0) as usize);
    if shown.contains('.') {
        shown.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        shown
    }
}
