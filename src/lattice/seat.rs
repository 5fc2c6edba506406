//! Seats the nodes of a grid that are next to an outline on it.
//!
//! 1. Every place of the grid is inside or outside.
//! 2. Where the outline passes between two neighbours, the nearer one is moved to the nearest point
//!    of the outline; each corner of the outline takes a node near it.
//! 3. Squares whose four nodes are inside or seated are cloth. With one node outside, the triangle
//!    of the other three is. So along the bias the cloth ends in triangles, whose long sides are no
//!    rods: a row of rods along such an edge would make it as stiff as a yarn.
//! 4. Meshes too small or too slanted are left out, nodes inside that this lays bare are seated in
//!    their turn, and 3 is repeated until none is bare. It ends, for seated nodes stay seated.
//!
//! So every node at the lattice's boundary lies on the outline. The one exception is a node laid bare
//! in 4 more than a step away from it, which stays where it is. (Of 4300 random stars, 8 to 24 cm
//! wide and half of them with a hole, at pitches of 0.4 to 1.1 cm, none laid a node bare.)

use crate::{
    lattice::{
        Outline,
        grid::{Grid, Mesh},
        ring::cross,
    },
    math::Vec2,
};
use std::{collections::BTreeSet, f64::consts::PI};

/// An outline that turns by more than this has a corner, which a node marks [rad].
const CORNER: f64 = PI / 9.0;
/// What a mesh may be like.
struct Limits {
    /// Its shortest rod, in grid steps.
    shortest: f64,
    /// Its sharpest angle, and how far its bluntest stays from straight [rad].
    sharpest: f64,
}

/// For meshes whose loss only moves the cloth's edge.
const STRICT: Limits = Limits {
    shortest: 0.3,
    sharpest: PI / 9.0,
};
/// For meshes whose loss would lay a node inside bare.
const LENIENT: Limits = Limits {
    shortest: 0.2,
    sharpest: PI / 22.5,
};
/// Distances that differ by less are equal, in grid steps: an outline that is symmetric but for
/// rounding gets a symmetric lattice.
const TIE: f64 = 1e-9;

/// Where a node of the grid is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Site {
    Outside,
    Inside,
    Seated,
}

/// Fits a regular grid to an outline that lies within it, in cloth coordinates.
pub(super) fn seat(grid: &mut Grid, outline: &Outline) {
    let sites = inside_and_outside(grid, outline);
    let ends: Vec<usize> = nearer_ends(grid, outline, &sites).collect();
    let mut seating = Seating {
        grid,
        outline,
        sites,
    };
    for node in ends {
        seating.take(node, outline.nearest(seating.grid.place(node)));
    }
    seating.mark_corners();
    seating.fill();
}

/// A grid in the course of being seated.
struct Seating<'a> {
    grid: &'a mut Grid,
    outline: &'a Outline,
    sites: Vec<Site>,
}

fn inside_and_outside(grid: &Grid, outline: &Outline) -> Vec<Site> {
    let mut sites = Vec::with_capacity(grid.shift.len());
    for row in 0..grid.counts[1] {
        let first = row * grid.counts[0];
        let crossings = outline.row_crossings(grid.place(first).y);
        let mut passed = 0;
        for node in first..first + grid.counts[0] {
            let x = grid.place(node).x;
            passed += crossings
                .iter()
                .skip(passed)
                .take_while(|at| **at < x)
                .count();
            let inside = passed % 2 == 1;
            sites.push(if inside { Site::Inside } else { Site::Outside });
        }
    }
    sites
}

/// Of neighbours that the outline passes between, the one nearer to it; of equally near ones the
/// one inside.
fn nearer_ends(grid: &Grid, outline: &Outline, sites: &[Site]) -> impl Iterator<Item = usize> {
    let across = grid.counts[0];
    let along = move |node: &usize| (node % across + 1 < across).then_some((*node, node + 1));
    let above = move |node: &usize| (node + across < sites.len()).then_some((*node, node + across));
    let warps = (0..sites.len()).filter_map(move |node| along(&node));
    let wefts = (0..sites.len()).filter_map(move |node| above(&node));
    let parted = warps.chain(wefts).filter(|(a, b)| sites[*a] != sites[*b]);
    parted.map(|(a, b)| {
        let [inside, outside] = if sites[a] == Site::Inside {
            [a, b]
        } else {
            [b, a]
        };
        let [near, far] = [inside, outside].map(|node| {
            let place = grid.place(node);
            (outline.nearest(place) - place).norm()
        });
        if near <= far + TIE * grid.step.min() {
            inside
        } else {
            outside
        }
    })
}

impl Seating<'_> {
    fn take(&mut self, node: usize, seat: Vec2) {
        self.grid.shift[node] = seat - self.grid.place(node);
        self.sites[node] = Site::Seated;
    }

    /// Seats a node on each corner of the outline: of the four around it, the nearest one that
    /// spoils no mesh; if all do, the outline's corner is cut off. Of equally near ones, a convex
    /// corner takes the one inside, a hollow one the one outside. A node takes one corner, its first.
    fn mark_corners(&mut self) {
        let mut taken = BTreeSet::new();
        for (corner, convex) in self.outline.corners(CORNER) {
            let better = if convex { Site::Inside } else { Site::Outside };
            let distance = |seating: &Self, node: usize| {
                let bonus = if seating.sites[node] == better {
                    TIE * seating.grid.step.min()
                } else {
                    0.0
                };
                (corner - seating.grid.place(node)).norm() - bonus
            };
            let mut around = self.grid.around(corner);
            around.sort_by(|a, b| distance(self, *a).total_cmp(&distance(self, *b)));
            let mut free = around.into_iter().filter(|node| !taken.contains(node));
            if let Some(node) = free.find(|node| self.spoilt_by(*node, corner) == 0) {
                taken.insert(node);
                self.take(node, corner);
            }
        }
    }

    /// How many meshes around a node would lay a node inside bare, if it took a seat.
    fn spoilt_by(&mut self, node: usize, seat: Vec2) -> usize {
        let before = (self.grid.shift[node], self.sites[node]);
        self.take(node, seat);
        let around = self.grid.squares_around(node);
        let spoilt = around.filter(|square| {
            let mesh = self.mesh(*square);
            self.bare(*square, mesh).next().is_some()
        });
        let spoilt = spoilt.count();
        (self.grid.shift[node], self.sites[node]) = before;
        spoilt
    }

    /// How far a node's place is from the outline [cm].
    fn distance(&self, node: usize) -> f64 {
        let place = self.grid.place(node);
        (self.outline.nearest(place) - place).norm()
    }

    /// Fills the squares, and seats what lies bare within a step of the outline, until nothing does.
    fn fill(&mut self) {
        loop {
            let squares = 0..self.grid.meshes.len();
            self.grid.meshes = squares.clone().map(|square| self.mesh(square)).collect();
            let bare = squares.flat_map(|square| self.bare(square, self.grid.meshes[square]));
            let near = |node: &usize| self.distance(*node) <= self.grid.step.max();
            let bare: BTreeSet<usize> = bare.filter(near).collect();
            if bare.is_empty() {
                return;
            }
            for node in bare {
                self.take(node, self.outline.nearest(self.grid.place(node)));
            }
        }
    }

    /// What of a square is cloth.
    fn mesh(&self, square: usize) -> Mesh {
        let nodes = self.grid.square(square);
        let count = |site: Site| nodes.iter().filter(|n| self.sites[**n] == site).count();
        if count(Site::Inside) == 4 {
            return Mesh::Whole;
        }
        let bares = count(Site::Inside) > 0;
        let fits = |mesh: Mesh| {
            let nodes = self.grid.nodes(square, mesh);
            let share = 1.0 / nodes.len() as f64;
            let middle = nodes.map(|node| self.grid.at(node) * share).sum();
            let within = bares || self.outline.contains(middle);
            let limits = if bares { LENIENT } else { STRICT };
            within && limits.allow(self.grid, square, mesh)
        };
        let outside = (0..4).find(|corner| self.sites[nodes[*corner]] == Site::Outside);
        let candidates = match (count(Site::Outside), outside) {
            (0, _) => [Some(Mesh::Whole), self.flattened(square)],
            (1, Some(corner)) => [Some(Mesh::Without(corner)), None],
            _ => [None, None],
        };
        let mut sound = candidates.into_iter().flatten().filter(|mesh| fits(*mesh));
        sound.next().unwrap_or(Mesh::Absent)
    }

    /// A square without its bluntest corner, where the outline runs straight past it.
    fn flattened(&self, square: usize) -> Option<Mesh> {
        let nodes = self.grid.square(square);
        let angle =
            |corner: &usize| angle_at(self.grid, [3, 0, 1].map(|k| nodes[(corner + k) % 4]));
        let bluntest = (0..4).max_by(|a, b| angle(a).total_cmp(&angle(b)))?;
        let seated = |k: usize| self.sites[nodes[(bluntest + k) % 4]] == Site::Seated;
        (seated(3) && seated(0) && seated(1)).then_some(Mesh::Without(bluntest))
    }

    /// The nodes inside that are corners of a square but not of its mesh.
    fn bare(&self, square: usize, mesh: Mesh) -> impl Iterator<Item = usize> {
        let nodes = self.grid.square(square).into_iter().enumerate();
        nodes.filter_map(move |(corner, node)| {
            let bare = self.sites[node] == Site::Inside && !mesh.corners().contains(&corner);
            bare.then_some(node)
        })
    }
}

impl Limits {
    fn allow(&self, grid: &Grid, square: usize, mesh: Mesh) -> bool {
        let nodes: Vec<usize> = grid.nodes(square, mesh).collect();
        let count = nodes.len();
        let shortest = self.shortest * grid.step.min();
        let rod = |k: usize| {
            let rod = grid.vector(nodes[k], nodes[(k + 1) % count]);
            rod.norm() >= shortest
        };
        let open = |k: usize| {
            let around = [count - 1, 0, 1].map(|next| nodes[(k + next) % count]);
            let angle = angle_at(grid, around);
            (self.sharpest..=PI - self.sharpest).contains(&angle)
        };
        match mesh {
            Mesh::Absent => false,
            Mesh::Whole => (0..4).all(|k| rod(k) && open(k)),
            // The rods of a triangle meet at its second node, and only there is a corner.
            Mesh::Without(_) => rod(0) && rod(1) && open(1),
        }
    }
}

/// The angle on the left of a path over three nodes [rad], negative where the path turns back past
/// straight; infinitely wrong values are never sound.
fn angle_at(grid: &Grid, [before, at, after]: [usize; 3]) -> f64 {
    let (back, on) = (grid.vector(at, before), grid.vector(at, after));
    let angle = libm::atan2(cross(on, back), on.dot(&back));
    if angle < 0.0 { angle + 2.0 * PI } else { angle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::{Lattice, Piece};
    use proptest::prelude::*;

    fn star(radii: &[f64]) -> Outline {
        let step = 2.0 * PI / radii.len() as f64;
        let tip = |(k, radius): (usize, &f64)| {
            let (sin, cos) = (k as f64 * step).sin_cos();
            Vec2::new(cos, sin) * *radius
        };
        Outline::polygon(radii.iter().enumerate().map(tip).collect(), Vec::new()).unwrap()
    }

    /// Nodes that have fewer than four whole meshes around them.
    fn at_the_edge(lattice: &Lattice) -> Vec<usize> {
        let mut meshes = vec![0; lattice.coordinates.len()];
        for cell in &lattice.cells {
            let triangle = (0..4).any(|k| cell[k] == cell[(k + 1) % 4]);
            for node in cell {
                meshes[*node as usize] += usize::from(!triangle);
            }
        }
        (0..meshes.len()).filter(|node| meshes[*node] < 4).collect()
    }

    proptest! {
        #[test]
        fn any_star_is_filled_to_its_edge(
            radii in prop::collection::vec(6.0..14.0_f64, 3..12),
            grain in 0.0..PI,
            pitch in 0.3..1.0_f64,
        ) {
            let piece = Piece { outline: star(&radii), grain, pitch };
            let lattice = piece.cut(pitch).unwrap();
            let area: f64 = lattice.area.iter().sum();
            prop_assert!((area / piece.outline.area() - 1.0).abs() < 0.05);
            for node in at_the_edge(&lattice) {
                let at = piece.to_outline(lattice.coordinates[node]);
                // Beside a triangle a node may lie inside, on its grid place.
                let seated = (piece.outline.nearest(at) - at).norm() < 1e-9;
                let steps = lattice.coordinates[node] / pitch;
                let on_grid = (steps - steps.map(f64::round)).norm() < 1e-9;
                prop_assert!(seated || on_grid && piece.outline.contains(at));
            }
            for rod in &lattice.rods {
                prop_assert!(rod.rest > 0.2 * pitch && rod.rest < 2.5 * pitch);
            }
        }
    }
}
