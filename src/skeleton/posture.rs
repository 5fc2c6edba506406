//! How a person stands: where the pelvis is, and how each joint is turned.

use super::Skeleton;
use crate::math::{Pose, Rotation};

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
