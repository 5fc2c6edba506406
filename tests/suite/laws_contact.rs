//! The laws of a touch against their own definitions, by themselves and gathered over a cloth.

use crate::specimen::{crumpled, disc, shapes, slope, whole_matrix};
use proptest::prelude::*;
use soen::{
    body::{Bodies, Part, Shape},
    contact::{Friction, Skin, Surface, Touches},
    lattice::Lattice,
    math::{Pose, Vec3},
};

proptest! {
    #![proptest_config(shapes(256))]

    #[test]
    fn a_skins_force_is_the_slope_of_its_energy(
        depth in -0.01..0.08f64, scale in 0.01..1.0f64,
    ) {
        let skin = Skin { scale, depth: 0.004 };
        let step = 1e-7;
        let (ahead, behind) = (skin.answer(depth + step), skin.answer(depth - step));
        let (_, force, slope) = skin.answer(depth);
        let energy_slope = (ahead.0 - behind.0) / (2.0 * step);
        prop_assert!((energy_slope - force).abs() <= 1e-6 * (scale + force));
        // The slope jumps where the skin begins, and only there.
        if depth.abs() > step {
            let force_slope = (ahead.1 - behind.1) / (2.0 * step);
            prop_assert!((force_slope - slope).abs() <= 1e-4 * (scale / 0.004 + slope));
        }
        prop_assert!(force >= 0.0, "a body pulls");
    }

    #[test]
    fn friction_is_minus_the_slope_of_its_energy(
        slip in prop::array::uniform2(-0.02..0.02f64), limit in 0.01..10.0f64,
    ) {
        let friction = Friction { limit, give: 0.004 };
        let (slip, normal) = (Vec3::new(slip[0], slip[1], 0.0), Vec3::z());
        let force = friction.force(&slip);
        let stiffness = friction.stiffness(&slip, &normal);
        prop_assert!(force.norm() <= limit * (1.0 + 1e-12), "outside its cone");
        prop_assert!(force.dot(&slip) <= 0.0, "friction pushes on");
        let step = 1e-7;
        for axis in 0..2 {
            let mut way = Vec3::zeros();
            way[axis] = step;
            let (ahead, behind) = (slip + way, slip - way);
            let slope = (friction.energy(&ahead) - friction.energy(&behind)) / (2.0 * step);
            prop_assert!((slope + force[axis]).abs() <= 1e-6 * limit);
            let slope = (friction.force(&behind) - friction.force(&ahead)) / (2.0 * step);
            if (slip.norm() - friction.give).abs() > 2.0 * step {
                let error = (slope - stiffness.column(axis)).amax();
                prop_assert!(error <= 1e-5 * limit / friction.give, "{error}");
            }
        }
    }
}

proptest! {
    #![proptest_config(shapes(24))]

    #[test]
    fn touches_push_by_minus_the_gradient_of_their_energy(
        at in crumpled(&disc(2.2, 1.0), 0.02), slip in prop::array::uniform3(-0.01..0.01f64),
    ) {
        let lattice = disc(2.2, 1.0);
        let (touches, at) = pressed(&lattice, &at, &Vec3::from(slip));
        prop_assert!(touches.list().len() > at.len(), "samples and nodes touch");
        let mut forces = vec![Vec3::zeros(); at.len()];
        touches.add_forces(&at, &mut forces);
        let greatest = forces.iter().map(Vec3::norm).fold(0.0, f64::max);
        let whole = whole_matrix(at.len(), |add| touches.stiffness(&at, add));
        let mut there = at.clone();
        for (node, sum) in forces.iter().enumerate() {
            for (axis, force) in sum.iter().enumerate() {
                let slope = slope(&mut there, [node, axis], 1e-7, |at| touches.energy(at));
                let error = (slope + force).abs();
                prop_assert!(error <= 1e-5 * greatest, "{error} of {greatest}");
            }
            let (force, stiffness) = touches.pull(node, &at);
            let error = (force - sum).norm();
            prop_assert!(error <= 1e-12 * greatest, "node {node}: {error} of {greatest}");
            let block = whole.fixed_view::<3, 3>(3 * node, 3 * node);
            let error = (stiffness - block).amax();
            prop_assert!(error <= 1e-12 * whole.amax(), "node {node}: {error}");
        }
    }

    #[test]
    fn touches_stiffen_by_minus_the_gradient_of_their_force(
        at in crumpled(&disc(2.2, 1.0), 0.02),
    ) {
        let lattice = disc(2.2, 1.0);
        // Sticking: a slip far below the give, so that the law is smooth all around.
        let (touches, at) = pressed(&lattice, &at, &Vec3::new(1e-4, 2e-4, 0.0));
        let whole = whole_matrix(at.len(), |add| touches.stiffness(&at, add));
        let mut there = at.clone();
        let step = 1e-8;
        for column in 0..3 * at.len() {
            let (node, axis) = (column / 3, column % 3);
            let here = at[node][axis];
            let mut forces_at = |x: f64| {
                there[node][axis] = x;
                let mut forces = vec![Vec3::zeros(); at.len()];
                touches.add_forces(&there, &mut forces);
                forces
            };
            let (ahead, behind) = (forces_at(here + step), forces_at(here - step));
            there[node][axis] = here;
            for (row, (ahead, behind)) in ahead.iter().zip(behind).enumerate() {
                let slope = (behind - ahead) / (2.0 * step);
                let block = whole.fixed_view::<3, 1>(3 * row, column);
                let error = (slope - block).amax();
                prop_assert!(error <= 1e-4 * whole.amax(), "{error} of {}", whole.amax());
            }
        }
    }
}

/// A disc laid into a ball's skin, friction loaded, then slipped.
fn pressed(lattice: &Lattice, at: &[Vec3], slip: &Vec3) -> (Touches, Vec<Vec3>) {
    let ball = Shape::Ball { radius: 10.0 };
    let ball = Part::new("ball".into(), &ball, Pose::identity()).unwrap();
    let surface = Surface {
        friction: 0.3,
        offset: 0.025,
        pressure: 0.14,
        node_skin: 0.004,
        sample_skin: 0.004,
        sample_distance: 0.25,
    };
    let on_ball = |at: &Vec3| {
        let height = 10.0 + at.z;
        Vec3::new(
            at.x,
            at.y,
            (height * height - at.x * at.x - at.y * at.y).sqrt(),
        )
    };
    let at: Vec<Vec3> = at.iter().map(on_ball).collect();
    let mut touches = Touches::new(lattice, surface);
    touches.refresh(&at, &Bodies::new(vec![ball]), |_| [0.1, 0.1]);
    touches.look_at_loads(&at);
    let at = at.iter().map(|at| at + slip).collect();
    (touches, at)
}
