//! `impact-paper eval`: what it prints.

use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{counting, jump};
use serde_json::{Value, json};
use std::path::Path;

fn eval(arguments: &str) -> String {
    crate::answer(Path::new("."), &format!("eval {arguments}"))
}

/// The one JSON object of a good call.
fn answer(arguments: &str) -> Value {
    let text = eval(arguments);
    assert!(text.ends_with('\n') && text.lines().count() == 1);
    serde_json::from_str(&text).unwrap()
}

fn float(arguments: &str) -> f64 {
    let value = &answer(arguments)["value"];
    assert!(value.is_f64(), "{arguments}: {value} is printed as a float");
    value.as_f64().unwrap()
}

fn integer(arguments: &str) -> u64 {
    answer(arguments)["value"].as_u64().expect("an integer is printed as one")
}

#[test]
fn every_quantity_prints_what_the_library_computes() {
    let (simple, five) = (SampleSpace::Simple, SampleSpace::FiveClasses);
    let law = |space| Law::new(space, 41, 0.07).unwrap();
    let relation = ImpactProbability::new(0.2, 1.5, 1.1, 0.6).unwrap();
    assert_eq!(float("p-crit --vertices 41"), jump::p_crit(41).unwrap());
    assert_eq!(float("p-jump --vertices 41"), jump::p_jump(simple, 41).unwrap().p);
    assert_eq!(float("higher-p-jump --vertices 41"), jump::p_jump(five, 41).unwrap().p);
    let after = |space| jump::p_jump(space, 41).unwrap().k_after as u64;
    assert_eq!(integer("k-after-jump --vertices 41"), after(simple));
    assert_eq!(integer("higher-k-after-jump --vertices 41"), after(five));
    for (prefix, space) in [("", simple), ("higher-", five)] {
        let of = |quantity: &str| format!("{prefix}{quantity} --vertices 41 --p 0.07");
        assert_eq!(integer(&of("k-star")), law(space).k_star() as u64);
        assert_eq!(float(&of("mean-impacts")), law(space).mean());
        assert_eq!(float(&(of("probability") + " --k 7")), law(space).probability(7).unwrap());
    }
    assert_eq!(float("log-circuits --vertices 41 --k 7"), counting::log_phi(41, 7).unwrap());
    let given = "--sigma 0.2 --spacing 1.5 --omega 1.1 --forcing-frequency 0.6";
    assert_eq!(float(&format!("p-of-sigma {given}")), relation.p().unwrap());
    assert_eq!(float(&format!("log-p-of-sigma {given}")), relation.log_p().unwrap());
}

#[test]
fn the_answer_is_one_object_with_the_inputs_and_their_defaults() {
    let mean = Law::new(SampleSpace::Simple, 41, 1.0).unwrap().mean();
    let expected = format!(
        "{{\"quantity\":\"mean-impacts\",\"value\":{mean:?},\
         \"inputs\":{{\"masses\":40,\"vertices\":41,\"p\":1.0}}}}\n"
    );
    assert_eq!(eval("mean-impacts --masses 40 --p 1"), expected);
    let root = std::f64::consts::SQRT_2;
    let expected = json!({"sigma": 0.15, "omega": 1.0, "forcing_frequency": root, "spacing": 1.0});
    assert_eq!(answer("p-of-sigma --sigma 0.15")["inputs"], expected);
    assert_eq!(answer("p-crit")["inputs"], json!({"vertices": 100}));
    let (code, _, note) = crate::run(Path::new("."), "eval p-crit --vertices 2");
    assert!(code == 0 && note.contains("no probability"), "{note}");
    // A million are answered at once, and zero has no sign.
    assert_eq!(integer("k-star --vertices 1000000 --p 0.3"), 999_997);
    assert_eq!(answer("k-star --p -0.0")["inputs"]["p"].to_string(), "0.0");
    let list = eval("--list");
    assert_eq!(list.lines().count(), 14);
    assert!(list.lines().all(|line| line.contains("Eq") || line.contains("Sec.")));
}
