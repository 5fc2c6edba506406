//! Where cloth meets a body (design §4, §5): a reaction that pushes, never pulls, and friction
//! inside its Coulomb cone.
//!
//! A *site* is a point of the cloth that may touch: each node, samples within each cell, and the
//! deepest place of a cell that is near an edge or a tip, since cloth is a surface and a feature of
//! a body may stand between nodes. A *touch* is a site near one
//! part of a body: the plane of the nearest surface, and the anchor that friction holds on to.

mod clearance;
mod deepest;
mod footing;
mod law;
mod places;
mod sites;
mod touch;
mod touches;

pub(crate) use deepest::faces_around;
pub use footing::Footing;
pub use law::{Friction, Skin};
pub(crate) use sites::corner_of;
pub use sites::{Site, Sites};
pub use touch::Touch;
pub use touches::{Surface, Touches};
