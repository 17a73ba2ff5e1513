//! Counts ordered choices of vertices exactly.

/// Returns N (N − 1) … (N − count + 1) exactly: the ordered choices of `count` of N vertices;
/// none beyond 128 bits.
pub fn arrangements(big_n: usize, count: usize) -> Option<u128> {
    let mut product = 1_u128;
    for i in 0..count {
        product = product.checked_mul(big_n.saturating_sub(i) as u128)?;
    }
    Some(product)
}
