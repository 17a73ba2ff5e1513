//! What the verbs that take time have in common: experiments by name, threads, Ctrl-C, and errors as exit codes.

use super::Failure;
use crate::experiments::{self, Error, Progress, say};
use crate::input::MEMORY;
use crate::params::Profile;
use crate::report::{self, contents};
use crate::{claims, dynamics, figures};
use clap::builder::{PathBufValueParser, PossibleValue, PossibleValuesParser, TypedValueParser};
use literate::experiments::deep;
use literate::experiments::shards::Plan;
use std::collections::HashSet;
use std::num::ParseIntError;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

/// Reads the name of a profile, one of these.
fn profiles(some: &[Profile]) -> impl TypedValueParser<Value = Profile> {
    let about = |profile| match profile {
        Profile::Quick => "To try out: seconds",
        Profile::Ci => "For pull requests: half a minute",
        Profile::Full => "The committed report: minutes",
        Profile::Deep => {
            "What is run now and then, committed, and carried over: a quarter of an hour"
        }
    };
    let known = some.iter().map(|own| PossibleValue::new(own.name()).help(about(*own)));
    PossibleValuesParser::new(known).try_map(|name| profile(&name).ok_or("unknown"))
}

/// The profile of a name.
pub fn profile(name: &str) -> Option<Profile> {
    Profile::ALL.into_iter().find(|own| own.name() == name)
}

/// Reads sample sizes of a report.
pub fn of_reports() -> impl TypedValueParser<Value = Profile> {
    profiles(&[Profile::Quick, Profile::Ci, Profile::Full])
}

/// Reads sample sizes, and what takes longer than any report may.
pub fn of_all() -> impl TypedValueParser<Value = Profile> {
    profiles(&Profile::ALL)
}

/// Reads a folder that may have to be made: without dots at its end, with which none can be.
pub fn folder() -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().map(|folder| folder.components().collect())
}

/// Which experiments of a profile are meant.
#[derive(clap::Args)]
pub struct Only {
    /// Only these experiments, by the names that `status` shows, with commas between them. Shards are those of
    /// the units of these: `plan`, `run` and `merge` must name the same.
    #[arg(long = "experiment", value_name = "NAME", value_delimiter = ',')]
    names: Vec<String>,
}

impl Only {
    /// The units of work of these experiments, or of all if none is named.
    pub fn plan(&self, profile: Profile) -> Result<Plan, Failure> {
        let known: Vec<&str> = experiments::of(profile).iter().map(|one| one.name()).collect();
        if let Some(name) = self.names.iter().find(|name| !known.contains(&name.as_str())) {
            let (profile, known) = (profile.name(), known.join(", "));
            return Err(Failure::input(format!(
                "--experiment: profile {profile} has no experiment \"{name}\"; give some of {known}"
            )));
        }
        let plan = Plan::new(experiments::of, profile);
        Ok(if self.names.is_empty() { plan } else { plan.only(&self.names) })
    }
}

/// Where results of a profile are kept unless a folder is given: beside the source what is committed,
/// under target what is not.
pub fn results(given: Option<PathBuf>, profile: Profile) -> PathBuf {
    given.unwrap_or_else(|| match profile {
        Profile::Deep => "benches/deep".into(),
        _ => "target/results".into(),
    })
}

/// How stale results of a profile are made fresh.
pub fn remedy(profile: Profile) -> String {
    match profile {
        Profile::Deep => deep::REMEDY.into(),
        _ => format!("`impact-paper paper --profile {}` runs them", profile.name()),
    }
}

/// The first number of a file in which Linux tells something.
fn number(text: &str) -> Option<u128> {
    text.split_whitespace().next()?.parse().ok()
}

/// The number behind a name at the beginning of a line.
fn named(path: &str, name: &str) -> Option<u128> {
    std::fs::read_to_string(path).ok()?.lines().find_map(|line| number(line.strip_prefix(name)?))
}

/// Addresses that the process may still take, where its limit is below the infinite. Counted from its beginning, and not
/// from what it has now: what the system sets aside for the heaps of threads depends on their order.
fn addresses() -> Option<u128> {
    static BEGAN: OnceLock<u128> = OnceLock::new();
    let most = named("/proc/self/limits", "Max address space")?;
    let kib = |name| Some(named("/proc/self/status", name)? << 10);
    let began = *BEGAN.get_or_init(|| kib("VmSize:").unwrap_or_default());
    let taken = kib("RssAnon:")?;
    Some(most.saturating_sub(began + taken))
}

/// Memory that the system has to give, in bytes: Linux tells it, elsewhere 4 GiB are taken for granted. Less where
/// the process or its group may not have as much.
fn at_hand() -> u128 {
    let group = || {
        let at =
            |name: &str| number(&std::fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?);
        Some(at("memory.max")?.saturating_sub(at("memory.current")?))
    };
    let free = named("/proc/meminfo", "MemAvailable:").map_or(4 << 30, |kib| kib << 10);
    // Half of the addresses are what a process can hope for.
    let limits = [addresses(), group(), Some(usize::MAX as u128 / 2)];
    limits.into_iter().flatten().fold(free, u128::min)
}

/// Bytes in GiB or, where they are fewer, MiB.
fn size(bytes: u128) -> String {
    match bytes as f64 / f64::from(1 << 20) {
        mib if mib < 1024.0 => format!("{mib:.0} MiB"),
        mib => format!("{:.1} GiB", mib / 1024.0),
    }
}

/// Refuses work that needs more memory than there is, before any of it is taken: an estimate in bytes, the
/// option that asks for it, and what to give instead.
pub fn memory(needed: u128, option: &str, remedy: &str) -> Result<(), Failure> {
    let at_hand = at_hand();
    // Where addresses are few, what threads set aside counts.
    let pool = THREAD * POOL.load(Ordering::Relaxed) as u128;
    let needed = needed + addresses().map_or(0, |_| OWN + pool);
    if needed <= at_hand {
        return Ok(());
    }
    let (needed, at_hand) = (size(needed), size(at_hand));
    Err(Failure::input(format!(
        "{option}: about {needed} of memory are needed and {at_hand} are at hand; {remedy}"
    )))
}

/// Memory that results, figures and documents need at least, in MiB: measured, with a little room.
pub const RESULTS: u128 = 256;

/// Refuses a verb, or a part of one, that needs at least so many MiB, where there are fewer.
pub fn least(mib: u128, what: &str) -> Result<(), Failure> {
    memory(mib << 20, what, MEMORY)
}

/// What any verb takes at least, in MiB: asked for before there is a second thread.
pub const BEGIN: u128 = 16;

/// Addresses of the threads besides those that compute (of the verb, of the signals, of the signs of life), and once what
/// the system takes for a moment to align a heap.
const OWN: u128 = 3 * THREAD + HEAP;

/// What the system sets aside for the heap of a thread.
const HEAP: u128 = 64 << 20;

/// Addresses that a thread takes besides: its stack and its heap.
pub const THREAD: u128 = STACK as u128 + HEAP;

/// Stack of a thread that works, in bytes: the system, or RUST_MIN_STACK, may give less.
pub const STACK: usize = 8 << 20;

/// Stack of a thread that only waits and tells: RUST_MIN_STACK may ask for more than there is.
const SMALL: usize = 1 << 20;

/// What a shell calls a program that Ctrl-C ended: 128 + SIGINT.
const INTERRUPTED: u8 = 130;

/// The flag of the work under way.
static WORK: OnceLock<Arc<AtomicBool>> = OnceLock::new();

/// How long work may take to see its flag.
const PATIENCE: Duration = Duration::from_millis(700);

/// From now on Ctrl-C (SIGTERM, or the end of the terminal) raises the flag that work with [`Progress`] looks at; without such
/// work, or the second time, it ends the program at once. Always with exit code 130.
pub fn obey_signals() {
    let end = || -> ! {
        remove_empty(&MADE.lock().unwrap_or_else(PoisonError::into_inner));
        for path in TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).iter() {
            // Again, should the work that goes on have saved something meanwhile.
            let gone = || std::fs::remove_dir_all(path).or_else(|_| std::fs::remove_file(path));
            let _ = (0..9).any(|_| gone().is_ok());
        }
        // Standard error may wait for a reader for ever.
        let (tells, told) = std::sync::mpsc::channel();
        let tell = move || {
            say("impact-paper: interrupted");
            let _ = tells.send(());
        };
        if std::thread::Builder::new().stack_size(SMALL).spawn(tell).is_ok() {
            let _ = told.recv_timeout(Duration::from_millis(200));
        }
        std::process::exit(i32::from(INTERRUPTED))
    };
    // A file that would grow past the limit of `ulimit -f` fails to be written, as on a full disk.
    #[cfg(unix)]
    let _ =
        signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::new(AtomicBool::new(false)));
    // Where memory ends in spite of all estimates, that is told and aborts.
    #[cfg(unix)]
    let _ = signal_hook::flag::register_conditional_shutdown(
        signal_hook::consts::SIGABRT,
        4,
        Arc::new(AtomicBool::new(true)),
    );
    let is = |now| *NOW.lock().unwrap_or_else(PoisonError::into_inner) == now;
    // A handler can only be refused if there is one already; then a signal just ends the program.
    let obey = move || {
        if let Some(stop) = WORK.get()
            && !is(Now::Idle)
            && !stop.swap(true, Ordering::Relaxed)
        {
            std::thread::sleep(PATIENCE);
        }
        loop {
            // Held to the end, so that no file is moved meanwhile.
            let now = NOW.lock().unwrap_or_else(PoisonError::into_inner);
            if *now != Now::Placing {
                end();
            }
            drop(now);
            while is(Now::Placing) {
                std::thread::sleep(Duration::from_millis(10));
            }
            // All is in its place: what is left is to tell of it.
            std::thread::sleep(PATIENCE);
        }
    };
    #[cfg(not(unix))]
    let _ = ctrlc::set_handler(obey);
    #[cfg(unix)]
    on_signals(obey);
}

/// Calls `obey` at each signal that ends programs, but for what the caller has ignored: `nohup` does.
#[cfg(unix)]
fn on_signals(obey: impl Fn() + Send + 'static) {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let hangup = (!is_ignored(SIGHUP)).then_some(SIGHUP);
    let signals = signal_hook::iterator::Signals::new(hangup.into_iter().chain([SIGINT, SIGTERM]));
    let follow = |mut signals: signal_hook::iterator::Signals| {
        let thread = std::thread::Builder::new().stack_size(SMALL);
        thread.spawn(move || signals.forever().for_each(|_| obey()))
    };
    // Without, such a signal just ends the program.
    let _ = signals.and_then(follow);
}

/// Whether a signal was ignored when the program began; Linux tells it.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

/// What a signal has to know of the moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Now {
    /// Work is under way.
    Working,
    /// Text is printed, and may wait for a reader for ever: the first signal ends the program.
    Idle,
    /// Files are moved into place, which is a matter of moments: the signal waits.
    Placing,
}

static NOW: Mutex<Now> = Mutex::new(Now::Working);

/// As long as this lives, the moment is what it was said to be.
pub struct Moment(());

/// Says what the moment is.
pub fn moment(now: Now) -> Moment {
    *NOW.lock().unwrap_or_else(PoisonError::into_inner) = now;
    Moment(())
}

impl Drop for Moment {
    fn drop(&mut self) {
        *NOW.lock().unwrap_or_else(PoisonError::into_inner) = Now::Working;
    }
}

/// Folders that this run makes, the deepest first.
static MADE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Temporary files and folders of this run, which go with all that is in them.
static TEMPORARY: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Says that a signal which ends the program is to remove a file, or a folder with all that is in it.
pub fn temporary(path: &Path) {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner).push(path.into());
}

/// At the end of this, and of the program, what was made and left empty is removed.
#[derive(Debug)]
pub struct Made(Vec<PathBuf>);

/// Says that a folder is about to be made, with those above it that are missing.
pub fn made(folder: &Path) -> Made {
    let missing = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
    let missing: Vec<PathBuf> = folder.ancestors().take_while(missing).map(PathBuf::from).collect();
    MADE.lock().unwrap_or_else(PoisonError::into_inner).extend(missing.clone());
    Made(missing)
}

impl Drop for Made {
    fn drop(&mut self) {
        remove_empty(&self.0);
        let own: HashSet<&PathBuf> = self.0.iter().collect();
        MADE.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| !own.contains(path));
    }
}

fn remove_empty(folders: &[PathBuf]) {
    for folder in folders {
        // Fails, as it should, if the folder is not empty.
        let _ = std::fs::remove_dir(folder);
    }
}

/// Progress on stderr of work that a signal ends within a moment. What has not looked at the flag by then, such as a
/// chain of many masses, is ended all the same.
pub fn progress() -> Progress {
    Progress::on_stderr(Arc::clone(WORK.get_or_init(Arc::default)))
}

/// Threads for each core that may be asked for: more share the same cores, and cost memory.
const THREADS_A_CORE: usize = 4;

/// Cores at hand.
pub fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// The variables by which the library of threads takes their number.
const THREADS: [&str; 2] = ["RAYON_NUM_THREADS", "RAYON_RS_NUM_CPUS"];

/// Reads a number of threads, no more than work can use: as a parser of `--threads`, before there is any work.
pub fn threads(text: &str) -> Result<usize, String> {
    let threads = text.parse().map_err(|error: ParseIntError| error.to_string())?;
    let most = THREADS_A_CORE * cores();
    if (1..=most).contains(&threads) {
        return Ok(threads);
    }
    let bound = format!("give 1 to {most}, {THREADS_A_CORE} for each core");
    Err(format!("{threads} threads are not allowed; {bound}"))
}

/// Holds the environment to the bounds that options have. What is no number, or none, is passed over by who reads it.
pub fn environment() -> Result<(), Failure> {
    THREADS.into_iter().try_for_each(|name| match std::env::var(name) {
        Ok(text) if text.parse().is_ok_and(|n: usize| n > 0) => {
            threads(&text).map(drop).map_err(|what| Failure::input(format!("{name}: {what}")))
        }
        _ => Ok(()),
    })
}

/// Threads of the pool under way.
static POOL: AtomicUsize = AtomicUsize::new(0);

/// Runs `work` on that many threads; none means all cores.
pub fn on_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let number = threads.or_else(of_environment).unwrap_or_else(cores);
    POOL.store(number, Ordering::Relaxed);
    least(BEGIN, "the threads")?;
    let builder = rayon::ThreadPoolBuilder::new().num_threads(number).stack_size(STACK);
    let pool = builder.build().map_err(|error| {
        Failure::input(format!("--threads: {error}; give a smaller number of threads"))
    })?;
    let result = pool.install(work);
    POOL.store(0, Ordering::Relaxed);
    result
}

/// The number of threads that the environment asks for.
fn of_environment() -> Option<usize> {
    let number = |name| std::env::var(name).ok()?.parse().ok().filter(|&n: &usize| n > 0);
    THREADS.into_iter().find_map(number)
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match &error {
            Error::Interrupted => INTERRUPTED,
            Error::Store { source, .. } => Failure::io_code(source),
            Error::Input { .. } | Error::Foreign { .. } => 2,
            Error::Failed { source, .. } if is_input(source.as_ref()) => 2,
            Error::Stale { .. } | Error::Units { .. } | Error::NotUnderstood { .. } => 3,
            _ => 4,
        };
        Failure { code, message: error.to_string() }
    }
}

/// Whether a run was refused for what it was given.
fn is_input(error: &(dyn std::error::Error + Send + Sync + 'static)) -> bool {
    matches!(error.downcast_ref(), Some(dynamics::Error::Input { .. }))
}

impl From<claims::Error> for Failure {
    fn from(error: claims::Error) -> Self {
        match error {
            claims::Error::Published(error) => Failure::input(error.to_string()),
            claims::Error::Experiment(error) => error.into(),
        }
    }
}

impl From<contents::Error> for Failure {
    fn from(error: contents::Error) -> Self {
        match error {
            contents::Error::Claims(error) => error.into(),
            contents::Error::Experiment(error) => error.into(),
            contents::Error::Report(error) => error.into(),
            contents::Error::Rows(_) | contents::Error::Missing(_) => {
                Failure::run(error.to_string())
            }
        }
    }
}

impl From<figures::Error> for Failure {
    fn from(error: figures::Error) -> Self {
        let told = error.to_string();
        match error {
            figures::Error::Data(error) => error.into(),
            _ => Failure::run(told),
        }
    }
}

impl From<report::Error> for Failure {
    fn from(error: report::Error) -> Self {
        use report::Error::{Lint, NotShown, Unused};
        use report::lint::Fault;
        match error {
            Lint(ref found) if !found.iter().all(|one| matches!(one.fault, Fault::Numeral(_))) => {
                Failure::input(error.to_string())
            }
            // What can be read, and breaks a rule of the prose.
            Lint(_) | NotShown(_) | Unused(_) => Failure::check(error.to_string()),
            _ => Failure::input(error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_that_were_made_and_left_empty_go() {
        let folder = tempfile::tempdir().unwrap();
        let [new, below] = ["new", "new/below"].map(|name| folder.path().join(name));
        for (file, left) in [("", false), ("kept", true)] {
            let made = made(&below);
            std::fs::create_dir_all(&below).unwrap();
            if left {
                std::fs::write(new.join(file), "").unwrap();
            }
            drop(made);
            assert_eq!((new.exists(), below.exists()), (left, false));
        }
        assert!(folder.path().exists());
    }
}
