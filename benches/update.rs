//! Updates of nodes per second, on one thread and on two: `cargo bench --bench update`.
//!
//! The square hangs by two corners and is swept from the flat start, where every move is long
//! enough to be checked: each visit finds the forces twice. One item is one update of one node.
//! Setting up is in the time of the 40 sweeps; "setting up" is what they take without a sweep.

#[path = "../examples/bench/hang.rs"]
mod hang;
#[path = "../examples/bench/square.rs"]
mod square;

use divan::{Bencher, counter::ItemsCount};
use hang::hang;
use soen::{
    forces::Laws,
    math::Vec3,
    solver::{Problem, sweeps},
};
use square::{Crew, Tried};
use std::fmt::{Display, Formatter, Result};

const SIDES: [u32; 3] = [65, 129, 257];
const THREADS: [usize; 2] = [1, 2];
const SWEEPS: usize = 40;

fn main() -> Tried<()> {
    let problem = hang(65)?;
    let swept = |threads| Crew::of(threads).map(|crew| crew.run(|| sweeps(&problem, 3)));
    assert_eq!(swept(1)??, swept(2)??, "threads change the result");
    divan::main();
    Ok(())
}

/// Which laws act, for so many sweeps of N × N nodes.
#[derive(Clone, Copy)]
struct Work {
    name: &'static str,
    laws: Laws,
    count: usize,
    nodes: u32,
}

impl Display for Work {
    fn fmt(&self, to: &mut Formatter<'_>) -> Result {
        write!(to, "{}, N = {}", self.name, self.nodes)
    }
}

fn works() -> Vec<Work> {
    let only = |[tension, bending, shear]: [bool; 3]| Laws {
        tension,
        bending,
        shear,
    };
    let kinds = [
        ("all laws", Laws::default(), SWEEPS),
        ("tension", only([true, false, false]), SWEEPS),
        ("bending", only([false, true, false]), SWEEPS),
        ("shear", only([false, false, true]), SWEEPS),
        ("setting up", Laws::default(), 0),
    ];
    let of = |(name, laws, count)| {
        SIDES.map(|nodes| Work {
            name,
            laws,
            count,
            nodes,
        })
    };
    kinds.into_iter().flat_map(of).collect()
}

#[divan::bench(args = works(), consts = THREADS, sample_count = 3, sample_size = 1)]
fn update<const N: usize>(bencher: Bencher<'_, '_>, work: Work) {
    let problem = Problem {
        laws: work.laws,
        ..hang(work.nodes).unwrap()
    };
    let nodes = work.nodes as usize;
    let crew = Crew::of(N).unwrap();
    let bencher = bencher.counter(ItemsCount::new(nodes * nodes * work.count.max(1)));
    bencher.bench_local(|| {
        let at = crew.run(|| sweeps(&problem, work.count)).unwrap();
        check(&problem, &at, work.count);
    });
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
