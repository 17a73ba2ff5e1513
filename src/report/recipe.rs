//! Experiments by the names that values carry: where their code is, and with which parameters
//! they run. The parameters are those of [`crate::params`], field by field.

use crate::experiments::catalogue::ALL;
use crate::params::{Profile, VERTICES};
use serde::Serialize;
use serde_json::Value as Json;

/// How an experiment is run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recipe {
    /// Its name, as "second_seed".
    pub name: &'static str,
    /// The path of its module.
    pub item: String,
    /// Name and setting of each parameter, the seed among them.
    pub parameters: Vec<(String, String)>,
}

/// The recipe of a name; None for a name that no experiment has.
pub fn recipe(name: &str, profile: Profile) -> Option<Recipe> {
    let (name, item, parameters) = match name {
        "theory" => ("theory", "experiments::theory".into(), serde_json::json!({"N": VERTICES})),
        "audits" => ("audits", "experiments::deep::audit".into(), Json::Null),
        _ => {
            let experiment = ALL.iter().find(|experiment| experiment.name() == name)?;
            (experiment.name(), experiment.item(), experiment.parameters(profile))
        }
    };
    let mut flat = Vec::new();
    flatten("", &parameters, &mut flat);
    Some(Recipe { name, item, parameters: flat })
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
        for experiment in ALL {
            let recipe = super::recipe(experiment.name(), Profile::Full).unwrap();
            assert!(place::file(&recipe.item).is_some(), "there is no {}", recipe.item);
        }
        assert_eq!(super::recipe("no such", Profile::Full), None);
    }
}
