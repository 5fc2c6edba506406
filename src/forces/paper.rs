//! Figures 7–9 to the letter: a node feels its own 4 tensions, 2 bends and 4 shears, no more, and
//! the Jacobian of (8) is found by numbers. It is there for comparison with the paper; because
//! action lacks its reaction, no energy belongs to it.

use super::{Sheet, sheet::Pull};
use crate::math::{Mat3, Vec3};

/// Step of the numerical derivative [cm].
const STEP: f64 = 1e-6;

/// The ten forces and gravity on a node [gf], and minus their numerical derivative [gf/cm].
#[must_use]
pub fn paper_forces(sheet: &Sheet<'_>, node: usize, at: &[Vec3]) -> Pull {
    let here = at[node];
    let mut stiffness = Mat3::zeros();
    for axis in 0..3 {
        let mut step = Vec3::zeros();
        step[axis] = STEP;
        let ahead = sheet.force_with(node, &(here + step), at, true);
        let behind = sheet.force_with(node, &(here - step), at, true);
        stiffness.set_column(axis, &((behind - ahead) / (2.0 * STEP)));
    }
    Pull {
        force: sheet.force(node, at, true),
        stiffness,
    }
}
