//! Lateral buckling: a narrow strip on edge, clamped at one end, falls over sideways when it is
//! longer than `L³ = 12.8538·√(EI·GJ)/q` (Michell 1899, Prandtl 1899, for its own weight).
//!
//! Of cloth, EI is M_BN and GJ the twist modulus M_T, each times the width, and q is W times it: so
//! the width falls out. Without a twist modulus nothing keeps the strip up.

use super::{
    LabError, Reading, Rest, Watch,
    reading::{figures, within},
    specimen::{Limit, TOLERANCE, hold, rigid, strip},
};
use crate::{
    fabric::{Fabric, Yarn},
    lattice::Edge,
    math::Vec3,
};

/// q·L³ over √(EI·GJ) at which it buckles.
pub const CRITICAL: f64 = 12.853_763_321_4;
/// A strip whose tip is this part of its length off its plane has buckled.
const BUCKLED: f64 = 0.005;
/// Most cells along a strip.
const LONG: f64 = 1000.0;
/// The critical length is found to within this part.
const WITHIN: f64 = 0.005;

/// A strip on edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Buckling {
    /// Which way its length runs.
    pub yarn: Yarn,
    /// Its height, over its length.
    pub slimness: f64,
    /// Cells along its height.
    pub cells: u32,
    /// Whether its yarns and its shear are rigid, as the theory has them; else the strip also sags
    /// in its plane.
    pub rigid: bool,
}

impl Default for Buckling {
    fn default() -> Self {
        Self {
            yarn: Yarn::Warp,
            slimness: 0.1,
            cells: 2,
            rigid: false,
        }
    }
}

/// The longest strip that stood.
#[derive(Clone, Debug)]
pub struct Stood {
    /// Its length [cm].
    pub length: f64,
    /// The same by theory [cm].
    pub critical: f64,
    /// The shortest strip that was seen to buckle.
    pub rest: Rest,
}

impl Buckling {
    /// The length at which a strip along a yarn buckles, by theory [cm].
    ///
    /// # Errors
    /// [`LabError`] where the fabric does not bend or twist.
    pub fn critical(fabric: &Fabric, yarn: Yarn) -> Result<f64, LabError> {
        let bending = fabric.along(yarn).bending;
        let bending = within("bending [gf·cm]", bending, 1e-9, 1e4)?;
        let twist = within("twist modulus [gf·cm]", fabric.twist, 1e-9, 1e4)?;
        Ok(libm::cbrt(
            CRITICAL * (bending * twist).sqrt() / fabric.weight,
        ))
    }

    /// Halves between standing and buckling.
    ///
    /// # Errors
    /// [`LabError`] where the fabric does not bend or twist, or a strip cannot be cut.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Stood, LabError> {
        within("slimness [-]", self.slimness, 0.005, 1.0)?;
        within("cells", f64::from(self.cells), 1.0, LONG * self.slimness)?;
        let critical = Self::critical(fabric, self.yarn)?;
        let lengths = [0.0, 2.0 * critical];
        let limit = Limit::find(lengths, WITHIN * critical, |length| {
            let rest = self.stand(fabric, length, watch)?;
            Ok((rest.off_plane() <= BUCKLED * length, rest))
        })?;
        let [low, high] = limit.between;
        let rest = limit.gave.ok_or(LabError::NotFound {
            what: "a length [cm] at which the strip buckles",
            low: lengths[0],
            high: lengths[1],
        })?;
        let length = 0.5 * (low + high);
        Ok(Stood {
            length,
            critical,
            rest,
        })
    }

    /// A strip on edge.
    ///
    /// # Errors
    /// [`LabError`] where it cannot be cut.
    pub fn stand(&self, fabric: &Fabric, length: f64, watch: Watch<'_>) -> Result<Rest, LabError> {
        let height = self.slimness * length;
        let pitch = height / f64::from(self.cells);
        let rigid = self.rigid.then(|| rigid(fabric, length));
        let cloth = rigid.as_ref().unwrap_or(fabric);
        let mut problem = strip(cloth, self.yarn.into(), [length, height], pitch)?;
        problem.placement.y_axis = Vec3::z();
        problem.holds = vec![hold(Edge::XMin, true, Vec3::zeros())];
        Rest::judged(problem, TOLERANCE, usize::MAX, watch)
    }
}

impl Stood {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self) -> Reading {
        let of_theory = 100.0 * (self.length / self.critical - 1.0);
        Reading {
            instrument: "buckling",
            histogram: Vec::new(),
            figures: figures([
                ("twist_gf_cm", self.rest.problem.fabric.twist),
                ("critical_length_cm", self.length),
                ("critical_length_of_theory_cm", self.critical),
                ("from_theory_percent", of_theory),
            ]),
            trace: None,
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}
