//! Reads a scenario from JSON, and writes one.

use crate::error::{Error, check_range};
use crate::scenario::{COMPONENTS, Initial, Overtone, Scenario, draw_pairs};
use crate::state::State;
use crate::{Boundary, Chain, Engine};
use impact_numerics::random::{NormalPairs, Seed};
use serde::{Deserialize, Serialize, Serializer};
use serde_json::Value;

/// One component: a pair for each mass.
type Pairs = Vec<[f64; 2]>;

#[derive(Deserialize, Serialize)]
#[serde(default, deny_unknown_fields)]
struct ScenarioFile {
    spacing: f64,
    natural_frequency: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    forcing_frequency: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    forcing_frequencies: Option<Vec<f64>>,
    restitution: f64,
    boundary: Boundary,
    #[serde(skip_serializing_if = "Option::is_none")]
    places: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    walls: Option<[f64; 2]>,
    initial: Start,
    forcing: Forcing,
}

#[derive(Deserialize, Serialize)]
#[serde(untagged, expecting = "neither a list of pairs [alpha, beta] nor one for each frequency")]
enum Forcing {
    One(Pairs),
    Several(Vec<Pairs>),
}

#[derive(Deserialize, Serialize)]
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
            places: None,
            walls: None,
            initial: Start::Rest,
            forcing: Forcing::One(Vec::new()),
        }
    }
}

/// What people look for in vain, by a part of its name, and what to do instead.
const NOT_IN_MODEL: [(&str, &str); 6] = [
    ("damp", "flight is not damped; only impacts take energy out (restitution)"),
    ("friction", "there is no friction; only impacts take energy out (restitution)"),
    ("mass", "all masses are 1; the length of forcing is their number"),
    ("stiff", "all springs are alike and go to the ground; give natural_frequency"),
    ("gravity", "give places: a constant force F shifts the place of a mass by F/w^2"),
    ("coupl", "no springs join the masses; they meet in impacts only"),
];

const REMEDY: &str =
    r#"write {"forcing": [[alpha, beta], ...]}, and other fields where they differ from the paper"#;

impl Scenario {
    /// Reads a scenario from JSON: `{"forcing": [[α₁, β₁], …]}`, with those fields of
    /// [`Chain`] that differ from the paper's.
    ///
    /// `"initial"` is `"rest"`, `"zero"`, `{"free": [[a₁, b₁], …]}`,
    /// `{"at": {"positions": [x₁, …], "velocities": [v₁, …]}}` or
    /// `{"random": {"sigma": σ, "seed": k}}`. Several components are
    /// `"forcing_frequencies": [Ω₁, …]` with a list of pairs for each. `"places": [p₁, …]` and
    /// `"walls": [p₀, pₙ₊₁]` are places of equilibrium other than j d; a ring has no walls.
    ///
    /// # Errors
    /// As [`Engine::new`]; [`Error::Input`] names the field and the remedy.
    pub fn from_json(text: &str) -> Result<Scenario, Error> {
        let scenario = Scenario::parse_json(text)?;
        Engine::new(&scenario)?;
        Ok(scenario)
    }

    /// Reads a scenario as [`Scenario::from_json`] does, whether the engine can run it or not.
    pub fn parse_json(text: &str) -> Result<Scenario, Error> {
        read_file(text)?.into_scenario()
    }

    /// Writes the scenario as JSON in one line, from which [`Scenario::from_json`] reads the same,
    /// without the places of the walls on a ring. One that [`Scenario::validate`] refuses is not
    /// read again, or as another.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).unwrap_or_default()
    }
}

/// In the form of [`Scenario::to_json`].
impl Serialize for Scenario {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let several = !self.overtones.is_empty();
        let (frequencies, lists) =
            self.components().map(|(frequency, pairs)| (frequency, pairs.to_vec())).unzip();
        let (masses, walls) = match self.places.as_deref() {
            Some([left, masses @ .., right]) => {
                let walls = (self.boundary == Boundary::Walls).then_some([*left, *right]);
                (Some(masses.to_vec()), walls)
            }
            _ => (None, None),
        };
        let file = ScenarioFile {
            spacing: self.spacing,
            natural_frequency: self.natural_frequency,
            forcing_frequency: (!several).then_some(self.forcing_frequency),
            forcing_frequencies: several.then_some(frequencies),
            restitution: self.restitution,
            boundary: self.boundary,
            places: masses,
            walls,
            initial: match &self.initial {
                Initial::Rest => Start::Rest,
                Initial::Free(parts) => Start::Free(parts.clone()),
            },
            forcing: if several {
                Forcing::Several(lists)
            } else {
                Forcing::One(self.forcing.clone())
            },
        };
        file.serialize(serializer)
    }
}

fn read_file(text: &str) -> Result<ScenarioFile, Error> {
    // Fields have names: an array is not taken for them by position.
    let value: Value = serde_json::from_str(text).unwrap_or_default();
    let objects =
        [("", "scenario"), ("/initial/at", "initial.at"), ("/initial/random", "initial.random")];
    for (place, field) in objects {
        if value.pointer(place).is_some_and(Value::is_array) {
            return Err(Error::input(field, "it is an array, not a JSON object", REMEDY));
        }
    }
    let mut reader = serde_json::Deserializer::from_str(text);
    let read: Result<ScenarioFile, _> = serde_path_to_error::deserialize(&mut reader);
    let file = read.map_err(|error| {
        // A part of the path that has no name is "?".
        let path = error.path().to_string().replace(".?", "");
        let field = match path.as_str() {
            "." | "?" => "scenario",
            "" => "unnamed field",
            path => path,
        };
        let error = error.inner();
        if is_not_finite(text, error) {
            let problem = format!("not finite at line {} column {}", error.line(), error.column());
            return Error::input(field, problem, "give a finite number");
        }
        let problem = error.to_string();
        let unknown = problem.strip_prefix("unknown field `");
        let name = unknown.and_then(|rest| rest.split('`').next()).unwrap_or_default();
        match NOT_IN_MODEL.iter().find(|(part, _)| name.contains(part)) {
            Some((_, instead)) => Error::input(field, "it is not in the model", *instead),
            None => Error::input(field, problem, REMEDY),
        }
    })?;
    reader.end().map_err(|error| {
        let remedy = "give one scenario, or read one from each line (trace --lines)";
        Error::input("scenario", error.to_string(), remedy)
    })?;
    Ok(file)
}

/// Returns whether JSON could not be read because of NaN or an infinity, for which it has no
/// number.
fn is_not_finite(text: &str, error: &serde_json::Error) -> bool {
    let line = text.lines().nth(error.line().saturating_sub(1)).unwrap_or_default();
    let rest = line.get(error.column().saturating_sub(1)..).unwrap_or_default();
    let names = ["NaN", "Infinity", "-Infinity"];
    error.is_syntax() && names.iter().any(|name| rest.starts_with(name))
}

impl ScenarioFile {
    fn into_scenario(self) -> Result<Scenario, Error> {
        let mut components =
            components(self.forcing, self.forcing_frequency, self.forcing_frequencies)?.into_iter();
        let (forcing_frequency, forcing) = components.next().unwrap_or_default();
        let masses = forcing.len();
        let zero = Initial::Free(vec![[0.0; 2]; masses]);
        if self.boundary == Boundary::Ring && self.walls.is_some() {
            return Err(Error::input("walls", "a ring has none", "leave it out"));
        }
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
                check_range("initial.random.sigma", sigma, 0.0, 1e9)?;
                let mut normals = NormalPairs::new("trace", Seed(seed), 0);
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
            places: places(masses, self.spacing, self.places, self.walls)?,
        };
        let Some(state) = state else { return Ok(scenario) };
        state.as_scenario(&scenario).map_err(|mut error| {
            if let Error::Input { field, .. } | Error::Overlap { field, .. } = &mut error
                && (field.starts_with("positions") || field.starts_with("velocities"))
            {
                field.insert_str(0, "initial.at.");
            }
            error
        })
    }
}

fn places(
    masses: usize,
    spacing: f64,
    places: Option<Vec<f64>>,
    walls: Option<[f64; 2]>,
) -> Result<Option<Vec<f64>>, Error> {
    if places.is_none() && walls.is_none() {
        return Ok(None);
    }
    let regular = (1..=masses).map(|j| j as f64 * spacing).collect();
    let places: Vec<f64> = places.unwrap_or(regular);
    if places.len() != masses {
        let problem = format!("it has {} places for {masses} masses", places.len());
        return Err(Error::input("places", problem, "give one for each mass"));
    }
    for wall in walls.into_iter().flatten() {
        check_range("walls", wall, -1e9, 1e9)?;
    }
    let [left, right] = walls.unwrap_or([0.0, (masses + 1) as f64 * spacing]);
    Ok(Some([vec![left], places, vec![right]].concat()))
}

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

#[cfg(test)]
mod tests {
    use super::*;

    /// A ring without walls is written so that it can be read; one with walls is refused.
    #[test]
    fn a_ring_has_no_walls() {
        let ring = |more: &str| {
            Scenario::from_json(&format!(
                r#"{{"boundary":"ring",{more},"forcing":[[0.9,0.1],[-0.8,0.3]]}}"#
            ))
        };
        let placed = ring(r#""places":[1.1,2.0]"#).unwrap();
        assert_eq!(Scenario::from_json(&placed.to_json()), Ok(placed));
        let refused = ring(r#""walls":[3,0]"#).unwrap_err().to_string();
        assert_eq!(refused, "walls: a ring has none; leave it out");
        let far = Scenario::from_json(r#"{"walls":[0,1e300],"forcing":[[0,0]]}"#).unwrap_err();
        assert!(far.to_string().starts_with("walls: "), "{far}");
    }

    #[test]
    fn numbers_that_are_not_finite_and_overlaps_are_called_by_their_field() {
        for (text, expected) in [
            (
                r#"{"forcing": [[NaN, 0]]}"#,
                "forcing[0][0]: not finite at line 1 column 15; give a finite number",
            ),
            (r#"{"spacing":-Infinity}"#, "spacing: not finite at line 1 column 1"),
            (
                r#"{"forcing":[[0,0]],"initial":{"at":{"positions":[-1],"velocities":[0]}}}"#,
                "initial.at.positions: gap 0 starts overlapped by 1e0",
            ),
        ] {
            let refused = Scenario::from_json(text).unwrap_err().to_string();
            assert!(refused.starts_with(expected), "{refused}");
        }
    }
}
