//! The joint system's matrix: 3×3 blocks between nodes that share a force [gf/cm].

use super::dissection::Neighbours;
#[cfg(test)]
use crate::math::Vec3;
use crate::{math::Mat3, threads};
use std::sync::Arc;

/// Which nodes have a block with which: found once for a lattice.
#[derive(Debug)]
pub(super) struct Pattern {
    first: Vec<u32>,
    columns: Vec<u32>,
}

impl Pattern {
    /// Of nodes that share a force; held nodes are left out.
    pub(super) fn new(neighbours: &Neighbours, held: &[bool]) -> Self {
        let mut first = vec![0];
        let mut columns = Vec::new();
        for node in 0..held.len() as u32 {
            if !held[node as usize] {
                let others = neighbours.of(node).iter().copied();
                let mut row: Vec<u32> = others
                    .filter(|other| !held[*other as usize])
                    .chain([node])
                    .collect();
                row.sort_unstable();
                columns.append(&mut row);
            }
            first.push(columns.len() as u32);
        }
        Self { first, columns }
    }

    /// Nodes, held ones too.
    pub(super) fn len(&self) -> usize {
        self.first.len() - 1
    }

    /// The nodes that a node has blocks with, itself among them, in rising order; none of a held
    /// node.
    pub(super) fn row(&self, node: usize) -> &[u32] {
        &self.columns[self.range(node)]
    }

    /// All pairs of nodes that have a block, each once.
    pub(super) fn pairs(&self) -> Vec<[u32; 2]> {
        let rows = 0..self.len() as u32;
        rows.flat_map(|node| {
            let later = self.row(node as usize).iter().filter(move |n| **n > node);
            later.map(move |other| [node, *other])
        })
        .collect()
    }

    /// Where the blocks of a row stand.
    pub(super) fn range(&self, node: usize) -> core::ops::Range<usize> {
        self.first[node] as usize..self.first[node + 1] as usize
    }

    fn place(&self, row: u32, column: u32) -> Option<usize> {
        let columns = self.row(row as usize);
        let place = columns.iter().position(|other| *other == column)?;
        Some(self.first[row as usize] as usize + place)
    }
}

/// Blocks of a symmetric matrix, all of each row.
#[derive(Clone, Debug)]
pub(super) struct Stiffness {
    pattern: Arc<Pattern>,
    blocks: Vec<Mat3>,
}

impl Stiffness {
    /// An empty matrix.
    pub(super) fn new(pattern: Arc<Pattern>) -> Self {
        Self {
            blocks: vec![Mat3::zeros(); pattern.columns.len()],
            pattern,
        }
    }

    /// A matrix of rows that are found one by one: `fill(row, blocks)` writes those of a row.
    pub(super) fn of_rows(
        pattern: Arc<Pattern>,
        fill: impl Fn(usize, &mut [Mat3]) + Sync + Send,
    ) -> Self {
        let rows = threads::map(pattern.len(), |row| {
            let mut blocks = vec![Mat3::zeros(); pattern.row(row).len()];
            fill(row, &mut blocks);
            blocks
        });
        Self {
            blocks: rows.concat(),
            pattern,
        }
    }

    /// Which blocks there are.
    #[cfg(test)]
    pub(super) fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// The matrix times moves, block by block.
    #[cfg(test)]
    pub(super) fn times(&self, moves: &[Vec3]) -> Vec<Vec3> {
        let product = |row| {
            let (columns, blocks) = self.row(row);
            let parts = columns.iter().zip(blocks);
            parts
                .map(|(column, block)| block * moves[*column as usize])
                .sum()
        };
        (0..moves.len()).map(product).collect()
    }

    /// Adds a block at (row, column), and so its transpose at (column, row); held nodes and pairs
    /// that were not announced are passed over.
    pub(super) fn add(&mut self, row: u32, column: u32, block: &Mat3) {
        if let Some(place) = self.pattern.place(row, column) {
            self.blocks[place] += block;
        }
        if row != column
            && let Some(place) = self.pattern.place(column, row)
        {
            self.blocks[place] += block.transpose();
        }
    }

    /// The nodes that a node is joined with, itself among them, and the blocks.
    pub(super) fn row(&self, node: usize) -> (&[u32], &[Mat3]) {
        let blocks = &self.blocks[self.pattern.range(node)];
        (self.pattern.row(node), blocks)
    }

    /// The block at a place of the pattern.
    pub(super) fn block(&self, place: usize) -> &Mat3 {
        &self.blocks[place]
    }

    /// A node's own block; `None` of a held node.
    pub(super) fn diagonal(&self, node: usize) -> Option<&Mat3> {
        let place = self.pattern.place(node as u32, node as u32)?;
        Some(&self.blocks[place])
    }
}
