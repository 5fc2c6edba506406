//! Inverse kinematics: how the joints turn so that a bone's end comes to a point.
//!
//! Each step solves rapier's Jacobian by rapier's damped least squares. Two things differ from its
//! `inverse_kinematics`: that one keeps the last bone's direction where it is told only the place,
//! here it is free; and it knows no limits. So the Jacobian is taken in anatomical angles, an angle
//! that stands at a limit and would go beyond it is left out, and the others are solved again.
//!
//! 1. The limb alone is tried, from the bone to the first fork above it: arm with collar bone, leg.
//! 2. If it comes to rest in its limits short of the point, it starts again from other angles.
//! 3. Then the bones above, up to the root's, take part.
//!
//! It finds a posture that reaches; it does not prove, where it finds none, that there is none.

use super::{Joint, Posture, Skeleton, rig::Rig};
use crate::math::{Rotation, Vec3};
use core::f64::consts::PI;
use rapier3d::{
    dynamics::Multibody,
    math::{DVector, Jacobian},
};

/// Where inverse kinematics came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// The posture that comes nearest, a turn for every bone.
    pub posture: Posture,
    /// How far the bone's end is from the point [cm]; infinite for a bone that is not there and
    /// for a point or a posture that is not finite.
    pub miss: f64,
}

/// An end so near to its point is there [cm].
const THERE: f64 = 0.5;
/// A search ends so near to its point [cm].
const NEAR: f64 = 1e-3;
/// Least damping of least squares [cm]: a limb that stands askew to the way by more than this over
/// its length is turned as far as undamped.
const DAMPING: f64 = 2.0;
/// An end is drawn no further in one step [cm]: a limb is straight over so much.
const STRIDE: f64 = 15.0;
/// A search in which no angle turns further in a step has come to rest [rad].
const STILL: f64 = 1e-7;
/// Steps of one search.
const STEPS: usize = 100;
/// Searches from different angles, of the limb and again of the whole chain.
const STARTS: usize = 12;
/// Bones are shorter [cm]; beyond it sums of squares would overflow.
const LONGEST: f64 = 1e9;
/// Swings stay so much below half a turn [rad], where their angles would change sign.
const SHORT: f64 = 1e-6;

impl Reached {
    /// Whether the end is within 0.5 cm of the point.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.miss <= THERE
    }
}

impl Skeleton {
    /// Brings the end of a bone to a point [cm], from a posture whose root stays where it is.
    ///
    /// The limb's joints, and where it needs them those of the trunk, are within their limits
    /// afterwards, even where those of `from` were not; all others are as they were.
    #[must_use]
    pub fn reach(&self, from: &Posture, bone: usize, target: &Vec3) -> Reached {
        let chain = self.chain(bone);
        let limb = self.limb(&chain);
        let begun = |movable: &[usize], start: usize| {
            let mut search = Search::new(self, from, bone, target, movable);
            search.begin(start);
            search
        };
        let mut best = begun(&limb, 0).reached();
        let trunk_too = (limb.len() < chain.len()).then_some(&chain);
        for movable in [Some(&limb), trunk_too].into_iter().flatten() {
            for start in 0..STARTS {
                if best.is_there() || !best.miss.is_finite() {
                    return best;
                }
                let mut search = begun(movable, start);
                search.run();
                let reached = search.reached();
                if reached.miss < best.miss {
                    best = reached;
                }
            }
        }
        best
    }

    /// The bones whose joints turn a bone, itself first, the root left out.
    fn chain(&self, bone: usize) -> Vec<usize> {
        let parent = |bone: &usize| self.bones().get(*bone)?.parent;
        let bones = core::iter::successors(Some(bone), parent);
        bones.filter(|bone| *bone > 0).collect()
    }

    /// The part of a chain before the first bone that others hang on too.
    fn limb(&self, chain: &[usize]) -> Vec<usize> {
        let forks = |bone: usize| {
            let hanging = self.bones().iter().filter(|b| b.parent == Some(bone));
            hanging.count() > 1
        };
        let mut limb = chain.iter().copied();
        let own = limb.next();
        own.into_iter()
            .chain(limb.take_while(|bone| !forks(*bone)))
            .collect()
    }
}

/// One way down from one start.
struct Search<'s> {
    skeleton: &'s Skeleton,
    rig: Rig,
    posture: Posture,
    bone: usize,
    target: Vec3,
    /// The joints that turn, and their angles [rad].
    movable: Vec<(usize, &'s Joint, [f64; 3])>,
}

impl<'s> Search<'s> {
    fn new(
        skeleton: &'s Skeleton,
        from: &Posture,
        bone: usize,
        target: &Vec3,
        movable: &[usize],
    ) -> Self {
        let mut posture = from.clone();
        posture
            .joints
            .resize(skeleton.bones().len(), Rotation::identity());
        let turning = |bone: usize| {
            let joint = &skeleton.bones().get(bone)?.joint;
            let angles = joint.angles(posture.joints.get(bone)?);
            joint.turns().then_some((bone, joint, angles))
        };
        Self {
            movable: movable.iter().copied().filter_map(turning).collect(),
            rig: Rig::new(skeleton),
            skeleton,
            bone,
            target: *target,
            posture,
        }
    }

    /// Starts from the posture's own angles or, after those, from angles strewn over what the
    /// limits allow: the same ones each time.
    fn begin(&mut self, start: usize) {
        let mut number = 1.5;
        for (_, joint, angles) in &mut self.movable {
            for (angle, [low, high]) in angles.iter_mut().zip(joint.limits) {
                // Roots of halves of odd numbers are irrational, so their multiples never repeat.
                number += 1.0;
                let part = (start as f64 * f64::sqrt(number)).fract();
                if start > 0 {
                    *angle = low + part * (high - low);
                }
            }
            *angles = allowed(joint, *angles);
        }
        self.apply();
    }

    /// Goes nearer until it is there or can go no nearer. A step that led away is taken back, and
    /// the next ones are damped more: a limb that is stretched towards a point beyond it swings to
    /// and fro else.
    fn run(&mut self) {
        let mut damping = DAMPING;
        let mut nearest = (self.miss(), self.angles());
        for _ in 0..STEPS {
            if nearest.0 <= NEAR || !self.step(damping) {
                break;
            }
            let miss = self.miss();
            if miss < nearest.0 {
                nearest = (miss, self.angles());
                damping = (0.5 * damping).max(DAMPING);
            } else {
                self.take(&nearest.1);
                damping *= 4.0;
            }
        }
        self.take(&nearest.1);
    }

    fn take(&mut self, taken: &[[f64; 3]]) {
        for ((_, _, angles), taken) in self.movable.iter_mut().zip(taken) {
            *angles = *taken;
        }
        self.apply();
    }

    fn reached(self) -> Reached {
        let miss = self.miss();
        Reached {
            posture: self.posture,
            miss: if miss.is_finite() {
                miss
            } else {
                f64::INFINITY
            },
        }
    }

    fn angles(&self) -> Vec<[f64; 3]> {
        self.movable.iter().map(|(_, _, angles)| *angles).collect()
    }

    /// Poses the bones by the angles.
    fn apply(&mut self) {
        for (bone, joint, angles) in &self.movable {
            if let Some(turn) = self.posture.joints.get_mut(*bone) {
                *turn = joint.rotation(*angles);
            }
        }
        self.rig.pose(&self.posture);
    }

    /// From the bone's end to the target [cm].
    fn way(&self) -> Option<Vec3> {
        let bone = self.skeleton.bones().get(self.bone)?;
        Some(self.target - bone.end(&self.rig.place(self.bone)))
    }

    fn miss(&self) -> f64 {
        self.way().map_or(f64::INFINITY, |way| way.norm())
    }

    /// One step of damped least squares within the limits; none where nothing can move.
    fn step(&mut self, damping: f64) -> bool {
        let (Some(way), Some(mut jacobian)) = (self.way(), self.jacobian()) else {
            return false;
        };
        let far = way.norm();
        let wanted = way * (STRIDE.min(far) / far);
        let sound = jacobian.iter().all(|part| part.abs() < LONGEST);
        if !sound || !wanted.iter().all(|part| part.is_finite()) {
            return false;
        }
        // Each round leaves out at least one angle more.
        for _ in 0..jacobian.ncols() {
            let turns = solved(&jacobian, &wanted, damping);
            if !self.leave_out_those_at_limits(&turns, &mut jacobian) {
                self.turn(&turns);
                return turns.amax() > STILL;
            }
        }
        false
    }

    /// How the bone's end moves with each angle [cm/rad]; no turn of it is asked for.
    fn jacobian(&self) -> Option<Jacobian<f64>> {
        let whole = self.rig.jacobian(self.bone)?;
        let bone = self.skeleton.bones().get(self.bone)?;
        let arm = self.rig.place(self.bone).rotation * bone.vector;
        let mut columns = Jacobian::zeros(3 * self.movable.len());
        for (place, (index, joint, angles)) in self.movable.iter().enumerate() {
            let column = self.rig.column(*index)?;
            let moves = whole.fixed_view::<3, 3>(0, column);
            let turns = whole.fixed_view::<3, 3>(3, column);
            for (angle, rate) in rates(joint, *angles).iter().enumerate() {
                let end = moves * rate + (turns * rate).cross(&arm);
                columns
                    .fixed_view_mut::<3, 1>(0, 3 * place + angle)
                    .copy_from(&end);
            }
        }
        Some(columns)
    }

    /// Whether any angle was left out: one at its limit that would go beyond it.
    fn leave_out_those_at_limits(&self, turns: &DVector, jacobian: &mut Jacobian<f64>) -> bool {
        let limits = self.movable.iter().flat_map(|(_, joint, angles)| {
            let pairs = angles.iter().zip(joint.limits);
            pairs.map(|(angle, [low, high])| (*angle <= low, *angle >= high))
        });
        let mut any = false;
        let columns = jacobian.column_iter_mut().zip(turns.iter());
        for ((mut column, turn), (lowest, highest)) in columns.zip(limits) {
            if (lowest && *turn < 0.0) || (highest && *turn > 0.0) {
                column.fill(0.0);
                any = true;
            }
        }
        any
    }

    fn turn(&mut self, turns: &DVector) {
        let mut turns = turns.iter();
        for (_, joint, angles) in &mut self.movable {
            for (angle, turn) in angles.iter_mut().zip(&mut turns) {
                *angle += turn;
            }
            *angles = allowed(joint, *angles);
        }
        self.apply();
    }
}

/// Rapier's damped least squares for a wanted move of the end.
fn solved(jacobian: &Jacobian<f64>, wanted: &Vec3, damping: f64) -> DVector {
    let mut turns = DVector::zeros(jacobian.ncols());
    let wanted = nalgebra::Vector6::new(wanted.x, wanted.y, wanted.z, 0.0, 0.0, 0.0);
    Multibody::inverse_kinematics_delta_with_jacobian(jacobian, &wanted, damping, &mut turns);
    turns
}

/// The nearest angles within the limits that are read back from their turn: a swing about two axes
/// at once may exceed half a turn where neither alone does.
fn allowed(joint: &Joint, angles: [f64; 3]) -> [f64; 3] {
    let [f, a, t] = joint.within(angles);
    let swing = (f * f + a * a).sqrt();
    let part = ((PI - SHORT) / swing).min(1.0);
    joint.within([f * part, a * part, t])
}

/// How fast a joint turns, about which axis of its parent, when each of its angles grows.
fn rates(joint: &Joint, [f, a, _]: [f64; 3]) -> [Vec3; 3] {
    let [flex, side, twist] = joint.axes;
    let swing = flex * f + side * a;
    let swung = joint.rotation([f, a, 0.0]);
    [along(&swing, &flex), along(&swing, &side), swung * twist]
}

/// The turning that goes with a change of a rotation vector: the left Jacobian of the rotations.
fn along(vector: &Vec3, change: &Vec3) -> Vec3 {
    let square = vector.norm_squared();
    let angle = square.sqrt();
    // (1 − cos x)/x² → 1/2 and (x − sin x)/x³ → 1/6; below, their next terms are 1e-9 of them.
    let [first, second] = if angle < 1e-4 {
        [0.5, 1.0 / 6.0]
    } else {
        let (sine, cosine) = libm::sincos(angle);
        [(1.0 - cosine) / square, (angle - sine) / (angle * square)]
    };
    let across = vector.cross(change);
    change + across * first + vector.cross(&across) * second
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::turned;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rates_are_the_slopes_of_the_turn(f in -2.0..2.0, a in -2.0..2.0, t in -3.0..3.0) {
            let joint = Joint {
                name: "left_shoulder".into(),
                angles: ["flexion", "abduction", "rotation"],
                axes: [-Vec3::x(), -Vec3::y(), -Vec3::z()],
                limits: [[-3.0, 3.0]; 3],
            };
            let step = 1e-5;
            for (angle, rate) in rates(&joint, [f, a, t]).iter().enumerate() {
                let (mut before, mut after) = ([f, a, t], [f, a, t]);
                before[angle] -= step;
                after[angle] += step;
                let turn = joint.rotation(after) * joint.rotation(before).inverse();
                let slope = turned(&turn) / (2.0 * step);
                prop_assert!((slope - rate).norm() < 1e-8, "{slope} and {rate}");
            }
        }
    }
}
