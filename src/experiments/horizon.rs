//! How long a run can be trusted: twins that differ in the last bit of every amplitude.
//!
//! A change of one amplitude alone would be the smaller disturbance: in one run of four it is
//! rounded away. Every operation of a run rounds, in every mass, so the twins differ in all.

use super::ensembles::each;
use super::{Error, Progress};
use crate::params::HorizonParams;
use impact_chain::{Engine, Growth, Impact, Scenario};
use impact_numerics::estimates::average;
use impact_numerics::random::NormalPairs;
use impact_numerics::statistics::Estimate;
use literate::table::Table;
use literate::value::origin;
use serde::{Deserialize, Serialize};

/// The measured horizon. Means over the twins, with standard error and a normal interval.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Horizon {
    /// What was run.
    pub parameters: HorizonParams,
    /// One for each pair of twins.
    pub twins: Vec<Twins>,
    /// Time of the first impact whose gap differs.
    pub order: Option<Estimate>,
    /// Number of impacts before it.
    pub order_impacts: Option<Estimate>,
    /// Growth rate λ of the time differences, e-folds per unit of time.
    pub growth: Option<Estimate>,
    /// Time in which differences grow tenfold, ln 10 / λ.
    pub tenfold: Option<Estimate>,
}

/// One pair of twins.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Twins {
    /// Time of the first impact whose gap differs, if there was one.
    pub order: Option<f64>,
    /// Impacts before it.
    pub order_impacts: Option<u64>,
    /// Growth rate λ of this pair.
    pub growth: Option<f64>,
}

/// Runs the twins.
pub fn run(parameters: &HorizonParams, progress: &Progress) -> Result<Horizon, Error> {
    let stage = progress.stage("horizon", parameters.realisations as u64);
    let indices = 0..parameters.realisations as u64;
    let twins = each(&stage, progress, indices, |index| pair(parameters, index))?;
    let over = |pick: fn(&Twins) -> Option<f64>| {
        average(&twins.iter().filter_map(pick).collect::<Vec<f64>>())
    };
    let growth = over(|twins| twins.growth);
    Ok(Horizon {
        parameters: parameters.clone(),
        order: over(|twins| twins.order),
        order_impacts: over(|twins| Some(twins.order_impacts? as f64)),
        growth,
        tenfold: growth.map(tenfold),
        twins,
    })
}

/// What follows: means over the twins.
pub fn tables(found: &Horizon) -> Vec<Table> {
    let table = Table::of("horizon.twins", &[found], |own| own.twins.len())
        .computed_by(origin(run))
        .count("pairs", "pairs of twins", |own| own.twins.len() as u64)
        .chosen("sigma", "d omega^2", "", |own| Some(own.parameters.sigma))
        .estimate("order", "1/omega", "time of the first impact of another gap", |own| own.order)
        .estimate("impacts", "1", "impacts before it", |own| own.order_impacts)
        .estimate("tenfold", "1/omega", "time in which differences grow tenfold", |own| own.tenfold)
        .real("first_order", "1/omega", 3, "least time of the first impact of another gap", |own| {
            own.twins.iter().filter_map(|pair| pair.order).fold(f64::INFINITY, f64::min)
        })
        .done();
    vec![table]
}

/// ln 10 / λ, with the error carried over to first order.
fn tenfold(growth: Estimate) -> Estimate {
    let of = |rate: f64| std::f64::consts::LN_10 / rate;
    Estimate {
        value: of(growth.value),
        error: of(growth.value) * growth.error / growth.value,
        interval: [of(growth.interval[1]), of(growth.interval[0])],
    }
}

/// Runs a scenario and its twin, whose amplitudes are one bit larger and smaller in turn.
fn pair(parameters: &HorizonParams, index: u64) -> Result<Twins, Error> {
    let mut normals = NormalPairs::new(&parameters.stream, parameters.seed, index);
    let scenario = Scenario::draw(&parameters.chain, parameters.sigma, &mut normals);
    let mut twin = scenario.clone();
    for (j, amplitude) in twin.forcing.iter_mut().flatten().enumerate() {
        *amplitude = if j % 2 == 0 { amplitude.next_up() } else { amplitude.next_down() };
    }
    let failed = |source| Error::failed("horizon", source);
    let mut engine = Engine::new(&scenario).map_err(failed)?;
    let first = engine.impacts(parameters.until).map_err(failed)?;
    let mut compared = Compared::default();
    let mut own = first.iter();
    let mut engine = Engine::new(&twin).map_err(failed)?;
    engine
        .run(parameters.until, |impact| own.next().is_some_and(|own| compared.see(own, &impact)))
        .map_err(failed)?;
    Ok(compared.end())
}

/// The running comparison of twins.
#[derive(Default)]
struct Compared {
    impacts: u64,
    order: Option<f64>,
    growth: Growth,
}

impl Compared {
    /// Compares the next impact of both; false once their order differs.
    fn see(&mut self, own: &Impact, other: &Impact) -> bool {
        if own.gap != other.gap {
            self.order = Some(own.time.min(other.time));
            return false;
        }
        self.impacts += 1;
        let difference = (own.time - other.time).abs();
        self.growth.see(own.time, difference);
        true
    }

    fn end(self) -> Twins {
        Twins {
            order: self.order,
            order_impacts: self.order.map(|_| self.impacts),
            growth: self.growth.rate(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_known_growth_is_measured() {
        // Twins whose differences grow as 1e−14 · e^(t/5), compared at t = 0.5, 1, 1.5, …
        let mut compared = Compared::default();
        let impact = |time: f64, gap| Impact { time, gap, closing_speed: 1.0 };
        let mut time = 0.0;
        loop {
            time += 0.5;
            let difference = 1e-14 * pxfm::f_exp(time / 5.0);
            let gap = usize::from(difference > 1e-3);
            if !compared.see(&impact(time, 0), &impact(time + difference, gap)) {
                break;
            }
        }
        let twins = compared.end();
        assert!((twins.growth.unwrap() - 0.2).abs() < 2e-3, "{twins:?}");
        // 1e−3 is passed at 5 ln 1e11 = 126.64; 253 impacts before.
        assert_eq!((twins.order, twins.order_impacts), (Some(127.0), Some(253)));
    }

    #[test]
    fn twins_part_and_repeat_exactly() {
        let mut parameters = HorizonParams::new(crate::params::Profile::Quick);
        parameters.realisations = 2;
        let horizon = run(&parameters, &Progress::silent()).unwrap();
        assert_eq!(horizon, run(&parameters, &Progress::silent()).unwrap());
        // An independent simulator at quadruple precision: order to t about 175, tenfold in 12 to 15. Two twins know
        // that to some ten per cent.
        let order = horizon.order.unwrap().value;
        assert!((100.0..260.0).contains(&order), "{order}");
    }
}
