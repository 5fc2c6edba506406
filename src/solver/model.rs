//! The move that a quadratic model of the energy asks for: conjugate gradients on the exact
//! stiffness, which may have negative directions, led by a positive one (Steihaug 1983).

use super::{leader::Leader, packed::Packed};
use crate::math::Vec3;

/// How far a search goes.
struct Limits {
    /// Rounds at most.
    rounds: usize,
    /// What may be left of the force, measured by what leads: its square, of what there was.
    left: f64,
    /// Moves longer than this are not followed up [cm].
    far: f64,
}

/// Rounds after which a search is given up.
const MANY_ROUNDS: usize = 2000;
/// What may be left of the force, by its square: steps far from rest are cut short anyway, those near
/// it shall converge fast, and where nothing is left the search for a way out has been thorough.
const ROUGHLY: f64 = 1e-3;
const EXACTLY: f64 = 1e-7;
const NOTHING: f64 = 1e-10;
/// The same where steps are cut short anyway: rounds at most, and what may be left.
const FEW_ROUNDS: usize = 15;
const NEARLY: f64 = 1e-2;
/// And where what leads is near to the exact stiffness.
const SOME_ROUNDS: usize = 30;
const WELL: f64 = 1e-4;

/// What a model answers.
#[derive(Debug)]
pub(super) enum Answer {
    /// Moves of all nodes [cm].
    Moves(Vec<Vec3>),
    /// Moves [cm] in the way of which the energy falls, and it is not known how far: they became too
    /// long, or met a direction in which it falls ever faster and go on along that.
    Downhill(Vec<Vec3>),
    /// So many rounds did not tell.
    Unclear,
}

/// The moves that answer `forces` [gf] by the `exact` stiffness, if none is longer than `far` [cm];
/// a `rough` answer is good enough where they are cut short.
pub(super) fn exact_answer(
    leader: &Leader,
    exact: &Packed<f64>,
    forces: &[Vec3],
    far: f64,
    rough: bool,
) -> Answer {
    let limits = Limits {
        rounds: MANY_ROUNDS,
        left: if rough { ROUGHLY } else { EXACTLY },
        far,
    };
    let mut found = search(leader, exact, forces, &limits);
    if let Some(way) = found.way_out {
        let part = far / longest(&way);
        add(&mut found.moves, &way, part);
        return Answer::Downhill(found.moves);
    }
    if !found.enough {
        Answer::Unclear
    } else if longest(&found.moves) > far {
        Answer::Downhill(found.moves)
    } else {
        Answer::Moves(found.moves)
    }
}

/// A direction in which the energy falls from a shape without forces, in moves of any length; `None`
/// where a search begun by `forces` meets none.
pub(super) fn way_out(leader: &Leader, exact: &Packed<f64>, forces: &[Vec3]) -> Option<Vec<Vec3>> {
    let limits = Limits {
        rounds: MANY_ROUNDS,
        left: NOTHING,
        far: f64::INFINITY,
    };
    search(leader, exact, forces, &limits).way_out
}

/// Nearly the moves that answer `forces` [gf] by a stiffness that may have negative directions: the
/// search ends before one, and where moves have become longer than `far` [cm].
pub(super) fn near_answer(
    leader: &Leader,
    stiffness: &Packed<f64>,
    forces: &[Vec3],
    far: f64,
) -> Vec<Vec3> {
    let limits = Limits {
        rounds: FEW_ROUNDS,
        left: NEARLY,
        far,
    };
    let found = search(leader, stiffness, forces, &limits);
    match found.way_out {
        // The first way is downhill, whatever lies beyond.
        Some(way) if found.rounds == 0 => way,
        _ => found.moves,
    }
}

/// Nearly the moves [cm] that answer `forces` [gf] by the `exact` stiffness, up to the trusted length
/// `far` [cm]; where the search meets a direction in which the energy falls ever faster, it ends so far
/// along that. Returns as well whether it met none.
pub(super) fn trusted_answer(
    leader: &Leader,
    exact: &Packed<f64>,
    forces: &[Vec3],
    far: f64,
) -> (Vec<Vec3>, bool) {
    let limits = Limits {
        rounds: SOME_ROUNDS,
        left: WELL,
        far,
    };
    let mut found = search(leader, exact, forces, &limits);
    if let Some(way) = &found.way_out {
        add(&mut found.moves, way, far / longest(way));
    }
    (found.moves, found.way_out.is_none())
}

/// What a search came to.
struct Found {
    moves: Vec<Vec3>,
    /// Rounds that the moves are of.
    rounds: usize,
    /// Whether so little is left as was asked for, or moves are as long.
    enough: bool,
    /// A direction of negative stiffness, if the search met one.
    way_out: Option<Vec<Vec3>>,
}

/// Conjugate gradients within limits.
fn search(leader: &Leader, stiffness: &Packed<f64>, forces: &[Vec3], limits: &Limits) -> Found {
    let mut found = Found {
        moves: vec![Vec3::zeros(); forces.len()],
        rounds: 0,
        enough: false,
        way_out: None,
    };
    let mut left = forces.to_vec();
    let mut way = leader.answer(&left);
    let mut product = dot(&left, &way);
    let begun = product;
    loop {
        found.enough = product <= limits.left * begun || longest(&found.moves) > limits.far;
        if found.enough || found.rounds == limits.rounds {
            return found;
        }
        let push = stiffness.times(&way);
        let curvature = dot(&way, &push);
        if curvature.is_nan() {
            return found;
        }
        if curvature <= 0.0 {
            found.way_out = Some(way);
            return found;
        }
        let part = product / curvature;
        add(&mut found.moves, &way, part);
        add(&mut left, &push, -part);
        let answer = leader.answer(&left);
        let next = dot(&left, &answer);
        let turn = next / product;
        for (way, answer) in way.iter_mut().zip(answer) {
            *way = answer + *way * turn;
        }
        product = next;
        found.rounds += 1;
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

#[cfg(test)]
mod tests {
    use super::{
        super::{
            dissection::{Neighbours, dissect},
            factor::Plan,
            leader::Way,
            packed::Layout,
            stiffness::{Pattern, Stiffness, Sum},
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
        let mut matrix = Sum::new(pattern);
        let spring = Mat3::new(2.0, 0.5, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 3.0);
        for [a, b] in pairs {
            matrix.add(a, a, &spring);
            matrix.add(b, b, &spring);
            matrix.add(a, b, &-spring);
        }
        for node in 0..NODES {
            matrix.add(node, node, &(Mat3::identity() * ground));
        }
        (Way::Factors(Arc::new(plan)), matrix.whole())
    }

    fn packed(matrix: &Stiffness) -> Packed<f64> {
        let rows: Vec<u32> = (0..NODES).collect();
        let layout = Layout::new(matrix.pattern(), [rows.as_slice()]);
        Packed::new(&layout.into(), matrix)
    }

    fn forces() -> Vec<Vec3> {
        let force =
            |node: u32| Vec3::from_fn(|axis, _| libm::sin(f64::from(3 * node) + axis as f64));
        (0..NODES).map(force).collect()
    }

    #[test]
    fn moves_answer_the_exact_stiffness_whatever_leads() {
        let ((way, positive), (_, exact)) = (chain(2.0), chain(0.01));
        let exact = packed(&exact);
        let leader = Leader::new(&way, &positive).unwrap();
        let Answer::Moves(moves) = exact_answer(&leader, &exact, &forces(), 1e6, false) else {
            panic!("it is positive");
        };
        for (push, force) in exact.times(&moves).iter().zip(forces()) {
            assert!((push - force).norm() < 1e-2, "{push} {force}");
        }
        let far = 0.1 * longest(&moves);
        let Answer::Downhill(moves) = exact_answer(&leader, &exact, &forces(), far, false) else {
            panic!("it is longer");
        };
        assert!(dot(&moves, &forces()) > 0.0);
    }

    #[test]
    fn what_factors_in_32_bits_answer_is_put_right() {
        let (way, matrix) = chain(1e-4);
        let Way::Factors(plan) = &way else {
            panic!("it is small");
        };
        let left = |moves: &[Vec3]| {
            let pushes = packed(&matrix).times(moves);
            let lefts = pushes
                .iter()
                .zip(forces())
                .map(|(push, force)| push - force);
            longest(&lefts.collect::<Vec<_>>())
        };
        let leader = Leader::rounded(plan, &matrix).unwrap();
        let rounded = leader.answer(&forces());
        let Answer::Moves(moves) = exact_answer(&leader, &packed(&matrix), &forces(), 1e9, false)
        else {
            panic!("it is positive");
        };
        let exact = Leader::by_factors(plan, &matrix).unwrap().answer(&forces());
        let off = |moves: &[Vec3]| {
            let ways = moves.iter().zip(&exact).map(|(way, other)| way - other);
            longest(&ways.collect::<Vec<_>>()) / longest(&exact)
        };
        assert!(
            left(&moves) < 0.1 * left(&rounded),
            "{} {}",
            left(&moves),
            left(&rounded)
        );
        assert!(off(&moves) < 1e-5, "{} {}", off(&moves), off(&rounded));
    }

    #[test]
    fn a_trusted_answer_is_the_exact_one_or_goes_as_far_as_is_trusted_and_downhill() {
        let energy = |moves: &[Vec3], exact: &Packed<f64>| {
            0.5 * dot(moves, &exact.times(moves)) - dot(moves, &forces())
        };
        let (way, positive) = chain(0.02);
        let leader = Leader::new(&way, &positive).unwrap();
        let exact = packed(&chain(0.01).1);
        let (moves, stable) = trusted_answer(&leader, &exact, &forces(), 1e6);
        assert!(stable);
        for (push, force) in exact.times(&moves).iter().zip(forces()) {
            assert!((push - force).norm() < 0.1, "{push} {force}");
        }
        let far = 0.1 * longest(&moves);
        let (moves, stable) = trusted_answer(&leader, &exact, &forces(), far);
        assert!(stable && longest(&moves) >= far && energy(&moves, &exact) < 0.0);
        let exact = packed(&chain(-0.02).1);
        let (moves, stable) = trusted_answer(&leader, &exact, &forces(), 50.0);
        assert!(!stable && energy(&moves, &exact) < 0.0);
    }

    #[test]
    fn what_rounding_to_32_bits_makes_indefinite_is_led_by_64() {
        let bits = |ground: f64| {
            let (way, positive) = chain(ground);
            let Way::Factors(plan) = &way else {
                panic!("it is small");
            };
            match Leader::by_rounded_factors(plan, &positive) {
                Some(Leader::Rounded(..)) => 32,
                Some(Leader::Factors(..)) => 64,
                _ => 0,
            }
        };
        assert_eq!(bits(0.1), 32);
        assert_eq!(bits(-0.1), 0);
        let soft: Vec<u32> = (1..40).map(|k| bits(1e-10 * f64::from(k))).collect();
        assert!(soft.contains(&64) && !soft.contains(&0), "{soft:?}");
    }

    #[test]
    fn a_negative_direction_is_found_and_is_one() {
        let ((way, positive), (_, exact)) = (chain(1.0), chain(-0.02));
        let exact = packed(&exact);
        let leader = Leader::new(&way, &positive).unwrap();
        let out = way_out(&leader, &exact, &forces()).expect("there is one");
        assert!(dot(&out, &exact.times(&out)) < 0.0);
        let Answer::Downhill(moves) = exact_answer(&leader, &exact, &forces(), 50.0, false) else {
            panic!("it is not positive");
        };
        let energy = 0.5 * dot(&moves, &exact.times(&moves)) - dot(&moves, &forces());
        assert!(energy < 0.0, "{energy}");
        // Where steps are cut short anyway, what is asked for still goes downhill.
        let moves = near_answer(&leader, &exact, &forces(), f64::INFINITY);
        assert!(dot(&moves, &forces()) > 0.0);
    }
}
