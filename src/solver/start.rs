//! Where a drape begins: the flat or rolled cloth in its place, its holds, and a breath of disorder.

use super::{Grip, Problem, Unsolvable, level::stopped};
use crate::{
    contact::{Sites, Surface},
    forces::Clamp,
    lattice::Lattice,
    math::Vec3,
    threads,
};

/// The problem on one lattice.
#[derive(Clone, Debug)]
pub(super) struct Start {
    /// Positions of the cloth as it was laid out [cm].
    pub(super) at: Vec<Vec3>,
    /// Which nodes are held.
    pub(super) held: Vec<bool>,
    /// How far each held node is carried [cm].
    pub(super) carry: Vec<(u32, Vec3)>,
    /// The vices.
    pub(super) clamps: Vec<Clamp>,
}

/// Height of the disorder that lets folds begin, in pitches: far below anything measured.
const DISORDER: f64 = 1e-3;

impl Start {
    /// Lays the cloth out and takes hold of it.
    pub(super) fn new(problem: &Problem, lattice: &Lattice) -> Result<Self, Unsolvable> {
        let at = lattice
            .coordinates
            .iter()
            .map(|cloth| problem.placement.at(problem.piece.to_outline(*cloth)))
            .collect();
        let nodes = lattice.coordinates.len();
        let mut start = Self {
            at,
            held: vec![false; nodes],
            carry: Vec::new(),
            clamps: Vec::new(),
        };
        let mut clamped = vec![false; nodes];
        for (index, hold) in problem.holds.iter().enumerate() {
            for node in gripped(problem, lattice, index)? {
                clamped[node as usize] |= hold.clamp;
                if !core::mem::replace(&mut start.held[node as usize], true) {
                    start.carry.push((node, hold.carry));
                }
            }
        }
        start.clamp(problem, lattice, &clamped);
        Ok(start)
    }

    /// Keeps the slope of every rod that leaves a clamped hold.
    fn clamp(&mut self, problem: &Problem, lattice: &Lattice, clamped: &[bool]) {
        for rod in &lattice.rods {
            let [a, b] = rod.nodes;
            for [held, next] in [[a, b], [b, a]] {
                if clamped[held as usize] && !self.held[next as usize] {
                    let along = slope(problem, lattice, [held, next]);
                    self.clamps.push(Clamp {
                        nodes: [held, next],
                        slope: along / along.norm(),
                        yarn: rod.yarn,
                        length: rod.rest,
                        width: rod.width,
                    });
                }
            }
        }
    }

    /// Refuses a start inside a body, or with a body through the cloth.
    pub(super) fn check(&self, problem: &Problem, lattice: &Lattice) -> Result<(), Unsolvable> {
        let bodies = &problem.bodies;
        for position in &self.at {
            let depth = bodies.depth(position);
            if depth > 1e-9 {
                return Err(inside(problem, position, depth));
            }
        }
        for rod in &lattice.rods {
            let [a, b] = rod.nodes.map(|node| self.at[node as usize]);
            let free = bodies.free_way(&a, &b);
            if free < 1.0 {
                return Err(inside(problem, &(a + (b - a) * free), 0.0));
            }
        }
        Ok(())
    }

    /// Lets a cloth that nothing holds fall until it is about to touch; `None` where it falls for
    /// ever.
    pub(super) fn fall(
        &mut self,
        problem: &Problem,
        surface: &Surface,
        lattice: &Lattice,
    ) -> Option<()> {
        if self.held.iter().any(|held| *held) {
            return Some(());
        }
        let sites = Sites::new(lattice, surface.sample_distance);
        let nodes = threads::map(self.at.len(), |node| problem.bodies.fall(&self.at[node]));
        let cells = threads::map(sites.cells().len(), |cell| {
            let falls = sites.places().map(|place| {
                problem
                    .bodies
                    .fall(&sites.in_cell(cell, place).at(&self.at))
            });
            falls.flatten().reduce(f64::min)
        });
        let falls = nodes.into_iter().chain(cells);
        let fall = falls.flatten().reduce(f64::min)?;
        let fall = (fall - 1.5 * surface.node_reach()).max(0.0);
        for position in &mut self.at {
            position.z -= fall;
        }
        Some(())
    }

    /// Moves every free node by a hash of the seed and its place, far below the pitch and through no
    /// surface.
    pub(super) fn disturb(&self, at: &mut [Vec3], lattice: &Lattice, problem: &Problem) {
        for ((position, grid), held) in at.iter_mut().zip(&lattice.grid).zip(&self.held) {
            if *held {
                continue;
            }
            let place = (grid[0] as u32 as u64) << 32 | grid[1] as u32 as u64;
            let mut to = *position;
            for axis in 0..3 {
                let number = number(mix(problem.seed ^ (axis as u64 + 1)) ^ place);
                to[axis] += number * DISORDER * lattice.pitch;
            }
            *position = stopped(&problem.bodies, position, to);
        }
    }
}

/// The direction in which the cloth leaves one node towards the next at the start.
fn slope(problem: &Problem, lattice: &Lattice, nodes: [u32; 2]) -> Vec3 {
    let piece = &problem.piece;
    let [from, to] = nodes.map(|node| piece.to_outline(lattice.coordinates[node as usize]));
    if problem.placement.curl == 0.0 {
        problem.placement.at(to) - problem.placement.at(from)
    } else {
        problem.placement.along(to - from, from)
    }
}

/// The nodes that a hold takes.
fn gripped(problem: &Problem, lattice: &Lattice, index: usize) -> Result<Vec<u32>, Unsolvable> {
    match problem.holds[index].grip {
        Grip::Edge(edge) => Ok(problem.piece.edge_nodes(lattice, edge)),
        Grip::Point(point) => match lattice.nearest_node(problem.piece.to_cloth(point)) {
            Some((node, distance)) if distance <= 1.01 * lattice.pitch => Ok(vec![node]),
            _ => Err(Unsolvable::HoldOutside {
                index: index + 1,
                x: point.x,
                y: point.y,
            }),
        },
    }
}

fn inside(problem: &Problem, at: &Vec3, depth: f64) -> Unsolvable {
    let nearest = problem.bodies.near(at, 1e-6).into_iter().next();
    let part = nearest.and_then(|near| problem.bodies.parts().get(near.part));
    Unsolvable::StartsInside {
        part: part.map_or_else(|| "a body".to_owned(), |part| part.name().to_owned()),
        depth,
        x: at.x,
        y: at.y,
        z: at.z,
    }
}

/// A number between −1 and 1 for a seed.
pub(super) fn number(seed: u64) -> f64 {
    (mix(seed) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A step of the splitmix64 generator (Steele, Lea & Flood 2014).
fn mix(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
