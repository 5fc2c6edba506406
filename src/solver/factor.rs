//! Sparse Cholesky of the joint system, front by front (multifrontal: Duff & Reid 1983).
//!
//! 1. [`dissect`] orders the nodes; each part's *border* is what it touches of later parts.
//! 2. A part's front is a dense matrix over its nodes and border: its own blocks of the stiffness,
//!    plus what its halves left over.
//! 3. The part's columns are factored; what is left of the border goes to the part above.
//!
//! Halves are independent and run side by side; each front's arithmetic has one order, so the
//! result has the same bits for any number of threads.

use super::{
    dense,
    dissection::{Neighbours, Part},
    stiffness::Stiffness,
};
use crate::{math::Vec3, threads};

/// What each part eliminates and touches: found once for a lattice.
#[derive(Debug)]
pub(super) struct Plan {
    root: Front,
    /// Place of each node in the order of elimination; `u32::MAX` for held ones.
    pub(super) rank: Vec<u32>,
}

#[derive(Debug)]
struct Front {
    /// Nodes eliminated here, then the border, each in order of elimination.
    nodes: Vec<u32>,
    /// How many of them are eliminated here.
    own: usize,
    /// For each half, where its border stands in `nodes`.
    halves: Vec<(Self, Vec<u32>)>,
}

/// A factored system.
#[derive(Debug)]
pub(super) struct Factor {
    root: Factored,
}

#[derive(Debug)]
struct Factored {
    /// Columns of L of the front's own nodes, over all its nodes (column-major).
    columns: Vec<f64>,
    halves: Vec<Self>,
}

impl Plan {
    /// Plans the elimination of a dissected cloth.
    pub(super) fn new(root: Part, neighbours: &Neighbours, nodes: usize) -> Self {
        let mut rank = vec![u32::MAX; nodes];
        let mut next = 0;
        number(&root, &mut rank, &mut next);
        let root = Front::new(root, neighbours, &rank);
        Self { root, rank }
    }
}

fn number(part: &Part, rank: &mut [u32], next: &mut u32) {
    for half in &part.halves {
        number(half, rank, next);
    }
    for node in &part.nodes {
        rank[*node as usize] = *next;
        *next += 1;
    }
}

impl Front {
    fn new(part: Part, neighbours: &Neighbours, rank: &[u32]) -> Self {
        let halves: Vec<Self> = part
            .halves
            .into_iter()
            .map(|half| Self::new(half, neighbours, rank))
            .collect();
        let last = part
            .nodes
            .iter()
            .chain(halves.iter().flat_map(|half| &half.nodes[..half.own]));
        let last = last.map(|node| rank[*node as usize]).max().unwrap_or(0);
        let later = |node: &u32| rank[*node as usize] != u32::MAX && rank[*node as usize] > last;
        let mut border: Vec<u32> = part
            .nodes
            .iter()
            .flat_map(|node| neighbours.of(*node))
            .chain(halves.iter().flat_map(|half| &half.nodes[half.own..]))
            .copied()
            .filter(later)
            .collect();
        border.sort_unstable_by_key(|node| rank[*node as usize]);
        border.dedup();
        let own = part.nodes.len();
        let mut nodes = part.nodes;
        nodes.append(&mut border);
        let placed = halves
            .into_iter()
            .map(|half| {
                let places = places(&half.nodes[half.own..], &nodes, rank);
                (half, places)
            })
            .collect();
        Self {
            nodes,
            own,
            halves: placed,
        }
    }
}

/// Where each of `some` stands in `all`, both in order of elimination.
fn places(some: &[u32], all: &[u32], rank: &[u32]) -> Vec<u32> {
    some.iter()
        .map(|node| {
            all.partition_point(|other| rank[*other as usize] < rank[*node as usize]) as u32
        })
        .collect()
}

impl Factor {
    /// Factors a stiffness; `None` where it is not positive definite.
    pub(super) fn new(plan: &Plan, stiffness: &Stiffness) -> Option<Self> {
        let (root, _) = factor(&plan.root, stiffness, &plan.rank)?;
        Some(Self { root })
    }

    /// Solves for the moves [cm] that answer the forces [gf]; held nodes stay.
    pub(super) fn solve(&self, plan: &Plan, forces: &[Vec3]) -> Vec<Vec3> {
        let (solved, _) = forward(&plan.root, &self.root, &plan.rank, forces);
        let mut moves = vec![Vec3::zeros(); forces.len()];
        let answers = backward(&plan.root, &self.root, solved, &[]);
        answers.scatter(&plan.root, &mut moves);
        moves
    }
}

/// Factors one front; returns its columns and what it leaves for the part above.
fn factor(front: &Front, stiffness: &Stiffness, rank: &[u32]) -> Option<(Factored, Vec<f64>)> {
    let mut halves = factor_halves(&front.halves, stiffness, rank)?;
    let order = 3 * front.nodes.len();
    let own = 3 * front.own;
    let mut matrix = vec![0.0; order * order];
    assemble(front, stiffness, rank, &mut matrix);
    for ((_, places), (_, rest)) in front.halves.iter().zip(&mut halves) {
        extend_add(&mut matrix, order, rest, places);
        *rest = Vec::new();
    }
    if !dense::factor(&mut matrix, order, own) {
        return None;
    }
    let rest = border_of(&matrix, order, own);
    matrix.truncate(order * own);
    matrix.shrink_to_fit();
    let halves = halves.into_iter().map(|(factored, _)| factored).collect();
    Some((
        Factored {
            columns: matrix,
            halves,
        },
        rest,
    ))
}

type Halves = Vec<(Factored, Vec<f64>)>;

fn factor_halves(
    halves: &[(Front, Vec<u32>)],
    stiffness: &Stiffness,
    rank: &[u32],
) -> Option<Halves> {
    if let [(one, _), (other, _)] = halves {
        let (one, other) = threads::both(
            || factor(one, stiffness, rank),
            || factor(other, stiffness, rank),
        );
        return Some(vec![one?, other?]);
    }
    halves
        .iter()
        .map(|(half, _)| factor(half, stiffness, rank))
        .collect()
}

/// Puts the front's own blocks of the stiffness in place.
fn assemble(front: &Front, stiffness: &Stiffness, rank: &[u32], matrix: &mut [f64]) {
    let order = 3 * front.nodes.len();
    for (column, &node) in front.nodes[..front.own].iter().enumerate() {
        let (others, blocks) = stiffness.row(node);
        for (row, block) in places(others, &front.nodes, rank).into_iter().zip(blocks) {
            for c in 0..3 {
                for r in 0..3 {
                    // Blocks stand at (earlier, later); the lower half wants (later, earlier).
                    matrix[(3 * column + c) * order + 3 * row as usize + r] += block[(c, r)];
                }
            }
        }
    }
}

/// Adds what a half left over.
fn extend_add(matrix: &mut [f64], order: usize, rest: &[f64], places: &[u32]) {
    let size = 3 * places.len();
    for (j, column) in rest.chunks_exact(size.max(1)).enumerate() {
        let target = (3 * places[j / 3] as usize + j % 3) * order;
        for (place, three) in places.iter().zip(column.chunks_exact(3)).skip(j / 3) {
            let at = target + 3 * *place as usize;
            for (entry, value) in matrix[at..at + 3].iter_mut().zip(three) {
                *entry += value;
            }
        }
    }
}

/// The Schur complement of the border.
fn border_of(matrix: &[f64], order: usize, own: usize) -> Vec<f64> {
    let columns = matrix[own * order..].chunks_exact(order);
    columns
        .flat_map(|column| column[own..].iter().copied())
        .collect()
}

/// Values of the front's own unknowns, and those of its halves.
struct Solved {
    own: Vec<f64>,
    halves: Vec<Self>,
}

impl Solved {
    fn scatter(&self, front: &Front, moves: &mut [Vec3]) {
        for (node, three) in front.nodes[..front.own]
            .iter()
            .zip(self.own.chunks_exact(3))
        {
            moves[*node as usize] = Vec3::new(three[0], three[1], three[2]);
        }
        for (half, (front, _)) in self.halves.iter().zip(&front.halves) {
            half.scatter(front, moves);
        }
    }
}

/// Fronts of more unknowns than this are shared out; waking another core for less costs more.
const SHARED: usize = 200;

/// Solves with L, from the leaves up; returns what is left over for the border as well.
fn forward(
    front: &Front,
    factored: &Factored,
    rank: &[u32],
    forces: &[Vec3],
) -> (Solved, Vec<f64>) {
    let below = each_half(front, |k| {
        forward(&front.halves[k].0, &factored.halves[k], rank, forces)
    });
    let order = 3 * front.nodes.len();
    let mut local = vec![0.0; order];
    for (three, node) in local.chunks_exact_mut(3).zip(&front.nodes[..front.own]) {
        three.copy_from_slice(forces[*node as usize].as_slice());
    }
    let mut halves = Vec::with_capacity(below.len());
    for ((solved, rest), (_, places)) in below.into_iter().zip(&front.halves) {
        for (place, three) in places.iter().zip(rest.chunks_exact(3)) {
            for (entry, value) in local[3 * *place as usize..].iter_mut().zip(three) {
                *entry += value;
            }
        }
        halves.push(solved);
    }
    for (k, column) in factored.columns.chunks_exact(order.max(1)).enumerate() {
        local[k] /= column[k];
        let value = local[k];
        for (entry, factor) in local[k + 1..].iter_mut().zip(&column[k + 1..]) {
            *entry -= factor * value;
        }
    }
    let rest = local.split_off(3 * front.own);
    (Solved { own: local, halves }, rest)
}

/// Solves with Lᵀ, from the root down; `border` has what the parts above came to.
fn backward(front: &Front, factored: &Factored, solved: Solved, border: &[f64]) -> Solved {
    let order = 3 * front.nodes.len();
    let mut local = solved.own;
    local.extend_from_slice(border);
    let columns = factored.columns.chunks_exact(order.max(1));
    for (k, column) in columns.enumerate().rev() {
        let sum = local[k] - dot(&column[k + 1..], &local[k + 1..]);
        local[k] = sum / column[k];
    }
    let below: Vec<Solved> = solved.halves;
    let borders: Vec<Vec<f64>> = front
        .halves
        .iter()
        .map(|(_, places)| {
            let of = |place: &u32| local[3 * *place as usize..][..3].iter().copied();
            places.iter().flat_map(of).collect()
        })
        .collect();
    let mut below = below.into_iter();
    let halves = match (below.next(), below.next()) {
        (Some(one), Some(other)) if order > SHARED => {
            let descend = |k: usize, solved| {
                backward(&front.halves[k].0, &factored.halves[k], solved, &borders[k])
            };
            let (one, other) = threads::both(|| descend(0, one), || descend(1, other));
            vec![one, other]
        }
        (one, other) => {
            let all = one.into_iter().chain(other).enumerate();
            all.map(|(k, solved)| {
                backward(&front.halves[k].0, &factored.halves[k], solved, &borders[k])
            })
            .collect()
        }
    };
    local.truncate(3 * front.own);
    Solved { own: local, halves }
}

/// Does the same for each half of a front, side by side where that pays.
fn each_half<T: Send>(front: &Front, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if front.halves.len() == 2 && 3 * front.nodes.len() > SHARED {
        let (one, other) = threads::both(|| work(0), || work(1));
        return vec![one, other];
    }
    (0..front.halves.len()).map(work).collect()
}

/// The product of two columns, in eight sums of fixed order: so that it streams.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a
        .remainder()
        .iter()
        .zip(b.remainder())
        .map(|(a, b)| a * b)
        .sum();
    for (a, b) in a.zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums.iter().sum::<f64>() + rest
}
