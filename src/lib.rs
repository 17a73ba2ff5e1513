//! A literate, reproducible edition of M. Homer and S. J. Hogan (2007), *Impact Dynamics of Large
//! Dimensional Systems*: every number and figure of that paper, computed and checked.
//!
//! In the order of the paper, with links to the report that `make paper` has written:
//!
//! - [Section 1](../../../paper/report.html#sec-introduction) and
//!   [Section 2](../../../paper/report.html#sec-simulation), the chain of forced masses and its
//!   impacts: [`impact_chain`].
//! - [Section 3](../../../paper/report.html#sec-graph) to
//!   [Section 7](../../../paper/report.html#sec-jump), circuits of the impact graph, their
//!   probability, the jump: [`impact_circuits`].
//! - [Section 8](../../../paper/report.html#sec-relation), how p follows from σ:
//!   [`impact_circuits::impact_probability`].
//! - [Section 9](../../../paper/report.html#sec-higher), circuits that are not simple:
//!   [`impact_circuits::higher_order`].
//! - What is run, with which parameters: [`experiments`] and [`params`]; in the report
//!   [the method](../../../paper/methods.html#sec-method) and its
//!   [speed and accuracy](../../../paper/methods.html#sec-accuracy).
//! - What is shown: [`figures`], [`claims`], [`contents`] and the engine in the page ([`lab`]);
//!   `src/main.rs` puts it together. Where each equation is: [`mod@equations`].
// Macros that print panic on a closed pipe or a full disk: `literate::cli::terminal` does not.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
#![warn(clippy::print_stderr, clippy::print_stdout)]

pub mod claims;
pub mod contents;
pub mod equations;
pub mod experiments;
pub mod figures;
pub mod lab;
pub mod params;
