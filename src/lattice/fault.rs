//! What is wrong with an outline.

use crate::{
    lattice::ring::{Ring, cross, first_meeting},
    math::Vec2,
};

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

/// A size that is finite and above 0 [cm].
pub(super) fn size(what: &'static str, value: f64) -> Result<f64, OutlineError> {
    if !value.is_finite() {
        let what = what.to_owned();
        return Err(OutlineError::NotFinite { what, value });
    }
    if value <= 0.0 {
        return Err(OutlineError::Size { what, value });
    }
    Ok(value)
}

/// The ring of points that enclose an area and do not meet themselves; `name` is for errors.
pub(super) fn checked_ring(name: &str, points: Vec<Vec2>) -> Result<Ring, OutlineError> {
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

/// That the rings after the first lie in it, apart from each other.
pub(super) fn check_holes(rings: &[Ring]) -> Result<(), OutlineError> {
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
    use crate::lattice::{
        Outline,
        sample::{points, square},
    };

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
