//! Who moves how.

use crate::{
    body::{Bodies, Part, PartError},
    math::{Pose, Vec3},
    motion::{InvalidMotion, Key, Motion},
    robot::{Ball, Robot},
    skeleton::Posture,
};

/// How long all take from where the cloth is laid on to where their motions begin [s].
pub const ENTRANCE: f64 = 1.0;
/// From one station to the next no muscle near the cloth moves by more than this against the rest of
/// the body [cm]: a third of a thin arm's radius, so that the cloth is pushed along before any of it
/// could be on the other side.
const STATION: f64 = 1.0;
/// What is farther away from the cloth's box than this [cm] when a way begins is not near it.
const NEAR: f64 = 5.0;
/// Looks at a way between two stations: the arc of a limb is longer than its chord.
const LOOKS: usize = 8;

/// A robot that plays a motion.
#[derive(Clone, Debug)]
pub struct Actor {
    name: String,
    robot: Robot,
    place: Pose,
    start: Posture,
    motion: Option<Motion>,
    entrance: Option<Motion>,
}

impl Actor {
    /// A robot in its place [cm], standing as the cloth is laid on, and what it does then.
    ///
    /// # Errors
    /// [`InvalidMotion`] where the motion is another skeleton's.
    pub fn new(
        name: String,
        robot: Robot,
        place: Pose,
        start: Posture,
        motion: Option<Motion>,
    ) -> Result<Self, InvalidMotion> {
        let key = |time, posture| Key { time, posture };
        let goes_over = |motion: &Motion| {
            let keys = vec![key(0.0, start.clone()), key(ENTRANCE, motion.at(0.0))];
            Motion::new(name.clone(), keys, None, robot.skeleton())
        };
        let entrance = motion.as_ref().map(goes_over).transpose()?;
        Ok(Self {
            name,
            robot,
            place,
            start,
            motion,
            entrance,
        })
    }

    /// The robot.
    #[must_use]
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// How it stands at a time [s].
    #[must_use]
    pub fn posture(&self, time: f64) -> Posture {
        match (&self.motion, &self.entrance) {
            (Some(motion), _) if time >= 0.0 => motion.at(time),
            (_, Some(entrance)) => entrance.at((time + ENTRANCE).max(0.0)),
            _ => self.start.clone(),
        }
    }

    /// Where its bones are at a time [s], each at its joint.
    #[must_use]
    pub fn frames(&self, time: f64) -> Vec<Pose> {
        let frames = self.robot.skeleton().stand(&self.posture(time));
        frames.into_iter().map(|frame| self.place * frame).collect()
    }

    /// Its muscles at a time [s].
    #[must_use]
    pub fn balls(&self, time: f64) -> Vec<Ball> {
        self.robot.balls(&self.posture(time), &self.frames(time))
    }

    fn parts(&self, time: f64) -> Result<Vec<Part>, PartError> {
        let parts = self.robot.parts(&self.posture(time), &self.frames(time))?;
        let named = parts.into_iter().map(|part| {
            let name = format!("{}, {}", self.name, part.name());
            part.named(name)
        });
        Ok(named.collect())
    }
}

/// One of a cast.
#[derive(Clone, Debug)]
pub enum Member {
    /// A thing that stays where it is.
    Still(Part),
    /// Someone who moves.
    Actor(Box<Actor>),
}

/// Everyone and everything that cloth may meet, in the scene's order.
#[derive(Clone, Debug, Default)]
pub struct Cast {
    /// The members.
    pub members: Vec<Member>,
}

impl Cast {
    /// Those who move.
    pub fn actors(&self) -> impl Iterator<Item = &Actor> {
        self.members.iter().filter_map(|member| match member {
            Member::Still(_) => None,
            Member::Actor(actor) => Some(&**actor),
        })
    }

    /// Whether anyone has a motion to play.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.actors().any(|actor| actor.motion.is_some())
    }

    /// All bodies at a time [s]: always the same parts in the same order.
    ///
    /// # Errors
    /// [`PartError`] where a muscle is too small for a part.
    pub fn bodies(&self, time: f64) -> Result<Bodies, PartError> {
        let mut parts = Vec::new();
        for member in &self.members {
            match member {
                Member::Still(part) => parts.push(part.clone()),
                Member::Actor(actor) => parts.extend(actor.parts(time)?),
            }
        }
        Ok(Bodies::new(parts))
    }

    /// The bodies between two times [s], at stations so close together that a cloth at these places
    /// [cm] is not passed through; neither end is among them.
    ///
    /// # Errors
    /// [`PartError`], as [`bodies`](Self::bodies).
    pub fn between(&self, from: f64, to: f64, cloth: &[Vec3]) -> Result<Vec<Bodies>, PartError> {
        let steps = self.stations(from, to, cloth, Against::Middle);
        let time = |k: usize| from + (to - from) * (k as f64 / steps as f64);
        (1..steps).map(|k| self.bodies(time(k))).collect()
    }

    /// How many steps from one time to another [s] are short enough for a cloth at these places [cm].
    pub(super) fn stations(&self, from: f64, to: f64, cloth: &[Vec3], against: Against) -> usize {
        let low = cloth
            .iter()
            .fold(Vec3::repeat(f64::INFINITY), |low, at| low.inf(at));
        let high = cloth
            .iter()
            .fold(Vec3::repeat(f64::NEG_INFINITY), |high, at| high.sup(at));
        let is_near = |ball: &Ball| {
            let reach = Vec3::repeat(ball.radius + NEAR);
            ball.centre >= low - reach && ball.centre <= high + reach
        };
        let ways = self
            .actors()
            .map(|actor| longest_way(actor, [from, to], against, is_near));
        (ways.fold(0.0, f64::max) / STATION).ceil().max(1.0) as usize
    }
}

/// What a muscle's way is measured against.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Against {
    /// The middle of all muscles, which takes along a cloth that is at rest on them.
    Middle,
    /// The ground, for a cloth that nothing takes along but what touches it.
    Ground,
}

/// How far the farthest muscle that counts goes between two times [cm].
fn longest_way(
    actor: &Actor,
    [from, to]: [f64; 2],
    against: Against,
    counts: impl Fn(&Ball) -> bool,
) -> f64 {
    let look = |k: usize| actor.balls(from + (to - from) * (k as f64 / LOOKS as f64));
    let mut before = look(0);
    let counts: Vec<bool> = before.iter().map(counts).collect();
    let mut ways = vec![0.0; before.len()];
    for k in 1..=LOOKS {
        let now = look(k);
        let common = match against {
            Against::Middle => middle(&now) - middle(&before),
            Against::Ground => Vec3::zeros(),
        };
        for (way, (now, before)) in ways.iter_mut().zip(now.iter().zip(&before)) {
            *way += (now.centre - before.centre - common).norm();
        }
        before = now;
    }
    let counted = ways.into_iter().zip(counts).filter(|(_, counts)| *counts);
    counted.map(|(way, _)| way).fold(0.0, f64::max)
}

fn middle(balls: &[Ball]) -> Vec3 {
    let sum: Vec3 = balls.iter().map(|ball| ball.centre).sum();
    sum / balls.len().max(1) as f64
}
