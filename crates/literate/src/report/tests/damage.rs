//! Damages each text that a report is made of or reads back: no reader panics or hangs.

use super::damaged::survives;
use super::*;
use crate::input::one_line;

const MORE: &str = "\n\n## Sec {#sec:a}\n\nMasses ([@rice1945]; see [@eq:18] and [@sec:a]) move *fast*, [here](x.md):\n\n\
    $$\np_{\\mathrm{crit}} = \\left(\\frac{1 + \\sqrt{N+1}}{«v.tiny | significant(digits=3)»}\\right)^2\n$$\n\n\
    | Check | Ours |\n|:--|--:|\n<% for c in [\"a\", \"b\"] %>| «c» | «v.tiny | percent» |\n<% endfor %>\n";

fn line<T>(read: Result<T, Error>) -> Result<(), String> {
    read.map(drop).map_err(|error| one_line(&error.to_string(), 1000))
}

#[test]
fn no_reader_panics_or_hangs() {
    let report = assembled(PROSE).unwrap();
    survives("prose", format!("{PROSE}{MORE}"), 200, |text| line(assembled(text)));
    survives("references.bib", BIB.into(), 100, |text| line(bibliography::Library::read(text)));
    survives("values.json", file(&report, "values.json"), 100, |text| line(values::read(text)));
    survives("ledger.json", file(&report, "ledger.json"), 100, |text| line(ledger::read(text)));
    let sums = |text: &str| folder::read_sums(text).map(drop).ok_or_else(String::new);
    survives("SHA256SUMS", file(&report, "SHA256SUMS"), 1000, sums);
}
