//! Bending on the bias: strips cut along warp, weft and at 45° to both, bent as cantilevers.
//!
//! A sheet bent to a cylinder along the bias has `B45 = (B_warp + B_weft + M_T)/4`, for it is bent by
//! a half along both yarns, and twisted. Of rods that resist no twist it is half the mean of warp and
//! weft; ten cloths measured by Wang et al. (2011) show 0.78 of it on average. A narrow strip may
//! twist besides, and has less.
//!
//! Of cloth C with twist, B45 over the mean of what its warp and weft strips show is 0.71, 0.73, 0.75
//! with 4, 8, 16 cells; without it 0.61, 0.53, 0.50.

use super::{
    Cut, LabError, Reading, Rest, Watch,
    elastica::bending_of_drop,
    reading::{figures, within},
    specimen::{hold, strip},
};
use crate::{fabric::Fabric, lattice::Edge, math::Vec3};
use std::f64::consts::SQRT_2;

/// B45 over the mean of warp and weft, of measured cloth [-].
const MEASURED: f64 = 0.78;

/// Most cells across a strip.
const WIDE: f64 = 500.0;

/// Three strips.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BiasBend {
    /// Twist modulus M_T [gf·cm].
    pub twist: f64,
    /// Width of the strips [cm].
    pub width: f64,
    /// Cells along a strip.
    pub cells: u32,
}

impl BiasBend {
    /// With a fabric's twist modulus or, where it has none, with that of measured cloth.
    #[must_use]
    pub fn of(fabric: &Fabric) -> Self {
        let both = fabric.warp.bending + fabric.weft.bending;
        let usual = (2.0 * MEASURED - 1.0) * both;
        Self {
            twist: if fabric.twist > 0.0 {
                fabric.twist
            } else {
                usual
            },
            width: 10.0,
            cells: 16,
        }
    }
}

/// What the strips' bending is.
#[derive(Clone, Debug)]
pub struct BiasBent {
    /// Along warp, weft and bias with the twist modulus [gf·cm].
    pub with: [f64; 3],
    /// Along the bias without it [gf·cm].
    pub without: f64,
    /// The bias strip with it.
    pub rest: Rest,
    certified: bool,
}

impl BiasBend {
    /// How long the strips are: two bending lengths of the mean of warp and weft [cm].
    #[must_use]
    pub fn length(fabric: &Fabric) -> f64 {
        let bending = 0.5 * (fabric.warp.bending + fabric.weft.bending);
        2.0 * libm::cbrt(bending / fabric.weight)
    }

    /// Bends the strips, each about two bending lengths long.
    ///
    /// # Errors
    /// [`LabError`] where a setting is out of range or a strip cannot be cut.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<BiasBent, LabError> {
        let both = fabric.warp.bending + fabric.weft.bending;
        within("bending [gf·cm]", 0.5 * both, 1e-9, 1e4)?;
        within("twist modulus [gf·cm]", self.twist, 0.0, 1e4)?;
        within("width [cm]", self.width, 0.5, 100.0)?;
        within("cells", f64::from(self.cells), 4.0, 200.0)?;
        let mut bend = |cut: Cut, twist: f64| self.bend(fabric, cut, twist, watch);
        let (warp, warp_rest) = bend(Cut::Warp, self.twist)?;
        let (weft, weft_rest) = bend(Cut::Weft, self.twist)?;
        let (bias, rest) = bend(Cut::Bias, self.twist)?;
        let (without, plain_rest) = bend(Cut::Bias, 0.0)?;
        let rests = [&warp_rest, &weft_rest, &rest, &plain_rest];
        let certified = rests.iter().all(|rest| rest.settled.converged);
        let with = [warp, weft, bias];
        Ok(BiasBent {
            with,
            without,
            rest,
            certified,
        })
    }

    /// The bending [gf·cm] with which the elastica's tip would drop as the strip's does.
    fn bend(
        &self,
        fabric: &Fabric,
        cut: Cut,
        twist: f64,
        watch: Watch<'_>,
    ) -> Result<(f64, Rest), LabError> {
        let length = Self::length(fabric);
        let cloth = Fabric {
            twist,
            ..fabric.clone()
        };
        let (pitch, width) = self.lattice(cut, length)?;
        let mut problem = strip(&cloth, cut, [length, width], pitch)?;
        problem.holds = vec![hold(Edge::XMin, true, Vec3::zeros())];
        let rest = Rest::of(problem, watch)?;
        let drop = -rest.middle(Edge::XMax).z;
        Ok((bending_of_drop(fabric.weight, length, drop), rest))
    }

    /// Pitch and width [cm] of a strip. Along the bias the lattice's nodes fall into lines across it,
    /// half a cell's diagonal apart: the strip ends on such lines, at its clamp as at its sides, so
    /// that no cell is cut there.
    fn lattice(&self, cut: Cut, length: f64) -> Result<(f64, f64), LabError> {
        let pitch = length / f64::from(self.cells);
        let width = within("width [cm]", self.width, pitch, WIDE * pitch)?;
        if cut != Cut::Bias {
            return Ok((pitch, width));
        }
        let diagonals = (length / (SQRT_2 * pitch)).round();
        let diagonal = length / diagonals;
        let across = (width / diagonal).round().max(1.0);
        Ok((diagonal / SQRT_2, across * diagonal))
    }
}

impl BiasBent {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self, test: &BiasBend) -> Reading {
        let [warp, weft, bias] = self.with;
        let mean = 0.5 * (warp + weft);
        Reading {
            instrument: "bias-bend",
            histogram: Vec::new(),
            figures: figures([
                ("twist_gf_cm", test.twist),
                ("bending_warp_gf_cm", warp),
                ("bending_weft_gf_cm", weft),
                ("bending_bias_gf_cm", bias),
                ("bending_bias_without_twist_gf_cm", self.without),
                ("bias_over_mean", bias / mean),
                ("bias_over_mean_without_twist", self.without / mean),
                (
                    "bias_over_mean_of_cylinder",
                    0.5 + test.twist / (4.0 * mean),
                ),
            ]),
            trace: None,
            certified: self.certified,
            rest: Some(self.rest),
        }
    }
}
