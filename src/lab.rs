//! Writes lab.js, which a page loads to compute: the engine, results, and the script.

use crate::experiments::rise::{Mean, RisePoint};
use crate::experiments::sweep;
use crate::experiments::{REPLAY, Results, Session};
use impact_numerics::statistics::count_quantile;
use literate::{Failure, input};
use serde_json::json;

/// The engine as WebAssembly, where `.ci/module` has put it.
const MODULE: &str = "target/page.wasm";

/// The file; none without the engine.
pub fn lab(session: &Session<'_>, results: &Results) -> Result<Option<String>, Failure> {
    let found = session.project.find(MODULE).and_then(|path| input::regular(&path).ok());
    match found.filter(|module| module.starts_with(b"\0asm")) {
        Some(module) => Ok(Some(script(&module, results, session.templates.text("lab.js")?)?)),
        None => {
            let what = "is missing or not WebAssembly, so the pages cannot run the engine; `make paper` builds it";
            session.progress.say(&format!("{MODULE} {what}"));
            Ok(None)
        }
    }
}

/// The file, from the module in WebAssembly and the script.
pub fn script(module: &[u8], results: &Results, script: &str) -> Result<String, Failure> {
    let (replays, sweep) = (results.of(&REPLAY)?, sweep::main(results)?);
    let runs = replays.parameters.iter().zip(&replays.found);
    let runs: Vec<_> = runs
        .map(|((name, asked), found)| json!({ "name": name, "asked": asked, "found": found }))
        .collect();
    let value = |mean: Option<Mean>| mean.map(|mean| mean.value);
    let row = |row: &RisePoint| {
        let [low, high] = [0.05, 0.95].map(|share| count_quantile(&row.counts, share).unwrap_or(0));
        (row.sigma, value(row.mean_all), value(row.mean), low, high)
    };
    let rows: Vec<_> = sweep.comparable().map(row).collect();
    let gaps = sweep.ensemble.chain.gaps();
    let data =
        json!({ "runs": runs, "curve": { "gaps": gaps, "rows": rows }, "module": base64(module) });
    Ok(format!("\"use strict\";\nconst LAB = {data};\n{script}"))
}

/// Base64 with padding (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let mut word = [0; 4];
        word[1..=chunk.len()].copy_from_slice(chunk);
        for i in 0..4 {
            let letter = LETTERS[(u32::from_be_bytes(word) >> (18 - 6 * i) & 63) as usize];
            out.push(if i <= chunk.len() { letter as char } else { '=' });
        }
    }
    out
}
