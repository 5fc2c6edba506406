//! Rays against triangles, by a bounding volume tree.

use crate::{math::Vec3, output::shell::Shell};
use parry3d::{
    bounding_volume::Aabb,
    partitioning::{Bvh, BvhBuildStrategy, BvhNode},
};

/// A half line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    /// Where it begins [cm].
    pub(super) origin: Vec3,
    /// Its direction, of length 1.
    pub(super) direction: Vec3,
    /// One over each component of the direction.
    inverse: Vec3,
}

impl Ray {
    /// A ray from a point in a direction of length 1.
    pub(super) fn new(origin: Vec3, direction: Vec3) -> Self {
        // Dividing by 0 would give 0 · ∞ on the face of a box.
        let safe = |x: f64| {
            if x.abs() < 1e-12 {
                1e-12_f64.copysign(x)
            } else {
                x
            }
        };
        Self {
            origin,
            direction,
            inverse: direction.map(|x| 1.0 / safe(x)),
        }
    }

    /// The point at a distance [cm].
    pub(super) fn at(&self, distance: f64) -> Vec3 {
        self.origin + self.direction * distance
    }

    /// Distance at which the ray enters a box, 0 inside it; `f64::MAX` if it misses.
    fn enters(&self, node: &BvhNode) -> f64 {
        let (low, high) = (node.mins(), node.maxs());
        let mut near = 0.0_f64;
        let mut far = f64::MAX;
        for (low, high, from, inverse) in [
            (low.x, high.x, self.origin.x, self.inverse.x),
            (low.y, high.y, self.origin.y, self.inverse.y),
            (low.z, high.z, self.origin.z, self.inverse.z),
        ] {
            let (a, b) = ((low - from) * inverse, (high - from) * inverse);
            near = near.max(a.min(b));
            far = far.min(a.max(b));
        }
        if near <= far { near } else { f64::MAX }
    }
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hit {
    /// Distance along the ray [cm].
    pub(super) distance: f64,
    /// Vertices of the triangle.
    pub(super) corners: [u32; 3],
    /// Weight of each vertex there.
    pub(super) weights: [f64; 3],
    /// Normal of the triangle, of length 1.
    pub(super) normal: Vec3,
}

/// A shell that rays can be cast at.
#[derive(Debug)]
pub(super) struct Surface {
    shell: Shell,
    triangles: Vec<Triangle>,
    tree: Bvh,
}

/// How far beyond its sides a triangle still stops a ray, in sides, so that rounding opens no gap
/// between neighbours.
const EDGE: f64 = 1e-9;

/// A corner and the two sides from it [cm].
#[derive(Clone, Copy, Debug)]
struct Triangle {
    corner: Vec3,
    sides: [Vec3; 2],
}

impl Surface {
    /// Builds the tree over a shell's triangles.
    pub(super) fn new(shell: Shell) -> Self {
        let points = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| shell.vertices.get(corner as usize).copied());
            let (a, b, c) = (
                a.unwrap_or_default(),
                b.unwrap_or_default(),
                c.unwrap_or_default(),
            );
            Triangle {
                corner: a,
                sides: [b - a, c - a],
            }
        };
        let triangles: Vec<Triangle> = shell.triangles.iter().map(points).collect();
        let boxes: Vec<Aabb> = triangles.iter().map(Triangle::bounds).collect();
        let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
        Self {
            shell,
            triangles,
            tree,
        }
    }

    /// The shell.
    pub(super) fn shell(&self) -> &Shell {
        &self.shell
    }

    /// The nearest point that a ray meets within a distance [cm].
    pub(super) fn hit(&self, ray: &Ray, within: f64) -> Option<Hit> {
        let meet = |leaf: u32, _: f64| {
            let met = self.triangles.get(leaf as usize)?.meet(ray)?;
            Some((met[0], met))
        };
        let enters = |node: &BvhNode, _: f64| ray.enters(node);
        let (leaf, (distance, [_, v, w])) = self.tree.find_best(within, enters, meet)?;
        let corners = *self.shell.triangles.get(leaf as usize)?;
        let [ahead, back] = self.triangles.get(leaf as usize)?.sides;
        let normal = ahead.cross(&back).try_normalize(0.0)?;
        Some(Hit {
            distance,
            corners,
            weights: [1.0 - v - w, v, w],
            normal,
        })
    }

    /// Whether a ray meets anything within a distance [cm].
    pub(super) fn blocks(&self, ray: &Ray, within: f64) -> bool {
        // Any hit counts as the nearest there could be, which ends the search.
        let meet = |leaf: u32, _: f64| {
            let met = self.triangles.get(leaf as usize)?.meet(ray)?;
            (met[0] < within).then_some(0.0)
        };
        let enters = |node: &BvhNode, _: f64| ray.enters(node);
        self.tree.find_best(within, enters, meet).is_some()
    }

    /// A vertex quantity between the corners of a hit.
    pub(super) fn normal(&self, hit: &Hit) -> Vec3 {
        let normals = hit
            .corners
            .iter()
            .zip(hit.weights)
            .filter_map(|(corner, weight)| {
                Some(*self.shell.normals.get(*corner as usize)? * weight)
            });
        normals
            .sum::<Vec3>()
            .try_normalize(1e-9)
            .unwrap_or(hit.normal)
    }
}

impl Triangle {
    fn bounds(&self) -> Aabb {
        let others = self.sides.map(|side| self.corner + side);
        let low = self.corner.inf(&others[0]).inf(&others[1]);
        let high = self.corner.sup(&others[0]).sup(&others[1]);
        Aabb::new(low.into(), high.into())
    }

    /// Distance along the ray and the weights of the second and third corner, where they meet
    /// (Möller and Trumbore 1997): the three unknowns of `origin + t·direction = corner + v·side₀ +
    /// w·side₁` by Cramer's rule.
    fn meet(&self, ray: &Ray) -> Option<[f64; 3]> {
        let [first, second] = self.sides;
        let across = ray.direction.cross(&second);
        let volume = first.dot(&across);
        if volume == 0.0 {
            return None;
        }
        let from = ray.origin - self.corner;
        let v = from.dot(&across) / volume;
        let turned = from.cross(&first);
        let w = ray.direction.dot(&turned) / volume;
        let distance = second.dot(&turned) / volume;
        (v >= -EDGE && w >= -EDGE && v + w <= 1.0 + EDGE && distance > 0.0)
            .then_some([distance, v, w])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample;

    #[test]
    fn rays_meet_a_ball_where_geometry_says() {
        let centre = Vec3::new(1.0, -2.0, 3.0);
        let ball = Surface::new(Shell::of_body(&sample::ball(centre, 5.0, 64)));
        for k in 0..200 {
            let k = f64::from(k);
            let away = Vec3::new(libm::sin(k), libm::cos(1.7 * k), libm::sin(2.3 * k)).normalize();
            let aside = away.cross(&Vec3::new(0.3, -0.2, 0.9)).normalize() * (0.03 * k);
            let ray = Ray::new(centre + 20.0 * away + aside, -away);
            let expected = 25.0 - aside.norm_squared();
            match ball.hit(&ray, f64::MAX) {
                Some(hit) => {
                    let distance = 20.0 - libm::sqrt(expected);
                    assert!((hit.distance - distance).abs() < 0.05, "{k}: {hit:?}");
                    let normal = ball.normal(&hit);
                    assert!((normal - (ray.at(hit.distance) - centre) / 5.0).norm() < 0.02);
                    assert!(ball.blocks(&ray, 20.1) && !ball.blocks(&ray, 14.9));
                }
                None => assert!(expected < 0.1, "{k}"),
            }
        }
    }

    #[test]
    fn a_ray_between_two_faces_is_not_lost() {
        let vertices = vec![Vec3::zeros(), Vec3::x(), Vec3::x() + Vec3::y(), Vec3::y()];
        let normals = vec![Vec3::z(); 4];
        let triangles = vec![[0, 1, 2], [0, 2, 3]];
        let floor = Surface::new(Shell {
            vertices,
            normals,
            triangles,
        });
        let ray = Ray::new(Vec3::new(0.5, 0.5, 1.0), -Vec3::z());
        assert_eq!(floor.hit(&ray, 9.0).map(|hit| hit.distance), Some(1.0));
        assert!(floor.hit(&ray, 0.5).is_none());
    }

    #[test]
    fn nothing_is_met_where_nothing_is() {
        let nothing = Surface::new(Shell::default());
        let ray = Ray::new(Vec3::zeros(), Vec3::x());
        assert!(nothing.hit(&ray, f64::MAX).is_none() && !nothing.blocks(&ray, f64::MAX));
    }
}
