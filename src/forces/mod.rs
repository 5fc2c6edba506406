//! Laws × lattice: what pulls a node (paper C-i, figures 7–9; design §3).
//!
//! One law, one file: [`RodLaw`] is tension (5); [`turn`] is bending (6) and shear (7); [`twist`] is
//! what bending lacks on a lattice of rods; [`Momentum`] is inertia over a step of time.
//! [`Sheet`] gathers them over a lattice: energy, forces, and the blocks of their derivatives.

mod abreast;
mod angle;
mod blocks;
mod elements;
mod momentum;
mod paper;
mod rod;
mod roles;
mod series;
mod sheet;
mod stencil;
mod twist;

pub(crate) use abreast::{pulls, work_of_rods};
pub use angle::{
    Turn, TurnStiffness, angle_between, turn, turn_stiffness, turn_stiffness_positive,
};
pub(crate) use blocks::Blocks;
pub use momentum::{GRAVITY, Momentum};
pub use paper::paper_forces;
pub use rod::RodLaw;
pub use sheet::{Clamp, Laws, Pull, Sheet};
pub(crate) use stencil::{PLACES, Stencil, Stencils, StencilsFrom};
pub use twist::{Twisting, twist, twist_stiffness, twist_stiffness_positive};
