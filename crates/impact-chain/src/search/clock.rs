//! Keeps exact time: instants on a fixed grid, and phases without loss at any instant.

use super::trig::sin_cos_turn;

/// One unit of time is 2^80 ticks.
const TICKS: f64 = (1u128 << 80) as f64;

/// 1/(2π) in units of 2^-256, least significant limb first.
const INVERSE_TAU: [u64; 4] =
    [0x7f94_58ea_f7ae_f158, 0x36d8_a566_4f10_e410, 0x7f09_d5f4_7d4d_3770, 0x28be_60db_9391_054a];

/// The latest time that an instant of the clock is meant for, in units of time.
pub const LATEST: f64 = 1e12;

/// A moment, as a whole number of ticks of 2^-80 units of time since t = 0.
/// Sums of waiting times are exact up to one tick (8e-25), so nothing is lost at large times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instant(i128);

impl Instant {
    pub const ZERO: Instant = Instant(0);
    /// Later than every time that is reached: the key of a gap that awaits nothing.
    pub const NEVER: Instant = Instant(i128::MAX);

    /// Returns the instant at time `t`, |t| ≤ [`LATEST`]; exact when `t` has no bits below 2^-80.
    pub fn at(t: f64) -> Instant {
        Instant((t * TICKS) as i128)
    }

    /// Returns the last instant whose time is `t` when rounded, as that of an impact is.
    pub fn last_at(t: f64) -> Instant {
        let half_unit = (0.5 * TICKS * (t.next_up() - t)) as i128;
        let last = Instant(Instant::at(t).0 + half_unit);
        Instant(last.0 - i128::from(last.time() > t))
    }

    /// Returns the instant that is as much later as `by` is than zero.
    pub fn shifted(self, by: Instant) -> Instant {
        Instant(self.0 + by.0)
    }

    /// Returns the instant `s` units of time later, truncated to a tick.
    #[inline(always)]
    pub fn after(self, s: f64) -> Instant {
        // Numbers from 2^-28 to 2^36 are shifted mantissas; conversion to 128 bits is long.
        let bits = s.to_bits();
        let shift = (bits >> 52).wrapping_sub(1075 - 80);
        if shift < 64 {
            let mantissa = (bits & ((1 << 52) - 1)) + (1 << 52);
            return Instant(self.0 + (i128::from(mantissa) << shift));
        }
        Instant(self.0 + (s * TICKS) as i128)
    }

    /// Returns the time that has passed since `earlier`, rounded once.
    #[inline(always)]
    pub fn since(self, earlier: Instant) -> f64 {
        let ticks = self.0 - earlier.0;
        let lead = (ticks >> 64) as i64;
        if lead <= 0 {
            return ticks as f64 / TICKS;
        }
        // The first 63 bits, the last of them set if any follows, round as the whole does.
        let zeros = lead.leading_zeros();
        let whole = (ticks as u128) << zeros;
        let (head, tail) = ((whole >> 64) as u64, whole as u64);
        let sticky = head >> 1 | head & 1 | u64::from(tail != 0);
        sticky as i64 as f64 * f64::from_bits(u64::from(1023 + 65 - 80 - zeros) << 52)
    }

    /// Returns the time since `epoch` in units of 2^-58, rounded down, from 0 to 64 in time.
    #[inline(always)]
    pub fn units_since(self, epoch: Instant) -> u64 {
        let units = (self.0 - epoch.0) >> 22;
        u64::try_from(units).unwrap_or(if units < 0 { 0 } else { u64::MAX })
    }

    /// Returns the time since t = 0, rounded once.
    #[inline(always)]
    pub fn time(self) -> f64 {
        self.since(Instant::ZERO)
    }
}

/// A frequency in turns per unit of time, in units of 2^-128, least significant limb first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rate([u64; 3]);

impl Rate {
    /// Computes the rate of `omega`, 0 < `omega` ≤ 1e6, to 2^-128 turns per unit time.
    pub fn new(omega: f64) -> Rate {
        // omega = mantissa · 2^exponent exactly.
        let bits = omega.to_bits();
        let raw = (bits >> 52) as i32 & 0x7ff;
        let mantissa = (bits & ((1 << 52) - 1)) + if raw > 0 { 1 << 52 } else { 0 };
        let exponent = raw.max(1) - 1075;
        // mantissa · INVERSE_TAU, five limbs, in units of 2^(exponent − 256).
        let mut product = [0u64; 5];
        let mut carry = 0u128;
        for (limb, sum) in INVERSE_TAU.iter().zip(product.iter_mut()) {
            carry += u128::from(*limb) * u128::from(mantissa);
            *sum = carry as u64;
            carry >>= 64;
        }
        product[4] = carry as u64;
        // Down to units of 2^-128.
        let shift = (128 - exponent) as usize;
        let (limbs, bits) = (shift / 64, shift % 64);
        let limb = |i: usize| product.get(i).copied().unwrap_or(0);
        Rate(std::array::from_fn(|i| {
            let low = limb(i + limbs) >> bits;
            if bits == 0 { low } else { low + (limb(i + limbs + 1) << (64 - bits)) }
        }))
    }

    /// Returns the phase at an instant ≥ 0 as a fraction of a turn in units of 2^-64.
    ///
    /// The product of 128 and 192 bits is taken modulo one turn, without what lies below 2^-80
    /// turns, so the error is below 2^-63 turns up to [`LATEST`], whatever the history of the run.
    #[inline(always)]
    pub fn turn(self, instant: Instant) -> u64 {
        let t = instant.0 as u128;
        let (t0, t1) = (u128::from(t as u64), u128::from((t >> 64) as u64));
        let [r0, r1, r2] = self.0.map(u128::from);
        // In units of 2^-80 turns, modulo 2^48 turns.
        let sum = (t0 * r2)
            .wrapping_add(t1 * r1)
            .wrapping_add((t0 * r1) >> 64)
            .wrapping_add((t1 * r0) >> 64)
            .wrapping_add((t1 * r2) << 64);
        (sum >> 16) as u64
    }

    #[inline(always)]
    pub fn sin_cos(self, instant: Instant) -> (f64, f64) {
        sin_cos_turn(self.turn(instant))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use impact_numerics::random::{NormalPairs, Seed};

    /// The fast conversions agree with those of the language.
    #[test]
    fn conversions_are_rounded_once() {
        let mut normals = NormalPairs::new("conversions", Seed(1), 0);
        for i in 0..20_000 {
            let [x, y] = normals.pair();
            let s = x * 2.0f64.powi(i % 140 - 95);
            let (start, late) = (Instant::at(y), Instant::at(y).after(s));
            assert_eq!(late.0 - start.0, (s * TICKS) as i128, "{s:e}");
            for ticks in [late.0, late.0 - start.0, start.0 - late.0] {
                assert_eq!(Instant(ticks).time(), ticks as f64 / TICKS, "{ticks}");
            }
        }
        // Halfway between two doubles, and a tick to either side.
        for ticks in [(1 << 100) + (1 << 47), (1 << 100) + (3 << 47)] {
            for ticks in [ticks - 1, ticks, ticks + 1] {
                assert_eq!(Instant(ticks).time(), ticks as f64 / TICKS, "{ticks}");
            }
        }
    }
}
