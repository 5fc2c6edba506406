//! Which meshes resist twist, and how much cloth each stands for.
//!
//! The diagonals of a flat mesh cross; those of a twisted one pass each other at a gap. Of any four
//! points that gap is the one measure of how far they are from a plane, and it answers twist: of a
//! rectangle, nothing else. Off the grain it answers bending along the yarns too.
//! - A mesh that answers bending more than half as much as twist has none of its own.
//! - Nor has a triangle: three points have a plane. The area of either goes to the meshes beside it.

use crate::{
    lattice::{
        Twist,
        grid::{Grid, Mesh},
        ring::cross,
    },
    math::Vec2,
};

/// A mesh off the grain may answer bending along a yarn by this part of what it answers to twist.
const BENDING_TAKEN_FOR_TWIST: f64 = 0.5;

/// The meshes that resist twist; nodes by their `number`.
pub(super) fn twists(grid: &Grid, number: &[Option<u32>]) -> Vec<Twist> {
    let per_gap: Vec<Option<f64>> = (0..grid.meshes.len())
        .map(|square| per_gap(grid, square))
        .collect();
    let area = areas(grid, &per_gap);
    let twist = |square: usize| {
        let [a, b, c, d] = grid.square(square).map(|node| number[node]);
        Some(Twist {
            nodes: [a?, b?, c?, d?],
            per_gap: per_gap[square]?,
            area: area[square],
        })
    };
    (0..per_gap.len()).filter_map(twist).collect()
}

/// Twist over gap [1/cm²] of a mesh; `None` where it has no twist.
fn per_gap(grid: &Grid, square: usize) -> Option<f64> {
    if grid.meshes[square] != Mesh::Whole {
        return None;
    }
    let nodes = grid.square(square);
    let [warp, twist, weft] = gaps(nodes.map(|node| grid.vector(nodes[0], node)));
    let sound = warp.abs().max(weft.abs()) <= BENDING_TAKEN_FOR_TWIST * twist;
    sound.then(|| 1.0 / twist)
}

/// How far the first diagonal of a mesh passes above the second [cm] where the cloth, at (x, y),
/// stands at the height x²/2, x·y and y²/2 [cm]: bent along the warp, twisted, bent along the weft
/// by 1/cm.
fn gaps([a, b, c, d]: [Vec2; 4]) -> [f64; 3] {
    let (first, second, between) = (c - a, d - b, b - a);
    let normal = cross(first, second);
    // Between its ends a straight line stands above a parabola by s·(1 − s) of its bend.
    let above = |line: Vec2, across: Vec2| {
        let part = cross(between, across) / normal;
        let bent = part * (1.0 - part);
        [
            0.5 * bent * line.x * line.x,
            bent * line.x * line.y,
            0.5 * bent * line.y * line.y,
        ]
    };
    let (one, other) = (above(first, second), above(second, first));
    core::array::from_fn(|k| one[k] - other[k])
}

/// How much cloth each mesh's twist stands for [cm²]: its own area, and a share of that of meshes
/// beside it that have none.
fn areas(grid: &Grid, per_gap: &[Option<f64>]) -> Vec<f64> {
    let mut areas = vec![0.0; per_gap.len()];
    for (square, mesh) in grid.meshes.iter().enumerate() {
        let nodes: Vec<usize> = grid.nodes(square, *mesh).collect();
        let area = grid.area(&nodes);
        if per_gap[square].is_some() {
            areas[square] += area;
        } else if *mesh != Mesh::Absent {
            let beside = grid.squares_beside(square);
            let takers: Vec<usize> = beside.filter(|other| per_gap[*other].is_some()).collect();
            for taker in &takers {
                areas[*taker] += area / takers.len() as f64;
            }
        }
    }
    areas
}
