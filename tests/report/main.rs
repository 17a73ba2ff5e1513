//! The report and what it is made of: templates, figures, pages, parsers, and rules about the source.

mod budgets;
mod commonmark;
mod depends;
mod figures;
mod html;
mod parsers;
mod prose;
mod quick;
mod structure;
