//! Whole bodies of the people that ship.

#![allow(
    clippy::print_stdout,
    reason = "figures are for whoever runs the tests with --nocapture"
)]

mod moving;
mod program;

use crate::{
    reach::missed_of_200,
    skeleton::{by_hand, postures},
};
use proptest::prelude::*;
use soen::{
    math::{Vec3, turn},
    robot::{Ball, Girth, PEOPLE, Robot},
    scene,
    skeleton::{POSES, Posture},
};
use std::sync::OnceLock;

/// Name and body of everyone that ships, built once.
fn everyone() -> &'static [(&'static str, Robot)] {
    static BODIES: OnceLock<Vec<(&str, Robot)>> = OnceLock::new();
    BODIES.get_or_init(|| {
        let built = PEOPLE.map(|(name, _)| {
            let person = scene::person(name.as_ref()).unwrap();
            (name, Robot::new(&person).unwrap())
        });
        built.into()
    })
}

#[test]
fn bodies_are_as_measured() {
    println!("{:28}{:>8}{:>8}{:>8}", "[cm]", "asked", "built", "off");
    for (name, robot) in everyone() {
        let person = robot.measurements();
        let lengths = [
            ("stature", person.stature, robot.stature(), 0.5),
            (
                "sitting height",
                person.sitting_height,
                robot.sitting_height(),
                0.5,
            ),
            (
                "shoulder width",
                person.shoulder_width,
                robot.shoulder_width(),
                0.5,
            ),
            ("hip width", person.hip_width, robot.hip_width(), 0.5),
        ];
        let girth = |girth: Girth| {
            (
                girth.name(),
                person.girths.of(girth),
                robot.girth(girth),
                1.0,
            )
        };
        let girths = Girth::ALL.map(girth);
        for (what, asked, built, allowed) in lengths.into_iter().chain(girths) {
            let off = built - asked;
            println!("{name:10} {what:17}{asked:8.1}{built:8.2}{off:8.2}");
            assert!(off.abs() < allowed, "{name} {what}: {built} for {asked}");
        }
        let dent = robot.trunk_dent().unwrap();
        println!(
            "{name:10} {} balls, dents {dent:.2} cm",
            robot.muscles().len()
        );
        assert!(dent < 0.5);
    }
}

/// The skeleton's soles are the robot's balls, and the standing person's touch the floor.
#[test]
fn soles_are_the_feet_that_stand_on_the_floor() {
    for (name, robot) in everyone() {
        let skeleton = robot.skeleton();
        let frames = by_hand(skeleton, &Posture::standing(skeleton));
        assert_eq!(skeleton.soles().len(), 60, "{name}");
        for sole in skeleton.soles() {
            let height = (frames[sole.bone] * nalgebra::Point3::from(sole.at)).z - sole.radius;
            assert!(height.abs() < 1e-9, "{name}: {height}");
            let is_it = |m: &&soen::robot::Muscle| {
                m.bone == sole.bone && m.radius == sole.radius && (m.at - sole.at).norm() < 1e-9
            };
            assert!(robot.muscles().iter().any(|muscle| is_it(&muscle)));
        }
    }
}

/// A bent elbow thickens the upper arm, a bent knee the thigh: nothing else that is not beyond a
/// joint changes when it turns.
fn bulges(joint: &str, bone: &str) -> bool {
    ["right", "left"].iter().any(|side| {
        let is = |j: &str, b: &str| joint == format!("{side}_{j}") && bone == format!("{side}_{b}");
        is("elbow", "upper_arm") || is("knee", "thigh") || is("knee", "shank")
    })
}

#[test]
fn to_turn_any_joint_moves_bones_and_balls_beyond_it_and_no_other() {
    for (name, robot) in everyone() {
        let skeleton = robot.skeleton();
        let standing = Posture::standing(skeleton);
        let before = skeleton.stand(&standing);
        let balls_before = robot.balls(&standing, &before);
        let mut counts = [0; 2];
        for turned in 1..skeleton.bones().len() {
            let joint = &skeleton.bones()[turned].joint.name;
            let mut posture = standing.clone();
            posture.joints[turned] = turn(&Vec3::new(0.3, 0.5, -0.2));
            let after = skeleton.stand(&posture);
            for (bone, (was, is)) in before.iter().zip(&after).enumerate() {
                let own = &skeleton.bones()[bone];
                if skeleton.is_beyond(bone, turned) {
                    assert!(
                        (own.end(is) - own.end(was)).norm() > 0.5,
                        "{} by {joint}",
                        own.name
                    );
                    assert!(is.rotation.angle_to(&was.rotation) > 0.5);
                    counts[0] += 1;
                } else {
                    assert_eq!(was, is, "{} by {joint}", own.name);
                }
            }
            let balls = robot.balls(&posture, &after);
            for ((muscle, was), is) in robot.muscles().iter().zip(&balls_before).zip(&balls) {
                let bone = &skeleton.bones()[muscle.bone].name;
                let with_bone =
                    after[muscle.bone].translation.vector + after[muscle.bone].rotation * muscle.at;
                // What is between ribs and shoulder stretches.
                let stretches = joint == bone && joint.ends_with("clavicle");
                if bulges(joint, bone) {
                    assert!((is.centre - with_bone).norm() < 1.0, "{bone} by {joint}");
                } else if !stretches {
                    assert!((is.centre - with_bone).norm() < 1e-9, "{bone} by {joint}");
                    assert_eq!(is.radius, was.radius);
                }
                if skeleton.is_beyond(muscle.bone, turned) {
                    counts[1] += 1;
                } else if !bulges(joint, bone) {
                    assert_eq!(was, is, "{bone} by {joint}");
                }
            }
        }
        let [bones, balls] = counts;
        println!("{name}: {bones} times a bone moved, {balls} times a ball");
        // Spine 12, 11, 2, 1; arms and legs 4 + 3 + 2 + 1 each.
        assert_eq!(bones, 12 + 11 + 2 + 1 + 20 + 20);
    }
}

proptest! {
    #[test]
    fn real_bones_stand_where_products_by_hand_do(posture in postures()) {
        for (name, robot) in everyone() {
            let poses = robot.skeleton().stand(&posture);
            prop_assert_eq!(poses.len(), posture.joints.len());
            for (pose, wanted) in poses.iter().zip(by_hand(robot.skeleton(), &posture)) {
                let apart = pose.translation.vector - wanted.translation.vector;
                prop_assert!(apart.norm() < 1e-9, "{}: {} cm", name, apart.norm());
                prop_assert!(pose.rotation.angle_to(&wanted.rotation) < 1e-7);
            }
        }
    }
}

#[test]
fn hands_and_feet_reach_19_of_20_points_that_they_can() {
    let chains: [&[&str]; 4] = [
        &[
            "right_hand",
            "right_forearm",
            "right_upper_arm",
            "right_clavicle",
        ],
        &[
            "left_hand",
            "left_forearm",
            "left_upper_arm",
            "left_clavicle",
            "thorax",
            "lumbar",
        ],
        &["right_foot", "right_shank", "right_thigh"],
        &["left_foot", "left_shank", "left_thigh"],
    ];
    for (name, robot) in everyone() {
        for chain in chains {
            let missed = missed_of_200(robot.skeleton(), chain);
            let worst = missed.iter().map(|(_, miss)| *miss).fold(0.0, f64::max);
            let there = 200 - missed.len();
            println!("{name} {}: {there} of 200, worst {worst:.2} cm", chain[0]);
            assert!(there >= 190, "{name} {}: {missed:?}", chain[0]);
        }
    }
}

/// Height of the lowest ball of a foot [cm], and of the lowest at its heel and at its toes.
fn foot(robot: &Robot, balls: &[Ball], side: &str) -> [f64; 3] {
    let bone = robot.skeleton().bone(&format!("{side}_foot")).unwrap();
    let of_foot = || {
        robot
            .muscles()
            .iter()
            .zip(balls)
            .filter(|(m, _)| m.bone == bone)
    };
    let lowest = |pick: &dyn Fn(f64) -> bool| {
        let heights = of_foot().filter(|(m, _)| pick(m.at.y));
        heights
            .map(|(_, b)| b.centre.z - b.radius)
            .fold(f64::MAX, f64::min)
    };
    [
        lowest(&|_| true),
        lowest(&|y| y > 0.0),
        lowest(&|y| y < -8.0),
    ]
}

#[test]
fn all_poses_of_everyone_are_within_limits_and_on_the_ground() {
    for (name, robot) in everyone() {
        let skeleton = robot.skeleton();
        for (pose, _) in POSES {
            let posture = scene::posture(pose.as_ref(), skeleton).unwrap();
            assert_eq!(skeleton.exceeded(&posture), []);
            let frames = skeleton.stand(&posture);
            let balls = robot.balls(&posture, &frames);
            let feet = ["right", "left"].map(|side| foot(robot, &balls, side));
            println!(
                "{name} {pose}: right {:.2?}, left {:.2?} cm",
                feet[0], feet[1]
            );
            let lowest = balls
                .iter()
                .map(|b| b.centre.z - b.radius)
                .fold(f64::MAX, f64::min);
            assert!(lowest.abs() < 1.0, "{name} {pose}: {lowest}");
            for [low, heel, toes] in feet {
                if pose == "stride" {
                    assert!(low < 2.5, "{name}: a foot is {low} cm off the ground");
                } else {
                    // Sitting, thighs that close in turn the soles by 2°: 0.1 cm over half a foot.
                    assert!([low, heel, toes].iter().all(|height| height.abs() < 0.15));
                }
            }
        }
    }
}
