//! How muscles change when a joint bends: a string of balls thickens in its middle and thins towards
//! its ends, on the side that bends, and its volume stays.

use super::{
    bones::Side,
    muscles::{Ball, Flesh, Muscle, Muscles},
};
use crate::{
    math::Vec3,
    skeleton::{Posture, Skeleton},
};
use core::f64::consts::PI;

/// A muscle that a joint's flexion changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Bulge {
    muscle: usize,
    /// The bone whose joint bends.
    joint: usize,
    /// The flexion at which the muscle is thickest [rad].
    full: f64,
    /// What its section gains at full flexion, as a share.
    gain: f64,
    /// Which side thickens, in the bone's frame.
    towards: Vec3,
}

/// A string, the joint that changes it, what its thickest radius gains, and on which side.
struct Rule {
    flesh: Flesh,
    joint: &'static str,
    gain: f64,
    towards: Vec3,
}

/// A bent upper arm measures some 2 cm more than the 26 cm it has hanging, a bent knee's thigh and
/// calf 1 to 2 cm more (from memory of tailors' ease).
fn rules() -> [Rule; 3] {
    let rule = |flesh, joint, gain, towards| Rule {
        flesh,
        joint,
        gain,
        towards,
    };
    [
        rule(Flesh::UpperArm, "elbow", 0.08, -Vec3::y()),
        rule(Flesh::Thigh, "knee", 0.03, Vec3::y()),
        rule(Flesh::Shank, "knee", 0.04, Vec3::y()),
    ]
}

/// All bulges of a body.
pub(super) fn bulges(skeleton: &Skeleton, muscles: &Muscles) -> Vec<Bulge> {
    let mut bulges = Vec::new();
    for rule in rules() {
        for side in [Side::Right, Side::Left] {
            let joint = skeleton.joint(&side.of(rule.joint));
            let full =
                joint.and_then(|joint| Some(skeleton.bones().get(joint)?.joint.limits[0][1]));
            let (Some(joint), Some(full)) = (joint, full) else {
                continue;
            };
            let string = muscles.group(rule.flesh, Some(side));
            let balls = muscles.all.get(string.clone()).unwrap_or_default();
            let square = (1.0 + rule.gain) * (1.0 + rule.gain) - 1.0;
            bulges.extend(string.zip(shares(balls)).map(|(muscle, share)| Bulge {
                muscle,
                joint,
                full,
                gain: square * share,
                towards: rule.towards,
            }));
        }
    }
    bulges
}

/// What each ball of a string gains of its section, 1 where it is most: sin⁴ along the string, less
/// as much of sin as it takes for the volume Σ r²·length to stay.
fn shares(string: &[Muscle]) -> Vec<f64> {
    let middle = |index: usize| string.get(index).map(|muscle| muscle.at);
    let step = |index: usize| match (middle(index), middle(index + 1)) {
        (Some(one), Some(next)) => (next - one).norm(),
        _ => 0.0,
    };
    let whole: f64 = (0..string.len()).map(step).sum();
    if whole <= 0.0 {
        return vec![0.0; string.len()];
    }
    let mut along = 0.0;
    let mut rows = Vec::new();
    for (index, muscle) in string.iter().enumerate() {
        let before = index.checked_sub(1).map_or(0.0, step);
        let sine = libm::sin(PI * along / whole).max(0.0);
        let volume = 0.5 * (before + step(index)) * muscle.radius * muscle.radius;
        rows.push((sine, volume));
        along += step(index);
    }
    let fourth = |sine: f64| sine * sine * sine * sine;
    let risen: f64 = rows
        .iter()
        .map(|(sine, volume)| fourth(*sine) * volume)
        .sum();
    let evenly: f64 = rows.iter().map(|(sine, volume)| sine * volume).sum();
    let less = risen / evenly.max(1e-12);
    let gains = rows.iter().map(|(sine, _)| fourth(*sine) - less * sine);
    let most = gains.clone().fold(1e-12, f64::max);
    gains.map(|gain| gain / most).collect()
}

impl Bulge {
    /// Its number, and what it is when a person stands so, in the bone's frame.
    pub(super) fn of(&self, muscles: &[Muscle], bent: &Bent) -> Option<(usize, Ball)> {
        let muscle = muscles.get(self.muscle)?;
        let share = (bent.flexion(self.joint) / self.full).clamp(0.0, 1.0);
        let radius = muscle.radius * (1.0 + self.gain * share).max(0.25).sqrt();
        let centre = muscle.at + self.towards * (radius - muscle.radius);
        Some((self.muscle, Ball { centre, radius }))
    }
}

/// The joints of a posture, asked for their flexion.
pub(super) struct Bent<'a> {
    pub(super) skeleton: &'a Skeleton,
    pub(super) posture: &'a Posture,
}

impl Bent<'_> {
    /// The first angle of a joint [rad]; 0 where a posture says nothing of it.
    fn flexion(&self, joint: usize) -> f64 {
        let bone = self.skeleton.bones().get(joint);
        let turn = self.posture.joints.get(joint);
        bone.zip(turn).map_or(0.0, |(bone, turn)| {
            let [flexion, ..] = bone.joint.angles(turn);
            if flexion.is_finite() { flexion } else { 0.0 }
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(
        clippy::print_stdout,
        reason = "the figures are told to who asks with --nocapture"
    )]

    use crate::{
        robot::{Ball, Robot, sample::everyone},
        skeleton::{Posture, Skeleton},
    };

    fn bent(skeleton: &Skeleton, joint: &str, degrees: f64) -> Posture {
        let mut posture = Posture::standing(skeleton);
        let bone = skeleton.joint(joint).unwrap();
        let angles = [f64::to_radians(degrees), 0.0, 0.0];
        posture.joints[bone] = skeleton.bones()[bone].joint.rotation(angles);
        posture
    }

    /// The balls of a bone, with all bones left standing so that the string stays straight.
    fn string(robot: &Robot, bone: &str, posture: &Posture) -> Vec<Ball> {
        let bone = robot.skeleton().bone(bone).unwrap();
        let balls = robot.balls(posture, &robot.standing_frames());
        let of_bone = |(muscle, _): &(usize, &Ball)| robot.muscles()[*muscle].bone == bone;
        balls
            .iter()
            .enumerate()
            .filter(of_bone)
            .map(|(_, ball)| *ball)
            .collect()
    }

    /// Volume of the union, counted in cubes of a millimetre and a half.
    fn volume(balls: &[Ball]) -> f64 {
        const SIDE: f64 = 0.15;
        let reach = |axis: usize, sign: f64| {
            let ends = balls
                .iter()
                .map(|ball| sign * ball.centre[axis] + ball.radius);
            (ends.fold(f64::MIN, f64::max) / SIDE).ceil() as i64 + 1
        };
        let range = |axis: usize| -reach(axis, -1.0)..reach(axis, 1.0);
        let mut count = 0;
        for z in range(2) {
            let z = z as f64 * SIDE;
            let near: Vec<&Ball> = balls
                .iter()
                .filter(|ball| (ball.centre.z - z).abs() < ball.radius)
                .collect();
            for y in range(1) {
                for x in range(0) {
                    let point = crate::math::Vec3::new(x as f64 * SIDE, y as f64 * SIDE, z);
                    let inside = |ball: &&Ball| (ball.centre - point).norm() < ball.radius;
                    count += i32::from(near.iter().any(inside));
                }
            }
        }
        f64::from(count) * SIDE.powi(3)
    }

    #[test]
    fn bent_limbs_are_thicker_in_the_middle_and_keep_their_volume() {
        let cases = [
            ("left_upper_arm", "left_elbow", 150.0),
            ("right_thigh", "right_knee", 135.0),
            ("right_shank", "right_knee", 135.0),
        ];
        for person in everyone() {
            let robot = Robot::new(&person).unwrap();
            for (bone, joint, full) in cases {
                let at = |degrees| string(&robot, bone, &bent(robot.skeleton(), joint, degrees));
                let (straight, flexed) = (at(0.0), at(full));
                let before = volume(&straight);
                for degrees in [0.5 * full, full] {
                    let kept = volume(&at(degrees)) / before;
                    println!("{} {bone} at {degrees}°: volume × {kept:.4}", person.name);
                    assert!((kept - 1.0).abs() < 0.01, "{kept}");
                }
                let gains = straight
                    .iter()
                    .zip(&flexed)
                    .map(|(a, b)| b.radius / a.radius);
                let (most, least) = (gains.clone().fold(0.0, f64::max), gains.fold(9.0, f64::min));
                assert!(most > 1.025 && least > 0.9, "{most} {least}");
                // The thickest one and the angle: always more.
                let widest = (0..straight.len())
                    .max_by(|a, b| {
                        let gain = |i: &usize| flexed[*i].radius - straight[*i].radius;
                        gain(a).total_cmp(&gain(b))
                    })
                    .unwrap();
                let radii: Vec<f64> = (0..=10)
                    .map(|i| at(0.1 * f64::from(i) * full)[widest].radius)
                    .collect();
                assert!(radii.windows(2).all(|pair| pair[1] > pair[0]), "{radii:?}");
            }
        }
    }

    #[test]
    fn the_flexed_side_comes_forward_and_the_other_stays() {
        let robot = Robot::new(&everyone()[1]).unwrap();
        let at = |degrees| {
            string(
                &robot,
                "left_upper_arm",
                &bent(robot.skeleton(), "left_elbow", degrees),
            )
        };
        let (straight, flexed) = (at(0.0), at(150.0));
        for (before, after) in straight.iter().zip(&flexed) {
            let behind = |ball: &Ball| ball.centre.y + ball.radius;
            assert!((behind(before) - behind(after)).abs() < 1e-9);
        }
        let front = |balls: &[Ball]| {
            balls
                .iter()
                .map(|b| b.centre.y - b.radius)
                .fold(0.0, f64::min)
        };
        assert!(front(&straight) - front(&flexed) > 0.5);
    }
}
