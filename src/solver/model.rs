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

#[cfg(test)]
mod tests {
    use super::{
        super::{
            dissection::{Neighbours, dissect},
            factor::Plan,
            leader::Way,
            stiffness::Pattern,
        },
        *,
    };
    use crate::math::{Mat3, Vec2};
    use std::sync::Arc;

    const NODES: u32 = 30;

    /// A chain of nodes, each drawn to the next and by `ground` [gf/cm] to where it is.
    fn chain(ground: f64) -> (Way, Stiffness) {
        let pairs: Vec<[u32; 2]> = (1..NODES).map(|node| [node - 1, node]).collect();
        let neighbours = Neighbours::new(NODES as usize, &pairs);
        let pattern = Arc::new(Pattern::new(&neighbours, &[false; NODES as usize]));
        let places: Vec<Vec2> = (0..NODES).map(|k| Vec2::new(f64::from(k), 0.0)).collect();
        let parts = dissect((0..NODES).collect(), &places, &neighbours);
        let plan = Plan::new(parts, &neighbours, NODES as usize);
        let mut matrix = Stiffness::new(pattern);
        let spring = Mat3::new(2.0, 0.5, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 3.0);
        for [a, b] in pairs {
            matrix.add(a, a, &spring);
            matrix.add(b, b, &spring);
            matrix.add(a, b, &-spring);
        }
        for node in 0..NODES {
            matrix.add(node, node, &(Mat3::identity() * ground));
        }
        (Way::Factors(Arc::new(plan)), matrix)
    }

    fn forces() -> Vec<Vec3> {
        let force =
            |node: u32| Vec3::from_fn(|axis, _| libm::sin(f64::from(3 * node) + axis as f64));
        (0..NODES).map(force).collect()
    }

    #[test]
    fn moves_answer_the_exact_stiffness_whatever_leads() {
        let ((way, positive), (_, exact)) = (chain(2.0), chain(0.01));
        let leader = Leader::new(&way, &positive).unwrap();
        let Answer::Moves(moves) = exact_answer(&leader, &exact, &forces()) else {
            panic!("it is positive");
        };
        for (push, force) in exact.times(&moves).iter().zip(forces()) {
            assert!((push - force).norm() < 1e-3, "{push} {force}");
        }
    }

    #[test]
    fn a_negative_direction_is_found_and_is_one() {
        let ((way, positive), (_, exact)) = (chain(1.0), chain(-0.02));
        let leader = Leader::new(&way, &positive).unwrap();
        let Answer::WayOut(out) = exact_answer(&leader, &exact, &forces()) else {
            panic!("it is not positive");
        };
        assert!(dot(&out, &exact.times(&out)) < 0.0);
        // Where steps are cut short anyway, what is asked for still goes downhill.
        let moves = near_answer(&leader, &exact, &forces(), f64::INFINITY);
        assert!(dot(&moves, &forces()) > 0.0);
    }
}
