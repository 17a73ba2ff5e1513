//! The earliest of many keys, each of which may change at any time.

use super::clock::Instant;
use wide::f64x2;

/// Children of a node: their minimum takes three operations of a register of two numbers each.
const WIDTH: usize = 8;

/// Keys 0..len with the earliest at hand; among equal keys the lowest index wins.
///
/// A tree of minima with eight children a node, over the keys rounded down to whole units of 2^-23 of
/// time. Such a rounded key hardly ever ties, and then the full keys decide. No branch depends on
/// who wins, for no processor can predict it.
#[derive(Clone, Debug)]
pub struct Earliest {
    /// The keys in full.
    keys: Vec<Instant>,
    /// The rounded keys, then the minima of eight of them each, and so on to a level of eight; all
    /// levels filled up with "never".
    nodes: Vec<f64>,
    /// Where each level begins.
    levels: Vec<usize>,
}

impl Earliest {
    /// `len` ≥ 1 keys, all [`Instant::NEVER`].
    pub fn new(len: usize) -> Self {
        let mut levels = vec![0];
        let mut size = len.next_multiple_of(WIDTH);
        let mut end = size;
        while size > WIDTH {
            levels.push(end);
            size = (size / WIDTH).next_multiple_of(WIDTH);
            end += size;
        }
        Earliest { keys: vec![Instant::NEVER; len], nodes: vec![f64::INFINITY; end], levels }
    }

    /// The eight nodes that begin at `start`.
    #[inline(always)]
    fn block(&self, start: usize) -> [f64x2; WIDTH / 2] {
        let block: &[f64; WIDTH] = self.nodes[start..].first_chunk().expect("levels are filled up");
        std::array::from_fn(|i| f64x2::from([block[2 * i], block[2 * i + 1]]))
    }

    /// Changes the keys of `first`, `first` + 1, …, at most eight.
    #[inline(always)]
    pub fn set<const K: usize>(&mut self, first: usize, keys: [Instant; K]) {
        const { assert!(K <= WIDTH) };
        self.keys[first..first + K].copy_from_slice(&keys);
        for (node, key) in self.nodes[first..first + K].iter_mut().zip(keys) {
            *node = key.coarse();
        }
        let (mut low, mut high) = (first / WIDTH, (first + K - 1) / WIDTH);
        for level in 1..self.levels.len() {
            let (below, here) = (self.levels[level - 1], self.levels[level]);
            for node in low..=high {
                self.nodes[here + node] = least(self.block(below + node * WIDTH));
            }
            (low, high) = (low / WIDTH, high / WIDTH);
        }
    }

    /// The index of the earliest key, and that key.
    #[inline(always)]
    pub fn first(&self) -> (usize, Instant) {
        let level = self.levels.len() - 1;
        let minimum = least(self.block(self.levels[level]));
        // The filling is "never" too, and has no key: where it wins, all keys are.
        let index = if minimum < f64::INFINITY { self.find(level, 0, minimum) } else { 0 };
        (index, self.keys[index])
    }

    /// The index of the earliest of the keys under one node that are rounded to `minimum`.
    #[inline(always)]
    fn find(&self, mut level: usize, mut node: usize, minimum: f64) -> usize {
        loop {
            let places = places(self.block(self.levels[level] + node * WIDTH), minimum);
            if places & (places - 1) != 0 {
                return self.first_of_ties(level, node, minimum, places);
            }
            node = node * WIDTH + places.trailing_zeros() as usize;
            if level == 0 {
                return node;
            }
            level -= 1;
        }
    }

    /// The same where several children have the minimum. The two gaps beside an impact often end
    /// their searches at one instant.
    fn first_of_ties(&self, level: usize, node: usize, minimum: f64, mut places: u32) -> usize {
        let mut best: Option<(Instant, usize)> = None;
        while places != 0 {
            let child = node * WIDTH + places.trailing_zeros() as usize;
            places &= places - 1;
            let index = if level == 0 { child } else { self.find(level - 1, child, minimum) };
            if best.is_none_or(|best| self.keys[index] < best.0) {
                best = Some((self.keys[index], index));
            }
        }
        best.map_or(0, |(_, index)| index)
    }
}

/// The least of eight numbers.
#[inline(always)]
fn least([a, b, c, d]: [f64x2; WIDTH / 2]) -> f64 {
    let [even, odd] = a.fast_min(b).fast_min(c.fast_min(d)).to_array();
    if odd < even { odd } else { even }
}

/// One bit for each of eight numbers, set where it is `value`.
#[inline(always)]
fn places(block: [f64x2; WIDTH / 2], value: f64) -> u32 {
    let value = f64x2::splat(value);
    let [a, b, c, d] = block.map(|pair| pair.simd_eq(value).to_bitmask());
    a | b << 2 | c << 4 | d << 6
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::generator;
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
