//! Solid things that cloth lies on (paper B), as parry shapes with poses.

mod mesh;
mod part;
mod query;

pub use mesh::{Format, Inspection, Mesh, MeshError, Place, Unit, Up};
pub use part::{Nature, Part, PartError, Shape};
pub use query::{Bodies, Near};
