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
}
