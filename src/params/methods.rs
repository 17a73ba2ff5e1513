//! Names the methods of simulation.

use MethodName::*;
use impact_chain::methods::{self, Method};
use serde::{Deserialize, Serialize};

/// A method of simulation. In results it has the name of [`Method::name`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    Certified,
    Sampled,
    Advancement,
    RungeKutta,
    MoreauJean,
    Verlet,
    Penalty,
    VerletAbreast,
    Truth,
}

impl MethodName {
    pub const ALL: [MethodName; 8] =
        [Certified, Sampled, Advancement, RungeKutta, MoreauJean, Verlet, Penalty, VerletAbreast];

    /// Returns the method with its step or tolerance, and a least rebound speed if it can have one.
    pub fn with_setting(self, value: f64, stop: f64) -> Box<dyn Method> {
        let (step, tolerance, least_rebound) = (value, value, stop);
        match self {
            Certified => Box::new(methods::Certified),
            Sampled => Box::new(methods::Sampled { step, least_rebound }),
            Advancement => Box::new(methods::Advancement { tolerance, least_rebound }),
            RungeKutta => Box::new(methods::RungeKutta { tolerance, least_rebound }),
            MoreauJean => Box::new(methods::MoreauJean { step }),
            Verlet => Box::new(methods::Verlet { step }),
            Penalty => Box::new(methods::Penalty { step }),
            VerletAbreast => Box::new(methods::VerletAbreast { step }),
            Truth => Box::new(methods::Truth),
        }
    }

    /// Returns its name in results and on the command line.
    pub fn id(self) -> &'static str {
        self.with_setting(0.0, 0.0).name()
    }

    /// Returns its name in tables.
    pub fn title(self) -> &'static str {
        match self {
            Certified => "engine",
            Sampled => "sampling",
            Advancement => "advancement",
            RungeKutta => "Runge–Kutta",
            MoreauJean => "time stepping",
            Verlet => "Verlet",
            Penalty => "penalty springs",
            VerletAbreast => "float32 Verlet",
            Truth => "true motion",
        }
    }

    /// Returns whether it goes from impact to impact: a least rebound speed helps it to a rest.
    pub fn locates_impacts(self) -> bool {
        matches!(self, Sampled | Advancement | RungeKutta)
    }

    pub fn has_tolerance(self) -> bool {
        matches!(self, Advancement | RungeKutta)
    }
}

/// A method with its step or tolerance; 0 for the engine, which has none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Setting {
    pub method: MethodName,
    /// Step h in units of 1/ω, or tolerance.
    pub value: f64,
    /// Least rebound speed in units of d ω: no impact leaves a gap opening more slowly.
    pub stop: f64,
}

impl Setting {
    /// Returns its name in tables and data: `Verlet, h = 0.01`, `Runge–Kutta, tol = 1e-6`.
    pub fn name(self) -> String {
        let letter = match self.method {
            Certified => return self.method.title().into(),
            method if method.has_tolerance() => "tol",
            _ => "h",
        };
        let decimal = |value: f64| {
            if value < 0.01 { format!("{value:e}") } else { value.to_string() }
        };
        let stop =
            if self.stop > 0.0 { format!(", stop = {}", decimal(self.stop)) } else { "".into() };
        format!("{}, {letter} = {}{stop}", self.method.title(), decimal(self.value))
    }

    pub fn method(self) -> Box<dyn Method> {
        self.method.with_setting(self.value, self.stop)
    }
}
