//! One frame after the other of a cloth with inertia.

use super::{Cast, Frames, Unplayable, cast::Against};
use crate::{
    contact::Footing,
    math::Vec3,
    solver::{Dynamics, Problem, Progress, Settings, Settled, borne, step},
};

/// How a cloth with inertia goes from a frame to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Steps of time; more where the bodies go far from one to the next.
    pub steps: usize,
    /// Rate at which motion through still air dies down [1/s].
    pub damping: f64,
}

/// A drape at rest at a time [s], set going: from then on it has the velocities of a cloth that its
/// bodies take along. Frames are so many in a second.
///
/// # Errors
/// [`Unplayable`] where the cloth or the cast is another.
pub fn set_going(
    problem: &Problem,
    cast: &Cast,
    time: f64,
    (frames, pace): (&Frames, &Pace),
    drape: Settled,
) -> Result<Settled, Unplayable> {
    let step = 1.0 / (frames.rate * pace.steps.max(1) as f64);
    let later = cast.bodies(time + step)?;
    let velocities = borne(problem, drape.state(), &later, step)?;
    Ok(Settled {
        velocities,
        ..drape
    })
}

/// The cloth at a time [s], gone on from an earlier one: where its nodes were [cm], where friction held
/// on, and how fast they went [cm/s].
///
/// # Errors
/// [`Unplayable`] where the cloth or the cast is another.
pub fn sway(
    problem: &Problem,
    cast: &Cast,
    ([from, to], pace): ([f64; 2], &Pace),
    before: (&[Vec3], &Footing, &[Vec3]),
    settings: &Settings,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Settled, Unplayable> {
    let problem = Problem {
        bodies: cast.bodies(to)?,
        ..problem.clone()
    };
    // Nothing takes the cloth along but what touches it: no body may go far in a step.
    let stations = cast.stations(from, to, before.0, Against::Ground);
    let steps = pace.steps.max(1);
    let steps = steps * stations.div_ceil(steps);
    let length = (to - from) / steps as f64;
    let through = (1..steps).map(|k| cast.bodies(from + length * k as f64));
    let through: Vec<_> = through.collect::<Result<_, _>>()?;
    let dynamics = Dynamics {
        step: length,
        damping: pace.damping,
    };
    Ok(step(&problem, &through, before, dynamics, settings, watch)?)
}
