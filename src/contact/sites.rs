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

/// All sites of a lattice: nodes first, then a square grid of samples in each cell.
#[derive(Clone, Debug)]
pub struct Sites {
    cells: Vec<[u32; 4]>,
    nodes: usize,
    side: usize,
    area: Vec<f64>,
    cell_area: f64,
}

/// Samples of a cell stand no farther apart than this [cm], where 4 to 8 a side allow it.
const SAMPLE_DISTANCE: f64 = 0.125;

impl Sites {
    /// The sites of a lattice.
    #[must_use]
    pub fn new(lattice: &Lattice) -> Self {
        let side = (lattice.pitch / SAMPLE_DISTANCE).ceil().clamp(4.0, 8.0) as usize;
        Self {
            cells: lattice.cells.clone(),
            nodes: lattice.coordinates.len(),
            side,
            area: lattice.area.clone(),
            cell_area: lattice.pitch * lattice.pitch,
        }
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes + self.cells.len() * self.side * self.side
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether a site is a node.
    #[must_use]
    pub fn is_node(&self, site: usize) -> bool {
        site < self.nodes
    }

    /// Area of cloth that a site stands for [cm²].
    #[must_use]
    pub fn area(&self, site: usize) -> f64 {
        match self.area.get(site) {
            Some(area) => *area,
            None => self.cell_area / (self.side * self.side) as f64,
        }
    }

    /// A site by its number.
    #[must_use]
    pub fn site(&self, site: usize) -> Site {
        if site < self.nodes {
            return Site {
                nodes: [site as u32; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
            };
        }
        let (cell, sample) = (
            (site - self.nodes) / (self.side * self.side),
            (site - self.nodes) % (self.side * self.side),
        );
        let place = |k: usize| (k as f64 + 0.5) / self.side as f64;
        let (u, v) = (place(sample % self.side), place(sample / self.side));
        let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
        let nodes = self.cells[cell];
        Site {
            nodes,
            weights: gathered(&nodes, weights),
        }
    }
}

impl Site {
    /// Where it is [cm].
    #[must_use]
    pub fn at(&self, positions: &[Vec3]) -> Vec3 {
        if self.weights[0] == 1.0 {
            return positions[self.nodes[0] as usize];
        }
        let mut at = Vec3::zeros();
        for (node, weight) in self.nodes.iter().zip(self.weights) {
            at += positions[*node as usize] * weight;
        }
        at
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
