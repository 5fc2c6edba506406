//! What an animation is handed on as: the film, its pictures and its report.

use crate::{args::AnimateWish, failure::Failure};
use soen::{
    body::Bodies,
    certificate::Equilibrium,
    lattice::Lattice,
    math::Vec3,
    output::{self, BodyMesh, ClothMesh, Frame, Image, Shot, View},
    play::{Frames, Member},
    robot::Ball,
    scene::Scene,
};
use std::path::Path;

/// Width and height of the pictures [pixels].
const PICTURE: [u32; 2] = [480, 640];
const NOT_AT_REST: &str = "NOT AT REST: stopped before it was certified";
const NOT_BALANCED: &str = "NOT IN EQUILIBRIUM: stopped before it was certified";

/// Number, time [s] and drape of a frame.
type Take<'a> = (usize, f64, &'a Shot);

/// The frames that are shown.
pub(crate) struct Film<'a> {
    scene: &'a Scene,
    lattice: &'a Lattice,
    /// How many were asked for.
    wanted: usize,
    /// Number, time [s] and drape of each.
    takes: Vec<Take<'a>>,
    /// Frames in a second [1/s].
    rate: f64,
}

impl<'a> Film<'a> {
    /// The shots within a range of frames.
    pub(crate) fn new(
        scene: &'a Scene,
        lattice: &'a Lattice,
        frames: &Frames,
        shots: &'a [Shot],
        range: (usize, usize),
    ) -> Self {
        let takes = shots.iter().enumerate().skip(range.0);
        Self {
            scene,
            lattice,
            wanted: range.1 - range.0,
            rate: frames.rate,
            takes: takes
                .map(|(number, shot)| (number, frames.time(number), shot))
                .collect(),
        }
    }

    /// Whether every frame that was asked for is there and certified.
    pub(crate) fn is_whole(&self) -> bool {
        self.takes.len() == self.wanted && self.takes.iter().all(|(.., shot)| shot.converged)
    }

    /// Writes all; the report last, so that where it stands the others do too.
    pub(crate) fn write(&self, wish: &AnimateWish) -> Result<(), Failure> {
        let put = |name: &str, bytes: &[u8]| output::write(&wish.out.join(name), bytes);
        if !self.takes.is_empty() {
            put("animation.glb", &self.glb())?;
        }
        if wish.pictures {
            let pictures = self.pictures()?;
            for ((number, ..), picture) in self.takes.iter().zip(&pictures) {
                put(&format!("frame-{number:04}.png"), &picture.to_png())?;
            }
            let rate = self.rate.round().clamp(1.0, f64::from(u16::MAX)) as u16;
            put("animation.png", &output::animated_png(&pictures, rate))?;
        }
        put("report.json", self.report().as_bytes())?;
        Ok(())
    }

    fn glb(&self) -> Vec<u8> {
        let frames: Vec<Vec<Vec3>> = self
            .takes
            .iter()
            .map(|(.., shot)| shot.positions.clone())
            .collect();
        let balls: Vec<Vec<Ball>> = self.takes.iter().map(|take| self.balls(take.1)).collect();
        let seconds: Vec<f64> = self.takes.iter().map(|take| take.1).collect();
        output::animated_glb(&output::Film {
            title: &self.scene.title,
            lattice: self.lattice,
            frames: &frames,
            bodies: &self.still(),
            balls: &balls,
            seconds: &seconds,
        })
    }

    /// Every actor's muscles at a time [s].
    fn balls(&self, time: f64) -> Vec<Ball> {
        let actors = self.scene.cast.actors();
        actors.flat_map(|actor| actor.balls(time)).collect()
    }

    /// What does not move.
    fn still(&self) -> Vec<BodyMesh> {
        let members = self.scene.cast.members.iter();
        let still = members.filter_map(|member| match member {
            Member::Still(part) => Some(part.clone()),
            Member::Actor(_) => None,
        });
        output::body_meshes(&Bodies::new(still.collect()))
    }

    /// The bodies' surfaces at a time [s].
    fn shown(&self, time: f64) -> Vec<BodyMesh> {
        let actors = self.scene.cast.actors().flat_map(|actor| {
            output::muscle_meshes(actor.robot(), &actor.posture(time), &actor.frames(time))
        });
        self.still().into_iter().chain(actors).collect()
    }

    /// A picture of each frame; the camera goes with the first actor.
    fn pictures(&self) -> Result<Vec<Image>, Failure> {
        let mut bodies = Vec::new();
        for (_, time, _) in &self.takes {
            let there = self.scene.cast.bodies(*time);
            bodies.push(there.map_err(|error| Failure::Input(error.to_string()))?);
        }
        let shown = |(take, bodies): (&Take<'_>, &Bodies)| {
            let corners = bodies
                .extent()
                .into_iter()
                .flat_map(|(low, high)| [low, high]);
            corners.chain(take.2.positions.iter().copied()).collect()
        };
        let shown: Vec<Vec<Vec3>> = self.takes.iter().zip(&bodies).map(shown).collect();
        let middles: Vec<Vec3> = self.takes.iter().map(|take| self.middle(take.1)).collect();
        let frames = Frame::following(shown.iter().map(Vec::as_slice).zip(middles));
        let pictures = self
            .takes
            .iter()
            .enumerate()
            .map(|(index, (_, time, shot))| {
                let cloth = ClothMesh {
                    lattice: self.lattice,
                    positions: &shot.positions,
                };
                let view = View {
                    caption: (!shot.converged).then_some(match shot.equilibrium {
                        Equilibrium::Static => NOT_AT_REST,
                        Equilibrium::Dynamic { .. } => NOT_BALANCED,
                    }),
                    width: PICTURE[0],
                    height: PICTURE[1],
                    frame: frames.get(index).copied(),
                    ..View::default()
                };
                output::picture_pixels(&cloth, &self.shown(*time), &view)
            });
        Ok(pictures.collect())
    }

    /// Where the first actor's pelvis is at a time [cm].
    fn middle(&self, time: f64) -> Vec3 {
        let actor = self.scene.cast.actors().next();
        let frames = actor.map(|actor| actor.frames(time)).unwrap_or_default();
        frames
            .first()
            .map_or(Vec3::zeros(), |frame| frame.translation.vector)
    }

    pub(crate) fn report(&self) -> String {
        let (title, fabric) = (&self.scene.title, &self.scene.fabric);
        output::film_report(title, fabric, self.wanted, &self.takes)
    }

    /// The frames as a short table.
    pub(crate) fn table(&self, out: &Path) -> String {
        let certified = self
            .takes
            .iter()
            .filter(|(.., shot)| shot.converged)
            .count();
        let mut table = format!(
            "{}\n{certified} of {} frames certified\n  frame  time    residual  to go      deepest    \
             height\n",
            self.scene.title, self.wanted
        );
        for (number, time, shot) in &self.takes {
            let (speed, not) = match shot.equilibrium {
                Equilibrium::Static => (String::new(), "NOT AT REST"),
                Equilibrium::Dynamic { fastest, .. } => {
                    (format!("  {fastest:.1} cm/s"), "NOT IN EQUILIBRIUM")
                }
            };
            let mark = if shot.converged { "" } else { not };
            let mark = format!("{speed}  {mark}");
            let mark = mark.trim_end();
            table += &format!(
                "  {number:5}  {time:5.3} s  {:.1e}  {:.4} cm  {:.4} cm  {:.2} to {:.2} cm{mark}\n",
                shot.residual_max,
                shot.remaining_move,
                shot.deepest,
                shot.heights[0],
                shot.heights[1],
            );
        }
        table + &format!("  written  {}\n", out.display())
    }
}
