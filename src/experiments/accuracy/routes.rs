//! From the name of a method and its setting to the method.

use crate::params::{MethodName, Setting};
use impact_chain::methods::{Certified, Method, MoreauJean, Penalty, RungeKutta, Sampled, Verlet};

/// The method of a setting.
pub fn method(setting: Setting) -> Box<dyn Method> {
    let step = setting.value;
    match setting.method {
        MethodName::Certified => Box::new(Certified),
        MethodName::Sampled => Box::new(Sampled { step }),
        MethodName::RungeKutta => Box::new(RungeKutta { tolerance: step }),
        MethodName::MoreauJean => Box::new(MoreauJean { step }),
        MethodName::Verlet => Box::new(Verlet { step }),
        MethodName::Penalty => Box::new(Penalty { step }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Results are saved under the same names that the command line has.
    #[test]
    fn names_are_those_of_the_methods() {
        for name in MethodName::ALL {
            let own = method(Setting { method: name, value: 1e-3 });
            assert_eq!(serde_json::json!(name), own.name());
            assert_eq!(name.id(), own.name());
        }
    }
}
