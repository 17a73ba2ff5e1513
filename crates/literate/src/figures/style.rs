//! Fixes the style of all figures: sizes, colours, dashes and symbols.
//!
//! Lengths are in grid units: hundredths of a millimetre on the printed column. Whole ones are fine
//! enough for smooth curves. The hues are those of Okabe and Ito (2008), which colour-blind readers
//! distinguish, the orange darker for its contrast with paper. A colour never stands alone: a
//! symbol, a dash or a name says the same.

use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, RGBColor, ShapeStyle, TextStyle};

/// Width of every figure: one column.
pub const WIDTH: u32 = 8400;

/// Size of axis labels, 8 points.
pub const TEXT: i32 = 282;
/// Size of tick labels, 7 points.
pub const SMALL: i32 = 247;

/// Thickness of axes and ticks.
pub const HAIR: u32 = 16;
/// Thickness of thin curves.
pub const THIN: u32 = 22;
/// Thickness of curves.
pub const LINE: u32 = 36;

/// Half the width of symbols that stand close together.
pub const MEDIUM: i32 = 52;
/// Half the width of symbols elsewhere.
pub const LARGE: i32 = 58;

/// Text and axes.
pub const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// Less prominent parts: construction lines, unused edges.
pub const GREY: RGBColor = RGBColor(0x6b, 0x6b, 0x6b);
/// Light fills and guides.
pub const PALE: RGBColor = RGBColor(0xbd, 0xbd, 0xbd);
/// Red, for what matters most.
pub const RED: RGBColor = RGBColor(0xc8, 0x1e, 0x1e);
/// Bluish green.
pub const GREEN: RGBColor = RGBColor(0x00, 0x80, 0x5d);
/// Blue.
pub const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xb2);
/// Dark orange.
pub const ORANGE: RGBColor = RGBColor(0x9a, 0x66, 0x00);
/// Reddish purple.
pub const PURPLE: RGBColor = RGBColor(0xa5, 0x50, 0x8c);
/// Four shades of blue from light to dark, for an ordered parameter; grey keeps their order.
const SHADES: [RGBColor; 4] = [
    RGBColor(0x3b, 0x83, 0xb5),
    RGBColor(0x1f, 0x65, 0x9a),
    RGBColor(0x12, 0x46, 0x70),
    RGBColor(0x0b, 0x25, 0x45),
];
/// The page.
pub(crate) const WHITE: RGBColor = RGBColor(0xff, 0xff, 0xff);

pub(super) const PALETTE: [(&str, RGBColor); 13] = [
    ("ink", INK),
    ("grey", GREY),
    ("pale", PALE),
    ("red", RED),
    ("green", GREEN),
    ("blue", BLUE),
    ("orange", ORANGE),
    ("purple", PURPLE),
    ("shade-1", SHADES[0]),
    ("shade-2", SHADES[1]),
    ("shade-3", SHADES[2]),
    ("shade-4", SHADES[3]),
    ("page", WHITE),
];

/// Returns the colour of one of up to four values of an ordered parameter, counted from zero: the
/// larger the value, the darker. The value that matters most may be [`RED`] instead.
pub fn ordered(place: usize, count: usize) -> RGBColor {
    let last = count.max(2) - 1;
    SHADES[(3 * place.min(last) + last / 2) / last]
}

/// The line for plotters, without its dashes.
impl From<Stroke> for ShapeStyle {
    fn from(stroke: Stroke) -> Self {
        stroke.colour.stroke_width(stroke.width)
    }
}

/// How a line is broken: the lengths of its strokes and of the gaps between them.
pub type Dash = &'static [u32];

/// An unbroken line.
pub const SOLID: Dash = &[];
/// Long strokes.
pub const LONG: Dash = &[150, 75];
/// Short strokes.
pub const SHORT: Dash = &[70, 50];
/// Dots.
pub const DOTTED: Dash = &[24, 54];
/// A stroke and a dot.
pub const ALTERNATE: Dash = &[150, 60, 26, 60];
/// A stroke and two dots.
pub const TWICE: Dash = &[120, 50, 26, 50, 26, 50];

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stroke {
    /// One of the colours here.
    pub colour: RGBColor,
    /// Thickness in grid units.
    pub width: u32,
    /// How it is broken.
    pub dash: Dash,
}

impl Stroke {
    /// Makes an unbroken line.
    pub const fn solid(colour: RGBColor, width: u32) -> Self {
        Stroke { colour, width, dash: SOLID }
    }

    /// Makes a broken line.
    pub const fn dashed(colour: RGBColor, width: u32, dash: Dash) -> Self {
        Stroke { colour, width, dash }
    }
}

/// The mark at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symbol {
    /// The sign ×.
    Cross,
    /// The sign +.
    Plus,
    /// A filled circle.
    Disc,
    /// An open circle.
    Ring,
    /// A filled square.
    Square,
    /// An open square.
    OpenSquare,
    /// An open triangle.
    OpenTriangle,
    /// An open diamond.
    OpenDiamond,
}

/// Makes the style of words of a size in grid units; `h` and `v` say where in them their place is.
pub fn words(size: i32, colour: RGBColor, h: HPos, v: VPos) -> TextStyle<'static> {
    FontDesc::from(("plain", size)).color(&colour).pos(Pos::new(h, v))
}

/// Makes the style of words with a rim of the page's colour, which sets them off. A style of
/// plotters cannot say so; the name of its font does, which chooses no font here.
pub(crate) fn rimmed(size: i32, colour: RGBColor, h: HPos, v: VPos) -> TextStyle<'static> {
    FontDesc::from(("rimmed", size)).color(&colour).pos(Pos::new(h, v))
}
