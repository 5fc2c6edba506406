//! Patches: where folds still travel while the rest of the cloth has settled, each is brought on by
//! itself, the cloth around it held.
//!
//! A fold moves along a hem in many short steps. In steps of all nodes together, each fold would
//! wait for the most difficult one, and each step would cost as much as the whole cloth.

use super::{joint::Joint, level::Level};
use crate::{
    certificate::Case,
    forces::Clamp,
    lattice::{Lattice, Part},
};

/// A patch reaches so many rods beyond the nodes that still move.
const MARGIN: usize = 4;
/// Patches are worth it while they hold no more than this part of the cloth.
const WORTH_IT: f64 = 0.2;
/// Rounds on a patch before the whole cloth is looked at again.
const ROUNDS: usize = 24;
/// A patch has come to rest for now when free steps ask for less than this part of a pitch.
pub(super) const CALM: f64 = 0.01;

impl Joint {
    /// Brings the restless parts of the cloth on, one after the other.
    pub(super) fn settle_patches(&mut self, level: &mut Level<'_>, case: &Case<'_>) {
        for chosen in patches(level.lattice, self.restless.concat()) {
            self.settle(level, case, &chosen);
        }
    }

    /// Brings one patch nearer to rest.
    fn settle(&mut self, level: &mut Level<'_>, case: &Case<'_>, chosen: &[bool]) {
        let part = case.lattice.part(chosen);
        let held: Vec<bool> = of(&part, |node| level.held[node] || !chosen[node]);
        let clamps = clamps_of(&part, case.clamps);
        let own_case = Case {
            lattice: &part.lattice,
            clamps: &clamps,
            held: &held,
            ..*case
        };
        let mut own = Level::new(&own_case, level.touches.of_part(&part));
        own.at = of(&part, |node| level.at[node]);
        let damping = of(&part, |node| self.damping[node]);
        let mut joint = self.of_patch(&own, damping);
        let mut made = level.lattice.pitch;
        for _ in 0..ROUNDS {
            let Some(step) = joint.round(&mut own, made) else {
                break;
            };
            made = step.made;
            if step.free && step.asked < CALM * level.lattice.pitch {
                break;
            }
        }
        for (number, node) in part.nodes.iter().enumerate() {
            if !held[number] {
                level.at[*node as usize] = own.at[number];
                self.damping[*node as usize] = joint.damping[number];
            }
        }
        level.updates += own.updates;
        level.touches.adopt(&own.touches, &part);
    }
}

fn of<T>(part: &Part, value: impl Fn(usize) -> T) -> Vec<T> {
    part.nodes
        .iter()
        .map(|node| value(*node as usize))
        .collect()
}

/// The vices that act in a part.
fn clamps_of(part: &Part, clamps: &[Clamp]) -> Vec<Clamp> {
    let in_part = |clamp: &Clamp| {
        let [held, next] = clamp.nodes.map(|node| part.number_of(node));
        Some(Clamp {
            nodes: [held?, next?],
            ..*clamp
        })
    };
    clamps.iter().filter_map(in_part).collect()
}

/// The marks of each patch: nodes near the restless ones, in pieces that share no rod. None where
/// they are too much of the cloth.
fn patches(lattice: &Lattice, restless: Vec<u32>) -> Vec<Vec<bool>> {
    let count = lattice.coordinates.len();
    let mut marked = vec![false; count];
    for node in restless {
        marked[node as usize] = true;
    }
    for _ in 0..MARGIN {
        let before = marked.clone();
        for rod in &lattice.rods {
            let [a, b] = rod.nodes.map(|node| node as usize);
            marked[a] |= before[b];
            marked[b] |= before[a];
        }
    }
    let size = marked.iter().filter(|marked| **marked).count();
    if size as f64 > WORTH_IT * count as f64 {
        return Vec::new();
    }
    pieces(lattice, &marked)
}

/// Parts the marked nodes into pieces that hang together by rods.
fn pieces(lattice: &Lattice, marked: &[bool]) -> Vec<Vec<bool>> {
    let mut beside = vec![Vec::new(); marked.len()];
    for rod in &lattice.rods {
        let [a, b] = rod.nodes;
        if marked[a as usize] && marked[b as usize] {
            beside[a as usize].push(b as usize);
            beside[b as usize].push(a as usize);
        }
    }
    let mut seen = vec![false; marked.len()];
    let mut pieces = Vec::new();
    for first in 0..marked.len() {
        if !marked[first] || seen[first] {
            continue;
        }
        let mut piece = vec![false; marked.len()];
        let mut waiting = vec![first];
        while let Some(node) = waiting.pop() {
            if !core::mem::replace(&mut seen[node], true) {
                piece[node] = true;
                waiting.extend(beside[node].iter().copied());
            }
        }
        pieces.push(piece);
    }
    pieces
}
