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
    /// The winner below each node, root at 1; leaves are `width..2 width`. Siblings lie side by
    /// side, so that a comparison touches one cache line.
    nodes: Vec<Entry>,
}

/// A key and its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Entry(Instant, u32);

impl WinnerTree {
    /// A tree of `len` ≥ 1 keys, all [`Instant::NEVER`].
    pub fn new(len: usize) -> Self {
        let width = len.next_power_of_two();
        let mut nodes = vec![Entry(Instant::NEVER, 0); 2 * width];
        for (leaf, node) in nodes[width..].iter_mut().enumerate() {
            node.1 = leaf as u32;
        }
        for node in (1..width).rev() {
            nodes[node] = nodes[2 * node];
        }
        WinnerTree { width, nodes }
    }

    /// Changes one key.
    #[inline]
    pub fn set(&mut self, index: usize, key: Instant) {
        let index = index as u32;
        let mut node = self.width + index as usize;
        self.nodes[node].0 = key;
        while node > 1 {
            let (left, right) = (&self.nodes[node & !1], &self.nodes[node | 1]);
            // The right index is the larger one: it wins only with a smaller key.
            let winner = if right.0 < left.0 { *right } else { *left };
            node >>= 1;
            let slot = &mut self.nodes[node];
            // Another key wins here as it did before: nothing changes further up.
            if slot.1 == winner.1 && winner.1 != index {
                return;
            }
            *slot = winner;
        }
    }

    /// The index of the earliest key, and that key.
    #[inline]
    pub fn first(&self) -> (usize, Instant) {
        let Entry(key, index) = self.nodes[1];
        (index as usize, key)
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
