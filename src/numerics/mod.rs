//! Mathematics that knows no physics: portable kernels, certified searches, sums, statistics and
//! random streams. Everything here gives the same bits on every machine: only + − × ÷ √ and the
//! functions of `pxfm` are used, never the platform's libm.

pub mod bisection;
pub mod bootstrap;
pub mod clock;
pub mod double_double;
pub mod first_root;
pub mod lane;
pub mod local_frame;
pub mod quadrature;
pub mod random;
pub mod regression;
pub mod scaled;
pub mod statistics;
pub mod trig;
pub mod winner_tree;
