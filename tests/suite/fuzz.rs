//! No bytes make the readers of scenes, fabrics, body files and measurement sheets panic: each is read, or refused
//! with a message that begins with a file's name.
//!
//! `PROPTEST_CASES=100000 cargo test --test suite fuzz` looks longer.

use crate::{
    fit::slips::{CURVE, FAST, KES, SHEAR, SHEET},
    trial::SCENE,
};
use proptest::prelude::*;
use soen::{fabric::swatch, scene};
use std::fs;

const BODY: &str = r#"name = "two"
[[part]]
name = "left"
capsule = { radius_cm = 4.0, length_cm = 10.0 }
at_cm = [-12.0, 0.0, 0.0]
[[part]]
convex_hull = { points_cm = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]] }
rotate_deg = [0.0, 0.0, 90.0]
"#;

const WORDS: [&str; 24] = [
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "1e308",
    "1e-308",
    "9223372036854775807",
    "\"\"",
    "\"c\"",
    "[]",
    "[[]]",
    "{}",
    "true",
    "=",
    "\n",
    "[",
    "]",
    "[[hold]]",
    "[cloth]",
    "outline_cm =",
    "file = \"x.toml\"",
    "\u{0}",
    "\u{FEFF}",
];

/// One slip of a hand or a disk.
#[derive(Clone, Debug)]
enum Slip {
    Put(usize, u8),
    Cut(usize, usize),
    Say(usize, &'static str),
    Swap(usize, usize),
}

fn slips() -> impl Strategy<Value = Vec<Slip>> {
    let place = || 0..1000usize;
    let one = prop_oneof![
        (place(), any::<u8>()).prop_map(|(at, byte)| Slip::Put(at, byte)),
        (place(), 0..60usize).prop_map(|(at, length)| Slip::Cut(at, length)),
        (place(), prop::sample::select(&WORDS[..])).prop_map(|(at, word)| Slip::Say(at, word)),
        (place(), place()).prop_map(|(a, b)| Slip::Swap(a, b)),
    ];
    prop::collection::vec(one, 1..5)
}

/// The text with its slips; a word takes the place of the value on its line.
fn spoilt(text: &str, slips: &[Slip]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for slip in slips {
        let count = bytes.len().max(1);
        match *slip {
            Slip::Put(at, byte) => bytes.insert(at % count, byte),
            Slip::Cut(at, length) => {
                let from = at % count;
                bytes.drain(from..(from + length).min(bytes.len()));
            }
            Slip::Say(at, word) => say(&mut bytes, at, word),
            Slip::Swap(a, b) => {
                let mut lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
                let count = lines.len();
                lines.swap(a % count, b % count);
                bytes = lines.join(&b'\n');
            }
        }
        if bytes.is_empty() {
            bytes.push(b'\n');
        }
    }
    bytes
}

fn say(bytes: &mut Vec<u8>, at: usize, word: &str) {
    let lines: Vec<&[u8]> = bytes.split(|byte| *byte == b'\n').collect();
    let mut lines: Vec<Vec<u8>> = lines.into_iter().map(<[u8]>::to_vec).collect();
    let count = lines.len();
    let line = &mut lines[at % count];
    if let Some(equals) = line.iter().position(|byte| *byte == b'=') {
        line.truncate(equals + 1);
    }
    line.extend_from_slice(word.as_bytes());
    *bytes = lines.join(&b'\n');
}

/// Reads a scene whose fabric and body are files beside it.
fn read(scene: &[u8], fabric: &[u8], body: &[u8]) -> Result<(), TestCaseError> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("scene.toml"), scene).unwrap();
    fs::write(path("mine.toml"), fabric).unwrap();
    fs::write(path("two.toml"), body).unwrap();
    match scene::read(&path("scene.toml")) {
        Ok(scene) => {
            let problem = &scene.problem;
            prop_assert!(problem.fabric.clone().checked().is_ok());
            prop_assert!(problem.friction.is_finite() && problem.thickness > 0.0);
            prop_assert!(problem.piece.pitch > 0.0 && problem.piece.outline.area() > 0.0);
            let Placement {
                centre,
                x_axis,
                y_axis,
                ..
            } = problem.placement;
            prop_assert!(centre.iter().all(|x| x.is_finite()));
            prop_assert!(x_axis.dot(&y_axis).abs() < 1e-5);
            prop_assert!((x_axis.norm() - 1.0).abs() < 1e-12);
        }
        Err(error) => {
            let message = error.to_string();
            prop_assert!(message.contains(".toml"), "{message}");
            prop_assert!(message.lines().all(|line| line.chars().count() < 2000));
        }
    }
    Ok(())
}

/// Reads a measurement sheet whose records are files beside it.
fn measure(sheet: &[u8], curve: &[u8], shear: &[u8]) -> Result<(), TestCaseError> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("sheet.toml"), sheet).unwrap();
    fs::write(path("curve.csv"), curve).unwrap();
    fs::write(path("shear.csv"), shear).unwrap();
    match scene::measured(&path("sheet.toml")) {
        Ok(measured) => {
            let text = soen::output::fabric_file(&measured);
            fs::write(path("found.toml"), text).unwrap();
            let found = scene::fabric(path("found.toml").to_str().unwrap());
            prop_assert_eq!(found.unwrap(), measured.fabric);
        }
        Err(error) => {
            let message = error.to_string();
            prop_assert!(message.lines().all(|line| line.chars().count() < 2000));
        }
    }
    Ok(())
}

use soen::solver::Placement;

fn whole() -> (String, &'static str) {
    let scene = SCENE.replace("\"c\"", "\"mine.toml\"") + "[[body]]\nfile = \"two.toml\"\n";
    (scene, swatch("c").unwrap())
}

#[test]
fn without_slips_all_three_files_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, fabric) = whole();
    fs::write(folder.path().join("scene.toml"), scene).unwrap();
    fs::write(folder.path().join("mine.toml"), fabric).unwrap();
    fs::write(folder.path().join("two.toml"), BODY).unwrap();
    let read = scene::read(&folder.path().join("scene.toml")).unwrap();
    let names: Vec<&str> = read
        .problem
        .bodies
        .parts()
        .iter()
        .map(|part| part.name())
        .collect();
    assert_eq!(names, ["body 1", "body 2, left", "body 2, part 2"]);
}

proptest! {
    #[test]
    fn a_spoilt_scene_is_read_or_refused(slips in slips()) {
        let (scene, fabric) = whole();
        read(&spoilt(&scene, &slips), fabric.as_bytes(), BODY.as_bytes())?;
    }

    #[test]
    fn a_spoilt_fabric_is_read_or_refused(slips in slips()) {
        let (scene, fabric) = whole();
        read(scene.as_bytes(), &spoilt(fabric, &slips), BODY.as_bytes())?;
    }

    #[test]
    fn a_spoilt_body_is_read_or_refused(slips in slips()) {
        let (scene, fabric) = whole();
        read(scene.as_bytes(), fabric.as_bytes(), &spoilt(BODY, &slips))?;
    }

    #[test]
    fn a_spoilt_sheet_is_read_or_refused(slips in slips()) {
        for sheet in [SHEET, KES, FAST] {
            measure(&spoilt(sheet, &slips), CURVE.as_bytes(), SHEAR.as_bytes())?;
        }
    }

    #[test]
    fn a_spoilt_record_is_read_or_refused(slips in slips()) {
        measure(SHEET.as_bytes(), &spoilt(CURVE, &slips), SHEAR.as_bytes())?;
        measure(SHEET.as_bytes(), CURVE.as_bytes(), &spoilt(SHEAR, &slips))?;
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let (scene, fabric) = whole();
        read(&bytes, fabric.as_bytes(), BODY.as_bytes())?;
        read(scene.as_bytes(), &bytes, BODY.as_bytes())?;
        read(scene.as_bytes(), fabric.as_bytes(), &bytes)?;
        measure(&bytes, CURVE.as_bytes(), SHEAR.as_bytes())?;
        measure(SHEET.as_bytes(), &bytes, &bytes)?;
    }
}
