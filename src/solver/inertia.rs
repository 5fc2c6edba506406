//! Sweeps with inertia: each starts where the cloth would be if it went on as it went, so that what
//! is far from rest travels a whole cloth in some hundred sweeps (Nesterov 1983).
//!
//! A cloth that has begun to climb is stopped and starts anew (O'Donoghue & Candès 2015).

use super::{
    level::Level,
    rest::{Run, Standing},
};
use crate::{math::Vec3, threads};

/// Sweeps between two looks at the bodies.
const LOOKED_EVERY: usize = 10;
/// Most sweeps before the first joint step of a level, of the finest, and between two of them.
pub(super) const FIRST: usize = 300;
pub(super) const FIRST_ON_FINEST: usize = 1500;
pub(super) const BETWEEN: usize = 150;
/// The cloth has settled when sweeps move no node by more than this part of a pitch.
const SETTLED: f64 = 1e-4;
/// Touches farther away than so many moves of the last sweep are not felt in the next.
const AWAKE: f64 = 2.0;
/// A sweep that moves a node by more than this part of a pitch goes on too fast.
const TOO_FAST: f64 = 0.3;

impl Run<'_> {
    /// Brings a level nearer to rest by so many sweeps at most. Returns whether it has settled.
    pub(super) fn glide(
        &mut self,
        level: &mut Level<'_>,
        number: usize,
        standing: &Standing,
        most: usize,
    ) -> bool {
        let pitch = level.lattice.pitch;
        let mut before = level.at.clone();
        let mut run = 0;
        let (mut fastest, mut last) = (pitch, pitch);
        for sweep in 0..most {
            if sweep % LOOKED_EVERY == 0 {
                if fastest < SETTLED * pitch {
                    return true;
                }
                if !self.goes_on(level, number, standing) {
                    return false;
                }
                let way = (2.0 * LOOKED_EVERY as f64 * fastest).clamp(0.005 * pitch, 0.8 * pitch);
                level.look(way, way);
                fastest = 0.0;
            }
            let from = level.at.clone();
            let inertia = run as f64 / (run as f64 + 3.0);
            if run > 0 {
                level.at = level.freely(|node| {
                    // Friction takes up what goes on by itself.
                    let part = if level.touches.rubs(node) {
                        0.0
                    } else {
                        inertia
                    };
                    (from[node] - before[node]) * part
                });
            }
            level.touches.wake(&level.at, AWAKE * last);
            let begun = level.at.clone();
            level.sweep();
            let (longest, climbs) = judge(&from, &begun, &level.at);
            run = if climbs || longest > TOO_FAST * pitch {
                0
            } else {
                run + 1
            };
            fastest = f64::max(fastest, longest);
            last = longest;
            before = from;
        }
        false
    }
}

/// The longest move of a sweep [cm], and whether the sweep itself went against what went before.
fn judge(from: &[Vec3], begun: &[Vec3], to: &[Vec3]) -> (f64, bool) {
    let against = threads::sum(to.len(), |node| {
        (begun[node] - to[node]).dot(&(to[node] - from[node]))
    });
    let moves = to.iter().zip(from).map(|(to, from)| (to - from).norm());
    (moves.fold(0.0, f64::max), against > 0.0)
}
