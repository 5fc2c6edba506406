//! The people that ship have bodies as measured, and bad files of people get their messages.

#![allow(
    clippy::print_stdout,
    reason = "the figures are told to who asks with --nocapture"
)]

use soen::{
    robot::{Girth, Robot},
    scene::person,
};
use std::{fs, path::Path};

const SHIPPED: [&str; 3] = ["woman-158", "man-170", "child-120"];

fn shipped(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("bodies");
    fs::read_to_string(folder.join(name).with_extension("toml")).unwrap()
}

/// What is said of a file with this text.
fn said(text: &str) -> Result<soen::robot::Measurements, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("someone.toml");
    fs::write(&path, text).unwrap();
    person(&path).map_err(|error| error.to_string())
}

#[test]
fn those_that_ship_have_the_girths_of_their_files() {
    for name in SHIPPED {
        let person = said(&shipped(name)).unwrap();
        let robot = Robot::new(&person).unwrap();
        for girth in Girth::ALL {
            let (asked, built) = (person.girths.of(girth), robot.girth(girth));
            println!("{name} {girth}: {built:.2} cm, asked {asked} cm");
            assert!((built - asked).abs() < 1.0, "{name} {girth}: {built}");
        }
    }
}

#[test]
fn lengths_and_a_missing_head_are_read() {
    let text = shipped("woman-158").replace("head = true", "head = false");
    let person = said(&(text + "[lengths]\nthigh_cm = 39.0\n")).unwrap();
    assert_eq!((person.head, person.lengths.thigh), (false, Some(39.0)));
    assert!(
        Robot::new(&person)
            .unwrap()
            .skeleton()
            .bone("head")
            .is_none()
    );
}

#[test]
fn bad_files_are_told_where_and_what_is_allowed() {
    // What is changed, into what, and what the message must hold.
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "stature_cm = 158.0",
            "stature_cm = 1.58",
            &[
                "someone.toml:4:14: stature_cm is 1.58; allowed: 60 to 280 cm",
                "^^^^",
            ],
        ),
        (
            "stature_cm = 158.0",
            "stature_cm = nan",
            &["stature_cm is nan; allowed: 60 to 280 cm"],
        ),
        (
            "stature_cm = 158.0",
            "stature_cm = inf",
            &["stature_cm is inf; allowed"],
        ),
        (
            "stature_cm = 158.0",
            "stature_cm = \"158\"",
            &["stature_cm is \"158\"; allowed: a number"],
        ),
        ("stature_cm = 158.0\n", "", &["missing key \"stature_cm\""]),
        ("stature_cm", "height_cm", &["unknown key \"height_cm\""]),
        (
            "sitting_height_cm = 85.8",
            "sitting_height_cm = 158.0",
            &["sitting_height_cm is 158.0; allowed: 71.1 to 102.7 cm for that stature"],
        ),
        (
            "hip_width_cm = 32.0",
            "hip_width_cm = 40.0",
            &["hip_width_cm is 40.0; allowed: 29 to 36.2 cm for that hip girth"],
        ),
        (
            "waist_cm = 64.0",
            "waist_cm = -64.0",
            &["girths.waist_cm is -64.0; allowed: 34.8 to 189.6 cm for that stature"],
        ),
        (
            "waist_cm",
            "waste_cm",
            &[
                "unknown key \"waste_cm\" in [girths]",
                "did you mean \"waist_cm\"?",
            ],
        ),
        (
            "calf_cm = 34.0\n",
            "",
            &["missing key \"calf_cm\" in [girths]"],
        ),
        (
            "[girths]",
            "[girth]",
            &["unknown key \"girth\"", "did you mean \"girths\"?"],
        ),
        (
            "head = true",
            "head = 1",
            &["head is 1; allowed: true or false"],
        ),
        (
            "[girths]",
            "[lengths]\nfoot_cm = 234.0\n[girths]",
            &["lengths.foot_cm is 234.0; allowed: 12.6 to 34.8 cm for that stature"],
        ),
        (
            "[girths]",
            "[lengths]\nthigh_cm = 50.0\nshank_cm = 50.0\n[girths]",
            &["lengths.shank_cm is 50.0; allowed: 20.8 to 29.5 cm beside that thigh"],
        ),
        (
            "[girths]",
            "[lengths]\nforarm_cm = 22.0\n[girths]",
            &[
                "unknown key \"forarm_cm\" in [lengths]",
                "did you mean \"forearm_cm\"?",
            ],
        ),
        (
            "[girths]",
            "girths = 3\n[more]",
            &["girths is 3; allowed: a table"],
        ),
        ("[girths]", "[girths", &["not valid TOML"]),
        (
            "under_bust_cm = 72.0",
            "under_bust_cm = 150.0",
            &["girths nearer to the others"],
        ),
    ];
    let right = shipped("woman-158");
    for (before, after, expected) in cases {
        let text = right.replacen(before, after, 1);
        assert_ne!(text, right, "{before:?} is not in the file");
        let message = said(&text).unwrap_err();
        println!("{message}\n");
        for words in *expected {
            assert!(message.contains(words), "{words:?} is not in\n{message}");
        }
    }
    assert!(said("").unwrap_err().contains("is empty"));
}
