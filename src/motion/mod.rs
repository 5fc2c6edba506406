//! Postures in time: keys that a person wrote, or the capture of an actor mapped onto the bones.
//!
//! A [`Motion`] is a list of [`Key`]s with smooth postures between them. [`Bvh`] reads a file of
//! motion capture; a [`Mapping`] says which of its joints moves which bone, [`retarget`] makes a
//! motion of it, and [`errors`] measures how far that is from what the actor did.

mod between;
mod bvh;
mod capture;
mod compare;
mod floor;
mod mapping;
mod retarget;

pub use bvh::{Bvh, BvhError, BvhJoint, Channel};
pub use compare::{Errors, errors};
pub use mapping::{BONES, MAPPINGS, Mapping, Source};
pub use retarget::{RetargetError, leg, retarget};

use crate::{
    math::{Rotation, Vec3, turned},
    skeleton::{Exceeded, Posture, Skeleton},
};
use between::Span;
use std::collections::BTreeMap;

/// Name and file text of each motion that ships.
pub const MOTIONS: [(&str, &str); 3] = [
    ("walk", include_str!("../../bodies/motions/walk.toml")),
    ("run", include_str!("../../bodies/motions/run.toml")),
    ("jump", include_str!("../../bodies/motions/jump.toml")),
];

/// A posture at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// When [s].
    pub time: f64,
    /// How the person stands then.
    pub posture: Posture,
}

/// Postures in time.
///
/// Between its keys every joint turns, and the root moves, by a cubic that passes through the keys
/// with a continuous (angular) velocity: at a key that of the parabola through it and its two
/// neighbours, at an end that of the way to its neighbour. A constant velocity is kept exactly.
/// Quaternions enter only by the turn from one key to the next, the shorter way, so that `q` and
/// `−q` are the same and no turn flips, however far a joint turns in all; between two neighbours
/// it may turn by less than 180°.
///
/// After M.-J. Kim, M.-S. Kim and S. Y. Shin, *A General Construction Scheme for Unit Quaternion
/// Curves with Simple High Order Derivatives*, SIGGRAPH 1995 (the cumulative cubic).
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    name: String,
    keys: Vec<Key>,
    cycle: Option<Vec3>,
}

/// Keys that are no motion.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvalidMotion {
    /// No keys, or a cycle of one.
    #[error("{found} keys; allowed: 1 or more, in a cycle 2 or more")]
    TooFewKeys {
        /// How many.
        found: usize,
    },
    /// A time, place or turn that is not a number.
    #[error("key {key} has a {what} that is not finite")]
    NotFinite {
        /// Which key, from 1.
        key: usize,
        /// What of it.
        what: &'static str,
    },
    /// A time that is not above the one before.
    #[error("time {time} s of key {key} is not above {before} s, that of the key before")]
    NotRising {
        /// Which key, from 1.
        key: usize,
        /// Its time [s].
        time: f64,
        /// The time before it [s].
        before: f64,
    },
    /// Not one turn for each bone.
    #[error("key {key} turns {found} bones; allowed: {allowed}, one turn for each bone")]
    Bones {
        /// Which key, from 1.
        key: usize,
        /// How many turns it has.
        found: usize,
        /// How many bones the skeleton has.
        allowed: usize,
    },
    /// A cycle whose last key is another than its first.
    #[error("the last key of a cycle must be its first again; {what} is off by {off:.3} {unit}")]
    NotClosed {
        /// The joint, or the root.
        what: String,
        /// By how much.
        off: f64,
        /// Degrees or cm.
        unit: &'static str,
    },
}

/// An angle that a motion takes beyond what anatomy allows.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    /// The angle where it is farthest beyond.
    pub worst: Exceeded,
    /// When that is [s].
    pub time: f64,
    /// The part of the keys at which the angle is beyond its limits, 0 to 1.
    pub share: f64,
}

/// The ends of a cycle may differ by so much: what a file with 3 decimals leaves [rad], [cm].
const CLOSED: f64 = 1e-3;

impl Motion {
    /// Checks keys; a cycle is given by how far each round takes the root [cm].
    ///
    /// The keys of a cycle stand in place: its way is gone steadily and added to them.
    ///
    /// # Errors
    /// [`InvalidMotion`] where times do not rise, a number is not finite, bones are missing or a
    /// cycle does not close.
    pub fn new(
        name: String,
        keys: Vec<Key>,
        cycle: Option<Vec3>,
        skeleton: &Skeleton,
    ) -> Result<Self, InvalidMotion> {
        let found = keys.len();
        if found < 1 + usize::from(cycle.is_some()) {
            return Err(InvalidMotion::TooFewKeys { found });
        }
        for (index, key) in keys.iter().enumerate() {
            check_key(index + 1, key, skeleton)?;
        }
        for (index, pair) in keys.windows(2).enumerate() {
            if let [before, key] = pair
                && key.time <= before.time
            {
                return Err(InvalidMotion::NotRising {
                    key: index + 2,
                    time: key.time,
                    before: before.time,
                });
            }
        }
        let motion = Self { name, keys, cycle };
        if motion.cycle.is_some() {
            motion.check_closed(skeleton)?;
        }
        Ok(motion)
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The same motion by another name.
    #[must_use]
    pub fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    /// Its keys, in the order of time.
    #[must_use]
    pub fn keys(&self) -> &[Key] {
        &self.keys
    }

    /// How far each round takes the root [cm]; none where it ends at its last key.
    #[must_use]
    pub fn travel(&self) -> Option<Vec3> {
        self.cycle
    }

    /// From the first key to the last [s]; 0 for a single key.
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.last_time() - self.first_time()
    }

    /// The posture at a time [s], on the clock of the keys.
    ///
    /// A cycle has one at any time. Otherwise the person stands in the first posture before the
    /// first key, and in the last one after the last.
    #[must_use]
    pub fn at(&self, time: f64) -> Posture {
        let time = if time.is_finite() {
            time
        } else {
            self.first_time()
        };
        let (time, round) = match self.cycle {
            Some(travel) => {
                let rounds = (time - self.first_time()) / self.duration();
                let within = (rounds - rounds.floor()) * self.duration();
                (self.first_time() + within, travel * rounds)
            }
            None => (time, Vec3::zeros()),
        };
        let mut posture = self.within(time);
        posture.root.translation.vector += round;
        posture
    }

    /// Angles beyond what anatomy allows, at the keys: the worst of each, in the order of bones.
    #[must_use]
    pub fn beyond_limits(&self, skeleton: &Skeleton) -> Vec<Beyond> {
        let mut found: BTreeMap<(usize, &str), (Beyond, usize)> = BTreeMap::new();
        for key in &self.keys {
            let turns = skeleton.bones().iter().zip(&key.posture.joints);
            for (index, (bone, turn)) in turns.enumerate().skip(1) {
                for worst in bone.joint.exceeded(bone.joint.angles(turn)) {
                    let (time, share) = (key.time, 0.0);
                    let entry = found.entry((index, worst.angle));
                    let (known, count) = entry.or_insert_with(|| {
                        (
                            Beyond {
                                worst: worst.clone(),
                                time,
                                share,
                            },
                            0,
                        )
                    });
                    *count += 1;
                    if excess(&worst) > excess(&known.worst) {
                        (known.worst, known.time) = (worst, time);
                    }
                }
            }
        }
        let keys = self.keys.len() as f64;
        let shared = |(beyond, count): (Beyond, usize)| Beyond {
            share: count as f64 / keys,
            ..beyond
        };
        found.into_values().map(shared).collect()
    }

    /// The keys from one time to another [s] as a motion that begins at 0 s, the root above where
    /// it stands.
    ///
    /// # Errors
    /// [`InvalidMotion::TooFewKeys`] where no key is between them.
    pub fn cut(&self, from: f64, to: f64, skeleton: &Skeleton) -> Result<Self, InvalidMotion> {
        let within = |key: &&Key| (from..=to).contains(&key.time);
        let mut keys: Vec<Key> = self.keys.iter().filter(within).cloned().collect();
        if let Some(first) = keys.first().cloned() {
            let mut shift = skeleton.base() - first.posture.root.translation.vector;
            shift.z = 0.0;
            for key in &mut keys {
                key.time -= first.time;
                key.posture.root.translation.vector += shift;
            }
        }
        Self::new(self.name.clone(), keys, None, skeleton)
    }

    /// The same motion with every joint turned no farther than anatomy allows, at the keys.
    #[must_use]
    pub fn within_limits(mut self, skeleton: &Skeleton) -> Self {
        for key in &mut self.keys {
            for (bone, turn) in skeleton.bones().iter().zip(&mut key.posture.joints).skip(1) {
                *turn = bone
                    .joint
                    .rotation(bone.joint.within(bone.joint.angles(turn)));
            }
        }
        self
    }

    fn first_time(&self) -> f64 {
        self.keys.first().map_or(0.0, |key| key.time)
    }

    fn last_time(&self) -> f64 {
        self.keys.last().map_or(0.0, |key| key.time)
    }

    /// The posture at a time within one round, its way not counted.
    fn within(&self, time: f64) -> Posture {
        let span = Span::find(&self.keys, time, self.cycle.is_some());
        let root = &span.from().root;
        let mut posture = span.from().clone();
        posture.root.translation.vector = span.place(|posture| posture.root.translation.vector);
        posture.root.rotation = span.turn(|posture| posture.root.rotation, root.rotation);
        for (bone, turn) in posture.joints.iter_mut().enumerate() {
            let of = |posture: &Posture| posture.joints.get(bone).copied().unwrap_or_default();
            *turn = span.turn(of, *turn);
        }
        posture
    }

    fn check_closed(&self, skeleton: &Skeleton) -> Result<(), InvalidMotion> {
        let (Some(first), Some(last)) = (self.keys.first(), self.keys.last()) else {
            return Ok(());
        };
        let (first, last) = (&first.posture, &last.posture);
        let moved = last.root.translation.vector - first.root.translation.vector;
        let open = |what: &str, off: f64, unit| {
            let what = what.to_owned();
            Err(InvalidMotion::NotClosed { what, off, unit })
        };
        if moved.norm() > CLOSED {
            return open("the root's place", moved.norm(), "cm");
        }
        let names = skeleton.bones().iter().map(|bone| bone.joint.name.as_str());
        let turns = first.joints.iter().zip(&last.joints);
        let root = ("the root", (&first.root.rotation, &last.root.rotation));
        for (name, (first, last)) in core::iter::once(root).chain(names.zip(turns)) {
            let off = way(first, last).norm();
            if off > CLOSED {
                return open(name, off.to_degrees(), "degrees");
            }
        }
        Ok(())
    }
}

/// The turn from one rotation to another, in the frame of the first [rad].
fn way(from: &Rotation, to: &Rotation) -> Vec3 {
    turned(&(from.inverse() * to))
}

fn excess(exceeded: &Exceeded) -> f64 {
    (exceeded.value - exceeded.high).max(exceeded.low - exceeded.value)
}

fn check_key(number: usize, key: &Key, skeleton: &Skeleton) -> Result<(), InvalidMotion> {
    let (found, allowed) = (key.posture.joints.len(), skeleton.bones().len());
    if found != allowed {
        return Err(InvalidMotion::Bones {
            key: number,
            found,
            allowed,
        });
    }
    let root = &key.posture.root;
    let turns = key.posture.joints.iter().chain([&root.rotation]);
    let finite = |turn: &Rotation| turn.coords.iter().all(|part| part.is_finite());
    let what = if !key.time.is_finite() {
        "time"
    } else if !root.translation.vector.iter().all(|part| part.is_finite()) {
        "place"
    } else if !turns.into_iter().all(finite) {
        "turn"
    } else {
        return Ok(());
    };
    Err(InvalidMotion::NotFinite { key: number, what })
}

#[cfg(test)]
mod tests;
