//! The impact law.

// listing: jumps
/// The jumps of velocity (left, right) of two neighbours whose gap closes at `speed` ≥ 0.
///
/// Newton's restitution: the gap opens at r `speed` afterwards, and momentum is shared by the
/// inverse masses: 1 for a mass, 0 for a wall. Equal masses exchange; at a wall v → −r v.
#[inline(always)]
pub fn jumps(speed: f64, restitution: f64, inverse_masses: [f64; 2]) -> [f64; 2] {
    let [left, right] = inverse_masses;
    let share = (1.0 + restitution) * speed / (left + right);
    [-(share * left), share * right]
}
// end
