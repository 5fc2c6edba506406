//! `soen robot PERSON`.

pub(crate) mod args;
mod figure;
mod report;
mod table;

use crate::{
    failure::{DONE, Failure},
    say,
};
use args::{Reach, RobotWish};
use soen::{
    body::Format,
    math::{Pose, Vec3},
    output,
    robot::Robot,
    scene,
    skeleton::{Posture, Skeleton},
};
use std::{
    path::{Path, PathBuf},
    process::ExitCode,
};

pub(crate) fn robot(wish: &RobotWish) -> Result<ExitCode, Failure> {
    let format = wish.mesh.as_deref().map(format_of).transpose()?;
    let person = scene::person(&wish.person)?;
    let built = Robot::new(&person).map_err(|error| Failure::Input(error.to_string()))?;
    let stood = Stood::new(&built, wish)?;
    let report = report::Report::new(&stood, wish)?;
    let mut written = Vec::new();
    if let (Some(path), Some(format)) = (&wish.mesh, format) {
        let skin = built.skin(&stood.posture, &stood.frames).map_err(cannot)?;
        let bytes = output::mesh_file(&skin, format).unwrap_or_default();
        put(path, &bytes, &mut written)?;
    }
    if let Some(out) = &wish.out {
        write(out, &stood, wish, &report.json(), &mut written)?;
    }
    say(&if wish.json {
        report.json()
    } else {
        table::table(&report, &written)
    })?;
    Ok(DONE)
}

/// A body in a posture.
struct Stood<'a> {
    robot: &'a Robot,
    posture: Posture,
    /// Where the bones are.
    frames: Vec<Pose>,
    reached: Vec<Came>,
}

/// Where a bone's end came to.
struct Came {
    bone: String,
    to: Vec3,
    /// How far from there it is [cm].
    miss: f64,
    there: bool,
}

impl<'a> Stood<'a> {
    fn new(robot: &'a Robot, wish: &RobotWish) -> Result<Self, Failure> {
        let skeleton = robot.skeleton();
        let mut posture = scene::posture(&wish.pose, skeleton)?;
        let mut reached = Vec::new();
        for reach in &wish.reaches {
            let bone = named(skeleton, reach)?;
            let found = skeleton.reach(&posture, bone, &reach.to);
            reached.push(Came {
                bone: reach.bone.clone(),
                to: reach.to,
                miss: found.miss,
                there: found.is_there(),
            });
            posture = found.posture;
        }
        Ok(Self {
            robot,
            frames: skeleton.stand(&posture),
            posture,
            reached,
        })
    }
}

/// The bone that is to reach; the pelvis does not move.
fn named(skeleton: &Skeleton, reach: &Reach) -> Result<usize, Failure> {
    let found = skeleton.bone(&reach.bone).filter(|bone| *bone > 0);
    found.ok_or_else(|| {
        let names = skeleton.bones().iter().skip(1);
        let names: Vec<&str> = names.map(|bone| bone.name.as_str()).collect();
        Failure::Input(format!(
            "--reach names {:?}; allowed: {}",
            reach.bone,
            names.join(", ")
        ))
    })
}

/// The format that a path's ending names, of those that are written.
fn format_of(path: &Path) -> Result<Format, Failure> {
    let written = [Format::Obj, Format::Stl, Format::Ply];
    let format = Format::of_path(path).filter(|format| written.contains(format));
    format.ok_or_else(|| {
        Failure::Input(format!(
            "--mesh is {}; allowed: a path that ends in .obj, .stl or .ply",
            path.display()
        ))
    })
}

/// Writes all files of a folder; the report last, so that where it stands the others do too.
fn write(
    out: &Path,
    stood: &Stood<'_>,
    wish: &RobotWish,
    report: &str,
    written: &mut Vec<PathBuf>,
) -> Result<(), Failure> {
    let (robot, frames) = (stood.robot, &stood.frames);
    let muscles = output::muscle_meshes(robot, &stood.posture, frames);
    let bones = output::bone_meshes(robot, frames);
    let obj = output::figure_obj(robot, frames, &muscles);
    put(&out.join("robot.obj"), obj.as_bytes(), written)?;
    for (name, shown) in [("robot.png", muscles), ("bones.png", bones)] {
        put(&out.join(name), &figure::picture(shown, wish.view), written)?;
    }
    put(&out.join("report.json"), report.as_bytes(), written)
}

fn put(path: &Path, bytes: &[u8], written: &mut Vec<PathBuf>) -> Result<(), Failure> {
    output::write(path, bytes)?;
    written.push(path.to_owned());
    Ok(())
}

fn cannot(error: soen::body::MeshError) -> Failure {
    Failure::Input(format!("the skin cannot be made: {error}"))
}
