//! Circuits that repeat vertices (Sec. 9): how many there are, class by class, and the sample
//! space of five classes.
//!
//! The printed formulas count cyclic sequences as length!/length would, which is right only while
//! no sequence can be a repetition of a shorter one. [`Class::primitive`] counts the circuits
//! that are really different, at every length.

mod classes;
mod doubled;
mod sample_space;

pub use classes::{Class, four_visits, three_visits, two_doubled};
pub use doubled::{
    compositions, doubled, doubled_as_printed, doubled_paths, is_composition, length_of_loops,
    paths_by_falling, paths_with_loops,
};
pub use sample_space::{CLASSES, FiveClass, SHARED, different, multiplicity};
