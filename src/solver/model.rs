//! The move that a quadratic model of the energy asks for: conjugate gradients on the exact
//! stiffness, which may have negative directions, led by a positive one (Steihaug 1983).

use super::{leader::Leader, stiffness::Stiffness};
use crate::math::Vec3;

/// Rounds at most.
const MOST_ROUNDS: usize = 2000;
/// What is left of the force, measured by what leads, when steps converge quadratically: its square.
const GOOD_ENOUGH: f64 = 1e-10;

/// What a model answers.
#[derive(Debug)]
pub(super) enum Answer {
    /// Moves of all nodes [cm].
    Moves(Vec<Vec3>),
    /// The stiffness is not positive: the energy falls, or rises too slowly to say so, along this.
    WayOut(Vec<Vec3>),
}

/// The moves that answer `forces` [gf] by the `exact` stiffness.
pub(super) fn exact_answer(leader: &Leader, exact: &Stiffness, forces: &[Vec3]) -> Answer {
    let mut moves = vec![Vec3::zeros(); forces.len()];
    let mut left = forces.to_vec();
    let mut way = leader.answer(&left);
    let mut product = dot(&left, &way);
    let begun = product;
    for _ in 0..MOST_ROUNDS {
        if product <= GOOD_ENOUGH * begun {
            return Answer::Moves(moves);
        }
        let push = exact.times(&way);
        let curvature = dot(&way, &push);
        if curvature.is_nan() || curvature <= 0.0 {
            break;
        }
        let part = product / curvature;
        add(&mut moves, &way, part);
        add(&mut left, &push, -part);
        let answer = leader.answer(&left);
        let next = dot(&left, &answer);
        let turn = next / product;
        for (way, answer) in way.iter_mut().zip(answer) {
            *way = answer + *way * turn;
        }
        product = next;
    }
    Answer::WayOut(way)
}

/// Rounds at most, and what may be left of the force, where steps are cut short anyway.
const FEW_ROUNDS: usize = 15;
const NEARLY: f64 = 1e-2;

/// Nearly the moves that answer `forces` [gf] by a stiffness that may have negative directions: the
/// search ends before one, and where moves have become longer than `far` [cm].
pub(super) fn near_answer(
    leader: &Leader,
    stiffness: &Stiffness,
    forces: &[Vec3],
    far: f64,
) -> Vec<Vec3> {
    let mut moves = vec![Vec3::zeros(); forces.len()];
    let mut left = forces.to_vec();
    let mut way = leader.answer(&left);
    let mut product = dot(&left, &way);
    let begun = product;
    for rounds in 1..=FEW_ROUNDS {
        let push = stiffness.times(&way);
        let curvature = dot(&way, &push);
        if curvature <= 0.0 {
            // The first way is downhill, whatever lies beyond.
            return if rounds == 1 { way } else { moves };
        }
        let part = product / curvature;
        add(&mut moves, &way, part);
        add(&mut left, &push, -part);
        let answer = leader.answer(&left);
        let next = dot(&left, &answer);
        if next <= NEARLY * begun || longest(&moves) > far {
            break;
        }
        let turn = next / product;
        for (way, answer) in way.iter_mut().zip(answer) {
            *way = answer + *way * turn;
        }
        product = next;
    }
    moves
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
