//! Names the methods of simulation.

use impact_chain::methods::{
    Advancement, Certified, Method, MoreauJean, Penalty, RungeKutta, Sampled, Truth, Verlet,
    VerletAbreast,
};
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
    pub const ALL: [MethodName; 8] = [
        MethodName::Certified,
        MethodName::Sampled,
        MethodName::Advancement,
        MethodName::RungeKutta,
        MethodName::MoreauJean,
        MethodName::Verlet,
        MethodName::Penalty,
        MethodName::VerletAbreast,
    ];

    /// Returns the method with its step or tolerance, and a least rebound speed if it can have one.
    pub fn with_setting(self, value: f64, stop: f64) -> Box<dyn Method> {
        match self {
            MethodName::Certified => Box::new(Certified),
            MethodName::Sampled => Box::new(Sampled { step: value, least_rebound: stop }),
            MethodName::Advancement => {
                Box::new(Advancement { tolerance: value, least_rebound: stop })
            }
            MethodName::RungeKutta => {
                Box::new(RungeKutta { tolerance: value, least_rebound: stop })
            }
            MethodName::MoreauJean => Box::new(MoreauJean { step: value }),
            MethodName::Verlet => Box::new(Verlet { step: value }),
            MethodName::Penalty => Box::new(Penalty { step: value }),
            MethodName::VerletAbreast => Box::new(VerletAbreast { step: value }),
            MethodName::Truth => Box::new(Truth),
        }
    }

    /// Returns its name in results and on the command line.
    pub fn id(self) -> &'static str {
        self.with_setting(0.0, 0.0).name()
    }

    /// Returns its name in tables.
    pub fn title(self) -> &'static str {
        match self {
            MethodName::Certified => "engine",
            MethodName::Sampled => "sampling",
            MethodName::Advancement => "advancement",
            MethodName::RungeKutta => "Runge–Kutta",
            MethodName::MoreauJean => "time stepping",
            MethodName::Verlet => "Verlet",
            MethodName::Penalty => "penalty springs",
            MethodName::VerletAbreast => "float32 Verlet",
            MethodName::Truth => "true motion",
        }
    }

    /// Returns whether it goes from impact to impact: a least rebound speed helps it to a rest.
    pub fn locates_impacts(self) -> bool {
        matches!(self, MethodName::Sampled | MethodName::Advancement | MethodName::RungeKutta)
    }

    pub fn has_tolerance(self) -> bool {
        matches!(self, MethodName::Advancement | MethodName::RungeKutta)
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
            MethodName::Certified => return self.method.title().into(),
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

    /// Returns the method with this setting.
    pub fn method(self) -> Box<dyn Method> {
        self.method.with_setting(self.value, self.stop)
    }
}
