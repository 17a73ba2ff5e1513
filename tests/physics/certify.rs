//! `trace --certify`: what it says can be trusted is true, and what is regular is trusted.

use crate::reference::{Dd, Real, Reference};
use impact_paper::dynamics::{Impact, Initial, Scenario, TOLERANCE, certify};
use impact_paper::numerics::random::NormalPairs;
use impact_paper::params::{Boundary, Chain};
use std::process::Command;

fn draw(chain: &Chain, sigma: f64, index: u64) -> Scenario {
    Scenario::draw(chain, sigma, &mut NormalPairs::new("certificates", 1, index))
}

/// Impacts of the run that are right: the gap, and the time within the tolerance.
fn right(ours: &[Impact], scenario: &Scenario, until: f64) -> u64 {
    let mut reference = Reference::<Dd>::new(scenario);
    let tolerance = TOLERANCE / scenario.natural_frequency;
    let mut count = 0;
    for own in ours {
        let Some(hit) = reference.step(&Dd::of(until + 1.0)).unwrap() else { break };
        let difference = (Dd::of(own.time) - hit.time).near().abs();
        if own.gap != hit.gap || difference > tolerance {
            break;
        }
        count += 1;
    }
    count
}

#[test]
fn the_horizon_is_not_beyond_the_true_one() {
    let chain = |masses| Chain { masses, ..Chain::default() };
    let scenarios = [
        (draw(&chain(20), 0.3, 0), 250.0),
        (draw(&chain(20), 0.3, 1), 250.0),
        (draw(&chain(40), 0.2, 2), 250.0),
        (draw(&Chain { restitution: 1.0, ..chain(8) }, 0.3, 3), 150.0),
        (draw(&Chain { boundary: Boundary::Ring, ..chain(12) }, 0.3, 4), 250.0),
        (
            draw(&Chain { natural_frequency: 2.0, forcing_frequency: 3.1, ..chain(10) }, 2.0, 5),
            120.0,
        ),
    ];
    for (i, (scenario, until)) in scenarios.into_iter().enumerate() {
        let mut ours = Vec::new();
        let certificate = certify(&scenario, until, |impact| {
            ours.push(impact);
            true
        });
        let certificate = certificate.unwrap();
        let right = right(&ours, &scenario, until);
        println!("{i}: {certificate:?}, {right} of {} are right", ours.len());
        assert!(right < ours.len() as u64, "{i}: too short a run to lose its way");
        assert!(certificate.impacts <= right, "{i}: {certificate:?}, but {right} are right");
        assert!(certificate.impacts * 10 > right * 7, "{i}: {certificate:?} of {right}: too shy");
        let horizon = certificate.horizon.expect("a chaotic run has one");
        let next = &ours[certificate.impacts as usize];
        assert!(horizon <= next.time && next.time - horizon < 5.0, "{i}: {horizon} {next:?}");
        let growth = certificate.growth.expect("errors grow");
        assert!((0.05..2.0).contains(&growth), "{i}: {growth}");
    }
}

/// A margin too small would show here: one of many runs would be trusted too long.
#[test]
fn of_many_runs_none_is_trusted_too_long() {
    let many = 12;
    let (mut trusted, mut true_ones, mut wrong) = (0, 0, 0);
    for index in 10..10 + many {
        // Some of them so near resonance that the twins' first roundings are as large as they may be.
        let near = |chain| Chain { forcing_frequency: 1.0 - 5e-8, ..chain };
        let chain = Chain { masses: 12, ..Chain::default() };
        let chain = if index % 4 == 0 { near(chain) } else { chain };
        let scenario = draw(&chain, 0.35, index);
        let mut ours = Vec::new();
        let certificate = certify(&scenario, 250.0, |impact| {
            ours.push(impact);
            true
        });
        let certificate = certificate.unwrap();
        let right = right(&ours, &scenario, 250.0);
        wrong += u32::from(certificate.impacts > right);
        trusted += certificate.impacts;
        true_ones += right;
    }
    println!("{trusted} trusted of {true_ones} that are right, {wrong} of {many} runs wrong");
    assert_eq!(wrong, 0);
    assert!(trusted * 10 > true_ones * 7, "{trusted} of {true_ones}: too shy");
}

#[test]
fn what_is_regular_or_quiet_is_trusted_to_its_end() {
    let chain = |masses| Chain { masses, ..Chain::default() };
    // A mass that bounces at one wall without forcing: no chaos, and the times drift by roundings.
    let bouncing = Scenario {
        initial: Initial::Free(vec![[0.0, 1.5]]),
        forcing: vec![[0.0; 2]],
        restitution: 1.0,
        ..draw(&chain(1), 0.1, 0)
    };
    // A mirror image keeps its exact ties.
    let mut mirror = draw(&chain(6), 0.3, 3);
    for j in 0..3 {
        mirror.forcing[5 - j] = mirror.forcing[j].map(|x| -x);
    }
    let quiet = draw(&chain(30), 0.04, 1);
    for (scenario, until, least) in [(bouncing, 1e4, 1000), (mirror, 20.0, 10), (quiet, 1e9, 0)] {
        let mut impacts = 0;
        let certificate = certify(&scenario, until, |_| {
            impacts += 1;
            true
        });
        let certificate = certificate.unwrap();
        println!("{impacts}: {certificate:?}");
        assert!(impacts >= least, "{impacts}");
        assert_eq!((certificate.impacts, certificate.horizon), (impacts, None));
        assert!(certificate.growth.is_none_or(|rate| rate < 0.5), "{certificate:?}");
    }
}

#[test]
fn the_line_stands_on_stderr_and_the_output_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scenario.json");
    std::fs::write(&path, r#"{"forcing":[[0.9,-0.4],[-0.7,0.8],[0.3,0.9]]}"#).unwrap();
    let run = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_impact-paper"));
        command.arg("trace").arg(&path).args(["--until", "300"]).args(more);
        let output = command.output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let (plain, certified) = (run(&[]), run(&["--certify"]));
    assert_eq!((plain.0, plain.2.as_str()), (Some(0), ""));
    assert_eq!((certified.0, &certified.1), (Some(0), &plain.1));
    let line = certified.2.trim_end();
    let all = plain.1.lines().count() - 1;
    let words = format!(" of {all} impacts can be trusted, before t = ");
    assert!(line.contains(&words) && line.contains("errors grow as exp(0."), "{line}");
    assert_eq!(line.lines().count(), 1, "{line}");
    let short = run(&["--certify", "--max-impacts", "5"]);
    assert!(
        short.1.lines().count() == 6 && short.2.contains("5 impacts can be trusted, to the end"),
        "{short:?}"
    );
    for more in [["--method", "verlet"], ["--method", "sampled"]] {
        let (code, output, error) = run(&["--certify", more[0], more[1]]);
        assert_eq!((code, output.as_str(), error.lines().count()), (Some(2), "", 1), "{error}");
        assert!(error.contains("--certify") && error.contains(more[1]), "{error}");
    }
}
