//! How far our bones are from where the actor's were.

use super::{
    Bvh, Mapping, Motion, RetargetError,
    capture::{Actor, Stance},
    retarget::{Follower, Joints, Tip, leg},
};
use crate::{
    math::{Pose, Vec3},
    skeleton::{Posture, Skeleton},
};

/// Mean distances over all frames and both sides, as parts of our stature: the height of the
/// highest bone when standing.
///
/// `hands` and `feet` compare a wrist's and an ankle's place against the middle of the hips, the
/// actor scaled as a whole: our length of leg and trunk, hip to ankle and hips to shoulders, over
/// his. They hold what the actor is built otherwise than we are. `arms` and `legs` compare a
/// wrist's place against its shoulder and an ankle's against its hip, the actor's arm and leg each
/// scaled to ours: what is left is how the limb points and bends. Where the root is in space is
/// not compared: it is the actor's, scaled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Wrists, from the hips.
    pub hands: f64,
    /// Ankles, from the hips.
    pub feet: f64,
    /// Wrists, from their shoulders.
    pub arms: f64,
    /// Ankles, from their hips.
    pub legs: f64,
}

/// Compares a capture with what [`retarget`](super::retarget()) made of it, frame by frame.
///
/// # Errors
/// [`RetargetError`] where mapping, capture and skeleton do not belong together, or arms are
/// missing.
pub fn errors(
    source: &Bvh,
    mapping: &Mapping,
    skeleton: &Skeleton,
    motion: &Motion,
) -> Result<Errors, RetargetError> {
    let actor = Actor::find(source, mapping)?;
    let follower = Follower::new(&actor, source, mapping, skeleton)?;
    let unturned = actor.unturned();
    let standing = skeleton.stand(&Posture::standing(skeleton));
    let limbs = Limbs::find(&actor, source, mapping, skeleton, &follower)?;
    let scales = limbs.scales(&unturned, &standing, skeleton, &follower)?;
    let bones = skeleton.bones().iter().zip(&standing);
    let ends = bones.map(|(bone, pose)| bone.end(pose).z);
    let stature = ends.fold(f64::MIN_POSITIVE, f64::max);
    let mut sum = [0.0; 4];
    let mut count = 0.0;
    for (frame, stance) in actor.frames().enumerate() {
        let posture = motion.at(frame as f64 * source.frame_time);
        let poses = skeleton.stand(&posture);
        let hips = [follower.hips(&stance), posture.root.translation.vector];
        for side in 0..2 {
            for (sum, off) in sum
                .iter_mut()
                .zip(limbs.off(side, &stance, &poses, hips, scales))
            {
                *sum += off;
            }
            count += 1.0;
        }
    }
    let [hands, feet, arms, legs] = sum.map(|sum| sum / count / stature);
    Ok(Errors {
        hands,
        feet,
        arms,
        legs,
    })
}

/// Shoulder, elbow and wrist, hip, knee and ankle: the actor's points, and the bones that start there.
struct Limbs {
    arms: [[(Tip, usize); 3]; 2],
    legs: [[(Tip, usize); 3]; 2],
}

/// Our length over the actor's [cm per unit].
#[derive(Clone, Copy)]
struct Scales {
    whole: f64,
    arms: f64,
    legs: f64,
}

impl Limbs {
    fn find(
        actor: &Actor<'_>,
        source: &Bvh,
        mapping: &Mapping,
        skeleton: &Skeleton,
        follower: &Follower,
    ) -> Result<Self, RetargetError> {
        let joints = Joints {
            actor,
            source,
            mapping,
        };
        let ours = |bone: &'static str| {
            let found = skeleton.bone(bone);
            found.ok_or(RetargetError::NoBone { bone })
        };
        let arm = |upper, fore, hand| {
            let start =
                |bone: &'static str| joints.start(bone).ok_or(RetargetError::NotMapped { bone });
            let wrist = joints
                .tip(fore)
                .ok_or(RetargetError::NoLength { limb: "arm" })?;
            Ok::<_, RetargetError>([
                (start(upper)?, ours(upper)?),
                (start(fore)?, ours(fore)?),
                (wrist, ours(hand)?),
            ])
        };
        let leg = |tips: [Tip; 3], bones: [&'static str; 3]| {
            let ([hip, knee, ankle], [thigh, shank, foot]) = (tips, bones);
            Ok::<_, RetargetError>([
                (hip, ours(thigh)?),
                (knee, ours(shank)?),
                (ankle, ours(foot)?),
            ])
        };
        let [right, left] = follower.legs();
        Ok(Self {
            arms: [
                arm("right_upper_arm", "right_forearm", "right_hand")?,
                arm("left_upper_arm", "left_forearm", "left_hand")?,
            ],
            legs: [
                leg(right, ["right_thigh", "right_shank", "right_foot"])?,
                leg(left, ["left_thigh", "left_shank", "left_foot"])?,
            ],
        })
    }

    fn scales(
        &self,
        actor: &Stance,
        ours: &[Pose],
        skeleton: &Skeleton,
        follower: &Follower,
    ) -> Result<Scales, RetargetError> {
        let [[right, ..], [left, ..]] = self.arms;
        let shoulders = (right.0.place(actor) + left.0.place(actor)) / 2.0;
        let trunk = (shoulders - follower.hips(actor)).norm();
        let own_shoulders = (start_of(right.1, ours) + start_of(left.1, ours)) / 2.0;
        let own_trunk = (own_shoulders - skeleton.base()).norm();
        let length = |places: [Vec3; 3]| {
            let [first, middle, last] = places;
            (middle - first).norm() + (last - middle).norm()
        };
        let arm: f64 = self
            .arms
            .map(|arm| length(arm.map(|(tip, _)| tip.place(actor))))
            .iter()
            .sum();
        let own_arm: f64 = self
            .arms
            .map(|arm| length(arm.map(|(_, bone)| start_of(bone, ours))))
            .iter()
            .sum();
        if arm <= 0.0 {
            return Err(RetargetError::NoLength { limb: "arm" });
        }
        let (leg, own_leg) = (follower.actor_leg(actor)?, leg(skeleton)?);
        Ok(Scales {
            whole: (own_leg + own_trunk) / (leg + trunk),
            arms: own_arm / arm,
            legs: own_leg / leg,
        })
    }

    /// Distances of a side's wrist and ankle, as in [`Errors`] [cm].
    fn off(
        &self,
        side: usize,
        stance: &Stance,
        poses: &[Pose],
        hips: [Vec3; 2],
        scales: Scales,
    ) -> [f64; 4] {
        let limb = |limb: &[[(Tip, usize); 3]; 2], scale: f64| {
            let [(root, bone), _, (tip, end)] = limb[side];
            let (theirs, ours) = (tip.place(stance), start_of(end, poses));
            let whole = (theirs - hips[0]) * scales.whole - (ours - hips[1]);
            let own = (theirs - root.place(stance)) * scale - (ours - start_of(bone, poses));
            [whole.norm(), own.norm()]
        };
        let [hands, arms] = limb(&self.arms, scales.arms);
        let [feet, legs] = limb(&self.legs, scales.legs);
        [hands, feet, arms, legs]
    }
}

fn start_of(bone: usize, poses: &[Pose]) -> Vec3 {
    poses
        .get(bone)
        .map_or(Vec3::zeros(), |pose| pose.translation.vector)
}
