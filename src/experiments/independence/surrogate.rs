//! Sequences with the frequencies of a sequence, or with its transition matrix, and otherwise by chance.

use rand::Rng;

/// A number below `below`.
fn draw(random: &mut impl Rng, below: usize) -> usize {
    // Multiply and shift: unbiased to 2^−64 · below, and the same on every machine.
    ((u128::from(random.next_u64()) * below as u128) >> 64) as usize
}

/// The same gaps in random order: independent impacts with the same frequencies.
pub fn shuffled(gaps: &[usize], random: &mut impl Rng) -> Vec<usize> {
    let mut gaps = gaps.to_vec();
    for last in (1..gaps.len()).rev() {
        gaps.swap(last, draw(random, last + 1));
    }
    gaps
}

/// As many impacts of the Markov chain whose transition matrix is the measured one: after each gap one
/// of those that followed it. The last impact is followed by the first.
pub fn markov(gaps: &[usize], big_n: usize, random: &mut impl Rng) -> Vec<usize> {
    // Followers of all gaps in one list, those of gap g from start[g] to start[g + 1].
    let mut start = vec![0; big_n + 1];
    gaps.iter().for_each(|&gap| start[gap + 1] += 1);
    (0..big_n).for_each(|gap| start[gap + 1] += start[gap]);
    let mut followers = vec![0; gaps.len()];
    let mut place = start.clone();
    for (&gap, &next) in gaps.iter().zip(gaps.iter().skip(1).chain(gaps.first())) {
        followers[place[gap]] = next;
        place[gap] += 1;
    }
    let Some(&(mut gap)) = gaps.first() else { return Vec::new() };
    let mut step = |_| {
        let number = start[gap + 1] - start[gap];
        let after = followers[start[gap] + draw(random, number)];
        std::mem::replace(&mut gap, after)
    };
    (0..gaps.len()).map(&mut step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::random::generator;

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

    #[test]
    fn the_markov_chain_makes_measured_steps_as_often() {
        // After 0 comes 1 in three of four, after 1 and 2 always 0: returns 0 → 1 → 0 have a share of
        // one half times 3/4, seen from both ends 3/4.
        let gaps: Vec<usize> = [0, 1, 0, 1, 0, 2, 0, 1].repeat(500);
        let chain = markov(&gaps, 3, &mut generator("test", 2, 0));
        assert_eq!(chain.len(), gaps.len());
        let ones = chain.iter().filter(|&&gap| gap == 1).count() as f64 / 2000.0;
        assert!((ones - 0.75).abs() < 0.05, "{ones}");
        assert!(chain.windows(2).all(|pair| (pair[0] == 0) != (pair[1] == 0)));
    }
}
