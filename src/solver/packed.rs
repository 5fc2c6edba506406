//! A matrix packed for the processor: eight rows side by side, so that what is done to one is done
//! to eight at once, and in the order in which rows are visited, so that memory is read as it lies.
//!
//! Each number is made of the same operations in the same order however many are taken at once.

use super::{
    number::Number,
    stiffness::{Pattern, Stiffness},
};
use crate::{
    lanes::{Simd, WIDEST, WithSimd, widest},
    math::{Mat3, Vec3},
    threads,
};
use core::ops::Range;
use std::sync::Arc;

/// No row, or no block, stands there.
const NONE: u32 = u32::MAX;
/// Eights that a thread takes at least.
const GRAIN: usize = 32;

/// Numbers side by side, one of each row.
type Eight<T> = [T; WIDEST];
/// The coordinates of eight moves or forces.
type Ways = [Eight<f64>; 3];

/// Where the blocks of a pattern stand: found once.
#[derive(Debug)]
pub(super) struct Layout {
    /// For each group of rows, its eights.
    groups: Vec<Range<usize>>,
    /// Rows of each eight.
    rows: Vec<Eight<u32>>,
    /// First entry of each eight, and one more.
    first: Vec<u32>,
    /// For each entry, the columns of its blocks and their places in the pattern.
    columns: Vec<Eight<u32>>,
    sources: Vec<Eight<u32>>,
}

impl Layout {
    /// Of groups of rows, no row in two.
    pub(super) fn new<'a>(pattern: &Pattern, groups: impl IntoIterator<Item = &'a [u32]>) -> Self {
        let mut layout = Self {
            groups: Vec::new(),
            rows: Vec::new(),
            first: vec![0],
            columns: Vec::new(),
            sources: Vec::new(),
        };
        for group in groups {
            let begin = layout.rows.len();
            for eight in group.chunks(WIDEST) {
                layout.add(pattern, eight);
            }
            layout.groups.push(begin..layout.rows.len());
        }
        layout
    }

    fn add(&mut self, pattern: &Pattern, eight: &[u32]) {
        let mut rows = [NONE; WIDEST];
        rows[..eight.len()].copy_from_slice(eight);
        let length = |row: &u32| pattern.row(*row as usize).len();
        for k in 0..eight.iter().map(length).max().unwrap_or(0) {
            let (mut columns, mut sources) = ([0; WIDEST], [NONE; WIDEST]);
            for (lane, row) in eight.iter().enumerate() {
                if let Some(column) = pattern.row(*row as usize).get(k) {
                    columns[lane] = *column;
                    sources[lane] = (pattern.range(*row as usize).start + k) as u32;
                }
            }
            self.columns.push(columns);
            self.sources.push(sources);
        }
        self.first.push(self.columns.len() as u32);
        self.rows.push(rows);
    }

    /// Calls `work` on each row of some eights, with its place in `ways`.
    fn each_row(&self, eights: Range<usize>, ways: &[Ways], mut work: impl FnMut(usize, Vec3)) {
        for (rows, ways) in self.rows[eights].iter().zip(ways) {
            for (lane, row) in rows.iter().enumerate() {
                if *row != NONE {
                    work(*row as usize, Vec3::from_fn(|axis, _| ways[axis][lane]));
                }
            }
        }
    }
}

/// Blocks in the order of a layout.
#[derive(Debug)]
pub(super) struct Packed<T> {
    layout: Arc<Layout>,
    blocks: Vec<[Eight<T>; 9]>,
}

impl<T: Number> Packed<T> {
    pub(super) fn new(layout: &Arc<Layout>, matrix: &Stiffness) -> Self {
        let mut blocks = vec![[[T::default(); WIDEST]; 9]; layout.sources.len()];
        threads::for_each_part(&mut blocks, GRAIN, |first, part| {
            for (sources, block) in layout.sources[first..].iter().zip(part) {
                for (lane, source) in sources.iter().enumerate() {
                    if *source != NONE {
                        set(block, lane, matrix.block(*source as usize));
                    }
                }
            }
        });
        Self {
            layout: Arc::clone(layout),
            blocks,
        }
    }

    /// The matrix times moves: the forces that answer them [gf].
    pub(super) fn times(&self, moves: &[Vec3]) -> Vec<Vec3> {
        let eights = 0..self.layout.rows.len();
        let products = self.each_eight(eights.clone(), moves, None);
        let mut forces = vec![Vec3::zeros(); moves.len()];
        self.layout
            .each_row(eights, &products, |row, force| forces[row] = force);
        forces
    }

    /// Moves each row of a group to its own equilibrium, by the inverses of its own blocks.
    pub(super) fn visit(
        &self,
        group: usize,
        inverses: &Inverses<T>,
        forces: &[Vec3],
        moves: &mut [Vec3],
    ) {
        let eights = self.layout.groups[group].clone();
        let ways = self.each_eight(eights.clone(), moves, Some((inverses, forces)));
        self.layout
            .each_row(eights, &ways, |row, way| moves[row] += way);
    }

    /// How many groups of rows there are.
    pub(super) fn groups(&self) -> usize {
        self.layout.groups.len()
    }

    /// For each eight its product with moves [gf], or what is answered to forces beyond that [cm].
    fn each_eight(
        &self,
        eights: Range<usize>,
        moves: &[Vec3],
        answer: Option<(&Inverses<T>, &[Vec3])>,
    ) -> Vec<Ways> {
        let mut ways = vec![[[0.0; WIDEST]; 3]; eights.len()];
        threads::for_each_part(&mut ways, GRAIN, |first, ways| {
            widest(Eights {
                packed: self,
                first: eights.start + first,
                moves,
                answer,
                ways,
            });
        });
        ways
    }

    /// The products of an eight of rows with moves.
    #[inline(always)]
    fn product(&self, eight: usize, moves: &[Vec3]) -> Ways {
        let entries = self.layout.first[eight] as usize..self.layout.first[eight + 1] as usize;
        let mut sum = [[0.0; WIDEST]; 3];
        for (columns, block) in self.layout.columns[entries.clone()]
            .iter()
            .zip(&self.blocks[entries])
        {
            let mut x = [[0.0; WIDEST]; 3];
            for (lane, column) in columns.iter().enumerate() {
                let way = &moves[*column as usize];
                for (axis, numbers) in x.iter_mut().enumerate() {
                    numbers[lane] = way[axis];
                }
            }
            let more = times(block, &x);
            for (sum, more) in sum.iter_mut().flatten().zip(more.iter().flatten()) {
                *sum += more;
            }
        }
        sum
    }
}

/// The inverses of the rows' own blocks, in the order of a layout [cm/gf].
#[derive(Debug)]
pub(super) struct Inverses<T>(Vec<[Eight<T>; 9]>);

impl<T: Number> Inverses<T> {
    /// `None` where a row's own block is not positive definite.
    pub(super) fn new(layout: &Layout, matrix: &Stiffness) -> Option<Self> {
        let eights = threads::map(layout.rows.len(), |eight| {
            let mut blocks = [[T::default(); WIDEST]; 9];
            for (lane, row) in layout.rows[eight].iter().enumerate() {
                if *row != NONE {
                    let own = matrix.diagonal(*row as usize)?.cholesky()?;
                    set(&mut blocks, lane, &own.inverse());
                }
            }
            Some(blocks)
        });
        eights.into_iter().collect::<Option<_>>().map(Self)
    }
}

fn set<T: Number>(blocks: &mut [Eight<T>; 9], lane: usize, block: &Mat3) {
    for (k, numbers) in blocks.iter_mut().enumerate() {
        numbers[lane] = T::of(block[(k / 3, k % 3)]);
    }
}

/// Eight blocks times eight vectors.
#[inline(always)]
fn times<T: Number>(blocks: &[Eight<T>; 9], x: &Ways) -> Ways {
    let mut y = [[0.0; WIDEST]; 3];
    for (row, y) in y.iter_mut().enumerate() {
        for (lane, y) in y.iter_mut().enumerate() {
            let part = |axis: usize| blocks[3 * row + axis][lane].number() * x[axis][lane];
            *y = part(0) + part(1) + part(2);
        }
    }
    y
}

/// Work on some eights.
struct Eights<'a, T> {
    packed: &'a Packed<T>,
    first: usize,
    moves: &'a [Vec3],
    answer: Option<(&'a Inverses<T>, &'a [Vec3])>,
    ways: &'a mut [Ways],
}

impl<T: Number> WithSimd for Eights<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (eight, ways) in (self.first..).zip(self.ways) {
            let product = self.packed.product(eight, self.moves);
            *ways = match self.answer {
                None => product,
                Some((inverses, forces)) => {
                    let rows = &self.packed.layout.rows[eight];
                    times(&inverses.0[eight], &beyond(forces, rows, &product))
                }
            };
        }
    }
}

/// What forces on rows [gf] are beyond a product; none where there is no row.
#[inline(always)]
fn beyond(forces: &[Vec3], rows: &Eight<u32>, product: &Ways) -> Ways {
    let mut left = [[0.0; WIDEST]; 3];
    for (lane, row) in rows.iter().enumerate() {
        if let Some(force) = forces.get(*row as usize) {
            for (axis, left) in left.iter_mut().enumerate() {
                left[lane] = force[axis] - product[axis][lane];
            }
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::{super::dissection::Neighbours, super::stiffness::Sum, *};
    use crate::lanes::OneByOne;

    const SIDE: u32 = 9;

    /// A sheet of nodes drawn to those beside and below them, two of them held; its free nodes as on a
    /// chess board, those of one colour sharing no block.
    fn sheet() -> (Stiffness, Vec<Vec<u32>>) {
        let count = SIDE * SIDE;
        let held: Vec<bool> = (0..count).map(|node| node == 0 || node == 40).collect();
        let beside = (0..count).filter(|node| node % SIDE > 0);
        let mut pairs: Vec<[u32; 2]> = beside.map(|node| [node - 1, node]).collect();
        pairs.extend((SIDE..count).map(|node| [node - SIDE, node]));
        let neighbours = Neighbours::new(count as usize, &pairs);
        let mut matrix = Sum::new(Pattern::new(&neighbours, &held).into());
        for (k, [a, b]) in (0..).zip(pairs) {
            let spring = Mat3::from_fn(|i, j| libm::cos(f64::from(k) + (i * j) as f64));
            let spring = spring * spring.transpose() + Mat3::identity();
            matrix.add(a, a, &spring);
            matrix.add(b, b, &spring);
            matrix.add(a, b, &-spring);
        }
        let free = (0..count).filter(|node| !held[*node as usize]);
        let (even, odd) = free.partition(|node| (node % SIDE + node / SIDE).is_multiple_of(2));
        (matrix.whole(), vec![even, odd])
    }

    fn packed<T: Number>(matrix: &Stiffness, groups: &[Vec<u32>]) -> Packed<T> {
        let layout = Layout::new(matrix.pattern(), groups.iter().map(Vec::as_slice));
        Packed::new(&layout.into(), matrix)
    }

    fn ways(phase: f64) -> Vec<Vec3> {
        let number = |node: u32, axis: usize| libm::sin(phase + f64::from(node) + axis as f64);
        let way = |node| Vec3::from_fn(|axis, _| number(node, axis));
        (0..SIDE * SIDE).map(way).collect()
    }

    #[test]
    fn a_packed_matrix_is_the_matrix() {
        let (matrix, groups) = sheet();
        let moves = ways(0.1);
        let expected = matrix.times(&moves);
        assert_eq!(packed::<f64>(&matrix, &groups).times(&moves), expected);
        let single = packed::<f32>(&matrix, &groups).times(&moves);
        for (one, other) in single.iter().zip(&expected) {
            assert!((one - other).norm() < 1e-6 * (1.0 + other.norm()));
        }
    }

    #[test]
    fn rows_that_share_no_block_are_in_equilibrium_after_a_visit() {
        let (matrix, groups) = sheet();
        let packed = packed::<f64>(&matrix, &groups);
        let inverses = Inverses::new(&packed.layout, &matrix).unwrap();
        let (forces, mut moves) = (ways(0.3), ways(0.7));
        for (number, group) in groups.iter().enumerate() {
            packed.visit(number, &inverses, &forces, &mut moves);
            let answered = matrix.times(&moves);
            for node in group {
                let left = forces[*node as usize] - answered[*node as usize];
                assert!(left.norm() < 1e-12, "{node}: {left}");
            }
        }
    }

    #[test]
    fn one_at_a_time_and_eight_give_the_same_bits() {
        let (matrix, groups) = sheet();
        let packed = packed::<f32>(&matrix, &groups);
        let moves = ways(0.2);
        let (mut one, mut eight) = (vec![[[0.0; WIDEST]; 3]; 10], vec![[[0.0; WIDEST]; 3]; 10]);
        let work = |ways| Eights {
            packed: &packed,
            first: 0,
            moves: &moves,
            answer: None,
            ways,
        };
        work(&mut one).with_simd(OneByOne);
        widest(work(&mut eight));
        assert_eq!(one, eight);
    }

    #[test]
    fn a_row_whose_own_block_is_not_positive_has_no_inverse() {
        let (mut matrix, groups) = sheet();
        let layout = Layout::new(matrix.pattern(), groups.iter().map(Vec::as_slice));
        assert!(Inverses::<f32>::new(&layout, &matrix).is_some());
        matrix.add_own(7, &(Mat3::identity() * -100.0));
        assert!(Inverses::<f32>::new(&layout, &matrix).is_none());
    }
}
