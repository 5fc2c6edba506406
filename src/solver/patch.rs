//! Patches: where folds still travel while the rest of the cloth has settled, each is brought on by
//! itself, the cloth around it held.
//!
//! A fold moves along a hem in many short steps. In steps of all nodes together, each fold would
//! wait for the most difficult one, and each step would cost as much as the whole cloth.

use super::{dissection::Neighbours, joint::Joint, level::Level};
use crate::{
    certificate::Case,
    forces::Clamp,
    lattice::{Lattice, Patch},
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
        let patch = case.lattice.patch(chosen);
        let held: Vec<bool> = of(&patch, |node| level.held[node] || !chosen[node]);
        let clamps = clamps_of(&patch, case.clamps);
        let own_case = Case {
            lattice: &patch.lattice,
            clamps: &clamps,
            held: &held,
            ..*case
        };
        let at = of(&patch, |node| level.at[node]);
        let mut own = Level::new(&own_case, level.touches.of_patch(&patch), at);
        let damping = of(&patch, |node| self.damping[node]);
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
        for (number, node) in patch.nodes.iter().enumerate() {
            if !held[number] {
                level.at[*node as usize] = own.at[number];
                self.damping[*node as usize] = joint.damping[number];
            }
        }
        level.updates += own.updates;
        level.touches.adopt(&own.touches, &patch);
    }
}

fn of<T>(patch: &Patch, value: impl Fn(usize) -> T) -> Vec<T> {
    patch
        .nodes
        .iter()
        .map(|node| value(*node as usize))
        .collect()
}

/// The vices that act in a patch.
fn clamps_of(patch: &Patch, clamps: &[Clamp]) -> Vec<Clamp> {
    let in_patch = |clamp: &Clamp| {
        let [held, next] = clamp.nodes.map(|node| patch.number_of(node));
        Some(Clamp {
            nodes: [held?, next?],
            ..*clamp
        })
    };
    clamps.iter().filter_map(in_patch).collect()
}

/// The marks of each patch: nodes near the restless ones, in pieces that share no rod. None where
/// they are too much of the cloth.
fn patches(lattice: &Lattice, restless: Vec<u32>) -> Vec<Vec<bool>> {
    let count = lattice.coordinates.len();
    let rods: Vec<[u32; 2]> = lattice.rods.iter().map(|rod| rod.nodes).collect();
    let beside = Neighbours::new(count, &rods);
    let mut marked = vec![false; count];
    let mut rim = restless;
    for _ in 0..=MARGIN {
        rim.retain(|node| !core::mem::replace(&mut marked[*node as usize], true));
        rim = rim
            .iter()
            .flat_map(|node| beside.of(*node))
            .copied()
            .collect();
    }
    let size = marked.iter().filter(|marked| **marked).count();
    if size as f64 > WORTH_IT * count as f64 {
        return Vec::new();
    }
    pieces(&mut marked, &beside)
}

/// Takes the marked nodes apart into pieces that hang together by rods.
fn pieces(marked: &mut [bool], beside: &Neighbours) -> Vec<Vec<bool>> {
    let mut pieces = Vec::new();
    for first in 0..marked.len() {
        if !marked[first] {
            continue;
        }
        let mut piece = vec![false; marked.len()];
        let mut waiting = vec![first as u32];
        while let Some(node) = waiting.pop() {
            if core::mem::replace(&mut marked[node as usize], false) {
                piece[node as usize] = true;
                waiting.extend(beside.of(node));
            }
        }
        pieces.push(piece);
    }
    pieces
}
