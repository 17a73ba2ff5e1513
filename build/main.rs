//! What the program must know of its own source: a fingerprint, and the homes of equations.

mod fingerprint;
mod homes;

fn main() -> std::io::Result<()> {
    fingerprint::run()?;
    homes::run()
}
