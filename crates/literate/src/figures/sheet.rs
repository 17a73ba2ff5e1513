//! The sheet that a figure is drawn on: panels, and free drawing for schematics.
//!
//! Whatever draws fails if a label has a character that the shipped fonts lack.

use std::cell::RefCell;
use std::rc::Rc;

use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use plotters::element::{Circle, Rectangle, Text};
use plotters::style::text_anchor::{HPos, VPos};
use plotters::style::{Color, RGBColor, ShapeStyle};

use super::axis::Axis;
use super::drawing::Drawing;
use super::element::{Drawn, Look};
use super::panel::{Frame, Panel};
use super::record::Record;
use super::series::Marker;
use super::style::{self, Colour, GREY, INK, Stroke, TINY, WIDTH};
use super::{Error, Figure};

/// A figure in the making.
pub struct Sheet {
    drawing: Rc<RefCell<Drawing>>,
    area: DrawingArea<Drawing, Shift>,
    /// What each panel has recorded.
    records: RefCell<Vec<Rc<RefCell<Record>>>>,
}

/// One entry of a legend.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Line, if the series has one.
    pub line: Option<Stroke>,
    /// Marker with half width, if the series has one.
    pub mark: Option<Marker>,
    /// Words, with mark-up.
    pub text: String,
}

impl Entry {
    /// An entry for a curve.
    pub fn line(stroke: Stroke, text: &str) -> Self {
        Entry { line: Some(stroke), mark: None, text: text.into() }
    }

    /// An entry for markers.
    pub fn mark(mark: Marker, text: &str) -> Self {
        Entry { line: None, mark: Some(mark), text: text.into() }
    }

    /// An entry for a curve with markers.
    pub fn both(line: Stroke, mark: Marker, text: &str) -> Self {
        Entry { line: Some(line), mark: Some(mark), text: text.into() }
    }
}

impl Sheet {
    /// An empty sheet of column width.
    pub fn new(height: u32) -> Self {
        Sheet::on(Drawing::new(height))
    }

    fn on(drawing: Drawing) -> Self {
        let drawing = Rc::new(RefCell::new(drawing));
        let area = DrawingArea::from(&drawing);
        Sheet { drawing, area, records: RefCell::default() }
    }

    /// A panel with its axes drawn.
    pub fn panel(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = Panel::new(&self.area, frame, x, y);
        self.records.borrow_mut().push(panel.record.clone());
        panel.axes()?;
        Ok(panel)
    }

    /// A panel with its axes and its letter.
    pub fn lettered(&self, letter: &str, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = self.panel(frame, x, y)?;
        panel.letter(letter)?;
        Ok(panel)
    }

    /// An inset with smaller numbers. It shows data of the panel again, and records nothing; with data of its own
    /// it takes a [`Panel::file`].
    pub fn inset(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = Panel::new(&self.area, frame, x, y);
        self.records.borrow_mut().push(panel.record.clone());
        let panel = Panel { numbers: TINY, recorded: false, ..panel };
        panel.axes()?;
        Ok(panel)
    }

    /// Words on the sheet: size, colour and anchor.
    pub fn text(
        &self,
        text: &str,
        at: (i32, i32),
        (size, colour, h, v): (i32, Colour, HPos, VPos),
    ) -> Result<(), Error> {
        let look = style::text(size, colour, h, v);
        Ok(self.area.draw(&Text::new(text.to_string(), at, look))?)
    }

    /// A line through points of the sheet.
    pub fn line(&self, points: &[(i32, i32)], stroke: Stroke) -> Result<(), Error> {
        Ok(self.area.draw(&Drawn(points.to_vec(), Look::Curve(stroke)))?)
    }

    /// A line that ends in an arrow head.
    pub fn arrow(&self, points: &[(i32, i32)], stroke: Stroke) -> Result<(), Error> {
        Ok(self.area.draw(&Drawn(points.to_vec(), Look::Arrow(stroke)))?)
    }

    /// A filled circle with an edge.
    pub fn disc(
        &self,
        centre: (i32, i32),
        radius: i32,
        fill: Colour,
        edge: Stroke,
    ) -> Result<(), Error> {
        let fill = RGBColor::from(fill).filled();
        self.area.draw(&Circle::new(centre, radius, fill))?;
        let edge = ShapeStyle {
            color: RGBColor::from(edge.colour).to_rgba(),
            filled: false,
            stroke_width: edge.width,
        };
        Ok(self.area.draw(&Circle::new(centre, radius, edge))?)
    }

    /// A filled rectangle.
    pub fn rectangle(&self, frame: Frame, fill: Colour) -> Result<(), Error> {
        let corners = [(frame.left, frame.top), (frame.right, frame.bottom)];
        Ok(self.area.draw(&Rectangle::new(corners, RGBColor::from(fill).filled()))?)
    }

    /// A legend; `at` is the left end of its first sample line.
    pub fn legend(
        &self,
        at: (i32, i32),
        (size, spacing): (i32, i32),
        entries: &[Entry],
    ) -> Result<(), Error> {
        const SAMPLE: i32 = 560;
        for (i, entry) in entries.iter().enumerate() {
            let (x, y) = (at.0, at.1 + i as i32 * spacing);
            if let Some(stroke) = entry.line {
                self.line(&[(x, y), (x + SAMPLE, y)], stroke)?;
            }
            if let Some((mark, half, stroke)) = entry.mark {
                let look = Look::Marks(mark, half, stroke);
                self.area.draw(&Drawn(vec![(x + SAMPLE / 2, y)], look))?;
            }
            let look = (size, INK, HPos::Left, VPos::Center);
            self.text(&entry.text, (x + SAMPLE + 130, y), look)?;
        }
        Ok(())
    }

    /// A legend in columns of so many rows; `at` is where the first begins, and `apart` how far the next.
    pub fn legend_in_columns(
        &self,
        at: (i32, i32),
        look: (i32, i32),
        (rows, apart): (usize, i32),
        entries: &[Entry],
    ) -> Result<(), Error> {
        let mut columns = entries.chunks(rows.max(1)).zip(0..);
        columns.try_for_each(|(own, i)| self.legend((at.0 + apart * i, at.1), look, own))
    }

    /// Closes a figure; its `id` is the picture's file name without its ending. Its data is what its panels have
    /// recorded, a file for each.
    pub fn finish(self, id: &str, title: &str, description: String) -> Figure {
        let drawing = self.drawing.take();
        let svg = drawing.svg(id, title, &description);
        let records = self.records.take();
        let data = records.iter().filter_map(|record| record.borrow().file(id)).collect();
        let (id, title) = (id.to_string(), title.to_string());
        Figure {
            id,
            title,
            description,
            svg,
            drawing,
            data,
            source: String::new(),
            experiments: Vec::new(),
        }
    }
}

impl Figure {
    /// With a line at its foot about where it comes from.
    pub fn with_foot(self, words: &str) -> Result<Figure, Error> {
        let Figure { id, title, description, mut drawing, .. } = self;
        drawing.height += FOOT;
        let at = (WIDTH as i32 - 120, drawing.height as i32 - 110);
        let sheet = Sheet::on(drawing);
        sheet.text(words, at, (TINY, GREY, HPos::Right, VPos::Bottom))?;
        let Figure { svg, drawing, .. } = sheet.finish(&id, &title, description.clone());
        Ok(Figure { id, title, description, drawing, svg, ..self })
    }
}

/// Height of the line at the foot.
const FOOT: u32 = 330;
