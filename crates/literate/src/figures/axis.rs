//! Axes: range, ticks and their labels.
//!
//! plotters' logarithmic coordinate uses the platform's logarithm; ours is a linear axis over
//! log10 of the data, taken with a portable function.

use pxfm::f_log10;

/// A tick; minor ones have no label.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Position in axis coordinates.
    pub at: f64,
    /// Label, with mark-up.
    pub label: Option<String>,
}

/// One axis of a panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Lowest value.
    pub lo: f64,
    /// Highest value.
    pub hi: f64,
    /// Label, with mark-up; empty for none.
    pub label: String,
    /// Ticks from low to high.
    pub ticks: Vec<Tick>,
}

/// Data as a logarithmic axis shows it: log10 of the value.
pub fn log(value: f64) -> f64 {
    f_log10(value)
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
        let decimals = (0..8).find(|&d| is_whole(step * POWERS[d])).unwrap_or(8);
        let slack = 1e-9;
        let (first, last) = ((lo / fine - slack).ceil() as i64, (hi / fine + slack).floor() as i64);
        let ticks = (first..=last)
            .map(|i| {
                let major = i % i64::from(minor) == 0;
                let at = if major { (i / i64::from(minor)) as f64 * step } else { i as f64 * fine };
                Tick { at: at.clamp(lo, hi), label: major.then(|| number(at, decimals)) }
            })
            .collect();
        Axis { lo, hi, label: label.into(), ticks }
    }

    /// A logarithmic axis from 10^`lo` to 10^`hi`, labelled every `every` decades; beyond five the
    /// decades between have no tick.
    pub fn decades(lo: i32, hi: i32, every: i32, label: &str) -> Self {
        let mut ticks = Vec::new();
        for exponent in lo..=hi {
            let base = f64::from(exponent);
            let labelled = (exponent - lo) % every == 0;
            if !labelled && every > 5 {
                continue;
            }
            let name = format!("10^{{{}}}", exponent.to_string().replace('-', "−"));
            ticks.push(Tick { at: base, label: labelled.then_some(name) });
            if every == 1 && exponent < hi {
                ticks.extend((2..10).map(|m| Tick { at: base + log(f64::from(m)), label: None }));
            }
        }
        Axis { lo: f64::from(lo), hi: f64::from(hi), label: label.into(), ticks }
    }

    /// Whether the axis holds a value; a wall touched within rounding is still inside.
    pub fn holds(&self, value: f64) -> bool {
        let slack = 1e-9 * (self.hi - self.lo);
        self.lo - slack <= value && value <= self.hi + slack
    }

    /// The same axis without numbers, for a panel that shares its neighbour's.
    pub fn bare(mut self) -> Self {
        self.label.clear();
        for tick in &mut self.ticks {
            tick.label = tick.label.take().map(|_| String::new());
        }
        self
    }
}

const POWERS: [f64; 8] = [1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 1e7];

fn is_whole(value: f64) -> bool {
    (value - value.round()).abs() < 1e-6
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().filter_map(|t| t.label.as_deref()).collect()
    }

    #[test]
    fn linear_ticks_are_exact_multiples() {
        let axis = Axis::linear(0.0, 0.4, 0.1, 2, "σ");
        assert_eq!(labels(&axis), ["0", "0.1", "0.2", "0.3", "0.4"]);
        assert_eq!(axis.ticks.len(), 9);
        assert_eq!(
            labels(&Axis::linear(-1.0, 1.0, 0.5, 1, "")),
            ["−1.0", "−0.5", "0", "0.5", "1.0"]
        );
        assert_eq!(
            labels(&Axis::linear(0.01, 0.0275, 0.005, 1, "")),
            ["0.010", "0.015", "0.020", "0.025"]
        );
    }

    #[test]
    fn decades_are_labelled_as_powers() {
        let axis = Axis::decades(-3, 0, 1, "p");
        assert_eq!(labels(&axis), ["10^{−3}", "10^{−2}", "10^{−1}", "10^{0}"]);
        assert_eq!(axis.ticks.len(), 4 + 3 * 8);
        assert_eq!(labels(&Axis::decades(-12, 0, 3, "")).len(), 5);
    }
}
