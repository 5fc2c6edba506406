//! The slope: a cloth on an inclined plane, which is raised until the cloth slides.

use super::{
    LabError, Reading, Rest, Watch,
    reading::{figures, within},
    specimen::{Limit, TOUCHING, cloth},
};
use crate::{
    body::{Bodies, Part, Shape},
    fabric::Fabric,
    lattice::Outline,
    math::{Pose, Vec3, turn},
};
use nalgebra::Translation3;

/// A square of cloth, and the friction of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slope {
    /// Coulomb friction between cloth and plane [-].
    pub friction: f64,
    /// Side of the square [cm].
    pub size: f64,
    /// Pitch of the lattice [cm].
    pub pitch: f64,
}

/// Where the cloth began to slide.
#[derive(Clone, Debug)]
pub struct Slid {
    /// Steepest slope on which it still lies [°].
    pub angle: f64,
    /// tan of that angle [-].
    pub friction: f64,
    /// The cloth on that slope.
    pub rest: Rest,
}

/// Slopes to look between [°].
const SLOPES: [f64; 2] = [0.0, 80.0];
/// The steepest slope is found to within this [°].
const WITHIN: f64 = 0.02;
/// A cloth that lies still does so after fewer rounds.
const ROUNDS: usize = 60;
/// Thickness of the plane [cm].
const THICK: f64 = 10.0;

impl Slope {
    /// Raises the plane, halving between lying and sliding.
    ///
    /// # Errors
    /// [`LabError`] where a setting is out of range, or the cloth slides on any slope.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Slid, LabError> {
        within("friction [-]", self.friction, 0.01, 2.0)?;
        within("size [cm]", self.size, 1.0, 50.0)?;
        within("pitch [cm]", self.pitch, self.size / 50.0, 0.5 * self.size)?;
        let limit = Limit::find(SLOPES, WITHIN, |degrees| {
            let rest = self.lie(fabric, degrees, watch)?;
            Ok((rest.settled.converged, rest))
        })?;
        let [angle, high] = limit.between;
        let rest = limit.held.ok_or(LabError::NotFound {
            what: "a slope [deg] that the cloth lies on",
            low: angle,
            high,
        })?;
        Ok(Slid {
            angle,
            friction: libm::tan(angle.to_radians()),
            rest,
        })
    }

    /// The cloth laid on a slope.
    fn lie(&self, fabric: &Fabric, degrees: f64, watch: Watch<'_>) -> Result<Rest, LabError> {
        let wide = 6.0 * self.size;
        let plane = Shape::Cuboid {
            size: Vec3::new(wide, wide, THICK),
        };
        let turn = turn(&(Vec3::y() * degrees.to_radians()));
        let down = turn * Vec3::new(0.0, 0.0, -0.5 * THICK);
        let pose = Pose::from_parts(Translation3::from(down), turn);
        let outline = Outline::rectangle(self.size, self.size)?;
        let above = turn * Vec3::new(0.0, 0.0, 0.5 * fabric.thickness + 0.01);
        let mut problem = cloth(fabric, outline, self.pitch, above);
        problem.placement.x_axis = turn * Vec3::x();
        problem.bodies = Bodies::new(vec![Part::new("plane".into(), &plane, pose)?]);
        problem.friction = self.friction;
        Rest::judged(problem, TOUCHING, ROUNDS, watch)
    }
}

impl Slid {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self, test: &Slope) -> Reading {
        Reading {
            instrument: "slope",
            histogram: Vec::new(),
            figures: figures([
                ("sliding_angle_deg", self.angle),
                ("friction", self.friction),
                ("friction_given", test.friction),
            ]),
            trace: None,
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}
