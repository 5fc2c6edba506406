//! The actor's turns on our bones, whatever pose the actor is built in.
//!
//! For each frame, from the pelvis on:
//! 1. The pelvis, the trunk, the head and the shoulder girdle are turned as the actor's are, against
//!    the pose in which the actor is built: upright there is upright here.
//! 2. Upper arms, forearms, hands, thighs and shanks point where the actor's do, from joint to
//!    joint. About itself each is twisted as the actor's is, counted from the shortest turn that
//!    takes our standing limb, its parent's turn done, to the actor's as built: hanging arms and
//!    arms held out are one pose, with thumbs ahead.
//!    Upper arms are then turned about themselves by one angle for the whole capture, so that its
//!    elbows bend ahead: where a capture has its arms' zero is its own affair, which way elbows bend
//!    is not. Forearms and hands stay as they are.
//! 3. A foot is turned against its shank as the actor's is against his.
//! 4. A bone without a source, or whose joint does not turn, goes with its parent.
//!
//! The hips' middle goes the actor's way, as much shorter as our legs are. Feet are brought onto the
//! floor as `floor` tells; where only bones are known, the lowest ankle of all frames is where a
//! standing person's is.

use super::{
    Bvh, InvalidMotion, Key, Mapping, Motion,
    capture::{Actor, Stance},
    floor::{Tread, tread_on, treads},
};
use crate::{
    math::{Pose, Rotation, Vec3, turn},
    skeleton::{Bone, Posture, Skeleton},
};

/// Why a capture does not fit bones.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RetargetError {
    /// A bone that a mapping must name.
    #[error("no joint is given for {bone}; pelvis, thighs and shanks need one")]
    NotMapped {
        /// The bone.
        bone: &'static str,
    },
    /// A joint that the capture does not have.
    #[error("{bone} is moved by joint {joint:?}, which the capture does not have")]
    NoJoint {
        /// The bone.
        bone: String,
        /// The joint.
        joint: String,
    },
    /// A skeleton that cannot walk.
    #[error("the skeleton has no bone {bone:?}")]
    NoBone {
        /// The bone.
        bone: &'static str,
    },
    /// An actor whose hips and knees are in one place.
    #[error("which way is up cannot be told: hips and knees are in one place when unturned")]
    NoUp,
    /// An actor whose hips are in one place.
    #[error("which way is left cannot be told: both hips are in one place when unturned")]
    NoLeft,
    /// An actor without legs or arms.
    #[error("the actor's {limb} has no length")]
    NoLength {
        /// The limb.
        limb: &'static str,
    },
    /// Postures that are no motion.
    #[error(transparent)]
    Motion(#[from] InvalidMotion),
}

/// Elbows that bend less, sine squared, in the mean over all frames, say nothing of their hinge: 6°.
const LEAST_BEND: f64 = 0.01;

/// An upper arm and its forearm, on each side.
const ARMS: [[&str; 2]; 2] = [
    ["right_upper_arm", "right_forearm"],
    ["left_upper_arm", "left_forearm"],
];

/// A foot whose sole is steeper than this where it stands does not stand on it: cosine of 30°.
const STEEPEST: f64 = 0.866;

const FEET: [&str; 2] = ["right_foot", "left_foot"];

/// The capture as a motion of our bones, from 0 s and the standing place on: a key for each frame and,
/// where those are few and the skeleton knows its soles, keys between.
///
/// Joint limits are not kept: [`Motion::beyond_limits`] tells where they are exceeded.
///
/// # Errors
/// [`RetargetError`] where mapping, capture and skeleton do not belong together.
pub fn retarget(
    source: &Bvh,
    mapping: &Mapping,
    skeleton: &Skeleton,
) -> Result<Motion, RetargetError> {
    let actor = Actor::find(source, mapping)?;
    let mut follower = Follower::new(&actor, source, mapping, skeleton)?;
    for [upper, fore] in ARMS {
        follower.bend_ahead(&actor, skeleton, [upper, fore]);
    }
    let actor_leg = follower.actor_leg(&actor.unturned())?;
    let scale = leg(skeleton)? / actor_leg;
    let step = source.frame_time;
    let joints = Joints {
        actor: &actor,
        source,
        mapping,
    };
    // A foot without a ball is its ankle.
    let foot = |side: usize| {
        let [_, _, ankle] = follower.legs[side];
        [ankle, joints.tip(FEET[side]).unwrap_or(ankle)]
    };
    let treads = treads(&actor, [foot(0), foot(1)], actor_leg, step);
    if !skeleton.soles().is_empty() {
        for (foot, treads) in FEET.iter().zip(&treads) {
            follower.stand_flat(&actor, skeleton.bone(foot), treads);
        }
    }
    let mut keys: Vec<Key> = Vec::with_capacity(source.frames.len());
    for (index, stance) in actor.frames().enumerate() {
        let mut posture = follower.posture(&stance, skeleton);
        posture.root.translation.vector *= scale;
        let time = index as f64 * step;
        keys.push(Key { time, posture });
    }
    begin_above_standing_place(&mut keys, skeleton);
    let motion = Motion::new(mapping.name.clone(), keys, None, skeleton)?;
    let keys = tread_on(&motion, skeleton, &treads, step)
        .unwrap_or_else(|| stood_on_lowest_ankle(motion.keys(), skeleton));
    Ok(Motion::new(mapping.name.clone(), keys, None, skeleton)?)
}

/// Moves keys on the floor, so that the first is where the person stands.
fn begin_above_standing_place(keys: &mut [Key], skeleton: &Skeleton) {
    let start = keys.first().map(|key| key.posture.root.translation.vector);
    let mut shift = skeleton.base() - start.unwrap_or_default();
    shift.z = 0.0;
    for key in keys {
        key.posture.root.translation.vector += shift;
    }
}

/// Keys moved up or down, so that the lowest ankle of all is where a standing person's is.
fn stood_on_lowest_ankle(keys: &[Key], skeleton: &Skeleton) -> Vec<Key> {
    let ankles = ["right_shank", "left_shank"].map(|bone| skeleton.bone(bone));
    let ankle = |posture: &Posture| {
        let pose = skeleton.stand(posture);
        let ends = ankles
            .iter()
            .flatten()
            .filter_map(|bone| Some(skeleton.bones().get(*bone)?.end(pose.get(*bone)?).z));
        ends.fold(f64::INFINITY, f64::min)
    };
    let lowest = keys.iter().map(|key| ankle(&key.posture));
    let rise = ankle(&Posture::standing(skeleton)) - lowest.fold(f64::INFINITY, f64::min);
    let mut keys = keys.to_vec();
    for key in &mut keys {
        key.posture.root.translation.vector.z += rise;
    }
    keys
}

/// What moves each of our bones.
pub(super) struct Follower {
    bones: Vec<Option<Track>>,
    /// The joints of both hips, knees and ankles, right then left.
    legs: [[Tip; 3]; 2],
}

/// What moves one bone.
struct Track {
    joint: usize,
    twist: usize,
    /// Where it ends, for a bone that points where the actor's does.
    tip: Option<Tip>,
    /// From our standing bone to the actor's as built.
    built: Rotation,
    /// Our standing bone.
    vector: Vec3,
}

/// A point of the actor.
#[derive(Clone, Copy)]
pub(super) enum Tip {
    Joint(usize),
    /// From a joint, unturned.
    From(usize, Vec3),
}

impl Tip {
    pub(super) fn place(self, stance: &Stance) -> Vec3 {
        let place = |joint: usize| stance.places.get(joint).copied().unwrap_or_default();
        match self {
            Self::Joint(joint) => place(joint),
            Self::From(joint, vector) => {
                place(joint) + stance.turns.get(joint).copied().unwrap_or_default() * vector
            }
        }
    }
}

impl Follower {
    pub(super) fn new(
        actor: &Actor<'_>,
        source: &Bvh,
        mapping: &Mapping,
        skeleton: &Skeleton,
    ) -> Result<Self, RetargetError> {
        for (bone, joint) in mapping.joints() {
            if source.joint(joint).is_none() {
                let (bone, joint) = (bone.to_owned(), joint.to_owned());
                return Err(RetargetError::NoJoint { bone, joint });
            }
        }
        let unturned = actor.unturned();
        let joints = Joints {
            actor,
            source,
            mapping,
        };
        // What goes with its parent hands on how that is built.
        let mut built: Vec<Rotation> = Vec::new();
        let mut bones: Vec<Option<Track>> = Vec::new();
        for bone in skeleton.bones() {
            let above = bone.parent.and_then(|parent| built.get(parent)).copied();
            let above = above.unwrap_or_default();
            let turns = bone.parent.is_none() || bone.joint.turns();
            let track = joints.track(bone, above, &unturned).filter(|_| turns);
            built.push(track.as_ref().map_or(above, |track| track.built));
            bones.push(track);
        }
        if bones.first().is_none_or(Option::is_none) {
            return Err(RetargetError::NotMapped { bone: "pelvis" });
        }
        let leg = |thigh, shank| {
            let start = |bone: &'static str| {
                let missing = RetargetError::NotMapped { bone };
                let joint = mapping
                    .source(bone)
                    .and_then(|given| source.joint(&given.joint));
                joint.map(Tip::Joint).ok_or(missing)
            };
            let none = RetargetError::NoLength { limb: "leg" };
            let ankle = joints.tip(shank).ok_or(none)?;
            Ok::<_, RetargetError>([start(thigh)?, start(shank)?, ankle])
        };
        let legs = [
            leg("right_thigh", "right_shank")?,
            leg("left_thigh", "left_shank")?,
        ];
        Ok(Self { bones, legs })
    }

    /// The middle of the hips.
    pub(super) fn hips(&self, stance: &Stance) -> Vec3 {
        let [[right, ..], [left, ..]] = self.legs;
        (right.place(stance) + left.place(stance)) / 2.0
    }

    /// Hip, knee and ankle of the right leg, then of the left.
    pub(super) fn legs(&self) -> [[Tip; 3]; 2] {
        self.legs
    }

    /// From hip to ankle along the bones, both legs' mean.
    pub(super) fn actor_leg(&self, stance: &Stance) -> Result<f64, RetargetError> {
        let length = |[hip, knee, ankle]: [Tip; 3]| {
            let [hip, knee, ankle] = [hip, knee, ankle].map(|tip| tip.place(stance));
            (knee - hip).norm() + (ankle - knee).norm()
        };
        let mean = self.legs.map(length).iter().sum::<f64>() / 2.0;
        if mean > 0.0 {
            Ok(mean)
        } else {
            Err(RetargetError::NoLength { limb: "leg" })
        }
    }

    /// Turns a foot as built, so that where the actor's stands flat its sole is level on the whole.
    fn stand_flat(&mut self, actor: &Actor<'_>, foot: Option<usize>, treads: &[Tread]) {
        let Some(Some(track)) = foot.and_then(|foot| self.bones.get_mut(foot)) else {
            return;
        };
        let flat = actor
            .frames()
            .zip(treads)
            .filter(|(_, tread)| tread.is_flat);
        let ups = flat.map(|(stance, _)| track.turn(&stance).inverse() * Vec3::z());
        let up: Vec3 = ups.sum();
        if up.z > STEEPEST * up.norm() {
            track.built *= swing(&Vec3::z(), &up);
        }
    }

    /// Twists an upper arm as built, so that on the whole its elbow bends about the hinge that it has:
    /// the mean over all frames, each with the weight of its bend's sine squared.
    fn bend_ahead(&mut self, actor: &Actor<'_>, skeleton: &Skeleton, arm: [&str; 2]) {
        let [Some(upper), Some(fore)] = arm.map(|bone| skeleton.bone(bone)) else {
            return;
        };
        let track = |bone: usize| self.bones.get(bone).and_then(Option::as_ref);
        let (Some(above), Some(below)) = (track(upper), track(fore)) else {
            return;
        };
        let Some(hinge) = skeleton.bones().get(fore).map(|bone| bone.joint.axes[0]) else {
            return;
        };
        let along = above.vector.normalize();
        let across = along.cross(&hinge);
        let (mut sine, mut cosine) = (0.0, 0.0);
        for stance in actor.frames() {
            let (Some(arm), Some(forearm)) = (above.along(&stance), below.along(&stance)) else {
                return;
            };
            let size = arm.norm() * forearm.norm();
            if size > 0.0 {
                let bend = above.turn(&stance).inverse() * arm.cross(&forearm) / size;
                let weight = bend.norm();
                sine += weight * bend.dot(&across);
                cosine += weight * bend.dot(&hinge);
            }
        }
        let count = actor.count() as f64;
        if (sine * sine + cosine * cosine).sqrt() < LEAST_BEND * count {
            return;
        }
        let twist = turn(&(along * libm::atan2(sine, cosine)));
        if let Some(Some(track)) = self.bones.get_mut(upper) {
            track.built *= twist;
        }
    }

    /// Our posture in a stance; the root's place is the actor's, in the file's unit.
    fn posture(&self, stance: &Stance, skeleton: &Skeleton) -> Posture {
        let mut worlds: Vec<Rotation> = Vec::with_capacity(self.bones.len());
        let mut joints = Vec::with_capacity(self.bones.len());
        for (bone, track) in skeleton.bones().iter().zip(&self.bones) {
            let above = bone.parent.and_then(|parent| worlds.get(parent)).copied();
            let above = above.unwrap_or_default();
            let world = track.as_ref().map_or(above, |track| track.turn(stance));
            joints.push(above.inverse() * world);
            worlds.push(world);
        }
        let root = worlds.first().copied().unwrap_or_default();
        if let Some(first) = joints.first_mut() {
            *first = Rotation::identity();
        }
        Posture {
            root: Pose::from_parts(self.hips(stance).into(), root),
            joints,
        }
    }
}

impl Track {
    /// From its start to its end, for a bone that points where the actor's does.
    fn along(&self, stance: &Stance) -> Option<Vec3> {
        let tip = self.tip?;
        Some(tip.place(stance) - Tip::Joint(self.joint).place(stance))
    }

    /// How our bone is turned in space.
    fn turn(&self, stance: &Stance) -> Rotation {
        let turned = stance.turns.get(self.twist).copied().unwrap_or_default() * self.built;
        let along = self
            .tip
            .map(|tip| tip.place(stance) - Tip::Joint(self.joint).place(stance));
        along.map_or(turned, |along| {
            swing(&(turned * self.vector), &along) * turned
        })
    }
}

/// A capture's joints, as a mapping names them.
pub(super) struct Joints<'a> {
    pub(super) actor: &'a Actor<'a>,
    pub(super) source: &'a Bvh,
    pub(super) mapping: &'a Mapping,
}

impl Joints<'_> {
    /// What moves a bone whose parent is built so.
    fn track(&self, bone: &Bone, above: Rotation, unturned: &Stance) -> Option<Track> {
        let given = self.mapping.source(&bone.name)?;
        let joint = self.source.joint(&given.joint)?;
        let twist = given.twist.as_deref();
        let twist = twist.and_then(|twist| self.source.joint(twist));
        let tip = points(&bone.name).then(|| self.tip(&bone.name)).flatten();
        let mut track = Track {
            joint,
            twist: twist.unwrap_or(joint),
            tip,
            built: above,
            vector: bone.vector,
        };
        // Unturned, the swing alone is what the actor is built with.
        track.built = track.turn(unturned);
        Some(track)
    }

    /// Where the joint of a bone is.
    pub(super) fn start(&self, bone: &str) -> Option<Tip> {
        let given = self.mapping.source(bone)?;
        self.source.joint(&given.joint).map(Tip::Joint)
    }

    /// Where a bone ends.
    pub(super) fn tip(&self, bone: &str) -> Option<Tip> {
        let given = self.mapping.source(bone)?;
        let named = given.end.as_deref().or_else(|| {
            let next = self.mapping.source(next(bone)?)?;
            Some(next.joint.as_str())
        });
        if let Some(end) = named.and_then(|name| self.source.joint(name)) {
            return Some(Tip::Joint(end));
        }
        let joint = self.source.joint(&given.joint)?;
        let mut joints = self.source.joints.iter();
        let child = joints.position(|child| child.parent == Some(joint));
        let site = || Some(Tip::From(joint, self.actor.end_site(joint)?));
        child.map(Tip::Joint).or_else(site)
    }
}

/// Whether a bone points where the actor's does.
fn points(bone: &str) -> bool {
    let limb = bone
        .trim_start_matches("right_")
        .trim_start_matches("left_");
    matches!(limb, "upper_arm" | "forearm" | "hand" | "thigh" | "shank")
}

/// The bone that hangs on a limb's end.
fn next(bone: &str) -> Option<&'static str> {
    Some(match bone {
        "right_upper_arm" => "right_forearm",
        "left_upper_arm" => "left_forearm",
        "right_forearm" => "right_hand",
        "left_forearm" => "left_hand",
        "right_thigh" => "right_shank",
        "left_thigh" => "left_shank",
        "right_shank" => "right_foot",
        "left_shank" => "left_foot",
        _ => return None,
    })
}

/// The shortest turn from one direction to another; none where one has no length.
fn swing(from: &Vec3, to: &Vec3) -> Rotation {
    let axis = from.cross(to);
    let (sine, cosine) = (axis.norm(), from.dot(to));
    let size = from.norm() * to.norm();
    if sine > 1e-12 * size {
        return turn(&(axis * (libm::atan2(sine, cosine) / sine)));
    }
    if cosine >= 0.0 || size == 0.0 {
        return Rotation::identity();
    }
    // Straight back: about any axis across.
    let beside = if from.x.abs() < 0.5 * from.norm() {
        Vec3::x()
    } else {
        Vec3::y()
    };
    turn(&(from.cross(&beside).normalize() * core::f64::consts::PI))
}

/// From hip to ankle along our bones, both legs' mean [cm].
///
/// # Errors
/// [`RetargetError::NoBone`] where a thigh or a shank is missing.
pub fn leg(skeleton: &Skeleton) -> Result<f64, RetargetError> {
    let length = |bone: &'static str| {
        let found = skeleton
            .bone(bone)
            .and_then(|index| skeleton.bones().get(index));
        found
            .map(|bone_of| bone_of.vector.norm())
            .ok_or(RetargetError::NoBone { bone })
    };
    let right = length("right_thigh")? + length("right_shank")?;
    let left = length("left_thigh")? + length("left_shank")?;
    Ok((right + left) / 2.0)
}
