//! Mathematics without physics. Everything gives the same bits on every machine: only + − × ÷
//! √ and the functions of `pxfm` are used, never the platform's libm.
//!
//! - Numbers beyond f64: [`double_double`] has 32 digits, [`scaled`] the exponents of factorials.
//! - [`roots`], integrals ([`quadrature`]), and the fit of a [`decay`].
//! - Samples: [`random`] streams that depend on their names only, [`statistics`], the
//!   [`bootstrap`], and [`estimates`] with errors by the jackknife.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

#[cfg(feature = "statistics")]
pub mod bootstrap;
pub mod decay;
pub mod double_double;
#[cfg(feature = "statistics")]
pub mod estimates;
pub mod quadrature;
#[cfg(feature = "random")]
pub mod random;
pub mod roots;
pub mod scaled;
#[cfg(feature = "statistics")]
pub mod statistics;
