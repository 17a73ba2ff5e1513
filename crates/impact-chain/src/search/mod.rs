//! The first root of a sum of sinusoids and a constant, found with a proof that none before it was missed: [`first_root`], in frames
//! ([`local_frame`]) that lose no digits, screened by polynomials ([`screen`]); phases without drift from a [`clock`] of
//! 96 bits; the next event of many from [`earliest`].

pub mod clock;
pub mod earliest;
pub mod first_root;
mod linear;
pub mod local_frame;
mod nodes;
pub mod screen;
mod stepping;
pub mod trig;
pub mod window;
