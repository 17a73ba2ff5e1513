//! Numbers that remember how they were computed, so that every rounding can be followed to the end.

use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// One number, what it was made of, and the derivative by each of these.
struct Node {
    value: f64,
    from: [(usize, f64); 2],
    /// The stage whose rounding it carries, if it was rounded.
    rounded: Option<usize>,
}

thread_local! {
    static TAPE: RefCell<(Vec<Node>, usize)> = const { RefCell::new((Vec::new(), 0)) };
}

/// A number on the tape of this thread.
#[derive(Clone, Copy, Debug)]
pub struct Num(usize);

fn push(value: f64, from: [(usize, f64); 2], rounds: bool) -> Num {
    TAPE.with_borrow_mut(|(tape, stage)| {
        tape.push(Node { value, from, rounded: rounds.then_some(*stage) });
        Num(tape.len() - 1)
    })
}

/// Forgets everything.
pub fn clear() {
    TAPE.with_borrow_mut(|(tape, stage)| {
        tape.clear();
        *stage = 0;
    });
}

/// What is computed from now on belongs to this stage.
pub fn stage(number: usize) {
    TAPE.with_borrow_mut(|(_, stage)| *stage = number);
}

impl Num {
    /// An exact number.
    pub fn exact(value: f64) -> Num {
        push(value, [(0, 0.0); 2], false)
    }

    /// The value.
    pub fn value(self) -> f64 {
        TAPE.with_borrow(|(tape, _)| tape[self.0].value)
    }

    /// The same number, rounded once more.
    pub fn rounded(self) -> Num {
        push(self.value(), [(self.0, 1.0), (0, 0.0)], true)
    }

    /// To first order, what each rounding on the way to this number adds to it, if it is one unit
    /// of 2^-53 of what it rounds; in the order of the tape, with its stage.
    pub fn roundings(self) -> Vec<(usize, f64)> {
        TAPE.with_borrow(|(tape, _)| {
            let mut adjoint = vec![0.0; self.0 + 1];
            adjoint[self.0] = 1.0;
            let mut roundings = Vec::new();
            for (i, node) in tape[..=self.0].iter().enumerate().rev() {
                for (parent, derivative) in node.from {
                    adjoint[parent] += derivative * adjoint[i];
                }
                if let Some(stage) = node.rounded {
                    roundings.push((stage, adjoint[i] * node.value));
                }
            }
            roundings
        })
    }
}

impl Neg for Num {
    type Output = Num;
    fn neg(self) -> Num {
        push(-self.value(), [(self.0, -1.0), (0, 0.0)], false)
    }
}

/// An operation with its derivatives by both numbers.
macro_rules! operator {
    ($($operator:ident $method:ident |$a:ident, $b:ident| $by_a:expr, $by_b:expr;)*) => {$(
        impl $operator for Num {
            type Output = Num;
            fn $method(self, other: Num) -> Num {
                let [$a, $b] = [self.value(), other.value()];
                push($operator::$method($a, $b), [(self.0, $by_a), (other.0, $by_b)], true)
            }
        }
    )*};
}

operator! {
    Add add |_a, _b| 1.0, 1.0;
    Sub sub |_a, _b| 1.0, -1.0;
    Mul mul |a, b| b, a;
    Div div |a, b| 1.0 / b, -a / (b * b);
}
