//! Where a point stands to the bodies: nearest surfaces, and the way that is free.

use super::{Nature, Part};
use crate::math::Vec3;
use parry3d::{
    bounding_volume::Aabb,
    math::Vector,
    partitioning::{Bvh, BvhBuildStrategy},
    query::Ray,
};

/// A surface near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Which part.
    pub part: usize,
    /// Distance to its surface [cm]; negative inside a solid.
    pub distance: f64,
    /// Direction out of the surface at the nearest point, of length 1.
    pub normal: Vec3,
}

/// All parts of all bodies, with a tree over their boxes, so that the cost of a question depends
/// little on their number.
#[derive(Clone, Debug)]
pub struct Bodies {
    parts: Vec<Part>,
    boxes: Vec<Aabb>,
    tree: Bvh,
}

/// Nearer than this [cm], the direction to the surface is made of rounding errors.
const ON_THE_SURFACE: f64 = 1e-9;
/// A move may end this deep in a solid [cm]; its reaction then brings the point back.
const SHALLOW: f64 = 0.04;
/// How deep inside a solid [cm] a point is still brought back.
const DEEP: f64 = 3.0;
/// A move ends no nearer than this to a surface that it would pass through [cm]: cloth pressed on
/// again and again would else come so near that rounding carries it through.
const KEPT_OFF: f64 = 1e-6;
/// More surfaces than this are not between two points of a cell, but on a fold of the sheet.
const MOST_CROSSINGS: usize = 16;

impl Default for Bodies {
    fn default() -> Self {
        Self::new(Vec::new())
    }
}

impl Bodies {
    /// Gathers parts.
    #[must_use]
    pub fn new(parts: Vec<Part>) -> Self {
        let boxes: Vec<Aabb> = parts
            .iter()
            .map(|part| part.shape().compute_aabb(part.pose()))
            .collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self { parts, boxes, tree }
    }

    /// The parts, in the scene's order.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Where each part's box is: its least and greatest corner [cm].
    #[must_use]
    pub fn places(&self) -> Vec<(Vec3, Vec3)> {
        let corners = |part: &Aabb| (part.mins.into(), part.maxs.into());
        self.boxes.iter().map(corners).collect()
    }

    /// A part as it is here and as it is in other bodies; `None` where either has no such part.
    pub(crate) fn part_then_and_now<'a>(
        &'a self,
        part: usize,
        now: &'a Self,
    ) -> Option<(&'a Part, &'a Part)> {
        self.parts.get(part).zip(now.parts.get(part))
    }

    /// The bodies half way to where they are later, part by part: shapes as they are then, poses in
    /// the middle.
    #[must_use]
    pub fn half_way(&self, later: &Self) -> Self {
        let pairs = self.parts.iter().zip(&later.parts);
        Self::new(pairs.map(|(from, to)| to.half_way_from(from)).collect())
    }

    /// The box around all parts: its least and greatest corner [cm]; `None` without parts.
    #[must_use]
    pub fn extent(&self) -> Option<(Vec3, Vec3)> {
        let (first, rest) = self.boxes.split_first()?;
        let whole = rest.iter().fold(*first, |whole, part| {
            Aabb::new(whole.mins.min(part.mins), whole.maxs.max(part.maxs))
        });
        Some((whole.mins.into(), whole.maxs.into()))
    }

    /// Every surface within `reach` [cm] of a point, and every solid it is inside of, by part.
    #[must_use]
    pub fn near(&self, point: &Vec3, reach: f64) -> Vec<Near> {
        self.near_from(point, point, reach)
    }

    /// As [`near`](Self::near), for a point of a cloth that has another point at `from`: where a
    /// sheet stands between the two, the cloth has gone through it, and the point counts as inside.
    #[must_use]
    pub fn near_from(&self, from: &Vec3, point: &Vec3, reach: f64) -> Vec<Near> {
        self.within(from, point, reach, reach.max(DEEP))
    }

    /// As [`near_from`](Self::near_from), with surfaces sought no farther than `search` [cm].
    fn within(&self, from: &Vec3, point: &Vec3, reach: f64, search: f64) -> Vec<Near> {
        let (from, centre) = (Vector::from(*from), Vector::from(*point));
        let mut around = Aabb::new(centre - Vector::splat(reach), centre + Vector::splat(reach));
        around.take_point(from);
        let nearest = |index| {
            let part = &self.parts[index];
            let near = nearest(part, index, point, search)?;
            let near = seen_from(part, near, &from, &centre);
            (near.distance <= reach).then_some(near)
        };
        let mut found: Vec<Near> = self
            .in_box(&around)
            .into_iter()
            .filter_map(nearest)
            .collect();
        found.sort_by_key(|near| near.part);
        found
    }

    /// Depth of a point in the solids [cm]: positive inside, 0 outside.
    #[must_use]
    pub fn depth(&self, point: &Vec3) -> f64 {
        self.depth_from(point, point)
    }

    /// Depth of a point of a cloth that has another point at `from` [cm]: inside a solid, or
    /// beyond a sheet that stands between the two.
    #[must_use]
    pub fn depth_from(&self, from: &Vec3, point: &Vec3) -> f64 {
        let inside = self.within(from, point, 0.0, f64::MAX);
        let depths = inside.iter().map(|near| -near.distance);
        depths.fold(0.0, f64::max)
    }

    /// The fraction of a straight move that is free, 1 where all of it is: it ends 10⁻⁶ cm before the
    /// first surface that it would pass through.
    #[must_use]
    pub fn free_way(&self, from: &Vec3, to: &Vec3) -> f64 {
        let (start, end) = (Vector::from(*from), Vector::from(*to));
        let around = Aabb::new(start.min(end), start.max(end));
        let hit = |part: usize| self.hit(part, from, to);
        self.in_box(&around)
            .into_iter()
            .map(hit)
            .fold(1.0, f64::min)
    }

    /// How far a point can fall before it meets a surface [cm].
    #[must_use]
    pub fn fall(&self, from: &Vec3) -> Option<f64> {
        let (low, high) = self.extent()?;
        if from.x < low.x || from.x > high.x || from.y < low.y || from.y > high.y {
            return None;
        }
        let below = Vec3::new(from.x, from.y, low.z.min(from.z) - 1.0);
        let (start, end) = (Vector::from(*from), Vector::from(below));
        let around = Aabb::new(start.min(end), start.max(end));
        let ray = Ray::new(start, end - start);
        let cast = |part: usize| {
            let part = &self.parts[part];
            part.shape().cast_ray(part.pose(), &ray, 1.0, true)
        };
        let first = self
            .in_box(&around)
            .into_iter()
            .filter_map(cast)
            .reduce(f64::min)?;
        Some(first * (from.z - below.z))
    }

    /// Parts whose boxes meet a box, in rising order.
    fn in_box(&self, around: &Aabb) -> Vec<usize> {
        if self.parts.len() < 4 {
            let meets = |part: &usize| {
                let own = &self.boxes[*part];
                own.mins.cmple(around.maxs).all() && own.maxs.cmpge(around.mins).all()
            };
            return (0..self.parts.len()).filter(meets).collect();
        }
        let mut found: Vec<usize> = self
            .tree
            .intersect_aabb(around)
            .map(|leaf| leaf as usize)
            .collect();
        found.sort_unstable();
        found
    }

    /// The fraction of a move at which it passes into a part, 1 where it does not.
    fn hit(&self, part: usize, from: &Vec3, to: &Vec3) -> f64 {
        let (index, part) = (part, &self.parts[part]);
        let ray = Ray::new((*from).into(), (to - from).into());
        let Some(hit) = part
            .shape()
            .cast_ray_and_get_normal(part.pose(), &ray, 1.0, true)
        else {
            return 1.0;
        };
        let normal = Vec3::from(hit.normal);
        if part.nature() == Nature::Solid {
            // Started inside: its reaction will bring it out, through the surface.
            if holds(part, from) {
                return 1.0;
            }
            let shallow = |near: Near| near.distance > -SHALLOW && near.normal.dot(&normal) > 0.5;
            if nearest(part, index, to, DEEP).is_none_or(shallow) && holds(part, to) {
                return 1.0;
            }
        }
        let approach = normal.dot(&(to - from)).abs();
        (hit.time_of_impact - KEPT_OFF / approach).max(0.0)
    }
}

/// What is near a point, seen from another point of the cloth: beyond a sheet it is inside.
fn seen_from(part: &Part, near: Near, from: &Vector, point: &Vector) -> Near {
    let way = *point - *from;
    let length = way.length();
    // A surface between them is nearer to the point than they are to each other.
    if part.nature() == Nature::Solid || near.distance > length || length <= ON_THE_SURFACE {
        return near;
    }
    let mut passed = 0.0;
    let mut crossings = 0;
    while crossings < MOST_CROSSINGS {
        let ray = Ray::new(*from + way * passed, way);
        let Some(hit) = part.shape().cast_ray(part.pose(), &ray, 1.0 - passed, true) else {
            break;
        };
        passed += hit + ON_THE_SURFACE / length;
        crossings += 1;
    }
    if crossings % 2 == 0 {
        return near;
    }
    Near {
        distance: -near.distance,
        normal: -near.normal,
        ..near
    }
}

/// Whether a point is inside a solid.
fn holds(part: &Part, point: &Vec3) -> bool {
    part.shape().contains_point(part.pose(), (*point).into())
}

/// The nearest point of one part's surface, if it is no farther than `search` [cm].
fn nearest(part: &Part, index: usize, point: &Vec3, search: f64) -> Option<Near> {
    let (shape, pose) = (part.shape(), part.pose());
    if let Some(ball) = shape.as_ball() {
        // In closed form: parry's answer at the very centre is not a number.
        let out = *point - Vec3::from(pose.translation);
        let distance = out.norm() - ball.radius;
        let normal = out.try_normalize(ON_THE_SURFACE).unwrap_or_else(Vec3::z);
        return Some(Near {
            part: index,
            distance,
            normal,
        });
    }
    let found = shape.project_point_with_max_dist(pose, Vector::from(*point), false, search)?;
    let inside = part.nature() == Nature::Solid && found.is_inside;
    let away = *point - Vec3::from(found.point);
    let size = away.norm();
    let normal = if size > ON_THE_SURFACE {
        away * (if inside { -1.0 } else { 1.0 } / size)
    } else {
        let out = *point - part.centre();
        out.try_normalize(ON_THE_SURFACE).unwrap_or_else(Vec3::z)
    };
    Some(Near {
        part: index,
        distance: if inside { -size } else { size },
        normal,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        body::{Mesh, Shape},
        math::Pose,
    };

    /// Two squares of 2 cm across z, open, at heights 0 and −1 cm.
    fn sheets() -> Bodies {
        let square = |height| {
            let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
            let corners = corners.map(|[x, y]| Vec3::new(x, y, height)).to_vec();
            let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
            Part::new("square".into(), &Shape::Mesh(mesh), Pose::identity()).unwrap()
        };
        Bodies::new(vec![square(0.0), square(-1.0)])
    }

    #[test]
    fn bodies_half_way_have_gone_and_turned_by_half_and_halves_of_halves_by_a_quarter() {
        let about = |angle: f64| crate::math::turn(&(Vec3::new(1.0, 2.0, -2.0) * (angle / 3.0)));
        let box_at = |part: f64| {
            let place = Vec3::new(4.0, -2.0, 8.0) * part;
            let size = Vec3::new(1.0, 2.0, 3.0);
            let pose = Pose::from_parts(place.into(), about(0.3 + 2.0 * part));
            Bodies::new(vec![
                Part::new("box".into(), &Shape::Cuboid { size }, pose).unwrap(),
            ])
        };
        let (start, end) = (box_at(0.0), box_at(1.0));
        let half = start.half_way(&end);
        let quarter = start.half_way(&half);
        for (found, expected) in [(half, box_at(0.5)), (quarter, box_at(0.25))] {
            let corners = |bodies: &Bodies| bodies.parts()[0].triangles().0;
            for (a, b) in corners(&found).iter().zip(corners(&expected)) {
                assert!((a - b).norm() < 1e-12, "{a} {b}");
            }
            let boxes = found.places()[0].0 - expected.places()[0].0;
            assert!(boxes.norm() < 1e-12);
        }
    }

    #[test]
    fn a_point_pressed_on_a_sheet_again_and_again_stays_on_its_side() {
        let bodies = sheets();
        let mut at = Vec3::new(0.31, 0.17, 0.4);
        for _ in 0..100 {
            let to = at + Vec3::new(0.001, -0.002, -0.5);
            at += (to - at) * (0.9 * bodies.free_way(&at, &to));
        }
        assert!(at.z > 0.9e-6 && at.z < 2e-6, "{at:?}");
        assert_eq!(bodies.free_way(&at, &(at + Vec3::z())), 1.0);
    }

    #[test]
    fn beyond_a_sheet_is_inside_and_round_its_rim_is_not() {
        let bodies = sheets();
        let standing = |from: [f64; 3], point: [f64; 3]| {
            let nears = bodies.near_from(&from.into(), &point.into(), 0.5);
            let figures = |near: &Near| (near.part, near.distance, near.normal.z);
            nears.iter().map(figures).collect::<Vec<_>>()
        };
        let above = [0.2, 0.1, 0.4];
        assert_eq!(standing(above, [0.3, 0.0, 0.25]), [(0, 0.25, 1.0)]);
        assert_eq!(standing(above, [0.3, 0.0, -0.25]), [(0, -0.25, 1.0)]);
        // Seen from below, the same point is outside.
        assert_eq!(
            standing([0.3, 0.1, -0.4], [0.3, 0.0, -0.25]),
            [(0, 0.25, -1.0)]
        );
        // Over the diagonal that two faces share, and through both sheets.
        assert_eq!(
            standing([0.0, 0.0, 0.1], [0.0, 0.0, -0.1]),
            [(0, -0.1, 1.0)]
        );
        let through = standing([0.0, 0.0, 0.1], [0.0, 0.0, -1.25]);
        assert_eq!(through, [(0, -1.25, 1.0), (1, -0.25, 1.0)]);
        // Past the rim nothing stands between.
        let past = standing([1.4, 0.0, 0.2], [1.2, 0.0, -0.2]);
        assert!(past.len() == 1 && past[0].1 > 0.0, "{past:?}");
    }
}
