//! Computes with two numbers side by side, with the bits of each number alone on every machine.

#[cfg(target_arch = "x86_64")]
pub use safe_arch::{
    cmp_lt_mask_m128d as less, m128d as Pair, max_m128d as max, min_m128d as min,
    move_mask_m128d as signs,
};

#[cfg(not(target_arch = "x86_64"))]
pub use portable::{Pair, less, max, min, signs};

#[inline(always)]
pub fn splat(x: f64) -> Pair {
    Pair::from([x; 2])
}

#[inline(always)]
pub fn abs(x: Pair) -> Pair {
    x & splat(f64::from_bits(u64::MAX >> 1))
}

/// Returns the numbers of `yes` where `mask`, a result of [`less`], is true, and of `no` elsewhere.
#[inline(always)]
pub fn select(mask: Pair, yes: Pair, no: Pair) -> Pair {
    no ^ ((no ^ yes) & mask)
}

#[cfg(not(target_arch = "x86_64"))]
mod portable {
    use std::ops::{Add, AddAssign, BitAnd, BitXor, Div, Mul, Sub};

    #[derive(Clone, Copy, Debug)]
    pub struct Pair([f64; 2]);

    impl Pair {
        pub fn to_array(self) -> [f64; 2] {
            self.0
        }
    }

    impl From<[f64; 2]> for Pair {
        fn from(pair: [f64; 2]) -> Pair {
            Pair(pair)
        }
    }

    fn both(a: Pair, b: Pair, operation: impl Fn(f64, f64) -> f64) -> Pair {
        Pair([operation(a.0[0], b.0[0]), operation(a.0[1], b.0[1])])
    }

    /// Compares: all bits are set where a < b, and none elsewhere.
    pub fn less(a: Pair, b: Pair) -> Pair {
        both(a, b, |a, b| f64::from_bits(if a < b { u64::MAX } else { 0 }))
    }

    pub fn min(a: Pair, b: Pair) -> Pair {
        both(a, b, |a, b| if a < b { a } else { b })
    }

    pub fn max(a: Pair, b: Pair) -> Pair {
        both(a, b, |a, b| if a > b { a } else { b })
    }

    /// Returns the sign bits, that of the first number lowest.
    pub fn signs(x: Pair) -> i32 {
        i32::from(x.0[0].is_sign_negative()) | i32::from(x.0[1].is_sign_negative()) << 1
    }

    macro_rules! operators {
        ($($operator:ident $method:ident $operation:expr;)*) => {$(
            impl $operator for Pair {
                type Output = Pair;
                fn $method(self, other: Pair) -> Pair {
                    both(self, other, $operation)
                }
            }
        )*};
    }
    operators! {
        Add add |a, b| a + b;
        Sub sub |a, b| a - b;
        Mul mul |a, b| a * b;
        Div div |a, b| a / b;
        BitAnd bitand |a, b| f64::from_bits(a.to_bits() & b.to_bits());
        BitXor bitxor |a, b| f64::from_bits(a.to_bits() ^ b.to_bits());
    }

    impl AddAssign for Pair {
        fn add_assign(&mut self, other: Pair) {
            *self = *self + other;
        }
    }
}
