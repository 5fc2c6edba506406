//! Figures of a drape that people compare.

use super::Case;
use crate::{
    fabric::Yarn,
    forces::{Sheet, angle_between},
    math::Vec3,
};

/// Figures of a drape.
#[derive(Clone, Debug, PartialEq)]
pub struct DrapeShape {
    /// Lowest point [cm].
    pub lowest: f64,
    /// Highest point [cm].
    pub highest: f64,
    /// Mean height, by area [cm].
    pub mean_height: f64,
    /// Energy of cloth and weight [gf·cm].
    pub energy: f64,
    /// Greatest strain of a warp rod [-].
    pub strain_warp_max: f64,
    /// Greatest strain of a weft rod [-].
    pub strain_weft_max: f64,
    /// Greatest shear angle [rad].
    pub shear_max: f64,
}

/// Measures a shape.
#[must_use]
pub fn drape_shape(case: &Case<'_>, at: &[Vec3]) -> DrapeShape {
    let lattice = case.lattice;
    let heights = || at.iter().map(|position| position.z);
    let area: f64 = lattice.area.iter().sum();
    let moment: f64 = lattice
        .area
        .iter()
        .zip(heights())
        .map(|(area, height)| area * height)
        .sum();
    let strain_max = |yarn: Yarn| {
        let rods = lattice.rods.iter().filter(|rod| rod.yarn == yarn);
        rods.map(|rod| {
            let [a, b] = rod.nodes.map(|node| at[node as usize]);
            (b - a).norm() / rod.rest - 1.0
        })
        .fold(f64::NEG_INFINITY, f64::max)
    };
    let shear = lattice.corners.iter().map(|corner| {
        let [node, a, b] = corner.nodes.map(|node| at[node as usize]);
        (corner.rest_angle - angle_between(&(a - node), &(b - node))).abs()
    });
    DrapeShape {
        lowest: heights().fold(f64::INFINITY, f64::min),
        highest: heights().fold(f64::NEG_INFINITY, f64::max),
        mean_height: moment / area,
        energy: Sheet::new(lattice, case.fabric, case.laws, case.clamps).energy(at),
        strain_warp_max: strain_max(Yarn::Warp),
        strain_weft_max: strain_max(Yarn::Weft),
        shear_max: shear.fold(0.0, f64::max),
    }
}
