//! Finds the earliest of many keys, each of which may change at any time.

use super::clock::Instant;

/// Keys 0..len, of which the earliest is found at once; among equal keys the lowest index wins.
///
/// A winner tree over single words: the time from an epoch to the key in units of 2^-58, whose last
/// bits are replaced by the index. The lesser word is the earlier key, unless the two agree in all
/// other bits (2^-51 of time for 100 keys, 2^-38 for a million). Then [`first`](Self::first) is the
/// lower index, [`is_close`](Self::is_close) is true, and [`first_in_full`](Self::first_in_full)
/// compares the full keys of all words that agree with the root. So there is no branch on the way
/// up, and only callers that need the exact order pay for it. Words end 64 units of time after the
/// epoch; when no key is left before that end, the earliest becomes the epoch. The shape is fixed,
/// so the order of changes never matters.
#[derive(Clone, Debug)]
pub struct Earliest {
    /// The keys in full, "never" beyond `len`.
    keys: Vec<Instant>,
    /// The winner below each node, root at 1; the leaves are the second half.
    nodes: Vec<u64>,
    epoch: Instant,
}

impl Earliest {
    /// Creates `len` ≥ 1 keys, all [`Instant::NEVER`].
    pub fn new(len: usize) -> Self {
        let width = len.next_power_of_two();
        let mut earliest = Earliest {
            keys: vec![Instant::NEVER; width],
            nodes: vec![0; 2 * width],
            epoch: Instant::ZERO,
        };
        earliest.rebase(Instant::ZERO);
        earliest
    }

    fn rebase(&mut self, epoch: Instant) {
        self.epoch = epoch;
        let width = self.keys.len();
        for index in 0..width {
            self.nodes[width + index] = self.word(index, self.keys[index]);
        }
        for node in (1..width).rev() {
            self.nodes[node] = self.nodes[2 * node].min(self.nodes[2 * node + 1]);
        }
    }

    /// Returns the bits of a word that hold its index.
    #[inline(always)]
    fn mask(&self) -> u64 {
        self.keys.len() as u64 - 1
    }

    #[inline(always)]
    fn word(&self, index: usize, key: Instant) -> u64 {
        key.units_since(self.epoch) & !self.mask() | index as u64
    }

    /// Changes the keys of `first`, `first` + 1, …, at most three.
    ///
    /// Neighbours have at most two nodes of each level above them. The two winners are carried
    /// upwards in registers, each against one sibling from memory, so the latency is a comparison a
    /// level; no branch depends on the winner, which no processor can predict.
    #[inline(always)]
    pub fn set<const K: usize>(&mut self, first: usize, keys: [Instant; K]) {
        const { assert!(K <= 3) };
        let width = self.keys.len();
        self.keys[first..first + K].copy_from_slice(&keys);
        let words: [u64; K] = std::array::from_fn(|i| self.word(first + i, keys[i]));
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
    }

    #[inline(always)]
    pub fn key(&self, index: usize) -> Instant {
        self.keys[index]
    }

    /// Returns index and key of the least word: none is earlier beyond the resolution of words.
    #[inline(always)]
    pub fn first(&mut self) -> (usize, Instant) {
        let (word, mask) = (self.nodes[1], self.mask());
        if word >= !mask {
            return self.next_epoch();
        }
        let index = (word & mask) as usize;
        (index, self.keys[index])
    }

    /// Returns whether another word agrees with that of `index`, the first, except for the index.
    #[inline(always)]
    pub fn is_close(&self, index: usize) -> bool {
        // Such a word, or another that agrees with it, lost to this one on its way up.
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

    /// Returns index and key of the earliest full key; of equal ones the fastest, then the lowest.
    #[cold]
    pub fn first_in_full(&self, speed: impl Fn(usize) -> f64) -> (usize, Instant) {
        let mut agreeing = vec![1];
        let (mut first, mut key, mut fastest) = (0, Instant::NEVER, f64::NEG_INFINITY);
        while let Some(node) = agreeing.pop() {
            if self.nodes[node] ^ self.nodes[1] > self.mask() {
                continue;
            }
            let Some(index) = node.checked_sub(self.keys.len()) else {
                agreeing.extend([2 * node + 1, 2 * node]);
                continue;
            };
            let candidate = self.keys[index];
            if candidate > key || candidate == Instant::NEVER {
                continue;
            }
            let speed = speed(index);
            if candidate < key || speed > fastest {
                (first, key, fastest) = (index, candidate, speed);
            }
        }
        (first, key)
    }

    /// Moves the epoch, as no key is left before the end of the words.
    #[cold]
    fn next_epoch(&mut self) -> (usize, Instant) {
        let (index, key) = self.first_in_full(|_| 0.0);
        if key < Instant::NEVER {
            self.rebase(key);
        }
        (index, key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::{Seed, generator};
    use rand::Rng;

    /// Scans all keys: exact ties, ties of words alone, times before and after the epoch.
    #[test]
    fn agrees_with_a_scan() {
        fn check(earliest: &mut Earliest, keys: &[Instant]) {
            let index = (0..keys.len()).min_by_key(|&i| (keys[i], i)).unwrap();
            let (first, key) = earliest.first();
            assert!(earliest.is_close(first) || first == index);
            assert_eq!(key, keys[first]);
            assert_eq!(earliest.first_in_full(|_| 0.0), (index, keys[index]));
            // The fastest of equal keys, and the lowest of those.
            let fastest = (0..keys.len()).min_by_key(|&i| (keys[i], 9 - i % 10, i)).unwrap();
            if key < Instant::NEVER {
                assert_eq!(earliest.first_in_full(|i| (i % 10) as f64), (fastest, keys[fastest]));
            }
        }
        for len in [1, 2, 7, 8, 9, 101, 700] {
            let mut earliest = Earliest::new(len);
            let mut keys = vec![Instant::NEVER; len];
            let mut random = generator("earliest", Seed(1), len as u64);
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
                if index + 3 <= len {
                    let three = [0, 1, 2].map(|i| moment.after(f64::from(i) * 0.25));
                    keys[index..index + 3].copy_from_slice(&three);
                    earliest.set(index, three);
                    check(&mut earliest, &keys);
                }
            }
        }
    }
}
