//! The best that bodies can do for a node: a reaction inside the Coulomb cones of what it touches.

use crate::math::Vec3;

/// Visits to each cone while a reaction is shared out among several.
const ROUNDS: usize = 200;

/// The net force [gf] that is left of `net` after the best reaction in the cones about `normals`.
pub(super) fn left_over(net: &Vec3, normals: &[Vec3], friction: f64) -> Vec3 {
    let mut shares = vec![Vec3::zeros(); normals.len()];
    let mut left = *net;
    let rounds = if normals.len() > 1 { ROUNDS } else { 1 };
    for _ in 0..rounds {
        for (share, normal) in shares.iter_mut().zip(normals) {
            left -= *share;
            *share = into_cone(&-left, normal, friction);
            left += *share;
        }
    }
    left
}

/// The nearest force to `force` in the cone |F_t| ≤ µ·N about `normal`.
fn into_cone(force: &Vec3, normal: &Vec3, friction: f64) -> Vec3 {
    let push = force.dot(normal);
    let tangential = force - normal * push;
    let slide = tangential.norm();
    if slide <= friction * push {
        return *force;
    }
    if friction * slide <= -push {
        return Vec3::zeros();
    }
    let push = (push + friction * slide) / (1.0 + friction * friction);
    normal * push + tangential * (friction * push / slide)
}
