//! The best that bodies can do for a node: a reaction inside the Coulomb cones of what it touches.
//!
//! All reactions together are the convex cone that the rays of all Coulomb cones span, and the
//! best is the point of it nearest to the force asked for. It is found by generating rays:
//!
//! 1. Of all rays, take the one that what is left pulls along most.
//! 2. With the at most three rays kept so far, find the nearest point; keep those it stands on.
//! 3. When no ray is pulled along any more, no reaction is better.

use crate::math::{Mat3, Vec3};

/// Rays generated at most; some ten are usual.
const MOST_RAYS: usize = 100;
/// What is left of a force below this part of it is rounding.
const ROUNDING: f64 = 1e-13;
/// How often the pushes along some rays are solved for: once, and twice for what rounding left.
const SOLVED: usize = 3;

/// The net force [gf] that is left of `net` after the best reaction in the cones about `normals`.
pub(super) fn left_over(net: &Vec3, normals: &[Vec3], friction: f64) -> Vec3 {
    let mut rays: Vec<Vec3> = Vec::new();
    let mut left = *net;
    for _ in 0..MOST_RAYS {
        let asked = -left;
        let best = normals
            .iter()
            .map(|normal| ray_along(&asked, normal, friction))
            .max_by(|a, b| a.dot(&asked).total_cmp(&b.dot(&asked)));
        let Some(ray) = best.filter(|ray| ray.dot(&asked) > ROUNDING * net.norm()) else {
            break;
        };
        rays.push(ray);
        let (next, kept) = nearest(net, &rays);
        if next.norm() >= left.norm() {
            break;
        }
        (left, rays) = (next, kept);
    }
    left
}

/// The direction in a cone that a force pulls along most, of length 1.
fn ray_along(force: &Vec3, normal: &Vec3, friction: f64) -> Vec3 {
    let push = force.dot(normal);
    let tangential = force - normal * push;
    let slide = tangential.norm();
    if slide <= friction * push {
        return force.normalize();
    }
    let slope = tangential * (friction / slide.max(f64::MIN_POSITIVE));
    (normal + slope).normalize()
}

/// What is left of `net` after the best sum of pushes along at most four rays, and the rays (three
/// at most) that push.
fn nearest(net: &Vec3, rays: &[Vec3]) -> (Vec3, Vec<Vec3>) {
    let mut best = (*net, Vec::new());
    for chosen in 1_u32..1 << rays.len() {
        let chosen: Vec<Vec3> = rays
            .iter()
            .enumerate()
            .filter(|(k, _)| chosen >> k & 1 == 1)
            .map(|(_, ray)| *ray)
            .collect();
        let Some(left) = left_of(net, &chosen) else {
            continue;
        };
        if left.norm() < best.0.norm() {
            best = (left, chosen);
        }
    }
    best
}

/// What is left of `net` when up to three rays push as well as they can; `None` where one of them
/// would pull.
fn left_of(net: &Vec3, rays: &[Vec3]) -> Option<Vec3> {
    if rays.len() > 3 {
        return None;
    }
    // Gram's matrix of the rays; those that are not there are orthogonal to all.
    let mut gram = Mat3::identity();
    for (j, ray) in rays.iter().enumerate() {
        for (k, other) in rays.iter().enumerate() {
            gram[(j, k)] = ray.dot(other);
        }
    }
    let gram = gram.lu();
    let mut pushes = Vec3::zeros();
    let mut left = *net;
    // What rounding leaves along rays that almost oppose or follow each other is pushed away anew.
    for _ in 0..SOLVED {
        let mut asked = Vec3::zeros();
        for (asked, ray) in asked.iter_mut().zip(rays) {
            *asked = -left.dot(ray);
        }
        pushes += gram.solve(&asked)?;
        let pushed: Vec3 = rays
            .iter()
            .zip(&pushes)
            .map(|(ray, push)| ray * *push)
            .sum();
        left = net + pushed;
    }
    let pushing = pushes.iter().take(rays.len()).all(|push| *push >= 0.0);
    pushing.then_some(left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FRICTION: f64 = 0.4;
    /// Rays that stand for a cone in the brute force.
    const AROUND: usize = 40;

    /// Rays on the cones' surfaces.
    fn rays(normals: &[Vec3]) -> Vec<Vec3> {
        let around = |normal: &Vec3| {
            let u = normal.cross(&normal.yzx()).normalize();
            let v = normal.cross(&u);
            let normal = *normal;
            (0..AROUND).map(move |k| {
                let angle = core::f64::consts::TAU * k as f64 / AROUND as f64;
                normal + (u * angle.cos() + v * angle.sin()) * FRICTION
            })
        };
        normals.iter().flat_map(around).collect()
    }

    /// The nearest point in the span of every choice of one, two or three rays.
    fn brute_force(net: &Vec3, normals: &[Vec3]) -> f64 {
        let rays = rays(normals);
        let mut least = net.norm();
        let mut try_with = |chosen: &[Vec3]| {
            if let Some(left) = left_of(net, chosen) {
                least = least.min(left.norm());
            }
        };
        for (i, a) in rays.iter().enumerate() {
            try_with(&[*a]);
            for (j, b) in rays[..i].iter().enumerate() {
                try_with(&[*a, *b]);
                for c in &rays[..j] {
                    try_with(&[*a, *b, *c]);
                }
            }
        }
        least
    }

    fn direction() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-1.0..1.0f64)
            .prop_map(Vec3::from)
            .prop_filter("long enough", |v| v.norm() > 0.2)
            .prop_map(|v| v.normalize())
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 16, ..ProptestConfig::default() })]

        #[test]
        fn no_reaction_is_better_by_brute_force(
            net in direction(), normals in prop::collection::vec(direction(), 1..3),
        ) {
            // Where two cones almost hold a line between them, so few rays are too coarse a measure.
            prop_assume!(normals.len() < 2 || normals[0].dot(&normals[1]) > -0.6);
            let left = left_over(&net, &normals, FRICTION).norm();
            let brute = brute_force(&net, &normals);
            // Rays on the surface are a little less than the cones.
            prop_assert!(left <= brute + 1e-9, "{left}, {brute}");
            prop_assert!(left >= brute - 3e-3, "{left}, {brute}");
        }
    }

    proptest! {
        /// The nearest point of a convex cone: at right angles to what is left, and nothing in the
        /// cone lies towards it.
        #[test]
        fn what_is_left_pulls_away_from_every_cone(
            net in direction(), normals in prop::collection::vec(direction(), 1..40),
        ) {
            let left = left_over(&net, &normals, FRICTION);
            prop_assert!(left.dot(&(net - left)).abs() <= 1e-9);
            for ray in rays(&normals) {
                prop_assert!(-left.dot(&ray) <= 1e-9, "{left:?} {ray:?}");
            }
        }

        #[test]
        fn a_force_inside_one_of_many_cones_leaves_nothing(
            normals in prop::collection::vec(direction(), 1..40), slope in 0.0..0.9f64,
        ) {
            // Cones about nearly the same normal, as the samples of a cell have on a round body.
            let close: Vec<Vec3> = normals.iter().map(|n| (n * 0.05 + Vec3::z()).normalize()).collect();
            let across = close[0].cross(&Vec3::x()).normalize();
            let net = -(close[0] + across * (slope * FRICTION));
            prop_assert!(left_over(&net, &close, FRICTION).norm() <= 1e-12);
        }
    }

    #[test]
    fn cones_that_almost_oppose_each_other_leave_what_is_at_right_angles_to_them() {
        let normals = [
            Vec3::new(
                0.821_158_811_844_251_1,
                -0.508_319_193_334_434,
                0.259_441_329_433_781_8,
            ),
            Vec3::new(
                -0.985_780_917_426_282_4,
                -0.098_286_471_238_091_35,
                0.136_292_892_000_136_36,
            ),
        ];
        let left = left_over(&Vec3::z(), &normals, FRICTION);
        let along = left.dot(&(Vec3::z() - left));
        assert!(along.abs() <= 1e-12, "{along}");
        for ray in rays(&normals) {
            assert!(-left.dot(&ray) <= 1e-9, "{ray:?}");
        }
    }

    #[test]
    fn one_cone_leaves_what_leans_out_of_it() {
        let net = Vec3::new(0.6, 0.0, -1.0);
        let left = left_over(&net, &[Vec3::z()], 0.5);
        // The boundary ray (−0.5, 0, 1)/√1.25 takes net·ray, the rest is at right angles to it.
        let ray = Vec3::new(-0.5, 0.0, 1.0) / 1.25_f64.sqrt();
        assert!((left - (net - ray * net.dot(&ray))).norm() < 1e-12);
        assert_eq!(left_over(&Vec3::z(), &[Vec3::z()], 0.5), Vec3::z());
        assert_eq!(left_over(&Vec3::z(), &[], 0.5), Vec3::z());
    }
}
