//! Times that were measured once, on one machine: `benches/measured.json`.
//!
//! Times are no results: they differ from run to run, so nothing of the paper's reproduction
//! depends on them. `make measure` writes them, with date and machine, and they are committed; the
//! report only reads them, and so keeps its bytes until somebody measures again.

use super::Error;
use crate::committed;
use literate::input::one_line;
use serde::{Deserialize, Serialize};

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
    pub rows: Vec<Row>,
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
    /// Another model, written in this project for its speed (`impact-chain`, example `ballistic`).
    Model,
    /// Wall time of a command of this project.
    Command,
    /// Another project that could not be run; the note says why.
    Absent,
}

/// One run. Times are in microseconds or seconds of the clock, simulated time is in units of 1/ω.
///
/// A run starts from rest with r = 0.8 and Ω = √2 between walls. Its accuracy is held against a
/// reference of 106 bits: impacts one after the other up to the first wrong one (the *horizon*),
/// and the next impact alone from the true state after each impact (*segments*).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// What the row tells.
    pub what: What,
    /// Name of engine, method, peer or command.
    pub name: String,
    /// Its version.
    pub version: String,
    /// Step, tolerance or options, e.g. "tol=1e-10"; may be empty.
    pub settings: String,
    /// Number of masses n; 0 for a command that has many.
    pub n: u64,
    /// Standard deviation σ of the forcing; 0 for a command that has many.
    pub sigma: f64,
    /// Simulated time T.
    pub until: f64,
    /// Chains run.
    pub chains: u64,
    /// Threads used.
    pub threads: u32,
    /// Impacts that it saw, over all chains.
    pub impacts: u64,
    /// Wall time over impacts: the best of several repetitions.
    pub microseconds_per_impact: Option<f64>,
    /// Evaluations of a gap, or of an acceleration, per impact, where they were counted.
    pub evaluations_per_impact: Option<f64>,
    /// Impacts of the reference that the run was held against; none if it was not.
    pub compared: Option<u64>,
    /// Number, counted from 1, of the first impact with a wrong gap or a time off by more than
    /// 1e−3; none if all that were compared are right.
    pub horizon_impact: Option<u64>,
    /// Time of that impact in the reference.
    pub horizon_time: Option<f64>,
    /// Segments whose next impact was not found: wrong gap, or a time off by more than 1e−3.
    pub segment_misses: Option<u64>,
    /// Segments tried.
    pub segments: Option<u64>,
    /// Wall time of all of it, in seconds.
    pub seconds: Option<f64>,
    /// Largest resident memory of the process, in MiB.
    pub peak_mib: Option<f64>,
    /// What else one must know; may be empty.
    pub note: String,
}

/// What to do about any broken file.
const AGAIN: &str = "run make measure again, or restore the file";

impl Measured {
    /// The committed file.
    ///
    /// # Errors
    /// As [`Measured::parse`]; and if the file cannot be read.
    pub fn committed() -> Result<Self, Error> {
        let text = committed::text(FILE)
            .map_err(|e| Error::input("measured.json", e.to_string(), AGAIN))?;
        Measured::parse(&text)
    }

    /// Reads and checks the file.
    ///
    /// # Errors
    /// [`Error::Input`] names the first field that is missing, unknown or out of bounds.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut reader = serde_json::Deserializer::from_str(text);
        let measured: Measured =
            serde_path_to_error::deserialize(&mut reader).map_err(|error| {
                let path = error.path().to_string();
                let field = if matches!(&*path, "." | "?") { "file" } else { &path };
                wrong(field, error.into_inner().to_string())
            })?;
        reader.end().map_err(|error| wrong("file", error.to_string()))?;
        measured.check()?;
        Ok(measured)
    }

    /// Rows of one kind.
    pub fn of(&self, what: What) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(move |row| row.what == what)
    }

    fn check(&self) -> Result<(), Error> {
        let digits = |part: &str, n| part.len() == n && part.bytes().all(|b| b.is_ascii_digit());
        let parts: Vec<&str> = self.date.split('-').collect();
        if !matches!(parts[..], [y, m, d] if digits(y, 4) && digits(m, 2) && digits(d, 2)) {
            return Err(wrong("date", format!("{:?} is no day YYYY-MM-DD", self.date)));
        }
        if self.machine.cores == 0 {
            return Err(wrong("machine.cores", "a machine has at least one".into()));
        }
        for (i, row) in self.rows.iter().enumerate() {
            row.check()
                .map_err(|(field, problem)| wrong(&format!("rows[{i}].{field}"), problem))?;
        }
        Ok(())
    }
}

impl Row {
    /// Field and problem of the first value that cannot be.
    fn check(&self) -> Result<(), (&'static str, String)> {
        let positive = [
            ("microseconds_per_impact", self.microseconds_per_impact),
            ("evaluations_per_impact", self.evaluations_per_impact),
            ("horizon_time", self.horizon_time),
            ("seconds", self.seconds),
            ("peak_mib", self.peak_mib),
        ];
        for (field, value) in positive {
            if let Some(x) = value
                && !(x.is_finite() && x > 0.0)
            {
                return Err((field, format!("{x:?} is not positive")));
            }
        }
        if self.name.is_empty() {
            return Err(("name", "it is empty".into()));
        }
        for (field, x) in [("sigma", self.sigma), ("until", self.until)] {
            if !(x.is_finite() && x >= 0.0) {
                return Err((field, format!("{x:?} is not 0 or more")));
            }
        }
        if self.segments.is_some() != self.segment_misses.is_some() {
            return Err(("segments", "segments and segment_misses come together".into()));
        }
        if self.segment_misses > self.segments {
            return Err(("segment_misses", "more were missed than tried".into()));
        }
        if self.horizon_impact.is_some() != self.horizon_time.is_some() {
            return Err(("horizon_impact", "horizon_impact and horizon_time come together".into()));
        }
        if self.horizon_impact > self.compared {
            return Err(("horizon_impact", "it lies beyond the impacts compared".into()));
        }
        if self.what == What::Absent && self.note.is_empty() {
            return Err(("note", "an absent peer has a reason".into()));
        }
        Ok(())
    }
}

fn wrong(field: &str, problem: String) -> Error {
    let field = format!("measured.json: {}", one_line(field, 80));
    Error::input(field, one_line(&problem, 1000), AGAIN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_file_reads() {
        let measured = Measured::committed().unwrap();
        assert!(measured.of(What::Engine).count() > 0);
        let text = serde_json::to_string(&measured).unwrap();
        assert_eq!(Measured::parse(&text).unwrap(), measured);
        assert!(!text.contains("/home") && !text.contains("/root"));
    }

    /// The committed file with one text replaced by another.
    fn with(old: &str, new: &str) -> String {
        let text = serde_json::to_string(&Measured::committed().unwrap()).unwrap();
        assert!(text.contains(old), "{old} is not in the file");
        text.replacen(old, new, 1)
    }

    #[test]
    fn what_is_wrong_is_named() {
        let measured = Measured::committed().unwrap();
        let row = &measured.rows[0];
        let name = format!("\"name\":{:?}", row.name);
        let date = format!("\"date\":{:?}", measured.date);
        let time =
            format!("\"microseconds_per_impact\":{:?}", row.microseconds_per_impact.unwrap());
        for (text, field) in [
            (String::new(), "file: "),
            ("{}".into(), "missing field `date`"),
            (with(&date, "\"date\":\"today\""), "date: "),
            (with(&name, "\"name\":\"\""), "rows[0].name: "),
            (with(&name, "\"name\":7"), "rows[0].name: "),
            (with(&name, "\"nome\":\"x\""), "rows[0].nome: "),
            (with(&time, "\"microseconds_per_impact\":-1.0"), "rows[0].microseconds_per_impact: "),
            (with("\"what\":\"engine\"", "\"what\":\"motor\""), "rows[0].what: "),
            (with("\"what\":\"engine\"", "\"what\":\"absent\""), "rows[0].note: "),
            (format!("{} x", with("{", "{")), "file: "),
        ] {
            let error = Measured::parse(&text).unwrap_err().to_string();
            assert!(error.starts_with("measured.json: ") && error.contains(field), "{error}");
        }
    }

    #[test]
    fn counts_agree() {
        let mut row = Measured::committed().unwrap().rows.remove(0);
        (row.segments, row.segment_misses) = (Some(3), Some(4));
        assert_eq!(row.check().unwrap_err().0, "segment_misses");
        (row.segments, row.segment_misses) = (None, Some(4));
        assert_eq!(row.check().unwrap_err().0, "segments");
        (row.segments, row.segment_misses) = (None, None);
        (row.compared, row.horizon_impact, row.horizon_time) = (Some(5), Some(6), Some(1.0));
        assert_eq!(row.check().unwrap_err().0, "horizon_impact");
    }
}
