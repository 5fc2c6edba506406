//! The order in which a joint step eliminates nodes: nested dissection of the flat cloth.
//!
//! The cloth is halved along its longer side, again and again. Left-hand nodes that touch the
//! right half part the two, so each half can be eliminated without the other and the parting
//! strip last. A lattice of n nodes then fills some n·log n blocks (George 1973).

use crate::math::Vec2;

/// Pieces of at most this many nodes are not halved: smaller fronts cost more in bookkeeping than
/// they save in arithmetic.
const LEAF: usize = 24;

/// A set of nodes that are eliminated together, and the halves that go before it.
#[derive(Debug)]
pub(super) struct Part {
    /// Its nodes, in order of elimination.
    pub(super) nodes: Vec<u32>,
    /// Parts that are eliminated before it and touch it or what follows it.
    pub(super) halves: Vec<Self>,
}

/// Which nodes each node shares a force with.
#[derive(Clone, Debug)]
pub(super) struct Neighbours {
    first: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    /// From pairs, each named once.
    pub(super) fn new(nodes: usize, pairs: &[[u32; 2]]) -> Self {
        let mut both: Vec<[u32; 2]> = pairs.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
        both.sort_unstable();
        both.dedup();
        let mut first = vec![0; nodes + 1];
        for [node, _] in &both {
            first[*node as usize + 1] += 1;
        }
        for node in 0..nodes {
            first[node + 1] += first[node];
        }
        Self {
            first,
            list: both.into_iter().map(|[_, other]| other).collect(),
        }
    }

    /// The nodes that share a force with this one, in rising order.
    pub(super) fn of(&self, node: u32) -> &[u32] {
        let node = node as usize;
        &self.list[self.first[node] as usize..self.first[node + 1] as usize]
    }
}

/// Halves the cloth into parts; `free` nodes only, by their cloth coordinates.
pub(super) fn dissect(free: Vec<u32>, coordinates: &[Vec2], neighbours: &Neighbours) -> Part {
    let mut side = vec![0_u8; coordinates.len()];
    halve(free, coordinates, neighbours, &mut side)
}

fn halve(nodes: Vec<u32>, coordinates: &[Vec2], neighbours: &Neighbours, side: &mut [u8]) -> Part {
    if nodes.len() <= LEAF {
        return Part {
            nodes,
            halves: Vec::new(),
        };
    }
    let axis = longer_axis(&nodes, coordinates);
    let mut sorted = nodes;
    sorted.sort_by(|a, b| {
        let of = |node: &u32| coordinates[*node as usize];
        of(a)[axis].total_cmp(&of(b)[axis]).then(a.cmp(b))
    });
    let right = sorted.split_off(sorted.len() / 2);
    for node in &right {
        side[*node as usize] = 1;
    }
    let touches_right = |node: &u32| neighbours.of(*node).iter().any(|n| side[*n as usize] == 1);
    let (parting, left): (Vec<u32>, Vec<u32>) = sorted.into_iter().partition(touches_right);
    for node in &right {
        side[*node as usize] = 0;
    }
    let halves = [left, right]
        .into_iter()
        .filter(|half| !half.is_empty())
        .map(|half| halve(half, coordinates, neighbours, side))
        .collect();
    Part {
        nodes: parting,
        halves,
    }
}

fn longer_axis(nodes: &[u32], coordinates: &[Vec2]) -> usize {
    let extent = |axis: usize| {
        let of = |node: &u32| coordinates[*node as usize][axis];
        let low = nodes.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = nodes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        high - low
    };
    usize::from(extent(1) > extent(0))
}
