//! Cloth in motion: a cast of bodies moves, and frame by frame the cloth comes to rest on it.
//!
//! Each frame is a drape of its own, with its certificate, that goes on from the one before: friction
//! is carried over, and on the way the bodies take steps so short that nothing is passed through.
//! There is no time in it but that of the motion: the cloth is as slow as it needs to be to stay at
//! rest ([`next`]: quasi-static motion). Where inertia is asked for, each frame is some steps of time
//! after the one before, and its certificate is of forces that balance with inertia ([`sway`]).
//!
//! A cast's clock: at −1 s and before everyone stands as the cloth is laid on; until 0 s they go over
//! to where their motion begins; from then on they follow it.

mod cast;
mod frame;
mod sway;

pub use cast::{Actor, Cast, ENTRANCE, Member};
pub use frame::{Frames, Unplayable, dress, next};
pub use sway::{Pace, set_going, sway};
