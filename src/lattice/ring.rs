//! A closed line of straight edges on the plane, and the questions that cutting asks of it.

use crate::math::Vec2;

/// Corners of a closed line [cm]; the last is joined to the first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Ring {
    pub(super) points: Vec<Vec2>,
}

/// The component of `a × b` out of the plane.
pub(super) fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The point of the segment `a`–`b` nearest to `point`.
pub(super) fn nearest_on_segment(point: Vec2, a: Vec2, b: Vec2) -> Vec2 {
    let along = b - a;
    let length = along.norm_squared();
    if length == 0.0 {
        return a;
    }
    a + along * ((point - a).dot(&along) / length).clamp(0.0, 1.0)
}

impl Ring {
    /// Edges in order, each with its ends.
    pub(super) fn edges(&self) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(a, b)| (*a, *b))
    }

    /// Area, positive where the ring runs counter-clockwise [cm²].
    pub(super) fn signed_area(&self) -> f64 {
        let Some(first) = self.points.first() else {
            return 0.0;
        };
        let twice: f64 = self.edges().map(|(a, b)| cross(a - first, b - first)).sum();
        0.5 * twice
    }

    /// Length of all edges [cm].
    pub(super) fn length(&self) -> f64 {
        self.edges().map(|(a, b)| (b - a).norm()).sum()
    }

    /// Whether a ray from the point crosses the ring an odd number of times.
    pub(super) fn surrounds(&self, point: Vec2) -> bool {
        let mut inside = false;
        self.row_crossings(point.y, |x| inside ^= x > point.x);
        inside
    }

    /// Hands on where the line at height `y` crosses the ring, in the order of the edges [cm].
    /// An edge owns its lower end and not its upper, so that the crossings are even in number.
    pub(super) fn row_crossings(&self, y: f64, mut crossing: impl FnMut(f64)) {
        for (a, b) in self.edges() {
            if (a.y <= y) != (b.y <= y) {
                crossing(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
            }
        }
    }

    /// The point of the ring nearest to `point`.
    pub(super) fn nearest(&self, point: Vec2) -> Option<Vec2> {
        let mut best: Option<(f64, Vec2)> = None;
        for (a, b) in self.edges() {
            let candidate = nearest_on_segment(point, a, b);
            let distance = (candidate - point).norm_squared();
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, candidate));
            }
        }
        best.map(|(_, nearest)| nearest)
    }

    /// Drops points that repeat the one before, the first after the last included.
    pub(super) fn without_repeats(mut points: Vec<Vec2>) -> Self {
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        Self { points }
    }
}

/// The first two edges that meet, of one ring or of two, by their numbers from 0.
/// Neighbours in a ring meet when they fold back on each other.
pub(super) fn first_meeting(one: &Ring, other: Option<&Ring>) -> Option<(usize, usize)> {
    let mut edges = numbered(one, 0);
    edges.extend(other.map(|ring| numbered(ring, 1)).unwrap_or_default());
    // Sorted by their left ends, an edge need only be held against those that begin before it ends.
    edges.sort_by(|e, f| e.left().total_cmp(&f.left()));
    for (at, edge) in edges.iter().enumerate() {
        let right = edge.from.x.max(edge.to.x);
        let rest = edges.iter().skip(at + 1);
        for next in rest.take_while(|next| next.left() <= right) {
            if (other.is_none() || edge.ring != next.ring) && edge.meets(next) {
                let swap = (next.ring, next.number) < (edge.ring, edge.number);
                let (a, b) = if swap { (next, edge) } else { (edge, next) };
                return Some((a.number, b.number));
            }
        }
    }
    None
}

struct Edge {
    ring: usize,
    number: usize,
    /// The number of the edge that begins where this one stops.
    next: usize,
    from: Vec2,
    to: Vec2,
}

fn numbered(ring: &Ring, which: usize) -> Vec<Edge> {
    let count = ring.points.len().max(1);
    let number = |(k, (from, to))| Edge {
        ring: which,
        number: k,
        next: (k + 1) % count,
        from,
        to,
    };
    ring.edges().enumerate().map(number).collect()
}

impl Edge {
    fn left(&self) -> f64 {
        self.from.x.min(self.to.x)
    }

    /// Whether the two have a point in common, other than the corner that joins neighbours.
    fn meets(&self, other: &Self) -> bool {
        if self.ring == other.ring && self.next == other.number {
            return folds_back(self.from, self.to, other.to);
        }
        if self.ring == other.ring && other.next == self.number {
            return folds_back(other.from, self.from, self.to);
        }
        let ((a, b), (c, d)) = ((self.from, self.to), (other.from, other.to));
        let sides = |p: Vec2, q: Vec2, r: Vec2| cross(q - p, r - p);
        let (ac, ad) = (sides(a, b, c), sides(a, b, d));
        if ac == 0.0 && ad == 0.0 {
            return overlap(a.x, b.x, c.x, d.x) && overlap(a.y, b.y, c.y, d.y);
        }
        ac * ad <= 0.0 && sides(c, d, a) * sides(c, d, b) <= 0.0
    }
}

fn folds_back(from: Vec2, joint: Vec2, to: Vec2) -> bool {
    let (back, on) = (from - joint, to - joint);
    cross(back, on) == 0.0 && back.dot(&on) > 0.0
}

fn overlap(a: f64, b: f64, c: f64, d: f64) -> bool {
    a.min(b) <= c.max(d) && c.min(d) <= a.max(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[[f64; 2]]) -> Ring {
        Ring {
            points: points.iter().map(|p| Vec2::new(p[0], p[1])).collect(),
        }
    }

    #[test]
    fn a_triangle_has_half_base_times_height() {
        let triangle = ring(&[[1.0, 1.0], [5.0, 1.0], [2.0, 4.0]]);
        assert_eq!(triangle.signed_area(), 6.0);
        assert!(triangle.surrounds(Vec2::new(2.0, 2.0)));
        assert!(!triangle.surrounds(Vec2::new(4.0, 3.0)));
        let nearest = triangle.nearest(Vec2::new(3.0, -2.0)).unwrap();
        assert_eq!(nearest, Vec2::new(3.0, 1.0));
    }

    #[test]
    fn edges_that_cross_touch_or_fold_back_are_named() {
        let bow = ring(&[[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
        assert_eq!(first_meeting(&bow, None), Some((0, 2)));
        let touching = ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]]);
        assert!(first_meeting(&touching, None).is_some());
        let spike = ring(&[[0.0, 0.0], [4.0, 0.0], [6.0, 0.0], [4.0, 0.0], [2.0, 3.0]]);
        assert!(first_meeting(&spike, None).is_some());
        let pinched = ring(&[
            [0.0, 0.0],
            [2.0, 2.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [2.0, 2.0],
            [0.0, 4.0],
        ]);
        assert!(first_meeting(&pinched, None).is_some());
        let square = ring(&[[0.0, 0.0], [2.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        assert_eq!(first_meeting(&square, None), None);
        let beside = ring(&[[5.0, 0.0], [6.0, 0.0], [6.0, 1.0]]);
        assert_eq!(first_meeting(&square, Some(&beside)), None);
        let across = ring(&[[3.0, 1.0], [6.0, 1.0], [6.0, 2.0]]);
        assert!(first_meeting(&square, Some(&across)).is_some());
    }
}
