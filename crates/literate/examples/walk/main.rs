//! How far a random walk goes.

use literate::prelude::*;

#[derive(serde::Serialize)]
struct Walks {
    lengths: Vec<u32>,
    walks: u64,
    seed: u64,
}

fn parameters(profile: Profile) -> Walks {
    let walks = if profile == Profile::Quick { 100 } else { 2000 };
    Walks { lengths: vec![10, 30, 100, 300, 1000], walks, seed: 1 }
}

/// For each length the squares of the distances, which are saved.
type Squares = Vec<(u32, Vec<f64>)>;

fn run(own: &Walks, progress: &Progress) -> Result<Squares, Error> {
    let squares = |&steps: &u32| {
        progress.check()?;
        let square = |walk| {
            let mut normals = NormalPairs::new("walk", own.seed, walk);
            let place: f64 = (0..steps).map(|_| normals.pair()[0]).sum();
            place * place
        };
        Ok((steps, (0..own.walks).map(square).collect()))
    };
    own.lengths.iter().map(squares).collect()
}

fn tables(found: &Squares) -> Vec<Table> {
    let reached = Table::of("walk.reached", found, |(_, squares)| squares.len())
        .key("steps", "1", |row| row.0.into())
        .estimate("square", "1", "Mean square of the distance.", |row| average(&row.1));
    vec![reached.done()]
}

const WALK: Experiment<Walks, Squares> = Experiment::new("walk", parameters, run, tables);

fn spread(results: &Results) -> Result<Figure, FigureError> {
    let reached = results.table("walk.reached")?.estimates(&[], "steps", "square");
    let plot = Plot::new().log_x("steps").log_y("mean square distance");
    let plot = plot.estimates("walks", &reached).curve("one a step", |steps| steps);
    plot.finish("Spread of a walk", seen!("Both rise in proportion to the steps."))
}

/// The paper.
pub fn paper() -> Paper {
    Paper::new("How far a walk goes", sources!("examples/walk"))
        .author("Ada Example", "University of Somewhere")
        .experiment(&WALK)
        .figure("spread", &[&WALK], spread)
        .check("square", |s| s.cell("walk.reached[steps=1000].square").within_errors())
}

fn main() -> std::process::ExitCode {
    paper().cli()
}
