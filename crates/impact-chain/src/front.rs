//! Long chains: the events of a slice of time along a front, so that neighbours follow one another in memory too.
//!
//! In the order of time the next event may be anywhere, and in a chain of a million each waits for memory. But an event of
//! gap k concerns the gaps k − 1, k and k + 1 alone. So a slice of time is gone through by a front from both ends to the
//! middle: those events come first for which t + λ (distance from the end) is least. At any moment only some hundred
//! gaps are concerned, and they are read ahead in the order of memory.
//!
//! **Why the impacts are the same.** Two events out of order matter to one another only if they concern a common gap. The
//! one that is taken last, though it is earlier, finds that gap framed later than itself; and the other would have found it waiting,
//! had it been known by then. Each event looks for both (`is_local`). If one finds either, or an exact tie, or is part of a contact
//! of too many gaps, the slice is undone as a whole and taken in order. That is rare: the front passes some hundred gaps
//! in a unit of time, impacts that are merely close to one another are kept in order by a walk to what is earlier nearby, and
//! no run of impacts was seen to overtake it but those that were made to.
//!
//! The front from each end meets the other only in the middle, so each half of a chain may have a core of its own (`halves`).

use super::Error;
use super::engine::{Impact, Sink};
use super::flight::{Motion, Phases};
use super::force::Force;
use super::simulation::{Awaits, Gap, NEARLY_SHUT, Simulation};
use super::simultaneous::Simultaneous;
use impact_numerics::clock::Instant;
use impact_numerics::earliest::Begins;
use impact_numerics::first_root::Work;
use std::hint::black_box;
use std::ops::Range;

/// From so many gaps on, a chain is taken along a front: shorter ones stay in the cache as they are.
const LONG: usize = 50_000;

/// Gaps of each half that the front spans.
const PLACES: usize = 512;

/// Events of a slice, for each gap: so many are wanted, and no more are taken before the slice is given up. With fewer, the
/// chain is read more often; with more, there is more to keep.
const WANTED: f64 = 1.0;
const MOST: usize = 2;

/// Units of time in a slice, at least and at most: the queue has words for 64, each of them for 1/[`WORDS`].
const LEAST: f64 = 1e-9;
const LARGEST: f64 = 30.0;
const WORDS: f64 = (1u64 << 58) as f64;

/// A slice is a waste that has fewer events for each gap, however long it is.
const FEW: f64 = 0.02;

/// An event of contact may concern gaps so far on either side, and one more; of impacts at one instant there are fewer.
pub(super) const NEARBY: usize = 8;

/// Gaps of each half that are read at once.
const AHEAD: usize = 64;

/// A gap as it was before the slice, with the free part of the mass to its left.
#[derive(Clone, Debug)]
struct Before<const M: usize> {
    k: usize,
    gap: Gap<M>,
    key: Instant,
    free: [f64; 2],
}

/// What contact changes besides, of a gap and the mass to its left.
type BeforeContact<const M: usize> = (usize, Motion<M>, Force<M>);

/// An impact that is yet to be handed out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Found {
    at: Instant,
    /// How many were found before it.
    number: u32,
    k: u32,
    closing_speed: f64,
}

/// What a simulation counts: the time of its last event, its work, its impacts and phases of contact, its budget.
pub(super) type Counted = (Instant, Work, [u64; 2], (Instant, u64));

/// What a slice changed, as it was before, and the impacts it found.
#[derive(Clone, Debug)]
pub(super) struct Slice<const M: usize> {
    before: Vec<Before<M>>,
    before_contact: Vec<BeforeContact<M>>,
    pub found: Vec<Found>,
}

/// The front of a long chain.
#[derive(Clone, Debug)]
pub(super) struct Front<const M: usize> {
    pub places: usize,
    wanted: f64,
    /// Units of time that the next slice is to take.
    pub height: f64,
    /// Units of time that were taken in order after the last slice, since it was a waste: twice as many each time.
    pub pause: f64,
    pub slice: Slice<M>,
    /// Whether each half has a core of its own.
    pub on_two_cores: bool,
    #[cfg(test)]
    undone: u32,
    #[cfg(test)]
    pub by_halves: u32,
}

impl<const M: usize> Slice<M> {
    pub const NEW: Self =
        Slice { before: Vec::new(), before_contact: Vec::new(), found: Vec::new() };

    /// Sorts the impacts found by time.
    fn sort(&mut self) {
        // By two comparisons, of which the second is hardly ever asked for.
        self.found.sort_unstable_by(|a, b| a.at.cmp(&b.at).then(a.number.cmp(&b.number)));
    }

    /// Adds the impacts of a part whose gaps begin at `from`; of one instant, those of the lower gaps come first.
    #[cfg(not(target_family = "wasm"))]
    pub fn add(&mut self, part: &Self, from: usize) {
        let moved = |found: &Found| Found { k: found.k + from as u32, ..*found };
        self.found.extend(part.found.iter().map(moved));
        self.found.sort_by_key(|found| found.at);
    }

    /// Whether impacts of one instant are as in the order of time, where the lowest gap of all comes first: here the lowest
    /// nearby does.
    pub fn is_sorted(&self) -> bool {
        let mut instants = self.found.chunk_by(|one, next| one.at == next.at);
        instants.all(|own| own.len() < NEARBY && own.is_sorted_by(|one, next| one.k <= next.k + 1))
    }
}

impl<const M: usize> Front<M> {
    /// Bytes for each gap, at most.
    pub const BYTES: usize = size_of::<Before<M>>() + MOST * size_of::<Found>();

    /// Of a chain of so many gaps, should it need one.
    pub fn of(gaps: usize, natural_frequency: f64) -> Option<Self> {
        (gaps >= LONG).then(|| Self::new(PLACES, WANTED, 0.5 / natural_frequency))
    }

    fn new(places: usize, wanted: f64, height: f64) -> Self {
        Front {
            places,
            wanted,
            height: height.clamp(LEAST, LARGEST),
            pause: 0.0,
            slice: Slice::NEW,
            on_two_cores: false,
            #[cfg(test)]
            undone: 0,
            #[cfg(test)]
            by_halves: 0,
        }
    }

    /// How long the next slice is, where so much time is left: all alike, and a whole number of what words can tell.
    pub fn next_height(&self, left: f64) -> f64 {
        (left / (left / self.height).ceil() * WORDS).floor() / WORDS
    }

    /// Has the next slice take as long as so many events ask for, or half as long after one that was given up; and pauses after
    /// a waste.
    pub fn learn(&mut self, height: f64, events_per_gap: Option<f64>) {
        #[cfg(test)]
        {
            self.undone += u32::from(events_per_gap.is_none());
        }
        let factor = events_per_gap.map_or(0.5, |events| (self.wanted / events).clamp(0.5, 2.0));
        self.height = (height * factor).clamp(LEAST, LARGEST);
        let is_few = |events| height > 0.5 * LARGEST && events < FEW;
        self.pause =
            if events_per_gap.is_none_or(is_few) { height.max(2.0 * self.pause) } else { 0.0 };
    }
}

impl<const M: usize> Simulation<M> {
    /// Runs along the front, on as many cores as it has, up to `end` or as far as is worth it; false if the receiver wants no more.
    pub(super) fn run_along(
        &mut self,
        front: &mut Front<M>,
        end: Instant,
        sink: Sink,
    ) -> Result<bool, Error> {
        #[cfg(not(target_family = "wasm"))]
        if front.on_two_cores && !self.run_on_two_cores(front, end, sink)? {
            return Ok(false);
        }
        self.run_in_slices(front, end, sink)
    }

    /// Runs slice by slice up to `end`, or as far as is worth a slice; false if the receiver wants no more.
    fn run_in_slices(
        &mut self,
        front: &mut Front<M>,
        end: Instant,
        sink: Sink,
    ) -> Result<bool, Error> {
        let mut begin = self.now;
        loop {
            let left = end.since(begin);
            if left < 0.25 * front.height {
                break;
            }
            let height = front.next_height(left);
            let counted = self.counted();
            let (gaps, places) = (self.gaps.len(), front.places);
            let events =
                self.follow(&mut front.slice, begin, height, places, Begins::AtEnds, 0..gaps);
            let events = events.filter(|_| front.slice.is_sorted());
            if events.is_some() {
                begin = begin.after(height);
                if let Some(handed) = self.hand_out_found(&front.slice.found, sink) {
                    self.undo(&mut front.slice, counted);
                    return self.run_again(begin, handed);
                }
            } else {
                self.undo(&mut front.slice, counted);
            }
            front.learn(height, events.map(|events| events as f64 / gaps as f64));
            if front.pause > 0.0 {
                begin = begin.after(front.pause.min(end.since(begin)));
                self.queue.straighten();
                if !self.run_in_order(begin, sink)? {
                    return Ok(false);
                }
            }
        }
        self.queue.straighten();
        Ok(true)
    }

    /// Hands out the impacts of a slice; tells how many, if the receiver wants no more.
    pub(super) fn hand_out_found(&self, found: &[Found], sink: Sink) -> Option<usize> {
        let is_last = |&Found { at, k, closing_speed, .. }: &Found| {
            !sink(Impact { time: at.time(), gap: self.topology.label(k as usize), closing_speed })
        };
        found.iter().position(is_last).map(|last| last + 1)
    }

    /// After a slice that was undone: to the state right after the last of the impacts that were `handed` out, in order.
    pub(super) fn run_again(&mut self, end: Instant, mut handed: usize) -> Result<bool, Error> {
        self.run_in_order(end, &mut |_| {
            handed -= 1;
            handed > 0
        })
    }

    /// Takes the events of a slice along the front, all among the gaps `inside`, and counts them; nothing if one of them cannot be
    /// taken there.
    pub(super) fn follow(
        &mut self,
        slice: &mut Slice<M>,
        begin: Instant,
        height: f64,
        places: usize,
        from: Begins,
        inside: Range<usize>,
    ) -> Option<usize> {
        slice.before.clear();
        slice.before_contact.clear();
        slice.found.clear();
        self.queue.slant(begin, height, places, from);
        let (mut latest, mut read, mut events, gaps) = (self.now, 0, 0, self.gaps.len());
        while let Some((k, at)) = self.queue.first_nearby() {
            self.read_ahead(k, &mut read);
            self.now = at;
            events += 1;
            if events > MOST * gaps
                || !inside.contains(&k)
                || !(self.is_local(k, begin, slice) || self.is_local_contact(k, begin, slice))
            {
                return None;
            }
            if let Some(Impact { closing_speed, .. }) = self.step(k).ok()? {
                let number = slice.found.len() as u32;
                slice.found.push(Found { at, number, k: k as u32, closing_speed });
            }
            latest = latest.max(at);
        }
        self.now = latest;
        slice.sort();
        Some(events)
    }

    /// Whether the event of gap k now concerns no more than its neighbours, and comes in order among them. Keeps them, if so.
    #[inline(always)]
    fn is_local(&self, k: usize, begin: Instant, slice: &mut Slice<M>) -> bool {
        let own = &self.gaps[k];
        let local = match own.awaits {
            Awaits::Search { .. } => !own.in_contact,
            Awaits::Impact(speed) => {
                let beside = self.topology.adjacent(k).into_iter().flatten();
                let local = !self.is_slow(self.restitution * speed)
                    && beside
                        .clone()
                        .all(|near| !self.gaps[near].in_contact && self.waits_for(near));
                if local {
                    beside.for_each(|near| self.remember(near, begin, slice));
                }
                local
            }
            Awaits::Release | Awaits::Nothing => false,
        };
        if local {
            self.remember(k, begin, slice);
        }
        local
    }

    /// Whether gap `near` may be changed now: it was not changed later, nor waits for what comes before.
    #[inline(always)]
    fn waits_for(&self, near: usize) -> bool {
        self.gaps[near].origin <= self.now && self.queue.key(near) > self.now
    }

    /// The same of an event in which contact begins, goes on or ends: it concerns the gaps up to the first on either side
    /// that is open, and one more.
    #[cold]
    fn is_local_contact(&self, k: usize, begin: Instant, slice: &mut Slice<M>) -> bool {
        let phases = Phases::at(&self.rates, self.now);
        let is_open = |near: &usize| {
            let width = self.look(*near, &phases).f0;
            !self.gaps[*near].in_contact && width > NEARLY_SHUT * self.spacing
        };
        let most = self.gaps.len() - 1;
        let first = (k.saturating_sub(NEARBY)..k).rev().find(is_open).filter(|&first| first > 0);
        let last = (k + 1..=most.min(k + NEARBY)).find(is_open).filter(|&last| last < most);
        let Some((first, last)) = first.zip(last) else { return false };
        let concerned = first - 1..=last + 1;
        let local = self.ties.law == Simultaneous::Sequential
            && concerned.clone().all(|near| near == k || self.waits_for(near));
        if local {
            for near in concerned {
                self.remember(near, begin, slice);
                let left = self.motions[self.topology.sides(near)[0]];
                slice.before_contact.push((near, left, self.forces[near]));
            }
        }
        local
    }

    /// Keeps gap k as it was before the slice, if it still is.
    #[inline(always)]
    fn remember(&self, k: usize, begin: Instant, slice: &mut Slice<M>) {
        let gap = self.gaps[k];
        if gap.origin <= begin {
            let left = &self.motions[self.topology.sides(k)[0]];
            slice.before.push(Before { k, gap, key: self.queue.key(k), free: [left.a, left.b] });
        }
    }

    /// What is counted so far.
    pub(super) fn counted(&self) -> Counted {
        let budget = (self.budget_end, self.budget_left);
        (self.now, self.work, [self.impacts, self.contact_phases], budget)
    }

    /// Makes all as it was before the slice, and the order straight.
    pub(super) fn undo(&mut self, slice: &mut Slice<M>, counted: Counted) {
        // Backwards: what was kept twice was kept first as it was before.
        while let Some((k, left, force)) = slice.before_contact.pop() {
            self.motions[self.topology.sides(k)[0]] = left;
            self.forces[k] = force;
        }
        while let Some(Before { k, gap, key, free }) = slice.before.pop() {
            self.gaps[k] = gap;
            self.queue.restore(k, key);
            let left = &mut self.motions[self.topology.sides(k)[0]];
            [left.a, left.b] = free;
        }
        let budget;
        (self.now, self.work, [self.impacts, self.contact_phases], budget) = counted;
        (self.budget_end, self.budget_left) = budget;
        self.queue.straighten();
    }

    /// Has the memory of the next gaps at hand, when the front comes near: one after the other, as the processor foresees.
    #[inline(always)]
    fn read_ahead(&self, k: usize, read: &mut usize) {
        let place = self.queue.place(k);
        if place + AHEAD / 2 < *read {
            return;
        }
        let from = place.max(*read);
        *read = from + AHEAD;
        for near in from..(*read).min(self.queue.places()) {
            for k in self.queue.at_place(near) {
                let gap = &self.gaps[k];
                black_box((gap.frame.f0, gap.in_contact, self.motions[k].a, self.queue.leaf(k)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Boundary, Chain, Counters, Initial, Scenario};
    use impact_numerics::random::NormalPairs;

    fn drawn(chain: &Chain, sigma: f64) -> Scenario {
        Scenario::draw(chain, sigma, &mut NormalPairs::new("front", 1, 0))
    }

    /// What a run gives, all of it in bits.
    type Given = (Vec<(u64, usize, u64)>, Counters, Vec<[u64; 2]>, Vec<(usize, u64)>);

    /// Runs with an interruption by the receiver, a pause and a piece that is too short for a slice; tells how many
    /// slices were undone, and how many taken by halves.
    fn run(scenario: &Scenario, until: f64, front: Option<Front<1>>) -> (Given, [u32; 2]) {
        let mut simulation = Simulation::<1>::new(scenario).unwrap();
        simulation.front = front.map(Box::new);
        let mut impacts = Vec::new();
        for (part, stops) in [(0.4, false), (0.401, false), (0.8, true), (1.0, false)] {
            let enough = if stops { impacts.len() + impacts.len() / 2 } else { usize::MAX };
            simulation
                .run(part * until, &mut |impact| {
                    impacts.push((
                        impact.time.to_bits(),
                        impact.gap,
                        impact.closing_speed.to_bits(),
                    ));
                    impacts.len() < enough
                })
                .unwrap();
            impacts.push((simulation.time().to_bits(), 0, 0));
        }
        let free = simulation.free_parts().iter().map(|part| part.map(f64::to_bits)).collect();
        let places = simulation.contacts(until).iter().map(|(k, f)| (*k, f.to_bits())).collect();
        let slices =
            simulation.front.as_ref().map_or([0; 2], |front| [front.undone, front.by_halves]);
        ((impacts, simulation.counters(), free, places), slices)
    }

    /// Holds a run in slices of all kinds against one in order; tells how many slices were undone.
    fn agrees(scenario: &Scenario, until: f64) -> u32 {
        let (plain, _) = run(scenario, until, None);
        assert!(plain.1.impacts > 300, "{}", plain.1.impacts);
        let (mut undone, mut by_halves) = (0, 0);
        for (places, wanted) in [(1, 1.0), (8, 0.05), (8, 1.0), (64, 0.3), (512, 1.0)] {
            for on_two_cores in [false, true] {
                let front = Front { on_two_cores, ..Front::new(places, wanted, 0.5) };
                let (own, slices) = run(scenario, until, Some(front));
                assert!(own == plain, "{places} places, {wanted} events a gap, {on_two_cores}");
                undone += slices[0];
                by_halves += slices[1];
            }
        }
        assert!(by_halves > 2 || scenario.boundary == Boundary::Ring, "{by_halves}");
        undone
    }

    /// A slice that is undone leaves everything as it was, contact included.
    fn undoes(scenario: &Scenario) {
        let mut simulation = Simulation::<1>::new(scenario).unwrap();
        let mut in_contact = 0;
        for i in 1..40 {
            simulation.run(0.25 * f64::from(i), &mut |_| true).unwrap();
            let state = |of: &Simulation<1>| {
                let keys: Vec<Instant> = (0..of.gaps.len()).map(|k| of.queue.key(k)).collect();
                format!("{:?}", (&of.motions, &of.gaps, &of.forces, keys, of.counted()))
            };
            let (before, counted) = (state(&simulation), simulation.counted());
            let (mut slice, gaps) = (Slice::NEW, simulation.gaps.len());
            simulation.follow(&mut slice, simulation.now, 0.5, 64, Begins::AtEnds, 0..gaps);
            in_contact += slice.before_contact.len();
            simulation.undo(&mut slice, counted);
            assert!(state(&simulation) == before, "at {i}/4");
        }
        assert!(in_contact > 100, "{in_contact}");
    }

    fn chain(masses: usize, restitution: f64, boundary: Boundary) -> Chain {
        Chain { masses, restitution, boundary, ..Chain::default() }
    }

    /// The same impacts to the last bit, in the same order, and the same state and counts, whatever is hit how hard.
    #[test]
    fn impacts_are_those_of_the_order_of_time() {
        for boundary in [Boundary::Walls, Boundary::Ring] {
            for (restitution, sigma) in [(0.8, 0.3), (0.8, 0.12), (1.0, 0.2), (0.3, 0.5)] {
                agrees(&drawn(&chain(1000, restitution, boundary), sigma), 40.0);
            }
        }
        // Whatever number of threads is there.
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| agrees(&drawn(&chain(2000, 0.5, Boundary::Walls), 0.3), 20.0));
        }
        // Nothing of it is luck: a front of the engine's own steepness has nothing to undo.
        let scenario = drawn(&chain(3000, 0.8, Boundary::Walls), 0.3);
        assert_eq!(run(&scenario, 100.0, Some(Front::new(PLACES, WANTED, 0.5))).1[0], 0);
    }

    /// Contact and ties are no matter of two masses. The chain is its own mirror image, with a mass at rest in the middle.
    #[test]
    fn contact_and_ties_are_taken_in_order() {
        for (restitution, sigma) in [(0.0, 0.6), (0.2, 1.0)] {
            let contact = drawn(&chain(1000, restitution, Boundary::Walls), sigma);
            let (given, _) = run(&contact, 10.0, None);
            assert!(given.1.contact_phases > 10 && !given.3.is_empty(), "{:?}", given.1);
            agrees(&contact, 10.0);
            undoes(&contact);
        }
        let mut mirror = drawn(&chain(999, 0.8, Boundary::Walls), 0.4);
        for j in 0..500 {
            mirror.forcing[998 - j] = mirror.forcing[j].map(|x| if j == 499 { 0.0 } else { -x });
        }
        for simultaneous in [Simultaneous::Sequential, Simultaneous::Joint] {
            let scenario = Scenario { simultaneous, ..mirror.clone() };
            assert!(run(&scenario, 40.0, None).0.1.simultaneous > 0);
            assert!(agrees(&scenario, 40.0) > 0);
        }
    }

    /// Masses that stand close are struck from both sides. The faster shock goes through them faster than any front, and
    /// meets the slower one where the front from the right had taken that already.
    #[test]
    fn what_overtakes_the_front_is_undone() {
        let mut scenario = Scenario { restitution: 1.0, ..drawn(&Chain::default(), 0.0) };
        let n = 1000;
        scenario.forcing = vec![[0.0; 2]; n];
        let mut free: Vec<[f64; 2]> =
            (0..n).map(|j| [0.999_99 * (500.0 - j as f64), 0.0]).collect();
        (free[0][1], free[n - 1][1]) = (50.0, -5.0);
        scenario.initial = Initial::Free(free);
        assert!(agrees(&scenario, 1.0) >= 5);
    }

    /// A silent chain comes to any time at once: slices without events are not worth one each.
    #[test]
    fn silence_is_skipped() {
        let scenario = drawn(&chain(LONG, 0.8, Boundary::Walls), 0.01);
        let mut simulation = Simulation::<1>::new(&scenario).unwrap();
        simulation.run(1e12, &mut |_| true).unwrap();
        assert_eq!(simulation.counters().impacts, 0);
    }

    /// A million impacts, and a chain that is long enough to be taken along a front unasked.
    #[test]
    #[ignore = "seconds"]
    fn a_long_chain_has_the_same_impacts() {
        let scenario = drawn(&chain(100_000, 0.8, Boundary::Walls), 0.3);
        let front = Simulation::<1>::new(&scenario).unwrap().front;
        let (plain, _) = run(&scenario, 60.0, None);
        assert!(plain.1.impacts > 1_000_000);
        for on_two_cores in [false, true] {
            let front = front.clone().map(|front| Front { on_two_cores, ..*front });
            let (own, [undone, by_halves]) = run(&scenario, 60.0, front);
            assert!(own == plain && undone == 0, "{undone} slices undone");
            assert!(by_halves > 10 || !on_two_cores, "{by_halves}");
        }
    }
}
