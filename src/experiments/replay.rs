//! Runs what a page repeats, each run with a digest of the bits of its impacts.

use crate::experiments::prelude::*;
use literate::input::sha256;
use std::collections::BTreeSet;

pub const REPLAY: Experiment<ReplayRuns, Replays> = Experiment {
    own: &["src/experiments/replay.rs"],
    how: Whole(run, |_| WORK_PER_SECOND / 10),
    ..Experiment::new("replay", runs, run, tables)
};

/// The input of a run: all that determines its bits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    pub chain: Chain,
    pub forces: Forces,
    /// Transient T after which gaps with an impact are counted.
    pub transient: f64,
    /// Window W in which they are counted.
    pub window: f64,
}

/// The source of the amplitudes of the forcing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Forces {
    /// A realisation of a random stream, with the standard deviation σ.
    Drawn { sigma: f64, stream: String, seed: u64, realisation: u64 },
    /// Given as (α, β) for each mass; the start is not random.
    Given(Vec<[f64; 2]>),
}

pub type ReplayRuns = Vec<(String, Request)>;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Replays {
    pub parameters: ReplayRuns,
    #[serde(rename = "found")]
    pub results: Vec<ReplayResult>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReplayResult {
    pub impacts: u64,
    pub distinct: u64,
    pub contact_phases: u64,
    /// Runs of neighbouring gaps that closed at one instant.
    pub simultaneous: u64,
    /// SHA-256 (hexadecimal) of the impacts' times, gaps and closing speeds, 8 bytes little-endian.
    pub digest: String,
}

/// Returns the runs: realisations behind Fig. 3, and others that are difficult for an engine.
pub fn runs(_: Profile) -> ReplayRuns {
    let draw = |sigma: f64, chain: Chain| {
        let forces = Forces::Drawn { sigma, stream: "sweep".into(), seed: SEED, realisation: 0 };
        let Protocol { transient, window } = Protocol::default();
        Request { chain, forces, transient, window }
    };
    let give = |pairs: Vec<[f64; 2]>, restitution: f64, until: f64| {
        let chain = Chain { masses: pairs.len(), restitution, ..Chain::default() };
        Request { chain, forces: Forces::Given(pairs), transient: 0.0, window: until }
    };
    let (chain, threshold) = (Chain::default, params::printed_threshold());
    let at_threshold = format!("Fig. 3 at σ = {threshold}");
    let hit_twice = vec![[2.0, 1.0], [0.0; 2], [-2.0, -1.0]];
    let third = Forces::Drawn { sigma: 0.1, stream: "sweep".into(), seed: SEED, realisation: 3 };
    // Towards the middle, not in mirror symmetry.
    let pairs = (0..5).map(f64::from).map(|j| [3.0 * (4.0 - 2.0 * j) + 0.1 * j, 0.3 * j]);
    let runs = [
        (&at_threshold[..], draw(threshold, chain())),
        ("Fig. 3 at σ = 0.05, without an impact", draw(0.05, chain())),
        ("Fig. 3 at σ = 0.1, realisation 3", Request { forces: third, ..draw(0.1, chain()) }),
        ("Fig. 3 at σ = 0.2", draw(0.2, chain())),
        ("Fig. 3 at σ = 0.3", draw(0.3, chain())),
        ("a ring", draw(0.2, Chain { boundary: Boundary::Ring, ..chain() })),
        ("a random start", draw(0.16, Chain { start: Start::Random, ..chain() })),
        ("no loss, r = 1", draw(threshold, Chain { restitution: 1.0, ..chain() })),
        ("no rebound, r = 0", draw(0.3, Chain { restitution: 0.0, ..chain() })),
        ("a thousand masses", draw(0.16, Chain { masses: 1000, ..chain() })),
        ("chatter: one mass comes to rest at a wall", give(vec![[5.88, -4.94]], 0.2, 20.0)),
        ("contact: five masses are pressed together", give(pairs.collect(), 0.2, 20.0)),
        ("ties: a mass is hit from both sides", give(hit_twice, 0.8, 100.0)),
        ("ties: a chain is its own mirror image", give(mirrored(), 0.8, 50.0)),
    ];
    runs.map(|(name, request)| (name.to_string(), request)).into()
}

/// Returns the forces on 20 masses of which the right half mirrors the left.
fn mirrored() -> Vec<[f64; 2]> {
    let chain = Chain { masses: 10, ..Chain::default() };
    let half = Scenario::draw(&chain, 0.3, &mut NormalPairs::new("mirror", Seed(SEED), 0)).forcing;
    half.iter().copied().chain(half.iter().rev().map(|pair| pair.map(|x| -x))).collect()
}

pub fn run(parameters: &ReplayRuns, progress: &Progress) -> Result<Replays, Error> {
    let stage = progress.stage("replays", parameters.len() as u64);
    let one = |(_, request): &(String, Request)| {
        replay(request).map_err(|source| Error::failed("replay", source))
    };
    let results = run_each(&stage, progress, parameters, one)?;
    Ok(Replays { parameters: parameters.clone(), results })
}

fn replay(request: &Request) -> Result<ReplayResult, impact_chain::Error> {
    let scenario = match &request.forces {
        Forces::Drawn { sigma, stream, seed, realisation } => {
            let mut normals = NormalPairs::new(stream, Seed(*seed), *realisation);
            Scenario::draw(&request.chain, *sigma, &mut normals)
        }
        Forces::Given(pairs) => Scenario::given(&request.chain, pairs.clone())?,
    };
    let mut engine = Engine::new(&scenario)?;
    let (mut hit, mut bytes) = (BTreeSet::new(), Vec::new());
    for impact in engine.impacts(request.transient + request.window)? {
        let Impact { time, gap, closing_speed } = impact;
        for bits in [time.to_bits(), gap as u64, closing_speed.to_bits()] {
            bytes.extend(bits.to_le_bytes());
        }
        if time > request.transient {
            hit.insert(gap);
        }
    }
    let work = engine.counters();
    Ok(ReplayResult {
        impacts: work.impacts,
        distinct: hit.len() as u64,
        contact_phases: work.contact_phases,
        simultaneous: work.simultaneous,
        digest: sha256(bytes),
    })
}

pub fn tables(replays: &Replays) -> Vec<Table> {
    let rows: Vec<_> = replays.parameters.iter().zip(&replays.results).collect();
    let runs = Table::builder("replay.runs", &rows, |_| 1)
        .table_computed_by(origin(run))
        .text_key("run", |((name, _), _)| name.clone())
        .count("masses", "masses", |((_, request), _)| request.chain.masses as u64)
        .chosen("until", TIME, "length", |((_, request), _)| {
            Some(request.transient + request.window)
        })
        .count("impacts", "impacts", |(_, result)| result.impacts)
        .count("distinct", "gaps with an impact in the window", |(_, result)| result.distinct)
        .count("contact_phases", "contact phases", |(_, result)| result.contact_phases)
        .count("simultaneous", "ties", |(_, result)| result.simultaneous)
        .words("sha256", "of all impacts: time, gap, speed", |(_, result)| result.digest.clone())
        .computed_by(origin(run), &["sha256"])
        .done();
    let sums = Table::builder("replay.all", &[replays], |replays| replays.results.len())
        .table_computed_by(origin(run))
        .count("runs", "runs", |replays| replays.results.len() as u64)
        .count("impacts", "impacts of all", |replays| {
            replays.results.iter().map(|result| result.impacts).sum()
        })
        .done();
    vec![runs, sums]
}
