//! Muscles: balls strung on bones, as dumplings on a skewer (kushi-dango, B-ii).
//!
//! Limbs are strings of balls, the trunk rows of balls abreast, so that chest and back are flat and
//! the sides round. Which balls are neighbours is kept too: between neighbours there is flesh, which
//! the skin covers.

use super::{
    bones::Side,
    levels::Levels,
    measurements::{Girth, Measurements},
};
use crate::{math::Vec3, skeleton::Skeleton};
use core::ops::Range;

/// A ball of flesh on a bone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Muscle {
    /// The bone that it goes with.
    pub bone: usize,
    /// Its middle [cm], from the bone's joint, in the axes of the standing frame.
    pub at: Vec3,
    /// Its radius at rest [cm].
    pub radius: f64,
}

/// A muscle in place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its middle [cm].
    pub centre: Vec3,
    /// Its radius [cm].
    pub radius: f64,
}

/// What a group of muscles is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flesh {
    Trunk,
    Breast,
    Neck,
    Head,
    /// On the collar bone.
    Shoulder,
    UpperArm,
    Forearm,
    Hand,
    Thigh,
    Shank,
    Foot,
}

/// Muscles that belong together.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Group {
    pub(super) flesh: Flesh,
    /// None for what is in the middle.
    pub(super) side: Option<Side>,
    pub(super) muscles: Range<usize>,
}

/// All muscles of a body, and which are neighbours.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Muscles {
    pub(super) all: Vec<Muscle>,
    pub(super) groups: Vec<Group>,
    /// Those that go with two bones.
    pub(super) shared: Vec<Shared>,
    /// Two neighbours (the second twice) or three, and the limb that they are of, one that blends
    /// into the others.
    pub(super) links: Vec<Link>,
}

/// A muscle that lies between its own bone and another, and stretches when they part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shared {
    pub(super) muscle: usize,
    /// The other bone.
    pub(super) bone: usize,
    /// How much it goes with its own bone, 0 to 1.
    pub(super) own: f64,
}

/// Neighbours, with flesh between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Two muscles, or three.
    pub(super) ends: [usize; 3],
    pub(super) limb: Limb,
}

/// Flesh that is smooth in itself, and blends into other such.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Limb {
    Trunk,
    RightBreast,
    LeftBreast,
    Head,
    RightArm,
    LeftArm,
    RightLeg,
    LeftLeg,
}

/// How much wider than asked each section is made, so that the tape reads what was asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Widths(pub(super) [f64; 12]);

impl Widths {
    pub(super) fn of(&self, girth: Girth) -> f64 {
        let index = Girth::ALL.iter().position(|other| *other == girth);
        index
            .and_then(|index| self.0.get(index))
            .copied()
            .unwrap_or(1.0)
    }
}

/// A body as its muscles are laid on, in the standing frame.
pub(super) struct Builder<'a> {
    pub(super) person: &'a Measurements,
    pub(super) levels: &'a Levels,
    widths: &'a Widths,
    skeleton: &'a Skeleton,
    starts: Vec<Vec3>,
    pub(super) made: Muscles,
}

impl Muscles {
    /// The muscles of a group.
    pub(super) fn group(&self, flesh: Flesh, side: Option<Side>) -> Range<usize> {
        let is = |group: &&Group| group.flesh == flesh && group.side == side;
        let found = self.groups.iter().find(is);
        found.map_or(0..0, |group| group.muscles.clone())
    }

    /// The muscles of both sides and of the middle.
    pub(super) fn groups(&self, kinds: &[Flesh]) -> impl Iterator<Item = usize> {
        let of_kind = move |group: &&Group| kinds.contains(&group.flesh);
        self.groups
            .iter()
            .filter(of_kind)
            .flat_map(|group| group.muscles.clone())
    }
}

impl<'a> Builder<'a> {
    /// Lays on all muscles of a person.
    pub(super) fn of(
        person: &'a Measurements,
        levels: &'a Levels,
        skeleton: &'a Skeleton,
        widths: &'a Widths,
    ) -> Self {
        let mut builder = Self {
            person,
            levels,
            widths,
            skeleton,
            starts: starts(skeleton),
            made: Muscles::default(),
        };
        builder.trunk();
        builder.neck_and_head();
        for side in [Side::Right, Side::Left] {
            builder.breast(side);
            builder.arm(side);
            builder.leg(side);
        }
        builder
    }

    /// A girth as asked, times how much wider its section is made, over 2π [cm].
    pub(super) fn radius(&self, girth: Girth) -> f64 {
        self.girth(girth) / (2.0 * core::f64::consts::PI)
    }

    /// A girth as asked, times how much wider its section is made [cm].
    pub(super) fn girth(&self, girth: Girth) -> f64 {
        self.person.girths.of(girth) * self.width(girth)
    }

    /// How much wider than asked a section is made.
    pub(super) fn width(&self, girth: Girth) -> f64 {
        self.widths.of(girth)
    }

    /// Lays a ball on a bone; its number.
    pub(super) fn ball(&mut self, bone: usize, centre: Vec3, radius: f64) -> usize {
        let start = self.starts.get(bone).copied().unwrap_or_default();
        self.made.all.push(Muscle {
            bone,
            at: centre - start,
            radius,
        });
        self.made.all.len() - 1
    }

    /// A ball that was laid, in the standing frame.
    pub(super) fn laid(&self, ball: usize) -> Ball {
        let muscle = self.made.all.get(ball).copied();
        let (at, radius) = muscle.map_or((Vec3::zeros(), 0.0), |muscle| (muscle.at, muscle.radius));
        let start = muscle
            .and_then(|muscle| self.starts.get(muscle.bone))
            .copied();
        Ball {
            centre: start.unwrap_or_default() + at,
            radius,
        }
    }

    /// Marks what was laid since as one group.
    pub(super) fn group(&mut self, flesh: Flesh, side: Option<Side>, since: usize) {
        let muscles = since..self.made.all.len();
        self.made.groups.push(Group {
            flesh,
            side,
            muscles,
        });
    }

    /// How many there are already.
    pub(super) fn count(&self) -> usize {
        self.made.all.len()
    }

    /// A bone by its name; the first, where there is none of that name.
    pub(super) fn bone(&self, name: &str) -> usize {
        self.skeleton.bone(name).unwrap_or(0)
    }

    /// Where a bone begins and its vector [cm].
    pub(super) fn line(&self, bone: usize) -> (Vec3, Vec3) {
        let start = self.starts.get(bone).copied().unwrap_or_default();
        let vector = self
            .skeleton
            .bones()
            .get(bone)
            .map_or_else(Vec3::zeros, |bone| bone.vector);
        (start, vector)
    }

    /// Makes neighbours of each ball and the next.
    pub(super) fn string(&mut self, limb: Limb, balls: &[usize]) {
        for pair in balls.windows(2) {
            if let &[one, next] = pair {
                let ends = [one, next, next];
                self.made.links.push(Link { ends, limb });
            }
        }
    }

    /// Makes neighbours of the balls of two rows of one length, and of each and the next in its row.
    pub(super) fn web(&mut self, limb: Limb, row: &[usize], next: &[usize]) {
        for (pair, beyond) in row.windows(2).zip(next.windows(2)) {
            if let (&[a, b], &[c, d]) = (pair, beyond) {
                for ends in [[a, b, d], [a, d, c]] {
                    let [p, q, r] = ends;
                    if p != q && q != r && r != p {
                        self.made.links.push(Link { ends, limb });
                    }
                }
            }
        }
    }
}

/// Where every bone begins when the person stands [cm].
pub(super) fn starts(skeleton: &Skeleton) -> Vec<Vec3> {
    let mut starts: Vec<Vec3> = Vec::new();
    for bone in skeleton.bones() {
        let parent = bone.parent.and_then(|parent| {
            let start = starts.get(parent)?;
            let vector = skeleton.bones().get(parent)?.vector;
            Some(if bone.at_base { *start } else { start + vector })
        });
        starts.push(parent.unwrap_or(skeleton.base()));
    }
    starts
}
