//! The move that a quadratic model of the energy asks for: conjugate gradients on the exact
//! stiffness, which may have negative directions, led by factors of a positive one (Steihaug 1983).

use super::{
    factor::{Factor, Plan},
    stiffness::Stiffness,
};
use crate::math::Vec3;

/// Rounds at most.
const MOST_ROUNDS: usize = 15;
/// What is left of the force, measured by the factors, when the model is good enough: its square.
const GOOD_ENOUGH: f64 = 1e-2;

/// What a model asks for.
#[derive(Debug)]
pub(super) struct Model {
    /// Moves of all nodes [cm].
    pub(super) moves: Vec<Vec3>,
    /// What the factors alone answer [cm].
    pub(super) first: Vec<Vec3>,
}

impl Model {
    /// The moves that answer `forces` [gf] by the `exact` stiffness, found with factors of a
    /// positive one; moves longer than `far` [cm] are not followed up.
    ///
    /// Where the exact stiffness has a negative direction, the search ends before it.
    pub(super) fn new(
        plan: &Plan,
        factor: &Factor,
        exact: &Stiffness,
        forces: &[Vec3],
        far: f64,
    ) -> Self {
        let mut moves = vec![Vec3::zeros(); forces.len()];
        let mut left = forces.to_vec();
        let first = factor.solve(plan, &left);
        let mut way = first.clone();
        let mut product = dot(&left, &way);
        let begun = product;
        for rounds in 1..=MOST_ROUNDS {
            let push = exact.times(&way);
            let curvature = dot(&way, &push);
            if curvature <= 0.0 {
                // The first way is downhill, whatever lies beyond.
                let moves = if rounds == 1 { way } else { moves };
                return Self { moves, first };
            }
            let part = product / curvature;
            add(&mut moves, &way, part);
            add(&mut left, &push, -part);
            let answer = factor.solve(plan, &left);
            let next = dot(&left, &answer);
            if next <= GOOD_ENOUGH * begun || longest(&moves) > far {
                return Self { moves, first };
            }
            let turn = next / product;
            for (way, answer) in way.iter_mut().zip(answer) {
                *way = answer + *way * turn;
            }
            product = next;
        }
        Self { moves, first }
    }
}

/// The longest of some moves [cm]; not a number where one of them is not.
pub(super) fn longest(moves: &[Vec3]) -> f64 {
    moves.iter().map(Vec3::norm).fold(
        0.0,
        |longest, way| if way <= longest { longest } else { way },
    )
}

fn add(sum: &mut [Vec3], ways: &[Vec3], part: f64) {
    for (sum, way) in sum.iter_mut().zip(ways) {
        *sum += way * part;
    }
}

fn dot(a: &[Vec3], b: &[Vec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}
