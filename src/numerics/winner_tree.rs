//! A winner tree: the earliest of many keys, each of which may change at any time.

use super::clock::Instant;

/// Keys 0..len with the earliest at hand; among equal keys the lowest index wins.
///
/// Changing one key costs one comparison a level, and the shape is fixed, so the order of
/// changes never matters: ties resolve the same way in every run.
#[derive(Clone, Debug)]
pub struct WinnerTree {
    /// Number of leaves, a power of two.
    width: usize,
    keys: Vec<Instant>,
    /// `winner[i]` for inner node i, root at 1; leaves are `width..2 width`.
    winner: Vec<u32>,
}

impl WinnerTree {
    /// A tree of `len` ≥ 1 keys, all [`Instant::NEVER`].
    pub fn new(len: usize) -> Self {
        let width = len.next_power_of_two();
        let mut winner = vec![0; 2 * width];
        for (leaf, slot) in winner[width..].iter_mut().enumerate() {
            *slot = leaf as u32;
        }
        for node in (1..width).rev() {
            winner[node] = winner[2 * node];
        }
        WinnerTree { width, keys: vec![Instant::NEVER; width], winner }
    }

    /// Changes one key.
    #[inline]
    pub fn set(&mut self, index: usize, key: Instant) {
        self.keys[index] = key;
        let mut node = (self.width + index) >> 1;
        while node > 0 {
            let (left, right) = (self.winner[2 * node], self.winner[2 * node + 1]);
            let right_wins = self.keys[right as usize] < self.keys[left as usize];
            let winner = if right_wins { right } else { left };
            // Another key wins here as it did before: nothing changes further up.
            if winner == self.winner[node] && winner != index as u32 {
                return;
            }
            self.winner[node] = winner;
            node >>= 1;
        }
    }

    /// The index of the earliest key, and that key.
    #[inline]
    pub fn first(&self) -> (usize, Instant) {
        let index = self.winner[1] as usize;
        (index, self.keys[index])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::generator;
    use rand::Rng;

    #[test]
    fn agrees_with_a_scan() {
        for len in [1, 2, 3, 7, 101] {
            let mut tree = WinnerTree::new(len);
            let mut keys = vec![Instant::NEVER; len];
            let mut random = generator("winner tree", 1, len as u64);
            for _ in 0..2000 {
                let index = random.next_u64() as usize % len;
                let key = Instant::at((random.next_u64() % 50) as f64);
                keys[index] = key;
                tree.set(index, key);
                let expected = (0..len).min_by_key(|&i| (keys[i], i)).unwrap();
                assert_eq!(tree.first(), (expected, keys[expected]));
            }
        }
    }
}
