//! Claims about bones: their lengths against surveys, their joints against anatomy.

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
    let turn = joint("left_clavicle").rotation(collar) * joint("left_shoulder").rotation(shoulder);
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
