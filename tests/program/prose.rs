//! Faults of the templates, each told with its file and line.

use crate::{QUICK, templates};

/// What is wrong with a file of the templates, and what is said behind its name: text in the place of other text, or lines
/// at its end (`+`; $ is the last line).
const FAULTS: &str = r##"2 front.md +«v.p | nofilter» => :$:
1 front.md +About 12 of them. => :$:7: the naked numeral 12
2 front.md +It is «sweep.rise.half_heigth». => :$:
2 literals.toml why = "what the model is -> why = " " # => : [
2 published.toml [[statement]] -> [[statement => :
2 published.toml printed = "N − 1" -> printed = "N − 2" => :385: the id "sec7_limit": its check judges "N − 1", and not its printed
2 published.toml "sec2_half_height" -> "sec2_new" => : no statement "sec2_half_height""##;

#[test]
fn faults_of_the_prose_are_told_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    for line in FAULTS.lines() {
        let (given, says) = line.split_once(" => ").unwrap();
        let [expected, file, fault] = given.splitn(3, ' ').collect::<Vec<_>>().try_into().unwrap();
        let _ = std::fs::remove_dir_all(here.join("t"));
        templates(&here.join("t"), file, |text| match fault.split_once(" -> ") {
            Some((from, to)) => text.replacen(from, to, 1),
            None => format!("{}\n\n{}\n", text.trim_end(), &fault[1..]),
        });
        let (code, told, note) =
            crate::run(here, "paper --profile quick --out p --results r --templates t");
        let text = std::fs::read_to_string(here.join("t").join(file)).unwrap();
        let says = format!("{file}{}", says.replace('$', &text.lines().count().to_string()));
        let line = note.lines().last().unwrap();
        assert!(code.to_string() == expected && line.contains(&says), "{says}: {told}{note}");
    }
    // A copy of a section that an editor left, and a section that is lost.
    let edition = here.join("t/edition");
    std::fs::copy(edition.join("12-limits.md"), edition.join("12-limits copy.md")).unwrap();
    crate::refused(
        here,
        "check --profile quick --results r --templates t",
        &["edition/12-", "13-name.md"],
    );
    std::fs::remove_file(edition.join("12-limits copy.md")).unwrap();
    std::fs::remove_file(edition.join("12-limits.md")).unwrap();
    crate::refused(
        here,
        "check --profile quick --results r --templates t",
        &["edition/13-", "12-name.md"],
    );
}
