//! A paper that computes its numbers: from experiments to the documents that people read, on any
//! subject. The [manual] has two pages: how to write a paper, and prose. `examples/feigenbaum` is a
//! whole paper: in this folder, `cargo run --example feigenbaum -- paper --out FOLDER`.
//!
//! 1. An [experiment](experiments) has parameters for each profile and a run. Its result is saved,
//!    and used again as long as parameters and the code that it depends on are the same.
//! 2. Its numbers stand in [tables](table); a cell has an address, `cascade.orbits[n=3].delta`, by
//!    which prose, figures, claims and cards name it. Single numbers are [values](value).
//! 3. A [figure](figures) is one list of shapes, written as SVG and PDF, with its data as CSV.
//! 4. A printed [statement](claims) is compared with the result; its verdict is a function of
//!    numbers, and can fail.
//! 5. The [report](mod@report) fills people's prose with all of it: Markdown, LaTeX and HTML.
//! 6. A [`Paper`] is all of it, with its folders ([`Project`]) and its [command line](cli);
//!    [`prelude`] has the imports of a paper.
//!
//! A table, and a number by its address:
//!
//! ```
//! use literate::table::Table;
//!
//! let rows = [(1.0, 0.5), (2.0, 0.25)];
//! let table = Table::builder("halving.rows", &rows, |_| 1)
//!     .key("n", "1", |row| row.0)
//!     .real("share", "1", 3, "What is left.", |row| row.1)
//!     .done();
//! assert_eq!(table.number(&[("n", 2.0)], "share")?, 0.25);
//! assert!(table.cell("halving.rows[n=2].share").is_some());
//! # Ok::<(), literate::table::Missing>(())
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![deny(missing_docs)]

mod build;
pub mod claims;
pub mod cli;
mod code;
mod decimal;
pub mod experiments;
mod failure;
pub mod figures;
pub mod input;
mod names;
#[doc = include_str!("manual.md")]
pub mod manual {}
mod paper;
pub use plotters;
/// What a paper needs, for one line of imports.
pub mod prelude {
    pub use crate::claims::{Basis, Check, Evidence, Judged, Rule, Text};
    pub use crate::experiments::{Command, Error, Experiment, Profile, Progress, Results};
    pub use crate::figures::prelude::{Error as FigureError, *};
    pub use crate::sample::{average, difference, jackknife, ratio, share};
    pub use crate::table::Table;
    pub use crate::{Failure, Paper, numbers, sources};
    pub use impact_numerics::estimates::with_error;
    pub use impact_numerics::random::{NormalPairs, Seed, generator};
    pub use impact_numerics::statistics::Estimate;
    pub use rand::RngExt;
}
mod print;
mod project;
mod prose;
pub mod report;
mod sample;
mod source;
pub mod table;
pub mod value;

pub use build::make_report;
pub use failure::{Failure, INTERRUPTED};
pub use impact_numerics::double_double;
pub use literate_sources::{sources, texts};
pub use paper::{FigureSpec, Paper};
pub use project::Project;
pub use prose::Templates;
pub use sample::Sampled;
pub use source::Sources;
