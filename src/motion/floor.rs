//! Feet on the floor: the actor's is found where he stands, and no sole goes below ours.
//!
//! For a skeleton that knows its [soles](Skeleton::soles), of a capture:
//! 1. A foot stands while its ball, where the toes begin, hardly moves and is low; on a belt, where
//!    both always move, the lower one does.
//! 2. What is flat on his floor is flat on ours: each foot is turned, by one turn for the whole
//!    capture, so that where it stands with its heel down its sole is level on the whole.
//! 3. The root goes up or down so that the feet that stand are on the floor, toes not counted, for
//!    an actor's bend. Floors of captures slope: one rises by 5 cm on a way of 4 m. In flight the way
//!    from floor to floor is straight, so that a fall stays a parabola. A bell of 0.2 s
//!    takes the jitter out.
//! 4. A foot that would still go through the floor is tipped at the ankle, just as far as it must: a
//!    heel rises less where toes cannot bend. Where that is not enough the root goes up too, as far
//!    as it must, smoothly.

use super::{Key, Motion, capture::Actor, retarget::Tip};
use crate::{
    math::{Pose, Vec3, turn},
    skeleton::{Skeleton, Sole},
};

/// A foot whose ball is slower than this share of a leg in a second stands …
const SLOW: f64 = 0.3;
/// … where it is not higher than this share of a leg above the lowest place that either comes to.
const LOW: f64 = 0.1;
/// Velocities are means over this time [s]: captures jitter.
const LOOK: f64 = 0.05;
/// Half the width of the bell that takes the jitter out of the floor's height [s].
const BELL: f64 = 0.1;
/// Half the time that the root takes for going up where tipping the foot is not enough [s].
const RISE: f64 = 0.15;
/// Keys farther apart than this [s] get others between …
const FINE: f64 = 0.01;
/// … so many parts at most.
const MOST_PARTS: usize = 8;
/// A foot is tipped no further [°].
const MOST_TIPPED: u32 = 60;
/// What is ahead of this share of the foot's bone are toes.
const TOES: f64 = 2.0 / 3.0;
/// Halvings of a degree: to 1e-9 of it.
const ROUNDS: usize = 30;

/// One of our feet.
struct Foot {
    bone: usize,
    /// Flexion, toes up.
    axis: Vec3,
    soles: Vec<Sole>,
    /// Those that do not bend up with the toes.
    firm: Vec<Sole>,
}

/// What a foot of the actor does in a frame.
#[derive(Clone, Copy)]
pub(super) struct Tread {
    pub(super) stands: bool,
    /// Stands with its heel down.
    pub(super) is_flat: bool,
}

/// When the actor's feet stand, frame by frame, from each one's ankle and where its toes begin.
///
/// Where none ever does, he walks on a belt: then the lower one does.
pub(super) fn treads(
    actor: &Actor<'_>,
    feet: [[Tip; 2]; 2],
    leg: f64,
    step: f64,
) -> [Vec<Tread>; 2] {
    let paths = feet.map(|tips| Path::of(actor, tips));
    let low = LOW * leg + paths.iter().map(Path::lowest).fold(f64::INFINITY, f64::min);
    let still = |path: &Path| {
        let balls = path.balls.iter().enumerate();
        let slow = |frame: usize| path.speed(frame, step) <= SLOW * leg;
        balls
            .map(|(frame, ball)| ball.z <= low && slow(frame))
            .collect::<Vec<bool>>()
    };
    let mut stands = [still(&paths[0]), still(&paths[1])];
    if !stands.iter().flatten().any(|stands| *stands) {
        let [right, left] = &paths;
        let lower = |one: &Path, other: &Path| -> Vec<bool> {
            let pairs = one.balls.iter().zip(&other.balls);
            pairs.map(|(one, other)| one.z <= other.z).collect()
        };
        stands = [lower(right, left), lower(left, right)];
    }
    let [right, left] = [0, 1].map(|side| paths[side].treads(&stands[side]));
    [right, left]
}

/// Where a foot of the actor goes.
struct Path {
    ankles: Vec<Vec3>,
    balls: Vec<Vec3>,
}

impl Path {
    fn of(actor: &Actor<'_>, tips: [Tip; 2]) -> Self {
        let places = actor.frames().map(|stance| {
            let [ankle, ball] = tips.map(|tip| tip.place(&stance));
            (ankle, ball)
        });
        let (ankles, balls) = places.unzip();
        Self { ankles, balls }
    }

    fn lowest(&self) -> f64 {
        let heights = self.balls.iter().map(|ball| ball.z);
        heights.fold(f64::INFINITY, f64::min)
    }

    /// How fast the ball is about a frame.
    fn speed(&self, frame: usize, step: f64) -> f64 {
        let reach = ((0.5 * LOOK / step).round() as usize).max(1);
        let last = self.balls.len().saturating_sub(1);
        let (from, to) = (
            frame.saturating_sub(reach),
            frame.saturating_add(reach).min(last),
        );
        let at = |frame: usize| self.balls.get(frame).copied().unwrap_or_default();
        (at(to) - at(from)).norm() / ((to - from).max(1) as f64 * step)
    }

    /// The half of the time in which its ankle is lowest over its ball, of that in which it stands,
    /// its heel is down.
    fn treads(&self, stands: &[bool]) -> Vec<Tread> {
        let raised = self
            .ankles
            .iter()
            .zip(&self.balls)
            .map(|(ankle, ball)| ankle.z - ball.z);
        let raised: Vec<f64> = raised.collect();
        let standing = raised.iter().zip(stands).filter(|(_, stands)| **stands);
        let mut heights: Vec<f64> = standing.map(|(raised, _)| *raised).collect();
        heights.sort_by(f64::total_cmp);
        let median = heights.get(heights.len() / 2).copied().unwrap_or_default();
        let tread = |(raised, stands): (&f64, &bool)| Tread {
            stands: *stands,
            is_flat: *stands && *raised <= median,
        };
        raised.iter().zip(stands).map(tread).collect()
    }
}

/// The keys of a capture with the feet on the floor; `treads` are those of the right foot and of the
/// left, frame by frame. A capture of few frames a second gets keys between them, for between keys a
/// foot knows nothing of the floor.
///
/// None where the skeleton knows no soles.
pub(super) fn tread_on(
    motion: &Motion,
    skeleton: &Skeleton,
    treads: &[Vec<Tread>; 2],
    step: f64,
) -> Option<Vec<Key>> {
    let feet = ["right_foot", "left_foot"].map(|name| Foot::of(skeleton, name));
    let [Some(right), Some(left)] = feet else {
        return None;
    };
    let parts = ((step / FINE).ceil() as usize).clamp(1, MOST_PARTS);
    let mut keys = finer(motion, parts, step);
    let step = step / parts as f64;
    let feet = [right, left];
    let mut poses: Vec<[Pose; 2]> = Vec::with_capacity(keys.len());
    for key in &keys {
        let stand = skeleton.stand(&key.posture);
        let pose = |foot: &Foot| stand.get(foot.bone).copied().unwrap_or_default();
        poses.push([pose(&feet[0]), pose(&feet[1])]);
    }
    let on_floor = poses.iter().enumerate().map(|(frame, poses)| {
        let both = feet.iter().zip(poses).zip(treads);
        let stands =
            |treads: &Vec<Tread>, frame: usize| treads.get(frame).is_some_and(|tread| tread.stands);
        let (before, after) = (frame / parts, frame.div_ceil(parts));
        let stands = both.filter(|(_, list)| stands(list, before) && stands(list, after));
        stands
            .map(|((foot, pose), _)| lowest(&foot.firm, pose))
            .reduce(f64::min)
    });
    let level = smoothed(&between(&on_floor.collect::<Vec<_>>()), BELL / step);
    for (poses, level) in poses.iter_mut().zip(&level) {
        for pose in poses {
            pose.translation.vector.z -= level;
        }
    }
    let short = poses.iter().map(|poses| {
        let both = feet.iter().zip(poses);
        both.map(|(foot, pose)| -foot.tipped(pose).1)
            .fold(0.0, f64::max)
    });
    let rise = covered(&short.collect::<Vec<_>>(), RISE / step);
    for (frame, (key, poses)) in keys.iter_mut().zip(&mut poses).enumerate() {
        let at = |list: &[f64]| list.get(frame).copied().unwrap_or_default();
        key.posture.root.translation.vector.z += at(&rise) - at(&level);
        for (foot, pose) in feet.iter().zip(poses) {
            pose.translation.vector.z += at(&rise);
            if let Some(joint) = key.posture.joints.get_mut(foot.bone) {
                *joint *= turn(&(foot.axis * foot.tipped(pose).0));
            }
        }
    }
    Some(keys)
}

/// The keys, and so many parts less one between any two.
fn finer(motion: &Motion, parts: usize, step: f64) -> Vec<Key> {
    if parts == 1 {
        return motion.keys().to_vec();
    }
    let last = motion.keys().len().saturating_sub(1);
    let times = (0..=last * parts).map(|key| key as f64 * step / parts as f64);
    let key = |time: f64| Key {
        time,
        posture: motion.at(time),
    };
    times.map(key).collect()
}

impl Foot {
    fn of(skeleton: &Skeleton, name: &str) -> Option<Self> {
        let index = skeleton.bone(name)?;
        let bone = skeleton.bones().get(index)?;
        let own = skeleton.soles().iter().filter(|sole| sole.bone == index);
        let soles: Vec<Sole> = own.copied().collect();
        let along = Vec3::new(bone.vector.x, bone.vector.y, 0.0);
        let is_firm = |sole: &&Sole| sole.at.dot(&along) <= TOES * along.norm_squared();
        let firm: Vec<Sole> = soles.iter().filter(is_firm).copied().collect();
        (!firm.is_empty()).then_some(Self {
            bone: index,
            axis: bone.joint.axes[0],
            soles,
            firm,
        })
    }

    /// How high its lowest point is when it is tipped by an angle [rad] more [cm].
    fn height(&self, pose: &Pose, angle: f64) -> f64 {
        let mut tipped = *pose;
        tipped.rotation *= turn(&(self.axis * angle));
        lowest(&self.soles, &tipped)
    }

    /// The least angle [rad] that takes it out of the floor, or the one that takes it farthest, and how
    /// high its lowest point is then [cm]. Tipped far either way, a foot rises again on its heel's or
    /// its toes' round: so what is nearest is sought from level on.
    fn tipped(&self, pose: &Pose) -> (f64, f64) {
        let mut best = (0.0, self.height(pose, 0.0));
        for degrees in 1..=MOST_TIPPED {
            if best.1 >= 0.0 {
                break;
            }
            for side in [1.0, -1.0] {
                let angle = side * f64::from(degrees).to_radians();
                let height = self.height(pose, angle);
                if height >= 0.0 {
                    let below = side * f64::from(degrees - 1).to_radians();
                    let out = self.just_out(pose, [below, angle]);
                    return (out, self.height(pose, out));
                }
                if height > best.1 {
                    best = (angle, height);
                }
            }
        }
        best
    }

    /// Where between an angle at which it is below the floor and one at which it is not it comes out.
    fn just_out(&self, pose: &Pose, [mut below, mut out]: [f64; 2]) -> f64 {
        for _ in 0..ROUNDS {
            let middle = 0.5 * (below + out);
            if self.height(pose, middle) < 0.0 {
                below = middle;
            } else {
                out = middle;
            }
        }
        out
    }
}

fn lowest(soles: &[Sole], pose: &Pose) -> f64 {
    let heights = soles.iter().map(|sole| {
        let middle = pose.translation.vector + pose.rotation * sole.at;
        middle.z - sole.radius
    });
    heights.fold(f64::INFINITY, f64::min)
}

/// What is known, and straight lines between; before the first and after the last as there.
fn between(known: &[Option<f64>]) -> Vec<f64> {
    let mut filled = Vec::with_capacity(known.len());
    let mut before: Option<(usize, f64)> = None;
    for (frame, value) in known.iter().enumerate() {
        let Some(value) = *value else { continue };
        let (from, start) = before.unwrap_or((0, value));
        let steps = (frame - from).max(1) as f64;
        while filled.len() < frame {
            let part = (filled.len() - from) as f64 / steps;
            filled.push(start + (value - start) * part);
        }
        filled.push(value);
        before = Some((frame, value));
    }
    filled.resize(known.len(), before.map_or(0.0, |(_, value)| value));
    filled
}

/// Means under a bell that is so many frames wide to each side, cut off at the ends.
fn smoothed(list: &[f64], half: f64) -> Vec<f64> {
    let mean = |frame: usize| {
        let (mut sum, mut weights) = (0.0, 0.0);
        for (other, value) in near(list, frame, half) {
            let weight = bell(frame.abs_diff(other) as f64 / half);
            sum += weight * value;
            weights += weight;
        }
        if weights > 0.0 { sum / weights } else { 0.0 }
    };
    (0..list.len()).map(mean).collect()
}

/// The highest of bells that stand on all values, so many frames wide to each side.
fn covered(list: &[f64], half: f64) -> Vec<f64> {
    let highest = |frame: usize| {
        let bells = near(list, frame, half)
            .map(|(other, value)| value * bell(frame.abs_diff(other) as f64 / half));
        bells.fold(0.0, f64::max)
    };
    (0..list.len()).map(highest).collect()
}

fn near(list: &[f64], frame: usize, half: f64) -> impl Iterator<Item = (usize, f64)> {
    let reach = (half.floor() as usize).min(list.len());
    let from = frame.saturating_sub(reach);
    let values = list.iter().copied().enumerate();
    values.skip(from).take(frame + reach + 1 - from)
}

/// 1 in the middle, 0 from 1 on, level at both.
fn bell(off: f64) -> f64 {
    let left = (1.0 - off * off).max(0.0);
    left * left
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::{collection::vec, prelude::*};

    #[test]
    fn between_stances_the_way_is_straight() {
        let known = [None, Some(2.0), None, None, None, Some(4.0), None];
        assert_eq!(between(&known), [2.0, 2.0, 2.5, 3.0, 3.5, 4.0, 4.0]);
        assert_eq!(between(&[None, None]), [0.0, 0.0]);
        assert_eq!(between(&[]), Vec::<f64>::new());
    }

    proptest! {
        #[test]
        fn a_rise_is_never_short_nor_higher_than_needed_anywhere(
            list in vec(0.0..3.0, 1..60), half in 0.3..9.0
        ) {
            let most = list.iter().copied().fold(0.0, f64::max);
            for (rise, needed) in covered(&list, half).iter().zip(&list) {
                prop_assert!(rise >= needed && *rise <= most);
            }
        }

        #[test]
        fn a_slope_is_not_smoothed_away(start in -9.0..9.0, slope in -1.0..1.0, half in 1.0..6.0) {
            let line: Vec<f64> = (0..40).map(|frame| start + slope * f64::from(frame)).collect();
            let smooth = smoothed(&line, half);
            for frame in 6..34 {
                prop_assert!((smooth[frame] - line[frame]).abs() < 1e-9);
            }
        }
    }
}
