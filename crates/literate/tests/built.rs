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

struct Toy {
    folder: tempfile::TempDir,
    target: PathBuf,
}

impl Toy {
    fn new() -> Toy {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let read = |name: &str| fs::read_to_string(root.join(name)).unwrap();
        // With the profile of these tests, what they have compiled serves here too.
        let manifest = read("Cargo.toml");
        let profile = &manifest[manifest.find("[profile.release]").unwrap()..];
        let profile: String = profile
            .lines()
            .filter(|line| !line.starts_with("impact-"))
            .map(|l| format!("{l}\n"))
            .collect();
        let target = std::env::current_exe().unwrap().ancestors().nth(3).unwrap().to_path_buf();
        let toy =
            Toy { folder: tempfile::Builder::new().prefix("a toy ").tempdir().unwrap(), target };
        let literate = env!("CARGO_MANIFEST_DIR");
        for (path, text) in [
            (
                "Cargo.toml",
                format!("[workspace]\nresolver = \"3\"\nmembers = [\"toy\", \"phys\"]\n{profile}"),
            ),
            ("Cargo.lock", read("Cargo.lock")),
            (
                "toy/Cargo.toml",
                format!(
                    "[package]\nname = \"literate-toy\"\nedition = \"2024\"\n[features]\nheavy = []\n[dependencies]\n\
                     literate = {{ package = \"literate-paper\", path = {literate:?} }}\nphys = {{ path = \"../phys\" }}\n"
                ),
            ),
            ("toy/build.rs", BUILD.into()),
            ("toy/src/main.rs", PROGRAM.into()),
            ("toy/data/included.csv", "4\n".into()),
            ("toy/data/read.csv", "0\n".into()),
            (
                "toy/prose/report.md",
                "# Sum\n\nThe sum is «sum.all.value».\n\n![A line](figures/line.svg)\n".into(),
            ),
            ("phys/Cargo.toml", "[package]\nname = \"phys\"\nedition = \"2024\"\n".into()),
            ("phys/src/lib.rs", "pub const G: f64 = 1.0;\n".into()),
            ("shared/elsewhere.rs", "pub const H: f64 = 2.0;\n".into()),
        ] {
            toy.write(path, &text);
        }
        toy
    }

    fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn build(&self, more: &[&str]) {
        self.build_with(more, &[]);
    }

    fn build_with(&self, more: &[&str], variables: &[(&str, &str)]) {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["build", "--release", "--offline", "--quiet", "--package=literate-toy"]);
        cargo
            .args(more)
            .current_dir(self.folder.path())
            .env("CARGO_TARGET_DIR", &self.target)
            .envs(variables.iter().copied());
        let output = cargo.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }

    /// Runs the program, and returns its exit code and all that it printed.
    fn run(&self, line: &str) -> (i32, String) {
        let mut program = Command::new(self.target.join("release/literate-toy"));
        program.args(line.split(' ')).current_dir(self.folder.path().join("toy"));
        program.env_remove("LITERATE_PROJECT");
        let output = program.output().unwrap();
        let printed = [output.stdout, output.stderr].concat();
        (output.status.code().unwrap(), String::from_utf8(printed).unwrap())
    }

    fn report(&self) -> String {
        fs::read_to_string(self.folder.path().join("toy/paper/report.md")).unwrap()
    }
}

#[test]
fn a_result_is_stale_as_soon_as_what_made_it_has_changed() {
    let toy = Toy::new();
    toy.build(&[]);
    assert_eq!(toy.run("paper").0, 0);
    assert!(toy.report().contains("The sum is 15."), "{}", toy.report());
    assert_eq!(toy.run("paper --dry-run"), (0, String::new()));

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
        let (code, printed) = toy.run(line);
        assert_eq!(code, 2, "{line}: {printed}");
        assert!(printed.contains("../phys/src/lib.rs has changed since"), "{line}: {printed}");
        assert!(printed.contains("run `cargo build`"), "{line}: {printed}");
    }
    toy.build(&[]);
    let (code, printed) = toy.run("paper --dry-run");
    assert!(
        code == 1 && printed.contains("sum: run again, ../phys/src/lib.rs changed"),
        "{printed}"
    );

    // A figure is drawn into the report only if nothing else there is stale.
    let (code, printed) = toy.run("paper --figure line");
    assert!(code == 0 && printed.contains("target/figures: "), "{printed}");
    assert!(toy.report().contains("The sum is 15."));
    assert_eq!(toy.run("paper").0, 0);
    assert!(toy.report().contains("The sum is 30."), "{}", toy.report());
    let (code, printed) = toy.run("paper --figure line");
    assert!(code == 0 && printed.contains("paper: 2 files"), "{printed}");

    // So is a report whose prose has changed since.
    toy.write(
        "toy/prose/report.md",
        "# Sum\n\nIt is «sum.all.value».\n\n![A line](figures/line.svg)\n",
    );
    for (line, code) in [("paper --dry-run", 1), ("verify", 1), ("check", 1)] {
        let (exit, printed) = toy.run(line);
        assert!(
            exit == code && printed.contains("not as prose, published numbers"),
            "{line}: {printed}"
        );
    }

    toy.build(&["--features=heavy"]);
    let (code, printed) = toy.run("paper --dry-run");
    assert!(code == 1 && printed.contains("feature heavy changed"), "{printed}");

    // A variable that code takes when it is compiled.
    assert_eq!(toy.run("paper").0, 0);
    toy.build_with(&["--features=heavy"], &[("TOY_TAKEN", "64")]);
    let (code, printed) = toy.run("paper --dry-run");
    assert!(code == 1 && printed.contains("TOY_TAKEN when compiled changed"), "{printed}");

    // A file that is put back with its old time, which cargo does not see.
    let old = toy.folder.path().join("old.rs");
    let path = toy.folder.path().join("phys/src/lib.rs");
    fs::write(&old, "pub const G: f64 = 1.0;\n").unwrap();
    let hour = std::time::Duration::from_secs(3600);
    let before = fs::metadata(&path).unwrap().modified().unwrap() - hour;
    fs::File::options().write(true).open(&old).unwrap().set_modified(before).unwrap();
    fs::rename(&old, &path).unwrap();
    let (code, printed) = toy.run("paper");
    assert!(code == 2 && printed.contains("is not what this program was built from"), "{printed}");

    // A copy without the list of cargo is known by its bytes.
    let copy = toy.folder.path().join("copy");
    fs::copy(toy.target.join("release/literate-toy"), &copy).unwrap();
    let output = Command::new(copy)
        .args(["paper", "--dry-run"])
        .current_dir(toy.folder.path().join("toy"))
        .output();
    let printed = String::from_utf8(output.unwrap().stdout).unwrap();
    assert!(printed.contains("sum: run again, "), "{printed}");
}
