//! Text that is nearly right, and what a parser must do with it.

use impact_paper::numerics::random::generator;
use rand::{Rng, RngExt};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::channel;
use std::time::Duration;

/// Whether a refusal is one line that is not too long.
pub fn is_one_line(text: &str) -> bool {
    !text.contains(char::is_control) && text.len() <= 2000
}

/// Longer than this over one file of some kilobytes is a hang.
const HANG: Duration = Duration::from_secs(60);

pub fn committed(path: &str) -> String {
    std::fs::read_to_string(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// What stands where a number stood.
const NUMBERS: &str = r#"0 -0 -1 1 1e308 -1e308 1e309 1e-309 5e-324 NaN nan inf -inf null "1" 99999999999999999999
    -9223372036854775808 18446744073709551615 4294967296 2147483647 65536 1.7976931348623157e308
    0x10 1_000 1e-5 007"#;

/// What is put in anywhere: characters that mean something to one of the parsers.
const TOKENS: [&str; 48] = [
    "{", "}", "[", "]", "(", ")", "\"", "'", "\\", ",", ":", "=", "\n", "\n\n", "\r", "\t", "\0",
    "#", "$", "$$", "`", "```", "*", "_", "|", ">", "<", "«", "»", "<%", "%>", "<#", "#>", "<!--",
    "-->", "[@", "[!", "![", "\u{e000}", "\u{e001}", "\u{e002}", "\u{2028}", "\u{feff}", "ﬁ", "𝛔",
    "@", "\\tag{", "~",
];

/// What is nested.
const NESTS: [(&str, &str); 16] = [
    ("[", "]"),
    ("{", "}"),
    ("(", ")"),
    ("{\"a\":", "}"),
    ("\n> ", ""),
    ("> ", ""),
    ("- ", ""),
    ("*a ", " a*"),
    ("**", "**"),
    ("_a ", " a_"),
    ("$\\frac{", "}{1}$"),
    ("\\sqrt{", "}"),
    ("«(", ")»"),
    ("«[", "]»"),
    ("<% if true %>", "<% endif %>"),
    ("[a", "](b)"),
];

fn pick<'a, T>(random: &mut impl Rng, from: &'a [T]) -> &'a T {
    &from[random.random_range(0..from.len())]
}

/// A place in the bytes, and one behind it that is mostly near.
fn range(random: &mut impl Rng, bytes: &[u8]) -> std::ops::Range<usize> {
    let from = random.random_range(0..=bytes.len());
    let most = if random.random_bool(0.8) { 40 } else { bytes.len() };
    from..random.random_range(from..=bytes.len().min(from + most))
}

/// One change of `bytes`; parts of `others` may come in.
fn change(random: &mut impl Rng, bytes: &mut Vec<u8>, others: &[String]) {
    let at = random.random_range(0..=bytes.len());
    match random.random_range(0..9) {
        0 if at < bytes.len() => bytes[at] ^= 1 << random.random_range(0..8),
        1 => drop(bytes.drain(range(random, bytes))),
        2 if random.random_bool(0.3) => bytes.truncate(at),
        3 => {
            let piece = bytes[range(random, bytes)].to_vec();
            let many = piece.len() < 500 && random.random_bool(0.1);
            let times = if many { 300 } else { 1 };
            bytes.splice(at..at, piece.repeat(times));
        }
        4 => {
            let other = pick(random, others).as_bytes();
            let piece = &other[range(random, other)];
            bytes.splice(at..at, piece.iter().copied());
        }
        5 | 6 => {
            // The first number behind the place.
            let digit = |b: &u8| b.is_ascii_digit();
            let Some(from) = bytes[at..].iter().position(digit).map(|i| at + i) else { return };
            let length =
                bytes[from..].iter().take_while(|b| digit(b) || b"+-.eE".contains(b)).count();
            let numbers: Vec<&str> = NUMBERS.split_whitespace().collect();
            let number = pick(random, &numbers).as_bytes();
            bytes.splice(from..from + length, number.iter().copied());
        }
        7 => drop(bytes.splice(at..at, pick(random, &TOKENS).bytes())),
        _ if random.random_bool(0.15) => {
            let (open, close) = pick(random, &NESTS);
            let depth = *pick(random, &[3, 30, 200, 5000]);
            let mut nest = open.repeat(depth);
            if random.random_bool(0.6) {
                nest.push('x');
                nest.push_str(&close.repeat(depth));
            }
            bytes.splice(at..at, nest.bytes());
        }
        _ => drop(bytes.splice(range(random, bytes), [random.random::<u8>()])),
    }
}

/// The text number `index` of those made of good ones: the first are the good ones themselves.
pub fn mutant(name: &str, index: usize, good: &[String]) -> String {
    if let Some(text) = good.get(index) {
        return text.clone();
    }
    let mut random = generator(name, 1, index as u64);
    let mut bytes = pick(&mut random, good).clone().into_bytes();
    for _ in 0..*pick(&mut random, &[1, 1, 1, 2, 4]) {
        change(&mut random, &mut bytes, good);
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Gives `parser` the good texts and so many made of them. It says what is refused; a refusal is
/// one line with this start.
pub fn survives(
    name: &'static str,
    good: &[String],
    count: usize,
    start: &str,
    parser: impl Fn(&str) -> Result<(), String> + Send + 'static,
) {
    let (tell, told) = channel();
    let texts = good.to_vec();
    // A thread as the report is made in: with 2 MiB of stack.
    std::thread::spawn(move || {
        for index in 0..count {
            let text = mutant(name, index, &texts);
            let result = catch_unwind(AssertUnwindSafe(|| parser(&text)));
            if tell.send(result).is_err() {
                return;
            }
        }
    });
    let (mut taken, mut refused, mut faults) = (0, 0, Vec::new());
    for index in 0..count {
        let fault = match told.recv_timeout(HANG) {
            Err(_) => Some("it hangs".to_string()),
            Ok(Err(_)) => Some("it panics".to_string()),
            Ok(Ok(Ok(()))) => {
                taken += 1;
                None
            }
            Ok(Ok(Err(line))) => {
                refused += 1;
                assert!(index >= good.len(), "{name}: good text {index} is refused: {line}");
                let fine = is_one_line(&line) && line.starts_with(start);
                (!fine)
                    .then(|| format!("is told as {:?}", line.chars().take(300).collect::<String>()))
            }
        };
        if let Some(fault) = fault {
            let file = std::env::temp_dir().join(format!("impact-paper-{name}-{index}"));
            let _ = std::fs::write(&file, mutant(name, index, good));
            let hangs = fault == "it hangs";
            faults.push(format!("{}: {fault}", file.display()));
            if hangs || faults.len() == 12 {
                break;
            }
        }
    }
    eprintln!("{name}: {taken} taken, {refused} refused");
    assert!(faults.is_empty(), "{name}:\n{}", faults.join("\n"));
    assert!(taken > good.len() && refused > count / 10, "{name}: the texts are all of one kind");
}
