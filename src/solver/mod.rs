//! Finds rest: node by node to each node's own equilibrium (paper C-ii), until the whole is at rest.

mod carry;
mod dense;
mod descent;
mod dissection;
mod factor;
mod film;
mod follow;
mod inertia;
mod joint;
mod leader;
mod leap;
mod level;
mod march;
mod model;
mod moving;
mod multigrid;
mod number;
mod packed;
mod rest;
mod start;
mod stiffness;
mod stream;
mod substitution;
mod sweep;
mod visit;

use crate::{
    body::Bodies,
    certificate::{Certificate, DrapeShape},
    contact::Footing,
    fabric::Fabric,
    forces::Laws,
    lattice::{CutError, Edge, Lattice, Piece},
    math::{Vec2, Vec3},
};

/// Where the flat cloth starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Where the outline's centre is [cm].
    pub centre: Vec3,
    /// The outline's x axis in space, of length 1.
    pub x_axis: Vec3,
    /// The outline's y axis in space, of length 1, at a right angle to x.
    pub y_axis: Vec3,
    /// Curvature that the cloth is rolled up with, about the y axis and towards x × y [rad/cm]; 0
    /// where it starts flat.
    pub curl: f64,
}

impl Placement {
    /// Where a point in outline coordinates [cm] starts.
    #[must_use]
    pub fn at(&self, outline: Vec2) -> Vec3 {
        if self.curl == 0.0 {
            return self.centre + self.x_axis * outline.x + self.y_axis * outline.y;
        }
        let (sine, cosine) = libm::sincos(self.curl * outline.x);
        let rolled = self.x_axis * sine + self.x_axis.cross(&self.y_axis) * (1.0 - cosine);
        self.centre + rolled / self.curl + self.y_axis * outline.y
    }

    /// The direction in space of a direction of the outline, at a point of it [cm].
    #[must_use]
    pub fn along(&self, direction: Vec2, outline: Vec2) -> Vec3 {
        let (sine, cosine) = libm::sincos(self.curl * outline.x);
        let along_x = self.x_axis * cosine + self.x_axis.cross(&self.y_axis) * sine;
        along_x * direction.x + self.y_axis * direction.y
    }
}

/// What a hold takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grip {
    /// The node nearest to a point in outline coordinates [cm].
    Point(Vec2),
    /// Every node on an edge of the outline.
    Edge(Edge),
}

/// Points that are held in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// What is held.
    pub grip: Grip,
    /// Whether the slope is held too, as in a vice (`physics.md` §3: a half cell).
    pub clamp: bool,
    /// Where it is carried before the rest is found [cm].
    pub carry: Vec3,
}

/// How a node's forces are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceModel {
    /// Minus the gradient of the whole energy.
    Lattice,
    /// Figures 7–9 to the letter: 4 tensions, 2 bends and 4 shears of the node's own.
    Paper,
}

/// A cloth, a body and a start.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The cloth's material.
    pub fabric: Fabric,
    /// The cloth's cut.
    pub piece: Piece,
    /// Where it starts.
    pub placement: Placement,
    /// What is held.
    pub holds: Vec<Hold>,
    /// What it may rest on.
    pub bodies: Bodies,
    /// Coulomb friction against the bodies [-].
    pub friction: f64,
    /// Thickness of the cloth in contact [cm].
    pub thickness: f64,
    /// Which laws act.
    pub laws: Laws,
    /// How forces are counted.
    pub forces: ForceModel,
    /// Seed of the perturbation that lets folds begin.
    pub seed: u64,
}

/// A cut with fewer cells than this is none of the coarse ones that a solution goes through.
const PREVIEWED_CELLS: usize = 50;

impl Problem {
    /// The same problem on one of the coarse cuts that its solution starts from: with a sixteenth of
    /// the nodes, or a quarter, or all of a small cloth.
    #[must_use]
    pub fn preview(&self) -> Self {
        let coarser = |times: f64| {
            let mut coarse = self.clone();
            coarse.piece.pitch *= times;
            coarse
        };
        let shows = |coarse: &Self| {
            let lattice = prepare(coarse);
            lattice.is_ok_and(|lattice| lattice.cells.len() > PREVIEWED_CELLS)
        };
        let coarse = [4.0, 2.0].map(coarser);
        let shown = coarse.into_iter().find(shows);
        shown.unwrap_or_else(|| self.clone())
    }
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Residual at which a node counts as at rest [-].
    pub tolerance: f64,
    /// How many shapes between start and rest are kept.
    pub frames: usize,
}

/// Where a run is; the watcher answers whether to go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Which level, from 0 for the coarsest, and how many there are.
    pub level: (usize, usize),
    /// Nodes of this level.
    pub nodes: usize,
    /// Sweeps on this level so far.
    pub sweeps: usize,
    /// Greatest residual so far known [-]; infinite before the first.
    pub residual: f64,
    /// Longest move that the last joint step asked for [cm]; infinite before the first.
    pub remaining_move: f64,
}

/// The work done on one level.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Pitch [cm].
    pub spacing: f64,
    /// Nodes.
    pub nodes: usize,
    /// Sweeps over all nodes.
    pub sweeps: usize,
    /// Joint steps: system (8) written for all nodes at once.
    pub joint_steps: usize,
    /// Updates of single nodes.
    pub updates: u64,
}

/// What came of it: a shape and the proof, or the lack of one.
#[derive(Clone, Debug)]
pub struct Settled {
    /// The finest lattice.
    pub lattice: Lattice,
    /// Positions of its nodes [cm].
    pub positions: Vec<Vec3>,
    /// Normal force of the bodies on each node [gf].
    pub contact: Vec<f64>,
    /// Where friction holds on, for a drape that goes on from this one.
    pub footing: Footing,
    /// Velocities of the nodes [cm/s]; zero at rest.
    pub velocities: Vec<Vec3>,
    /// Force that keeps each held node in its place [gf]; zero on free ones.
    pub holding: Vec<Vec3>,
    /// The proof of rest.
    pub certificate: Certificate,
    /// Whether all of the certificate holds at the tolerance.
    pub converged: bool,
    /// Figures of the shape.
    pub shape: DrapeShape,
    /// Levels from coarse to fine.
    pub levels: Vec<Level>,
    /// Updates of single nodes over all levels.
    pub node_updates: u64,
    /// Shapes between start and rest, on the finest lattice.
    pub frames: Vec<Vec<Vec3>>,
}

impl Settled {
    /// What a drape that goes on from this one must know: positions [cm] and footing.
    #[must_use]
    pub fn state(&self) -> (&[Vec3], &Footing) {
        (&self.positions, &self.footing)
    }
}

/// A problem that has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unsolvable {
    /// The cloth could not be cut.
    #[error(transparent)]
    Cut(#[from] CutError),
    /// A hold takes nothing.
    #[error("hold {index} is at ({x}, {y}) cm, outside the cloth")]
    HoldOutside {
        /// Which hold, from 1.
        index: usize,
        /// Outline coordinate [cm].
        x: f64,
        /// Outline coordinate [cm].
        y: f64,
    },
    /// The start is inside a body.
    #[error("the cloth starts inside {part:?}: {depth} cm deep at ({x}, {y}, {z}) cm")]
    StartsInside {
        /// The part's name.
        part: String,
        /// How deep [cm].
        depth: f64,
        /// Where [cm].
        x: f64,
        /// Where [cm].
        y: f64,
        /// Where [cm].
        z: f64,
    },
    /// Nothing holds the cloth: no hold, and no body under it.
    #[error("nothing carries the cloth: give a [[hold]], or a [[body]] below it")]
    Falls,
    /// A drape cannot go on as another cloth, or over other parts.
    #[error("the cloth, its holds or the parts of the bodies are not those of the drape before")]
    Changed,
    /// A step of time that cannot be taken.
    #[error("{quantity} is {value}; allowed: {allowed}")]
    Pace {
        /// Which number.
        quantity: &'static str,
        /// What it is.
        value: f64,
        /// Its range, in words.
        allowed: &'static str,
    },
}

/// Cuts the cloth, takes hold of it and lets it fall, as [`settle`] does first, and solves nothing.
///
/// # Errors
/// [`Unsolvable`], as [`settle`].
pub fn prepare(problem: &Problem) -> Result<Lattice, Unsolvable> {
    descent::prepare(problem)
}

/// Solves a problem; `watch` is asked between sweeps whether to go on.
///
/// An unconverged drape is a value whose certificate says so.
///
/// # Errors
/// [`Unsolvable`] where no start can be made.
pub fn settle(
    problem: &Problem,
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    descent::descend(problem, settings, watch)
}

/// Goes on from a drape of the same cloth, by its positions [cm] and its footing, while bodies and
/// holds move and friction keeps what it remembers: quasi-static motion.
///
/// The bodies pass `through` the ways they stand in between and end as the problem has them, part by
/// part the same; from one to the next nothing should move by more than a few millimetres, and never
/// by more than a part's half thickness. Holds are carried from where they are to where the problem
/// has them. The result has its own certificate.
///
/// # Errors
/// [`Unsolvable`], as [`settle`]; [`Unsolvable::Changed`] where cloth or parts are others.
pub fn go_on(
    problem: &Problem,
    through: &[Bodies],
    before: (&[Vec3], &Footing),
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    follow::go_on(problem, through, before, settings, watch)
}

/// How a cloth with inertia goes through time.
///
/// A step is backward Euler's, which damps by itself: a swing of angular frequency ω [rad/s] loses
/// amplitude at a rate of about ½·ω²·step [1/s], so that steps of 1/200 s hardly slow the swing of a
/// skirt (ω = 6: 0.1/s) and take away its flutter (ω = 60: 9/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// A step of time [s], 1e-6 to 10.
    pub step: f64,
    /// Rate at which motion through still air dies down [1/s], 0 to 1e4.
    pub damping: f64,
}

impl Dynamics {
    /// The rate [1/s] at which air slows a cloth of this weight [gf/cm²] at 1 m/s, on average over all
    /// the ways that it may face: a third of the drag ½·ρ·C·v² of a plate broadside on over mass times
    /// v, since air resists the part of a motion that goes across the cloth, and the mean of cos² over
    /// all directions is 1/3. ρ = 1.2e-3 g/cm³, C = 1.16 (a square plate; Hoerner, *Fluid-Dynamic
    /// Drag*, 1965).
    #[must_use]
    pub fn damping_in_air(weight: f64) -> f64 {
        (0.5 * 1.2e-3 * 1.16 * 100.0 / (3.0 * weight)).min(moving::MOST_DAMPING)
    }
}

/// Goes on in time from a cloth that moves: by its positions [cm], its footing and its velocities
/// [cm/s]. Inertia resists, and still air.
///
/// There is a step for each of the bodies that it goes `through`, and one for the problem's: each as it
/// is at the step's end, part by part the same as the footing's. Holds go steadily from where they are to
/// where the problem has them. A step that does not come to its equilibrium is halved, the bodies half
/// way in between; none should take a body farther than half of what it is thick. The certificate is
/// that of the last step: forces balance with inertia (d'Alembert). Its way to go is the worst of all.
///
/// # Errors
/// [`Unsolvable`], as [`go_on`]; [`Unsolvable::Pace`] for a step, a damping or a velocity out of range.
pub fn step(
    problem: &Problem,
    through: &[Bodies],
    before: (&[Vec3], &Footing, &[Vec3]),
    dynamics: Dynamics,
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    moving::go(problem, through, before, dynamics, settings, watch)
}

/// Velocities [cm/s] of a cloth that goes along with its bodies to where they are so many `seconds`
/// later, each node as the bodies near it do; held nodes stand still.
///
/// # Errors
/// [`Unsolvable::Changed`], as [`go_on`].
pub fn borne(
    problem: &Problem,
    before: (&[Vec3], &Footing),
    later: &Bodies,
    seconds: f64,
) -> Result<Vec<Vec3>, Unsolvable> {
    moving::borne(problem, before, later, seconds)
}

/// The shape [cm] that so many sweeps alone, without joint steps and coarse cuts, take the flat
/// cloth to: to measure the sweeps by.
///
/// # Errors
/// [`Unsolvable`], as [`settle`].
pub fn sweeps(problem: &Problem, count: usize) -> Result<Vec<Vec3>, Unsolvable> {
    descent::sweeps(problem, count)
}
