//! Nodes side by side against [`Sheet::pull`](crate::forces::Sheet::pull), node by node.

use super::*;
use crate::{
    fabric::{Curve, Tension},
    forces::{Laws, PLACES, Sheet, Stencil, Stencils},
    lanes::{OneByOne, WIDEST, WithSimd, widest},
    lattice::{Lattice, Outline, sample::cut},
    math::{Mat3, Vec3},
    scene::fabric,
};
use std::collections::BTreeMap;

/// The pulls on every node of a lattice, in its order.
struct Pulls<'a> {
    lattice: &'a Lattice,
    sheet: &'a Sheet<'a>,
    at: &'a [Vec3],
}

/// What is found for a node.
#[derive(Debug, PartialEq)]
struct Found {
    force: Vec3,
    block: Mat3,
    /// The force as it is found without the block.
    force_alone: Vec3,
    /// What its rods do where [`WAY`] ends, and what they would by their stiffness; and `WAY·block·WAY`.
    works: [f64; 3],
}

/// A move of the node [cm].
const WAY: [f64; 3] = [0.01, -0.02, 0.015];

impl WithSimd for Pulls<'_> {
    type Output = Vec<Found>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Self { lattice, sheet, at } = self;
        let numbered = (0_usize..).zip(&lattice.grid);
        let number: BTreeMap<_, _> = numbered.map(|(node, place)| (*place, node)).collect();
        let nodes: Vec<usize> = (0..at.len()).collect();
        let mut all = Vec::new();
        for nodes in nodes.chunks(Lanes::<S>::COUNT) {
            let own: Vec<Stencil> = nodes
                .iter()
                .map(|node| sheet.stencil(*node, &lattice.grid))
                .collect();
            let mut points = PLACES.map(|[i, j]| {
                let point = |node: &usize| {
                    let [a, b] = lattice.grid[*node];
                    number
                        .get(&[a + i, b + j])
                        .map_or(Vec3::zeros(), |n| at[*n])
                };
                Points([0, 1, 2].map(|axis| {
                    let mut numbers = [0.0; WIDEST];
                    for (slot, node) in numbers.iter_mut().zip(nodes) {
                        *slot = point(node)[axis];
                    }
                    Lanes::read(simd, &numbers)
                }))
            });
            let stencils = Stencils::mixed(own.iter());
            let (fabric, from) = (sheet.fabric(), stencils.from(0));
            let (force, block, rods) = pulls::<S, true>(simd, fabric, from, &points);
            let (force_alone, _, _) = pulls::<S, false>(simd, fabric, from, &points);
            let way = Points(WAY.map(|number| Lanes::of(simd, number)));
            points[0] += way;
            let works = [
                work_of_rods(simd, fabric, from, &points, way),
                rods.along(way),
                block.square_of(way),
            ];
            let read = |lanes: Lanes<S>| {
                let mut numbers = [0.0; WIDEST];
                lanes.write(&mut numbers);
                numbers
            };
            let (force, force_alone) = (force.0.map(read), force_alone.0.map(read));
            let (block, works) = (block.0.map(read), works.map(read));
            for k in 0..nodes.len() {
                let [xx, yy, zz, xy, xz, yz] = block.map(|numbers| numbers[k]);
                all.push(Found {
                    force: Vec3::from_fn(|axis, _| force[axis][k]),
                    block: Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
                    force_alone: Vec3::from_fn(|axis, _| force_alone[axis][k]),
                    works: works.map(|numbers| numbers[k]),
                });
            }
        }
        all
    }
}

/// A shape up to this part of a pitch away from flat, and not the same twice.
fn shaken(lattice: &Lattice, by: f64) -> Vec<Vec3> {
    let wave = |k: usize, axis: usize| libm::sin(1.0 + (7 * k + 3 * axis) as f64 * 1.7);
    let nodes = lattice.coordinates.iter().enumerate();
    nodes
        .map(|(k, at)| {
            let off = Vec3::from_fn(|axis, _| wave(k, axis));
            Vec3::new(at.x, at.y, 0.0) + off * (by * lattice.pitch)
        })
        .collect()
}

#[test]
fn nodes_side_by_side_bear_what_each_bears_alone() {
    let towel = || Outline::rectangle(9.0, 7.0).unwrap();
    let lattices = [
        cut(towel(), 0.0, 1.0),
        cut(towel(), 35.0, 0.7),
        cut(Outline::disc(4.6).unwrap(), 17.0, 0.8),
    ];
    let mut curved = fabric("d").unwrap();
    let curve = Curve::new(&[[0.0, 0.0], [0.01, 2.1], [0.05, 60.0]]).unwrap();
    curved.warp.tension = Tension::Points(curve);
    curved.weft.tension = Tension::Linear { modulus: 370.0 };
    let mut twisting = fabric("c").unwrap();
    twisting.twist = 0.07;
    let fabrics = [fabric("a").unwrap(), fabric("c").unwrap(), curved, twisting];
    for fabric in fabrics {
        for lattice in &lattices {
            // Each law alone, and all; from nearly flat to folded over.
            for (law, by) in (0..16).map(|k| (k / 4, [1e-4, 0.02, 0.4, 0.9][k % 4])) {
                let laws = Laws {
                    tension: law % 4 == 0 || law == 3,
                    bending: law == 1 || law == 3,
                    shear: law == 2 || law == 3,
                };
                let sheet = Sheet::new(lattice, &fabric, laws, &[]);
                let at = shaken(lattice, by);
                let pulls = |()| Pulls {
                    lattice,
                    sheet: &sheet,
                    at: &at,
                };
                let found = widest(pulls(()));
                assert_eq!(found, pulls(()).with_simd(OneByOne));
                for (node, found) in found.iter().enumerate() {
                    let Found { force, block, .. } = found;
                    let expected = sheet.pull(node, &at);
                    let error = (force - expected.force).norm();
                    let most = block.norm().max(expected.stiffness.norm()) * lattice.pitch;
                    assert!(
                        error <= 1e-8 * most,
                        "{laws:?} {by} {node}: {error} of {most}"
                    );
                    let error = (force - found.force_alone).norm();
                    assert!(error <= 1e-12 * most, "{laws:?} {by} {node}: {error}");
                    let least = block.symmetric_eigenvalues().min();
                    assert!(least >= -1e-9 * block.norm(), "{by} {node}: {least}");
                }
            }
        }
    }
}

#[test]
fn rods_alone_do_what_all_does_where_nothing_else_acts() {
    let lattice = cut(Outline::disc(4.6).unwrap(), 17.0, 0.8);
    let way = Vec3::from(WAY);
    let laws = Laws {
        tension: true,
        bending: false,
        shear: false,
    };
    for fabric in [fabric("a").unwrap(), fabric("c").unwrap()] {
        let sheet = Sheet::new(&lattice, &fabric, laws, &[]);
        let at = shaken(&lattice, 0.02);
        let found = widest(Pulls {
            lattice: &lattice,
            sheet: &sheet,
            at: &at,
        });
        for (node, found) in found.iter().enumerate() {
            let weighs = sheet.measures()[node] * way.z;
            let mut moved = at.clone();
            moved[node] += way;
            let at_end = sheet.pull(node, &moved).force.dot(&way) + weighs;
            let square = way.dot(&(found.block * way));
            let by_stiffness = found.force.dot(&way) + weighs - square;
            let most = found.block.norm() * way.norm_squared() + at_end.abs();
            for (found, expected) in found.works.iter().zip([at_end, by_stiffness, square]) {
                let error = (found - expected).abs();
                assert!(error <= 1e-9 * most, "{node}: {found} for {expected}");
            }
        }
    }
}
