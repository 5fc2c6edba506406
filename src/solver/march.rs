//! The march: how a cloth that has landed on bodies comes near rest. Each of its steps is one of
//! Newton's, by factors, and a sweep after it, that brings each node to its own equilibrium.
//!
//! 1. As long as the stiffness without its negative directions asks for much, its answer is the way.
//! 2. Where it asks for little, it would creep: there it leads conjugate gradients on the exact one,
//!    up to the trusted length, or along the first direction in which the energy falls ever faster
//!    (Steihaug 1983). It is so near to the exact one that two to thirty rounds are enough.
//! 3. Where those met no such direction, the way is the answer of the exact one's own factors.
//!
//! A straight way lengthens the rods that turn, and so may raise the energy. More steps of the first
//! kind take that back before energies are compared.

use super::{
    joint::Joint,
    leader::Leader,
    level::Level,
    model::{longest, trusted_answer},
    rest::{Run, Standing},
};
use crate::math::Vec3;

/// No node is led farther at once than this part of a pitch.
const LONGEST_MOVE: f64 = 0.8;
/// The way is searched for where the leading stiffness asks for less than this part of a pitch.
const LITTLE: f64 = 0.15;
/// Steps that take back what a way has lengthened. What led one that moved no node by more than this
/// part of a pitch is good enough to lead the next search.
const TAKING_BACK: usize = 3;
const STILL_GOOD: f64 = 0.1;
/// The trusted length grows by this factor after a step with nothing to take back, and shrinks where
/// there was more than one such step, or no lower energy in the end; to no less than this part of a
/// pitch.
const LONGER: f64 = 1.5;
const SHORTER: f64 = 0.7;
const MUCH_SHORTER: f64 = 0.4;
const SHORTEST: f64 = 0.02;
/// Below this part of a pitch it is damping that lacks.
const TOO_SHORT: f64 = 1e-4;
/// Damping times pitch at first, where there was none, and from where on there is none; what is left
/// of it after a step that went well, by how much it grows, and where it is given up.
const FIRST_DAMPING: f64 = 1.0;
const SOME_DAMPING: f64 = 1e-3;
const NO_DAMPING: f64 = 1e-6;
const EASED: f64 = 0.3;
const FIRMER: f64 = 4.0;
const MOST_DAMPING: f64 = 1e6;
/// Bodies are sought as far as so many trusted lengths.
const SIGHT: f64 = 2.0;
/// A cloth is near rest where its exact stiffness asks for less than this part of a pitch.
const NEAR: f64 = 0.05;
/// Most steps of a march.
const STEPS: usize = 300;

/// What a march has learnt of its cloth.
#[derive(Debug)]
pub(super) struct March {
    /// Damping of all nodes: stiffness per weight [1/cm].
    damping: f64,
    /// Length that steps are trusted to [cm].
    radius: f64,
    /// Whether the exact stiffness is taken to have factors.
    stable: bool,
    /// What leads the next search.
    kept: Option<Leader>,
}

/// Where a step is to go.
struct Way {
    moves: Vec<Vec3>,
    found: Found,
}

#[derive(Clone, Copy, PartialEq)]
enum Found {
    /// By the stiffness without its negative directions.
    Led,
    /// By a search.
    Sought,
    /// By the exact stiffness.
    Exactly,
}

impl Run<'_> {
    /// Marches until rest is near or the watcher ends it. `false` where the cloth does not come on by
    /// this.
    pub(super) fn march(
        &mut self,
        level: &mut Level<'_>,
        joint: &Joint,
        march: &mut March,
        standing: &Standing,
    ) -> bool {
        for _ in 0..STEPS {
            if !self.goes_on(level, standing) {
                return true;
            }
            match march.step(level, joint) {
                Some(true) => return true,
                Some(false) => {}
                None => return false,
            }
        }
        true
    }
}

impl March {
    /// Of a level of this pitch [cm].
    pub(super) fn new(pitch: f64) -> Self {
        Self {
            damping: FIRST_DAMPING / pitch,
            radius: LONGEST_MOVE * pitch,
            stable: false,
            kept: None,
        }
    }

    /// One step. Returns whether rest is near; `None` where no damping helps.
    fn step(&mut self, level: &mut Level<'_>, joint: &Joint) -> Option<bool> {
        let pitch = level.lattice.pitch;
        let sight = (SIGHT * self.radius).clamp(SHORTEST * pitch, LONGEST_MOVE * pitch);
        level.look(sight, sight);
        let from = level.at.clone();
        let energy = level.energy(&from);
        let Way { moves, found } = self.way(level, joint)?;
        let asked = longest(&moves);
        level.go_and_sweep(&moves, self.radius);
        let enough = energy + 1e-12 * energy.abs().max(1.0);
        let Some(taken_back) = self.take_back(level, joint, enough) else {
            level.at = from;
            self.kept = None;
            self.shrink(asked, pitch);
            return (self.damping < MOST_DAMPING / pitch).then_some(false);
        };
        if found != Found::Sought {
            self.kept = None;
        }
        self.learn(taken_back, pitch);
        self.stable |= found == Found::Exactly;
        Some(found == Found::Exactly && asked < NEAR * pitch)
    }

    /// Steps that take back what a way has lengthened, until the energy is no more than `enough`
    /// [gf·cm]. Returns how many; `None` where it is not.
    fn take_back(&mut self, level: &mut Level<'_>, joint: &Joint, enough: f64) -> Option<usize> {
        let pitch = level.lattice.pitch;
        for taken_back in 0..=TAKING_BACK {
            if level.energy(&level.at) <= enough {
                return Some(taken_back);
            }
            self.kept = None;
            if taken_back < TAKING_BACK {
                let (leader, moves) = self.led(level, joint)?;
                level.go_and_sweep(&moves, LONGEST_MOVE * pitch);
                self.kept = (longest(&moves) < STILL_GOOD * pitch).then_some(leader);
            }
        }
        None
    }

    /// Where to go; `None` where that is not known.
    fn way(&mut self, level: &mut Level<'_>, joint: &Joint) -> Option<Way> {
        let forces = level.forces(&level.at);
        if core::mem::take(&mut self.stable) {
            level.joint_steps += 1;
            if let Some(leader) = joint.exact_leader(level) {
                return Way::of(leader.answer(&forces), Found::Exactly);
            }
        }
        let leader = match self.kept.take() {
            Some(leader) => leader,
            None => {
                let (leader, moves) = self.firmly_led(level, joint)?;
                if longest(&moves) > LITTLE * level.lattice.pitch {
                    return Way::of(moves, Found::Led);
                }
                leader
            }
        };
        let exact = joint.evenly_damped(level, self.damping);
        let (moves, positive) = trusted_answer(&leader, &exact, &forces, self.radius);
        self.stable = positive && longest(&moves) < self.radius;
        Way::of(moves, Found::Sought)
    }

    /// What the leading stiffness answers here, with the damping that it needs.
    fn firmly_led(&mut self, level: &mut Level<'_>, joint: &Joint) -> Option<(Leader, Vec<Vec3>)> {
        let pitch = level.lattice.pitch;
        while self.damping < MOST_DAMPING / pitch {
            let led = self.led(level, joint);
            if led.is_some() {
                return led;
            }
            self.damp(pitch);
        }
        None
    }

    /// What the leading stiffness answers here; `None` where rounding makes it indefinite.
    fn led(&self, level: &mut Level<'_>, joint: &Joint) -> Option<(Leader, Vec<Vec3>)> {
        level.joint_steps += 1;
        let leader = joint.evenly_damped_leader(level, self.damping)?;
        let moves = leader.answer(&level.forces(&level.at));
        longest(&moves).is_finite().then_some((leader, moves))
    }

    fn damp(&mut self, pitch: f64) {
        self.damping = (FIRMER * self.damping).max(SOME_DAMPING / pitch);
    }

    /// Learns from a step that asked for so much [cm] and came to nothing.
    fn shrink(&mut self, asked: f64, pitch: f64) {
        self.radius = MUCH_SHORTER * self.radius.min(asked);
        if self.radius < TOO_SHORT * pitch {
            self.damp(pitch);
            self.radius = SHORTEST * pitch;
        }
    }

    /// Learns from a step that went well.
    fn learn(&mut self, taken_back: usize, pitch: f64) {
        match taken_back {
            0 => {
                self.radius = (LONGER * self.radius).min(LONGEST_MOVE * pitch);
                self.damping *= EASED;
                if self.damping < NO_DAMPING / pitch {
                    self.damping = 0.0;
                }
            }
            1 => {}
            _ => self.radius = (SHORTER * self.radius).max(SHORTEST * pitch),
        }
    }
}

impl Way {
    fn of(moves: Vec<Vec3>, found: Found) -> Option<Self> {
        longest(&moves).is_finite().then_some(Self { moves, found })
    }
}

impl Level<'_> {
    /// Goes along some moves, none longer than `most` [cm], as far as bodies leave free, and lets each
    /// node find its own equilibrium there.
    fn go_and_sweep(&mut self, moves: &[Vec3], most: f64) {
        let part = most / longest(moves).max(most);
        self.at = self.freely(|node| moves[node] * part);
        self.sweep();
    }
}
