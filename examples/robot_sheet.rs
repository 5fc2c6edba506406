//! The robots that ship on two sheets, in four poses each: the bones alone, as in figure 4 of the
//! paper, and with their muscles, as in figure 5.
//!
//! `cargo run --release --example robot_sheet -- docs/pictures` made the README's.

use soen::{
    lattice::Lattice,
    output::{self, BodyMesh, ClothMesh, Image, View},
    robot::Robot,
    scene,
};
use std::{env, error::Error, path::PathBuf};

const PEOPLE: [&str; 3] = ["woman-158", "man-170", "child-120"];
const POSES: [&str; 4] = ["standing", "sitting", "stride", "reaching-up"];
/// Width and height of a picture [pixels].
const SIZE: [u32; 2] = [240, 300];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(env::args().nth(1).unwrap_or_else(|| ".".into()));
    let (mut bones, mut muscles) = (Vec::new(), Vec::new());
    for person in PEOPLE {
        let robot = Robot::new(&scene::person(person.as_ref())?)?;
        for pose in POSES {
            let posture = scene::posture(pose.as_ref(), robot.skeleton())?;
            let frames = robot.skeleton().stand(&posture);
            bones.push(picture(&output::bone_meshes(&robot, &frames)));
            muscles.push(picture(&output::muscle_meshes(&robot, &posture, &frames)));
        }
    }
    for (name, pictures) in [("bones.png", bones), ("robot.png", muscles)] {
        let sheet = output::contact_sheet(&pictures, POSES.len());
        output::write(&folder.join(name), &sheet)?;
    }
    Ok(())
}

fn picture(bodies: &[BodyMesh]) -> Image {
    let nothing = ClothMesh {
        lattice: &Lattice::default(),
        positions: &[],
    };
    let view = View {
        width: SIZE[0],
        height: SIZE[1],
        ..View::default()
    };
    output::picture_pixels(&nothing, bodies, &view)
}
