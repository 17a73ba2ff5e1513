//! What the program must know of its own source: a fingerprint, the homes of equations,
//! and the source that the report quotes.

mod depends;
mod fingerprint;
mod homes;
mod sources;

fn main() -> std::io::Result<()> {
    fingerprint::run()?;
    homes::run()?;
    sources::run()
}
