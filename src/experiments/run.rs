//! Runs what is needed, and nothing else; long runs are taken from the store.

use super::catalogue;
use super::{Error, Measured, Need, Progress, Results, Store};
use super::{laws, segments};
use crate::params::Profile;

/// Runs the experiments behind `needs` with the sample sizes of a profile. `scenarios` gives the
/// text of a file of [`segments::FILES`]; it is asked only if [`Need::Segments`] is among them.
///
/// # Errors
/// [`Error::Interrupted`], or whatever the first failing experiment returns.
pub fn run(
    needs: &[Need],
    profile: Profile,
    scenarios: impl Fn(&str) -> Result<String, String>,
    store: &Store,
    progress: &Progress,
) -> Result<Results, Error> {
    let needs = |need| needs.contains(&need);
    let mut results = Results::empty(profile);
    if needs(Need::Segments) {
        let text = |file: &str| {
            scenarios(file).map_err(|problem| Error::Scenario { file: file.into(), problem })
        };
        let [fig05, fig06] = segments::FILES.map(text);
        results.segments = Some(segments::run([&fig05?, &fig06?])?);
    }
    if needs(Need::Measured) {
        results.measured = Some(Measured::committed()?);
    }
    if needs(Need::Sweep) || needs(Need::Laws) {
        results.sweep = Some(catalogue::SWEEP.get(profile, store, progress)?);
    }
    if let (true, Some(sweep)) = (needs(Need::Laws), &results.sweep) {
        results.laws = Some(laws::run(&sweep.rows));
    }
    macro_rules! saved {
        ($($field:ident: $experiment:ident),*) => {
            $(if needs(catalogue::$experiment.need) {
                results.$field = Some(catalogue::$experiment.get(profile, store, progress)?);
            })*
        };
    }
    macro_rules! carried {
        ($($field:ident: $experiment:ident),*) => {
            $(if needs(catalogue::$experiment.need) {
                let (result, audit) = catalogue::$experiment.get(profile, store, progress)?;
                let name = catalogue::$experiment.need.name();
                results.audits.extend(audit.map(|audit| (name.into(), audit)));
                results.$field = Some(result);
            })*
        };
    }
    saved!(
        horizon: HORIZON, two_masses: TWO_MASSES, spacetime: SPACE_TIME, race: RACE, trials: TRIALS,
        scale: SCALE, analytic: ANALYTIC, nucleation: NUCLEATION, history: HISTORY, orbits: ORBITS, seeds: SEEDS
    );
    carried!(
        second_seed: SECOND_SEED, protocol: PROTOCOL, protocols: PROTOCOLS, starts: STARTS, biases: BIAS, heat: HEAT,
        independence: INDEPENDENCE, restitution: RESTITUTION, chains: CHAINS,
        long_protocol: LONG_PROTOCOL, sizes: SIZES
    );
    progress.check()?;
    Ok(results)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_needed_runs() {
        let none = |_: &str| Err("not there".to_string());
        let quiet = Progress::silent();
        let needs = [Need::TwoMasses];
        let results = run(&needs, Profile::Quick, none, &Store::nowhere(), &quiet).unwrap();
        assert!(results.two_masses().is_ok());
        assert!(results.sweep.is_none() && results.laws.is_none() && results.segments.is_none());
    }

    #[test]
    fn a_missing_scenario_is_named() {
        let none = |_: &str| Err("not there".to_string());
        let (store, quiet) = (Store::nowhere(), Progress::silent());
        let error = run(&[Need::Segments], Profile::Quick, none, &store, &quiet).unwrap_err();
        assert!(error.to_string().starts_with("scenarios/fig05.json: not there"), "{error}");
    }
}
