//! The theory of Secs. 3 to 9 against second routes: exact and 67-digit arithmetic, enumeration,
//! quadrature, and the command line around it.

mod distribution;
mod eval;
mod high_precision;
mod jump;
mod relation;
mod results;
