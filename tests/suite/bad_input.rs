//! One slip each in a scene that is right otherwise: exit code 2, and a message that names the
//! file, the line and what is allowed.

mod meanings;

use crate::trial::{SCENE, Said, Trial};
use meanings::MEANINGS;

/// What stands in the scene, what is written in its place, and what the message must say.
type Slip = (&'static str, &'static str, &'static [&'static str]);

const KEYS: &[Slip] = &[
    ("fabric = \"c\"", "", &["missing key \"fabric\" in [cloth]"]),
    (
        "spacing_cm = 2.0",
        "",
        &["missing key \"spacing_cm\" in [cloth]"],
    ),
    (
        "spacing_cm = 2.0",
        "spacing = 2.0",
        &[
            ":6:1:",
            "unknown key \"spacing\" in [cloth]",
            "did you mean \"spacing_cm\"?",
            "^^^^^^^",
        ],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "",
        &["missing key \"one of size_cm, disc_radius_cm, outline_cm\""],
    ),
    (
        "grain_deg = 0.0",
        "disc_radius_cm = 5.0",
        &["size_cm, disc_radius_cm exclude each other in [cloth]"],
    ),
    (
        "grain_deg = 0.0",
        "holes_cm = [[[0, 0], [1, 0], [0, 1]]]",
        &["size_cm, holes_cm exclude each other"],
    ),
    (
        "grain_deg = 0.0",
        "grain = 0.0",
        &["unknown key \"grain\"", "did you mean \"grain_deg\"?"],
    ),
    (
        "title = \"trial\"",
        "colour = \"red\"",
        &["unknown key \"colour\"; allowed: title, seed, cloth"],
    ),
    (
        "[cloth]",
        "[cloht]",
        &["unknown key \"cloht\"; did you mean \"cloth\"?"],
    ),
    ("[contact]", "[[contact]]", &["contact", "allowed: a table"]),
    (
        "[[hold]]",
        "[hold]",
        &["hold is [hold]", "allowed: tables, each headed [[hold]]"],
    ),
    (
        "point_cm = [-10.0, 10.0]",
        "",
        &["missing key \"one of point_cm, edge\" in hold[1]"],
    ),
    (
        "[[body]]",
        "edge = \"x-min\"\n[[body]]",
        &["point_cm, edge exclude each other in hold[1]"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "",
        &["missing key \"one of ball, capsule", "in body[1]"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "ball = { radius_cm = 10.0 }\ncuboid = { size_cm = [1, 1, 1] }",
        &["ball, cuboid exclude each other"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "ball = [10.0]",
        &["body[1].ball is [10.0]; allowed: a table"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "ball = {}",
        &["missing key \"radius_cm\" in body[1].ball"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "ball = { diameter_cm = 10.0 }",
        &["unknown key \"diameter_cm\" in body[1].ball"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "boll = { radius_cm = 10.0 }",
        &["unknown key \"boll\" in body[1]", "did you mean \"ball\"?"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "capsule = { radius_cm = 10.0 }",
        &["missing key \"length_cm\" in body[1].capsule"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "mesh = { file = \"x.obj\" }",
        &["missing key \"unit\" in body[1].mesh"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "convex_hull = { file = \"hull.obj\" }",
        &["missing key \"unit\" in body[1].convex_hull"],
    ),
    (
        "seed = 1",
        "seed = 1\nseed = 2",
        &[":3:1:", "duplicate key"],
    ),
];

const NUMBERS: &[Slip] = &[
    (
        "spacing_cm = 2.0",
        "spacing_cm = -2.0",
        &[
            ":6:14: cloth.spacing_cm is -2.0; allowed: 0.01 to 50 cm",
            "6 | spacing_cm = -2.0",
            "^^^^",
        ],
    ),
    (
        "spacing_cm = 2.0",
        "spacing_cm = 0",
        &["cloth.spacing_cm is 0; allowed: 0.01 to 50 cm"],
    ),
    (
        "spacing_cm = 2.0",
        "spacing_cm = nan",
        &["cloth.spacing_cm is nan; allowed: 0.01 to 50 cm"],
    ),
    (
        "spacing_cm = 2.0",
        "spacing_cm = inf",
        &["cloth.spacing_cm is inf; allowed"],
    ),
    (
        "spacing_cm = 2.0",
        "spacing_cm = \"2\"",
        &["cloth.spacing_cm is \"2\"; allowed: a number"],
    ),
    (
        "spacing_cm = 2.0",
        "spacing_cm = [2.0]",
        &["cloth.spacing_cm is [2.0]; allowed: a number"],
    ),
    (
        "spacing_cm = 2.0",
        "spacing_cm = 1e999",
        &["cloth.spacing_cm is"],
    ),
    (
        "size_cm = [20.0, 20.0]\nspacing_cm = 2.0",
        "size_cm = [200, 200]\nspacing_cm = 0.01",
        &[
            "cloth.spacing_cm is 0.01",
            "at most 4000000 are allowed",
            "or more would fit",
        ],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "size_cm = [20.0, 0.0]",
        &["cloth.size_cm[2] is 0.0; allowed: 0.01 to 10000 cm"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "size_cm = [-20.0, 20.0]",
        &["cloth.size_cm[1] is -20.0; allowed"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "size_cm = [20.0]",
        &["cloth.size_cm is [20.0]; allowed: a list of 2 numbers"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "size_cm = [20.0, 20.0, 1.0]",
        &["cloth.size_cm is [20.0, 20.0, 1.0]; allowed: a list of 2 numbers"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "size_cm = 20.0",
        &["cloth.size_cm is 20.0; allowed: a list"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "size_cm = [20.0, true]",
        &["cloth.size_cm[2] is true; allowed: a number"],
    ),
    (
        "size_cm = [20.0, 20.0]",
        "disc_radius_cm = -1",
        &["cloth.disc_radius_cm is -1; allowed"],
    ),
    (
        "seed = 1",
        "seed = -1",
        &["seed is -1; allowed: a whole number, 0 or more"],
    ),
    (
        "seed = 1",
        "seed = 1.5",
        &["seed is 1.5; allowed: a whole number"],
    ),
    ("seed = 1", "seed = 99999999999999999999", &["seed"]),
    (
        "title = \"trial\"",
        "title = 5",
        &["title is 5; allowed: a text in quotes"],
    ),
    (
        "title = \"trial\"",
        "title = trial",
        &[":1:9:", "not valid TOML"],
    ),
    (
        "grain_deg = 0.0",
        "grain_deg = 1e6",
        &["cloth.grain_deg is 1e6; allowed: -360 to 360 degrees"],
    ),
    (
        "centre_cm = [0.0, 0.0, 25.0]",
        "centre_cm = [0.0, 0.0, nan]",
        &["cloth.centre_cm[3] is nan; allowed"],
    ),
    (
        "centre_cm = [0.0, 0.0, 25.0]",
        "centre_cm = [0.0, 0.0]",
        &["allowed: a list of 3 numbers"],
    ),
    (
        "x_axis = [1.0, 0.0, 0.0]",
        "x_axis = [0.0, 0.0, 0.0]",
        &["cloth.x_axis is [0.0, 0.0, 0.0]; allowed: a direction"],
    ),
    (
        "x_axis = [1.0, 0.0, 0.0]",
        "x_axis = [1.0, 0.1, 0.0]",
        &["allowed: x_axis and y_axis at a right angle"],
    ),
    (
        "x_axis = [1.0, 0.0, 0.0]",
        "x_axis = [inf, 0.0, 0.0]",
        &["cloth.x_axis is [inf, 0.0, 0.0]; allowed"],
    ),
    (
        "radius_cm = 10.0",
        "radius_cm = 0.0",
        &["body[1].ball.radius_cm is 0.0; allowed: 0.01 to 10000 cm"],
    ),
    (
        "radius_cm = 10.0",
        "radius_cm = -10.0",
        &["body[1].ball.radius_cm is -10.0; allowed"],
    ),
    (
        "radius_cm = 10.0",
        "radius_cm = nan",
        &["body[1].ball.radius_cm is nan; allowed"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "cuboid = { size_cm = [1, 1, 0] }",
        &["body[1].cuboid.size_cm[3] is 0; allowed"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "cone = { radius_cm = 1, height_cm = -1 }",
        &["body[1].cone.height_cm is -1; allowed"],
    ),
    (
        "ball = { radius_cm = 10.0 }",
        "convex_hull = { points_cm = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }",
        &["body[1].convex_hull", "no volume"],
    ),
    (
        "at_cm = [0.0, 0.0, 5.0]",
        "rotate_deg = [0.0, inf, 0.0]",
        &["body[1].rotate_deg[2] is inf; allowed"],
    ),
    (
        "friction = 0.3",
        "friction = -0.1",
        &["contact.friction is -0.1; allowed: 0 to 5"],
    ),
    (
        "thickness_cm = 0.05",
        "thickness_cm = 0.0",
        &["contact.thickness_cm is 0.0; allowed: 0.0001 to 2 cm"],
    ),
    (
        "tolerance = 1e-3",
        "tolerance = 0",
        &["solve.tolerance is 0; allowed"],
    ),
    (
        "tolerance = 1e-3",
        "tolerance = 2.0",
        &["solve.tolerance is 2.0; allowed"],
    ),
    (
        "max_seconds = 60.0",
        "max_seconds = -1",
        &["solve.max_seconds is -1; allowed"],
    ),
    (
        "max_seconds = 60.0",
        "max_seconds = nan",
        &["solve.max_seconds is nan; allowed"],
    ),
];

#[test]
fn unknown_and_missing_keys_are_named() {
    check(KEYS);
}

#[test]
fn numbers_out_of_range_are_shown_with_the_range() {
    check(NUMBERS);
}

#[test]
fn values_without_a_meaning_are_refused() {
    check(MEANINGS);
}

#[test]
fn the_scene_without_a_slip_is_understood() {
    let trial = Trial::new();
    trial.put("scene.toml", SCENE.as_bytes());
    let said = trial.run(&["check", "scene.toml"]);
    assert_eq!(said.code, 0, "{}", said.err);
    assert!(said.out.contains("121 nodes"), "{}", said.out);
}

/// `drape` and `check` refuse each scene with the same words.
#[track_caller]
fn check(slips: &[Slip]) {
    let mut wrong = Vec::new();
    for &(right, slip, says) in slips {
        let trial = Trial::new();
        let scene = SCENE.replacen(right, slip, 1);
        assert_ne!(scene, SCENE, "{right:?} is not in the scene");
        trial.put("scene.toml", scene.as_bytes());
        let draped = trial.run(&["drape", "scene.toml", "--out", "out", "--max-seconds", "1"]);
        let checked = trial.run(&["check", "scene.toml"]);
        for Said { code, out, err } in [&draped, &checked] {
            let unsaid = says.iter().find(|part| !err.contains(**part));
            let starts = err.starts_with("error: scene.toml:");
            if *code != 2 || unsaid.is_some() || !starts || !out.is_empty() || !trial.kept() {
                wrong.push(format!(
                    "{slip}\n  exit {code}, without {unsaid:?}\n{err}{out}"
                ));
            }
        }
        if draped.err != checked.err {
            wrong.push(format!("{slip}\n  drape and check say different things"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
