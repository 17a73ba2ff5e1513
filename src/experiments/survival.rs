//! How long something lasts, where some of it was still lasting when nobody looked any more.

/// The share that lasts longer than k, for k = 0, 1, …, by the product of Kaplan and Meier (J. Am. Stat. Assoc. 53,
/// 457, 1958). `ended[k]` lasted k, `cut[k]` were last seen at k and went on. It stops where none is left, for beyond
/// that nothing is known.
pub fn kaplan_meier(ended: &[u64], cut: &[u64]) -> Vec<f64> {
    let mut left: u64 = ended.iter().chain(cut).sum();
    let mut share = 1.0;
    let both = ended.iter().zip(cut);
    let step = |(ended, cut): (&u64, &u64)| {
        if left == 0 {
            return None;
        }
        share *= (left - ended) as f64 / left as f64;
        left -= ended + cut;
        Some(share)
    };
    both.map_while(step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_product_by_hand() {
        // Five: one ends at 0, one at 1 where another is cut, one at 3, and one is cut at 4.
        let found = kaplan_meier(&[1, 1, 0, 1, 0, 0], &[0, 1, 0, 0, 1, 0]);
        let first = 4.0 / 5.0;
        let second = first * 3.0 / 4.0;
        let expected = [first, second, second, second / 2.0, second / 2.0];
        assert_eq!(found.len(), expected.len());
        let near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-15;
        assert!(found.iter().zip(&expected).all(near), "{found:?}");
        assert!(kaplan_meier(&[0, 0], &[0, 0]).is_empty());
    }

    #[test]
    fn without_cuts_it_is_the_share_that_lasts_longer() {
        let ended = [3, 0, 4, 1, 2];
        let found = kaplan_meier(&ended, &[0; 5]);
        for (k, share) in found.iter().enumerate() {
            let longer: u64 = ended[k + 1..].iter().sum();
            assert!((share - longer as f64 / 10.0).abs() < 1e-15, "{k}");
        }
    }

    #[test]
    fn of_a_constant_hazard_every_age_is_the_same() {
        // A tenth of those that are left ends at each k, and as many are cut.
        let (mut left, mut ended, mut cut) = (1_000_000_000_u64, Vec::new(), Vec::new());
        for _ in 0..6 {
            ended.push(left / 10);
            cut.push(left / 10);
            left -= 2 * (left / 10);
        }
        // Those that are still left are cut in the end.
        ended.push(0);
        cut.push(left);
        let found = kaplan_meier(&ended, &cut);
        let constant = found[..6].windows(2).all(|pair| (pair[1] / pair[0] - 0.9).abs() < 1e-9);
        assert!(constant && found[5] == found[6], "{found:?}");
    }
}
