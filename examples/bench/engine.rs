//! The square on the ball by rapier's time-stepped cloth, beside the solver: seconds to rest.
//!
//! Rapier is a game engine's solver: its springs have frequencies, not moduli, and are set here to
//! what fabric C answers a strip of 50 cm of its own weight with, per cell (warp 78, weft 37, shear
//! 24 gf/cm; bending as of the hinges between cells). They are of the same order, not measured.
//!
//! It is given metres, no collisions of the cloth with itself, time steps of 1/60 s, its default 4
//! solver iterations, and what it came nearest to rest with. It runs twice, with its own sleep
//! switched off and on. Tried at N = 33, greatest speed of a node after 6 s, or what 20 seconds on
//! the clock reached (a cloth that hangs by two corners is at rest after 4.6 s):
//! - linear damping 0, 2, 5, 10 1/s: 90 to 240 mm/s (5 kept; 20 and 50 do not help either);
//! - contact at its default, 60 Hz with damping ratio 10 and four times as stiff: 130 mm/s; as stiff
//!   as it says, 89; a half, 84; a quarter, 44, and with damping ratio 1, 31 (kept); a tenth: 42, and
//!   the cloth sinks 2 cm into the ball;
//! - 8, 16, 32 solver iterations instead of 4: 26, 70, 26 mm/s, at 2 to 6 times the seconds;
//!   20 iterations in each: 26; time steps of 4 ms: 355 mm/s with the default contact;
//! - bending by edges, as its cloth has it, springs at its default 30 Hz, cloth of 3 cm thickness,
//!   Coulomb friction, no reuse and no clustering of contacts: no less than without.

use crate::square::{Crew, Tried};
use rapier3d::prelude::{
    ColliderBuilder, PhysicsWorld, RigidBodyBuilder, SoftBody, SoftBodyBuilder, SoftBodyHandle,
    SpringCoefficients, Vector,
};
use soen::solver::{Problem, Settings, settle};
use std::{f64::consts::TAU, time::Instant};

/// Greatest speed of a node at rest [m/s], and for how many steps in turn.
const RESTING: f64 = 1e-3;
const STEPS_AT_REST: usize = 10;
/// A cloth that has not yet come down is not looked at [s].
const COMING_DOWN: f64 = 1.0;
/// When to give up: after so many times the solver's seconds.
const PATIENCE: f64 = 31.0;

/// Force [N] of a gram-force.
const GRAM_FORCE: f64 = 9.81e-3;
/// Stiffness of a cell [gf/cm] along warp and weft and of its diagonals.
const STRETCH: [f64; 2] = [78.0, 37.0];
const SHEAR: f64 = 24.0;

/// Prints both times and their ratio for each number of nodes a side.
pub(crate) fn compare(works: &[(u32, Problem)]) -> Tried<()> {
    println!("The ball on one thread, rapier to 1 mm/s, soen to its certificate at 1e-3");
    println!("    N  rapier [s]   soen [s]  ratio  what rapier came to");
    for (nodes, problem) in works {
        let certified = certified(problem)?;
        for sleeps in [false, true] {
            let run = run(*nodes, problem, sleeps, PATIENCE * certified);
            println!(
                "{nodes:5} {:11.1} {certified:10.1} {:>6}  {}",
                run.seconds,
                run.ratio(certified),
                run.story(),
            );
        }
    }
    Ok(())
}

/// Seconds to the certificate.
fn certified(problem: &Problem) -> Tried<f64> {
    let settings = Settings {
        tolerance: 1e-3,
        frames: 0,
    };
    let begin = Instant::now();
    let settled = Crew::of(1)?.run(|| settle(problem, &settings, &mut |_| true))?;
    if settled.converged {
        Ok(begin.elapsed().as_secs_f64())
    } else {
        Err("the ball was not certified".into())
    }
}

/// How a run of rapier ended.
enum End {
    AtRest,
    /// Put to sleep by rapier's own threshold: 100 mm/s for half a second.
    Asleep,
    GivenUp,
}

struct Run {
    end: End,
    seconds: f64,
    simulated: f64,
    /// Greatest and mean speed of a node in the last step before the end [m/s].
    greatest: f64,
    mean: f64,
    /// Deepest node in the ball [m].
    depth: f64,
}

impl Run {
    fn ratio(&self, certified: f64) -> String {
        let least = if matches!(self.end, End::GivenUp) {
            "> "
        } else {
            ""
        };
        format!("{least}{:.1}", self.seconds / certified)
    }

    fn story(&self) -> String {
        let end = match self.end {
            End::AtRest => "at rest",
            End::Asleep => "put to sleep, not at rest,",
            End::GivenUp => "not at rest",
        };
        format!(
            "{end} after {:.1} s simulated; greatest speed {:.2} mm/s, mean {:.2}; {:.1} mm deep",
            self.simulated,
            1e3 * self.greatest,
            1e3 * self.mean,
            1e3 * self.depth,
        )
    }
}

fn run(nodes: u32, problem: &Problem, sleeps: bool, patience: f64) -> Run {
    let (mut world, cloth) = world(nodes, problem, sleeps);
    let begin = Instant::now();
    let mut run = Run {
        end: End::GivenUp,
        seconds: 0.0,
        simulated: 0.0,
        greatest: 0.0,
        mean: 0.0,
        depth: 0.0,
    };
    let mut calm = 0;
    while run.seconds < patience {
        world.step();
        run.simulated += world.integration_parameters.dt;
        run.seconds = begin.elapsed().as_secs_f64();
        let cloth = &world.soft_bodies[cloth];
        if cloth.is_sleeping() {
            run.end = End::Asleep;
            break;
        }
        look(&mut run, cloth);
        let is_calm = run.simulated > COMING_DOWN && run.greatest < RESTING;
        calm = if is_calm { calm + 1 } else { 0 };
        if calm == STEPS_AT_REST {
            run.end = End::AtRest;
            break;
        }
    }
    run
}

fn look(run: &mut Run, cloth: &SoftBody) {
    let speeds = || cloth.particle_velocities().map(|speed| speed.length());
    let depths = cloth.particle_positions().map(|at| RADIUS - at.length());
    run.greatest = speeds().fold(0.0, f64::max);
    run.mean = speeds().sum::<f64>() / cloth.num_particles() as f64;
    run.depth = depths.fold(0.0, f64::max);
}

/// Radius of the ball [m].
const RADIUS: f64 = 0.25;

fn world(nodes: u32, problem: &Problem, sleeps: bool) -> (PhysicsWorld, SoftBodyHandle) {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, 0.0, -9.81);
    let parameters = &mut world.integration_parameters;
    parameters.static_contact_softness = SpringCoefficients::new(60.0, 1.0);
    parameters.soft_bodies.contact_stiffening = 0.25;
    let ball = ColliderBuilder::ball(RADIUS).friction(problem.friction);
    world.insert(RigidBodyBuilder::fixed(), ball);
    let cloth = world.insert_soft_body(cloth(nodes, problem, sleeps));
    (world, cloth)
}

fn cloth(nodes: u32, problem: &Problem, sleeps: bool) -> SoftBodyBuilder {
    let pitch = 0.01 * problem.piece.pitch;
    // 1 gf/cm² is the weight of 10 kg/m².
    let mass = 10.0 * problem.fabric.weight * pitch * pitch;
    // An edge moves two nodes: half of one's mass.
    let frequency = |stiffness: f64| (100.0 * GRAM_FORCE * stiffness / (0.5 * mass)).sqrt() / TAU;
    let spring = |stiffness| SpringCoefficients::new(frequency(stiffness), 1.0);
    let corner = Vector::new(-0.5, -0.5, 0.01 * problem.placement.centre.z);
    let (along, across) = (Vector::X * pitch, Vector::Y * pitch);
    let [warp, weft] = STRETCH.map(spring);
    let side = nodes as usize;
    let mut cloth = SoftBodyBuilder::cloth_anisotropic(
        corner,
        along,
        across,
        side,
        side,
        warp,
        weft,
        spring(SHEAR),
    );
    // Hinges between triangles instead of edges over two cells, whose answer to bending begins
    // with the fourth power of the curvature.
    cloth.dihedrals = cloth.surface_dihedrals();
    cloth.bend_edges.clear();
    let bending = 0.01 * GRAM_FORCE * problem.fabric.warp.bending;
    let hinge = (4.0 * bending / (mass * pitch * pitch)).sqrt() / TAU;
    cloth.material.bend_softness = SpringCoefficients::new(hinge, 1.0);
    let collider = ColliderBuilder::ball(1.0).friction(problem.friction);
    let total = 10.0 * problem.fabric.weight;
    cloth
        .mass(total)
        .particle_radius(0.0025)
        .linear_damping(5.0)
        .self_contacts(false)
        .can_sleep(sleeps)
        .surface_collider(collider)
}
