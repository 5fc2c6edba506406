//! Bones as vectors (paper B-i, figure 4): to turn one turns all beyond it.
//!
//! A [`Skeleton`] is a list of bones, parents before children, as they lie when the person stands
//! with the arms down. A [`Posture`] is where the first bone stands and how each joint is turned.
//! [`Skeleton::stand`] has rapier's multibody find where every bone is then, and
//! [`Skeleton::reach`] the posture in which a bone's end is at a point.
//!
//! Frame: z up; the person faces −y, x is to their left, the origin on the floor between the feet.

mod joint;
mod posture;
mod reach;
mod rig;

pub use joint::{Exceeded, Joint};
pub use posture::{POSES, Posture};
pub use reach::Reached;

use crate::math::Vec3;

/// A bone: a vector from its joint to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Bone {
    /// What it is called, `right_thigh`.
    pub name: String,
    /// The bone that it hangs on, an earlier one of the list; none for the first.
    pub parent: Option<usize>,
    /// Whether it hangs on its parent's joint instead of on its end: the legs, at A of figure 4.
    pub at_base: bool,
    /// From its joint to its end, standing [cm].
    pub vector: Vec3,
    /// How it may turn against its parent.
    pub joint: Joint,
}

/// What a foot stands on: a ball of flesh below a bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sole {
    /// The bone that it goes with.
    pub bone: usize,
    /// Its middle [cm], from the bone's joint, in the axes of the standing frame.
    pub at: Vec3,
    /// Its radius [cm].
    pub radius: f64,
}

/// Bones, parents before children; the first one is the pelvis.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    base: Vec3,
    bones: Vec<Bone>,
    soles: Vec<Sole>,
}

/// A list of bones that is no skeleton.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidSkeleton {
    /// No bones.
    #[error("a skeleton needs at least one bone")]
    Empty,
    /// A bone other than the first hangs on nothing, or on one that comes later.
    #[error("bone {0:?} does not hang on an earlier bone")]
    Order(String),
    /// Two bones or joints of one name.
    #[error("{0:?} is there twice")]
    Twice(String),
    /// A bone's vector is not finite.
    #[error("bone {0:?} has no length that is a number")]
    NotFinite(String),
    /// The least that an angle of a joint may be is above the greatest, or no number.
    #[error("the limits of joint {0:?} are not in order")]
    Limits(String),
}

impl Skeleton {
    /// Checks a list of bones, the first of which starts at `base` [cm] when the person stands.
    ///
    /// # Errors
    /// [`InvalidSkeleton`] where bones are out of order, doubled or not finite, or limits are.
    pub fn new(base: Vec3, bones: Vec<Bone>) -> Result<Self, InvalidSkeleton> {
        if bones.is_empty() {
            return Err(InvalidSkeleton::Empty);
        }
        for (index, bone) in bones.iter().enumerate() {
            let in_order = bone.parent.map_or(index == 0, |parent| parent < index);
            if !in_order {
                return Err(InvalidSkeleton::Order(bone.name.clone()));
            }
            let earlier = &bones[..index];
            if earlier.iter().any(|other| other.name == bone.name) {
                return Err(InvalidSkeleton::Twice(bone.name.clone()));
            }
            let same = |other: &&Bone| other.joint.name == bone.joint.name;
            if let Some(other) = earlier.iter().find(same) {
                return Err(InvalidSkeleton::Twice(other.joint.name.clone()));
            }
            if bone
                .vector
                .iter()
                .chain(&base)
                .any(|part| !part.is_finite())
            {
                return Err(InvalidSkeleton::NotFinite(bone.name.clone()));
            }
            // Not the other way round: a limit that is no number is in no order.
            if !bone.joint.limits.iter().all(|[low, high]| low <= high) {
                return Err(InvalidSkeleton::Limits(bone.joint.name.clone()));
            }
        }
        let soles = Vec::new();
        Ok(Self { base, bones, soles })
    }

    /// The same skeleton with flesh below its feet; that of bones which it does not have is left out.
    #[must_use]
    pub fn with_soles(mut self, soles: Vec<Sole>) -> Self {
        let count = self.bones.len();
        self.soles = soles.into_iter().filter(|sole| sole.bone < count).collect();
        self
    }

    /// What the feet stand on; nothing where only bones are known.
    #[must_use]
    pub fn soles(&self) -> &[Sole] {
        &self.soles
    }

    /// Where the first bone starts when the person stands, A of figure 4 [cm].
    #[must_use]
    pub fn base(&self) -> Vec3 {
        self.base
    }

    /// The bones, parents before children.
    #[must_use]
    pub fn bones(&self) -> &[Bone] {
        &self.bones
    }

    /// The bone of a name.
    #[must_use]
    pub fn bone(&self, name: &str) -> Option<usize> {
        self.bones.iter().position(|bone| bone.name == name)
    }

    /// The bone that a joint turns, by the joint's name.
    #[must_use]
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.bones.iter().position(|bone| bone.joint.name == name)
    }

    /// Whether a bone is another one or hangs on it, by whatever is between.
    #[must_use]
    pub fn is_beyond(&self, bone: usize, other: usize) -> bool {
        let parent = |bone: &usize| self.bones[*bone].parent;
        core::iter::successors(Some(bone), parent).any(|bone| bone == other)
    }
}
