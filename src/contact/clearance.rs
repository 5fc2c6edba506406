//! How far from any surface the nodes are known to be: so that bodies are asked only where one of them
//! could be in the way.

use super::{deepest::nearest_of, touches::Touches};
use crate::{body::Bodies, math::Vec3, threads};

impl Touches {
    /// Measures anew how far surfaces are from nodes that such moves [cm] could take out of what is
    /// known to be clear.
    pub fn measure(
        &mut self,
        at: &[Vec3],
        bodies: &Bodies,
        way: impl Fn(usize) -> f64 + Sync + Send,
    ) {
        if bodies.parts().is_empty() {
            return;
        }
        let measured = threads::map(at.len(), |node| {
            let (clear, there) = self.clearance[node];
            let gone = (at[node] - there).norm();
            if clear - gone >= way(node) || gone < 0.25 * clear {
                return None;
            }
            let wide = 2.0 * self.surface.node_reach() + self.pitch;
            Some((nearest_of(&bodies.near(&at[node], wide), wide), at[node]))
        });
        for (known, measured) in self.clearance.iter_mut().zip(measured) {
            if let Some(measured) = measured {
                *known = measured;
            }
        }
    }

    /// Whether nothing can be in a node's way: both ends of it are nearer to where the node's
    /// clearance was measured than any surface was.
    #[must_use]
    pub fn is_clear(&self, node: usize, from: &Vec3, to: &Vec3) -> bool {
        let (clear, there) = self.clearance[node];
        (from - there).norm().max((to - there).norm()) < clear
    }

    /// How far every point of a cell is from any surface at least, by what its nodes know [cm].
    pub(super) fn clear_of(&self, cell: usize, at: &[Vec3]) -> f64 {
        let nodes = self.sites.cells()[cell];
        let by_node = |node: u32| {
            let (clear, there) = self.clearance[node as usize];
            let here = at[node as usize];
            let farthest = nodes
                .iter()
                .map(|other| (at[*other as usize] - here).norm())
                .fold(0.0, f64::max);
            clear - (here - there).norm() - farthest
        };
        nodes
            .into_iter()
            .map(by_node)
            .fold(f64::NEG_INFINITY, f64::max)
    }
}
