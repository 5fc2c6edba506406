//! A hand goes to where it is asked to, within the limits of its joints, or says how far off it
//! stays.

use crate::{skeleton::by_hand, woman::woman};
use soen::{
    math::{Rotation, Vec3},
    skeleton::{Joint, Posture, Skeleton},
};

/// Numbers of [0, 1), always the same: SplitMix64 (Steele, Lea & Flood 2014).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut word = self.0;
        word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((word ^ (word >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Angles within a joint's limits, its swing at most half a turn.
    fn angles(&mut self, joint: &Joint) -> [f64; 3] {
        loop {
            let angles = joint
                .limits
                .map(|[low, high]| low + self.next() * (high - low));
            if angles[0].hypot(angles[1]) < 3.1 {
                return angles;
            }
        }
    }
}

/// Where a bone's end is when the joints of these bones stand anyhow within their limits.
fn reachable(skeleton: &Skeleton, chain: &[&str], dice: &mut Dice) -> Vec3 {
    let mut posture = Posture::standing(skeleton);
    for name in chain {
        let bone = skeleton.bone(name).unwrap();
        let joint = &skeleton.bones()[bone].joint;
        posture.joints[bone] = joint.rotation(dice.angles(joint));
    }
    assert_eq!(skeleton.exceeded(&posture), []);
    let bone = skeleton.bone(chain[0]).unwrap();
    skeleton.bones()[bone].end(&skeleton.stand(&posture)[bone])
}

/// Of 200 points that an end can be at, at least 190 are reached from the standing posture.
#[track_caller]
fn reaches_19_of_20(chain: &[&str]) {
    let missed = missed_of_200(&woman(), chain);
    assert!(missed.len() <= 10, "{} misses {missed:?}", chain[0]);
}

/// Those of 200 points that an end can be at which it does not come to, and by how far; of each it is
/// told truly how far off the end stays.
#[track_caller]
pub(crate) fn missed_of_200(skeleton: &Skeleton, chain: &[&str]) -> Vec<(Vec3, f64)> {
    let standing = Posture::standing(skeleton);
    let bone = skeleton.bone(chain[0]).unwrap();
    let mut dice = Dice(1);
    let mut missed = Vec::new();
    for _ in 0..200 {
        let target = reachable(skeleton, chain, &mut dice);
        let reached = skeleton.reach(&standing, bone, &target);
        let end = skeleton.bones()[bone].end(&by_hand(skeleton, &reached.posture)[bone]);
        let miss = (end - target).norm();
        assert!(
            (miss - reached.miss).abs() < 1e-9,
            "{miss} told as {}",
            reached.miss
        );
        assert_eq!(reached.is_there(), miss <= 0.5);
        assert_eq!(skeleton.exceeded(&reached.posture), []);
        assert_eq!(reached.posture.root, standing.root);
        if !reached.is_there() {
            missed.push((target, miss));
        }
    }
    missed
}

#[test]
fn hands_reach_19_of_20_points_that_they_can() {
    for side in ["right", "left"] {
        let bones =
            ["hand", "forearm", "upper_arm", "clavicle"].map(|bone| format!("{side}_{bone}"));
        let chain: Vec<&str> = bones.iter().map(String::as_str).collect();
        reaches_19_of_20(&chain);
    }
}

#[test]
fn hands_reach_19_of_20_points_that_they_can_with_the_trunk() {
    let chain = [
        "right_hand",
        "right_forearm",
        "right_upper_arm",
        "right_clavicle",
        "thorax",
        "lumbar",
    ];
    reaches_19_of_20(&chain);
}

#[test]
fn feet_reach_19_of_20_points_that_they_can() {
    for chain in [
        ["right_foot", "right_shank", "right_thigh"],
        ["left_foot", "left_shank", "left_thigh"],
    ] {
        reaches_19_of_20(&chain);
    }
}

#[test]
fn an_arm_reaches_without_the_trunk_where_it_can() {
    let skeleton = woman();
    let standing = Posture::standing(&skeleton);
    let hand = skeleton.bone("right_hand").unwrap();
    let near = skeleton.reach(&standing, hand, &Vec3::new(-20.0, -45.0, 115.0));
    assert!(near.is_there());
    let far = skeleton.reach(&standing, hand, &Vec3::new(10.0, -80.0, 95.0));
    assert!(far.is_there(), "{}", far.miss);
    let arm = ["clavicle", "upper_arm", "forearm", "hand"].map(|part| format!("right_{part}"));
    for (index, bone) in skeleton.bones().iter().enumerate() {
        let turned = |posture: &Posture| posture.joints[index] != Rotation::identity();
        let (is_arm, is_trunk) = (
            arm.contains(&bone.name),
            matches!(&*bone.name, "lumbar" | "thorax"),
        );
        assert!(is_arm || !turned(&near.posture), "{}", bone.name);
        assert!(is_arm || is_trunk || !turned(&far.posture), "{}", bone.name);
    }
}

#[test]
fn a_point_out_of_reach_is_missed_by_what_it_is_too_far() {
    let skeleton = woman();
    let standing = Posture::standing(&skeleton);
    let foot = skeleton.bone("right_foot").unwrap();
    // Toes pointed, the knee bent as little as brings the toes below the hip: thigh, then the
    // straight way from the knee to the toes, in one line.
    let hip = Vec3::new(-8.3, 0.0, 81.2);
    let (sine, cosine) = 50_f64.to_radians().sin_cos();
    let down = 37.5 + 16.0 * sine + 6.2 * cosine;
    let length = 37.5 + down.hypot(16.0 * cosine - 6.2 * sine);
    let target = hip - Vec3::z() * (length + 20.0);
    let reached = skeleton.reach(&standing, foot, &target);
    assert!(!reached.is_there());
    assert!((reached.miss - 20.0).abs() < 0.05, "{}", reached.miss);
}

#[test]
fn what_is_no_point_or_no_bone_is_not_reached() {
    let skeleton = woman();
    let standing = Posture::standing(&skeleton);
    let hand = skeleton.bone("right_hand").unwrap();
    for (bone, target) in [
        (hand, Vec3::new(f64::NAN, 0.0, 0.0)),
        (hand, Vec3::new(0.0, f64::INFINITY, 0.0)),
        (hand, Vec3::new(0.0, f64::MAX, f64::MAX)),
        (21, Vec3::zeros()),
        (usize::MAX, Vec3::zeros()),
    ] {
        let reached = skeleton.reach(&standing, bone, &target);
        assert!(!reached.is_there() && !reached.miss.is_nan());
        assert_eq!(reached.posture, standing);
    }
    // The pelvis hangs on nothing that could turn.
    let reached = skeleton.reach(&standing, 0, &Vec3::zeros());
    assert!((reached.miss - 95.2).abs() < 1e-9);
}

#[test]
fn a_posture_that_is_no_number_reaches_nothing() {
    let skeleton = woman();
    let hand = skeleton.bone("right_hand").unwrap();
    for bone in [hand, hand - 1, 2] {
        let mut posture = Posture::standing(&skeleton);
        let quaternion = nalgebra::Quaternion::new(f64::NAN, 0.0, 0.0, 0.0);
        posture.joints[bone] = Rotation::new_unchecked(quaternion);
        let reached = skeleton.reach(&posture, hand, &Vec3::zeros());
        assert_eq!(reached.miss, f64::INFINITY);
    }
    let mut posture = Posture::standing(&skeleton);
    posture.root.translation.x = f64::NAN;
    assert_eq!(
        skeleton.reach(&posture, hand, &Vec3::zeros()).miss,
        f64::INFINITY
    );
}

#[test]
fn a_limb_that_was_beyond_its_limits_is_within_them_and_the_trunk_is_left_alone() {
    let skeleton = woman();
    let mut posture = Posture::standing(&skeleton);
    for (joint, degrees) in [
        ("right_elbow", [-20.0, 5.0, 0.0]),
        ("chest", [40.0, 0.0, 0.0]),
    ] {
        let bone = skeleton.joint(joint).unwrap();
        posture.joints[bone] = skeleton.bones()[bone]
            .joint
            .rotation(degrees.map(f64::to_radians));
    }
    let hand = skeleton.bone("right_hand").unwrap();
    let end = skeleton.bones()[hand].end(&skeleton.stand(&posture)[hand]);
    let reached = skeleton.reach(&posture, hand, &(end + Vec3::new(-3.0, -10.0, 15.0)));
    assert!(reached.is_there());
    let broken: Vec<String> = skeleton
        .exceeded(&reached.posture)
        .iter()
        .map(|e| e.joint.clone())
        .collect();
    assert_eq!(broken, ["chest"]);
    let chest = skeleton.joint("chest").unwrap();
    assert_eq!(reached.posture.joints[chest], posture.joints[chest]);
}
