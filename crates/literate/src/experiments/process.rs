//! Runs other programs, and ends them and what they started: at their end, and with this one.

use super::Progress;
use crate::input::is_control;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::time::Duration;

/// The ids of the process groups of the programs that run.
static RUNNING: Mutex<Vec<u32>> = Mutex::new(Vec::new());

/// MiB that a program may print on standard output, and on standard error.
const MOST: u64 = if cfg!(test) { 1 } else { 256 };

/// Bytes of standard error that are kept, the last ones.
const KEPT: usize = 64 << 10;

/// Runs a program that reads a text; `hear` gets each line of its standard error at once, and says
/// whether to keep it. Returns what it printed and these lines; an error names no program.
pub(super) fn run(
    command: &mut Command,
    text: String,
    hear: impl FnMut(&str) -> bool + Send,
) -> Result<(Vec<u8>, String), String> {
    let cannot = |error| format!("cannot be started: {error}; install it, or correct the command");
    let mut guard = guard().map_err(cannot)?;
    let group = guard.id();
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let started = command.process_group(group.cast_signed()).spawn();
    let mut child = started.inspect_err(|_| drop(guard.wait())).map_err(cannot)?;
    running().push(group);
    let (input, output, errors) = (child.stdin.take(), child.stdout.take(), child.stderr.take());
    let mut printed = Vec::new();
    let (status, errors, is_full) = std::thread::scope(|threads| {
        // In threads, since a program may write much before it reads.
        threads.spawn(|| input.map(|mut input| input.write_all(text.as_bytes())));
        threads.spawn(|| {
            let _ = output.map(|output| output.take((MOST << 20) + 1).read_to_end(&mut printed));
            if printed.len() as u64 > MOST << 20 {
                send("KILL", group);
            }
        });
        let errors = threads.spawn(|| {
            let mut stream = errors.map(|errors| errors.take(MOST << 20));
            let lines = stream.as_mut().map(|stream| lines_of(stream, hear));
            let is_full = stream.is_some_and(|stream| stream.limit() == 0);
            if is_full {
                send("KILL", group);
            }
            (lines.unwrap_or_default(), is_full)
        });
        let status = child.wait();
        // After a signal its children may take some time to end.
        if !Progress::silent().stopped() {
            let _ = guard.wait();
        }
        let (errors, is_full) = errors.join().unwrap_or_default();
        (status, errors, is_full)
    });
    let _ = guard.wait();
    running().retain(|other| *other != group);
    match status {
        _ if is_full || printed.len() as u64 > MOST << 20 => {
            Err(format!("printed more than {MOST} MiB; print less, or write a file in `writes`"))
        }
        Ok(status) if status.success() => Ok((printed, errors)),
        Ok(status) if errors.is_empty() => Err(format!("ended with {status}; it said nothing")),
        Ok(status) => Err(format!("ended with {status}; it said:\n{}", errors.trim_end())),
        Err(error) => Err(cannot(error)),
    }
}

/// Starts a shell that leads a process group, and kills it with all programs in it as soon as its
/// standard input is closed: when it is waited for, or when this program ends in whatever way.
fn guard() -> io::Result<Child> {
    let mut shell = Command::new("sh");
    shell.args(["-c", "trap '' HUP INT TERM; read -r end; kill -s KILL 0"]).process_group(0);
    shell.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null()).spawn()
}

/// Hands over each line, and returns the last of those that are to be kept.
fn lines_of(errors: impl Read, mut hear: impl FnMut(&str) -> bool) -> String {
    let mut errors = BufReader::new(errors);
    let (mut kept_lines, mut line) = (String::new(), Vec::new());
    let mut next = |line: &mut Vec<u8>| errors.by_ref().take(KEPT as u64).read_until(b'\n', line);
    while next(&mut line).is_ok_and(|length| length > 0) {
        let line_text = String::from_utf8_lossy(&line);
        // A bar of progress writes over itself: its last state counts.
        let line_text = line_text.trim_end().rsplit('\r').next().unwrap_or_default();
        let line_text = line_text.replace(is_control, " ");
        if hear(&line_text) {
            kept_lines.extend([&line_text, "\n"]);
        }
        if kept_lines.len() > KEPT {
            kept_lines.drain(..kept_lines.ceil_char_boundary(kept_lines.len() - KEPT / 2));
        }
        line.clear();
    }
    kept_lines
}

fn running() -> std::sync::MutexGuard<'static, Vec<u32>> {
    RUNNING.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Asks all programs that run to end, and kills those that have not ended after some seconds.
pub(crate) fn end_all() {
    running().iter().for_each(|group| send("TERM", *group));
    for _ in 0..200 {
        if running().is_empty() {
            return;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    running().iter().for_each(|group| send("KILL", *group));
}

/// Sends a signal to a program that runs and to those that it started.
fn send(signal: &str, group: u32) {
    // The shell's `kill`, since not every system has a program of that name.
    let line = format!("kill -s {signal} -- -{group}");
    let _ = Command::new("sh").args(["-c", &line]).stderr(Stdio::null()).status();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn its_children_end_with_it_and_what_it_writes_is_bounded() {
        let sh = |line| {
            run(Command::new("sh").args(["-c", line]), String::new(), |line| line != "not kept")
        };
        assert_eq!(sh("(sleep 2; echo late) & echo early").unwrap().0, b"early\n");
        for endless in ["trap '' PIPE; yes", "trap '' PIPE; yes >&2"] {
            assert!(sh(endless).unwrap_err().starts_with("printed more than 1 MiB;"));
        }
        let (_, said) = sh(r"printf 'first\nnot kept\n10 %%\r20 %%\r\nbell\a\n' >&2").unwrap();
        assert_eq!(said, "first\n20 %\nbell \n");
        let (_, said) = sh("yes σ | head -n 100000 >&2; echo last >&2").unwrap();
        assert!((KEPT / 4..=KEPT).contains(&said.len()) && said.ends_with("σ\nlast\n"), "{said}");
    }
}
