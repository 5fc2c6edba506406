//! Posture files: what they mean, and what is said of each slip.

use crate::woman::woman;
use proptest::prelude::*;
use soen::{
    math::Vec3,
    scene,
    skeleton::{Posture, Skeleton},
};
use std::{fs, path::Path};

/// A posture in which nothing is wrong.
const SITTING: &str = r#"name = "sitting"
ground = true
[root]
turn_deg = [0.0, 0.0, 30.0]
move_cm = [10.0, 0.0, 0.0]
[joint.right_hip]
flexion_deg = 90.0
[joint.right_knee]
flexion_deg = 90.0
[joint.left_elbow]
flexion_deg = 90
pronation_deg = 45.0
[[reach]]
bone = "right_hand"
to_cm = [-10.0, -30.0, 110.0]
"#;

/// What is replaced in it, by what, and what is said of it.
const SLIPS: &[(&str, &str, &[&str])] = &[
    (
        "[joint.right_hip]",
        "[joint.right_hipp]",
        &["x.toml:6:8: unknown key \"right_hipp\" in [joint]; did you mean \"right_hip\"?"],
    ),
    (
        "[joint.right_hip]",
        "[joint.tail]",
        &["unknown key \"tail\" in [joint]; allowed: waist, chest, neck, head, right_clavicle,"],
    ),
    (
        "[joint.right_hip]",
        "[joint.root]",
        &["unknown key \"root\" in [joint]"],
    ),
    (
        "[joint.right_hip]",
        "[joint.right_hip_bone]",
        &["unknown key \"right_hip_bone\" in [joint]; did you mean \"right_hip\"?"],
    ),
    (
        "flexion_deg = 90\n",
        "flexion = 90\n",
        &[
            "x.toml:11:1: unknown key \"flexion\" in [joint.left_elbow]; did you mean \"flexion_deg\"?",
        ],
    ),
    (
        "flexion_deg = 90\n",
        "bend_rad = 1.0\n",
        &[
            "unknown key \"bend_rad\" in [joint.left_elbow]; allowed: flexion_deg, carrying_deg, pronation_deg",
        ],
    ),
    (
        "flexion_deg = 90\n",
        "flexion_deg = nan\n",
        &["x.toml:11:15: joint.left_elbow.flexion_deg is nan; allowed: 0 to 150 degrees"],
    ),
    (
        "flexion_deg = 90\n",
        "flexion_deg = -inf\n",
        &["joint.left_elbow.flexion_deg is -inf; allowed: 0 to 150 degrees"],
    ),
    (
        "flexion_deg = 90\n",
        "flexion_deg = 150.1\n",
        &["joint.left_elbow.flexion_deg is 150.1; allowed: 0 to 150 degrees"],
    ),
    (
        "flexion_deg = 90\n",
        "flexion_deg = 90\ncarrying_deg = 5\n",
        &["joint.left_elbow.carrying_deg is 5; allowed: 0 to 0 degrees"],
    ),
    (
        "pronation_deg = 45.0",
        "pronation_deg = \"45\"",
        &["joint.left_elbow.pronation_deg is \"45\"; allowed: a number"],
    ),
    (
        "pronation_deg = 45.0",
        "pronation_deg = 1\npronation_deg = 2",
        &["x.toml:13:1: not valid TOML: duplicate key"],
    ),
    (
        "[[reach]]",
        "[joint.left_shoulder]\nflexion_deg = 150\nabduction_deg = 150\n[[reach]]",
        &[
            "joint.left_shoulder is ",
            "allowed: flexion_deg and abduction_deg whose squares add up to 180² or less",
        ],
    ),
    (
        "[joint.right_hip]\nflexion_deg = 90.0",
        "[joint]\nright_hip = 90.0",
        &["joint.right_hip is 90.0; allowed: a table"],
    ),
    (
        "ground = true",
        "ground = \"yes\"",
        &["x.toml:2:10: ground is \"yes\"; allowed: true or false"],
    ),
    (
        "ground = true",
        "grounded = true",
        &["unknown key \"grounded\"; did you mean \"ground\"?"],
    ),
    (
        "turn_deg = [0.0, 0.0, 30.0]",
        "turn_deg = [0.0, 30.0]",
        &["root.turn_deg is [0.0, 30.0]; allowed: a list of 3 numbers"],
    ),
    (
        "turn_deg = [0.0, 0.0, 30.0]",
        "turn_deg = [0.0, inf, 30.0]",
        &["root.turn_deg[2] is inf; allowed: -3600 to 3600 degrees"],
    ),
    (
        "move_cm = [10.0, 0.0, 0.0]",
        "move_cm = [nan, 0.0, 0.0]",
        &["x.toml:5:12: root.move_cm[1] is nan; allowed: -100000 to 100000 cm"],
    ),
    (
        "move_cm = [10.0, 0.0, 0.0]",
        "move = [10.0, 0.0, 0.0]",
        &["unknown key \"move\" in [root]; did you mean \"move_cm\"?"],
    ),
    (
        "\"right_hand\"",
        "\"right_hnd\"",
        &[
            "x.toml:14:8: reach[1].bone is \"right_hnd\"; allowed: lumbar,",
            "did you mean \"right_hand\"?",
        ],
    ),
    (
        "\"right_hand\"",
        "\"pelvis\"",
        &["reach[1].bone is \"pelvis\"; allowed: lumbar, thorax,"],
    ),
    (
        "bone = \"right_hand\"\n",
        "",
        &["x.toml:13:1: missing key \"bone\" in [reach]"],
    ),
    (
        "to_cm = [-10.0, -30.0, 110.0]",
        "to_cm = [-10.0, -30.0, nan]",
        &["reach[1].to_cm[3] is nan; allowed: -100000 to 100000 cm"],
    ),
    (
        "[[reach]]",
        "[reach]",
        &["reach is [reach]; allowed: tables, each headed [[reach]]"],
    ),
];

fn read(text: &str, skeleton: &Skeleton) -> Result<Posture, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.toml");
    fs::write(&path, text).unwrap();
    scene::posture(&path, skeleton).map_err(|error| {
        let said = error.to_string();
        let folder = format!("{}/", folder.path().display());
        said.replace(&folder, "")
    })
}

#[test]
fn each_slip_is_named_with_its_place_and_what_is_allowed() {
    let skeleton = woman();
    for (right, slip, says) in SLIPS {
        let text = SITTING.replacen(right, slip, 1);
        assert_ne!(text, SITTING, "{right:?} is not in the file");
        let said = read(&text, &skeleton).expect_err(slip);
        for part in *says {
            assert!(said.contains(part), "without {part:?}:\n{said}");
        }
        assert!(said.starts_with("x.toml:") && said.ends_with('^'), "{said}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn a_spoilt_file_is_read_or_refused(
        from in 0..SITTING.len(), length in 0..20_usize,
        word in prop::sample::select(vec!["", "nan", "1e308", "-1", "]", "[[reach]]", "\0", "\"", "{}"]),
    ) {
        let to = (from + length).min(SITTING.len());
        let mut text = SITTING.to_owned();
        text.replace_range(from..to, word);
        if let Err(said) = read(&text, &woman()) {
            prop_assert!(said.starts_with("x.toml:"), "{}", said);
        }
    }
}

#[test]
fn a_reach_that_misses_says_by_how_much() {
    let skeleton = woman();
    // Straight ahead of the shoulder by a metre more than the arm has: 28.1 + 22.3 + 16.8 cm.
    let text = "[[reach]]\nbone = \"right_hand\"\nto_cm = [-16.4, -300.0, 124.2]\n";
    let said = read(text, &skeleton).expect_err("too far");
    let (_, miss) = said.split_once("right_hand ends ").unwrap();
    let (miss, _) = miss
        .split_once(" cm from it; allowed: a point within its reach")
        .unwrap();
    assert!(
        said.starts_with("x.toml:3:9: reach[1].to_cm is [-16.4, -300.0, 124.2]: "),
        "{said}"
    );
    // The trunk's joints bring the shoulder forward, by no more than the spine and half the
    // shoulders' width are long.
    let miss: f64 = miss.parse().unwrap();
    let (most, least) = (300.0 - 67.2, 300.0 - 67.2 - 43.0 - 17.5);
    assert!((least..most).contains(&miss), "{miss}");
}

#[test]
fn what_is_no_file_or_no_text_is_refused() {
    let skeleton = woman();
    assert!(
        read("", &skeleton)
            .unwrap_err()
            .starts_with("x.toml: is empty")
    );
    assert!(
        read("\0", &skeleton)
            .unwrap_err()
            .starts_with("x.toml: is binary")
    );
    assert!(
        read("[joint", &skeleton)
            .unwrap_err()
            .contains("not valid TOML")
    );
    let said = scene::posture(Path::new("none.toml"), &skeleton)
        .unwrap_err()
        .to_string();
    assert!(
        said.starts_with("none.toml: cannot be read: No such file"),
        "{said}"
    );
}

#[test]
fn angles_and_root_are_what_the_file_says() {
    let skeleton = woman();
    let text = SITTING
        .split("[[reach]]")
        .next()
        .unwrap()
        .replace("ground = true", "ground = false");
    let posture = read(&text, &skeleton).unwrap();
    assert_eq!(posture.root.translation.vector, Vec3::new(10.0, 0.0, 81.2));
    // Facing −y, then 30° to the left: −y turns towards x.
    let faces = posture.root.rotation * -Vec3::y();
    assert!((faces - Vec3::new(0.5, -(0.75_f64.sqrt()), 0.0)).norm() < 1e-12);
    let elbow = skeleton.joint("left_elbow").unwrap();
    let angles = skeleton.bones()[elbow].joint.angles(&posture.joints[elbow]);
    for (angle, degrees) in angles.iter().zip([90.0, 0.0, 45.0]) {
        assert!((angle.to_degrees() - degrees).abs() < 1e-9);
    }
    // A thigh level ahead, a shank straight down.
    let knee = skeleton.bone("right_shank").unwrap();
    let poses = skeleton.stand(&posture);
    let thigh = poses[knee].translation.vector - poses[knee - 1].translation.vector;
    assert!((thigh - faces * 37.5).norm() < 1e-9);
    let shank = skeleton.bones()[knee].end(&poses[knee]) - poses[knee].translation.vector;
    assert!((shank + Vec3::z() * 37.5).norm() < 1e-9);
}

#[test]
fn a_figure_is_put_on_the_ground_unless_told_otherwise() {
    let skeleton = woman();
    let legs = |flexion: &str| {
        let hips = "[joint.right_hip]\nflexion_deg = 60.0\n[joint.left_hip]\nflexion_deg = 60.0\n";
        let knees = hips.replace("hip", "knee").replace("60.0", flexion);
        format!("{hips}{knees}")
    };
    let crouching = format!(
        "{}{}",
        legs("75.0"),
        "[joint.right_ankle]\nflexion_deg = 15.0\n[joint.left_ankle]\nflexion_deg = 15.0\n"
    );
    let posture = read(&crouching, &skeleton).unwrap();
    assert!(skeleton.lowest(&posture).abs() < 1e-9);
    assert!(posture.root.translation.z < 80.0);
    let floating = read(&format!("ground = false\n{crouching}"), &skeleton).unwrap();
    assert_eq!(floating.root.translation.z, 81.2);
    assert!(skeleton.lowest(&floating) > 1.0);
    assert_eq!(floating.joints, posture.joints);
}

#[test]
fn a_reach_turns_the_joints_after_the_angles() {
    let skeleton = woman();
    let posture = read(SITTING, &skeleton).unwrap();
    let end = |name: &str| {
        let bone = skeleton.bone(name).unwrap();
        skeleton.bones()[bone].end(&skeleton.stand(&posture)[bone])
    };
    assert!((end("right_hand") - Vec3::new(-10.0, -30.0, 110.0)).norm() <= 0.5);
    let elbow = skeleton.joint("left_elbow").unwrap();
    let angles = skeleton.bones()[elbow].joint.angles(&posture.joints[elbow]);
    assert!((angles[0].to_degrees() - 90.0).abs() < 1e-9);
}

#[test]
fn postures_that_ship_are_within_the_limits_and_on_the_ground() {
    let skeleton = woman();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("bodies/poses");
    let mut names = Vec::new();
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let posture = scene::posture(&path, &skeleton).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(skeleton.exceeded(&posture), [], "{}", path.display());
        assert!(skeleton.lowest(&posture).abs() < 1e-9, "{}", path.display());
        names.push(path.file_stem().unwrap().to_str().unwrap().to_owned());
    }
    names.sort();
    let wanted = [
        "arms-down",
        "arms-out",
        "reaching-up",
        "sitting",
        "standing",
        "stride",
    ];
    assert_eq!(names, wanted);
}

#[test]
fn shipped_postures_are_what_they_are_called() {
    let skeleton = woman();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("bodies/poses");
    let ends = |name: &str| {
        let posture = scene::posture(&folder.join(format!("{name}.toml")), &skeleton).unwrap();
        let poses = skeleton.stand(&posture);
        move |bone: &str| {
            let bone = woman().bone(bone).unwrap();
            woman().bones()[bone].end(&poses[bone])
        }
    };
    let out = ends("arms-out");
    // Level to within a hand's thickness, and spread to both sides alike.
    for side in ["right", "left"] {
        let (elbow, hand) = (
            out(&format!("{side}_upper_arm")),
            out(&format!("{side}_hand")),
        );
        assert!((elbow.z - hand.z).abs() < 1.0, "{} {}", elbow.z, hand.z);
    }
    assert!((out("right_hand") + out("left_hand")).x.abs() < 1e-9);
    let up = ends("reaching-up");
    assert!(
        up("right_hand").z > up("head").z + 15.0,
        "{}",
        up("right_hand").z
    );
    let sitting = ends("sitting");
    assert!((sitting("right_thigh").z - sitting("right_hip_bone").z).abs() < 1e-9);
    assert!(sitting("right_hand").z > sitting("right_thigh").z);
    let stride = ends("stride");
    let (ahead, behind) = (stride("right_foot"), stride("left_foot"));
    assert!(
        (40.0..90.0).contains(&(behind.y - ahead.y)),
        "{ahead} {behind}"
    );
    assert!(ahead.z < 3.0 && behind.z < 3.0, "{ahead} {behind}");
    assert!(stride("left_hand").y < stride("right_hand").y - 30.0);
}
