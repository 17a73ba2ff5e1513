//! One row for each published number or statement.
