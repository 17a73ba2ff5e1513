//! What is run: one experiment a file, results that save and reload exactly.

pub mod theory;
