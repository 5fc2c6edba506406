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
/// Touches farther away than so many moves of the last step are not felt in the next; those that are
/// felt are found for three times as far.
const AWAKE: f64 = 2.0;
const AWAKE_LATER: f64 = 3.0;
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
    /// How far nodes may still go before other touches could be felt [cm].
    clear: f64,
}

impl Inertia {
    /// Of a cloth that stands still.
    pub(super) fn none(level: &Level<'_>) -> Self {
        Self {
            before: level.at.clone(),
            run: 0,
            fastest: level.lattice.pitch,
            last: level.lattice.pitch,
            clear: 0.0,
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
        self.clear = 0.0;
    }

    /// Wakes the touches that could be felt by moves of `way` [cm], unless they are awake.
    fn wake(&mut self, level: &mut Level<'_>, way: f64) {
        if self.clear < way {
            self.clear = AWAKE_LATER * way;
            level.touches.wake(&level.at, self.clear);
        }
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
        number: usize,
        standing: &Standing,
        most: usize,
    ) {
        let pitch = level.lattice.pitch;
        let cap = LONGEST_MOVE * pitch;
        let mut energy = f64::INFINITY;
        let mut leader = None;
        for step in 0..most {
            if step % LOOKED_EVERY == 0 {
                if !self.goes_on(level, number, standing) {
                    return;
                }
                let way =
                    (2.0 * LOOKED_EVERY as f64 * inertia.fastest).clamp(0.005 * pitch, 0.8 * pitch);
                level.look(way, way);
                energy = f64::INFINITY;
                inertia.clear = 0.0;
                inertia.fastest = 0.0;
                leader = None;
            }
            if leader.is_none() {
                leader = joint.leader(level);
            }
            let Some(leads) = &leader else { return };
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
                    leader = None;
                }
                inertia.go_back(level, stride.from);
                continue;
            }
            energy = if calm { f64::INFINITY } else { now };
            inertia.before = stride.from;
            if joint.damp(&stride.asked, cap, TOO_FAR) {
                leader = None;
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
    fn stride(&mut self, leader: &Leader, inertia: &mut Inertia, cap: f64) -> Stride {
        let from = self.at.clone();
        let run = inertia.run as f64;
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
        inertia.wake(self, AWAKE * inertia.last);
        let begun = self.at.clone();
        let asked = leader.answer_smoothly(&self.quick_forces());
        self.at = self.freely(|node| {
            let way = asked[node] * PART;
            way * (cap / way.norm().max(cap))
        });
        self.sweep();
        let (made, climbs) = judge(&from, &begun, &self.at);
        // What was gone inertly before the touches were woken counts as well, to be safe.
        inertia.clear -= made;
        inertia.wake(self, 0.0);
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
    let moves = to.iter().zip(from).map(|(to, from)| (to - from).norm());
    (moves.fold(0.0, f64::max), against > 0.0)
}
