//! Whether the meshes of a grid hang together.

use crate::lattice::grid::{Grid, Mesh};

/// A part this small beside the largest one is a scrap, as in the tip of a sharp corner.
const SCRAP: f64 = 0.02;

/// Leaves out scraps: small sets of meshes that share no side with the rest. Where others would
/// have to be left out too, answers how many parts there are, scraps not counted.
pub(super) fn drop_scraps(grid: &mut Grid) -> Result<(), usize> {
    let part = parts(grid);
    let mut areas = vec![0.0; part.iter().flatten().max().map_or(0, |last| last + 1)];
    for (square, part) in part.iter().enumerate() {
        if let Some(part) = part {
            let nodes: Vec<usize> = grid.nodes(square, grid.meshes[square]).collect();
            areas[*part] += grid.area(&nodes);
        }
    }
    let largest = areas.iter().copied().fold(0.0, f64::max);
    let is_scrap = |part: usize| areas[part] <= SCRAP * largest;
    let whole = (0..areas.len()).filter(|part| !is_scrap(*part)).count();
    if whole > 1 {
        return Err(whole);
    }
    for (mesh, part) in grid.meshes.iter_mut().zip(&part) {
        if part.is_some_and(is_scrap) {
            *mesh = Mesh::Absent;
        }
    }
    Ok(())
}

/// The number of the part that each mesh belongs to, from 0; `None` where there is no mesh.
fn parts(grid: &Grid) -> Vec<Option<usize>> {
    let mut part = vec![None; grid.meshes.len()];
    let mut count = 0;
    for square in 0..part.len() {
        if part[square].is_some() || grid.meshes[square] == Mesh::Absent {
            continue;
        }
        part[square] = Some(count);
        let mut open = vec![square];
        while let Some(square) = open.pop() {
            for next in neighbours(grid, square) {
                if part[next].is_none() {
                    part[next] = Some(count);
                    open.push(next);
                }
            }
        }
        count += 1;
    }
    part
}

/// Squares whose meshes share a side with a square's mesh.
fn neighbours(grid: &Grid, square: usize) -> impl Iterator<Item = usize> {
    let across = grid.counts[0] - 1;
    let column = square % across;
    // Each with this square's corners on the common side and the neighbour's.
    let beside = [
        (column + 1 < across).then_some((square + 1, [1, 2], [0, 3])),
        (column > 0).then(|| (square - 1, [0, 3], [1, 2])),
        (square + across < grid.meshes.len()).then_some((square + across, [3, 2], [0, 1])),
        (square >= across).then(|| (square - across, [0, 1], [3, 2])),
    ];
    let has = |square: usize, side: [usize; 2]| {
        let corners = grid.meshes[square].corners();
        side.iter().all(|corner| corners.contains(corner))
    };
    let joined = beside.into_iter().flatten();
    let joined = joined.filter(move |(next, own, other)| has(square, *own) && has(*next, *other));
    joined.map(|(next, _, _)| next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::Vec2;

    /// A row of meshes with some left out.
    fn row(count: usize, absent: &[usize]) -> Grid {
        let mut grid = Grid::regular([count + 1, 2], Vec2::repeat(1.0));
        for square in absent {
            grid.meshes[*square] = Mesh::Absent;
        }
        grid
    }

    #[test]
    fn a_gap_parts_the_cloth() {
        assert_eq!(drop_scraps(&mut row(9, &[])), Ok(()));
        assert_eq!(drop_scraps(&mut row(9, &[3, 6])), Err(3));
    }

    #[test]
    fn a_scrap_is_dropped() {
        let mut grid = row(102, &[100]);
        assert_eq!(drop_scraps(&mut grid), Ok(()));
        let left = grid.meshes.iter().filter(|mesh| **mesh == Mesh::Whole);
        assert_eq!((left.count(), grid.meshes[101]), (100, Mesh::Absent));
    }

    #[test]
    fn a_common_node_alone_joins_nothing() {
        let mut grid = Grid::regular([3, 3], Vec2::repeat(1.0));
        grid.meshes[1] = Mesh::Absent;
        grid.meshes[2] = Mesh::Absent;
        assert_eq!(drop_scraps(&mut grid), Err(2));
        grid.meshes[1] = Mesh::Without(2);
        assert_eq!(drop_scraps(&mut grid), Err(2));
        grid.meshes[1] = Mesh::Without(1);
        assert_eq!(drop_scraps(&mut grid), Ok(()));
    }
}
