//! Writes lab.js, which a page loads to compute: the engine, results, and the script.

use crate::experiments::ensembles::named;
use crate::experiments::rise::{Curve, Mean, RisePoint};
use crate::experiments::{JUMP, PROTOCOL, REPLAY, Results, Session, sweep};
use crate::params::printed_threshold;
use impact_numerics::statistics::count_quantile;
use literate::{Failure, input};
use serde_json::json;

/// The engine as WebAssembly, where `.ci/module` has put it.
const MODULE: &str = "target/page.wasm";

/// The file; none without the engine.
pub fn lab(session: &Session<'_>, results: &Results) -> Result<Option<String>, Failure> {
    let found = session.project.find(MODULE).and_then(|path| input::regular(&path).ok());
    match found.filter(|module| module.starts_with(b"\0asm")) {
        Some(module) => {
            let files = |ending| {
                let files = session.templates.iter();
                let own =
                    files.filter(|(path, _)| path.starts_with("lab/") && path.ends_with(ending));
                own.map(|(_, text)| text).collect()
            };
            let [style, code] = [".css", ".js"].map(files);
            Ok(Some(script(&module, results, [style, code])?))
        }
        None => {
            let what = "is missing or not WebAssembly, so the pages cannot run the engine; `make paper` builds it";
            session.progress.say(&format!("{MODULE} {what}"));
            Ok(None)
        }
    }
}

/// The file, from the module in WebAssembly, a style sheet and the script.
pub fn script(
    module: &[u8],
    results: &Results,
    [style, code]: [String; 2],
) -> Result<String, Failure> {
    let (replays, sweep) = (results.of(&REPLAY)?, sweep::main(results)?);
    let runs = replays.parameters.iter().zip(&replays.found);
    let runs: Vec<_> = runs
        .map(|((name, asked), found)| json!({ "name": name, "asked": asked, "found": found }))
        .collect();
    let row = |row: &RisePoint| {
        let [low, high] = [0.05, 0.95].map(|share| count_quantile(&row.counts, share).unwrap_or(0));
        (row.sigma, value(row.mean_all), value(row.mean), low, high)
    };
    let rows: Vec<_> = sweep.comparable().map(row).collect();
    let curve = json!({ "gaps": sweep.ensemble.chain.gaps(), "half": sweep.first().rise.half_height, "rows": rows });
    let protocols = named(results.of(&PROTOCOL)?, PROTOCOL.name).map_or(&[][..], |map| &map.curves);
    let protocols: Vec<_> = protocols.iter().map(protocol).collect();
    let jumps: Vec<_> = results.of(&JUMP)?.windows.iter().map(|window| {
        let passing = &window.jump.all_gaps;
        json!({ "protocol": window.protocol, "sigma": passing.sigma, "jumps": passing.is_jump() })
    }).collect();
    let data = json!({
        "runs": runs, "curve": curve, "protocols": protocols, "jumps": jumps, "printed": printed_threshold(),
        "module": base64(module), "style": style,
    });
    Ok(format!("\"use strict\";\nconst LAB = {data};\n{{\n{code}}}\n"))
}

/// The mean number of gaps of a window against σ: of all chains, and of those with an impact.
fn protocol(curve: &Curve) -> serde_json::Value {
    let row = |row: &RisePoint| (row.sigma, value(row.mean_all), value(row.mean));
    let rows: Vec<_> = curve.rows.iter().map(row).collect();
    json!({ "protocol": curve.protocol, "half": curve.rise.half_height, "rows": rows })
}

/// A mean to a hundredth of a gap, which no eye sees.
fn value(mean: Option<Mean>) -> Option<f64> {
    mean.map(|mean| (mean.value * 100.0).round() / 100.0)
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
