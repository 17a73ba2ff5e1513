//! Chooses the ensembles of chains: which chains, at which σ, and how many.

use super::chosen::SECOND_SEED;
use super::ensemble::{Beyond, Ensemble, Heating};
use impact_chain::{Boundary, Chain, Protocol, Start};
use literate::experiments::Profile;

/// Lists the windows (T, T + W] of all transients T, each with all widths W.
pub fn windows(transients: &[f64], widths: &[f64]) -> Vec<Protocol> {
    let after = |&transient| widths.iter().map(move |&window| Protocol { transient, window });
    transients.iter().flat_map(after).collect()
}

/// The paper's chain from rest, with our protocol (the default of [`Ensemble`]). The name is that
/// of its random stream too: ensembles of one name have the same chains, also in experiments with
/// other names.
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
        Profile::Full => {
            let rise = grid.and(4..=15, 200).and(32..=72, 400);
            (rise.and(19..=28, 100).and(15..=20, 50), 1000, 100)
        }
        Profile::Quick => {
            let rise = grid.and([2, 4, 6, 8], 100).and(9..=16, 100);
            (rise.and([9], 50).and(4..=8, 20), 12, 6)
        }
    };
    let beyond = Beyond { above: 0.16, realisations: Some(few), until: None };
    vec![Ensemble { beyond: Some(beyond), ..paper("sweep", sigmas, realisations) }]
}

/// The headline numbers again, with another seed and fewer realisations on the rise only.
pub fn second_seed(profile: Profile) -> Vec<Ensemble> {
    let (sigmas, realisations) = match profile {
        Profile::Full => (Grid::default().and(34..=54, 400), 200),
        Profile::Quick => (Grid::default().and(8..=16, 100), 8),
    };
    // The stream of the main sweep: only the seed differs.
    vec![Ensemble { seed: SECOND_SEED, ..paper("sweep", sigmas, realisations) }]
}

/// The map over transients and windows, and chains of the main sweep well below the rise.
pub fn protocol(profile: Profile) -> Vec<Ensemble> {
    let (longest, widest, sigmas, realisations, below) = match profile {
        Profile::Full => {
            (9, 7, Grid::default().and((34..=68).step_by(2), 400).and(18..=22, 100), 80, 1000)
        }
        Profile::Quick => (6, 5, Grid::default().and(9..=17, 100), 6, 100),
    };
    let transients = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0, 4000.0];
    let widths = [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0];
    let protocols = windows(&transients[..longest], &widths[..widest]);
    // Above, nearly every gap has been hit long before the end.
    let beyond = Some(Beyond { above: 0.131, realisations: None, until: Some(1000.0) });
    let map = paper("protocol", sigmas, realisations);
    let below = paper("sweep", Grid::default().and([8], 100), below);
    vec![Ensemble { protocols: protocols.clone(), beyond, ..map }, Ensemble { protocols, ..below }]
}

/// The paper's chain, and chains that differ from it in start, ends or frequency.
pub fn starts(profile: Profile) -> Vec<Ensemble> {
    let (step, realisations) = if profile == Profile::Quick { (2, 4) } else { (1, 100) };
    let variant = |name: &str, [from, to]: [u32; 2], change: fn(&mut Chain)| {
        let sigmas = Grid::default().and((from..=to).step_by(step), 100);
        let mut one = Ensemble { stream: "starts".into(), ..paper(name, sigmas, realisations) };
        change(&mut one.chain);
        one
    };
    vec![
        variant("rest", [8, 18], |_| ()),
        variant("random", [8, 18], |chain| chain.start = Start::Random),
        variant("ring", [8, 18], |chain| chain.boundary = Boundary::Ring),
        variant("forcing-frequency-1.3", [4, 14], |chain| chain.forcing_frequency = 1.3),
        variant("forcing-frequency-1.6", [11, 19], |chain| chain.forcing_frequency = 1.6),
    ]
}

/// Chains from rest of several lengths, and chains with a random start.
pub fn lengths(profile: Profile) -> Vec<Ensemble> {
    // Masses, σ in thousandths (first, last, step), realisations, transient, windows.
    type Sizes = (usize, [u32; 3], usize, f64, &'static [f64]);
    let sizes: &[Sizes] = match profile {
        Profile::Full => &[
            (100, [80, 160, 10], 120, 500.0, &[200.0]),
            (10_000, [80, 150, 10], 2, 500.0, &[200.0]),
            (100, [90, 114, 8], 30, 2e4, &[2000.0]),
        ],
        Profile::Quick => &[
            (20, [140, 180, 20], 10, 50.0, &[200.0]),
            (100, [120, 160, 20], 2, 50.0, &[200.0]),
            (100, [100, 140, 20], 2, 500.0, &[200.0, 2000.0]),
        ],
    };
    let rest = |&(masses, [from, to, step], realisations, transient, widths): &Sizes| {
        let name = format!("rest, n = {masses}, T = {transient}");
        let sigmas = Grid::default().and((from..=to).step_by(step as usize), 1000);
        Ensemble {
            chain: Chain { masses, ..Chain::default() },
            protocols: windows(&[transient], widths),
            pieces: (masses / 250).max(1),
            stream: "sizes".into(),
            ..paper(&name, sigmas, realisations)
        }
    };
    let (transients, step, realisations): (&[f64], _, _) = match profile {
        Profile::Full => (&[100.0, 500.0, 1000.0, 2000.0], 1, 24),
        Profile::Quick => (&[100.0, 500.0], 4, 2),
    };
    let random = Ensemble {
        chain: Chain { start: Start::Random, ..Chain::default() },
        protocols: windows(transients, &[200.0]),
        stream: "chains".into(),
        // The half height lies where many random starts overlap; the others are counted.
        most_rejected: 1.0,
        ..paper("random", Grid::default().and((9..=18).step_by(step), 100), realisations)
    };
    sizes.iter().map(rest).chain([random]).collect()
}

/// Chains from rest and from above at the σ of their half heights; σ = 0.09 for a fixed σ.
pub fn branches(profile: Profile) -> Vec<Ensemble> {
    const REST: Option<Heating> = None;
    const ABOVE: Option<Heating> = Some(Heating { sigma: 0.2, time: 300.0 });
    const ALL: &[f64] = &[500.0, 5e3, 2e4, 5e4, 1e5];
    // Masses, start, σ in ten-thousandths (first, last, step), transients.
    type Sizes = (&'static [usize], Option<Heating>, [u32; 3], &'static [f64]);
    let (chains, sizes): (_, &[Sizes]) = match profile {
        // Steps of 0.0025 where half heights lie in the long chains, and from above in the short.
        Profile::Full => (
            12,
            &[
                (&[1000], REST, [900, 900, 25], ALL),
                (&[1000], REST, [950, 975, 25], ALL),
                (&[1000], REST, [1000, 1000, 25], &ALL[..4]),
                // Short chains rise later.
                (&[300], REST, [950, 1050, 50], ALL),
                (&[1000], REST, [1025, 1050, 25], &ALL[..2]),
                (&[300], REST, [1100, 1100, 25], &ALL[..2]),
                (&[1000], REST, [1100, 1100, 25], &ALL[..1]),
                (&[300, 1000], REST, [1150, 1250, 25], &ALL[..1]),
                (&[300, 1000], ABOVE, [650, 750, 25], &ALL[..1]),
                (&[300], ABOVE, [800, 825, 25], &ALL[..1]),
                (&[1000], ABOVE, [800, 825, 25], &ALL[..2]),
                (&[300, 1000], ABOVE, [850, 900, 25], ALL),
            ],
        ),
        Profile::Quick => (
            3,
            &[
                (&[60, 200], REST, [900, 1700, 200], &[50.0, 200.0, 500.0]),
                (&[60, 200], ABOVE, [100, 900, 200], &[50.0, 200.0, 500.0]),
            ],
        ),
    };
    let mut ensembles = Vec::new();
    for &(lengths, heating, [from, to, step], transients) in sizes {
        for &masses in lengths {
            let start = if heating.is_some() { "above" } else { "rest" };
            let name = format!("{start}, n = {masses}, σ from {}", f64::from(from) / 1e4);
            let sigmas = Grid::default().and((from..=to).step_by(step as usize), 10_000);
            ensembles.push(Ensemble {
                chain: Chain { masses, ..Chain::default() },
                heating,
                protocols: windows(transients, &[200.0]),
                stream: "history".into(),
                ..paper(&name, sigmas, chains)
            });
        }
    }
    ensembles
}

/// Chains of several restitutions, each at the σ where its half height may lie.
pub fn restitution(profile: Profile) -> Vec<Ensemble> {
    // σ around the half height, and up to strong forces.
    let large = Grid::default().and(16..=18, 100).and(4..=7, 20).and([2], 5);
    let small = Grid::default().and(8..=14, 100).and(16..=18, 100).and([4], 20).and([2], 5);
    let (cases, realisations): (Vec<(&[f64], Grid)>, _) = match profile {
        Profile::Full => (
            vec![
                (&[0.0, 0.05, 0.1, 0.2, 0.4], large),
                (&[0.6], Grid::default().and(10..=20, 100)),
                (&[0.8, 0.9, 0.95], small),
            ],
            24,
        ),
        Profile::Quick => (vec![(&[0.0, 0.8], Grid::default().and([9, 15, 30, 60], 100))], 2),
    };
    let ensemble = |restitution: f64, sigmas: &Grid| Ensemble {
        chain: Chain { restitution, ..Chain::default() },
        stream: "restitution".into(),
        ..paper(&format!("r = {restitution}"), sigmas.clone(), realisations)
    };
    let of_case =
        |(all, sigmas): &(&[f64], Grid)| Vec::from_iter(all.iter().map(|r| ensemble(*r, sigmas)));
    cases.iter().flat_map(of_case).collect()
}

/// Chains from rest for the jump of the mode, in each window with T + W ≤ 700 of the map, and rings
/// with our protocol: each σ has chains of its own, so that errors at different σ are independent.
pub fn jump(profile: Profile) -> Vec<Ensemble> {
    // σ in hundred thousandths (first, last, step), and chains at each.
    type Stretch = ([u32; 3], usize);
    let (stretches, rings): (&[Stretch], Stretch) = match profile {
        Profile::Full => (
            &[
                ([8000, 10_000, 500], 2000),
                ([10_250, 11_250, 250], 1200),
                // Dense where our protocol has the jump.
                ([11_500, 12_250, 125], 2000),
                ([12_500, 14_500, 500], 800),
                ([15_000, 17_000, 500], 200),
                ([18_000, 20_000, 1000], 150),
                // Where a single gap is overtaken; few of these chains have an impact.
                ([8750, 9750, 500], 3500),
            ],
            ([10_750, 11_750, 250], 800),
        ),
        Profile::Quick => (&[([9000, 15_000, 1000], 60)], ([10_000, 14_000, 2000], 20)),
    };
    let transients = [10.0, 20.0, 50.0, 100.0, 200.0, 500.0];
    let mut protocols = windows(&transients, &[20.0, 50.0, 100.0, 200.0, 500.0]);
    protocols.retain(|protocol| protocol.end() <= 700.0);
    let (mut ensembles, mut first) = (Vec::new(), 0);
    let walls = stretches.iter().map(|stretch| ("σ", stretch, &protocols[..]));
    for (name, &([from, to, step], realisations), protocols) in
        walls.chain([("ring, σ", &rings, &[Protocol::default()][..])])
    {
        for sigma in Grid::default().and((from..=to).step_by(step as usize), 100_000).values() {
            let mut chains = paper(&format!("{name} = {sigma}"), Grid::default(), realisations);
            (chains.sigmas, chains.protocols) = (vec![sigma], protocols.into());
            (chains.first, chains.stream) = (first, "jump".into());
            if name != "σ" {
                chains.chain.boundary = Boundary::Ring;
            }
            ensembles.push(chains);
            first += realisations as u64;
        }
    }
    ensembles.sort_by(|a, b| a.sigmas[0].total_cmp(&b.sigmas[0]));
    ensembles.sort_by_key(|one| one.chain.boundary == Boundary::Ring);
    ensembles
}

/// A σ axis made of stretches of equal steps; values are quotients, so 0.12 is the nearest double.
#[derive(Clone, Debug, Default)]
pub struct Grid(Vec<f64>);

impl Grid {
    /// Appends i / `denominator` for each numerator i.
    pub fn and(mut self, numerators: impl IntoIterator<Item = u32>, denominator: u32) -> Self {
        self.0.extend(numerators.into_iter().map(|i| f64::from(i) / f64::from(denominator)));
        self
    }

    pub fn values(self) -> Vec<f64> {
        debug_assert!(self.0.windows(2).all(|w| w[0] < w[1]));
        self.0
    }
}
