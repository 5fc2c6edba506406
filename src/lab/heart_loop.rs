//! Peirce's heart loop (1930; ASTM D1388 option B): a strip whose two ends are clamped together,
//! both upwards, so that it hangs as a heart.
//!
//! With ℓ₀ = 0.1337·L the height of a loop without weight, and d = ℓ − ℓ₀ what its weight adds, the
//! bending length is `c = ℓ₀·(cos θ/tan θ)^(1/3)` at θ = 32.85°·d/ℓ₀.

use super::{
    LabError, Reading, Rest, Trace, Watch,
    reading::{figures, within},
    specimen::{hold, strip},
};
use crate::{
    fabric::{Fabric, Yarn},
    lattice::Edge,
    math::Vec3,
};
use std::f64::consts::PI;

/// Height of the loop without weight, over the strip's length.
const WEIGHTLESS: f64 = 0.1337;
/// θ where the weight doubles the height [°].
const DOUBLED: f64 = 32.85;
/// The strip turns by so much from clamp to clamp [rad].
const TURN: f64 = 3.0 * PI;

/// Bending lengths in a strip that hangs as a heart: a shorter one stands up from the clamp instead
/// (5 do, of cloths A to D; 6 hang, of all five), and in a longer one the loop's height hardly tells.
const HEARTS: [f64; 2] = [6.0, 25.0];

/// A strip, two cells wide, clamped as a heart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeartLoop {
    /// Which way its length runs.
    pub yarn: Yarn,
    /// Its length from clamp to clamp [cm].
    pub length: f64,
    /// Pitch of its lattice [cm].
    pub pitch: f64,
}

/// A heart that hangs.
#[derive(Clone, Debug)]
pub struct Heart {
    /// ℓ, from the clamp to the lowest point [cm].
    pub height: f64,
    /// Bending length by Peirce's relation [cm].
    pub bending_length: f64,
    /// M_BN = W·c³ [gf·cm].
    pub bending: f64,
    /// The strip.
    pub rest: Rest,
}

impl HeartLoop {
    /// A strip of ten bending lengths in 80 cells.
    #[must_use]
    pub fn of(fabric: &Fabric, yarn: Yarn) -> Self {
        let length = 10.0 * fabric.bending_length(yarn);
        let pitch = length / 80.0;
        Self {
            yarn,
            length,
            pitch,
        }
    }

    /// Hangs the loop.
    ///
    /// # Errors
    /// [`LabError`] where the strip cannot be cut, or is not as long as 6 to 25 bending lengths.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Heart, LabError> {
        within(
            "bending [gf·cm]",
            fabric.along(self.yarn).bending,
            1e-9,
            1e4,
        )?;
        let [least, most] = HEARTS.map(|times| times * fabric.bending_length(self.yarn));
        let length = within("length [cm]", self.length, least, most)?;
        let pitch = within("pitch [cm]", self.pitch, length / 1000.0, length / 20.0)?;
        let mut problem = strip(fabric, self.yarn.into(), [length, 2.0 * pitch], pitch)?;
        // Rolled up, the end of the strip stands before its start by a diameter.
        let curl = TURN / length;
        problem.placement.curl = curl;
        problem.placement.centre = Vec3::zeros();
        problem.holds = vec![
            hold(Edge::XMin, true, Vec3::x() / -curl),
            hold(Edge::XMax, true, Vec3::x() / curl),
        ];
        let rest = Rest::of(problem, watch)?;
        let height = rest.middle(Edge::XMin).z - rest.settled.shape.lowest;
        let bending_length = bending_length(length, height);
        Ok(Heart {
            height,
            bending_length,
            bending: fabric.weight * bending_length.powi(3),
            rest,
        })
    }
}

/// Peirce's relation [cm]; infinite for a loop no longer than without weight, 0 for one so long that
/// it does not bend.
fn bending_length(length: f64, height: f64) -> f64 {
    let weightless = WEIGHTLESS * length;
    let angle = (DOUBLED * (height - weightless) / weightless).to_radians();
    if angle <= 0.0 {
        return f64::INFINITY;
    }
    // Beyond a right angle cosine and tangent are both negative: the loop is longer than any.
    weightless * libm::cbrt(libm::cos(angle).max(0.0) / libm::tan(angle).abs())
}

impl Heart {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self) -> Reading {
        let line = self.rest.line();
        Reading {
            instrument: "heart-loop",
            histogram: Vec::new(),
            figures: figures([
                ("loop_height_cm", self.height),
                ("bending_length_cm", self.bending_length),
                ("bending_gf_cm", self.bending),
            ]),
            trace: Some(Trace {
                x: "across [cm]",
                y: "height [cm]",
                lines: vec![("loop", line.iter().map(|at| [at.x, at.z]).collect())],
            }),
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the weight doubles the height, c = ℓ₀·(cos 32.85°/tan 32.85°)^(1/3).
    #[test]
    fn peirces_relation_is_his() {
        let doubled = bending_length(10.0, 2.674);
        assert!((doubled / 1.337 - 1.0917).abs() < 1e-4, "{doubled}");
        assert_eq!(bending_length(10.0, 1.3), f64::INFINITY);
        assert_eq!(bending_length(10.0, 5.1), 0.0);
    }
}
