//! Faults of the templates, each told with its file and line.

use crate::{QUICK, templates};

/// What is wrong with a file of the templates, and what is said behind its name: lines at its end (`+`, with ¦ for line ends and ◀▶ for
/// characters of nobody), told with the last line; or words and others in their place.
const FAULTS: &str = r##"front.md +«v.p | nofilter» => :$:1: no template has a filter "nofilter", only percent
front.md +<% endfor %> => :$:4: Unknown tag endfor
front.md +«1 | percent» => :$:2: Invalid type for the value, expected text but got a number
report.tex +%◀ => :$:2: the character U+E000 is none of a text
literals.toml +[[literal]]¦why = "x"¦phrases = ["two nothings"] => :$: "two nothings": no prose has it
references.bib +@article{aa, title={b}} => :$: aa lacks its author
references.bib +@misc{aa, author={B}, title={b}, year={1999}} => :$: aa has the type @misc
references.bib volume  = {17} -> volume  = {17}, crossref = {homer2007} => :6: homer2007 has `crossref`
front.md +It is «sweep.rise.half_height now. => :$:7: « is not closed
front.md # -> ## => :1:1: a report begins with its title
published.toml value = 100 -> value = nan => :11: the id "masses": a text is empty
published.toml place = "Sec. 2" -> place = Sec. 2 => :12: this is neither a number nor text in quotes
published.toml place = "Sec. 2" -> place = "" => :11: the id "masses": a text is empty
published.toml printed = "n =  -> printed = "" # " => :116: the id "sec2_parameters": a text is empty
published.toml statement = "For small σ -> statement = "" # " => :122: the id "sec2_few_below": a text is empty
published.toml = "For small σ -> = "For small $σ => :122: the id "sec2_few_below": a text is empty
published.toml printed = "N − 1" -> printed = "N − 2" => :385: the id "sec7_limit": its check judges "N − 1", and not its printed
published.toml printed = "valid for k > 3" -> printed = "valid for k < 3" => :503: the id "sec9_eq35": its check judges "valid for k > 3", and not its printed
published.toml value = 0.12 -> value = 0.13 => :134: the id "sec2_half_height": its check judges "σ ≈ 0.13", and not its printed
published.toml "sec2_half_height" -> "sec2_few_below" => :134: the id "sec2_few_below": it stands twice
published.toml "sec2_half_height" -> "sec2_new" => :134: the id "sec2_new": no check judges it"##;

#[test]
fn faults_of_the_prose_are_told_with_their_place() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    crate::put(&here.join("r"), &QUICK.results);
    let made = |file: &str, fault: &str| {
        let _ = std::fs::remove_dir_all(here.join("t"));
        templates(&here.join("t"), file, |text| match fault.split_once(" -> ") {
            Some((from, to)) => text.replacen(from, to, 1),
            None => {
                let more = fault[1..].replace('¦', "\n");
                let more = more.replace('◀', "\u{e000}").replace('▶', "\u{e001}");
                format!("{}\n\n{more}\n", text.trim_end())
            }
        });
        crate::run(here, "paper --profile quick --out p --results r --templates t")
    };
    for line in FAULTS.lines() {
        let (given, says) = line.split_once(" => ").unwrap();
        let (file, fault) = given.split_once(' ').unwrap();
        let (code, told, note) = made(file, fault);
        let text = std::fs::read_to_string(here.join("t").join(file)).unwrap();
        let says = format!("{file}{}", says.replace('$', &text.lines().count().to_string()));
        let line = note.lines().last().unwrap();
        assert!(code == 2 && line.contains(&says), "{says}: {told}{note}");
        for jargon in ["-->", " | ", "usize", "f64", "[\""] {
            assert!(!line.contains(jargon), "{line}");
        }
    }
    // A section that was emptied is named, and not what else misses it.
    let text = std::fs::read_to_string(here.join("t/edition/04-orbits.md")).unwrap();
    let (code, _, note) = made("edition/04-orbits.md", &format!("{} -> ", text.trim_end()));
    assert!(code == 2 && note.contains("edition/04-orbits.md: it is empty; write"), "{note}");
    // So is one that another was copied over.
    let read = |name: &str| std::fs::read_to_string(here.join("t/edition").join(name)).unwrap();
    let [own, other] = ["05-counting.md", "06-probability.md"].map(read);
    let (code, _, note) = made("edition/05-counting.md", &format!("{own} -> {other}"));
    assert!(code == 2 && note.contains("the first at edition/05-counting.md:1:1"), "{note}");
    // A bar in a statement ends no cell of a table.
    let (code, told, note) = made("published.toml", "= \"For small σ -> = \"For $|x|$ | small σ");
    assert_eq!(code, 0, "{told}{note}");
    // The lock of an editor, a link to nowhere, is no prose.
    std::os::unix::fs::symlink("me@here.1:2", here.join("t/.#front.md")).unwrap();
    let (code, told, note) = crate::run(here, "check --profile quick --results r --templates t");
    assert_eq!(code, 0, "{told}{note}");
}
