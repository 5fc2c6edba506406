//! The skin: one closed surface over all flesh.
//!
//! 1. A grid of cells, looked at in blocks: a block far from the surface is all inside or all
//!    outside, since no point is nearer to it than the block's middle less the way to its corner.
//! 2. Clefts narrower than a cell, which would leave edges of four faces, are closed.
//! 3. Surface nets (Gibson, 1998; the crate `fast-surface-nets`) join the cells that are crossed.
//! 4. Vertices drift to the middle of their neighbours, and along the slope back to the surface; the
//!    crate's f32 decides only what is joined.

use super::{field::Field, figure::Robot};
use crate::{
    body::{Mesh, MeshError},
    math::{Pose, Vec3},
    skeleton::Posture,
};
use fast_surface_nets::{SurfaceNetsBuffer, ndshape::RuntimeShape, surface_nets};

/// Width of a cell [cm].
const CELL: f64 = 1.0;
/// Cells along a block's edge.
const BLOCK: usize = 4;
/// Where limbs blend, the surface is this much farther out than any of them [cm], at most.
const BLENDED: f64 = 2.5;
/// Cells along an edge of the grid, at most: a giant's span, and memory's sake.
const MOST: f64 = 420.0;
/// How often vertices drift; triangles are then of nearly one size.
const DRIFTS: usize = 8;

impl Robot {
    /// The skin over the muscles in place, closed and outward: a solid for cloth to lie on.
    ///
    /// # Errors
    /// [`MeshError`] where frames are not finite or the body reaches farther than 4.2 m.
    pub fn skin(&self, posture: &Posture, frames: &[Pose]) -> Result<Mesh, MeshError> {
        let field = Field::of(&self.muscles, &self.balls(posture, frames));
        let (vertices, triangles) = covered(&field);
        Mesh::new(vertices, triangles)
    }
}

/// A grid over the flesh: its lowest corner and how many corners it has along each axis.
struct Grid {
    low: Vec3,
    counts: [usize; 3],
}

fn covered(field: &Field) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let Some(grid) = Grid::over(field) else {
        return (Vec::new(), Vec::new());
    };
    let mut distances = grid.distances(field);
    grid.close_clefts(&mut distances);
    let counts = grid.counts.map(|count| count as u32);
    let mut net = SurfaceNetsBuffer::default();
    let last = counts.map(|count| count - 1);
    surface_nets(
        &distances,
        &RuntimeShape::<u32, 3>::new(counts),
        [0; 3],
        last,
        &mut net,
    );
    let mut vertices: Vec<Vec3> = net
        .positions
        .iter()
        .map(|place| grid.place(*place))
        .collect();
    let (triangles, _) = net.indices.as_chunks::<3>();
    let near: Vec<Field> = vertices
        .iter()
        .map(|vertex| field.near(vertex, 4.0 * CELL + BLENDED))
        .collect();
    for _ in 0..DRIFTS {
        vertices = drifted(&vertices, triangles);
        for (vertex, near) in vertices.iter_mut().zip(&near) {
            *vertex = onto_surface(near, *vertex, 1);
        }
    }
    for (vertex, near) in vertices.iter_mut().zip(&near) {
        *vertex = onto_surface(near, *vertex, 6);
    }
    (vertices, triangles.to_vec())
}

impl Grid {
    /// None where there is nothing, or it reaches farther than any body.
    fn over(field: &Field) -> Option<Self> {
        let (low, high) = field.extent()?;
        // On whole cells of space, so that a small move does not shift the grid by a part of one.
        let low = low.map(|x| (x / CELL).floor() - 2.0);
        let high = high.map(|x| (x / CELL).ceil() + 2.0);
        let size = high - low;
        // Not so for NaN either.
        if !size.iter().all(|cells| (1.0..=MOST).contains(cells)) {
            return None;
        }
        Some(Self {
            low: low * CELL,
            counts: [size.x, size.y, size.z].map(|cells| {
                let blocks = (cells as usize).div_ceil(BLOCK);
                blocks * BLOCK
            }),
        })
    }

    /// The crate's place of a vertex, in cells; rounded, so that the last bits of its f32 count for
    /// nothing.
    fn place(&self, cells: [f32; 3]) -> Vec3 {
        let rounded = cells.map(|x| (256.0 * f64::from(x)).round() / 256.0);
        self.low + Vec3::from(rounded) * CELL
    }

    /// How far outside the corners are, x running fastest.
    fn distances(&self, field: &Field) -> Vec<f32> {
        let [across, deep, high] = self.counts;
        let mut distances = vec![0.0_f32; across * deep * high];
        let half = 0.5 * (BLOCK - 1) as f64 * CELL;
        let to_corner = half * 3.0_f64.sqrt();
        let blocks = |count: usize| (0..count).step_by(BLOCK);
        for z in blocks(high) {
            for y in blocks(deep) {
                for x in blocks(across) {
                    let low = self.corner([x, y, z]);
                    let middle = low + Vec3::repeat(half);
                    let Some(whole) = field.outside(&middle) else {
                        continue;
                    };
                    let reach = whole.distance.max(0.0) + 2.0 * to_corner + BLENDED;
                    let uniform = whole.distance.abs() > to_corner + CELL + BLENDED;
                    let near = (!uniform).then(|| field.near(&middle, reach));
                    self.fill(&mut distances, [x, y, z], |corner| {
                        let outside = near.as_ref().and_then(|near| near.outside(&corner));
                        outside.unwrap_or(whole).distance as f32
                    });
                }
            }
        }
        distances
    }

    fn fill(&self, distances: &mut [f32], low: [usize; 3], of: impl Fn(Vec3) -> f32) {
        let [across, deep, _] = self.counts;
        let [x0, y0, z0] = low;
        for z in z0..z0 + BLOCK {
            for y in y0..y0 + BLOCK {
                for x in x0..x0 + BLOCK {
                    if let Some(slot) = distances.get_mut((z * deep + y) * across + x) {
                        *slot = of(self.corner([x, y, z]));
                    }
                }
            }
        }
    }

    /// Closes cells whose corners inside, or whose corners outside, do not hang together by edges:
    /// there one vertex would stand for two sheets. Closing one may break its neighbour, so again
    /// until none is left; each time less is outside.
    fn close_clefts(&self, distances: &mut [f32]) {
        let [across, deep, high] = self.counts;
        let whole: Vec<bool> = (0..=u8::MAX)
            .map(|inside| joined(inside) && joined(!inside))
            .collect();
        let mut open = true;
        while core::mem::take(&mut open) {
            for z in 0..high - 1 {
                for y in 0..deep - 1 {
                    for x in 0..across - 1 {
                        let corners: [usize; 8] = core::array::from_fn(|corner| {
                            let (x, y, z) =
                                (x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2));
                            (z * deep + y) * across + x
                        });
                        let is_inside = |at: &usize| distances.get(*at).is_some_and(|d| *d < 0.0);
                        let inside = corners
                            .iter()
                            .rev()
                            .fold(0, |bits, at| bits << 1 | usize::from(is_inside(at)));
                        if whole.get(inside).copied().unwrap_or(true) {
                            continue;
                        }
                        open = true;
                        for at in corners {
                            if let Some(distance) = distances.get_mut(at).filter(|d| **d >= 0.0) {
                                *distance = -0.25;
                            }
                        }
                    }
                }
            }
        }
    }

    fn corner(&self, cell: [usize; 3]) -> Vec3 {
        self.low + Vec3::from(cell.map(|index| index as f64)) * CELL
    }
}

/// Whether the corners of a cube that are set hang together by its edges.
fn joined(corners: u8) -> bool {
    let mut reached = corners & corners.wrapping_neg();
    loop {
        // To the next corner along x, y and z, and back.
        let along = (reached & 0x55) << 1 | (reached & 0xaa) >> 1;
        let beside = (reached & 0x33) << 2 | (reached & 0xcc) >> 2;
        let next = (reached | along | beside | reached << 4 | reached >> 4) & corners;
        if next == reached {
            return reached == corners;
        }
        reached = next;
    }
}

/// Each vertex half way to the mean of those it shares an edge with.
fn drifted(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let mut sums = vec![(Vec3::zeros(), 0.0); vertices.len()];
    for &[a, b, c] in triangles {
        for (to, from) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
            let from = vertices.get(from as usize).copied().unwrap_or_default();
            if let Some((sum, count)) = sums.get_mut(to as usize) {
                *sum += from;
                *count += 1.0;
            }
        }
    }
    let moved = vertices.iter().zip(sums);
    moved
        .map(|(vertex, (sum, count))| 0.5 * (vertex + sum / f64::max(count, 1.0)))
        .collect()
}

/// Newton's steps along the slope.
fn onto_surface(field: &Field, mut point: Vec3, steps: usize) -> Vec3 {
    for _ in 0..steps {
        let Some(outside) = field.outside(&point) else {
            break;
        };
        let way = outside.distance / outside.slope.norm_squared().max(0.25);
        point -= outside.slope * way.clamp(-CELL, CELL);
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_hang_together_by_edges_only() {
        // Corner 0 is the lowest; 1, 2 and 4 are next to it along x, y and z.
        for (corners, whole) in [
            (0b0000_0000, true),
            (0b0000_0001, true),
            (0b0000_0011, true),
            (0b0000_1001, false),
            (0b1000_0001, false),
            (0b0001_0001, true),
            (0b1001_0110, false),
            (0b0111_1111, true),
        ] {
            assert_eq!(joined(corners), whole, "{corners:b}");
        }
    }
}
