//! The bones of a measured person (paper B-i): their lengths, how they stand, how they may turn.
//!
//! Angles are counted from the standing posture, in which the arms hang a little outward, beside
//! the trunk and not in it: the upper arm by [`UPPER_ARM_OUT`], the forearm by [`FOREARM_OUT`];
//! legs close in a little from hips to knees, as a thigh bone does.
//!
//! Ranges are those of the American Academy of Orthopaedic Surgeons and the American Medical
//! Association (Norkin and White, table A.1), those of spine and legs from memory of the same. Where a body
//! shares a range among joints that we have apart:
//! - an arm goes up by 180°: the shoulder's ball 120°, the shoulder blade 60°, of which the collar
//!   bone lifts one half and the blade's turn against it is the other (Inman, 1944). So the shoulder
//!   abducts by 150° and the collar bone rises by at least 30°; its joint has 45° (from memory).
//!   Forward the collar bone cannot help, for it turns across: flexion is the shoulder's alone, 180°;
//! - the trunk bends 80°/25°/35°/45° (forward, back, side, turn), mostly below for bending and
//!   mostly above for turning: the lumbar joints' facets stand along, the thoracic ones' across;
//! - the neck 45°/45°/45°/60°: the skull's joints nod, and give two thirds of the turn.

use super::{
    extremities::soles,
    levels::Levels,
    measurements::{InvalidMeasurement, Measurements},
};
use crate::{
    math::Vec3,
    skeleton::{Bone, InvalidSkeleton, Joint, Skeleton},
};
use core::f64::consts::PI;

/// A person of whom there is no body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidPerson {
    /// A measurement is outside its range.
    #[error(transparent)]
    Measurement(#[from] InvalidMeasurement),
    /// Its bones are no skeleton.
    #[error(transparent)]
    Skeleton(#[from] InvalidSkeleton),
    /// Its flesh is not as a tape should find it.
    #[error(
        "{girth} girth comes to {built:.1} cm, not {asked} cm; allowed: girths nearer to each other"
    )]
    Girth {
        /// Which girth.
        girth: super::Girth,
        /// What came of it [cm].
        built: f64,
        /// What was asked for [cm].
        asked: f64,
    },
}

/// How far the upper arm hangs outward [rad]: 8°, so that it is beside the chest.
const UPPER_ARM_OUT: f64 = 8.0 * PI / 180.0;
/// How far the forearm and the hand hang outward [rad].
const FOREARM_OUT: f64 = 3.0 * PI / 180.0;
/// Distance of the hip joints over the breadth of the hips: 17 cm of 32 (from memory of anatomy).
const HIP_JOINTS: f64 = 0.53;
/// Distance of the knees over that of the hip joints.
const KNEES: f64 = 0.85;
/// The shoulder joint is this much of the stature inside the tip of the shoulder.
const SHOULDER_INSIDE: f64 = 0.01;
/// The ankle stands over the foot at this share of its length from the heel.
pub(super) const ANKLE_FROM_HEEL: f64 = 0.25;
/// Half the thickness of the toes, as a share of the foot's length.
pub(super) const TOES: f64 = 0.06;

/// Least and greatest angle of each [degrees].
type Limits = [[f64; 2]; 3];

const FIXED: Limits = [[0.0; 2]; 3];
const WAIST: Limits = [[-15.0, 50.0], [-20.0, 20.0], [-15.0, 15.0]];
const CHEST: Limits = [[-10.0, 30.0], [-15.0, 15.0], [-30.0, 30.0]];
const NECK: Limits = [[-25.0, 25.0], [-30.0, 30.0], [-20.0, 20.0]];
const HEAD: Limits = [[-20.0, 20.0], [-15.0, 15.0], [-40.0, 40.0]];
const CLAVICLE: Limits = [[-20.0, 20.0], [-10.0, 45.0], [0.0; 2]];
const SHOULDER: Limits = [[-60.0, 180.0], [-50.0, 150.0], [-90.0, 70.0]];
const ELBOW: Limits = [[0.0, 150.0], [0.0; 2], [-80.0, 80.0]];
const WRIST: Limits = [[-70.0, 80.0], [-30.0, 20.0], [0.0; 2]];
const HIP: Limits = [[-30.0, 120.0], [-30.0, 45.0], [-45.0, 45.0]];
const KNEE: Limits = [[0.0, 135.0], [0.0; 2], [0.0; 2]];
const ANKLE: Limits = [[-50.0, 20.0], [-35.0, 20.0], [0.0; 2]];

const SPINE: [&str; 3] = ["flexion", "side", "rotation"];

impl Measurements {
    /// The bones of this person, standing.
    ///
    /// # Errors
    /// [`InvalidPerson`] where a measurement is outside its range or lengths do not add up.
    pub fn skeleton(&self) -> Result<Skeleton, InvalidPerson> {
        let levels = Levels::of(&self.clone().checked()?)?;
        let mut list = List(Vec::new());
        list.spine(&levels, self.head);
        for side in [Side::Right, Side::Left] {
            list.arm(&levels, 0.5 * self.shoulder_width, side);
            list.leg(&levels, 0.5 * HIP_JOINTS * self.hip_width, side);
        }
        let base = Vec3::new(0.0, 0.0, levels.hip_joint);
        let skeleton = Skeleton::new(base, list.0)?;
        let soles = soles(&skeleton, levels.foot);
        Ok(skeleton.with_soles(soles))
    }
}

/// One half of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The person's right, x < 0.
    Right,
    /// The person's left, x > 0.
    Left,
}

impl Side {
    /// `right_thigh` of `thigh`.
    pub(super) fn of(self, name: &str) -> String {
        match self {
            Self::Right => format!("right_{name}"),
            Self::Left => format!("left_{name}"),
        }
    }

    /// A vector of the left half, on this one.
    pub(super) fn vector(self, v: Vec3) -> Vec3 {
        match self {
            Self::Right => Vec3::new(-v.x, v.y, v.z),
            Self::Left => v,
        }
    }

    /// What a turn on the left half is about, on this one: a mirror turns the other way.
    fn axis(self, v: Vec3) -> Vec3 {
        match self {
            Self::Right => Vec3::new(v.x, -v.y, -v.z),
            Self::Left => v,
        }
    }
}

/// Bones as they are added, parents first.
struct List(Vec<Bone>);

impl List {
    fn add(&mut self, name: &str, parent: Option<&str>, vector: Vec3, joint: Joint) {
        let parent = parent.and_then(|parent| self.0.iter().position(|bone| bone.name == parent));
        self.0.push(Bone {
            name: name.into(),
            parent,
            at_base: false,
            vector,
            joint,
        });
    }

    fn spine(&mut self, levels: &Levels, head: bool) {
        let up = |length: f64| Vec3::new(0.0, 0.0, length);
        let bend = |name, limits| joint(name, SPINE, [Vec3::x(), Vec3::y(), Vec3::z()], limits);
        self.add("pelvis", None, up(levels.pelvis), bend("root", FIXED));
        self.add(
            "lumbar",
            Some("pelvis"),
            up(levels.lumbar),
            bend("waist", WAIST),
        );
        self.add(
            "thorax",
            Some("lumbar"),
            up(levels.thorax),
            bend("chest", CHEST),
        );
        if head {
            let neck = levels.skull - levels.collar;
            self.add("neck", Some("thorax"), up(neck), bend("neck", NECK));
            let rest = levels.stature - levels.skull;
            self.add("head", Some("neck"), up(rest), bend("head", HEAD));
        }
    }

    fn arm(&mut self, levels: &Levels, half_width: f64, side: Side) {
        let inside = SHOULDER_INSIDE * levels.stature;
        let across = Vec3::new(half_width - inside, 0.0, levels.shoulder - levels.collar);
        let upper_arm = hanging(levels.upper_arm, UPPER_ARM_OUT);
        let forearm = hanging(levels.forearm, FOREARM_OUT);
        let hand = hanging(levels.hand, FOREARM_OUT);
        // Forward about the first, outward (or up) about the second, inward about the bone.
        let outward = |bone: &Vec3| {
            let along = bone.normalize();
            [along.cross(&-Vec3::y()), -Vec3::y(), along]
        };
        let [towards_thumb, _, along_hand] = outward(&hand);
        let joints = [
            (
                "clavicle",
                "thorax",
                across,
                "clavicle",
                ["protraction", "elevation", "rotation"],
                outward(&across),
                CLAVICLE,
            ),
            (
                "upper_arm",
                "clavicle",
                upper_arm,
                "shoulder",
                ["flexion", "abduction", "rotation"],
                outward(&upper_arm),
                SHOULDER,
            ),
            (
                "forearm",
                "upper_arm",
                forearm,
                "elbow",
                ["flexion", "carrying", "pronation"],
                outward(&forearm),
                ELBOW,
            ),
            // The palm faces the thigh: it bends to the body, and its thumb is in front.
            (
                "hand",
                "forearm",
                hand,
                "wrist",
                ["flexion", "deviation", "rotation"],
                [Vec3::y(), towards_thumb, along_hand],
                WRIST,
            ),
        ];
        for (bone, parent, vector, name, angles, axes, limits) in joints {
            self.half(
                side,
                bone,
                parent,
                vector,
                joint(name, angles, axes, limits),
            );
        }
    }

    fn leg(&mut self, levels: &Levels, hip: f64, side: Side) {
        let inward = (KNEES - 1.0) * hip;
        let down = (levels.thigh * levels.thigh - inward * inward)
            .max(0.0)
            .sqrt();
        let thigh = Vec3::new(inward, 0.0, -down);
        let shank = Vec3::new(0.0, 0.0, -levels.shank);
        let toes = TOES * levels.foot;
        let foot = Vec3::new(
            0.0,
            -(1.0 - ANKLE_FROM_HEEL) * levels.foot + toes,
            toes - levels.ankle,
        );
        let along = thigh.normalize();
        let forward = along.cross(&-Vec3::y());
        let straight = [-Vec3::x(), -Vec3::y(), -Vec3::z()];
        let [forward_straight, outward, down] = straight;
        let joints = [
            (
                "hip_bone",
                "pelvis",
                Vec3::new(hip, 0.0, 0.0),
                "hip_bone",
                ["flexion", "abduction", "rotation"],
                straight,
                FIXED,
            ),
            (
                "thigh",
                "hip_bone",
                thigh,
                "hip",
                ["flexion", "abduction", "rotation"],
                [forward, outward, along],
                HIP,
            ),
            (
                "shank",
                "thigh",
                shank,
                "knee",
                ["flexion", "side", "rotation"],
                [-forward_straight, outward, down],
                KNEE,
            ),
            (
                "foot",
                "shank",
                foot,
                "ankle",
                ["flexion", "eversion", "rotation"],
                straight,
                ANKLE,
            ),
        ];
        for (bone, parent, vector, name, angles, axes, limits) in joints {
            self.half(
                side,
                bone,
                parent,
                vector,
                joint(name, angles, axes, limits),
            );
        }
    }

    /// Adds a bone of one half, of which all is said for the left.
    fn half(&mut self, side: Side, bone: &str, parent: &str, vector: Vec3, mut joint: Joint) {
        joint.name = side.of(&joint.name);
        joint.axes = joint.axes.map(|axis| side.axis(axis));
        let at_base = parent == "pelvis";
        let parent = match parent {
            "pelvis" | "thorax" => parent.to_owned(),
            _ => side.of(parent),
        };
        self.add(&side.of(bone), Some(&parent), side.vector(vector), joint);
        if let Some(added) = self.0.last_mut() {
            added.at_base = at_base;
        }
    }
}

/// A bone of the left half that hangs, turned outward by an angle [rad].
fn hanging(length: f64, outward: f64) -> Vec3 {
    let (sine, cosine) = libm::sincos(outward);
    Vec3::new(length * sine, 0.0, -length * cosine)
}

fn joint(name: &str, angles: [&'static str; 3], axes: [Vec3; 3], limits: Limits) -> Joint {
    Joint {
        name: name.into(),
        angles,
        axes,
        limits: limits.map(|pair| pair.map(f64::to_radians)),
    }
}

#[cfg(test)]
mod tests;
