//! A fabric with what each of its numbers rests on.

use super::{BendingFit, Doubt, Estimate, Fate, PowerFit, ShearFit};
use crate::fabric::{Direction, Fabric, InvalidFabric, Quantity, Tension, Yarn};

/// What a value rests on.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis {
    /// Readings used.
    pub used: usize,
    /// All readings.
    pub of: usize,
    /// Least and greatest reading used.
    pub range: [f64; 2],
    /// Unit of the range.
    pub unit: &'static str,
    /// How far the readings lie from what was fitted, root mean square, relative [-].
    pub residual: f64,
}

/// A value and where it is from.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The value, in the unit of its [`Quantity`].
    pub estimate: Estimate,
    /// File, relation or sheet, in words.
    pub how: String,
    /// What it rests on; absent for a value that a sheet gives.
    pub basis: Option<Basis>,
}

/// A measured S–S curve and the law found in it.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredCurve {
    /// Strain [-], slack taken off, and tension [gf/cm], in the order of their reading.
    pub points: Vec<[f64; 2]>,
    /// What became of each.
    pub fates: Vec<Fate>,
    /// Least and greatest strain used [-].
    pub strains: [f64; 2],
}

/// What was found along one thread direction.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredDirection {
    /// Along which.
    pub yarn: Yarn,
    /// Factor A of (1) [gf/cm].
    pub a: Finding,
    /// Exponent B of (1) [-].
    pub b: Finding,
    /// M_BN of (2) [gf·cm].
    pub bending: Finding,
    /// M_SH of (3) [gf/cm], per radian.
    pub shear: Finding,
    /// What is doubtful.
    pub doubts: Vec<Doubt>,
    /// The S–S curve, where one was measured.
    pub curve: Option<MeasuredCurve>,
}

/// What was found of a cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Its numbers, to six digits.
    pub fabric: Fabric,
    /// The file that was read.
    pub sheet: String,
    /// Along the warp.
    pub warp: MeasuredDirection,
    /// Along the weft.
    pub weft: MeasuredDirection,
    /// What is doubtful about the cloth as a whole.
    pub doubts: Vec<Doubt>,
}

impl Finding {
    /// A value as a sheet gives it.
    #[must_use]
    pub fn given(value: f64, how: impl Into<String>) -> Self {
        Self {
            estimate: Estimate::given(value),
            how: how.into(),
            basis: None,
        }
    }
}

impl PowerFit {
    /// A and B, found in a record of that name.
    #[must_use]
    pub fn findings(&self, record: &str) -> [Finding; 2] {
        let basis = Basis {
            used: self
                .fates
                .iter()
                .filter(|fate| **fate == Fate::Used)
                .count(),
            of: self.fates.len(),
            range: self.strains.map(|strain| 100.0 * strain),
            unit: "% strain",
            residual: self.residual,
        };
        [self.a, self.b].map(|estimate| Finding {
            estimate,
            how: format!("(1) by robust least squares of relative errors, {record}"),
            basis: Some(basis.clone()),
        })
    }
}

impl BendingFit {
    /// M_BN, found by a relation of that name.
    #[must_use]
    pub fn finding(&self, relation: &str) -> Finding {
        Finding {
            estimate: self.bending,
            how: format!("overhangs, {relation}"),
            basis: Some(Basis {
                used: self.readings,
                of: self.readings,
                range: self.lengths,
                unit: "cm overhang",
                residual: self.spread,
            }),
        }
    }
}

impl ShearFit {
    /// M_SH, found in a record of that name between two angles [rad].
    #[must_use]
    pub fn finding(&self, record: &str, angles: [f64; 2]) -> Finding {
        let hysteresis = match self.hysteresis {
            Some(width) => format!(", 2HG {width:.3} gf/cm"),
            None => String::new(),
        };
        Finding {
            estimate: self.shear,
            how: format!("(3) and (4), {record}{hysteresis}"),
            basis: Some(Basis {
                used: self.used,
                of: self.of,
                range: angles.map(f64::to_degrees),
                unit: "degrees",
                residual: self.residual,
            }),
        }
    }
}

impl MeasuredDirection {
    /// Each value with its quantity.
    #[must_use]
    pub fn findings(&self) -> [(Quantity, &Finding); 4] {
        [
            (Quantity::PowerFactor(self.yarn), &self.a),
            (Quantity::PowerExponent(self.yarn), &self.b),
            (Quantity::Bending(self.yarn), &self.bending),
            (Quantity::Shear(self.yarn), &self.shear),
        ]
    }

    /// Its numbers, to six digits.
    #[must_use]
    pub fn direction(&self) -> Direction {
        Direction {
            tension: Tension::Power {
                a: six_digits(self.a.estimate.value),
                b: six_digits(self.b.estimate.value),
            },
            bending: six_digits(self.bending.estimate.value),
            shear: six_digits(self.shear.estimate.value),
        }
    }
}

impl Measured {
    /// A cloth, its weight and thickness to six digits too, and what its numbers rest on.
    ///
    /// # Errors
    /// [`InvalidFabric`] where a value that was found is none that a cloth can have.
    pub fn new(
        cloth: Fabric,
        sheet: String,
        [warp, weft]: [MeasuredDirection; 2],
        mut doubts: Vec<Doubt>,
    ) -> Result<Self, InvalidFabric> {
        let fabric = Fabric {
            weight: six_digits(cloth.weight),
            thickness: six_digits(cloth.thickness),
            ..cloth
        }
        .checked()?;
        let density = fabric.weight / fabric.thickness;
        // Open felts and lofty knits have some 0.05, glass cloth 1.6.
        if !(0.05..=1.6).contains(&density) {
            doubts.push(Doubt::Density { density });
        }
        Ok(Self {
            fabric,
            sheet,
            warp,
            weft,
            doubts,
        })
    }

    /// All that is doubtful, with the direction that it belongs to.
    pub fn all_doubts(&self) -> impl Iterator<Item = (Option<Yarn>, &Doubt)> {
        let along = |one: &MeasuredDirection| Some(one.yarn);
        let warp = self
            .warp
            .doubts
            .iter()
            .map(move |doubt| (along(&self.warp), doubt));
        let weft = self
            .weft
            .doubts
            .iter()
            .map(move |doubt| (along(&self.weft), doubt));
        self.doubts
            .iter()
            .map(|doubt| (None, doubt))
            .chain(warp)
            .chain(weft)
    }
}

/// The decimal number of six digits next to a value: more than a laboratory can measure.
fn six_digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
