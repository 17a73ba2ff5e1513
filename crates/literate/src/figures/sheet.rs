//! The sheet that a figure is drawn on: panels, and free drawing for schematics.
//!
//! Whatever draws fails if a label has a character that the shipped fonts lack.

use std::cell::{RefCell, RefMut};
use std::rc::Rc;

use super::axis::Axis;
use super::drawing::{Drawing, Look, Point};
use super::panel::{Frame, Panel};
use super::record::Record;
use super::series::Marker;
use super::style::{INK, Stroke};
use super::{Error, Figure, Seen};
use plotters::style::text_anchor::{HPos, VPos};

/// A figure in the making.
pub struct Sheet {
    drawing: Rc<RefCell<Drawing>>,
    /// What each panel has recorded.
    records: RefCell<Vec<Rc<RefCell<Record>>>>,
}

/// One entry of a legend.
#[derive(Clone, Debug)]
pub struct Entry {
    pub(super) line: Option<Stroke>,
    pub(super) mark: Option<Marker>,
    pub(super) text: String,
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

    /// A legend in columns of so many rows; `at` is the left end of its first sample line, and `apart` how far the next
    /// column is.
    pub fn legend(
        &self,
        at: Point,
        (size, spacing): (i32, i32),
        (rows, apart): (i32, i32),
        entries: &[Entry],
    ) -> Result<(), Error> {
        const SAMPLE: i32 = 560;
        for (i, entry) in (0..).zip(entries) {
            let (x, y) = (at.0 + i / rows * apart, at.1 + i % rows * spacing);
            if let Some(stroke) = entry.line {
                self.free().line(vec![(x, y), (x + SAMPLE, y)], stroke);
            }
            if let Some(marker) = entry.mark {
                self.free().marks([(x + SAMPLE / 2, y)], marker);
            }
            let look = (size, INK, HPos::Left, VPos::Center);
            self.text(&entry.text, (x + SAMPLE + 130, y), look)?;
        }
        Ok(())
    }

    /// Closes a figure; its `id` is the picture's file name without its ending. Its data is what its panels have
    /// recorded, a file for each.
    pub fn finish(self, id: &str, title: &str, description: Seen) -> Figure {
        let drawing = self.drawing.take();
        let records = self.records.take();
        let data = records.iter().filter_map(|record| record.borrow().file(id)).collect();
        let (id, title) = (id.to_string(), title.to_string());
        let (source, experiments) = (String::new(), Vec::new());
        Figure { id, title, description, drawing, data, source, experiments }
    }
}
