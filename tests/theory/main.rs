//! The theory of Secs. 3 to 9 against second routes: exact and 67-digit arithmetic, enumeration,
//! quadrature.

mod distribution;
mod high_precision;
mod jump;
mod relation;
mod tables;
