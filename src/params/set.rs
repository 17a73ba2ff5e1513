//! What a run may choose otherwise than the paper: `paper --set restitution=0.7`.
//!
//! The choice is made once, before anything is computed, and holds for the whole process; who sets nothing has
//! the paper's parameters. Sample sizes are not here: a profile has them.

use super::{Chain, Profile, Protocol, SEED, VERTICES};
use crate::input::one_line;
use std::sync::OnceLock;

/// What may be set, each with the paper's value (or ours, where it prints none) as its default.
#[derive(Clone, Debug, Default, PartialEq)]
struct Set {
    chain: Chain,
    protocol: Protocol,
    seed: Option<u64>,
    told: Vec<String>,
}

static SET: OnceLock<Set> = OnceLock::new();

/// One parameter: its name, the least and the largest value, whether it is a whole number, and where it stands.
struct Parameter {
    name: &'static str,
    range: [f64; 2],
    whole: bool,
    get: fn(&Set) -> f64,
    put: fn(&mut Set, f64),
}

impl Parameter {
    const fn new(
        name: &'static str,
        range: [f64; 2],
        whole: bool,
        get: fn(&Set) -> f64,
        put: fn(&mut Set, f64),
    ) -> Self {
        Parameter { name, range, whole, get, put }
    }

    /// The text as a value that may be given.
    fn read(&self, text: &str) -> Option<f64> {
        let [low, high] = self.range;
        if self.whole {
            // As a whole number: a double would round what is out of range into it.
            let whole = text.parse::<u64>().ok().filter(|n| (low as u64..=high as u64).contains(n));
            return whole.map(|n| n as f64);
        }
        text.parse().ok().filter(|x| (low..=high).contains(x))
    }

    /// What may be given, in words.
    fn range(&self) -> String {
        let [low, high] = self.range;
        let whole = if self.whole { "a whole number from " } else { "" };
        format!("{whole}{low} to {high}")
    }
}

const WHOLE: bool = true;

/// Within these ranges the rise stays on the grid of σ. Whole numbers are exact up to 2^53.
const PARAMETERS: [Parameter; 6] = [
    Parameter::new(
        "masses",
        [40.0, 150.0],
        WHOLE,
        |set| set.chain.masses as f64,
        |set, n| set.chain.masses = n as usize,
    ),
    Parameter::new(
        "restitution",
        [0.3, 0.9],
        !WHOLE,
        |set| set.chain.restitution,
        |set, r| set.chain.restitution = r,
    ),
    Parameter::new(
        "forcing_frequency",
        [1.35, 1.5],
        !WHOLE,
        |set| set.chain.forcing_frequency,
        |set, w| set.chain.forcing_frequency = w,
    ),
    Parameter::new(
        "transient",
        [0.0, 1e4],
        !WHOLE,
        |set| set.protocol.transient,
        |set, t| set.protocol.transient = t,
    ),
    Parameter::new(
        "window",
        [10.0, 1e4],
        !WHOLE,
        |set| set.protocol.window,
        |set, w| set.protocol.window = w,
    ),
    Parameter::new(
        "seed",
        [0.0, (1u64 << 53) as f64],
        WHOLE,
        |set| set.seed.unwrap_or(SEED) as f64,
        |set, seed| set.seed = Some(seed as u64),
    ),
];

/// Chooses `name=value` pairs for the rest of the process. Values that are the defaults change nothing.
///
/// # Errors
/// One line that names the pair and what may be given; a second choice.
pub fn choose(pairs: &[String]) -> Result<(), String> {
    let (mut set, paper) = (Set::default(), Set::default());
    let mut given: Vec<&str> = Vec::new();
    for pair in pairs {
        let (name, value) = pair.split_once('=').unwrap_or((pair, ""));
        let (name, value) = (name.trim(), value.trim());
        let Some(parameter) = PARAMETERS.iter().find(|parameter| parameter.name == name) else {
            let names: Vec<&str> = PARAMETERS.iter().map(|parameter| parameter.name).collect();
            let told = one_line(name, SHOWN);
            return Err(match nearest(name, &names) {
                Some(near) => format!("there is no parameter {told:?}; is {near} meant?"),
                None => format!("there is no parameter {told:?}; there are {}", names.join(", ")),
            });
        };
        if given.contains(&name) {
            return Err(format!("{name} is given twice; give it once"));
        }
        given.push(name);
        let refused = || {
            let told = one_line(value, SHOWN);
            format!("{name}={told} is not allowed; give {}", parameter.range())
        };
        (parameter.put)(&mut set, parameter.read(value).ok_or_else(refused)?);
    }
    let other = PARAMETERS.iter().filter(|one| (one.get)(&set) != (one.get)(&paper));
    set.told = other.map(|one| format!("{} = {}", one.name, (one.get)(&set))).collect();
    SET.set(set).map_err(|_| "the parameters were chosen before".to_string())
}

/// Characters of what was given that a message repeats at most.
const SHOWN: usize = 40;

/// The name that is most alike, if it is alike at all.
fn nearest<'a>(name: &str, names: &[&'a str]) -> Option<&'a str> {
    let other = |other: &&str| strsim::osa_distance(name, other);
    let best = names.iter().copied().min_by_key(other)?;
    // A third of the letters may differ: no single letter is like a name.
    (3 * other(&best) <= name.len()).then_some(best)
}

/// A line for each parameter: name, default, range; and where to find others.
pub fn list() -> String {
    let line = |one: &Parameter| {
        format!("{:18} {:<20} {}\n", one.name, (one.get)(&Set::default()), one.range())
    };
    let head = format!("{:18} {:20} {}\n", "parameter", "default", "may be");
    let rest = "The start and the ends: `sweep --initial random --boundary ring`, and Table S3 of the report.\n\
                d and the natural frequency are the units of length and time, sigma is the axis.\n";
    std::iter::once(head).chain(PARAMETERS.iter().map(line)).chain([rest.into()]).collect()
}

/// What was chosen otherwise than the paper, `not the paper's parameters: restitution = 0.7`; nothing as a rule.
pub fn told() -> Option<String> {
    let set = SET.get().filter(|set| !set.told.is_empty())?;
    Some(format!("not the paper's parameters: {}", set.told.join(", ")))
}

/// The name of a profile, and what was chosen.
pub fn profile(profile: Profile) -> String {
    told().map_or_else(|| profile.name().into(), |told| format!("{} ({told})", profile.name()))
}

/// What was chosen in place of a number that the paper printed, by its id.
pub fn printed(id: &str) -> Option<f64> {
    told()?;
    let chain = &SET.get()?.chain;
    match id {
        "masses" | "vertices" => Some(chain.masses as f64),
        "restitution" => Some(chain.restitution),
        "forcing_frequency_squared" => Some(chain.forcing_frequency * chain.forcing_frequency),
        _ => None,
    }
}

/// The chain of Sec. 2, or as it was chosen.
pub fn chain() -> Chain {
    SET.get().map_or_else(Chain::default, |set| set.chain.clone())
}

/// The counting protocol, or as it was chosen.
pub fn protocol() -> Protocol {
    SET.get().map_or_else(Protocol::default, |set| set.protocol)
}

/// The master seed, or as it was chosen.
pub fn seed() -> u64 {
    SET.get().and_then(|set| set.seed).unwrap_or(SEED)
}

/// The vertices N of the theory's curves: the paper takes as many as there are masses.
pub fn vertices() -> usize {
    SET.get().map_or(VERTICES, |set| set.chain.masses)
}
