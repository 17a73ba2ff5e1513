//! Runs one realisation of an ensemble and counts its impacts.

use crate::counts::{Counts, Stopped, Watch};
use crate::ensemble::{Ensemble, Heating};
use crate::{Engine, Error, Scenario};
use impact_numerics::random::NormalPairs;

impl Ensemble {
    /// Runs a realisation at a σ, `index` after the first, and counts its impacts; ends early, with
    /// incomplete counts, when `stopped` returns true. A start that overlaps, and a run that the
    /// engine ended early, are counted as such.
    ///
    /// # Errors
    /// [`Error::Input`] if the chain is not allowed.
    pub fn realisation(
        &self,
        sigma: f64,
        index: u64,
        stopped: impl Fn() -> bool,
    ) -> Result<Counts, Error> {
        self.counted(sigma, self.first + index, &stopped)
    }

    /// Not generic: generic code would be compiled with the caller's crate.
    fn counted(&self, sigma: f64, index: u64, stopped: Stopped) -> Result<Counts, Error> {
        let mut engine = match self.started(sigma, index, stopped) {
            Ok(engine) => engine,
            Err(Error::Overlap { .. }) => return Ok(Counts::rejected(self)),
            Err(Error::Work { .. }) => return Ok(Counts::failed(self)),
            Err(error) => return Err(error),
        };
        let mut watch = Watch::new(self);
        let ended = watch.follow(&mut engine, self.until(sigma), stopped);
        watch.counts(self, index, &engine, ended)
    }

    /// Returns an engine at the time from which transients are measured.
    fn started(&self, sigma: f64, index: u64, stopped: Stopped) -> Result<Engine, Error> {
        let mut normals = NormalPairs::new(&self.stream, self.seed, index);
        let Some(Heating { sigma: hot, time }) = self.heating else {
            return Engine::new(&Scenario::draw(&self.chain, sigma, &mut normals));
        };
        let scenario = Scenario::draw(&self.chain, hot, &mut normals);
        let mut engine = Engine::new(&scenario)?;
        engine.run(time, |_| !stopped())?;
        Engine::new(&scenario.lowered(&engine.free_parts(), time, sigma / hot))
    }
}
