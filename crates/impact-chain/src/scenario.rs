//! A scenario: one chain, its forcing and its start, complete and checked.

use crate::methods::State;
use crate::{Boundary, Chain, Engine, Error, Start, rounding};
use impact_numerics::random::NormalPairs;
use impact_numerics::text::{count, plain};
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// The start of one scenario.
#[derive(Clone, Debug, PartialEq)]
pub enum Initial {
    /// At rest at equilibrium.
    Rest,
    /// No free part.
    Zero,
    /// Given free parts (a_j, b_j): x_j = j d + a_j cos ωt + b_j sin ωt + forced response.
    Free(Vec<[f64; 2]>),
}

/// Components of the forcing that a scenario may have at most.
pub const COMPONENTS: usize = 8;

/// The form of a scenario file, with forcing `F`: one component, or several with their frequencies.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Form<F: Default> {
    spacing: f64,
    natural_frequency: f64,
    forcing_frequency: Option<f64>,
    forcing_frequencies: Option<Vec<f64>>,
    restitution: f64,
    boundary: Boundary,
    initial: InitialForm,
    forcing: F,
}

/// One component: a pair for each mass.
type Pairs = Vec<[f64; 2]>;

/// The start as a scenario file names it.
#[derive(Deserialize)]
#[serde(
    rename_all = "lowercase",
    expecting = "\"rest\", \"zero\", {\"free\": …}, {\"at\": …} or {\"random\": …}"
)]
enum InitialForm {
    Rest,
    Zero,
    Free(Vec<[f64; 2]>),
    At(Object<At>),
    Random(Object<Random>),
}

/// The form of a start from places and rates.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct At {
    positions: Vec<f64>,
    velocities: Vec<f64>,
}

/// The form of a random start.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Random {
    sigma: f64,
    seed: u64,
}

/// Fields by their names: serde would take an array of them, in their order, as well.
struct Object<T>(T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Fields<T>(PhantomData<T>);

        impl<'de, T: Deserialize<'de>> Visitor<'de> for Fields<T> {
            type Value = Object<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a JSON object {…}")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Object<T>, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map)).map(Object)
            }
        }

        from.deserialize_map(Fields(PhantomData))
    }
}

impl<F: Default> Default for Form<F> {
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
            forcing: F::default(),
        }
    }
}

impl<F: Default> Form<F> {
    /// Reads a form.
    fn read<'a>(text: &'a str) -> Result<Self, Error>
    where
        F: Deserialize<'a>,
    {
        let remedy =
            r#"write {"forcing": [[alpha, beta], ...]}, and what is not as in the paper beside it"#;
        let refuse = |problem: &str| Err(Error::input("scenario", problem, remedy));
        if text.trim().is_empty() {
            return refuse("it is empty");
        }
        if text.starts_with('\u{feff}') {
            return refuse("it begins with a byte-order mark; save it as UTF-8 without");
        }
        let mut reader = serde_json::Deserializer::from_str(text);
        let Object(form) = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
            // What has no name in the path is called "?".
            let path = error.path().to_string().replace(".?", "");
            let field =
                if [".", "?"].contains(&path.as_str()) { "scenario".to_string() } else { path };
            Error::input(field, plain(&error.into_inner().to_string()), remedy)
        })?;
        reader.end().map_err(|error| {
            let remedy = "write one JSON object and nothing after it";
            Error::input("scenario", error.to_string(), remedy)
        })?;
        Ok(form)
    }

    /// The scenario with these components of the forcing.
    fn with(self, components: Vec<(f64, Pairs)>) -> Result<Scenario, Error> {
        let masses = components.first().map_or(0, |(_, pairs)| pairs.len());
        let mut start = None;
        let initial = match self.initial {
            InitialForm::Rest => Initial::Rest,
            InitialForm::Zero => Initial::Zero,
            InitialForm::Free(parts) => Initial::Free(parts),
            InitialForm::At(Object(At { positions, velocities })) => {
                start = Some(State { time: 0.0, positions, velocities });
                Initial::Zero
            }
            InitialForm::Random(Object(Random { sigma, seed })) => {
                if !(0.0..=1e9).contains(&sigma) {
                    return Err(Error::input(
                        "initial.random.sigma",
                        format!("{sigma:?} is no standard deviation"),
                        "give a number from 0.0 to 1e9",
                    ));
                }
                let mut normals = NormalPairs::new("trace", seed, 0);
                Initial::Free(scaled_pairs(masses, sigma, &mut normals))
            }
        };
        let mut components = components.into_iter();
        let (forcing_frequency, forcing) = components.next().unwrap_or_default();
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
        start.map_or(Ok(scenario.clone()), |start| start.as_scenario(&scenario))
    }
}

/// Does the forcing begin with three brackets, as that of several components? Its brackets tell it even where the text is
/// broken further on; of empty ones their frequencies tell it.
fn has_lists(text: &str) -> bool {
    let key = text.split_once("\"forcing\"").map_or("", |(_, behind)| behind);
    let signs: String = key.chars().filter(|c| !c.is_whitespace()).take(4).collect();
    let empty = signs.starts_with(":[]") || signs == ":[[]";
    signs == ":[[[" || (empty && text.contains("\"forcing_frequencies\""))
}

impl Form<Pairs> {
    /// The scenario of a form with one component.
    fn scenario(mut self) -> Result<Scenario, Error> {
        if self.forcing_frequencies.is_some() {
            return Err(Error::input(
                "forcing",
                "it is one list of pairs beside forcing_frequencies",
                "give one list of pairs for each frequency, or one forcing_frequency",
            ));
        }
        let frequency = self.forcing_frequency.take();
        let pairs = std::mem::take(&mut self.forcing);
        self.with(vec![(frequency.unwrap_or(Chain::default().forcing_frequency), pairs)])
    }
}

impl Form<Vec<Pairs>> {
    /// The scenario of a form with several components.
    fn scenario(mut self) -> Result<Scenario, Error> {
        let Some(frequencies) = self.forcing_frequencies.take() else {
            return Err(Error::input(
                "forcing",
                "it has lists of pairs, as several components do, and there are no forcing_frequencies",
                "give the frequency of each list, or give forcing one pair for each mass",
            ));
        };
        if self.forcing_frequency.is_some() {
            return Err(Error::input(
                "forcing_frequency",
                "it stands beside forcing_frequencies",
                "give one of the two",
            ));
        }
        let forcing = std::mem::take(&mut self.forcing);
        if frequencies.len() != forcing.len() || forcing.is_empty() || forcing.len() > COMPONENTS {
            let (given, lists) = (frequencies.len(), forcing.len());
            return Err(Error::input(
                "forcing_frequencies",
                format!("their number is {given}, and forcing has {}", count(lists, "list")),
                format!("give 1 to {COMPONENTS}, and one list of pairs for each"),
            ));
        }
        self.with(frequencies.into_iter().zip(forcing).collect())
    }
}

/// `masses` pairs of normals with standard deviation `sigma`.
fn scaled_pairs(masses: usize, sigma: f64, normals: &mut NormalPairs) -> Vec<[f64; 2]> {
    (0..masses).map(|_| normals.pair().map(|x| sigma * x)).collect()
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

    /// A chain with given amplitudes; a random start, of which there is no chance here, is one without a free part.
    ///
    /// # Errors
    /// [`Error::Input`] if there is not one pair for each mass of the chain.
    pub fn given(chain: &Chain, forcing: Vec<[f64; 2]>) -> Result<Scenario, Error> {
        if forcing.len() != chain.masses {
            return Err(Error::input(
                "forcing",
                format!(
                    "it has {} for {}",
                    count(forcing.len(), "pair"),
                    count(chain.masses, "mass")
                ),
                "give one pair [alpha, beta] for each mass",
            ));
        }
        Ok(Scenario::of(chain, forcing))
    }

    fn of(chain: &Chain, forcing: Vec<[f64; 2]>) -> Scenario {
        Scenario {
            spacing: chain.spacing,
            natural_frequency: chain.natural_frequency,
            forcing_frequency: chain.forcing_frequency,
            restitution: chain.restitution,
            boundary: chain.boundary,
            initial: if chain.start == Start::Rest { Initial::Rest } else { Initial::Zero },
            forcing,
            overtones: Vec::new(),
        }
    }

    /// Reads a scenario from JSON: `{"forcing": [[α₁, β₁], …]}`, with the fields of [`Chain`] beside it where they are not as in the paper.
    ///
    /// `"initial"` is `"rest"`, `"zero"`, `{"free": [[a₁, b₁], …]}`, `{"at": {"positions": [x₁, …], "velocities": [v₁, …]}}`
    /// or `{"random": {"sigma": σ, "seed": k}}`. Several components are `"forcing_frequencies": [Ω₁, …]` with a list of pairs for each.
    ///
    /// # Errors
    /// As [`Engine::new`]; [`Error::Input`] names the field and the remedy.
    pub fn from_json(text: &str) -> Result<Scenario, Error> {
        let scenario = if has_lists(text) {
            Form::<Vec<Pairs>>::read(text)?.scenario()?
        } else {
            Form::<Pairs>::read(text)?.scenario()?
        };
        Engine::new(&scenario)?;
        Ok(scenario)
    }

    /// Checks every field against the model.
    ///
    /// # Errors
    /// [`Error::Input`] names the first field that is out of bounds.
    pub fn validate(&self) -> Result<(), Error> {
        let within = |field: &str, x: f64, low: f64, high: f64| {
            if x >= low && x <= high {
                return Ok(());
            }
            let remedy = format!("give a number from {low:?} to {high:?}");
            Err(Error::input(field, format!("{x:?} is out of range"), remedy))
        };
        within("spacing", self.spacing, 1e-6, 1e6)?;
        within("natural_frequency", self.natural_frequency, 1e-3, 1e3)?;
        within("restitution", self.restitution, 0.0, 1.0)?;
        let single = self.overtones.is_empty();
        if self.overtones.len() >= COMPONENTS {
            return Err(Error::input(
                "forcing_frequencies",
                format!("{} are too many", self.overtones.len() + 1),
                format!("give 1 to {COMPONENTS}"),
            ));
        }
        let frequencies = std::iter::once(self.forcing_frequency)
            .chain(self.overtones.iter().map(|overtone| overtone.frequency));
        for (m, frequency) in frequencies.enumerate() {
            let field = match single {
                true => "forcing_frequency".to_string(),
                false => format!("forcing_frequencies[{m}]"),
            };
            within(&field, frequency, 1e-3, 1e3)?;
            if frequency == self.natural_frequency {
                return Err(Error::input(
                    field,
                    format!("{frequency:?} equals the natural frequency (resonance)"),
                    "the undamped response grows without bound; choose another frequency",
                ));
            }
        }
        if self.forcing.is_empty() {
            return Err(Error::input(
                "forcing",
                "it names no mass",
                "give one pair [alpha, beta] for each mass, at least one",
            ));
        }
        let pairs = |field: &str, pairs: &[[f64; 2]]| {
            for (j, pair) in pairs.iter().enumerate() {
                for x in pair {
                    within(&format!("{field}[{j}]"), *x, -1e9, 1e9)?;
                }
            }
            Ok(())
        };
        pairs(if single { "forcing" } else { "forcing[0]" }, &self.forcing)?;
        for (m, overtone) in self.overtones.iter().enumerate() {
            let field = format!("forcing[{}]", m + 1);
            if overtone.amplitudes.len() != self.forcing.len() {
                let (own, first) = (overtone.amplitudes.len(), self.forcing.len());
                return Err(Error::input(
                    field,
                    format!("it has {}, forcing[0] has {first}", count(own, "pair")),
                    "give one pair [alpha, beta] for each mass in each list",
                ));
            }
            pairs(&field, &overtone.amplitudes)?;
        }
        if let Initial::Free(free) = &self.initial {
            if free.len() != self.forcing.len() {
                return Err(Error::input(
                    "initial.free",
                    format!(
                        "it has {} for {}",
                        count(free.len(), "pair"),
                        count(self.forcing.len(), "mass")
                    ),
                    "give one pair [a, b] for each mass",
                ));
            }
            pairs("initial.free", free)?;
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

    /// The same motion with time begun anew at `time`, from the free parts that its masses have then: every
    /// phase is turned by what passed, and places, velocities and forces go on.
    pub fn later(&self, free: &[[f64; 2]], time: f64) -> Scenario {
        let turned = |pairs: &[[f64; 2]], frequency: f64| -> Vec<[f64; 2]> {
            let (sin, cos) = pxfm::f_sincos(frequency * time);
            pairs.iter().map(|[a, b]| [a * cos + b * sin, b * cos - a * sin]).collect()
        };
        let overtone = |own: &Overtone| Overtone {
            frequency: own.frequency,
            amplitudes: turned(&own.amplitudes, own.frequency),
        };
        Scenario {
            initial: Initial::Free(turned(free, self.natural_frequency)),
            forcing: turned(&self.forcing, self.forcing_frequency),
            overtones: self.overtones.iter().map(overtone).collect(),
            ..self.clone()
        }
    }

    /// The scenario that goes on from a time at which all forces change by a factor: places and velocities stay, so the
    /// free parts, given as they are then, take what the forced parts lose.
    pub fn lowered(&self, free: &[[f64; 2]], time: f64, factor: f64) -> Scenario {
        let omega = self.natural_frequency;
        let now = self.later(free, time);
        let Initial::Free(mut parts) = now.initial.clone() else { return now };
        for (big_omega, forces) in now.components() {
            let lost = (1.0 - factor) / (omega * omega - big_omega * big_omega);
            for ([a, b], force) in parts.iter_mut().zip(forces) {
                *a += lost * force[0];
                *b += lost * big_omega / omega * force[1];
            }
        }
        let lower =
            |forces: &[[f64; 2]]| forces.iter().map(|own| own.map(|x| factor * x)).collect();
        let overtone = |own: &Overtone| Overtone {
            frequency: own.frequency,
            amplitudes: lower(&own.amplitudes),
        };
        Scenario {
            initial: Initial::Free(parts),
            forcing: lower(&now.forcing),
            overtones: now.overtones.iter().map(overtone).collect(),
            ..now
        }
    }

    /// The components of the forcing: frequency, and amplitudes of each mass.
    pub fn components(&self) -> impl Iterator<Item = (f64, &[[f64; 2]])> {
        let further = self.overtones.iter().map(|own| (own.frequency, own.amplitudes.as_slice()));
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
        match self.boundary {
            Boundary::Walls => self.forcing.len() + 1,
            Boundary::Ring => self.forcing.len(),
        }
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

    #[test]
    fn what_no_engine_takes_is_refused_when_it_is_read() {
        for (fields, words) in [
            (r#""initial":{"free":[[-1.5,0]]}"#, "initial: gap 0 starts overlapped by 5e-1; give"),
            (
                r#""initial":{"at":{"positions":[-1],"velocities":[0]}}"#,
                "gap 0 starts overlapped by 1e0",
            ),
            (
                r#""initial":{"at":{"positions":[1],"velocities":[]}}"#,
                "start.velocities: 0 values for 1",
            ),
            (r#""initial":{"at":{"positions":[1]}}"#, "initial.at: missing field `velocities`"),
            (r#""spacing":0"#, "spacing: 0.0 is out of range; give"),
            (r#""start":0"#, "start: unknown field"),
        ] {
            let json = format!(r#"{{"forcing":[[0,0]],{fields}}}"#);
            let error = Scenario::from_json(&json).expect_err(fields).to_string();
            assert!(error.contains(words), "{fields}: {error}");
        }
        let error = Scenario::given(&Chain::default(), vec![[0.1; 2]; 3]).unwrap_err().to_string();
        assert!(
            error.starts_with("forcing: it has 3 pairs for 100 masses; give one pair"),
            "{error}"
        );
    }
}
