//! A drape that goes on from the last one while bodies and holds move, a little at a time, and keeps
//! what friction remembers of its way.
//!
//! 1. Bodies and holds move by a small step; what friction holds on to goes with its part.
//! 2. Every node goes along as the bodies near it do.
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
    rest::{CARRIED, CARRYING, Firmness, Run, Standing},
    start::Start,
};
use crate::{
    body::Bodies,
    contact::{Footing, Surface, Touches},
    lattice::Lattice,
    math::Vec3,
    threads,
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
        firmness: if before.1.stands_on(through, &problem.bodies) {
            Firmness::STUCK
        } else {
            Firmness::CARRIED
        },
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
pub(super) fn same_cloth(
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
pub(super) const PRESSED: f64 = 0.05;

/// A held node's way: where it starts, and how far it goes [cm].
pub(super) struct Carried {
    pub(super) node: usize,
    pub(super) from: Vec3,
    pub(super) way: Vec3,
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
            go_along(&mut level.at, &level.held, &footing, &moved);
            level.touches.stand_on(&moved);
            let pitch = level.lattice.pitch;
            level.look(pitch, pitch);
            level.hold(surface.friction, self.firmness);
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
        let standing = Standing::new(level, 0);
        if level.own_only {
            let pitch = level.lattice.pitch;
            level.look(pitch, pitch);
            for _ in 0..CARRYING {
                level.sweep();
                level.touches.look_at_loads(&level.at);
            }
            self.goes_on(level, &standing);
            return;
        }
        let mut inertia = Inertia::none(level);
        self.glide(level, joint, &mut inertia, &standing, CARRYING);
    }
}

pub(super) fn carried(level: &Level<'_>, start: &Start) -> Vec<Carried> {
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

/// What is farther away than this [cm] does not take the cloth along.
const REACH: f64 = 15.0;
/// What is nearer than this [cm] takes it along as what is touched.
const TOUCHED: f64 = 1.0;

/// Takes every node along as the bodies near it go, the nearer the more (Shepard 1968), and as all
/// that the cloth holds on to where none is near: so what lies on a part stays on it, and what hangs
/// between two is not torn.
pub(super) fn go_along(at: &mut [Vec3], held: &[bool], before: &Footing, now: &Footing) {
    let whole = Whole::of(before, now);
    let (from, to) = (before.bodies(), now.bodies());
    let gone = threads::map(at.len(), |node| {
        let place = at[node];
        if held[node] {
            return place;
        }
        let far = weight_at(REACH);
        let (mut sum, mut weights) = ((whole.carries(&place) - place) * far, far);
        for near in from.near(&place, REACH) {
            let Some((then, now)) = from.part_then_and_now(near.part, to) else {
                continue;
            };
            let weight = weight_at(near.distance);
            sum += (now.carries(then, &place) - place) * weight;
            weights += weight;
        }
        place + sum / weights
    });
    at.copy_from_slice(&gone);
}

fn weight_at(distance: f64) -> f64 {
    let near = TOUCHED / (distance.max(0.0) + TOUCHED);
    near * near * near * near
}

/// How all that a cloth holds on to goes as one: over the ground, and about the vertical, which
/// changes no force in a cloth.
struct Whole {
    from: Vec3,
    to: Vec3,
    sine: f64,
    cosine: f64,
}

impl Whole {
    /// By the places where friction holds on, each with the weight of what it bears there.
    fn of(before: &Footing, now: &Footing) -> Self {
        let ways: Vec<(Vec3, Vec3, f64)> = before.ways(now).collect();
        let weight: f64 = ways.iter().map(|(_, _, weight)| weight).sum();
        let mut whole = Self {
            from: Vec3::zeros(),
            to: Vec3::zeros(),
            sine: 0.0,
            cosine: 1.0,
        };
        if weight <= 0.0 {
            return whole;
        }
        for (from, to, part) in &ways {
            whole.from += from * (part / weight);
            whole.to += to * (part / weight);
        }
        let (mut sine, mut cosine) = (0.0, 0.0);
        for (from, to, part) in &ways {
            let (a, b) = (from - whole.from, to - whole.to);
            sine += part * (a.x * b.y - a.y * b.x);
            cosine += part * (a.x * b.x + a.y * b.y);
        }
        let size = libm::hypot(sine, cosine);
        if size > 0.0 {
            (whole.sine, whole.cosine) = (sine / size, cosine / size);
        }
        whole
    }

    fn carries(&self, place: &Vec3) -> Vec3 {
        let way = place - self.from;
        let turned = Vec3::new(
            self.cosine * way.x - self.sine * way.y,
            self.sine * way.x + self.cosine * way.y,
            way.z,
        );
        self.to + turned
    }
}
