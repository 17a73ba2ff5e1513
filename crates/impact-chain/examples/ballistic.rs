//! Another model, for its speed: masses that fly freely between elastic impacts, with the engine's queue. What it takes
//! less than the engine is the price of forces, springs and certified searches.
//!
//!     cargo run --release -p impact-chain --example ballistic -- MASSES IMPACTS

use impact_chain::search::clock::Instant;
use impact_chain::search::earliest::Earliest;
use impact_numerics::random::NormalPairs;

/// A mass in free flight: where it was, since when, and how fast it is.
#[derive(Clone, Copy)]
struct Flight {
    place: f64,
    since: Instant,
    velocity: f64,
}

/// Masses at unit distances between walls, which are masses that never move.
struct Gas(Vec<Flight>, Earliest);

impl Gas {
    fn new(masses: usize) -> Self {
        let mut normals = NormalPairs::new("ballistic", 1, 0);
        let flight = |j: usize| {
            let velocity = if j == 0 || j > masses { 0.0 } else { normals.pair()[0] };
            Flight { place: j as f64, since: Instant::ZERO, velocity }
        };
        let mut row = Gas((0..masses + 2).map(flight).collect(), Earliest::new(masses + 1));
        (0..=masses).for_each(|gap| row.1.set(gap, [row.closes(gap, Instant::ZERO)]));
        row
    }

    /// When a gap closes that is open at `now`.
    fn closes(&self, gap: usize, now: Instant) -> Instant {
        let [left, right] = [self.0[gap], self.0[gap + 1]];
        let at = |own: Flight| own.place + own.velocity * now.since(own.since);
        let speed = left.velocity - right.velocity;
        if speed > 0.0 {
            now.after((at(right) - at(left)).max(0.0) / speed)
        } else {
            Instant::NEVER
        }
    }

    /// The next impact: equal masses exchange their velocities, a wall turns one round.
    fn step(&mut self) {
        let (gap, now) = self.1.first();
        let last = self.0.len() - 2;
        for j in [gap, gap + 1] {
            let own = &mut self.0[j];
            own.place += own.velocity * now.since(own.since);
            own.since = now;
        }
        let [a, b] = [self.0[gap].velocity, self.0[gap + 1].velocity];
        self.0[gap].velocity = if gap == 0 {
            0.0
        } else if gap == last {
            -a
        } else {
            b
        };
        self.0[gap + 1].velocity = if gap == last {
            0.0
        } else if gap == 0 {
            -b
        } else {
            a
        };
        // The masses of this gap part, so it does not close before one of them is hit again.
        let never = Instant::NEVER;
        match gap {
            0 => self.1.set(0, [never, self.closes(1, now)]),
            _ if gap == last => self.1.set(gap - 1, [self.closes(gap - 1, now), never]),
            _ => self.1.set(gap - 1, [self.closes(gap - 1, now), never, self.closes(gap + 1, now)]),
        }
    }
}

fn main() {
    let mut asked = std::env::args().skip(1).map(|text| text.parse::<usize>());
    let (Some(Ok(masses)), Some(Ok(impacts))) = (asked.next(), asked.next()) else {
        eprintln!("give the numbers of masses and of impacts: 100 1000000");
        std::process::exit(2)
    };
    let mut row = Gas::new(masses.max(2));
    let energy = |row: &Gas| row.0.iter().map(|own| own.velocity * own.velocity).sum::<f64>();
    let before = energy(&row);
    let began = std::time::Instant::now();
    (0..impacts).for_each(|_| row.step());
    let seconds = began.elapsed().as_secs_f64();
    // Impacts only exchange velocities.
    assert!((energy(&row) / before - 1.0).abs() < 1e-9);
    println!("{}", seconds / impacts as f64 * 1e6);
}
