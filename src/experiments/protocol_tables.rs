//! Tables of the map over transients and windows, and of its long end.

use super::protocol::{ProtocolCell, ProtocolMap, join};
use impact_numerics::statistics::Estimate;
use literate::table::Table;
use literate::value::origin;

/// Of the map of the paper's chain.
pub fn of_map(map: &ProtocolMap) -> Vec<Table> {
    let halves = || map.cells.iter().filter_map(|own| Some((own.half_height?, own)));
    let least = halves().min_by(|a, b| a.0.value.total_cmp(&b.0.value)).map(|(_, own)| own);
    let most = halves().max_by(|a, b| a.0.value.total_cmp(&b.0.value)).map(|(_, own)| own);
    let half = |own: Option<&ProtocolCell>| own.and_then(|own| own.half_height);
    let same = |own: Option<&ProtocolCell>| own.map(|own| address("protocol", own, "half_height"));
    let all = Table::of("protocol.all", &[map], |own| own.parameters.realisations)
        .count("realisations", "chains at each σ", |own| own.parameters.realisations as u64)
        .count("sigmas", "values of σ", |own| own.parameters.sigmas.len() as u64)
        .count("combinations", "transients times windows", |own| own.cells.len() as u64)
        .count("as_printed", "of these, half heights that round to the printed one", |_| {
            map.cells.iter().filter(|own| own.prints_as_published).count() as u64
        })
        .estimate("largest", "d omega^2", "largest half height", |_| half(most))
        .same("largest", |_| same(most))
        .estimate("least", "d omega^2", "least half height", |_| half(least))
        .same("least", |_| same(least))
        .estimate("range_all", "d omega^2", "range of the half heights of the mean of all", |own| {
            range(own.cells.iter().map(|cell| cell.half_height_all))
        })
        .done();
    vec![cells("protocol.cells", map), all]
}

/// From the least of some places to the largest.
pub fn range(places: impl Iterator<Item = Option<Estimate>>) -> Option<Estimate> {
    let places: Vec<Estimate> = places.flatten().collect();
    let least = places.iter().min_by(|a, b| a.value.total_cmp(&b.value))?;
    let most = places.iter().max_by(|a, b| a.value.total_cmp(&b.value))?;
    let error = (least.error * least.error + most.error * most.error).sqrt();
    let (value, room) = (most.value - least.value, 1.96 * error);
    Some(Estimate { value, error, interval: [value - room, value + room] })
}

/// Of its long end.
pub fn of_long(long: &ProtocolMap) -> Vec<Table> {
    let all = Table::of("long_protocol.all", &[&long.parameters], |own| own.realisations)
        .count("realisations", "chains at each σ", |own| own.realisations as u64)
        .count("sigmas", "values of σ", |own| own.sigmas.len() as u64)
        .done();
    vec![cells("long_protocol.cells", long), all]
}

/// The address of a number of a cell.
pub fn address(experiment: &str, own: &ProtocolCell, column: &str) -> String {
    let ProtocolCell { transient, window, .. } = own;
    format!("{experiment}.cells[transient={transient},window={window}].{column}")
}

/// A column: its name, what it is, and the place of a cell.
type Place = (&'static str, &'static str, fn(&ProtocolCell) -> Option<Estimate>);

const PLACES: [Place; 4] = [
    ("half_height", "σ where the mean of the kept passes half of all gaps", |own| own.half_height),
    ("half_height_all", "σ where the mean of all passes half of all gaps", |own| {
        own.half_height_all
    }),
    ("onset", "σ where the mean of all passes a twentieth of all gaps", |own| own.onset),
    ("kept_half", "σ at which half of the chains have an impact in the window", |own| {
        own.kept_half
    }),
];

fn cells(name: &'static str, map: &ProtocolMap) -> Table {
    let table = Table::of(name, &map.cells, |_| map.parameters.realisations)
        .key("transient", "1/omega", |own| own.transient)
        .key("window", "1/omega", |own| own.window)
        .computed_by(origin(join));
    PLACES
        .into_iter()
        .fold(table, |table, (name, meaning, place)| {
            table.estimate(name, "d omega^2", meaning, place)
        })
        .done()
}
