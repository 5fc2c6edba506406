//! One frame after the other.

use super::{Cast, ENTRANCE, Pace};
use crate::{
    body::PartError,
    contact::Footing,
    math::Vec3,
    solver::{Problem, Progress, Settings, Settled, Unsolvable, go_on, settle},
};

/// Which moments of a motion are wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// How many.
    pub count: usize,
    /// How many in a second [1/s].
    pub rate: f64,
    /// How a cloth with inertia goes from one to the next; `None` where each is at rest.
    pub pace: Option<Pace>,
}

impl Frames {
    /// When a frame is, from 0 on [s].
    #[must_use]
    pub fn time(&self, frame: usize) -> f64 {
        frame as f64 / self.rate
    }
}

/// A frame that cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unplayable {
    /// The cloth cannot start or go on.
    #[error(transparent)]
    Unsolvable(#[from] Unsolvable),
    /// A body cannot be built.
    #[error(transparent)]
    Part(#[from] PartError),
}

/// Lays the cloth on, before anyone moves.
///
/// # Errors
/// [`Unplayable`] where no start can be made.
pub fn dress(
    problem: &Problem,
    cast: &Cast,
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unplayable> {
    let problem = Problem {
        bodies: cast.bodies(-ENTRANCE)?,
        ..problem.clone()
    };
    Ok(settle(&problem, settings, watch)?)
}

/// The drape at a time [s], gone on from one at an earlier time: where its nodes were [cm], and where
/// friction held on.
///
/// # Errors
/// [`Unplayable`] where the cloth or the cast is another.
pub fn next(
    problem: &Problem,
    cast: &Cast,
    [from, to]: [f64; 2],
    before: (&[Vec3], &Footing),
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unplayable> {
    let problem = Problem {
        bodies: cast.bodies(to)?,
        ..problem.clone()
    };
    let through = cast.between(from, to, before.0)?;
    Ok(go_on(&problem, &through, before, settings, watch)?)
}
