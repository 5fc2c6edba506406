//! Substitution through the factors: up the tree of fronts with L, down it with Lᵀ. Halves are
//! independent and run side by side.

use super::{
    factor::{Factored, Front},
    number::Number,
};
use crate::{math::Vec3, threads};

/// The moves that answer forces; nodes without a rank stay.
pub(super) fn substitute<T: Number>(
    root: &Front,
    factored: &Factored<T>,
    forces: &[Vec3],
) -> Vec<Vec3> {
    let (solved, _) = forward(root, factored, forces);
    let mut moves = vec![Vec3::zeros(); forces.len()];
    backward(root, factored, solved, &[]).scatter(root, &mut moves);
    moves
}

/// Values of the front's own unknowns, and those of its halves.
struct Solved<T> {
    own: Vec<T>,
    halves: Vec<Self>,
}

impl<T: Number> Solved<T> {
    fn scatter(&self, front: &Front, moves: &mut [Vec3]) {
        for (node, three) in front.nodes[..front.own]
            .iter()
            .zip(self.own.chunks_exact(3))
        {
            moves[*node as usize] = Vec3::from_fn(|axis, _| three[axis].number());
        }
        for (half, (front, _)) in self.halves.iter().zip(&front.halves) {
            half.scatter(front, moves);
        }
    }
}

/// Fronts of more unknowns than this are shared out; waking another core for less costs more.
const SHARED: usize = 200;

/// Solves with L, from the leaves up; returns what is left over for the border as well.
fn forward<T: Number>(
    front: &Front,
    factored: &Factored<T>,
    forces: &[Vec3],
) -> (Solved<T>, Vec<T>) {
    let below = each_half(front, |k| {
        forward(&front.halves[k].0, &factored.halves[k], forces)
    });
    let order = 3 * front.nodes.len();
    let mut local = vec![T::default(); order];
    for (three, node) in local.chunks_exact_mut(3).zip(&front.nodes[..front.own]) {
        for (entry, force) in three.iter_mut().zip(&forces[*node as usize]) {
            *entry = T::of(*force);
        }
    }
    let mut halves = Vec::with_capacity(below.len());
    for ((solved, rest), (_, places)) in below.into_iter().zip(&front.halves) {
        for (place, three) in places.iter().zip(rest.chunks_exact(3)) {
            for (entry, value) in local[3 * *place as usize..].iter_mut().zip(three) {
                *entry += *value;
            }
        }
        halves.push(solved);
    }
    for (k, column) in factored.columns.chunks_exact(order.max(1)).enumerate() {
        let value = local[k] / column[k];
        local[k] = value;
        for (entry, factor) in local[k + 1..].iter_mut().zip(&column[k + 1..]) {
            *entry -= *factor * value;
        }
    }
    let rest = local.split_off(3 * front.own);
    (Solved { own: local, halves }, rest)
}

/// Solves with Lᵀ, from the root down; `border` has what the parts above came to.
fn backward<T: Number>(
    front: &Front,
    factored: &Factored<T>,
    solved: Solved<T>,
    border: &[T],
) -> Solved<T> {
    let order = 3 * front.nodes.len();
    let mut local = solved.own;
    local.extend_from_slice(border);
    let columns = factored.columns.chunks_exact(order.max(1));
    for (k, column) in columns.enumerate().rev() {
        let sum = local[k] - dot(&column[k + 1..], &local[k + 1..]);
        local[k] = sum / column[k];
    }
    let below: Vec<Solved<T>> = solved.halves;
    let borders: Vec<Vec<T>> = front
        .halves
        .iter()
        .map(|(_, places)| {
            let of = |place: &u32| local[3 * *place as usize..][..3].iter().copied();
            places.iter().flat_map(of).collect()
        })
        .collect();
    let mut below = below.into_iter();
    let halves = match (below.next(), below.next()) {
        (Some(one), Some(other)) if order > SHARED => {
            let descend = |k: usize, solved| {
                backward(&front.halves[k].0, &factored.halves[k], solved, &borders[k])
            };
            let (one, other) = threads::both(|| descend(0, one), || descend(1, other));
            vec![one, other]
        }
        (one, other) => {
            let all = one.into_iter().chain(other).enumerate();
            all.map(|(k, solved)| {
                backward(&front.halves[k].0, &factored.halves[k], solved, &borders[k])
            })
            .collect()
        }
    };
    local.truncate(3 * front.own);
    Solved { own: local, halves }
}

/// Does the same for each half of a front, side by side where that pays.
fn each_half<T: Send>(front: &Front, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    if front.halves.len() == 2 && 3 * front.nodes.len() > SHARED {
        let (one, other) = threads::both(|| work(0), || work(1));
        return vec![one, other];
    }
    (0..front.halves.len()).map(work).collect()
}

/// The product of two columns, in eight sums of fixed order: so that it streams.
fn dot<T: Number>(a: &[T], b: &[T]) -> T {
    let mut sums = [T::default(); 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let mut rest = T::default();
    for (a, b) in a.remainder().iter().zip(b.remainder()) {
        rest += *a * *b;
    }
    for (a, b) in a.zip(b) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += *a * *b;
        }
    }
    sums.into_iter().fold(T::default(), T::add) + rest
}
