//! Replays the motions of Figs. 5(b) and 6(b), and a periodic orbit for each of their circuits.

use crate::experiments::prelude::*;
use impact_circuits::graph::Graph;
use std::collections::BTreeSet;

pub const SEGMENTS: Experiment<(), Segments> = Experiment {
    name: "segments",
    own: &["src/experiments/segments.rs"],
    reads: &[],
    parameters: |_| (),
    how: Read(read),
    tables,
};

/// The two segments, and periodic orbits with the same impacts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segments {
    /// Fig. 5(b): L-1, 1-2, 3-R.
    pub fig05: Segment,
    /// Fig. 6(b): L-1, L-1, 1-2, L-1, 2-3, 1-2, 3-R, 3-R.
    pub fig06: Segment,
    /// Periodic orbits with the impacts of Fig. 5 and of Fig. 6, each over two periods.
    pub periodic: [Segment; 2],
    /// Periodic orbits that are no circuit, over two periods too: one without an impact, and one in
    /// which two masses, driven against each other, hit both walls at one instant.
    pub no_circuit: [Segment; 2],
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Segment {
    pub spacing: f64,
    pub masses: usize,
    /// Its beginning, after the start of the run.
    pub from: f64,
    pub until: f64,
    /// A grid of times from `from` to `until` that includes every impact.
    pub times: Vec<f64>,
    /// Positions on that grid, `positions[mass][time]`.
    pub positions: Vec<Vec<f64>>,
    pub impacts: Vec<SegmentImpact>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentImpact {
    pub time: f64,
    /// Gap: 0 is left wall–mass 1.
    pub gap: usize,
    /// Where the two bodies touch.
    pub position: f64,
}

/// Periods after which masses that hit one another have come to a periodic orbit.
const TRANSIENT: f64 = 1000.0;

/// Points of the grid between two impacts, at least.
const POINTS: usize = 200;

impl Segment {
    /// Returns the impacts of the circuit, each once, without a last one that closes it.
    pub fn circuit(&self) -> &[SegmentImpact] {
        match &self.impacts[..] {
            [first, .., last] if first.gap == last.gap => &self.impacts[..self.impacts.len() - 1],
            impacts => impacts,
        }
    }

    /// Returns the names of its impacts as the paper has them: `L-1, 1-2, 3-R`.
    pub fn names(&self) -> Vec<String> {
        let graph = Graph::of_chain(self.masses);
        self.circuit().iter().map(|impact| graph.label(impact.gap).to_string()).collect()
    }

    /// Returns how often each different impact is repeated beyond its first time, most first.
    pub fn repeats(&self) -> Vec<(String, usize)> {
        let mut names = self.names();
        names.sort();
        let counts = names.chunk_by(|a, b| a == b).map(|same| (same[0].clone(), same.len() - 1));
        let mut repeats: Vec<_> = counts.filter(|(_, times)| *times > 0).collect();
        repeats.sort_by_key(|(_, times)| std::cmp::Reverse(*times));
        repeats
    }

    /// Returns a segment over two periods with the impacts of the first alone.
    pub fn first_period(&self) -> Segment {
        let impacts = self.impacts[..self.impacts.len() / 2].to_vec();
        Segment { impacts, ..self.clone() }
    }

    /// Returns the largest distance of positions and of impact times one period apart, or infinity
    /// if the impacts differ.
    fn apart(&self) -> f64 {
        let (first, second) = self.impacts.split_at(self.impacts.len() / 2);
        let same = first.iter().map(|impact| impact.gap).eq(second.iter().map(|impact| impact.gap));
        if !same || self.times.len().is_multiple_of(2) {
            return f64::INFINITY;
        }
        let period = 0.5 * (self.until - self.from);
        let times = first.iter().zip(second).map(|(a, b)| (b.time - a.time - period).abs());
        let positions = self.positions.iter().flat_map(|track| {
            track.iter().zip(&track[track.len() / 2..]).map(|(a, b)| (a - b).abs())
        });
        times.chain(positions).fold(0.0, f64::max)
    }

    pub fn masses_hit(&self) -> usize {
        let both_sides = self.impacts.iter().flat_map(|impact| [impact.gap, impact.gap + 1]);
        both_sides.filter(|body| (1..=self.masses).contains(body)).collect::<BTreeSet<_>>().len()
    }

    fn instants(&self) -> usize {
        self.impacts.chunk_by(|a, b| a.time == b.time).count()
    }

    fn gaps(&self) -> BTreeSet<usize> {
        self.impacts.iter().map(|impact| impact.gap).collect()
    }
}

pub fn tables(segments: &Segments) -> Vec<Table> {
    let [first, second] = &segments.periodic;
    let figures = [(5.0, &segments.fig05), (6.0, &segments.fig06)];
    let table = Table::builder("segments.circuits", &figures, |_| 1)
        .table_computed_by(origin(Segment::circuit))
        .key("figure", "1", |(figure, _)| *figure)
        .count("masses", "that take part", |(_, one)| one.masses_hit() as u64)
        .computed_by(origin(Segment::masses_hit), &["masses"])
        .count("length", "impacts", |(_, one)| one.circuit().len() as u64)
        .count("distinct", "different impacts", |(_, one)| one.gaps().len() as u64)
        .count("repeated", "of them repeated", |(_, one)| one.repeats().len() as u64)
        .done();
    let orbits = [(5.0, first), (6.0, second)];
    let orbits = Table::builder("segments.orbits", &orbits, |_| 1)
        .key("figure", "1", |(figure, _)| *figure)
        .real("period", "1/omega", 4, "of the orbit", |(_, one)| 0.5 * (one.until - one.from))
        .computed_by(origin(record), &["period"])
        .real("apart", "1", 1, "largest distance of two periods in d and 1/ω", |row| row.1.apart())
        .computed_by(origin(Segment::apart), &["apart"])
        .done();
    const INSTANTS: &str = "different times at which it has impacts";
    let exceptions = ["no impact", "impacts at once"].into_iter().zip(&segments.no_circuit);
    let exceptions = Vec::from_iter(exceptions.map(|(name, two)| (name, two, two.first_period())));
    let exceptions = Table::builder("segments.no_circuit", &exceptions, |_| 1)
        .text_key("orbit", |(name, ..)| name.to_string())
        .count("impacts", "in a period", |(_, _, one)| one.impacts.len() as u64)
        .computed_by(origin(record), &["impacts"])
        .count("instants", INSTANTS, |(_, _, one)| one.instants() as u64)
        .computed_by(origin(Segment::instants), &["instants"])
        .real("apart", "1", 1, "largest distance of two periods in d and 1/ω", |row| row.1.apart())
        .computed_by(origin(Segment::apart), &["apart"])
        .done();
    vec![table, orbits, exceptions]
}

/// The files of the saved scenarios, below the templates directory.
pub const FILES: [&str; 4] = [
    "scenarios/fig05.json",
    "scenarios/fig06.json",
    "scenarios/fig05-periodic.json",
    "scenarios/fig06-periodic.json",
];

#[derive(Deserialize)]
struct Saved {
    scenario: serde_json::Value,
    from: f64,
    until: f64,
}

pub fn read(session: &Session<'_>) -> Result<Segments, Error> {
    let one = |file: &str| {
        let json = session.templates.text(file).map_err(|error| error.to_string());
        json.and_then(replay).map_err(|problem| {
            let remedy = "restore it, or find it anew by the directed search";
            Error::input(file, one_line(&problem, 500), remedy)
        })
    };
    let [fig05, fig06, first, second] = FILES.map(one);
    let failure = |source| Error::failed("a periodic orbit", source);
    let [silent, at_once] = [(Start::Zero, [0.0, 0.5], 0.0), (Start::Rest, [1.0, -1.0], TRANSIENT)]
        .map(|(start, forces, from)| {
            let chain = Chain { masses: 2, start, ..Chain::default() };
            let period = std::f64::consts::TAU / chain.forcing_frequency;
            Scenario::given(&chain, forces.map(|force| [force, 0.0]).to_vec())
                .and_then(|pair| record(&pair, from * period, (from + 2.0) * period))
                .map_err(failure)
        });
    let (periodic, no_circuit) = ([first?, second?], [silent?, at_once?]);
    Ok(Segments { fig05: fig05?, fig06: fig06?, periodic, no_circuit })
}

/// Records the segment of a saved scenario.
fn replay(json: &str) -> Result<Segment, String> {
    let saved: Saved = serde_json::from_str(json).map_err(|error| error.to_string())?;
    Scenario::from_json(&saved.scenario.to_string())
        .and_then(|scenario| record(&scenario, saved.from, saved.until))
        .map_err(|error| error.to_string())
}

/// Runs a scenario and records positions and impacts from `from` to `until`.
fn record(scenario: &Scenario, from: f64, until: f64) -> Result<Segment, impact_chain::Error> {
    let mut engine = Engine::new(scenario)?;
    engine.advance(from)?;
    let (masses, spacing) = (scenario.forcing.len(), scenario.spacing);
    let (mut times, mut tracks, mut impacts) = (Vec::new(), vec![Vec::new(); masses], Vec::new());
    let mut push = |time: f64, positions: Vec<f64>| {
        times.push(time);
        tracks.iter_mut().zip(positions).for_each(|(track, x)| track.push(x));
    };
    let step = (until - from) / POINTS as f64;
    for point in 0..=POINTS {
        let time = if point == POINTS { until } else { from + point as f64 * step };
        // The engine stops after each impact, because positions are exact only up to the next.
        while let Some(Impact { time, gap, .. }) = engine.next_impact(time)? {
            let positions = engine.state(time)?.positions;
            let position = if gap == 0 { 0.0 } else { positions[gap.min(masses) - 1] };
            impacts.push(SegmentImpact { time, gap, position });
            push(time, positions);
        }
        push(time, engine.state(time)?.positions);
    }
    Ok(Segment { spacing, masses, from, until, times, positions: tracks, impacts })
}
