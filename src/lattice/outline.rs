//! Where a piece of cloth ends: a rectangle, a disc, or a polygon with holes.

use crate::{
    lattice::ring::{Ring, cross, first_meeting},
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

/// An outline that no cloth can have. Edges, points and holes are counted from 1; edge n runs from
/// point n to the next.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// A number is infinite or not a number.
    #[error("{what} is {value}, expected a finite number [cm]")]
    NotFinite {
        /// Which number.
        what: String,
        /// Its value.
        value: f64,
    },
    /// A width, height or radius is zero or less.
    #[error("{what} is {value} cm, expected more than 0")]
    Size {
        /// Which size.
        what: &'static str,
        /// Its value [cm].
        value: f64,
    },
    /// A ring has fewer than three different points.
    #[error("{ring} has {count} different points, expected at least 3")]
    FewPoints {
        /// "the outline" or "hole n".
        ring: String,
        /// How many.
        count: usize,
    },
    /// All points of a ring lie on one line.
    #[error("{ring} has no area: all its points lie on one line")]
    ZeroArea {
        /// "the outline" or "hole n".
        ring: String,
    },
    /// Two edges of one ring meet.
    #[error("{ring} crosses itself: its edges {first} and {second} meet")]
    CrossesItself {
        /// "the outline" or "hole n".
        ring: String,
        /// The first edge.
        first: usize,
        /// The second edge.
        second: usize,
    },
    /// A hole meets the outline.
    #[error("hole {hole} crosses the outline: its edge {edge} meets the outline's edge {outer}")]
    HoleCrosses {
        /// Which hole.
        hole: usize,
        /// The hole's edge.
        edge: usize,
        /// The outline's edge.
        outer: usize,
    },
    /// A hole is not within the outline.
    #[error("hole {hole} lies outside the outline")]
    HoleOutside {
        /// Which hole.
        hole: usize,
    },
    /// Two holes share points.
    #[error("holes {first} and {second} overlap, expected cloth between them")]
    HolesOverlap {
        /// The first hole.
        first: usize,
        /// The second hole.
        second: usize,
    },
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

fn size(what: &'static str, value: f64) -> Result<f64, OutlineError> {
    if !value.is_finite() {
        let what = what.to_owned();
        return Err(OutlineError::NotFinite { what, value });
    }
    if value <= 0.0 {
        return Err(OutlineError::Size { what, value });
    }
    Ok(value)
}

fn checked_ring(name: &str, points: Vec<Vec2>) -> Result<Ring, OutlineError> {
    for (k, point) in points.iter().enumerate() {
        if let Some(value) = point.iter().find(|value| !value.is_finite()) {
            let (what, value) = (format!("point {} of {name}", k + 1), *value);
            return Err(OutlineError::NotFinite { what, value });
        }
    }
    let (ring, name) = (Ring::without_repeats(points), name.to_owned());
    if ring.points.len() < 3 {
        let (ring, count) = (name, ring.points.len());
        return Err(OutlineError::FewPoints { ring, count });
    }
    if on_one_line(&ring) {
        return Err(OutlineError::ZeroArea { ring: name });
    }
    match first_meeting(&ring, None) {
        None => Ok(ring),
        Some((a, b)) => Err(OutlineError::CrossesItself {
            ring: name,
            first: a + 1,
            second: b + 1,
        }),
    }
}

fn on_one_line(ring: &Ring) -> bool {
    let Some(first) = ring.points.first() else {
        return true;
    };
    let arms = || ring.points.iter().map(|point| point - first);
    let longest = arms().fold(Vec2::zeros(), |longest: Vec2, arm| {
        if arm.norm() > longest.norm() {
            arm
        } else {
            longest
        }
    });
    let length = longest.norm();
    arms().all(|arm| cross(longest, arm).abs() <= 1e-12 * length * length)
}

fn check_holes(rings: &[Ring]) -> Result<(), OutlineError> {
    let Some((outer, holes)) = rings.split_first() else {
        return Ok(());
    };
    for (k, hole) in holes.iter().enumerate() {
        if let Some((a, b)) = first_meeting(outer, Some(hole)) {
            let (hole, outer, edge) = (k + 1, a + 1, b + 1);
            return Err(OutlineError::HoleCrosses { hole, edge, outer });
        }
        if !lies_in(hole, outer) {
            return Err(OutlineError::HoleOutside { hole: k + 1 });
        }
        for (l, before) in holes.iter().take(k).enumerate() {
            let apart = first_meeting(before, Some(hole)).is_none();
            if !apart || lies_in(hole, before) || lies_in(before, hole) {
                let (first, second) = (l + 1, k + 1);
                return Err(OutlineError::HolesOverlap { first, second });
            }
        }
    }
    Ok(())
}

/// Whether a ring that does not meet another lies inside it.
fn lies_in(ring: &Ring, other: &Ring) -> bool {
    ring.points.first().is_some_and(|p| other.surrounds(*p))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[[f64; 2]]) -> Vec<Vec2> {
        list.iter().map(|p| Vec2::new(p[0], p[1])).collect()
    }

    fn square(low: f64, high: f64) -> Vec<Vec2> {
        points(&[[low, low], [high, low], [high, high], [low, high]])
    }

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

    #[test]
    fn every_fault_is_named_with_its_place() {
        let outer = || square(0.0, 10.0);
        let with = |holes: Vec<Vec<Vec2>>| Outline::polygon(outer(), holes);
        let alone = |list: &[[f64; 2]]| Outline::polygon(points(list), Vec::new());
        let cases = [
            (
                Outline::rectangle(0.0, 1.0),
                "width is 0 cm, expected more than 0",
            ),
            (
                Outline::rectangle(1.0, -2.0),
                "height is -2 cm, expected more than 0",
            ),
            (
                Outline::disc(f64::NAN),
                "radius is NaN, expected a finite number [cm]",
            ),
            (
                alone(&[[0.0, 0.0], [1.0, f64::INFINITY], [1.0, 1.0]]),
                "point 2 of the outline is inf, expected a finite number [cm]",
            ),
            (
                alone(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 0.0]]),
                "the outline has 2 different points, expected at least 3",
            ),
            (
                alone(&[[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]]),
                "the outline has no area: all its points lie on one line",
            ),
            (
                alone(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]),
                "the outline crosses itself: its edges 1 and 3 meet",
            ),
            (
                with(vec![square(8.0, 11.0)]),
                "hole 1 crosses the outline: its edge 4 meets the outline's edge 3",
            ),
            (
                with(vec![square(12.0, 13.0)]),
                "hole 1 lies outside the outline",
            ),
            (
                with(vec![square(-1.0, 11.0)]),
                "hole 1 lies outside the outline",
            ),
            (
                with(vec![square(1.0, 4.0), square(2.0, 3.0)]),
                "holes 1 and 2 overlap, expected cloth between them",
            ),
            (
                with(vec![square(1.0, 4.0), square(3.0, 6.0)]),
                "holes 1 and 2 overlap, expected cloth between them",
            ),
        ];
        for (case, message) in cases {
            assert_eq!(case.unwrap_err().to_string(), message);
        }
    }
}
