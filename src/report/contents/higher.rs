//! Section 9: circuits of higher order.

use super::{Error, chosen, from};
use crate::claims::{sec9, sec10};
use crate::experiments::{Results, theory};
use crate::report::values::{Value, origin};

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let mut values = from(classes(results)?, origin(theory::distributions::higher), "theory");
    values.extend(from(compared(results)?, origin(sec9::largest_change), "theory"));
    Ok(values)
}

fn classes(results: &Results) -> Result<Vec<Value>, Error> {
    let (theory, id) = (&results.theory, &results.identities);
    let scalars = &theory.scalars;
    let missing = Error::Missing("Figs. 13 and 14");
    let (Some(first), Some(last)) = (theory.higher.first(), theory.higher.last()) else {
        return Err(missing);
    };
    let [Some(a), Some(b)] = [theory.convergence.first(), theory.convergence.last()] else {
        return Err(missing);
    };
    let eq33 = id.classes.iter().find(|class| class.equation == 33);
    let eq33 = eq33.ok_or(Error::Missing("Eq. (33)"))?;
    let share = |p: f64| sec9::simple_share(theory, p).ok_or(Error::Missing("a share of Fig. 13"));
    let middle = theory.higher.get(1).map_or(last.p, |panel| panel.p);
    // From this k on p k²/2 is at least one.
    let tail_from = (2.0 / first.p).sqrt().ceil() as usize;
    let tail: f64 = first.total.iter().skip(tail_from - 1).sum();
    let doubling = sec9::doubling(last, last.mean as usize);
    let [doubling, _] = doubling.ok_or(Error::Missing("the classes of Fig. 13"))?;
    let [_, at] = sec9::largest_mean_difference(theory);
    let small = theory.most_likely.mean_inset.iter().find(|row| row.p == at);
    let small = small.map_or(0.0, |row| row.mean_higher - row.mean);
    let repeated = sec9::repeats(&results.segments()?.fig06).len();
    Ok(vec![
        Value::integer("fig6_repeated", repeated),
        Value::real("eq30_printed", id.eq30_printed, 1),
        Value::integer("eq30_counted", id.eq30_counted),
        Value::real("eq33_printed", eq33.formula_below, 2),
        Value::integer("eq33_counted", eq33.counted_below),
        Value::real("printed_jump_shift", scalars.printed_p_jump / scalars.higher_p_jump - 1.0, 1),
        Value::real("simple_share_a", share(first.p)?, 3),
        Value::real("simple_share_b", share(middle)?, 2),
        Value::real("simple_share_c", share(a.p)?, 1),
        Value::real("simple_share_d", share(last.p)?, 1),
        Value::integer("tail_from", tail_from),
        Value::real("tail_weight", tail, 1),
        Value::real("tv_a", a.total_variation, 2),
        Value::real("tv_b", b.total_variation, 2),
        Value::real("mean_difference_large", last.mean - last.mean_simple, 2),
        Value::real("mean_difference_small", small, 2),
        chosen("mean_difference_at", at),
        Value::real("doubling", doubling, 3),
        Value::real("higher_p_jump", scalars.higher_p_jump, 5),
        Value::integer("higher_k_after_jump", scalars.higher_k_after_jump),
    ])
}

/// Fig. 15.
fn compared(results: &Results) -> Result<Vec<Value>, Error> {
    let (sweep, theory) = (results.sweep()?, &results.theory);
    let scalars = &theory.scalars;
    let [change, at] = sec9::largest_change(&theory.curve);
    let [relation, higher] = sec9::moves(theory);
    let distance = |column| {
        sec10::distance(sweep, &theory.curve, column).ok_or(Error::Missing("rows of the rise"))
    };
    Ok(vec![
        Value::real("fig15_largest", change, 2),
        chosen("fig15_largest_at", at),
        Value::real("fig15_shift", scalars.sigma_half - scalars.higher_sigma_half, 1),
        Value::real("rms_simple", distance(|row| row.simple)?, 3),
        Value::real("rms_higher", distance(|row| row.higher)?, 3),
        Value::real("rms_rest", distance(|row| row.simple_rest)?, 3),
        Value::real("relation_over_higher", relation / higher, 2),
    ])
}
