//! Runs the verb `trace`: one scenario, with its impacts.

mod args;
mod one;

use super::range::Times;
pub use args::Args;
use args::{METHODS, option};
use impact_chain::State;
use impact_paper::experiments::alive;
use impact_paper::params::MethodName::*;
use literate::Failure;
use literate::cli::terminal::{warn, written as printed};
use literate::input::{self, one_line};
use one::{Job, Part};
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

pub fn run(args: Args) -> Result<(), Failure> {
    let needs_engine =
        [("--at", args.at.is_some()), ("--events", args.events), ("--save", args.save.is_some())];
    if let Some((option, _)) = needs_engine.iter().find(|(_, given)| *given)
        && args.method != Certified
    {
        let message = format!("{option}: only the method certified has states; leave it out");
        return Err(Failure::input(message));
    }
    if matches!(args.at, Some(Times::OncePerPeriod)) && args.until.is_none() {
        return Err(Failure::input("--at: period has no end; give --until"));
    }
    if args.save.as_deref() == Some(Path::new("-")) {
        return Err(Failure::input("--save: standard output has the rows; give a file"));
    }
    if let Some(path) = &args.save {
        // A long run is not made for a file that cannot be written; if it is ended, none is left.
        let is_new = !path.exists();
        let file = File::options().append(true).create(true).open(path);
        let remove = || if is_new { std::fs::remove_file(path) } else { Ok(()) };
        file.and_then(|_| remove()).map_err(|error| one::unsaved(path, &error))?;
    }
    let start = args.from.as_deref().map(saved).transpose()?;
    let first_sample = match &args.at {
        Some(Times::Values(times)) => times.first().copied(),
        _ => None,
    };
    let begin = start.as_ref().map_or(0.0, |start| start.time);
    for (option, time) in [("--until", args.until), ("--at", first_sample)] {
        if let Some(time) = time.filter(|time| *time < begin) {
            let problem = format!("{time:?} is before the state, at {begin:?}");
            return Err(Failure::input(format!("{option}: {problem}; give a later time")));
        }
    }
    let latest = Arc::new(AtomicU64::new(0));
    let job = Job { setting: setting(&args)?, start, latest: Arc::clone(&latest), args };
    let _alive = alive(move || format!("trace: at t = {:?}", f64::from_bits(latest.load(Relaxed))));
    let (mut header, mut failed_lines) = (job.header(), 0);
    let mut stdout = io::stdout();
    // Scenarios are read while others run, and the rows of each are taken in turn.
    let (queue, scenarios) = sync_channel(4 * rayon::current_num_threads());
    thread::spawn(move || start_all(&Arc::new(job), &queue));
    for part in scenarios.into_iter().flatten() {
        match part {
            // Whole rows: a signal that ends the program leaves no half of a number.
            Part::Rows(rows) => {
                let text = std::mem::take(&mut header) + &rows;
                if let Err(error) = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush())
                {
                    // A reader that goes away is no failure.
                    return printed(Err(error));
                }
            }
            Part::Note(note) => warn(&note),
            Part::FailedLine(message) => {
                warn(&message);
                failed_lines += 1;
            }
            Part::Failed(failure) => return Err(failure),
        }
    }
    match failed_lines {
        0 => Ok(()),
        number => Err(Failure::check(format!("lines refused or stopped: {number}"))),
    }
}

/// Reads the state that `--save` wrote.
fn saved(path: &Path) -> Result<State, Failure> {
    let text = File::open(path).and_then(input::read_from);
    let state = text.and_then(|text| Ok(serde_json::from_str(&text)?));
    state.map_err(|error| {
        let (path, error) = (path.display(), one_line(&error.to_string(), 1000));
        Failure::input(format!("--from: {path}: {error}; give a file that --save wrote"))
    })
}

/// Starts the runs of all scenarios, and hands on where their parts come from.
fn start_all(job: &Arc<Job>, queue: &SyncSender<Receiver<Part>>) {
    let path = &job.args.scenario;
    let is_stdin = path == Path::new("-");
    let name = if is_stdin { "standard input".into() } else { path.display().to_string() };
    let start = |number: Option<u64>, text: String| {
        let (sender, parts) = sync_channel(16);
        let (job, name) = (Arc::clone(job), name.clone());
        let is_wanted = queue.send(parts).is_ok();
        rayon::spawn(move || job.run(number, &name, &text, sender));
        is_wanted
    };
    let start_each = || -> io::Result<()> {
        let mut file: Box<dyn BufRead> = if is_stdin {
            Box::new(io::stdin().lock())
        } else {
            Box::new(BufReader::new(File::open(path)?))
        };
        if !job.args.lines {
            start(None, input::read_from(file)?);
            return Ok(());
        }
        for number in 1.. {
            let mut line = Vec::new();
            (&mut file).take(input::MOST << 20).read_until(b'\n', &mut line)?;
            let is_blank = line.trim_ascii().is_empty();
            if line.is_empty() || !is_blank && !start(Some(number), input::read_from(&line[..])?) {
                break;
            }
        }
        Ok(())
    };
    if let Err(error) = start_each() {
        let failure = format!("{name}: {error}; give a scenario, see `trace --help`");
        let (sender, parts) = sync_channel(1);
        // Nobody takes it if the program is ending.
        let _ = sender.send(Part::Failed(Failure::input(failure)));
        let _ = queue.send(parts);
    }
}

/// Returns the step or tolerance; refuses an option that the method does not have.
fn setting(args: &Args) -> Result<f64, Failure> {
    let usual = METHODS.iter().find(|(method, ..)| *method == args.method).and_then(|row| row.1);
    let takes = usual.map_or("neither", |_| option(args.method));
    for (given, value) in [("--step", args.step), ("--tolerance", args.tolerance)] {
        if value.is_some() && given != takes {
            let name = args.method.id();
            let what = format!("{given}: the method {name} takes {takes}; leave it out");
            return Err(Failure::input(what));
        }
    }
    Ok(args.step.or(args.tolerance).or(usual).unwrap_or_default())
}
