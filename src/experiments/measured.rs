//! Times that were measured once, on one machine: `benches/measured.json`.
//!
//! Times are no results: they differ from run to run, so nothing of the paper's reproduction
//! depends on them. `make measure` writes them, with date and machine, and they are committed; the
//! report only reads them, and so keeps its bytes until somebody measures again.

use crate::experiments::prelude::*;
use literate::input::one_line;

/// Where the file lies, seen from the top of the project.
pub const FILE: &str = "benches/measured.json";

/// What was measured, where and when.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Day of the measurement, YYYY-MM-DD.
    pub date: String,
    /// What it ran on.
    pub machine: Machine,
    /// One for each run.
    pub rows: Vec<Measurement>,
}

/// A machine, without its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Machine {
    /// Model of the processor, as the system calls it.
    pub processor: String,
    /// Processors that the system offers.
    pub cores: u32,
    /// Operating system and architecture.
    pub os: String,
}

/// What a row tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum What {
    /// One chain in the engine of this project.
    Engine,
    /// Many chains in the engine of this project, for the most impacts a second.
    Ensemble,
    /// Another method, written in this project (`impact_chain::methods`).
    Method,
    /// Another project.
    Peer,
    /// Wall time of a command of this project.
    Command,
    /// Another project that could not be run; the note says why.
    Absent,
}

/// One run, as far as the report needs it. Times are in microseconds or seconds of the clock, simulated time is in units of 1/ω.
///
/// A run starts from rest with r = 0.8 and Ω = √2 between walls. Its accuracy is held against a
/// reference of 106 bits: impacts one after the other up to the first wrong one (the *horizon*),
/// and the next impact alone from the true state after each impact (*segments*).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    /// What the row tells.
    pub what: What,
    /// Name of engine, method, peer or command.
    pub name: String,
    /// Number of masses n; 0 for a command that has many.
    pub n: u64,
    /// Simulated time T.
    pub until: f64,
    /// Chains run.
    pub chains: u64,
    /// Threads used.
    pub threads: u32,
    /// Wall time over impacts: the best of several repetitions.
    pub microseconds_per_impact: Option<f64>,
    /// Impacts of the reference that the run was held against; none if it was not.
    pub compared: Option<u64>,
    /// Number, counted from 1, of the first impact with a wrong gap or a time off by more than
    /// 1e−3; none if all that were compared are right.
    pub horizon_impact: Option<u64>,
    /// Time of that impact in the reference.
    pub horizon_time: Option<f64>,
    /// Wall time of all of it, in seconds.
    pub seconds: Option<f64>,
    /// Largest resident memory of the process, in MiB.
    pub peak_mib: Option<f64>,
    /// What else one must know; may be empty.
    pub note: String,
}

impl Measured {
    /// The committed file.
    pub fn committed(session: &Session<'_>) -> Result<Self, Error> {
        let again = "run make measure again, or restore the file";
        let project = &session.paper.project;
        let text = project
            .text(FILE)
            .map_err(|error| Error::input("measured.json", error.to_string(), again))?;
        let mut reader = serde_json::Deserializer::from_str(&text);
        serde_path_to_error::deserialize(&mut reader).map_err(|error| {
            let field = format!("measured.json: {}", one_line(&error.path().to_string(), 80));
            Error::input(field, one_line(&error.into_inner().to_string(), 1000), again)
        })
    }

    /// Rows of one kind.
    pub fn of(&self, what: What) -> impl Iterator<Item = &Measurement> {
        self.rows.iter().filter(move |row| row.what == what)
    }

    /// Time of an impact in one chain of 100 masses, by what has this name.
    fn impact(&self, what: What, name: &str) -> f64 {
        let own = self.of(what).filter(|row| row.name == name && row.n == 100 && row.chains == 1);
        own.filter_map(|row| row.microseconds_per_impact).last().unwrap_or(f64::NAN)
    }
}

/// When and where times were measured, and what an impact takes.
pub fn tables(measured: &Measured) -> Vec<Table> {
    let machine = &measured.machine;
    let table = Table::of("measured.machine", &[()], |()| 1)
        .computed_by(origin(Measured::committed))
        .words("date", "when", |()| measured.date.clone())
        .words("processor", "on what", |()| machine.processor.replace("(R)", ""))
        .words("os", "under what", |()| machine.os.replace('_', "-"))
        .count("cores", "processors", |()| u64::from(machine.cores))
        .measured();
    let engine = measured.impact(What::Engine, "impact-paper");
    let [certified, advancement] =
        ["certified", "advancement"].map(|name| measured.impact(What::Method, name));
    let impact = Table::of("measured.impact", &[()], |()| 1)
        .computed_by(origin(Measured::committed))
        .real("engine", "us", 2, "time of an impact in the engine, one chain of 100 masses", |()| {
            engine
        })
        .real("advancement", "1", 2, "time of conservative advancement over the engine's", |()| {
            advancement / certified
        })
        .measured();
    vec![table.done(), impact.done()]
}
