//! The sheet that a figure is drawn on: panels, and free drawing for schematics.
//!
//! Whatever draws fails if a label has a character that the shipped fonts lack.

use std::cell::{RefCell, RefMut};
use std::rc::Rc;

use super::axis::Axis;
use super::drawing::{Drawing, Look, Point};
use super::panel::{Frame, Panel};
use super::record::Record;
use super::{Error, Figure, Seen};

/// A figure in the making.
pub struct Sheet {
    drawing: Rc<RefCell<Drawing>>,
    records: RefCell<Vec<Rc<RefCell<Record>>>>,
}

impl Sheet {
    /// An empty sheet of column width, `height` grid units high.
    pub fn new(height: u32) -> Self {
        let drawing = Rc::new(RefCell::new(Drawing::new(height)));
        Sheet { drawing, records: RefCell::default() }
    }

    /// A panel with its axes drawn.
    pub fn panel(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = Panel::new(&self.drawing, frame, x, y);
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

    /// For free drawing.
    pub fn free(&self) -> RefMut<'_, Drawing> {
        self.drawing.borrow_mut()
    }

    /// Words on the sheet.
    pub fn text(&self, text: &str, at: Point, look: Look) -> Result<(), Error> {
        self.free().label(text, at, look, false)
    }

    /// Closes a figure. Its data is what its panels have recorded, a file for each. The paper gives it its name.
    pub fn finish(self, title: &str, description: Seen) -> Figure {
        let drawing = self.drawing.take();
        let records = self.records.take();
        let data = records.iter().filter_map(|record| record.borrow().file()).collect();
        Figure { title: title.into(), description, drawing, data, ..Figure::default() }
    }
}
