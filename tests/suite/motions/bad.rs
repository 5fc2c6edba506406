//! One slip each in a motion that is right otherwise, and the message that it gets.

use crate::woman::woman;
use soen::scene;
use std::fs;

/// Nothing is wrong with it.
const KEYS: &str = r#"name = "nod"
cycle = true
travel_cm = [0.0, -10.0, 0.0]
leg_cm = 75.0
[[key]]
time_s = 0.0
[key.root]
move_cm = [0.0, 0.0, -1.0]
turn_deg = [0.0, 0.0, 5.0]
[key.joint.right_hip]
flexion_deg = 25.0
[[key]]
time_s = 0.5
[[key]]
time_s = 1.0
root = { move_cm = [0.0, 0.0, -1.0], turn_deg = [0.0, 0.0, 5.0] }
joint.right_hip.flexion_deg = 25.0
"#;

/// Nothing is wrong with it either: two legs and a trunk.
const CAPTURE: &str = "HIERARCHY
ROOT hips
{
OFFSET 0 0 0
CHANNELS 3 Xposition Yposition Zposition
JOINT lleg { OFFSET 9 0 0
CHANNELS 1 Xrotation
JOINT lshank { OFFSET 0 -40 0
End Site { OFFSET 0 -40 0 } } }
JOINT rleg { OFFSET -9 0 0
CHANNELS 1 Xrotation
JOINT rshank { OFFSET 0 -40 0
End Site { OFFSET 0 -40 0 } } }
}
MOTION
Frames: 3
Frame Time: 0.1
0 80 0 0 0
0 80 5 10 -10
0 80 10 0 0
";

const NAMES: &str = r#"name = "mine"
[bone]
pelvis = "hips"
left_thigh = "lleg"
right_thigh = { joint = "rleg" }
left_shank = "lshank"
right_shank = "rshank"
"#;

const PIECE: &str = r#"name = "piece"
capture = "walk.bvh"
names = "mine.toml"
from_s = 0.1
to_s = 0.2
within_limits = true
"#;

/// Which of the four files, what stands in it, what is written in its place, what the message says.
type Slip = (&'static str, &'static str, &'static str, &'static str);

const SLIPS: &[Slip] = &[
    (
        "nod.toml",
        "right_hip]",
        "rihgt_hip]",
        "unknown key \"rihgt_hip\" in key[1].joint; did you mean \"right_hip\"?",
    ),
    (
        "nod.toml",
        "right_hip]",
        "tail]",
        "unknown key \"tail\" in key[1].joint; allowed: waist, chest",
    ),
    (
        "nod.toml",
        "right_hip]",
        "root]",
        "unknown key \"root\" in key[1].joint",
    ),
    (
        "nod.toml",
        "right_hip]",
        "right_hip_bone]",
        "unknown key \"right_hip_bone\" in key[1].joint; did you mean \"right_hip\"?",
    ),
    (
        "nod.toml",
        "flexion_deg = 25.0\n[[",
        "flexoin_deg = 25.0\n[[",
        "unknown key \"flexoin_deg\" in key[1].joint.right_hip; did you mean \"flexion_deg\"?",
    ),
    (
        "nod.toml",
        "flexion_deg = 25.0\n[[",
        "flexion_deg = 135.0\n[[",
        "nod.toml:11:15: key[1].joint.right_hip.flexion_deg is 135.0; allowed: -30 to 120 degrees",
    ),
    (
        "nod.toml",
        "flexion_deg = 25.0\n[[",
        "flexion_deg = nan\n[[",
        "is nan; allowed: -30 to 120 degrees",
    ),
    (
        "nod.toml",
        "flexion_deg = 25.0\n[[",
        "flexion_deg = \"25\"\n[[",
        "is \"25\"; allowed: a number",
    ),
    (
        "nod.toml",
        "time_s = 0.5",
        "time_s = 0.0",
        "nod.toml:13:10: key[2].time_s is 0.0; allowed: above 0 s, the time of the key before",
    ),
    (
        "nod.toml",
        "time_s = 0.5",
        "time_s = 2.0",
        "key[3].time_s is 1.0; allowed: above 2 s",
    ),
    (
        "nod.toml",
        "time_s = 0.5",
        "time_s = inf",
        "key[2].time_s is inf; allowed",
    ),
    (
        "nod.toml",
        "time_s = 0.5",
        "",
        "missing key \"time_s\" in key[2]",
    ),
    (
        "nod.toml",
        "right_hip.flexion_deg = 25.0\n",
        "right_hip.flexion_deg = 20.0\n",
        "key[3]: the last key of a cycle must be its first again; right_hip is off by 5.000 degrees",
    ),
    (
        "nod.toml",
        "root = { move_cm = [0.0, 0.0, -1.0]",
        "root = { move_cm = [0.0, 0.0, -2.0]",
        "the root's place is off by 1.000 cm",
    ),
    (
        "nod.toml",
        "cycle = true",
        "cycle = false",
        "travel_cm is [0.0, -10.0, 0.0]; allowed: absent without cycle = true",
    ),
    (
        "nod.toml",
        "cycle = true",
        "cycel = true",
        "unknown key \"cycel\"; did you mean \"cycle\"?",
    ),
    (
        "nod.toml",
        "leg_cm = 75.0",
        "leg_cm = 0.0",
        "leg_cm is 0.0; allowed: 1 to 500 cm",
    ),
    (
        "nod.toml",
        "leg_cm = 75.0",
        "from_s = 0.0",
        "key, from_s exclude each other",
    ),
    (
        "nod.toml",
        "leg_cm = 75.0",
        "capture = \"walk.bvh\"",
        "key, capture exclude each other",
    ),
    (
        "nod.toml",
        "move_cm = [0.0, 0.0, -1.0]\n",
        "move_cm = [0.0, 0.0]\n",
        "key[1].root.move_cm is [0.0, 0.0]; allowed: a list of 3 numbers",
    ),
    (
        "nod.toml",
        "turn_deg = [0.0, 0.0, 5.0]\n",
        "turn_deg = [0.0, 0.0, inf]\n",
        "key[1].root.turn_deg[3] is inf; allowed: -3600 to 3600 degrees",
    ),
    (
        "piece.toml",
        "walk.bvh",
        "wlak.bvh",
        "capture is \"wlak.bvh\": no such file",
    ),
    (
        "piece.toml",
        "mine.toml",
        "yours.toml",
        "names is \"yours.toml\": no such file",
    ),
    (
        "piece.toml",
        "mine.toml",
        "cum",
        "names is \"cum\"; allowed: cmu, makehuman, makehuman-old, the name of a file in bodies/motions/names/",
    ),
    (
        "piece.toml",
        "mine.toml",
        "cmu",
        "bone.head is \"head\"; allowed: a joint of the capture",
    ),
    (
        "piece.toml",
        "names = \"mine.toml\"",
        "",
        "walk.bvh: no table of joint names fits joints hips, lleg, lshank, rleg, rshank",
    ),
    (
        "piece.toml",
        "to_s = 0.2",
        "to_s = 0.05",
        "to_s is 0.05; allowed: from_s to 0.200 s, with a frame between",
    ),
    (
        "piece.toml",
        "from_s = 0.1\nto_s = 0.2",
        "from_s = 9.0",
        "from_s is 9.0; allowed: 0 to 0.200 s",
    ),
    (
        "piece.toml",
        "from_s = 0.1",
        "from_s = -1.0",
        "from_s is -1.0; allowed: 0 to",
    ),
    (
        "piece.toml",
        "capture = \"walk.bvh\"",
        "",
        "missing key \"one of key, capture\"",
    ),
    (
        "piece.toml",
        "to_s = 0.2",
        "cycle = true",
        "capture, cycle exclude each other",
    ),
    (
        "mine.toml",
        "pelvis = \"hips\"",
        "pelvis = \"hipps\"",
        "mine.toml:3:10: bone.pelvis is \"hipps\"; allowed: a joint of the capture; did you mean \"hips\"?",
    ),
    (
        "mine.toml",
        "pelvis = \"hips\"",
        "pelvsi = \"hips\"",
        "unknown key \"pelvsi\" in [bone]; did you mean \"pelvis\"?",
    ),
    (
        "mine.toml",
        "pelvis = \"hips\"",
        "",
        "no joint is given for pelvis",
    ),
    (
        "mine.toml",
        "left_thigh = \"lleg\"",
        "",
        "no joint is given for left_thigh",
    ),
    (
        "mine.toml",
        "left_thigh = \"lleg\"",
        "left_thigh = 3",
        "bone.left_thigh is 3; allowed: a joint's name in quotes or a table with joint, end, twist",
    ),
    (
        "mine.toml",
        "{ joint = \"rleg\" }",
        "{ joint = \"rleg\", tip = \"x\" }",
        "unknown key \"tip\"",
    ),
    (
        "walk.bvh",
        "Frame Time: 0.1",
        "Frame Time: 0",
        "walk.bvh: line 17: frame time is \"0\"; allowed: 0.0001 to 60 s",
    ),
    (
        "walk.bvh",
        "0 80 5 10 -10",
        "0 80 5 nan -10",
        "walk.bvh: line 19, value 4: Xrotation of joint \"lleg\" is \"nan\"; allowed: a finite number",
    ),
    (
        "walk.bvh",
        "0 80 10 0 0\n",
        "",
        "walk.bvh: 3 frames announced, 2 found: the file may be cut off",
    ),
    (
        "walk.bvh",
        "0 80 10 0 0\n",
        "0 80 1",
        "walk.bvh: line 20: frame 3 has 3 values; allowed: 5",
    ),
    (
        "walk.bvh",
        "ROOT hips\n{",
        "",
        "walk.bvh: line 3: found \"OFFSET 0 0 0\"; allowed: ROOT or MOTION",
    ),
    (
        "walk.bvh",
        "ROOT hips\n",
        "JOINT hips\n",
        "walk.bvh: line 2: the hierarchy has 0 roots; allowed: 1",
    ),
    (
        "walk.bvh",
        "Frames: 3",
        "Frames: 100001",
        "walk.bvh: line 16: 100001 frames; allowed: 1 to 100000",
    ),
    (
        "walk.bvh",
        "OFFSET 9 0 0",
        "OFFSET -9 0 0",
        "which way is left cannot be told",
    ),
    (
        "walk.bvh",
        "HIERARCHY",
        "BINARY",
        "walk.bvh: line 1: found \"BINARY\"; allowed: HIERARCHY",
    ),
];

#[test]
fn every_slip_gets_its_message() {
    let mut wrong = Vec::new();
    for (file, right, slip, says) in SLIPS {
        let folder = tempfile::tempdir().unwrap();
        let files = [
            ("nod.toml", KEYS),
            ("walk.bvh", CAPTURE),
            ("mine.toml", NAMES),
            ("piece.toml", PIECE),
        ];
        for (name, text) in files {
            let text = match name == *file {
                true => {
                    assert!(text.contains(right), "{right:?} is not in {name}");
                    text.replacen(right, slip, 1)
                }
                false => text.to_owned(),
            };
            fs::write(folder.path().join(name), text).unwrap();
        }
        let read = if *file == "nod.toml" {
            "nod.toml"
        } else {
            "piece.toml"
        };
        match scene::motion(folder.path().join(read), &woman()) {
            Ok(_) => wrong.push(format!("{slip}: read without a word")),
            Err(error) if !error.to_string().contains(says) => {
                wrong.push(format!("{slip}:\n{error}\n  without {says}"));
            }
            Err(_) => (),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn the_files_without_a_slip_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).unwrap();
        scene::motion(folder.path().join(name), &woman())
    };
    let nod = put("nod.toml", KEYS).unwrap();
    assert_eq!((nod.name(), nod.duration()), ("nod", 1.0));
    let hip = woman().joint("right_hip").unwrap();
    let angle = nod.at(7.0).joints[hip].angle().to_degrees();
    assert!((angle - 25.0).abs() < 1e-9);
    assert!((nod.at(2.0).root.translation.vector.y + 20.0).abs() < 1e-9);
    assert!((nod.at(0.0).root.rotation.angle().to_degrees() - 5.0).abs() < 1e-9);

    put("walk.bvh", CAPTURE).unwrap_err();
    put("mine.toml", NAMES).unwrap_err();
    let piece = put("piece.toml", PIECE).unwrap();
    assert_eq!((piece.name(), piece.keys().len()), ("piece", 2));
    assert!((piece.duration() - 0.1).abs() < 1e-12);
    // 5 forward by legs of 80 are 75/80 of it by ours.
    let way = piece.at(0.1).root.translation.vector - piece.at(0.0).root.translation.vector;
    assert!((way.y + 5.0 * 75.0 / 80.0).abs() < 1e-9, "{way}");
}

#[test]
fn names_that_nobody_knows_and_files_that_are_not_there() {
    let said = |path: &str| scene::motion(path, &woman()).unwrap_err().to_string();
    assert!(
        said("wlak").contains("motion is \"wlak\"; allowed: walk, run, jump, the name of a file")
    );
    assert!(said("wlak").ends_with("did you mean \"walk\"?"));
    assert!(said("none.toml").contains("none.toml: cannot be read"));
    assert!(said("none.bvh").contains("none.bvh: cannot be read"));
    let said = scene::mapping("mkehuman").unwrap_err().to_string();
    assert!(said.contains("did you mean \"makehuman\"?"), "{said}");
}
