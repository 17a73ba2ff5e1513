//! The roundings between the doubles of a scenario and the next impact, counted by a machine.

pub mod path;
pub mod tape;

pub use path::{COUNTED, Case, Parts, RANGE};
use tape::Num;

/// The worst errors of f and f' at the root by stages, as coefficients of d, Q₁ and Q₂, in units of
/// 2^-53 (and of the fastest frequency for f').
///
/// Every rounding is linear in the two numbers of an amplitude, so the sum of the moduli is convex in
/// its direction; 64 directions miss at most a part in a thousand of its largest value.
pub fn worst(case: &Case) -> [[[f64; COUNTED]; 3]; 2] {
    let fastest = case.frequencies[0].max(case.frequencies[1]);
    let along = |free: bool, i: usize| {
        let mut parts = Parts::default();
        let of = if free { &mut parts.free } else { &mut parts.forced };
        of[1][i] = 1.0;
        case.follow(&parts).map(Num::roundings)
    };
    let d = case.follow(&Parts { spacing: 1.0, ..Parts::default() }).map(Num::roundings);
    let pairs = [[along(true, 0), along(true, 1)], [along(false, 0), along(false, 1)]];
    std::array::from_fn(|k| {
        let unit = [1.0, fastest][k];
        let mut sums = [[0.0; COUNTED]; 3];
        for (stage, x) in &d[k] {
            sums[0][*stage] += x.abs() / unit;
        }
        for (group, [x, y]) in pairs.iter().enumerate() {
            for turn in 0..64 {
                let (sin, cos) = (f64::from(turn) * std::f64::consts::PI / 64.0).sin_cos();
                let mut sum = [0.0; COUNTED];
                for ((stage, x), (_, y)) in x[k].iter().zip(&y[k]) {
                    sum[*stage] += (x * cos + y * sin).abs() / unit;
                }
                for (most, sum) in sums[group + 1].iter_mut().zip(sum) {
                    *most = sum.max(*most);
                }
            }
        }
        sums
    })
}

/// The largest error of f and f' at the root of these very parts, in units of 2^-53.
pub fn of(case: &Case, parts: &Parts) -> [f64; 2] {
    case.follow(parts).map(|end| end.roundings().iter().map(|(_, x)| x.abs()).sum())
}
