//! The map over transients and windows for other starts and ends.

use super::protocol::{self, Part, ProtocolMap};
use super::{Error, Progress};
use crate::params::{NamedProtocol, ProtocolParams, ProtocolsParams};
use literate::experiments::cutting::{Cutting, Row, Unit};
use literate::experiments::progress::Stage;
use serde::{Deserialize, Serialize};

/// A map for each kind of chain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Protocols {
    /// What was run.
    pub parameters: ProtocolsParams,
    /// In the order of the parameters.
    pub maps: Vec<ProtocolMap>,
}

/// The maps in units of work: realisations of one σ of one map.
pub const CUTTING: Cutting<ProtocolsParams, Part, Protocols> = Cutting { rows, part, fits, join };

impl Protocols {
    /// The names of the maps, and the maps.
    pub fn named(&self) -> impl Iterator<Item = (&str, &ProtocolMap)> {
        self.parameters.maps.iter().map(|own| own.name.as_str()).zip(&self.maps)
    }
}

fn rows(parameters: &ProtocolsParams) -> Vec<Row> {
    let of = |own: &NamedProtocol| {
        let name = own.name.clone();
        let rows = protocol::rows(&own.map).into_iter();
        rows.map(move |row| Row { covers: format!("{name}, {}", row.covers), ..row })
    };
    parameters.maps.iter().flat_map(of).collect()
}

/// The map to which a unit belongs, and its unit there.
fn within<'a>(parameters: &'a ProtocolsParams, unit: &Unit) -> Option<(&'a ProtocolParams, Unit)> {
    let (place, unit) = unit.within(parameters.maps.iter().map(|own| own.map.sigmas.len()))?;
    Some((&parameters.maps[place].map, unit))
}

fn part(
    parameters: &ProtocolsParams,
    unit: &Unit,
    stage: &Stage,
    progress: &Progress,
) -> Result<Part, Error> {
    match within(parameters, unit) {
        Some((map, unit)) => protocol::part(map, &unit, stage, progress),
        None => Ok(Part::new()),
    }
}

fn fits(parameters: &ProtocolsParams, unit: &Unit, runs: &Part) -> bool {
    within(parameters, unit).is_some_and(|(map, unit)| protocol::fits(map, &unit, runs))
}

pub(crate) fn join(
    parameters: &ProtocolsParams,
    parts: Vec<Vec<Part>>,
    progress: &Progress,
) -> Result<Protocols, Error> {
    let mut parts = parts.into_iter();
    let one = |own: &NamedProtocol| {
        let parts = parts.by_ref().take(own.map.sigmas.len()).collect();
        protocol::join(&own.map, parts, progress)
    };
    let maps = parameters.maps.iter().map(one).collect::<Result<_, Error>>()?;
    Ok(Protocols { parameters: parameters.clone(), maps })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::{Profile, Start};

    #[test]
    fn each_map_is_that_of_its_own_parameters() {
        let mut parameters = ProtocolsParams::new(Profile::Quick);
        for own in &mut parameters.maps {
            own.map.chain.masses = 12;
            own.map.transients = vec![20.0, 40.0];
            own.map.windows = vec![20.0];
            own.map.realisations = 4;
        }
        let quiet = Progress::silent();
        let found = CUTTING.run(&parameters, "test", &quiet).unwrap();
        assert_eq!(found.maps.len(), 3);
        for (own, (name, map)) in parameters.maps.iter().zip(found.named()) {
            assert_eq!(own.name, name);
            assert_eq!(*map, protocol::run(&own.map, &quiet).unwrap(), "{name}");
            // Without a free part nothing closes so soon.
            let zero = own.map.chain.start == Start::Zero;
            let hit =
                map.curves.iter().flat_map(|own| &own.means).flatten().any(|mean| *mean > 0.0);
            assert!(hit || zero, "{name}");
            // Of random starts some overlap, and those are counted in no window.
            let random = own.map.chain.start == Start::Random;
            assert!(random || map.failed == 0, "{name}: {}", map.failed);
        }
    }
}
