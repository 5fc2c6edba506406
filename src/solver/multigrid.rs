//! A matrix answered on ever coarser lattices at once (multigrid: Brandt 1977).
//!
//! 1. Each node in turn is moved to where its own 3×3 system (8) wants it: what differs from node to
//!    node is soon gone.
//! 2. What is left is smooth. It is summed up on every second node of every second row, where the
//!    matrix is `Pᵀ A P` with P the linear interpolation, and answered there in the same way.
//! 3. The answer is interpolated back, and the nodes are visited again in the opposite order, so
//!    that the whole is symmetric, as conjugate gradients need it.
//!
//! The work and the memory are a fixed number of blocks a node. Nodes of one colour share no
//! block, so the result has the same bits for any number of threads.

use super::{
    dissection::{Neighbours, dissect},
    factor::{Factor, Plan},
    packed::{Inverses, Layout, Packed},
    stiffness::{Pattern, Stiffness},
};
use crate::{
    math::{Vec2, Vec3},
    threads,
};
use std::{collections::BTreeMap, sync::Arc};

/// A lattice of at most so many nodes is answered by its factors.
const COARSEST: usize = 300;
/// A lattice that keeps more than this part of its nodes is not worth a level of its own.
const WORTH_IT: f64 = 0.7;

/// Which levels there are, and what joins them: found once for a lattice.
#[derive(Debug)]
pub(super) struct Levels {
    steps: Vec<Step>,
    coarsest: Plan,
}

/// A level and the way to the next coarser one.
#[derive(Debug)]
struct Step {
    /// Free nodes by colours.
    layout: Arc<Layout>,
    /// Each node's parents on the coarser level, and their parts of it.
    parents: Lists,
    /// The same by parents.
    children: Lists,
    /// Which blocks the coarser level has.
    coarser: Arc<Pattern>,
}

/// For each node, others and their weights [-].
#[derive(Debug)]
struct Lists {
    first: Vec<u32>,
    entries: Vec<(u32, f64)>,
}

impl Lists {
    fn new(lists: impl IntoIterator<Item = Vec<(u32, f64)>>) -> Self {
        let mut first = vec![0];
        let mut entries = Vec::new();
        for mut list in lists {
            entries.append(&mut list);
            first.push(entries.len() as u32);
        }
        Self { first, entries }
    }

    fn of(&self, node: usize) -> &[(u32, f64)] {
        &self.entries[self.first[node] as usize..self.first[node + 1] as usize]
    }

    /// The lists turned round, for `count` others.
    fn turned(&self, count: usize) -> Self {
        let mut lists = vec![Vec::new(); count];
        for node in 0..self.first.len() - 1 {
            for (other, weight) in self.of(node) {
                lists[*other as usize].push((node as u32, *weight));
            }
        }
        Self::new(lists)
    }

    /// Values of the others, weighted and summed for each node.
    fn sum(&self, values: &[Vec3]) -> Vec<Vec3> {
        threads::map(self.first.len() - 1, |node| {
            let mut sum = Vec3::zeros();
            for (other, weight) in self.of(node) {
                sum += values[*other as usize] * *weight;
            }
            sum
        })
    }
}

impl Levels {
    /// Of a lattice's nodes by their places on its grid, and the blocks between them.
    pub(super) fn new(grid: &[[i32; 2]], pattern: &Arc<Pattern>) -> Self {
        let mut steps: Vec<Step> = Vec::new();
        let mut grid = grid.to_vec();
        let mut pattern = Arc::clone(pattern);
        while grid.len() > COARSEST {
            let (coarse, parents) = coarsen(&grid, &pattern);
            if coarse.is_empty() || coarse.len() as f64 > WORTH_IT * grid.len() as f64 {
                break;
            }
            let children = parents.turned(coarse.len());
            let coarser = Arc::new(joined(&pattern, &parents, &children));
            let colours = colours(&pattern);
            steps.push(Step {
                layout: Layout::new(&pattern, colours.iter().map(Vec::as_slice)).into(),
                parents,
                children,
                coarser: Arc::clone(&coarser),
            });
            (grid, pattern) = (coarse, coarser);
        }
        let place = |at: &[i32; 2]| Vec2::new(f64::from(at[0]), f64::from(at[1]));
        let places: Vec<Vec2> = grid.iter().map(place).collect();
        let neighbours = Neighbours::new(grid.len(), &pattern.pairs());
        let free = (0..grid.len() as u32)
            .filter(|node| !pattern.row(*node as usize).is_empty())
            .collect();
        let parts = dissect(free, &places, &neighbours);
        Self {
            steps,
            coarsest: Plan::new(parts, &neighbours, grid.len()),
        }
    }
}

/// The next coarser grid, and each node's parents there.
fn coarsen(grid: &[[i32; 2]], pattern: &Pattern) -> (Vec<[i32; 2]>, Lists) {
    let even = grid
        .iter()
        .filter(|at| at[0].rem_euclid(2) == 0 && at[1].rem_euclid(2) == 0);
    let mut coarse: Vec<[i32; 2]> = even.map(|at| at.map(|k| k.div_euclid(2))).collect();
    coarse.sort_unstable_by_key(|at| [at[1], at[0]]);
    let numbers: BTreeMap<[i32; 2], u32> = coarse.iter().copied().zip(0..).collect();
    let parents = grid.iter().enumerate().map(|(node, at)| {
        if pattern.row(node).is_empty() {
            return Vec::new();
        }
        let [along, across] = at.map(|k| [k.div_euclid(2), (k + 1).div_euclid(2)]);
        let places = across.map(|j| along.map(|i| [i, j])).concat();
        let mut list: Vec<(u32, f64)> = Vec::new();
        for place in places {
            let Some(&number) = numbers.get(&place) else {
                continue;
            };
            match list.iter_mut().find(|(other, _)| *other == number) {
                Some((_, weight)) => *weight += 0.25,
                None => list.push((number, 0.25)),
            }
        }
        let whole: f64 = list.iter().map(|(_, weight)| weight).sum();
        for (_, weight) in &mut list {
            *weight /= whole;
        }
        list
    });
    let parents = Lists::new(parents);
    (coarse, parents)
}

/// Which coarse nodes share a block: those with children that do.
fn joined(pattern: &Pattern, parents: &Lists, children: &Lists) -> Pattern {
    let count = children.first.len() - 1;
    let mut pairs = Vec::new();
    for node in 0..count {
        let own = children.of(node).iter();
        let beside = own.flat_map(|(child, _)| pattern.row(*child as usize));
        let others = beside.flat_map(|other| parents.of(*other as usize));
        let mut later: Vec<u32> = others
            .map(|(other, _)| *other)
            .filter(|other| *other as usize > node)
            .collect();
        later.sort_unstable();
        later.dedup();
        pairs.extend(later.into_iter().map(|other| [node as u32, other]));
    }
    let idle: Vec<bool> = (0..count)
        .map(|node| children.of(node).is_empty())
        .collect();
    Pattern::new(&Neighbours::new(count, &pairs), &idle)
}

/// Free nodes in sets that share no block, each node in the first that takes it.
fn colours(pattern: &Pattern) -> Vec<Vec<u32>> {
    let mut colour = vec![usize::MAX; pattern.len()];
    let mut colours: Vec<Vec<u32>> = Vec::new();
    for node in 0..pattern.len() {
        let row = pattern.row(node);
        if row.is_empty() {
            continue;
        }
        let taken = |k: &usize| row.iter().any(|other| colour[*other as usize] == *k);
        let own = (0..).find(|k| !taken(k)).unwrap_or(colours.len());
        if own == colours.len() {
            colours.push(Vec::new());
        }
        colours[own].push(node as u32);
        colour[node] = own;
    }
    colours
}

/// A positive matrix on one level: single precision is enough to lead by.
#[derive(Debug)]
struct Visits {
    matrix: Packed<f32>,
    /// Inverse of each node's own block [cm/gf].
    inverses: Inverses<f32>,
}

impl Visits {
    /// Of a matrix; `None` where it is not positive definite.
    fn new(step: &Step, matrix: &Stiffness) -> Option<Self> {
        Some(Self {
            inverses: Inverses::new(&step.layout, matrix)?,
            matrix: Packed::new(&step.layout, matrix),
        })
    }

    /// Visits the nodes, has what is left answered by `below`, and visits them in the opposite order.
    fn answer(
        &self,
        step: &Step,
        forces: &[Vec3],
        below: impl FnOnce(&[Vec3]) -> Vec<Vec3>,
    ) -> Vec<Vec3> {
        let Self { matrix, inverses } = self;
        let mut moves = vec![Vec3::zeros(); forces.len()];
        for colour in 0..matrix.groups() {
            matrix.visit(colour, inverses, forces, &mut moves);
        }
        let mut left = matrix.times(&moves);
        for (left, force) in left.iter_mut().zip(forces) {
            *left = force - *left;
        }
        let coarse = below(&step.children.sum(&left));
        for (way, more) in moves.iter_mut().zip(step.parents.sum(&coarse)) {
            *way += more;
        }
        for colour in (0..matrix.groups()).rev() {
            matrix.visit(colour, inverses, forces, &mut moves);
        }
        moves
    }
}

/// A positive matrix on all levels.
#[derive(Debug)]
pub(super) struct Multigrid {
    /// On the finest level; `None` where the smooth part of an answer is enough.
    finest: Option<Visits>,
    /// On the levels below, but the coarsest.
    coarser: Vec<Visits>,
    coarsest: Factor<f64>,
}

impl Multigrid {
    /// Of a matrix; `None` where it is not positive definite.
    pub(super) fn new(levels: &Levels, matrix: &Stiffness) -> Option<Self> {
        let mut multigrid = Self::smooth(levels, matrix)?;
        if let Some(step) = levels.steps.first() {
            multigrid.finest = Some(Visits::new(step, matrix)?);
        }
        Some(multigrid)
    }

    /// Of a matrix, summed up on the coarser levels alone; `None` where it is not positive definite
    /// there.
    pub(super) fn smooth(levels: &Levels, finest: &Stiffness) -> Option<Self> {
        let mut coarser = Vec::new();
        let mut summed: Option<Stiffness> = None;
        for (number, step) in levels.steps.iter().enumerate() {
            let matrix = summed.as_ref().unwrap_or(finest);
            if number > 0 {
                coarser.push(Visits::new(step, matrix)?);
            }
            summed = Some(summed_up(step, matrix));
        }
        Some(Self {
            finest: None,
            coarser,
            coarsest: Factor::new(&levels.coarsest, summed.as_ref().unwrap_or(finest))?,
        })
    }

    /// About the moves [cm] that answer forces [gf], or what there is of them that is smooth; held nodes
    /// stay.
    pub(super) fn answer(&self, levels: &Levels, forces: &[Vec3]) -> Vec<Vec3> {
        let below = |forces: &[Vec3]| self.answer_below(levels, 1, forces);
        match (levels.steps.first(), &self.finest) {
            (None, _) => below(forces),
            (Some(step), None) => step.parents.sum(&below(&step.children.sum(forces))),
            (Some(step), Some(finest)) => finest.answer(step, forces, below),
        }
    }

    /// The same on a coarser level, from 1 on.
    fn answer_below(&self, levels: &Levels, number: usize, forces: &[Vec3]) -> Vec<Vec3> {
        match self.coarser.get(number - 1) {
            None => self.coarsest.solve(&levels.coarsest, forces),
            Some(visits) => visits.answer(&levels.steps[number], forces, |left| {
                self.answer_below(levels, number + 1, left)
            }),
        }
    }
}

/// `Pᵀ A P`, row by row of the coarser level.
fn summed_up(step: &Step, finer: &Stiffness) -> Stiffness {
    Stiffness::of_rows(Arc::clone(&step.coarser), |row, blocks| {
        let columns = step.coarser.row(row);
        for (child, part) in step.children.of(row) {
            let (others, fine) = finer.row(*child as usize);
            for (other, block) in others.iter().zip(fine) {
                for (parent, weight) in step.parents.of(*other as usize) {
                    if let Some(place) = columns.iter().position(|column| column == parent) {
                        blocks[place] += block * (part * weight);
                    }
                }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::{super::stiffness::Sum, *};
    use crate::math::Mat3;

    /// A sheet of nodes that are drawn to their four neighbours as `springs` say along x and y, and
    /// a little to the ground; some are held, and a hole is left.
    fn sheet(side: i32, springs: [Mat3; 2]) -> (Levels, Stiffness) {
        let in_hole = |i: i32, j: i32| 3 * i > side && 2 * i < side && 3 * j > side && 2 * j < side;
        let mut grid: Vec<[i32; 2]> = Vec::new();
        for j in 0..side {
            grid.extend((0..side).filter(|i| !in_hole(*i, j)).map(|i| [i - 3, j]));
        }
        let number: BTreeMap<[i32; 2], u32> = grid.iter().copied().zip(0..).collect();
        let mut pairs = Vec::new();
        for ([i, j], a) in &number {
            for (axis, next) in [[i + 1, *j], [*i, j + 1]].iter().enumerate() {
                pairs.extend(number.get(next).map(|b| (axis, [*a, *b])));
            }
        }
        let both: Vec<[u32; 2]> = pairs.iter().map(|(_, pair)| *pair).collect();
        let held: Vec<bool> = grid.iter().map(|at| at[1] == 0 && at[0] % 7 == 0).collect();
        let pattern = Arc::new(Pattern::new(&Neighbours::new(grid.len(), &both), &held));
        let levels = Levels::new(&grid, &pattern);
        let mut matrix = Sum::new(pattern);
        for (axis, [a, b]) in pairs {
            let spring = &springs[axis];
            matrix.add(a, a, spring);
            matrix.add(b, b, spring);
            matrix.add(a, b, &-spring);
        }
        for node in 0..grid.len() as u32 {
            matrix.add(node, node, &(Mat3::identity() * 1e-4));
        }
        (levels, matrix.whole())
    }

    /// Some numbers for every free node.
    fn numbers(matrix: &Stiffness, seed: f64) -> Vec<Vec3> {
        let number = |node: usize, axis: usize| libm::sin(seed + (3 * node + axis) as f64 * 1.9);
        (0..matrix.pattern().len())
            .map(|node| match matrix.diagonal(node) {
                Some(_) => Vec3::from_fn(|axis, _| number(node, axis)),
                None => Vec3::zeros(),
            })
            .collect()
    }

    fn dot(a: &[Vec3], b: &[Vec3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
    }

    /// The greatest part of an error, in energy, that one answer leaves, by the power method.
    fn left_over(levels: &Levels, matrix: &Stiffness) -> f64 {
        let multigrid = Multigrid::new(levels, matrix).unwrap();
        let mut error = numbers(matrix, 0.3);
        let mut part = 0.0;
        for _ in 0..30 {
            let size = dot(&error, &matrix.times(&error)).sqrt();
            for way in &mut error {
                *way /= size;
            }
            let answer = multigrid.answer(levels, &matrix.times(&error));
            for (way, answer) in error.iter_mut().zip(answer) {
                *way -= answer;
            }
            part = dot(&error, &matrix.times(&error)).sqrt();
        }
        part
    }

    #[test]
    fn a_finer_sheet_is_answered_as_well_as_a_coarse_one() {
        let springs = [Mat3::new(3.0, 1.0, 0.0, 1.0, 2.0, 0.5, 0.0, 0.5, 1.0); 2];
        for side in [31, 62, 124] {
            let (levels, matrix) = sheet(side, springs);
            let part = left_over(&levels, &matrix);
            // Brandt's rule for two visits a level: a fifth or so; holes and holds cost a little.
            assert!(part < 0.4, "{side}: {part}");
        }
    }

    #[test]
    fn answers_to_stiff_and_soft_directions_are_symmetric_and_positive() {
        let stiff = |axis: usize| {
            Mat3::from_diagonal(&Vec3::from_fn(|k, _| if k == axis { 1e4 } else { 1.0 }))
        };
        let (levels, matrix) = sheet(50, [stiff(0), stiff(1)]);
        let multigrid = Multigrid::new(&levels, &matrix).unwrap();
        let (x, y) = (numbers(&matrix, 0.1), numbers(&matrix, 0.7));
        let (of_x, of_y) = (multigrid.answer(&levels, &x), multigrid.answer(&levels, &y));
        let (one, other) = (dot(&x, &of_y), dot(&y, &of_x));
        assert!(
            (one - other).abs() <= 1e-9 * dot(&x, &of_x),
            "{one} and {other}"
        );
        assert!(left_over(&levels, &matrix) < 1.0);
    }

    #[test]
    fn a_small_sheet_is_answered_exactly() {
        let (levels, matrix) = sheet(14, [Mat3::identity(); 2]);
        let multigrid = Multigrid::new(&levels, &matrix).unwrap();
        let moves = numbers(&matrix, 0.4);
        let answer = multigrid.answer(&levels, &matrix.times(&moves));
        for (found, expected) in answer.iter().zip(&moves) {
            assert!((found - expected).norm() < 1e-9);
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_has_no_answer() {
        let (levels, mut matrix) = sheet(40, [Mat3::identity(); 2]);
        assert!(Multigrid::new(&levels, &matrix).is_some());
        matrix.add_own(5, &(Mat3::identity() * -1e3));
        assert!(Multigrid::new(&levels, &matrix).is_none());
        matrix.add_own(5, &Mat3::repeat(f64::NAN));
        assert!(Multigrid::new(&levels, &matrix).is_none());
    }

    #[cfg(feature = "threads")]
    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let (levels, matrix) = sheet(70, [Mat3::identity(); 2]);
        let forces = numbers(&matrix, 0.2);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let answer = || {
                let multigrid = Multigrid::new(&levels, &matrix).unwrap();
                multigrid.answer(&levels, &forces)
            };
            let moves = pool.unwrap().install(answer);
            let bits = moves.iter().flatten().map(|number| number.to_bits());
            bits.collect::<Vec<u64>>()
        };
        assert!(on(1) == on(3));
    }
}
