//! A shape carried from one lattice to a finer one.

use super::{level::Level, start::Start};
use crate::{contact::Surface, lattice::Lattice, math::Vec3};

/// Positions of a finer lattice on the shape of a coarser one; held nodes where they are carried.
pub(super) fn carry_over(
    coarse: &Lattice,
    rest: &[Vec3],
    fine: &Lattice,
    start: &Start,
    flat: &[Vec3],
) -> Vec<Vec3> {
    let locator = coarse.locator();
    let mut at: Vec<Vec3> = fine
        .coordinates
        .iter()
        .map(|coordinate| locator.locate(*coordinate).blend(rest))
        .collect();
    for (node, carry) in &start.carry {
        at[*node as usize] = flat[*node as usize] + carry;
    }
    at
}

/// Brings free nodes that the finer cut put into a body back to its surface.
pub(super) fn push_out(level: &mut Level<'_>, surface: &Surface) {
    for node in 0..level.at.len() {
        if level.held[node] {
            continue;
        }
        for _ in 0..3 {
            let nears = level.bodies.near(&level.at[node], 0.0);
            let Some(deepest) = nears
                .iter()
                .min_by(|a, b| a.distance.total_cmp(&b.distance))
            else {
                break;
            };
            level.at[node] += deepest.normal * (surface.node_reach() - deepest.distance);
        }
    }
}
