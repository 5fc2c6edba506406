//! Every command, what it prints and how it exits.

use crate::trial::{SCENE, Trial};
use soen::fabric::SWATCHES;

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
