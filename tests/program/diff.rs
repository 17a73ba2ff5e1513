//! Runs `impact-paper diff` on two reports, by folder or by revision of git.

use crate::*;

/// Some files of the committed report twice, as `a` and as `b`, which has another number, verdict
/// and datum, lacks a file and has a new one.
fn changed() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["values.json", "ledger.json", "report.md", "data/fig07.csv", "data/fig12.csv"];
    let committed = |path: &str| fs::read(Path::new("paper").join(path)).unwrap();
    let files = paths.map(|path| (path.to_string(), committed(path))).into();
    ["a", "b"].iter().for_each(|name| put(&folder.path().join(name), &files));
    let changed = |path: &str| folder.path().join("b").join(path);
    let json = |path: &str| -> serde_json::Value {
        serde_json::from_str(&fs::read_to_string(changed(path)).unwrap()).unwrap()
    };
    let mut values = json("values.json");
    let error =
        values["sweep.rise.half_height"]["kind"]["ensemble"]["standard_error"].as_f64().unwrap();
    let value = &mut values["sweep.rise.half_height"]["number"]["real"]["value"];
    *value = (value.as_f64().unwrap() + 3.0 * error * 2f64.sqrt()).into();
    // What no printed digit shows is shown in full.
    let p = &mut values["theory.jump.p_jump"]["number"]["real"]["value"];
    *p = (p.as_f64().unwrap() + 1e-9).into();
    let cards = values.as_object_mut().unwrap();
    let mut new = cards.remove("theory.jump.p_crit").unwrap();
    new["id"] = "new".into();
    new["number"] = serde_json::json!({"text": "a b"});
    cards.insert("new".into(), new);
    fs::write(changed("values.json"), format!("{values:#}\n")).unwrap();
    let mut ledger = json("ledger.json");
    let claims = ledger["claims"].as_array_mut().unwrap();
    let claim = claims.iter_mut().find(|claim| claim["id"] == "sec7_jump").unwrap();
    claim["verdict"] = "differs".into();
    claim["tolerance"] = "± 0.0001 | more".into();
    fs::write(changed("ledger.json"), format!("{ledger:#}\n")).unwrap();
    let data = fs::read_to_string(changed("data/fig12.csv")).unwrap();
    let data = data.replacen("25)\",0.021,1\n", "25)\",0.021,0.75\n", 1);
    fs::write(changed("data/fig12.csv"), data).unwrap();
    fs::remove_file(changed("data/fig07.csv")).unwrap();
    fs::write(changed("data/new.csv"), "a\n1\n").unwrap();
    fs::write(changed("report.html"), "built beside").unwrap();
    folder
}

/// The largest difference in standard errors comes first, what only one report has last.
#[test]
fn number_verdict_and_files_are_told_in_each_form() {
    let folder = changed();
    let here = folder.path();
    assert_eq!(answer(here, "diff a a"), "a and a: nothing differs\n");
    let differences = answer(here, "diff a b");
    for line in [
        "  sec7_jump: reproduced -> differs; tolerance: ten or more, above p_crit -> ± 0.0001 | more\n",
        "1 check and 4 numbers changed\n",
        ", +3.00 σ\n  theory.jump.p_jump: 0.01303",
        "; Δ +1.00e-9\n  new: new, a b\n  theory.jump.p_crit: gone, was 0.012210\n",
        "  differs  data/fig12.csv: 1 of ",
        " lines; the first \"theory, Eq. (25)\",0.021,1 -> \"theory, Eq. (25)\",0.021,0.75\n",
        "  new      data/new.csv\n",
        "  gone     data/fig07.csv\n",
        "  differs  values.json\n",
    ] {
        assert!(differences.contains(line), "{line}: {differences}");
    }
    assert!(!differences.contains("report.html"), "{differences}");
    fs::write(here.join("b/values.json"), "{\"a\": ").unwrap();
    refused(here, "diff a b", &["b: values.json"]);
}

#[test]
fn revisions_of_git_are_compared() {
    let folder = changed();
    let here = folder.path();
    let git = |arguments: &str| {
        let mut command = Command::new("git");
        command.current_dir(here).args(["-c", "user.name=a", "-c", "user.email=a@b"]);
        assert!(command.args(arguments.split(' ')).output().unwrap().status.success());
    };
    git("init --quiet");
    for (tag, name) in [("v1", "a"), ("v2", "b")] {
        let _ = fs::remove_dir_all(here.join("sub/paper"));
        put(&here.join("sub/paper"), &tree(&here.join(name)));
        git("add --force sub");
        git(&format!("commit --quiet --message {tag}"));
        git(&format!("tag {tag}"));
    }
    // The folder paper/ is that of the folder where the program runs, wherever git's top is.
    let sub = here.join("sub");
    assert_eq!(answer(&sub, "diff v1 v2"), answer(here, "diff a b"));
    assert_eq!(answer(&sub, "diff HEAD paper"), "HEAD and paper: nothing differs\n");
    assert!(answer(&sub, "diff HEAD~1 ../a").contains("nothing differs"));

    for odd in ["nothing", "v1:sub", "v1..v2", "", "--output=x"] {
        refused(&sub, &format!("diff -- {odd} paper"), &["neither a folder nor a revision"]);
    }
    let (code, _, note) = outcome(program(&sub, "diff v1 paper").env("PATH", ""));
    assert!(code == 2 && note.contains("git: ") && note.lines().count() == 1, "{note}");
}
