//! lab.js, which a page loads to compute: the engine, the results with which its runs are compared, and the script.

use crate::experiments::rise::{Mean, RisePoint};
use crate::experiments::sweep;
use crate::experiments::{REPLAY, Results, Session};
use literate::{Failure, input};
use serde_json::json;

/// The engine as WebAssembly, where `.ci/module` has put it: the machine may have no compiler for that.
const MODULE: &str = "target/page.wasm";

/// The file; none without the engine.
///
/// # Errors
/// If a result was not run, or the prose has no script.
pub fn lab(session: &Session<'_>, results: &Results) -> Result<Option<String>, Failure> {
    let found = session.paper.project.find(MODULE).and_then(|path| input::regular(&path).ok());
    match found.filter(|module| module.starts_with(b"\0asm")) {
        Some(module) => Ok(Some(script(&module, results, session.templates.text("lab.js")?)?)),
        None => {
            let what =
                "is not there or no module, so the pages run nothing; `make paper` builds it";
            session.progress.say(&format!("{MODULE} {what}"));
            Ok(None)
        }
    }
}

/// The file, from the module in WebAssembly and the script.
fn script(module: &[u8], results: &Results, script: &str) -> Result<String, Failure> {
    let (replays, sweep) = (results.of(&REPLAY)?, sweep::main(results)?);
    let runs = replays.parameters.iter().zip(&replays.found);
    let runs: Vec<_> = runs
        .map(|((name, asked), found)| json!({ "name": name, "asked": asked, "found": found }))
        .collect();
    let value = |mean: Option<Mean>| mean.map(|mean| mean.value);
    let row = |row: &RisePoint| {
        let [low, high] = [0.05, 0.95].map(|share| quantile(&row.counts, share));
        (row.sigma, value(row.mean_all), value(row.mean), low, high)
    };
    let rows: Vec<_> = sweep.comparable().map(row).collect();
    let gaps = sweep.ensemble.chain.gaps();
    let data =
        json!({ "runs": runs, "curve": { "gaps": gaps, "rows": rows }, "module": base64(module) });
    Ok(format!("\"use strict\";\nconst LAB = {data};\n{script}"))
}

/// The smallest k such that at least this share of the realisations count k or fewer; `counts` are their numbers by k.
fn quantile(counts: &[u32], share: f64) -> usize {
    let all: u32 = counts.iter().sum();
    let sums = counts.iter().scan(0, |sum, count| {
        *sum += count;
        Some(*sum)
    });
    sums.take_while(|sum| f64::from(*sum) < share * f64::from(all)).count()
}

/// Base64 with padding (RFC 4648).
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            out.push(if i <= chunk.len() { letter as char } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::{REPLAY, SWEEP, quick};

    #[test]
    fn the_page_has_each_run_with_its_digest_and_the_module() {
        let results = quick(&[&SWEEP, &REPLAY]);
        let text = script(b"foobar", &results, "end();").unwrap();
        let data = text.split("const LAB = ").nth(1).unwrap().strip_suffix(";\nend();").unwrap();
        let data: serde_json::Value = serde_json::from_str(data).unwrap();
        assert_eq!(data["module"], "Zm9vYmFy");
        let replays = results.of(&REPLAY).unwrap();
        assert_eq!(data["runs"].as_array().unwrap().len(), replays.found.len());
        for (i, found) in replays.found.iter().enumerate() {
            assert_eq!(data["runs"][i]["found"]["digest"], found.digest.as_str());
            let asked = serde_json::from_value(data["runs"][i]["asked"].clone());
            let asked: impact_chain::replay::Asked = asked.unwrap();
            assert_eq!(asked, replays.parameters[i].1);
        }
    }
}
