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
    number::Number,
    stiffness::Stiffness,
    substitution::substitute,
};
use crate::{math::Vec3, threads};

/// What each part eliminates and touches: found once for a lattice.
#[derive(Debug)]
pub(super) struct Plan {
    root: Front,
    /// Place of each node in the order of elimination; `u32::MAX` for held ones.
    rank: Vec<u32>,
}

#[derive(Debug)]
pub(super) struct Front {
    /// Nodes eliminated here, then the border, each in order of elimination.
    pub(super) nodes: Vec<u32>,
    /// How many of them are eliminated here.
    pub(super) own: usize,
    /// For each half, where its border stands in `nodes`.
    pub(super) halves: Vec<(Self, Vec<u32>)>,
}

/// A factored system, in numbers of 64 bits, or of 32 where what it says is only to lead.
#[derive(Debug)]
pub(super) struct Factor<T> {
    root: Factored<T>,
}

#[derive(Debug)]
pub(super) struct Factored<T> {
    /// Columns of L of the front's own nodes, over all its nodes (column-major); and after them, until
    /// the part above has taken it, what is left of the border.
    pub(super) columns: Vec<T>,
    pub(super) halves: Vec<Self>,
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
    some.iter().map(|node| place(*node, all, rank)).collect()
}

fn place(node: u32, all: &[u32], rank: &[u32]) -> u32 {
    all.partition_point(|other| rank[*other as usize] < rank[node as usize]) as u32
}

impl<T: Number> Factor<T> {
    /// Factors a stiffness; `None` where it is not positive definite.
    pub(super) fn new(plan: &Plan, stiffness: &Stiffness) -> Option<Self> {
        let root = factor(&plan.root, stiffness, &plan.rank)?;
        Some(Self { root })
    }

    /// Solves for the moves [cm] that answer the forces [gf]; held nodes stay.
    pub(super) fn solve(&self, plan: &Plan, forces: &[Vec3]) -> Vec<Vec3> {
        substitute(&plan.root, &self.root, forces)
    }
}

/// Factors one front, and leaves the Schur complement of its border for the part above.
fn factor<T: Number>(front: &Front, stiffness: &Stiffness, rank: &[u32]) -> Option<Factored<T>> {
    let mut halves = factor_halves(&front.halves, stiffness, rank)?;
    let order = 3 * front.nodes.len();
    let own = 3 * front.own;
    let mut matrix = vec![T::default(); order * order];
    assemble(front, stiffness, rank, &mut matrix);
    for ((half, places), factored) in front.halves.iter().zip(&mut halves) {
        let (order_below, own_below) = (3 * half.nodes.len(), 3 * half.own);
        let rest = Rest {
            matrix: &factored.columns,
            order: order_below,
            own: own_below,
        };
        rest.add_to(&mut matrix, order, places);
        factored.columns.truncate(order_below * own_below);
        factored.columns.shrink_to_fit();
    }
    dense::factor(&mut matrix, order, own).then_some(Factored {
        columns: matrix,
        halves,
    })
}

fn factor_halves<T: Number>(
    halves: &[(Front, Vec<u32>)],
    stiffness: &Stiffness,
    rank: &[u32],
) -> Option<Vec<Factored<T>>> {
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
fn assemble<T: Number>(front: &Front, stiffness: &Stiffness, rank: &[u32], matrix: &mut [T]) {
    let order = 3 * front.nodes.len();
    for (column, &node) in front.nodes[..front.own].iter().enumerate() {
        let (others, blocks) = stiffness.row(node as usize);
        for (other, block) in others.iter().zip(blocks) {
            if rank[*other as usize] < rank[node as usize] {
                continue;
            }
            let row = place(*other, &front.nodes, rank) as usize;
            for c in 0..3 {
                for r in 0..3 {
                    // Blocks stand at (earlier, later); the lower half wants (later, earlier).
                    matrix[(3 * column + c) * order + 3 * row + r] += T::of(block[(c, r)]);
                }
            }
        }
    }
}

/// What a half leaves over: the Schur complement of its border, behind its own columns.
struct Rest<'a, T> {
    matrix: &'a [T],
    order: usize,
    own: usize,
}

impl<T: Number> Rest<'_, T> {
    /// Adds it to the matrix of the front above, in which its nodes have these places.
    fn add_to(&self, matrix: &mut [T], order: usize, places: &[u32]) {
        // A front without nodes parts halves that share no force.
        let columns = self.matrix[self.own * self.order..].chunks_exact(self.order.max(1));
        for (j, column) in columns.enumerate() {
            let target = (3 * places[j / 3] as usize + j % 3) * order;
            let threes = column[self.own..].chunks_exact(3);
            for (place, three) in places.iter().zip(threes).skip(j / 3) {
                let at = target + 3 * *place as usize;
                for (entry, value) in matrix[at..at + 3].iter_mut().zip(three) {
                    *entry += *value;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::{
            dissection::dissect,
            stiffness::{Pattern, Sum},
        },
        *,
    };
    use crate::math::{Mat3, Vec2};
    use nalgebra::{DMatrix, DVector};
    use proptest::prelude::*;

    /// Numbers between −1 and 1 that look random (a multiplicative congruential generator).
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005) + 1;
            (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }

        fn is_below(&mut self, share: f64) -> bool {
            0.5 * (self.next() + 1.0) < share
        }

        fn block(&mut self) -> Mat3 {
            Mat3::from_fn(|_, _| self.next())
        }

        fn forces(&mut self, nodes: usize) -> Vec<Vec3> {
            (0..nodes)
                .map(|_| Vec3::from_fn(|_, _| self.next()))
                .collect()
        }
    }

    /// Nodes side by side, some of them held, and a positive definite matrix on them: a spring of
    /// random blocks between nodes at most two steps apart, and a soft one to the ground.
    struct System {
        plan: Plan,
        blocks: Vec<(u32, u32, Mat3)>,
        nodes: usize,
        neighbours: Neighbours,
    }

    impl System {
        /// `joined` and `held` are shares of all [-].
        fn new([wide, high]: [u32; 2], joined: f64, held: f64, seed: u64) -> Self {
            let mut numbers = Numbers(seed | 1);
            let nodes = (wide * high) as usize;
            let place = |node: u32| [node % wide, node / wide];
            let coordinates: Vec<Vec2> = (0..wide * high)
                .map(|node| place(node).map(f64::from))
                .map(|at| Vec2::from(at) + Vec2::new(numbers.next(), numbers.next()) * 0.3)
                .collect();
            let mut pairs = Vec::new();
            for a in 0..wide * high {
                for b in a + 1..wide * high {
                    let ([i, j], [k, l]) = (place(a), place(b));
                    if i.abs_diff(k) + j.abs_diff(l) <= 2 && numbers.is_below(joined) {
                        pairs.push([a, b]);
                    }
                }
            }
            let free = (0..wide * high)
                .filter(|_| !numbers.is_below(held))
                .collect();
            let neighbours = Neighbours::new(nodes, &pairs);
            let parts = dissect(free, &coordinates, &neighbours);
            let mut system = Self {
                plan: Plan::new(parts, &neighbours, nodes),
                blocks: Vec::new(),
                nodes,
                neighbours,
            };
            system.join(&pairs, &mut numbers);
            system
        }

        /// Springs `½·|p·u − q·v|²`, named in either order.
        fn join(&mut self, pairs: &[[u32; 2]], numbers: &mut Numbers) {
            for &[a, b] in pairs {
                let (p, q) = (numbers.block(), numbers.block());
                let between = -p.transpose() * q;
                self.blocks.push((a, a, p.transpose() * p));
                self.blocks.push((b, b, q.transpose() * q));
                self.blocks.push(if numbers.is_below(0.5) {
                    (a, b, between)
                } else {
                    (b, a, between.transpose())
                });
            }
            for node in 0..self.nodes as u32 {
                self.blocks.push((node, node, Mat3::identity() * 0.1));
            }
        }

        fn factor<T: Number>(&self) -> Option<Factor<T>> {
            let held: Vec<bool> = (0..self.nodes).map(|node| self.is_held(node)).collect();
            let pattern = Pattern::new(&self.neighbours, &held);
            let mut stiffness = Sum::new(pattern.into());
            for (row, column, block) in &self.blocks {
                stiffness.add(*row, *column, block);
            }
            Factor::new(&self.plan, &stiffness.whole())
        }

        /// The moves that answer forces.
        fn solve(&self, forces: &[Vec3]) -> Vec<Vec3> {
            self.factor::<f64>().unwrap().solve(&self.plan, forces)
        }

        fn is_held(&self, node: usize) -> bool {
            self.plan.rank[node] == u32::MAX
        }

        /// The whole matrix; held nodes have the identity.
        fn dense(&self) -> DMatrix<f64> {
            let mut whole = DMatrix::zeros(3 * self.nodes, 3 * self.nodes);
            for (row, column, block) in &self.blocks {
                let (r, c) = (*row as usize, *column as usize);
                if self.is_held(r) || self.is_held(c) {
                    continue;
                }
                let mut here = whole.fixed_view_mut::<3, 3>(3 * r, 3 * c);
                here += block;
                if r != c {
                    let mut mirror = whole.fixed_view_mut::<3, 3>(3 * c, 3 * r);
                    mirror += block.transpose();
                }
            }
            for node in (0..self.nodes).filter(|node| self.is_held(*node)) {
                whole
                    .fixed_view_mut::<3, 3>(3 * node, 3 * node)
                    .fill_with_identity();
            }
            whole
        }
    }

    fn systems() -> impl Strategy<Value = System> {
        let sizes = [1..14u32, 1..14];
        let joined = prop::sample::select(&[0.0, 0.2, 0.6, 1.0][..]);
        let held = prop::sample::select(&[0.0, 0.1, 0.7, 1.0][..]);
        (sizes, joined, held, any::<u64>())
            .prop_map(|(size, joined, held, seed)| System::new(size, joined, held, seed))
    }

    impl core::fmt::Debug for System {
        fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
            write!(f, "{} nodes, {} blocks", self.nodes, self.blocks.len())
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn moves_are_those_of_a_dense_factor_and_held_nodes_stay(
            system in systems(), seed in any::<u64>(),
        ) {
            let forces = Numbers(seed | 1).forces(system.nodes);
            let moves = system.solve(&forces);
            let mut sides = DVector::from_iterator(3 * system.nodes, forces.iter().flatten().copied());
            for node in (0..system.nodes).filter(|node| system.is_held(*node)) {
                sides.fixed_rows_mut::<3>(3 * node).fill(0.0);
                prop_assert_eq!(moves[node], Vec3::zeros());
            }
            let expected = system.dense().cholesky().unwrap().solve(&sides);
            let found = DVector::from_iterator(3 * system.nodes, moves.iter().flatten().copied());
            let error = (found - &expected).amax();
            prop_assert!(error <= 1e-10 * expected.amax(), "{error} of {}", expected.amax());
        }

        #[test]
        fn a_matrix_is_refused_just_where_it_stops_being_positive_definite(mut system in systems()) {
            let Some(free) = (0..system.nodes).find(|node| !system.is_held(*node)) else {
                return Ok(());
            };
            // Taking λ off one diagonal block makes it singular at λ = 1/greatest of the inverse's.
            let inverse = system.dense().cholesky().unwrap().inverse();
            let block = inverse.fixed_view::<3, 3>(3 * free, 3 * free).into_owned();
            let most = 1.0 / block.symmetric_eigenvalues().max();
            let free = free as u32;
            system.blocks.push((free, free, Mat3::identity() * (-most * (1.0 - 1e-6))));
            prop_assert!(system.factor::<f64>().is_some());
            system.blocks.push((free, free, Mat3::identity() * (-most * 2e-6)));
            prop_assert!(system.factor::<f64>().is_none());
            system.blocks.push((free, free, Mat3::repeat(f64::NAN)));
            prop_assert!(system.factor::<f64>().is_none());
        }
    }

    #[test]
    fn factors_in_32_bits_answer_as_those_in_64_but_for_their_rounding() {
        let system = System::new([30, 20], 1.0, 0.1, 5);
        let forces = Numbers(3).forces(system.nodes);
        let exact = system.solve(&forces);
        let rounded = system.factor::<f32>().unwrap();
        let most = exact.iter().map(Vec3::amax).fold(0.0, f64::max);
        let moves = rounded.solve(&system.plan, &forces);
        let error = exact.iter().zip(&moves).map(|(a, b)| (a - b).amax());
        let error = error.fold(0.0, f64::max) / most;
        assert!((1e-9..1e-3).contains(&error), "{error}");
    }

    /// Large enough that halves run side by side and the topmost front is shared out.
    #[cfg(feature = "threads")]
    #[test]
    fn one_thread_and_three_give_the_same_bits() {
        let system = System::new([56, 60], 1.0, 0.02, 7);
        let forces = Numbers(3).forces(system.nodes);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let moves = pool.unwrap().install(|| system.solve(&forces));
            let bits = moves.iter().flatten().map(|number| number.to_bits());
            bits.collect::<Vec<u64>>()
        };
        assert!(3 * system.plan.root.nodes.len() * 3 * system.plan.root.own > 1 << 15);
        assert!(on(1) == on(3));
    }
}
