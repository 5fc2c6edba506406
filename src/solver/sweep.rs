//! The paper's solver: each node in turn to its own equilibrium, by the 3×3 system (8).
//!
//! Nodes of one colour share no force, so they move side by side and the result does not depend
//! on their order.

use super::level::Level;
use crate::{
    forces::{Pull, paper_forces},
    math::{Mat3, Vec3},
    threads,
};

/// A node moves at most this part of a pitch at a visit: farther, its neighbours' places mean
/// nothing.
pub(super) const LONGEST_MOVE: f64 = 0.25;

impl Level<'_> {
    /// One sweep over all colours. Returns the longest move [cm].
    pub(super) fn sweep(&mut self) -> f64 {
        self.sweeps += 1;
        if !self.own_only {
            return self.stream_sweep();
        }
        let colours = core::mem::take(&mut self.colours);
        let longest = self.sweep_over(&colours);
        self.colours = colours;
        longest
    }

    /// Visits some nodes, by colours. Returns the longest move [cm].
    pub(super) fn sweep_over(&mut self, colours: &[Vec<u32>]) -> f64 {
        let mut longest = 0.0_f64;
        for nodes in colours {
            let moved = threads::map(nodes.len(), |k| self.visit(nodes[k] as usize));
            self.updates += nodes.len() as u64;
            for (node, to) in nodes.iter().zip(moved) {
                let here = &mut self.at[*node as usize];
                longest = longest.max((to - *here).norm());
                *here = to;
            }
        }
        longest
    }

    /// Where a node's own equilibrium is, by (8), within the longest move and the free way.
    fn visit(&self, node: usize) -> Vec3 {
        let pull = self.pull(node);
        let here = self.at[node];
        let (push, block) = self.touches.pull(node, &self.at);
        let floor = self.sheet.weights()[node] / self.lattice.pitch;
        let stiffness = pull.stiffness + block + Mat3::identity() * floor;
        let force = pull.force + push;
        // The paper's Jacobian lacks the reactions, and so symmetry.
        let way = if self.own_only {
            stiffness.lu().solve(&force)
        } else {
            solve(&stiffness, &force)
        };
        let Some(way) = way else { return here };
        let longest = LONGEST_MOVE * self.lattice.pitch;
        let way = way * (longest / way.norm().max(longest));
        self.free_way(node, here + way)
    }

    fn pull(&self, node: usize) -> Pull {
        if self.own_only {
            return paper_forces(&self.sheet, node, &self.at);
        }
        self.sheet.pull(node, &self.at)
    }
}

/// Solves (8) for the move; `None` where the block is not positive definite.
fn solve(stiffness: &Mat3, force: &Vec3) -> Option<Vec3> {
    let way = stiffness.cholesky()?.solve(force);
    way.iter().all(|x| x.is_finite()).then_some(way)
}
