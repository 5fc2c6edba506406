//! Motion capture: the actor's limbs point where ours do, whatever pose he is built in.

use crate::woman::{ends, woman};
use nalgebra::{Translation3, Unit};
use soen::{
    math::{Pose, Rotation, Vec3},
    motion::{Bvh, Channel, Errors, Mapping, Motion, Source, errors, retarget},
    scene,
};
use std::{
    f64::consts::FRAC_1_SQRT_2,
    fs,
    path::{Path, PathBuf},
};

const FILES: [&str; 5] = [
    "cmu_02_01_walk.bvh",
    "cmu_02_03_run.bvh",
    "cmu_02_04_jump.bvh",
    "makehuman_tpose.bvh",
    "makehuman_walk1.bvh",
];

/// Captures that are too large for this repository stand beside it.
fn shared(file: &str) -> Option<PathBuf> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/motion");
    let path = Path::new(folder).join(file);
    let found = path.is_file();
    if !found {
        println!("{file}: not there, not tried");
    }
    found.then_some(path)
}

#[test]
fn hands_and_feet_are_where_the_actors_are() {
    let woman = woman();
    for file in FILES {
        let Some(path) = shared(file) else { continue };
        let source = Bvh::parse(&fs::read_to_string(&path).unwrap()).unwrap();
        let mapping = scene::mapping_for(&source).unwrap();
        let motion = retarget(&source, &mapping, &woman).unwrap();
        let Errors {
            hands,
            feet,
            arms,
            legs,
        } = errors(&source, &mapping, &woman, &motion).unwrap();
        println!(
            "{file}: {} frames by {:?}; of stature: hands {:.2} %, feet {:.2} %, from shoulder {:.2} %, \
             from hip {:.2} %",
            source.frames.len(),
            mapping.name,
            100.0 * hands,
            100.0 * feet,
            100.0 * arms,
            100.0 * legs
        );
        for beyond in motion.beyond_limits(&woman) {
            println!(
                "    {}, in {:.0} % of frames",
                beyond.worst,
                100.0 * beyond.share
            );
        }
        assert!(hands < 0.05 && feet < 0.05 && arms < 0.05 && legs < 0.05);
        assert_eq!(motion.keys().len(), source.frames.len());
    }
}

#[test]
fn every_shared_capture_plays_at_any_rate() {
    let woman = woman();
    for file in FILES {
        let Some(path) = shared(file) else { continue };
        let motion = scene::motion(&path, &woman).unwrap();
        for step in 0..=100 {
            let posture = motion.at(motion.duration() * f64::from(step) / 100.0);
            let [_, toe] = ends(&woman, &posture, "left_foot");
            let [_, top] = ends(&woman, &posture, "head");
            assert!(top.z > 80.0 && top.z < 240.0, "{file}: {top}");
            assert!(toe.z > -8.0 && toe.z < 100.0, "{file}: {toe}");
        }
    }
}

#[test]
fn the_walk_goes_ahead() {
    let Some(path) = shared("cmu_02_01_walk.bvh") else {
        return;
    };
    let woman = woman();
    let motion = scene::motion(&path, &woman).unwrap();
    let first = motion.at(0.0).root.translation.vector;
    let last = motion.at(motion.duration()).root.translation.vector;
    assert!(first.xy().norm() < 1e-9);
    let way = last - first;
    let speed = way.norm() / motion.duration();
    println!("walks {:.0} cm in {:.2} s", way.norm(), motion.duration());
    assert!(way.y < -100.0 && way.x.abs() < 0.2 * way.norm(), "{way}");
    assert!((60.0..200.0).contains(&speed), "{speed} cm/s");
}

/// Heights of joints above the file's origin along its up axis, by nalgebra's own Euler turns.
fn heights(source: &Bvh, frame: &[f64], up: usize, names: [&str; 2]) -> [f64; 2] {
    let axes = [Vec3::x_axis(), Vec3::y_axis(), Vec3::z_axis()];
    let mut poses: Vec<Pose> = vec![];
    let mut values = frame.iter();
    for joint in &source.joints {
        let above = joint
            .parent
            .map_or(Pose::identity(), |parent| poses[parent]);
        let mut pose = above * Translation3::from(Vec3::from(joint.offset));
        for channel in &joint.channels {
            let value = *values.next().unwrap();
            match *channel {
                Channel::Position(axis) => pose *= Translation3::from(axes[axis].scale(value)),
                Channel::Rotation(axis) => {
                    pose *= Rotation::from_axis_angle(&axes[axis], value.to_radians());
                }
            }
        }
        poses.push(pose);
    }
    names.map(|name| poses[source.joint(name).unwrap()].translation.vector[up])
}

#[test]
fn the_lower_ankle_is_as_high_as_the_actors() {
    let woman = woman();
    // Legs by hand from the files' offsets.
    let files = [
        ("cmu_02_01_walk.bvh", 1, ["rfoot", "lfoot"], 84.0),
        ("cmu_02_03_run.bvh", 1, ["rfoot", "lfoot"], 84.0),
        ("cmu_02_04_jump.bvh", 1, ["rfoot", "lfoot"], 84.0),
        ("makehuman_walk1.bvh", 2, ["Foot_R", "Foot_L"], 8.185),
    ];
    for (file, up, ankles, leg) in files {
        let Some(path) = shared(file) else { continue };
        let source = Bvh::parse(&fs::read_to_string(&path).unwrap()).unwrap();
        let motion = scene::motion(&path, &woman).unwrap();
        let lower = |pair: [f64; 2]| pair[0].min(pair[1]);
        let theirs = source
            .frames
            .iter()
            .map(|frame| lower(heights(&source, frame, up, ankles)));
        let theirs: Vec<f64> = theirs.collect();
        let ours = motion.keys().iter().map(|key| {
            let height = |foot| ends(&woman, &key.posture, foot)[0].z;
            lower([height("right_foot"), height("left_foot")])
        });
        let ours: Vec<f64> = ours.collect();
        let least = |list: &[f64]| list.iter().copied().fold(f64::MAX, f64::min);
        let (low, their_low) = (least(&ours), least(&theirs));
        assert!((low - 6.2).abs() < 1e-9);
        let off = ours
            .iter()
            .zip(&theirs)
            .map(|(ours, theirs)| ((ours - low) - (theirs - their_low) * 75.0 / leg).abs());
        let off = off.fold(0.0, f64::max);
        println!("{file}: the lower ankle is within {off:.2} cm of the actor's, scaled");
        assert!(off < 2.0);
    }
}

/// An actor of 14 joints, by hand: hips 100 above the floor, in any pose, frame and unit.
struct Puppet {
    /// Where a point of our frame is in the file.
    frame: fn(Vec3) -> Vec3,
    /// Directions of the right arm and leg as built; the left ones mirror them.
    arm: Vec3,
    leg: Vec3,
}

impl Puppet {
    /// A file with the frames given, three turns about z, x, y of the file for each named joint.
    fn text(&self, frames: &[&[(&str, [f64; 3])]]) -> String {
        let mut text = "HIERARCHY\n".to_owned();
        let mut names = vec![];
        let mut add = |text: &mut String, name: &str, at: Vec3| {
            let head = if names.is_empty() { "ROOT" } else { "JOINT" };
            let [x, y, z]: [f64; 3] = (self.frame)(at).into();
            text.push_str(&format!(
                "{head} {name}\n{{\nOFFSET {x} {y} {z}\nCHANNELS 3 Zrotation Xrotation Yrotation\n"
            ));
            names.push(name.to_owned());
        };
        let end = "End Site\n{\nOFFSET 0 0 0\n}\n";
        add(&mut text, "hips", Vec3::z() * 100.0);
        add(&mut text, "chest", Vec3::z() * 30.0);
        for side in [-1.0, 1.0] {
            let mirrored = |v: Vec3| Vec3::new(v.x * -side, v.y, v.z);
            let s = if side < 0.0 { "r" } else { "l" };
            add(
                &mut text,
                &format!("{s}_arm"),
                Vec3::new(20.0 * side, 0.0, 20.0),
            );
            add(&mut text, &format!("{s}_fore"), mirrored(self.arm) * 30.0);
            add(&mut text, &format!("{s}_hand"), mirrored(self.arm) * 25.0);
            text.push_str(&format!("{end}}}\n}}\n}}\n"));
        }
        text.push_str("}\n");
        for side in [-1.0, 1.0] {
            let mirrored = |v: Vec3| Vec3::new(v.x * -side, v.y, v.z);
            let s = if side < 0.0 { "r" } else { "l" };
            add(
                &mut text,
                &format!("{s}_leg"),
                Vec3::new(9.0 * side, 0.0, 0.0),
            );
            add(&mut text, &format!("{s}_shank"), mirrored(self.leg) * 46.0);
            add(&mut text, &format!("{s}_foot"), mirrored(self.leg) * 46.0);
            text.push_str(&format!("{end}}}\n}}\n}}\n"));
        }
        text.push_str(&format!(
            "}}\nMOTION\nFrames: {}\nFrame Time: 0.1\n",
            frames.len()
        ));
        for frame in frames {
            for name in &names {
                let given = frame.iter().find(|(joint, _)| joint == name);
                let [z, x, y] = given.map_or([0.0; 3], |(_, turns)| *turns);
                text.push_str(&format!("{z} {x} {y} "));
            }
            text.push('\n');
        }
        text
    }

    fn play(&self, frames: &[&[(&str, [f64; 3])]]) -> Motion {
        let source = Bvh::parse(&self.text(frames)).unwrap();
        retarget(&source, &puppet_names(), &woman()).unwrap()
    }
}

fn puppet_names() -> Mapping {
    let mut bones = vec![
        ("pelvis", "hips".to_owned()),
        ("thorax", "chest".to_owned()),
    ];
    for (side, s) in [("right", "r"), ("left", "l")] {
        for (bone, joint) in [
            ("upper_arm", "arm"),
            ("forearm", "fore"),
            ("hand", "hand"),
            ("thigh", "leg"),
            ("shank", "shank"),
            ("foot", "foot"),
        ] {
            let bone: &'static str = format!("{side}_{bone}").leak();
            bones.push((bone, format!("{s}_{joint}")));
        }
    }
    let source = |joint| Source {
        joint,
        end: None,
        twist: None,
    };
    let bones = bones
        .into_iter()
        .map(|(bone, joint)| (bone.to_owned(), source(joint)));
    Mapping {
        name: "puppet".into(),
        bones: bones.collect(),
    }
}

const HANGING: Vec3 = Vec3::new(0.0, 0.0, -1.0);
const OUT: Vec3 = Vec3::new(-1.0, 0.0, 0.0);
/// Ours, and files with y up, with x to the right, and facing +x.
const FRAMES: [fn(Vec3) -> Vec3; 3] = [
    |p| p,
    |p| Vec3::new(p.x, p.z, -p.y) * 0.01,
    |p| Vec3::new(-p.y, p.x, p.z) * 7.0,
];

/// Angles [degrees] of a joint in a key.
fn angles(motion: &Motion, key: usize, joint: &str) -> [f64; 3] {
    let woman = woman();
    let index = woman.joint(joint).unwrap();
    let turn = &motion.keys()[key].posture.joints[index];
    woman.bones()[index].joint.angles(turn).map(f64::to_degrees)
}

#[track_caller]
fn near(found: [f64; 3], wanted: [f64; 3]) {
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-6, "{found} instead of {wanted}");
    }
}

#[test]
fn an_actor_built_standing_stands_in_any_frame_and_unit() {
    for frame in FRAMES {
        let puppet = Puppet {
            frame,
            arm: HANGING,
            leg: HANGING,
        };
        let motion = puppet.play(&[&[]]);
        for joint in [
            "waist",
            "right_shoulder",
            "left_elbow",
            "left_hip",
            "right_knee",
            "right_ankle",
        ] {
            near(angles(&motion, 0, joint), [0.0; 3]);
        }
        let root = motion.at(0.0).root;
        assert!((root.translation.vector - Vec3::new(0.0, 0.0, 81.2)).norm() < 1e-9);
        assert!(root.rotation.angle() < 1e-9);
    }
}

#[test]
fn arms_held_out_and_legs_apart_are_abducted_without_a_twist() {
    let apart = Vec3::new(-0.5, 0.0, -FRAC_1_SQRT_2 * 1.5_f64.sqrt());
    for frame in FRAMES {
        let motion = Puppet {
            frame,
            arm: OUT,
            leg: apart,
        }
        .play(&[&[]]);
        for side in ["right", "left"] {
            near(
                angles(&motion, 0, &format!("{side}_shoulder")),
                [0.0, 90.0, 0.0],
            );
            near(angles(&motion, 0, &format!("{side}_elbow")), [0.0; 3]);
            near(angles(&motion, 0, &format!("{side}_hip")), [0.0, 30.0, 0.0]);
            near(angles(&motion, 0, &format!("{side}_ankle")), [0.0; 3]);
        }
    }
}

#[test]
fn an_elbow_bent_from_a_t_pose_is_flexed() {
    // In the file of the first frame z is up: the right forearm, held out to −x, swings to −y, to the
    // front, by +z turns; the left one by −z turns.
    let puppet = Puppet {
        frame: FRAMES[0],
        arm: OUT,
        leg: HANGING,
    };
    let bent: &[(&str, [f64; 3])] = &[("r_fore", [70.0, 0.0, 0.0]), ("l_fore", [-70.0, 0.0, 0.0])];
    // And the whole arms brought down to the sides first: about y.
    let down: &[(&str, [f64; 3])] = &[
        ("r_arm", [0.0, 0.0, -90.0]),
        ("l_arm", [0.0, 0.0, 90.0]),
        ("r_fore", [70.0, 0.0, 0.0]),
        ("l_fore", [-70.0, 0.0, 0.0]),
        ("r_shank", [0.0, 40.0, 0.0]),
        ("l_leg", [0.0, -30.0, 0.0]),
    ];
    let motion = puppet.play(&[bent, down]);
    for side in ["right", "left"] {
        near(
            angles(&motion, 0, &format!("{side}_elbow")),
            [70.0, 0.0, 0.0],
        );
        near(
            angles(&motion, 0, &format!("{side}_shoulder")),
            [0.0, 90.0, 0.0],
        );
        near(
            angles(&motion, 1, &format!("{side}_elbow")),
            [70.0, 0.0, 0.0],
        );
        near(angles(&motion, 1, &format!("{side}_shoulder")), [0.0; 3]);
    }
    near(angles(&motion, 1, "right_knee"), [40.0, 0.0, 0.0]);
    near(angles(&motion, 1, "left_hip"), [30.0, 0.0, 0.0]);
}

#[test]
fn an_elbow_whose_hinge_the_file_has_elsewhere_bends_ahead_all_the_same() {
    // Arms hang; in the file they are turned inwards by 50° about themselves where ours are at 0,
    // so that elbows bend about an axis 50° off: z turns of the arm, undone in the hand.
    let puppet = Puppet {
        frame: FRAMES[0],
        arm: HANGING,
        leg: HANGING,
    };
    let (s, c) = 50_f64.to_radians().sin_cos();
    // The forearm's turn about the axis (−c, −s, 0), by 80°, as turns about z, x, z.
    let bend = Rotation::from_axis_angle(
        &Unit::new_normalize(Vec3::new(-c, -s, 0.0)),
        80_f64.to_radians(),
    );
    let zxy = |turn: Rotation| {
        // R = Z·X·Y: its second row and column give x, then z and y.
        let m = turn.to_rotation_matrix();
        let x = m[(2, 1)].asin();
        let (z, y) = ((-m[(0, 1)]).atan2(m[(1, 1)]), (-m[(2, 0)]).atan2(m[(2, 2)]));
        [z, x, y].map(f64::to_degrees)
    };
    let motion = puppet.play(&[&[("r_fore", zxy(bend)), ("r_arm", [0.0; 3])]]);
    let [flexion, carrying, pronation] = angles(&motion, 0, "right_elbow");
    assert!(
        (flexion - 80.0).abs() < 1e-6 && carrying.abs() < 1e-6,
        "{flexion}, {carrying}"
    );
    // The hand's palm is where it was: what the shoulder turns, the forearm turns back.
    let rotation = angles(&motion, 0, "right_shoulder")[2];
    assert!((rotation.abs() - 50.0).abs() < 1e-6 && (rotation + pronation).abs() < 1e-6);
    near(angles(&motion, 0, "right_wrist"), [0.0; 3]);
    near(angles(&motion, 0, "left_shoulder"), [0.0; 3]);
}

#[test]
fn a_capture_without_a_joint_that_the_mapping_names_is_refused() {
    let puppet = Puppet {
        frame: FRAMES[0],
        arm: OUT,
        leg: HANGING,
    };
    let source = Bvh::parse(&puppet.text(&[&[]])).unwrap();
    let mut names = puppet_names();
    names.bones[0].1.joint = "hip".into();
    let said = retarget(&source, &names, &woman()).unwrap_err().to_string();
    assert_eq!(
        said,
        "pelvis is moved by joint \"hip\", which the capture does not have"
    );
    names.bones.remove(0);
    let said = retarget(&source, &names, &woman()).unwrap_err().to_string();
    assert_eq!(
        said,
        "no joint is given for pelvis; pelvis, thighs and shanks need one"
    );
}
