//! The command line: lists of σ.

use super::mutants::mutant;
use std::process::Command;

/// A list that is taken leads to the refusal of --masses 0.
#[test]
fn lists_of_sigma_of_any_text() {
    let good = ["0.1,0.12,0.3", "0.08..0.18:0.0025", "0..0.001:5e-4"].map(String::from);
    let mut taken = 0;
    for index in 0..400 {
        let text = mutant("sigma", index, &good).replace('\0', "");
        let text: String = text.chars().take(20_000).collect();
        let sigma = format!("--sigma={text}");
        let mut command = Command::new(env!("CARGO_BIN_EXE_impact-paper"));
        let output = command.args(["sweep", &sigma, "--masses=0"]).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        let shown = &error[..error.len().min(300)];
        assert_eq!(output.status.code(), Some(2), "{text:?}: {shown}");
        assert_eq!(error.lines().count(), 1, "{text:?}: {shown}");
        assert!(error.len() < 2000, "{text:?}: {} long", error.len());
        let option = if error.contains("--masses: 0") { "--masses" } else { "--sigma" };
        taken += usize::from(option == "--masses");
        assert!(error.contains(option), "{text:?}: {shown}");
    }
    assert!((50..350).contains(&taken), "{taken} taken");
}
