//! Every law against its own definition, over any shape of the cloth.
//!
//! A law is an energy; its force is minus the gradient and its stiffness minus the force's, by
//! central differences. Weight and laws move with the cloth (rigid motion), and do not know warp
//! from weft but by the fabric (exchange).

use crate::specimen::{
    crumpled, disc, fabric, flat, linear, shapes, slope, towel, twisting, weightless, whole_matrix,
};
use nalgebra::DMatrix;
use proptest::prelude::*;
use soen::{
    fabric::{Fabric, Yarn},
    forces::{Clamp, Laws, Sheet},
    lattice::{Lattice, Rod},
    math::{Vec2, Vec3},
};

/// Each law by itself, and all together.
const LAWS: [Laws; 4] = [
    laws(true, false, false),
    laws(false, true, false),
    laws(false, false, true),
    laws(true, true, true),
];

const fn laws(tension: bool, bending: bool, shear: bool) -> Laws {
    Laws {
        tension,
        bending,
        shear,
    }
}

/// A vice on the first node, sloping upward, and one at an edge of half width.
fn clamps(lattice: &Lattice) -> Vec<Clamp> {
    let slope = Vec3::new(0.8, 0.0, 0.6);
    let warp = lattice.rods.iter().filter(|rod| rod.yarn == Yarn::Warp);
    let clamp = |rod: &Rod| Clamp {
        nodes: rod.nodes,
        slope,
        yarn: rod.yarn,
        length: rod.rest,
        width: rod.width,
    };
    warp.take(5).map(clamp).collect()
}

proptest! {
    #![proptest_config(shapes(24))]

    #[test]
    fn force_is_minus_the_gradient_of_energy(at in crumpled(&towel(4.0, 3.0, 1.0), 0.2)) {
        let lattice = towel(4.0, 3.0, 1.0);
        for laws in LAWS {
            for cloth in [fabric("c"), twisting(&fabric("c")), linear(&fabric("d"))] {
                let sheet = Sheet::new(&lattice, &cloth, laws, &clamps(&lattice));
                check_gradient(&sheet, &at)?;
            }
        }
    }

    #[test]
    fn force_is_minus_the_gradient_beside_an_outline_too(at in crumpled(&disc(2.2, 1.0), 0.15)) {
        let lattice = disc(2.2, 1.0);
        let cloth = twisting(&fabric("a"));
        for laws in LAWS {
            check_gradient(&Sheet::new(&lattice, &cloth, laws, &[]), &at)?;
        }
    }

    #[test]
    fn stiffness_is_minus_the_gradient_of_force(at in crumpled(&towel(3.0, 2.0, 1.0), 0.2)) {
        let lattice = towel(3.0, 2.0, 1.0);
        for laws in LAWS {
            for cloth in [fabric("c"), twisting(&fabric("c")), linear(&fabric("d"))] {
                let sheet = Sheet::new(&lattice, &cloth, laws, &clamps(&lattice));
                let exact = stiffness(&sheet, &at, false);
                let measured = measured_stiffness(&sheet, &at);
                let error = (&exact - measured).amax();
                prop_assert!(error <= 1e-5 * exact.amax(), "{laws:?}: {error} of {}", exact.amax());
            }
        }
    }

    #[test]
    fn the_positive_stiffness_has_no_negative_direction(at in crumpled(&disc(2.2, 1.0), 0.25)) {
        let lattice = disc(2.2, 1.0);
        for laws in LAWS {
            let cloth = twisting(&fabric("b"));
            let whole = stiffness(&Sheet::new(&lattice, &cloth, laws, &clamps(&lattice)), &at, true);
            let (greatest, values) = (whole.amax(), whole.symmetric_eigenvalues());
            prop_assert!(values.min() >= -1e-10 * greatest, "{laws:?}: {}", values.min());
        }
    }

    #[test]
    fn a_rigid_motion_changes_nothing(
        at in crumpled(&towel(4.0, 3.0, 1.0), 0.3),
        axis in prop::array::uniform3(-3.0..3.0f64),
        shift in prop::array::uniform3(-50.0..50.0f64),
    ) {
        let lattice = towel(4.0, 3.0, 1.0);
        let turn = nalgebra::Rotation3::new(Vec3::from(axis));
        let moved: Vec<Vec3> = at.iter().map(|at| turn * at + Vec3::from(shift)).collect();
        let cloth = weightless(&twisting(&fabric("c")));
        for laws in LAWS {
            let sheet = Sheet::new(&lattice, &cloth, laws, &[]);
            let (energy, after) = (sheet.energy(&at), sheet.energy(&moved));
            prop_assert!((energy - after).abs() <= 1e-10 * energy, "{laws:?}: {energy}, {after}");
            let forces = sheet.forces(&at);
            let greatest = forces.iter().map(Vec3::norm).fold(0.0, f64::max);
            for (force, after) in forces.iter().zip(sheet.forces(&moved)) {
                prop_assert!((turn * force - after).norm() <= 1e-10 * greatest);
            }
            let sum: Vec3 = forces.iter().sum();
            let torque: Vec3 = at.iter().zip(&forces).map(|(at, force)| at.cross(force)).sum();
            prop_assert!(sum.norm() <= 1e-12 * greatest, "{laws:?}: {sum:?}");
            prop_assert!(torque.norm() <= 1e-11 * greatest, "{laws:?}: {torque:?}");
        }
    }

    #[test]
    fn warp_and_weft_may_be_exchanged(at in crumpled(&towel(4.0, 3.0, 1.0), 0.3)) {
        let (lattice, turned) = (towel(4.0, 3.0, 1.0), towel(3.0, 4.0, 1.0));
        let cloth = twisting(&fabric("b"));
        let exchanged = Fabric {
            warp: cloth.weft.clone(),
            weft: cloth.warp.clone(),
            ..cloth.clone()
        };
        let partner: Vec<usize> = lattice.grid.iter().map(|[i, j]| {
            turned.grid.iter().position(|grid| grid == &[*j, *i]).unwrap()
        }).collect();
        let mut mirrored = at.clone();
        for (node, other) in partner.iter().enumerate() {
            mirrored[*other] = at[node];
        }
        for laws in LAWS {
            let forces = Sheet::new(&lattice, &cloth, laws, &[]).forces(&at);
            let others = Sheet::new(&turned, &exchanged, laws, &[]).forces(&mirrored);
            let greatest = forces.iter().map(Vec3::norm).fold(0.0, f64::max);
            for (force, other) in forces.iter().zip(&partner) {
                prop_assert!((force - others[*other]).norm() <= 1e-12 * greatest, "{laws:?}");
            }
        }
    }

    #[test]
    fn a_nodes_own_sum_is_its_share_of_the_whole(at in crumpled(&disc(2.2, 1.0), 0.2)) {
        let lattice = disc(2.2, 1.0);
        let cloth = twisting(&fabric("d"));
        let clamps = clamps(&lattice);
        let sheet = Sheet::new(&lattice, &cloth, Laws::default(), &clamps);
        let whole = stiffness(&sheet, &at, true);
        let forces = sheet.forces(&at);
        // A vice's own node is held: no node's sum counts what the vice feels.
        let free = |node: &usize| clamps.iter().all(|clamp| clamp.nodes[0] as usize != *node);
        for node in (0..at.len()).filter(free) {
            let pull = sheet.pull(node, &at);
            let scale = 1e-12 * (1.0 + forces[node].norm());
            prop_assert!((forces[node] - sheet.force(node, &at, false)).norm() <= scale);
            prop_assert!((forces[node] - pull.force).norm() <= scale);
            let block = whole.fixed_view::<3, 3>(3 * node, 3 * node);
            prop_assert!((pull.stiffness - block).amax() <= 1e-12 * block.amax());
        }
    }
}

#[test]
fn a_flat_cloth_without_weight_is_at_rest() {
    for lattice in [towel(4.0, 3.0, 1.0), towel(5.0, 3.0, 0.7), disc(2.2, 1.0)] {
        let cloth = weightless(&linear(&twisting(&fabric("d"))));
        let sheet = Sheet::new(&lattice, &cloth, Laws::default(), &[]);
        let at = flat(&lattice);
        assert!(sheet.energy(&at) <= 1e-20, "{}", sheet.energy(&at));
        for force in sheet.forces(&at) {
            assert!(force.norm() <= 1e-10, "{force:?}");
        }
    }
}

#[test]
fn the_positive_stiffness_is_exact_at_rest() {
    for lattice in [towel(4.0, 3.0, 1.0), disc(2.2, 1.0)] {
        let cloth = linear(&twisting(&fabric("d")));
        let sheet = Sheet::new(&lattice, &cloth, Laws::default(), &[]);
        let at = flat(&lattice);
        let (exact, positive) = (stiffness(&sheet, &at, false), stiffness(&sheet, &at, true));
        let error = (&exact - positive).amax();
        assert!(error <= 1e-9 * exact.amax(), "{error} of {}", exact.amax());
    }
}

/// Trellis shear of a 10 cm picture frame, pulled at two opposite joints until the angle between
/// the yarns is φ = π/2 − γ: `F = a·M_SH·γ/sin(φ/2)` at any pitch (reference.json,
/// `e_shear_frame`), and no node inside the frame has anything to answer.
#[test]
fn a_picture_frame_pulls_alike_at_any_pitch() {
    // F/(a·M_SH) by γ [degrees].
    let unit = [
        (1.0, 0.0249009299904),
        (5.0, 0.129170703802),
        (10.0, 0.271525030304),
        (20.0, 0.608577738339),
        (30.0, core::f64::consts::FRAC_PI_3),
        (40.0, 1.65192033568),
        (60.0, 4.04606063971),
    ];
    // The mean of both directions' M_SH [gf/cm].
    for (name, shear) in [("a", 1.0), ("c", 12.0), ("d", 74.0)] {
        for pitch in [2.0, 1.0, 0.4] {
            let lattice = towel(10.0, 10.0, pitch);
            let cloth = weightless(&fabric(name));
            let sheet = Sheet::new(&lattice, &cloth, laws(false, true, true), &[]);
            for (degrees, unit) in unit {
                let gamma = f64::to_radians(degrees);
                let (force, inside) = frame_force(&lattice, &sheet, gamma);
                let expected = 10.0 * shear * unit;
                let error = (force / expected - 1.0).abs();
                assert!(
                    error <= 1e-9,
                    "{name} at {pitch}, {degrees}°: {force}, {expected}"
                );
                assert!(inside <= 1e-11 * expected, "{inside}");
            }
        }
    }
}

/// The pull on two opposite joints that holds a frame at a shear γ, by virtual work, and the
/// greatest force on a node inside it [gf].
fn frame_force(lattice: &Lattice, sheet: &Sheet<'_>, gamma: f64) -> (f64, f64) {
    let weft = Vec3::new(gamma.sin(), gamma.cos(), 0.0);
    let turning = Vec3::new(gamma.cos(), -gamma.sin(), 0.0);
    let coordinates = &lattice.coordinates;
    let at: Vec<Vec3> = coordinates
        .iter()
        .map(|c| Vec3::x() * c.x + weft * c.y)
        .collect();
    let forces = sheet.forces(&at);
    let work: f64 = coordinates
        .iter()
        .zip(&forces)
        .map(|(c, force)| -force.dot(&(turning * c.y)))
        .sum();
    let diagonal_grows = 10.0 * (0.5 * (core::f64::consts::FRAC_PI_2 - gamma)).sin();
    let is_inside = |c: &Vec2| c.x.abs() < 4.9 && c.y.abs() < 4.9;
    let inside = coordinates
        .iter()
        .zip(&forces)
        .filter(|(c, _)| is_inside(c));
    let inside = inside.map(|(_, force)| force.norm()).fold(0.0, f64::max);
    (work / diagonal_grows, inside)
}

fn check_gradient(sheet: &Sheet<'_>, at: &[Vec3]) -> Result<(), TestCaseError> {
    const STEP: f64 = 1e-5;
    let forces = sheet.forces(at);
    let greatest = forces.iter().map(Vec3::norm).fold(0.0, f64::max);
    let mut there = at.to_vec();
    for (node, force) in forces.iter().enumerate() {
        for axis in 0..3 {
            let slope = slope(&mut there, [node, axis], STEP, |at| sheet.energy(at));
            let error = (slope + force[axis]).abs();
            prop_assert!(
                error <= 1e-7 * greatest,
                "node {node}: {slope}, {}",
                force[axis]
            );
        }
    }
    Ok(())
}

fn stiffness(sheet: &Sheet<'_>, at: &[Vec3], positive: bool) -> DMatrix<f64> {
    whole_matrix(at.len(), |add| sheet.stiffness(at, positive, add))
}

fn measured_stiffness(sheet: &Sheet<'_>, at: &[Vec3]) -> DMatrix<f64> {
    const STEP: f64 = 1e-6;
    let mut there = at.to_vec();
    let mut whole = DMatrix::zeros(3 * at.len(), 3 * at.len());
    for column in 0..3 * at.len() {
        let (node, axis) = (column / 3, column % 3);
        let here = at[node][axis];
        there[node][axis] = here + STEP;
        let ahead = sheet.forces(&there);
        there[node][axis] = here - STEP;
        let behind = sheet.forces(&there);
        there[node][axis] = here;
        for (row, (ahead, behind)) in ahead.iter().zip(behind).enumerate() {
            let slope = (behind - ahead) / (2.0 * STEP);
            whole
                .fixed_view_mut::<3, 1>(3 * row, column)
                .copy_from(&slope);
        }
    }
    whole
}
