//! A shape carried from one lattice to a finer one.

use super::{
    level::{Level, stopped},
    start::Start,
};
use crate::{contact::Surface, lattice::Lattice, math::Vec3};

/// A node that a finer cut put into a body is pushed out at most so often: the nearest surface
/// beyond one may be another's.
const PUSHES: usize = 3;

/// Puts a level on the shape of a coarser one: held nodes where they are carried, free ones outside
/// of the bodies, on the side where the coarse cloth is.
pub(super) fn carry_over(
    level: &mut Level<'_>,
    coarse: &Lattice,
    rest: &[Vec3],
    start: &Start,
    surface: &Surface,
) {
    let locator = coarse.locator();
    let flat = core::mem::take(&mut level.at);
    let mut from = Vec::with_capacity(flat.len());
    for coordinate in &level.lattice.coordinates {
        let place = locator.locate(*coordinate);
        level.at.push(place.blend(rest));
        from.push(rest[place.nearest() as usize]);
    }
    for (node, carry) in &start.carry {
        level.at[*node as usize] = flat[*node as usize] + carry;
    }
    push_out(level, surface, &from, 0.0);
}

/// Brings free nodes that are deeper than this [cm] in a body, or beyond a sheet from where the cloth
/// is, to the surface.
pub(super) fn push_out(level: &mut Level<'_>, surface: &Surface, from: &[Vec3], deep: f64) {
    for (node, from) in from.iter().enumerate() {
        if level.held[node] {
            continue;
        }
        let mut at = level.at[node];
        let deepest = |at: &Vec3| {
            let nears = level.bodies.near_from(from, at, 0.0);
            nears
                .into_iter()
                .filter(|near| near.distance <= -deep)
                .min_by(|a, b| a.distance.total_cmp(&b.distance))
        };
        for _ in 0..PUSHES {
            let Some(near) = deepest(&at) else { break };
            at += near.normal * (surface.node_reach() - near.distance);
        }
        if deepest(&at).is_some() {
            at = stopped(level.bodies, from, at);
        }
        level.at[node] = at;
    }
}
