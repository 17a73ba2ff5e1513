//! Makes the paper: `cargo run -p literate --example feigenbaum -- paper --out FOLDER`.

mod paper;

fn main() -> std::process::ExitCode {
    paper::paper().cli()
}
