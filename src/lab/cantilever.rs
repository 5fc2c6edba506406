//! The cantilever (paper A-ii, figure 2): a strip clamped level that bends under its own weight.

use super::{
    LabError, Reading, Rest, Trace, Watch, elastica,
    reading::{figures, within},
    specimen::{hold, strip},
};
use crate::{
    fabric::{Fabric, Yarn, bending_from_overhang},
    lattice::Edge,
    math::Vec3,
};

/// Slope of the instrument's inclined plane, from the edge of the table to the strip's tip [°].
pub const SLOPE: f64 = 41.5;

/// A strip, two cells wide, whose root is clamped level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cantilever {
    /// Which way its length runs.
    pub yarn: Yarn,
    /// Free length [cm].
    pub overhang: f64,
    /// Pitch of its lattice [cm].
    pub pitch: f64,
}

/// A bent strip.
#[derive(Clone, Debug)]
pub struct Bent {
    /// How far the tip is below the root [cm].
    pub tip_drop: f64,
    /// How far the tip is from the root, level [cm].
    pub tip_reach: f64,
    /// The strip.
    pub rest: Rest,
}

/// The overhang at which the tip meets the instrument's slope.
#[derive(Clone, Debug)]
pub struct Overhang {
    /// The length L [cm].
    pub length: f64,
    /// M_BN that (2) makes of it [gf·cm].
    pub bending: f64,
    /// The strip of that length.
    pub bent: Bent,
}

impl Cantilever {
    /// Bends the strip.
    ///
    /// # Errors
    /// [`LabError`] where the strip cannot be cut.
    pub fn run(&self, fabric: &Fabric, watch: Watch<'_>) -> Result<Bent, LabError> {
        let length = within("overhang [cm]", self.overhang, 0.01, 1000.0)?;
        let pitch = within("pitch [cm]", self.pitch, length / 1000.0, length)?;
        let mut problem = strip(fabric, self.yarn.into(), [length, 2.0 * pitch], pitch)?;
        problem.holds = vec![hold(Edge::XMin, true, Vec3::zeros())];
        let rest = Rest::of(problem, watch)?;
        let tip = rest.middle(Edge::XMax);
        Ok(Bent {
            tip_drop: -tip.z,
            tip_reach: tip.x,
            rest,
        })
    }

    /// Looks for the overhang at which the tip meets the slope of 41.5°, with so many cells along
    /// it: by the secant, from where the heavy elastica meets it.
    ///
    /// # Errors
    /// [`LabError`] where a strip cannot be cut, or the fabric does not bend.
    pub fn overhang(
        fabric: &Fabric,
        yarn: Yarn,
        cells: u32,
        watch: Watch<'_>,
    ) -> Result<Overhang, LabError> {
        let cells = within("cells", f64::from(cells), 2.0, 1000.0)?;
        within("bending [gf·cm]", fabric.along(yarn).bending, 1e-9, 1e4)?;
        let usual = 2.0 * fabric.bending_length(yarn);
        let mut bend = |overhang: f64| {
            let pitch = overhang / cells;
            let bent = Self {
                yarn,
                overhang,
                pitch,
            }
            .run(fabric, watch)?;
            Ok::<_, LabError>((bent.below_slope(), bent))
        };
        let [mut before, mut length] = [0.97 * usual, usual];
        let (mut off_before, mut bent) = bend(before)?;
        for _ in 0..8 {
            let (off, now) = bend(length)?;
            bent = now;
            if off.abs() < 1e-4 || off == off_before {
                break;
            }
            let next = length - off * (length - before) / (off - off_before);
            (before, off_before) = (length, off);
            length = next.clamp(0.5 * length, 2.0 * length);
        }
        Ok(Overhang {
            length,
            bending: bending_from_overhang(fabric.weight, length),
            bent,
        })
    }
}

impl Bent {
    /// By how much the line from root to tip falls more steeply than the instrument's slope [°].
    fn below_slope(&self) -> f64 {
        libm::atan2(self.tip_drop, self.tip_reach).to_degrees() - SLOPE
    }

    /// What the instrument shows; the continuum's tip is by the extensible heavy elastica.
    #[must_use]
    pub fn reading(self, test: &Cantilever) -> Reading {
        let tip = elastica::Heavy::of(&self.rest.problem.fabric, test.yarn, test.overhang).tip();
        let line = self.rest.line();
        let line = line.iter().map(|at| [at.x, at.z]).collect();
        Reading {
            instrument: "cantilever",
            histogram: Vec::new(),
            figures: figures([
                ("overhang_cm", test.overhang),
                ("tip_drop_cm", self.tip_drop),
                ("tip_reach_cm", self.tip_reach),
                ("elastica_tip_drop_cm", -tip[1]),
                ("elastica_tip_reach_cm", tip[0]),
            ]),
            trace: Some(Trace {
                x: "from the root [cm]",
                y: "height [cm]",
                lines: vec![("simulated strip", line)],
            }),
            certified: self.rest.settled.converged,
            rest: Some(self.rest),
        }
    }
}

impl Overhang {
    /// What the instrument shows.
    #[must_use]
    pub fn reading(self, fabric: &Fabric, yarn: Yarn) -> Reading {
        let bending = fabric.along(yarn).bending;
        let rest = self.bent.rest;
        Reading {
            instrument: "cantilever",
            histogram: Vec::new(),
            figures: figures([
                ("overhang_cm", self.length),
                ("slope_deg", SLOPE),
                ("bending_gf_cm", self.bending),
                (
                    "from_fabric_percent",
                    100.0 * (self.bending / bending - 1.0),
                ),
            ]),
            trace: None,
            certified: rest.settled.converged,
            rest: Some(rest),
        }
    }
}
