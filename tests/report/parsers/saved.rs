//! Saved results: whatever is in the file, a result is what was saved, or is run again for a reason.

use super::mutants::{is_one_line, mutant};
use impact_paper::experiments::built::code;
use impact_paper::experiments::{Progress, Store};
use impact_paper::params::Profile;
use literate::experiments::identity::{Identity, told};
use sha2::{Digest, Sha256};

type Saved = Vec<(String, Option<f64>, [u32; 2])>;

fn digest(lines: &[&str]) -> String {
    let mut hash = Sha256::new();
    lines.iter().for_each(|line| hash.update(format!("{line}\n")));
    hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}

#[test]
fn saved_results_of_any_text() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::open(folder.path()).unwrap();
    let identity = Identity::new("test", code("src/experiments/rise.rs"), &[1.5, 0.25]);
    let result: Saved =
        (0..20).map(|i| (format!("row {i}"), Some(f64::from(i) / 7.0), [i, i * i])).collect();
    let get = || store.get(&identity, Profile::Quick, &Progress::silent(), || Ok(result.clone()));
    assert_eq!(get().unwrap(), result);
    let file = folder.path().join("test-quick.json");
    let good = std::fs::read_to_string(&file).unwrap();
    let body = store.look(&identity, Profile::Quick).unwrap();
    let (mut refused, mut forged, mut foreign) = (0, 0, 0);
    for index in 1..800 {
        let text = mutant("saved", index, std::slice::from_ref(&good));
        // With a checksum that fits, as nobody has by accident.
        let lines: Vec<&str> = text.split('\n').collect();
        let fitting = match lines[..] {
            [_, made_of, body, ""] if index % 2 == 0 => {
                forged += 1;
                format!("{}\n{made_of}\n{body}\n", digest(&[made_of, body]))
            }
            _ => text.clone(),
        };
        std::fs::write(&file, &fitting).unwrap();
        match store.look(&identity, Profile::Quick) {
            Ok(found) => assert!(found == body || index % 2 == 0, "{text}"),
            Err(reasons) => {
                refused += 1;
                assert!(is_one_line(&told(&reasons)), "{reasons:?}");
            }
        }
        match get() {
            Ok(found) => assert!(found == result || index % 2 == 0, "{text}"),
            // What has nothing of a result any more is nobody's to replace.
            Err(error) => {
                assert!(
                    error.to_string().contains("where a saved result belongs"),
                    "{error}: {text}"
                );
                assert_eq!(std::fs::read_to_string(&file).unwrap(), fitting);
                foreign += 1;
                std::fs::write(&file, &good).unwrap();
            }
        }
    }
    assert!(refused > 250 && forged > 100, "{refused} refused, {forged} forged");
    assert!(foreign < refused / 2, "{foreign} foreign");
}
