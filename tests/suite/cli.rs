//! Every command, what it prints and how it exits.

use crate::trial::{SCENE, Trial};
use soen::fabric::SWATCHES;
use std::fs;

#[test]
fn help_names_every_command_and_its_exit_codes() {
    let trial = Trial::new();
    let help = trial.run(&["--help"]);
    assert_eq!(help.code, 0);
    for command in ["drape", "check", "fabric", "schema"] {
        assert!(help.out.contains(command), "{}", help.out);
    }
    let drape = trial.run(&["drape", "--help"]);
    for word in [
        "0 certified",
        "2 bad input",
        "3 stopped",
        "--out",
        "--json",
        "--map",
    ] {
        assert!(drape.out.contains(word), "without {word:?}:\n{}", drape.out);
    }
}

#[test]
fn wrong_usage_is_bad_input() {
    let trial = Trial::new();
    let out = ["drape", "scene.toml", "--out", "out"];
    let cases: [&[&str]; 9] = [
        &[],
        &["drap"],
        &["drape"],
        &["drape", "scene.toml"],
        &["check"],
        &["--threads", "0"],
        &["--max-seconds", "nan"],
        &["--frames", "-1"],
        &["--map", "strain"],
    ];
    for case in cases {
        let options = case.first().is_some_and(|word| word.starts_with("--"));
        let arguments = if options {
            [&out, case].concat()
        } else {
            case.to_vec()
        };
        let said = trial.run(&arguments);
        assert_eq!(said.code, 2, "{case:?}: {}", said.err);
        assert!(!said.err.is_empty(), "{case:?}");
    }
}

#[test]
fn every_fabric_that_ships_is_listed_and_shown_as_its_file() {
    let trial = Trial::new();
    let list = trial.run(&["fabric", "list"]);
    assert_eq!(list.code, 0);
    for (name, text) in SWATCHES {
        assert!(
            list.out.lines().any(|line| line.starts_with(name)),
            "{}",
            list.out
        );
        assert_eq!(trial.run(&["fabric", "show", name]).out, text);
    }
    let unknown = trial.run(&["fabric", "show", "wash"]);
    assert_eq!(unknown.code, 2);
    assert!(
        unknown.err.contains("did you mean \"washi\"?"),
        "{}",
        unknown.err
    );
}

#[test]
fn a_fabric_file_comes_before_the_one_that_ships() {
    let trial = Trial::new();
    let mine = SWATCHES[0].1.replace("Cloth A", "My cloth");
    trial.put("fabrics/a.toml", mine.as_bytes());
    assert_eq!(trial.run(&["fabric", "show", "a"]).out, mine);
}

#[test]
fn the_schema_knows_every_table_of_a_scene() {
    let trial = Trial::new();
    let said = trial.run(&["schema"]);
    let schema: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    for table in ["title", "seed", "cloth", "hold", "body", "contact", "solve"] {
        assert!(schema["properties"][table].is_object(), "{table}");
    }
    assert_eq!(schema["required"], serde_json::json!(["cloth"]));
    assert_eq!(schema["additionalProperties"], false);
    let cloth = &schema["$defs"]["ClothTable"]["properties"];
    assert_eq!(cloth["size_cm"]["maxItems"], 2);
}

#[test]
fn check_prints_what_it_understood() {
    let trial = Trial::new();
    let mesh = "v 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";
    trial.put("scenes/open.obj", mesh.as_bytes());
    let body = "[[body]]\nname = \"open\"\nmesh = { file = \"open.obj\", unit = \"mm\" }\n";
    trial.put("scenes/scene.toml", format!("{SCENE}{body}").as_bytes());
    let said = trial.run(&["check", "scenes/scene.toml"]);
    assert_eq!(said.code, 0, "{}", said.err);
    for part in [
        "title      trial",
        "Cloth C (Soen, tables 1 and 2; fabrics/c.toml)",
        "20.0000 × 20.0000 cm",
        "spacing 2 cm, 121 nodes",
        "the node nearest (-10, 10) cm",
        "body 1: solid",
        "open: open: a sheet with two sides",
        "open.obj: 4 vertices, 3 faces, open, 1 holes",
        "friction 0.3, thickness 0.05 cm",
        "tolerance 0.001, at most 60 s, forces lattice, laws tension bending shear, seed 1",
    ] {
        assert!(said.out.contains(part), "without {part:?}:\n{}", said.out);
    }
}

/// A small cloth that hangs by one edge: certified in a blink.
const HANG: &str = r#"title = "hang"
[cloth]
fabric = "c"
size_cm = [10.0, 10.0]
spacing_cm = 2.0
[[hold]]
edge = "x-min"
"#;

#[test]
fn a_certified_drape_exits_with_0_and_writes_every_file() {
    let trial = Trial::new();
    trial.put("hang.toml", HANG.as_bytes());
    let said = trial.run(&["drape", "hang.toml", "--out", "new/folder", "--json"]);
    assert_eq!(said.code, 0, "{}", said.err);
    let read = |name: &str| fs::read(trial.path().join("new/folder").join(name)).unwrap();
    assert_eq!(said.out.as_bytes(), read("report.json"), "the report alone");
    let report: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(report["converged"], true);
    assert_eq!(
        (&report["title"], &report["fabric"]),
        (&"hang".into(), &"c".into())
    );
    assert_eq!(report["nodes"], 36);
    assert!(read("drape.obj").starts_with(b"#"));
    assert!(read("drape.glb").starts_with(b"glTF"));
    assert!(read("drape.png").starts_with(b"\x89PNG"));
}

#[test]
fn a_preview_is_marked_as_one() {
    let trial = Trial::new();
    trial.put("hang.toml", HANG.as_bytes());
    let wish = ["drape", "hang.toml", "--preview", "--threads", "2"];
    let said = trial.run(&[&wish[..], &["--out", "out", "--json"]].concat());
    assert_eq!(said.code, 0, "{}", said.err);
    let report: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    assert_eq!(report["title"], "hang (preview)");
    let png = fs::read(trial.path().join("out/drape.png")).unwrap();
    // Width and height stand in a PNG's header: a preview's picture is a quarter of a drape's.
    assert_eq!(
        [&png[16..20], &png[20..24]],
        [&600_u32.to_be_bytes(), &450_u32.to_be_bytes()]
    );
}

#[test]
fn a_drape_out_of_time_exits_with_3_and_says_so_everywhere() {
    let trial = Trial::new();
    trial.put("scene.toml", SCENE.as_bytes());
    let said = trial.run(&["drape", "scene.toml", "--out", "out", "--max-seconds", "0"]);
    stopped(&trial, said.code, &said.out, &said.err);
    let mine = fs::read(trial.path().join("out/mine.txt")).unwrap();
    assert_eq!(mine, b"kept", "files that are none of the drape's stay");
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_and_still_writes() {
    let trial = Trial::new();
    let endless = SCENE.replace("tolerance = 1e-3", "tolerance = 1e-12");
    trial.put("scene.toml", endless.as_bytes());
    let said = trial.interrupt(&["drape", "scene.toml", "--out", "out"]);
    stopped(&trial, said.code, &said.out, &said.err);
}

#[track_caller]
fn stopped(trial: &Trial, code: i32, out: &str, err: &str) {
    assert_eq!(code, 3, "{err}");
    assert!(out.contains("NOT certified"), "{out}");
    let read = |name: &str| fs::read_to_string(trial.path().join("out").join(name)).unwrap();
    let report: serde_json::Value = serde_json::from_str(&read("report.json")).unwrap();
    assert_eq!(report["converged"], false);
    assert!(read("drape.obj").contains("NOT AT REST"));
}
