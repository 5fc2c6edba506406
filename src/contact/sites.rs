//! Points of the cloth that may touch a body.

use crate::{lattice::Lattice, math::Vec3};

/// A point of the cloth: a node, or a mean of the nodes of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Nodes; a node's own site names it four times, a triangle's site one of them twice.
    pub nodes: [u32; 4],
    /// Their weights, summing to 1; a node's own site has 1, 0, 0, 0. Where a node is named again
    /// its weight is 0.
    pub weights: [f64; 4],
}

/// All sites of a lattice: its nodes, a square grid of samples in each cell, and any other place in
/// a cell that is asked for.
#[derive(Clone, Debug)]
pub struct Sites {
    cells: Vec<[u32; 4]>,
    area: Vec<f64>,
    side: usize,
    with_edges: bool,
    sample_area: f64,
}

/// The node of a cell, from 0 to 3, that a place in it belongs to.
pub(crate) fn corner_of([u, v]: [f64; 2]) -> usize {
    match (u > 0.5, v > 0.5) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    }
}

/// Samples of a cell stand no farther apart than this [cm], where 2 to 4 a side allow it.
const USUAL_DISTANCE: f64 = 0.2;

impl Sites {
    /// The sites of a lattice. Where samples come to stand farther apart than `distance` [cm] they
    /// take in the edges of the cells, which are the nearest that cloth folded there has to a body.
    #[must_use]
    pub fn new(lattice: &Lattice, distance: f64) -> Self {
        let side = (lattice.pitch / USUAL_DISTANCE).ceil().clamp(2.0, 4.0);
        let with_edges = lattice.pitch > distance * side;
        let side = side as usize + usize::from(with_edges);
        Self {
            cells: lattice.cells.clone(),
            area: lattice.area.clone(),
            side,
            with_edges,
            sample_area: lattice.pitch * lattice.pitch / (side * side) as f64,
        }
    }

    /// The cells, by their nodes.
    #[must_use]
    pub fn cells(&self) -> &[[u32; 4]] {
        &self.cells
    }

    /// Places of the samples in any cell, each from 0 to 1 along both sides.
    pub fn places(&self) -> impl Iterator<Item = [f64; 2]> + use<> {
        let side = self.side;
        let [from, length] = if self.with_edges {
            [0.0, side as f64 - 1.0]
        } else {
            [0.5, side as f64]
        };
        let place = move |k: usize| (k as f64 + from) / length;
        (0..side * side).map(move |k| [place(k % side), place(k / side)])
    }

    /// Samples of a cell.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.side * self.side
    }

    /// A node's own site.
    #[must_use]
    pub fn node(&self, node: usize) -> Site {
        Site {
            nodes: [node as u32; 4],
            weights: [1.0, 0.0, 0.0, 0.0],
        }
    }

    /// The site at a place in a cell.
    #[must_use]
    pub fn in_cell(&self, cell: usize, [u, v]: [f64; 2]) -> Site {
        // On the two triangles that the cell is shown as, parted from its first node to its third.
        let weights = if u >= v {
            [1.0 - u, u - v, v, 0.0]
        } else {
            [1.0 - v, 0.0, u, v - u]
        };
        let nodes = self.cells[cell];
        Site {
            nodes,
            weights: gathered(&nodes, weights),
        }
    }

    /// Area of cloth that a node stands for [cm²].
    #[must_use]
    pub fn node_area(&self, node: usize) -> f64 {
        self.area[node]
    }

    /// Area of cloth that a sample stands for [cm²].
    #[must_use]
    pub fn sample_area(&self) -> f64 {
        self.sample_area
    }
}

impl Site {
    /// Where it is [cm].
    #[inline]
    #[must_use]
    pub fn at(&self, positions: &[Vec3]) -> Vec3 {
        let [a, b, c, d] = self.nodes.map(|node| node as usize);
        let [f, g, h, i] = self.weights;
        if f == 1.0 {
            return positions[a];
        }
        positions[a] * f + positions[b] * g + positions[c] * h + positions[d] * i
    }

    /// Its share of a node [-].
    #[must_use]
    pub fn weight_of(&self, node: usize) -> f64 {
        let place = self.nodes.iter().position(|other| *other as usize == node);
        place.map_or(0.0, |place| self.weights[place])
    }

    /// Its nodes with weights that are not 0.
    pub fn shares(&self) -> impl Iterator<Item = (u32, f64)> + '_ {
        let shares = self.nodes.iter().copied().zip(self.weights);
        shares.filter(|(_, weight)| *weight != 0.0)
    }
}

/// Weights with a triangle's repeated node named once: its stiffness is the square of all its
/// weight, not the sum of the squares of its parts.
fn gathered(nodes: &[u32; 4], mut weights: [f64; 4]) -> [f64; 4] {
    for k in 1..4 {
        if let Some(first) = (0..k).find(|first| nodes[*first] == nodes[k]) {
            weights[first] += weights[k];
            weights[k] = 0.0;
        }
    }
    weights
}
