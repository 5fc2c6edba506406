//! The laws gathered over a lattice: a node's own pull for the sweeps, and whole-cloth sums.

use super::{
    RodLaw, Stencil,
    angle::{turn, turn_stiffness, turn_stiffness_positive},
    elements::{SheetAngle, SheetClamp, SheetRod, SheetTwist},
    roles::{Role, Roles},
    twist::{twist, twist_stiffness, twist_stiffness_positive},
};
use crate::{
    fabric::{Fabric, Yarn},
    lattice::Lattice,
    math::{Mat3, Vec3},
    threads,
};

/// Which laws act; weight always does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Laws {
    /// Rods pull (5).
    pub tension: bool,
    /// Opposite rods bend (6), and cells resist twist where the fabric does.
    pub bending: bool,
    /// Corners shear (7).
    pub shear: bool,
}

impl Default for Laws {
    fn default() -> Self {
        Self {
            tension: true,
            bending: true,
            shear: true,
        }
    }
}

/// A joint at a vice: the held slope on one side, a rod on the other, a half cell apart, so that
/// its bending is doubled (`physics.md` §3: without that the error is first order).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clamp {
    /// The held node and its free neighbour.
    pub nodes: [u32; 2],
    /// The direction from the held node that the vice keeps, of length 1.
    pub slope: Vec3,
    /// Yarn of the rod.
    pub yarn: Yarn,
    /// Length of the rod at rest [cm].
    pub length: f64,
    /// Width of cloth that it stands for [cm].
    pub width: f64,
}

/// The force on a node [gf] and minus its derivative by the node's position [gf/cm].
#[derive(Clone, Copy, Debug)]
pub struct Pull {
    /// The force.
    pub force: Vec3,
    /// The stiffness against moving this node alone, positive semi-definite.
    pub stiffness: Mat3,
}

/// Cloth without weight is taken for one whose bending length is ten pitches.
const WEIGHTLESS: f64 = 1e-3;

/// A lattice of one fabric under the laws that act.
#[derive(Clone, Debug)]
pub struct Sheet<'a> {
    fabric: &'a Fabric,
    rods: Vec<SheetRod>,
    angles: Vec<SheetAngle>,
    twists: Vec<SheetTwist>,
    clamps: Vec<SheetClamp>,
    weights: Vec<f64>,
    /// What forces on each node are measured by [gf].
    measures: Vec<f64>,
    roles: Roles,
}

impl<'a> Sheet<'a> {
    /// Gives a lattice the laws of a fabric.
    #[must_use]
    pub fn new(lattice: &Lattice, fabric: &'a Fabric, laws: Laws, clamps: &[Clamp]) -> Self {
        let rods = lattice.rods.iter().filter(|_| laws.tension);
        let rods: Vec<SheetRod> = rods.map(|rod| SheetRod::new(rod, fabric)).collect();
        let bends = lattice.bends.iter().filter(|_| laws.bending);
        let corners = lattice.corners.iter().filter(|_| laws.shear);
        let angles: Vec<SheetAngle> = bends
            .map(|bend| SheetAngle::of_bend(bend, fabric))
            .chain(corners.map(|corner| SheetAngle::of_corner(corner, fabric)))
            .filter(|angle| angle.stiffness > 0.0)
            .collect();
        let twists = lattice.twists.iter().filter(|_| laws.bending);
        let twists: Vec<SheetTwist> = twists
            .map(|twist| SheetTwist::new(twist, fabric))
            .filter(|twist| twist.stiffness > 0.0)
            .collect();
        let clamps = clamps.iter().filter(|_| laws.bending);
        let clamps: Vec<SheetClamp> = clamps.map(|clamp| SheetClamp::new(clamp, fabric)).collect();
        let areas = lattice.area.iter();
        let measure = if fabric.weight > 0.0 {
            fabric.weight
        } else {
            let bending = fabric.warp.bending.max(fabric.weft.bending);
            WEIGHTLESS * bending / (lattice.pitch * lattice.pitch * lattice.pitch)
        };
        Self {
            fabric,
            measures: areas.clone().map(|area| area * measure).collect(),
            weights: areas.map(|area| area * fabric.weight).collect(),
            roles: Roles::new(lattice.area.len(), &rods, &angles, &twists, &clamps),
            rods,
            angles,
            twists,
            clamps,
        }
    }

    /// Weight of each node [gf].
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// What forces on each node are measured by [gf]: its weight or, of cloth without, a part of the
    /// couple that bends it over a pitch.
    pub(crate) fn measures(&self) -> &[f64] {
        &self.measures
    }

    /// How many nodes there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.weights.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.weights.is_empty()
    }

    /// Every pair of nodes that a law joins, each once, in a fixed order.
    #[must_use]
    pub fn joined(&self) -> Vec<[u32; 2]> {
        let rods = self.rods.iter().map(|rod| rod.nodes);
        let angles = self.angles.iter().flat_map(|angle| {
            let [a, b, c] = angle.nodes;
            [[a, b], [b, c], [a, c]]
        });
        let twists = self.twists.iter().flat_map(|twist| {
            let [a, b, c, d] = twist.nodes;
            [[a, b], [b, c], [c, d], [d, a], [a, c], [b, d]]
        });
        let clamps = self.clamps.iter().map(|clamp| clamp.nodes);
        let mut pairs: Vec<[u32; 2]> = rods
            .chain(angles)
            .chain(twists)
            .chain(clamps)
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }

    /// Energy of cloth and weight [gf·cm].
    #[must_use]
    pub fn energy(&self, at: &[Vec3]) -> f64 {
        let rods = threads::sum(self.rods.len(), |k| {
            let rod = &self.rods[k];
            self.law(rod).energy(&rod.along(at))
        });
        let angles = threads::sum(self.angles.len(), |k| {
            let angle = &self.angles[k];
            let (u, v) = angle.rods(at);
            turn(&u, &v, angle.stiffness, angle.rest).energy
        });
        let twists = threads::sum(self.twists.len(), |k| {
            let element = &self.twists[k];
            twist(&element.corners(at), element.stiffness).energy
        });
        let clamps = threads::sum(self.clamps.len(), |k| {
            let clamp = &self.clamps[k];
            turn(&clamp.slope, &clamp.along(at), clamp.stiffness, 0.0).energy
        });
        let weights = threads::sum(at.len(), |node| self.weights[node] * at[node].z);
        rods + angles + twists + clamps + weights
    }

    /// The force on every node [gf].
    #[must_use]
    pub fn forces(&self, at: &[Vec3]) -> Vec<Vec3> {
        let mut forces: Vec<Vec3> = self
            .weights
            .iter()
            .map(|weight| Vec3::new(0.0, 0.0, -weight))
            .collect();
        let pulls = threads::map(self.rods.len(), |k| {
            let rod = &self.rods[k];
            self.law(rod).pull(&rod.along(at))
        });
        for (rod, pull) in self.rods.iter().zip(pulls) {
            forces[rod.nodes[0] as usize] += pull;
            forces[rod.nodes[1] as usize] -= pull;
        }
        let slopes = threads::map(self.angles.len(), |k| {
            let angle = &self.angles[k];
            let (u, v) = angle.rods(at);
            let law = turn(&u, &v, angle.stiffness, angle.rest);
            angle.spread(&law.by_u, &law.by_v)
        });
        for (angle, slopes) in self.angles.iter().zip(slopes) {
            for (node, slope) in angle.nodes.iter().zip(slopes) {
                forces[*node as usize] -= slope;
            }
        }
        let slopes = threads::map(self.twists.len(), |k| {
            let element = &self.twists[k];
            twist(&element.corners(at), element.stiffness).slopes
        });
        for (element, slopes) in self.twists.iter().zip(slopes) {
            for (node, slope) in element.nodes.iter().zip(slopes) {
                forces[*node as usize] -= slope;
            }
        }
        for clamp in &self.clamps {
            let law = turn(&clamp.slope, &clamp.along(at), clamp.stiffness, 0.0);
            forces[clamp.nodes[0] as usize] += law.by_v;
            forces[clamp.nodes[1] as usize] -= law.by_v;
        }
        forces
    }

    /// Hands every block of the second derivative of the energy [gf/cm] to `add(row, column, block)`:
    /// diagonal blocks, and each pair of an element's nodes once. With `positive`, every element's
    /// negative directions are left out.
    pub fn stiffness(&self, at: &[Vec3], positive: bool, add: &mut dyn FnMut(u32, u32, &Mat3)) {
        let rod = |k: usize| {
            let rod = &self.rods[k];
            self.law(rod).stiffness(&rod.along(at), positive)
        };
        threads::in_turn(self.rods.len(), rod, |k, block| {
            let [a, b] = self.rods[k].nodes;
            add(a, a, &block);
            add(b, b, &block);
            add(a, b, &-block);
        });
        let blocks_of = if positive {
            turn_stiffness_positive
        } else {
            turn_stiffness
        };
        let angle = |k: usize| {
            let angle = &self.angles[k];
            let (u, v) = angle.rods(at);
            blocks_of(&u, &v, angle.stiffness, angle.rest)
        };
        threads::in_turn(self.angles.len(), angle, |k, blocks| {
            self.angles[k].spread_stiffness(&blocks, add);
        });
        self.twist_blocks(at, positive, add);
        for clamp in &self.clamps {
            let block = blocks_of(&clamp.slope, &clamp.along(at), clamp.stiffness, 0.0).vv;
            let [held, next] = clamp.nodes;
            add(held, held, &block);
            add(next, next, &block);
            add(held, next, &-block);
        }
    }

    /// The twists' part of the stiffness.
    fn twist_blocks(&self, at: &[Vec3], positive: bool, add: &mut dyn FnMut(u32, u32, &Mat3)) {
        let blocks_of = if positive {
            twist_stiffness_positive
        } else {
            twist_stiffness
        };
        let blocks = threads::map(self.twists.len(), |k| {
            let element = &self.twists[k];
            blocks_of(&element.corners(at), element.stiffness)
        });
        for (element, blocks) in self.twists.iter().zip(blocks) {
            for (k, &row) in element.nodes.iter().enumerate() {
                for (l, &column) in element.nodes.iter().enumerate().skip(k) {
                    add(row, column, &blocks[k][l]);
                }
            }
        }
    }

    /// What acts on a node, by grid places of all nodes.
    pub(crate) fn stencil(&self, node: usize, grid: &[[i32; 2]]) -> Stencil {
        let mut stencil = Stencil::of_weight(self.weights[node]);
        let way = |to: u32| {
            let ([a, b], [c, d]) = (grid[node], grid[to as usize]);
            [c - a, d - b]
        };
        for role in self.roles.of(node) {
            match *role {
                Role::Rod(index, end) => {
                    let rod = &self.rods[index as usize];
                    let other = rod.nodes[1 - usize::from(end)];
                    stencil.add_rod(way(other), rod.rest, rod.width, rod.floor);
                }
                Role::Angle(index, _) => {
                    let angle = &self.angles[index as usize];
                    angle.add_to(&mut stencil, angle.nodes.map(way));
                }
                Role::Twist(index, place) => {
                    let element = &self.twists[index as usize];
                    let across = element.nodes[(usize::from(place) + 2) % 4];
                    stencil.add_twist(way(across), element.stiffness);
                }
                // A vice is not a matter of the grid.
                Role::Clamp(_) => (),
            }
        }
        stencil
    }

    /// The vices' part of the force on a node [gf] and of its own stiffness [gf/cm]; `None` where
    /// there is none.
    #[inline]
    pub(crate) fn vice(&self, node: usize, at: &[Vec3]) -> Option<Pull> {
        let mut pull: Option<Pull> = None;
        // They stand last in a node's list.
        for role in self.roles.of(node).iter().rev() {
            let Role::Clamp(index) = *role else { break };
            let sum = pull.get_or_insert(Pull {
                force: Vec3::zeros(),
                stiffness: Mat3::zeros(),
            });
            let clamp = &self.clamps[index as usize];
            let along = clamp.along(at);
            sum.force -= turn(&clamp.slope, &along, clamp.stiffness, 0.0).by_v;
            sum.stiffness += turn_stiffness_positive(&clamp.slope, &along, clamp.stiffness, 0.0).vv;
        }
        pull
    }

    /// The fabric.
    pub(crate) fn fabric(&self) -> &'a Fabric {
        self.fabric
    }

    /// The force on one node and its own stiffness: the terms of (8).
    #[must_use]
    pub fn pull(&self, node: usize, at: &[Vec3]) -> Pull {
        let mut force = Vec3::new(0.0, 0.0, -self.weights[node]);
        let mut stiffness = Mat3::zeros();
        for role in self.roles.of(node) {
            match *role {
                Role::Rod(index, end) => {
                    let rod = &self.rods[index as usize];
                    let (law, along) = (self.law(rod), rod.along(at));
                    force += law.pull(&along) * if end == 0 { 1.0 } else { -1.0 };
                    stiffness += law.stiffness(&along, true);
                }
                Role::Angle(index, place) => {
                    let angle = &self.angles[index as usize];
                    let (u, v) = angle.rods(at);
                    let law = turn(&u, &v, angle.stiffness, angle.rest);
                    let blocks = turn_stiffness_positive(&u, &v, angle.stiffness, angle.rest);
                    let (by_u, by_v) = angle.signs()[place as usize];
                    force -= law.by_u * by_u + law.by_v * by_v;
                    stiffness += blocks.uu * (by_u * by_u)
                        + (blocks.uv + blocks.uv.transpose()) * (by_u * by_v)
                        + blocks.vv * (by_v * by_v);
                }
                Role::Twist(index, place) => {
                    let (element, place) = (&self.twists[index as usize], usize::from(place));
                    let corners = element.corners(at);
                    force -= twist(&corners, element.stiffness).slopes[place];
                    stiffness +=
                        twist_stiffness_positive(&corners, element.stiffness)[place][place];
                }
                Role::Clamp(index) => {
                    let clamp = &self.clamps[index as usize];
                    let along = clamp.along(at);
                    force -= turn(&clamp.slope, &along, clamp.stiffness, 0.0).by_v;
                    stiffness +=
                        turn_stiffness_positive(&clamp.slope, &along, clamp.stiffness, 0.0).vv;
                }
            }
        }
        Pull { force, stiffness }
    }

    /// The force on one node [gf]; with `own_only`, without the reactions of its neighbours' bends
    /// and corners, and without twist.
    #[must_use]
    pub fn force(&self, node: usize, at: &[Vec3], own_only: bool) -> Vec3 {
        self.force_with(node, &at[node], at, own_only)
    }

    /// The same with the node at `here` and all others where they are [gf].
    #[must_use]
    pub fn force_with(&self, node: usize, here: &Vec3, at: &[Vec3], own_only: bool) -> Vec3 {
        let get = |other: u32| {
            let other = other as usize;
            if other == node { *here } else { at[other] }
        };
        let mut force = Vec3::new(0.0, 0.0, -self.weights[node]);
        for role in self.roles.of(node) {
            match *role {
                Role::Rod(index, end) => {
                    let rod = &self.rods[index as usize];
                    let pull = self.law(rod).pull(&rod.along_by(&get));
                    force += pull * if end == 0 { 1.0 } else { -1.0 };
                }
                Role::Angle(index, place) => {
                    let angle = &self.angles[index as usize];
                    if own_only && angle.own_place() != place {
                        continue;
                    }
                    let (u, v) = angle.rods_by(&get);
                    let law = turn(&u, &v, angle.stiffness, angle.rest);
                    let (by_u, by_v) = angle.signs()[place as usize];
                    force -= law.by_u * by_u + law.by_v * by_v;
                }
                Role::Twist(index, place) => {
                    if own_only {
                        continue;
                    }
                    let element = &self.twists[index as usize];
                    let law = twist(&element.nodes.map(get), element.stiffness);
                    force -= law.slopes[usize::from(place)];
                }
                Role::Clamp(index) => {
                    let clamp = &self.clamps[index as usize];
                    let along = get(clamp.nodes[1]) - get(clamp.nodes[0]);
                    force -= turn(&clamp.slope, &along, clamp.stiffness, 0.0).by_v;
                }
            }
        }
        force
    }

    fn law(&self, rod: &SheetRod) -> RodLaw<'a> {
        let tension = &self.fabric.along(rod.yarn).tension;
        RodLaw {
            tension,
            rest: rod.rest,
            width: rod.width,
            floor: rod.floor,
        }
    }
}
