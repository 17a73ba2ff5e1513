//! The long end of the protocol map: runs of up to 10⁵ time units.

use super::ensembles::joined_by;
use super::protocol::{self, Part, ProtocolMap};
use super::{Error, Progress};
use crate::params::{LEVEL, ProtocolParams};
use impact_numerics::statistics::{normal_quantile, standard_deviation};
use literate::experiments::cutting::{Cutting, Unit};
use literate::experiments::deep::Distance;
use serde::{Deserialize, Serialize};

/// The map with its ensembles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LongMap {
    /// The map itself.
    pub map: ProtocolMap,
    /// For each σ the standard deviation of all realisations in each cell.
    pub deviations: Vec<Vec<Option<f64>>>,
}

/// The map in units of work: realisations of one σ.
pub const CUTTING: Cutting<ProtocolParams, Part, LongMap> = joined_by(join);

pub(crate) fn join(
    parameters: &ProtocolParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<LongMap, Error> {
    let row = |runs: &Vec<Part>| {
        let runs: Part = runs.concat();
        let counts = |cell: usize| runs.iter().flatten().filter_map(move |counts| counts[cell]);
        let deviation = |cell| standard_deviation(&counts(cell).map(f64::from).collect::<Vec<_>>());
        (0..protocol::cells(parameters)).map(deviation).collect()
    };
    let deviations = parts.iter().map(row).collect();
    Ok(LongMap { map: protocol::join(parameters, parts, progress)?, deviations })
}

/// How far realisations are from the map: the sum of their counts in each cell from what the means
/// of all let expect, in standard deviations of that sum; the largest of all cells.
pub fn distance(long: &LongMap, parts: &[(&Unit, Part)]) -> Distance {
    let cells = long.map.cells.len();
    let largest = (0..cells).map(|cell| of_cell(long, parts, cell)).fold(0.0, f64::max);
    // Bonferroni's correction: one cell of so many may be far by chance.
    let allowed = normal_quantile(1.0 - (1.0 - LEVEL) / cells.max(1) as f64);
    Distance { largest, allowed }
}

fn of_cell(long: &LongMap, parts: &[(&Unit, Part)], cell: usize) -> f64 {
    let (mut excess, mut variance) = (0.0, 0.0);
    for (unit, part) in parts {
        let both = long.map.curves[cell][unit.row].zip(long.deviations[unit.row][cell]);
        let Some((mean, deviation)) = both else { continue };
        for count in part.iter().flatten().filter_map(|counts| counts.get(cell).copied().flatten())
        {
            excess += f64::from(count) - mean;
            variance += deviation * deviation;
        }
    }
    match () {
        () if variance > 0.0 => excess.abs() / variance.sqrt(),
        () if excess == 0.0 => 0.0,
        // No realisation departs from any other: nor may this one.
        () => f64::MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Grid, Profile};

    #[test]
    fn realisations_are_near_their_own_mean_and_full_ones_are_far() {
        let mut parameters = ProtocolParams::long(Profile::Quick);
        parameters.chain.masses = 12;
        parameters.transients = vec![50.0, 100.0];
        parameters.windows = vec![20.0, 50.0];
        parameters.sigmas = Grid::default().and(12, 20, 4, 100).values();
        parameters.realisations = 8;
        let quiet = Progress::silent();
        let units = CUTTING.units(&parameters);
        let stage = quiet.stage("test", 1);
        let part = |unit| (CUTTING.part)(&parameters, unit, &stage, &quiet).unwrap();
        let parts: Vec<(&Unit, Part)> = units.iter().map(|unit| (unit, part(unit))).collect();
        let texts = parts.iter().map(|(_, part)| part.clone()).collect();
        let long = CUTTING.joined(&parameters, texts, &quiet).unwrap();
        assert!(distance(&long, &parts).largest < 1e-6, "all of them have the mean of all");

        // Some of an ensemble are as far as chance allows.
        let some: Vec<(&Unit, Part)> =
            parts.iter().map(|(unit, part)| (*unit, part[..3].to_vec())).collect();
        let Distance { largest, allowed } = distance(&long, &some);
        assert!(largest > 0.0 && largest < allowed, "{largest} {allowed}");

        // Every gap of every realisation: no chance does that.
        let mut full = parts;
        let gaps = parameters.chain.gaps() as u32;
        full.iter_mut()
            .flat_map(|(_, part)| part.iter_mut().flatten())
            .for_each(|counts| counts.fill(Some(gaps)));
        let Distance { largest, allowed } = distance(&long, &full);
        assert!(largest > allowed, "{largest} {allowed}");
    }
}
