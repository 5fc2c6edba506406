//! `soen animate`: as many frames as asked, each with its proof; ended and gone on, the same bits.

#![allow(
    clippy::print_stdout,
    reason = "what was not tried is for whoever runs the tests with --nocapture"
)]

use crate::trial::Trial;
use gltf::animation::util::ReadOutputs;
use serde_json::Value;
use std::{fs, path::Path};

/// A kerchief on a child's head who runs: small enough to be quick, and nothing pinches it.
const SCENE: &str = "[cloth]\nfabric = \"d\"\nsize_cm = [16, 16]\nspacing_cm = 2\n\
    centre_cm = [0, 0, 124]\n[contact]\nfriction = 0.5\n\
    [[body]]\nname = \"child\"\nrobot = { person = \"child-120\", motion = \"walk\" }\n\
    [animation]\nframes = 3\nframes_per_s = 12.5\n";

fn state(trial: &Trial, out: &str, frame: usize) -> Vec<u8> {
    fs::read(trial.path().join(format!("{out}/frame-{frame:04}.state"))).unwrap()
}

fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

#[test]
fn a_kerchief_goes_along_and_a_run_that_was_ended_goes_on_to_the_same_bits() {
    let trial = Trial::new();
    trial.put("run.toml", SCENE.as_bytes());
    let said = trial.run(&["animate", "run.toml", "--out", "one"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    let report = json(&trial.path().join("one/report.json"));
    assert_eq!(report["frames_certified"], 3);
    assert!(report["deepest_cm"].as_f64().unwrap() <= 0.05);
    let glb = gltf::Gltf::open(trial.path().join("one/animation.glb")).unwrap();
    let blob = glb.blob.as_deref();
    let animation = glb.animations().next().unwrap();
    let weights = animation.channels().find_map(|channel| {
        let reader = channel.reader(|_| blob);
        let times: Vec<f32> = reader.read_inputs()?.collect();
        matches!(reader.read_outputs()?, ReadOutputs::MorphTargetWeights(_)).then_some(times)
    });
    assert_eq!(weights.unwrap(), [0.0, 0.08, 0.16]);

    // As if it had been ended within the second frame.
    fs::create_dir(trial.path().join("two")).unwrap();
    for name in ["dressed.state", "frame-0000.state"] {
        let [from, to] = ["one", "two"].map(|out| trial.path().join(out).join(name));
        fs::copy(from, to).unwrap();
    }
    trial.put("two/frame-0001.state", &state(&trial, "one", 1)[..1000]);
    let said = trial.run(&["animate", "run.toml", "--out", "two", "--threads", "1"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    for frame in 0..3 {
        assert!(
            state(&trial, "one", frame) == state(&trial, "two", frame),
            "frame {frame}"
        );
    }
}

/// The same with inertia: the first frame is at rest, and is set going with the head.
#[test]
fn a_kerchief_with_inertia_goes_along_and_a_run_that_was_ended_goes_on_to_the_same_bits() {
    let trial = Trial::new();
    let scene = format!("{SCENE}dynamics = true\nsteps_per_frame = 4\n");
    trial.put("run.toml", scene.as_bytes());
    let said = trial.run(&["animate", "run.toml", "--out", "one"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    let report = json(&trial.path().join("one/report.json"));
    assert_eq!(report["frames_certified"], 3);
    let kinds = [0, 1, 2].map(|frame| report["frames"][frame]["equilibrium"].clone());
    assert_eq!(kinds, ["static", "dynamic", "dynamic"]);
    assert!(report["frames"][0]["fastest_cm_per_s"].is_null());
    // Within the first 0.16 s of a walk of 1 m/s, the head takes the kerchief along.
    for frame in [1, 2] {
        let fastest = report["frames"][frame]["fastest_cm_per_s"].as_f64();
        assert!((20.0..300.0).contains(&fastest.unwrap()), "{fastest:?}");
        let energy = report["frames"][frame]["kinetic_energy_gf_cm"].as_f64();
        assert!(energy.unwrap() > 0.0);
    }

    fs::create_dir(trial.path().join("two")).unwrap();
    for name in ["dressed.state", "frame-0000.state", "frame-0001.state"] {
        let [from, to] = ["one", "two"].map(|out| trial.path().join(out).join(name));
        fs::copy(from, to).unwrap();
    }
    let said = trial.run(&["animate", "run.toml", "--out", "two", "--threads", "1"]);
    assert_eq!(said.code, 0, "{}{}", said.out, said.err);
    assert!(state(&trial, "one", 2) == state(&trial, "two", 2));
}

#[test]
fn what_cannot_be_animated_is_refused() {
    let trial = Trial::new();
    let still = SCENE.replace(", motion = \"walk\"", "");
    let (frameless, _) = SCENE.split_once("[animation]").unwrap();
    let unknown = SCENE.replace("\"walk\"", "\"wlak\"");
    let slow = SCENE.replace("12.5", "0");
    let with = |keys: &str| format!("{SCENE}{keys}\n");
    let airless = with("damping_per_s = 3.0");
    let stepped = with("steps_per_frame = 4");
    let stepless = with("dynamics = true\nsteps_per_frame = 0");
    let half = with("dynamics = true\nsteps_per_frame = 1.5");
    let hasty = with("dynamics = true\nsteps_per_frame = 1000").replace("12.5", "1000");
    let driven = with("dynamics = true\ndamping_per_s = -1.0");
    let rows = [
        (still.as_str(), "", "nobody moves in this scene"),
        (frameless, "", "the scene has no [animation]"),
        (&unknown, "", "walk"),
        (&slow, "", "allowed: 0.1 to 10000 frames per second"),
        (
            &airless,
            "",
            "animation.damping_per_s is 3.0; allowed: only with dynamics = true",
        ),
        (
            &stepped,
            "",
            "animation.steps_per_frame is 4; allowed: only with dynamics = true",
        ),
        (
            &stepless,
            "",
            "animation.steps_per_frame is 0; allowed: 1 to 1000 steps",
        ),
        (
            &hasty,
            "",
            "animation.steps_per_frame is 1000; allowed: 1 to 100 at 1000 frames per second",
        ),
        (
            &half,
            "",
            "animation.steps_per_frame is 1.5; allowed: a whole number, 0 or more",
        ),
        (
            &driven,
            "",
            "animation.damping_per_s is -1.0; allowed: 0 to 10000 per second",
        ),
        (
            SCENE,
            "--frames=2..9",
            "allowed: A..B with A below B, up to 0..3",
        ),
        (SCENE, "--frames=2", "allowed: A..B, two whole numbers"),
    ];
    for (scene, option, message) in rows {
        trial.put("run.toml", scene.as_bytes());
        let mut arguments = vec!["animate", "run.toml", "--out", "out"];
        arguments.extend(Some(option).filter(|option| !option.is_empty()));
        let said = trial.run(&arguments);
        assert_eq!(said.code, 2, "{}{}", said.out, said.err);
        assert!(said.err.contains(message), "{}", said.err);
        assert!(trial.kept());
    }
}

#[test]
fn scenes_in_motion_are_read_and_a_capture_that_is_not_there_is_named() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes/motion");
    let mut names = vec![];
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        match soen::scene::read(&path) {
            Ok(scene) => assert!(scene.cast.moves() && scene.frames.is_some(), "{name}"),
            // Captures are not part of the project.
            Err(error) => {
                println!("{name}: {error}");
                assert!(name.contains("captured") && error.to_string().contains("no such file"));
            }
        }
        names.push(name);
    }
    names.sort();
    assert_eq!(
        names,
        [
            "poncho-captured-walk",
            "poncho-jump",
            "poncho-walk",
            "veil-walk"
        ]
    );

    let trial = Trial::new();
    let scene = fs::read(folder.join("poncho-captured-walk.toml")).unwrap();
    trial.put("walk.toml", &scene);
    let said = trial.run(&["animate", "walk.toml", "--out", "out"]);
    assert_eq!(said.code, 2, "{}", said.err);
    let file = "shared/data/motion/cmu_02_01_walk.bvh";
    assert!(
        said.err
            .contains("walk.toml:16:42: body[1].robot.motion is"),
        "{}",
        said.err
    );
    assert!(said.err.contains("no such file; tried") && said.err.contains(file));
    assert!(trial.kept());
}
