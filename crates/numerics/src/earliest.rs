//! The earliest of many keys, each of which may change at any time.

use super::clock::Instant;
use std::hint::select_unpredictable;

/// Keys 0..len with the earliest at hand; among equal keys the lowest index wins.
///
/// A winner tree over the keys rounded down to whole units of 2^-23 of time. Where two of those tie,
/// the full keys decide. The shape is fixed, so the order of changes never matters: ties resolve
/// the same way in every run.
#[derive(Clone, Debug)]
pub struct Earliest {
    /// The keys in full, "never" beyond `len`.
    keys: Vec<Instant>,
    /// The winner below each node, root at 1; the leaves are the second half.
    nodes: Vec<Entry>,
    last: usize,
}

/// A rounded key and its index.
#[derive(Clone, Copy, Debug)]
struct Entry {
    coarse: i64,
    index: u64,
}

impl Earliest {
    /// Bytes for each key, of a power of two of them.
    pub const BYTES: usize = size_of::<Instant>() + 2 * size_of::<Entry>();

    /// `len` ≥ 1 keys, all [`Instant::NEVER`].
    pub fn new(len: usize) -> Self {
        let width = len.next_power_of_two();
        let never = Instant::NEVER.coarse();
        let mut nodes: Vec<Entry> = vec![Entry { coarse: never, index: 0 }; 2 * width];
        for (index, node) in nodes[width..].iter_mut().enumerate() {
            node.index = index as u64;
        }
        for node in (1..width).rev() {
            nodes[node] = nodes[2 * node];
        }
        Earliest { keys: vec![Instant::NEVER; width], nodes, last: len - 1 }
    }

    /// Changes the keys of `first`, `first` + 1, …, at most three.
    ///
    /// Neighbours have at most two nodes of each level above them. The two winners are carried
    /// upwards in registers, each against one sibling from memory, so the wait is a comparison a
    /// level; no branch depends on who wins, for no processor can predict it.
    #[inline(always)]
    pub fn set<const K: usize>(&mut self, first: usize, keys: [Instant; K]) {
        const { assert!(K <= 3) };
        self.keys[first..first + K].copy_from_slice(&keys);
        let width = self.keys.len();
        let (mut low, mut high) = (width + first, width + first + K - 1);
        for (i, key) in keys.into_iter().enumerate() {
            self.nodes[low + i].coarse = key.coarse();
        }
        let (mut left, mut right) = (self.nodes[low], self.nodes[high]);
        while low > 1 {
            left = self.play(left, low);
            right = if K > 1 { self.play(right, high) } else { left };
            (low, high) = (low >> 1, high >> 1);
            let mask = self.nodes.len() - 1;
            self.nodes[low & mask] = left;
            if K > 1 {
                self.nodes[high & mask] = right;
            }
        }
    }

    /// The winner of node `node`, whose own winner is `own`, against its sibling.
    #[inline(always)]
    fn play(&self, own: Entry, node: usize) -> Entry {
        let other = self.nodes[(node ^ 1) & (self.nodes.len() - 1)];
        let mut loses = other.coarse < own.coarse;
        if other.coarse == own.coarse {
            loses = self.loses_tie(own, other);
        }
        Entry {
            coarse: select_unpredictable(loses, other.coarse, own.coarse),
            index: select_unpredictable(loses, other.index, own.index),
        }
    }

    /// Whether `other` is earlier by the full keys, or as early with the lower index.
    #[cold]
    fn loses_tie(&self, own: Entry, other: Entry) -> bool {
        let key = |entry: Entry| (self.keys[entry.index as usize], entry.index);
        key(other) < key(own)
    }

    /// Whether key `index` has an equal next to it, where the last and the first are neighbours too.
    #[inline(always)]
    pub fn ties_beside(&self, index: usize) -> bool {
        let before = if index == 0 { self.last } else { index - 1 };
        let after = if index == self.last { 0 } else { index + 1 };
        let own = self.keys[index];
        (self.keys[before] == own) | (self.keys[after] == own)
    }

    /// Key `index`.
    pub fn key(&self, index: usize) -> Instant {
        self.keys[index]
    }

    /// The index of the earliest key, and that key.
    #[inline(always)]
    pub fn first(&self) -> (usize, Instant) {
        let index = self.nodes[1].index as usize;
        (index, self.keys[index])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::generator;
    use rand::Rng;

    /// Against a scan of all keys, with many exact ties and many that only rounding makes.
    #[test]
    fn agrees_with_a_scan() {
        for len in [1, 2, 7, 8, 9, 101, 700] {
            let mut earliest = Earliest::new(len);
            let mut keys = vec![Instant::NEVER; len];
            let mut random = generator("earliest", 1, len as u64);
            for _ in 0..2000 {
                let index = random.next_u64() as usize % len;
                let moment = Instant::at((random.next_u64() % 50) as f64);
                let key = match random.next_u64() % 4 {
                    0 => Instant::NEVER,
                    1 => moment,
                    _ => moment.after((random.next_u64() % 9) as f64 * 1e-20),
                };
                keys[index] = key;
                earliest.set(index, [key]);
                let expected = (0..len).min_by_key(|&i| (keys[i], i)).unwrap();
                assert_eq!(earliest.first(), (expected, keys[expected]));
                let beside = [(index + len - 1) % len, (index + 1) % len];
                let tied = beside.into_iter().any(|i| keys[i] == keys[index]);
                assert_eq!(earliest.ties_beside(index), tied);
                if index + 3 <= len {
                    let three = [0, 1, 2].map(|i| moment.after(f64::from(i) * 0.25));
                    keys[index..index + 3].copy_from_slice(&three);
                    earliest.set(index, three);
                    let expected = (0..len).min_by_key(|&i| (keys[i], i)).unwrap();
                    assert_eq!(earliest.first(), (expected, keys[expected]));
                }
            }
        }
    }
}
