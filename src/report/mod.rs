//! What the documents of this paper have beside those of any other: [`literate::report`].

pub mod contents;
pub mod equations;
pub mod lab;
mod program;
pub mod recipe;

pub use literate::report::*;
pub use program::PROGRAM;
