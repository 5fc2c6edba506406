//! Coarse to fine: the same cloth cut ever finer, each cut starting where the last came to rest.

use super::{
    ForceModel, Level as LevelWork, Problem, Progress, Settings, Settled, Unsolvable,
    carry::carry_over,
    film::Film,
    level::Level,
    rest::{Firmness, Run},
    start::Start,
};
use crate::{
    certificate::{Case, certify, drape_shape},
    contact::{Footing, Surface, Touches},
    lattice::Lattice,
    math::Vec3,
};

/// Pressure that the skin answers, in weights of the cloth: what a few decimetres of cloth bring
/// to a curved body.
const SKIN_PRESSURE: f64 = 10.0;

/// Depth of skin over which the force of a body grows e-fold, in pitches: in a skin that is thin for
/// its lattice, cloth that falls a part of a pitch comes to lie hundreds of depths deep, and takes
/// as many steps to come out.
const SKIN: f64 = 0.01;
/// The finest lattice shows how deep it lies: its skins end at these [cm]. With 0.01 cm for nodes, one
/// that bears a hundred nodes' weight lies inside its body, its cloth pressed flat.
const THINNEST_SKIN: f64 = 0.004;
const NODE_SKIN: f64 = 0.006;
/// Samples of a wider lattice take in the edges of its cells [cm]: there cloth that is folded round a
/// wrist lies a few hundredths deeper than where samples half a distance away touch.
const SAMPLE_DISTANCE: f64 = 0.25;

/// Solves a problem from the coarsest lattice to the finest.
pub(super) fn descend(
    problem: &Problem,
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    let lattices = cuts(problem, &surface(problem))?;
    let mut before: Option<(&Lattice, Vec<Vec3>)> = None;
    let mut work = Vec::new();
    let mut run = Run {
        watch,
        settings,
        levels: lattices.len(),
        film: Film::new(settings.frames),
        stopped: false,
        lands: true,
        firmness: Firmness::CARRIED,
    };
    for (number, lattice) in lattices.iter().enumerate() {
        let last = number + 1 == lattices.len();
        let surface = if last {
            surface(problem)
        } else {
            coarse_surface(problem, lattice.pitch)
        };
        let mut start = Start::new(problem, lattice)?;
        start
            .fall(problem, &surface, lattice)
            .ok_or(Unsolvable::Falls)?;
        let case = case_of(problem, lattice, &start, surface);
        let touches = Touches::new(lattice, surface);
        let mut level = Level::new(&case, touches, start.at.clone());
        if let Some((coarse, rest)) = &before {
            carry_over(&mut level, coarse, rest, &start, &surface);
        }
        start.disturb(&mut level.at, lattice, problem);
        let remaining = run.rest(&mut level, &case, &start, number);
        work.push(level.work());
        if last {
            let settled = finish(&case, level, work, settings, remaining);
            return Ok(Settled {
                frames: run.film.develop(&lattices),
                ..settled
            });
        }
        before = Some((lattice, level.at));
    }
    Err(Unsolvable::Falls)
}

/// Cuts the finest lattice and finds out whether a drape can begin.
pub(super) fn prepare(problem: &Problem) -> Result<Lattice, Unsolvable> {
    let lattice = problem.piece.cut(problem.piece.pitch)?;
    let mut start = Start::new(problem, &lattice)?;
    start.check(problem, &lattice)?;
    let fallen = start.fall(problem, &surface(problem), &lattice);
    fallen.ok_or(Unsolvable::Falls)?;
    Ok(lattice)
}

/// So many sweeps from the flat start.
pub(super) fn sweeps(problem: &Problem, count: usize) -> Result<Vec<Vec3>, Unsolvable> {
    let lattice = problem.piece.cut(problem.piece.pitch)?;
    let surface = surface(problem);
    let mut start = Start::new(problem, &lattice)?;
    let fallen = start.fall(problem, &surface, &lattice);
    fallen.ok_or(Unsolvable::Falls)?;
    let case = case_of(problem, &lattice, &start, surface);
    let mut level = Level::new(&case, Touches::new(&lattice, surface), start.at.clone());
    start.disturb(&mut level.at, &lattice, problem);
    level.look(lattice.pitch, lattice.pitch);
    for _ in 0..count {
        level.sweep();
    }
    Ok(level.at)
}

/// One lattice of a problem, as the certificate sees it.
pub(super) fn case_of<'a>(
    problem: &'a Problem,
    lattice: &'a Lattice,
    start: &'a Start,
    surface: Surface,
) -> Case<'a> {
    Case {
        lattice,
        fabric: &problem.fabric,
        laws: problem.laws,
        own_only: problem.forces == ForceModel::Paper,
        clamps: &start.clamps,
        held: &start.held,
        bodies: &problem.bodies,
        surface,
        passage: None,
    }
}

/// The bodies' surface as the finest cloth meets it.
pub(super) fn surface(problem: &Problem) -> Surface {
    Surface {
        node_skin: skin(problem.piece.pitch).min(NODE_SKIN),
        sample_skin: THINNEST_SKIN,
        sample_distance: SAMPLE_DISTANCE,
        friction: problem.friction,
        offset: 0.5 * problem.thickness,
        pressure: SKIN_PRESSURE * problem.fabric.weight,
    }
}

/// The same as a coarser cut of this pitch [cm] meets it.
fn coarse_surface(problem: &Problem, pitch: f64) -> Surface {
    Surface {
        node_skin: skin(pitch),
        sample_skin: skin(pitch),
        sample_distance: f64::INFINITY,
        ..surface(problem)
    }
}

fn skin(pitch: f64) -> f64 {
    (SKIN * pitch).max(THINNEST_SKIN)
}

/// The lattices from coarse to fine. Cuts that would fall apart when coarse, or miss a hold or the
/// body below, are left out.
fn cuts(problem: &Problem, surface: &Surface) -> Result<Vec<Lattice>, Unsolvable> {
    let mut lattices = vec![prepare(problem)?];
    let mut pitch = problem.piece.pitch;
    while lattices
        .last()
        .is_some_and(|lattice| lattice.cells.len() > 200)
        && lattices.len() < 8
        && pitch <= 64.0 * problem.piece.pitch
    {
        pitch *= 2.0;
        let coarse = problem.piece.cut(pitch);
        lattices.extend(coarse.ok().filter(|lattice| {
            let start = Start::new(problem, lattice);
            start.is_ok_and(|mut start| start.fall(problem, surface, lattice).is_some())
        }));
    }
    lattices.reverse();
    Ok(lattices)
}

pub(super) fn finish(
    case: &Case<'_>,
    level: Level<'_>,
    levels: Vec<LevelWork>,
    settings: &Settings,
    remaining: f64,
) -> Settled {
    let certificate = certify(case, &level.at, settings.tolerance, remaining);
    let mut pulls = level.sheet.forces(&level.at);
    level.add_momentum(&level.at, &mut pulls);
    let held = case.held.iter();
    let holding = pulls
        .into_iter()
        .zip(held)
        .map(|(pull, held)| if *held { -pull } else { Vec3::zeros() });
    Settled {
        holding: holding.collect(),
        lattice: level.lattice.clone(),
        contact: level.touches.loads(&level.at),
        footing: footing(case, &level),
        velocities: velocities(case, &level.at),
        converged: certificate.holds(settings.tolerance),
        shape: drape_shape(case, &level.at),
        certificate,
        node_updates: levels.iter().map(|level| level.updates).sum(),
        levels,
        frames: Vec::new(),
        positions: level.at,
    }
}

/// What the nodes have of the last step [cm/s].
fn velocities(case: &Case<'_>, at: &[Vec3]) -> Vec<Vec3> {
    match &case.passage {
        Some(passage) => {
            let ways = at.iter().zip(passage.from);
            ways.map(|(to, from)| (to - from) / passage.step).collect()
        }
        None => vec![Vec3::zeros(); at.len()],
    }
}

/// Where the cloth holds on to the problem's bodies; one that was stopped on its way there holds on to
/// them as they were then.
fn footing(case: &Case<'_>, level: &Level<'_>) -> Footing {
    let there = level.touches.footing(&level.at, level.bodies);
    if core::ptr::eq(case.bodies, level.bodies) {
        there
    } else {
        there.carried(case.bodies)
    }
}
