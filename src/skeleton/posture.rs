//! How a person stands: where the pelvis is, and how each joint is turned.

use super::Skeleton;
use crate::math::{Pose, Rotation};

/// Name and file text of each posture that ships.
pub const POSES: [(&str, &str); 6] = [
    ("standing", include_str!("../../bodies/poses/standing.toml")),
    (
        "arms-down",
        include_str!("../../bodies/poses/arms-down.toml"),
    ),
    ("arms-out", include_str!("../../bodies/poses/arms-out.toml")),
    (
        "reaching-up",
        include_str!("../../bodies/poses/reaching-up.toml"),
    ),
    ("sitting", include_str!("../../bodies/poses/sitting.toml")),
    ("stride", include_str!("../../bodies/poses/stride.toml")),
];

/// Where the first bone stands and how every joint is turned.
#[derive(Clone, Debug, PartialEq)]
pub struct Posture {
    /// Where the first bone, the pelvis, starts [cm], and how it is turned.
    pub root: Pose,
    /// How each bone is turned against its parent, one for each bone; the first is not used.
    pub joints: Vec<Rotation>,
}

impl Posture {
    /// Upright, the arms down.
    #[must_use]
    pub fn standing(skeleton: &Skeleton) -> Self {
        Self {
            root: Pose::from_parts(skeleton.base().into(), Rotation::identity()),
            joints: vec![Rotation::identity(); skeleton.bones().len()],
        }
    }
}
