//! What all drawings of the page share: the outlines of their glyphs, and rules for the classes of colours.

use crate::figures::{Glyphs, palette, path_data};
use std::fmt::Write as _;

/// The hidden element that holds the outlines.
pub fn shared(glyphs: &Glyphs) -> String {
    let mut out = String::from("<svg class=\"glyphs\" aria-hidden=\"true\"><defs>\n");
    for (id, steps) in glyphs {
        let d = path_data(steps, ' ');
        let _ = writeln!(out, "<path id=\"glyph-{id}\" d=\"{d}\"/>");
    }
    out + "</defs></svg>"
}

/// A rule for each class of a colour.
pub fn rules() -> String {
    let rule = |(name, _): (&str, _)| {
        format!(
            ".fill-{name} {{ fill: var(--{name}) }}\n.stroke-{name} {{ stroke: var(--{name}) }}\n"
        )
    };
    palette().map(rule).collect()
}
