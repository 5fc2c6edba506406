//! What each node bears, element by element from the positions alone, by statics instead of by
//! derivatives: tensions along rods, couples that rods carry as pairs of forces.

use crate::{
    fabric::{Direction, Fabric, Yarn},
    forces::{Clamp, Laws},
    lattice::Lattice,
    math::Vec3,
};

/// The forces of cloth and weight on a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Load {
    /// Their sum [gf].
    pub(super) net: Vec3,
    /// The sum of their magnitudes, weight included [gf].
    pub(super) sum: f64,
}

/// Everything that acts, one after the other.
pub(super) struct Loads<'a> {
    pub(super) lattice: &'a Lattice,
    pub(super) fabric: &'a Fabric,
    pub(super) laws: Laws,
    pub(super) clamps: &'a [Clamp],
    /// Figures 7–9: bends and corners act on their own node only.
    pub(super) own_only: bool,
}

impl Loads<'_> {
    /// The load on every node.
    pub(super) fn at(&self, at: &[Vec3]) -> Vec<Load> {
        let mut loads: Vec<Load> = self
            .lattice
            .area
            .iter()
            .map(|area| area * self.fabric.weight)
            .map(|weight| Load {
                net: Vec3::new(0.0, 0.0, -weight),
                sum: weight,
            })
            .collect();
        if self.laws.tension {
            self.add_tensions(at, &mut loads);
        }
        if self.laws.bending {
            self.add_bends(at, &mut loads);
            self.add_clamps(at, &mut loads);
        }
        if self.laws.shear {
            self.add_corners(at, &mut loads);
        }
        loads
    }

    fn direction(&self, yarn: Yarn) -> &Direction {
        match yarn {
            Yarn::Warp => &self.fabric.warp,
            Yarn::Weft => &self.fabric.weft,
        }
    }

    /// (5).
    fn add_tensions(&self, at: &[Vec3], loads: &mut [Load]) {
        for rod in &self.lattice.rods {
            let direction = self.direction(rod.yarn);
            let [a, b] = rod.nodes.map(|node| node as usize);
            let along = at[b] - at[a];
            let length = along.norm();
            let pi = core::f64::consts::PI;
            let euler = pi * pi * direction.bending / (rod.rest * rod.rest);
            let tension = direction.tension.tension(length / rod.rest - 1.0, euler);
            let pull = along * (rod.width * tension / length.max(1e-12));
            loads[a].add(pull);
            loads[b].add(-pull);
        }
    }

    /// (6): a joint of three nodes carries the couple M_BN·w·θ/b.
    fn add_bends(&self, at: &[Vec3], loads: &mut [Load]) {
        for bend in &self.lattice.bends {
            let [a, b, c] = bend.nodes.map(|node| node as usize);
            let stiffness = self.direction(bend.yarn).bending * bend.width / bend.length;
            let (first, second) = couple(
                &(at[b] - at[a]),
                &(at[c] - at[b]),
                stiffness,
                bend.rest_angle,
            );
            if !self.own_only {
                loads[a].add(-first);
                loads[c].add(second);
            }
            loads[b].add(first - second);
        }
    }

    /// A vice bends the rod beside it over half a cell.
    fn add_clamps(&self, at: &[Vec3], loads: &mut [Load]) {
        for clamp in self.clamps {
            let [held, next] = clamp.nodes.map(|node| node as usize);
            let stiffness = 2.0 * self.direction(clamp.yarn).bending * clamp.width / clamp.length;
            let (_, second) = couple(&clamp.slope, &(at[next] - at[held]), stiffness, 0.0);
            loads[next].add(second);
            loads[held].add(-second);
        }
    }

    /// (7): a corner carries the couple M_SH·area·(φ₀ − φ).
    fn add_corners(&self, at: &[Vec3], loads: &mut [Load]) {
        let shear = 0.5 * (self.fabric.warp.shear + self.fabric.weft.shear);
        for corner in &self.lattice.corners {
            let [node, a, b] = corner.nodes.map(|node| node as usize);
            let stiffness = shear * corner.area;
            let (first, second) = couple(
                &(at[a] - at[node]),
                &(at[b] - at[node]),
                stiffness,
                corner.rest_angle,
            );
            if !self.own_only {
                loads[a].add(first);
                loads[b].add(second);
            }
            loads[node].add(-first - second);
        }
    }
}

impl Load {
    fn add(&mut self, force: Vec3) {
        self.net += force;
        self.sum += force.norm();
    }
}

/// The forces on the ends of two rods u and v that a couple k·(θ − θ₀) between them turns towards
/// each other: at a right angle to each rod, in their plane, couple over length.
fn couple(u: &Vec3, v: &Vec3, stiffness: f64, rest: f64) -> (Vec3, Vec3) {
    let (length_u, length_v) = (u.norm(), v.norm());
    let normal = u.cross(v);
    let size = normal.norm();
    if size <= 1e-15 * length_u * length_v {
        return (Vec3::zeros(), Vec3::zeros());
    }
    let axis = normal / size;
    let excess = libm::atan2(size, u.dot(v)) - rest;
    let couple = stiffness * excess;
    (
        axis.cross(u) * (couple / (length_u * length_u)),
        -axis.cross(v) * (couple / (length_v * length_v)),
    )
}
