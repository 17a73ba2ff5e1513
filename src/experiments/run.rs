//! Runs what is needed, and nothing else; long runs are taken from the store.

use super::accuracy::{analytic, bias, race, scale, trials};
use super::{Error, Measured, Need, Progress, Results, Store};
use super::{horizon, laws, protocol, segments, spacetime, starts, sweep, two_masses};
use crate::params::{
    AnalyticParams, BiasParams, HorizonParams, Profile, ProtocolParams, RaceParams, ScaleParams,
    SpaceTimeParams, StartsParams, SweepParams, TrialParams, TwoMassesParams,
};

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
        results.measured = Some(Measured::find()?);
    }
    if needs(Need::Sweep) || needs(Need::Laws) {
        let parameters = SweepParams::main(profile);
        let run = || sweep::run(&parameters, "main sweep", progress);
        results.sweep = Some(store.get("sweep", &parameters, progress, run)?);
    }
    if let (true, Some(sweep)) = (needs(Need::Laws), &results.sweep) {
        results.laws = Some(laws::run(&sweep.rows));
    }
    if needs(Need::SecondSeed) {
        let parameters = SweepParams::second_seed(profile);
        let run = || sweep::run(&parameters, "second seed", progress);
        results.second_seed = Some(store.get("second-seed", &parameters, progress, run)?);
    }
    if needs(Need::Protocol) {
        let parameters = ProtocolParams::new(profile);
        let run = || protocol::run(&parameters, progress);
        results.protocol = Some(store.get("protocol", &parameters, progress, run)?);
    }
    if needs(Need::Starts) {
        let parameters = StartsParams::new(profile);
        let run = || starts::run(&parameters, progress);
        results.starts = Some(store.get("starts", &parameters, progress, run)?);
    }
    if needs(Need::Horizon) {
        let parameters = HorizonParams::new(profile);
        let run = || horizon::run(&parameters, progress);
        results.horizon = Some(store.get("horizon", &parameters, progress, run)?);
    }
    if needs(Need::TwoMasses) {
        let parameters = TwoMassesParams::new(profile);
        let run = || two_masses::run(&parameters, progress);
        results.two_masses = Some(store.get("two-masses", &parameters, progress, run)?);
    }
    if needs(Need::SpaceTime) {
        let parameters = SpaceTimeParams::new(profile);
        let run = || spacetime::run(&parameters, progress);
        results.spacetime = Some(store.get("space-time", &parameters, progress, run)?);
    }
    if needs(Need::Race) {
        let parameters = RaceParams::new(profile);
        let run = || race::run(&parameters, progress);
        results.race = Some(store.get("race", &parameters, progress, run)?);
    }
    if needs(Need::Biases) {
        let parameters = BiasParams::new(profile);
        let run = || bias::run(&parameters, progress);
        results.biases = Some(store.get("bias", &parameters, progress, run)?);
    }
    if needs(Need::Trials) {
        let parameters = TrialParams::new(profile);
        let run = || trials::run(&parameters, progress);
        results.trials = Some(store.get("trials", &parameters, progress, run)?);
    }
    if needs(Need::Scale) {
        let parameters = ScaleParams::new(profile);
        let run = || scale::run(&parameters, progress);
        results.scale = Some(store.get("scale", &parameters, progress, run)?);
    }
    if needs(Need::Analytic) {
        let parameters = AnalyticParams::new(profile);
        let run = || analytic::run(&parameters, progress);
        results.analytic = Some(store.get("analytic", &parameters, progress, run)?);
    }
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
