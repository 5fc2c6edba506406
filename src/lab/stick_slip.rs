//! Stick and slip (after Romero et al. 2021): a strip clamped upright above a floor is lowered, bends
//! over its tip, and the tip slips when the floor's reaction leaves the Coulomb cone.
//!
//! The strip has next to no weight, so that its elastica is the weightless one.

use super::{
    LabError, Reading, Rest, Watch,
    reading::{figures, within},
    specimen::{TOUCHING, hold, rigid, strip},
};
use crate::{
    body::{Bodies, Part, Shape},
    fabric::{Fabric, Yarn},
    lattice::Edge,
    math::{Pose, Vec3},
};

/// A strip above a floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StickSlip {
    /// Which way the strip's length runs.
    pub yarn: Yarn,
    /// Coulomb friction of the floor [-].
    pub friction: f64,
    /// Cells along the strip.
    pub cells: u32,
}

/// Where the tip slipped.
#[derive(Clone, Debug)]
pub struct Slipped {
    /// How far the clamp was lowered, over the strip's length [-].
    pub compression: f64,
    /// The strip just before.
    pub rest: Rest,
}

/// Length of the strip [cm].
const LENGTH: f64 = 20.0;
/// W·L³/M_BN of a strip with next to no weight.
const WEIGHTLESS: f64 = 0.02;
/// A tip this part of the length away has slipped.
const AWAY: f64 = 0.03;
/// Compressions are tried up to this; beyond it the tip lies flat.
const MOST: f64 = 0.36;
/// The clamp's first step, in which the strip comes to lie on its bent side, those that follow, and
/// how fine the last ones are.
const FIRST: f64 = 0.01;
const STEP: f64 = 0.01;
const WITHIN: f64 = 5e-4;
/// Rounds that a strip has to come to rest.
const ROUNDS: usize = 1000;
const THICKNESS: f64 = 0.01;

impl StickSlip {
    /// Length of the strip [cm].
    pub const LENGTH: f64 = LENGTH;
    /// Fewest and most cells along it: of 10 the tip slips at once, wherever it should.
    pub const CELLS: [f64; 2] = [20.0, 200.0];

    /// Lowers the clamp step by step, each from where the last came to rest, until the tip slips;
    /// then again with half the step from before it did.
    ///
    /// # Errors
    /// [`LabError`] where a setting is out of range or the tip never slips.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Slipped, LabError> {
        within("friction [-]", self.friction, 0.02, 0.37)?;
        within(
            "cells",
            f64::from(self.cells),
            Self::CELLS[0],
            Self::CELLS[1],
        )?;
        let (mut at, mut step) = (0.0, FIRST);
        let mut rest = None;
        while step > WITHIN {
            let pressed = self.press(fabric, at + step, rest.as_ref(), watch)?;
            if pressed.middle(Edge::XMax).xy().norm() < AWAY * LENGTH {
                (at, rest) = (at + step, Some(pressed));
                step = step.min(STEP);
            } else {
                step *= 0.5;
            }
            if at > MOST {
                break;
            }
        }
        let found = rest.filter(|_| at <= MOST);
        let rest = found.ok_or(LabError::NotFound {
            what: "a compression at which the tip slips",
            low: 0.0,
            high: MOST,
        })?;
        // As it stands: under its load the tip comes to lie a little below the floor's skin.
        let height = rest.middle(Edge::XMin).z - rest.middle(Edge::XMax).z;
        let compression = 1.0 - height / LENGTH + step;
        Ok(Slipped { compression, rest })
    }

    /// The strip, its clamp lowered by a part of its length, from where it stood before if it did.
    fn press(
        &self,
        fabric: &Fabric,
        part: f64,
        before: Option<&Rest>,
        watch: Watch<'_>,
    ) -> Result<Rest, LabError> {
        let mut cloth = rigid(fabric, LENGTH);
        let bending = cloth.along(self.yarn).bending;
        cloth.weight = WEIGHTLESS * bending / (LENGTH * LENGTH * LENGTH);
        let pitch = LENGTH / f64::from(self.cells);
        let mut problem = strip(&cloth, self.yarn.into(), [LENGTH, pitch], pitch)?;
        problem.placement.x_axis = -Vec3::z();
        problem.placement.centre = Vec3::z() * (0.5 * LENGTH + 0.02);
        let down = Vec3::z() * (-part * LENGTH - 0.02);
        problem.holds = vec![hold(Edge::XMin, true, down)];
        let floor = Shape::Cuboid {
            size: Vec3::new(6.0 * LENGTH, 6.0 * LENGTH, 2.0),
        };
        let below = Pose::translation(0.0, 0.0, -1.0 - 0.5 * THICKNESS);
        problem.bodies = Bodies::new(vec![Part::new("floor".into(), &floor, below)?]);
        problem.friction = self.friction;
        problem.thickness = THICKNESS;
        match before {
            None => Rest::judged(problem, TOUCHING, ROUNDS, watch),
            Some(before) => before.on_to(problem, TOUCHING, ROUNDS, watch),
        }
    }
}

impl Slipped {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self, test: &StickSlip) -> Reading {
        Reading {
            instrument: "stick-slip",
            histogram: Vec::new(),
            figures: figures([
                ("friction", test.friction),
                ("compression_at_slip", self.compression),
            ]),
            trace: None,
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}
