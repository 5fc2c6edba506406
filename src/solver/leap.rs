//! Leaps: a cloth far from rest goes the way that the joint system asks for, straight, and then comes
//! back to its own lengths by a few steps with inertia, which take back little of the way but what
//! lengthens it. The energy is compared after that: along the straight way alone it soon rises, since
//! rods that turn by an angle φ are longer by ½·φ².

use super::{
    inertia::Inertia,
    joint::Joint,
    level::Level,
    model::longest,
    rest::{Approach, Run, Standing},
};
use crate::math::Vec3;

/// A leap is at first so many pitches long, and at most so many or so far [cm], whichever is more: a cloth
/// that is cut finer has as far to go from valley to valley.
const FIRST: f64 = 0.5;
const LONGEST: f64 = 2.0;
const LONGEST_WAY: f64 = 2.0;
/// After one that went well, the next may be so many times as long; after one that did not, it is this
/// part of it.
const LONGER: f64 = 1.5;
const SHORTER: f64 = 0.4;
/// Each series of leaps goes no farther at once than this part of the last one's longest, so that the
/// cloth comes to rest in a valley and does not leap to the next for ever.
const CALMER: f64 = 0.25;
/// Shorter leaps than so many pitches are not worth their time.
const SHORTEST: f64 = 0.1;
/// Steps with inertia after a leap.
const RELAXING: usize = 20;
/// Leaps of a series, and how many may fail.
const LEAPS: usize = 10;
const FAILURES: usize = 3;

/// How far leaps are trusted to go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leaps {
    /// The next one [cm].
    next: f64,
    /// The longest of a series [cm].
    longest: f64,
}

impl Leaps {
    /// Of a level on which none was tried. A cloth that follows others' moves shall not leave the folds
    /// that it has, and one on bodies leaps from valley to valley there: both do without.
    pub(super) fn of(level: &Level<'_>, lands: bool) -> Self {
        let pitch = level.lattice.pitch;
        let free = lands && level.bodies.parts().is_empty();
        Self {
            next: FIRST * pitch,
            longest: if free { farthest(pitch) } else { 0.0 },
        }
    }

    /// Whether any leap is worth a try.
    pub(super) fn some(&self, pitch: f64) -> bool {
        self.longest >= SHORTEST * pitch
    }

    /// Learns from a leap of `way` [cm] that went well.
    fn lengthen(&mut self, way: f64) {
        self.next = (LONGER * way).max(self.next).min(self.longest);
    }
}

/// The longest leap [cm] on a lattice of this pitch [cm].
fn farthest(pitch: f64) -> f64 {
    (LONGEST * pitch).max(LONGEST_WAY)
}

impl Run<'_> {
    /// Leaps as long as that lowers the energy and the joint system asks for more than `near` [cm].
    /// Returns whether the cloth has leapt and is still as far from rest, for all that is known.
    pub(super) fn leap(
        &mut self,
        level: &mut Level<'_>,
        joint: &mut Joint,
        approach: &mut Approach,
        near: f64,
        standing: &Standing,
    ) -> bool {
        let leaps = &mut approach.leaps;
        let pitch = level.lattice.pitch;
        let mut leapt = false;
        let mut failures = 0;
        if !leaps.some(pitch) {
            return leapt;
        }
        leaps.next = leaps.next.clamp(SHORTEST * pitch, leaps.longest);
        'series: for _ in 0..LEAPS {
            joint.look(level, pitch);
            let Some(moves) = joint.wish(level, farthest(pitch)) else {
                break;
            };
            if longest(&moves) < near {
                return false;
            }
            while !self.leap_once(level, joint, leaps, &moves, standing) {
                failures += 1;
                if leaps.next < SHORTEST * pitch || failures == FAILURES {
                    break 'series;
                }
            }
            leapt = true;
            approach.inertia.stop(level);
            if self.stopped {
                break;
            }
        }
        leaps.longest *= CALMER;
        leapt
    }

    /// One leap along such moves [cm], and what takes back what it has lengthened. Returns whether the
    /// energy is lower for it; if not, the cloth is where it was.
    fn leap_once(
        &mut self,
        level: &mut Level<'_>,
        joint: &mut Joint,
        leaps: &mut Leaps,
        moves: &[Vec3],
        standing: &Standing,
    ) -> bool {
        let from = level.at.clone();
        let energy = level.energy(&from);
        let asked = longest(moves);
        let way = leaps.next.min(asked);
        level.at = level.freely(|node| moves[node] * (way / asked));
        let mut inertia = Inertia::after(level, way);
        self.glide(level, joint, &mut inertia, standing, RELAXING);
        if level.energy(&level.at) < energy {
            leaps.lengthen(way);
            return true;
        }
        leaps.next = SHORTER * way;
        level.at = from;
        joint.look(level, level.lattice.pitch);
        false
    }
}
