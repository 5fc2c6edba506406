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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{Outline, sample::cut, weave::weave};

    #[test]
    fn a_cell_of_a_rectangle_has_two_over_its_area_and_stands_for_itself() {
        let lattice = cut(Outline::rectangle(6.0, 4.0).unwrap(), 0.0, 0.5);
        assert_eq!(lattice.twists.len(), lattice.cells.len());
        for (twist, cell) in lattice.twists.iter().zip(&lattice.cells) {
            let expected = Twist {
                nodes: *cell,
                per_gap: 8.0,
                area: 0.25,
            };
            assert_eq!(*twist, expected);
        }
    }

    #[test]
    fn cells_beside_a_triangle_stand_for_it() {
        let mut grid = Grid::regular([3, 3], Vec2::new(2.0, 2.0));
        grid.meshes[3] = Mesh::Without(2);
        let areas: Vec<f64> = weave(&grid).twists.iter().map(|twist| twist.area).collect();
        assert_eq!(areas, [4.0, 5.0, 5.0]);
    }

    #[test]
    fn a_cell_that_stands_on_its_corner_measures_no_twist() {
        let corners = [[0.0, -0.7], [0.7, 0.0], [0.0, 0.7], [-0.7, 0.0]];
        assert_eq!(gaps(corners.map(Vec2::from))[1], 0.0);
        let mut grid = Grid::regular([2, 2], Vec2::new(1.0, 1.0));
        for (node, corner) in [0, 1, 3, 2].into_iter().zip(corners) {
            grid.shift[node] = Vec2::from(corner) - grid.place(node);
        }
        assert_eq!(weave(&grid).twists, []);
    }

    #[test]
    fn every_cell_of_four_nodes_measures_twist_whatever_the_outline() {
        let towel = |grain| cut(Outline::rectangle(20.0, 13.0).unwrap(), grain, 0.5);
        let disc = cut(Outline::disc(8.3).unwrap(), 0.0, 0.5);
        let towels = [0.0, 5.0, 17.0, 30.0, 45.0, 71.0].map(towel);
        for lattice in towels.iter().chain([&disc]) {
            let has_four = |cell: &&[u32; 4]| (0..4).all(|k| cell[k] != cell[(k + 1) % 4]);
            let cells = lattice.cells.iter().filter(has_four);
            let twists = &lattice.twists;
            assert!(cells.eq(twists.iter().map(|twist| &twist.nodes)));
            // On the grain 8/cm² and 0.25 cm².
            let sound = |twist: &Twist| (4.0..20.0).contains(&twist.per_gap) && twist.area < 0.75;
            assert!(twists.iter().all(sound));
        }
    }
}
