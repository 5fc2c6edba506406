//! Covers a solid with triangles of nearly one size: surface nets (S. Gibson, 1998).
//!
//! 1. Where corners of a cubic cell are on both sides of the surface, the cell gets a vertex.
//! 2. Each edge of the grid that crosses the surface joins the vertices of its four cells.
//! 3. Vertices drift to the middle of their neighbours, and back along the normal to the surface.

use std::{
    array,
    collections::{BTreeMap, BTreeSet},
};

use soen::math::Vec3;

type Cell = [i32; 3];

/// Half the grid's width, depth and the heights it spans [cm]; the form stands well inside.
const HALF: f64 = 24.0;
const LOW: f64 = 66.0;
const HIGH: f64 = 143.0;

/// How often vertices drift; after 30 times they move less than 0.01 cm.
const DRIFTS: usize = 30;

/// The surface of the solid where `depth` is negative, wound outward.
pub(crate) fn cover(depth: &dyn Fn(Vec3) -> f64, pitch: f64) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let grid = Grid::new(depth, pitch);
    let cells = grid.crossed_cells();
    let mut vertices: Vec<Vec3> = cells.keys().map(|&cell| grid.middle(cell)).collect();
    let quads = grid.quads(&cells);
    for _ in 0..DRIFTS {
        vertices = drifted(&vertices, &quads);
        for vertex in &mut vertices {
            *vertex = onto_surface(depth, *vertex);
        }
    }
    let triangles = quads
        .iter()
        .flat_map(|&quad| halves(&vertices, quad))
        .collect();
    (vertices, triangles)
}

/// A cubic grid that is alike left and right of x = 0.
struct Grid {
    pitch: f64,
    size: [i32; 3],
    inside: Vec<bool>,
}

impl Grid {
    fn new(depth: &dyn Fn(Vec3) -> f64, pitch: f64) -> Self {
        let across = 2 * (HALF / pitch).ceil() as i32 + 1;
        let up = ((HIGH - LOW) / pitch).ceil() as i32 + 1;
        let mut grid = Self {
            pitch,
            size: [across, across, up],
            inside: Vec::new(),
        };
        for z in 0..up {
            for y in 0..across {
                for x in 0..across {
                    grid.inside.push(depth(grid.corner([x, y, z])) < 0.0);
                }
            }
        }
        grid
    }

    fn corner(&self, [x, y, z]: Cell) -> Vec3 {
        let middle = self.size[0] / 2;
        let across = |i: i32| f64::from(i - middle) * self.pitch;
        Vec3::new(across(x), across(y), LOW + f64::from(z) * self.pitch)
    }

    fn middle(&self, cell: Cell) -> Vec3 {
        self.corner(cell) + Vec3::repeat(0.5 * self.pitch)
    }

    fn is_inside(&self, [x, y, z]: Cell) -> bool {
        self.inside[((z * self.size[1] + y) * self.size[0] + x) as usize]
    }

    /// Corners of the grid that have a next one along every axis.
    fn lower_corners(&self) -> impl Iterator<Item = Cell> {
        let [nx, ny, nz] = self.size.map(|n| n - 1);
        (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
    }

    /// The cells that the surface passes through, numbered.
    fn crossed_cells(&self) -> BTreeMap<Cell, u32> {
        let crossed = |&[x, y, z]: &Cell| {
            let first = self.is_inside([x, y, z]);
            (1..8).any(|i| self.is_inside([x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)]) != first)
        };
        let in_order: BTreeSet<Cell> = self.lower_corners().filter(crossed).collect();
        in_order.into_iter().zip(0..).collect()
    }

    /// The four cells around each edge that crosses the surface, counter-clockwise from outside.
    fn quads(&self, cells: &BTreeMap<Cell, u32>) -> Vec<[u32; 4]> {
        let mut quads = Vec::new();
        for corner in self.lower_corners() {
            for axis in 0..3 {
                let mut next = corner;
                next[axis] += 1;
                if self.is_inside(corner) == self.is_inside(next) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let cell = |back_u: i32, back_v: i32| {
                    let mut cell = corner;
                    cell[u] -= back_u;
                    cell[v] -= back_v;
                    cells[&cell]
                };
                let mut quad = [cell(1, 1), cell(0, 1), cell(0, 0), cell(1, 0)];
                if !self.is_inside(corner) {
                    quad.reverse();
                }
                quads.push(quad);
            }
        }
        quads
    }
}

/// Each vertex half way to the mean of those it shares an edge with.
fn drifted(vertices: &[Vec3], quads: &[[u32; 4]]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::zeros(), 0.0); vertices.len()];
    for quad in quads {
        for i in 0..4 {
            let (vertex, next) = (quad[i] as usize, quad[(i + 1) % 4] as usize);
            for (to, from) in [(vertex, next), (next, vertex)] {
                sums[to].0 += vertices[from];
                sums[to].1 += 1.0;
            }
        }
    }
    vertices
        .iter()
        .zip(sums)
        .map(|(v, (sum, count))| 0.5 * (v + sum / count))
        .collect()
}

/// Newton's steps along the gradient.
fn onto_surface(depth: &dyn Fn(Vec3) -> f64, mut p: Vec3) -> Vec3 {
    const STEP: f64 = 1e-4;
    for _ in 0..3 {
        let slope = array::from_fn(|axis| {
            let mut step = Vec3::zeros();
            step[axis] = STEP;
            (depth(p + step) - depth(p - step)) / (2.0 * STEP)
        });
        let slope = Vec3::from(slope);
        p -= slope * (depth(p) / slope.norm_squared().max(0.01));
    }
    p
}

/// Divides a quad by its shorter diagonal.
fn halves(vertices: &[Vec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let apart = |p: u32, q: u32| (vertices[p as usize] - vertices[q as usize]).norm();
    if apart(a, c) <= apart(b, d) {
        [[a, b, c], [a, c, d]]
    } else {
        [[a, b, d], [b, c, d]]
    }
}
