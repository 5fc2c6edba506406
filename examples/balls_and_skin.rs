//! What the balls of a robot cost a drape: the same cloth over its balls, over its skin, and over its
//! balls once more with another seed, which shows how far a drape's folds are chance:
//! `cargo run --release --example balls_and_skin -- scenes/cape.toml`.
//!
//! A height is compared node by node, for all three cut the same cloth.

use soen::{
    body::{Bodies, Part, Shape},
    math::Pose,
    scene,
    solver::{Problem, Settings, Settled, settle},
};
use std::{
    env,
    error::Error,
    io::{self, Write},
    time::Instant,
};

/// When to stop a drape that does not come to rest [s].
const LONGEST: f64 = 600.0;

fn main() -> Result<(), Box<dyn Error>> {
    let path = env::args().nth(1).ok_or("give a scene with a robot")?;
    let scene = scene::read(path.as_ref())?;
    let balls = scene.problem;
    let skin = Problem {
        bodies: skins(&scene.cast)?,
        ..balls.clone()
    };
    let other = Problem {
        seed: balls.seed + 1,
        ..balls.clone()
    };
    let mut out = io::stdout();
    writeln!(out, "{path}, heights against those over the balls [cm]")?;
    writeln!(
        out,
        "{:22}{:>8}{:>10}{:>8}{:>9}{:>9}{:>8}{:>9}  certificate",
        "", "mean", "absolute", "most", "lowest", "highest", "depth", "seconds"
    )?;
    let mut first = None;
    for (name, problem) in [
        ("balls", &balls),
        ("skin", &skin),
        ("balls, another seed", &other),
    ] {
        let (drape, seconds) = draped(problem, &scene.settings)?;
        let row = row(first.as_ref().unwrap_or(&drape), &drape, seconds);
        writeln!(out, "{name:22}{row}")?;
        first.get_or_insert(drape);
    }
    Ok(())
}

/// The scene's robots as the cloth is laid on them, in their skin; all else is left out.
fn skins(cast: &soen::play::Cast) -> Result<Bodies, Box<dyn Error>> {
    let before = -soen::play::ENTRANCE;
    let mut parts = Vec::new();
    for actor in cast.actors() {
        let mesh = actor
            .robot()
            .skin(&actor.posture(before), &actor.frames(before))?;
        parts.push(Part::new(
            "skin".into(),
            &Shape::Mesh(mesh),
            Pose::identity(),
        )?);
    }
    match parts.is_empty() {
        true => Err("the scene has no robot".into()),
        false => Ok(Bodies::new(parts)),
    }
}

fn draped(problem: &Problem, settings: &Settings) -> Result<(Settled, f64), Box<dyn Error>> {
    let begin = Instant::now();
    let drape = settle(problem, settings, &mut |_| {
        begin.elapsed().as_secs_f64() < LONGEST
    })?;
    Ok((drape, begin.elapsed().as_secs_f64()))
}

fn row(first: &Settled, drape: &Settled, seconds: f64) -> String {
    let pairs = first.positions.iter().zip(&drape.positions);
    let offs: Vec<f64> = pairs.map(|(first, at)| at.z - first.z).collect();
    let count = offs.len().max(1) as f64;
    let mean = offs.iter().sum::<f64>() / count;
    let absolute = offs.iter().map(|off| off.abs()).sum::<f64>() / count;
    let most = offs.iter().map(|off| off.abs()).fold(0.0, f64::max);
    let (shape, deepest) = (&drape.shape, drape.certificate.deepest);
    let rest = if drape.converged {
        "at rest"
    } else {
        "NOT AT REST"
    };
    format!(
        "{mean:8.2}{absolute:10.2}{most:8.2}{:9.2}{:9.2}{deepest:8.3}{seconds:9.1}  {rest}",
        shape.lowest, shape.highest
    )
}
