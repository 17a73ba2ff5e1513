//! Holds a figure in the making: the sheet that it is drawn on, its panels and what they record.

use super::axis::Axis;
use super::drawing::{Drawing, Frame};
use super::error::Error;
use super::figure::{Description, Figure};
use super::panel::Panel;
use super::record::Record;
use plotters::coord::Shift;
use plotters::drawing::DrawingArea;
use std::cell::RefCell;
use std::rc::Rc;

/// A sheet as a drawing area of plotters, in grid units from its upper left corner.
pub type SheetArea = DrawingArea<Drawing, Shift>;

/// A figure in the making.
pub struct Sheet {
    pub area: SheetArea,
    drawing: Rc<RefCell<Drawing>>,
    records: RefCell<Vec<Rc<RefCell<Record>>>>,
}

impl Sheet {
    /// Makes an empty sheet of column width, `height` grid units high.
    pub fn new(height: u32) -> Self {
        let drawing = Rc::new(RefCell::new(Drawing::new(height)));
        Sheet { area: DrawingArea::from(&drawing), drawing, records: RefCell::default() }
    }

    /// Adds a panel and draws its axes.
    pub fn panel(&self, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        x.check()?;
        y.check()?;
        let panel = Panel::new(&self.drawing, frame, x, y);
        self.records.borrow_mut().push(panel.record.clone());
        panel.draw_axes()?;
        Ok(panel)
    }

    /// Adds a panel, its axes and its letter.
    pub fn lettered(&self, letter: &str, frame: Frame, x: Axis, y: Axis) -> Result<Panel, Error> {
        let panel = self.panel(frame, x, y)?;
        panel.letter(letter)?;
        Ok(panel)
    }

    /// Closes the figure. Its data is what its panels have recorded, a file for each. The paper
    /// gives it its id.
    pub fn finish(self, title: &str, description: Description) -> Figure {
        let drawing = self.drawing.take();
        let records = self.records.take();
        let data = records.iter().filter_map(|record| record.borrow().file()).collect();
        Figure { title: title.into(), description, drawing, data, ..Figure::default() }
    }
}
