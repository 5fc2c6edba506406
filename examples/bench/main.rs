//! Measures what a sweep and a certificate cost on this machine, and what rapier's cloth does, and
//! prints a table of each:
//! `cargo run --release --example bench -- [updates|certificate|rapier] [most nodes a side]`.
//!
//! The work is always the same: a square of fabric C, 1 m a side, with N × N nodes, either held at
//! two corners ("hang") or laid on a ball of radius 25 cm ("ball"). A figure of `updates` is the
//! least of three runs, since other programs can only add to it.

#![allow(clippy::print_stdout, reason = "a program that prints")]

mod engine;
mod square;

use peak_alloc::PeakAlloc;
use soen::{
    body::{Bodies, Part, Shape},
    math::{Pose, Vec2, Vec3},
    solver::{Grip, Hold, Problem, Settings, settle, sweeps},
};
use square::{Crew, Tried, square};
use std::{error::Error, time::Instant};

/// Counts the bytes that are in use.
#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

const MODES: [&str; 3] = ["updates", "certificate", "rapier"];

fn main() -> Tried<()> {
    let mut what = "all".to_owned();
    let mut most = 129;
    for word in std::env::args().skip(1) {
        match word.parse() {
            Ok(number) => most = number,
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
        certificates(most)?;
    }
    if asked("rapier") {
        let sides = [33, 65].into_iter().filter(|nodes| *nodes <= most);
        let works: Tried<Vec<_>> = sides.map(|nodes| Ok((nodes, ball(nodes)?))).collect();
        engine::compare(&works?)?;
    }
    Ok(())
}

fn hang(nodes: u32) -> Tried<Problem> {
    let corner = |x| Hold {
        grip: Grip::Point(Vec2::new(x, 50.0)),
        clamp: false,
        carry: Vec3::zeros(),
    };
    Ok(Problem {
        holds: vec![corner(-50.0), corner(50.0)],
        ..square(nodes)?
    })
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

fn certificates(most: u32) -> Tried<()> {
    println!("To the certificate at 1e-3");
    println!(
        "  work     N   nodes  seconds  sweeps on the finest  joint steps  updates in finest sweeps  \
         bytes a node at most"
    );
    let sides = [33, 65, 129, 257, 513];
    for (name, work) in [("ball", ball as fn(u32) -> Tried<Problem>), ("hang", hang)] {
        for nodes in sides.into_iter().filter(|nodes| *nodes <= most) {
            let problem = work(nodes)?;
            let before = MEMORY.current_usage();
            MEMORY.reset_peak_usage();
            let begin = Instant::now();
            let settings = Settings {
                tolerance: 1e-3,
                frames: 0,
            };
            let settled = settle(&problem, &settings, &mut |_| {
                begin.elapsed().as_secs_f64() < 3000.0
            })?;
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
                if settled.converged {
                    ""
                } else {
                    "   NOT certified"
                },
            );
        }
    }
    Ok(())
}
