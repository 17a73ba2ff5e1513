//! The methods of simulation by name.

use super::Failure;
use impact_chain::methods::{
    Certified, Method, MoreauJean, Penalty, RungeKutta, Sampled, Truth, Verlet,
};

/// A method by its name. The texts are the lines of `--help`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Name {
    /// Flight in closed form, the first root of each gap certified: nothing is missed.
    Certified,
    /// Flight in closed form, gaps sampled every --step [0.01], sign changes bisected: misses grazes.
    Sampled,
    /// Dormand–Prince 5(4) with events, --tolerance [1e-9]: misses pairs of roots within a step.
    RungeKutta,
    /// Time stepping on velocities, --step [0.001]: first order, hits near misses, but can rest.
    MoreauJean,
    /// Velocity Verlet with flips at the ends of steps, --step [0.001]: first order, impacts late.
    Verlet,
    /// A stiff damped spring for each contact, --step [0.0001]: order 1/2, restitution off in clusters.
    Penalty,
    /// Every time to 106 bits, slowly: walls, one frequency, no contact; asks the engine which gap is next.
    Truth,
}

/// Which method, and how fine.
#[derive(clap::Args)]
pub struct Choice {
    /// Simulate by this method; all but the first are there to be compared with it.
    #[arg(long, value_name = "NAME", value_enum, default_value_t = Name::Certified, hide_default_value = true)]
    method: Name,
    /// Take this step in time, of the methods that have one.
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    step: Option<f64>,
    /// Allow this error in a step, of runge-kutta.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    tolerance: Option<f64>,
}

impl Choice {
    /// Whether it flies in closed form, so that rounding is what moves its impacts first.
    pub fn is_closed(&self) -> bool {
        matches!(self.method, Name::Certified | Name::Sampled)
    }

    /// The method.
    ///
    /// # Errors
    /// Exit code 2 for a step or tolerance that the method does not have. Their values are checked
    /// by the method itself.
    pub fn method(&self) -> Result<Box<dyn Method>, Failure> {
        let step = |default: f64| self.step.unwrap_or(default);
        let method: Box<dyn Method> = match self.method {
            Name::Certified => Box::new(Certified),
            Name::Sampled => Box::new(Sampled { step: step(0.01) }),
            Name::RungeKutta => Box::new(RungeKutta { tolerance: self.tolerance.unwrap_or(1e-9) }),
            Name::MoreauJean => Box::new(MoreauJean { step: step(1e-3) }),
            Name::Verlet => Box::new(Verlet { step: step(1e-3) }),
            Name::Penalty => Box::new(Penalty { step: step(1e-4) }),
            Name::Truth => Box::new(Truth),
        };
        let (has_step, has_tolerance) = match self.method {
            Name::Certified | Name::Truth => (false, false),
            Name::RungeKutta => (false, true),
            _ => (true, false),
        };
        let takes = match (has_step, has_tolerance) {
            (true, _) => "it takes --step",
            (_, true) => "it takes --tolerance",
            _ => "leave it out",
        };
        let given = [
            ("--step", self.step.is_some() && !has_step),
            ("--tolerance", self.tolerance.is_some() && !has_tolerance),
        ];
        match given.iter().find(|(_, wrong)| *wrong) {
            Some((option, _)) => {
                let name = method.name();
                Err(Failure::input(format!("{option}: the method {name} has none; {takes}")))
            }
            None => Ok(method),
        }
    }
}
