//! The joint step: system (8) written for all nodes at once, so that a move of the whole cloth
//! that each node alone would take thousands of sweeps to feel is made in one.
//!
//! 1. The derivative of all forces by all positions is assembled exactly, with λ times each node's
//!    weight on the diagonal.
//! 2. λ is the least that leaves it positive definite and keeps the energy falling; it goes to 0
//!    as rest comes near, where steps converge quadratically.
//! 3. The step is cut to a part of the pitch, and each node to the way that bodies leave free.
//! 4. It is halved until the energy falls.

use super::{
    factor::{Factor, Plan},
    level::Level,
    stiffness::Stiffness,
};
use crate::math::{Mat3, Vec3};

/// A node moves at most this part of a pitch in a joint step.
const LONGEST_MOVE: f64 = 0.8;

/// The matrix and how far it is shifted from the exact one.
#[derive(Debug)]
pub(super) struct Joint {
    pub(super) plan: Plan,
    pub(super) stiffness: Stiffness,
    /// λ: stiffness per weight [1/cm].
    pub(super) shift: f64,
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
    /// Whether the unshifted, exact matrix was positive definite: the shape is stable.
    pub(super) exact: bool,
}

impl Joint {
    pub(super) fn new(level: &Level<'_>) -> Self {
        let (plan, stiffness) = level.plan();
        Self {
            plan,
            stiffness,
            shift: 4.0 / level.lattice.pitch,
            near: false,
        }
    }

    /// Assembles the matrix at the level's positions.
    fn assemble(&mut self, level: &Level<'_>, positive: bool) {
        let matrix = &mut self.stiffness;
        matrix.clear();
        level
            .sheet
            .stiffness(&level.at, positive, &mut |row, column, block| {
                matrix.add(row, column, block);
            });
        level
            .touches
            .stiffness(&level.at, &mut |row, column, block| {
                matrix.add(row, column, block);
            });
        for (node, weight) in level.sheet.weights().iter().enumerate() {
            let block = Mat3::identity() * (weight * self.shift);
            matrix.add(node as u32, node as u32, &block);
        }
    }

    /// Factors the exact matrix at the least shift that allows it, or else the positive one.
    fn factor(&mut self, level: &Level<'_>) -> Option<(Factor, bool)> {
        let least = LEAST_SHIFT / level.lattice.pitch;
        if self.shift < least {
            self.shift = 0.0;
        }
        if self.near {
            for _ in 0..3 {
                self.assemble(level, false);
                if let Some(factor) = Factor::new(&self.plan, &self.stiffness) {
                    return Some((factor, self.shift == 0.0));
                }
                self.shift = (self.shift * 5.0).max(4.0 * least);
            }
        }
        self.shift = self.shift.max(least);
        self.assemble(level, true);
        Some((Factor::new(&self.plan, &self.stiffness)?, false))
    }

    /// One step; the level has just looked at its touches.
    pub(super) fn step(&mut self, level: &mut Level<'_>) -> Option<Step> {
        let forces = level.forces(&level.at);
        let (factor, exact) = self.factor(level)?;
        let moves = factor.solve(&self.plan, &forces);
        level.joint_steps += 1;
        let asked = longest(&moves);
        self.near = asked < NEAR * level.lattice.pitch;
        if !asked.is_finite() {
            self.shift = self.shift.max(1.0) * 10.0;
            return Some(Step {
                asked: f64::INFINITY,
                made: 0.0,
                exact: false,
            });
        }
        let cap = (LONGEST_MOVE * level.lattice.pitch / asked.max(1e-300)).min(1.0);
        let made = self.descend(level, &factor, &moves, cap);
        Some(Step { asked, made, exact })
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

    /// Halves the step until the energy falls, and learns λ from how that went.
    fn descend(&mut self, level: &mut Level<'_>, factor: &Factor, moves: &[Vec3], cap: f64) -> f64 {
        let before = level.energy(&level.at);
        let noise = 1e-12 * before.abs().max(1.0);
        let mut part = cap;
        for halvings in 0..8 {
            let to = self.corrected(level, factor, moves, part);
            if level.energy(&to) <= before + noise {
                let made = to
                    .iter()
                    .zip(&level.at)
                    .map(|(to, at)| (to - at).norm())
                    .fold(0.0, f64::max);
                level.at = to;
                self.learn(halvings, cap);
                return made;
            }
            part *= 0.5;
        }
        self.shift = (self.shift * 8.0).max(LEAST_SHIFT / level.lattice.pitch);
        0.0
    }

    /// A part of the step, and after it what the same factors say of the forces that turning has
    /// raised: rods that a straight move lengthened come back to their length.
    fn corrected(
        &self,
        level: &Level<'_>,
        factor: &Factor,
        moves: &[Vec3],
        part: f64,
    ) -> Vec<Vec3> {
        let mut to = level.freely(|node| moves[node] * part);
        let mut energy = level.energy(&to);
        for _ in 0..CORRECTIONS {
            let answer = factor.solve(&self.plan, &level.forces(&to));
            let way =
                |node: usize| to[node] - level.at[node] + answer[node] - moves[node] * (1.0 - part);
            let next = level.freely(way);
            let lower = level.energy(&next);
            if lower.is_nan() || lower >= energy {
                break;
            }
            (to, energy) = (next, lower);
        }
        to
    }

    fn learn(&mut self, halvings: usize, cap: f64) {
        match halvings {
            0 if cap > 0.3 => self.shift *= 0.3,
            0 => self.shift *= 0.7,
            1 => (),
            _ => self.shift = (self.shift * 3.0).min(1e3),
        }
    }
}

/// A step that asks for less than this part of a pitch is short.
const NEAR: f64 = 0.1;
/// Most steps of a finish, and the move [cm] that ends it.
const FINISHING: usize = 6;
const FINISHED: f64 = 1e-7;
/// Corrections after a joint step: each costs a tenth of the factors.
const CORRECTIONS: usize = 3;
/// Below this λ times pitch the shift is dropped.
const LEAST_SHIFT: f64 = 0.01;

pub(super) fn longest(moves: &[Vec3]) -> f64 {
    moves.iter().map(Vec3::norm).fold(
        0.0,
        |longest, way| if way <= longest { longest } else { way },
    )
}
