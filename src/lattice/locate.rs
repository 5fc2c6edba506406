//! Finds the cell under a cloth coordinate, to carry positions from one lattice to another.

use crate::{
    lattice::{
        Cell, Lattice,
        ring::{cross, nearest_on_segment},
    },
    math::{Vec2, Vec3},
};

/// How far beyond a cell, in cells, its motion is carried on. Further out, the nearest place is
/// taken: a fold that is carried on for long runs away.
const REACH: f64 = 1.0;
/// A gap below this part of a bin is rounding.
const INSIDE: f64 = 1e-12;
/// Newton steps to a place in a cell; on a regular cell the first is exact.
const STEPS: usize = 6;

/// A place on a lattice: a weighted mean of the nodes of one cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The nodes of a cell.
    pub nodes: [u32; 4],
    /// Their weights, of sum 1; some are negative outside of the cell.
    pub weights: [f64; 4],
}

impl Place {
    /// The node that counts most.
    #[must_use]
    pub fn nearest(&self) -> u32 {
        let heavier = |a: usize, b: usize| {
            if self.weights[b] > self.weights[a] {
                b
            } else {
                a
            }
        };
        self.nodes[(0..4).fold(0, heavier)]
    }

    /// The mean of the nodes' positions by the weights [cm].
    #[must_use]
    pub fn blend(&self, positions: &[Vec3]) -> Vec3 {
        let mut at = Vec3::zeros();
        for (node, weight) in self.nodes.iter().zip(self.weights) {
            at += positions[*node as usize] * weight;
        }
        at
    }
}

/// Answers many calls of [`Lattice::locate`] on one lattice, each in constant time.
#[derive(Clone, Debug)]
pub struct Locator<'a> {
    lattice: &'a Lattice,
    low: Vec2,
    high: Vec2,
    /// Side of a bin [cm].
    side: f64,
    /// Bins along the warp and along the weft.
    counts: [usize; 2],
    /// The cells that each bin may touch; bins in rows along the weft.
    bins: Vec<Vec<usize>>,
}

impl Lattice {
    /// The place at cloth coordinates (warp, weft) [cm]: in the cell that contains them, or carried
    /// on from the nearest one, by at most a cell. Looks at every cell; [`locator`](Self::locator)
    /// is for many calls.
    #[must_use]
    pub fn locate(&self, coordinate: Vec2) -> Place {
        self.locator().locate(coordinate)
    }

    /// Prepares for many calls of [`locate`](Self::locate).
    #[must_use]
    pub fn locator(&self) -> Locator<'_> {
        Locator::of(self)
    }

    /// The node nearest to cloth coordinates, and how far it is [cm]; the first in lattice order of
    /// several. Looks at every node. `None` where there is none.
    #[must_use]
    pub fn nearest_node(&self, coordinate: Vec2) -> Option<(u32, f64)> {
        let distances = self.coordinates.iter().map(|at| (at - coordinate).norm());
        (0_u32..)
            .zip(distances)
            .min_by(|(_, a), (_, b)| a.total_cmp(b))
    }
}

impl<'a> Locator<'a> {
    fn of(lattice: &'a Lattice) -> Self {
        let (low, high) = box_of(&lattice.coordinates);
        let side = if lattice.pitch > 0.0 {
            lattice.pitch
        } else {
            1.0
        };
        let counts = [high.x - low.x, high.y - low.y].map(|size| (size / side) as usize + 1);
        let mut locator = Self {
            lattice,
            low,
            high,
            side,
            counts,
            bins: vec![Vec::new(); counts[0] * counts[1]],
        };
        for number in 0..lattice.cells.len() {
            let (low, high) = box_of(&locator.corners(number));
            let ([left, lower], [right, upper]) = (locator.bin(low), locator.bin(high));
            for row in lower..=upper {
                for bin in left..=right {
                    locator.bins[row * counts[0] + bin].push(number);
                }
            }
        }
        locator
    }

    /// As [`Lattice::locate`].
    #[must_use]
    pub fn locate(&self, coordinate: Vec2) -> Place {
        match self.nearest_cell(coordinate.sup(&self.low).inf(&self.high)) {
            None => Place {
                nodes: [0; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
            },
            Some(cell) => Place {
                nodes: self.lattice.cells[cell],
                weights: in_cell(self.corners(cell), coordinate).1,
            },
        }
    }

    /// The cell nearest to a point of the lattice's bounding box: its bin is searched first, then
    /// rings of bins about it.
    fn nearest_cell(&self, point: Vec2) -> Option<usize> {
        let centre = self.bin(point);
        let mut best: Option<(f64, usize)> = None;
        for ring in 0..self.counts[0].max(self.counts[1]) {
            // Cells found first in this ring are at least `ring − 1` bins away.
            let clear = self.side * ring.saturating_sub(1) as f64;
            if best.is_some_and(|(distance, _)| ring > 1 && distance <= clear) {
                break;
            }
            for cell in self.ring(centre, ring) {
                let (distance, _) = in_cell(self.corners(cell), point);
                if best.is_none_or(|(least, _)| distance < least) {
                    best = Some((distance, cell));
                }
            }
            if best.is_some_and(|(distance, _)| distance <= INSIDE * self.side) {
                break;
            }
        }
        best.map(|(_, cell)| cell)
    }

    /// The cells of all bins at a distance, in bins, from one.
    fn ring(&self, [i, j]: [usize; 2], ring: usize) -> impl Iterator<Item = usize> {
        let rows = j.saturating_sub(ring)..=(j + ring).min(self.counts[1] - 1);
        let columns = i.saturating_sub(ring)..=(i + ring).min(self.counts[0] - 1);
        let bins = rows.flat_map(move |row| columns.clone().map(move |column| [column, row]));
        let at_ring = bins.filter(move |bin| bin[0].abs_diff(i).max(bin[1].abs_diff(j)) == ring);
        at_ring.flat_map(|bin| self.bins[bin[1] * self.counts[0] + bin[0]].iter().copied())
    }

    fn bin(&self, point: Vec2) -> [usize; 2] {
        let bin = (point - self.low) / self.side;
        [
            (bin.x as usize).min(self.counts[0] - 1),
            (bin.y as usize).min(self.counts[1] - 1),
        ]
    }

    fn corners(&self, cell: usize) -> [Vec2; 4] {
        let cell: Cell = self.lattice.cells[cell];
        cell.map(|node| self.lattice.coordinates[node as usize])
    }
}

fn box_of(points: &[Vec2]) -> (Vec2, Vec2) {
    let first = points.first().copied().unwrap_or_default();
    points
        .iter()
        .fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)))
}

/// Distance from a cell, about 0 inside, and the weights of its corners.
fn in_cell(corners: [Vec2; 4], point: Vec2) -> (f64, [f64; 4]) {
    match (0..4).find(|k| corners[*k] == corners[(k + 3) % 4]) {
        Some(missing) => in_triangle(corners, missing, point),
        None => in_quadrangle(corners, point),
    }
}

fn in_quadrangle(corners: [Vec2; 4], point: Vec2) -> (f64, [f64; 4]) {
    let mut at = Vec2::repeat(0.5);
    for _ in 0..STEPS {
        let (_, step) = linear_step(corners, at, point);
        at = (at + step).map(|t| t.clamp(0.0, 1.0));
    }
    // The last step is linear, so it may leave the cell without losing the root.
    let (gap, step) = linear_step(corners, at, point);
    let step = step.map(|t| t.clamp(-REACH, REACH));
    let (u, v) = (at.x, at.y);
    let weights = [
        (1.0 - u) * (1.0 - v) - step.x * (1.0 - v) - step.y * (1.0 - u),
        u * (1.0 - v) + step.x * (1.0 - v) - step.y * u,
        u * v + step.x * v + step.y * u,
        (1.0 - u) * v - step.x * v + step.y * (1.0 - u),
    ];
    (gap, weights)
}

/// How far a point is from the bilinear place `at` of a quadrangle, and the step in `at` that would
/// reach it if the quadrangle were a parallelogram.
fn linear_step([a, b, c, d]: [Vec2; 4], at: Vec2, point: Vec2) -> (f64, Vec2) {
    let along = (b - a) * (1.0 - at.y) + (c - d) * at.y;
    let across = (d - a) * (1.0 - at.x) + (c - b) * at.x;
    let gap = point - (a + (b - a) * at.x) * (1.0 - at.y) - (d + (c - d) * at.x) * at.y;
    let step = Vec2::new(cross(gap, across), cross(along, gap)) / cross(along, across);
    (gap.norm(), step)
}

/// As a quadrangle of which one corner, which repeats the one before it, has no weight.
fn in_triangle(corners: [Vec2; 4], missing: usize, point: Vec2) -> (f64, [f64; 4]) {
    let [mid, next, before] = [2, 3, 1].map(|k| (missing + k) % 4);
    let (along, across) = (corners[next] - corners[mid], corners[before] - corners[mid]);
    let gap = point - corners[mid];
    let area = cross(along, across);
    let (u, v) = (cross(gap, across) / area, cross(along, gap) / area);
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    let sides = [(mid, next), (next, before), (before, mid)]
        .map(|(from, to)| (nearest_on_segment(point, corners[from], corners[to]) - point).norm());
    let outside = sides.into_iter().fold(f64::INFINITY, f64::min);
    let [u, v] = [u, v].map(|t| t.clamp(-REACH, 1.0 + REACH));
    let mut weights = [0.0; 4];
    weights[mid] = 1.0 - u - v;
    weights[next] = u;
    weights[before] = v;
    (if inside { 0.0 } else { outside }, weights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{Outline, sample::cut};

    fn value(place: Place, field: impl Fn(usize) -> f64) -> f64 {
        let parts = place.nodes.iter().zip(place.weights);
        parts
            .map(|(node, weight)| weight * field(*node as usize))
            .sum()
    }

    /// The linear fields warp and weft, of which any other is made, come back.
    #[track_caller]
    fn check(lattice: &Lattice, points: impl Iterator<Item = Vec2>) {
        let locator = lattice.locator();
        for point in points {
            let place = locator.locate(point);
            assert_eq!(place, lattice.locate(point));
            assert!((place.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
            for axis in 0..2 {
                let found = value(place, |node| lattice.coordinates[node][axis]);
                assert!((found - point[axis]).abs() < 1e-9, "{point} {found}");
            }
        }
    }

    fn spiral(radius: f64) -> impl Iterator<Item = Vec2> {
        (0..500).map(move |k| {
            let (sin, cos) = (2.4 * f64::from(k)).sin_cos();
            Vec2::new(cos, sin) * (radius * (f64::from(k) / 500.0).sqrt())
        })
    }

    #[test]
    fn linear_fields_come_back_on_regular_cells() {
        let cloth = cut(Outline::rectangle(10.0, 8.0).unwrap(), 90.0, 0.7);
        check(&cloth, spiral(4.4));
        check(&cloth, cloth.coordinates.clone().into_iter());
    }

    #[test]
    fn linear_fields_come_back_on_skew_cells_and_a_little_outside() {
        check(&cut(Outline::disc(5.0).unwrap(), 0.0, 0.8), spiral(5.3));
        let bias = cut(Outline::rectangle(12.0, 11.0).unwrap(), 33.0, 0.9);
        check(&bias, spiral(5.7));
    }

    #[test]
    fn the_cell_that_contains_a_point_is_found() {
        let disc = cut(Outline::disc(5.0).unwrap(), 0.0, 0.8);
        let locator = disc.locator();
        for cell in &disc.cells {
            let mut nodes = cell.to_vec();
            nodes.sort_unstable();
            nodes.dedup();
            let sum: Vec2 = nodes.iter().map(|n| disc.coordinates[*n as usize]).sum();
            let place = locator.locate(sum / nodes.len() as f64);
            assert_eq!(place.nodes, *cell);
        }
    }

    #[test]
    fn far_outside_a_position_is_carried_on_by_a_cell_at_most() {
        let cloth = cut(Outline::rectangle(10.0, 8.0).unwrap(), 0.0, 1.0);
        let place = cloth.locate(Vec2::new(300.0, 0.5));
        assert_eq!(value(place, |node| cloth.coordinates[node].x), 6.0);
        assert_eq!(value(place, |node| cloth.coordinates[node].y), 0.5);
    }

    #[test]
    fn the_nearest_node_is_the_nearest() {
        let cloth = cut(Outline::rectangle(10.0, 8.0).unwrap(), 0.0, 1.0);
        let (node, distance) = cloth.nearest_node(Vec2::new(-7.0, -4.0)).unwrap();
        assert_eq!((node, distance), (0, 2.0));
        assert_eq!(Lattice::default().nearest_node(Vec2::zeros()), None);
    }
}
