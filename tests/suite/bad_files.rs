//! Files that are absent, empty, cut off, binary or of the wrong kind, and folders that cannot be
//! written.

use crate::trial::{SCENE, Said, Trial};
use soen::fabric::swatch;

const TETRAHEDRON: &str = "v 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 3\n\
    f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn a_scene_file_must_be_a_text() {
    let cases: [(&[u8], &[&str]); 6] = [
        (b"", &["scene.toml: is empty"]),
        (b" \n\n", &["scene.toml: is empty"]),
        (
            b"\x89PNG\r\n\x1a\n\0\0",
            &["scene.toml: is binary, not text: byte 0"],
        ),
        (
            b"title = \"a\0b\"",
            &["scene.toml: is binary, not text: byte 10"],
        ),
        (&SCENE.as_bytes()[..SCENE.len() / 2], &["scene.toml:", "^"]),
        (&SCENE.as_bytes()[..40], &["scene.toml:", "^"]),
    ];
    for (bytes, says) in cases {
        let trial = Trial::new();
        trial.put("scene.toml", bytes);
        refuses(&trial, 2, says);
    }
}

#[test]
fn a_scene_file_must_be_there() {
    let trial = Trial::new();
    refuses(&trial, 2, &["scene.toml: cannot be read: No such file"]);
    trial.put("scene.toml/x", b"");
    refuses(&trial, 2, &["scene.toml: is a folder"]);
}

#[test]
fn a_fabric_file_is_checked_as_strictly() {
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "weight_gf_per_cm2 = 0.014",
            "",
            &["missing key \"weight_gf_per_cm2\""],
        ),
        (
            "weight_gf_per_cm2 = 0.014",
            "weight_gf_per_cm2 = -0.014",
            &["weight_gf_per_cm2 is -0.014; allowed: 0.00001 to 1 gf/cm²"],
        ),
        (
            "weight_gf_per_cm2 = 0.014",
            "weight_gf_per_cm2 = 140.0",
            &["weight_gf_per_cm2 is 140.0; allowed"],
        ),
        (
            "weight_gf_per_cm2 = 0.014",
            "weight_g_per_m2 = 140.0",
            &[
                "unknown key \"weight_g_per_m2\"",
                "did you mean \"weight_gf_per_cm2\"?",
            ],
        ),
        (
            "thickness_cm = 0.05",
            "thickness_cm = nan",
            &["thickness_cm is nan; allowed: 0.0001 to 2 cm"],
        ),
        (
            "body = 0.35",
            "body = 50",
            &["friction.body is 50; allowed: 0 to 5"],
        ),
        (
            "b = 1.8",
            "b = -0.5",
            &["warp.tension.b is -0.5; allowed: 0 to 10"],
        ),
        (
            "a_gf_per_cm = 3.8e5, ",
            "",
            &["missing key \"a_gf_per_cm\" in [warp.tension]"],
        ),
        (
            "{ a_gf_per_cm = 3.8e5, b = 1.8 }",
            "{ linear_gf_per_cm = 0 }",
            &["warp.tension.linear_gf_per_cm is 0; allowed"],
        ),
        (
            "{ a_gf_per_cm = 3.8e5, b = 1.8 }",
            "{ points = [[0.0, 0.0], [0.1, 2.0], [0.2, 1.0]] }",
            &["warp.tension.points: tension 1 gf/cm of point 3 is below 2"],
        ),
        (
            "{ a_gf_per_cm = 3.8e5, b = 1.8 }",
            "{ points = [] }",
            &["warp.tension.points: 1 points; allowed: 2 or more"],
        ),
        (
            "bending_gf_cm = 0.0089",
            "bending_gf_cm = inf",
            &["warp.bending_gf_cm is inf; allowed"],
        ),
        (
            "shear_gf_per_cm = 6.0",
            "shear_gf_per_cm = \"6\"",
            &["weft.shear_gf_per_cm is \"6\"; allowed: a number"],
        ),
        (
            "[warp]",
            "twist_gf_cm = -0.01\n[warp]",
            &[
                "twist_gf_cm is -0.01; allowed: 0 to 10000 gf·cm",
                "mine.toml:11:15:",
            ],
        ),
        (
            "[warp]",
            "twist_gf_cm = 1e5\n[warp]",
            &["twist_gf_cm is 1e5; allowed: 0 to 10000 gf·cm"],
        ),
        (
            "shear_gf_per_cm = 6.0",
            "shear_gf_per_cm = 6.0\ntwist_gf_cm = 0.01",
            &["unknown key \"twist_gf_cm\" in [weft]"],
        ),
        ("[weft]", "[woof]", &["unknown key \"woof\""]),
    ];
    let fabric = swatch("c").unwrap();
    for (right, slip, says) in cases {
        let trial = Trial::new();
        let text = fabric.replacen(right, slip, 1);
        assert_ne!(text, fabric, "{right:?} is not in the fabric");
        trial.put("mine.toml", text.as_bytes());
        put_scene(&trial, "fabric = \"c\"", "fabric = \"mine.toml\"");
        refuses(&trial, 2, says);
        refuses(&trial, 2, &["mine.toml:", "^"]);
    }
}

#[test]
fn a_fabric_file_must_be_there() {
    let trial = Trial::new();
    put_scene(&trial, "fabric = \"c\"", "fabric = \"none.toml\"");
    refuses(
        &trial,
        2,
        &["scene.toml:4:10: cloth.fabric is \"none.toml\": no such file; tried none.toml"],
    );
    trial.put("none.toml", b"");
    refuses(&trial, 2, &["none.toml: is empty"]);
    trial.put("none.toml", b"\xff\xfe\0");
    refuses(&trial, 2, &["none.toml: is binary"]);
}

#[test]
fn a_mesh_file_must_hold_a_mesh() {
    let cases: [(&str, &[u8], &[&str]); 9] = [
        ("x.obj", b"", &["x.obj: the file is empty"]),
        (
            "x.obj",
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\n",
            &["x.obj: the mesh has no faces"],
        ),
        (
            "x.obj",
            b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n",
            &["x.obj: line 4", "7"],
        ),
        (
            "x.obj",
            b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n",
            &["x.obj: ", "2"],
        ),
        (
            "x.obj",
            b"v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n",
            &["x.obj: none of the 1 faces has an area"],
        ),
        ("x.stl", b"\0\x01\x02", &["x.stl: "]),
        (
            "x.ply",
            b"ply\nformat ascii 1.0\nelement vertex 3\n",
            &["x.ply: "],
        ),
        ("x.glb", b"glTF\x02\0\0\0\xff\0\0\0", &["x.glb: "]),
        ("x.glb", b"{", &["x.glb: "]),
    ];
    for (name, bytes, says) in cases {
        let trial = Trial::new();
        trial.put(name, bytes);
        put_body(
            &trial,
            &format!("mesh = {{ file = \"{name}\", unit = \"cm\" }}"),
        );
        refuses(&trial, 2, says);
        refuses(
            &trial,
            2,
            &["scene.toml:14:17: body[1].mesh.file", "^^^^^^^"],
        );
    }
}

#[test]
fn a_mesh_file_must_be_there_and_of_a_known_kind() {
    let trial = Trial::new();
    put_body(&trial, "mesh = { file = \"x.obj\", unit = \"cm\" }");
    refuses(&trial, 2, &["body[1].mesh.file is \"x.obj\": no such file"]);
    trial.put("x.obj/y", b"");
    refuses(&trial, 2, &["no such file; tried x.obj (a folder)"]);
    trial.put("x.fbx", TETRAHEDRON.as_bytes());
    put_body(&trial, "mesh = { file = \"x.fbx\", unit = \"cm\" }");
    refuses(
        &trial,
        2,
        &["is \"x.fbx\"; allowed: a file ending in .obj, .stl, .ply, .glb or .gltf"],
    );
}

#[test]
fn a_body_file_must_list_parts() {
    let cases: &[(&str, &[&str])] = &[
        ("name = \"x\"\n", &["b.toml", "missing key \"part\""]),
        ("[[part]]\n", &["b.toml:1:1", "missing key \"one of ball"]),
        (
            "[[part]]\nball = { radius_cm = -1 }\n",
            &["b.toml:2:22: part[1].ball.radius_cm is -1; allowed"],
        ),
        (
            "[[part]]\nfile = \"b.toml\"\n",
            &["b.toml:2:8", "nested more than 8 deep"],
        ),
        (
            "[[body]]\nball = { radius_cm = 1 }\n",
            &["b.toml:1", "unknown key \"body\""],
        ),
    ];
    for (text, says) in cases {
        let trial = Trial::new();
        trial.put("b.toml", text.as_bytes());
        put_body(&trial, "file = \"b.toml\"");
        refuses(&trial, 2, says);
    }
}

#[test]
fn an_output_folder_that_cannot_be_written_is_the_systems_fault() {
    let trial = Trial::new();
    trial.put("scene.toml", SCENE.as_bytes());
    trial.put("taken", b"kept");
    for out in ["taken", "taken/below", "/dev/null/x"] {
        let said = trial.run(&["drape", "scene.toml", "--out", out, "--max-seconds", "1"]);
        assert_eq!(said.code, 1, "{}", said.err);
        assert!(said.err.contains("error: cannot write "), "{}", said.err);
    }
    assert_eq!(std::fs::read(trial.path().join("taken")).unwrap(), b"kept");
}

#[test]
fn a_drape_that_comes_to_nothing_makes_no_folder() {
    let trial = Trial::new();
    let missing = SCENE.replace("fabric = \"c\"", "");
    let inside = SCENE.replace("25.0]", "6.0]");
    let falls = SCENE.replace("[[hold]]\npoint_cm = [-10.0, 10.0]\n", "");
    let falls = falls.replace("0.0, 5.0]", "0.0, 50.0]");
    std::fs::create_dir(trial.path().join("stood")).unwrap();
    for scene in [missing, inside, falls] {
        trial.put("scene.toml", scene.as_bytes());
        for out in [
            "new",
            "deep/er",
            "deep/../new",
            "stood/below",
            "stood",
            "out",
        ] {
            let said = trial.run(&["drape", "scene.toml", "--out", out]);
            assert_eq!(said.code, 2, "{}", said.err);
            let names = ["out", "scene.toml", "stood"];
            assert_eq!(listed(&trial, ""), names, "{out}: {}", said.err);
            assert_eq!(listed(&trial, "stood"), [""; 0], "{out}: {}", said.err);
            assert_eq!(listed(&trial, "out"), ["drape.obj", "mine.txt"], "{out}");
            assert!(trial.kept());
        }
    }
}

/// What stands in a folder, by name.
fn listed(trial: &Trial, folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(trial.path().join(folder)).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn put_scene(trial: &Trial, right: &str, instead: &str) {
    let scene = SCENE.replacen(right, instead, 1);
    assert_ne!(scene, SCENE, "{right:?} is not in the scene");
    trial.put("scene.toml", scene.as_bytes());
}

fn put_body(trial: &Trial, body: &str) {
    put_scene(trial, "ball = { radius_cm = 10.0 }", body);
}

#[track_caller]
fn refuses(trial: &Trial, code: i32, says: &[&str]) {
    let Said {
        code: exit,
        out,
        err,
    } = trial.run(&["drape", "scene.toml", "--out", "out", "--max-seconds", "1"]);
    assert_eq!(exit, code, "{err}");
    assert!(out.is_empty(), "{out}");
    for part in says {
        assert!(err.contains(part), "without {part:?}:\n{err}");
    }
    assert!(trial.kept());
}
