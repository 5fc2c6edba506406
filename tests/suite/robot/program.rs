//! `soen robot`: what it prints, what it writes and how it exits.

use crate::trial::Trial;
use soen::{
    body::{Format, Mesh, Unit, Up},
    robot::{Girth, PEOPLE},
    skeleton::POSES,
};
use std::fs;

#[test]
fn help_names_options_people_poses_and_exit_codes() {
    let help = Trial::new().run(&["robot", "--help"]);
    assert_eq!(help.code, 0);
    let names = PEOPLE.iter().chain(&POSES).map(|(name, _)| *name);
    let words = [
        "--pose",
        "--reach",
        "--out",
        "--mesh",
        "--view",
        "--json",
        "2 bad input",
    ];
    for word in names.chain(words) {
        assert!(help.out.contains(word), "without {word:?}:\n{}", help.out);
    }
}

#[test]
fn the_table_has_every_measurement_and_joint() {
    let said = Trial::new().run(&["robot", "man-170", "--pose", "sitting"]);
    assert_eq!(said.code, 0, "{}", said.err);
    for girth in Girth::ALL {
        let name = format!("{girth} girth").replace('_', " ");
        assert!(said.out.contains(&name), "without {name}:\n{}", said.out);
    }
    for part in [
        "stature",
        "170.0",
        "hip width",
        "balls",
        "below the skin",
        "0° to 135°",
    ] {
        assert!(said.out.contains(part), "without {part:?}:\n{}", said.out);
    }
    let knee = said.out.lines().find(|line| line.starts_with("right_knee"));
    assert!(knee.unwrap().contains("90.0°"), "{}", said.out);
    assert!(!said.out.contains("beyond its limits"));
}

#[test]
fn the_report_has_units_in_its_keys() {
    let trial = Trial::new();
    let wish = [
        "robot",
        "child-120",
        "--pose",
        "arms-out",
        "--json",
        "--reach",
    ];
    let said = trial.run(&[&wish[..], &["right_hand=-40,-20,100"]].concat());
    assert_eq!(said.code, 0, "{}", said.err);
    let report: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(report["format"], "soen-robot/1");
    assert_eq!(report["measurements"][0]["name"], "stature");
    assert_eq!(report["measurements"][0]["asked_cm"], 120.0);
    assert_eq!(report["girths"].as_array().unwrap().len(), 12);
    assert!(report["girths"][1]["built_cm"].is_f64());
    assert!(report["deepest_trunk_dent_cm"].as_f64().unwrap() < 0.5);
    assert_eq!(report["beyond_limits"], serde_json::json!([]));
    let joints = report["joints"].as_array().unwrap();
    let of = |name: &str| joints.iter().find(|joint| joint["name"] == name).unwrap();
    let shoulder = &of("left_shoulder")["angles"][1];
    assert_eq!(shoulder["name"], "abduction");
    assert_eq!(shoulder["angle_deg"], 75.0);
    assert_eq!(shoulder["greatest_deg"], 150.0);
    assert_eq!(report["reaches"][0]["reached"], true);
    assert!(report["reaches"][0]["miss_cm"].as_f64().unwrap() < 0.5);
}

#[test]
fn a_hand_that_does_not_come_to_its_point_says_by_how_far() {
    let said = Trial::new().run(&["robot", "woman-158", "--reach", "right_hand=-300,0,120"]);
    assert_eq!(said.code, 0, "{}", said.err);
    let line = said
        .out
        .lines()
        .find(|line| line.starts_with("NOT reached"));
    let line = line.unwrap();
    assert!(line.contains("right_hand ends ") && line.contains("from (-300, 0, 120) cm"));
}

#[test]
fn every_file_is_written_and_the_skin_is_a_solid_for_cloth() {
    let trial = Trial::new();
    let read = |name: &str| fs::read(trial.path().join(name)).unwrap();
    for (ending, format) in [
        ("obj", Format::Obj),
        ("stl", Format::Stl),
        ("ply", Format::Ply),
    ] {
        let path = format!("new/skin.{ending}");
        let mut wish = vec!["robot", "child-120", "--mesh", &path];
        if ending == "obj" {
            wish.extend(["--out", "new/out", "--pose", "stride"]);
        }
        let said = trial.run(&wish);
        assert_eq!(said.code, 0, "{}", said.err);
        assert!(
            said.out.contains(&format!("written: {path}")),
            "{}",
            said.out
        );
        let skin = Mesh::read(&read(&path), format, Unit::Centimetre, Up::Z).unwrap();
        let found = skin.inspection();
        println!("{path}: {found}");
        assert!(found.closed && found.components == 1 && found.flipped == 0);
        let top = skin.vertices.iter().map(|v| v.z).fold(0.0, f64::max);
        assert!((115.0..121.0).contains(&top), "{top}");
    }
    assert!(read("new/out/robot.png").starts_with(b"\x89PNG"));
    assert!(read("new/out/bones.png").starts_with(b"\x89PNG"));
    let report: serde_json::Value = serde_json::from_slice(&read("new/out/report.json")).unwrap();
    let text = String::from_utf8(read("new/out/robot.obj")).unwrap();
    let objects = |kind: &str| text.lines().filter(|line| line.starts_with(kind)).count();
    assert_eq!(objects("l "), 21);
    let (bones, balls) = (objects("o bone_"), report["balls"].as_u64().unwrap());
    assert_eq!((bones, objects("o ") as u64), (21, balls + 21));
    // The picture is taken of it; another program can read it too.
    let mut bytes = text.as_bytes();
    let (models, _) = tobj::load_obj_buf(&mut bytes, &tobj::LoadOptions::default(), |_| {
        Ok(Default::default())
    })
    .unwrap();
    assert!(models.iter().any(|model| model.name == "left_thigh_3"));
}

#[test]
fn slips_are_bad_input_and_cost_no_file() {
    let trial = Trial::new();
    let woman = PEOPLE[0].1;
    trial.put(
        "thin.toml",
        woman
            .replace("waist_cm = 64.0", "waist_cm = 6.4")
            .as_bytes(),
    );
    trial.put("far.toml", b"[joint.left_knee]\nflexion_deg = 140.0\n");
    trial.put("skin.fbx", b"kept");
    trial.put("skin.obj/kept", b"kept");
    let cases: [(&[&str], &[&str]); 9] = [
        (&["robot"], &["PERSON"]),
        (
            &["robot", "woman"],
            &["person is \"woman\"", "woman-158, man-170, child-120"],
        ),
        (&["robot", "nobody.toml"], &["nobody.toml"]),
        (
            &["robot", "thin.toml"],
            &["thin.toml:", "waist_cm is 6.4; allowed:", "^^^"],
        ),
        (
            &["robot", "man-170", "--pose", "siting"],
            &["pose is \"siting\"", "\"sitting\"?"],
        ),
        (
            &["robot", "man-170", "--pose", "far.toml"],
            &["joint.left_knee.flexion_deg is 140.0; allowed: 0 to 135 degrees"],
        ),
        (
            &["robot", "man-170", "--reach", "tail=1,2,3"],
            &["tail", "right_hand"],
        ),
        (
            &["robot", "man-170", "--reach", "right_hand=1,nan,3"],
            &["allowed: a bone and"],
        ),
        (
            &["robot", "man-170", "--mesh", "skin.fbx"],
            &["skin.fbx", ".obj, .stl or .ply"],
        ),
    ];
    for (wish, parts) in cases {
        let said = trial.run(
            &[
                wish,
                if wish.len() > 1 {
                    &["--out", "out"]
                } else {
                    &[]
                },
            ]
            .concat(),
        );
        assert_eq!(said.code, 2, "{wish:?}: {}", said.err);
        for part in parts {
            assert!(
                said.err.contains(part),
                "{wish:?} without {part:?}:\n{}",
                said.err
            );
        }
    }
    // A folder stands where the skin should.
    let said = trial.run(&["robot", "man-170", "--mesh", "skin.obj"]);
    assert_eq!(said.code, 1, "{}", said.err);
    assert!(trial.kept() && !trial.path().join("out/robot.png").exists());
    let read = |name: &str| fs::read(trial.path().join(name)).unwrap();
    assert_eq!(
        [read("skin.fbx"), read("skin.obj/kept")],
        [b"kept", b"kept"]
    );
}
