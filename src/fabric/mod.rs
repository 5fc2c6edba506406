//! A cloth's material, as a textile laboratory measures it.
//!
//! Everything is per width of cloth and in the paper's units (cm, gram-force); the laws that turn
//! these numbers into tensions are in [`Tension`]. [`Fabric::checked`] lets only values pass that a
//! cloth can have, and [`KesSheet`] converts what other laboratories write.

mod curve;
pub mod fit;
mod kes;
mod limits;
mod swatch;
mod tension;

pub use curve::{Curve, InvalidCurve};
pub use kes::{KesDirection, KesSheet, ShearTest, bending_from_overhang, shear_from_frame};
pub use limits::{InvalidFabric, Quantity};
pub use swatch::{SWATCHES, swatch};
pub use tension::{Answer, Tension};

use std::fmt;

/// One of the two thread directions of a woven cloth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Yarn {
    /// Along the loom.
    Warp,
    /// Across the loom.
    Weft,
}

impl fmt::Display for Yarn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Warp => "warp",
            Self::Weft => "weft",
        })
    }
}

/// What was measured along one thread direction.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// Tension per width against strain [gf/cm].
    pub tension: Tension,
    /// Bending moment per width and curvature, M_BN of (2) [gf·cm].
    pub bending: f64,
    /// Shear force per width and radian, M_SH of (3) [gf/cm].
    pub shear: f64,
}

/// Friction coefficients [-].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// Against a body.
    pub body: f64,
    /// Against cloth.
    pub cloth: f64,
}

/// A measured cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct Fabric {
    /// What it is called.
    pub name: String,
    /// Who measured it, and where that is written.
    pub source: String,
    /// Weight per area [gf/cm²].
    pub weight: f64,
    /// Thickness [cm].
    pub thickness: f64,
    /// Friction where a scene gives none.
    pub friction: Friction,
    /// Twisting moment per width and twist, M_TW [gf·cm]: bending's third component, beside those
    /// along warp and weft. A strip of width w has the torsional stiffness M_TW·w, and on the bias
    /// cloth bends by (M_BN warp + M_BN weft + M_TW)/4. The paper's lattice has none: 0. Ten
    /// measured cloths had 1.1 times their mean bending, on average (`physics.md` §0.5).
    pub twist: f64,
    /// Along the warp.
    pub warp: Direction,
    /// Along the weft.
    pub weft: Direction,
}

impl Fabric {
    /// What was measured along a yarn.
    #[must_use]
    pub fn along(&self, yarn: Yarn) -> &Direction {
        match yarn {
            Yarn::Warp => &self.warp,
            Yarn::Weft => &self.weft,
        }
    }

    /// Peirce's bending length along a yarn, c = (M_BN/W)^(1/3) [cm].
    #[must_use]
    pub fn bending_length(&self, yarn: Yarn) -> f64 {
        libm::cbrt(self.along(yarn).bending / self.weight)
    }
}
