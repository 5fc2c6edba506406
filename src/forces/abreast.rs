//! The pulls on nodes side by side: what [`Sheet::pull`](super::Sheet::pull) gives for one, for as
//! many as the processor takes at once, without a sine, a cosine or their inverses.
//!
//! With c the cosine between two rods, the angle law `½·k·(θ − θ₀)²` has the slope
//! `k·(θ₀ − θ)/sin θ` by c, and `θ/sin θ` is a polynomial of `1 − c`. The stiffness is a simpler
//! one than the exact: for bends `k·P/L²`, P across the rod, which is never less than the exact one
//! without its mixed terms; for corners the square of the angle's derivative; for twists that of the
//! gap's.

use super::{
    blocks::Blocks,
    stencil::{BENDS, CORNERS, RODS, StencilsFrom, TWISTS},
    twist::LEAST_SPAN,
};
use crate::{
    fabric::Fabric,
    lanes::{Lanes, Points, Simd},
};

/// `θ/sin θ` in `1 − cos θ`, from 0° to 90°: Chebyshev's interpolation, within 6·10⁻¹⁰.
const ARC_OVER_SINE: [f64; 12] = [
    0.999_999_999_723_412_5,
    0.333_333_412_856_133_6,
    0.133_329_574_986_237_5,
    0.057_211_907_885_685_725,
    0.024_746_922_870_720_806,
    0.015_116_314_108_640_3,
    -0.006_956_934_755_601_454,
    0.029_797_453_221_689_956,
    -0.038_254_705_381_013_7,
    0.036_507_088_698_214_035,
    -0.018_817_364_088_836_14,
    0.004_782_656_130_823_653,
];

/// `(π/2 − θ)/(sin θ·cos θ)` in `cos² θ`, up to [`NEARLY_SQUARE`]: Chebyshev's interpolation,
/// within 3·10⁻⁹.
const SHEAR_OVER_COSINE: [f64; 9] = [
    1.000_000_001_330_611_2,
    0.666_666_069_168_655,
    0.533_377_113_607_841_7,
    0.455_919_970_565_827_8,
    0.423_245_723_164_520_73,
    0.240_614_543_893_685_28,
    0.900_963_914_635_905_2,
    -1.022_494_759_414_104_3,
    1.796_122_027_024_888,
];
/// Corners sheared by less than this sine (37°) need no square root.
const NEARLY_SQUARE: f64 = 0.6;

/// A rod from a point: its direction, its length [cm] and 1/its length [1/cm].
#[derive(Clone, Copy)]
struct Arm<S: Simd> {
    unit: Points<S>,
    length: Lanes<S>,
    over: Lanes<S>,
}

impl<S: Simd> Arm<S> {
    #[inline(always)]
    fn new(from: Points<S>, to: Points<S>) -> Self {
        let along = to - from;
        let simd = along.0[0].kind();
        let length = along.norm().max(Lanes::of(simd, 1e-12));
        let over = Lanes::of(simd, 1.0).over(length);
        Self {
            unit: along * over,
            length,
            over,
        }
    }

    /// Derivative of the cosine between this arm and another by this arm.
    #[inline(always)]
    fn slope(&self, other: &Self, cosine: Lanes<S>) -> Points<S> {
        (other.unit - self.unit * cosine) * self.over
    }
}

/// The force on nodes side by side [gf] and, if asked for, their own stiffness [gf/cm].
struct Sum<'a, S: Simd, const STIFF: bool> {
    simd: S,
    stencils: StencilsFrom<'a>,
    force: Points<S>,
    blocks: Blocks<S>,
}

/// The forces on nodes side by side [gf] and, with `STIFF`, their own stiffness [gf/cm]; `points`
/// are those around them, as [`PLACES`](super::PLACES) has them.
#[inline(always)]
pub(crate) fn pulls<S: Simd, const STIFF: bool>(
    simd: S,
    fabric: &Fabric,
    stencils: StencilsFrom<'_>,
    points: &[Points<S>; 13],
) -> (Points<S>, Blocks<S>) {
    let mut force = Points::zero(simd);
    force.0[2] = -stencils.weight(simd);
    let mut sum = Sum::<S, STIFF> {
        simd,
        stencils,
        force,
        blocks: Blocks::zero(simd),
    };
    let arm = |to: usize| Arm::new(points[0], points[to]);
    let arms = [arm(1), arm(2), arm(3), arm(4)];
    for (k, arm) in arms.iter().enumerate() {
        sum.add_rod(fabric, k, arm);
        // The bend about the neighbour.
        let beyond = Arm::new(points[1 + k], points[5 + k]);
        sum.add_far_bend(2 + k, arm, &beyond);
    }
    sum.add_own_bend(0, &arms[1], &arms[0]);
    sum.add_own_bend(1, &arms[3], &arms[2]);
    for (quarter, [along, across]) in [[0, 2], [1, 2], [1, 3], [0, 3]].into_iter().enumerate() {
        let diagonal = points[9 + quarter];
        let end = |k: usize| (&arms[k], points[1 + k]);
        let ends = [end(along), end(across)];
        sum.add_quarter(CORNERS + 6 * quarter, ends, diagonal);
    }
    if stencils.twisting() {
        sum.add_twists(points);
    }
    (sum.force, sum.blocks)
}

impl<S: Simd, const STIFF: bool> Sum<'_, S, STIFF> {
    /// (5).
    #[inline(always)]
    fn add_rod(&mut self, fabric: &Fabric, k: usize, arm: &Arm<S>) {
        let simd = self.simd;
        let at = RODS + 3 * k;
        let over_rest = self.stencils.get(simd, at);
        let width = self.stencils.get(simd, at + 1);
        let floor = self.stencils.get(simd, at + 2);
        let direction = if k < 2 { &fabric.warp } else { &fabric.weft };
        let one = Lanes::of(simd, 1.0);
        let strain = arm.length * over_rest - one;
        let (tension, tangent) = direction.tension.answers(strain, floor);
        let pull = tension * width;
        self.force += arm.unit * pull;
        if STIFF {
            let sideways = (pull * arm.over).abs();
            let stretch = tangent * width * over_rest;
            self.blocks.add_identity(sideways);
            self.blocks.add_square(arm.unit, stretch - sideways);
        }
    }

    /// (6), about the node itself.
    #[inline(always)]
    fn add_own_bend(&mut self, place: usize, before: &Arm<S>, after: &Arm<S>) {
        let (stiffness, rest) = self.angle(BENDS + 2 * place);
        let cosine = -before.unit.dot(after.unit);
        let pull = stiffness * self.bend_slope(cosine, rest);
        // The rod that comes in runs against `before`.
        let back = Arm {
            unit: before.unit * Lanes::of(self.simd, -1.0),
            ..*before
        };
        self.force += (after.slope(&back, cosine) - back.slope(after, cosine)) * pull;
        if STIFF {
            let over = before.over + after.over;
            let factor = stiffness * over * over;
            self.blocks.add_identity(factor);
            self.blocks.add_square(before.unit, factor * -0.5);
            self.blocks.add_square(after.unit, factor * -0.5);
        }
    }

    /// (6), about a neighbour.
    #[inline(always)]
    fn add_far_bend(&mut self, place: usize, near: &Arm<S>, beyond: &Arm<S>) {
        let (stiffness, rest) = self.angle(BENDS + 2 * place);
        let cosine = near.unit.dot(beyond.unit);
        let pull = stiffness * self.bend_slope(cosine, rest);
        self.force += near.slope(beyond, cosine) * pull;
        if STIFF {
            let factor = stiffness * near.over * near.over;
            self.blocks.add_identity(factor);
            self.blocks.add_square(near.unit, -factor);
        }
    }

    /// (7): the three corners of a quarter that the node belongs to.
    #[inline(always)]
    fn add_quarter(&mut self, at: usize, ends: [(&Arm<S>, Points<S>); 2], diagonal: Points<S>) {
        let [(along, _), (across, _)] = ends;
        let cosine = along.unit.dot(across.unit);
        let slope = along.slope(across, cosine) + across.slope(along, cosine);
        self.add_corner(at, cosine, slope);
        for (k, (arm, end)) in ends.into_iter().enumerate() {
            let other = Arm::new(end, diagonal);
            let back = Arm {
                unit: arm.unit * Lanes::of(self.simd, -1.0),
                ..*arm
            };
            let cosine = back.unit.dot(other.unit);
            let slope = back.slope(&other, cosine) * Lanes::of(self.simd, -1.0);
            self.add_corner(at + 2 * (k + 1), cosine, slope);
        }
    }

    /// Adds a corner; `slope` is minus the derivative of its cosine by the node.
    #[inline(always)]
    fn add_corner(&mut self, at: usize, cosine: Lanes<S>, slope: Points<S>) {
        let (stiffness, rest) = self.angle(at);
        let square = cosine * cosine;
        let mut pull = cosine * square.polynomial(&SHEAR_OVER_COSINE);
        // 1/sin² θ, to the third term of its series.
        let mut factor = square.polynomial(&[1.0, 1.0, 1.0]);
        let far = cosine.abs().any_above(NEARLY_SQUARE);
        if far || !self.stencils.on_grain() {
            // Which lanes take which way must not depend on which lanes stand together.
            let over_sine = self.over_sine(cosine);
            let right = Lanes::of(self.simd, core::f64::consts::FRAC_PI_2);
            let off = (rest - right).abs() + (square - square.min(self.nearly_square()));
            let near = off.less_than(Lanes::of(self.simd, 1e-12));
            pull = near.choose(pull, self.slope(cosine, rest, over_sine));
            factor = near.choose(factor, over_sine * over_sine);
        }
        self.force += slope * (stiffness * pull);
        if STIFF {
            self.blocks.add_square(slope, stiffness * factor);
        }
    }

    /// The twists of the four cells about the node.
    #[inline(always)]
    fn add_twists(&mut self, points: &[Points<S>; 13]) {
        for (quarter, [along, across]) in [[1, 3], [2, 3], [2, 4], [1, 4]].into_iter().enumerate() {
            let cell = [0, along, 9 + quarter, across].map(|place| points[place]);
            self.add_twist(TWISTS + quarter, cell);
        }
    }

    /// Adds the twist of a cell whose first node is the node.
    #[inline(always)]
    fn add_twist(&mut self, at: usize, [here, along, diagonal, across]: [Points<S>; 4]) {
        let stiffness = self.stencils.get(self.simd, at);
        let (first, second, between) = (diagonal - here, across - along, along - here);
        let normal = first.cross(second);
        let one = Lanes::of(self.simd, 1.0);
        let span = normal.dot(normal).max(Lanes::of(self.simd, LEAST_SPAN));
        let over = one.over(span);
        let lever = one - between.cross(second).dot(normal) * over;
        let pull = stiffness * lever * over;
        self.force += normal * (pull * between.dot(normal));
        if STIFF {
            self.blocks.add_square(normal, pull * lever);
        }
    }

    #[inline(always)]
    fn nearly_square(&self) -> Lanes<S> {
        Lanes::of(self.simd, NEARLY_SQUARE * NEARLY_SQUARE)
    }

    #[inline(always)]
    fn angle(&self, at: usize) -> (Lanes<S>, Lanes<S>) {
        (
            self.stencils.get(self.simd, at),
            self.stencils.get(self.simd, at + 1),
        )
    }

    #[inline(always)]
    fn over_sine(&self, cosine: Lanes<S>) -> Lanes<S> {
        let one = Lanes::of(self.simd, 1.0);
        // As in `turn`, rods folded onto each other have no direction to open.
        let square = (one - cosine * cosine).max(Lanes::of(self.simd, 1e-18));
        one.over(square.sqrt())
    }

    /// `(θ₀ − θ)/sin θ`, the slope of `½(θ − θ₀)²` by the cosine.
    #[inline(always)]
    fn slope(&self, cosine: Lanes<S>, rest: Lanes<S>, over_sine: Lanes<S>) -> Lanes<S> {
        let acute = arc_over_sine(cosine);
        let zero = Lanes::of(self.simd, 0.0);
        let pi = Lanes::of(self.simd, core::f64::consts::PI);
        let blunt = cosine.less_than(zero);
        // An obtuse angle is π less an acute one.
        let from = blunt.choose(rest - pi, rest);
        from * over_sine + blunt.choose(acute, -acute)
    }

    /// The same for bends, most of which are straight at rest and less than a right angle.
    #[inline(always)]
    fn bend_slope(&self, cosine: Lanes<S>, rest: Lanes<S>) -> Lanes<S> {
        if self.stencils.on_grain() && !cosine.any_below(0.0) {
            return -arc_over_sine(cosine);
        }
        let zero = Lanes::of(self.simd, 0.0);
        let slope = self.slope(cosine, rest, self.over_sine(cosine));
        // Straight rods at rest: 0/0, in the limit −1.
        let straight = Lanes::of(self.simd, 0.5).less_than(cosine);
        let exact = zero.less_than(rest);
        exact.choose(slope, straight.choose(-arc_over_sine(cosine), slope))
    }
}

#[inline(always)]
fn arc_over_sine<S: Simd>(cosine: Lanes<S>) -> Lanes<S> {
    (Lanes::of(cosine.kind(), 1.0) - cosine.abs()).polynomial(&ARC_OVER_SINE)
}

#[cfg(test)]
mod tests {
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

    impl WithSimd for Pulls<'_> {
        type Output = Vec<(Vec3, Mat3)>;

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
                let points = PLACES.map(|[i, j]| {
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
                let (force, block) =
                    pulls::<S, true>(simd, sheet.fabric(), stencils.from(0), &points);
                let read = |lanes: Lanes<S>| {
                    let mut numbers = [0.0; WIDEST];
                    lanes.write(&mut numbers);
                    numbers
                };
                let (force, block) = (force.0.map(read), block.0.map(read));
                for k in 0..nodes.len() {
                    let [xx, yy, zz, xy, xz, yz] = block.map(|numbers| numbers[k]);
                    all.push((
                        Vec3::from_fn(|axis, _| force[axis][k]),
                        Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
                    ));
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
                    for (node, (force, block)) in found.iter().enumerate() {
                        let expected = sheet.pull(node, &at);
                        let error = (force - expected.force).norm();
                        let most = block.norm().max(expected.stiffness.norm()) * lattice.pitch;
                        assert!(
                            error <= 1e-8 * most,
                            "{laws:?} {by} {node}: {error} of {most}"
                        );
                        let least = block.symmetric_eigenvalues().min();
                        assert!(least >= -1e-9 * block.norm(), "{by} {node}: {least}");
                    }
                }
            }
        }
    }
}
