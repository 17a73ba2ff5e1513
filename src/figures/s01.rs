//! Fig. S1: half height and onset against the transient.

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::panel::{Frame, Panel};
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Colour, Dash, GREEN, INK, Mark, PURPLE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::Results;
use crate::experiments::long::LongMap;
use crate::experiments::protocol::{ProtocolCell, ProtocolMap};
use crate::experiments::protocols::Protocols;
use crate::numerics::statistics::Estimate;

/// The half size of marks.
const SIZE: i32 = 52;

/// Windows of (a) and (c), and their looks.
const WINDOWS: [(f64, Mark, Colour); 3] =
    [(20.0, Mark::Disc, RED), (200.0, Mark::Square, BLUE), (2000.0, Mark::Diamond, GREEN)];

/// The window of (b) and (d).
const WINDOW: f64 = 200.0;

/// Names of chains, what they are, and their looks.
const STARTS: [(&str, &str, Mark, Colour); 4] = [
    ("rest", "rest", Mark::Disc, BLUE),
    ("ring", "rest, on a ring", Mark::Ring, INK),
    ("random", "random free parts", Mark::Square, RED),
    ("zero", "on the forced motion", Mark::Diamond, PURPLE),
];

/// A place on the rise.
type Place = fn(&ProtocolCell) -> Option<Estimate>;

const HALF: Place = |cell| cell.half_height_all;
const ONSET: Place = |cell| cell.onset;
const HALF_OF_KEPT: Place = |cell| cell.half_height;

/// The rows: a place, and its axis.
const ROWS: [(Place, &str); 2] = [(HALF, "*σ*_{1/2}"), (ONSET, "*σ*_{0}")];

/// The numbers that it shows.
const TABLES: [&str; 5] = [
    "protocol.cells",
    "long_protocol.cells",
    "protocols.zero",
    "protocols.random",
    "protocols.ring",
];

/// What is drawn.
#[derive(Clone, Copy)]
struct Maps<'a> {
    /// The map of the paper's chain.
    map: &'a ProtocolMap,
    /// Its long end.
    long: &'a LongMap,
    /// The maps of other chains.
    others: &'a Protocols,
    /// The σ at which a half, and a twentieth, of the chains from rest have a gap that closes by itself.
    seeds: [f64; 2],
}

impl<'a> Maps<'a> {
    /// The cells of a chain by rising T: those of the long end follow those of the map.
    fn cells(self, name: &str) -> Vec<&'a ProtocolCell> {
        if name != "rest" {
            let other = self.others.named().find(|(own, _)| *own == name);
            return other.iter().flat_map(|(_, map)| &map.cells).collect();
        }
        self.map.cells.iter().chain(self.long.beyond(self.map)).collect()
    }

    /// (T, place) of a chain at a window.
    fn line(self, name: &str, window: f64, place: Place) -> Vec<(f64, Estimate)> {
        let cells = self.cells(name).into_iter().filter(|cell| cell.window == window);
        cells.filter_map(|cell| Some((cell.transient, place(cell)?))).collect()
    }
}

/// The tops of the rows.
const TOPS: [i32; 2] = [430, 4680];

/// The top of the legends.
const LEGEND: i32 = 9000;

/// Draws the figure.
pub fn draw(results: &Results, note: Option<&str>) -> Result<Figure, Error> {
    let found = &results.identities;
    let maps = Maps {
        map: results.protocol()?,
        long: results.long_protocol()?,
        others: results.protocols()?,
        seeds: [found.sigma_kept_half, found.sigma_kept_onset],
    };
    let sheet = Sheet::new(10_650, note)?;
    let (left, right) = ((1000, 4150), (4900, 8050));
    // Half of N takes half of the chains, and a twentieth of N a twentieth of them.
    for (row, ((place, label), seeds)) in ROWS.into_iter().zip(maps.seeds).enumerate() {
        let top = TOPS[row];
        let panel = |column: usize, (from, to), label: &str| {
            let y = Axis::linear(0.07, 0.21, 0.02, 2, label);
            panel(&sheet, 2 * row + column, Frame::new(from, top, to, top + 3200), y)
        };
        let own = panel(0, left, label)?;
        bounded(&own, seeds)?;
        if row == 0 {
            kept_curves(&own, maps)?;
        }
        windows(&own, maps, place)?;
        starts(&panel(1, right, "")?, maps, place)?;
    }
    let mut entries: Vec<_> = WINDOWS
        .iter()
        .map(|(w, mark, colour)| entry(format!("*W* = {w}"), *mark, *colour))
        .collect();
    entries.push(Entry::line(kept(INK), "mean of the kept"));
    entries.push(Entry::line(bound(), "bound for the mean of all"));
    sheet.legend((1000, LEGEND), (SMALL, 340), &entries)?;
    let entries: Vec<_> = STARTS
        .iter()
        .map(|(_, what, mark, colour)| entry((*what).into(), *mark, *colour))
        .collect();
    sheet.legend((4900, LEGEND), (SMALL, 340), &entries)?;
    let title = "Half height and onset against the transient";
    let data = TABLES.map(|name| results.table(name).map(DataFile::of));
    let data = data.into_iter().collect::<Result<_, _>>()?;
    Ok(sheet.finish("s01", title, description(maps), data))
}

fn panel(sheet: &Sheet, place: usize, frame: Frame, y: Axis) -> Result<Panel, Error> {
    let panel = sheet.panel(frame, Axis::decades(1, 5, 1, "transient *T* (1/*ω*)"), y)?;
    panel.letter(LETTERS[place])?;
    Ok(panel)
}

fn entry(text: String, mark: Mark, colour: Colour) -> Entry {
    let stroke = Stroke::solid(colour, THIN);
    Entry { line: Some(stroke), mark: Some((mark, SIZE, stroke)), text }
}

/// The line of the mean of the kept.
fn kept(colour: Colour) -> Stroke {
    Stroke::dashed(colour, THIN, Dash::Long)
}

/// The line of the bound that no mean over all chains passes.
fn bound() -> Stroke {
    Stroke::dashed(INK, THIN, Dash::Dotted)
}

/// The values of estimates against log T.
fn values(all: &[(f64, Estimate)]) -> Vec<(f64, f64)> {
    all.iter().map(|(time, own)| (log(*time), own.value)).collect()
}

fn estimates(
    panel: &Panel,
    name: &str,
    all: &[(f64, Estimate)],
    look: (Mark, Colour),
) -> Result<(), Error> {
    let stroke = Stroke::solid(look.1, THIN);
    // Two points do not make a curve.
    if all.len() > 2 {
        panel.curve(name, &values(all), stroke, Outside::Cut)?;
    }
    let all: Vec<_> = all.iter().map(|(time, own)| (log(*time), *own)).collect();
    panel.estimates(name, &all, (look.0, SIZE, stroke), |y| y)
}

fn windows(panel: &Panel, maps: Maps<'_>, place: Place) -> Result<(), Error> {
    for (window, mark, colour) in WINDOWS {
        let line = maps.line("rest", window, place);
        estimates(panel, &format!("*W* = {window}"), &line, (mark, colour))?;
    }
    Ok(())
}

fn bounded(panel: &Panel, level: f64) -> Result<(), Error> {
    let level = [(panel.x.lo, level), (panel.x.hi, level)];
    panel.curve("bound by seeds", &level, bound(), Outside::Cut)
}

fn kept_curves(panel: &Panel, maps: Maps<'_>) -> Result<(), Error> {
    for (window, _, colour) in WINDOWS {
        let line = values(&maps.line("rest", window, HALF_OF_KEPT));
        panel.curve(&format!("kept, *W* = {window}"), &line, kept(colour), Outside::Cut)?;
    }
    Ok(())
}

fn starts(panel: &Panel, maps: Maps<'_>, place: Place) -> Result<(), Error> {
    for (name, what, mark, colour) in STARTS {
        estimates(panel, what, &maps.line(name, WINDOW, place), (mark, colour))?;
    }
    Ok(())
}

fn description(maps: Maps<'_>) -> String {
    let ends = |name: &str, place: Place| -> String {
        let line = maps.line(name, WINDOW, place);
        let ends = line.first().zip(line.last().filter(|_| line.len() > 1));
        ends.map_or("none".into(), |(first, last)| {
            format!("from {} to {}", short(first.1.value, 4), short(last.1.value, 4))
        })
    };
    let [half, onset] = maps.seeds.map(|seeds| short(seeds, 3));
    format!(
        "Against T: (a) half height of the mean of all, falling with T and with the window towards the \
         level {half}, {} at W = {WINDOW}; dashed, of the kept, below it. (b) Other chains: a ring as the row, random starts later. (c) Onset, \
         {}, above {onset}. (d) Onsets of other chains.",
        ends("rest", HALF),
        ends("rest", ONSET),
    )
}
