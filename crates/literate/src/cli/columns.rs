//! Reads the data files of a report, for columns that no prose names.

use crate::table::{DataFile, table_of};

/// The columns of a data file, with all cells as text.
pub(super) struct Columns {
    /// Names, each with its unit: `work (1)`.
    heads: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Columns {
    /// Reads comma-separated values, of which cells in quotation marks may have any sign.
    pub(super) fn read(text: &str) -> Columns {
        let bare = |cell: &str| {
            let inside = cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"'));
            inside.unwrap_or(cell).replace("\"\"", "\"")
        };
        let mut rows =
            unquoted(text.trim_end(), '\n').map(|row| unquoted(row, ',').map(bare).collect());
        Columns { heads: rows.next().unwrap_or_default(), rows: rows.collect() }
    }

    /// Returns a line for each column with cells that differ, and for each that one of both lacks.
    pub(super) fn changes(&self, new: &Columns, path: &str) -> Vec<String> {
        if self.rows.len() != new.rows.len() {
            return vec![format!("  {path}: {} rows -> {} rows", self.rows.len(), new.rows.len())];
        }
        let mut lines = Vec::new();
        for (at, head) in self.heads.iter().enumerate() {
            let Some(other) = new.heads.iter().position(|other| other == head) else {
                lines.push(format!("  {path}: {head}: gone"));
                continue;
            };
            let cells = self.rows.iter().zip(&new.rows);
            let cells = cells.map(|(old, new)| (old.get(at), new.get(other)));
            let changed: Vec<_> = cells.filter(|(old, new)| old != new).collect();
            if let Some((Some(old), Some(new))) = changed.first() {
                let (number, all) = (changed.len(), self.rows.len());
                let first = format!("the first {old} -> {new}");
                lines.push(format!("  {path}: {head}: {number} of {all} cells; {first}"));
            }
        }
        let added = new.heads.iter().filter(|head| !self.heads.contains(head));
        lines.extend(added.map(|head| format!("  {path}: {head}: new")));
        lines
    }

    fn column(&self, name: &str) -> Option<usize> {
        self.heads.iter().position(|head| head.split(" (").next() == Some(name))
    }

    /// Describes a column, `race.finest.work`, or a cell, `race.finest[method=sampled].work`: its
    /// unit, and the cells of the rows that are meant. None if there is no such column.
    fn describe(&self, address: &str, path: &str) -> Option<String> {
        let at = self.column(address.rsplit('.').next()?)?;
        let keys = address.split_once('[').and_then(|(_, rest)| rest.rsplit_once(']'));
        let mut out = format!("{address}: {} of {path}\n", self.heads[at]);
        let is_meant = |row: &&Vec<String>| {
            let mut keys = keys.iter().flat_map(|(keys, _)| keys.split(','));
            keys.all(|key| {
                let (name, wanted) = key.split_once('=').unwrap_or((key, ""));
                self.column(name).is_some_and(|column| row[column] == wanted)
            })
        };
        for row in self.rows.iter().filter(is_meant) {
            let name = self.heads[0].split(" (").next().unwrap_or_default();
            out += &format!("  {name}={}: {}\n", row[0], row[at]);
        }
        Some(out)
    }
}

/// Splits a text at a sign where that does not stand between quotation marks.
fn unquoted(text: &str, sign: char) -> impl Iterator<Item = &str> {
    let mut is_quoted = false;
    text.split(move |c| {
        is_quoted ^= c == '"';
        c == sign && !is_quoted
    })
}

/// Describes a column or a cell of a table of a report, whose files `read` returns; none if there
/// is no such table or column.
pub(super) fn column(asked: &str, read: impl Fn(&str) -> Option<String>) -> Option<String> {
    let address = asked.trim().trim_start_matches("v.").replace(['"', ' '], "");
    let path = format!("data/{}", DataFile::name_of(table_of(&address)?));
    Columns::read(&read(&path)?).describe(&address, &path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_that_no_prose_names_is_described_and_compared() {
        let old = "method (text),\"step, or so (1)\",work (1)\n\"a, \"\"b\"\"\",0.50,1\nc,2,3\n";
        let read = |path: &str| (path == "data/race-all.csv").then(|| old.to_string());
        assert_eq!(
            column("race.all.work", read).unwrap(),
            "race.all.work: work (1) of data/race-all.csv\n  method=a, \"b\": 1\n  method=c: 3\n"
        );
        let cell = column("race.all[method=\"c\"].work", read).unwrap();
        assert!(cell.ends_with("csv\n  method=c: 3\n"), "{cell}");
        assert!(column("race.all.steps", read).is_none() && column("race.no.work", read).is_none());
        let changes = |new: &str| Columns::read(old).changes(&Columns::read(new), "p");
        assert_eq!(changes(old), [""; 0]);
        let new = old.replace(",3\n", ",4\n").replace("work", "cost");
        assert_eq!(changes(&new), ["  p: work (1): gone", "  p: cost (1): new"]);
        assert_eq!(
            changes(&old.replace(",3\n", ",4\n")),
            ["  p: work (1): 1 of 2 cells; the first 3 -> 4"]
        );
    }
}
