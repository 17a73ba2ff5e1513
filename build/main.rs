//! What the program must know of its own source: a fingerprint, the homes of equations, the source that the report
//! quotes, and, with the feature `embed`, what it else reads when it runs.

mod commit;
mod embedded;
mod fingerprint;
mod homes;
mod sources;

fn main() -> std::io::Result<()> {
    commit::run()?;
    fingerprint::run()?;
    homes::run()?;
    sources::run()?;
    embedded::run()
}
