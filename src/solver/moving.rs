//! Cloth with inertia: steps of time, each an equilibrium of its own in which inertia and air take
//! part, found by the same visits and joint steps as rest.
//!
//! 1. Bodies and holds go to where they are at the step's end; what friction holds on to goes with
//!    its part.
//! 2. Each node goes on as it went, as far as bodies leave free; one that was overrun comes out first.
//! 3. Sweeps and joint steps bring it to its equilibrium. There is no landing, and no search for a way
//!    out: where a step is short, inertia makes the stiffness positive.
//! 4. A step that does not come there is halved.

use super::{
    Dynamics, Problem, Progress, Settings, Settled, Unsolvable,
    carry::push_out,
    descent::{case_of, finish, surface},
    film::Film,
    follow::{Carried, PRESSED, carried, go_along, same_cloth},
    joint::{Joint, Step},
    level::Level,
    rest::{Firmness, PATIENCE, Run, SWINGING, Standing},
    start::Start,
};
use crate::{
    body::Bodies,
    certificate::{Case, Passage, greatest_residual},
    contact::{Footing, Surface, Touches},
    forces::{GRAVITY, Momentum},
    math::Vec3,
};
use std::cell::OnceCell;

/// A step is divided into so many at most.
const PARTS: usize = 16;
/// Rounds of a step before it is halved.
const ROUNDS: usize = 32;
/// Sweeps before a joint step, where the last one moved a node by more than this part of a pitch: they
/// settle what strikes a body, for a fraction of what a joint step costs. (A ball that goes through a
/// curtain at 2 m/s took 600 joint steps without them, 114 with 4, 106 with 8.)
const SWEEPS: usize = 4;
const NEAR: f64 = 0.01;
/// Sweeps in a round of the paper's forces, which have no joint step.
const PLAIN_SWEEPS: usize = 20;
/// A step is done when what it asks for is this part of the tolerance, of what gravity moves in it.
const ENOUGH: f64 = 0.1;
/// Moves shorter than this [cm] are rounding.
const ROUNDING: f64 = 1e-9;

/// Ranges of a step [s], a damping [1/s] and a velocity [cm/s].
const SHORTEST: f64 = 1e-6;
const LONGEST: f64 = 10.0;
pub(super) const MOST_DAMPING: f64 = 1e4;
const FASTEST: f64 = 1e6;

/// Goes on in time, by a step for each of the bodies.
pub(super) fn go(
    problem: &Problem,
    through: &[Bodies],
    (positions, footing, velocities): (&[Vec3], &Footing, &[Vec3]),
    dynamics: Dynamics,
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unsolvable> {
    let lattice = problem.piece.cut(problem.piece.pitch)?;
    let start = Start::new(problem, &lattice)?;
    same_cloth(problem, through, (positions, footing), &lattice)?;
    check(&dynamics, velocities, positions.len())?;
    let surface = surface(problem);
    let case = case_of(problem, &lattice, &start, surface);
    let steps = through.len() + 1;
    let between: Vec<_> = (0..steps * PARTS).map(|_| OnceCell::new()).collect();
    let level = Level::new(&case, Touches::new(&lattice, surface), positions.to_vec());
    let mut journey = Journey {
        run: Run {
            watch,
            settings,
            levels: 1,
            film: Film::new(settings.frames),
            stopped: false,
            lands: false,
            firmness: Firmness::CARRIED,
        },
        joint: Joint::undamped(&level),
        holds: carried(&level, &start),
        level,
        case,
        surface,
        course: Course {
            first: footing.bodies(),
            stations: through.iter().chain([&problem.bodies]).collect(),
            between: &between,
        },
        dynamics,
        remaining: 0.0,
        last: None,
    };
    let mut moment = Moment {
        at: positions.to_vec(),
        velocities: velocities.to_vec(),
        footing: footing.clone(),
    };
    for number in 0..steps {
        let ticks = [number * PARTS, (number + 1) * PARTS];
        moment = journey.go(moment, ticks, number + 1 == steps);
        if journey.run.stopped {
            break;
        }
    }
    let settled = journey.end();
    Ok(Settled {
        frames: settled.1.develop(&[lattice]),
        ..settled.0
    })
}

/// Velocities of a cloth that goes along with its bodies [cm/s].
pub(super) fn borne(
    problem: &Problem,
    (positions, footing): (&[Vec3], &Footing),
    later: &Bodies,
    seconds: f64,
) -> Result<Vec<Vec3>, Unsolvable> {
    let lattice = problem.piece.cut(problem.piece.pitch)?;
    let held = Start::new(problem, &lattice)?.held;
    same_cloth(
        problem,
        core::slice::from_ref(later),
        (positions, footing),
        &lattice,
    )?;
    within("a time", seconds, SHORTEST..=LONGEST, "1e-6 to 10 s")?;
    let mut at = positions.to_vec();
    go_along(&mut at, &held, footing, &footing.carried(later));
    let ways = at.iter().zip(positions);
    Ok(ways.map(|(to, from)| (to - from) / seconds).collect())
}

/// Refuses steps that cannot be taken.
fn check(dynamics: &Dynamics, velocities: &[Vec3], nodes: usize) -> Result<(), Unsolvable> {
    let (step, damping) = (dynamics.step, dynamics.damping);
    within("a step of time", step, SHORTEST..=LONGEST, "1e-6 to 10 s")?;
    within(
        "damping",
        damping,
        0.0..=MOST_DAMPING,
        "0 to 1e4 per second",
    )?;
    for velocity in velocities {
        within("a speed", velocity.norm(), 0.0..=FASTEST, "0 to 1e6 cm/s")?;
    }
    if velocities.len() == nodes {
        Ok(())
    } else {
        Err(Unsolvable::Changed)
    }
}

fn within(
    quantity: &'static str,
    value: f64,
    range: core::ops::RangeInclusive<f64>,
    allowed: &'static str,
) -> Result<(), Unsolvable> {
    if range.contains(&value) {
        return Ok(());
    }
    Err(Unsolvable::Pace {
        quantity,
        value,
        allowed,
    })
}

/// Where the bodies are, in sixteenths of a step: at the end of each as they were given, and half way
/// between as often as is asked for.
struct Course<'a> {
    first: &'a Bodies,
    stations: Vec<&'a Bodies>,
    between: &'a [OnceCell<Bodies>],
}

impl<'a> Course<'a> {
    fn at(&self, tick: usize) -> &'a Bodies {
        if tick == 0 {
            return self.first;
        }
        if tick.is_multiple_of(PARTS) {
            return self.stations[tick / PARTS - 1];
        }
        let span = 1 << tick.trailing_zeros();
        let (before, after) = (tick - span, tick + span);
        self.between[tick].get_or_init(|| self.at(before).half_way(self.at(after)))
    }

    fn ticks(&self) -> usize {
        self.between.len()
    }
}

/// A cloth in motion, at a moment.
#[derive(Clone)]
struct Moment {
    at: Vec<Vec3>,
    velocities: Vec<Vec3>,
    footing: Footing,
}

/// A cloth on its way.
struct Journey<'a, 'w> {
    run: Run<'w>,
    level: Level<'a>,
    joint: Joint,
    case: Case<'a>,
    surface: Surface,
    course: Course<'a>,
    holds: Vec<Carried>,
    dynamics: Dynamics,
    /// The farthest that a node was from the equilibrium of any step [cm].
    remaining: f64,
    /// The moment before the last step, and how long that took [s].
    last: Option<(Moment, f64)>,
}

/// What came of a step.
struct Arrival {
    remaining: f64,
    is_there: bool,
}

impl Journey<'_, '_> {
    /// From one tick to another, at once or by halves; `ends` where the certificate will be asked.
    fn go(&mut self, from: Moment, [first, last]: [usize; 2], ends: bool) -> Moment {
        let step = self.dynamics.step * (last - first) as f64 / PARTS as f64;
        self.set_out(&from, last, step);
        let arrival = self.arrive(&from, step, ends);
        if self.run.stopped || arrival.is_there || last - first == 1 {
            let left = if arrival.is_there {
                arrival.remaining
            } else {
                f64::INFINITY
            };
            self.remaining = self.remaining.max(left);
            let ways = self.level.at.iter().zip(&from.at);
            let moment = Moment {
                velocities: ways.map(|(to, from)| (to - from) / step).collect(),
                at: self.level.at.clone(),
                footing: self
                    .level
                    .touches
                    .footing(&self.level.at, self.level.bodies),
            };
            self.last = Some((from, step));
            return moment;
        }
        let middle = (first + last) / 2;
        let there = self.go(from, [first, middle], false);
        if self.run.stopped {
            return there;
        }
        self.go(there, [middle, last], ends)
    }

    /// Moves bodies and holds to where they are at a tick, and the cloth to where it goes by itself.
    fn set_out(&mut self, from: &Moment, tick: usize, step: f64) {
        let level = &mut self.level;
        let bodies = self.course.at(tick);
        level.at.clone_from(&from.at);
        level.bodies = bodies;
        level.touches.stand_on(&from.footing.carried(bodies));
        let done = tick as f64 / self.course.ticks() as f64;
        for held in &self.holds {
            level.at[held.node] = held.from + held.way * done;
        }
        push_out(level, &self.surface, &from.at, PRESSED);
        let pitch = level.lattice.pitch;
        level.look(pitch, pitch);
        let momentum = Momentum::new(
            level.sheet.weights(),
            (&from.at, &from.velocities),
            step,
            self.dynamics.damping,
        );
        level.at = level.freely(|node| momentum.target(node) - level.at[node]);
        level.momentum = Some(momentum);
    }

    /// Brings the cloth to the equilibrium of its step.
    fn arrive(&mut self, from: &Moment, step: f64, ends: bool) -> Arrival {
        let passage = Passage {
            from: &from.at,
            velocities: &from.velocities,
            step,
            damping: self.dynamics.damping,
        };
        let case = Case {
            bodies: self.level.bodies,
            passage: Some(passage),
            ..self.case
        };
        let tolerance = self.run.settings.tolerance;
        let enough = (ENOUGH * tolerance * GRAVITY * step * step).max(ROUNDING);
        let standing = Standing::new(&self.level, 0);
        let mut made = self.level.lattice.pitch;
        let mut asked = f64::INFINITY;
        let mut remaining = f64::INFINITY;
        // Joint steps in a row that asked for too little to matter.
        let mut short = 0;
        for round in 0..ROUNDS {
            if !self.run.goes_on(&self.level, &standing) {
                remaining = f64::INFINITY;
                break;
            }
            let Some(next) = self.round(made) else {
                (made, short, remaining) = (0.0, 0, f64::INFINITY);
                continue;
            };
            made = next.made;
            // Moves that shrink to a part ρ have asked/(1 − ρ) to go.
            let left = next.asked / (1.0 - (next.asked / asked).min(1.0));
            remaining = if next.exact { left } else { f64::INFINITY };
            asked = next.asked;
            short = if next.exact && asked <= enough {
                short + 1
            } else {
                0
            };
            if short > 0 {
                remaining = asked;
            }
            let patient = round % PATIENCE == PATIENCE - 1;
            let known = short > usize::from(!self.level.touches.list().is_empty());
            let swings = patient && next.exact && asked < SWINGING;
            let balanced = || greatest_residual(&case, &self.level.at) <= 0.5 * tolerance;
            if (known && !ends) || ((known || swings) && balanced()) {
                return Arrival {
                    remaining: if known { remaining } else { asked },
                    is_there: true,
                };
            }
            if patient {
                self.level.touches.forget_features();
            }
        }
        Arrival {
            remaining,
            is_there: false,
        }
    }

    /// A joint step with what bodies are near, after sweeps where the last went far or nowhere.
    fn round(&mut self, made: f64) -> Option<Step> {
        let level = &mut self.level;
        if level.own_only {
            return Some(plain_round(level));
        }
        self.joint.look(level, made);
        if made == 0.0 || made > NEAR * level.lattice.pitch {
            for _ in 0..SWEEPS {
                level.sweep();
                level.touches.look_at_loads(&level.at);
            }
            self.joint.look(level, made);
        }
        self.joint.sure_step(level)
    }

    /// What came of it, and the film.
    fn end(self) -> (Settled, Film) {
        let work = vec![self.level.work()];
        let remaining = if self.run.stopped {
            f64::INFINITY
        } else {
            self.remaining
        };
        let passage = self.last.as_ref().map(|(from, step)| Passage {
            from: &from.at,
            velocities: &from.velocities,
            step: *step,
            damping: self.dynamics.damping,
        });
        let case = Case {
            passage,
            ..self.case
        };
        // One that was stopped is on its way to these bodies, and is judged by them.
        let settled = finish(&case, self.level, work, self.run.settings, remaining);
        (settled, self.run.film)
    }
}

/// Sweeps alone: the paper's forces have no energy.
fn plain_round(level: &mut Level<'_>) -> Step {
    let pitch = level.lattice.pitch;
    level.look(pitch, 0.1);
    let mut moved = 0.0;
    for _ in 0..PLAIN_SWEEPS {
        moved = level.sweep();
        level.touches.look_at_loads(&level.at);
    }
    Step {
        asked: moved,
        made: moved,
        exact: true,
        free: true,
    }
}
