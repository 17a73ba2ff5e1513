//! `impact-paper eval`: the contract of its output, and each kind of bad input.

use assert_cmd::Command;
use impact_paper::circuits::distribution::{Law, SampleSpace};
use impact_paper::circuits::impact_probability::ImpactProbability;
use impact_paper::circuits::{LARGEST_N, counting, jump};
use serde_json::{Value, json};

fn eval(arguments: &str) -> std::process::Output {
    let mut command = Command::cargo_bin("impact-paper").expect("the binary is built");
    command.arg("eval").args(arguments.split_whitespace()).output().expect("it runs")
}

/// The one JSON object of a good call.
fn answer(arguments: &str) -> Value {
    let output = eval(arguments);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty() && text.ends_with('\n') && text.lines().count() == 1);
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

/// Exit code 2, one line on stderr with all of `words`, nothing on stdout.
fn refused(arguments: &str, words: &[&str]) {
    let output = eval(arguments);
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments}: {text}");
    assert!(output.stdout.is_empty(), "{arguments}");
    assert_eq!(text.lines().count(), 1, "{arguments}: {text}");
    for word in words {
        assert!(text.contains(word), "{arguments}: `{word}` is not in `{text}`");
    }
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
fn the_answer_is_one_object_of_three_members_in_order() {
    let output = eval("mean-impacts --masses 40 --p 1");
    let text = String::from_utf8(output.stdout).unwrap();
    let mean = Law::new(SampleSpace::Simple, 41, 1.0).unwrap().mean();
    let expected = format!(
        "{{\"quantity\":\"mean-impacts\",\"value\":{mean:?},\
         \"inputs\":{{\"masses\":40,\"vertices\":41,\"p\":1.0}}}}\n"
    );
    assert_eq!(text, expected);
    let inputs = answer("p-of-sigma --sigma 0.15")["inputs"].clone();
    let default = std::f64::consts::SQRT_2;
    let expected =
        json!({"sigma": 0.15, "omega": 1.0, "forcing_frequency": default, "spacing": 1.0});
    assert_eq!(inputs, expected);
}

#[test]
fn vertices_default_to_a_hundred_and_masses_give_one_more() {
    assert_eq!(answer("p-crit")["inputs"], json!({"vertices": 100}));
    assert_eq!(float("p-jump --masses 100"), float("p-jump --vertices 101"));
    assert_ne!(float("p-jump"), float("p-jump --masses 100"));
    refused("p-jump --masses 100 --vertices 101", &["masses", "vertices", "one of them"]);
}

#[test]
fn p_zero_is_the_limit() {
    assert_eq!(float("mean-impacts --p 0"), 1.0);
    assert_eq!(float("mean-impacts --p -0.0"), 1.0);
    assert_eq!(integer("k-star --p 0"), 1);
    assert_eq!(float("probability --p 0 --k 1"), 1.0);
    assert_eq!(float("higher-probability --p 0 --k 2"), 0.0);
    assert_eq!(answer("k-star --p -0.0")["inputs"]["p"].to_string(), "0.0");
}

#[test]
fn large_graphs_are_answered_at_once() {
    // Values against high precision are in the tests of the library; here they must arrive.
    assert_eq!(integer("k-star --vertices 1000000 --p 0.3"), 999_997);
    assert!(float("mean-impacts --vertices 1000000 --p 0.3") < 999_998.0);
    assert!(float("higher-p-jump --vertices 1000000") > 1e-6);
    assert!(float("log-circuits --vertices 1000000 --k 1000000") > 1.28e7);
    assert_eq!(float("probability --vertices 1000000 --p 0.3 --k 1"), 0.0);
}

#[test]
fn list_names_every_quantity_with_its_equation() {
    let output = eval("--list");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    let names: Vec<&str> = text.lines().filter_map(|l| l.split_whitespace().next()).collect();
    let simple = ["p-jump", "k-after-jump", "k-star", "mean-impacts", "probability"];
    for name in simple {
        assert!(names.contains(&name) && names.contains(&format!("higher-{name}").as_str()));
    }
    for name in ["p-crit", "log-circuits", "p-of-sigma", "log-p-of-sigma"] {
        assert!(names.contains(&name));
    }
    assert_eq!(names.len(), 14);
    assert!(text.lines().all(|l| l.contains("Eq") || l.contains("Sec.")));
}

#[test]
fn bad_numbers_name_the_field_and_the_remedy() {
    for (value, word) in [("-0.1", "0 ≤ p ≤ 1"), ("1.5", "0 ≤ p ≤ 1"), ("nan", "0 ≤ p ≤ 1")]
    {
        refused(&format!("k-star --p {value}"), &["p:", word]);
        refused(&format!("higher-mean-impacts --p {value}"), &["p:", word]);
    }
    for value in ["inf", "-inf", "1e999"] {
        refused(&format!("mean-impacts --p {value}"), &["p:", "0 ≤ p ≤ 1"]);
    }
    refused("k-star --p abc", &["p:", "abc", "decimal"]);
    refused("k-star --p 0,5", &["p:", "0,5"]);
    for value in ["0", "-1", "nan", "inf", "1e400"] {
        refused(&format!("p-of-sigma --sigma {value}"), &["sigma:", "> 0"]);
        refused(&format!("log-p-of-sigma --sigma {value}"), &["sigma:", "> 0"]);
        for field in ["omega", "forcing-frequency", "spacing"] {
            let arguments = format!("p-of-sigma --sigma 0.1 --{field} {value}");
            refused(&arguments, &[&format!("{field}:"), "> 0"]);
        }
    }
    for field in ["omega", "forcing-frequency", "spacing", "sigma"] {
        refused(&format!("p-of-sigma --sigma 0.1 --{field} x"), &[field]);
    }
}

#[test]
fn bad_counts_name_the_field_and_the_remedy() {
    for field in ["vertices", "masses"] {
        for value in ["0", "100000001", "99999999999999999999999"] {
            refused(&format!("p-crit --{field} {value}"), &[field, "give"]);
        }
        for value in ["-1", "1.5", "1e3", "abc", "nan"] {
            refused(&format!("p-crit --{field} {value}"), &[&format!("{field}:"), "whole number"]);
        }
    }
    refused(&format!("mean-impacts --p 0.1 --vertices {}", LARGEST_N + 1), &["vertices:"]);
    refused(&format!("mean-impacts --p 0.1 --masses {LARGEST_N}"), &["masses:"]);
    for quantity in ["probability --p 0.5", "higher-probability --p 0.5", "log-circuits"] {
        for value in ["0", "101"] {
            refused(&format!("{quantity} --k {value}"), &["k:", "1 ≤ k ≤ 100"]);
        }
        for value in ["-1", "2.5"] {
            refused(&format!("{quantity} --k {value}"), &["k:", "whole number"]);
        }
    }
}

#[test]
fn what_does_not_exist_is_refused() {
    for big_n in 1..=3 {
        for quantity in ["p-jump", "k-after-jump"] {
            refused(&format!("{quantity} --vertices {big_n}"), &["vertices:", "no jump", "N ≥ 4"]);
        }
    }
    refused("p-jump --masses 2", &["masses", "no jump"]);
    refused("higher-p-jump --vertices 1", &["vertices:", "no jump", "N ≥ 2"]);
    assert!(float("p-jump --vertices 4") < 1.0 && float("higher-p-jump --vertices 2") < 1.0);
    refused("p-of-sigma --sigma 0.01", &["sigma:", "below the range", "log-p-of-sigma"]);
    refused("log-p-of-sigma --sigma 1e-160", &["sigma:", "larger"]);
    refused("p-of-sigma --sigma 0.1 --omega 2 --forcing-frequency 2", &["forcing-frequency:", "ω"]);
    let root = "1.4142135623730951";
    refused(&format!("log-p-of-sigma --sigma 1 --omega {root}"), &["forcing-frequency:"]);
}

#[test]
fn wrong_usage_is_one_line_too() {
    refused("", &["QUANTITY"]);
    refused("no-such-thing", &["no-such-thing", "--list"]);
    refused("p-crit --no-such-option", &["--no-such-option"]);
    refused("p-crit extra", &["extra"]);
    refused("k-star --p", &["--p"]);
    refused("k-star --p 0.1 --p 0.2", &["--p"]);
    refused("k-star", &["p:", "--p"]);
    refused("probability --p 0.1", &["k:", "--k"]);
    refused("p-of-sigma", &["sigma:", "--sigma"]);
    refused("log-circuits", &["k:"]);
}

#[test]
fn options_without_effect_are_refused() {
    refused("p-crit --p 0.1", &["p:", "leave --p out"]);
    refused("p-crit --sigma 0.1", &["sigma:"]);
    refused("k-star --p 0.1 --k 3", &["k:"]);
    refused("p-of-sigma --sigma 0.1 --vertices 5", &["vertices:"]);
    refused("p-of-sigma --sigma 0.1 --masses 5", &["masses:"]);
    for field in ["omega", "forcing-frequency", "spacing"] {
        refused(&format!("p-crit --{field} 2"), &[&format!("{field}:")]);
    }
}

#[test]
fn help_teaches() {
    let output = eval("--help");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    for word in ["higher-k-star", "Eq. (18)", "Options that a quantity does not", "--sigma"] {
        assert!(text.contains(word), "{word}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_no_panic() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let program = env!("CARGO_BIN_EXE_impact-paper");
    let mut command = std::process::Command::new(program);
    let output = command.args(["eval", "p-crit"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("standard output") && text.lines().count() == 1, "{text}");
}
