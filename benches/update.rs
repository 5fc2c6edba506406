//! Updates of nodes per second, on one thread and on two: `cargo bench --bench update`.
//!
//! The square hangs by two corners and is swept from the flat start, where every move is long
//! enough to be checked: each visit finds the forces twice. One item is one update of one node.
//! Setting up is in the time of the 40 sweeps; `setting_up` is what they take without a sweep.

#[path = "../examples/bench/square.rs"]
mod square;

use divan::{Bencher, counter::ItemsCount};
use soen::{
    forces::Laws,
    math::{Vec2, Vec3},
    solver::{Grip, Hold, Problem, sweeps},
};
use square::{Crew, Tried, square};

const SIDES: [u32; 3] = [65, 129, 257];
const THREADS: [usize; 2] = [1, 2];
const SWEEPS: usize = 40;

fn main() -> Tried<()> {
    let problem = hang(65, Laws::default())?;
    let swept = |threads| Crew::of(threads).map(|crew| crew.run(|| sweeps(&problem, 3)));
    assert_eq!(swept(1)??, swept(2)??, "threads change the result");
    divan::main();
    Ok(())
}

#[divan::bench(args = SIDES, consts = THREADS, sample_count = 3, sample_size = 1)]
fn all_laws<const N: usize>(bencher: Bencher<'_, '_>, nodes: u32) {
    measure(bencher, N, nodes, SWEEPS, Laws::default());
}

#[divan::bench(args = SIDES, consts = THREADS, sample_count = 3, sample_size = 1)]
fn tension_alone<const N: usize>(bencher: Bencher<'_, '_>, nodes: u32) {
    let laws = Laws {
        tension: true,
        ..NONE
    };
    measure(bencher, N, nodes, SWEEPS, laws);
}

#[divan::bench(args = SIDES, consts = THREADS, sample_count = 3, sample_size = 1)]
fn bending_alone<const N: usize>(bencher: Bencher<'_, '_>, nodes: u32) {
    let laws = Laws {
        bending: true,
        ..NONE
    };
    measure(bencher, N, nodes, SWEEPS, laws);
}

#[divan::bench(args = SIDES, consts = THREADS, sample_count = 3, sample_size = 1)]
fn shear_alone<const N: usize>(bencher: Bencher<'_, '_>, nodes: u32) {
    let laws = Laws {
        shear: true,
        ..NONE
    };
    measure(bencher, N, nodes, SWEEPS, laws);
}

#[divan::bench(args = SIDES, consts = THREADS, sample_count = 3, sample_size = 1)]
fn setting_up<const N: usize>(bencher: Bencher<'_, '_>, nodes: u32) {
    measure(bencher, N, nodes, 0, Laws::default());
}

const NONE: Laws = Laws {
    tension: false,
    bending: false,
    shear: false,
};

fn measure(bencher: Bencher<'_, '_>, threads: usize, nodes: u32, count: usize, laws: Laws) {
    let problem = hang(nodes, laws).unwrap();
    let updates = nodes as usize * nodes as usize * count.max(1);
    let crew = Crew::of(threads).unwrap();
    let bencher = bencher.counter(ItemsCount::new(updates));
    bencher.bench_local(|| {
        let at = crew.run(|| sweeps(&problem, count)).unwrap();
        check(&problem, &at, count);
    });
}

fn hang(nodes: u32, laws: Laws) -> Tried<Problem> {
    let corner = |x| Hold {
        grip: Grip::Point(Vec2::new(x, 50.0)),
        clamp: false,
        carry: Vec3::zeros(),
    };
    Ok(Problem {
        holds: vec![corner(-50.0), corner(50.0)],
        laws,
        ..square(nodes)?
    })
}

/// All nodes are somewhere; the two that are held are where they were, the others have sunk.
fn check(problem: &Problem, at: &[Vec3], count: usize) {
    let start = problem.placement.centre.z;
    let disorder = 1e-3 * problem.piece.pitch;
    let mean = at.iter().map(|place| place.z).sum::<f64>() / at.len() as f64;
    assert!(at.iter().all(|place| place.iter().all(|x| x.is_finite())));
    assert!(at.iter().filter(|place| place.z == start).count() == 2);
    assert!(count == 0 || mean < start - disorder, "{mean}");
}
