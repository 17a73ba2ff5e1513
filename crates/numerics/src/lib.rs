//! Mathematics that knows no physics: portable kernels, certified searches, sums, statistics and
//! random streams. Everything here gives the same bits on every machine: only + − × ÷ √ and the
//! functions of `pxfm` are used, never the platform's libm.
//!
//! - The first root of a sum of sinusoids in slow motion, found with a proof that none was missed:
//!   [`first_root`], in frames ([`local_frame`]) that lose no digits, screened by polynomials
//!   ([`screen`]); phases without drift from a [`clock`] of 96 bits; the next event of many from [`earliest`].
//! - Numbers beyond f64: [`double_double`] has 32 digits, [`scaled`] the exponents of factorials.
//! - Roots and integrals: [`bisection`], [`regula_falsi`], [`quadrature`].
//! - Samples: [`random`] streams that depend on nothing but their names, [`statistics`], the
//!   [`bootstrap`], and [`estimates`] with the jackknife's errors.

pub mod bisection;
pub mod bootstrap;
pub mod clock;
pub mod double_double;
pub mod earliest;
pub mod estimates;
pub mod first_root;
mod linear;
pub mod local_frame;
mod nodes;
pub mod quadrature;
pub mod random;
pub mod regula_falsi;
pub mod scaled;
pub mod screen;
pub mod statistics;
mod stepping;
pub mod text;
pub mod trig;
pub mod window;
