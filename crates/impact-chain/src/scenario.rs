//! A scenario: one chain, its forcing and its start, complete and checked.

use crate::methods::State;
use crate::{Boundary, Chain, Engine, Error, Start, rounding};
use impact_numerics::random::NormalPairs;
use serde::Deserialize;

/// The start of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// At rest at equilibrium.
    Rest,
    /// Given free parts (a_j, b_j): x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
    Free(Vec<[f64; 2]>),
}

/// Components of the forcing that a scenario may have at most.
pub const COMPONENTS: usize = 8;

/// One component: a pair for each mass.
type Pairs = Vec<[f64; 2]>;

/// The form of a scenario file.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a JSON object")]
struct Form {
    spacing: f64,
    natural_frequency: f64,
    forcing_frequency: Option<f64>,
    forcing_frequencies: Option<Vec<f64>>,
    restitution: f64,
    boundary: Boundary,
    initial: InitialForm,
    forcing: Forcing,
}

/// One component, or several.
#[derive(Deserialize)]
#[serde(untagged, expecting = "no list of pairs [alpha, beta], nor one for each frequency")]
enum Forcing {
    One(Pairs),
    Several(Vec<Pairs>),
}

/// The start as a scenario file names it.
#[derive(Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
enum InitialForm {
    Rest,
    Zero,
    Free(Pairs),
    At { positions: Vec<f64>, velocities: Vec<f64> },
    Random { sigma: f64, seed: u64 },
}

impl Default for Form {
    fn default() -> Self {
        let chain = Chain::default();
        Form {
            spacing: chain.spacing,
            natural_frequency: chain.natural_frequency,
            forcing_frequency: None,
            forcing_frequencies: None,
            restitution: chain.restitution,
            boundary: chain.boundary,
            initial: InitialForm::Rest,
            forcing: Forcing::One(Vec::new()),
        }
    }
}

const FORM: &str = r#"write {"forcing": [[alpha, beta], ...]}, and other fields where they are not as in the paper"#;

impl Form {
    fn read(text: &str) -> Result<Self, Error> {
        let mut reader = serde_json::Deserializer::from_str(text);
        let form = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
            // A part of the path that has no name is "?".
            let path = error.path().to_string().replace(".?", "");
            let field = if [".", "?"].contains(&path.as_str()) { "scenario" } else { &path };
            Error::input(field, error.inner().to_string(), FORM)
        })?;
        reader.end().map_err(|error| Error::input("scenario", error.to_string(), FORM))?;
        Ok(form)
    }

    /// The components of the forcing, with their frequencies.
    fn components(&mut self) -> Result<Vec<(f64, Pairs)>, Error> {
        let usual = Chain::default().forcing_frequency;
        let forcing = std::mem::replace(&mut self.forcing, Forcing::One(Vec::new()));
        match (forcing, &self.forcing_frequency, self.forcing_frequencies.take()) {
            (Forcing::One(pairs), one, None) => Ok(vec![(one.unwrap_or(usual), pairs)]),
            (Forcing::Several(lists), None, Some(frequencies))
                if frequencies.len() == lists.len() && (1..=COMPONENTS).contains(&lists.len()) =>
            {
                Ok(frequencies.into_iter().zip(lists).collect())
            }
            _ => Err(Error::input(
                "forcing",
                "its lists and its frequencies do not belong together",
                format!(
                    "give one list of pairs, or 1 to {COMPONENTS} forcing_frequencies and a list for each"
                ),
            )),
        }
    }

    fn scenario(mut self) -> Result<Scenario, Error> {
        let mut components = self.components()?.into_iter();
        let (forcing_frequency, forcing) = components.next().unwrap_or_default();
        let overtone = |(frequency, amplitudes)| Overtone { frequency, amplitudes };
        let none = Initial::Free(vec![[0.0; 2]; forcing.len()]);
        let mut start = None;
        let initial = match self.initial {
            InitialForm::Rest => Initial::Rest,
            InitialForm::Zero => none,
            InitialForm::Free(parts) => Initial::Free(parts),
            InitialForm::At { positions, velocities } => {
                start = Some(State { time: 0.0, positions, velocities });
                none
            }
            InitialForm::Random { sigma, seed } => {
                within("initial.random.sigma", sigma, 0.0, 1e9)?;
                let mut normals = NormalPairs::new("trace", seed, 0);
                Initial::Free(scaled_pairs(forcing.len(), sigma, &mut normals))
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
            overtones: components.map(overtone).collect(),
        };
        start.map_or(Ok(scenario.clone()), |start| start.as_scenario(&scenario))
    }
}

/// `masses` pairs of normals with standard deviation `sigma`.
fn scaled_pairs(masses: usize, sigma: f64, normals: &mut NormalPairs) -> Pairs {
    (0..masses).map(|_| normals.pair().map(|x| sigma * x)).collect()
}

/// Refuses a number outside [low, high].
pub(crate) fn within(field: &str, x: f64, low: f64, high: f64) -> Result<(), Error> {
    if (low..=high).contains(&x) {
        return Ok(());
    }
    let remedy = format!("give a number from {low:?} to {high:?}");
    Err(Error::input(field, format!("{x:?} is out of range"), remedy))
}

/// Refuses a list that is not one pair of numbers for each mass.
fn pairs_within(field: &str, pairs: &[[f64; 2]], masses: usize) -> Result<(), Error> {
    if pairs.len() != masses || masses == 0 {
        let problem = format!("it has {} pairs for {masses} masses", pairs.len());
        return Err(Error::input(field, problem, "give one pair for each mass, at least one"));
    }
    let all = pairs.iter().enumerate().flat_map(|(j, pair)| pair.map(|x| (j, x)));
    all.into_iter().try_for_each(|(j, x)| within(&format!("{field}[{j}]"), x, -1e9, 1e9))
}

/// One chain with the amplitudes of its forcing.
///
/// **Eq. (3)**: the forcing is a sum over components; the paper goes on with one, Eq. (5).
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Distance d between equilibria.
    pub spacing: f64,
    /// Natural frequency ω.
    pub natural_frequency: f64,
    /// Forcing frequency Ω.
    pub forcing_frequency: f64,
    /// Coefficient of restitution r.
    pub restitution: f64,
    /// Walls or ring.
    pub boundary: Boundary,
    /// The start.
    pub initial: Initial,
    /// Amplitudes (α_j, β_j) of Eq. (5), one pair a mass.
    pub forcing: Vec<[f64; 2]>,
    /// Further components of the forcing, Eq. (3); the paper has none.
    pub overtones: Vec<Overtone>,
}

/// A further component of the forcing.
#[derive(Clone, Debug, PartialEq)]
pub struct Overtone {
    /// Its frequency Ω.
    pub frequency: f64,
    /// Its amplitudes (α_j, β_j), one pair a mass.
    pub amplitudes: Vec<[f64; 2]>,
}

impl Scenario {
    /// **Eq. (5)**
    ///
    /// Draws the amplitudes α_j, β_j of the forcing α_j cos Ωt + β_j sin Ωt with standard deviation `sigma` from `normals`: first the
    /// n pairs of the forcing, then, for a random start, the n pairs of the free part.
    pub fn draw(chain: &Chain, sigma: f64, normals: &mut NormalPairs) -> Scenario {
        let mut scenario = Scenario::of(chain, scaled_pairs(chain.masses, sigma, normals));
        if chain.start == Start::Random {
            scenario.initial = Initial::Free(scaled_pairs(chain.masses, sigma, normals));
        }
        scenario
    }

    /// A chain with given amplitudes; [`Start::Random`] is taken as [`Start::Zero`], as there are no random numbers.
    pub fn given(chain: &Chain, forcing: Vec<[f64; 2]>) -> Result<Scenario, Error> {
        pairs_within("forcing", &forcing, chain.masses)?;
        Ok(Scenario::of(chain, forcing))
    }

    fn of(chain: &Chain, forcing: Vec<[f64; 2]>) -> Scenario {
        let none = || Initial::Free(vec![[0.0; 2]; forcing.len()]);
        Scenario {
            spacing: chain.spacing,
            natural_frequency: chain.natural_frequency,
            forcing_frequency: chain.forcing_frequency,
            restitution: chain.restitution,
            boundary: chain.boundary,
            initial: if chain.start == Start::Rest { Initial::Rest } else { none() },
            forcing,
            overtones: Vec::new(),
        }
    }

    /// Reads a scenario from JSON: `{"forcing": [[α₁, β₁], …]}`, with those fields of [`Chain`] that differ from the paper's.
    ///
    /// `"initial"` is `"rest"`, `"zero"`, `{"free": [[a₁, b₁], …]}`, `{"at": {"positions": [x₁, …], "velocities": [v₁, …]}}`
    /// or `{"random": {"sigma": σ, "seed": k}}`. Several components are `"forcing_frequencies": [Ω₁, …]` with a list of pairs for each.
    ///
    /// # Errors
    /// As [`Engine::new`]; [`Error::Input`] names the field and the remedy.
    pub fn from_json(text: &str) -> Result<Scenario, Error> {
        let scenario = Form::read(text)?.scenario()?;
        Engine::new(&scenario)?;
        Ok(scenario)
    }

    /// Checks every field against the model.
    pub fn validate(&self) -> Result<(), Error> {
        within("spacing", self.spacing, 1e-6, 1e6)?;
        within("natural_frequency", self.natural_frequency, 1e-3, 1e3)?;
        within("restitution", self.restitution, 0.0, 1.0)?;
        let masses = self.forcing.len();
        for (m, (frequency, pairs)) in self.components().enumerate() {
            let (of, field) = match self.overtones.is_empty() {
                true => ("forcing_frequency".to_string(), "forcing".to_string()),
                false => (format!("forcing_frequencies[{m}]"), format!("forcing[{m}]")),
            };
            within(&of, frequency, 1e-3, 1e3)?;
            if frequency == self.natural_frequency || m >= COMPONENTS {
                return Err(Error::input(
                    of,
                    format!(
                        "{frequency:?} equals the natural frequency (resonance), or is one too many"
                    ),
                    format!("choose another; give 1 to {COMPONENTS}"),
                ));
            }
            pairs_within(&field, pairs, masses)?;
        }
        if let Initial::Free(free) = &self.initial {
            pairs_within("initial.free", free, masses)?;
        }
        let (width, most) = (rounding::width(self), rounding::MOST * self.spacing);
        if width <= most {
            return Ok(());
        }
        Err(Error::input(
            "forcing",
            format!(
                "amplitudes of the motion (alpha/(w^2 - W^2) and the free parts) are so large that rounding \
                 may move a gap by {width:.1e}, which is more than {most:?}"
            ),
            "give frequencies further from the natural one, or smaller amplitudes",
        ))
    }

    /// The continuation from `time`, when all forces change by `factor`, with time counted from there: every phase is
    /// advanced by it. Positions and velocities are continuous, so the free parts, `free` until then, take up the change of
    /// the forced response.
    pub fn lowered(&self, free: &[[f64; 2]], time: f64, factor: f64) -> Scenario {
        let omega = self.natural_frequency;
        let turned = |pairs: &[[f64; 2]], frequency: f64| -> Pairs {
            let (sin, cos) = pxfm::f_sincos(frequency * time);
            pairs.iter().map(|[a, b]| [a * cos + b * sin, b * cos - a * sin]).collect()
        };
        let mut parts = turned(free, omega);
        let mut components = self.components().map(|(big_omega, forces)| {
            let mut amplitudes = turned(forces, big_omega);
            let lost = (1.0 - factor) / (omega * omega - big_omega * big_omega);
            for ([a, b], force) in parts.iter_mut().zip(&mut amplitudes) {
                *a += lost * force[0];
                *b += lost * big_omega / omega * force[1];
                *force = force.map(|x| factor * x);
            }
            Overtone { frequency: big_omega, amplitudes }
        });
        let forcing = components.next().map_or_else(Vec::new, |first| first.amplitudes);
        let overtones = components.collect();
        Scenario { initial: Initial::Free(parts), forcing, overtones, ..self.clone() }
    }

    /// The components of the forcing: frequency, and amplitudes of each mass.
    pub fn components(&self) -> impl Iterator<Item = (f64, &[[f64; 2]])> {
        let further = self.overtones.iter().map(|o| (o.frequency, o.amplitudes.as_slice()));
        std::iter::once((self.forcing_frequency, self.forcing.as_slice())).chain(further)
    }

    /// The largest of ω and the frequencies of the forcing.
    pub fn fastest(&self) -> f64 {
        self.components().fold(self.natural_frequency, |fastest, (big_w, _)| fastest.max(big_w))
    }

    /// The frequencies of the forcing, filled up to `M` with the first.
    pub(super) fn frequencies<const M: usize>(&self) -> [f64; M] {
        std::array::from_fn(|m| match m.checked_sub(1).and_then(|m| self.overtones.get(m)) {
            Some(overtone) => overtone.frequency,
            None => self.forcing_frequency,
        })
    }

    /// The amplitudes (α_j, β_j) of mass j, counted from 0, filled up to `M` with zeros.
    pub(super) fn amplitudes<const M: usize>(&self, j: usize) -> [[f64; 2]; M] {
        std::array::from_fn(|m| match m.checked_sub(1) {
            None => self.forcing[j],
            Some(m) => self.overtones.get(m).map_or([0.0; 2], |o| o.amplitudes[j]),
        })
    }

    /// Number of gaps.
    pub fn gaps(&self) -> usize {
        self.boundary.gaps(self.forcing.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_velocities_go_on_when_the_force_is_lowered() {
        let chain = Chain { masses: 5, ..Chain::default() };
        let mut normals = NormalPairs::new("test of history", 1, 1);
        let mut hot = Scenario::draw(&chain, 0.3, &mut normals);
        let amplitudes = (0..5).map(|_| normals.pair()).collect();
        hot.overtones = vec![Overtone { frequency: 2.3, amplitudes }];
        let free: Vec<[f64; 2]> = (0..5).map(|_| normals.pair()).collect();
        let (time, h) = (7.3, 1e-5);
        let place = |scenario: &Scenario, free: [f64; 2], j: usize, t: f64| {
            let (sin, cos) = pxfm::f_sincos(t);
            let forced = scenario.components().map(|(big_omega, forces)| {
                let (sin, cos) = pxfm::f_sincos(big_omega * t);
                (forces[j][0] * cos + forces[j][1] * sin) / (1.0 - big_omega * big_omega)
            });
            free[0] * cos + free[1] * sin + forced.sum::<f64>()
        };
        let after = hot.lowered(&free, time, 0.4);
        let Initial::Free(parts) = &after.initial else { panic!() };
        for j in 0..5 {
            let before = |t| place(&hot, free[j], j, t);
            let then = |t| place(&after, parts[j], j, t);
            assert!((before(time) - then(0.0)).abs() < 1e-12);
            let speeds = [before(time + h) - before(time - h), then(h) - then(-h)];
            assert!((speeds[0] - speeds[1]).abs() < 1e-9 * h.sqrt(), "{speeds:?}");
        }
    }

    #[test]
    fn a_start_from_places_and_rates_is_there() {
        let at = r#"{"positions":[0.9,2.2],"velocities":[0.5,-0.25]}"#;
        let json = format!(r#"{{"forcing":[[0.3,0.2],[-0.1,0.4]],"initial":{{"at":{at}}}}}"#);
        let engine = Engine::new(&Scenario::from_json(&json).unwrap()).unwrap();
        let found = [engine.positions(0.0), engine.velocities(0.0)];
        for (found, given) in found.iter().flatten().zip([0.9, 2.2, 0.5, -0.25]) {
            assert!((found - given).abs() < 1e-15, "{found} {given}");
        }
    }
}
