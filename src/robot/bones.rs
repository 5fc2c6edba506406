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
        Ok(Skeleton::new(base, list.0)?)
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
mod tests {
    use super::*;
    use crate::robot::{
        Lengths,
        sample::{child, everyone, man, woman},
    };

    /// Where every bone begins, standing: vectors added up.
    fn starts(skeleton: &Skeleton) -> Vec<Vec3> {
        let mut starts: Vec<Vec3> = Vec::new();
        for bone in skeleton.bones() {
            starts.push(match bone.parent {
                None => skeleton.base(),
                Some(parent) if bone.at_base => starts[parent],
                Some(parent) => starts[parent] + skeleton.bones()[parent].vector,
            });
        }
        starts
    }

    fn end(skeleton: &Skeleton, name: &str) -> Vec3 {
        let bone = skeleton.bone(name).unwrap();
        starts(skeleton)[bone] + skeleton.bones()[bone].vector
    }

    #[test]
    fn bones_add_up_to_stature_sitting_height_and_shoulder_width() {
        for person in everyone() {
            let skeleton = person.skeleton().unwrap();
            assert_eq!(skeleton.bones().len(), 21);
            assert!((end(&skeleton, "head").z - person.stature).abs() < 1e-9);
            let toes = end(&skeleton, "left_foot");
            assert!((0.0..1.8).contains(&toes.z) && toes.y < -10.0, "{toes}");
            let [left, right] =
                ["left", "right"].map(|side| end(&skeleton, &format!("{side}_clavicle")));
            let tips = (left - right).x + 0.02 * person.stature;
            assert!((tips - person.shoulder_width).abs() < 1e-9, "{tips}");
            assert!((left.z - right.z).abs() < 1e-12);
        }
    }

    /// AIST 1997–98: heights and lengths of bodies of 158 (between 155 and 160) and 170 cm.
    #[test]
    fn lengths_are_those_of_the_surveys() {
        let near = |ours: f64, theirs: f64, within: f64, what: &str| {
            assert!(
                (ours - theirs).abs() < within,
                "{what}: {ours:.1} cm, AIST {theirs} cm"
            );
        };
        let (woman, man) = (Levels::of(&woman()).unwrap(), Levels::of(&man()).unwrap());
        near(woman.acromion, 127.2, 1.0, "a woman's acromion");
        near(man.acromion, 137.1, 1.0, "a man's acromion");
        near(woman.head, 23.1, 0.3, "a woman's head");
        near(man.head, 23.9, 0.3, "a man's head");
        near(woman.crotch, 71.8, 0.5, "a woman's crotch");
        near(man.crotch, 78.3, 0.5, "a man's crotch");
        near(man.ankle + man.shank, 46.5, 1.5, "a man's knee, below it");
        near(man.forearm, 23.9, 0.3, "a man's forearm");
        near(man.hand, 18.1, 0.3, "a man's hand");
        // Wrist height 0.485 of the stature (Drillis and Contini).
        let wrist = man.shoulder - man.upper_arm - man.forearm;
        near(wrist, 0.485 * 170.0, 1.5, "a man's wrist");
    }

    #[test]
    fn a_length_that_is_given_wins() {
        let mut person = child();
        person.lengths.thigh = Some(26.0);
        person.lengths.hand = Some(14.0);
        person.lengths.lumbar = Some(12.0);
        let skeleton = person.skeleton().unwrap();
        for (name, length) in [("left_thigh", 26.0), ("right_hand", 14.0), ("lumbar", 12.0)] {
            let bone = &skeleton.bones()[skeleton.bone(name).unwrap()];
            assert!((bone.vector.norm() - length).abs() < 1e-9, "{name}");
        }
        assert!((end(&skeleton, "head").z - 120.0).abs() < 1e-9);
    }

    #[test]
    fn lengths_that_do_not_add_up_are_refused() {
        let said = |change: fn(&mut Lengths)| {
            let mut person = woman();
            change(&mut person.lengths);
            person.skeleton().unwrap_err().to_string()
        };
        assert_eq!(
            said(|l| (l.thigh, l.shank) = (Some(50.0), Some(50.0))),
            "lengths.shank is 50 cm; allowed: 20.8 to 29.5 cm beside that thigh"
        );
        assert_eq!(
            said(|l| (l.pelvis, l.lumbar, l.thorax) = (Some(10.0), Some(20.0), Some(30.0))),
            "lengths.thorax is 30 cm; allowed: 17.5 to 18.5 cm beside the other lengths"
        );
        assert!(said(|l| l.lumbar = Some(f64::NAN)).contains("lengths.lumbar is NaN"));
    }

    /// Which way the end of a bone goes for a positive angle, as anatomy has it: the left half.
    #[test]
    fn positive_angles_go_the_anatomical_way() {
        let skeleton = woman().skeleton().unwrap();
        let (front, back, left, up) = (-Vec3::y(), Vec3::y(), Vec3::x(), Vec3::z());
        let right = -left;
        // Joint, angle, what is looked at (its own bone, or another vector), where it goes.
        let rows: [(&str, usize, Option<Vec3>, Vec3); 24] = [
            ("waist", 0, None, front),
            ("chest", 1, None, left),
            ("chest", 2, Some(front), left),
            ("neck", 0, None, front),
            ("head", 2, Some(front), left),
            ("left_clavicle", 0, None, front),
            ("left_clavicle", 1, None, up),
            ("right_clavicle", 0, None, front),
            ("right_clavicle", 1, None, up),
            ("left_shoulder", 0, None, front),
            ("left_shoulder", 1, None, left),
            ("left_shoulder", 2, Some(front), right),
            ("right_shoulder", 1, None, right),
            ("right_shoulder", 2, Some(front), left),
            ("left_elbow", 0, None, front),
            ("left_elbow", 2, Some(front), right),
            ("right_elbow", 2, Some(front), left),
            ("left_wrist", 0, None, right),
            ("right_wrist", 0, None, left),
            ("left_wrist", 1, None, front),
            ("left_hip", 0, None, front),
            ("right_hip", 1, None, right),
            ("left_knee", 0, None, back),
            ("right_ankle", 0, None, up),
        ];
        for (name, which, seen, goes) in rows {
            let bone = &skeleton.bones()[skeleton.joint(name).unwrap()];
            let mut angles = [0.0; 3];
            angles[which] = 0.3;
            let seen = seen.unwrap_or(bone.vector.normalize());
            let moved = bone.joint.rotation(angles) * seen - seen;
            assert!(
                moved.dot(&goes) > 0.2,
                "{name} {}",
                bone.joint.angles[which]
            );
        }
        // The soles turn outward: their normals, which point down.
        for (side, outward) in [("left", left), ("right", right)] {
            let name = format!("{side}_ankle");
            let joint = &skeleton.bones()[skeleton.joint(&name).unwrap()].joint;
            assert!((joint.rotation([0.0, 0.3, 0.0]) * -up).dot(&outward) > 0.2);
        }
    }

    #[test]
    fn axes_stand_at_right_angles_and_limits_hold_the_standing_posture() {
        for bone in woman().skeleton().unwrap().bones() {
            let [a, b, c] = bone.joint.axes;
            for (one, other) in [(a, b), (b, c), (c, a)] {
                assert!(one.dot(&other).abs() < 1e-12, "{}", bone.name);
            }
            assert!(
                bone.joint
                    .axes
                    .iter()
                    .all(|axis| (axis.norm() - 1.0).abs() < 1e-12)
            );
            assert_eq!(bone.joint.exceeded([0.0; 3]).count(), 0);
        }
    }

    /// 180° from hanging: collar bone 30°, shoulder 150° less what the arm hangs outward.
    #[test]
    fn an_arm_reaches_overhead_within_its_limits() {
        let skeleton = woman().skeleton().unwrap();
        let joint = |name: &str| &skeleton.bones()[skeleton.joint(name).unwrap()].joint;
        let arm = skeleton.bones()[skeleton.bone("left_upper_arm").unwrap()].vector;
        let (collar, shoulder) = ([0.0, 30.0, 0.0], [0.0, 142.0, 0.0]);
        let [collar, shoulder] = [collar, shoulder].map(|angles| angles.map(f64::to_radians));
        assert_eq!(joint("left_clavicle").exceeded(collar).count(), 0);
        assert_eq!(joint("left_shoulder").exceeded(shoulder).count(), 0);
        let turn =
            joint("left_clavicle").rotation(collar) * joint("left_shoulder").rotation(shoulder);
        assert!((turn * arm.normalize() - Vec3::z()).norm() < 1e-9);
    }

    #[test]
    fn a_body_may_do_without_a_head() {
        let mut person = man();
        person.head = false;
        let skeleton = person.skeleton().unwrap();
        assert_eq!((skeleton.bone("neck"), skeleton.bone("head")), (None, None));
        assert_eq!(skeleton.bones().len(), 19);
    }
}
