//! Lowers keyframes: angles by their joints' names, lengths by the leg.

use super::format::{KeyTable, MotionFile};
use crate::{
    math::{Pose, Rotation, Vec3, turn_in_order},
    motion::{InvalidMotion, Key, Motion, leg},
    scene::{
        complaint::nearest,
        document::{Allowed, At},
        error::{Fault, SceneError},
        format::Numbers,
    },
    skeleton::{Joint, Posture, Skeleton},
};
use std::collections::BTreeMap;

const TIME: Allowed = Allowed::new(-1e5, 1e5, "s");
const LENGTH: Allowed = Allowed::new(-1e4, 1e4, "cm");
const LEG: Allowed = Allowed::new(1.0, 500.0, "cm");
const TURN: Allowed = Allowed::new(-3600.0, 3600.0, "degrees");

pub(super) fn motion(
    top: &At<'_>,
    file: &MotionFile,
    name: String,
    skeleton: &Skeleton,
) -> Result<Motion, SceneError> {
    let scale = match file.leg_cm {
        None => 1.0,
        Some(own) => {
            let at = top.key("leg_cm");
            let own = at.number(own, &LEG)?;
            let ours = leg(skeleton);
            ours.map_err(|_| at.not_allowed("absent: this skeleton has no legs"))? / own
        }
    };
    let cycle = file.cycle.unwrap_or(false);
    if file.travel_cm.is_some() && !cycle {
        let at = top.key("travel_cm");
        return Err(at.not_allowed("absent without cycle = true"));
    }
    let travel = numbers(&top.key("travel_cm"), file.travel_cm, &LENGTH)? * scale;
    let at = top.key("key");
    let mut keys = Vec::new();
    for (item, table) in file.key.iter().flatten().enumerate() {
        let at = at.item(item);
        let time = at.key("time_s").number(table.time_s, &TIME)?;
        let posture = posture(&at, table, scale, skeleton)?;
        keys.push(Key { time, posture });
    }
    let count = keys.len();
    let made = Motion::new(name, keys, cycle.then_some(travel), skeleton);
    made.map_err(|error| refusal(&at, error, count))
}

/// The refusal of keys, where it belongs.
fn refusal(at: &At<'_>, error: InvalidMotion, count: usize) -> SceneError {
    let item = |number: usize| at.item(number.saturating_sub(1));
    let at = match &error {
        InvalidMotion::NotRising { key, before, .. } => {
            let at = item(*key).key("time_s");
            return at.not_allowed(format!("above {before} s, the time of the key before"));
        }
        InvalidMotion::NotClosed { .. } => item(count),
        InvalidMotion::NotFinite { key, .. } | InvalidMotion::Bones { key, .. } => item(*key),
        InvalidMotion::TooFewKeys { .. } => at.clone(),
    };
    let key = at.name();
    at.error(Fault::Motion { key, error })
}

fn posture(
    at: &At<'_>,
    table: &KeyTable,
    scale: f64,
    skeleton: &Skeleton,
) -> Result<Posture, SceneError> {
    let mut posture = Posture::standing(skeleton);
    let root = at.key("root");
    let moved = numbers(&root.key("move_cm"), table.root.move_cm, &LENGTH)? * scale;
    let turns = numbers(&root.key("turn_deg"), table.root.turn_deg, &TURN)?;
    posture.root = Pose::from_parts(
        (posture.root.translation.vector + moved).into(),
        turn_in_order(turns.map(f64::to_radians).into()),
    );
    let at = at.key("joint");
    for (name, angles) in &table.joint {
        let bone = skeleton.joint(name).filter(|bone| *bone > 0);
        let found = bone.and_then(|bone| Some((bone, skeleton.bones().get(bone)?)));
        let found = found.filter(|(_, bone)| bone.joint.turns());
        let Some((bone, found)) = found else {
            let bones = skeleton.bones().iter().skip(1);
            let turning = bones.filter(|bone| bone.joint.turns());
            let known = turning.map(|bone| bone.joint.name.clone());
            return Err(unknown(&at, name, known.collect()));
        };
        let turned = rotation(&at.key(name), angles, &found.joint)?;
        if let Some(slot) = posture.joints.get_mut(bone) {
            *slot = turned;
        }
    }
    Ok(posture)
}

fn rotation(
    at: &At<'_>,
    given: &BTreeMap<String, f64>,
    joint: &Joint,
) -> Result<Rotation, SceneError> {
    let names = joint.angles.map(|angle| format!("{angle}_deg"));
    let mut angles = [0.0; 3];
    for (key, value) in given {
        let known = names.iter().position(|name| name == key);
        let slots =
            known.and_then(|known| Some((angles.get_mut(known)?, joint.limits.get(known)?)));
        let Some((angle, limits)) = slots else {
            return Err(unknown(at, key, names.into()));
        };
        // 120° and back by way of radians has 13 right digits.
        let [low, high] = limits.map(|limit| (limit.to_degrees() * 1e6).round() / 1e6);
        let allowed = Allowed::new(low, high, "degrees");
        *angle = at.key(key).number(*value, &allowed)?.to_radians();
    }
    Ok(joint.rotation(angles))
}

fn unknown(at: &At<'_>, key: &str, known: Vec<String>) -> SceneError {
    at.key(key).error(Fault::UnknownKey {
        key: key.to_owned(),
        table: at.name(),
        nearest: nearest(key, known.iter().map(String::as_str)),
        known,
    })
}

/// Three numbers as a vector; zeros where absent.
fn numbers(at: &At<'_>, given: Option<Numbers<3>>, allowed: &Allowed) -> Result<Vec3, SceneError> {
    let values = given.map_or([0.0; 3], |Numbers(values)| values);
    Ok(at.numbers(values, allowed)?.into())
}
