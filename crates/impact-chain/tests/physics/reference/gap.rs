//! Finds the first root of one gap, Eq. (19) as a function of absolute time, with certainty.

use super::{Dd, EPS, sin_cos};

/// Δ(t) = d + a cos ωt + b sin ωt + Σ (c cos Ωt + e sin Ωt).
#[derive(Clone, Debug)]
pub struct Gap {
    /// d.
    pub spacing: Dd,
    /// ω and each Ω.
    pub frequencies: Vec<Dd>,
    /// (a, b) and each (c, e).
    pub amplitudes: Vec<[Dd; 2]>,
}

impl Gap {
    /// Δ, Δ', Δ'' at a time.
    pub fn jet(&self, t: Dd) -> [Dd; 3] {
        let mut jet = [self.spacing, Dd::ZERO, Dd::ZERO];
        for (&w, &[a, b]) in self.frequencies.iter().zip(&self.amplitudes) {
            let [s, c] = sin_cos(w * t);
            let u = a * c + b * s;
            let v = b * c - a * s;
            let [f, g, h] = jet;
            jet = [f + u, g + w * v, h - w * w * u];
        }
        jet
    }

    /// Bounds of |Δ − d|, |Δ''| and |Δ'''| over all time.
    fn bounds(&self) -> [f64; 3] {
        let mut bounds = [0.0; 3];
        for (&w, &[a, b]) in self.frequencies.iter().zip(&self.amplitudes) {
            let (radius, w) = (a.hi.hypot(b.hi) * (1.0 + 1e-14), w.hi.abs());
            bounds[0] += radius;
            bounds[1] += w * w * radius;
            bounds[2] += w * w * w * radius;
        }
        bounds
    }

    /// d + R1 + R2.
    pub fn scale(&self) -> f64 {
        self.spacing.hi + self.bounds()[0]
    }

    /// ω² R1 + Ω² R2, which bounds |Δ''|.
    pub fn bend(&self) -> f64 {
        self.bounds()[1]
    }

    /// The first time in (from, to] at which Δ falls to zero from above.
    ///
    /// A gap that is closed at `from` (to a few roundings) counts as just parted when it opens,
    /// and as a root when it closes. With neither, it stays in contact: an error.
    pub fn first_root(&self, from: Dd, to: Dd) -> Result<Option<Dd>, String> {
        let noise = 1e4 * EPS * self.scale() * from.hi.abs().max(1.0);
        let [f, g, h] = self.jet(from).map(|x| x.hi);
        let touching = f.abs() <= noise;
        if touching && g.abs() > noise && g < 0.0 {
            return Ok(Some(from));
        }
        if f < -noise {
            return Err(format!("overlap of {f:e} at t = {}", from.hi));
        }
        // Without a speed the gap opens or stays by its acceleration.
        let mut ignore = Dd::ZERO;
        if touching && g.abs() <= noise {
            if h <= 0.0 {
                return Err(format!("contact at t = {}", from.hi));
            }
            ignore = Dd::from(noise.sqrt() / h.sqrt().min(1.0) * 10.0);
        }
        let start = from + ignore;
        if start < to { self.search(start, to) } else { Ok(None) }
    }

    /// Depth first, left first: a piece is excluded by its enclosure, decided by the signs at its
    /// ends where Δ is monotone, cut at its extremum where Δ' is, and halved otherwise.
    fn search(&self, from: Dd, to: Dd) -> Result<Option<Dd>, String> {
        let [_, _, third] = self.bounds();
        let mut stack = vec![[from, to]];
        while let Some([from, to]) = stack.pop() {
            let half = Dd::from(0.5) * (to - from);
            let middle = from + half;
            let h = half.hi * (1.0 + 1e-14);
            let [f, g, k] = self.jet(middle).map(|x| x.hi);
            let falls = g.abs() * h + 0.5 * k.abs() * h * h + third * h * h * h / 6.0;
            if f > falls * (1.0 + 1e-13) {
                continue;
            }
            let is_monotone = g.abs() > (k.abs() * h + 0.5 * third * h * h) * (1.0 + 1e-13);
            if is_monotone || k.abs() > third * h * (1.0 + 1e-13) {
                if let Some(root) = self.unimodal(from, to, k > 0.0) {
                    return Ok(Some(root));
                }
                continue;
            }
            if h < 1e-13 {
                return Err(format!("a triple root at t = {}", middle.hi));
            }
            stack.extend([[middle, to], [from, middle]]);
        }
        Ok(None)
    }

    /// The first root in a piece where Δ' or Δ'' keeps its sign.
    fn unimodal(&self, from: Dd, to: Dd, convex: bool) -> Option<Dd> {
        let slope = |t: Dd| self.jet(t)[1];
        let [falls_before, falls] = [from, to].map(|t| slope(t) < Dd::ZERO);
        if falls_before == falls {
            return (falls && self.closed(to)).then(|| self.bisect(from, to, 0, -1.0));
        }
        let turn = self.bisect(from, to, 1, if convex { 1.0 } else { -1.0 });
        let (left, right) = if convex { (from, turn) } else { (turn, to) };
        self.closed(right).then(|| self.bisect(left, right, 0, -1.0))
    }

    fn closed(&self, t: Dd) -> bool {
        self.jet(t)[0] <= Dd::ZERO
    }

    /// The place in (from, to] where Δ or Δ', times a sign, rises through zero: bisection down to
    /// a small piece, then Newton steps kept inside it.
    fn bisect(&self, mut from: Dd, mut to: Dd, order: usize, sign: f64) -> Dd {
        let mut best = to;
        for step in 0..400 {
            let jet = self.jet(best);
            let [f, slope] = [jet[order] * sign, jet[order + 1] * sign];
            if f >= Dd::ZERO {
                to = best;
            } else {
                from = best;
            }
            let newton = best - f / slope;
            let wide = to - from;
            let halves = step % 3 == 2 && wide.hi > 1e-6 || !(newton > from && newton < to);
            let next = if halves { from + Dd::from(0.5) * wide } else { newton };
            let change = (next - best).hi.abs() / next.hi.abs().max(1e-3);
            best = next;
            // A step of Newton's method doubles the digits.
            if change <= if halves { 4.0 * EPS } else { 1e-4 * EPS.sqrt() } {
                break;
            }
        }
        best
    }
}
