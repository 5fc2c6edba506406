//! The numbers everything else is written in: `f64`, nalgebra's names, and nothing tuned.

/// A point or direction in space [cm], right-handed, z up.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3×3 matrix, for stiffness [gf/cm].
pub type Mat3 = nalgebra::Matrix3<f64>;
/// A point on the flat cloth [cm].
pub type Vec2 = nalgebra::Vector2<f64>;
/// A position and a turn in space.
pub type Pose = nalgebra::Isometry3<f64>;
