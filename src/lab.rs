//! Writes lab.js, which a page loads to compute: the engine, results, and the script.

use crate::experiments::ensembles::find_ensemble;
use crate::experiments::rise::{Mean, RisePoint};
use crate::experiments::{MODE_JUMP, PROTOCOL, REPLAY, Results, Session, sweep};
use impact_numerics::statistics::count_quantile;
use literate::{Failure, input};
use serde_json::json;

/// The engine as WebAssembly, where `.ci/module` has put it.
const MODULE: &str = "target/page.wasm";

/// Returns the file, or `None` without the engine.
pub fn lab(session: &Session<'_>, results: &Results) -> Result<Option<String>, Failure> {
    let bytes = session.project.find(MODULE).and_then(|path| input::read_file(&path).ok());
    match bytes.filter(|module| module.starts_with(b"\0asm")) {
        Some(module) => {
            let files = session.templates.iter().filter(|(path, _)| path.starts_with("lab/"));
            let code: String = files.map(|(_, text)| text).collect();
            Ok(Some(script(&module, results, &code)?))
        }
        None => {
            let problem = "is missing or not WebAssembly, so the pages cannot run the engine; `make paper` builds it";
            session.progress.say(&format!("{MODULE} {problem}"));
            Ok(None)
        }
    }
}

/// Returns the file, of the module in WebAssembly, results and the script.
pub fn script(module: &[u8], results: &Results, script: &str) -> Result<String, Failure> {
    let (replays, sweep) = (results.of(&REPLAY)?, sweep::main_sweep(results)?);
    let runs = replays.parameters.iter().zip(&replays.results);
    let runs: Vec<_> = runs
        .map(|((name, request), result)| json!({ "name": name, "asked": request, "found": result }))
        .collect();
    // To a hundredth of a gap, which no eye sees.
    let round = |mean: Option<Mean>| mean.map(|mean| (mean.value * 100.0).round() / 100.0);
    let row = |row: &RisePoint| {
        let [low, high] = [0.05, 0.95].map(|share| count_quantile(&row.counts, share).unwrap_or(0));
        (row.sigma, round(row.mean_all), round(row.mean), low, high)
    };
    let rows: Vec<_> = sweep.comparable().map(row).collect();
    let (gaps, half) = (sweep.ensemble.chain.gaps(), sweep.first_curve().rise.half_height);
    let map = find_ensemble(results.of(&PROTOCOL)?, PROTOCOL.name);
    let protocols = map.iter().flat_map(|map| &map.curves).map(|curve| {
        let rows: Vec<_> = curve.rows.iter().map(row).collect();
        json!({ "protocol": curve.protocol, "half": curve.rise.half_height, "rows": rows })
    });
    let jumps = results.of(&MODE_JUMP)?.windows.iter().map(|window| {
        let passing = &window.jump.all_gaps;
        json!({ "protocol": window.protocol, "sigma": passing.sigma, "jumps": passing.is_jump() })
    });
    let data = json!({
        "runs": runs, "curve": { "gaps": gaps, "half": half, "rows": rows },
        "protocols": protocols.collect::<Vec<_>>(), "jumps": jumps.collect::<Vec<_>>(), "module": base64(module),
    });
    Ok(format!("\"use strict\";\nconst LAB = {data};\n{{\n{script}}}\n"))
}

/// Encodes bytes in Base64 with padding (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut digits = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let mut word = [0; 4];
        word[1..=chunk.len()].copy_from_slice(chunk);
        for i in 0..4 {
            let letter = LETTERS[(u32::from_be_bytes(word) >> (18 - 6 * i) & 63) as usize];
            digits.push(if i <= chunk.len() { letter as char } else { '=' });
        }
    }
    digits
}
