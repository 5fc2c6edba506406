//! The motions that ship: what a foot does on the floor, what limits allow, what falls freely.

use crate::woman::{ends, woman};
use soen::{
    math::{Vec3, turn},
    motion::{MOTIONS, Motion},
    scene,
    skeleton::{Joint, Posture},
};

const SIDES: [&str; 2] = ["right", "left"];
/// Where a standing ankle is [cm].
const ANKLE: f64 = 6.2;

fn shipped(name: &str) -> Motion {
    scene::motion(name, &woman()).unwrap()
}

/// Instants from start to end, finer than the keys [s].
fn instants(motion: &Motion, count: usize) -> impl Iterator<Item = f64> {
    let step = motion.duration() / count as f64;
    (0..count).map(move |index| index as f64 * step)
}

/// The toe's tip.
fn toe(posture: &Posture, side: &str) -> Vec3 {
    ends(&woman(), posture, &format!("{side}_foot"))[1]
}

/// The lowest point of a foot: the toe's tip, or the heel 4 cm behind and 6.2 cm below the ankle.
fn sole(posture: &Posture, side: &str) -> f64 {
    let [ankle, toe] = ends(&woman(), posture, &format!("{side}_foot"));
    let ahead = (toe - ankle).normalize();
    // The tip of a standing foot is 1 cm above the floor: a pitch of −16.6° is level.
    let level = turn(&(Vec3::x() * -(5.2_f64 / 17.5).atan())) * ahead;
    let heel = ankle - level * 4.0 - level.cross(&Vec3::x()) * ANKLE;
    heel.z.min(toe.z - 1.0)
}

#[test]
fn shipped_motions_keep_within_what_anatomy_allows_between_keys_too() {
    let woman = woman();
    for (name, _) in MOTIONS {
        let motion = shipped(name);
        assert_eq!(motion.name(), name);
        assert_eq!(motion.beyond_limits(&woman), []);
        for time in instants(&motion, 400) {
            let posture = motion.at(time);
            for (bone, turn) in woman.bones().iter().zip(&posture.joints).skip(1) {
                let joint: &Joint = &bone.joint;
                let beyond: Vec<_> = joint.exceeded(joint.angles(turn)).collect();
                assert!(beyond.is_empty(), "{name} at {time} s: {}", beyond[0]);
            }
        }
    }
}

#[test]
fn a_walk_swings_hips_and_knees_as_people_do() {
    // Winter, The Biomechanics and Motor Control of Human Gait, natural cadence: hip +22 to −11 or
    // more with the pelvis still, knee to 20 in stance and 65 in swing; arms opposite to legs.
    let (motion, woman) = (shipped("walk"), woman());
    let angle = |time: f64, name: &str| {
        let bone = woman.joint(name).unwrap();
        let turn = &motion.at(time).joints[bone];
        woman.bones()[bone].joint.angles(turn)[0].to_degrees()
    };
    let range = |name: &str| {
        let all = instants(&motion, 200).map(|time| angle(time, name));
        all.fold([f64::MAX, f64::MIN], |[low, high], x| {
            [low.min(x), high.max(x)]
        })
    };
    for side in SIDES {
        let [hip, knee, ankle] =
            ["hip", "knee", "ankle"].map(|joint| range(&format!("{side}_{joint}")));
        println!("{side}: hip {hip:.0?}, knee {knee:.0?}, ankle {ankle:.0?}");
        assert!((-20.0..-8.0).contains(&hip[0]) && (25.0..38.0).contains(&hip[1]));
        assert!(knee[0] >= 2.0 && (55.0..68.0).contains(&knee[1]));
    }
    assert!(angle(0.0, "right_hip") > 15.0 && angle(0.0, "right_shoulder") < -10.0);
    assert!(angle(0.0, "left_shoulder") > 10.0);
    let half = motion.duration() / 2.0;
    for joint in ["hip", "knee", "ankle", "shoulder", "elbow"] {
        for time in instants(&motion, 20) {
            let [right, left] = SIDES.map(|side| format!("{side}_{joint}"));
            let off = angle(time, &right) - angle(time + half, &left);
            assert!(off.abs() < 0.2, "{joint} at {time} s: {off}");
        }
    }
}

/// How far the toe that carries slides, and how far soles are off the floor [cm].
fn stance(motion: &Motion, from: f64, to: f64, side: &str) -> [f64; 3] {
    let (mut low, mut high) = (Vec3::repeat(f64::MAX), Vec3::repeat(f64::MIN));
    let mut off = [f64::MAX, f64::MIN];
    for step in 0..=60 {
        let posture = motion.at(from + (to - from) * f64::from(step) / 60.0);
        let tip = toe(&posture, side);
        (low, high) = (low.inf(&tip), high.sup(&tip));
        let height = sole(&posture, side);
        off = [off[0].min(height), off[1].max(height)];
    }
    [(high - low).xy().norm(), off[0], off[1]]
}

#[test]
fn a_foot_that_carries_stays_where_it_is() {
    for (name, from, to, allowed) in [("walk", 0.10, 0.58, 1.0), ("run", 0.03, 0.28, 1.5)] {
        let motion = shipped(name);
        for (side, phase) in [("right", 0.0), ("left", 0.5)] {
            let at = |part: f64| (part + phase) * motion.duration();
            let [slip, low, high] = stance(&motion, at(from), at(to), side);
            println!("{name}, {side}: slides {slip:.2} cm, sole {low:.2} to {high:.2} cm");
            assert!(slip < allowed && low > -1.5 && high < 1.5);
        }
    }
}

#[test]
fn no_foot_goes_through_the_floor() {
    for (name, _) in MOTIONS {
        let motion = shipped(name);
        for time in instants(&motion, 300) {
            for side in SIDES {
                let height = sole(&motion.at(time), side);
                assert!(
                    height > -1.5,
                    "{name} at {time} s: {side} sole at {height} cm"
                );
            }
        }
    }
}

#[test]
fn a_runner_is_off_the_floor_twice_a_round_and_a_walker_never() {
    let lowest = |motion: &Motion, time: f64| {
        let posture = motion.at(time);
        SIDES
            .map(|side| sole(&posture, side))
            .into_iter()
            .fold(f64::MAX, f64::min)
    };
    let walk = shipped("walk");
    let run = shipped("run");
    assert!(instants(&walk, 200).all(|time| lowest(&walk, time) < 1.5));
    let aloft: Vec<bool> = instants(&run, 200)
        .map(|time| lowest(&run, time) > 1.5)
        .collect();
    let flights = aloft.windows(2).filter(|pair| pair[1] && !pair[0]).count();
    let share = aloft.iter().filter(|aloft| **aloft).count() as f64 / 200.0;
    println!("aloft for {:.0} % of a run", 100.0 * share);
    assert_eq!(flights, 2);
    assert!((0.2..0.45).contains(&share));
}

#[test]
fn a_jump_falls_freely_and_ends_where_it_began() {
    let jump = shipped("jump");
    let height = |time: f64| jump.at(time).root.translation.vector.z;
    // 0.45 s in the air from 0.8 s on: z = z₀ + v t − g t²/2, and at its ends the same height.
    let (start, time_aloft) = (0.8, 0.45);
    let rise = 981.0 * time_aloft * time_aloft / 8.0;
    assert!((height(start + time_aloft / 2.0) - height(start) - rise).abs() < 0.1);
    for step in 0..=45 {
        let time = f64::from(step) * 0.01;
        let fall = height(start) + 981.0 * (0.5 * time_aloft * time - 0.5 * time * time);
        let off = height(start + time) - fall;
        assert!(off.abs() < 0.3, "{off} cm after {time} s");
    }
    for side in SIDES {
        let (first, last) = (toe(&jump.at(0.0), side), toe(&jump.at(9.0), side));
        assert!((first - last).norm() < 0.1);
        let aloft = toe(&jump.at(start + 0.5 * time_aloft), side);
        assert!(aloft.z > 20.0);
    }
}

#[test]
fn a_longer_leg_takes_longer_steps() {
    let woman = woman();
    let grown: Vec<_> = woman
        .bones()
        .iter()
        .cloned()
        .map(|mut bone| {
            bone.vector *= 1.2;
            bone
        })
        .collect();
    let tall = soen::skeleton::Skeleton::new(woman.base() * 1.2, grown).unwrap();
    let [own, other] = [&woman, &tall].map(|skeleton| scene::motion("walk", skeleton).unwrap());
    assert!((other.travel().unwrap() - own.travel().unwrap() * 1.2).norm() < 1e-9);
    for time in [0.1, 0.5, 0.9] {
        let [own, other] = [&own, &other].map(|motion| motion.at(time));
        let scaled = own.root.translation.vector * 1.2;
        assert!((other.root.translation.vector - scaled).norm() < 1e-9);
        assert_eq!(own.joints, other.joints);
    }
}
