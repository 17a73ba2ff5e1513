//! The inputs of a quantity, read and checked.

use super::Options;
use super::quantity::Quantity;
use crate::cli::sigmas::LARGEST;
use crate::cli::{Failure, number};
use impact_circuits::LARGEST_N;
use impact_paper::params::{Chain, VERTICES};
use serde::Serialize;

/// What a quantity may depend on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// N, by `--masses` or `--vertices`.
    Vertices,
    /// `--p`.
    P,
    /// `--k`.
    K,
    /// `--sigma`.
    Sigma,
    /// ω, Ω and d, with defaults.
    Oscillator,
}

impl Need {
    /// How the list of quantities shows it.
    pub fn option(self) -> &'static str {
        match self {
            Need::Vertices => "[N]",
            Need::P => "--p",
            Need::K => "--k",
            Need::Sigma => "--sigma",
            Need::Oscillator => "[ω Ω d]",
        }
    }
}

/// The inputs that a quantity used, as the answer repeats them.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Inputs {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub masses: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vertices: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub omega: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forcing_frequency: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spacing: Option<f64>,
}

impl Inputs {
    /// Reads what the quantity needs, with defaults, and refuses what it does not use.
    pub fn read(quantity: &Quantity, options: &Options) -> Result<Self, Failure> {
        refuse_unused(quantity, options)?;
        let needs = |need| quantity.needs.contains(&need);
        let mut inputs = Inputs::default();
        if needs(Need::Vertices) {
            (inputs.masses, inputs.vertices) = vertices(options)?;
        }
        if needs(Need::P) {
            let text = required(quantity, "p", &options.p, "the probability of an edge, 0 to 1")?;
            inputs.p = Some(number("p", text)?);
        }
        if needs(Need::K) {
            let text = required(quantity, "k", &options.k, "the number of impacts, 1 to N")?;
            inputs.k = Some(whole("k", text)?);
        }
        if needs(Need::Sigma) {
            let meaning = "the standard deviation of the forcing";
            let text = required(quantity, "sigma", &options.sigma, meaning)?;
            let sigma = number("sigma", text)?;
            // Others are refused where they are used.
            if sigma > LARGEST && sigma.is_finite() {
                let what = format!("sigma: {sigma:e} is out of range; give {LARGEST} at most");
                return Err(Failure::input(what));
            }
            inputs.sigma = Some(sigma);
        }
        let chain = Chain::default();
        let or = |field, text: &Option<String>, default| match text {
            Some(text) => number(field, text).map(Some),
            None => Ok(Some(default)),
        };
        if needs(Need::Oscillator) {
            inputs.omega = or("omega", &options.omega, chain.natural_frequency)?;
            inputs.forcing_frequency =
                or("forcing-frequency", &options.forcing_frequency, chain.forcing_frequency)?;
            inputs.spacing = or("spacing", &options.spacing, chain.spacing)?;
            // As of a scenario.
            for (field, x, range) in [
                ("omega", inputs.omega, [1e-3, 1e3]),
                ("forcing-frequency", inputs.forcing_frequency, [1e-3, 1e3]),
                ("spacing", inputs.spacing, [1e-6, 1e6]),
            ] {
                bounded(field, x.unwrap_or(f64::NAN), range)?;
            }
        }
        Ok(inputs)
    }

    /// N.
    pub fn big_n(&self) -> usize {
        self.vertices.unwrap_or(VERTICES)
    }

    /// k.
    pub fn k(&self) -> usize {
        self.k.unwrap_or_default()
    }
}

/// n (if given) and N.
fn vertices(options: &Options) -> Result<(Option<usize>, Option<usize>), Failure> {
    match (&options.masses, &options.vertices) {
        (Some(_), Some(_)) => Err(Failure::input(
            "masses, vertices: both are given; give one of them (N = n + 1 between walls)",
        )),
        (None, None) => Ok((None, Some(VERTICES))),
        (None, Some(text)) => Ok((None, Some(whole("vertices", text)?))),
        (Some(text), None) => {
            let masses = whole("masses", text)?;
            if !(1..LARGEST_N).contains(&masses) {
                let problem = format!("masses: {masses} masses; give 1 ≤ n ≤ {}", LARGEST_N - 1);
                return Err(Failure::input(problem));
            }
            Ok((Some(masses), Some(masses + 1)))
        }
    }
}

/// Refuses a number outside a range.
fn bounded(field: &str, x: f64, [low, high]: [f64; 2]) -> Result<(), Failure> {
    if (low..=high).contains(&x) {
        return Ok(());
    }
    let short = |x: f64| match x.abs() {
        size if size == 0.0 || (1e-3..1e9).contains(&size) => x.to_string(),
        _ => format!("{x:e}"),
    };
    let [x, low, high] = [x, low, high].map(short);
    Err(Failure::input(format!("{field}: {x} is out of range; give {low} to {high}")))
}

fn required<'a>(
    quantity: &Quantity,
    field: &str,
    text: &'a Option<String>,
    meaning: &str,
) -> Result<&'a str, Failure> {
    let missing = || format!("{field}: {} needs it; give --{field}, {meaning}", quantity.name);
    text.as_deref().ok_or_else(|| Failure::input(missing()))
}

fn number(field: &str, text: &str) -> Result<f64, Failure> {
    number::parse(text).map_err(|what| Failure::input(format!("{field}: `{text}`: {what}")))
}

fn whole(field: &str, text: &str) -> Result<usize, Failure> {
    use std::num::IntErrorKind::PosOverflow;
    text.trim().parse().map_err(|error: std::num::ParseIntError| {
        let problem = match error.kind() {
            PosOverflow => format!("is too large; give at most {LARGEST_N}"),
            _ => "is not a whole number ≥ 0; give one such as 100".to_string(),
        };
        Failure::input(format!("{field}: `{text}` {problem}"))
    })
}

/// An option without effect is a misunderstanding, so it is an error.
fn refuse_unused(quantity: &Quantity, options: &Options) -> Result<(), Failure> {
    let given = [
        ("masses", &options.masses, Need::Vertices),
        ("vertices", &options.vertices, Need::Vertices),
        ("p", &options.p, Need::P),
        ("sigma", &options.sigma, Need::Sigma),
        ("k", &options.k, Need::K),
        ("omega", &options.omega, Need::Oscillator),
        ("forcing-frequency", &options.forcing_frequency, Need::Oscillator),
        ("spacing", &options.spacing, Need::Oscillator),
    ];
    for (field, text, need) in given {
        if text.is_some() && !quantity.needs.contains(&need) {
            let name = quantity.name;
            let problem = format!("{field}: {name} does not depend on it; leave --{field} out");
            return Err(Failure::input(problem));
        }
    }
    Ok(())
}
