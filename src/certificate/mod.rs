//! The proof that a shape is at rest (design §6), recomputed from the final positions alone, or, of a
//! cloth in motion, from those and the positions and velocities before the last step: it shares no
//! sum, list or derivative with the solver.

mod loads;
mod reaction;
mod shape;

pub use shape::{DrapeShape, drape_shape};

use crate::{
    body::{Bodies, Near},
    contact::{Sites, Surface, corner_of, faces_around},
    fabric::Fabric,
    forces::{Clamp, Laws},
    lattice::Lattice,
    math::Vec3,
    threads,
};
use loads::{Load, Loads};

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
    /// Which equilibrium was proved, or was not.
    pub equilibrium: Equilibrium,
}

/// The two kinds of equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Equilibrium {
    /// Forces balance: the cloth stays where it is.
    Static,
    /// Forces balance with inertia and the air's resistance (d'Alembert): the cloth moves on. Friction
    /// is judged as at rest, to be inside its cone: that of a node that slips should lie on it and
    /// against the slip, which is not looked at.
    Dynamic {
        /// Greatest speed of a node [cm/s].
        fastest: f64,
        /// Kinetic energy of the whole [gf·cm].
        kinetic_energy: f64,
    },
}

/// Where a cloth in motion comes from: its last step of time, which its acceleration is found from.
#[derive(Clone, Copy, Debug)]
pub struct Passage<'a> {
    /// Positions before the step [cm], one per node.
    pub from: &'a [Vec3],
    /// Velocities before it [cm/s], one per node.
    pub velocities: &'a [Vec3],
    /// How long it took [s].
    pub step: f64,
    /// Rate at which motion through still air dies down [1/s].
    pub damping: f64,
}

/// What a shape is judged against.
#[derive(Clone, Copy, Debug)]
pub struct Case<'a> {
    /// The lattice.
    pub lattice: &'a Lattice,
    /// Its material.
    pub fabric: &'a Fabric,
    /// The laws that act.
    pub laws: Laws,
    /// Whether bends and corners act on their own node only (figures 7–9), and twist on none.
    pub own_only: bool,
    /// Vices.
    pub clamps: &'a [Clamp],
    /// Which nodes are held.
    pub held: &'a [bool],
    /// The bodies.
    pub bodies: &'a Bodies,
    /// Friction and standoff.
    pub surface: Surface,
    /// The last step of a cloth in motion; `None` of one at rest.
    pub passage: Option<Passage<'a>>,
}

/// Deeper than this [cm] no point of a certified cloth is inside a body.
pub const DEEPEST_ALLOWED: f64 = 0.05;
/// A certified cloth has no farther to go than this [cm].
pub const FARTHEST_ALLOWED: f64 = 0.05;
/// Between the places looked at, a surface may be nearer than at them by this [cm].
const BETWEEN: f64 = 0.01;
/// Normals that lean apart by more than this cosine (11°) show that an edge or a tip is near.
const ONE_FACE: f64 = 0.98;
/// Points along a side of a cell that is near one.
const FINE: usize = 17;
/// Samples this far beyond [cm] may have a place that touches near them.
const AROUND: f64 = 0.1;
/// Normals nearer than this to each other are one.
const SAME_NORMAL: f64 = 1.0 - 1e-9;

impl Certificate {
    /// Whether the shape is at rest at a tolerance on the residual.
    #[must_use]
    pub fn holds(&self, tolerance: f64) -> bool {
        self.residual_max <= tolerance
            && self.pulled == 0
            && self.outside_cone == 0
            && self.deepest <= DEEPEST_ALLOWED
            && self.remaining_move <= FARTHEST_ALLOWED
    }
}

/// Judges positions; `remaining_move` [cm] is the solver's estimate, from how its steps contract.
#[must_use]
pub fn certify(case: &Case<'_>, at: &[Vec3], tolerance: f64, remaining_move: f64) -> Certificate {
    let loads = case.loads().at(at);
    let touching = case.normals(at);
    let residuals = threads::map(at.len(), |node| {
        case.residual(node, &loads[node], &touching[node])
    });
    let worst = (0..at.len()).fold(0, |worst, node| {
        if residuals[node] > residuals[worst] {
            node
        } else {
            worst
        }
    });
    let squares: f64 = residuals.iter().map(|residual| residual * residual).sum();
    let failing = |node: &usize| residuals[*node] > tolerance && !touching[*node].is_empty();
    let pulled = |node: &usize| {
        touching[*node]
            .iter()
            .all(|normal| loads[*node].net.dot(normal) > 0.0)
    };
    let failing: Vec<usize> = (0..at.len()).filter(failing).collect();
    let pulled = failing.iter().filter(|node| pulled(node)).count();
    Certificate {
        residual_max: residuals.get(worst).copied().unwrap_or(0.0),
        residual_rms: (squares / at.len().max(1) as f64).sqrt(),
        worst_node: at.get(worst).copied().unwrap_or_default(),
        remaining_move,
        touching: touching
            .iter()
            .filter(|normals| !normals.is_empty())
            .count(),
        pulled,
        outside_cone: failing.len() - pulled,
        deepest: deepest(case.lattice, case.bodies, at),
        equilibrium: case.loads().equilibrium(at),
    }
}

/// The greatest residual alone, for a solver that wants to know whether to go on [-].
#[must_use]
pub fn greatest_residual(case: &Case<'_>, at: &[Vec3]) -> f64 {
    let loads = case.loads().at(at);
    let touching = case.normals(at);
    threads::map(at.len(), |node| {
        case.residual(node, &loads[node], &touching[node])
    })
    .into_iter()
    .fold(0.0, f64::max)
}

impl Case<'_> {
    fn loads(&self) -> Loads<'_> {
        Loads {
            lattice: self.lattice,
            fabric: self.fabric,
            laws: self.laws,
            clamps: self.clamps,
            own_only: self.own_only,
            passage: self.passage,
        }
    }

    /// The normals of what each node touches: itself, or by the cells around it.
    fn normals(&self, at: &[Vec3]) -> Vec<Vec<Vec3>> {
        let reach = self.surface.node_reach() + 1e-9;
        let near = |point: &Vec3, reach: f64| -> Vec<Vec3> {
            self.bodies
                .near(point, reach)
                .into_iter()
                .map(|near| near.normal)
                .collect()
        };
        let mut normals = threads::map(at.len(), |node| near(&at[node], reach));
        let sites = Sites::new(self.lattice, self.surface.sample_distance);
        let of_cells = threads::map(self.lattice.cells.len(), |cell| {
            self.normals_at_cell(&sites, cell, at)
        });
        for (nodes, found) in self.lattice.cells.iter().zip(of_cells) {
            for normal in found {
                for node in nodes {
                    let known = &mut normals[*node as usize];
                    if !known.iter().any(|other| other.dot(&normal) > SAME_NORMAL) {
                        known.push(normal);
                    }
                }
            }
        }
        normals
    }

    /// Normals of the surfaces that a cell touches between its nodes.
    fn normals_at_cell(&self, sites: &Sites, cell: usize, at: &[Vec3]) -> Vec<Vec3> {
        // Cloth touches where half its thickness meets a surface, between nodes as at them.
        let reach = self.surface.node_reach() + BETWEEN;
        let wide = reach + AROUND;
        let corners = self.lattice.cells[cell].map(|node| at[node as usize]);
        let place = |[u, v]: [f64; 2]| blend(&corners, u, v);
        // A cell is far when its middle is farther than its size.
        let middle = place([0.5, 0.5]);
        let size = corners.iter().map(|corner| (corner - middle).norm());
        let size = size.fold(0.0, f64::max);
        if self.bodies.near(&middle, size + wide).is_empty() {
            return Vec::new();
        }
        let nears = |sample, reach| {
            let corner = &corners[corner_of(sample)];
            self.bodies.near_from(corner, &place(sample), reach)
        };
        let look = |sample| (sample, nears(sample, wide));
        let samples: Vec<_> = sites.places().map(look).collect();
        let mut all = faces_around(&nears, wide, &samples);
        all.extend(samples.into_iter().flat_map(|(_, nears)| nears));
        let leans = |near: &Near| near.normal.dot(&all[0].normal) < ONE_FACE;
        if all.iter().any(leans) {
            let fine = (0..FINE * FINE).map(|k| [k % FINE, k / FINE].map(|k| k as f64));
            let fine = fine.map(|k| k.map(|k| k / (FINE - 1) as f64));
            all.extend(fine.flat_map(|place| nears(place, reach)));
        }
        let touching = all.into_iter().filter(|near| near.distance <= reach);
        touching.map(|near| near.normal).collect()
    }

    /// A node's residual [-].
    fn residual(&self, node: usize, load: &Load, normals: &[Vec3]) -> f64 {
        if self.held[node] {
            return 0.0;
        }
        let left = reaction::left_over(&load.net, normals, self.surface.friction);
        left.norm() / load.sum
    }
}

/// The deepest of 16 points a cell inside any body, or through a sheet [cm]: a grid that takes in
/// the cell's edges.
fn deepest(lattice: &Lattice, bodies: &Bodies, at: &[Vec3]) -> f64 {
    if bodies.parts().is_empty() {
        return 0.0;
    }
    let of_cell = |cell: usize| {
        let corners = lattice.cells[cell].map(|node| at[node as usize]);
        // Straight ways from the first and the third node to any point run in the cloth itself,
        // so that where they pass a sheet, the cloth does.
        let depth = |place: [f64; 2]| {
            let point = blend(&corners, place[0], place[1]);
            let depth = |from: &Vec3| bodies.depth_from(from, &point);
            depth(&corners[0]).max(depth(&corners[2]))
        };
        samples(|k| k as f64 / 3.0).map(depth).fold(0.0, f64::max)
    };
    threads::map(lattice.cells.len(), of_cell)
        .into_iter()
        .fold(0.0, f64::max)
}

/// A grid of 4 × 4 places in a cell.
fn samples(place: impl Fn(usize) -> f64) -> impl Iterator<Item = [f64; 2]> {
    (0..16).map(move |k| [place(k % 4), place(k / 4)])
}

/// A place in a cell, on the two triangles that it is shown as.
fn blend([a, b, c, d]: &[Vec3; 4], u: f64, v: f64) -> Vec3 {
    if u >= v {
        a + (b - a) * u + (c - b) * v
    } else {
        a + (c - d) * u + (d - a) * v
    }
}
