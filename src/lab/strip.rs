//! The strip: hung from one edge, and pulled as in a tensile tester (paper A-i).

use super::{
    Cut, LabError, Reading, Rest, Trace, Watch,
    reading::{figures, within},
    specimen::{hold, strip, tared},
};
use crate::{
    fabric::{Fabric, Yarn},
    lattice::Edge,
    math::Vec3,
};

/// A strip that hangs from one edge under its own weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HungStrip {
    /// Which way its length runs.
    pub yarn: Yarn,
    /// Its length [cm].
    pub length: f64,
    /// Pitch of its lattice [cm].
    pub pitch: f64,
}

/// A strip that hangs.
#[derive(Clone, Debug)]
pub struct Hung {
    /// How much longer it is [cm].
    pub elongation: f64,
    /// What the continuum does, ΔL = L·(W·L/A)^n·(B+1)/(B+2) with n = 1/(B+1), by the strain at
    /// each height [cm].
    pub continuum: f64,
    /// The strip.
    pub rest: Rest,
}

/// Places along a strip at which the continuum's strain is summed.
const PLACES: u32 = 4000;

impl HungStrip {
    /// Hangs the strip.
    ///
    /// # Errors
    /// [`LabError`] where the strip cannot be cut.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Hung, LabError> {
        let length = within("length [cm]", self.length, 0.1, 1000.0)?;
        let pitch = within("pitch [cm]", self.pitch, length / 2000.0, length)?;
        let mut problem = strip(fabric, self.yarn.into(), [length, 2.0 * pitch], pitch)?;
        problem.holds = vec![hold(Edge::XMin, false, Vec3::zeros())];
        let rest = Rest::of(problem, watch)?;
        Ok(Hung {
            elongation: -rest.settled.shape.lowest - length,
            continuum: elongation(fabric, self.yarn, length),
            rest,
        })
    }
}

/// ∫ S ds along a strip that hangs, by the midpoint rule [cm].
fn elongation(fabric: &Fabric, yarn: Yarn, length: f64) -> f64 {
    let tension = &fabric.along(yarn).tension;
    let step = length / f64::from(PLACES);
    let below = |k: u32| length - (f64::from(k) + 0.5) * step;
    (0..PLACES)
        .map(|k| step * tension.strain_at(fabric.weight * below(k)))
        .sum()
}

impl Hung {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self) -> Reading {
        let of_continuum = 100.0 * (self.elongation / self.continuum - 1.0);
        Reading {
            instrument: "strip",
            histogram: Vec::new(),
            figures: figures([
                ("elongation_cm", self.elongation),
                ("continuum_elongation_cm", self.continuum),
                ("from_continuum_percent", of_continuum),
            ]),
            trace: None,
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}

/// A strip pulled by both ends: 2.5 × 5 cm in the paper's tester.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pull {
    /// Which way its length runs.
    pub cut: Cut,
    /// Length between the grips and width [cm].
    pub size: [f64; 2],
    /// Pitch of its lattice [cm].
    pub pitch: f64,
    /// Strain that it is pulled to [-].
    pub most: f64,
    /// In how many equal steps.
    pub steps: u32,
}

/// An S–S curve, and the strip at its end.
#[derive(Clone, Debug)]
pub struct Pulled {
    /// Strain [-] and force per width [gf/cm].
    pub curve: Vec<[f64; 2]>,
    /// Whether each shape is certified.
    pub certified: bool,
    /// The strip at the end.
    pub rest: Rest,
}

impl Default for Pull {
    fn default() -> Self {
        Self {
            cut: Cut::Warp,
            size: [5.0, 2.5],
            pitch: 0.5,
            most: 0.1,
            steps: 10,
        }
    }
}

impl Pull {
    /// Pulls the strip; its weight is taken off.
    ///
    /// # Errors
    /// [`LabError`] where the strip cannot be cut.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Pulled, LabError> {
        let [length, width] = self.size;
        within("length [cm]", length, 0.1, 1000.0)?;
        within("width [cm]", width, 0.1, 1000.0)?;
        let pitch = within("pitch [cm]", self.pitch, length.max(width) / 500.0, length)?;
        let most = within("strain [-]", self.most, 1e-6, 2.0)?;
        let steps = self.steps.clamp(1, 1000);
        let cloth = tared(fabric);
        let mut pull = |step: u32| {
            let strain = most * f64::from(step) / f64::from(steps);
            let mut problem = strip(&cloth, self.cut, self.size, pitch)?;
            let way = Vec3::x() * (strain * length);
            problem.holds = vec![
                hold(Edge::XMin, false, Vec3::zeros()),
                hold(Edge::XMax, false, way),
            ];
            Rest::of(problem, watch).map(|rest| (strain, rest))
        };
        let mut curve = vec![[0.0, 0.0]];
        let mut certified = true;
        let mut step = 1;
        let rest = loop {
            let (strain, pulled) = pull(step)?;
            curve.push([strain, pulled.pull(Edge::XMax).x / width]);
            certified &= pulled.settled.converged;
            if step == steps {
                break pulled;
            }
            step += 1;
        };
        Ok(Pulled {
            curve,
            certified,
            rest,
        })
    }
}

impl Pulled {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self) -> Reading {
        let [strain, tension] = self.curve.last().copied().unwrap_or_default();
        Reading {
            instrument: "strip",
            histogram: Vec::new(),
            figures: figures([("strain", strain), ("tension_gf_per_cm", tension)]),
            trace: Some(Trace {
                x: "strain [-]",
                y: "tension [gf/cm]",
                lines: vec![("simulated strip", self.curve)],
            }),
            rest: Some(self.rest),
            certified: self.certified,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a_hanging_strip of `reference.json`: ΔL = L·(W·L/A)^n·(B+1)/(B+2).
    #[test]
    fn strains_along_a_hung_strip_add_up_to_the_closed_form() {
        let cloth = crate::scene::fabric("a").unwrap();
        let sum = elongation(&cloth, Yarn::Warp, 20.0);
        assert!((sum / 0.107_642_532_204 - 1.0).abs() < 5e-6, "{sum}");
    }
}
