//! Reads a scenario from JSON.

use crate::error::{Error, within};
use crate::scenario::{COMPONENTS, Initial, Overtone, Scenario, draw_pairs};
use crate::state::State;
use crate::{Boundary, Chain, Engine};
use impact_numerics::random::NormalPairs;
use serde::Deserialize;

/// One component: a pair for each mass.
type Pairs = Vec<[f64; 2]>;

/// The fields of a scenario file.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a JSON object")]
struct ScenarioFile {
    spacing: f64,
    natural_frequency: f64,
    forcing_frequency: Option<f64>,
    forcing_frequencies: Option<Vec<f64>>,
    restitution: f64,
    boundary: Boundary,
    initial: Start,
    forcing: Forcing,
}

/// The forcing: one component, or several.
#[derive(Deserialize)]
#[serde(untagged, expecting = "neither a list of pairs [alpha, beta] nor one for each frequency")]
enum Forcing {
    One(Pairs),
    Several(Vec<Pairs>),
}

/// The field `initial`.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum Start {
    Rest,
    Zero,
    Free(Pairs),
    At { positions: Vec<f64>, velocities: Vec<f64> },
    Random { sigma: f64, seed: u64 },
}

impl Default for ScenarioFile {
    fn default() -> Self {
        let chain = Chain::default();
        ScenarioFile {
            spacing: chain.spacing,
            natural_frequency: chain.natural_frequency,
            forcing_frequency: None,
            forcing_frequencies: None,
            restitution: chain.restitution,
            boundary: chain.boundary,
            initial: Start::Rest,
            forcing: Forcing::One(Vec::new()),
        }
    }
}

const REMEDY: &str =
    r#"write {"forcing": [[alpha, beta], ...]}, and other fields where they differ from the paper"#;

impl Scenario {
    /// Reads a scenario from JSON: `{"forcing": [[α₁, β₁], …]}`, with those fields of
    /// [`Chain`] that differ from the paper's.
    ///
    /// `"initial"` is `"rest"`, `"zero"`, `{"free": [[a₁, b₁], …]}`,
    /// `{"at": {"positions": [x₁, …], "velocities": [v₁, …]}}` or
    /// `{"random": {"sigma": σ, "seed": k}}`. Several components are
    /// `"forcing_frequencies": [Ω₁, …]` with a list of pairs for each.
    ///
    /// # Errors
    /// As [`Engine::new`]; [`Error::Input`] names the field and the remedy.
    pub fn from_json(text: &str) -> Result<Scenario, Error> {
        let scenario = Scenario::parse_json(text)?;
        Engine::new(&scenario)?;
        Ok(scenario)
    }

    /// Reads a scenario as [`Scenario::from_json`] does, but does not ask whether the engine can
    /// run it.
    ///
    /// # Errors
    /// [`Error::Input`] names the field and the remedy.
    pub fn parse_json(text: &str) -> Result<Scenario, Error> {
        parse(text)?.into_scenario()
    }
}

fn parse(text: &str) -> Result<ScenarioFile, Error> {
    let mut reader = serde_json::Deserializer::from_str(text);
    let file = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        // A part of the path that has no name is "?".
        let path = error.path().to_string().replace(".?", "");
        let field = match path.as_str() {
            "." | "?" => "scenario",
            "" => "unnamed field",
            named => named,
        };
        Error::input(field, error.inner().to_string(), REMEDY)
    })?;
    reader.end().map_err(|error| Error::input("scenario", error.to_string(), REMEDY))?;
    Ok(file)
}

impl ScenarioFile {
    fn into_scenario(self) -> Result<Scenario, Error> {
        let mut components =
            components(self.forcing, self.forcing_frequency, self.forcing_frequencies)?.into_iter();
        let (forcing_frequency, forcing) = components.next().unwrap_or_default();
        let masses = forcing.len();
        let zero = Initial::Free(vec![[0.0; 2]; masses]);
        let mut state = None;
        let initial = match self.initial {
            Start::Rest => Initial::Rest,
            Start::Zero => zero,
            Start::Free(parts) => Initial::Free(parts),
            Start::At { positions, velocities } => {
                state = Some(State { time: 0.0, positions, velocities });
                zero
            }
            Start::Random { sigma, seed } => {
                within("initial.random.sigma", sigma, 0.0, 1e9)?;
                let mut normals = NormalPairs::new("trace", seed, 0);
                Initial::Free(draw_pairs(masses, sigma, &mut normals))
            }
        };
        let scenario = Scenario {
            spacing: self.spacing,
            natural_frequency: self.natural_frequency,
            forcing_frequency,
            restitution: self.restitution,
            boundary: self.boundary,
            initial,
            forcing,
            overtones: components
                .map(|(frequency, amplitudes)| Overtone { frequency, amplitudes })
                .collect(),
        };
        match state {
            Some(state) => state.as_scenario(&scenario),
            None => Ok(scenario),
        }
    }
}

/// Returns the components of the forcing with their frequencies.
fn components(
    forcing: Forcing,
    frequency: Option<f64>,
    frequencies: Option<Vec<f64>>,
) -> Result<Vec<(f64, Pairs)>, Error> {
    match (forcing, frequency, frequencies) {
        (Forcing::One(pairs), frequency, None) => {
            let usual = Chain::default().forcing_frequency;
            Ok(vec![(frequency.unwrap_or(usual), pairs)])
        }
        (Forcing::Several(lists), None, Some(frequencies))
            if frequencies.len() == lists.len() && (1..=COMPONENTS).contains(&lists.len()) =>
        {
            Ok(frequencies.into_iter().zip(lists).collect())
        }
        _ => Err(Error::input(
            "forcing",
            "its lists do not match the frequencies",
            format!(
                "give one list of pairs, or 1 to {COMPONENTS} forcing_frequencies and a list for each"
            ),
        )),
    }
}
