//! The joint step: system (8) written for all nodes at once, so that a cloth near rest comes there
//! in a few steps, quadratically.
//!
//! 1. The derivative of all forces by all positions is assembled: the exact one, and one without
//!    its negative directions, which leads.
//! 2. The exact one is solved by its factors; on a large lattice by factors in 32 bits, whose answers
//!    conjugate gradients put right. Where it has none the shape is not stable: conjugate
//!    gradients seek the way down, and there is no step; nor where the step would be long: unless
//!    other steps go even less far, then the energy's fall is followed as far as is trusted.
//! 3. The step is cut to the trusted length, and each node to the way that bodies leave free. It is
//!    corrected for what turning has lengthened, and halved until the energy falls.
//! 4. A cloth that lands is far from rest: nodes that ask for more than is trusted are damped, and
//!    the step is asked for again, so that a flap that swings does not hold the rest back.

use super::{
    factor::Plan,
    leader::{Leader, Way, plan_of},
    level::Level,
    model::{Answer, exact_answer, longest, near_answer, way_out},
    packed::{Layout, Packed},
    stiffness::{Pattern, Stiffness, Sum},
};
use crate::math::{Mat3, Vec3};
use std::{cell::OnceCell, sync::Arc};

/// A node moves at most this part of a pitch in a joint step.
const LONGEST_MOVE: f64 = 0.4;
/// Damping times pitch at first.
const FIRST_DAMPING: f64 = 4.0;
/// Damping times pitch is never below this in a damped step.
const LEAST_DAMPING: f64 = 0.001;
/// A node counts as damped where damping times pitch is above this.
const DAMPED: f64 = 0.1;
/// A damped step that asks for more than so many trusted lengths is asked for again, with the nodes
/// that did damped: cut short as it is, it would bring the rest of the cloth nowhere.
const TOO_FAR: f64 = 2.0;
const ASKED_AGAIN: usize = 3;
/// A step that asks for less than this part of a pitch is short.
const NEAR: f64 = 0.5;
/// A joint step takes as long as about so many steps with inertia.
const STEPS_IN_TIME: f64 = 30.0;
/// Most steps of a finish, and the move [cm] that ends it.
const FINISHING: usize = 6;
const FINISHED: f64 = 1e-5;
/// Lattices of more nodes than this are not factored: it takes n^1.5 operations, and 5 GB for
/// 263,169.
const MOST_FACTORED: usize = 300_000;
/// On lattices of more nodes than this steps are by factors in 32 bits: below, no one waits for them.
/// That a shape at rest is stable is proved by 64 on any.
const ROUNDED: usize = 10_000;
/// Corrections after a joint step.
const CORRECTIONS: usize = 3;
/// All nodes are damped tenfold at most so often for a matrix that has no answer.
const DAMPED_MORE: usize = 12;
/// A step is halved at most so often.
const HALVINGS: usize = 8;

/// Whether a level is small enough to be factored.
pub(super) fn has_factors(level: &Level<'_>) -> bool {
    level.at.len() <= MOST_FACTORED
}

/// The joint system and what was learnt of the steps it may ask for.
#[derive(Debug)]
pub(super) struct Joint {
    way: Way,
    pattern: Arc<Pattern>,
    layout: Arc<Layout>,
    /// How the exact matrix is factored: found when it first is.
    plan: OnceCell<Arc<Plan>>,
    /// Damping of each node in what leads: stiffness per weight [1/cm].
    damping: Vec<f64>,
    /// Length that steps are trusted to [cm].
    radius: f64,
    /// How far the level has looked for touches [cm]: no step is longer.
    pub(super) sight: f64,
}

/// What a joint step came to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Longest move that the system asked for [cm].
    pub(super) asked: f64,
    /// Longest move made [cm].
    pub(super) made: f64,
    /// Whether it was taken by the exact, undamped stiffness, and no negative direction was met. A
    /// bold step searches roughly; what it leaves is for [`Joint::finish`] and the last look for a
    /// way out.
    pub(super) exact: bool,
    /// Whether no more than one node in a hundred was damped, so that what was asked for is what
    /// the cloth wants.
    pub(super) free: bool,
}

impl Step {
    /// Whether rest may be near.
    pub(super) fn is_near(&self, pitch: f64) -> bool {
        let moving = self.made > 0.0 || self.asked == 0.0;
        self.free && self.asked < NEAR * pitch && moving
    }

    /// Whether the cloth wants to go less than this [cm].
    pub(super) fn wants_less_than(&self, way: f64) -> bool {
        self.free && self.asked < way
    }
}

impl Joint {
    pub(super) fn new(level: &Level<'_>) -> Self {
        Self::damped_by(level, FIRST_DAMPING / level.lattice.pitch)
    }

    /// Of a cloth in motion, which inertia steadies.
    pub(super) fn undamped(level: &Level<'_>) -> Self {
        Self::damped_by(level, 0.0)
    }

    fn damped_by(level: &Level<'_>, damping: f64) -> Self {
        let (way, pattern) = Way::of(level);
        let free: Vec<u32> = (0..level.at.len() as u32)
            .filter(|node| !level.held[*node as usize])
            .collect();
        Self {
            way,
            layout: Layout::new(&pattern, [free.as_slice()]).into(),
            pattern,
            plan: OnceCell::new(),
            damping: vec![damping; level.at.len()],
            radius: 0.2 * level.lattice.pitch,
            sight: 0.0,
        }
    }

    /// The derivative at the level's positions, exact or without its negative directions.
    fn assembled(&self, level: &Level<'_>, positive: bool) -> Stiffness {
        let mut matrix = Sum::new(Arc::clone(&self.pattern));
        let at = &level.at;
        level
            .sheet
            .stiffness(at, positive, &mut |row, column, block| {
                matrix.add(row, column, block);
            });
        level.touches.stiffness(at, &mut |row, column, block| {
            matrix.add(row, column, block);
        });
        if let Some(momentum) = &level.momentum {
            for node in 0..at.len() {
                let block = Mat3::identity() * momentum.stiffness(node);
                matrix.add(node as u32, node as u32, &block);
            }
        }
        matrix.whole()
    }

    /// The same with the nodes' damping.
    fn damped(&self, level: &Level<'_>, positive: bool) -> Stiffness {
        self.damped_as(level, positive, |node| self.damping[node])
    }

    /// The same with each node's `damping` [1/cm].
    fn damped_as(
        &self,
        level: &Level<'_>,
        positive: bool,
        damping: impl Fn(usize) -> f64,
    ) -> Stiffness {
        let mut matrix = self.assembled(level, positive);
        for (node, weight) in level.sheet.measures().iter().enumerate() {
            matrix.add_own(node, &(Mat3::identity() * (weight * damping(node))));
        }
        matrix
    }

    fn packed(&self, matrix: &Stiffness) -> Packed<f64> {
        Packed::new(&self.layout, matrix)
    }

    /// What leads: the damped positive matrix. Where rounding makes it indefinite, as crushed rods
    /// may, all nodes are damped more; `None` where nothing helps.
    pub(super) fn leader(&mut self, level: &Level<'_>) -> Option<Leader> {
        self.positive(level, Leader::new)
    }

    /// What leads steps with inertia: of the same matrix's answers, what sweeps would take long to find.
    pub(super) fn guide(&mut self, level: &Level<'_>) -> Option<Leader> {
        self.positive(level, Leader::smooth)
    }

    fn positive(
        &mut self,
        level: &Level<'_>,
        lead: fn(&Way, &Stiffness) -> Option<Leader>,
    ) -> Option<Leader> {
        for _ in 0..DAMPED_MORE {
            let leader = lead(&self.way, &self.damped(level, true));
            if leader.is_some() {
                return leader;
            }
            for damping in &mut self.damping {
                *damping = 10.0 * damping.max(1e-3 / level.lattice.pitch);
            }
        }
        None
    }

    /// One step; the level has just looked at its touches. Where the shape is not stable, or rest is
    /// not near, a `bold` step follows the energy's fall, and one that is not is `None`.
    pub(super) fn step(&mut self, level: &mut Level<'_>, bold: bool) -> Option<Step> {
        self.step_after(level, bold, bold)
    }

    /// A bold step after a search to the end: where one or two are all that a cloth needs.
    pub(super) fn sure_step(&mut self, level: &mut Level<'_>) -> Option<Step> {
        self.step_after(level, false, true)
    }

    fn step_after(&mut self, level: &mut Level<'_>, rough: bool, bold: bool) -> Option<Step> {
        level.joint_steps += 1;
        let forces = level.forces(&level.at);
        let far = level.lattice.pitch;
        let (leader, answer) = self.ask(level, &forces, far, rough)?;
        let (moves, exact) = match answer {
            Answer::Moves(moves) if longest(&moves) < NEAR * far => (moves, true),
            Answer::Moves(moves) | Answer::Downhill(moves) if bold => (moves, false),
            _ => return None,
        };
        let asked = longest(&moves);
        if asked.is_nan() {
            return None;
        }
        let made = self.descend(level, &leader, &moves);
        Some(Step {
            asked,
            made,
            exact,
            free: exact,
        })
    }

    /// What the exact stiffness asks for [cm], or a way downhill, followed no farther than `far` [cm];
    /// `None` where it is not known.
    pub(super) fn wish(&mut self, level: &mut Level<'_>, far: f64) -> Option<Vec<Vec3>> {
        level.joint_steps += 1;
        let forces = level.forces(&level.at);
        match self.ask(level, &forces, far, true)?.1 {
            Answer::Moves(moves) | Answer::Downhill(moves) => Some(moves),
            Answer::Unclear => None,
        }
        .filter(|moves| longest(moves).is_finite())
    }

    /// What the exact stiffness answers to forces [gf], a search followed no farther than `far` [cm], and
    /// what leads there.
    fn ask(
        &mut self,
        level: &Level<'_>,
        forces: &[Vec3],
        far: f64,
        rough: bool,
    ) -> Option<(Leader, Answer)> {
        let exact = self.assembled(level, false);
        let leader = match self.factored_to_step(level, &exact, rough) {
            Some(factored @ Leader::Factors(..)) => {
                let moves = factored.answer(forces);
                return Some((factored, Answer::Moves(moves)));
            }
            Some(rounded) => rounded,
            None => self.leader(level)?,
        };
        let answer = exact_answer(&leader, &self.packed(&exact), forces, far, rough);
        Some((leader, answer))
    }

    /// The factors that a step is found by: on a large lattice in 32 bits, since they only lead. Where
    /// rounding makes the matrix indefinite, a `rough` answer is not worth those in 64.
    fn factored_to_step(
        &self,
        level: &Level<'_>,
        stiffness: &Stiffness,
        rough: bool,
    ) -> Option<Leader> {
        if level.at.len() <= ROUNDED {
            self.factored(level, stiffness)
        } else if rough {
            Leader::rounded(self.plan(level)?, stiffness)
        } else {
            Leader::by_rounded_factors(self.plan(level)?, stiffness)
        }
    }

    /// A stiffness by its factors: `None` where it is not positive definite; of the exact one, the shape
    /// is not known to be stable then.
    fn factored(&self, level: &Level<'_>, stiffness: &Stiffness) -> Option<Leader> {
        Leader::by_factors(self.plan(level)?, stiffness)
    }

    /// How a level's matrices are factored; `None` of one that is too large.
    fn plan(&self, level: &Level<'_>) -> Option<&Arc<Plan>> {
        has_factors(level).then(|| {
            self.plan.get_or_init(|| match &self.way {
                Way::Factors(plan) => Arc::clone(plan),
                Way::Levels(_) => plan_of(level, &self.pattern).into(),
            })
        })
    }

    /// The exact stiffness by its factors, if it has them.
    pub(super) fn exact_leader(&self, level: &Level<'_>) -> Option<Leader> {
        self.factored(level, &self.assembled(level, false))
    }

    /// The stiffness without its negative directions by its factors, all nodes damped alike [1/cm]. The
    /// energy judges where it leads.
    pub(super) fn evenly_damped_leader(&self, level: &Level<'_>, damping: f64) -> Option<Leader> {
        let matrix = self.damped_as(level, true, |_| damping);
        self.factored_to_step(level, &matrix, false)
    }

    /// The exact stiffness, all nodes damped alike [1/cm].
    pub(super) fn evenly_damped(&self, level: &Level<'_>, damping: f64) -> Packed<f64> {
        self.packed(&self.damped_as(level, false, |_| damping))
    }

    /// Whether a joint step is trusted to go farther than the steps with inertia that could be taken
    /// in its time, each of so much [cm].
    pub(super) fn goes_farther_than(&self, steps: f64) -> bool {
        self.radius > STEPS_IN_TIME * steps
    }

    /// A step of a cloth that is far from rest: by the exact stiffness, damped where nodes ask for
    /// more than is trusted. The level has just looked at its touches.
    pub(super) fn damped_step(&mut self, level: &mut Level<'_>) -> Option<Step> {
        level.joint_steps += 1;
        let forces = level.forces(&level.at);
        let (mut leader, mut moves) = self.ask_damped(level, &forces)?;
        for _ in 0..ASKED_AGAIN {
            if longest(&moves) <= TOO_FAR * self.radius {
                break;
            }
            self.damp(&moves, self.radius, 1.0);
            (leader, moves) = self.ask_damped(level, &forces)?;
        }
        let asked = longest(&moves);
        let made = if asked.is_finite() {
            self.descend(level, &leader, &moves)
        } else {
            0.0
        };
        let pitch = level.lattice.pitch;
        let damped = self.damping.iter().filter(|one| **one > DAMPED / pitch);
        let free = 100 * damped.count() <= level.at.len();
        self.damp(&moves, self.radius, 1.0);
        self.free(&moves, self.radius, 0.5, LEAST_DAMPING / pitch);
        Some(Step {
            asked,
            made,
            exact: false,
            free,
        })
    }

    fn ask_damped(&mut self, level: &Level<'_>, forces: &[Vec3]) -> Option<(Leader, Vec<Vec3>)> {
        let leader = self.leader(level)?;
        let damped = self.packed(&self.damped(level, false));
        let far = 4.0 * self.radius;
        let moves = near_answer(&leader, &damped, forces, far);
        Some((leader, moves))
    }

    /// Damps all nodes, where even a step without inertia was too long.
    pub(super) fn damp_all(&mut self, pitch: f64) {
        for damping in &mut self.damping {
            *damping = (4.0 * *damping).max(DAMPED / pitch);
        }
    }

    /// Damps nodes that asked for more than so many `times` what is `trusted` [cm]. Returns whether
    /// any did.
    pub(super) fn damp(&mut self, moves: &[Vec3], trusted: f64, times: f64) -> bool {
        let mut any = false;
        for (damping, way) in self.damping.iter_mut().zip(moves) {
            let asked = way.norm() / trusted;
            if asked > times {
                *damping = damping.max(0.1 / trusted) * asked.clamp(1.5, 10.0);
                any = true;
            }
        }
        any
    }

    /// Leaves nodes that asked for less than half of what is `trusted` [cm] a part of their damping,
    /// and no less than `least` [1/cm].
    pub(super) fn free(&mut self, moves: &[Vec3], trusted: f64, part: f64, least: f64) {
        for (damping, way) in self.damping.iter_mut().zip(moves) {
            if way.norm() / trusted < 0.5 {
                *damping = (*damping * part).max(least);
            }
        }
    }

    /// A direction in which the energy falls from a shape without forces, in moves [cm] of any
    /// length; `None` where none was found.
    pub(super) fn way_out(&mut self, level: &Level<'_>) -> Option<Vec<Vec3>> {
        let exact = self.assembled(level, false);
        if self.factored(level, &exact).is_some() {
            return None;
        }
        let leader = self.leader(level)?;
        way_out(&leader, &self.packed(&exact), &level.any_forces())
    }

    /// Steps on from one that asked for so much [cm], with the touches as they were last seen, where
    /// nothing but smooth laws is left and steps converge quadratically.
    pub(super) fn finish(&mut self, level: &mut Level<'_>, mut asked: f64) {
        for _ in 0..FINISHING {
            if asked <= FINISHED {
                break;
            }
            match self.step(level, false) {
                Some(step) => asked = step.asked,
                None => break,
            }
        }
    }

    /// Halves the step until the energy falls, and learns how far steps can be trusted. Returns the
    /// longest move made [cm], 0 where none lowers the energy.
    fn descend(&mut self, level: &mut Level<'_>, leader: &Leader, moves: &[Vec3]) -> f64 {
        let before = level.energy(&level.at);
        let noise = 1e-12 * before.abs().max(1.0);
        let longest_move = LONGEST_MOVE * level.lattice.pitch;
        let asked = longest(moves).max(1e-300);
        // What leads answers to the forces here.
        let first = leader.answer(&level.forces(&level.at));
        let mut part = (self.sight.min(2.0 * self.radius) / asked).min(1.0);
        for halvings in 0..HALVINGS {
            let to = corrected(level, leader, moves, &first, part);
            if level.energy(&to) <= before + noise {
                let ways = to.iter().zip(&level.at).map(|(to, at)| (to - at).norm());
                let made = ways.fold(0.0, f64::max);
                level.at = to;
                if halvings > 0 {
                    self.radius *= 0.7;
                } else if asked * part > 0.5 * self.radius {
                    self.radius = (1.3 * self.radius).min(longest_move);
                }
                self.radius = self.radius.max(1e-3 * longest_move);
                return made;
            }
            part *= 0.5;
        }
        self.radius = (0.3 * self.radius).max(1e-3 * longest_move);
        0.0
    }
}

/// A part of the step, and after it what leads says of the forces that turning has raised: rods that
/// a straight move lengthened come back to their length.
fn corrected(
    level: &Level<'_>,
    leader: &Leader,
    moves: &[Vec3],
    first: &[Vec3],
    part: f64,
) -> Vec<Vec3> {
    let mut to = level.freely(|node| moves[node] * part);
    let mut energy = level.energy(&to);
    for _ in 0..CORRECTIONS {
        let answer = leader.answer(&level.forces(&to));
        let way =
            |node: usize| to[node] - level.at[node] + answer[node] - first[node] * (1.0 - part);
        let next = level.freely(way);
        let lower = level.energy(&next);
        if lower.is_nan() || lower >= energy {
            break;
        }
        (to, energy) = (next, lower);
    }
    to
}
