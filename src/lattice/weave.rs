//! From a grid to the lattice: what joins the nodes, and how much cloth each joint stands for.
//!
//! Every mesh hands its area out once per law: to its nodes as weight, to its rods along each yarn
//! as rest length × width, to its corners, and to its twist. So each law's shares add up to the
//! cloth's area.
//! - Of two rods along one yarn, one that runs off the grain, as beside an outline, gets the lesser
//!   share: cloth pulled off its yarns yields by shear. ([`alignment`])
//! - A triangle has one rod along each yarn and one corner between them, so it feels exactly the
//!   three strains that a triangle has. Its third side, off both yarns, is no rod.

use crate::{
    fabric::Yarn,
    lattice::{
        Bend, Cell, Corner, Lattice, Rod,
        grid::{Grid, Mesh},
        ring::cross,
        twist::twists,
    },
    math::Vec2,
};

/// Cloth's stiffness along a yarn over its stiffness in shear, about: 1900 over 12 gf/cm for cloth
/// C. Only the division of one mesh's area among its own rods depends on it.
const YARN_OVER_SHEAR: f64 = 100.0;

/// The sides of a square that are rods: where from, where to, along which yarn.
const SIDES: [(usize, usize, Yarn); 4] = [
    (0, 1, Yarn::Warp),
    (3, 2, Yarn::Warp),
    (0, 3, Yarn::Weft),
    (1, 2, Yarn::Weft),
];

/// The lattice of a grid: nodes without a mesh are left out.
pub(super) fn weave(grid: &Grid) -> Lattice {
    let shares = Shares::of(grid);
    let mut number = vec![None; shares.area.len()];
    let mut lattice = Lattice {
        pitch: grid.step.max(),
        ..Lattice::default()
    };
    let present = (0..number.len()).filter(|node| shares.area[*node] > 0.0);
    for (count, node) in (0_u32..).zip(present) {
        number[node] = Some(count);
        lattice.coordinates.push(grid.at(node));
        lattice
            .grid
            .push(grid.indices(node).map(|index| index as i32));
        lattice.area.push(shares.area[node]);
    }
    let woven = Woven {
        grid,
        shares,
        number,
    };
    for node in 0..woven.number.len() {
        for yarn in [Yarn::Warp, Yarn::Weft] {
            lattice.rods.extend(woven.rod(node, yarn));
            lattice.bends.extend(woven.bend(node, yarn));
        }
    }
    for (square, mesh) in grid.meshes.iter().enumerate() {
        lattice.cells.extend(woven.cell(square, *mesh));
        woven.push_corners(square, *mesh, &mut lattice.corners);
    }
    lattice.twists = twists(grid, &woven.number);
    lattice
}

/// How much cloth each part of the grid stands for.
struct Shares {
    /// Area of each node [cm²].
    area: Vec<f64>,
    /// Width of the rods that begin at each node along warp and weft [cm]; 0 where there is none.
    width: [Vec<f64>; 2],
}

impl Shares {
    fn of(grid: &Grid) -> Self {
        let nodes = grid.shift.len();
        let mut shares = Self {
            area: vec![0.0; nodes],
            width: [vec![0.0; nodes], vec![0.0; nodes]],
        };
        for (square, mesh) in grid.meshes.iter().enumerate() {
            if *mesh != Mesh::Absent {
                shares.add(grid, square, *mesh);
            }
        }
        shares
    }

    fn add(&mut self, grid: &Grid, square: usize, mesh: Mesh) {
        let nodes: Vec<usize> = grid.nodes(square, mesh).collect();
        let area = grid.area(&nodes);
        for node in &nodes {
            self.area[*node] += area / nodes.len() as f64;
        }
        let square = grid.square(square);
        for yarn in [Yarn::Warp, Yarn::Weft] {
            let rods = SIDES.iter().filter(|(from, to, along)| {
                *along == yarn && [from, to].iter().all(|end| mesh.corners().contains(end))
            });
            let rods = rods.map(|(from, to, _)| {
                let rod = grid.vector(square[*from], square[*to]);
                (square[*from], rod.norm(), alignment(rod))
            });
            let whole: f64 = rods.clone().map(|(_, rest, share)| rest * share).sum();
            for (from, _, share) in rods {
                self.width[yarn as usize][from] += area * share / whole;
            }
        }
    }
}

/// How well a rod does for its yarn: the stiffness of cloth along the rod over that along the yarn,
/// from 1 on grain to about 0.04 midway between the yarns. Closed form for balanced cloth without
/// Poisson effect, 1/E(α) = (cos⁴α + sin⁴α)/E + sin²α cos²α/G, its first term taken as 1/E.
fn alignment(rod: Vec2) -> f64 {
    let off = rod.x * rod.y / rod.norm_squared();
    1.0 / (1.0 + YARN_OVER_SHEAR * off * off)
}

/// A grid whose present nodes are numbered.
struct Woven<'a> {
    grid: &'a Grid,
    shares: Shares,
    number: Vec<Option<u32>>,
}

impl Woven<'_> {
    /// The next node along a yarn, by its place in the grid.
    fn next(&self, node: usize, yarn: Yarn) -> usize {
        match yarn {
            Yarn::Warp => node + 1,
            Yarn::Weft => node + self.grid.counts[0],
        }
    }

    fn rod(&self, node: usize, yarn: Yarn) -> Option<Rod> {
        let width = self.shares.width[yarn as usize][node];
        if width <= 0.0 {
            return None;
        }
        let next = self.next(node, yarn);
        Some(Rod {
            nodes: [self.number[node]?, self.number[next]?],
            yarn,
            rest: self.grid.vector(node, next).norm(),
            width,
        })
    }

    /// The bend about a node.
    fn bend(&self, node: usize, yarn: Yarn) -> Option<Bend> {
        let before = match yarn {
            Yarn::Warp => node.checked_sub(1)?,
            Yarn::Weft => node.checked_sub(self.grid.counts[0])?,
        };
        let (rod, next) = (self.rod(before, yarn)?, self.rod(node, yarn)?);
        let [from, to] = [(before, node), (node, self.next(node, yarn))]
            .map(|(from, to)| self.grid.vector(from, to));
        Some(Bend {
            nodes: [rod.nodes[0], rod.nodes[1], next.nodes[1]],
            yarn,
            length: 0.5 * (rod.rest + next.rest),
            width: 0.5 * (rod.width + next.width),
            rest_angle: angle(from, to),
        })
    }

    fn cell(&self, square: usize, mesh: Mesh) -> Option<Cell> {
        let nodes = self.grid.square(square);
        let corner = |corner: usize| match mesh {
            Mesh::Absent => None,
            Mesh::Without(missing) if missing == corner => self.number[nodes[(corner + 3) % 4]],
            _ => self.number[nodes[corner]],
        };
        Some([corner(0)?, corner(1)?, corner(2)?, corner(3)?])
    }

    fn push_corners(&self, square: usize, mesh: Mesh, corners: &mut Vec<Corner>) {
        let nodes: Vec<usize> = self.grid.nodes(square, mesh).collect();
        let area = self.grid.area(&nodes);
        let square = self.grid.square(square);
        // Of a triangle, the corner opposite to the missing one lies between its two rods.
        let (mids, area): (&[usize], f64) = match mesh {
            Mesh::Without(missing) => (&[(missing + 2) % 4], area),
            _ => (mesh.corners(), 0.25 * area),
        };
        for mid in mids {
            // 0 and 1 lie along the warp from each other, as do 2 and 3; 0 and 3 along the weft.
            let ends = [square[*mid], square[mid ^ 1], square[3 - mid]];
            let [Some(at), Some(warp), Some(weft)] = ends.map(|node| self.number[node]) else {
                continue;
            };
            corners.push(Corner {
                nodes: [at, warp, weft],
                rest_angle: angle(
                    self.grid.vector(ends[0], ends[1]),
                    self.grid.vector(ends[0], ends[2]),
                ),
                area,
            });
        }
    }
}

/// The angle between two directions [rad]: exactly 0 and π/2 where the numbers allow it.
fn angle(a: Vec2, b: Vec2) -> f64 {
    libm::atan2(cross(a, b).abs(), a.dot(&b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// A square of 2 × 2 meshes at pitch 2 whose far corner is cut off.
    fn cut_square() -> Lattice {
        let mut grid = Grid::regular([3, 3], Vec2::new(2.0, 2.0));
        grid.meshes[3] = Mesh::Without(2);
        weave(&grid)
    }

    #[test]
    fn a_triangle_stands_for_its_area_in_every_law() {
        let lattice = cut_square();
        assert_eq!(lattice.coordinates.len(), 8);
        assert_eq!(lattice.cells.last(), Some(&[4, 5, 5, 7]));
        let last = lattice.corners.last().unwrap();
        assert_eq!(
            (last.nodes, last.rest_angle, last.area),
            ([4, 5, 7], FRAC_PI_2, 2.0)
        );
        assert!((lattice.area.iter().sum::<f64>() - 14.0).abs() < 1e-12);
        assert_eq!(lattice.corners.iter().map(|c| c.area).sum::<f64>(), 14.0);
        for yarn in [Yarn::Warp, Yarn::Weft] {
            let rods = lattice.rods.iter().filter(|rod| rod.yarn == yarn);
            assert_eq!(
                rods.clone().map(|rod| rod.rest * rod.width).sum::<f64>(),
                14.0
            );
            assert_eq!(rods.count(), 5);
        }
    }

    #[test]
    fn a_rod_off_the_grain_gets_the_lesser_share() {
        let mut grid = Grid::regular([2, 2], Vec2::new(1.0, 1.0));
        grid.shift[3] = Vec2::new(0.0, -0.3);
        let lattice = weave(&grid);
        let [on, _, off, ..] = lattice.rods.as_slice() else {
            panic!("a mesh has four rods");
        };
        assert_eq!((on.nodes, off.nodes), ([0, 1], [1, 3]));
        let warp = lattice.rods.iter().filter(|rod| rod.yarn == Yarn::Warp);
        let warp: Vec<_> = warp.collect();
        assert!(warp[1].width < 0.2 * warp[0].width);
        let shared: f64 = warp.iter().map(|rod| rod.rest * rod.width).sum();
        assert!((shared - 0.85).abs() < 1e-15);
        // Both weft rods lie on the grain and share by length alone.
        let weft = lattice.rods.iter().filter(|rod| rod.yarn == Yarn::Weft);
        assert!(weft.clone().all(|rod| (rod.width - 0.5).abs() < 1e-15));
    }
}
