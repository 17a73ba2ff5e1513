//! Checks a scenario against the ranges of the model.

use crate::error::{Error, check_pairs, check_range};
use crate::rounding;
use crate::scenario::{COMPONENTS, Initial, Scenario};

impl Scenario {
    /// Checks that the places are the paper's, j d, which most methods take for granted.
    #[cfg(feature = "methods")]
    pub(crate) fn check_uniform(&self) -> Result<(), Error> {
        let problem = "only the method certified supports places of equilibrium";
        match self.places {
            None => Ok(()),
            Some(_) => Err(Error::input("places", problem, "leave it out, or use that method")),
        }
    }

    /// Checks every field against the model; names the first that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        check_range("spacing", self.spacing, 1e-6, 1e6)?;
        check_range("natural_frequency", self.natural_frequency, 1e-3, 1e3)?;
        check_range("restitution", self.restitution, 0.0, 1.0)?;
        let masses = self.forcing.len();
        for (m, (frequency, pairs)) in self.components().enumerate() {
            let (frequency_field, field) = if self.overtones.is_empty() {
                ("forcing_frequency".to_string(), "forcing".to_string())
            } else {
                (format!("forcing_frequencies[{m}]"), format!("forcing[{m}]"))
            };
            check_range(&frequency_field, frequency, 1e-3, 1e3)?;
            if frequency == self.natural_frequency {
                let problem = format!("{frequency:?} equals the natural frequency (resonance)");
                return Err(Error::input(frequency_field, problem, "choose another"));
            }
            if m >= COMPONENTS {
                let problem = format!("there are more than {COMPONENTS} frequencies");
                return Err(Error::input(frequency_field, problem, "use fewer"));
            }
            check_pairs(&field, pairs, masses)?;
        }
        if let Initial::Free(free) = &self.initial {
            check_pairs("initial.free", free, masses)?;
        }
        if let Some(places) = &self.places {
            if places.len() != masses + 2 {
                let problem = format!("it has {} places for {masses} masses", places.len());
                return Err(Error::input("places", problem, "give one for each mass and wall"));
            }
            for &place in places {
                check_range("places", place, -1e9, 1e9)?;
            }
        }
        let (width, largest) = (rounding::gap_error(self), rounding::LARGEST * self.spacing);
        if width <= largest {
            return Ok(());
        }
        Err(Error::input(
            "forcing",
            format!(
                "the amplitudes of the motion (alpha/(w^2 - W^2) and the free parts) are so large \
                 that rounding may move a gap by {width:.1e}, which is more than {largest:?}"
            ),
            "give frequencies further from the natural one, or smaller amplitudes",
        ))
    }
}
