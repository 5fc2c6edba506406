//! Cloth in motion: a cast of bodies moves, and frame by frame the cloth comes to rest on it.
//!
//! Each frame is a drape of its own, with its certificate, that goes on from the one before: friction
//! is carried over, and on the way the bodies take steps so short that nothing is passed through.
//! There is no time in it but that of the motion: the cloth is as slow as it needs to be to stay at
//! rest (quasi-static motion).
//!
//! A cast's clock: at −1 s and before everyone stands as the cloth is laid on; until 0 s they go over
//! to where their motion begins; from then on they follow it.

mod cast;
mod frame;

pub use cast::{Actor, Cast, ENTRANCE, Member};
pub use frame::{Frames, Unplayable, dress, next};
