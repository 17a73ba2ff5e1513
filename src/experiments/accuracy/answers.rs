//! Chooses, for each question about the chains, the method that answers it in the least time.

use super::bias::{Biases, GapCount};
use super::case::Expected;
use super::race::Entry;
use super::tables::{in_formulas, own_error, pairs};
use super::trials::{Trial, Trials, right};
use crate::experiments::measured::{Subject, Times};
use crate::experiments::prelude::*;
use crate::experiments::programs::{Program, Run};
use crate::experiments::{BIAS, MEASURED, PROGRAMS, RACE, TRIALS};
use crate::params::MethodName::Certified;
use literate::table::Building;

/// How far a mean may be off, relative to it, at each σ.
pub const MEANS: [(f64, f64); 4] = [(0.11, 0.05), (0.12, 0.05), (0.14, 0.01), (0.115, 0.05)];

/// How far the share of active chains may be off, and the half height, relative to it.
const ALIKE: f64 = 0.01;

/// Times to which an orbit is wanted, in units of 1/ω, and the share of chains in which it is.
const ORBITS: [f64; 2] = [10.0, 100.0];
const MOST: f64 = 0.5;

/// Times that differ by less than this factor may change their order from run to run.
const TIE: f64 = 1.3;

/// The scenes in which masses come to rest.
const REST: [&str; 4] = ["ball", "table", "held", "squeezed"];

struct Answer {
    setting: Setting,
    /// Seconds of one core for a thousand chains.
    seconds: f64,
    chains: usize,
    /// The error, or the share of runs that are right to the time that is asked.
    result: Estimate,
    /// Whether this is surely within what is allowed or surely not, or `None` if chains do not
    /// tell.
    is_enough: Option<bool>,
}

/// Returns the 95 % interval of a mean over chains, by Student's t.
fn interval(mean: f64, chains: usize, error: f64) -> [f64; 2] {
    let quantile = student_quantile(LEVEL, chains.saturating_sub(1));
    let half = quantile.map_or(f64::INFINITY, |t| t * error);
    [mean - half, mean + half]
}

/// Returns on which side of what is allowed the interval of an error lies, if on one.
fn is_within([low, high]: [f64; 2], allowed: f64) -> Option<bool> {
    (high <= allowed || low >= allowed).then_some(high <= allowed)
}

fn cheapest<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> Option<&'a Answer> {
    let enough = answers.into_iter().filter(|answer| answer.is_enough == Some(true));
    enough.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}

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

    /// Returns by what factor the engine or its fastest rival is faster than the other, or `None`
    /// if one of them does not answer.
    fn lead(&self) -> Option<f64> {
        let ratio = self.rival()?.seconds / self.engine()?.seconds;
        Some(ratio.max(1.0 / ratio))
    }

    /// Names the method of the least time, or says that it ties, or that the chains do not decide.
    fn choice(&self) -> String {
        let engine = self.engine().filter(|engine| engine.is_enough == Some(true));
        let is_near =
            |answer: &Answer| engine.is_some_and(|engine| answer.seconds < TIE * engine.seconds);
        let is_open = |answer: &Answer| answer.is_enough.is_none() && is_near(answer);
        match self.rival().zip(engine) {
            Some((rival, engine)) if TIE * rival.seconds <= engine.seconds => name_of(Some(rival)),
            _ if self.answers.iter().any(is_open) => "undecided".into(),
            Some((rival, _)) if is_near(rival) => "tie".into(),
            _ => name_of(cheapest(&self.answers)),
        }
    }
}

pub fn tables(results: &Results, _: &[Table]) -> Option<Vec<Table>> {
    let (biases, measured) = (results.of(&BIAS).ok()?, results.of(&MEASURED).ok()?);
    let race = results.of(&RACE).ok()?;
    let orbits = |is_generic: bool, until: f64| {
        let run = &race.parameters.growth;
        let answer = |entry: &Entry| {
            let (chains, setting) = (entry.runs.len(), entry.setting);
            let times = Times { measured, is_generic };
            let seconds = times.seconds(Subject::Question, setting, run, until)?;
            let right = entry.runs.iter().filter(|left| **left >= until).count();
            let [low, high] = wilson(right as u64, chains as u64, LEVEL)?;
            let (value, error) = (right as f64 / chains as f64, (high - low) / 4.0);
            let result = Estimate { value, error, interval: [low, high] };
            let is_enough = is_within([1.0 - high, 1.0 - low], 1.0 - MOST);
            Some(Answer { setting, seconds, chains, result, is_enough })
        };
        Question {
            id: until.to_string(),
            words: format!("every impact in its order, to $t = {until}$"),
            answers: race.entries.iter().filter_map(answer).collect(),
        }
    };
    let orbits = ORBITS.map(|until| [false, true].map(|is_generic| orbits(is_generic, until)));
    let programs = results.of(&PROGRAMS).ok()?;
    let trials = results.of(&TRIALS).ok()?;
    const GAP: &str = "gap between balls of the cradle as the first comes";
    const RESTS: &str = "programs with a setting right wherever masses rest";
    const GRAZES: &str = "programs with a setting that sees every graze and nothing else";
    let summary = Table::builder("answers.all", &[()], |()| cases_at_rest(trials))
        .chosen("share", "1", "share of chains in which an orbit must be right", |()| Some(MOST))
        .chosen("tie", "1", "times that differ by less than this factor tie", |()| Some(TIE))
        .real("cradle", "d", 1, GAP, |()| cradle(trials))
        .words("rest", RESTS, |()| names(programs, &REST))
        .words("grazes", GRAZES, |()| names(programs, &["grazing-hits", "grazing-misses"]))
        .done();
    let [means, generic] =
        [false, true].map(|is_generic| questions(biases, Times { measured, is_generic }));
    let means: Vec<[Question; 2]> = means.into_iter().zip(generic).map(Into::into).collect();
    let means = table("answers.means", "1", &means).done();
    let orbits = table("answers.orbits", "1", &orbits)
        .words("right", "runs of the rival that are right to that time", |[own, _]| {
            own.rival().map_or("–".into(), |answer| {
                let right = (answer.result.value * answer.chains as f64).round();
                format!("{right} of {}", answer.chains)
            })
        })
        .done();
    Some(vec![means, orbits, summary])
}

/// Returns the name of the setting of an answer, a dash without one.
fn name_of(answer: Option<&Answer>) -> String {
    answer.map_or("–".into(), |answer| in_formulas(&answer.setting.name()))
}

fn table<'a>(
    name: &'static str,
    unit: &'static str,
    questions: &'a [[Question; 2]],
) -> Building<'a, [Question; 2]> {
    let seconds = |answer: Option<&Answer>| answer.map(|answer| answer.seconds);
    const CHEAPEST: &str = "seconds of one core for a thousand chains";
    const LEAD: &str = "time of the engine or its fastest rival over that of the other";
    Table::builder(name, questions, |[own, _]| own.rival().map_or(0, |answer| answer.chains))
        .table_computed_by(origin(tables))
        .text_key("id", |[own, _]| own.id.clone())
        .words("question", "what is asked", |[own, _]| own.words.clone())
        .words("take", "the method of the least time", |[own, _]| own.choice())
        .real("lead", "1", 2, LEAD, |[own, _]| own.lead())
        .words("generic", "the same by any processor's vectors", |[_, generic]| generic.choice())
        .real("generic_lead", "1", 2, LEAD, |[_, generic]| generic.lead())
        .words("rival", "the rival of the least time", |[own, _]| name_of(own.rival()))
        .computed_by(origin(tables), &["take", "generic", "rival"])
        .real("seconds", "s", 2, CHEAPEST, |[own, _]| seconds(own.rival()))
        .estimate("found", unit, "its error, or share of runs that are right", |[own, _]| {
            Some(own.rival()?.result)
        })
        .real("engine", "s", 2, "the engine's seconds", |[own, _]| seconds(own.engine()))
        .measured(&["lead", "generic_lead", "seconds", "engine"])
}

/// The counts of all settings at one σ, and the second counts of the engine.
type Runs<'a> = (&'a Vec<Vec<GapCount>>, &'a Vec<GapCount>);

/// A question about means over chains at some σ.
struct Query<'a> {
    id: String,
    words: String,
    sigmas: &'a [f64],
    /// How far the answer may be off.
    tolerance: f64,
    /// Whether a share of chains is asked for.
    is_share: bool,
}

/// Answers a question by every method; `errors` turns a method's pairs at each σ into errors.
fn question(
    biases: &Biases,
    times: Times,
    query: Query,
    errors: impl Fn(&[Vec<[f64; 2]>]) -> Vec<f64>,
) -> Option<Question> {
    let Query { id, words, sigmas, tolerance, is_share } = query;
    let find = |sigma: &f64| {
        let runs = biases.runs.iter().zip(&biases.again);
        biases.parameters.means.iter().zip(runs).find(|(means, _)| means.chains.sigma == *sigma)
    };
    let ensembles = sigmas.iter().map(find).collect::<Option<Vec<_>>>()?;
    let answer = |&(setting, _): &(Setting, usize)| {
        let place = |means: &Means| means.settings.iter().position(|(other, _)| *other == setting);
        let pairs = |&(means, (runs, again)): &(&Means, Runs)| {
            // Shares compare one run with another.
            let ours = [&runs[0][..], if is_share { &runs[0] } else { again }];
            Some(pairs(&runs[place(means)?], ours))
        };
        let pairs = ensembles.iter().map(pairs).collect::<Option<Vec<_>>>()?;
        let errors = errors(&pairs);
        let result = match setting.method {
            Certified => {
                let runs = ensembles.iter().map(|(_, runs)| runs);
                let own = runs.map(|(runs, again)| own_error([&runs[0], again], runs[0].len()));
                with_error(0.0, if is_share { 0.0 } else { own.fold(0.0, f64::max) })
            }
            // Where all chains agree, only of a share one knows how often they would not.
            _ => average(&errors).filter(|mean| is_share || mean.error > 0.0)?,
        };
        let time = |(means, _): &(&Means, Runs)| {
            let subject = if is_share { Subject::Question } else { Subject::Method };
            times.seconds(subject, setting, &means.chains, means.chains.until)
        };
        let seconds = ensembles.iter().map(time).sum::<Option<f64>>()?;
        let (chains, off) = (errors.len(), result.value.abs());
        let interval = if is_share && setting.method != Certified {
            wilson((off * chains as f64).round() as u64, chains as u64, LEVEL)?
        } else {
            interval(off, chains, result.error)
        };
        Some(Answer { setting, seconds, chains, result, is_enough: is_within(interval, tolerance) })
    };
    let answers = ensembles[0].0.settings.iter().filter_map(answer).collect();
    Some(Question { id, words, answers })
}

/// Questions about means: of gaps with an impact, of active chains, and where the first rises.
fn questions(biases: &Biases, times: Times) -> Vec<Question> {
    let ours = |pairs: &[[f64; 2]]| mean(&pairs.iter().map(|pair| pair[1]).collect::<Vec<_>>());
    let mut questions = Vec::new();
    for means in &biases.parameters.means {
        let (sigma, transient) = (means.chains.sigma, means.transient);
        let Some(&(_, tolerance)) = MEANS.iter().find(|mean| mean.0 == sigma) else { continue };
        let percent = 100.0 * tolerance;
        let words = format!("a mean to {percent} %, $σ = {sigma}$, $T = {transient}$");
        let id = format!("mean-{sigma}");
        let query = Query { id, words, sigmas: &[sigma], tolerance, is_share: false };
        questions.extend(question(biases, times, query, |pairs| {
            let [theirs, ours] = [0, 1].map(|i| pairs[0].iter().map(|pair| pair[i]).sum::<f64>());
            let (ratio, mean) = (theirs / ours, ours / pairs[0].len() as f64);
            let residual = |pair: &[f64; 2]| (pair[0] - ratio * pair[1]) / mean + ratio - 1.0;
            pairs[0].iter().map(residual).collect()
        }));
    }
    let (low, high, percent) = (MEANS[0].0, MEANS[1].0, 100.0 * ALIKE);
    let words =
        format!("the share of chains with an impact to {percent} percentage point, $σ = {low}$");
    let (tolerance, id) = (ALIKE, "share".into());
    let query = Query { id, words, sigmas: &[low], tolerance, is_share: true };
    questions.extend(question(biases, times, query, |pairs| {
        let any = |count: f64| f64::from(u8::from(count > 0.0));
        pairs[0].iter().map(|pair| any(pair[0]) - any(pair[1])).collect()
    }));
    let words = format!("the half height of the rise to {percent} %");
    let (sigmas, id) = (&[low, high], "rise".into());
    let query = Query { id, words, sigmas, tolerance, is_share: false };
    questions.extend(question(biases, times, query, |pairs| {
        let half = 0.5 * (1 + biases.parameters.means[0].chains.chain.masses) as f64;
        let [below, above] = [0, 1].map(|i| ours(&pairs[i]).unwrap_or(f64::NAN));
        let slope = (above - below) / (high - low);
        let (part, height) = ((half - below) / (above - below), low + (half - below) / slope);
        let lower = |[a, b]: [&[f64; 2]; 2]| (1.0 - part) * (a[1] - a[0]) + part * (b[1] - b[0]);
        pairs[0].iter().zip(&pairs[1]).map(|(a, b)| lower([a, b]) / slope / height).collect()
    }));
    questions
}

fn cases_at_rest(trials: &Trials) -> usize {
    let scenes = trials.parameters.scenes.iter().filter(|scene| REST.contains(&&*scene.id));
    scenes.map(|scene| scene.cases.len()).sum()
}

/// Returns the gap between two balls of the cradle when the first comes, in units of d.
fn cradle(trials: &Trials) -> Option<f64> {
    let scene = trials.parameters.scenes.iter().find(|scene| scene.id == "cradle")?;
    let case = scene.cases.first()?;
    let Expected::Impacts { impacts, .. } = &case.expected else { return None };
    let frequency = case.scenario["natural_frequency"].as_f64()?;
    Some(1.0 - pxfm::f_cos(frequency * impacts.first()?.0))
}

/// Names the programs with a setting that is right in all cases of some scenes.
fn names(programs: &[Program], scenes: &[&str]) -> String {
    let is_right = |trial: &Trial| right(trial) == trial.len();
    let solves = |run: &&Run| scenes.iter().all(|scene| is_right(&run.outcomes[*scene]));
    let runs = programs.iter().filter_map(|program| program.settings.iter().find(solves));
    runs.map(|run| &*run.name).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::MethodName::Verlet;

    fn answer(seconds: f64, margin: f64, error: f64) -> Answer {
        let setting = Setting { method: Verlet, value: seconds, stop: 0.0 };
        let (chains, result) = (100, with_error(0.0, error));
        let is_enough = is_within(interval(1.0 - margin, chains, error), 1.0);
        Answer { setting, seconds, chains, result, is_enough }
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
    }

    #[test]
    fn a_tie_is_undecided_where_a_faster_setting_is_open() {
        let choice = |faster: Option<Answer>| {
            let setting = Setting { method: Certified, value: 0.0, stop: 0.0 };
            let engine = Answer { setting, ..answer(1.0, 0.05, 0.0) };
            let answers = [engine, answer(0.9, 0.04, 0.01)].into_iter().chain(faster).collect();
            Question { id: String::new(), words: String::new(), answers }.choice()
        };
        assert_eq!(choice(None), "tie");
        assert_eq!(choice(Some(answer(0.5, 0.01, 0.02))), "undecided");
        assert_eq!(choice(Some(answer(0.5, -0.05, 0.01))), "tie");
        assert_eq!(choice(Some(answer(0.5, 0.04, 0.01))), "Verlet, $h = 0.5$");
    }
}
