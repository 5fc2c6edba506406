//! Measures what a sweep and a certificate cost on this machine, and prints a table:
//! `cargo run --release --example bench -- [updates|certificate] [most nodes a side]`.
//!
//! The work is always the same: a square of fabric C, 1 m a side, with N × N nodes, either held at
//! two corners ("hang") or laid on a ball of radius 25 cm ("ball"). A figure is the least of three
//! runs, since other programs can only add to it.

#![allow(clippy::print_stdout, reason = "a program that prints")]

use soen::{
    body::{Bodies, Part, Shape},
    forces::Laws,
    lattice::{Outline, Piece},
    math::{Pose, Vec2, Vec3},
    solver::{ForceModel, Grip, Hold, Placement, Problem, Settings, settle, sweeps},
};
use std::{error::Error, time::Instant};

type Tried<T> = Result<T, Box<dyn Error>>;

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
    let unknown = !["updates", "certificate"].iter().any(|name| asked(name));
    if unknown {
        return Err(format!("{what}: allowed: updates, certificate").into());
    }
    if asked("updates") {
        updates()?;
    }
    if asked("certificate") {
        certificates(most)?;
    }
    Ok(())
}

/// The square, N × N nodes, above whatever it meets.
fn square(nodes: u32) -> Tried<Problem> {
    let fabric = soen::scene::fabric("c")?;
    Ok(Problem {
        piece: Piece {
            outline: Outline::rectangle(100.0, 100.0)?,
            grain: 0.0,
            pitch: 100.0 / f64::from(nodes - 1),
        },
        placement: Placement {
            centre: Vec3::new(0.0, 0.0, 26.0),
            x_axis: Vec3::x(),
            y_axis: Vec3::y(),
        },
        holds: vec![],
        bodies: Bodies::default(),
        friction: 0.3,
        thickness: fabric.thickness,
        laws: Laws::default(),
        forces: ForceModel::Lattice,
        seed: 1,
        fabric,
    })
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
        let one = on(1, || update(&problem, 50))?;
        let two = on(2, || update(&problem, 50))?;
        println!("  {nodes:5} {one:10.0} {two:10.0} {:7.2}", one / two);
    }
    Ok(())
}

fn certificates(most: u32) -> Tried<()> {
    println!("To the certificate at 1e-3");
    println!(
        "  work     N   nodes  seconds  sweeps on the finest  joint steps  updates in finest sweeps"
    );
    let sides = [33, 65, 129, 257, 513];
    for (name, work) in [("ball", ball as fn(u32) -> Tried<Problem>), ("hang", hang)] {
        for nodes in sides.into_iter().filter(|nodes| *nodes <= most) {
            let problem = work(nodes)?;
            let begin = Instant::now();
            let settings = Settings {
                tolerance: 1e-3,
                frames: 0,
            };
            let settled = settle(&problem, &settings, &mut |_| {
                begin.elapsed().as_secs_f64() < 3000.0
            })?;
            let seconds = begin.elapsed().as_secs_f64();
            let Some(finest) = settled.levels.last() else {
                continue;
            };
            let steps: usize = settled.levels.iter().map(|level| level.joint_steps).sum();
            println!(
                "  {name} {nodes:5} {:7} {seconds:8.2} {:21} {steps:12} {:25.0}{}",
                finest.nodes,
                finest.sweeps,
                settled.node_updates as f64 / finest.nodes as f64,
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

/// Does a work on so many threads.
#[cfg(feature = "threads")]
fn on(threads: usize, work: impl FnOnce() -> Tried<f64> + Send) -> Tried<f64> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    let done = pool.install(|| work().map_err(|error| error.to_string()));
    Ok(done?)
}

#[cfg(not(feature = "threads"))]
fn on(_: usize, work: impl FnOnce() -> Tried<f64>) -> Tried<f64> {
    work()
}
