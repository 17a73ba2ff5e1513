//! What can be counted in a sequence of impacts: a list of gaps, in the order of time.

use rand::Rng;

/// How often each gap follows each other one. The last impact is followed by the first, so that each
/// gap is left as often as it is reached.
pub struct Matrix {
    big_n: usize,
    cells: Vec<u64>,
}

impl Matrix {
    /// Of a sequence.
    pub fn new(gaps: &[usize], big_n: usize) -> Self {
        let mut cells = vec![0; big_n * big_n];
        let next = gaps.iter().skip(1).chain(gaps.first());
        gaps.iter().zip(next).for_each(|(&from, &to)| cells[from * big_n + to] += 1);
        Matrix { big_n, cells }
    }

    /// Information, in nats, that an impact gives about the next beyond what the frequencies `hits`
    /// of the gaps say. Of independent impacts it is above zero too, for their number is finite.
    pub fn information(&self, hits: &[u64]) -> f64 {
        let all = hits.iter().sum::<u64>() as f64;
        let mut sum = 0.0;
        for (row, &from) in self.cells.chunks(self.big_n).zip(hits) {
            for (&n, &to) in row.iter().zip(hits).filter(|(n, _)| **n > 0) {
                sum += n as f64 * pxfm::f_log(n as f64 * all / (from as f64 * to as f64));
            }
        }
        sum / all
    }

    /// Impacts by the distance |i − j| from their gap to that of the next.
    pub fn distances(&self) -> Vec<u64> {
        let mut distances = vec![0; self.big_n];
        for (at, n) in self.cells.iter().enumerate() {
            distances[(at / self.big_n).abs_diff(at % self.big_n)] += n;
        }
        distances
    }
}

/// Impacts of each gap.
pub fn hits(gaps: &[usize], big_n: usize) -> Vec<u64> {
    let mut hits = vec![0; big_n];
    gaps.iter().for_each(|&gap| hits[gap] += 1);
    hits
}

/// Impacts of which the next that moves one of the same two masses is at the gap to the left, at the same
/// gap, and at the gap to the right.
pub fn next(gaps: &[usize], big_n: usize) -> [u64; 3] {
    let mut next = [0; 3];
    let mut after = vec![usize::MAX; big_n + 2];
    for (time, &gap) in gaps.iter().enumerate().rev() {
        let around = &mut after[gap..gap + 3];
        if let Some(side) = (0..3).filter(|&s| around[s] < usize::MAX).min_by_key(|&s| around[s]) {
            next[side] += 1;
        }
        around[1] = time;
    }
    next
}

/// Simple circuits in a sequence.
#[derive(Debug, PartialEq)]
pub struct Circuits {
    /// Impacts from which on the first gap to come again is their own, after k impacts, at index k − 1.
    pub lengths: Vec<u64>,
    /// Of those with 2 ≤ k ≤ the length that is called short: how many pass by a neighbour of their first
    /// gap.
    pub passing: u64,
}

/// The simple circuits of a sequence.
pub fn circuits(gaps: &[usize], big_n: usize, short: usize) -> Circuits {
    let mut lengths = vec![0; big_n];
    let mut passing = 0;
    let mut again = vec![usize::MAX; big_n];
    // The first time at which a gap comes that came since the time that is looked at.
    let mut closed = usize::MAX;
    for (time, &gap) in gaps.iter().enumerate().rev() {
        let back = std::mem::replace(&mut again[gap], time);
        if back < closed {
            closed = back;
            let k = back - time;
            lengths[k - 1] += 1;
            let between = &gaps[time + 1..back];
            passing += u64::from(
                (2..=short).contains(&k) && between.iter().any(|other| other.abs_diff(gap) == 1),
            );
        }
    }
    Circuits { lengths, passing }
}

/// Different gaps in each block of m successive impacts, added up, and the number of blocks.
pub fn distinct(gaps: &[usize], big_n: usize, m: usize) -> [u64; 2] {
    let mut seen = vec![usize::MAX; big_n];
    let (mut different, mut blocks) = (0, 0);
    for (block, impacts) in gaps.chunks_exact(m).enumerate() {
        blocks += 1;
        for &gap in impacts {
            different += u64::from(std::mem::replace(&mut seen[gap], block) != block);
        }
    }
    [different, blocks]
}

/// The same gaps in random order: independent impacts with the same frequencies.
pub fn shuffled(gaps: &[usize], random: &mut impl Rng) -> Vec<usize> {
    let mut gaps = gaps.to_vec();
    for last in (1..gaps.len()).rev() {
        // Multiply and shift: unbiased to 2^−64 · (last + 1), and the same on every machine.
        let place = (u128::from(random.next_u64()) * (last as u128 + 1)) >> 64;
        gaps.swap(last, place as usize);
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::generator;

    const GAPS: [usize; 10] = [0, 1, 0, 0, 3, 2, 1, 3, 2, 3];

    #[test]
    fn a_short_sequence_by_hand() {
        let hits = hits(&GAPS, 4);
        assert_eq!(hits, [3, 2, 2, 3]);
        let matrix = Matrix::new(&GAPS, 4);
        // 01 10 00 03 32 21 13 32 23, and 30 around the end.
        assert_eq!(matrix.cells, [1, 1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 1, 0, 2, 0]);
        assert_eq!(matrix.distances(), [1, 6, 1, 2]);
        // In order: right, left, same, right, left, left, right, left, right, and none for the last.
        assert_eq!(next(&GAPS, 4), [4, 1, 4]);
        // 010, 00, 3213, 2132 and 323; from 1 on the 0 comes again first.
        let found = circuits(&GAPS, 4, 3);
        assert_eq!(found.lengths, [1, 2, 2, 0]);
        assert_eq!(found.passing, 4);
        assert_eq!(distinct(&GAPS, 4, 5), [6, 2]);
        assert_eq!(distinct(&GAPS, 4, 3), [2 + 3 + 3, 3]);
    }

    #[test]
    fn information_is_that_of_both_less_that_of_the_pair() {
        // A gap that follows the other always: ln 2. H(a) + H(b) − H(a, b) by the histogram is the
        // second route.
        let turns: Vec<usize> = (0..40).map(|i| i % 2).collect();
        let of = |gaps: &[usize], n| Matrix::new(gaps, n).information(&hits(gaps, n));
        assert!((of(&turns, 2) - std::f64::consts::LN_2).abs() < 1e-15);
        let all = GAPS.len() as f64;
        let x_log = |n: u64| n as f64 * (n as f64).ln();
        let single: f64 = hits(&GAPS, 4).into_iter().map(x_log).sum();
        let pairs = Matrix::new(&GAPS, 4).cells.into_iter().filter(|n| *n > 0);
        let pairs: f64 = pairs.map(x_log).sum();
        let expected = (pairs - 2.0 * single) / all + all.ln();
        assert!((of(&GAPS, 4) - expected).abs() < 1e-14);
    }

    #[test]
    fn only_neighbours_are_passed_by() {
        assert_eq!(circuits(&[4, 5, 4, 5, 4], 9, 10).passing, 3);
        assert_eq!(circuits(&[4, 7, 4], 9, 10).passing, 0);
    }

    #[test]
    fn a_shuffled_sequence_has_the_same_gaps_elsewhere() {
        let gaps: Vec<usize> = (0..500).map(|i| i % 7).collect();
        let mut other = shuffled(&gaps, &mut generator("test", 1, 0));
        assert_ne!(other, gaps);
        // All places alike: of 500, those of gap 0 in the first half are some 36 of 72.
        let early = other[..250].iter().filter(|&&gap| gap == 0).count();
        assert!((20..=52).contains(&early), "{early}");
        other.sort_unstable();
        let mut sorted = gaps;
        sorted.sort_unstable();
        assert_eq!(other, sorted);
    }
}
