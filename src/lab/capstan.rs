//! The capstan: a belt over a fixed cylinder, its ends hanging; by how much the longer may outweigh
//! the shorter before the belt slides.
//!
//! With its own weight on the cylinder counted, the longest end is
//! `L₂ = L₁·e^{µπ} + R·2µ/(1 + µ²)·(e^{µπ} + 1)` (Euler–Eytelwein for a heavy belt).

use super::{
    LabError, Reading, Rest, Watch,
    reading::{figures, within},
    specimen::{TOUCHING, strip},
};
use crate::{
    body::{Bodies, Part, Shape},
    fabric::{Fabric, Yarn},
    math::{Pose, Vec3, turn},
};
use nalgebra::Translation3;
use std::f64::consts::{FRAC_PI_2, PI};

/// A belt, one cell wide, over a cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capstan {
    /// Which way the belt's length runs.
    pub yarn: Yarn,
    /// Coulomb friction [-].
    pub friction: f64,
    /// Radius of the belt's middle on the cylinder [cm].
    pub radius: f64,
    /// The shorter end, below the cylinder's side [cm].
    pub short: f64,
    /// Pitch of the lattice [cm].
    pub pitch: f64,
}

impl Default for Capstan {
    fn default() -> Self {
        Self {
            yarn: Yarn::Warp,
            friction: 0.3,
            radius: 5.0,
            short: 10.0,
            pitch: 0.25,
        }
    }
}

/// The heaviest belt that lay still.
#[derive(Clone, Debug)]
pub struct Held {
    /// Its longer end over the longest that theory lets friction hold, as it lies [-].
    pub part: f64,
    /// The longer end [cm].
    pub long: f64,
    /// The shorter end, as it lies [cm].
    pub short: f64,
    /// The belt.
    pub rest: Rest,
}

/// Belts are tried from this part above the limit down, in steps.
const FROM: f64 = 1.01;
const STEP: f64 = 0.0025;
const TRIES: u32 = 40;
/// Rounds that a belt has to come to rest.
const ROUNDS: usize = 800;
const THICKNESS: f64 = 0.01;

impl Capstan {
    /// The usual cylinder, at a pitch that a fabric's bends need: a quarter of its bending length
    /// along the belt, but 0.25 to 0.5 cm.
    #[must_use]
    pub fn of(fabric: &Fabric, yarn: Yarn) -> Self {
        let pitch = (0.25 * fabric.bending_length(yarn)).clamp(0.25, 0.5);
        Self {
            yarn,
            pitch,
            ..Self::default()
        }
    }

    /// Lays ever lighter belts until one lies still. What its landing moved counts: it is judged as
    /// it lies.
    ///
    /// # Errors
    /// [`LabError`] where a setting is out of range or no belt lies still.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Held, LabError> {
        within("friction [-]", self.friction, 0.01, 1.0)?;
        within("radius [cm]", self.radius, 0.5, 100.0)?;
        within("short end [cm]", self.short, 0.5, 20.0 * self.radius)?;
        within(
            "pitch [cm]",
            self.pitch,
            self.radius / 100.0,
            0.5 * self.radius,
        )?;
        for step in 0..TRIES {
            let held = self.lay(fabric, FROM - STEP * f64::from(step), watch)?;
            if held.rest.settled.converged {
                return Ok(held);
            }
        }
        Err(LabError::NotFound {
            what: "the part of the limit at which the belt lies still",
            low: FROM - STEP * f64::from(TRIES),
            high: FROM,
        })
    }

    /// The longest end that friction holds against a shorter one [cm].
    #[must_use]
    pub fn longest(&self, short: f64) -> f64 {
        let friction = self.friction;
        let grip = libm::exp(friction * PI);
        short * grip + self.radius * 2.0 * friction / (1.0 + friction * friction) * (grip + 1.0)
    }

    /// Lays the belt flat on top, its longer end a part of the longest.
    fn lay(&self, fabric: &Fabric, part: f64, watch: Watch<'_>) -> Result<Held, LabError> {
        let long = part * self.longest(self.short);
        let shift = 0.5 * (long - self.short);
        let length = self.short + PI * self.radius + long;
        let mut problem = strip(fabric, self.yarn.into(), [length, self.pitch], self.pitch)?;
        problem.placement.centre = Vec3::new(shift, 0.0, self.radius + 0.2);
        problem.thickness = THICKNESS;
        problem.friction = self.friction;
        problem.bodies = Bodies::new(vec![self.cylinder()?]);
        let rest = Rest::judged(problem, TOUCHING, ROUNDS, watch)?;
        let slipped = slipped(&rest);
        let (long, short) = (long + slipped, self.short - slipped);
        let part = long / self.longest(short);
        Ok(Held {
            part,
            long,
            short,
            rest,
        })
    }

    fn cylinder(&self) -> Result<Part, LabError> {
        let shape = Shape::Cylinder {
            radius: self.radius - 0.5 * THICKNESS,
            height: 20.0 * self.pitch.max(1.0),
        };
        let level = turn(&(Vec3::x() * FRAC_PI_2));
        let pose = Pose::from_parts(Translation3::identity(), level);
        Ok(Part::new("cylinder".into(), &shape, pose)?)
    }
}

/// How far the cloth on top has gone towards the longer end [cm].
fn slipped(rest: &Rest) -> f64 {
    let at = &rest.settled.positions;
    let top = (0..at.len()).max_by(|a, b| at[*a].z.total_cmp(&at[*b].z));
    let piece = &rest.problem.piece;
    top.map_or(0.0, |top| {
        let cloth = piece.to_outline(rest.settled.lattice.coordinates[top]);
        at[top].x - (cloth.x + rest.problem.placement.centre.x)
    })
}

impl Held {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self, test: &Capstan) -> Reading {
        Reading {
            instrument: "capstan",
            histogram: Vec::new(),
            figures: figures([
                ("long_end_cm", self.long),
                ("short_end_cm", self.short),
                ("limit_cm", test.longest(self.short)),
                ("part_of_limit", self.part),
            ]),
            trace: None,
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// d_capstan of `reference.json`.
    #[test]
    fn the_longest_end_counts_the_belts_weight_on_the_cylinder() {
        let capstan = Capstan {
            friction: 0.1,
            radius: 0.5,
            ..Capstan::default()
        };
        for (short, long) in [(5.0, 7.080_103_978_93), (10.0, 13.925_642_832_1)] {
            let longest = capstan.longest(short);
            assert!((longest - long).abs() < 1e-9, "{longest}");
        }
    }
}
