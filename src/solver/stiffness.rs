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
    /// For each row, the place of its node's own block.
    own: Vec<u32>,
    /// For each place before that in a row, the place of the same pair in the other's row.
    mirror: Vec<u32>,
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
                // A cell of three nodes joins one of them with itself.
                row.dedup();
                columns.append(&mut row);
            }
            first.push(columns.len() as u32);
        }
        let mut pattern = Self {
            first,
            columns,
            own: Vec::new(),
            mirror: Vec::new(),
        };
        pattern.find_mirrors();
        pattern
    }

    fn find_mirrors(&mut self) {
        let own = |row: usize| {
            let before = self
                .row(row)
                .partition_point(|column| (*column as usize) < row);
            self.first[row] + before as u32
        };
        self.own = (0..self.len()).map(own).collect();
        // Rows in order meet the places after each node's own block in order.
        let mut next: Vec<u32> = self.own.iter().map(|own| own + 1).collect();
        let mut mirror = Vec::new();
        for row in 0..self.len() {
            for place in self.first[row]..self.own[row] {
                let other = self.columns[place as usize] as usize;
                mirror.push(next[other]);
                next[other] += 1;
            }
        }
        self.mirror = mirror;
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

    /// Where a block on or above the diagonal stands.
    fn place(&self, row: u32, column: u32) -> Option<usize> {
        let from = self.own[row as usize] as usize;
        let later = &self.columns[from..self.first[row as usize + 1] as usize];
        let place = later.iter().position(|other| *other == column)?;
        Some(from + place)
    }
}

/// A symmetric matrix that is summed up: its blocks on and above the diagonal.
#[derive(Debug)]
pub(super) struct Sum(Stiffness);

impl Sum {
    /// An empty matrix.
    pub(super) fn new(pattern: Arc<Pattern>) -> Self {
        Self(Stiffness {
            blocks: vec![Mat3::zeros(); pattern.columns.len()],
            pattern,
        })
    }

    /// Adds a block at (row, column), and so its transpose at (column, row); held nodes and pairs
    /// that were not announced are passed over.
    pub(super) fn add(&mut self, row: u32, column: u32, block: &Mat3) {
        let Self(matrix) = self;
        if row <= column {
            if let Some(place) = matrix.pattern.place(row, column) {
                matrix.blocks[place] += block;
            }
        } else if let Some(place) = matrix.pattern.place(column, row) {
            matrix.blocks[place] += block.transpose();
        }
    }

    /// The whole matrix.
    pub(super) fn whole(self) -> Stiffness {
        let Self(mut matrix) = self;
        let pattern = Arc::clone(&matrix.pattern);
        let mut mirrors = pattern.mirror.iter();
        for row in 0..pattern.len() {
            for place in pattern.first[row]..pattern.own[row] {
                let Some(other) = mirrors.next() else { break };
                matrix.blocks[place as usize] = matrix.blocks[*other as usize].transpose();
            }
        }
        matrix
    }
}

/// Blocks of a symmetric matrix, all of each row.
#[derive(Clone, Debug)]
pub(super) struct Stiffness {
    pattern: Arc<Pattern>,
    blocks: Vec<Mat3>,
}

impl Stiffness {
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

    /// Adds a block to a node's own; a held node is passed over.
    pub(super) fn add_own(&mut self, node: usize, block: &Mat3) {
        if let Some(place) = self.pattern.place(node as u32, node as u32) {
            self.blocks[place] += block;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_is_whole_on_both_sides_where_a_pair_joins_a_node_with_itself_and_one_is_held() {
        let pairs = [[0, 1], [0, 3], [1, 1], [1, 2], [1, 3], [2, 3]];
        let neighbours = Neighbours::new(4, &pairs);
        let pattern = Arc::new(Pattern::new(&neighbours, &[false, false, true, false]));
        assert_eq!(pattern.row(1), [0, 1, 3]);
        let block = |k: u32| Mat3::from_fn(|i, j| f64::from(9 * k) + (3 * i + j) as f64);
        let mut sum = Sum::new(pattern);
        for (k, [row, column]) in (0..).zip([[0, 0], [0, 1], [3, 0], [3, 1], [1, 1], [1, 2]]) {
            sum.add(row, column, &block(k));
        }
        let whole = sum.whole();
        let (zero, one, three) = (whole.row(0), whole.row(1), whole.row(3));
        assert_eq!(zero.1, [block(0), block(1), block(2).transpose()]);
        assert_eq!(
            one.1,
            [block(1).transpose(), block(4), block(3).transpose()]
        );
        assert_eq!(three.1, [block(2), block(3), Mat3::zeros()]);
        assert!(whole.row(2).0.is_empty());
    }
}
