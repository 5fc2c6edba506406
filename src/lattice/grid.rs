//! The grid that a lattice is cut from, before its absent nodes are left out.

use crate::{lattice::ring::cross, math::Vec2};

/// Nodes in rows along the weft, within a row along the warp, each a little off its grid place.
#[derive(Debug)]
pub(super) struct Grid {
    /// Nodes along the warp and along the weft, at least 1 each.
    pub(super) counts: [usize; 2],
    /// Distance of grid places along the warp and along the weft [cm].
    pub(super) step: Vec2,
    /// How far each node is from its grid place [cm]. Kept apart, so that lengths and angles
    /// between nodes that did not move come out exact.
    pub(super) shift: Vec<Vec2>,
    /// What stands in each square of the grid, `counts − 1` each way.
    pub(super) meshes: Vec<Mesh>,
}

/// What of a square of the grid is cloth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mesh {
    /// Nothing.
    Absent,
    /// All four nodes.
    Whole,
    /// The triangle that is left without one node: 0 to 3, counter-clockwise from the least warp
    /// and weft.
    Without(usize),
}

impl Mesh {
    /// The corners that are present, counter-clockwise; of a triangle, the one between its rods is
    /// in the middle.
    pub(super) fn corners(self) -> &'static [usize] {
        match self {
            Self::Absent => &[],
            Self::Whole => &[0, 1, 2, 3],
            Self::Without(0) => &[1, 2, 3],
            Self::Without(1) => &[2, 3, 0],
            Self::Without(2) => &[3, 0, 1],
            Self::Without(3..) => &[0, 1, 2],
        }
    }
}

impl Grid {
    /// A grid of whole squares, no node moved.
    pub(super) fn regular(counts: [usize; 2], step: Vec2) -> Self {
        let squares = counts[0].saturating_sub(1) * counts[1].saturating_sub(1);
        Self {
            counts,
            step,
            shift: vec![Vec2::zeros(); counts[0] * counts[1]],
            meshes: vec![Mesh::Whole; squares],
        }
    }

    /// Grid indices of a node (along the warp, along the weft).
    pub(super) fn indices(&self, node: usize) -> [usize; 2] {
        [node % self.counts[0], node / self.counts[0]]
    }

    /// Where a node was before it moved; the middle of the grid is the origin [cm].
    pub(super) fn place(&self, node: usize) -> Vec2 {
        let [i, j] = self.indices(node);
        let middle = |count: usize| 0.5 * (count as f64 - 1.0);
        Vec2::new(
            (i as f64 - middle(self.counts[0])) * self.step.x,
            (j as f64 - middle(self.counts[1])) * self.step.y,
        )
    }

    /// Where a node is [cm].
    pub(super) fn at(&self, node: usize) -> Vec2 {
        self.place(node) + self.shift[node]
    }

    /// The four nodes whose places are around a point [cm].
    pub(super) fn around(&self, point: Vec2) -> [usize; 4] {
        let first = [0, 1].map(|axis| {
            let middle = 0.5 * (self.counts[axis] as f64 - 1.0);
            let index = (point[axis] / self.step[axis] + middle) as usize;
            index.min(self.counts[axis].saturating_sub(2))
        });
        let first = first[1] * self.counts[0] + first[0];
        let above = first + self.counts[0];
        [first, first + 1, above, above + 1]
    }

    /// From one node to another [cm].
    pub(super) fn vector(&self, from: usize, to: usize) -> Vec2 {
        let ([a, b], [c, d]) = (self.indices(from), self.indices(to));
        let steps = Vec2::new(c as f64 - a as f64, d as f64 - b as f64);
        steps.component_mul(&self.step) + (self.shift[to] - self.shift[from])
    }

    /// The four nodes of a square, counter-clockwise from the least warp and weft.
    pub(super) fn square(&self, square: usize) -> [usize; 4] {
        let across = self.counts[0] - 1;
        let first = square / across * self.counts[0] + square % across;
        let above = first + self.counts[0];
        [first, first + 1, above + 1, above]
    }

    /// The squares that have a node as a corner.
    pub(super) fn squares_around(&self, node: usize) -> impl Iterator<Item = usize> {
        let [across, along] = self.counts.map(|count| count - 1);
        let [i, j] = self.indices(node);
        let rows = j.saturating_sub(1)..(j + 1).min(along);
        let columns = i.saturating_sub(1)..(i + 1).min(across);
        rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }

    /// The squares that share a side with a square.
    pub(super) fn squares_beside(&self, square: usize) -> impl Iterator<Item = usize> {
        let [across, along] = self.counts.map(|count| count - 1);
        let [i, j] = [square % across, square / across];
        let beside = [
            (i > 0).then(|| square - 1),
            (i + 1 < across).then_some(square + 1),
            (j > 0).then(|| square - across),
            (j + 1 < along).then_some(square + across),
        ];
        beside.into_iter().flatten()
    }

    /// The nodes of a mesh, counter-clockwise.
    pub(super) fn nodes(&self, square: usize, mesh: Mesh) -> impl ExactSizeIterator<Item = usize> {
        let nodes = self.square(square);
        mesh.corners().iter().map(move |corner| nodes[*corner])
    }

    /// Area of a polygon of nodes, positive where they run counter-clockwise [cm²].
    pub(super) fn area(&self, nodes: &[usize]) -> f64 {
        let Some((first, rest)) = nodes.split_first() else {
            return 0.0;
        };
        let arm = |node: &usize| self.vector(*first, *node);
        let pairs = rest.iter().zip(rest.iter().skip(1));
        0.5 * pairs.map(|(a, b)| cross(arm(a), arm(b))).sum::<f64>()
    }
}
