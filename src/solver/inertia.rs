//! Steps with inertia, that bring a cloth near rest from afar: each starts where the cloth would be
//! if it went on as it went (Nesterov 1983), and is
//! 1. what a positive, damped stiffness, summed up on the coarser lattices, answers to the forces
//!    there: what a sweep would take thousands of times to find,
//! 2. a sweep, that brings each node to its own equilibrium.
//!
//! A cloth that has begun to climb is stopped and starts anew (O'Donoghue & Candès 2015).

use super::{
    joint::Joint,
    leader::Leader,
    level::Level,
    model::longest,
    rest::{Run, Standing},
};
use crate::{math::Vec3, threads};

/// Steps between two looks at the bodies and at the stiffness.
const LOOKED_EVERY: usize = 10;
/// A node goes no farther in a step than this part of a pitch: a rod that turns by more is lengthened
/// by more than cloth yields.
const LONGEST_MOVE: f64 = 0.05;
/// Of what the stiffness answers, this part is done: steps with inertia overshoot by a third at most
/// (Nesterov's bound is 4/3 of the stiffness), and stiffness grows with strain.
const PART: f64 = 0.7;
/// Nodes that ask for more than so many longest moves are damped; those that ask for little keep this
/// part of their damping, and no less than so much [1/cm].
const TOO_FAR: f64 = 2.0;
const FREED: f64 = 0.8;
const LEAST_DAMPING: f64 = 0.02;
/// No node is in haste when none asks for more than this part of the longest move.
const CALM: f64 = 0.2;
/// Touches are felt as far away as so many last steps of their nodes go, and the longest of all: felt
/// too late, they would throw the cloth back. They are found as far as so many ways since the last look
/// and this part of what the fastest could go.
const AWAKE: f64 = 3.0;
const SEEN: f64 = 2.0;
const SEEN_ANYWHERE: f64 = 0.5;
/// A stop after more steps than this, with no node in haste, is one near rest.
const LONG_RUN: usize = 30;

/// How a cloth goes on by itself.
#[derive(Debug)]
pub(super) struct Inertia {
    /// Positions before the last step [cm].
    before: Vec<Vec3>,
    /// Steps since the last stop.
    run: usize,
    /// Longest ways of a step, since the last look and of the last step [cm].
    fastest: f64,
    pub(super) last: f64,
    /// Positions at the last look [cm].
    seen: Vec<Vec3>,
}

impl Inertia {
    /// Of a cloth that stands still.
    pub(super) fn none(level: &Level<'_>) -> Self {
        Self {
            before: level.at.clone(),
            run: 0,
            fastest: level.lattice.pitch,
            last: level.lattice.pitch,
            seen: level.at.clone(),
        }
    }

    /// Of a cloth that has just leapt so far [cm].
    pub(super) fn after(level: &Level<'_>, way: f64) -> Self {
        Self {
            fastest: way,
            last: way,
            ..Self::none(level)
        }
    }

    /// The cloth has gone on by other means; how fast it went is kept.
    pub(super) fn stop(&mut self, level: &Level<'_>) {
        self.before.clone_from(&level.at);
        self.run = 0;
    }

    /// Takes a step back, and stops.
    fn go_back(&mut self, level: &mut Level<'_>, to: Vec<Vec3>) {
        self.before.clone_from(&to);
        self.run = 0;
        level.at = to;
    }

    /// Wakes the touches that could be felt in a step, and measures what is clear for it, by how far each
    /// node went in the last one.
    fn wake(&self, level: &mut Level<'_>) {
        let (before, at) = (&self.before, &level.at);
        let way = |node: usize| AWAKE * (at[node] - before[node]).norm() + self.last;
        let ways: Vec<f64> = threads::map(at.len(), way);
        level.touches.wake(&level.at, |node| ways[node]);
        level
            .touches
            .measure(&level.at, level.bodies, |node| ways[node]);
    }

    /// Looks about for as long as the next steps may go, by how the nodes went since the last look.
    fn look(&mut self, level: &mut Level<'_>) {
        let pitch = level.lattice.pitch;
        let any = (LOOKED_EVERY as f64 * self.fastest).clamp(0.005 * pitch, 0.8 * pitch);
        let way = |node: usize| {
            let gone = (level.at[node] - self.seen[node]).norm();
            (SEEN * gone + SEEN_ANYWHERE * any).min(2.0 * any)
        };
        let ways: Vec<f64> = threads::map(level.at.len(), way);
        level.look_about(|node| [ways[node]; 2]);
        self.seen.clone_from(&level.at);
        self.fastest = 0.0;
    }
}

/// Steps shorter than this part of a pitch are those of a cloth at rest.
const STILL: f64 = 1e-6;

impl Run<'_> {
    /// Brings a level nearer to rest, until it comes to a stop or by so many steps.
    pub(super) fn glide(
        &mut self,
        level: &mut Level<'_>,
        joint: &mut Joint,
        inertia: &mut Inertia,
        standing: &Standing,
        most: usize,
    ) {
        let pitch = level.lattice.pitch;
        let cap = LONGEST_MOVE * pitch;
        let mut energy = f64::INFINITY;
        let mut guide = None;
        for step in 0..most {
            if step % LOOKED_EVERY == 0 {
                if !self.goes_on(level, standing) {
                    return;
                }
                inertia.look(level);
                energy = f64::INFINITY;
                guide = None;
            }
            if guide.is_none() {
                guide = joint.guide(level);
            }
            let Some(leads) = &guide else { return };
            let stride = level.stride(leads, inertia, cap);
            inertia.fastest = f64::max(inertia.fastest, stride.made);
            inertia.last = stride.made;
            let calm = longest(&stride.asked) < CALM * cap;
            // What moves so little by little need not be looked at each time.
            let now = if calm {
                f64::NEG_INFINITY
            } else {
                level.energy(&level.at)
            };
            if now > energy + 1e-12 * energy.abs().max(1.0) {
                if inertia.run == 0 {
                    joint.damp_all(pitch);
                    guide = None;
                }
                inertia.go_back(level, stride.from);
                continue;
            }
            energy = if calm { f64::INFINITY } else { now };
            inertia.before = stride.from;
            if joint.damp(&stride.asked, cap, TOO_FAR) {
                guide = None;
            }
            joint.free(&stride.asked, cap, FREED, LEAST_DAMPING);
            let at_turn = stride.climbs && inertia.run > LONG_RUN && calm;
            inertia.run = if stride.climbs { 0 } else { inertia.run + 1 };
            if at_turn || stride.made < STILL * pitch {
                return;
            }
        }
    }
}

/// What a step with inertia came to.
struct Stride {
    /// Positions before it [cm].
    from: Vec<Vec3>,
    /// What the leading stiffness asked for [cm].
    asked: Vec<Vec3>,
    /// Longest move [cm].
    made: f64,
    /// Whether it went against what went before.
    climbs: bool,
}

impl Level<'_> {
    /// One step with inertia, no node led farther than `cap` [cm].
    fn stride(&mut self, guide: &Leader, inertia: &mut Inertia, cap: f64) -> Stride {
        let from = self.at.clone();
        let run = inertia.run as f64;
        inertia.wake(self);
        if inertia.run > 0 {
            self.at = self.freely(|node| {
                // Friction takes up what goes on by itself.
                let part = if self.touches.rubs(node) {
                    0.0
                } else {
                    run / (run + 3.0)
                };
                (from[node] - inertia.before[node]) * part
            });
        }
        let begun = self.at.clone();
        let asked = guide.answer(&self.quick_forces());
        self.at = self.freely(|node| {
            let way = asked[node] * PART;
            way * (cap / way.norm().max(cap))
        });
        self.sweep();
        let (made, climbs) = judge(&from, &begun, &self.at);
        Stride {
            from,
            asked,
            made,
            climbs,
        }
    }
}

/// The longest way of a step [cm], and whether the step itself went against what went before.
fn judge(from: &[Vec3], begun: &[Vec3], to: &[Vec3]) -> (f64, bool) {
    let against = threads::sum(to.len(), |node| {
        (begun[node] - to[node]).dot(&(to[node] - from[node]))
    });
    let longest = threads::most(to.len(), |node| (to[node] - from[node]).norm());
    (longest, against > 0.0)
}
