//! Fig. S8: successive impacts, circuits and different gaps beside independent impacts.

use super::axis::{Axis, log};
use super::chart::{LETTERS, short};
use super::data::cells;
use super::panel::Frame;
use super::series::Outside;
use super::sheet::{Entry, Sheet};
use super::style::{BLUE, Colour, Dash, INK, LINE, Mark, ORANGE, PURPLE, RED, SMALL, Stroke, THIN};
use super::{DataFile, Error, Figure};
use crate::experiments::independence::{Dependence, Distinct, Independence};
use crate::numerics::statistics::Estimate;

/// The half size of marks.
const SIZE: i32 = 52;

/// Looks of the ensembles, by rising σ.
const LOOKS: [(Mark, Colour); 4] = [
    (Mark::Disc, RED),
    (Mark::OpenSquare, ORANGE),
    (Mark::OpenTriangle, PURPLE),
    (Mark::Ring, BLUE),
];

/// The largest length of circuits in (b).
const LONGEST: usize = 70;

/// Draws the figure.
pub fn draw(found: &Independence, note: Option<&str>) -> Result<Figure, Error> {
    let sheet = Sheet::new(9350, note)?;
    distances(&sheet, found)?;
    circuits(&sheet, found)?;
    different(&sheet, found)?;
    let title = "Successive impacts beside independent ones";
    Ok(sheet.finish_own(8, title, description(found), tables(found)))
}

fn looked(found: &Independence) -> impl Iterator<Item = (&Dependence, (Mark, Colour))> {
    // The last look is that of the highest σ, whatever is between.
    let last = found.long().count().saturating_sub(1);
    let look = move |at: usize| if at == last { LOOKS[3] } else { LOOKS[at.min(2)] };
    found.long().enumerate().map(move |(at, row)| (row, look(at)))
}

fn ends(found: &Independence) -> Vec<(&Dependence, (Mark, Colour))> {
    let mut all: Vec<_> = looked(found).collect();
    let last = all.pop();
    all.into_iter().take(1).chain(last).collect()
}

fn sigma(row: &Dependence) -> String {
    format!("*σ* = {}", row.row.sigma)
}

fn distances(sheet: &Sheet, found: &Independence) -> Result<(), Error> {
    let far = found.long().map(|row| row.near.len()).max().unwrap_or(1) as f64;
    let panel = sheet.panel(
        Frame::new(1150, 480, 8150, 3380),
        Axis::linear(-0.5, far - 0.5, 5.0, 5, "distance |*i* − *j*| from one impact to the next"),
        Axis::linear(0.0, 1.6, 0.5, 5, "over independent"),
    )?;
    panel.letter(LETTERS[0])?;
    let level = Stroke::solid(INK, LINE);
    panel.curve("independent", &[(-0.5, 1.0), (far - 0.5, 1.0)], level, Outside::Refuse)?;
    let mut entries = vec![Entry::line(level, "independent")];
    for (row, (mark, colour)) in looked(found) {
        let thin = Stroke::solid(colour, THIN);
        let known = (0..).zip(&row.near).filter_map(|(x, own)| Some((f64::from(x), (*own)?)));
        let known: Vec<(f64, Estimate)> = known.collect();
        panel.estimates(&sigma(row), &known, (mark, SIZE, thin), |y| y)?;
        entries.push(Entry::mark(mark, SIZE, thin, &sigma(row)));
    }
    let (line, marks) = entries.split_at(1);
    sheet.legend((3300, 2250), (SMALL, 310), line)?;
    sheet.legend((5900, 2250), (SMALL, 310), marks)
}

fn circuits(sheet: &Sheet, found: &Independence) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(1150, 4780, 4450, 7380),
        Axis::linear(0.0, LONGEST as f64, 20.0, 4, "length *k*"),
        Axis::decades(-6, -1, 1, "frequency"),
    )?;
    panel.letter(LETTERS[1])?;
    let line = Stroke::solid(INK, LINE);
    let points = |shares: &mut dyn Iterator<Item = f64>| -> Vec<(f64, f64)> {
        let all = (1..=LONGEST).zip(shares).filter(|(_, share)| *share > 0.0);
        all.map(|(k, share)| (k as f64, log(share))).collect()
    };
    let equal = found.long().next().map(|row| row.uniform.clone()).unwrap_or_default();
    let curve = points(&mut equal.into_iter());
    panel.curve("equal and independent", &curve, line, Outside::Cut)?;
    let mut lines = vec![Entry::line(line, "equal and independent")];
    let mut marks = Vec::new();
    for (row, (mark, colour)) in ends(found) {
        let (thin, all) = (Stroke::solid(colour, THIN), impacts(row).max(1.0));
        let dashed = matrix(colour);
        let name = format!("measured matrix, {}", sigma(row));
        let curve = points(&mut row.markov.iter().map(|&n| n as f64 / all));
        panel.curve(&name, &curve, dashed, Outside::Cut)?;
        lines.push(Entry::line(dashed, &name));
        let own = points(&mut row.circuits.iter().map(|&n| n as f64 / all));
        panel.marks(&sigma(row), &own, (mark, SIZE * 2 / 3, thin), Outside::Cut)?;
        marks.push(Entry::mark(mark, SIZE, thin, &format!("measured, {}", sigma(row))));
    }
    sheet.legend((500, 8420), (SMALL, 340), &lines)?;
    sheet.legend((4950, 8420), (SMALL, 340), &marks)
}

/// The line of the measured transition matrix.
fn matrix(colour: Colour) -> Stroke {
    Stroke::dashed(colour, THIN, Dash::Short)
}

fn different(sheet: &Sheet, found: &Independence) -> Result<(), Error> {
    let panel = sheet.panel(
        Frame::new(5550, 4780, 8150, 7380),
        Axis::linear(0.0, 3.0, 1.0, 4, "impacts, *m*/*N*"),
        Axis::linear(0.0, 1.0, 0.2, 2, "different gaps/*N*"),
    )?;
    panel.letter(LETTERS[2])?;
    type Height = fn(&Distinct) -> Option<f64>;
    let points = |row: &Dependence, height: Height| -> Vec<(f64, f64)> {
        let n = row.gaps as f64;
        let at = |own: &Distinct| Some((own.impacts as f64 / n, height(own)? / n));
        row.distinct.iter().filter_map(at).collect()
    };
    if let Some(row) = found.long().next() {
        let line = Stroke::solid(INK, LINE);
        let equal = points(row, |own| Some(own.uniform));
        panel.curve("equal and independent", &equal, line, Outside::Cut)?;
    }
    for (row, (mark, colour)) in ends(found) {
        let name = format!("measured matrix, {}", sigma(row));
        let curve = points(row, |own| Some(own.markov?.value));
        panel.curve(&name, &curve, matrix(colour), Outside::Cut)?;
        let marks = points(row, |own| Some(own.mean?.value));
        let look = (mark, SIZE, Stroke::solid(colour, THIN));
        panel.marks(&sigma(row), &marks, look, Outside::Cut)?;
    }
    Ok(())
}

fn impacts(row: &Dependence) -> f64 {
    row.hits.iter().flatten().sum::<u64>() as f64
}

fn description(found: &Independence) -> String {
    let told = |own: Option<Estimate>| own.map_or("none".into(), |own| short(own.value, 2));
    let near: Vec<String> = found
        .long()
        .map(|row| {
            let near: Vec<String> = row.near.iter().take(4).map(|own| told(*own)).collect();
            format!("{} at σ = {}", near.join(", "), row.row.sigma)
        })
        .collect();
    let lengths: Vec<String> =
        found.long().map(|row| format!("{} at σ = {}", told(row.length), row.row.sigma)).collect();
    let uniform = found.long().last().map_or(0.0, |row| row.length_uniform);
    let different: Vec<String> = found
        .long()
        .filter_map(|row| {
            let own = row.distinct.iter().find(|own| own.impacts == row.gaps)?;
            let (mean, matrix, sigma) = (told(own.mean), told(own.markov), row.row.sigma);
            Some(format!("{mean} at σ = {sigma}, by the measured matrix {matrix}"))
        })
        .collect();
    format!(
        "(a) Successions at distance |i − j| over those of independent impacts with the same \
         frequencies, with standard errors: none at distance zero, few at the next ones, near one beyond. \
         At distances from zero to three: {}. (b) Share of impacts that begin a simple circuit of length k, on a \
         logarithmic axis: a curve that falls ever faster for equal and independent gaps, close to it dashed \
         ones for the measured transition matrices; measured points lie below for short circuits and \
         far above for long ones. Mean lengths: {}, and {} for equal and independent gaps. (c) Different \
         gaps among m successive impacts over the number of gaps, against m over that number, with the same looks; \
         among as many impacts as there are gaps: {}.",
        near.join("; "),
        lengths.join(", "),
        short(uniform, 2),
        different.join(", "),
    )
}

fn tables(found: &Independence) -> Vec<DataFile> {
    let mut near = DataFile::new(
        "s08a.csv",
        &[
            "n (1)",
            "sigma (d omega^2)",
            "distance (1)",
            "over_independent (1)",
            "standard_error (1)",
        ],
    );
    let mut circuits = DataFile::new(
        "s08b.csv",
        &[
            "n (1)",
            "sigma (d omega^2)",
            "k (1)",
            "measured (1)",
            "measured_matrix (1)",
            "equal_and_independent (1)",
        ],
    );
    let mut different = DataFile::new(
        "s08c.csv",
        &[
            "n (1)",
            "sigma (d omega^2)",
            "impacts (1)",
            "different_gaps (1)",
            "standard_error (1)",
            "measured_matrix (1)",
            "measured_frequencies (1)",
            "equal_and_independent (1)",
        ],
    );
    let value = |own: Option<Estimate>| own.map(|own| own.value);
    let error = |own: Option<Estimate>| own.map(|own| own.error);
    for row in &found.rows {
        let (n, sigma, all) = (row.row.masses as u64, row.row.sigma, impacts(row).max(1.0));
        for (distance, own) in (0_u64..).zip(&row.near) {
            near.row(cells![n, sigma, distance, value(*own), error(*own)]);
        }
        for (at, uniform) in row.uniform.iter().enumerate() {
            let share = |list: &[u64]| list.get(at).map(|&n| n as f64 / all);
            let k = at as u64 + 1;
            circuits.row(cells![n, sigma, k, share(&row.circuits), share(&row.markov), *uniform]);
        }
        for own in &row.distinct {
            different.row(cells![
                n,
                sigma,
                own.impacts as u64,
                value(own.mean),
                error(own.mean),
                value(own.markov),
                value(own.frequencies),
                own.uniform
            ]);
        }
    }
    vec![near, circuits, different]
}
