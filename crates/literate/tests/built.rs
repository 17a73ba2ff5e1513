//! Builds a small paper in a workspace as its author would, and changes what it is made of.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A sum of one number of each kind of code: of another package, a file elsewhere, included data, a
/// build script, a feature.
const PROGRAM: &str = r#"
use literate::prelude::*;

#[path = "../../shared/elsewhere.rs"]
mod elsewhere;
include!(concat!(env!("OUT_DIR"), "/made.rs"));

fn run(_: &(), _: &Progress) -> Result<f64, Error> {
    let included: f64 = include_str!("../data/included.csv").trim().parse().unwrap();
    let feature = if cfg!(feature = "heavy") { 1000.0 } else { 0.0 };
    let taken: f64 = option_env!("TOY_TAKEN").map_or(0.0, |text| text.parse().unwrap());
    Ok(phys::G + elsewhere::H + included + MADE + feature + taken)
}

fn tables(sum: &f64) -> Vec<Table> {
    vec![Table::builder("sum.all", &[*sum], |_| 1).real("value", "1", 6, "The sum.", |sum| *sum).done()]
}

const SUM: Experiment<(), f64> =
    Experiment { reads: &["data/read.csv"], ..Experiment::new("sum", |_| (), run, tables) };

fn circle(_: &Results) -> Result<Figure, FigureError> {
    let plot = Plot::new().x("x").y("y").line("line", &[(0.0, 0.0), (1.0, 1.0)]);
    plot.finish("A line", describe!("It rises."))
}

fn main() -> std::process::ExitCode {
    let paper = Paper::new("Sum", sources!("src"));
    paper.experiment(&SUM).figure("line", &[&SUM], circle).cli()
}
"#;

const BUILD: &str = r#"
fn main() {
    let folder = std::env::var("OUT_DIR").unwrap();
    std::fs::write(format!("{folder}/made.rs"), "const MADE: f64 = 8.0;").unwrap();
    println!("cargo::rerun-if-changed=build.rs");
}
"#;

const PACKAGE: &str = r#"[package]
name = "literate-toy"
edition = "2024"
[features]
heavy = []
[dependencies]
literate = { package = "literate-paper", path = "LITERATE" }
phys = { path = "../phys" }
"#;

const WORKSPACE: &str = "[workspace]\nresolver = \"3\"\nmembers = [\"toy\", \"phys\"]\n";

/// Files with the same text in each test.
const FILES: [(&str, &str); 8] = [
    ("toy/build.rs", BUILD),
    ("toy/src/main.rs", PROGRAM),
    ("toy/data/included.csv", "4\n"),
    ("toy/data/read.csv", "0\n"),
    (
        "toy/prose/report.md",
        "# Sum\n\nThe sum is «sum.all.value».\n\n![A line](figures/line.svg)\n",
    ),
    ("phys/Cargo.toml", "[package]\nname = \"phys\"\nedition = \"2024\"\n"),
    ("phys/src/lib.rs", "pub const G: f64 = 1.0;\n"),
    ("shared/elsewhere.rs", "pub const H: f64 = 2.0;\n"),
];

struct Toy {
    folder: tempfile::TempDir,
    target: PathBuf,
}

impl Toy {
    fn new() -> Toy {
        let literate = env!("CARGO_MANIFEST_DIR");
        let read = |name: &str| fs::read_to_string(format!("{literate}/../../{name}")).unwrap();
        let target = std::env::current_exe().unwrap().ancestors().nth(3).unwrap().to_path_buf();
        let folder = tempfile::Builder::new().prefix("a toy ").tempdir().unwrap();
        let toy = Toy { folder, target };
        // With the profile of these tests, what they have compiled serves here too.
        let manifest = read("Cargo.toml");
        let profile = manifest[manifest.find("[profile.release]").unwrap()..].lines();
        let profile: Vec<&str> = profile.filter(|line| !line.starts_with("impact-")).collect();
        toy.write("Cargo.toml", &[WORKSPACE, &profile.join("\n")].concat());
        toy.write("Cargo.lock", &read("Cargo.lock"));
        toy.write("toy/Cargo.toml", &PACKAGE.replace("LITERATE", literate));
        FILES.iter().for_each(|(path, text)| toy.write(path, text));
        toy
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn build(&self, options: &[&str], variables: &[(&str, &str)]) {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["build", "--release", "--offline", "--quiet", "--package=literate-toy"]);
        cargo.args(options).current_dir(&self.folder).envs(variables.iter().copied());
        let output = cargo.env("CARGO_TARGET_DIR", &self.target).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }

    /// Runs a program, and returns its exit code and all that it printed.
    fn run(&self, program: &Path, line: &str) -> (i32, String) {
        let mut program = Command::new(program);
        program.args(line.split(' ')).current_dir(self.folder.path().join("toy"));
        let output = program.env_remove("LITERATE_PROJECT").output().unwrap();
        let printed = [output.stdout, output.stderr].concat();
        (output.status.code().unwrap(), String::from_utf8(printed).unwrap())
    }

    /// Runs the program, which must end with an exit code and print these words.
    fn expect(&self, line: &str, code: i32, words: &[&str]) {
        let (exit, printed) = self.run(&self.target.join("release/literate-toy"), line);
        assert_eq!(exit, code, "{line}: {printed}");
        assert!(words.iter().all(|words| printed.contains(words)), "{line}: {printed}");
    }

    fn expect_report(&self, words: &str) {
        let path = self.folder.path().join("toy/paper/report.md");
        let report = fs::read_to_string(path).unwrap();
        assert!(report.contains(words), "{report}");
    }
}

#[test]
fn a_result_is_stale_as_soon_as_what_made_it_has_changed() {
    let toy = Toy::new();
    toy.build(&[], &[]);
    toy.expect("paper", 0, &[]);
    toy.expect_report("The sum is 15.");
    let program = toy.target.join("release/literate-toy");
    assert_eq!(toy.run(&program, "paper --dry-run"), (0, String::new()));

    // All that it was made of is known, wherever it lies.
    let saved = toy.folder.path().join("toy/target/results/sum-full.json");
    let saved = fs::read_to_string(saved).unwrap();
    for name in [
        "src/main.rs",
        "build.rs",
        "made by a build script: made.rs",
        "data/included.csv",
        "data/read.csv",
        "Cargo.toml",
        "../Cargo.toml",
        "../Cargo.lock",
        "../phys/Cargo.toml",
        "../phys/src/lib.rs",
        "../shared/elsewhere.rs",
        "the compiler",
        "the profile",
    ] {
        assert!(saved.contains(&format!("\"{name}\":\"")), "{name}: {saved}");
    }
    let heavy = "\"feature heavy\"";
    assert!(!saved.contains(heavy) && !saved.contains("report.md"), "{saved}");

    // Before it is built again, a program older than its code computes and judges nothing.
    toy.write("phys/src/lib.rs", "pub const G: f64 = 16.0;\n");
    for line in ["paper", "paper --dry-run", "run", "check", "verify", "verify --rerun"] {
        toy.expect(line, 2, &["../phys/src/lib.rs has changed since", "run `cargo build`"]);
    }
    toy.build(&[], &[]);
    toy.expect("paper --dry-run", 1, &["sum: run again, ../phys/src/lib.rs changed"]);

    // A figure is drawn into the report only if nothing else there is stale.
    toy.expect("paper --figure line", 0, &["target/figures: "]);
    toy.expect_report("The sum is 15.");
    toy.expect("paper", 0, &[]);
    toy.expect_report("The sum is 30.");
    toy.expect("paper --figure line", 0, &["paper: 2 files"]);

    // So is a report whose prose has changed since.
    let prose = "# Sum\n\nIt is «sum.all.value».\n\n![A line](figures/line.svg)\n";
    toy.write("toy/prose/report.md", prose);
    for line in ["paper --dry-run", "verify", "check"] {
        toy.expect(line, 1, &["not as prose, published numbers"]);
    }

    toy.build(&["--features=heavy"], &[]);
    toy.expect("paper --dry-run", 1, &["feature heavy changed"]);

    // A variable that code takes when it is compiled.
    toy.expect("paper", 0, &[]);
    toy.build(&["--features=heavy"], &[("TOY_TAKEN", "64")]);
    toy.expect("paper --dry-run", 1, &["TOY_TAKEN when compiled changed"]);

    // A file that is put back with its old time, which cargo does not see.
    let old = toy.folder.path().join("old.rs");
    let path = toy.folder.path().join("phys/src/lib.rs");
    fs::write(&old, "pub const G: f64 = 1.0;\n").unwrap();
    let hour = std::time::Duration::from_secs(3600);
    let before = fs::metadata(&path).unwrap().modified().unwrap() - hour;
    fs::File::options().write(true).open(&old).unwrap().set_modified(before).unwrap();
    fs::rename(&old, &path).unwrap();
    toy.expect("paper", 2, &["is not what this program was built from"]);

    // A copy without the list of cargo is known by its bytes.
    let copy = toy.folder.path().join("copy");
    fs::copy(program, &copy).unwrap();
    let (_, printed) = toy.run(&copy, "paper --dry-run");
    assert!(printed.contains("sum: run again, "), "{printed}");
}
