//! Damages a valid text in a seeded way: no reader of text from outside may panic or hang.

use impact_numerics::random::{Seed, generator};
use rand::RngExt;
use std::{fmt::Display, sync::mpsc::channel, time::Duration};

/// What is put in anywhere: signs that mean something, numbers, and what can be nested.
const SIGNS: &str = "{~}~[~]~(~)~\"~\\~,~=~\n\n~\r~\0~#~$~$$~```~*~|~> ~- ~«~»~«(~<% if true %>~<!--~[@~![~\
                     {\"a\":~\\sqrt{~\u{e000}~\u{2028}~NaN~-1e309~99999999999999999999~5e-324";

fn damaged(name: &str, index: u64, good: &str) -> String {
    let mut random = generator(name, Seed(1), index);
    let signs: Vec<&str> = SIGNS.split('~').collect();
    let mut bytes = good.as_bytes().to_vec();
    for _ in 0..random.random_range(1..4) {
        let offset = random.random_range(0..=bytes.len());
        let end = (offset + random.random_range(0..40)).min(bytes.len());
        match random.random_range(0..5) {
            0 if offset < bytes.len() => bytes[offset] ^= 1 << random.random_range(0..8),
            1 => drop(bytes.drain(offset..end)),
            2 if random.random_bool(0.2) => bytes.truncate(offset),
            3 => drop(bytes.splice(offset..offset, bytes[offset..end].to_vec())),
            _ => {
                let times = if random.random_bool(0.1) { 1000 } else { 1 };
                let sign = signs[random.random_range(0..signs.len())];
                drop(bytes.splice(offset..offset, sign.repeat(times).bytes()));
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Gives a reader the valid text and so many damaged ones.
pub fn survives<T: 'static, E: Display + 'static>(
    name: &str,
    good: &str,
    count: u64,
    read: fn(&str) -> Result<T, E>,
) {
    let read = move |text: &str| read(text).err().map(|error| error.to_string());
    assert_eq!(read(good), None, "{name}");
    let texts: Vec<String> = (0..count).map(|index| damaged(name, index, good)).collect();
    let (sender, outcomes) = channel();
    let given = texts.clone();
    std::thread::spawn(move || given.iter().all(|text| sender.send(read(text)).is_ok()));
    for text in texts {
        let outcome = outcomes.recv_timeout(Duration::from_secs(60));
        outcome.unwrap_or_else(|_| panic!("{name} panics or hangs: {text}"));
    }
}
