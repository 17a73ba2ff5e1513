//! Section 11: other starts, ends, restitutions and frequencies.

use super::{Error, chosen, estimate, from, mark};
use crate::claims::sec8_chains;
use crate::experiments::starts::{Starts, Variant};
use crate::experiments::{Results, rise, sweep};
use crate::params::{Boundary, COMPARABLE_REJECTED, Chain, Start};
use crate::report::values::{Value, origin};
use serde::Serialize;

/// One line of the table.
#[derive(Debug, Serialize)]
pub struct Line {
    name: String,
    half_height: String,
    difference: String,
}

fn id(variant: &Variant) -> String {
    format!("starts.{}", variant.name.replace(['-', '.'], "_"))
}

pub fn values(results: &Results) -> Result<Vec<Value>, Error> {
    let starts = results.starts()?;
    let n = starts.parameters.realisations;
    let mut values = Vec::new();
    let rest = starts.variants.first().and_then(|variant| variant.rise.half_height_all);
    for variant in &starts.variants {
        let half = variant.rise.half_height_all;
        values.push(estimate(id(variant), half, n));
        let difference = format!("{}_difference", id(variant));
        values.push(match rest.zip(half) {
            Some((a, b)) => {
                let error = (a.error * a.error + b.error * b.error).sqrt();
                Value::ensemble(difference, b.value - a.value, error, n as u64)
            }
            None => Value::text(difference, "none"),
        });
    }
    let values = values.into_iter().map(Value::data_only).collect();
    let mut values = from(values, origin(rise::find), "starts");
    values.extend(from(random(results, starts)?, origin(sweep::reduce), "starts"));
    Ok(values)
}

/// What the text says of random starts.
fn random(results: &Results, starts: &Starts) -> Result<Vec<Value>, Error> {
    let missing = Error::Missing("random starts");
    let Some(random) = starts.variant("random") else { return Err(missing) };
    let Some(last) = random.rows.last() else { return Err(missing) };
    let half = |name: &str| starts.variant(name).and_then(|variant| variant.rise.half_height_all);
    let theory = results.theory.scalars.sigma_half;
    let part = half("rest").zip(half("random"));
    Ok(vec![
        Value::integer("starts_realisations", starts.parameters.realisations),
        super::share("rejected_random", last.rejected, last.realisations),
        chosen("rejected_random_at", last.sigma),
        chosen("rejected_limit", COMPARABLE_REJECTED),
        part.map_or(Value::text("share_of_start", "none"), |(rest, random)| {
            let share = sec8_chains::share_of_start(rest.value, random.value, theory);
            Value::real("share_of_start", share, 2)
        }),
    ])
}

/// The lines of the table.
pub fn table(results: &Results) -> Result<Vec<Line>, Error> {
    let starts = results.starts()?;
    let paper = Chain::default();
    Ok(starts
        .variants
        .iter()
        .enumerate()
        .map(|(i, variant)| Line {
            name: name(&variant.chain, &paper),
            half_height: mark(id(variant)),
            difference: if i == 0 {
                "–".into()
            } else {
                mark(format!("{}_difference", id(variant)))
            },
        })
        .collect())
}

/// In what a chain differs from the paper's.
fn name(chain: &Chain, paper: &Chain) -> String {
    let mut parts = Vec::new();
    match chain.start {
        Start::Rest => {}
        Start::Zero => parts.push("no free parts".to_string()),
        Start::Random => parts.push("random free parts".to_string()),
    }
    if chain.boundary == Boundary::Ring {
        parts.push("ring".into());
    }
    if chain.restitution != paper.restitution {
        parts.push(format!("$r = {}$", chain.restitution));
    }
    if chain.forcing_frequency != paper.forcing_frequency {
        parts.push(format!(r"$\Omega = {}$", chain.forcing_frequency));
    }
    if parts.is_empty() { "from rest, between walls".into() } else { parts.join(", ") }
}
