//! Experiments by the names that values carry: where their code is, and with which parameters
//! they run. The parameters are those of [`crate::params`], field by field.

use crate::experiments::measured::FILE;
use crate::experiments::{ALL, MEASURED};
use crate::params::{Profile, VERTICES};
use literate::source::Recipe;

/// The recipe of a name, in the profile of a name; None for a name that no experiment has.
pub fn recipe(name: &str, profile: &str) -> Option<Recipe> {
    let profile = match profile {
        "quick" => Profile::Quick,
        _ => Profile::Full,
    };
    Some(match name {
        "theory" => {
            Recipe::of(name, "experiments::theory".into(), &serde_json::json!({"N": VERTICES}))
        }
        _ => {
            let experiment = ALL.iter().find(|experiment| experiment.name() == name)?;
            let recipe = Recipe::of(name, experiment.item(), &experiment.parameters(profile));
            let data = (name == MEASURED.name).then_some(FILE);
            Recipe { data, ..recipe }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::PROGRAM;

    #[test]
    fn a_sweep_tells_its_seed_and_its_chain() {
        let recipe = recipe("sweep", "full").unwrap();
        let of = |name: &str| {
            let found = recipe.parameters.iter().find(|(own, _)| own == name);
            found.map(|(_, setting)| setting.as_str())
        };
        assert_eq!(of("seed"), Some("2007"));
        assert_eq!(of("chain masses"), Some("100"));
        assert_eq!(of("protocols transient"), Some("500"));
        assert!(of("sigmas").unwrap().contains(" from 0.02 to 0.4"), "{:?}", of("sigmas"));
        for experiment in ALL {
            let recipe = super::recipe(experiment.name(), "full").unwrap();
            assert!(PROGRAM.file(&recipe.item).is_some(), "there is no {}", recipe.item);
        }
        assert_eq!(super::recipe("no such", "full"), None);
    }
}
