//! Where cloth meets a body (design §4, §5): a reaction that pushes, never pulls, and friction
//! inside its Coulomb cone.
//!
//! A *site* is a point of the cloth that may touch: each node, and samples within each cell, since
//! cloth is a surface and an edge of a body may stand between nodes. A *touch* is a site near one
//! part of a body: the plane of the nearest surface, and the anchor that friction holds on to.

mod law;
mod sites;
mod touches;

pub use law::{Friction, Skin};
pub use sites::{Site, Sites};
pub use touches::{Surface, Touch, Touches};
