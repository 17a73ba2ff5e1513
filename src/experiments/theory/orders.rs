//! Circuits of all orders: Fig. S7.

use super::distributions::sum;
use super::{Point, Scalars};
use crate::circuits::Error;
use crate::circuits::distribution::{Law, SampleSpace};
use crate::circuits::higher_order::{
    self, CLASSES, Orders, SHARED, diverges_from, multiplicity, total_of_all,
};
use crate::numerics::double_double::DoubleDouble;
use crate::params::{HIGHER_P, ORDERS, ORDERS_K};
use SampleSpace::{FiveClasses, Simple};
use serde::{Deserialize, Serialize};

/// The five classes of Sec. 9 among circuits of all orders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AllOrders {
    /// 1/N, where the sum over all circuits diverges.
    pub pole: f64,
    /// Share of the five classes among all circuits with K different vertices, to p = 1/K.
    pub shares: Vec<OrderShares>,
    /// Share of the five classes among all circuits, to p = 1/N.
    pub whole: Vec<Point>,
    /// The jump while orders are added.
    pub jumps: Vec<OrderJump>,
    /// The jump with all orders.
    pub jump: OrderJump,
    /// P(X = k) with all orders at that jump, k = 1..=N.
    pub at_jump: Vec<f64>,
    /// P(X = k) of simple circuits at theirs, k = 1..=N.
    pub simple_at_jump: Vec<f64>,
    /// Single numbers.
    pub remarks: OrderRemarks,
}

/// Shares of the five classes for one number of different vertices.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderShares {
    /// Number of different vertices K.
    pub k: usize,
    /// The points, over p; zero at p = 1/K.
    pub rows: Vec<Point>,
}

/// The jump with circuits that have at most so many edges more than different vertices.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderJump {
    /// How many; nothing for all.
    pub most: Option<usize>,
    /// Where k* leaves 1.
    pub p: f64,
    /// k* just after.
    pub k_after: usize,
}

/// Single numbers of the text.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrderRemarks {
    /// Smallest number of different vertices without a finite weight at p_jump of simple circuits.
    pub diverges_at_jump: usize,
    /// The same at the largest p of Fig. 13.
    pub diverges_at_large_p: usize,
    /// Share of the five classes at p_jump among all circuits with as many vertices as k* has there.
    pub five_at_jump: f64,
    /// Share of the class of Eq. (36) among all circuits with three edges more, for as many vertices.
    pub four_visits_of_third: f64,
    /// Share of circuits that are in none of the five classes, among all, at the smallest p of Fig. 13.
    pub beyond_five: f64,
    /// Share of the five classes among all circuits at the jump with all orders.
    pub whole_at_jump: f64,
    /// By how much that jump comes before the pole, relative to it.
    pub before_pole: f64,
    /// P(X = 1) there.
    pub ends: f64,
}

/// From 10^−3 to 10^−1, 30 to a decade.
fn drawn() -> impl Iterator<Item = f64> {
    (0..=60).map(|i| 1e-3 * pxfm::f_exp10(f64::from(i) / 30.0))
}

/// All of it, for one N.
pub fn orders(vertices: usize, scalars: &Scalars) -> Result<AllOrders, Error> {
    let orders = Orders::new(vertices, ORDERS[ORDERS.len() - 1])?;
    let jump = |most: Option<usize>| {
        let (p, k_after) = orders.jump(most)?;
        Ok::<_, Error>(OrderJump { most, p, k_after })
    };
    let all = jump(None)?;
    let whole = |p: f64| -> Result<f64, Error> {
        let five = Law::new(FiveClasses, vertices, p)?;
        let five = sum(five.all_weights().map(|weight| weight.to_f64() * p));
        Ok(total_of_all(vertices, p).map_or(0.0, |total| five / total))
    };
    let at_jump = orders.weights(all.p, None)?.unwrap_or_default();
    let total = sum(at_jump.iter().copied());
    let at_jump: Vec<f64> = at_jump.into_iter().map(|weight| weight / total).collect();
    let pole = 1.0 / vertices as f64;
    let k = scalars.k_after_jump;
    let remarks = OrderRemarks {
        diverges_at_jump: diverges_from(scalars.p_jump),
        diverges_at_large_p: diverges_from(HIGHER_P[HIGHER_P.len() - 1]),
        five_at_jump: five_share(&orders, k, scalars.p_jump),
        four_visits_of_third: four_visits_of_third(&orders, k),
        beyond_five: 1.0 - whole(HIGHER_P[0])?,
        whole_at_jump: whole(all.p)?,
        before_pole: 1.0 - all.p * vertices as f64,
        ends: at_jump.first().copied().unwrap_or(0.0),
    };
    Ok(AllOrders {
        pole,
        shares: ORDERS_K
            .into_iter()
            .filter(|k| *k <= vertices)
            .map(|k| shares(&orders, k))
            .collect(),
        whole: up_to_pole(pole)
            .map(|x| Ok(Point { x, y: whole(x)? }))
            .collect::<Result<_, Error>>()?,
        jumps: ORDERS.into_iter().map(|most| jump(Some(most))).collect::<Result<_, _>>()?,
        jump: all,
        at_jump,
        simple_at_jump: Law::new(Simple, vertices, scalars.p_jump)?.probabilities(),
        remarks,
    })
}

/// The five classes over all circuits with k different vertices; none are left where these diverge.
fn five_share(orders: &Orders, k: usize, p: f64) -> f64 {
    let five = multiplicity(FiveClasses, DoubleDouble::from(p), k).to_f64() / SHARED as f64;
    orders.all(k, p).map_or(0.0, |all| five / all)
}

fn shares(orders: &Orders, k: usize) -> OrderShares {
    let pole = 1.0 / k as f64;
    OrderShares {
        k,
        rows: up_to_pole(pole).map(|x| Point { x, y: five_share(orders, k, x) }).collect(),
    }
}

/// The places below a pole that are drawn, ever closer to it, and the pole itself.
fn up_to_pole(pole: f64) -> impl Iterator<Item = f64> {
    let far = drawn().take_while(move |p| *p < 0.9 * pole);
    let near = (0..=40).map(move |i| pole * (1.0 - 0.1 * pxfm::f_exp10(-0.25 * f64::from(i))));
    far.chain(near).chain([pole])
}

/// With three edges more, one vertex four times, of all ways: what Eq. (36) counts.
fn four_visits_of_third(orders: &Orders, k: usize) -> f64 {
    // At p = 1 a difference of partial sums is a count; circuits are primitive from k = 4 on.
    let third = orders.up_to(3, k, 1.0) - orders.up_to(2, k, 1.0);
    CLASSES[3].per_simple_circuit(FiveClasses, k) as f64 / higher_order::SHARED as f64 / third
}
