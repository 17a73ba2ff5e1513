//! Writes a drawing as a one-page PDF, for LaTeX: the same bytes everywhere.

use super::drawing::{Drawing, Element, Fill, Label};
use super::font;
use super::path::{Point, Step, polygon};
use super::style::{Stroke, WHITE, WIDTH};
use super::svg::PIXELS_PER_HUNDRED;
use pdf_writer::types::LineJoinStyle;
use pdf_writer::{Content, Finish, Name, Pdf, Rect, Ref, TextStr};
use plotters::style::RGBColor;
use std::collections::BTreeMap;

impl Drawing {
    pub(crate) fn pdf(&self, title: &str) -> Vec<u8> {
        // A pixel is 3/4 of a point.
        let width = 0.75 * (WIDTH * PIXELS_PER_HUNDRED / 100) as f32;
        let scale = width / WIDTH as f32;
        let height = scale * self.height as f32;
        let mut writer = Writer { drawing: self, content: Content::new(), states: [].into() };
        writer.content.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
        let (right, bottom) = (WIDTH as i32, self.height as i32);
        let page = polygon([(0, 0), (right, 0), (right, bottom), (0, bottom)]);
        writer.shape(&page, Some((WHITE, 100)), None);
        for element in &self.elements {
            match element {
                Element::Open(..) | Element::Close => (),
                Element::Shape(path, fill, stroke) => writer.shape(path, *fill, *stroke),
                Element::Label(label) => writer.label(label),
            }
        }
        let [catalog, tree, leaf, content, info] = [1, 2, 3, 4, 5].map(Ref::new);
        let mut pdf = Pdf::new();
        pdf.set_version(1, 5);
        pdf.catalog(catalog).pages(tree);
        pdf.pages(tree).kids([leaf]).count(1);
        let mut page = pdf.page(leaf);
        page.parent(tree).media_box(Rect::new(0.0, 0.0, width, height)).contents(content);
        let mut resources = page.resources();
        let mut states = resources.ext_g_states();
        for (name, hundredths) in &writer.states {
            let mut state = states.insert(Name(name.as_bytes())).dict();
            state.pair(Name(b"ca"), f32::from(*hundredths) / 100.0);
        }
        states.finish();
        resources.finish();
        page.finish();
        pdf.stream(content, &writer.content.finish());
        pdf.document_info(info).title(TextStr(title));
        pdf.finish()
    }
}

fn shares(RGBColor(r, g, b): RGBColor) -> [f32; 3] {
    [r, g, b].map(|part| f32::from(part) / 255.0)
}

struct Writer<'a> {
    drawing: &'a Drawing,
    content: Content,
    /// Graphics states in use, by their names: opacities in hundredths.
    states: BTreeMap<String, u8>,
}

impl Writer<'_> {
    fn shape(&mut self, path: &[Step], fill: Fill, stroke: Option<Stroke>) {
        let content = &mut self.content;
        content.save_state();
        if let Some((colour, opacity)) = fill {
            if opacity < 100 {
                let name = format!("o{opacity}");
                content.set_parameters(Name(name.as_bytes()));
                self.states.insert(name, opacity);
            }
            let [r, g, b] = shares(colour);
            content.set_fill_rgb(r, g, b);
        } else {
            content.set_line_join(LineJoinStyle::RoundJoin);
        }
        if let Some(stroke) = stroke {
            let [r, g, b] = shares(stroke.colour);
            content.set_stroke_rgb(r, g, b).set_line_width(stroke.width as f32);
            let dashes = stroke.dash.iter().map(|length| *length as f32);
            content.set_dash_pattern(dashes, 0.0);
        }
        let at = |(x, y): Point| (x as f32, y as f32);
        for step in path {
            match *step {
                Step::Move(to) => content.move_to(at(to).0, at(to).1),
                Step::Line(to) => content.line_to(at(to).0, at(to).1),
                Step::Curve(points) => {
                    let [a, b, c] = points.map(at);
                    content.cubic_to(a.0, a.1, b.0, b.1, c.0, c.1)
                }
                Step::Close => content.close_path(),
            };
        }
        match (path.is_empty(), fill, stroke) {
            (true, ..) | (_, None, None) => content.end_path(),
            (_, Some(_), None) => content.fill_nonzero(),
            (_, None, Some(_)) => content.stroke(),
            (_, Some(_), Some(_)) => content.fill_nonzero_and_stroke(),
        };
        content.restore_state();
    }

    fn label(&mut self, label: &Label) {
        let scale = label.size as f32 / font::EM as f32;
        let (x, y) = (label.at.0 as f32, label.at.1 as f32);
        let turned = if label.upwards {
            [0.0, -scale, -scale, 0.0, x, y]
        } else {
            [scale, 0.0, 0.0, -scale, x, y]
        };
        self.content.save_state().transform(turned);
        let rim = label.rim.then_some((WHITE, Some(Stroke::solid(WHITE, font::RIM))));
        for (colour, edge) in rim.into_iter().chain([(label.colour, None)]) {
            for placed in &label.glyphs {
                let size = placed.scale as f32 / font::EM as f32;
                let place = [size, 0.0, 0.0, size, placed.x as f32, placed.y as f32];
                self.content.save_state().transform(place);
                let drawing = self.drawing;
                if let Some(steps) = drawing.glyphs.get(&font::id(placed)) {
                    self.shape(steps, Some((colour, 100)), edge);
                }
                self.content.restore_state();
            }
        }
        self.content.restore_state();
    }
}
