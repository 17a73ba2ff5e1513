//! Makes the paper in a folder: `cargo run -p literate --example feigenbaum -- FOLDER`.

mod paper;

use literate::experiments::{Profile, Progress, Store};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("give a folder")?);
    let progress = Progress::on_stderr(Default::default());
    let report = paper::make(Profile::Full, &Store::open(&folder.join("results"))?, &progress)?;
    for (path, bytes) in report.committed.into_iter().chain(report.beside) {
        let path = folder.join(path);
        std::fs::create_dir_all(path.parent().unwrap_or(&folder))?;
        std::fs::write(path, bytes)?;
    }
    Ok(())
}
