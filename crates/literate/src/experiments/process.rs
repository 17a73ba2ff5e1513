//! Runs other programs, and ends them with this one.

use std::io::{self, Write};
use std::os::unix::process::CommandExt;
use std::process::{Command, Output, Stdio};
use std::sync::Mutex;
use std::time::Duration;

/// The ids of the programs that run, each of which leads a process group of the same id.
static RUNNING: Mutex<Vec<u32>> = Mutex::new(Vec::new());

pub(super) fn run(command: &mut Command, text: String) -> io::Result<Output> {
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.process_group(0);
    let mut child = command.spawn()?;
    let group = child.id();
    running().push(group);
    if let Some(mut input) = child.stdin.take() {
        // In a thread, since a program may write much before it reads.
        std::thread::spawn(move || drop(input.write_all(text.as_bytes())));
    }
    let output = child.wait_with_output();
    running().retain(|other| *other != group);
    output
}

fn running() -> std::sync::MutexGuard<'static, Vec<u32>> {
    RUNNING.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
}

/// Asks all programs that run to end, and kills those that have not ended after some seconds.
pub(crate) fn end_all() {
    send("TERM");
    for _ in 0..200 {
        if running().is_empty() {
            return;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    send("KILL");
}

/// Sends a signal to all programs that run and to those that they started.
fn send(signal: &str) {
    for group in running().iter() {
        // The shell's `kill`, since not every system has a program of that name.
        let line = format!("kill -s {signal} -- -{group}");
        let _ = Command::new("sh").args(["-c", &line]).stderr(Stdio::null()).status();
    }
}
