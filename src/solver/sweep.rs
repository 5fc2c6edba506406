//! Sweeps: each node in turn to its own equilibrium, by the 3×3 system (8).
//!
//! Nodes of one colour share no force, so they move side by side and the result does not depend
//! on their order. The paper's own ten forces are visited here, one by one.

use super::level::Level;
use crate::{
    forces::paper_forces,
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
        self.updates += self.colours.iter().map(Vec::len).sum::<usize>() as u64;
        if !self.own_only {
            return self.stream_sweep();
        }
        let mut longest = 0.0_f64;
        for colour in 0..self.colours.len() {
            let nodes = &self.colours[colour];
            let moved = threads::map(nodes.len(), |k| self.visit(nodes[k] as usize));
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
        let mut pull = paper_forces(&self.sheet, node, &self.at);
        let here = self.at[node];
        let (push, block) = self.touches.pull(node, &self.at);
        pull.force += push;
        pull.stiffness += block;
        if let Some(momentum) = &self.momentum {
            pull.force += momentum.force(node, &here);
            pull.stiffness += Mat3::identity() * momentum.stiffness(node);
        }
        let floor = self.sheet.measures()[node] / self.lattice.pitch;
        for axis in 0..3 {
            pull.stiffness[(axis, axis)] += floor;
        }
        // The paper's Jacobian lacks the reactions, and so symmetry.
        let Some(way) = pull.stiffness.lu().solve(&pull.force) else {
            return here;
        };
        let longest = LONGEST_MOVE * self.lattice.pitch;
        let way = way * (longest / way.norm().max(longest));
        self.free_way(node, here + way)
    }
}
