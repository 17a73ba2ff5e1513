//! Two files of data as one picture.

use super::table::{Table, TableChange, number};
use crate::figures::{self, Overlay, OverlayPane};

/// At most so many columns are drawn, those first that differ.
const PANES: usize = 6;

/// At most so many points of a column; more would not be seen.
const POINTS: usize = 1500;

/// Draws each column of numbers that differs over the first column of numbers that changes from row
/// to row. None if there is nothing to draw.
///
/// # Errors
/// What cannot be drawn.
pub fn overlay(
    change: &TableChange,
    before: &Table,
    after: &Table,
) -> Result<Option<String>, figures::Error> {
    let x = abscissa(after).or_else(|| abscissa(before));
    let is_y = |name: &&String| {
        let numbers = |table: &Table| column(table, name).is_some_and(|c| has_numbers(table, c));
        Some(*name) != x.as_ref() && numbers(before) | numbers(after)
    };
    let all: Vec<&String> = after.header.iter().filter(is_y).collect();
    let mut drawn = all.clone();
    drawn.retain(|name| change.columns_changed.contains(name));
    if drawn.is_empty() {
        drawn = all;
    }
    let left_out = drawn.len().saturating_sub(PANES);
    drawn.truncate(PANES);
    let pane = |name: &&String| {
        let own = |largest: &Option<super::Largest>| {
            largest.as_ref().filter(|l| l.column == **name).map(|l| l.row)
        };
        OverlayPane {
            label: (*name).clone(),
            before: curves(before, x.as_ref(), name),
            after: curves(after, x.as_ref(), name),
            note: match (own(&change.absolute), own(&change.relative)) {
                (Some(row), _) => format!("largest difference at row {row}"),
                (None, Some(row)) => format!("largest relative difference at row {row}"),
                (None, None) => String::new(),
            },
        }
    };
    let panes: Vec<OverlayPane> = drawn.iter().map(pane).collect();
    if panes.iter().all(|pane| pane.before.is_empty() && pane.after.is_empty()) {
        return Ok(None);
    }
    let more = (left_out > 0).then(|| format!("{left_out} columns more differ"));
    let x = x.unwrap_or_else(|| "row".into());
    figures::overlay(&Overlay { title: change.path.clone(), x, panes, more }).map(Some)
}

fn column(table: &Table, name: &str) -> Option<usize> {
    table.header.iter().position(|own| own == name)
}

fn has_numbers(table: &Table, column: usize) -> bool {
    table.rows.iter().any(|row| number(&row[column]).is_some())
}

/// The first column of numbers that differs between the first two rows: one that stays names a
/// curve and no point of it.
fn abscissa(table: &Table) -> Option<String> {
    let [first, second, ..] = table.rows.as_slice() else { return None };
    let changes = |i: &usize| {
        number(&first[*i]).zip(number(&second[*i])).is_some_and(|(first, second)| first != second)
    };
    (0..table.header.len()).find(changes).map(|i| table.header[i].clone())
}

/// A column over another; a curve ends where it would go backwards. Thinned evenly where there are
/// too many points.
fn curves(table: &Table, x: Option<&String>, y: &str) -> Vec<Vec<(f64, f64)>> {
    let Some(y) = column(table, y) else { return Vec::new() };
    let x = x.and_then(|x| column(table, x));
    let point = |(i, row): (usize, &Vec<String>)| {
        let x = x.map_or(Some((i + 1) as f64), |x| number(&row[x]))?;
        Some((x, number(&row[y])?))
    };
    let points: Vec<(f64, f64)> = table.rows.iter().enumerate().filter_map(point).collect();
    let every = points.len().div_ceil(POINTS).max(1);
    let mut curves: Vec<Vec<(f64, f64)>> = Vec::new();
    for (i, &point) in points.iter().enumerate() {
        let goes_on = i > 0 && points[i - 1].0 <= point.0;
        match curves.last_mut() {
            Some(curve) if goes_on && i % every != 0 => _ = curve,
            Some(curve) if goes_on => curve.push(point),
            _ => curves.push(vec![point]),
        }
    }
    curves
}
