//! Arms and legs as strings of balls along their bones, as thick as their girths at some places and
//! smoothly between them.

use super::{
    bones::Side,
    measurements::Girth,
    muscles::{Builder, Flesh, Limb, Shared},
    profile::Profile,
};
use crate::math::Vec3;

/// Where along the bone a limb's girth is taken, from its joint (0) to its end (1).
pub(super) const UPPER_ARM_AT: f64 = 0.5;
pub(super) const CALF_AT: f64 = 0.28;
/// The thigh is measured this much of the stature below the crotch …
const BELOW_CROTCH: f64 = 0.02;
/// … and the ankle this much above its joint.
const ABOVE_ANKLE: f64 = 0.03;

/// Deepest dent between balls of a limb [cm].
const DENT: f64 = 0.15;

/// Widths of a limb along a bone (0 to 1): radius, and how far inward the balls stand off the bone
/// [cm].
struct Limbs {
    radius: Profile,
    inward: Profile,
}

impl Builder<'_> {
    /// Where along the thigh its girth is taken.
    pub(super) fn thigh_at(&self) -> f64 {
        let levels = self.levels;
        let below = levels.hip_joint - levels.crotch + BELOW_CROTCH * levels.stature;
        (below / levels.thigh).clamp(0.1, 0.9)
    }

    /// Where along the shank the girth above the ankle is taken.
    pub(super) fn ankle_at(&self) -> f64 {
        (1.0 - ABOVE_ANKLE * self.levels.stature / self.levels.shank).clamp(0.5, 0.95)
    }

    pub(super) fn arm(&mut self, side: Side) {
        let limb = match side {
            Side::Right => Limb::RightArm,
            Side::Left => Limb::LeftArm,
        };
        let shoulder = self.shoulder(side, limb);
        let [arm, elbow, wrist] =
            [Girth::UpperArm, Girth::Elbow, Girth::Wrist].map(|girth| self.radius(girth));
        let tip = self.tip();
        let upper_arm = straight(&[
            (0.0, tip),
            (0.18, (1.04 * arm).max(tip)),
            (UPPER_ARM_AT, arm),
            (1.0, elbow),
        ]);
        let upper_arm = self.strung(Flesh::UpperArm, "upper_arm", side, &upper_arm, limb);
        let forearm = straight(&[
            (0.0, elbow),
            (0.2, 0.5 * (1.02 * elbow + elbow.max(wrist))),
            (1.0, wrist),
        ]);
        let forearm = self.strung(Flesh::Forearm, "forearm", side, &forearm, limb);
        self.join(limb, &shoulder, &upper_arm);
        self.join(limb, &upper_arm, &forearm);
        self.hand(side, limb, forearm.last().copied());
    }

    /// From the neck down to the tip of the shoulder, on the collar bone.
    fn shoulder(&mut self, side: Side, limb: Limb) -> Vec<usize> {
        let since = self.count();
        let (bone, stature) = (self.bone(&side.of("clavicle")), self.levels.stature);
        let (start, vector) = self.line(bone);
        let tip = self.tip();
        let balls: Vec<usize> = [0.25, 0.44, 0.63, 0.82, 1.0]
            .into_iter()
            .map(|along| {
                let near = 1.0 - along;
                let centre = start + vector * along + Vec3::new(0.0, 0.006 * stature * near, 0.0);
                self.ball(bone, centre, tip + 0.0145 * stature * near)
            })
            .collect();
        self.string(limb, &balls);
        // On the ribs, hidden while the arm hangs; from it skin goes up with a raised arm.
        let inward = side.vector(Vec3::new(-0.028, 0.0, -0.04)) * stature;
        let ribs = self.bone("thorax");
        let armpit = self.ball(ribs, start + vector + inward, 0.03 * stature);
        if let Some(&tip) = balls.last() {
            let between = self.between(ribs, tip, armpit);
            self.string(limb, &[tip, between, armpit]);
        }
        for &ball in balls.iter().skip(2) {
            self.stretch(armpit, ball, bone, ribs);
        }
        self.group(Flesh::Shoulder, Some(side), since);
        balls
    }

    /// Balls from the ribs to one of the shoulder's, close together while the arm hangs; they part as
    /// it is raised, and no gap is left below it.
    fn stretch(&mut self, armpit: usize, shoulder: usize, bone: usize, ribs: usize) {
        let [from, to] = [armpit, shoulder].map(|ball| self.laid(ball));
        for own in [0.2, 0.4, 0.6, 0.8] {
            let centre = from.centre + (to.centre - from.centre) * own;
            let radius = from.radius + (to.radius - from.radius) * own;
            let muscle = self.ball(bone, centre, radius);
            let bone = ribs;
            self.made.shared.push(Shared { muscle, bone, own });
        }
    }

    /// The ball of the shoulder joint passes through the tip of the shoulder.
    fn tip(&self) -> f64 {
        let across = 0.01 * self.levels.stature;
        libm::hypot(across, self.levels.acromion - self.levels.shoulder)
    }

    pub(super) fn leg(&mut self, side: Side) {
        let limb = match side {
            Side::Right => Limb::RightLeg,
            Side::Left => Limb::LeftLeg,
        };
        let [thigh, knee, calf, ankle] =
            [Girth::Thigh, Girth::Knee, Girth::Calf, Girth::Ankle].map(|girth| self.radius(girth));
        let half_hip = 0.5 * self.person.hip_width;
        let hip_joint = self.line(self.bone("left_thigh")).0.x;
        // Not wider than the hips, of which the thighs are part.
        let top = thigh.min(half_hip - hip_joint).max(0.8 * thigh);
        let at = self.thigh_at();
        let (_, vector) = self.line(self.bone("left_thigh"));
        let reach = hip_joint + at * vector.x + thigh - half_hip;
        let inward = reach.clamp(0.0, 0.1 * thigh);
        let upper = Limbs {
            radius: Profile::new(&[(0.0, top), (at, thigh), (1.0, knee)]),
            inward: Profile::new(&[(0.0, 0.0), (at, inward), (1.0, 0.0)]),
        };
        let upper = self.strung(Flesh::Thigh, "thigh", side, &upper, limb);
        let lower = straight(&[
            (0.0, knee),
            (CALF_AT, calf),
            (self.ankle_at(), ankle),
            (1.0, 1.06 * ankle),
        ]);
        let lower = self.strung(Flesh::Shank, "shank", side, &lower, limb);
        self.join(limb, &upper, &lower);
        self.foot(side, limb, lower.last().copied());
    }

    /// Balls along a bone, from its joint to its end, so close that dents are shallow.
    fn strung(
        &mut self,
        flesh: Flesh,
        name: &str,
        side: Side,
        widths: &Limbs,
        limb: Limb,
    ) -> Vec<usize> {
        let since = self.count();
        let bone = self.bone(&side.of(name));
        let (start, vector) = self.line(bone);
        let length = vector.norm();
        let balls: Vec<usize> = widths
            .radius
            .divided(|radius| (8.0 * DENT * radius).sqrt() / length)
            .into_iter()
            .map(|along| {
                let inward = side.vector(Vec3::new(-widths.inward.at(along), 0.0, 0.0));
                let centre = start + vector * along + inward;
                self.ball(bone, centre, widths.radius.at(along))
            })
            .collect();
        self.string(limb, &balls);
        self.group(flesh, Some(side), since);
        balls
    }

    /// Makes neighbours of the last ball of a string and the first of the next.
    fn join(&mut self, limb: Limb, string: &[usize], next: &[usize]) {
        if let (Some(&last), Some(&first)) = (string.last(), next.first()) {
            self.string(limb, &[last, first]);
        }
    }
}

fn straight(radii: &[(f64, f64)]) -> Limbs {
    Limbs {
        radius: Profile::new(radii),
        inward: Profile::new(&[]),
    }
}
