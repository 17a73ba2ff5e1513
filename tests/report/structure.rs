//! Rules about the source that no compiler checks: who imports whom, portable arithmetic, and a README
//! that is current.

use impact_paper::report::{PROGRAM, Templates};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below a folder with one of these endings, as (path from the top, text).
fn files(folder: &str, endings: &[&str]) -> Vec<(String, String)> {
    fn walk(folder: &Path, into: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() { walk(&path, into) } else { into.push(path) }
        }
    }
    let mut paths = Vec::new();
    walk(&root().join(folder), &mut paths);
    paths.sort();
    let wanted = |path: &PathBuf| endings.iter().any(|e| path.to_string_lossy().ends_with(e));
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(&path).unwrap())
    };
    paths.into_iter().filter(wanted).map(read).collect()
}

/// Lines of code with their numbers: no comments, nothing after the unit tests begin.
fn code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    lines
        .take_while(|(_, line)| *line != "#[cfg(test)]")
        .filter(|(_, line)| !line.trim_start().starts_with("//"))
}

/// The source of the program and of its crates.
fn sources() -> Vec<(String, String)> {
    let crates = ["numerics", "impact-chain", "circuits", "literate", "page"];
    let crates = crates.map(|name| format!("crates/{name}/src"));
    crates
        .iter()
        .map(String::as_str)
        .chain(["src"])
        .flat_map(|folder| files(folder, &[".rs"]))
        .collect()
}

/// The crates by the names of the layers that they are.
const CRATES: [(&str, &str); 4] = [
    ("literate", "literate"),
    ("impact_numerics", "impact_numerics"),
    ("impact_chain", "impact_chain"),
    ("impact_circuits", "impact_circuits"),
];

/// Who may import whom in src/, besides itself: no arrow goes back, and figures and claims know results,
/// never models.
const MAY_IMPORT: [(&str, &[&str]); 10] = [
    ("literate", &["impact_numerics"]),
    // The chain's own types.
    ("params", &["literate", "impact_numerics", "impact_chain"]),
    ("impact_numerics", &[]),
    ("impact_chain", &["impact_numerics"]),
    ("impact_circuits", &["impact_numerics", "impact_chain"]),
    ("experiments", &["params", "literate", "impact_numerics", "impact_chain", "impact_circuits"]),
    ("figures", &["params", "literate", "impact_numerics", "experiments"]),
    ("claims", &["params", "literate", "impact_numerics", "experiments"]),
    (
        "report",
        &[
            "params",
            "literate",
            "impact_numerics",
            "impact_circuits",
            "experiments",
            "figures",
            "claims",
        ],
    ),
    (
        "program",
        &["params", "literate", "impact_chain", "experiments", "figures", "claims", "report"],
    ),
];

/// Layers that a line of code names: `crate::layer`, the name of its crate, or `super::…::layer` that climbs to the top.
fn layers_named(line: &str, depth: usize) -> Vec<String> {
    let mut named = Vec::new();
    let word = |text: &str| -> String {
        text.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect()
    };
    for (i, _) in line.match_indices("crate::") {
        let rest = &line[i + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => {
                named.extend(list.split('}').next().unwrap().split(',').map(|p| word(p.trim())))
            }
            None => named.push(word(rest)),
        }
    }
    // A quoted name is no import.
    let code = line.replace("\"impact_", "\"");
    let crates = CRATES.iter().filter(|(name, _)| code.contains(&format!("{name}::")));
    named.extend(crates.map(|(_, layer)| (*layer).to_string()));
    let climb = "super::".repeat(depth);
    if let Some(i) = line.find(&climb).filter(|_| depth > 0) {
        named.push(word(&line[i + climb.len()..]));
    }
    named
}

#[test]
fn imports_flow_one_way() {
    let mut violations = Vec::new();
    let layers: Vec<&str> = MAY_IMPORT.iter().map(|(layer, _)| *layer).collect();
    for (path, text) in files("src", &[".rs"]) {
        let parts: Vec<&str> = path.trim_end_matches(".rs").split('/').skip(1).collect();
        let Some((_, allowed)) = MAY_IMPORT.iter().find(|(layer, _)| *layer == parts[0]) else {
            continue;
        };
        let depth = parts.len() - usize::from(parts.last() == Some(&"mod"));
        for (number, line) in code(&text) {
            for layer in layers_named(line, depth) {
                let known = layers.contains(&layer.as_str());
                if known && layer != parts[0] && !allowed.contains(&layer.as_str()) {
                    violations.push(format!("{path}:{number}: {} imports {layer}", parts[0]));
                }
            }
        }
    }
    assert!(violations.is_empty(), "{}", violations.join("\n"));
}

/// Methods of f64 that ask the platform's mathematical library, or fuse operations.
const PLATFORM: [&str; 29] = [
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sin_cos", "sinh", "cosh", "tanh",
    "asinh", "acosh", "atanh", "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10",
    "powf", "powi", "cbrt", "hypot", "mul_add", "gamma", "ln_gamma",
];

/// (file, method, why its bits do not depend on the machine).
const OWN_METHODS: [(&str, &str, &str); 3] = [
    ("crates/impact-chain/src/flight.rs", "sin_cos", "the clock's own kernel"),
    ("crates/circuits/src/impact_probability.rs", "exp", "of DoubleDouble"),
    ("crates/circuits/src/counting.rs", "ln", "of Scaled"),
];

#[test]
fn no_bit_depends_on_the_platform() {
    let mut found = Vec::new();
    let mut used = BTreeSet::new();
    for (path, text) in sources() {
        for (number, line) in code(&text) {
            for method in PLATFORM {
                let called = line.contains(&format!(".{method}("))
                    || line.contains(&format!("f64::{method}"));
                let own = OWN_METHODS.iter().find(|(file, m, _)| *file == path && *m == method);
                match own {
                    _ if !called => {}
                    Some(own) => {
                        used.insert(own);
                    }
                    None => found.push(format!("{path}:{number}: {method}: {}", line.trim())),
                }
            }
        }
    }
    assert!(found.is_empty(), "use pxfm or declare an own method:\n{}", found.join("\n"));
    for own in &OWN_METHODS {
        assert!(used.contains(own), "{own:?} is an exception that nothing needs any more");
    }
}

/// The first page of `cargo doc` leads to sections of the report that exist.
#[test]
fn links_of_the_documentation_land() {
    let page = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    let links = page.split("../../../paper/").skip(1).map(|rest| rest.split(')').next().unwrap());
    let links: Vec<(&str, &str)> = links.map(|link| link.split_once('#').unwrap()).collect();
    assert!(links.len() >= 8, "{links:?}");
    let templates = Templates::read(&root().join("templates")).unwrap();
    for (file, id) in links {
        let document = PROGRAM.documents.iter().find(|document| document.page == file).unwrap();
        let id = format!("{{#{}}}", id.replacen('-', ":", 1));
        let has = |path: &str| templates.text(path).unwrap().contains(&id);
        assert!(document.files(&templates).into_iter().any(has), "{file}: {id}");
    }
}

#[test]
fn no_path_of_a_machine() {
    // In two parts, so that this file does not find itself.
    let paths = ["/wo:rk/", "/ro:ot/", "/ho:me/", "/tm:p/", "/Us:ers/"].map(|p| p.replace(':', ""));
    let all = [".rs", ".toml", ".md", ".tex", ".bib", ".json", ".csv", ".svg", "run"];
    let folders = ["src", "crates", "build", "tests", "templates", "paper", ".ci"];
    let mut texts: Vec<_> = folders
        .iter()
        .filter(|folder| root().join(folder).is_dir())
        .flat_map(|folder| files(folder, &all))
        .collect();
    for name in ["README.md", "DESIGN.md", "CHANGELOG.md", "Makefile", "Cargo.toml", "CITATION.cff"]
    {
        texts.push((name.into(), fs::read_to_string(root().join(name)).unwrap()));
    }
    for (name, text) in texts {
        for path in &paths {
            assert!(!text.contains(path.as_str()), "{name} has {path}");
        }
    }
}

/// The score on the README's first screen is that of the committed ledger.
#[test]
fn the_readme_has_the_score() {
    let ledger = fs::read_to_string(root().join("paper/ledger.json")).unwrap();
    let ledger: serde_json::Value = serde_json::from_str(&ledger).unwrap();
    let rows = ledger["claims"].as_array().unwrap();
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let score = format!(
        "of {} statements {} are reproduced, {} differ for a reason that is given, {} differ without one, and {} cannot be judged",
        rows.len(),
        count("reproduced"),
        count("differs and explained"),
        count("differs"),
        count("cannot be judged"),
    );
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let line = readme.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(line.contains(&score), "the README does not say: {score}");
}

/// Links of the README lead to files of the project.
#[test]
fn links_of_the_readme_land() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    for part in readme.split("](").skip(1) {
        let target = part.split(')').next().unwrap();
        // paper/ is written by the program, and may not be there yet.
        if !target.contains("://") && !target.starts_with("paper/") {
            assert!(root().join(target).exists(), "the README links to {target}");
        }
    }
}
