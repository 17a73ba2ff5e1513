//! Fits a decay to a limit, c + a e^(−b x).

/// A decay fitted to points.
pub struct Decay {
    pub limit: f64,
    pub amplitude: f64,
    pub exponent: f64,
    /// The weighted sum of squares that is left.
    pub misfit: f64,
}

impl Decay {
    /// Fits a decay to points (x, y, weight), to zero or to a limit that is fitted too, with an
    /// exponent from about 1/20 to 20 that is found by ever finer steps of its logarithm. Returns
    /// `None` if there are fewer points than numbers to fit.
    pub fn fit(points: &[[f64; 3]], has_limit: bool) -> Option<Decay> {
        let fit = |log: f64| Decay::with_exponent(pxfm::f_exp(log), points, has_limit);
        let with_misfit = |log: f64| (log, fit(log).misfit);
        let (mut centre, mut half): (f64, f64) = (0.0, 3.0);
        for _ in 0..9 {
            let places = (-20..=20).map(|step| centre + half * f64::from(step) / 20.0);
            centre = places.map(with_misfit).min_by(|(_, a), (_, b)| a.total_cmp(b))?.0;
            half /= 10.0;
        }
        (points.len() >= 2 + usize::from(has_limit)).then(|| fit(centre))
    }

    fn with_exponent(exponent: f64, points: &[[f64; 3]], has_limit: bool) -> Decay {
        let powers = points.iter().map(|[x, ..]| pxfm::f_exp(-exponent * x));
        let powers: Vec<f64> = powers.collect();
        let sum = |factor: &dyn Fn(f64, f64) -> f64| {
            let terms = powers.iter().zip(points);
            terms.map(|(x, [_, y, weight])| weight * factor(*x, *y)).sum::<f64>()
        };
        let [one, x, y] = [sum(&|_, _| 1.0), sum(&|x, _| x), sum(&|_, y| y)];
        let [xx, xy] = [sum(&|x, _| x * x), sum(&|x, y| x * y)];
        let free = (one * xy - x * y) / (one * xx - x * x);
        let amplitude = if has_limit { free } else { xy / xx };
        let limit = if has_limit { (y - amplitude * x) / one } else { 0.0 };
        let rest = |x: f64, y: f64| y - limit - amplitude * x;
        Decay { limit, amplitude, exponent, misfit: sum(&|x, y| rest(x, y) * rest(x, y)) }
    }
}
