//! Which method simulates, and how fine.

use super::Failure;
use impact_chain::methods::Method;
use impact_paper::params::MethodName;

/// Which method, and how fine.
#[derive(clap::Args)]
pub struct Choice {
    /// Simulate by this method; all but the first are there to be compared with it.
    #[arg(long, value_name = "NAME", value_enum, default_value_t = MethodName::Certified, hide_default_value = true)]
    method: MethodName,
    /// Take this step in time, of the methods that have one.
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    step: Option<f64>,
    /// Allow this error in a step, of runge-kutta, or this width of a gap that is hit, of advancement.
    #[arg(long, value_name = "TOL", allow_hyphen_values = true)]
    tolerance: Option<f64>,
}

impl Choice {
    /// Whether it flies in closed form, so that rounding is what moves its impacts first.
    pub fn is_closed(&self) -> bool {
        matches!(self.method, MethodName::Certified | MethodName::Sampled)
    }

    /// The method.
    ///
    /// # Errors
    /// Exit code 2 for a step or tolerance that the method does not have. Their values are checked
    /// by the method itself.
    pub fn method(&self) -> Result<Box<dyn Method>, Failure> {
        let usual = match self.method {
            MethodName::Certified | MethodName::Truth => 0.0,
            MethodName::Sampled => 0.01,
            MethodName::Advancement => 1e-12,
            MethodName::RungeKutta => 1e-9,
            MethodName::MoreauJean | MethodName::Verlet => 1e-3,
            MethodName::Penalty => 1e-4,
        };
        let own = match self.method {
            MethodName::Certified | MethodName::Truth => None,
            own if own.has_tolerance() => Some("--tolerance"),
            _ => Some("--step"),
        };
        for (option, value) in [("--step", self.step), ("--tolerance", self.tolerance)] {
            if value.is_some() && own != Some(option) {
                let takes = own.map_or("leave it out".into(), |own| format!("it takes {own}"));
                let name = self.method.id();
                return Err(Failure::input(format!(
                    "{option}: the method {name} has none; {takes}"
                )));
            }
        }
        Ok(self.method.with(self.step.or(self.tolerance).unwrap_or(usual)))
    }
}
