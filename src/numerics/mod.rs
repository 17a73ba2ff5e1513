//! Mathematics that knows no physics: portable kernels, certified searches, sums, statistics and
//! random streams. Everything here gives the same bits on every machine: only + − × ÷ √ and the
//! functions of `pxfm` are used, never the platform's libm.

pub mod bisection;
pub mod bootstrap;
pub mod clock;
pub mod dense;
pub mod double_double;
pub mod earliest;
pub mod eigenvalues;
pub mod first_root;
pub mod local_frame;
mod polish;
pub mod quadrature;
pub mod random;
pub mod regression;
pub mod regula_falsi;
pub mod scaled;
pub mod screen;
pub mod statistics;
mod stepping;
pub mod trig;
pub mod window;
