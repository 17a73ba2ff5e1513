//! Makes the styles of words.
//!
//! A style of plotters cannot say that words have a rim of the page's colour. The name of the font
//! says it, since all words are set in the shipped fonts: [`rimmed`] writes it, [`is_rimmed`] reads
//! it.

use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontDesc, RGBColor, TextStyle};
use plotters_backend::BackendTextStyle;

const RIMMED: &str = "rimmed";

/// Makes the style of words of a size in grid units; `h` and `v` say where in them their place is.
pub fn words(size: i32, colour: RGBColor, h: HPos, v: VPos) -> TextStyle<'static> {
    FontDesc::from(("plain", size)).color(&colour).pos(Pos::new(h, v))
}

/// Makes the style of words that may stand on something: a rim of the page's colour sets them off.
pub fn rimmed(size: i32, colour: RGBColor, h: HPos, v: VPos) -> TextStyle<'static> {
    FontDesc::from((RIMMED, size)).color(&colour).pos(Pos::new(h, v))
}

/// Tells whether a style is one of [`rimmed`].
pub(super) fn is_rimmed(style: &impl BackendTextStyle) -> bool {
    style.family().as_str() == RIMMED
}
