//! Coarse to fine: the same cloth cut ever finer, each cut starting where the last came to rest.

use super::{
    ForceModel, Level as LevelWork, Problem, Progress, Settings, Settled, Unsolvable, joint::Joint,
    level::Level, start::Start,
};
use crate::{
    certificate::{Case, certify, drape_shape, greatest_residual},
    contact::{Sites, Surface, Touches},
    forces::Sheet,
    lattice::Lattice,
    math::Vec3,
};

/// Sweeps before each joint step: they settle what is near, it settles what is far.
const SWEEPS: usize = 4;
/// A coarse level is left when steps ask for less than this part of its pitch.
const COARSE_ENOUGH: f64 = 0.05;
/// A drape whose joint steps ask for less than this [cm] is where it will be.
const SETTLED: f64 = 1e-3;
/// A node on a sharp feature may swing between two equilibria this near to each other [cm]: after
/// as many rounds as patience lasts, either is accepted, and the swing is reported as the move
/// that remains.
const SWINGING: f64 = 0.02;
/// Rounds of short steps before a swing is accepted.
const PATIENCE: usize = 8;
/// Pressure that the skin answers, in weights of the cloth: what a few decimetres of cloth bring
/// to a curved body.
const SKIN_PRESSURE: f64 = 10.0;

/// Solves a problem from the coarsest lattice to the finest.
pub(super) fn descend(
    problem: &Problem,
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    let lattices = cuts(problem)?;
    let surface = Surface {
        friction: problem.friction,
        offset: 0.5 * problem.thickness,
        pressure: SKIN_PRESSURE * problem.fabric.weight,
    };
    let finest = &lattices[lattices.len() - 1];
    Start::new(problem, finest)?.check(problem, finest)?;
    let mut before: Option<(&Lattice, Vec<Vec3>)> = None;
    let mut work = Vec::new();
    let mut run = Run {
        watch,
        settings,
        levels: lattices.len(),
        stopped: false,
    };
    for (number, lattice) in lattices.iter().enumerate() {
        let mut start = Start::new(problem, lattice)?;
        start
            .fall(problem, &surface, lattice)
            .ok_or(Unsolvable::Falls)?;
        let mut level = open(problem, lattice, &start, surface);
        if let Some((coarse, rest)) = &before {
            level.at = carry_over(coarse, rest, lattice, &start, &level.at);
        }
        start.disturb(&mut level.at, lattice, problem.seed);
        push_out(&mut level, &surface);
        let first = before.is_none();
        let case = Case {
            lattice,
            fabric: &problem.fabric,
            laws: problem.laws,
            own_only: problem.forces == ForceModel::Paper,
            clamps: &start.clamps,
            held: &start.held,
            bodies: &problem.bodies,
            surface,
        };
        let remaining = run.rest(&mut level, &case, &start, number, first);
        work.push(LevelWork {
            spacing: lattice.pitch,
            nodes: level.at.len(),
            sweeps: level.sweeps,
            joint_steps: level.joint_steps,
        });
        if number + 1 == lattices.len() {
            return Ok(finish(&case, level, work, settings, remaining));
        }
        before = Some((lattice, level.at));
    }
    Err(Unsolvable::Falls)
}

/// The lattices from coarse to fine. Cuts that would fall apart when coarse are left out.
fn cuts(problem: &Problem) -> Result<Vec<Lattice>, Unsolvable> {
    let finest = problem.piece.cut(problem.piece.pitch)?;
    let mut lattices = vec![finest];
    let mut pitch = problem.piece.pitch;
    while lattices
        .last()
        .is_some_and(|lattice| lattice.cells.len() > 200)
        && lattices.len() < 8
    {
        pitch *= 2.0;
        if let Ok(lattice) = problem.piece.cut(pitch) {
            lattices.push(lattice);
        }
        if pitch > 64.0 * problem.piece.pitch {
            break;
        }
    }
    lattices.reverse();
    Ok(lattices)
}

fn open<'a>(
    problem: &'a Problem,
    lattice: &'a Lattice,
    start: &Start,
    surface: Surface,
) -> Level<'a> {
    let colours = lattice
        .colours()
        .into_iter()
        .map(|nodes| {
            nodes
                .into_iter()
                .filter(|node| !start.held[*node as usize])
                .collect()
        })
        .collect();
    Level {
        lattice,
        sheet: Sheet::new(lattice, &problem.fabric, problem.laws, &start.clamps),
        bodies: &problem.bodies,
        touches: Touches::new(Sites::new(lattice), surface, start.at.len()),
        held: start.held.clone(),
        colours,
        at: start.at.clone(),
        own_only: problem.forces == ForceModel::Paper,
        sweeps: 0,
        joint_steps: 0,
    }
}

/// Positions of a finer lattice on the shape of a coarser one; held nodes where they are carried.
fn carry_over(
    coarse: &Lattice,
    rest: &[Vec3],
    fine: &Lattice,
    start: &Start,
    flat: &[Vec3],
) -> Vec<Vec3> {
    let locator = coarse.locator();
    let mut at: Vec<Vec3> = fine
        .coordinates
        .iter()
        .map(|coordinate| {
            let place = locator.locate(*coordinate);
            let mut at = Vec3::zeros();
            for (node, weight) in place.nodes.iter().zip(place.weights) {
                at += rest[*node as usize] * weight;
            }
            at
        })
        .collect();
    for (node, carry) in &start.carry {
        at[*node as usize] = flat[*node as usize] + carry;
    }
    at
}

/// Brings free nodes that the finer cut put into a body back to its surface.
fn push_out(level: &mut Level<'_>, surface: &Surface) {
    for node in 0..level.at.len() {
        if level.held[node] {
            continue;
        }
        for _ in 0..3 {
            let nears = level.bodies.near(&level.at[node], 0.0);
            let Some(deepest) = nears
                .iter()
                .min_by(|a, b| a.distance.total_cmp(&b.distance))
            else {
                break;
            };
            level.at[node] += deepest.normal * (surface.node_reach() - deepest.distance);
        }
    }
}

/// A run under its watcher.
struct Run<'w> {
    watch: &'w mut dyn FnMut(&Progress) -> bool,
    settings: &'w Settings,
    levels: usize,
    stopped: bool,
}

impl Run<'_> {
    /// Brings one level to rest, or as near as the watcher allows. Returns the estimate of how
    /// far the farthest node still is from rest [cm].
    fn rest(
        &mut self,
        level: &mut Level<'_>,
        case: &Case<'_>,
        start: &Start,
        number: usize,
        first: bool,
    ) -> f64 {
        let mut joint = Joint::new(level);
        if first {
            carry_holds(level, &mut joint, start);
        }
        let last = number + 1 == self.levels;
        let pitch = level.lattice.pitch;
        let mut made = pitch;
        let mut remaining = f64::INFINITY;
        let mut residual = f64::INFINITY;
        let mut settled_for = 0;
        for round in 0.. {
            let progress = Progress {
                level: (number, self.levels),
                nodes: level.at.len(),
                sweeps: level.sweeps,
                residual,
                remaining_move: remaining,
            };
            if self.stopped || !(self.watch)(&progress) {
                self.stopped = true;
                break;
            }
            level.look(0.8 * pitch, (2.0 * made).clamp(0.002, 0.1));
            let sweeps = if joint.near { 0 } else { SWEEPS };
            for _ in 0..sweeps {
                level.sweep();
                level.touches.look_at_loads(&level.at);
            }
            level.look(0.8 * pitch, (2.0 * made).clamp(0.002, 0.1));
            let Some(step) = joint.step(level) else { break };
            made = step.made;
            remaining = step.asked;
            if !last && (step.asked < COARSE_ENOUGH * pitch || round > 30) {
                break;
            }
            settled_for = if step.exact && step.asked < COARSE_ENOUGH * pitch {
                settled_for + 1
            } else {
                0
            };
            if last && settled_for > 1 {
                joint.finish(level);
                residual = greatest_residual(case, &level.at);
                let still = if settled_for < PATIENCE {
                    SETTLED
                } else {
                    SWINGING
                };
                if residual <= 0.5 * self.settings.tolerance && step.asked < still {
                    break;
                }
            } else if round % 8 == 7 {
                residual = greatest_residual(case, &level.at);
            }
        }
        remaining
    }
}

/// Carries the holds to where they belong, a part of a pitch at a time.
fn carry_holds(level: &mut Level<'_>, joint: &mut Joint, start: &Start) {
    let way = start
        .carry
        .iter()
        .map(|(_, carry)| carry.norm())
        .fold(0.0, f64::max);
    let steps = (way / (0.4 * level.lattice.pitch)).ceil() as usize;
    for _ in 0..steps {
        for (node, carry) in &start.carry {
            level.at[*node as usize] += carry / steps as f64;
        }
        level.look(level.lattice.pitch, 0.1);
        for _ in 0..SWEEPS {
            level.sweep();
        }
        level.look(level.lattice.pitch, 0.1);
        joint.step(level);
    }
}

fn finish(
    case: &Case<'_>,
    level: Level<'_>,
    levels: Vec<LevelWork>,
    settings: &Settings,
    remaining: f64,
) -> Settled {
    let certificate = certify(case, &level.at, settings.tolerance, remaining);
    let node_updates = levels
        .iter()
        .map(|level| (level.nodes * level.sweeps) as u64)
        .sum();
    Settled {
        lattice: level.lattice.clone(),
        contact: level.touches.loads(&level.at),
        converged: certificate.holds(settings.tolerance),
        shape: drape_shape(case, &level.at),
        certificate,
        levels,
        node_updates,
        frames: Vec::new(),
        positions: level.at,
    }
}
