//! The impact law.

use crate::numerics::lane::Lane;

/// The jumps of velocity (left, right) of two neighbours whose gap closes at `speed` ≥ 0.
///
/// Newton's restitution: the gap opens at r `speed` afterwards, and momentum is shared by the
/// inverse masses: 1 for a mass, 0 for a wall. Equal masses exchange; at a wall v → −r v.
#[inline(always)]
pub fn jumps<L: Lane>(speed: L, restitution: L, inverse_masses: [L; 2]) -> [L; 2] {
    let [left, right] = inverse_masses;
    let share = (L::splat(1.0) + restitution) * speed / (left + right);
    [-(share * left), share * right]
}
