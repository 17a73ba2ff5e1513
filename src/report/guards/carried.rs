//! Results that are carried over.

use super::{Guard, Look, unless};
use crate::experiments;
use crate::params::Profile;
use literate::experiments::deep::{Audit, Carriage, Distance};

pub const GUARDS: &[Guard] =
    &[Guard { name: "carried_results_audited", ids: &["carried.*"], find: audited }];

/// A committed result that this program does not give is stale. The verdict follows from what was
/// counted, and the number of units from how the experiment is cut.
fn audited(look: Look<'_>) -> Option<String> {
    look.results.audits.iter().find_map(|(name, audit)| {
        let Audit { verdict, units, again, identical, distance } = audit;
        let cut = experiments::of(Profile::Deep)
            .iter()
            .find(|experiment| experiment.name() == name.as_str())?
            .at(Profile::Deep)
            .units()
            .len();
        let near = distance.is_some_and(|Distance { largest, allowed }| largest <= allowed);
        let expected = match () {
            () if identical == again => Carriage::Identical,
            () if near && identical < again => Carriage::WithinError,
            () => Carriage::Failed,
        };
        let id = |what: &str| format!("carried.{what}_{name}");
        unless(*verdict != Carriage::Failed, || {
            format!("the committed result {name} is stale: run `make deep`")
        })
        .or_else(|| {
            unless(*verdict == expected && *again > 0 && again <= units && *units == cut, || {
                format!("{name}: {identical} of {again} identical, of {units} units of {cut}")
            })
        })
        .or_else(|| look.is(&id("units"), cut as f64))
        .or_else(|| look.is(&id("again"), *again as f64))
        .or_else(|| look.is(&id("identical"), *identical as f64))
    })
}
