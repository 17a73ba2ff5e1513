//! Data in a panel: curves, markers, areas and bars.
//!
//! plotters moves points that lie outside a range onto the frame, which makes curves silently
//! false. Here such a point is an error, unless the caller asks for something else.
//!
//! Each series is recorded as it was given, in its own units, before anything is cut: curves, markers, ticks, bars,
//! estimates and columns. Guides and areas are no data.
//!
//! All return [`Error::Outside`] for a number that is not finite, and for a point outside where that is refused.

use super::Error;
use super::clip::clip;
use super::element::{Drawn, Look};
use super::panel::Panel;
use super::record::Row;
use super::style::{Colour, Mark, Stroke};
use impact_numerics::statistics::Estimate;

/// What to do with data outside the frame. On a logarithmic axis all that is not positive lies outside, below.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// It is a mistake.
    Refuse,
    /// The panel shows a part of the data on purpose: cut at the frame. What is not positive is left out on a
    /// logarithmic axis, of the record too.
    Cut,
    /// It is shown at the edge.
    Edge,
}

/// Shape, half width, and line or colour of markers.
pub type Marker = (Mark, i32, Stroke);

impl Panel {
    /// Where points lie on the axes. Numbers that are not finite are always an error.
    fn placed(
        &self,
        name: &str,
        points: &[(f64, f64)],
        outside: Outside,
    ) -> Result<Vec<(f64, f64)>, Error> {
        let finite = |p: &(f64, f64)| p.0.is_finite() && p.1.is_finite();
        let holds = |p: &(f64, f64)| self.x.holds(p.0) && self.y.holds(p.1);
        let fault = |p: &&(f64, f64)| !finite(p) || outside == Outside::Refuse && !holds(p);
        if let Some(&(x, y)) = points.iter().find(fault) {
            return Err(Error::Outside { series: name.into(), x, y });
        }
        let (x, y) = (self.x.ends(), self.y.ends());
        let place = |p: &(f64, f64)| (self.x.at(p.0), self.y.at(p.1));
        Ok(match outside {
            Outside::Cut => points.iter().map(place).filter(finite).collect(),
            // Of what is refused elsewhere, at most a rounding error is cut off here.
            Outside::Refuse | Outside::Edge => {
                let edge = |p: (f64, f64)| (p.0.clamp(x.0, x.1), p.1.clamp(y.0, y.1));
                points.iter().map(place).map(edge).collect()
            }
        })
    }

    /// Keeps rows of a series for the data file, as a picture may show them in another way.
    pub fn record<R: Into<Row>>(&self, name: &str, rows: impl IntoIterator<Item = R>) {
        if self.recorded {
            let name = self.series.as_deref().unwrap_or(name);
            self.record.borrow_mut().add(name, rows.into_iter().map(R::into));
        }
    }

    fn record_points(&self, name: &str, points: &[(f64, f64)], outside: Outside) {
        let shown = |p: &&(f64, f64)| {
            outside == Outside::Edge || self.x.at(p.0).is_finite() && self.y.at(p.1).is_finite()
        };
        self.record(name, points.iter().filter(shown).copied());
    }

    fn draw(&self, name: &str, elements: &[Drawn<(f64, f64)>]) -> Result<(), Error> {
        self.sheet.draw(&Drawn(vec![], Look::Open(name.into(), self.frame)))?;
        elements.iter().try_for_each(|element| self.plane.draw(element))?;
        Ok(self.sheet.draw(&Drawn(vec![], Look::Close))?)
    }

    /// A curve.
    pub fn curve(
        &self,
        name: &str,
        points: &[(f64, f64)],
        stroke: Stroke,
        outside: Outside,
    ) -> Result<(), Error> {
        let parts = clip(&self.placed(name, points, outside)?, self.x.ends(), self.y.ends());
        self.record_points(name, points, outside);
        let curves: Vec<_> =
            parts.into_iter().map(|points| Drawn(points, Look::Curve(stroke))).collect();
        self.draw(name, &curves)
    }

    /// A line that is no data: zero, a level, an outline, a printed value; cut at the frame.
    pub fn guide(&self, name: &str, points: &[(f64, f64)], stroke: Stroke) -> Result<(), Error> {
        self.quiet().curve(name, points, stroke, Outside::Cut)
    }

    /// A guide across the panel at one height.
    pub fn level(&self, name: &str, y: f64, stroke: Stroke) -> Result<(), Error> {
        self.guide(name, &[(self.x.lo, y), (self.x.hi, y)], stroke)
    }

    /// Markers; points outside the frame are left out if `outside` cuts.
    pub fn marks(
        &self,
        name: &str,
        points: &[(f64, f64)],
        (mark, half, stroke): Marker,
        outside: Outside,
    ) -> Result<(), Error> {
        let mut placed = self.placed(name, points, outside)?;
        placed.retain(|p| self.x.reaches(p.0) && self.y.reaches(p.1));
        self.record_points(name, points, outside);
        self.draw(name, &[Drawn(placed, Look::Marks(mark, half, stroke))])
    }

    /// A curve with markers at its points.
    pub fn marked(
        &self,
        name: &str,
        points: &[(f64, f64)],
        (stroke, marker): (Stroke, Marker),
        outside: Outside,
    ) -> Result<(), Error> {
        self.curve(name, points, stroke, outside)?;
        self.marks(name, points, marker, outside)
    }

    /// Upright ticks of the given width at many points, all inside the frame; the thickness of the
    /// stroke is their height.
    pub fn ticks(
        &self,
        name: &str,
        points: &[(f64, f64)],
        width: i32,
        stroke: Stroke,
    ) -> Result<(), Error> {
        let placed = self.placed(name, points, Outside::Refuse)?;
        self.record_points(name, points, Outside::Refuse);
        self.draw(name, &[Drawn(placed, Look::Ticks(width, stroke))])
    }

    /// A filled polygon, all of it inside the frame; it is a ground, and no data.
    pub fn area(
        &self,
        name: &str,
        points: &[(f64, f64)],
        fill: Colour,
        opacity: u8,
    ) -> Result<(), Error> {
        let placed = self.placed(name, points, Outside::Refuse)?;
        self.draw(name, &[Drawn(placed, Look::Area(fill, opacity))])
    }

    /// Columns of width 1 around 1, 2, …, which stand on zero: filled and with an outline.
    pub fn columns(&self, name: &str, values: &[f64], stroke: Stroke) -> Result<(), Error> {
        let heights = || (1..).map(f64::from).zip(values.iter().copied());
        let end = |k: f64| k.min(self.x.hi);
        let mut outline = vec![(0.5, 0.0)];
        outline.extend(heights().flat_map(|(k, own)| [(k - 0.5, own), (end(k + 0.5), own)]));
        outline.push((end(values.len() as f64 + 0.5), 0.0));
        self.record(name, heights());
        self.area(name, &outline, stroke.colour, 45)?;
        self.quiet().curve(name, &outline, stroke, Outside::Refuse)
    }

    /// Bars from `low` to `high` at each x, with caps of the given half width; cut at the frame where that is no
    /// mistake.
    pub fn bars(
        &self,
        name: &str,
        bars: &[(f64, f64, f64)],
        half: i32,
        stroke: Stroke,
        outside: Outside,
    ) -> Result<(), Error> {
        let outside = if outside == Outside::Cut { Outside::Edge } else { outside };
        let ends: Vec<_> = bars.iter().flat_map(|&(x, a, b)| [(x, a), (x, b)]).collect();
        let ends = self.placed(name, &ends, outside)?;
        self.record(name, bars.iter().copied());
        let (lo, hi) = self.x.ends();
        let cap = f64::from(half) * (hi - lo) / f64::from(self.frame.right - self.frame.left);
        let line = |a, b| Drawn(vec![a, b], Look::Curve(stroke));
        let mut parts = Vec::new();
        for ends in ends.chunks_exact(2) {
            let ((x, low), (_, high)) = (ends[0], ends[1]);
            parts.push(line((x, low), (x, high)));
            if half > 0 {
                let (a, b) = ((x - cap).max(lo), (x + cap).min(hi));
                parts.push(line((a, low), (b, low)));
                parts.push(line((a, high), (b, high)));
            }
        }
        self.draw(name, &parts)
    }

    /// Estimates with bars of one standard error. What lies outside the frame is left out, and bars are cut: a few
    /// realisations leave some that are longer than the axis.
    pub fn estimates(
        &self,
        name: &str,
        estimates: &[(f64, Estimate)],
        look: Marker,
    ) -> Result<(), Error> {
        let shown = |(x, own): &&(f64, Estimate)| {
            self.x.at(*x).is_finite() && self.y.at(own.value).is_finite()
        };
        self.record(name, estimates.iter().filter(shown).copied());
        let holds = |(x, own): &&(f64, Estimate)| self.x.holds(*x) && self.y.holds(own.value);
        let inside = || estimates.iter().filter(holds);
        let bars = inside().map(|(x, own)| (*x, own.value - own.error, own.value + own.error));
        let points: Vec<_> = inside().map(|(x, own)| (*x, own.value)).collect();
        self.quiet().bars(name, &bars.collect::<Vec<_>>(), 35, look.2, Outside::Edge)?;
        self.quiet().marks(name, &points, look, Outside::Refuse)
    }

    /// Estimates with a line through them, cut at the frame.
    pub fn joined(
        &self,
        name: &str,
        estimates: &[(f64, Estimate)],
        look: Marker,
    ) -> Result<(), Error> {
        let points: Vec<_> = estimates.iter().map(|(x, own)| (*x, own.value)).collect();
        self.quiet().curve(name, &points, look.2, Outside::Cut)?;
        self.estimates(name, estimates, look)
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
        let sheet = Sheet::new(3000);
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
        let bars = [(0.5, 0.1, 1.1)];
        assert!(panel.bars("bars", &bars, 20, line, Outside::Refuse).is_err());
        panel.bars("bars", &bars, 20, line, Outside::Cut).unwrap();
        assert!(panel.columns("columns", &[1.1], line).is_err());
        assert!(panel.curve("nan", &[(0.1, f64::NAN)], line, Outside::Cut).is_err());
    }

    #[test]
    fn on_a_logarithmic_axis_what_is_not_positive_is_outside_below() {
        let sheet = Sheet::new(3000);
        let frame = Frame::new(1000, 100, 2000, 1100);
        let (x, y) = (Axis::linear(0.0, 1.0, 0.5, 1, "x"), Axis::decades(-2, 0, 1, "y"));
        let panel = sheet.lettered("(b)", frame, x, y).unwrap();
        assert_eq!(panel.at(0.5, 0.1), (1500, 600));
        let line = Stroke::solid(GREEN, 30);
        let points = [(0.1, 0.5), (0.2, 0.0), (0.3, 1e-3), (0.4, -1.0)];
        let refused = panel.curve("refused", &points, line, Outside::Refuse);
        assert!(matches!(refused, Err(Error::Outside { x: 0.2, y: 0.0, .. })));
        panel.curve("cut", &points, line, Outside::Cut).unwrap();
        panel.marks("edge", &points[1..2], (Mark::Disc, 30, line), Outside::Edge).unwrap();
        let of = |value, error| Estimate { value, error, interval: [value; 2] };
        let estimates = [(0.5, of(0.1, 0.2)), (0.6, of(0.0, 0.1)), (0.7, of(2.0, 0.1))];
        panel.estimates("estimates", &estimates, (Mark::Disc, 30, line)).unwrap();
        // In units of the data, and as they were given: the cut is the picture's.
        let file = &sheet.finish("s01", "", String::new()).data[0];
        let rows = [
            "cut,0.1,0.5,",
            "cut,0.3,0.001,",
            "edge,0.2,0,",
            "estimates,0.5,0.1,0.2",
            "estimates,0.7,2,0.1",
        ];
        assert_eq!(file.name, "s01b.csv");
        assert_eq!(file.csv().lines().skip(1).collect::<Vec<_>>(), rows);
    }

    #[test]
    fn guides_grounds_and_insets_are_no_data() {
        let sheet = Sheet::new(3000);
        let frame = Frame::new(1000, 100, 2000, 1100);
        let axis = || Axis::linear(0.0, 1.0, 0.5, 1, "x");
        let panel = sheet.panel(frame, axis(), axis()).unwrap();
        let (line, points) = (Stroke::solid(GREEN, 30), [(0.1, 0.2), (0.3, 0.4)]);
        panel.guide("guide", &points, line).unwrap();
        panel.level("level", 0.5, line).unwrap();
        panel.area("area", &points, GREEN, 50).unwrap();
        panel.quiet().marks("rims", &points, (Mark::Disc, 30, line), Outside::Cut).unwrap();
        let inset = sheet.inset(frame, axis(), axis()).unwrap();
        inset.curve("again", &points, line, Outside::Cut).unwrap();
        let own = sheet.inset(frame, axis(), axis()).unwrap().file("-inset");
        own.series("finer").curve("again", &points[..1], line, Outside::Cut).unwrap();
        panel.columns("columns", &[0.5], line).unwrap();
        let data = sheet.finish("s01", "", String::new()).data;
        let told: Vec<_> = data.iter().map(|file| (&*file.name, file.csv())).collect();
        let head = "series (text),x (1),x (1)\n";
        let files = [("s01.csv", "columns,1,0.5\n"), ("s01-inset.csv", "finer,0.1,0.2\n")];
        assert_eq!(told, files.map(|(name, row)| (name, format!("{head}{row}"))));
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
