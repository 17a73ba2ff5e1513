//! Makes sheets and panels, and draws axes and names; [`super::series`] draws data in a panel.
//!
//! All methods fail if a label has a character that the shipped fonts lack.

use super::axis::{Axis, Tick};
use super::drawing::{Drawing, Frame};
use super::elements::CustomElement;
use super::error::{Drawn, Error, Fault};
use super::figure::{Description, Figure};
use super::font;
use super::markup::spelled;
use super::path::Point;
use super::record::Record;
use super::style::{HAIR, INK, SMALL, Stroke, TEXT, WIDTH, rimmed, words};
use plotters::coord::Shift;
use plotters::coord::cartesian::{Cartesian2d, MeshLine};
use plotters::drawing::DrawingArea;
use plotters::element::{EmptyElement, Text};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{FontTransform, RGBColor, ShapeStyle, TextStyle};
use plotters_backend::DrawingBackend;
use std::cell::RefCell;
use std::rc::Rc;

/// A sheet as a drawing area of plotters, in grid units from its upper left corner.
pub type SheetArea = DrawingArea<Drawing, Shift>;

/// A figure in the making.
pub struct Sheet {
    /// The whole sheet.
    pub area: SheetArea,
    drawing: Rc<RefCell<Drawing>>,
    records: RefCell<Vec<Rc<RefCell<Record>>>>,
}

impl Sheet {
    /// Makes an empty sheet of column width, `height` grid units high.
    pub fn new(height: u32) -> Self {
        let drawing = Rc::new(RefCell::new(Drawing { height, ..Drawing::default() }));
        Sheet { area: DrawingArea::from(&drawing), drawing, records: RefCell::default() }
    }

    /// Adds a panel and draws its axes.
    pub fn panel(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = self.bare_panel(frame, x, y)?;
        panel.draw_axes()?;
        Ok(panel)
    }

    /// Adds a panel without its axes. Its area is the whole sheet, so that plotters moves no point.
    pub fn bare_panel(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        x.check()?;
        y.check()?;
        let place = (frame.left..frame.right, frame.bottom..frame.top);
        let plane = Cartesian2d::new(x.clone(), y.clone(), place);
        let area = DrawingArea::from(&self.drawing).apply_coord_spec(plane);
        let record = Record { x: x.column_name(), y: y.column_name(), ..Record::default() };
        let record = Rc::new(RefCell::new(record));
        self.records.borrow_mut().push(record.clone());
        let (drawing, outside) = (self.drawing.clone(), Outside::Refuse);
        Ok(Panel { area, frame, x, y, drawing, record, recorded: true, outside })
    }

    /// Adds a panel, its axes and its letter.
    pub fn lettered(&self, letter: &str, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = self.panel(frame, x, y)?;
        panel.letter(letter)?;
        Ok(panel)
    }

    /// Closes the figure, with a data file for each panel that has recorded something.
    pub fn finish(self, title: &str, description: Description) -> Figure {
        let drawing = self.drawing.take();
        let records = self.records.take();
        let data = records.iter().filter_map(|record| record.borrow().file()).collect();
        Figure { title: title.into(), description, drawing, data, ..Figure::default() }
    }
}

/// What to do with data outside the frame; what is not positive is outside a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// It is a mistake.
    Refuse,
    /// The panel shows a part of the data on purpose: cut at the frame. What a logarithmic axis has
    /// no place for is left out of the data file too.
    Cut,
    /// It is shown at the edge.
    Edge,
}

/// Axes in a frame; data is in its units, whatever the scales.
#[derive(Clone)]
pub struct Panel {
    /// The panel as a drawing area of plotters, in units of the data.
    pub area: DrawingArea<Drawing, Cartesian2d<Axis, Axis>>,
    /// Where it stands on the sheet.
    pub frame: Frame,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    drawing: Rc<RefCell<Drawing>>,
    pub(super) record: Rc<RefCell<Record>>,
    pub(super) recorded: bool,
    pub(super) outside: Outside,
}

/// The names of the panels of a figure.
pub const LETTERS: [&str; 6] = ["(a)", "(b)", "(c)", "(d)", "(e)", "(f)"];

const TICK: i32 = 85;
const MINOR_TICK: i32 = 50;
const GAP: i32 = 70;

/// From a frame to the base of the label of its upright axis, without the width of the numbers.
pub(super) const LABEL_LEFT: i32 = TICK + 4 * GAP;
/// From a frame to the top of the label below it.
pub(super) const LABEL_BELOW: i32 = TICK + 3 * GAP + SMALL;

/// What stays clear around a name.
const CLEARANCE: i32 = 45;

/// From one line of words to the next.
const LINE_HEIGHT: i32 = 340;

pub(super) fn widest_number(axis: &Axis) -> Result<i32, Error> {
    let wider = |widest: i32, tick: &Tick| Ok(widest.max(font::width(tick.name(), SMALL)?));
    axis.ticks.iter().try_fold(0, wider)
}

/// Moves heights apart by at least so much, within a range, or returns `None` if it is too short.
fn spread(heights: &[i32], least: i32, (top, bottom): (i32, i32)) -> Option<Vec<i32>> {
    let mut order: Vec<usize> = (0..heights.len()).collect();
    order.sort_by_key(|&i| heights[i]);
    let mut places = heights.to_vec();
    for _ in 0..4 * heights.len() {
        for pair in order.windows(2) {
            let missing = (least - (places[pair[1]] - places[pair[0]])).max(0);
            places[pair[0]] -= missing / 2;
            places[pair[1]] += missing - missing / 2;
        }
    }
    let mut lowest = bottom;
    for &i in order.iter().rev() {
        places[i] = places[i].min(lowest);
        lowest = places[i] - least;
    }
    let mut highest = top;
    for &i in &order {
        places[i] = places[i].max(highest);
        highest = places[i] + least;
    }
    places.iter().all(|place| *place <= bottom).then_some(places)
}

impl Panel {
    /// Ends the name of the panel's data file, which begins with the figure's id.
    pub fn set_suffix(&self, suffix: &str) {
        self.record.borrow_mut().suffix = suffix.replace(['(', ')'], "");
    }

    /// Returns the panel without a record, for what is no data: repeated outlines, details.
    pub fn unrecorded(&self) -> Self {
        Panel { recorded: false, ..self.clone() }
    }

    /// Returns the panel with this done to data outside the frame; they are refused otherwise.
    pub fn outside(&self, outside: Outside) -> Self {
        Panel { outside, ..self.clone() }
    }

    fn text(&self, text: &str, at: (f64, f64), moved: Point, style: TextStyle<'static>) -> Drawn {
        Ok(self.area.draw(&(EmptyElement::at(at) + Text::new(text.to_string(), moved, style)))?)
    }

    fn text_on_sheet(&self, text: &str, at: Point, style: TextStyle<'static>) -> Drawn {
        Ok(self.area.use_screen_coord().draw_text(text, &style, at)?)
    }

    /// Draws both axes: spines at the left and below, ticks outwards, numbers, labels.
    fn draw_axes(&self) -> Drawn {
        let Frame { left, top, right, bottom } = self.frame;
        let hair = ShapeStyle::from(Stroke::solid(INK, HAIR));
        let corners = [(self.x.lo, self.y.hi), (self.x.lo, self.y.lo), (self.x.hi, self.y.lo)];
        // As lines, which the ticks continue as one path.
        let spines = CustomElement::new(corners.into(), move |drawing, corners| {
            drawing.draw_line(corners[0], corners[1], &hair)?;
            drawing.draw_line(corners[1], corners[2], &hair)
        });
        self.area.draw(&spines)?;
        let tick = |axis: &Axis, value: f64| {
            let is_major = axis.ticks.iter().any(|tick| tick.at == value && tick.label.is_some());
            if is_major { TICK } else { MINOR_TICK }
        };
        let draw_tick = |drawing: &mut Drawing, line: MeshLine<'_, Axis, Axis>| {
            let (from, to) = match line {
                MeshLine::XMesh((x, y), _, value) => ((x, y), (x, y + tick(&self.x, *value))),
                MeshLine::YMesh((x, y), _, value) => ((x, y), (x - tick(&self.y, *value), y)),
            };
            drawing.draw_line(from, to, &hair)
        };
        self.area.draw_mesh(draw_tick, usize::MAX, usize::MAX)?;

        let below = words(SMALL, INK, HPos::Center, VPos::Top);
        for tick in &self.x.ticks {
            self.text(tick.name(), (tick.at, self.y.lo), (0, TICK + GAP), below.clone())?;
        }
        let numbers = SMALL * font::CAP_HEIGHT / font::EM;
        let at = ((left + right) / 2, bottom + TICK + numbers + 3 * GAP);
        self.text_on_sheet(&self.x.label, at, words(TEXT, INK, HPos::Center, VPos::Top))?;
        let at_left = words(SMALL, INK, HPos::Right, VPos::Center);
        for tick in &self.y.ticks {
            let moved = (-TICK - GAP * 2 / 3, 0);
            self.text(tick.name(), (self.x.lo, tick.at), moved, at_left.clone())?;
        }
        // The numbers' width decides where the label stands. It reads from bottom to top.
        let at = (left - TICK - widest_number(&self.y)? - 4 * GAP, (top + bottom) / 2);
        let style = words(TEXT, INK, HPos::Center, VPos::Bottom);
        self.text_on_sheet(&self.y.label, at, style.transform(FontTransform::Rotate270))
    }

    /// Writes the letter of a panel, "(a)", above it, and ends the name of its data file with it.
    fn letter(&self, text: &str) -> Drawn {
        self.set_suffix(text);
        let at = (self.frame.left + 60, self.frame.top - 80);
        self.text_on_sheet(text, at, words(TEXT, INK, HPos::Left, VPos::Bottom))
    }

    /// Writes the letter of a panel, and the parameter that it is drawn for, above its frame.
    pub fn heading(&self, letter: &str, parameter: &str) -> Drawn {
        self.letter(letter)?;
        let corner = (self.frame.right, self.frame.top - 80);
        self.text_on_sheet(parameter, corner, words(SMALL, INK, HPos::Right, VPos::Bottom))
    }

    pub(super) fn contains(&self, (x, y): (f64, f64)) -> bool {
        self.x.contains(x) && self.y.contains(y)
    }

    /// Names a curve or a symbol in its colour, near a point of the data: `offset` is in
    /// millimetres to the right and down: `(1, 0)` is right of the point, `(0, -1)` above it.
    pub fn label(&self, text: &str, at: (f64, f64), offset: (i32, i32), colour: RGBColor) -> Drawn {
        let (right, down) = offset;
        let place = |offset: i32| (1 + offset.signum()) as usize;
        let h = [HPos::Right, HPos::Center, HPos::Left][place(right)];
        let v = [VPos::Bottom, VPos::Center, VPos::Top][place(down)];
        self.text(text, at, (100 * right, 100 * down), rimmed(SMALL, colour, h, v))
    }

    /// Names something as [`Panel::label`] does, at this offset or at the nearest one where the
    /// name is in the way of no line and no words drawn so far; at this one if there is none.
    pub fn label_nearby(
        &self,
        text: &str,
        at: (f64, f64),
        offset: (i32, i32),
        colour: RGBColor,
    ) -> Drawn {
        const AROUND: [(i32, i32); 8] =
            [(1, 0), (1, -1), (1, 1), (0, -1), (0, 1), (-1, -1), (-1, 1), (-1, 0)];
        let farther = (1..=3).flat_map(|far| AROUND.map(|(x, y)| (far * x, far * y)));
        let point = self.area.map_coordinate(&at);
        let size = (font::width(text, SMALL)?, SMALL * font::CAP_HEIGHT / font::EM);
        let mut offsets = std::iter::once(offset).chain(farther);
        let free = offsets.find(|&offset| self.has_room(point, size, offset));
        self.label(text, at, free.unwrap_or(offset), colour)
    }

    /// Returns whether words of a size have room at an offset from a point of the sheet.
    fn has_room(&self, (x, y): Point, size: (i32, i32), (right, down): (i32, i32)) -> bool {
        // From the point to the near edge of the words, less their size if they end there.
        let start = |place: i32, size: i32, millimetres: i32| {
            place + 100 * millimetres - size * (1 - millimetres.signum()) / 2 - CLEARANCE
        };
        let (left, top) = (start(x, size.0, right), start(y, size.1, down));
        let (width, height) = (size.0 + 2 * CLEARANCE, size.1 + 2 * CLEARANCE);
        let room = Frame::new(left, top, left + width, top + height);
        left >= self.frame.left
            && room.right <= WIDTH as i32
            && top >= 0
            && room.bottom <= self.frame.bottom
            && self.drawing.borrow().is_free(room)
    }

    /// Names curves (name, points, colour) at their right ends; names that would touch move apart.
    pub fn label_ends<P: AsRef<[(f64, f64)]>>(&self, curves: &[(String, P, RGBColor)]) -> Drawn {
        let mut ends = Vec::new();
        for (text, points, colour) in curves {
            let end = points.as_ref().iter().rfind(|point| self.contains(**point));
            let end = end.ok_or_else(|| Error(Fault::Empty(spelled(text))))?;
            ends.push((self.area.map_coordinate(end), text, *colour));
        }
        let heights: Vec<i32> = ends.iter().map(|(at, ..)| at.1).collect();
        let rows = (self.frame.top, self.frame.bottom);
        let places = spread(&heights, LINE_HEIGHT, rows).ok_or(Error(Fault::NoRoom(ends.len())))?;
        for (((x, _), text, colour), y) in ends.into_iter().zip(places) {
            let style = rimmed(SMALL, colour, HPos::Left, VPos::Center);
            self.text_on_sheet(text, (x + 100, y), style)?;
        }
        Ok(())
    }
}
