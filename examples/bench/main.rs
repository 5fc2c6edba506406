//! Measures what a sweep and a certificate cost on this machine, and what rapier's cloth does, and
//! prints a table of each:
//! `cargo run --release --example bench -- [updates|certificate|farther|rapier] [ball|hang] [most nodes
//! a side]`.
//!
//! The work is always the same: a square of fabric C, 1 m a side, with N × N nodes, either held at
//! two corners ("hang") or laid on a ball of radius 25 cm ("ball"). A figure of `updates` is the
//! least of three runs, since other programs can only add to it.

#![allow(clippy::print_stdout, reason = "a program that prints")]

mod engine;
mod hang;
mod square;

use hang::hang;
use peak_alloc::PeakAlloc;
use soen::{
    body::{Bodies, Part, Shape},
    math::Pose,
    solver::{Problem, Settings, Settled, settle, sweeps},
};
use square::{Crew, Tried, square};
use std::{error::Error, time::Instant};

/// Counts the bytes that are in use.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const MODES: [&str; 4] = ["updates", "certificate", "farther", "rapier"];

type Work = fn(u32) -> Tried<Problem>;

/// The works, and how many nodes a side they have.
const WORKS: [(&str, Work); 2] = [("ball", ball), ("hang", hang)];
const SIDES: [u32; 5] = [33, 65, 129, 257, 513];
/// When a certificate is given up [s].
const PATIENCE: f64 = 3000.0;

fn main() -> Tried<()> {
    let mut what = "all".to_owned();
    let mut works = WORKS.to_vec();
    let mut most = 129;
    for word in std::env::args().skip(1) {
        match word.parse() {
            Ok(number) => most = number,
            Err(_) if WORKS.iter().any(|(name, _)| *name == word) => {
                works.retain(|(name, _)| *name == word);
            }
            Err(_) => what = word,
        }
    }
    let asked = |name: &str| what == "all" || what == name;
    if !MODES.into_iter().any(asked) {
        return Err(format!("{what}: allowed: {}", MODES.join(", ")).into());
    }
    if asked("updates") {
        updates()?;
    }
    if asked("certificate") {
        certificates(&works, most)?;
    }
    if asked("farther") {
        farther(&works, most)?;
    }
    if asked("rapier") {
        let sides = [33, 65].into_iter().filter(|nodes| *nodes <= most);
        let works: Tried<Vec<_>> = sides.map(|nodes| Ok((nodes, ball(nodes)?))).collect();
        engine::compare(&works?)?;
    }
    Ok(())
}

fn ball(nodes: u32) -> Tried<Problem> {
    let ball = Part::new(
        "ball".into(),
        &Shape::Ball { radius: 25.0 },
        Pose::identity(),
    )?;
    Ok(Problem {
        bodies: Bodies::new(vec![ball]),
        ..square(nodes)?
    })
}

/// Seconds that a work takes, the least of three.
fn seconds<T, E: Error + 'static>(mut work: impl FnMut() -> Result<T, E>) -> Tried<f64> {
    let mut least = f64::INFINITY;
    for _ in 0..3 {
        let begin = Instant::now();
        work()?;
        least = least.min(begin.elapsed().as_secs_f64());
    }
    Ok(least)
}

/// Nanoseconds of one update of one node, setting up left out.
fn update(problem: &Problem, count: usize) -> Tried<f64> {
    let nodes = sweeps(problem, 1)?.len();
    let one = seconds(|| sweeps(problem, 1))?;
    let many = seconds(|| sweeps(problem, 1 + count))?;
    Ok((many - one) / (count * nodes) as f64 * 1e9)
}

/// From the flat start, where every move is long enough to be checked: each visit finds the forces
/// twice.
fn updates() -> Tried<()> {
    println!("One node update with all laws, checked, hang [ns]");
    println!("      N   1 thread  2 threads   ratio");
    for nodes in [65, 129, 257] {
        let problem = hang(nodes)?;
        let one = on(1, &problem)?;
        let two = on(2, &problem)?;
        println!("  {nodes:5} {one:10.0} {two:10.0} {:7.2}", one / two);
    }
    Ok(())
}

fn on(threads: usize, problem: &Problem) -> Tried<f64> {
    let crew = Crew::of(threads)?;
    Ok(crew.run(|| update(problem, 50).map_err(|error| error.to_string()))?)
}

fn certificates(works: &[(&str, Work)], most: u32) -> Tried<()> {
    println!("To the certificate at 1e-3");
    println!(
        "  work     N   nodes  seconds  sweeps on the finest  joint steps  updates in finest sweeps  \
         bytes a node at most"
    );
    for (name, work) in works {
        for nodes in SIDES.into_iter().filter(|nodes| *nodes <= most) {
            let problem = work(nodes)?;
            let before = MEMORY.current_usage();
            MEMORY.reset_peak_usage();
            let begin = Instant::now();
            let settled = settled(&problem, 1e-3)?;
            let seconds = begin.elapsed().as_secs_f64();
            let bytes = MEMORY.peak_usage() - before;
            let Some(finest) = settled.levels.last() else {
                continue;
            };
            let steps: usize = settled.levels.iter().map(|level| level.joint_steps).sum();
            println!(
                "  {name} {nodes:5} {:7} {seconds:8.2} {:21} {steps:12} {:25.0} {:21.0}{}",
                finest.nodes,
                finest.sweeps,
                settled.node_updates as f64 / finest.nodes as f64,
                bytes as f64 / finest.nodes as f64,
                unless_certified(&settled),
            );
        }
    }
    Ok(())
}

fn settled(problem: &Problem, tolerance: f64) -> Tried<Settled> {
    let begin = Instant::now();
    let settings = Settings {
        tolerance,
        frames: 0,
    };
    Ok(settle(problem, &settings, &mut |_| {
        begin.elapsed().as_secs_f64() < PATIENCE
    })?)
}

fn unless_certified(settled: &Settled) -> &'static str {
    if settled.converged {
        ""
    } else {
        "   NOT certified"
    }
}

/// How far the drape of 1e-3 is from where the same run, carried on to 1e-6, ends.
fn farther(works: &[(&str, Work)], most: u32) -> Tried<()> {
    println!("From the certificate at 1e-3 to that at 1e-6");
    println!("  work     N  farthest node [cm]");
    for (name, work) in works {
        for nodes in SIDES.into_iter().filter(|nodes| *nodes <= most) {
            let problem = work(nodes)?;
            let stopped = settled(&problem, 1e-3)?;
            let rest = settled(&problem, 1e-6)?;
            let ways = stopped.positions.iter().zip(&rest.positions);
            let farthest = ways.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            println!(
                "  {name} {nodes:5} {farthest:19.1e}{}",
                unless_certified(&rest)
            );
        }
    }
    Ok(())
}
