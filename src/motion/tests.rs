//! Interpolation against closed forms: no turn is compared with our own sampling.

use super::*;
use crate::{
    math::{Pose, turn},
    skeleton::{Bone, Joint},
};
use proptest::prelude::*;

fn skeleton() -> Skeleton {
    let bone = |name: &str, parent| Bone {
        name: name.into(),
        parent,
        at_base: false,
        vector: Vec3::z(),
        joint: Joint {
            name: format!("{name} joint"),
            angles: ["flexion", "side", "rotation"],
            axes: [Vec3::x(), Vec3::y(), Vec3::z()],
            limits: [[-1.0, 1.0]; 3],
        },
    };
    Skeleton::new(Vec3::zeros(), vec![bone("a", None), bone("b", Some(0))]).unwrap()
}

fn key(time: f64, place: Vec3, turn: Rotation) -> Key {
    let root = Pose::from_parts(place.into(), Rotation::identity());
    let joints = vec![Rotation::identity(), turn];
    let posture = Posture { root, joints };
    Key { time, posture }
}

fn motion(keys: Vec<Key>, cycle: Option<Vec3>) -> Motion {
    Motion::new("m".into(), keys, cycle, &skeleton()).unwrap()
}

fn turn_at(motion: &Motion, time: f64) -> Rotation {
    motion.at(time).joints[1]
}

/// Keys at uneven times with turns that differ by less than 180°.
fn some_keys() -> impl Strategy<Value = Vec<Key>> {
    let vector = || (-0.9..0.9, -0.9..0.9, -0.9..0.9).prop_map(|(x, y, z)| Vec3::new(x, y, z));
    proptest::collection::vec((0.05..0.5, vector(), vector()), 2..7).prop_map(|steps| {
        let (mut time, mut now) = (0.0, Rotation::identity());
        steps
            .iter()
            .map(|(step, place, about)| {
                time += step;
                now *= turn(about);
                key(time, place * 10.0, now)
            })
            .collect()
    })
}

proptest! {
    #[test]
    fn a_motion_passes_through_its_keys(keys in some_keys()) {
        let motion = motion(keys.clone(), None);
        for key in keys {
            let posture = motion.at(key.time);
            prop_assert!(way(&posture.joints[1], &key.posture.joints[1]).norm() < 1e-9);
            let off = posture.root.translation.vector - key.posture.root.translation.vector;
            prop_assert!(off.norm() < 1e-9);
        }
    }

    #[test]
    fn velocity_is_the_same_on_both_sides_of_a_key(keys in some_keys()) {
        const STEP: f64 = 1e-5;
        let motion = motion(keys.clone(), None);
        for key in &keys[1..keys.len() - 1] {
            let [before, here, after] =
                [-STEP, 0.0, STEP].map(|step| motion.at(key.time + step));
            let turns = [way(&before.joints[1], &here.joints[1]), way(&here.joints[1], &after.joints[1])];
            let places = [before, here, after].map(|posture| posture.root.translation.vector);
            // A jump of the velocity would be as large as velocities are, some 10/s; the second
            // derivative leaves its own size, some 1e3/s², times the step.
            prop_assert!((turns[1] - turns[0]).norm() / STEP < 0.05, "{turns:?}");
            prop_assert!((places[2] - 2.0 * places[1] + places[0]).norm() / STEP < 0.5);
        }
    }

    #[test]
    fn the_sign_of_a_quaternion_is_nothing(keys in some_keys(), flip in 0_usize..7, part in 0.0..1.0) {
        let plain = motion(keys.clone(), None);
        let mut keys = keys;
        let flip = flip % keys.len();
        let turn = &mut keys[flip].posture.joints[1];
        *turn = Rotation::new_unchecked(-turn.into_inner());
        let flipped = motion(keys, None);
        let time = plain.first_time() + part * plain.duration();
        prop_assert!(way(&turn_at(&plain, time), &turn_at(&flipped, time)).norm() < 1e-9);
    }

    #[test]
    fn a_constant_velocity_is_kept_past_half_a_turn(
        x in -1.0..1.0, y in -1.0..1.0, z in -1.0..1.0, speed in 1.0..8.9, part in 0.0..1.0
    ) {
        // Up to 8.9 rad/s for 2.05 s, nearly three turns; the widest keys, 0.35 s, are 178.5° apart.
        let axis = Vec3::new(x, y, z + 1.5).normalize();
        let at = |time: f64| turn(&(axis * (speed * time)));
        let times = [0.0, 0.3, 0.4, 0.7, 1.0, 1.05, 1.39, 1.7, 2.05];
        let keys = times.map(|time| key(time, Vec3::new(time, -3.0 * time, 0.0), at(time)));
        let motion = motion(keys.to_vec(), None);
        let time = 2.05 * part;
        prop_assert!(way(&at(time), &turn_at(&motion, time)).norm() < 1e-9);
        let place = motion.at(time).root.translation.vector;
        prop_assert!((place - Vec3::new(time, -3.0 * time, 0.0)).norm() < 1e-9);
    }
}

#[test]
fn inner_spans_of_a_fall_are_its_parabola() {
    let fall = |time: f64| Vec3::z() * (220.0 * time - 490.5 * time * time);
    let keys = [0.0, 0.1, 0.15, 0.3, 0.4].map(|time| key(time, fall(time), Rotation::identity()));
    let motion = motion(keys.to_vec(), None);
    for time in [0.1, 0.12, 0.149, 0.2, 0.29] {
        let off = motion.at(time).root.translation.vector - fall(time);
        assert!(off.norm() < 1e-9, "{time}: {off}");
    }
}

#[test]
fn a_cycle_goes_on_at_its_seam_and_takes_its_way_along() {
    let about = |angle: f64| turn(&(Vec3::x() * angle));
    let keys = vec![
        key(0.5, Vec3::zeros(), about(0.3)),
        key(0.8, Vec3::z(), about(-0.4)),
        key(1.1, Vec3::z(), about(0.9)),
        key(1.5, Vec3::zeros(), about(0.3)),
    ];
    let motion = motion(keys, Some(Vec3::new(0.0, -130.0, 0.0)));
    for time in [0.6, 0.9, 1.4] {
        let (now, later) = (motion.at(time), motion.at(time + 3.0));
        assert!(way(&now.joints[1], &later.joints[1]).norm() < 1e-9);
        let gone = later.root.translation.vector - now.root.translation.vector;
        assert!((gone - Vec3::new(0.0, -390.0, 0.0)).norm() < 1e-9, "{gone}");
    }
    const STEP: f64 = 1e-5;
    let [before, here, after] = [1.5 - STEP, 1.5, 1.5 + STEP].map(|time| turn_at(&motion, time));
    assert!((way(&before, &here) - way(&here, &after)).norm() / STEP < 0.01);
    assert!(motion.at(-7.3).root.translation.vector.y > 0.0);
}

#[test]
fn a_single_key_stands_still_and_a_plain_motion_stops_at_its_ends() {
    let still = motion(vec![key(1.0, Vec3::x(), turn(&Vec3::x()))], None);
    assert_eq!(still.duration(), 0.0);
    for time in [-1.0, 1.0, 5.0, f64::NAN, f64::INFINITY] {
        assert_eq!(still.at(time).root.translation.vector, Vec3::x());
        assert!(way(&still.at(time).joints[1], &turn(&Vec3::x())).norm() < 1e-12);
    }
    let keys = vec![
        key(0.0, Vec3::zeros(), Rotation::identity()),
        key(1.0, Vec3::x(), turn(&Vec3::x())),
    ];
    let motion = motion(keys, None);
    assert_eq!(motion.at(-3.0).root.translation.vector, Vec3::zeros());
    assert!((motion.at(9.0).root.translation.vector - Vec3::x()).norm() < 1e-12);
}

#[test]
fn keys_that_are_no_motion_are_refused() {
    let plain = |time| key(time, Vec3::zeros(), Rotation::identity());
    let refused = |keys: Vec<Key>, cycle: Option<Vec3>| {
        let made = Motion::new("m".into(), keys, cycle, &skeleton());
        made.unwrap_err().to_string()
    };
    let round = Some(Vec3::zeros());
    assert!(refused(vec![], None).starts_with("0 keys; allowed: 1 or more"));
    assert!(refused(vec![plain(0.0)], round).starts_with("1 keys"));
    assert_eq!(
        refused(vec![plain(0.0), plain(0.0)], None),
        "time 0 s of key 2 is not above 0 s, that of the key before"
    );
    assert!(refused(vec![plain(f64::NAN)], None).contains("time that is not finite"));
    let far = key(1.0, Vec3::x() * f64::INFINITY, Rotation::identity());
    assert!(refused(vec![plain(0.0), far], None).contains("key 2 has a place"));
    let turned = key(1.0, Vec3::zeros(), turn(&(Vec3::x() * 0.1)));
    assert_eq!(
        refused(vec![plain(0.0), turned], round),
        "the last key of a cycle must be its first again; b joint is off by 5.730 degrees"
    );
    let mut short = plain(0.0);
    short.posture.joints.pop();
    assert!(refused(vec![short], None).contains("turns 1 bones; allowed: 2"));
}

#[test]
fn angles_beyond_limits_are_told_and_can_be_taken_back() {
    let skeleton = skeleton();
    let keys = [0.5, 1.25, 1.5, 0.0].into_iter().enumerate();
    let keys =
        keys.map(|(time, angle)| key(time as f64, Vec3::zeros(), turn(&(Vec3::x() * angle))));
    let motion = motion(keys.collect(), None);
    let beyond = motion.beyond_limits(&skeleton);
    assert_eq!(beyond.len(), 1);
    assert_eq!((beyond[0].time, beyond[0].share), (2.0, 0.5));
    assert_eq!(beyond[0].worst.joint, "b joint");
    assert!((beyond[0].worst.value - 1.5_f64.to_degrees()).abs() < 1e-9);
    let within = motion.within_limits(&skeleton);
    assert_eq!(within.beyond_limits(&skeleton), []);
    assert!((turned(&turn_at(&within, 2.0)).x - 1.0).abs() < 1e-12);
}
