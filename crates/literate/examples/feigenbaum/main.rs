//! Makes the paper in a folder: `cargo run -p literate --example feigenbaum -- FOLDER`.

mod paper;

use literate::experiments::{Profile, Progress, Store};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("give a folder")?);
    let progress = Progress::on_stderr(Default::default());
    let report = paper::make(Profile::Full, &Store::nowhere(), &progress)?;
    report.write(&folder, false)?;
    Ok(())
}
