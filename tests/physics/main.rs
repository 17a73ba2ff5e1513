//! The engine against what it must obey: a second simulator of higher precision, laws that hold
//! whatever the arithmetic, and scenes whose outcome is known beforehand.

mod certified;
mod certify;
mod components;
mod contact;
mod hard_cases;
mod invariants;
mod methods;
mod reference;
mod roundings;
mod search_segments;
mod segments_replay;
mod simultaneous;
mod traces;
