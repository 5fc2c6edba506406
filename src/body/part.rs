//! One convex, round or meshed piece of a body.

use crate::{body::Mesh, math::Vec3};

/// A shape in its own frame [cm].
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A ball about the origin.
    Ball {
        /// Radius [cm].
        radius: f64,
    },
    /// All points within a radius of a segment along z, centred.
    Capsule {
        /// Radius [cm].
        radius: f64,
        /// Length of the segment, caps not counted [cm].
        length: f64,
    },
    /// A box, centred.
    Cuboid {
        /// Edge lengths along x, y, z [cm].
        size: Vec3,
    },
    /// A cylinder along z, centred.
    Cylinder {
        /// Radius [cm].
        radius: f64,
        /// Height [cm].
        height: f64,
    },
    /// A cone along z, centred, its tip up.
    Cone {
        /// Radius of the foot [cm].
        radius: f64,
        /// Height [cm].
        height: f64,
    },
    /// The convex hull of points.
    ConvexHull {
        /// The points [cm].
        points: Vec<Vec3>,
    },
    /// A triangle mesh: solid where it is closed, a two-sided sheet where it is not.
    Mesh(Mesh),
}
