//! Drapes that go on while bodies and holds move: friction remembers, and what moves as a whole
//! stays as it is.

use crate::specimen::scene;
use soen::{
    body::{Bodies, Part, Shape},
    contact::Footing,
    math::{Pose, Vec3, turn},
    solver::{Problem, Progress, Settings, Settled, Unsolvable, go_on, settle},
};

const SETTINGS: Settings = Settings {
    tolerance: 1e-3,
    frames: 0,
};

fn rest(problem: &Problem) -> Settled {
    settle(problem, &SETTINGS, &mut |_| true).unwrap()
}

/// Goes on through stations until it rests, or for so many rounds.
fn follow(problem: &Problem, through: &[Bodies], last: &Settled, rounds: usize) -> Settled {
    let mut left = rounds;
    let mut watch = |_: &Progress| {
        left = left.saturating_sub(1);
        left > 0
    };
    go_on(problem, through, last.state(), &SETTINGS, &mut watch).unwrap()
}

fn ball(pose: Pose) -> Bodies {
    let shape = Shape::Ball { radius: 8.0 };
    let nose = Shape::Ball { radius: 3.0 };
    let beside = pose * Pose::translation(6.5, 0.0, 3.0);
    Bodies::new(vec![
        Part::new("ball".into(), &shape, pose).unwrap(),
        Part::new("nose".into(), &nose, beside).unwrap(),
    ])
}

/// Moved and turned about the vertical, so far of the way.
fn moved(part: f64) -> Pose {
    let pose = turn(&(Vec3::z() * (0.6 * part)));
    Pose::from_parts((Vec3::new(4.0, -3.0, 1.0) * part).into(), pose)
}

fn over_ball() -> Problem {
    let text = "[cloth]\nfabric = \"c\"\ndisc_radius_cm = 14\nspacing_cm = 1\n\
        centre_cm = [0, 0, 9]\n[contact]\nfriction = 0.3\n";
    Problem {
        bodies: ball(Pose::identity()),
        ..scene(&format!("{text}[[body]]\nball = {{ radius_cm = 8 }}\n")).problem
    }
}

#[test]
fn cloth_goes_along_with_a_body_that_moves_as_a_whole() {
    let mut problem = over_ball();
    let first = rest(&problem);
    let through: Vec<Bodies> = (1..20).map(|k| ball(moved(f64::from(k) / 20.0))).collect();
    problem.bodies = ball(moved(1.0));
    let last = follow(&problem, &through, &first, usize::MAX);
    assert!(last.converged, "{:?}", last.certificate);
    let pairs = first.positions.iter().zip(&last.positions);
    let off = pairs.map(|(before, now)| {
        (moved(1.0) * nalgebra::Point3::from(*before) - now)
            .coords
            .norm()
    });
    let off = off.fold(0.0, f64::max);
    // Each of the two shapes is known to be within 1e-3 cm of rest.
    assert!(off < 0.01, "{off} cm from where it was carried");
}

#[test]
fn a_drape_in_motion_has_the_same_bits_on_any_number_of_threads() {
    let mut problem = over_ball();
    let first = rest(&problem);
    let through = [ball(moved(0.05))];
    problem.bodies = ball(moved(0.1));
    let on = |count: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        let last = pool
            .unwrap()
            .install(|| follow(&problem, &through, &first, 40));
        let numbers = last.positions.iter().flatten().map(|x| x.to_bits());
        numbers.collect::<Vec<_>>()
    };
    let one = on(1);
    assert!(one == on(2), "1 thread and 2");
    assert!(one == on(7), "1 thread and 7");
}

#[test]
fn a_body_of_other_parts_is_refused() {
    let mut problem = over_ball();
    let first = rest(&problem);
    problem.bodies = Bodies::new(problem.bodies.parts()[..1].to_vec());
    let refused = go_on(&problem, &[], first.state(), &SETTINGS, &mut |_| true);
    assert_eq!(refused.unwrap_err(), Unsolvable::Changed);
}

/// A strip on a level board, held at one end.
const DRAWN: &str = "[cloth]\nfabric = \"d\"\nsize_cm = [12, 2]\nspacing_cm = 1\n\
    centre_cm = [0, 0, 0.025]\n[contact]\nfriction = 0.25\nthickness_cm = 0.04\n\
    [[body]]\ncuboid = { size_cm = [80, 20, 2] }\nat_cm = [0, 0, -1]\n\
    [[hold]]\nedge = \"x-max\"\n";

/// Drawn over a board, cloth is held back by µ·N of what lies on it (Coulomb), and so it is on its
/// way back: what friction held on to follows it.
#[test]
fn cloth_that_is_drawn_over_a_board_is_held_back_by_coulombs_friction() {
    let mut problem = scene(DRAWN).problem;
    let first = rest(&problem);
    problem.holds[0].carry = Vec3::x() * 3.0;
    let there = follow(&problem, &[], &first, usize::MAX);
    let load: f64 = there.contact.iter().sum();
    let pull: Vec3 = there.holding.iter().sum();
    assert!(
        (pull.x / (0.25 * load) - 1.0).abs() < 0.01,
        "{pull:?} for {load} gf"
    );
    problem.holds[0].carry = Vec3::new(3.0, 1.5, 0.0);
    let aside = follow(&problem, &[], &there, usize::MAX);
    let load: f64 = aside.contact.iter().sum();
    let pull: Vec3 = aside.holding.iter().sum();
    assert!(pull.norm() < 0.25 * load * 1.01, "{pull:?} for {load} gf");
    assert!(pull.y > 0.1 * load, "{pull:?} for {load} gf");
}

fn board(angle: f64) -> Bodies {
    let shape = Shape::Cuboid {
        size: Vec3::new(80.0, 40.0, 2.0),
    };
    let pose = Pose::from_parts(Vec3::zeros().into(), turn(&(Vec3::y() * angle)));
    let below = Pose::translation(0.0, 0.0, -1.0);
    Bodies::new(vec![
        Part::new("board".into(), &shape, pose * below).unwrap(),
    ])
}

/// tan θ = µ (f_incline_and_edge): on a board that is tilted under it, cloth stays where it lies up
/// to that angle and no farther.
#[test]
fn cloth_stays_on_a_board_that_is_tilted_up_to_the_angle_of_friction() {
    let mut problem = scene(
        "[cloth]\nfabric = \"b\"\nsize_cm = [8, 8]\nspacing_cm = 1\ncentre_cm = [0, 0, 1]\n\
         [contact]\nfriction = 0.3\n[[body]]\ncuboid = { size_cm = [80, 40, 2] }\nat_cm = [0, 0, -1]\n",
    )
    .problem;
    let level = rest(&problem);
    let limit = 0.3_f64.atan();
    let tilted = |problem: &mut Problem, from: f64, to: f64, last: &Settled, rounds| {
        let between = |k: i32| board(from + (to - from) * f64::from(k) / 30.0);
        let through: Vec<Bodies> = (1..30).map(between).collect();
        problem.bodies = board(to);
        follow(problem, &through, last, rounds)
    };
    let slid = |settled: &Settled, angle: f64| {
        let back = turn(&(Vec3::y() * -angle));
        let pairs = level.positions.iter().zip(&settled.positions);
        let ways = pairs.map(|(before, now)| (back * now - before).xy().norm());
        ways.fold(0.0, f64::max)
    };
    let held = tilted(&mut problem, 0.0, 0.98 * limit, &level, usize::MAX);
    assert!(held.converged, "{:?}", held.certificate);
    let way = slid(&held, 0.98 * limit);
    assert!(
        way < 0.05,
        "slid by {way} cm on the way to 0.98 of the angle"
    );
    let gone = tilted(&mut problem, 0.98 * limit, 1.02 * limit, &held, 400);
    let way = slid(&gone, 1.02 * limit);
    assert!(way > 0.5, "slid by {way} cm only beyond the angle");
}

/// What a run keeps of a drape is enough to go on from it to the same bits.
#[test]
fn a_footing_kept_as_numbers_goes_on_to_the_same_bits() {
    let mut problem = over_ball();
    let first = rest(&problem);
    let numbers = first.footing.numbers();
    let read =
        |numbers: &[f64]| Footing::from_numbers(numbers, problem.bodies.clone(), &first.lattice);
    let kept = read(&numbers).unwrap();
    for cut in 0..numbers.len() {
        assert!(read(&numbers[..cut]).is_none(), "cut at {cut}");
    }
    let mut wrong = numbers.clone();
    wrong[1] = f64::NAN;
    assert!(read(&wrong).is_none());
    problem.bodies = ball(moved(0.05));
    let from = |footing: &Footing| {
        let mut left = 30;
        let last = go_on(
            &problem,
            &[],
            (&first.positions, footing),
            &SETTINGS,
            &mut |_| {
                left -= 1;
                left > 0
            },
        );
        let last = last.unwrap().positions;
        last.iter()
            .flatten()
            .map(|x| x.to_bits())
            .collect::<Vec<_>>()
    };
    assert!(from(&first.footing) == from(&kept));
}
