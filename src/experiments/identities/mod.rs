//! Compares each exact statement of Secs. 3 to 9 with a second route. A claim judges how many
//! cases fail, or by how much: a row for each, under the id of the statement.

pub(crate) mod circuits;
pub(crate) mod jump;
pub(crate) mod relation;

use crate::experiments::theory::basics::*;

pub fn tables() -> Vec<Table> {
    let rows: [(&str, Cases); 16] = [
        ("sec3_impact_types", circuits::impact_types()),
        ("sec5_eq6", circuits::eq6()),
        ("sec5_eq7", circuits::eq7()),
        ("sec6_like_simulation", jump::mean_rises()),
        ("sec7_eq11", jump::eq11()),
        ("sec7_eq16_17", jump::slopes()),
        ("sec7_through_zero", jump::through_zero()),
        ("sec7_other_root", jump::other_root()),
        ("sec7_inflexion", jump::falling()),
        ("sec7_extrema", jump::extrema()),
        ("sec7_monotone", jump::monotone()),
        ("sec9_eq29", circuits::eq29()),
        ("sec9_eq30", circuits::eq30_times_n()),
        ("sec9_eq32", circuits::eq32()),
        ("sec9_eq38", circuits::eq38(1)),
        ("sec9_eq38_in_range", circuits::eq38(3)),
    ];
    let cases = Table::builder("theory.cases", &rows, |_| 0)
        .text_key("statement", |(id, _)| (*id).into())
        .count("compared", "cases that were compared", |(_, [compared, _])| *compared)
        .count("failed", "cases that do not agree", |(_, [_, failed])| *failed)
        .done();
    let rows: [(&str, f64); 5] = [
        ("sec7_eq13", jump::eq13()),
        ("sec7_maximum", jump::maximum()),
        ("sec7_inflexion", jump::inflexion()),
        ("sec8_separation", relation::separation()),
        ("sec8_densities", relation::distributions()),
    ];
    let differences = Table::builder("theory.differences", &rows, |_| 0)
        .text_key("statement", |(id, _)| (*id).into())
        .real("largest", "1", 1, "largest difference", |(_, largest)| *largest)
        .done();
    let ranges = Table::builder("theory.class_ranges", &circuits::class_ranges(), |_| 0)
        .table_computed_by(origin(circuits::class_ranges))
        .key("equation", "1", |one| one.equation)
        .count("right_from", "the length from which on it is right", |one| one.right_from as u64)
        .count("compared", "cases from that length on", |one| one.cases[0])
        .count("failed", "of these", |one| one.cases[1])
        .real("formula_below", "1", 2, "one length below, on three vertices", |one| {
            one.formula_below
        })
        .count("counted_below", "the circuits there", |one| one.counted_below as u64)
        .done();
    vec![cases, differences, ranges]
}
