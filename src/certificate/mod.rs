//! The proof that a shape is at rest (design §6), recomputed from the final positions alone.

use crate::math::Vec3;

/// How far from rest a shape is. "Converged" means that all of it holds at the tolerance.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// Greatest net force of a node, after the best contact force inside its friction cone is
    /// taken off, over its weight plus the sum of the magnitudes of the forces on it [-].
    pub residual_max: f64,
    /// Root mean square of the same [-].
    pub residual_rms: f64,
    /// Where the greatest residual is [cm].
    pub worst_node: Vec3,
    /// Estimate of how far the farthest node still is from rest [cm].
    pub remaining_move: f64,
    /// Nodes touching a body.
    pub touching: usize,
    /// Nodes that a body would have to pull.
    pub pulled: usize,
    /// Nodes whose reaction would leave the Coulomb cone.
    pub outside_cone: usize,
    /// Deepest point of the cloth inside a body, 16 samples a cell [cm].
    pub deepest: f64,
}

/// Figures of a drape that people compare.
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
