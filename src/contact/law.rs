//! The two laws of a touch. Both have an energy, so that a drape is a minimum.

use crate::math::{Mat3, Vec3};

/// The normal law: a force that grows e-fold with every `depth` [cm] into a thin skin on the body,
/// `N = scale·(e^(d/depth) − 1)` [gf]. A gentle touch and a heavy load both end within a few
/// depths, with nothing tuned to either.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Skin {
    /// Force at d = 0.69 depths [gf].
    pub scale: f64,
    /// Depth over which the force grows e-fold [cm].
    pub depth: f64,
}

/// Beyond this many depths the force goes on in a straight line, so that no start overflows.
const STRAIGHT_BEYOND: f64 = 9.0;

impl Skin {
    /// Energy [gf·cm], force [gf] and its derivative [gf/cm] at a depth d [cm] in the skin.
    #[must_use]
    pub fn answer(&self, d: f64) -> (f64, f64, f64) {
        if d <= 0.0 {
            return (0.0, 0.0, 0.0);
        }
        let over = d / self.depth;
        let inner = over.min(STRAIGHT_BEYOND);
        let growth = libm::exp(inner);
        let force = self.scale * (growth - 1.0);
        let slope = self.scale * growth / self.depth;
        let energy = self.scale * self.depth * (growth - 1.0 - inner);
        let beyond = d - inner * self.depth;
        (
            energy + beyond * (force + 0.5 * beyond * slope),
            force + beyond * slope,
            slope,
        )
    }
}

/// Coulomb friction about an anchor, `F = limit·min(|u|/give, 1)` against the slip u: a spring
/// while it sticks, the limit µ·N while it slides (return mapping). Its force never leaves the
/// cone, whatever the anchor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// The limit µ·N [gf], as of the last look at N.
    pub limit: f64,
    /// The slip at which sticking ends [cm].
    pub give: f64,
}

impl Friction {
    /// Energy [gf·cm] at a slip u [cm] in the tangent plane.
    #[must_use]
    pub fn energy(&self, slip: &Vec3) -> f64 {
        let size = slip.norm();
        if size <= self.give {
            0.5 * self.limit * size * size / self.give
        } else {
            self.limit * (size - 0.5 * self.give)
        }
    }

    /// Force on the cloth [gf].
    #[must_use]
    pub fn force(&self, slip: &Vec3) -> Vec3 {
        slip * (-self.limit / slip.norm().max(self.give))
    }

    /// Stiffness in the plane across `normal` [gf/cm], positive semi-definite.
    #[must_use]
    pub fn stiffness(&self, slip: &Vec3, normal: &Vec3) -> Mat3 {
        let plane = Mat3::identity() - normal * normal.transpose();
        let size = slip.norm();
        if size <= self.give {
            return plane * (self.limit / self.give);
        }
        let along = slip / size;
        (plane - along * along.transpose()) * (self.limit / size)
    }
}
