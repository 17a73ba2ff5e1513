//! Reads times that were measured once, on one machine: `benches/measured.json`. They differ from
//! run to run, so nothing of the reproduction depends on them.

use crate::experiments::prelude::*;
use serde::de::DeserializeOwned;

pub const MEASURED: Experiment<(), Measured> = Experiment {
    name: "measured",
    own: &["src/experiments/measured.rs"],
    reads: &[FILE],
    parameters: |_| (),
    how: Read(|session| committed(session, FILE)),
    tables,
};

pub const FILE: &str = "benches/measured.json";

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    pub sessions: Vec<MeasuredOn>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeasuredOn {
    pub date: String,
    pub machine: Machine,
    pub rows: Vec<Measurement>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    pub processor: String,
    pub os: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Subject {
    /// One chain in the engine of this project.
    Engine,
    /// A method of this project with one setting, timed in turn with the engine.
    Method,
    /// The same on chains of several lengths.
    Size,
    /// The same in a run that ends when a question is answered.
    Question,
    Peer,
    #[serde(other)]
    Other,
}

/// One run, as far as the report needs it. Times are in microseconds or seconds of the clock,
/// simulated time is in units of 1/ω.
///
/// A run starts from rest with r = 0.8 and Ω = √2 between walls. It is compared with a reference
/// of 106 bits up to the first wrong impact (the *horizon*).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measurement {
    #[serde(rename = "what")]
    pub subject: Subject,
    pub name: String,
    pub value: Option<f64>,
    pub n: u64,
    /// Standard deviation σ of the forcing; 0 for a command that has many.
    pub sigma: f64,
    pub until: f64,
    pub chains: u64,
    /// The best of several repetitions.
    pub microseconds_per_impact: Option<f64>,
    /// Time of the first impact with a wrong gap or off by more than 1e−3, or `None` if all are
    /// right.
    pub horizon_time: Option<f64>,
    /// Time of the whole run: of the clock, for methods of the processor.
    pub seconds: Option<f64>,
    /// Processor time of the engine on the same chains, for methods.
    pub engine_seconds: Option<f64>,
    pub note: String,
}

/// Reads a file that `make measure` wrote.
pub fn committed<T: DeserializeOwned>(session: &Session<'_>, file: &str) -> Result<T, Error> {
    let wrong = |field: &str, error: &dyn std::fmt::Display| {
        let again = "run make measure again, or restore the file";
        Error::input(field, one_line(&error.to_string(), 1000), again)
    };
    let json = session.project.text(file).map_err(|error| wrong(file, &error))?;
    let mut reader = serde_json::Deserializer::from_str(&json);
    serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let field = format!("{file}: {}", one_line(&error.path().to_string(), 80));
        wrong(&field, error.inner())
    })
}

impl Measured {
    pub fn rows_about(&self, subject: Subject) -> impl Iterator<Item = &Measurement> {
        let rows = self.sessions.iter().flat_map(|session| &session.rows);
        rows.filter(move |row| row.subject == subject)
    }

    fn rows(
        &self,
        subject: Subject,
        setting: Setting,
        n: usize,
    ) -> impl Iterator<Item = &Measurement> {
        let Setting { method, value, .. } = setting;
        let rows = self.rows_about(subject).filter(move |row| row.n == n as u64);
        rows.filter(move |row| row.method() == method.id() && row.value == Some(value))
    }

    pub fn method(&self, setting: Setting, n: usize, sigma: f64) -> Option<&Measurement> {
        let mut rows = self.rows(Subject::Method, setting, n);
        rows.find(|row| row.sigma == sigma && !row.is_generic())
    }

    pub fn size(&self, setting: Setting, n: usize) -> Option<&Measurement> {
        self.rows(Subject::Size, setting, n).next()
    }

    /// Returns the seconds of one core for a thousand chains: the engine's, times the ratio to it.
    pub fn thousand(&self, row: &Measurement) -> Option<f64> {
        let engine = Setting { method: MethodName::Certified, value: 0.0, stop: 0.0 };
        let alike = |other: &&Measurement| {
            (other.sigma, other.until, other.is_generic())
                == (row.sigma, row.until, row.is_generic())
        };
        let engine = self.rows(row.subject, engine, row.n as usize).find(alike)?;
        Some(row.over_engine()? * engine.seconds? / engine.chains as f64 * 1e3)
    }

    /// Returns the microseconds of an impact by the engine, as many masses, in a row's session.
    pub fn engine(&self, row: &Measurement) -> Option<f64> {
        let session = self.sessions.iter().find(|session| session.rows.contains(row))?;
        let is_engine = |own: &&Measurement| own.subject == Subject::Engine && own.n == row.n;
        let engine = session.rows.iter().filter(is_engine);
        engine.filter_map(|own| own.microseconds_per_impact).next_back()
    }
}

/// The measured times of methods with the vectors that any processor has, or with those of a few.
#[derive(Clone, Copy)]
pub struct Times<'a> {
    pub measured: &'a Measured,
    pub is_generic: bool,
}

impl Times<'_> {
    /// Returns the seconds of one core for a thousand chains up to a time, or `None` if they were
    /// not measured.
    pub fn seconds(
        self,
        subject: Subject,
        setting: Setting,
        runs: &Runs,
        until: f64,
    ) -> Option<f64> {
        let mut rows = self.measured.rows(subject, setting, runs.chain.masses);
        self.measured.thousand(rows.find(|row| {
            row.sigma == runs.sigma && row.until == until && row.is_generic() == self.is_generic
        })?)
    }
}

/// What the names of methods end with that were run with the vectors that any processor has.
const GENERIC: &str = "-generic";

impl Measurement {
    fn method(&self) -> &str {
        self.name.strip_suffix(GENERIC).unwrap_or(&self.name)
    }

    fn is_generic(&self) -> bool {
        self.name.ends_with(GENERIC)
    }

    /// Returns the time over that of the engine on the same chains.
    pub fn over_engine(&self) -> Option<f64> {
        Some(self.seconds? / self.engine_seconds?)
    }
}

pub fn tables(measured: &Measured) -> Vec<Table> {
    const HORIZON: &str = "time up to which its run of one chain is right";
    const THOUSAND: &str = "time of one core for a thousand chains";
    // The last session of the engine and that of the methods, which may be one.
    let parts = [("engine", Subject::Engine), ("methods", Subject::Method)];
    let session = |(part, subject): (&'static str, Subject)| {
        let is_about = |on: &&MeasuredOn| on.rows.iter().any(|row| row.subject == subject);
        Some((part, measured.sessions.iter().rfind(is_about)?))
    };
    let sessions = Vec::from_iter(parts.into_iter().filter_map(session));
    let machine = Table::builder("measured.machine", &sessions, |_| 1)
        .text_key("of", |(part, _)| (*part).into())
        .words("date", "when", |(_, on)| on.date.clone())
        .words("processor", "on what", |(_, on)| on.machine.processor.replace("(R)", ""))
        .words("os", "under what", |(_, on)| on.machine.os.replace('_', "-"))
        .all_measured();
    let n = 100;
    let single = measured.rows_about(Subject::Engine).filter(|row| row.n == n && row.chains == 1);
    let engine = single.filter_map(|row| row.microseconds_per_impact).last();
    let meaning = format!("time of an impact in the engine, one chain of {n} masses");
    let impact = Table::builder("measured.impact", &[()], |()| 1)
        .real("engine", "us", 2, &meaning, |()| engine)
        .all_measured();
    let single = measured.rows_about(Subject::Engine).chain(measured.rows_about(Subject::Peer));
    let single = Vec::from_iter(single.filter(|row| row.chains == 1 && row.horizon_time.is_some()));
    let finest = single.chunk_by(|a, b| (&a.name, a.n) == (&b.name, b.n)).filter_map(<[_]>::last);
    let finest: Vec<_> = finest.collect();
    let chain = Table::builder("measured.chain", &finest, |_| 1)
        .text_key("program", |row| row.name.split(' ').next().unwrap_or_default().into())
        .key("n", "1", |row| row.n as f64)
        .real("horizon", TIME, 4, HORIZON, |row| row.horizon_time)
        .all_measured();
    let rows: Vec<&Measurement> = measured.rows_about(Subject::Method).collect();
    let methods = Table::builder("measured.methods", &rows, |row| row.chains as usize)
        .text_key("setting", |row| match row.value {
            Some(value) => format!("{}-{value}", row.name),
            None => row.name.clone(),
        })
        .key("sigma", SIGMA, |row| row.sigma)
        .real("thousand", "s", 2, THOUSAND, |row| measured.thousand(row))
        .real("over_engine", "1", 2, "time over the engine's", |row| row.over_engine())
        .all_measured();
    vec![machine.done(), impact.done(), chain.done(), methods.done()]
}
