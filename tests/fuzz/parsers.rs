//! Any bytes for one of the parsers, which the variable PARSER names (see entries.rs): none may panic,
//! hang or take more memory than its input allows. `.ci/fuzz` runs it.

#![no_main]

#[path = "../report/parsers/entries.rs"]
mod entries;

use entries::{ALL, Parser};
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

static PARSER: LazyLock<Parser> = LazyLock::new(|| {
    let name = std::env::var("PARSER").unwrap_or_default();
    let found = ALL.iter().find(|(known, _)| *known == name);
    found.unwrap_or_else(|| panic!("PARSER={name}: name one of ALL in entries.rs")).1
});

fuzz_target!(|bytes: &[u8]| {
    let text = String::from_utf8_lossy(bytes);
    if let Err(line) = PARSER(&text) {
        assert!(line.lines().count() <= 1, "{line:?}");
    }
});
