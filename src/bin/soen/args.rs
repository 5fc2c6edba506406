//! Every command and option, with its help and its default.

use crate::{lab::args::LabWish, robot::args::RobotWish};
use clap::{Args, Parser, Subcommand};
use soen::output::Map;
use std::path::PathBuf;

/// How measured cloth hangs over any body, with a certificate that it is at rest.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Finds the shape in which a scene's cloth hangs, and writes it.
    ///
    /// Exit codes: 0 certified, 2 bad input, 3 stopped before it was certified (the files are
    /// written and marked), 1 anything else. Ctrl-C stops and writes; a second one ends at once.
    Drape(Wish),
    /// Finds a drape for each frame of a motion, each gone on from the last, and writes the film.
    ///
    /// Finished frames are kept in DIR: a run that was ended goes on from its last good frame, to
    /// the same bits. Exit codes: 0 all frames certified, 2 bad input, 3 stopped, or a frame is not
    /// certified, 1 anything else. Ctrl-C stops and writes; a second one ends at once.
    Animate(AnimateWish),
    /// Reads a scene and all its files, finds out whether a drape can begin, solves nothing, and
    /// prints what was understood.
    Check {
        /// The scene file.
        scene: PathBuf,
    },
    /// Shows fabrics.
    Fabric {
        #[command(subcommand)]
        wish: FabricWish,
    },
    /// Measures a fabric as a textile laboratory does, on the simulated cloth.
    ///
    /// Each instrument prints its numbers. Exit codes: 0 certified, 2 bad input, 3 stopped before
    /// every shape was certified, 1 anything else, and for `verify` where a comparison fails.
    Lab(LabWish),
    /// Builds a measured person's body, poses it and prints what a tape finds on it.
    ///
    /// Exit codes: 0 done, 2 bad input, 1 anything else.
    Robot(RobotWish),
    /// Prints the JSON Schema of scene files, for editors.
    Schema,
}

#[derive(Args, Debug)]
pub(crate) struct Wish {
    /// The scene file.
    pub(crate) scene: PathBuf,
    /// Folder for drape.obj, drape.glb, drape.png and report.json.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Takes a quick look: the same cloth cut four times as coarse, in a tenth to a quarter of the
    /// time. The fine drape starts from this one.
    #[arg(long)]
    pub(crate) preview: bool,
    #[command(flatten)]
    pub(crate) run: RunWish,
    /// Writes N shapes between start and rest as frame-0001.obj and .png, …
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u16).range(0..=9999))]
    pub(crate) frames: u16,
    /// Also writes map-NAME.png and, with all maps in it, drape.ply: strain-warp, strain-weft (%;
    /// fractions in drape.ply), shear (degrees), contact-pressure (kPa) or gap (cm from each node
    /// to the nearest body). May be given more than once.
    #[arg(long = "map", value_name = "NAME", value_parser = map)]
    pub(crate) maps: Vec<Map>,
}

/// How a long run goes.
#[derive(Args, Debug)]
pub(crate) struct RunWish {
    /// Threads; all cores where not given. The result is the same, bit for bit.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Prints the report alone on standard output.
    #[arg(long)]
    pub(crate) json: bool,
    /// Stops after this time, an animation each of its frames, in place of the scene's max_seconds.
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub(crate) max_seconds: Option<f64>,
}

#[derive(Args, Debug)]
pub(crate) struct AnimateWish {
    /// The scene file, with an [animation] and a robot that has a motion.
    pub(crate) scene: PathBuf,
    /// Folder for animation.glb, report.json, the kept frames and pictures.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: PathBuf,
    /// Shows the frames from A up to, not with, B; all where not given.
    #[arg(long, value_name = "A..B", value_parser = range)]
    pub(crate) frames: Option<(usize, usize)>,
    /// Also writes a picture of each frame, frame-0000.png, …, and all of them as animation.png.
    #[arg(long)]
    pub(crate) pictures: bool,
    #[command(flatten)]
    pub(crate) run: RunWish,
}

#[derive(Debug, Subcommand)]
pub(crate) enum FabricWish {
    /// Lists the fabrics that ship.
    List,
    /// Prints a fabric file, after checking it.
    Show {
        /// One of the fabrics that ship, a file in fabrics/, or a path to a .toml.
        name: String,
    },
    /// Finds a fabric in what a laboratory measured, and writes its file.
    ///
    /// The sheet names S–S curves, overhangs and shear records, or has the numbers of a KES-F or
    /// FAST sheet. Each S–S curve is also plotted beside the file, as NAME-warp.svg, NAME-weft.svg.
    Fit(FitWish),
}

#[derive(Args, Debug)]
pub(crate) struct FitWish {
    /// The measurement sheet, a .toml.
    pub(crate) sheet: PathBuf,
    /// The fabric file to write, a .toml.
    #[arg(long, value_name = "FABRIC")]
    pub(crate) out: PathBuf,
    /// Prints what was found as JSON alone.
    #[arg(long)]
    pub(crate) json: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..=1e7).contains(&seconds) => Ok(seconds),
        _ => Err("allowed: 0 to 10000000 seconds".into()),
    }
}

fn range(text: &str) -> Result<(usize, usize), String> {
    let ends = text.split_once("..");
    let ends = ends.and_then(|(from, to)| Some((from.parse().ok()?, to.parse().ok()?)));
    ends.ok_or_else(|| "allowed: A..B, two whole numbers".into())
}

fn map(word: &str) -> Result<Map, String> {
    word.parse()
        .map_err(|error: soen::output::UnknownMap| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_commands_are_well_formed() {
        Arguments::command().debug_assert();
    }
}
