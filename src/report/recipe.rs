//! Experiments by the names that values carry: where their code is, and with which parameters
//! they run. The parameters are those of [`crate::params`], field by field.

use crate::params::{
    AnalyticParams, BiasParams, HorizonParams, Profile, ProtocolParams, RaceParams, ScaleParams,
    SpaceTimeParams, StartsParams, SweepParams, TrialParams, TwoMassesParams, VERTICES,
};
use serde::Serialize;
use serde_json::Value as Json;

/// How an experiment is run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recipe {
    /// Its name, as "second_seed".
    pub name: &'static str,
    /// The path of the item that runs it.
    pub item: &'static str,
    /// Name and setting of each parameter, the seed among them.
    pub parameters: Vec<(String, String)>,
}

/// The recipe of a name; None for a name that no experiment has.
pub fn recipe(name: &str, profile: Profile) -> Option<Recipe> {
    let (name, item, parameters) = match name {
        "sweep" => ("sweep", "experiments::sweep", json(SweepParams::main(profile))),
        "second_seed" => {
            ("second_seed", "experiments::sweep", json(SweepParams::second_seed(profile)))
        }
        "laws" => ("laws", "experiments::laws::run", json(SweepParams::main(profile))),
        "protocol" => {
            ("protocol", "experiments::protocol::run", json(ProtocolParams::new(profile)))
        }
        "starts" => ("starts", "experiments::starts::run", json(StartsParams::new(profile))),
        "horizon" => ("horizon", "experiments::horizon::run", json(HorizonParams::new(profile))),
        "two_masses" => {
            ("two_masses", "experiments::two_masses::run", json(TwoMassesParams::new(profile)))
        }
        "race" => ("race", "experiments::accuracy::race::run", json(RaceParams::new(profile))),
        "bias" => ("bias", "experiments::accuracy::bias::run", json(BiasParams::new(profile))),
        "trials" => {
            ("trials", "experiments::accuracy::trials::run", json(TrialParams::new(profile)))
        }
        "scale" => ("scale", "experiments::accuracy::scale::run", json(ScaleParams::new(profile))),
        "analytic" => {
            ("analytic", "experiments::accuracy::analytic::run", json(AnalyticParams::new(profile)))
        }
        "space-time" => {
            ("space-time", "experiments::spacetime::run", json(SpaceTimeParams::new(profile)))
        }
        "segments" => ("segments", "experiments::segments::run", Json::Null),
        "measured" => ("measured", "experiments::measured", Json::Null),
        "theory" => ("theory", "experiments::theory::run", serde_json::json!({"N": VERTICES})),
        _ => return None,
    };
    let mut flat = Vec::new();
    flatten("", &parameters, &mut flat);
    Some(Recipe { name, item, parameters: flat })
}

fn json(parameters: impl Serialize) -> Json {
    serde_json::to_value(parameters).unwrap_or(Json::Null)
}

/// Fields of fields get both names; long lists are told by their ends.
fn flatten(name: &str, value: &Json, into: &mut Vec<(String, String)>) {
    match value {
        Json::Null => {}
        Json::Object(fields) => {
            for (field, value) in fields {
                let field = field.replace('_', " ");
                let whole = if name.is_empty() { field } else { format!("{name} {field}") };
                flatten(&whole, value, into);
            }
        }
        Json::Array(list) => into.push((name.into(), listed(list))),
        scalar => into.push((name.into(), shown(scalar))),
    }
}

fn listed(list: &[Json]) -> String {
    let plain = list.iter().all(|one| one.is_number() || one.is_string());
    match list {
        [first, .., last] if plain && list.len() > 8 => {
            format!("{} from {} to {}", list.len(), shown(first), shown(last))
        }
        _ if plain => list.iter().map(shown).collect::<Vec<_>>().join(", "),
        _ => format!("{} of them", list.len()),
    }
}

fn shown(value: &Json) -> String {
    match value {
        Json::String(text) => text.clone(),
        Json::Number(number) => number
            .as_f64()
            .filter(|_| number.is_f64())
            .map_or(number.to_string(), |x| x.to_string()),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::Need;
    use crate::report::place;

    #[test]
    fn a_sweep_tells_its_seed_and_its_chain() {
        let recipe = recipe("sweep", Profile::Full).unwrap();
        let of = |name: &str| {
            let found = recipe.parameters.iter().find(|(own, _)| own == name);
            found.map(|(_, setting)| setting.as_str())
        };
        assert_eq!(of("seed"), Some("2007"));
        assert_eq!(of("chain masses"), Some("100"));
        assert_eq!(of("protocol transient"), Some("500"));
        assert!(of("sigmas").unwrap().contains(" from 0.02 to 0.4"), "{:?}", of("sigmas"));
        for need in Need::ALL {
            let recipe = super::recipe(need.name(), Profile::Full);
            let recipe = recipe.unwrap_or_else(|| panic!("{} has no recipe", need.name()));
            assert!(place::file(recipe.item).is_some(), "there is no {}", recipe.item);
        }
        assert_eq!(super::recipe("no such", Profile::Full), None);
    }
}
