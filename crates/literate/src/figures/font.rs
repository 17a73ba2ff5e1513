//! Sets labels in type, as glyph outlines of the two shipped faces: the same on every machine.

use super::error::{Error, Fault};
use super::markup::{self, Face, Level};
use super::path::Step;
use ab_glyph::{Font, FontRef, GlyphId, OutlineCurve, Point};
use std::sync::LazyLock;

/// Units of an em in both faces; the outlines and the layout below are in these units.
pub const EM: i32 = 1000;

/// Height of a capital in units of the em, for vertical centring.
pub const CAP_HEIGHT: i32 = 645;

/// Size of a lowered or raised piece, in thousandths, in words that are large enough for it.
const SCRIPT: i32 = 700;

/// Least size of such a piece, in grid units: nine pixels where a figure is 360 pixels wide.
const LEAST_SCRIPT: i32 = 211;

/// Width of the stroke that makes a rim, half of which is visible.
pub const RIM: u32 = 260;

const SUB_SHIFT: i32 = -200;
const SUP_SHIFT: i32 = 380;
/// How far two stacked scripts are pushed apart.
const STACK_SHIFT: i32 = 45;
/// Space between a script and the text that follows on the base line.
const SCRIPT_SPACE: i32 = 30;
/// Space between a slanted letter and an upright one, in place of an italic correction.
const SLANT_SPACE: i32 = 40;

/// One glyph of a label; its origin is in em units, y upwards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Placed {
    pub face: Face,
    pub glyph: u16,
    pub x: i32,
    pub y: i32,
    /// Size in thousandths; less than a thousand for a lowered or raised piece.
    pub scale: i32,
}

fn font(face: Face) -> Result<&'static FontRef<'static>, Error> {
    static FACES: LazyLock<[Option<FontRef<'_>>; 2]> = LazyLock::new(|| {
        let regular: &[u8] = include_bytes!("../../fonts/LibertinusSerif-Regular.otf");
        let italic: &[u8] = include_bytes!("../../fonts/LibertinusSerif-Italic.otf");
        [regular, italic].map(|file| FontRef::try_from_slice(file).ok())
    });
    let unreadable = || Error(Fault::Drawing("a shipped font file cannot be read".into()));
    FACES[face as usize].as_ref().ok_or_else(unreadable)
}

/// Sets a label in type whose em is `size`: returns its glyphs, in reading order and without
/// blanks, and its width in em units. A character that the face lacks is an error.
pub fn set(label: &str, size: i32) -> Result<(Vec<Placed>, i32), Error> {
    let script = SCRIPT.max(LEAST_SCRIPT * EM / size.max(1) + 1);
    let (mut glyphs, mut width): (Vec<Placed>, i32) = (Vec::new(), 0);
    // `x` is the pen, `start` is where a raised part stands above a lowered one.
    let (mut x, mut start, mut lift) = (0, 0, 0);
    let mut before = (Face::Regular, Level::Base);
    for piece in markup::parse(label) {
        let face = font(piece.face)?;
        match (before.1, piece.level) {
            (Level::Base, _) => start = x,
            (Level::Sub, Level::Sup) => {
                for glyph in glyphs.iter_mut().rev().take_while(|glyph| glyph.y < 0) {
                    glyph.y -= STACK_SHIFT;
                }
                (x, lift) = (start, STACK_SHIFT);
            }
            (_, Level::Base) => (x, lift) = (width + SCRIPT_SPACE, 0),
            _ => {}
        }
        let slanted = before.0 == Face::Italic && piece.face == Face::Regular;
        let raised = piece.level == Level::Sup && before.1 == Level::Base;
        if slanted && (before.1 == piece.level || raised) {
            x += SLANT_SPACE;
        }
        let (scale, y) = match piece.level {
            Level::Base => (EM, 0),
            Level::Sub => (script, SUB_SHIFT),
            Level::Sup => (script, SUP_SHIFT + lift),
        };
        for character in piece.text.chars() {
            let id = face.glyph_id(character);
            if id.0 == 0 {
                return Err(Error(Fault::Glyph { character, label: label.into() }));
            }
            if !character.is_whitespace() {
                let (face, glyph) = (piece.face, id.0);
                glyphs.push(Placed { face, glyph, x, y, scale });
            }
            x += (face.h_advance_unscaled(id) * scale as f32 / EM as f32).round() as i32;
        }
        width = width.max(x);
        before = (piece.face, piece.level);
    }
    Ok((glyphs, width))
}

pub fn width(label: &str, size: i32) -> Result<i32, Error> {
    Ok(set(label, size)?.1 * size / EM)
}

pub fn id(placed: &Placed) -> String {
    let face = if placed.face == Face::Italic { 'i' } else { 'r' };
    format!("{face}{}", placed.glyph)
}

/// Returns the outline of a glyph in em units, y upwards.
pub fn outline(placed: &Placed) -> Result<Vec<Step>, Error> {
    let mut steps = Vec::new();
    let mut at: Option<Point> = None;
    let p = |v: &Point| (v.x.round() as i32, v.y.round() as i32);
    let curves = font(placed.face)?.outline(GlyphId(placed.glyph)).map(|o| o.curves);
    for curve in curves.unwrap_or_default() {
        let (from, to, step) = match &curve {
            OutlineCurve::Line(a, b) => (a, b, Step::Line(p(b))),
            OutlineCurve::Cubic(a, b, c, e) => (a, e, Step::Curve([p(b), p(c), p(e)])),
            OutlineCurve::Quad(..) => {
                return Err(Error(Fault::Drawing("shipped fonts have cubic curves only".into())));
            }
        };
        if at != Some(*from) {
            steps.extend(at.map(|_| Step::Close));
            steps.push(Step::Move(p(from)));
        }
        steps.push(step);
        at = Some(*to);
    }
    steps.push(Step::Close);
    Ok(steps)
}
