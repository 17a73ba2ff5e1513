//! Runs one scenario of the verb `trace`, and hands on its rows.

use super::super::range::Times;
use super::args::Args;
use impact_chain::methods::{Cost, Task};
use impact_chain::rounding;
use impact_chain::{Counters, End, Engine, Error, Event, Graze, Impact, LATEST, Scenario, State};
use impact_paper::params::MethodName;
use literate::Failure;
use literate::input::{in_plain_words, one_line};
use std::f64::consts::TAU;
use std::fmt::{Arguments, Write};
use std::ops::ControlFlow::{Break, Continue};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::mpsc::SyncSender;

/// What every scenario is run with.
pub struct Job {
    pub args: Args,
    pub setting: f64,
    pub start: Option<State>,
    /// The bits of the time of the latest event.
    pub latest: Arc<AtomicU64>,
}

/// What a run hands on, in order.
pub enum Part {
    /// Whole rows; none at all at a good end.
    Rows(String),
    Note(String),
    /// Why a line failed after which the others go on.
    FailedLine(String),
    Failed(Failure),
}

/// Bytes of rows that are handed on together.
const BLOCK: usize = 1 << 13;

/// A run of one scenario, with its rows, each of which begins with the same cells.
struct Run<'a> {
    job: &'a Job,
    first_cells: String,
    block: String,
    is_silent: bool,
    /// Whether somebody takes the rows.
    is_wanted: bool,
    sender: SyncSender<Part>,
}

/// What a run cost, and its state at the end if that is asked for.
type Ended = Result<(Cost, Option<State>), Error>;

impl Run<'_> {
    fn row(&mut self, cells: Arguments) {
        self.is_silent = false;
        // A text takes all that is written.
        let _ = writeln!(self.block, "{}{cells}", self.first_cells);
        if self.block.len() > BLOCK {
            self.hand_on();
        }
    }

    fn hand_on(&mut self) {
        self.is_wanted &= self.sender.send(Part::Rows(std::mem::take(&mut self.block))).is_ok();
    }

    /// Runs the scenario of a text; returns how that went, and what is to be noted.
    fn trace(&mut self, name: &str, text: &str) -> (Result<(), Failure>, Vec<String>) {
        let scenario = match Scenario::from_json(text) {
            Ok(scenario) => scenario,
            Err(error) => return (Err(in_file(name, error)), Vec::new()),
        };
        let start = self.job.start.clone().unwrap_or_else(|| State::from_scenario(&scenario));
        let ran = if self.job.args.method == MethodName::Certified {
            self.by_engine(&scenario, &start)
        } else {
            self.by_method(&scenario, &start)
        };
        let mut notes = ran.as_ref().map_or(Vec::new(), |(cost, _)| doubts(cost));
        let width = rounding::gap_error(&scenario);
        let closed = matches!(self.job.args.method, MethodName::Certified | MethodName::Sampled);
        let began = matches!(ran, Ok(_) | Err(Error::Work { .. }));
        if closed && began && width > rounding::REPORTED * scenario.spacing {
            notes.push(format!(
                "rounding of large amplitudes may move each impact at closing speed v by {width:.1e}/v, \
                 and errors grow from impact to impact"
            ));
        }
        let ran = ran.map_err(|error| {
            let field = error.field().unwrap_or_default();
            let of_state = ["time", "positions", "velocities"].iter().any(|f| field.starts_with(f));
            match &self.job.args.from {
                Some(path) if of_state => in_file(&format!("--from: {}", path.display()), error),
                _ => in_file(name, error),
            }
        });
        let ended = ran.and_then(|(_, state)| match (&self.job.args.save, state) {
            (Some(path), Some(state)) => save(path, &state),
            _ => Ok(()),
        });
        (ended, notes)
    }

    fn note_time(&self, time: f64) {
        self.job.latest.store(time.to_bits(), Relaxed);
    }

    fn by_method(&mut self, scenario: &Scenario, start: &State) -> Ended {
        let mut left = self.job.args.max_impacts.unwrap_or(u64::MAX);
        let until = if left == 0 { start.time } else { self.job.args.until.unwrap_or_default() };
        let method = self.job.args.method.with_setting(self.job.setting, 0.0);
        let mut sink = |Impact { time, gap, closing_speed }| {
            self.note_time(time);
            if left > 0 {
                self.row(format_args!("{time:?},{gap},{closing_speed:?}"));
                left -= 1;
            }
            left > 0 && self.is_wanted
        };
        Ok((method.run(Task { scenario, start, until }, &mut sink)?, None))
    }

    /// Prints events, or states at given times; returns the state at the end.
    fn by_engine(&mut self, scenario: &Scenario, start: &State) -> Ended {
        let mut engine = Engine::from_state(scenario, start)?;
        let end = match &self.job.args.at {
            Some(times) => self.states(times, scenario.forcing_frequency, &mut engine)?,
            None => self.events(&mut engine)?,
        };
        let Counters { impacts, simultaneous, undecided, .. } = engine.counters();
        let first_graze = engine.first_graze();
        let cost = Cost { impacts, simultaneous, undecided, first_graze, ..Cost::default() };
        Ok((cost, self.job.args.save.as_ref().map(|_| engine.state(end)).transpose()?))
    }

    /// Prints each impact, or each event; returns the time of the end.
    fn events(&mut self, engine: &mut Engine) -> Result<f64, Error> {
        let (all, until) = (self.job.args.events, self.job.args.until.unwrap_or_default());
        let mut left = self.job.args.max_impacts.unwrap_or(u64::MAX);
        if left == 0 {
            return Ok(engine.time());
        }
        let ended = engine.run(until, |event, _| {
            let time = event.time();
            self.note_time(time);
            let (name, gaps) = match event {
                Event::Impact(Impact { gap, closing_speed, .. }) => {
                    let name = if all { "impact," } else { "" };
                    self.row(format_args!("{time:?},{name}{gap},{closing_speed:?}"));
                    left -= 1;
                    ("", &[][..])
                }
                Event::Stick { gaps, .. } => ("stick", &gaps[..]),
                Event::Release { gaps, .. } => ("release", &gaps[..]),
                Event::Graze(Graze { gap, .. }) => ("graze", std::slice::from_ref(gap)),
                _ => ("", &[][..]),
            };
            for gap in gaps.iter().filter(|_| all) {
                self.row(format_args!("{time:?},{name},{gap},"));
            }
            if left > 0 && self.is_wanted { Continue(()) } else { Break(()) }
        })?;
        Ok(if ended == End::Stopped { engine.time() } else { until })
    }

    /// Prints time, place and velocity of each mass at given times; returns the time of the end.
    fn states(&mut self, times: &Times, frequency: f64, engine: &mut Engine) -> Result<f64, Error> {
        let (from, until) = (engine.time(), self.job.args.until);
        let period = TAU / frequency;
        let times: Box<dyn Iterator<Item = f64>> = match times {
            Times::Values(times) => Box::new(times.iter().copied()),
            Times::OncePerPeriod => {
                let multiples = (from / period) as u64..;
                Box::new(multiples.map(|k| k as f64 * period).skip_while(|time| *time < from))
            }
        };
        let (mut last, mut printed) = (from, None);
        for time in times.take_while(|time| *time <= until.unwrap_or(LATEST)) {
            // Equal times have one state.
            if printed.replace(time) == Some(time) {
                continue;
            }
            engine.advance(time)?;
            self.note_time(time);
            let state = engine.state(time)?;
            for (j, (x, v)) in state.positions.iter().zip(&state.velocities).enumerate() {
                self.row(format_args!("{time:?},{},{x:?},{v:?}", j + 1));
            }
            last = time;
            if !self.is_wanted {
                break;
            }
        }
        let end = until.filter(|_| self.is_wanted).unwrap_or(last);
        engine.advance(end)?;
        Ok(end)
    }
}

impl Job {
    pub fn header(&self) -> String {
        let number = if self.args.lines { "scenario," } else { "" };
        let status = if self.args.keep_going { "status," } else { "" };
        format!("{number}{status}time,{}\n", self.columns())
    }

    fn columns(&self) -> &'static str {
        match (&self.args.at, self.args.events) {
            (Some(_), _) => "mass,position,velocity",
            (None, true) => "event,gap,closing_speed",
            (None, false) => "gap,closing_speed",
        }
    }

    /// Runs the scenario of a text, which is that of a line if it has a number.
    pub fn run(&self, number: Option<u64>, name: &str, text: &str, sender: SyncSender<Part>) {
        let number_cell = number.map_or(String::new(), |number| format!("{number},"));
        let cells = |status| match self.args.keep_going {
            true => format!("{number_cell}{status},"),
            false => number_cell.clone(),
        };
        let (first_cells, block) = (cells("ok"), String::new());
        let mut run =
            Run { job: self, first_cells, block, is_silent: true, is_wanted: true, sender };
        // With many scenarios each note names the one that it is about.
        let name = number.map_or(name.into(), |number| format!("{name}, line {number}"));
        let of_line = number.map_or(String::new(), |_| format!("{name}: "));
        let (ran, notes) = run.trace(&name, text);
        let commas = ",".repeat(self.columns().matches(',').count() + 1);
        let failure = match ran {
            Ok(()) => None,
            Err(failure) if self.args.keep_going => {
                run.first_cells = cells(if failure.code == 1 { "stopped" } else { "refused" });
                run.row(format_args!("{commas}"));
                Some(Part::FailedLine(failure.message))
            }
            Err(failure) => Some(Part::Failed(failure)),
        };
        if self.args.keep_going && run.is_silent {
            run.row(format_args!("{commas}"));
        }
        // A run that is refused at its start prints nothing, and one that is stopped its run.
        if !run.block.is_empty() || failure.is_none() {
            run.hand_on();
        }
        for part in notes.into_iter().map(|note| Part::Note(of_line.clone() + &note)).chain(failure)
        {
            // Nobody waits for it if the program is ending.
            let _ = run.sender.send(part);
        }
    }
}

/// Writes the state for `--from`.
fn save(path: &Path, state: &State) -> Result<(), Failure> {
    let json = serde_json::to_string(state).unwrap_or_default();
    std::fs::write(path, json + "\n").map_err(|error| unsaved(path, &error))
}

pub fn unsaved(path: &Path, error: &std::io::Error) -> Failure {
    Failure::input(format!("--save: {}: {error}; give another file", path.display()))
}

/// Lists impacts whose order is a choice, and grazes that rounding hides.
fn doubts(cost: &Cost) -> Vec<String> {
    let mut notes = Vec::new();
    if cost.simultaneous > 0 {
        notes.push(format!(
            "impacts at exactly the same instant as one in a neighbouring gap: {} of {}; they were taken \
             one after the other, fastest first",
            cost.simultaneous, cost.impacts
        ));
    }
    if let Some(Graze { time, gap, .. }) = cost.first_graze {
        notes.push(format!(
            "grazes that rounding could not decide: {}, the first of gap {gap} at t = {time:?}; each was \
             taken for a miss, and the run may be wrong from there on",
            cost.undecided
        ));
    }
    notes
}

/// The failure for an error in a scenario or a setting (exit code 2) or a run (1).
fn in_file(name: &str, error: Error) -> Failure {
    match error {
        Error::Work { .. } => Failure::check(error.to_string()),
        Error::Input { ref field, .. } if ["step", "tolerance"].contains(&field.as_str()) => {
            Failure::input(format!("--{error}"))
        }
        error => {
            let message = one_line(&in_plain_words(&error.to_string()), 1000);
            Failure::input(format!("{name}: {message}"))
        }
    }
}
