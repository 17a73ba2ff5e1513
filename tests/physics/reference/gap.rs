//! One gap as a function of absolute time, Eq. (19), and its first root with certainty.

use super::real::Real;

/// Δ(t) = d + a cos ωt + b sin ωt + Σ (c cos Ωt + e sin Ωt).
#[derive(Clone, Debug)]
pub struct Gap<R> {
    /// d.
    pub spacing: R,
    /// ω and each Ω.
    pub frequencies: Vec<R>,
    /// (a, b) and each (c, e).
    pub amplitudes: Vec<[R; 2]>,
}

/// One piece of the time axis, with the signs that are known of Δ at its ends.
struct Piece<R> {
    from: R,
    to: R,
}

impl<R: Real> Gap<R> {
    /// Δ, Δ', Δ'' at a time.
    pub fn jet(&self, t: &R) -> [R; 3] {
        let mut jet = [self.spacing.clone(), R::of(0.0), R::of(0.0)];
        for (w, [a, b]) in self.frequencies.iter().zip(&self.amplitudes) {
            let (s, c) = (w.clone() * t.clone()).sin_cos();
            let u = a.clone() * c.clone() + b.clone() * s.clone();
            let v = b.clone() * c - a.clone() * s;
            let [f, g, h] = jet;
            jet = [f + u.clone(), g + w.clone() * v, h - w.clone() * w.clone() * u];
        }
        jet
    }

    /// Bounds of |Δ − d|, |Δ''| and |Δ'''| over all time.
    fn bounds(&self) -> [f64; 3] {
        let mut bounds = [0.0; 3];
        for (w, [a, b]) in self.frequencies.iter().zip(&self.amplitudes) {
            let (radius, w) = (a.near().hypot(b.near()) * (1.0 + 1e-14), w.near().abs());
            bounds[0] += radius;
            bounds[1] += w * w * radius;
            bounds[2] += w * w * w * radius;
        }
        bounds
    }

    /// d + R1 + R2.
    pub fn scale(&self) -> f64 {
        self.spacing.near() + self.bounds()[0]
    }

    /// ω² R1 + Ω² R2, which bounds |Δ''|.
    pub fn bend(&self) -> f64 {
        self.bounds()[1]
    }

    /// Whether R1 + R2 < d by a clear margin, so that the gap never closes.
    pub fn never_closes(&self) -> bool {
        self.bounds()[0] * (1.0 + 1e-12) < self.spacing.near()
    }

    /// The first time in (from, to] at which Δ falls to zero from above.
    ///
    /// A gap that is closed at `from` (to a few roundings) counts as just parted when it opens,
    /// and as a root when it closes. With neither, it stays in contact: an error.
    pub fn first_root(&self, from: &R, to: &R) -> Result<Option<R>, String> {
        let noise = 1e4 * R::EPS * self.scale() * from.near().abs().max(1.0);
        let [f, g, h] = self.jet(from).map(|x| x.near());
        let touching = f.abs() <= noise;
        if touching && g.abs() > noise && g < 0.0 {
            return Ok(Some(from.clone()));
        }
        if f < -noise {
            return Err(format!("overlap of {f:e} at t = {}", from.near()));
        }
        // Without a speed the gap opens or stays by its acceleration.
        let mut ignore = R::of(0.0);
        if touching && g.abs() <= noise {
            if h <= 0.0 {
                return Err(format!("contact at t = {}", from.near()));
            }
            ignore = R::of(noise.sqrt() / h.sqrt().min(1.0) * 10.0);
        }
        let start = from.clone() + ignore;
        if start >= *to {
            return Ok(None);
        }
        let (rough, mut left) = (self.rough(), start.clone());
        while left < *to {
            let right = left.clone() + R::of(0.4);
            let right = if right < *to { right } else { to.clone() };
            if let Some(root) = self.search(&rough, left, right.clone())? {
                return Ok(Some(root));
            }
            left = right;
        }
        Ok(None)
    }

    /// The gap in doubles.
    fn rough(&self) -> Gap<f64> {
        Gap {
            spacing: self.spacing.near(),
            frequencies: self.frequencies.iter().map(R::near).collect(),
            amplitudes: self.amplitudes.iter().map(|[a, b]| [a.near(), b.near()]).collect(),
        }
    }

    /// Depth first, left first: a piece is excluded by its enclosure (in doubles where these are
    /// enough), decided by the signs at its ends where Δ is monotone, cut at its extremum where Δ'
    /// is, and halved otherwise.
    fn search(&self, rough: &Gap<f64>, from: R, to: R) -> Result<Option<R>, String> {
        let [_, bend, third] = self.bounds();
        // More than the errors of Δ, Δ' and Δ'' in doubles, those of the phases included.
        let fastest = rough.frequencies.iter().fold(1.0, |most: f64, w| most.max(w.abs()));
        let noise = 1e-13 * (self.scale() + bend) * (1.0 + fastest * to.near().abs());
        let mut stack = vec![Piece { from, to }];
        while let Some(Piece { from, to }) = stack.pop() {
            let half = R::of(0.5) * (to.clone() - from.clone());
            let middle = from.clone() + half.clone();
            let h = half.near() * (1.0 + 1e-14);
            let stays_open = |[f, g, k]: [f64; 3], noise: f64| {
                let falls = g.abs() * h + 0.5 * k.abs() * h * h + third * h * h * h / 6.0;
                f - noise > falls * (1.0 + 1e-13)
            };
            if stays_open(rough.jet(&middle.near()), noise) {
                continue;
            }
            let [f, g, k] = self.jet(&middle).map(|x| x.near());
            if stays_open([f, g, k], 0.0) {
                continue;
            }
            if g.abs() > (k.abs() * h + 0.5 * third * h * h) * (1.0 + 1e-13) {
                if g < 0.0 && self.closed(&to) {
                    return Ok(Some(self.bisect(from, to, 0)));
                }
                continue;
            }
            if k.abs() > third * h * (1.0 + 1e-13) {
                if let Some(root) = self.unimodal(rough, from, to, k > 0.0) {
                    return Ok(Some(root));
                }
                continue;
            }
            if h < 1e-13 {
                return Err(format!("a triple root at t = {}", middle.near()));
            }
            stack.push(Piece { from: middle.clone(), to });
            stack.push(Piece { from, to: middle });
        }
        Ok(None)
    }

    /// The first root in a piece where Δ'' keeps its sign.
    fn unimodal(&self, rough: &Gap<f64>, from: R, to: R, convex: bool) -> Option<R> {
        let slope = |t: &R| self.jet(t)[1].clone();
        let zero = R::of(0.0);
        let turns = (slope(&from) < zero) != (slope(&to) < zero);
        if !turns {
            let falls = slope(&to) < zero;
            return (falls && self.closed(&to)).then(|| self.bisect(from, to, 0));
        }
        // A convex Δ is above its tangent, which near the minimum is nearly level.
        let low = R::of(rough.bisect(from.near(), to.near(), 1));
        if convex && low > from && low < to {
            let [f, g, _] = self.jet(&low).map(|x| x.near());
            if f > g.abs() * (to.clone() - from.clone()).near() * (1.0 + 1e-13) {
                return None;
            }
        }
        let turn = self.bisect(from.clone(), to.clone(), if convex { 1 } else { 2 });
        let (left, right) = if convex { (from, turn) } else { (turn, to) };
        self.closed(&right).then(|| self.bisect(left, right, 0))
    }

    fn closed(&self, t: &R) -> bool {
        self.jet(t)[0] <= R::of(0.0)
    }

    /// The place in (from, to] where Δ falls (mode 0), Δ' rises (1) or Δ' falls (2) through
    /// zero: bisection down to a small piece, then Newton steps kept inside it.
    fn bisect(&self, mut from: R, mut to: R, mode: usize) -> R {
        let value = |t: &R| {
            let [f, g, h] = self.jet(t);
            match mode {
                0 => (-f, -g),
                1 => (g, h),
                _ => (-g, -h),
            }
        };
        let mut best = to.clone();
        for step in 0..400 {
            let (f, slope) = value(&best);
            if f >= R::of(0.0) {
                to = best.clone();
            } else {
                from = best.clone();
            }
            let newton = best.clone() - f / slope;
            let wide = to.clone() - from.clone();
            let halves = step % 3 == 2 && wide.near() > 1e-6 || !(newton > from && newton < to);
            let next = if halves { from.clone() + R::of(0.5) * wide } else { newton };
            let change = (next.clone() - best).near().abs() / next.near().abs().max(1e-3);
            best = next;
            // A step of Newton's method doubles the digits.
            if change <= if halves { 4.0 * R::EPS } else { 1e-4 * R::EPS.sqrt() } {
                break;
            }
        }
        best
    }
}
