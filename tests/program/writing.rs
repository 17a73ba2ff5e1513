//! What `impact-paper` writes over, and what it leaves as it is.

use crate::paper::{refused, run};
use crate::tree;

/// Whatever writes, writes over nothing that it did not make itself.
#[test]
fn what_others_made_is_left_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    std::fs::create_dir_all(here.join("t/figures")).unwrap();
    for name in ["README.md", "t/report.md", "t/figures/fig04.svg"] {
        std::fs::write(here.join(name), "by hand").unwrap();
    }
    let before = tree(here);
    for (arguments, says) in [
        ("paper --profile quick --out .", "--out: .: it has files and no SHA256SUMS"),
        ("paper --figure 4 --out t", "--out: t: it has files and no SHA256SUMS"),
        ("paper --figure 4 --out t/figures", "--out: t/figures: it has files"),
    ] {
        refused(here, arguments, &[says, "--force"]);
    }
    assert!(tree(here) == before, "{:?}", tree(here).keys());
    // Forced, it says what it wrote over, and a folder of its own is written again without.
    let (code, _, note) = run(here, "paper --figure 4 --out t --force");
    assert!(code == 0 && note.contains("wrote over figures/fig04.svg"), "{note}");
    assert_eq!(run(here, "paper --figure 4 --figure 5 --out t").0, 0);
    assert_eq!(std::fs::read_to_string(here.join("t/report.md")).unwrap(), "by hand");
}
