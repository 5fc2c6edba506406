//! The joint step: system (8) written for all nodes at once, so that a move of the whole cloth
//! that each node alone would take thousands of sweeps to feel is made in one.
//!
//! 1. Two derivatives of all forces by all positions are assembled: the exact one, and one without
//!    its negative directions, which is factored. Each node's weight, times a damping of its own,
//!    is added to both.
//! 2. The exact one is solved by conjugate gradients that the factors lead. Where nodes ask for far
//!    more than is trusted, they are damped and it is solved again.
//! 3. The step is cut to the trusted length, and each node to the way that bodies leave free. It is
//!    corrected for what turning has lengthened, and halved until the energy falls.
//! 4. Nodes that asked for too much are damped more next time, others less: a flap that swings
//!    does not hold the rest of the cloth back.
//! 5. Near rest the exact derivative alone is factored; steps then converge quadratically.

use super::{
    factor::{Factor, Plan},
    level::Level,
    model::{Model, longest},
    stiffness::Stiffness,
};
use crate::math::{Mat3, Vec3};

/// A node moves at most this part of a pitch in a joint step.
const LONGEST_MOVE: f64 = 0.8;
/// A step that asks for less than this part of a pitch is short.
const NEAR: f64 = 0.5;
/// Most steps of a finish, and the move [cm] that ends it.
const FINISHING: usize = 6;
const FINISHED: f64 = 1e-7;
/// Corrections after a joint step: each costs a tenth of the factors.
const CORRECTIONS: usize = 3;
/// Damping times pitch is never below this.
const LEAST_DAMPING: f64 = 0.001;
/// A node is restless when it asks for more than this part of the longest move.
const RESTLESS: f64 = 0.1;
/// Visits to restless nodes cost as much as so many sweeps over all, and are no more than so many.
const RESTLESS_SWEEPS: usize = 3;
const MOST_VISITS: usize = 60;
/// A node counts as damped where damping times pitch is above this.
const DAMPED: f64 = 0.1;
/// A step that asks for more than so many trusted lengths is asked for again, with the nodes that
/// did damped: cut short as it is, it would bring the rest of the cloth nowhere.
const TOO_FAR: f64 = 2.0;
const ASKED_AGAIN: usize = 3;
/// All nodes are damped tenfold at most so often for a matrix that cannot be factored.
const DAMPED_MORE: usize = 12;
/// A step is halved at most so often.
const HALVINGS: usize = 8;

/// The joint system and what was learnt of the steps it may ask for.
#[derive(Debug)]
pub(super) struct Joint {
    plan: Plan,
    exact: Stiffness,
    positive: Stiffness,
    /// Damping of each node: stiffness per weight [1/cm].
    pub(super) damping: Vec<f64>,
    /// Nodes that asked for much in the last step, by colours.
    pub(super) restless: Vec<Vec<u32>>,
    /// Length that steps are trusted to [cm].
    radius: f64,
    /// How far the level has looked for touches [cm]: no step is longer.
    pub(super) sight: f64,
    /// Whether the last step was short: rest may be near, and the exact matrix is tried.
    pub(super) near: bool,
}

/// What a joint step came to.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Longest move that the system asked for [cm].
    pub(super) asked: f64,
    /// Longest move made [cm].
    pub(super) made: f64,
    /// Whether the exact, undamped matrix was positive definite: the shape is stable.
    pub(super) exact: bool,
    /// Whether no more than one node in a hundred was damped, so that what was asked for is what
    /// the cloth wants.
    pub(super) free: bool,
}

/// Which derivative is meant.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Exact,
    Damped,
    PositiveDamped,
}

impl Joint {
    pub(super) fn new(level: &Level<'_>) -> Self {
        let (plan, exact) = level.plan();
        Self {
            plan,
            positive: exact.clone(),
            exact,
            damping: vec![4.0 / level.lattice.pitch; level.at.len()],
            restless: Vec::new(),
            radius: 0.2 * level.lattice.pitch,
            sight: 0.0,
            near: false,
        }
    }

    /// For a part of the cloth, that knows what was learnt of it.
    pub(super) fn of_patch(&self, level: &Level<'_>, damping: Vec<f64>) -> Self {
        Self {
            damping,
            radius: self.radius,
            ..Self::new(level)
        }
    }

    /// How often restless nodes are visited before the next step: few of them often, many seldom,
    /// so that it costs as much as so many sweeps.
    pub(super) fn visits(&self, level: &Level<'_>) -> usize {
        let restless: usize = self.restless.iter().map(Vec::len).sum();
        (RESTLESS_SWEEPS * level.at.len() / restless.max(1)).min(MOST_VISITS)
    }

    /// Assembles a derivative at the level's positions.
    fn assemble(&mut self, level: &Level<'_>, kind: Kind) {
        let positive = kind == Kind::PositiveDamped;
        let matrix = if positive {
            &mut self.positive
        } else {
            &mut self.exact
        };
        matrix.clear();
        let at = &level.at;
        level
            .sheet
            .stiffness(at, positive, &mut |row, column, block| {
                matrix.add(row, column, block);
            });
        level.touches.stiffness(at, &mut |row, column, block| {
            matrix.add(row, column, block);
        });
        if kind == Kind::Exact {
            return;
        }
        let weights = level.sheet.weights().iter().zip(&self.damping);
        for (node, (weight, damping)) in weights.enumerate() {
            let block = Mat3::identity() * (weight * damping);
            matrix.add(node as u32, node as u32, &block);
        }
    }

    /// One step; the level has just looked at its touches. `None` where even the positive matrix
    /// cannot be factored.
    pub(super) fn step(&mut self, level: &mut Level<'_>) -> Option<Step> {
        level.joint_steps += 1;
        let forces = level.forces(&level.at);
        if self.near
            && let Some(step) = self.exact_step(level, &forces)
        {
            return Some(step);
        }
        self.damped_step(level, &forces)
    }

    /// A step by the exact matrix, if it is positive definite and asks for little.
    fn exact_step(&mut self, level: &mut Level<'_>, forces: &[Vec3]) -> Option<Step> {
        self.near = false;
        self.assemble(level, Kind::Exact);
        let factor = Factor::new(&self.plan, &self.exact)?;
        let moves = factor.solve(&self.plan, forces);
        let asked = longest(&moves);
        if asked.is_nan() || asked >= NEAR * level.lattice.pitch {
            return None;
        }
        let made = self.descend(level, &factor, &moves, &moves);
        self.mark_restless(level, &moves, asked);
        self.near = true;
        Some(Step {
            asked,
            made,
            exact: true,
            free: true,
        })
    }

    /// A step by the exact matrix with damping, led by factors of the positive one.
    fn damped_step(&mut self, level: &mut Level<'_>, forces: &[Vec3]) -> Option<Step> {
        let (mut factor, mut model) = self.ask(level, forces)?;
        for _ in 0..ASKED_AGAIN {
            if longest(&model.moves) <= TOO_FAR * self.radius {
                break;
            }
            self.damp(&model.moves);
            (factor, model) = self.ask(level, forces)?;
        }
        let asked = longest(&model.moves);
        let made = if asked.is_finite() {
            self.descend(level, &factor, &model.moves, &model.first)
        } else {
            0.0
        };
        let damped = self
            .damping
            .iter()
            .filter(|damping| **damping > DAMPED / level.lattice.pitch);
        let free = 100 * damped.count() <= level.at.len();
        self.damp(&model.moves);
        self.free(level.lattice.pitch, &model.moves);
        self.mark_restless(level, &model.moves, asked);
        let still = made > 0.0 || asked == 0.0;
        self.near = free && asked < NEAR * level.lattice.pitch && still;
        Some(Step {
            asked,
            made,
            exact: false,
            free,
        })
    }

    fn mark_restless(&mut self, level: &Level<'_>, moves: &[Vec3], asked: f64) {
        let restless = |node: &u32| moves[*node as usize].norm() > RESTLESS * asked;
        let of_colour = |nodes: &Vec<u32>| nodes.iter().copied().filter(restless).collect();
        self.restless = level.colours.iter().map(of_colour).collect();
    }

    /// What the damped model asks for, and the factors that led to it.
    fn ask(&mut self, level: &Level<'_>, forces: &[Vec3]) -> Option<(Factor, Model)> {
        let factor = self.positive_factor(level)?;
        self.assemble(level, Kind::Damped);
        let far = 4.0 * self.radius;
        let model = Model::new(&self.plan, &factor, &self.exact, forces, far);
        Some((factor, model))
    }

    /// Factors of the positive matrix; where rounding makes it indefinite, as crushed rods may, all
    /// nodes are damped more.
    fn positive_factor(&mut self, level: &Level<'_>) -> Option<Factor> {
        for _ in 0..DAMPED_MORE {
            self.assemble(level, Kind::PositiveDamped);
            let factor = Factor::new(&self.plan, &self.positive);
            if factor.is_some() {
                return factor;
            }
            for damping in &mut self.damping {
                *damping *= 10.0;
            }
        }
        None
    }

    /// Damps nodes that asked for more than is trusted.
    fn damp(&mut self, moves: &[Vec3]) {
        for (damping, way) in self.damping.iter_mut().zip(moves) {
            let asked = way.norm() / self.radius;
            if asked > 1.0 {
                *damping = damping.max(0.1 / self.radius) * asked.clamp(1.5, 10.0);
            }
        }
    }

    /// Frees nodes that asked for little.
    fn free(&mut self, pitch: f64, moves: &[Vec3]) {
        for (damping, way) in self.damping.iter_mut().zip(moves) {
            if way.norm() < 0.5 * self.radius {
                *damping = (*damping * 0.5).max(LEAST_DAMPING / pitch);
            }
        }
    }

    /// Steps on with the touches as they were last seen, where nothing but smooth laws is left and
    /// steps converge quadratically.
    pub(super) fn finish(&mut self, level: &mut Level<'_>) {
        for _ in 0..FINISHING {
            match self.step(level) {
                Some(step) if step.exact && step.asked > FINISHED => (),
                _ => break,
            }
        }
    }

    /// Halves the step until the energy falls, and learns how far steps can be trusted. Returns the
    /// longest move made [cm], 0 where none lowers the energy. `first` is what the factors alone
    /// answer to the forces here.
    fn descend(
        &mut self,
        level: &mut Level<'_>,
        factor: &Factor,
        moves: &[Vec3],
        first: &[Vec3],
    ) -> f64 {
        let before = level.energy(&level.at);
        let noise = 1e-12 * before.abs().max(1.0);
        let longest_move = LONGEST_MOVE * level.lattice.pitch;
        let asked = longest(moves).max(1e-300);
        let mut part = (self.sight.min(2.0 * self.radius) / asked).min(1.0);
        for halvings in 0..HALVINGS {
            let to = self.corrected(level, factor, moves, first, part);
            if level.energy(&to) <= before + noise {
                let ways = to.iter().zip(&level.at).map(|(to, at)| (to - at).norm());
                let made = ways.fold(0.0, f64::max);
                level.at = to;
                if halvings > 0 {
                    self.radius *= 0.7;
                } else if asked * part > 0.5 * self.radius {
                    self.radius = (1.3 * self.radius).min(0.5 * longest_move);
                }
                self.radius = self.radius.max(1e-3 * longest_move);
                return made;
            }
            part *= 0.5;
        }
        self.radius = (0.3 * self.radius).max(1e-3 * longest_move);
        0.0
    }

    /// A part of the step, and after it what the same factors say of the forces that turning has
    /// raised: rods that a straight move lengthened come back to their length.
    fn corrected(
        &self,
        level: &Level<'_>,
        factor: &Factor,
        moves: &[Vec3],
        first: &[Vec3],
        part: f64,
    ) -> Vec<Vec3> {
        let mut to = level.freely(|node| moves[node] * part);
        let mut energy = level.energy(&to);
        for _ in 0..CORRECTIONS {
            let answer = factor.solve(&self.plan, &level.forces(&to));
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
}
