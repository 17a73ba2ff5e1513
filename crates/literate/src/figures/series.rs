//! Data in a panel: curves, markers, areas and bars.
//!
//! plotters moves points that lie outside a range onto the frame, which makes curves silently
//! false. Here such a point is an error, unless the caller asks for a cut at the frame.

use super::Error;
use super::clip::clip;
use super::element::{Drawn, Look};
use super::panel::Panel;
use super::style::{Colour, Mark, Stroke};
use impact_numerics::statistics::Estimate;

/// What to do with data outside the frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// It is a mistake.
    Refuse,
    /// The panel shows a part of the data on purpose: cut at the frame.
    Cut,
}

impl Panel {
    fn check(&self, name: &str, points: &[(f64, f64)]) -> Result<(), Error> {
        match points.iter().find(|p| !(self.x.holds(p.0) && self.y.holds(p.1))) {
            Some(&(x, y)) => Err(Error::Outside { series: name.into(), x, y }),
            None => Ok(()),
        }
    }

    fn series(&self, name: &str, elements: &[Drawn<(f64, f64)>]) -> Result<(), Error> {
        self.sheet.draw(&Drawn(vec![], Look::Open(name.into(), self.frame)))?;
        elements.iter().try_for_each(|element| self.plane.draw(element))?;
        Ok(self.sheet.draw(&Drawn(vec![], Look::Close))?)
    }

    /// A curve.
    ///
    /// # Errors
    /// [`Error::Outside`] if a point lies outside the frame and `outside` refuses that.
    pub fn curve(
        &self,
        name: &str,
        points: &[(f64, f64)],
        stroke: Stroke,
        outside: Outside,
    ) -> Result<(), Error> {
        if outside == Outside::Refuse {
            self.check(name, points)?;
        }
        if let Some(&(x, y)) = points.iter().find(|p| !(p.0.is_finite() && p.1.is_finite())) {
            return Err(Error::Outside { series: name.into(), x, y });
        }
        let inside: Vec<_> = match outside {
            Outside::Cut => points.to_vec(),
            // At most a rounding error is cut off here.
            Outside::Refuse => points
                .iter()
                .map(|p| (p.0.clamp(self.x.lo, self.x.hi), p.1.clamp(self.y.lo, self.y.hi)))
                .collect(),
        };
        let parts = clip(&inside, (self.x.lo, self.x.hi), (self.y.lo, self.y.hi));
        let curves: Vec<_> =
            parts.into_iter().map(|points| Drawn(points, Look::Curve(stroke))).collect();
        self.series(name, &curves)
    }

    /// Markers; points outside the frame are left out if `outside` cuts.
    ///
    /// # Errors
    /// [`Error::Outside`] if a point lies outside the frame and `outside` refuses that.
    pub fn marks(
        &self,
        name: &str,
        points: &[(f64, f64)],
        (mark, half, stroke): (Mark, i32, Stroke),
        outside: Outside,
    ) -> Result<(), Error> {
        if outside == Outside::Refuse {
            self.check(name, points)?;
        }
        let points =
            points.iter().copied().filter(|p| self.x.holds(p.0) && self.y.holds(p.1)).collect();
        self.series(name, &[Drawn(points, Look::Marks(mark, half, stroke))])
    }

    /// Upright ticks of the given width at many points, all inside the frame; the thickness of the
    /// stroke is their height.
    ///
    /// # Errors
    /// [`Error::Outside`] if a point lies outside the frame.
    pub fn ticks(
        &self,
        name: &str,
        points: &[(f64, f64)],
        width: i32,
        stroke: Stroke,
    ) -> Result<(), Error> {
        self.check(name, points)?;
        self.series(name, &[Drawn(points.to_vec(), Look::Ticks(width, stroke))])
    }

    /// A filled polygon, all of it inside the frame.
    ///
    /// # Errors
    /// [`Error::Outside`] if a corner lies outside the frame.
    pub fn area(
        &self,
        name: &str,
        points: &[(f64, f64)],
        fill: Colour,
        opacity: u8,
    ) -> Result<(), Error> {
        self.check(name, points)?;
        self.series(name, &[Drawn(points.to_vec(), Look::Area(fill, opacity))])
    }

    /// Bars from `low` to `high` at each x, with caps of the given half width.
    ///
    /// # Errors
    /// [`Error::Outside`] if an end lies outside the frame.
    pub fn bars(
        &self,
        name: &str,
        bars: &[(f64, f64, f64)],
        half: i32,
        stroke: Stroke,
    ) -> Result<(), Error> {
        let ends: Vec<_> = bars.iter().flat_map(|&(x, a, b)| [(x, a), (x, b)]).collect();
        self.check(name, &ends)?;
        let width = (self.x.hi - self.x.lo) / f64::from(self.frame.right - self.frame.left);
        let cap = f64::from(half) * width;
        let line = |a, b| Drawn(vec![a, b], Look::Curve(stroke));
        let mut parts = Vec::new();
        for &(x, low, high) in bars {
            parts.push(line((x, low), (x, high)));
            if half > 0 {
                let (a, b) = ((x - cap).max(self.x.lo), (x + cap).min(self.x.hi));
                parts.push(line((a, low), (b, low)));
                parts.push(line((a, high), (b, high)));
            }
        }
        self.series(name, &parts)
    }

    /// Estimates with bars of one standard error, at heights that may be logarithms. What lies outside the
    /// frame is left out, and bars are cut: a few realisations leave some that are longer than the axis.
    ///
    /// # Errors
    /// What drawing returns.
    pub fn estimates(
        &self,
        name: &str,
        estimates: &[(f64, Estimate)],
        look: (Mark, i32, Stroke),
        height: fn(f64) -> f64,
    ) -> Result<(), Error> {
        let at = |(x, own): &(f64, Estimate)| (*x, height(own.value));
        let holds = |(x, y): (f64, f64)| self.x.holds(x) && self.y.holds(y);
        let inside: Vec<_> = estimates.iter().filter(|own| holds(at(own))).collect();
        let cut = |y: f64| height(y.max(f64::MIN_POSITIVE)).clamp(self.y.lo, self.y.hi);
        let bar = |(x, own): &&(f64, Estimate)| {
            (*x, cut(own.value - own.error), cut(own.value + own.error))
        };
        self.bars(name, &inside.iter().map(bar).collect::<Vec<_>>(), 35, look.2)?;
        let points: Vec<_> = inside.into_iter().map(at).collect();
        self.marks(name, &points, look, Outside::Refuse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::axis::Axis;
    use crate::figures::panel::Frame;
    use crate::figures::sheet::Sheet;
    use crate::figures::style::GREEN;

    fn panel() -> Panel {
        let sheet = Sheet::new(3000, None).unwrap();
        let axis = || Axis::linear(0.0, 1.0, 0.5, 1, "");
        sheet.panel(Frame::new(1000, 100, 2000, 1100), axis(), axis()).unwrap()
    }

    #[test]
    fn data_outside_the_frame_is_an_error_and_not_moved_onto_it() {
        let panel = panel();
        let line = Stroke::solid(GREEN, 30);
        let beyond = [(0.5, 0.5), (0.6, 1.1)];
        let drawn = panel.curve("curve", &beyond, line, Outside::Refuse);
        assert!(matches!(drawn, Err(Error::Outside { y: 1.1, .. })));
        panel.curve("curve", &beyond, line, Outside::Cut).unwrap();
        let marks = panel.marks("marks", &beyond, (Mark::Disc, 30, line), Outside::Refuse);
        assert!(matches!(marks, Err(Error::Outside { .. })));
        assert!(panel.area("area", &beyond, GREEN, 50).is_err());
        assert!(panel.bars("bars", &[(0.5, 0.1, 1.1)], 20, line).is_err());
        assert!(panel.curve("nan", &[(0.1, f64::NAN)], line, Outside::Cut).is_err());
    }

    #[test]
    fn a_wall_touched_within_rounding_is_inside() {
        let line = Stroke::solid(GREEN, 30);
        panel().curve("wall", &[(0.0, -1e-17), (1.0, 1.0 + 1e-15)], line, Outside::Refuse).unwrap();
    }

    #[test]
    fn corners_of_the_axes_are_corners_of_the_frame() {
        let panel = panel();
        assert_eq!(panel.at(0.0, 0.0), (1000, 1100));
        assert_eq!(panel.at(1.0, 1.0), (2000, 100));
    }
}
