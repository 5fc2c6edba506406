//! Where a piece of cloth ends: a rectangle, a disc, or a polygon with holes.

use crate::{
    lattice::{
        fault::{OutlineError, check_holes, checked_ring, size},
        ring::{Ring, cross},
    },
    math::Vec2,
};

/// A checked outline, its bounding box centred on the origin.
///
/// ```
/// use soen::lattice::Outline;
/// let towel = Outline::rectangle(60.0, 40.0)?;
/// assert_eq!(towel.area(), 2400.0);
/// # Ok::<(), soen::lattice::OutlineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    shape: Shape,
    shift: Vec2,
}

#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// Its radius [cm].
    Disc(f64),
    /// The outer ring counter-clockwise, then the holes clockwise [cm].
    Rings(Vec<Ring>),
}

/// One of the four sides of an outline's bounding box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edge {
    /// Least x.
    XMin,
    /// Greatest x.
    XMax,
    /// Least y.
    YMin,
    /// Greatest y.
    YMax,
}

impl Outline {
    /// A rectangle with its sides along x and y [cm].
    ///
    /// # Errors
    /// [`OutlineError`] where a side is not finite or not above 0.
    pub fn rectangle(width: f64, height: f64) -> Result<Self, OutlineError> {
        let (x, y) = (0.5 * size("width", width)?, 0.5 * size("height", height)?);
        let points = vec![
            Vec2::new(-x, -y),
            Vec2::new(x, -y),
            Vec2::new(x, y),
            Vec2::new(-x, y),
        ];
        Ok(Self::from_rings(vec![Ring { points }]))
    }

    /// A disc [cm].
    ///
    /// # Errors
    /// [`OutlineError`] where the radius is not finite or not above 0.
    pub fn disc(radius: f64) -> Result<Self, OutlineError> {
        Ok(Self {
            shape: Shape::Disc(size("radius", radius)?),
            shift: Vec2::zeros(),
        })
    }

    /// A polygon, in either direction, with holes [cm]. A closing point equal to the first and
    /// points that repeat the one before are taken once. The whole is moved so that the centre of
    /// its bounding box is the origin; [`shift`](Self::shift) says by how much.
    ///
    /// # Errors
    /// [`OutlineError`], whatever the numbers.
    pub fn polygon(points: Vec<Vec2>, holes: Vec<Vec<Vec2>>) -> Result<Self, OutlineError> {
        let outer = checked_ring("the outline", points)?;
        let mut rings = vec![outer];
        for (k, hole) in holes.into_iter().enumerate() {
            rings.push(checked_ring(&format!("hole {}", k + 1), hole)?);
        }
        check_holes(&rings)?;
        for (k, ring) in rings.iter_mut().enumerate() {
            if (ring.signed_area() > 0.0) != (k == 0) {
                ring.points.reverse();
            }
        }
        let mut outline = Self::from_rings(rings);
        outline.centre();
        Ok(outline)
    }

    fn from_rings(rings: Vec<Ring>) -> Self {
        Self {
            shape: Shape::Rings(rings),
            shift: Vec2::zeros(),
        }
    }

    fn centre(&mut self) {
        let (low, high) = self.bounds();
        self.shift = -0.5 * (low + high);
        let shift = self.shift;
        for ring in self.rings_mut() {
            for point in &mut ring.points {
                *point += shift;
            }
        }
    }

    /// What was added to the points of a polygon to centre it [cm].
    #[must_use]
    pub fn shift(&self) -> Vec2 {
        self.shift
    }

    /// Area, holes taken off [cm²].
    #[must_use]
    pub fn area(&self) -> f64 {
        match &self.shape {
            Shape::Disc(radius) => std::f64::consts::PI * radius * radius,
            Shape::Rings(rings) => rings.iter().map(Ring::signed_area).sum(),
        }
    }

    /// Length of the boundary, holes included [cm].
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        match &self.shape {
            Shape::Disc(radius) => std::f64::consts::TAU * radius,
            Shape::Rings(rings) => rings.iter().map(Ring::length).sum(),
        }
    }

    /// Least and greatest x and y [cm].
    #[must_use]
    pub fn bounds(&self) -> (Vec2, Vec2) {
        match &self.shape {
            Shape::Disc(radius) => (Vec2::repeat(-radius), Vec2::repeat(*radius)),
            Shape::Rings(rings) => {
                let mut points = rings.iter().flat_map(|ring| ring.points.iter().copied());
                let first = points.next().unwrap_or_default();
                points.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)))
            }
        }
    }

    /// Whether a point lies on the cloth [cm]. A point of the boundary itself may fall either way.
    #[must_use]
    pub fn contains(&self, point: Vec2) -> bool {
        match &self.shape {
            Shape::Disc(radius) => point.norm() < *radius,
            Shape::Rings(rings) => rings.iter().filter(|r| r.surrounds(point)).count() % 2 == 1,
        }
    }

    /// The point of the boundary, holes included, nearest to a point [cm]. Of the centre of a
    /// disc, the one on the x axis.
    #[must_use]
    pub fn nearest(&self, point: Vec2) -> Vec2 {
        match &self.shape {
            Shape::Disc(radius) => {
                let direction = point.try_normalize(0.0).unwrap_or_else(Vec2::x);
                direction * *radius
            }
            Shape::Rings(rings) => {
                let each = rings.iter().filter_map(|ring| ring.nearest(point));
                let distance = |p: &Vec2| (p - point).norm_squared();
                each.min_by(|a, b| distance(a).total_cmp(&distance(b)))
                    .unwrap_or(point)
            }
        }
    }

    /// Where the line at height `y` crosses the boundary, from left to right [cm].
    pub(super) fn row_crossings(&self, y: f64) -> Vec<f64> {
        let mut crossings = Vec::new();
        match &self.shape {
            Shape::Disc(radius) => {
                let square = radius * radius - y * y;
                if square > 0.0 {
                    crossings.extend([-square.sqrt(), square.sqrt()]);
                }
            }
            Shape::Rings(rings) => {
                for ring in rings {
                    ring.row_crossings(y, |x| crossings.push(x));
                }
                crossings.sort_by(f64::total_cmp);
            }
        }
        crossings
    }

    /// Corners that turn by more than an angle, each with whether it is convex for the cloth, and
    /// in the order of the rings.
    pub(super) fn corners(&self, angle: f64) -> Vec<(Vec2, bool)> {
        let Shape::Rings(rings) = &self.shape else {
            return Vec::new();
        };
        let mut corners = Vec::new();
        for ring in rings {
            let following = ring.edges().skip(1).chain(ring.edges().take(1));
            for ((a, b), (_, c)) in ring.edges().zip(following) {
                let turn = libm::atan2(cross(b - a, c - b), (b - a).dot(&(c - b)));
                if turn.abs() > angle {
                    corners.push((b, turn > 0.0));
                }
            }
        }
        corners
    }

    /// The same outline with every point mapped by a turn about the origin.
    pub(super) fn mapped(&self, turn: impl Fn(Vec2) -> Vec2) -> Self {
        let mut outline = self.clone();
        for ring in outline.rings_mut() {
            for point in &mut ring.points {
                *point = turn(*point);
            }
        }
        outline
    }

    /// Width and height, if it is a rectangle with its sides along x and y to within 1e-9 of them
    /// [cm].
    pub(super) fn rectangle_size(&self) -> Option<Vec2> {
        let Shape::Rings(rings) = &self.shape else {
            return None;
        };
        let [Ring { points }] = rings.as_slice() else {
            return None;
        };
        let (_, half) = self.bounds();
        let at_corner = |p: &Vec2| (p.abs() - half).abs().max() <= 1e-9 * half.max();
        (points.len() == 4 && points.iter().all(at_corner)).then(|| 2.0 * half)
    }

    fn rings_mut(&mut self) -> &mut [Ring] {
        match &mut self.shape {
            Shape::Disc(_) => &mut [],
            Shape::Rings(rings) => rings,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::sample::{points, square};

    #[test]
    fn a_polygon_is_centred_and_its_holes_are_taken_off() {
        let mut closed = square(2.0, 12.0);
        closed.push(closed[0]);
        let mut clockwise = square(3.0, 5.0);
        clockwise.reverse();
        let frame = Outline::polygon(closed, vec![clockwise, square(6.0, 8.0)]).unwrap();
        assert_eq!(frame.area(), 92.0);
        assert_eq!(frame.perimeter(), 56.0);
        assert_eq!(frame.shift(), Vec2::new(-7.0, -7.0));
        assert_eq!(frame.bounds(), (Vec2::repeat(-5.0), Vec2::repeat(5.0)));
        assert!(frame.contains(Vec2::new(3.0, 3.0)));
        assert!(!frame.contains(Vec2::new(-3.0, -3.0)) && !frame.contains(Vec2::new(0.0, 6.0)));
        assert_eq!(frame.nearest(Vec2::new(-2.2, -3.0)), Vec2::new(-2.0, -3.0));
        assert_eq!(frame.nearest(Vec2::new(9.0, 1.0)), Vec2::new(5.0, 1.0));
    }

    #[test]
    fn row_crossings_agree_with_contains() {
        let leaf = points(&[
            [0.0, 0.0],
            [4.0, 1.0],
            [9.0, 0.0],
            [6.0, 5.0],
            [4.0, 2.0],
            [1.0, 6.0],
        ]);
        let hole = points(&[[1.0, 1.0], [2.0, 1.0], [1.5, 2.0]]);
        for outline in [Outline::disc(3.0), Outline::polygon(leaf, vec![hole])] {
            let outline = outline.unwrap();
            for k in 0..400 {
                let point = Vec2::new(
                    f64::from(k % 20) * 0.5117 - 5.0,
                    f64::from(k / 20) * 0.3713 - 3.7,
                );
                let left = outline.row_crossings(point.y);
                let left = left.iter().filter(|x| **x < point.x).count();
                assert_eq!(left % 2 == 1, outline.contains(point), "{point}");
            }
        }
    }

    #[test]
    fn a_disc_is_round() {
        let disc = Outline::disc(2.0).unwrap();
        assert_eq!(disc.nearest(Vec2::new(0.0, -0.1)), Vec2::new(0.0, -2.0));
        assert!(disc.contains(Vec2::new(1.4, 1.4)) && !disc.contains(Vec2::new(1.5, 1.5)));
    }
}
