//! The joint system's matrix: 3×3 blocks between nodes that share a force [gf/cm].

use super::dissection::Neighbours;
use crate::math::{Mat3, Vec3};

/// Blocks of a symmetric matrix, each pair once: in the row of the node that is eliminated first.
#[derive(Clone, Debug)]
pub(super) struct Stiffness {
    first: Vec<u32>,
    columns: Vec<u32>,
    blocks: Vec<Mat3>,
    rank: Vec<u32>,
}

impl Stiffness {
    /// An empty matrix for nodes of these ranks; a node of rank `u32::MAX` is held and left out.
    pub(super) fn new(neighbours: &Neighbours, rank: &[u32]) -> Self {
        let mut first = vec![0];
        let mut columns = Vec::new();
        for node in 0..rank.len() as u32 {
            let own = rank[node as usize];
            if own != u32::MAX {
                let others = neighbours.of(node).iter().copied();
                let later = |n: &u32| rank[*n as usize] > own && rank[*n as usize] != u32::MAX;
                let mut row: Vec<u32> = others.filter(later).chain([node]).collect();
                row.sort_unstable_by_key(|other| rank[*other as usize]);
                columns.append(&mut row);
            }
            first.push(columns.len() as u32);
        }
        let blocks = vec![Mat3::zeros(); columns.len()];
        Self {
            first,
            columns,
            blocks,
            rank: rank.to_vec(),
        }
    }

    /// All blocks to zero.
    pub(super) fn clear(&mut self) {
        self.blocks.fill(Mat3::zeros());
    }

    /// Adds a block at (row, column), and so its transpose at (column, row); held nodes and pairs
    /// that were not announced are passed over.
    pub(super) fn add(&mut self, row: u32, column: u32, block: &Mat3) {
        let (row_rank, column_rank) = (self.rank[row as usize], self.rank[column as usize]);
        if row_rank == u32::MAX || column_rank == u32::MAX {
            return;
        }
        let turned = row_rank > column_rank;
        let (row, column) = if turned { (column, row) } else { (row, column) };
        let start = self.first[row as usize] as usize;
        let columns = &self.columns[start..self.first[row as usize + 1] as usize];
        if let Some(place) = columns.iter().position(|other| *other == column) {
            let target = &mut self.blocks[start + place];
            if turned {
                *target += block.transpose();
            } else {
                *target += block;
            }
        }
    }

    /// The matrix times moves: the forces that answer them [gf].
    pub(super) fn times(&self, moves: &[Vec3]) -> Vec<Vec3> {
        let mut forces = vec![Vec3::zeros(); moves.len()];
        for row in 0..moves.len() {
            let range = self.first[row] as usize..self.first[row + 1] as usize;
            let mut sum = Vec3::zeros();
            for (column, block) in self.columns[range.clone()].iter().zip(&self.blocks[range]) {
                let column = *column as usize;
                sum += block * moves[column];
                if column != row {
                    forces[column] += block.tr_mul(&moves[row]);
                }
            }
            forces[row] += sum;
        }
        forces
    }

    /// The later nodes that a node is joined with, itself first, and the blocks.
    pub(super) fn row(&self, node: u32) -> (&[u32], &[Mat3]) {
        let range = self.first[node as usize] as usize..self.first[node as usize + 1] as usize;
        (&self.columns[range.clone()], &self.blocks[range])
    }
}
