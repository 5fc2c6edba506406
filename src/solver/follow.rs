//! A drape that goes on from the last one while bodies and holds move, a little at a time, and keeps
//! what friction remembers of its way.
//!
//! 1. Bodies and holds move by a small step; what friction holds on to goes with its part.
//! 2. The whole cloth goes along as those places do: moved over the ground and turned about the
//!    vertical, which changes no force in it.
//! 3. Nodes that a body has entered come out, and a few steps with inertia bring the cloth nearer to
//!    rest.
//! 4. After the last step it is brought to rest in full.

use super::{
    Problem, Progress, Settings, Settled, Unsolvable,
    carry::push_out,
    descent::{case_of, finish, surface},
    film::Film,
    inertia::Inertia,
    joint::Joint,
    level::Level,
    rest::{CARRIED, CARRYING, Run, Standing},
    start::Start,
};
use crate::{
    body::Bodies,
    contact::{Footing, Surface, Touches},
    lattice::Lattice,
    math::Vec3,
};

/// Goes on from a drape of the same cloth: through bodies as they stand in between, to the problem's.
pub(super) fn go_on(
    problem: &Problem,
    through: &[Bodies],
    before: (&[Vec3], &Footing),
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    let lattice = problem.piece.cut(problem.piece.pitch)?;
    let start = Start::new(problem, &lattice)?;
    same_cloth(problem, through, before, &lattice)?;
    let surface = surface(problem);
    let case = case_of(problem, &lattice, &start, surface);
    let mut level = Level::new(&case, Touches::new(&lattice, surface), before.0.to_vec());
    let mut run = Run {
        watch,
        settings,
        levels: 1,
        film: Film::new(settings.frames),
        stopped: false,
        lands: false,
    };
    let stations: Vec<&Bodies> = through.iter().chain([&problem.bodies]).collect();
    run.follow(&mut level, &start, &surface, &stations, before.1);
    let remaining = run.rest(&mut level, &case, &start, 0);
    let work = vec![level.work()];
    let settled = finish(&case, level, work, settings, remaining);
    Ok(Settled {
        frames: run.film.develop(&[lattice]),
        ..settled
    })
}

/// Whether there is a way from a drape to a problem.
fn same_cloth(
    problem: &Problem,
    through: &[Bodies],
    (positions, footing): (&[Vec3], &Footing),
    lattice: &Lattice,
) -> Result<(), Unsolvable> {
    let parts = footing.bodies().parts().len();
    let mut bodies = through.iter().chain([&problem.bodies]);
    let same = positions.len() == lattice.coordinates.len()
        && footing.fits(lattice)
        && bodies.all(|bodies| bodies.parts().len() == parts);
    if same {
        Ok(())
    } else {
        Err(Unsolvable::Changed)
    }
}

/// A loaded node lies so deep in a body at most [cm]; one that is deeper was overrun by it.
const PRESSED: f64 = 0.05;

/// A held node's way: where it starts, and how far it goes [cm].
struct Carried {
    node: usize,
    from: Vec3,
    way: Vec3,
}

impl<'a> Run<'_> {
    /// Takes a level along as bodies and holds move.
    fn follow(
        &mut self,
        level: &mut Level<'a>,
        start: &Start,
        surface: &Surface,
        stations: &[&'a Bodies],
        footing: &Footing,
    ) {
        let held = carried(level, start);
        let farthest = held.iter().map(|held| held.way.norm()).fold(0.0, f64::max);
        let reach = CARRIED * level.lattice.pitch * stations.len() as f64;
        let parts = (farthest / reach).ceil().max(1.0) as usize;
        let steps = (parts * stations.len()) as f64;
        let mut footing = footing.clone();
        let mut joint = Joint::new(level);
        for (number, bodies) in stations.iter().enumerate() {
            if number > 0 {
                level.let_go(surface.friction);
                footing = level.touches.footing(&level.at, level.bodies);
            }
            let moved = footing.carried(bodies);
            level.bodies = bodies;
            go_along(&mut level.at, &footing, &moved);
            level.touches.stand_on(&moved);
            let pitch = level.lattice.pitch;
            level.look(pitch, pitch);
            level.hold_firmly(surface.friction);
            for part in 1..=parts {
                let done = (number * parts + part) as f64 / steps;
                for held in &held {
                    level.at[held.node] = held.from + held.way * done;
                }
                push_out(level, surface, &level.at.clone(), PRESSED);
                self.ease(level, &mut joint);
                if self.stopped {
                    return;
                }
            }
        }
    }

    /// Brings a level that was disturbed nearer to rest.
    fn ease(&mut self, level: &mut Level<'_>, joint: &mut Joint) {
        let standing = Standing::new(level);
        if level.own_only {
            let pitch = level.lattice.pitch;
            level.look(pitch, pitch);
            for _ in 0..CARRYING {
                level.sweep();
                level.touches.look_at_loads(&level.at);
            }
            self.goes_on(level, 0, &standing);
            return;
        }
        let mut inertia = Inertia::none(level);
        self.glide(level, joint, &mut inertia, 0, &standing, CARRYING);
    }
}

fn carried(level: &Level<'_>, start: &Start) -> Vec<Carried> {
    let carried = start.carry.iter().map(|(node, carry)| {
        let node = *node as usize;
        let from = level.at[node];
        Carried {
            node,
            from,
            way: start.at[node] + carry - from,
        }
    });
    carried.collect()
}

/// Moves a cloth over the ground and turns it about the vertical as the places do that it holds on
/// to, each with the weight of what friction bears there.
fn go_along(at: &mut [Vec3], before: &Footing, now: &Footing) {
    let ways: Vec<(Vec3, Vec3, f64)> = before.ways(now).collect();
    let weight: f64 = ways.iter().map(|(_, _, weight)| weight).sum();
    if weight <= 0.0 {
        return;
    }
    let mean = |of: fn(&(Vec3, Vec3, f64)) -> Vec3| {
        let sum: Vec3 = ways.iter().map(|way| of(way) * way.2).sum();
        sum / weight
    };
    let (from, to) = (mean(|way| way.0), mean(|way| way.1));
    let (mut sine, mut cosine) = (0.0, 0.0);
    for (then, now, weight) in &ways {
        let (a, b) = (then - from, now - to);
        sine += weight * (a.x * b.y - a.y * b.x);
        cosine += weight * (a.x * b.x + a.y * b.y);
    }
    let size = libm::hypot(sine, cosine);
    let (sine, cosine) = if size > 0.0 {
        (sine / size, cosine / size)
    } else {
        (0.0, 1.0)
    };
    for position in at {
        let way = *position - from;
        let turned = Vec3::new(
            cosine * way.x - sine * way.y,
            sine * way.x + cosine * way.y,
            way.z,
        );
        *position = to + turned;
    }
}
