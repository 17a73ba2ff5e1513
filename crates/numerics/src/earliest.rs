//! The earliest of many keys, each of which may change at any time.

use super::clock::Instant;

/// Keys 0..len with the earliest at hand; among equal keys the lowest index wins.
///
/// A winner tree over single words: the time from an epoch to the key in units of 2^-58, whose last bits give way to the
/// index. The lesser word is the earlier key, unless the two agree in all other bits (2^-51 of time for 100 keys, 2^-38 for a
/// million). Then the lower index is [`first`](Self::first), which [`is_close`](Self::is_close) tells, and
/// [`first_in_full`](Self::first_in_full) goes by the full keys. So there is no branch on the way up, and only who
/// needs the exact order asks for it. Of all words that agree with the root, it then knows the winner in full below each node,
/// and changes keep that up as long as the root stays: a thousand keys of one instant are looked through once, not for each
/// of them. Words end 64 units of time after the epoch; when no key is left
/// before that end, the earliest becomes the epoch. The shape is fixed, so the order of changes never matters.
///
/// The order may be [slanted](Self::slant): then a key counts as later by its distance from an end, and
/// [`first_nearby`](Self::first_nearby) goes from that end inwards, or from both ends to the middle.
#[derive(Clone, Debug)]
pub struct Earliest {
    /// The keys in full, "never" beyond `len`.
    keys: Vec<Instant>,
    /// The winner below each node, root at 1; the leaves are the second half.
    nodes: Vec<u64>,
    /// The winner by full keys below each node, no leaf, whose word agrees with this one but for the index, as the root's does.
    agrees_with: Option<u64>,
    in_full: Vec<u32>,
    epoch: Instant,
    last: usize,
    slant: Option<Slant>,
    from: Begins,
    /// Words from here on are of no key that is left.
    beyond: u64,
    /// Nodes whose winner in full was looked for.
    #[cfg(test)]
    looked: u64,
}

/// Where a slanted order begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begins {
    /// At both ends: the middle comes last. The last and the first are neighbours too.
    AtEnds,
    /// At the first key; those of the last places, so many, are left out.
    AtFirst(usize),
    /// At the last key; those of the first places, so many, are left out.
    AtLast(usize),
}

/// How words are made where the order is slanted, in units of 2^-58 of time.
#[derive(Clone, Copy, Debug)]
struct Slant {
    /// From this time after the epoch on, keys have no words.
    height: u64,
    /// Words have no room for the last bits of a time.
    shift: u32,
    /// What one step away from the end adds.
    step: u64,
}

/// With a slanted order, keys that may be earlier than the first are looked for within so many places.
const NEARBY: usize = 4;

impl Earliest {
    /// Bytes for each key, of a power of two of them.
    pub const BYTES: usize = size_of::<Instant>() + 2 * size_of::<u64>() + size_of::<u32>();

    /// `len` ≥ 1 keys, all [`Instant::NEVER`].
    pub fn new(len: usize) -> Self {
        Self::of(vec![Instant::NEVER; len])
    }

    /// Of one key or more.
    pub fn of(mut keys: Vec<Instant>) -> Self {
        let (last, width) = (keys.len() - 1, keys.len().next_power_of_two());
        keys.resize(width, Instant::NEVER);
        let epoch = keys.iter().min().copied().filter(|&key| key < Instant::NEVER);
        let mut earliest = Earliest {
            keys,
            nodes: vec![0; 2 * width],
            agrees_with: None,
            in_full: Vec::new(),
            epoch: Instant::ZERO,
            last,
            slant: None,
            from: Begins::AtEnds,
            beyond: 0,
            #[cfg(test)]
            looked: 0,
        };
        earliest.rebase(epoch.unwrap_or(Instant::ZERO));
        earliest
    }

    /// The keys.
    pub fn keys(&self) -> &[Instant] {
        &self.keys[..=self.last]
    }

    /// Makes all words anew, for another epoch.
    fn rebase(&mut self, epoch: Instant) {
        (self.epoch, self.agrees_with) = (epoch, None);
        self.beyond = !self.mask();
        let width = self.keys.len();
        for index in 0..width {
            self.nodes[width + index] = match &self.slant {
                None => self.word(index, self.keys[index]),
                Some(slant) => self.slanted_word(slant, index, self.keys[index]),
            };
        }
        for node in (1..width).rev() {
            self.nodes[node] = self.nodes[2 * node].min(self.nodes[2 * node + 1]);
        }
    }

    /// Those bits of a word that are its index.
    #[inline(always)]
    fn mask(&self) -> u64 {
        self.keys.len() as u64 - 1
    }

    #[inline(always)]
    fn word(&self, index: usize, key: Instant) -> u64 {
        key.fine(self.epoch) & !self.mask() | index as u64
    }

    #[inline(always)]
    fn slanted_word(&self, slant: &Slant, index: usize, key: Instant) -> u64 {
        let fine = key.fine(self.epoch);
        // Wraps where there is no key.
        let slanted =
            (fine >> slant.shift).wrapping_add(slant.step.wrapping_mul(self.place(index) as u64));
        let time = if fine < slant.height { slanted } else { u64::MAX };
        time & !self.mask() | index as u64
    }

    /// How far `index` is from where the order begins.
    #[inline(always)]
    pub fn place(&self, index: usize) -> usize {
        let back = (self.last + 1).wrapping_sub(index);
        match self.from {
            Begins::AtEnds => index.min(back),
            Begins::AtFirst(_) => index,
            Begins::AtLast(_) => back,
        }
    }

    /// How many places there are.
    pub fn places(&self) -> usize {
        if self.from == Begins::AtEnds { self.keys().len() / 2 } else { self.keys().len() }
    }

    /// The keys at a place, or next to it: one from each end where the order begins.
    #[inline(always)]
    pub fn at_place(&self, place: usize) -> [usize; 2] {
        match self.from {
            Begins::AtEnds => [place, self.last - place],
            Begins::AtFirst(_) => [place; 2],
            Begins::AtLast(_) => [self.last - place; 2],
        }
    }

    /// Slants the order: of all keys within `height` units of time from `epoch`, those come first that are least when one
    /// place away from where it begins counts as much as `height` / `places`.
    pub fn slant(&mut self, epoch: Instant, height: f64, places: usize, from: Begins) {
        let height = Instant::ZERO.after(height).fine(Instant::ZERO);
        // The farthest place adds so many heights.
        let shift = (1 + self.last / places).ilog2() + 1;
        let step = (height >> shift) / places as u64;
        (self.slant, self.from) = (Some(Slant { height, shift, step }), from);
        self.rebase(epoch);
        if let Begins::AtFirst(out) | Begins::AtLast(out) = from {
            self.beyond = step * (self.last + 1).saturating_sub(out) as u64;
        }
    }

    /// Has the order straight again.
    pub fn straighten(&mut self) {
        if self.slant.take().is_none() {
            return;
        }
        let first = self.keys.iter().min().copied().filter(|&key| key < Instant::NEVER);
        self.from = Begins::AtEnds;
        self.rebase(first.unwrap_or(self.epoch));
    }

    /// The first in the slanted order, or whom a walk to earlier keys a few places farther in leads to. Nothing if none is
    /// left within the height, and before those that are left out.
    #[inline(always)]
    pub fn first_nearby(&self) -> Option<(usize, Instant)> {
        let word = self.nodes[1];
        if word >= self.beyond {
            return None;
        }
        let mut index = (word & self.mask()) as usize;
        let turn = match self.from {
            Begins::AtEnds => self.last / 2,
            Begins::AtFirst(_) => self.keys.len() - 1 - NEARBY,
            Begins::AtLast(_) => 0,
        };
        loop {
            let from = if index <= turn { index } else { index.saturating_sub(NEARBY) };
            let nearby = &self.keys[from..=from + NEARBY];
            let earlier = |best: usize, i: usize| if nearby[i] < nearby[best] { i } else { best };
            let best = (1..=NEARBY).fold(0, earlier);
            if from + best == index {
                return Some((index, nearby[best]));
            }
            index = from + best;
        }
    }

    /// Sets key `index` again; its word waits for the next change of the order.
    pub fn restore(&mut self, index: usize, key: Instant) {
        self.keys[index] = key;
    }

    /// Changes the keys of `first`, `first` + 1, …, at most three.
    ///
    /// Neighbours have at most two nodes of each level above them. The two winners are carried
    /// upwards in registers, each against one sibling from memory, so the wait is a comparison a
    /// level; no branch depends on who wins, for no processor can predict it.
    #[inline(always)]
    pub fn set<const K: usize>(&mut self, first: usize, keys: [Instant; K]) {
        const { assert!(K <= 3) };
        let width = self.keys.len();
        self.keys[first..first + K].copy_from_slice(&keys);
        let words: [u64; K] = match &self.slant {
            None => std::array::from_fn(|i| self.word(first + i, keys[i])),
            Some(slant) => std::array::from_fn(|i| self.slanted_word(slant, first + i, keys[i])),
        };
        let nodes = self.nodes.as_mut_slice();
        let mask = nodes.len() - 1;
        let (mut low, mut high) = (width + first, width + first + K - 1);
        nodes[low..=high].copy_from_slice(&words);
        let (mut left, mut right) = (words[0], words[K - 1]);
        while low > 1 {
            left = left.min(nodes[(low ^ 1) & mask]);
            low >>= 1;
            if K > 1 {
                right = right.min(nodes[(high ^ 1) & mask]);
                high >>= 1;
                nodes[high & mask] = right;
            }
            nodes[low & mask] = left;
        }
        if let Some(word) = self.agrees_with {
            self.keep_in_full(word, first, first + K - 1);
        }
    }

    /// Whether key `index` has an equal next to it, where the last and the first are neighbours too.
    #[inline(always)]
    pub fn ties_beside(&self, index: usize) -> bool {
        let before = if index == 0 { self.last } else { index - 1 };
        let after = if index == self.last { 0 } else { index + 1 };
        let own = self.keys[index];
        (self.keys[before] == own) | (self.keys[after] == own)
    }

    /// Key `index`, and its word: what a change of it reads first.
    #[inline(always)]
    pub fn leaf(&self, index: usize) -> (Instant, u64) {
        (self.keys[index], self.nodes[self.keys.len() + index])
    }

    /// Key `index`.
    #[inline(always)]
    pub fn key(&self, index: usize) -> Instant {
        self.keys[index]
    }

    /// The index of the least word, and its key: no other is earlier by more than words can tell.
    #[inline(always)]
    pub fn first(&mut self) -> (usize, Instant) {
        let (word, mask) = (self.nodes[1], self.mask());
        if word >= !mask {
            return self.next_epoch();
        }
        let index = (word & mask) as usize;
        (index, self.keys[index])
    }

    /// Whether another word agrees with that of `index`, the first, but for the index.
    #[inline(always)]
    pub fn is_close(&self, index: usize) -> bool {
        // Such a word, or one like it, lost to it on its way up.
        let nodes = self.nodes.as_slice();
        let (word, mask) = (nodes[1], nodes.len() - 1);
        let mut node = self.keys.len() + index;
        let mut least = u64::MAX;
        while node > 1 {
            least = least.min(nodes[(node ^ 1) & mask] ^ word);
            node >>= 1;
        }
        least <= self.mask()
    }

    /// The index of the earliest of the full keys, and that key.
    #[cold]
    pub fn first_in_full(&mut self) -> (usize, Instant) {
        if self.agrees_with.is_none() {
            self.agrees_with = Some(self.nodes[1]);
            self.in_full.resize(self.keys.len(), 0);
            self.find_in_full(1);
        }
        let index = self.winner_in_full(1);
        (index, self.keys[index])
    }

    /// Whether the word of a node agrees with the root's but for the index.
    fn agrees(&self, node: usize) -> bool {
        self.nodes[node] ^ self.nodes[1] <= self.mask()
    }

    /// The winner in full below a node whose word agrees, once it is found.
    fn winner_in_full(&self, node: usize) -> usize {
        let width = self.keys.len();
        if node < width { self.in_full[node] as usize } else { node - width }
    }

    /// Finds the winners in full of a node whose word agrees, and of all such below it.
    fn find_in_full(&mut self, node: usize) {
        if node < self.keys.len() {
            for below in [2 * node, 2 * node + 1] {
                if self.agrees(below) {
                    self.find_in_full(below);
                }
            }
            self.compare_in_full(node);
        }
    }

    /// The winner in full of a node from those right below it.
    fn compare_in_full(&mut self, node: usize) {
        #[cfg(test)]
        {
            self.looked += 1;
        }
        let below = [2 * node, 2 * node + 1].into_iter().filter(|&below| self.agrees(below));
        let found = below.map(|below| self.winner_in_full(below));
        if let Some(index) = found.min_by_key(|&index| self.keys[index]) {
            self.in_full[node] = index as u32;
        }
    }

    /// After a change of the keys `first` to `last`: the winners in full above them, unless the root is another now.
    #[cold]
    fn keep_in_full(&mut self, word: u64, first: usize, last: usize) {
        if self.nodes[1] ^ word > self.mask() {
            self.agrees_with = None;
            return;
        }
        let (mut low, mut high) = (self.keys.len() + first, self.keys.len() + last);
        while low > 1 {
            (low, high) = (low >> 1, high >> 1);
            (low..=high).for_each(|node| self.compare_in_full(node));
        }
    }

    /// No key is left before the end of the words.
    #[cold]
    fn next_epoch(&mut self) -> (usize, Instant) {
        let (index, key) = self.first_in_full();
        if key < Instant::NEVER {
            self.rebase(key);
        }
        (index, key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::generator;
    use rand::Rng;

    /// Against a scan of all keys, with many exact ties, many that only words make, and times before and after the epoch.
    #[test]
    fn agrees_with_a_scan() {
        fn check(earliest: &mut Earliest, keys: &[Instant]) {
            let index = (0..keys.len()).min_by_key(|&i| (keys[i], i)).unwrap();
            let (first, key) = earliest.first();
            assert!(earliest.is_close(first) || first == index);
            assert_eq!(key, keys[first]);
            assert_eq!(earliest.first_in_full(), (index, keys[index]));
        }
        for len in [1, 2, 7, 8, 9, 101, 700] {
            let mut earliest = Earliest::new(len);
            let mut keys = vec![Instant::NEVER; len];
            let mut random = generator("earliest", 1, len as u64);
            for round in 0..4000 {
                let index = random.next_u64() as usize % len;
                // Keys go on with time, some are far off, and some before all others.
                let moment = Instant::at(0.25 * (round + random.next_u64() % 300) as f64);
                let key = match random.next_u64() % 4 {
                    0 => Instant::NEVER,
                    1 => moment,
                    _ => moment.after((random.next_u64() % 9) as f64 * 1e-20),
                };
                keys[index] = key;
                earliest.set(index, [key]);
                check(&mut earliest, &keys);
                let beside = [(index + len - 1) % len, (index + 1) % len];
                let tied = beside.into_iter().any(|i| keys[i] == keys[index]);
                assert_eq!(earliest.ties_beside(index), tied);
                if index + 3 <= len {
                    let three = [0, 1, 2].map(|i| moment.after(f64::from(i) * 0.25));
                    keys[index..index + 3].copy_from_slice(&three);
                    earliest.set(index, three);
                    check(&mut earliest, &keys);
                }
            }
        }
    }

    /// Keys of one instant, and of ticks after it, are looked through once, not for each of them: besides, an event looks at no
    /// more than two nodes of each level. It changes its own key and those beside it, some to the same instant.
    #[test]
    fn many_of_one_instant_are_looked_through_once() {
        const LEN: usize = 1000;
        let mut keys = vec![Instant::ZERO; LEN];
        let mut earliest = Earliest::of(keys.clone());
        let mut random = generator("instants", 1, 0);
        let (mut instants, mut last) = (0, f64::NEG_INFINITY);
        let events = 20 * LEN;
        for _ in 0..events {
            let (mut index, mut at) = earliest.first();
            if earliest.is_close(index) {
                (index, at) = earliest.first_in_full();
            }
            assert_eq!(index, (0..LEN).min_by_key(|&i| keys[i]).unwrap());
            instants += u64::from(at.time().floor() != last);
            last = at.time().floor();
            let from = index.saturating_sub(1).min(LEN - 3);
            let mut three = [keys[from], keys[from + 1], keys[from + 2]];
            three[index - from] = Instant::at(last + 1.0);
            for key in &mut three {
                let ticks = (random.next_u64() % 4) as f64 / (1u128 << 80) as f64;
                match random.next_u64() % 4 {
                    0 => *key = at.after(ticks),
                    1 => *key = Instant::at(last + 1.0).after(ticks),
                    _ => {}
                }
            }
            keys[from..from + 3].copy_from_slice(&three);
            earliest.set(from, three);
        }
        assert!(instants > 5 && instants * 100 < events as u64, "{instants}");
        let levels = u64::from(LEN.next_power_of_two().ilog2());
        let bound = instants * LEN.next_power_of_two() as u64 + 2 * levels * events as u64;
        assert!(earliest.looked <= bound, "{} of {bound}", earliest.looked);
    }

    /// The first and the last of a ring are neighbours, and the last may be earlier by one tick.
    #[test]
    fn a_tick_decides() {
        let mut earliest = Earliest::new(9);
        let early = Instant::at(10.5);
        let late = early.after(1.0 / (1u128 << 80) as f64);
        earliest.set(0, [late]);
        earliest.set(8, [early]);
        assert_eq!(earliest.first(), (0, late));
        assert!(earliest.is_close(0));
        assert_eq!(earliest.first_in_full(), (8, early));
        earliest.set(8, [late]);
        assert_eq!(earliest.first_in_full(), (0, late));
    }
}
