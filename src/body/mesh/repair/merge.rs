use std::collections::BTreeMap;

use super::{Soup, at};
use crate::math::Vec3;

/// How near vertices must be to be one, over the diagonal of the mesh: the resolution of the
/// 32-bit numbers that most formats hold. Spot's seams (text of 6 digits) match exactly; a
/// scanner's finest detail is 100 times wider.
const SAME_PLACE: f64 = 1e-7;

/// A mesh whose vertices stand apart.
pub(super) struct Merged {
    pub(super) soup: Soup,
    /// Distance below which two vertices were one [cm].
    pub(super) tolerance: f64,
}

/// Merges vertices at the same place into the first of them; vertices of no face are left out.
pub(super) fn merged(soup: Soup) -> Merged {
    let mut soup = used(soup);
    let (low, high) = extent(&soup.vertices);
    let tolerance = SAME_PLACE * (high - low).norm();
    let mut grid = Grid {
        low,
        tolerance,
        cells: BTreeMap::new(),
    };
    let mut kept = Vec::new();
    let places: Vec<u32> = soup
        .vertices
        .iter()
        .map(|&vertex| grid.place(vertex, &mut kept))
        .collect();
    renumber(&mut soup.triangles, &places);
    soup.vertices = kept;
    Merged { soup, tolerance }
}

/// Leaves out vertices of no face; the others keep their order.
pub(super) fn used(mut soup: Soup) -> Soup {
    let mut numbers = vec![None; soup.vertices.len()];
    for &corner in soup.triangles.iter().flatten() {
        if let Some(number) = numbers.get_mut(corner as usize) {
            *number = Some(0);
        }
    }
    for (next, number) in (0..).zip(numbers.iter_mut().flatten()) {
        *number = next;
    }
    let mut in_use = numbers.iter().map(Option::is_some);
    soup.vertices.retain(|_| in_use.next().unwrap_or(false));
    let numbers: Vec<u32> = numbers.into_iter().map(Option::unwrap_or_default).collect();
    renumber(&mut soup.triangles, &numbers);
    soup
}

/// The lowest and highest coordinates [cm]; of no vertices, the origin.
pub(in super::super) fn extent(vertices: &[Vec3]) -> (Vec3, Vec3) {
    let first = vertices.first().copied().unwrap_or_default();
    vertices
        .iter()
        .fold((first, first), |(low, high), v| (low.inf(v), high.sup(v)))
}

fn renumber(triangles: &mut [[u32; 3]], numbers: &[u32]) {
    for corner in triangles.iter_mut().flatten() {
        *corner = numbers.get(*corner as usize).copied().unwrap_or_default();
    }
}

/// Vertices kept so far, by cubic cell. A cell is twice the tolerance wide, so that a vertex's
/// surroundings reach into two cells along an axis at most.
struct Grid {
    low: Vec3,
    tolerance: f64,
    cells: BTreeMap<[i64; 3], Vec<u32>>,
}

impl Grid {
    /// The number of the kept vertex at this place, this one if there was none.
    fn place(&mut self, vertex: Vec3, kept: &mut Vec<Vec3>) -> u32 {
        let reach = Vec3::repeat(self.tolerance);
        let [x0, y0, z0] = self.cell(vertex - reach);
        let [x1, y1, z1] = self.cell(vertex + reach);
        for x in x0..=x1 {
            for y in y0..=y1 {
                for z in z0..=z1 {
                    let there = self
                        .cells
                        .get(&[x, y, z])
                        .map(Vec::as_slice)
                        .unwrap_or_default();
                    let near = |&&other: &&u32| (at(kept, other) - vertex).norm() <= self.tolerance;
                    if let Some(&other) = there.iter().find(near) {
                        return other;
                    }
                }
            }
        }
        let number = kept.len() as u32;
        kept.push(vertex);
        self.cells
            .entry(self.cell(vertex))
            .or_default()
            .push(number);
        number
    }

    fn cell(&self, position: Vec3) -> [i64; 3] {
        // The cast saturates, and a mesh of no extent has all its vertices in cell 0.
        let side = (2.0 * self.tolerance).max(f64::MIN_POSITIVE);
        let steps = (position - self.low) / side;
        [steps.x, steps.y, steps.z].map(|step| step.floor() as i64)
    }
}
