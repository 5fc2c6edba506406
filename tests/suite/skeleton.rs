//! Turn one bone and all beyond it turn, and no other.

use crate::woman::woman;
use proptest::prelude::*;
use soen::{
    math::{Pose, Vec3, turn},
    skeleton::{Posture, Skeleton},
};

/// Forward kinematics by hand: each bone starts where the one that it hangs on ends.
pub(crate) fn by_hand(skeleton: &Skeleton, posture: &Posture) -> Vec<Pose> {
    let mut poses: Vec<Pose> = vec![posture.root];
    for (bone, joint) in skeleton.bones().iter().zip(&posture.joints).skip(1) {
        let parent = bone.parent.unwrap();
        let (holder, holding) = (poses[parent], &skeleton.bones()[parent]);
        let along = if bone.at_base {
            Vec3::zeros()
        } else {
            holding.vector
        };
        let origin = holder.translation.vector + holder.rotation * along;
        poses.push(Pose::from_parts(origin.into(), holder.rotation * joint));
    }
    poses
}

fn vector(greatest: f64) -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-greatest..greatest).prop_map(Vec3::from)
}

/// Any turns at all, also beyond every limit, and the pelvis anywhere.
pub(crate) fn postures() -> impl Strategy<Value = Posture> {
    let joints = prop::collection::vec(vector(4.0), 21);
    (vector(500.0), vector(4.0), joints).prop_map(|(place, about, joints)| Posture {
        root: Pose::from_parts(place.into(), turn(&about)),
        joints: joints.iter().map(turn).collect(),
    })
}

proptest! {
    #[test]
    fn rapier_stands_where_products_by_hand_do(posture in postures()) {
        let skeleton = woman();
        let poses = skeleton.stand(&posture);
        prop_assert_eq!(poses.len(), 21);
        for (pose, wanted) in poses.iter().zip(by_hand(&skeleton, &posture)) {
            let apart = pose.translation.vector - wanted.translation.vector;
            prop_assert!(apart.norm() < 1e-9, "{} cm", apart.norm());
            prop_assert!(pose.rotation.angle_to(&wanted.rotation) < 1e-7);
        }
    }

    #[test]
    fn bones_keep_their_lengths_and_stay_joined(posture in postures()) {
        let skeleton = woman();
        let poses = skeleton.stand(&posture);
        for (bone, pose) in skeleton.bones().iter().zip(&poses) {
            let origin = pose.translation.vector;
            let length = (bone.end(pose) - origin).norm();
            prop_assert!((length - bone.vector.norm()).abs() < 1e-10);
            let turn = pose.rotation.quaternion().norm();
            prop_assert!((turn - 1.0).abs() < 1e-14, "{}", turn);
            if let Some(parent) = bone.parent {
                let (holder, holding) = (&poses[parent], &skeleton.bones()[parent]);
                let anchor = if bone.at_base { holder.translation.vector } else { holding.end(holder) };
                prop_assert!((anchor - origin).norm() < 1e-9);
            }
        }
    }

    #[test]
    fn a_figure_comes_down_to_the_ground_as_it_is(posture in postures()) {
        let skeleton = woman();
        let grounded = skeleton.grounded(&posture);
        prop_assert!(skeleton.lowest(&grounded).abs() < 1e-9);
        let rise = grounded.root.translation.vector - posture.root.translation.vector;
        prop_assert_eq!((rise.x, rise.y), (0.0, 0.0));
        prop_assert_eq!(&grounded.joints, &posture.joints);
        prop_assert_eq!(grounded.root.rotation, posture.root.rotation);
    }
}

#[test]
fn to_turn_one_joint_moves_all_bones_beyond_it_and_no_other() {
    let skeleton = woman();
    let standing = Posture::standing(&skeleton);
    let before = skeleton.stand(&standing);
    let mut moved = 0;
    for turned in 1..skeleton.bones().len() {
        let mut posture = standing.clone();
        posture.joints[turned] = turn(&Vec3::new(0.3, 0.5, -0.2));
        let after = skeleton.stand(&posture);
        for (bone, (before, after)) in before.iter().zip(&after).enumerate() {
            if skeleton.is_beyond(bone, turned) {
                let (end, was) = (
                    skeleton.bones()[bone].end(after),
                    skeleton.bones()[bone].end(before),
                );
                assert!((end - was).norm() > 1.0, "bone {bone} by joint {turned}");
                assert!(after.rotation.angle_to(&before.rotation) > 0.5);
                moved += 1;
            } else {
                assert_eq!(before, after, "bone {bone} by joint {turned}");
            }
        }
    }
    // Bones at or beyond each joint: spine 12, 11, 2, 1; arms 4 + 3 + 2 + 1, twice; legs the same.
    assert_eq!(moved, 12 + 11 + 2 + 1 + 20 + 20);
}

#[test]
fn she_stands_as_tall_as_she_was_built() {
    let skeleton = woman();
    let posture = Posture::standing(&skeleton);
    let poses = skeleton.stand(&posture);
    let head = skeleton.bone("head").unwrap();
    assert!((skeleton.bones()[head].end(&poses[head]).z - 158.2).abs() < 1e-9);
    assert!(skeleton.lowest(&posture).abs() < 1e-9);
    assert!(skeleton.exceeded(&posture).is_empty());
}

#[test]
fn a_bent_elbow_points_forward_whatever_the_trunk_does_not() {
    let skeleton = woman();
    let mut posture = Posture::standing(&skeleton);
    let elbow = skeleton.joint("left_elbow").unwrap();
    posture.joints[elbow] = skeleton.bones()[elbow]
        .joint
        .rotation([90_f64.to_radians(), 0.0, 0.0]);
    let hand = skeleton.bone("left_hand").unwrap();
    let end = skeleton.bones()[hand].end(&skeleton.stand(&posture)[hand]);
    // Shoulder at (16.4, 0, 124.2), elbow 28.1 below it, 22.3 + 16.8 from there to the finger tips.
    assert!((end - Vec3::new(16.4, -39.1, 96.1)).norm() < 1e-9, "{end}");
}

#[test]
fn a_posture_with_too_few_or_too_many_turns_is_stood_in() {
    let skeleton = woman();
    let standing = Posture::standing(&skeleton);
    let mut short = standing.clone();
    short.joints.truncate(3);
    assert_eq!(skeleton.stand(&short), skeleton.stand(&standing));
    short.joints.clear();
    assert_eq!(skeleton.stand(&short), skeleton.stand(&standing));
    let mut long = standing.clone();
    long.joints.push(turn(&Vec3::x()));
    assert_eq!(skeleton.stand(&long), skeleton.stand(&standing));
    assert!(skeleton.exceeded(&long).is_empty());
    let pelvis = Skeleton::new(Vec3::z(), skeleton.bones()[..1].to_vec()).unwrap();
    let posture = Posture::standing(&pelvis);
    assert_eq!(pelvis.stand(&posture), [posture.root]);
}

#[test]
fn every_broken_limit_is_named() {
    let skeleton = woman();
    let mut posture = Posture::standing(&skeleton);
    for (joint, degrees) in [
        ("right_knee", [-10.0, 0.0, 0.0]),
        ("left_elbow", [160.0, 0.0, 95.0]),
    ] {
        let bone = skeleton.joint(joint).unwrap();
        let turn = skeleton.bones()[bone]
            .joint
            .rotation(degrees.map(f64::to_radians));
        posture.joints[bone] = turn;
    }
    let said: Vec<String> = skeleton
        .exceeded(&posture)
        .iter()
        .map(ToString::to_string)
        .collect();
    assert_eq!(
        said,
        [
            "left_elbow flexion is 160.0°; allowed: 0° to 150°",
            "left_elbow pronation is 95.0°; allowed: -80° to 80°",
            "right_knee flexion is -10.0°; allowed: 0° to 135°",
        ]
    );
}

#[test]
fn limits_the_wrong_way_round_make_no_skeleton() {
    let skeleton = woman();
    for limits in [[1.0, -1.0], [f64::NAN, 1.0], [0.0, f64::NAN]] {
        let mut bones = skeleton.bones().to_vec();
        bones[2].joint.limits[1] = limits;
        let error = Skeleton::new(skeleton.base(), bones).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the limits of joint \"chest\" are not in order"
        );
    }
}
