//! Runs the verb `eval`: computes one quantity of the theory and prints it as JSON.

use super::range::number;
use clap::builder::PossibleValuesParser;
use impact_circuits::distribution::{Law, SampleSpace};
use impact_circuits::impact_probability::ImpactProbability;
use impact_circuits::{Error, LARGEST_N, counting, jump};
use impact_paper::params::{Chain, VERTICES};
use literate::Failure;
use literate::cli::terminal::{print, warn};
use serde::Serialize;
use serde_json::Value;

/// Evaluate one quantity of the theory (Secs. 3 to 9), as one JSON object
///
/// Examples:
///   eval p-jump --vertices 100
///   {"quantity":"p-jump","value":0.01303285872435575,"inputs":{"vertices":100}}
///   eval p-of-sigma --sigma 0.12
///   eval --list
#[derive(clap::Args)]
#[command(verbatim_doc_comment, after_help = help())]
pub struct Args {
    /// Evaluate this, one of the names below.
    #[arg(value_name = "QUANTITY", required_unless_present = "list", hide_possible_values = true,
        value_parser = PossibleValuesParser::new(QUANTITIES.map(|[name, ..]| name)))]
    quantity: Option<String>,
    /// List all quantities with their equations and what they need.
    #[arg(long)]
    list: bool,
    #[command(flatten)]
    inputs: Inputs,
}

/// Inputs of quantities; the answer repeats those that it used.
#[derive(clap::Args, Serialize)]
struct Inputs {
    /// Number of masses n between walls; there are N = n + 1 vertices.
    #[arg(long, value_name = "n", conflicts_with = "vertices")]
    #[serde(skip_serializing_if = "Option::is_none")]
    masses: Option<usize>,
    /// Number of vertices N of the graph [default: 100].
    #[arg(long, value_name = "N")]
    #[serde(skip_serializing_if = "Option::is_none")]
    vertices: Option<usize>,
    /// Probability p of an edge; 0 means the limit p → 0+.
    #[arg(long, value_name = "P", value_parser = number(0.0, 1.0), allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    p: Option<f64>,
    /// Number of different impacts k, 1 ≤ k ≤ N.
    #[arg(long, value_name = "K")]
    #[serde(skip_serializing_if = "Option::is_none")]
    k: Option<usize>,
    /// Standard deviation σ of the forcing, above 0.
    #[arg(long, value_name = "S", value_parser = number(0.0, 1e6), allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    sigma: Option<f64>,
    /// Natural frequency ω [default: 1].
    #[arg(long, value_name = "w", value_parser = number(1e-3, 1e3), allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    omega: Option<f64>,
    /// Forcing frequency Ω, different from ω [default: √2; the double nearest to √2 is read
    /// as √2 itself].
    #[arg(long, value_name = "W", value_parser = number(1e-3, 1e3), allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    forcing_frequency: Option<f64>,
    /// Spacing d of the masses at rest [default: 1].
    #[arg(long, value_name = "d", value_parser = number(1e-6, 1e6), allow_hyphen_values = true)]
    #[serde(skip_serializing_if = "Option::is_none")]
    spacing: Option<f64>,
}

#[derive(Serialize)]
struct Answer {
    quantity: &'static str,
    value: Value,
    inputs: Inputs,
}

/// The quantities of the theory: name, equation, needed inputs (`oscillator` stands for ω, Ω and
/// d), meaning. Those with `higher-` are of five classes of circuits, the others of simple ones.
const QUANTITIES: [[&str; 4]; 14] = [
    ["p-crit", "Eq. (18)", "N", "p at which f gets a double zero"],
    ["p-jump", "Sec. 7", "N", "infimum of p with k* > 1 (N ≥ 4)"],
    ["k-after-jump", "Sec. 7", "N", "k* just after the jump (N ≥ 4)"],
    ["k-star", "Sec. 6", "N p", "most likely number of impacts; the lowest of several"],
    ["mean-impacts", "Sec. 6", "N p", "μ, the expected number of impacts"],
    ["probability", "Eqs. (9), (10)", "N p k", "P(X = k)"],
    ["log-circuits", "Eq. (7)", "N k", "ln φ_N(k), number of simple circuits of length k"],
    ["p-of-sigma", "Eqs. (20) to (25)", "sigma oscillator", "p(σ) that a gap closes by itself"],
    ["log-p-of-sigma", "Eqs. (20) to (25)", "sigma oscillator", "ln p(σ)"],
    ["higher-p-jump", "Eq. (38)", "N", "p-jump of the five classes (N ≥ 2)"],
    ["higher-k-after-jump", "Eq. (38)", "N", "k-after-jump of the five classes (N ≥ 2)"],
    ["higher-k-star", "Eq. (38)", "N p", "k-star of the five classes"],
    ["higher-mean-impacts", "Eq. (38)", "N p", "mean-impacts of the five classes"],
    ["higher-probability", "Eq. (38)", "N p k", "probability in the five classes"],
];

/// Computes a quantity; the inputs that it does not need are ignored.
fn evaluate(name: &str, inputs: &Inputs) -> Result<Value, Error> {
    let (name, space) = match name.strip_prefix("higher-") {
        Some(name) => (name, SampleSpace::FiveClasses),
        None => (name, SampleSpace::Simple),
    };
    let (n, k) = (inputs.vertices.unwrap_or(VERTICES), inputs.k.unwrap_or_default());
    let law = || Law::new(space, n, inputs.p.unwrap_or_default());
    let relation = || {
        let Inputs { sigma, spacing, omega, forcing_frequency, .. } = *inputs;
        let [sigma, spacing, natural_frequency, forcing_frequency] =
            [sigma, spacing, omega, forcing_frequency].map(|x| x.unwrap_or(f64::NAN));
        let chain = Chain { spacing, natural_frequency, forcing_frequency, ..Chain::default() };
        ImpactProbability::new(sigma, &chain)
    };
    Ok(match name {
        "p-crit" => jump::p_crit(n)?.into(),
        "p-jump" => jump::p_jump(space, n)?.p.into(),
        "k-after-jump" => jump::p_jump(space, n)?.k_after.into(),
        "k-star" => law()?.k_star().into(),
        "mean-impacts" => law()?.mean().into(),
        "probability" => law()?.probability(k)?.into(),
        "log-circuits" => counting::log_phi(n, k)?.into(),
        "p-of-sigma" => relation()?.p()?.into(),
        "log-p-of-sigma" => relation()?.log_p()?.into(),
        _ => Value::Null,
    })
}

impl Inputs {
    /// Fills in defaults; refuses options that the quantity does not use, and a lack of those that
    /// it needs.
    fn complete(mut self, name: &str, needed: &str) -> Result<Inputs, Failure> {
        let needs = |need: &str| needed.split(' ').any(|needed| needed == need);
        let values = serde_json::to_value(&self).unwrap_or_default();
        let is_unused = |option: &&String| match option.as_str() {
            "masses" | "vertices" => !needs("N"),
            "omega" | "forcing_frequency" | "spacing" => !needs("oscillator"),
            option => !needs(option),
        };
        if let Some(option) = values.as_object().and_then(|values| values.keys().find(is_unused)) {
            let option = option.replace('_', "-");
            let message = format!("--{option}: {name} does not depend on it; leave it out");
            return Err(Failure::input(message));
        }
        let missing = |need: &&str| !["N", "oscillator"].contains(need) && values[*need].is_null();
        if let Some(need) = needed.split(' ').find(missing) {
            return Err(Failure::input(format!("--{need}: {name} needs it; see `eval --help`")));
        }
        if needs("N") {
            let more = self.masses.map(|masses| masses.saturating_add(1));
            self.vertices = more.or(self.vertices).or(Some(VERTICES));
        }
        if needs("oscillator") {
            let chain = Chain::default();
            self.omega.get_or_insert(chain.natural_frequency);
            self.forcing_frequency.get_or_insert(chain.forcing_frequency);
            self.spacing.get_or_insert(chain.spacing);
        }
        Ok(self)
    }
}

pub fn run(args: Args) -> Result<(), Failure> {
    let is_asked = |[name, ..]: &&[&str; 4]| args.quantity.as_deref() == Some(name);
    let Some([quantity, _, needs, _]) = QUANTITIES.iter().find(is_asked).filter(|_| !args.list)
    else {
        return print(&list());
    };
    let inputs = args.inputs.complete(quantity, needs)?;
    let value = evaluate(quantity, &inputs).map_err(|error| {
        // --masses gives N too.
        let message = error.to_string();
        match (inputs.masses, message.strip_prefix("vertices:")) {
            (Some(_), Some(rest)) => Failure::input(format!("--masses (N = n + 1):{rest}")),
            _ => Failure::input(format!("--{message}")),
        }
    })?;
    if *quantity == "p-crit" && value.as_f64() > Some(1.0) {
        warn("p_crit is above 1, so no probability reaches it: N is too small");
    }
    let answer = Answer { quantity, value, inputs };
    let json = serde_json::to_string(&answer).map_err(|error| Failure::check(error.to_string()))?;
    print(&(json + "\n"))
}

/// Lists the quantities, a line for each: name, equation, inputs, meaning.
fn list() -> String {
    let option = |need: &str| match need {
        "N" => "[N]".into(),
        "oscillator" => "[ω Ω d]".into(),
        need => format!("--{need}"),
    };
    let line = |[name, equation, needs, meaning]: &[&str; 4]| {
        let needs: Vec<String> = needs.split(' ').map(option).collect();
        format!("{name:<20} {equation:<18} {:<16} {meaning}\n", needs.join(" "))
    };
    QUANTITIES.iter().map(line).collect()
}

fn help() -> String {
    format!(
        "Quantities (name, equation, options, meaning):\n{}\nFloats are printed with the fewest digits that read \
         back to the same double, integers as integers. N is at most {LARGEST_N} (a result then takes some seconds). \
         P(X = k) is printed as 0 where it is below the smallest double. With higher orders, k is the number of \
         different vertices, and circuits are primitive (a repetition of a shorter one is not counted).",
        list()
    )
}
