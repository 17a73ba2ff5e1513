//! Chooses, for each question about the chains, the method that answers it in the least time.

use super::bias::{Biases, GapCount};
use super::case::Outcome;
use super::race::Entry;
use super::trials::Trials;
use crate::experiments::prelude::*;
use crate::experiments::{BIAS, MEASURED, Measured, RACE, TRIALS};
use crate::params::{Means, MethodName::Certified, Setting};
use impact_numerics::estimates::LEVEL;
use impact_numerics::statistics::{mean, student_quantile};

/// How far a mean may be off, relative to it, at each σ.
const MEANS: [(f64, f64); 4] = [(0.11, 0.05), (0.12, 0.05), (0.14, 0.01), (0.115, 0.05)];

/// How far the share of chains with any impact may be off, at the first of these σ, and the half
/// height between the first two, relative to it.
const ALIKE: f64 = 0.01;

/// Times to which an orbit is wanted, in units of 1/ω.
const ORBITS: [f64; 2] = [10.0, 100.0];

/// The scenes in which masses come to rest.
const REST: [&str; 4] = ["ball", "table", "held", "squeezed"];

/// What a method answers.
struct Answer {
    setting: Setting,
    /// Seconds of one core for a thousand chains.
    seconds: f64,
    chains: usize,
    /// The error, or the horizon.
    found: Estimate,
    /// How far this is inside of what is allowed; negative outside.
    margin: f64,
}

impl Answer {
    /// Returns half of the 95 % interval, by Student's t.
    fn half(&self) -> f64 {
        let quantile = student_quantile(LEVEL, self.chains.saturating_sub(1));
        quantile.map_or(f64::INFINITY, |t| t * self.found.error)
    }

    /// Whether the 95 % interval lies inside of what is allowed.
    fn is_enough(&self) -> bool {
        self.margin >= self.half()
    }

    /// Returns the number of chains that would decide whether the method is enough, rounded up to
    /// two digits; none if these chains do.
    fn chains_to_decide(&self) -> Option<u64> {
        let ratio = self.half() / self.margin.abs();
        let chains = (self.chains as f64 * ratio * ratio).ceil() as u64;
        let unit = 10u64.pow(chains.max(1).ilog10().saturating_sub(1));
        (ratio > 1.0).then(|| chains.div_ceil(unit) * unit)
    }
}

/// Returns the answer in the least time of those that are enough.
fn cheapest<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> Option<&'a Answer> {
    let enough = answers.into_iter().filter(|answer| answer.is_enough());
    enough.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

/// A question and all answers to it.
struct Question {
    id: String,
    words: String,
    answers: Vec<Answer>,
}

impl Question {
    fn rival(&self) -> Option<&Answer> {
        cheapest(self.answers.iter().filter(|answer| answer.setting.method != Certified))
    }

    fn engine(&self) -> Option<&Answer> {
        self.answers.iter().find(|answer| answer.setting.method == Certified)
    }

    /// Names the cheapest of the methods that might answer in less time than the rival, or at all,
    /// and the number of chains that would decide.
    fn undecided(&self) -> Option<String> {
        let least = self.rival().map_or(f64::INFINITY, |best| best.seconds);
        let open =
            self.answers.iter().filter_map(|answer| Some((answer, answer.chains_to_decide()?)));
        let (answer, chains) = open.min_by(|a, b| a.0.seconds.total_cmp(&b.0.seconds))?;
        let named = || format!("{} ({chains} chains)", answer.setting.name());
        (answer.seconds < least).then(named)
    }
}

/// Makes the table of the methods of least time, and the list of those that bring masses to rest.
pub fn tables(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let (biases, measured) = (results.of(&BIAS).ok()?, results.of(&MEASURED).ok()?);
    let race = results.of(&RACE).ok()?;
    let orbits = ORBITS.map(|until| {
        let run = &race.parameters.growth;
        let answer = |entry: &Entry| {
            let row = measured.method(entry.setting, run.chain.masses, run.sigma)?;
            let (found, setting) = (entry.horizon()?, entry.setting);
            let (chains, margin) = (entry.runs.len(), found.value - until);
            Some(Answer { setting, seconds: row.thousand()?, chains, found, margin })
        };
        Question {
            id: until.to_string(),
            words: format!("every impact in its order, to t = {until}"),
            answers: race.entries.iter().filter_map(answer).collect(),
        }
    });
    let (rest, scenes) = at_rest(results.of(&TRIALS).ok()?);
    let rest = Table::of("answers.rest", &[()], |()| scenes)
        .computed_by(origin(at_rest))
        .words("methods", "methods that are right wherever masses come to rest", |()| {
            rest.join("; ")
        })
        .done();
    let means = table("answers.means", "1", &questions(biases, measured));
    Some(vec![means, table("answers.orbits", TIME, &orbits), rest])
}

fn table(name: &'static str, unit: &'static str, questions: &[Question]) -> Table {
    let seconds = |answer: Option<&Answer>| answer.map(|answer| answer.seconds);
    let named = |answer: Option<&Answer>| answer.map_or("–".into(), |of| of.setting.name());
    const CHEAPEST: &str = "seconds of one core for a thousand chains";
    Table::of(name, questions, |of| of.rival().map_or(0, |answer| answer.chains))
        .text_key("id", |of| of.id.clone())
        .words("question", "what is asked", |of| of.words.clone())
        .computed_by(origin(tables))
        .words("take", "the method of the least time", |of| named(cheapest(&of.answers)))
        .words("rival", "the rival of the least time", |of| named(of.rival()))
        .real("seconds", "s", 2, CHEAPEST, |of| seconds(of.rival()))
        .estimate("found", unit, "its error or horizon", |of| Some(of.rival()?.found))
        .real("engine", "s", 2, "the engine's seconds", |of| seconds(of.engine()))
        .words("undecided", "the cheapest on which more chains must decide", |of| {
            of.undecided().unwrap_or("–".into())
        })
        .done()
}

/// Returns what a method and the engine count in the chains that both ran to the end, by chain.
fn pairs(of: &Means, runs: &[Vec<GapCount>], setting: Setting) -> Vec<[f64; 2]> {
    let run = of.settings.iter().position(|(other, _)| *other == setting).map(|i| &runs[i]);
    let both = run.into_iter().flatten().zip(&runs[0]);
    both.filter_map(|(theirs, ours)| Some([f64::from((*theirs)?), f64::from((*ours)?)])).collect()
}

/// Asks how far a mean over chains is off. `values` turns the pairs of a method, at each of the σ,
/// into an error for each chain; the engine errs by nothing, as the others are held against it.
fn question(
    (biases, measured): (&Biases, &Measured),
    sigmas: &[f64],
    tolerance: f64,
    [id, words]: [String; 2],
    values: impl Fn(&[Vec<[f64; 2]>]) -> Vec<f64>,
) -> Option<Question> {
    let at = |sigma: &f64| {
        let mut all = biases.parameters.means.iter().zip(&biases.runs);
        all.find(|(of, _)| of.chains.sigma == *sigma)
    };
    let all = sigmas.iter().map(at).collect::<Option<Vec<_>>>()?;
    let answer = |&(setting, _): &(Setting, usize)| {
        let pairs: Vec<_> = all.iter().map(|(of, runs)| pairs(of, runs, setting)).collect();
        let values = values(&pairs);
        let found = match setting.method {
            Certified => with_error(0.0, 0.0),
            // Where all chains agree, nothing tells how often they would not.
            _ => average(&values).filter(|found| found.error > 0.0)?,
        };
        let masses = all[0].0.chains.chain.masses;
        let time = |sigma: &f64| measured.method(setting, masses, *sigma)?.thousand();
        let seconds = sigmas.iter().map(time).sum::<Option<f64>>()?;
        let margin = tolerance - found.value.abs();
        Some(Answer { setting, seconds, chains: values.len(), found, margin })
    };
    let answers = all[0].0.settings.iter().filter_map(answer).collect();
    Some(Question { id, words, answers })
}

/// Questions about means: of gaps with an impact, of chains with any, and where the first rises.
fn questions(biases: &Biases, measured: &Measured) -> Vec<Question> {
    let both = (biases, measured);
    let ours = |pairs: &[[f64; 2]]| mean(&pairs.iter().map(|pair| pair[1]).collect::<Vec<_>>());
    let mut all = Vec::new();
    for of in &biases.parameters.means {
        let (sigma, transient) = (of.chains.sigma, of.transient);
        let Some(&(_, tolerance)) = MEANS.iter().find(|mean| mean.0 == sigma) else { continue };
        let percent = 100.0 * tolerance;
        let words = format!("a mean to {percent} %, σ = {sigma}, T = {transient}");
        let named = [format!("mean-{sigma}"), words];
        all.extend(question(both, &[sigma], tolerance, named, |pairs| {
            let ours = ours(&pairs[0]).unwrap_or(f64::NAN);
            pairs[0].iter().map(|pair| (pair[0] - pair[1]) / ours).collect()
        }));
    }
    let (low, high, percent) = (MEANS[0].0, MEANS[1].0, 100.0 * ALIKE);
    let words = format!("the share of chains with an impact to {percent} %, σ = {low}");
    all.extend(question(both, &[low], ALIKE, ["share".into(), words], |pairs| {
        let any = |count: f64| f64::from(u8::from(count > 0.0));
        pairs[0].iter().map(|pair| any(pair[0]) - any(pair[1])).collect()
    }));
    let words = format!("the half height of the rise to {percent} %");
    all.extend(question(both, &[low, high], ALIKE, ["rise".into(), words], |pairs| {
        let half = 0.5 * (1 + biases.parameters.means[0].chains.chain.masses) as f64;
        let [below, above] = [0, 1].map(|i| ours(&pairs[i]).unwrap_or(f64::NAN));
        let slope = (above - below) / (high - low);
        let (part, height) = ((half - below) / (above - below), low + (half - below) / slope);
        let lower = |[a, b]: [&[f64; 2]; 2]| (1.0 - part) * (a[1] - a[0]) + part * (b[1] - b[0]);
        let both = pairs[0].iter().zip(&pairs[1]);
        both.map(|(a, b)| lower([a, b]) / slope / height).collect()
    }));
    all
}

/// Names the methods with settings that are right in all cases in which masses come to rest, and
/// counts these cases.
fn at_rest(trials: &Trials) -> (Vec<String>, usize) {
    let scenes = trials.parameters.scenes.iter().zip(&trials.found);
    let rest: Vec<_> = scenes.filter(|(scene, _)| REST.contains(&&*scene.id)).collect();
    let is_right =
        |i: usize| rest.iter().all(|(_, found)| found[i].iter().all(|of| *of == Outcome::Right));
    let settings = trials.parameters.settings.iter().enumerate();
    let right = settings.filter(|(i, _)| is_right(*i)).map(|(_, setting)| setting.name());
    (right.collect(), rest.iter().map(|(scene, _)| scene.cases.len()).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::MethodName::Verlet;

    fn answer(seconds: f64, margin: f64, error: f64) -> Answer {
        let setting = Setting { method: Verlet, value: seconds, stop: 0.0 };
        Answer { setting, seconds, chains: 100, found: with_error(0.0, error), margin }
    }

    #[test]
    fn the_cheapest_is_the_fastest_that_is_surely_within_the_tolerance() {
        // Outside; inside, but not surely; surely inside; the same and slower.
        let answers = [
            answer(0.1, -0.05, 0.01),
            answer(0.2, 0.03, 0.02),
            answer(0.4, 0.04, 0.02),
            answer(0.3, 0.04, 0.02),
        ];
        assert_eq!(cheapest(&answers).unwrap().seconds, 0.3);
        assert!(cheapest(&answers[..2]).is_none());
        // 1.98 errors of 0.02 are 0.0397, and 0.03 is (0.0397/0.03)² times as many chains away.
        let wanted: Vec<_> = answers.iter().map(Answer::chains_to_decide).collect();
        assert_eq!(wanted, [None, Some(180), None, None]);
        let question =
            Question { id: String::new(), words: String::new(), answers: answers.into() };
        assert_eq!(question.undecided().unwrap(), "Verlet, h = 0.2 (180 chains)");
    }
}
