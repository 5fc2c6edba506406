//! Specimens: a strip, how it is held, and how it comes to rest.

use super::{LabError, Watch};
use crate::{
    body::Bodies,
    fabric::{Fabric, Tension, Yarn},
    forces::Laws,
    lattice::{Edge, Outline, Piece},
    math::{Vec2, Vec3},
    solver::{ForceModel, Grip, Hold, Placement, Problem, Settings, Settled, go_on, settle},
};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// Which way a strip's length runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// Along the warp.
    Warp,
    /// Along the weft.
    Weft,
    /// At 45° to both.
    Bias,
}

impl Cut {
    /// Angle of the warp against the strip's length [rad].
    #[must_use]
    pub fn grain(self) -> f64 {
        match self {
            Self::Warp => 0.0,
            Self::Weft => FRAC_PI_2,
            Self::Bias => FRAC_PI_4,
        }
    }
}

impl From<Yarn> for Cut {
    fn from(yarn: Yarn) -> Self {
        match yarn {
            Yarn::Warp => Self::Warp,
            Yarn::Weft => Self::Weft,
        }
    }
}

/// Instruments read shapes that are this near to rest [-]; where a body is touched, [`TOUCHING`].
pub(super) const TOLERANCE: f64 = 1e-6;
pub(super) const TOUCHING: f64 = 1e-3;

/// A specimen at rest, or as near as it came.
#[derive(Clone, Debug)]
pub struct Rest {
    /// What was solved.
    pub problem: Problem,
    /// What came of it.
    pub settled: Settled,
}

impl Rest {
    /// Brings a specimen to rest.
    pub(super) fn of(problem: Problem, watch: Watch<'_>) -> Result<Self, LabError> {
        Self::within(problem, TOLERANCE, watch)
    }

    /// Brings a specimen to rest within a tolerance [-].
    pub(super) fn within(
        problem: Problem,
        tolerance: f64,
        watch: Watch<'_>,
    ) -> Result<Self, LabError> {
        let frames = 0;
        let settings = Settings { tolerance, frames };
        let settled = settle(&problem, &settings, watch)?;
        Ok(Self { problem, settled })
    }

    /// A shape that a search judges: at rest, or where so many rounds have left it.
    ///
    /// # Errors
    /// [`LabError::Stopped`] where the watcher ends it: of a shape that was cut short no search can
    /// tell whether it would have held.
    pub(super) fn judged(
        problem: Problem,
        tolerance: f64,
        rounds: usize,
        watch: Watch<'_>,
    ) -> Result<Self, LabError> {
        judged(rounds, watch, |watch| {
            Self::within(problem, tolerance, watch)
        })
    }

    /// The same, gone on to from this rest as bodies and holds move.
    pub(super) fn on_to(
        &self,
        problem: Problem,
        tolerance: f64,
        rounds: usize,
        watch: Watch<'_>,
    ) -> Result<Self, LabError> {
        let frames = 0;
        let settings = Settings { tolerance, frames };
        judged(rounds, watch, |watch| {
            let settled = go_on(&problem, &[], self.settled.state(), &settings, watch)?;
            Ok(Self { problem, settled })
        })
    }

    /// The nodes of an edge of the specimen.
    pub(super) fn edge(&self, edge: Edge) -> Vec<usize> {
        let nodes = self.problem.piece.edge_nodes(&self.settled.lattice, edge);
        nodes.into_iter().map(|node| node as usize).collect()
    }

    /// The middle of an edge of the specimen [cm].
    pub(super) fn middle(&self, edge: Edge) -> Vec3 {
        let nodes = self.edge(edge);
        let sum: Vec3 = nodes.iter().map(|node| self.settled.positions[*node]).sum();
        sum / nodes.len().max(1) as f64
    }

    /// How far a strip's tip is off the plane y = 0 [cm].
    pub(super) fn off_plane(&self) -> f64 {
        self.middle(Edge::XMax).y.abs()
    }

    /// The force that keeps an edge in its place [gf].
    pub(super) fn pull(&self, edge: Edge) -> Vec3 {
        let nodes = self.edge(edge);
        nodes.iter().map(|node| self.settled.holding[*node]).sum()
    }

    /// The middle line of a strip, from its start to its end [cm].
    pub(super) fn line(&self) -> Vec<Vec3> {
        let outline = |node: &usize| {
            let coordinates = &self.settled.lattice.coordinates;
            self.problem.piece.to_outline(coordinates[*node])
        };
        let pitch = self.settled.lattice.pitch;
        let near_middle = |at: Vec2| at.y.abs() < 0.26 * pitch;
        let nodes = 0..self.settled.positions.len();
        let mut line: Vec<usize> = nodes.filter(|node| near_middle(outline(node))).collect();
        line.sort_by(|a, b| outline(a).x.total_cmp(&outline(b).x));
        line.iter()
            .map(|node| self.settled.positions[*node])
            .collect()
    }
}

/// Gives a rest so many rounds.
fn judged(
    rounds: usize,
    watch: Watch<'_>,
    come_to: impl FnOnce(Watch<'_>) -> Result<Rest, LabError>,
) -> Result<Rest, LabError> {
    let (mut left, mut stopped) = (rounds, false);
    let rest = come_to(&mut |progress| {
        left = left.saturating_sub(1);
        stopped = stopped || !watch(progress);
        left > 0 && !stopped
    })?;
    if stopped {
        Err(LabError::Stopped)
    } else {
        Ok(rest)
    }
}

/// Where specimens cease to hold.
pub(super) struct Limit {
    /// The greatest value at which one held, and the least at which one gave way.
    pub(super) between: [f64; 2],
    /// The last that held, and the last that gave way.
    pub(super) held: Option<Rest>,
    pub(super) gave: Option<Rest>,
}

impl Limit {
    /// Halves between two values until they are so close; `try_at` says whether a specimen held.
    pub(super) fn find(
        mut between: [f64; 2],
        close: f64,
        mut try_at: impl FnMut(f64) -> Result<(bool, Rest), LabError>,
    ) -> Result<Self, LabError> {
        let (mut held, mut gave) = (None, None);
        while between[1] - between[0] > close {
            let middle = 0.5 * (between[0] + between[1]);
            let (holds, rest) = try_at(middle)?;
            if holds {
                (between[0], held) = (middle, Some(rest));
            } else {
                (between[1], gave) = (middle, Some(rest));
            }
        }
        Ok(Self {
            between,
            held,
            gave,
        })
    }
}

/// A strip of so many [cm] along x and across, lying level from the origin along x.
pub(super) fn strip(
    fabric: &Fabric,
    cut: Cut,
    [length, width]: [f64; 2],
    pitch: f64,
) -> Result<Problem, LabError> {
    let outline = Outline::rectangle(length, width)?;
    let mut problem = cloth(fabric, outline, pitch, Vec3::x() * (0.5 * length));
    problem.piece.grain = cut.grain();
    Ok(problem)
}

/// A piece of cloth on grain, lying level about a centre [cm]; nothing holds it yet.
pub(super) fn cloth(fabric: &Fabric, outline: Outline, pitch: f64, centre: Vec3) -> Problem {
    Problem {
        fabric: fabric.clone(),
        piece: Piece {
            outline,
            grain: 0.0,
            pitch,
        },
        placement: Placement {
            centre,
            x_axis: Vec3::x(),
            y_axis: Vec3::y(),
            curl: 0.0,
        },
        holds: Vec::new(),
        bodies: Bodies::default(),
        friction: fabric.friction.body,
        thickness: fabric.thickness,
        laws: Laws::default(),
        forces: ForceModel::Lattice,
        seed: 1,
    }
}

/// A hand on an edge.
pub(super) fn hold(edge: Edge, clamp: bool, carry: Vec3) -> Hold {
    let grip = Grip::Edge(edge);
    Hold { grip, clamp, carry }
}

/// The cloth without weight: a machine shows forces with the specimen's own weight taken off.
pub(super) fn tared(fabric: &Fabric) -> Fabric {
    Fabric {
        weight: 0.0,
        ..fabric.clone()
    }
}

/// T·L²/M_BN and M_SH·L²/M_BN of cloth that bends long before anything else.
const RIGID: f64 = 1e6;

/// The cloth with yarns and shear so stiff that a strip of a length [cm] only bends and twists, as
/// the theories of rods have it.
pub(super) fn rigid(fabric: &Fabric, length: f64) -> Fabric {
    let mut cloth = fabric.clone();
    for direction in [&mut cloth.warp, &mut cloth.weft] {
        let modulus = RIGID * direction.bending / (length * length);
        direction.tension = Tension::Linear { modulus };
        direction.shear = modulus;
    }
    cloth
}
