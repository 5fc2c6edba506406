//! Shapes between start and rest ("one can watch it settle"), kept while a run goes on.

use crate::{lattice::Lattice, math::Vec3};

/// Shapes of all levels, thinned as they become too many.
#[derive(Debug)]
pub(super) struct Film {
    wanted: usize,
    shots: Vec<Shot>,
    every: usize,
    seen: usize,
}

/// A shape on the lattice of its level.
#[derive(Debug)]
struct Shot {
    level: usize,
    at: Vec<Vec3>,
}

impl Film {
    /// A film from which `wanted` shapes will be asked.
    pub(super) fn new(wanted: usize) -> Self {
        Self {
            wanted,
            shots: Vec::new(),
            every: 1,
            seen: 0,
        }
    }

    /// Keeps a shape of a level, or passes it over.
    pub(super) fn shoot(&mut self, level: usize, at: &[Vec3]) {
        if self.wanted == 0 {
            return;
        }
        if self.seen.is_multiple_of(self.every) {
            self.shots.push(Shot {
                level,
                at: at.to_vec(),
            });
        }
        self.seen += 1;
        // Twice as many as wanted leaves a choice; more would cost memory.
        if self.shots.len() > (4 * self.wanted).max(64) {
            let mut number = 0;
            self.shots.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.every *= 2;
        }
    }

    /// The wanted number of shapes on the finest lattice, evenly spread over the run.
    pub(super) fn develop(&self, lattices: &[Lattice]) -> Vec<Vec<Vec3>> {
        let Some(finest) = lattices.last() else {
            return Vec::new();
        };
        let last = self.shots.len().saturating_sub(1);
        let count = if self.shots.is_empty() {
            0
        } else {
            self.wanted
        };
        let chosen = (0..count).map(|k| &self.shots[k * last / count.saturating_sub(1).max(1)]);
        chosen
            .map(|shot| {
                if shot.level + 1 == lattices.len() {
                    return shot.at.clone();
                }
                let locator = lattices[shot.level].locator();
                let place = |coordinate| locator.locate(coordinate).blend(&shot.at);
                finest
                    .coordinates
                    .iter()
                    .map(|coordinate| place(*coordinate))
                    .collect()
            })
            .collect()
    }
}
