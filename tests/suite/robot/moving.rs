//! Motions that ship and captures, on whole bodies.

use super::{everyone, foot};
use soen::{
    motion::{Bvh, MOTIONS, Motion, errors, retarget},
    robot::Robot,
    scene,
    skeleton::Skeleton,
};
use std::{fs, path::Path};

const CAPTURES: [&str; 5] = [
    "cmu_02_01_walk.bvh",
    "cmu_02_03_run.bvh",
    "cmu_02_04_jump.bvh",
    "makehuman_tpose.bvh",
    "makehuman_walk1.bvh",
];

/// How high the lower sole is over 60 instants, least and most [cm], all balls being finite and
/// as large as they are at rest to 15 %.
fn played(robot: &Robot, motion: &Motion) -> [f64; 2] {
    let mut soles = [f64::MAX, f64::MIN];
    for step in 0..60 {
        let posture = motion.at(motion.duration() * f64::from(step) / 59.0);
        let frames = robot.skeleton().stand(&posture);
        let balls = robot.balls(&posture, &frames);
        for (ball, muscle) in balls.iter().zip(robot.muscles()) {
            assert!(ball.centre.iter().all(|x| x.is_finite()));
            assert!((ball.radius / muscle.radius - 1.0).abs() < 0.15);
        }
        let feet = ["right", "left"].map(|side| foot(robot, &balls, side)[0]);
        let sole = feet[0].min(feet[1]);
        soles = [soles[0].min(sole), soles[1].max(sole)];
    }
    soles
}

#[test]
fn what_ships_plays_on_everyone() {
    for (name, robot) in everyone() {
        for (which, _) in MOTIONS {
            let motion = scene::motion(which, robot.skeleton()).unwrap();
            let [low, high] = played(robot, &motion);
            let beyond = motion.beyond_limits(robot.skeleton());
            println!("{name} {which}: lower sole {low:.2} to {high:.2} cm, {beyond:?}");
            assert!(low > -2.0, "{name} {which}: {low}");
            assert!(which != "walk" || high < 2.0, "{name} flies: {high}");
            assert!(beyond.is_empty());
        }
    }
}

#[test]
fn captures_play_on_everyone() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/motion");
    for file in CAPTURES {
        let path = Path::new(folder).join(file);
        let Ok(text) = fs::read_to_string(&path) else {
            println!("{file}: not there, not tried");
            continue;
        };
        let source = Bvh::parse(&text).unwrap();
        let mapping = scene::mapping_for(&source).unwrap();
        for (name, robot) in everyone() {
            let skeleton = robot.skeleton();
            let motion = retarget(&source, &mapping, skeleton).unwrap();
            let off = errors(&source, &mapping, skeleton, &motion).unwrap();
            let [low, high] = played(robot, &motion);
            println!(
                "{file} {name}: of stature: hands {:.2} %, feet {:.2} %, from shoulder {:.2} %, from \
                 hip {:.2} %; lower sole {low:.1} to {high:.1} cm",
                100.0 * off.hands,
                100.0 * off.feet,
                100.0 * off.arms,
                100.0 * off.legs
            );
            assert!(off.hands < 0.05 && off.feet < 0.05 && off.arms < 0.05 && off.legs < 0.05);
            stands_on_the_floor(file, robot, &source, &motion);
        }
    }
}

/// No ball of a foot is below the floor, where without soles the same capture's are; who walks
/// always has a foot on it; and the root is not thrown up or down for it.
fn stands_on_the_floor(file: &str, robot: &Robot, source: &Bvh, motion: &Motion) {
    let skeleton = robot.skeleton();
    let bones = Skeleton::new(skeleton.base(), skeleton.bones().to_vec()).unwrap();
    let mapping = scene::mapping_for(source).unwrap();
    let plain = retarget(source, &mapping, &bones).unwrap();
    let lower = |motion: &Motion, time: f64| {
        let posture = motion.at(time);
        let balls = robot.balls(&posture, &skeleton.stand(&posture));
        let feet = ["right", "left"].map(|side| foot(robot, &balls, side)[0]);
        feet[0].min(feet[1])
    };
    let count = source.frames.len();
    let last = |a: [f64; 2], b: f64| [a[0].min(b), a[1].max(b)];
    let range = |motion: &Motion, parts: usize| {
        let times = (0..parts * count).map(|k| k as f64 * source.frame_time / parts as f64);
        times
            .map(|time| lower(motion, time))
            .fold([f64::MAX, f64::MIN], last)
    };
    let ([before, _], [key, high], [between, _]) =
        (range(&plain, 1), range(motion, 1), range(motion, 3));
    let added = motion
        .keys()
        .iter()
        .map(|key| key.posture.root.translation.z - plain.at(key.time).root.translation.z);
    let added: Vec<f64> = added.collect();
    let bends = added.windows(3).map(|w| (w[0] - 2.0 * w[1] + w[2]).abs());
    let step = motion.duration() / (motion.keys().len() - 1).max(1) as f64;
    let thrown = bends.fold(0.0, f64::max) / step.max(1e-3).powi(2);
    println!(
        "    deepest {before:.2} cm, now {key:.2} cm, between keys {between:.2} cm; lower sole up to \
         {high:.2} cm; the root is pushed by up to {thrown:.0} cm/s²"
    );
    // Between keys a foot goes by the cubic, which knows of no floor.
    assert!(key > -1e-6 && between > -0.5, "{file}: {key}, {between}");
    assert!(!file.contains("walk") || high < 1.0, "{file} flies: {high}");
    assert!(thrown < 981.0);
}
