//! Ensembles of chains: which, at which σ, and how many.

use super::{Boundary, Chain, Grid, Profile, Protocol, SECOND_SEED, Start};
use impact_chain::{Beyond, Ensemble, Heating};

/// Windows (T, T + W] for all of these T and W, transients outer.
fn windows(transients: &[f64], windows: &[f64]) -> Vec<Protocol> {
    let of = |&transient: &f64| windows.iter().map(move |&window| Protocol { transient, window });
    transients.iter().flat_map(of).collect()
}

/// The paper's chain with the paper's protocol.
fn paper(name: &str, sigmas: Grid, realisations: usize) -> Ensemble {
    Ensemble {
        name: name.into(),
        sigmas: sigmas.values(),
        realisations,
        stream: name.into(),
        ..Ensemble::default()
    }
}

/// The main sweep of Sec. 2 (Figs. 2, 3, 12 and 15).
pub fn sweep(profile: Profile) -> Vec<Ensemble> {
    let grid = Grid::default();
    let (sigmas, realisations, few) = match profile {
        // 69 values, 0.0025 apart where the rise is.
        Profile::Full => (
            grid.and(4, 15, 1, 200).and(32, 72, 1, 400).and(19, 28, 1, 100).and(15, 20, 1, 50),
            1000,
            100,
        ),
        Profile::Quick => {
            (grid.and(2, 8, 2, 100).and(9, 16, 1, 100).and(9, 9, 1, 50).and(4, 8, 1, 20), 12, 6)
        }
    };
    let beyond = Beyond { above: 0.16, realisations: Some(few), until: None };
    vec![Ensemble { beyond: Some(beyond), ..paper("sweep", sigmas, realisations) }]
}

/// The headline numbers again, with another seed and fewer realisations on the rise only.
pub fn second_seed(profile: Profile) -> Vec<Ensemble> {
    let (sigmas, realisations) = match profile {
        Profile::Full => (Grid::default().and(34, 64, 1, 400), 400),
        Profile::Quick => (Grid::default().and(8, 16, 1, 100), 8),
    };
    vec![Ensemble { seed: SECOND_SEED, ..paper("sweep", sigmas, realisations) }]
}

/// The map over transients and windows.
pub fn protocol(profile: Profile) -> Vec<Ensemble> {
    let (longest, widest, sigmas, realisations) = match profile {
        Profile::Full => (9, 7, Grid::default().and(34, 68, 2, 400).and(18, 22, 1, 100), 120),
        Profile::Quick => (6, 5, Grid::default().and(9, 17, 1, 100), 6),
    };
    let transients = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 4000.0];
    let widths = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];
    vec![Ensemble {
        protocols: windows(&transients[..longest], &widths[..widest]),
        // The chain is full long before.
        beyond: Some(Beyond { above: 0.131, realisations: None, until: Some(1000.0) }),
        ..paper("protocol", sigmas, realisations)
    }]
}

/// The paper's chain, and chains that differ from it in start, ends, restitution or frequency.
pub fn starts(profile: Profile) -> Vec<Ensemble> {
    let (step, realisations) = match profile {
        Profile::Full => (1, 100),
        Profile::Quick => (2, 4),
    };
    let variant = |name: &str, [from, to]: [u32; 2], change: fn(&mut Chain)| {
        let sigmas = Grid::default().and(from, to, step, 100);
        let mut own = Ensemble { stream: "starts".into(), ..paper(name, sigmas, realisations) };
        change(&mut own.chain);
        own
    };
    // A smaller r or a larger Ω move the rise up, a larger r or a smaller Ω move it down.
    let (near, wide, low) = ([8, 18], [8, 26], [4, 14]);
    let mut variants = vec![
        variant("rest", near, |_| ()),
        variant("zero", wide, |chain| chain.start = Start::Zero),
        variant("random", near, |chain| chain.start = Start::Random),
        variant("ring", near, |chain| chain.boundary = Boundary::Ring),
    ];
    if profile == Profile::Full {
        variants.extend([
            variant("restitution-0.6", wide, |chain| chain.restitution = 0.6),
            variant("restitution-0.9", low, |chain| chain.restitution = 0.9),
            variant("forcing-frequency-1.3", low, |chain| chain.forcing_frequency = 1.3),
            variant("forcing-frequency-1.6", wide, |chain| chain.forcing_frequency = 1.6),
        ]);
    }
    variants
}

/// Chains of several lengths, random starts and rings, after several transients.
pub fn chains(profile: Profile) -> Vec<Ensemble> {
    let full = profile == Profile::Full;
    let grid = |from, to| Grid::default().and(from, to, if full { 1 } else { 4 }, 100);
    let few = |n: usize| if full { n } else { n.div_ceil(24).max(2) };
    let chain = |name: &str, sigmas, realisations, transients: &[f64]| Ensemble {
        protocols: windows(transients, &[200.0]),
        stream: "chains".into(),
        ..paper(name, sigmas, few(realisations))
    };
    let length = |masses: usize, realisations, sigmas, transients: &[f64]| Ensemble {
        chain: Chain { masses, ..Chain::default() },
        pieces: (masses / 1000).max(1),
        ..chain(&format!("length-{masses}"), sigmas, realisations, transients)
    };
    let mut all = vec![
        length(10, 600, grid(9, 25), &[50.0, 250.0, 500.0]),
        length(100, 120, grid(8, 16), &[500.0]),
    ];
    if full {
        all.push(length(1000, 8, grid(8, 15), &[500.0, 750.0, 5000.0]));
        all.push(length(10_000, 2, grid(8, 14), &[500.0, 1000.0]));
    }
    let transients: &[f64] = if full { &[100.0, 500.0, 1000.0, 2000.0] } else { &[100.0, 500.0] };
    let mut random = chain("random", grid(9, 18), 24, transients);
    random.chain.start = Start::Random;
    // Beyond the rise the half height lies where more starts overlap; what is left of them is counted.
    random.most_rejected = 1.0;
    let mut ring = chain("ring", grid(9, 18), 24, transients);
    ring.chain.boundary = Boundary::Ring;
    all.extend([random, ring]);
    all
}

/// Chains of several restitutions.
pub fn restitution(profile: Profile) -> Vec<Ensemble> {
    let grid = Grid::default();
    let (restitutions, sigmas, realisations): (&[f64], _, _) = match profile {
        Profile::Full => (
            &[0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95],
            grid.and(8, 18, 1, 100).and(4, 6, 1, 20).and(2, 3, 1, 5),
            24,
        ),
        Profile::Quick => (&[0.0, 0.8], grid.and(9, 15, 6, 100).and(30, 60, 30, 100), 2),
    };
    let of = |&restitution: &f64| Ensemble {
        chain: Chain { restitution, ..Chain::default() },
        stream: "restitution".into(),
        ..paper(&format!("r = {restitution}"), sigmas.clone(), realisations)
    };
    restitutions.iter().map(of).collect()
}

/// Chains that come from above: the force is lowered after a time well beyond the rise.
pub fn history(profile: Profile) -> Vec<Ensemble> {
    let (sigmas, last, realisations) = match profile {
        Profile::Full => (Grid::default().and(2, 13, 1, 100), 4000.0, 32),
        Profile::Quick => (Grid::default().and(6, 12, 3, 100), 1000.0, 3),
    };
    vec![Ensemble {
        heating: Some(Heating { sigma: 0.2, time: 300.0 }),
        protocols: windows(&[500.0, last], &[200.0]),
        ..paper("history", sigmas, realisations)
    }]
}

/// Lengths after several transients, near enough to the half height to tell 0.002 apart.
pub fn sizes(profile: Profile) -> Vec<Ensemble> {
    let cases: &[(f64, usize, usize, u32)] = match profile {
        Profile::Full => &[
            (500.0, 100, 150, 117),
            (500.0, 1000, 15, 117),
            (500.0, 10_000, 2, 117),
            (5000.0, 100, 125, 107),
            (5000.0, 1000, 12, 103),
            (5000.0, 10_000, 2, 103),
            (50_000.0, 100, 100, 103),
            (50_000.0, 1000, 3, 98),
            (50_000.0, 10_000, 2, 96),
        ],
        Profile::Quick => {
            &[(50.0, 20, 10, 160), (50.0, 100, 2, 140), (500.0, 20, 10, 125), (500.0, 100, 2, 117)]
        }
    };
    let of = |&(transient, masses, realisations, middle): &(f64, usize, usize, u32)| Ensemble {
        chain: Chain { masses, ..Chain::default() },
        protocols: windows(&[transient], &[200.0]),
        pieces: (masses / 1000).max(1),
        stream: "sizes".into(),
        ..paper(
            &format!("{masses} masses, T = {transient}"),
            Grid::default().and(middle - 4, middle + 4, 4, 1000),
            realisations,
        )
    };
    cases.iter().map(of).collect()
}

/// The long end of the map over transients and windows.
pub fn long_protocol(profile: Profile) -> Vec<Ensemble> {
    let (transients, widths, step, realisations): (&[f64], &[f64], _, _) = match profile {
        Profile::Full => (&[1e3, 4e3, 1e4, 2e4], &[20.0, 200.0, 2000.0], 1, 12),
        Profile::Quick => (&[500.0, 1e3], &[20.0, 200.0], 11, 2),
    };
    vec![Ensemble {
        protocols: windows(transients, widths),
        stream: "long-protocol".into(),
        ..paper("long_protocol", Grid::default().and(26, 48, step, 400), realisations)
    }]
}
