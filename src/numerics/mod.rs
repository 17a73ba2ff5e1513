//! Mathematics that knows no physics: portable kernels, certified searches, sums, statistics and
//! random streams. Everything here gives the same bits on every machine: only + − × ÷ √ and the
//! functions of `pxfm` are used, never the platform's libm.

pub mod bootstrap;
pub mod clock;
pub mod first_root;
pub mod lane;
pub mod random;
pub mod regression;
pub mod statistics;
pub mod trig;
pub mod winner_tree;
