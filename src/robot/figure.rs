//! A person's body whole: bones, muscles, and the tape around them.

use super::{
    bones::InvalidPerson,
    bulge::{Bent, Bulge, bulges},
    levels::Levels,
    limbs::{CALF_AT, UPPER_ARM_AT},
    measurements::{Girth, Measurements},
    muscles::{Ball, Builder, Flesh, Muscle, Muscles, Widths, starts},
    tape::Section,
};
use crate::{
    body::{Part, PartError, Shape},
    math::{Pose, Rotation, Vec3},
    skeleton::{Posture, Skeleton},
};

/// The robot: a skeleton, and balls strung on it whose girths are the person's.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    person: Measurements,
    pub(super) levels: Levels,
    skeleton: Skeleton,
    tapes: Vec<Tape>,
    bulges: Vec<Bulge>,
    pub(super) muscles: Muscles,
}

/// Where a girth is taken.
#[derive(Clone, Debug, PartialEq)]
struct Tape {
    girth: Girth,
    muscles: Vec<usize>,
    at: Vec3,
    across: Vec3,
}

/// Sections are widened until the tape reads what was asked to within this [cm] …
const NEAR: f64 = 0.02;
/// … in no more rounds than this, after which the body is refused where it is off by more than …
const ROUNDS: usize = 40;
/// … this [cm].
const FAR: f64 = 1.0;

impl Robot {
    /// Builds a person's body.
    ///
    /// Muscles overlap, so that a tape does not read what each section alone would have: sections
    /// are widened or narrowed until it does.
    ///
    /// # Errors
    /// [`InvalidPerson`] where a measurement is outside its range, lengths do not add up, or no
    /// body has such girths so near each other.
    pub fn new(person: &Measurements) -> Result<Self, InvalidPerson> {
        let skeleton = person.skeleton()?;
        let levels = Levels::of(person)?;
        let mut widths = Widths([1.0; 12]);
        let mut robot = Self::built(person, &levels, &skeleton, &widths);
        for _ in 0..ROUNDS {
            let balls = robot.standing();
            let mut worst: f64 = 0.0;
            for (tape, width) in robot.tapes.iter().zip(&mut widths.0) {
                let (asked, built) = (person.girths.of(tape.girth), tape.around(&balls));
                worst = worst.max((built - asked).abs());
                *width = (*width * asked / built.max(1e-3)).clamp(0.3, 2.0);
            }
            if worst < NEAR {
                return Ok(robot);
            }
            robot = Self::built(person, &levels, &skeleton, &widths);
        }
        robot.accepted()
    }

    /// The body itself, when its girths are not far from those asked for.
    fn accepted(self) -> Result<Self, InvalidPerson> {
        for girth in Girth::ALL {
            let (asked, built) = (self.person.girths.of(girth), self.girth(girth));
            if (built - asked).abs() > FAR {
                return Err(InvalidPerson::Girth {
                    girth,
                    built,
                    asked,
                });
            }
        }
        Ok(self)
    }

    fn built(person: &Measurements, levels: &Levels, skeleton: &Skeleton, widths: &Widths) -> Self {
        let builder = Builder::of(person, levels, skeleton, widths);
        let tapes = Girth::ALL.map(|girth| builder.tape(girth)).to_vec();
        Self {
            person: person.clone(),
            levels: *levels,
            skeleton: skeleton.clone(),
            tapes,
            bulges: bulges(skeleton, &builder.made),
            muscles: builder.made,
        }
    }

    /// The person.
    #[must_use]
    pub fn measurements(&self) -> &Measurements {
        &self.person
    }

    /// The bones.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The balls strung on the bones.
    #[must_use]
    pub fn muscles(&self) -> &[Muscle] {
        &self.muscles.all
    }

    /// What a tape reads around the standing body [cm].
    ///
    /// Arms are left out at the trunk, and of the legs one is measured; at the hips the tops of
    /// the thighs count.
    #[must_use]
    pub fn girth(&self, girth: Girth) -> f64 {
        let found = self.tapes.iter().find(|tape| tape.girth == girth);
        found.map_or(0.0, |tape| tape.around(&self.standing()))
    }

    /// Height at which a girth is taken [cm].
    pub(super) fn height(&self, girth: Girth) -> f64 {
        let found = self.tapes.iter().find(|tape| tape.girth == girth);
        found.map_or(0.0, |tape| tape.at.z)
    }

    /// The muscles in place, in the order of [`muscles`](Self::muscles), when the joints are turned
    /// as in `posture` and the bones are at `frames`, which [`Skeleton::stand`] gives.
    ///
    /// A bone without a frame stays where it is when the person stands.
    #[must_use]
    pub fn balls(&self, posture: &Posture, frames: &[Pose]) -> Vec<Ball> {
        let relaxed = self.muscles.all.iter().map(|muscle| Ball {
            centre: muscle.at,
            radius: muscle.radius,
        });
        let mut balls: Vec<Ball> = relaxed.collect();
        let bent = Bent {
            skeleton: &self.skeleton,
            posture,
        };
        for (muscle, bulged) in self
            .bulges
            .iter()
            .filter_map(|b| b.of(&self.muscles.all, &bent))
        {
            if let Some(ball) = balls.get_mut(muscle) {
                *ball = bulged;
            }
        }
        let standing = self.standing_frames();
        let placed = |bone: usize, at: &Vec3| {
            let frame = frames.get(bone).or(standing.get(bone));
            frame.map_or(*at, |frame| frame.translation.vector + frame.rotation * at)
        };
        for (ball, muscle) in balls.iter_mut().zip(&self.muscles.all) {
            ball.centre = placed(muscle.bone, &ball.centre);
        }
        self.share(&mut balls, placed);
        balls
    }

    /// Moves muscles that go with two bones to between where either alone would have them.
    fn share(&self, balls: &mut [Ball], placed: impl Fn(usize, &Vec3) -> Vec3) {
        let starts = starts(&self.skeleton);
        for shared in &self.muscles.shared {
            let muscle = self.muscles.all.get(shared.muscle);
            let (Some(muscle), Some(ball)) = (muscle, balls.get_mut(shared.muscle)) else {
                continue;
            };
            let start = |bone: usize| starts.get(bone).copied().unwrap_or_default();
            let at = muscle.at + start(muscle.bone) - start(shared.bone);
            let other = placed(shared.bone, &at);
            ball.centre = other + (ball.centre - other) * shared.own;
        }
    }

    /// The muscles in place as parts that cloth meets, named after their bones.
    ///
    /// # Errors
    /// [`PartError`] where a muscle is too small for a part.
    pub fn parts(&self, posture: &Posture, frames: &[Pose]) -> Result<Vec<Part>, PartError> {
        let mut counts = vec![0_usize; self.skeleton.bones().len()];
        let balls = self.balls(posture, frames);
        let placed = balls.iter().zip(&self.muscles.all).map(|(ball, muscle)| {
            let bone = self.skeleton.bones().get(muscle.bone);
            let count = counts.get_mut(muscle.bone).map_or(0, |count| {
                *count += 1;
                *count
            });
            let name = bone.map_or("", |bone| &bone.name);
            let pose = Pose::from_parts(ball.centre.into(), Rotation::identity());
            let shape = Shape::Ball {
                radius: ball.radius,
            };
            Part::new(format!("{name} {count}"), &shape, pose)
        });
        placed.collect()
    }

    /// The bones' frames when the person stands.
    pub(super) fn standing_frames(&self) -> Vec<Pose> {
        let starts = starts(&self.skeleton).into_iter();
        starts
            .map(|start| Pose::from_parts(start.into(), Rotation::identity()))
            .collect()
    }

    /// The muscles of the standing body.
    pub(super) fn standing(&self) -> Vec<Ball> {
        self.balls(&Posture::standing(&self.skeleton), &self.standing_frames())
    }
}

impl Tape {
    /// What it reads around some of these balls [cm].
    fn around(&self, balls: &[Ball]) -> f64 {
        let measured = self.muscles.iter().filter_map(|muscle| balls.get(*muscle));
        Section::of(measured, &self.at, &self.across).girth()
    }
}

impl Builder<'_> {
    /// Where a girth is taken, and around which muscles.
    fn tape(&self, girth: Girth) -> Tape {
        let left = Some(super::bones::Side::Left);
        let along = |bone: &str, share: f64| {
            let (start, vector) = self.line(self.bone(bone));
            (start + vector * share, vector.normalize())
        };
        let level = |height: f64| (Vec3::new(0.0, 0.0, height), Vec3::z());
        let trunk = |girth| level(self.height(girth).unwrap_or_default());
        let group = |flesh: &[Flesh]| self.made.groups(flesh).collect::<Vec<_>>();
        let of_left = |flesh: &[Flesh]| {
            let groups = flesh.iter().map(|flesh| self.made.group(*flesh, left));
            groups.flatten().collect::<Vec<_>>()
        };
        use Flesh::{Breast, Forearm, Neck, Shank, Thigh, Trunk, UpperArm};
        let ((at, across), muscles) = match girth {
            Girth::Neck => (level(self.neck_level()), group(&[Neck])),
            Girth::Bust | Girth::UnderBust | Girth::Waist => {
                (trunk(girth), group(&[Trunk, Breast]))
            }
            Girth::Hip => (trunk(girth), group(&[Trunk, Thigh])),
            Girth::Thigh => (along("left_thigh", self.thigh_at()), of_left(&[Thigh])),
            Girth::Knee => (along("left_shank", 0.0), of_left(&[Thigh, Shank])),
            Girth::Calf => (along("left_shank", CALF_AT), of_left(&[Shank])),
            Girth::Ankle => (along("left_shank", self.ankle_at()), of_left(&[Shank])),
            Girth::UpperArm => (along("left_upper_arm", UPPER_ARM_AT), of_left(&[UpperArm])),
            Girth::Elbow => (along("left_forearm", 0.0), of_left(&[UpperArm, Forearm])),
            Girth::Wrist => (along("left_hand", 0.0), of_left(&[Forearm])),
        };
        Tape {
            girth,
            muscles,
            at,
            across,
        }
    }
}
