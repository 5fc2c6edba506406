//! The pulls on nodes side by side: what [`Sheet::pull`](super::Sheet::pull) gives for one, for as
//! many as the processor takes at once, by [`series`] of cosines.
//!
//! The stiffness is a simpler one than the exact: for bends `k·P/L²`, P across the rod, which is never
//! less than the exact one without its mixed terms; for corners the square of the angle's derivative;
//! for twists that of the gap's.

use super::{
    blocks::Blocks,
    series,
    stencil::{BENDS, CORNERS, RODS, StencilsFrom, TWISTS},
    twist::LEAST_SPAN,
};
use crate::{
    fabric::{Fabric, Tension},
    lanes::{Lanes, Points, Simd},
};

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
}

/// The cosine of a corner, the slope of its law by that, and 1/sin² θ.
type Corner<S> = (Lanes<S>, Lanes<S>, Lanes<S>);

/// The arms that bound each quarter, along the warp and along the weft.
const QUARTERS: [[usize; 2]; 4] = [[0, 2], [1, 2], [1, 3], [0, 3]];

/// The rods of nodes side by side.
#[derive(Clone, Copy)]
pub(crate) struct Rods<S: Simd> {
    /// Directions away from the node.
    units: [Points<S>; 4],
    /// Tension [gf], and stiffness along and across [gf/cm].
    pulls: [[Lanes<S>; 3]; 4],
}

/// The force on nodes side by side [gf] and, if asked for, their own stiffness [gf/cm].
struct Sum<'a, S: Simd, const STIFF: bool> {
    simd: S,
    stencils: StencilsFrom<'a>,
    /// But what goes along the four arms.
    force: Points<S>,
    blocks: Blocks<S>,
    rods: Rods<S>,
    /// Force along each arm [gf], and stiffness along it [gf/cm].
    along: [Lanes<S>; 4],
    squares: [Lanes<S>; 4],
    /// Stiffness in any direction [gf/cm].
    identity: Lanes<S>,
}

/// The forces on nodes side by side [gf] and, with `STIFF`, their own stiffness [gf/cm] and what of it
/// all is their rods'; `points` are those around them, as [`PLACES`](super::PLACES) has them.
#[inline(always)]
pub(crate) fn pulls<S: Simd, const STIFF: bool>(
    simd: S,
    fabric: &Fabric,
    stencils: StencilsFrom<'_>,
    points: &[Points<S>; 13],
) -> (Points<S>, Blocks<S>, Rods<S>) {
    let zero = Lanes::of(simd, 0.0);
    let mut force = Points::zero(simd);
    force.0[2] = -stencils.weight(simd);
    let mut sum = Sum::<S, STIFF> {
        simd,
        stencils,
        force,
        blocks: Blocks::zero(simd),
        rods: Rods {
            units: [Points::zero(simd); 4],
            pulls: [[zero; 3]; 4],
        },
        along: [zero; 4],
        squares: [zero; 4],
        identity: zero,
    };
    let arm = |from: usize, to: usize| Arm::new(points[from], points[to]);
    let arms = [arm(0, 1), arm(0, 2), arm(0, 3), arm(0, 4)];
    let beyond = [arm(1, 5), arm(2, 6), arm(3, 7), arm(4, 8)];
    sum.add_rods_and_bends(fabric, &arms, &beyond);
    let sides = [
        [arm(1, 9), arm(3, 9)],
        [arm(2, 10), arm(3, 10)],
        [arm(2, 11), arm(4, 11)],
        [arm(1, 12), arm(4, 12)],
    ];
    sum.add_corners(&arms, &sides);
    if stencils.twisting() {
        sum.add_twists(points);
    }
    sum.whole(&arms)
}

impl<S: Simd, const STIFF: bool> Sum<'_, S, STIFF> {
    /// (5) and (6).
    #[inline(always)]
    fn add_rods_and_bends(&mut self, fabric: &Fabric, arms: &[Arm<S>; 4], beyond: &[Arm<S>; 4]) {
        let answers = tensions(self.simd, fabric, self.stencils, arms);
        let between = |one: &Arm<S>, other: &Arm<S>| one.unit.dot(other.unit);
        let cosines = [
            -between(&arms[1], &arms[0]),
            -between(&arms[3], &arms[2]),
            between(&arms[0], &beyond[0]),
            between(&arms[1], &beyond[1]),
            between(&arms[2], &beyond[2]),
            between(&arms[3], &beyond[3]),
        ];
        let mut slopes = series::straight_slopes(cosines);
        if !self.stencils.on_grain() || series::any_obtuse(cosines) {
            slopes = series::bend_slopes(cosines, self.rests(BENDS), slopes);
        }
        self.add_own_bend(0, [1, 0], arms, (cosines[0], slopes[0]));
        self.add_own_bend(1, [3, 2], arms, (cosines[1], slopes[1]));
        // One by one: a loop's indices would keep all of this out of the registers.
        let bend = |k: usize| (cosines[k], slopes[k]);
        self.add_rod(0, &arms[0], answers[0]);
        self.add_rod(1, &arms[1], answers[1]);
        self.add_rod(2, &arms[2], answers[2]);
        self.add_rod(3, &arms[3], answers[3]);
        self.add_far_bend(0, &arms[0], &beyond[0], bend(2));
        self.add_far_bend(1, &arms[1], &beyond[1], bend(3));
        self.add_far_bend(2, &arms[2], &beyond[2], bend(4));
        self.add_far_bend(3, &arms[3], &beyond[3], bend(5));
    }

    /// (5), by its tension [gf] and stiffness [gf/cm].
    #[inline(always)]
    fn add_rod(&mut self, k: usize, arm: &Arm<S>, [pull, stretch]: [Lanes<S>; 2]) {
        self.along[k] = self.along[k] + pull;
        if STIFF {
            let sideways = (pull * arm.over).abs();
            self.identity = self.identity + sideways;
            self.squares[k] = self.squares[k] + (stretch - sideways);
            self.rods.units[k] = arm.unit;
            self.rods.pulls[k] = [pull, stretch, sideways];
        }
    }

    /// (6), about the node itself, between the arms before and after it.
    #[inline(always)]
    fn add_own_bend(
        &mut self,
        place: usize,
        [before, after]: [usize; 2],
        arms: &[Arm<S>; 4],
        (cosine, slope): (Lanes<S>, Lanes<S>),
    ) {
        let (stiffness, _) = self.angle(BENDS + 2 * place);
        let pull = stiffness * slope;
        let (one, other) = (arms[before].over, arms[after].over);
        self.along[before] = self.along[before] - pull * (other + cosine * one);
        self.along[after] = self.along[after] - pull * (one + cosine * other);
        if STIFF {
            let over = one + other;
            let factor = stiffness * over * over;
            self.identity = self.identity + factor;
            for k in [before, after] {
                self.squares[k] = self.squares[k] - factor * 0.5;
            }
        }
    }

    /// (6), about the neighbour that an arm leads to.
    #[inline(always)]
    fn add_far_bend(
        &mut self,
        k: usize,
        near: &Arm<S>,
        beyond: &Arm<S>,
        (cosine, slope): (Lanes<S>, Lanes<S>),
    ) {
        let (stiffness, _) = self.angle(BENDS + 2 * (2 + k));
        let turn = stiffness * near.over;
        let pull = turn * slope;
        self.force += beyond.unit * pull;
        self.along[k] = self.along[k] - pull * cosine;
        if STIFF {
            let factor = turn * near.over;
            self.identity = self.identity + factor;
            self.squares[k] = self.squares[k] - factor;
        }
    }

    /// (7): the three corners of each quarter that the node belongs to; `sides` are the arms from each
    /// quarter's neighbours to its diagonal point.
    #[inline(always)]
    fn add_corners(&mut self, arms: &[Arm<S>; 4], sides: &[[Arm<S>; 2]; 4]) {
        let mut cosines = [Lanes::of(self.simd, 0.0); 12];
        for (quarter, [along, across]) in QUARTERS.into_iter().enumerate() {
            let (one, other) = (arms[along].unit, arms[across].unit);
            cosines[3 * quarter] = one.dot(other);
            cosines[3 * quarter + 1] = -one.dot(sides[quarter][0].unit);
            cosines[3 * quarter + 2] = -other.dot(sides[quarter][1].unit);
        }
        let mut squares = cosines;
        for square in &mut squares {
            *square = *square * *square;
        }
        let mut pulls = series::right_slopes(cosines, squares);
        let mut factors = squares;
        for factor in &mut factors {
            // 1/sin² θ, to the third term of its series.
            let one = Lanes::of(self.simd, 1.0);
            *factor = one + *factor * (one + *factor);
        }
        if !self.stencils.on_grain() || series::any_oblique(squares) {
            let rests = self.rests(CORNERS);
            (pulls, factors) = series::corner_slopes(cosines, rests, (pulls, factors));
        }
        let corner = |k: usize| (cosines[k], pulls[k], factors[k]);
        self.add_quarter(0, arms, sides, [corner(0), corner(1), corner(2)]);
        self.add_quarter(1, arms, sides, [corner(3), corner(4), corner(5)]);
        self.add_quarter(2, arms, sides, [corner(6), corner(7), corner(8)]);
        self.add_quarter(3, arms, sides, [corner(9), corner(10), corner(11)]);
    }

    /// Adds the three corners of a quarter.
    #[inline(always)]
    fn add_quarter(
        &mut self,
        quarter: usize,
        arms: &[Arm<S>; 4],
        sides: &[[Arm<S>; 2]; 4],
        [own, first, second]: [Corner<S>; 3],
    ) {
        let [along, across] = QUARTERS[quarter];
        let [one, other] = &sides[quarter];
        let at = CORNERS + 6 * quarter;
        self.add_own_corner(at, [along, across], arms, own);
        self.add_side_corner(at + 2, along, [&arms[along], one], first);
        self.add_side_corner(at + 4, across, [&arms[across], other], second);
    }

    /// Adds a corner between two arms.
    #[inline(always)]
    fn add_own_corner(
        &mut self,
        at: usize,
        [one, other]: [usize; 2],
        arms: &[Arm<S>; 4],
        (cosine, pull, factor): Corner<S>,
    ) {
        let (stiffness, _) = self.angle(at);
        let (a, b) = (&arms[one], &arms[other]);
        let pull = stiffness * pull;
        // Minus the derivative of its cosine by the node, along each arm.
        let along_a = b.over - a.over * cosine;
        let along_b = a.over - b.over * cosine;
        self.along[one] = self.along[one] + pull * along_a;
        self.along[other] = self.along[other] + pull * along_b;
        if STIFF {
            let slope = a.unit * along_a + b.unit * along_b;
            self.blocks.add_square(slope, stiffness * factor);
        }
    }

    /// Adds the corner at the end of an arm, between it and the arm from there.
    #[inline(always)]
    fn add_side_corner(
        &mut self,
        at: usize,
        end: usize,
        [arm, side]: [&Arm<S>; 2],
        (cosine, pull, factor): Corner<S>,
    ) {
        let (stiffness, _) = self.angle(at);
        let turn = stiffness * arm.over;
        let pull = turn * pull;
        if STIFF {
            let slope = side.unit + arm.unit * cosine;
            self.force += slope * -pull;
            self.blocks.add_square(slope, turn * arm.over * factor);
        } else {
            self.force += side.unit * -pull;
            self.along[end] = self.along[end] - pull * cosine;
        }
    }

    /// All of it, with what goes along the arms.
    #[inline(always)]
    fn whole(mut self, arms: &[Arm<S>; 4]) -> (Points<S>, Blocks<S>, Rods<S>) {
        for (arm, along) in arms.iter().zip(self.along) {
            self.force += arm.unit * along;
        }
        if STIFF {
            self.blocks.add_identity(self.identity);
            for (arm, square) in arms.iter().zip(self.squares) {
                self.blocks.add_square(arm.unit, square);
            }
        }
        (self.force, self.blocks, self.rods)
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

    /// Angles at rest [rad] of so many bends or corners.
    #[inline(always)]
    fn rests<const N: usize>(&self, at: usize) -> [Lanes<S>; N] {
        let mut rests = [Lanes::of(self.simd, 0.0); N];
        for (k, rest) in rests.iter_mut().enumerate() {
            (_, *rest) = self.angle(at + 2 * k);
        }
        rests
    }

    #[inline(always)]
    fn angle(&self, at: usize) -> (Lanes<S>, Lanes<S>) {
        (
            self.stencils.get(self.simd, at),
            self.stencils.get(self.simd, at + 1),
        )
    }
}

/// Tension [gf] and stiffness along [gf/cm] of the four rods.
#[inline(always)]
fn tensions<S: Simd>(
    simd: S,
    fabric: &Fabric,
    stencils: StencilsFrom<'_>,
    arms: &[Arm<S>; 4],
) -> [[Lanes<S>; 2]; 4] {
    let one = Lanes::of(simd, 1.0);
    let number = |k: usize| stencils.get(simd, RODS + k);
    let rod = |k: usize| [number(3 * k), number(3 * k + 1), number(3 * k + 2)];
    let rods = [rod(0), rod(1), rod(2), rod(3)];
    let strain = |k: usize| arms[k].length * rods[k][0] - one;
    let (warp, weft) = (&fabric.warp.tension, &fabric.weft.tension);
    let answers = Tension::answers(
        [warp, warp, weft, weft],
        [strain(0), strain(1), strain(2), strain(3)],
        [rods[0][2], rods[1][2], rods[2][2], rods[3][2]],
    );
    let mut tensions = [[one; 2]; 4];
    for (k, (tension, tangent)) in answers.into_iter().enumerate() {
        let [over_rest, width, _] = rods[k];
        tensions[k] = [tension * width, tangent * width * over_rest];
    }
    tensions
}

impl<S: Simd> Rods<S> {
    /// What the nodes' rods would do along a way [gf·cm] where it ends, were their stiffness the same
    /// all along.
    #[inline(always)]
    pub(crate) fn along(&self, way: Points<S>) -> Lanes<S> {
        let square = way.dot(way);
        let mut work = square * 0.0;
        for (unit, [pull, stretch, sideways]) in self.units.iter().zip(self.pulls) {
            let along = unit.dot(way);
            work = work + along * (pull - (stretch - sideways) * along) - sideways * square;
        }
        work
    }
}

/// What the rods of nodes side by side do along a way [gf·cm] where it ends; the first of the `points`
/// is there.
#[inline(always)]
pub(crate) fn work_of_rods<S: Simd>(
    simd: S,
    fabric: &Fabric,
    stencils: StencilsFrom<'_>,
    points: &[Points<S>; 13],
    way: Points<S>,
) -> Lanes<S> {
    let arm = |to: usize| Arm::new(points[0], points[to]);
    let arms = [arm(1), arm(2), arm(3), arm(4)];
    let mut work = Lanes::of(simd, 0.0);
    for (arm, [pull, _]) in arms.iter().zip(tensions(simd, fabric, stencils, &arms)) {
        work = work + pull * arm.unit.dot(way);
    }
    work
}

#[cfg(test)]
mod tests;
