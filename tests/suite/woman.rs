//! The skeleton of a woman of 158 cm, by hand: 21 bones, lengths of AIST's young women (acromion at
//! 0.806 of stature, hip joints at 81 cm, 17 cm apart), limits of Norkin & White's and the AAOS's
//! tables, those of the trunk and the neck shared out over their two joints.

use crate::skeleton::by_hand;
use soen::{
    math::Vec3,
    skeleton::{Bone, Joint, Posture, Skeleton},
};

type Limits = [[f64; 2]; 3];

const FIXED: Limits = [[0.0, 0.0]; 3];
const WAIST: Limits = [[-15.0, 50.0], [-20.0, 20.0], [-10.0, 10.0]];
const CHEST: Limits = [[-10.0, 30.0], [-15.0, 15.0], [-35.0, 35.0]];
const NECK: Limits = [[-20.0, 20.0], [-20.0, 20.0], [-25.0, 25.0]];
const HEAD: Limits = [[-25.0, 25.0], [-25.0, 25.0], [-35.0, 35.0]];
const CLAVICLE: Limits = [[-20.0, 25.0], [-10.0, 45.0], [0.0, 0.0]];
const SHOULDER: Limits = [[-60.0, 180.0], [-50.0, 180.0], [-90.0, 70.0]];
const ELBOW: Limits = [[0.0, 150.0], [0.0, 0.0], [-80.0, 80.0]];
const WRIST: Limits = [[-70.0, 80.0], [-30.0, 20.0], [0.0, 0.0]];
const HIP: Limits = [[-30.0, 120.0], [-30.0, 45.0], [-45.0, 45.0]];
const KNEE: Limits = [[0.0, 135.0], [0.0, 0.0], [0.0, 0.0]];
const ANKLE: Limits = [[-50.0, 20.0], [-35.0, 20.0], [0.0, 0.0]];

const SPINE_ANGLES: [&str; 3] = ["flexion", "side", "rotation"];
const LIMB_ANGLES: [&str; 3] = ["flexion", "abduction", "rotation"];

/// She, standing.
pub(crate) fn woman() -> Skeleton {
    let mut bones = vec![spine("pelvis", None, "root", 14.0, FIXED)];
    bones.push(spine("lumbar", Some(0), "waist", 15.0, WAIST));
    bones.push(spine("thorax", Some(1), "chest", 20.0, CHEST));
    bones.push(spine("neck", Some(2), "neck", 8.0, NECK));
    bones.push(spine("head", Some(3), "head", 20.0, HEAD));
    for (side, left) in [("right", -1.0), ("left", 1.0)] {
        arm(&mut bones, side, left);
    }
    for (side, left) in [("right", -1.0), ("left", 1.0)] {
        leg(&mut bones, side, left);
    }
    Skeleton::new(Vec3::new(0.0, 0.0, 81.2), bones).unwrap()
}

fn spine(name: &str, parent: Option<usize>, joint: &str, length: f64, limits: Limits) -> Bone {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    Bone {
        name: name.into(),
        parent,
        at_base: false,
        vector: Vec3::z() * length,
        joint: joint_of(joint.into(), SPINE_ANGLES, axes, limits),
    }
}

/// `left` is 1 for the left arm and −1 for the right, whose axes are mirrored.
fn arm(bones: &mut Vec<Bone>, side: &str, left: f64) {
    let [x, y, z] = [Vec3::x(), Vec3::y() * left, Vec3::z() * left];
    let hanging = |length: f64| -Vec3::z() * length;
    let clavicle = ["protraction", "elevation", "rotation"];
    let forearm = ["flexion", "carrying", "pronation"];
    let hand = ["flexion", "deviation", "rotation"];
    let thorax = 2;
    let down = Vec3::new(16.4 * left, 0.0, -6.0);
    let axes = [-z, -y, x * left];
    let mut add = |name: &str, joint: &str, parent, vector, angles, axes, limits| {
        bones.push(Bone {
            name: format!("{side}_{name}"),
            parent: Some(parent),
            at_base: false,
            vector,
            joint: joint_of(format!("{side}_{joint}"), angles, axes, limits),
        });
        bones.len() - 1
    };
    let up = add(
        "clavicle", "clavicle", thorax, down, clavicle, axes, CLAVICLE,
    );
    let axes = [-x, -y, -z];
    let vector = hanging(28.1);
    let up = add(
        "upper_arm",
        "shoulder",
        up,
        vector,
        LIMB_ANGLES,
        axes,
        SHOULDER,
    );
    let up = add("forearm", "elbow", up, hanging(22.3), forearm, axes, ELBOW);
    add("hand", "wrist", up, hanging(16.8), hand, [y, -x, -z], WRIST);
}

fn leg(bones: &mut Vec<Bone>, side: &str, left: f64) {
    let [x, y, z] = [Vec3::x(), Vec3::y() * left, Vec3::z() * left];
    let ankle = ["flexion", "eversion", "rotation"];
    let mut add = |name: &str, joint: &str, parent, vector, angles, axes, limits| {
        bones.push(Bone {
            name: format!("{side}_{name}"),
            parent: Some(parent),
            at_base: parent == 0,
            vector,
            joint: joint_of(format!("{side}_{joint}"), angles, axes, limits),
        });
        bones.len() - 1
    };
    let axes = [-x, -y, -z];
    let out = x * (8.3 * left);
    let shank = -Vec3::z() * 37.5;
    let up = add("hip_bone", "hip_bone", 0, out, LIMB_ANGLES, axes, FIXED);
    let up = add("thigh", "hip", up, shank, LIMB_ANGLES, axes, HIP);
    let up = add("shank", "knee", up, shank, SPINE_ANGLES, [x, -y, -z], KNEE);
    let foot = Vec3::new(0.0, -16.0, -6.2);
    add("foot", "ankle", up, foot, ankle, axes, ANKLE);
}

fn joint_of(name: String, angles: [&'static str; 3], axes: [Vec3; 3], limits: Limits) -> Joint {
    Joint {
        name,
        angles,
        axes,
        limits: limits.map(|pair| pair.map(f64::to_radians)),
    }
}

/// Where a bone starts and ends in a posture [cm].
pub(crate) fn ends(skeleton: &Skeleton, posture: &Posture, bone: &str) -> [Vec3; 2] {
    let index = skeleton.bone(bone).unwrap();
    let pose = by_hand(skeleton, posture)[index];
    [pose.translation.vector, skeleton.bones()[index].end(&pose)]
}
