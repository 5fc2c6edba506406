//! Lowers those who move: a person, the pose in which the cloth is laid on, and a motion; and which
//! moments of it are wanted.

use super::{
    document::{Allowed, At},
    error::{Fault, SceneError},
    format::{AnimationTable, RobotTable},
    motion, person, posture,
};
use crate::{
    math::Pose,
    play::{Actor, Frames, Pace},
    robot::Robot,
    skeleton::Posture,
    solver::Dynamics,
};
use std::path::PathBuf;

const COUNT: Allowed = Allowed::new(1.0, 1e5, "frames");
const RATE: Allowed = Allowed::new(0.1, 1e4, "frames per second");
const USUAL_RATE: f64 = 24.0;
const STEPS: Allowed = Allowed::new(1.0, 1000.0, "steps");
/// At 24 frames a second a step is 1/192 s: it slows the swing of half a metre of cloth (ω = 5.3 rad/s)
/// by 0.07/s, far less than air does, and a hand that goes 1 m/s takes it half a centimetre.
const USUAL_STEPS: f64 = 8.0;
/// Most steps in a second.
const MOST_STEPS: f64 = 1e5;
const DAMPING: Allowed = Allowed::new(0.0, 1e4, "per second");

/// The robot of a scene's body, in its place.
pub(super) fn actor(
    at: &At<'_>,
    table: &RobotTable,
    name: String,
    place: Pose,
) -> Result<Actor, SceneError> {
    let at_person = at.key("person");
    let measurements = person(&named(&at_person, &table.person)?)?;
    let refused = |error: String| at_person.not_allowed(error);
    let robot = Robot::new(&measurements).map_err(|error| refused(error.to_string()))?;
    let skeleton = robot.skeleton();
    let start = match &table.pose {
        Some(pose) => posture(&named(&at.key("pose"), pose)?, skeleton)?,
        None => Posture::standing(skeleton),
    };
    let played = |name: &String| motion(named(&at.key("motion"), name)?, skeleton);
    let motion = table.motion.as_ref().map(played).transpose()?;
    Actor::new(name, robot, place, start, motion).map_err(|error| {
        let at = at.key("motion");
        let key = at.name();
        at.error(Fault::Motion { key, error })
    })
}

/// A file beside the scene, or the name of what ships.
fn named(at: &At<'_>, name: &str) -> Result<PathBuf, SceneError> {
    let path = PathBuf::from(name);
    if path.extension().is_some() || name.contains(['/', '\\']) {
        at.file(&path)
    } else {
        Ok(path)
    }
}

/// The moments that are wanted of a cloth that weighs so much [gf/cm²].
pub(super) fn frames(
    at: &At<'_>,
    table: &AnimationTable,
    weight: f64,
) -> Result<Frames, SceneError> {
    let count = at.key("frames").number(f64::from(table.frames), &COUNT)?;
    let rate = table.frames_per_s.unwrap_or(USUAL_RATE);
    let rate = at.key("frames_per_s").number(rate, &RATE)?;
    Ok(Frames {
        count: count as usize,
        rate,
        pace: pace(at, table, (weight, rate))?,
    })
}

/// How the cloth goes from one to the next, if it has inertia.
fn pace(
    at: &At<'_>,
    table: &AnimationTable,
    (weight, rate): (f64, f64),
) -> Result<Option<Pace>, SceneError> {
    let given = [
        ("steps_per_frame", table.steps_per_frame.is_some()),
        ("damping_per_s", table.damping_per_s.is_some()),
    ];
    if !table.dynamics {
        return match given.iter().find(|(_, given)| *given) {
            Some((key, _)) => Err(at.key(key).not_allowed("only with dynamics = true")),
            None => Ok(None),
        };
    }
    let steps = table.steps_per_frame.map_or(USUAL_STEPS, f64::from);
    let damping = table.damping_per_s;
    let damping = damping.unwrap_or_else(|| Dynamics::damping_in_air(weight));
    let steps = at.key("steps_per_frame").number(steps, &STEPS)?;
    if steps * rate > MOST_STEPS {
        let most = (MOST_STEPS / rate).floor();
        let allowed = format!("1 to {most} at {rate} frames per second");
        return Err(at.key("steps_per_frame").not_allowed(allowed));
    }
    Ok(Some(Pace {
        steps: steps as usize,
        damping: at.key("damping_per_s").number(damping, &DAMPING)?,
    }))
}
