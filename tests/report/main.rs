//! The report and what it is made of: templates, figures, pages, damaged texts, and rules about the source.

mod damage;
mod documents;
mod figures;
mod html;
// What the paper is made of.
#[path = "../../src/main.rs"]
#[allow(dead_code)]
mod program;
mod prose;
mod quick;
mod structure;
