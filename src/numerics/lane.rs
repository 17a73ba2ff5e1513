//! Arithmetic over a lane: one number, or several side by side.
//!
//! Search, impact and flight are pure functions of state and phase, written once for any [`Lane`].
//! With `f64` they run one chain; with [`Lanes`] several chains advance side by side, and each
//! lane gives exactly the bits that `f64` would give, since every operation acts on each lane
//! alone and nothing is fused or reordered.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number or a bundle of numbers with the operations that the engine needs.
pub trait Lane:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// One truth value per lane.
    type Mask: Copy;

    /// The same number in every lane.
    fn splat(x: f64) -> Self;
    /// Correctly rounded square root.
    fn sqrt(self) -> Self;
    /// Absolute value.
    fn abs(self) -> Self;
    /// `self < other`, lane by lane.
    fn lt(self, other: Self) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The smaller of two numbers; `other` if `self` is not a number.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }

    /// The larger of two numbers; `other` if `self` is not a number.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }
}

impl Lane for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> f64 {
        f64::abs(self)
    }
    #[inline(always)]
    fn lt(self, other: f64) -> bool {
        self < other
    }
    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
}

/// `K` numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lanes<const K: usize>(pub [f64; K]);

macro_rules! lanewise {
    ($trait:ident, $method:ident, $op:tt) => {
        impl<const K: usize> $trait for Lanes<K> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Lanes(std::array::from_fn(|i| self.0[i] $op other.0[i]))
            }
        }
    };
}
lanewise!(Add, add, +);
lanewise!(Sub, sub, -);
lanewise!(Mul, mul, *);
lanewise!(Div, div, /);

impl<const K: usize> Neg for Lanes<K> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Lanes(self.0.map(|x| -x))
    }
}

impl<const K: usize> Lane for Lanes<K> {
    type Mask = [bool; K];

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Lanes([x; K])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes(self.0.map(f64::sqrt))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Lanes(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> [bool; K] {
        std::array::from_fn(|i| self.0[i] < other.0[i])
    }
    #[inline(always)]
    fn select(mask: [bool; K], yes: Self, no: Self) -> Self {
        Lanes(std::array::from_fn(|i| if mask[i] { yes.0[i] } else { no.0[i] }))
    }
}
