//! The options of `soen robot`.

use clap::{Args, ValueEnum};
use soen::math::Vec3;
use std::path::PathBuf;

#[derive(Args, Debug)]
pub(crate) struct RobotWish {
    /// One of the people that ship (woman-158, man-170, child-120), a file in bodies/, or a path
    /// to a .toml.
    pub(crate) person: PathBuf,
    /// One of the postures that ship (standing, arms-down, arms-out, reaching-up, sitting, stride),
    /// a file in bodies/poses/, or a path to a .toml.
    #[arg(long, value_name = "POSE", default_value = "standing")]
    pub(crate) pose: PathBuf,
    /// Then brings the end of a bone to a point [cm], as right_hand=-30,-40,120, and says how near
    /// it came. May be given more than once; the pelvis stays.
    #[arg(long = "reach", value_name = "BONE=X,Y,Z", value_parser = reach)]
    pub(crate) reaches: Vec<Reach>,
    /// Folder for robot.obj, robot.png, bones.png and report.json.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Writes the smooth closed skin [cm, z up]: a path that ends in .obj, .stl or .ply.
    #[arg(long, value_name = "FILE")]
    pub(crate) mesh: Option<PathBuf>,
    /// From where the pictures are taken.
    #[arg(long, value_enum, default_value_t = Side::Oblique)]
    pub(crate) view: Side,
    /// Prints the report alone on standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

/// The end of a bone, and where it should go [cm].
#[derive(Clone, Debug)]
pub(crate) struct Reach {
    pub(crate) bone: String,
    pub(crate) to: Vec3,
}

/// Where the camera stands.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Side {
    /// Before the person and 30° to the left.
    Oblique,
    /// Before the person.
    Front,
    /// On the person's left.
    Left,
    /// Behind the person.
    Back,
}

fn reach(text: &str) -> Result<Reach, String> {
    const ALLOWED: &str = "allowed: a bone and a point in cm, as right_hand=-30,-40,120";
    /// Farther from the origin nothing is reached [cm].
    const FARTHEST: f64 = 1e5;
    let (bone, point) = text.split_once('=').ok_or(ALLOWED)?;
    let numbers = point.split(',').map(|number| number.trim().parse::<f64>());
    let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().map_err(|_| ALLOWED)?;
    match <[f64; 3]>::try_from(numbers) {
        Ok(to) if to.iter().all(|x| x.abs() <= FARTHEST) => Ok(Reach {
            bone: bone.trim().into(),
            to: to.into(),
        }),
        _ => Err(format!("{ALLOWED}, each from -100000 to 100000")),
    }
}
