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

/// One parameter: its name, what may be given, what it is, and where it goes.
struct Parameter {
    name: &'static str,
    range: &'static str,
    get: fn(&Set) -> String,
    put: fn(&mut Set, &str) -> Option<()>,
}

/// The text as a number within bounds.
fn within<T: std::str::FromStr + PartialOrd>(text: &str, low: T, high: T) -> Option<T> {
    text.parse().ok().filter(|x| (low..=high).contains(x))
}

/// The ranges are those in which every part of the report can be made: the rise stays on the grid of σ, and chains with
/// one seed are not too rare to be found.
const PARAMETERS: [Parameter; 6] = [
    Parameter {
        name: "masses",
        range: "40 to 150",
        get: |set| set.chain.masses.to_string(),
        put: |set, text| within(text, 40, 150).map(|n| set.chain.masses = n),
    },
    Parameter {
        name: "restitution",
        range: "0.3 to 0.9",
        get: |set| set.chain.restitution.to_string(),
        put: |set, text| within(text, 0.3, 0.9).map(|r| set.chain.restitution = r),
    },
    Parameter {
        name: "forcing_frequency",
        range: "1.35 to 1.5 (the natural frequency is 1)",
        get: |set| set.chain.forcing_frequency.to_string(),
        put: |set, text| within(text, 1.35, 1.5).map(|w| set.chain.forcing_frequency = w),
    },
    Parameter {
        name: "transient",
        range: "0 to 10000",
        get: |set| set.protocol.transient.to_string(),
        put: |set, text| within(text, 0.0, 1e4).map(|t| set.protocol.transient = t),
    },
    Parameter {
        name: "window",
        range: "1 to 10000",
        get: |set| set.protocol.window.to_string(),
        put: |set, text| within(text, 1.0, 1e4).map(|w| set.protocol.window = w),
    },
    Parameter {
        name: "seed",
        range: "a whole number from 0",
        get: |set| set.seed.unwrap_or(SEED).to_string(),
        put: |set, text| text.parse().ok().map(|seed| set.seed = Some(seed)),
    },
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
        let (range, told) = (parameter.range, one_line(value, SHOWN));
        (parameter.put)(&mut set, value)
            .ok_or_else(|| format!("{name}={told} is not allowed; give {range}"))?;
    }
    let other = PARAMETERS.iter().filter(|one| (one.get)(&set) != (one.get)(&paper));
    set.told = other.map(|one| format!("{} = {}", one.name, (one.get)(&set))).collect();
    SET.set(set).map_err(|_| "the parameters were chosen before".to_string())
}

/// Characters of what was given that a message repeats at most.
const SHOWN: usize = 40;

/// The name with the most letters in common, if it has half of them.
fn nearest<'a>(name: &str, names: &[&'a str]) -> Option<&'a str> {
    let pairs =
        |word: &str| -> Vec<(char, char)> { word.chars().zip(word.chars().skip(1)).collect() };
    let own = pairs(name);
    let common = |other: &str| pairs(other).iter().filter(|pair| own.contains(pair)).count();
    let best = names.iter().max_by_key(|other| common(other))?;
    (2 * common(best) >= own.len().max(1)).then_some(*best)
}

/// A line for each parameter: name, default, range; and where to find others.
pub fn list() -> String {
    let line = |one: &Parameter| {
        format!("{:18} {:20} {}\n", one.name, (one.get)(&Set::default()), one.range)
    };
    let head = format!("{:18} {:20} {}\n", "parameter", "default", "may be");
    let rest = "The start and the ends: `sweep --initial random --boundary ring`, and Table S3 of the report.\n\
                d and the natural frequency are the units of length and time, sigma is the axis.\n";
    std::iter::once(head).chain(PARAMETERS.iter().map(line)).chain([rest.into()]).collect()
}

/// What was chosen otherwise than the paper, `restitution = 0.7`; nothing as a rule.
pub fn told() -> Option<String> {
    SET.get().filter(|set| !set.told.is_empty()).map(|set| set.told.join(", "))
}

/// The name of a profile, and what was chosen.
pub fn profile(profile: Profile) -> String {
    told().map_or_else(|| profile.name().into(), |told| format!("{}, {told}", profile.name()))
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
