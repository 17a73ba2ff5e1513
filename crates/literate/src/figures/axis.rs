//! Axes: scale, range, ticks and their labels; all in units of the data.
//!
//! plotters' logarithmic coordinate uses the platform's logarithm; ours is a linear axis over
//! log10 of the data, taken with a portable function.

use super::markup::spelled;
use pxfm::f_log10;

/// How values lie along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// As they are.
    Linear,
    /// By their logarithm; what is not positive lies below every end.
    Logarithm,
}

/// A tick; minor ones have no label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Where it stands.
    pub at: f64,
    /// Label, with mark-up.
    pub label: Option<String>,
}

/// One axis of a panel.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "the names tell")]
pub struct Axis {
    pub lo: f64,
    pub hi: f64,
    pub scale: Scale,
    /// Label, with mark-up; empty for none.
    pub label: String,
    /// Name and unit of its column in data files, where the label says too little.
    pub column: Option<String>,
    /// Ticks from low to high.
    pub ticks: Vec<Tick>,
}

/// A number as a tick label: fixed decimals, a true minus, a bare zero.
pub fn number(value: f64, decimals: usize) -> String {
    let shown = format!("{value:.decimals$}");
    if shown.trim_start_matches(['-', '0', '.']).is_empty() {
        return "0".into();
    }
    shown.replace('-', "−")
}

impl Axis {
    /// A linear axis with labelled ticks every `step` and `minor` intervals between two of them.
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
        Axis::new(Scale::Linear, [lo, hi], label, ticks)
    }

    /// An axis with these ticks.
    pub fn new(scale: Scale, [lo, hi]: [f64; 2], label: &str, ticks: Vec<Tick>) -> Self {
        Axis { lo, hi, scale, label: label.into(), column: None, ticks }
    }

    /// A logarithmic axis from 10^`lo` to 10^`hi`, labelled every `every` decades; beyond five the
    /// decades between have no tick.
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
        Axis::new(Scale::Logarithm, [lo, hi].map(|end| decimal(1, end)), label, ticks)
    }

    /// The decades that hold all values, labelled every `every`.
    pub fn around(values: impl Iterator<Item = f64>, every: i32, label: &str) -> Self {
        let [low, high] = range(values.map(f_log10)).unwrap_or([0.0, 1.0]);
        let (low, high) = (low.floor() as i32, high.ceil() as i32);
        Axis::decades(low, high.max(low + 1), every, label)
    }

    /// The stretch of the axis from `lo` to `hi`.
    pub fn from(mut self, lo: f64, hi: f64) -> Self {
        (self.lo, self.hi) = (lo, hi);
        self.ticks.retain(|tick| (lo..=hi).contains(&tick.at));
        self
    }

    /// The same logarithmic axis with numbers at 1, 2 and 5 of each decade: for one that is short.
    pub fn finely(mut self) -> Self {
        for tick in &mut self.ticks {
            let number = tick.at.to_string();
            let round = number.trim_start_matches(['0', '.']).starts_with(['1', '2', '5']);
            tick.label = round.then_some(number);
        }
        self
    }

    /// The same axis with another column in data files, such as `sigma (d omega^2)`.
    pub fn column(mut self, column: &str) -> Self {
        self.column = Some(column.into());
        self
    }

    /// Name and unit of its column in data files: as given, or the label in plain text. A unit stands in brackets
    /// at the end, behind a space; what has none is a pure number.
    pub fn named(&self) -> (String, String) {
        let words = self.column.clone().unwrap_or_else(|| spelled(&self.label));
        let unit = words.strip_suffix(')').and_then(|words| words.rsplit_once(" ("));
        let (name, unit) = unit.unwrap_or((&words, "1"));
        (name.into(), unit.into())
    }

    /// Where a value lies between the ends.
    pub fn at(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => value,
            Scale::Logarithm if value <= 0.0 => f64::NEG_INFINITY,
            Scale::Logarithm => f_log10(value),
        }
    }

    /// Where its ends lie.
    pub fn ends(&self) -> (f64, f64) {
        (self.at(self.lo), self.at(self.hi))
    }

    /// Whether the axis holds a value; a wall touched within rounding is still inside.
    pub fn holds(&self, value: f64) -> bool {
        self.reaches(self.at(value))
    }

    /// Whether a place lies between the ends.
    pub(super) fn reaches(&self, at: f64) -> bool {
        let (lo, hi) = self.ends();
        let slack = 1e-9 * (hi - lo);
        lo - slack <= at && at <= hi + slack
    }

    /// The same axis without numbers, for a panel that shares its neighbour's.
    pub fn bare(mut self) -> Self {
        let (name, unit) = self.named();
        self.column = Some(format!("{name} ({unit})"));
        self.label.clear();
        for tick in &mut self.ticks {
            tick.label = tick.label.take().map(|_| String::new());
        }
        self
    }
}

pub(super) fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    values.map(|own| [own; 2]).reduce(|[low, high], [own, _]| [low.min(own), high.max(own)])
}

/// m · 10^exponent, as the literal is.
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
        let short = Axis::decades(-1, 1, 1, "").from(0.2, 2.0).finely();
        assert_eq!((short.lo, labels(&short)), (0.2, vec!["0.2", "0.5", "1", "2"]));
        let axis = Axis::decades(-20, 7, 1, "");
        let whole = axis.ticks.iter().filter(|tick| tick.label.is_some());
        assert!(whole.zip(-20..).all(|(tick, power)| axis.at(tick.at) == f64::from(power)));
        assert!(!axis.holds(0.0) && !axis.holds(-1.0) && !axis.holds(f64::NAN));
        let around = Axis::around([0.02, 30.0].into_iter(), 1, "");
        assert_eq!((around.lo, around.hi), (0.01, 100.0));
    }
}
