//! Posture files: angles of joints by their anatomical names, and points to reach.

use super::{
    complaint::nearest,
    document::{Allowed, At},
    error::{Fault, SceneError},
    format::{Numbers, Table},
    motion::document,
};
use crate::{
    math::{Pose, Rotation, Vec3, turn_in_order},
    skeleton::{Bone, Joint, POSES, Posture, Skeleton},
};
use core::f64::consts::PI;
use serde::Deserialize;
use std::{collections::BTreeMap, path::Path};

const PLACE: Allowed = Allowed::new(-1e5, 1e5, "cm");
const TURN: Allowed = Allowed::new(-3600.0, 3600.0, "degrees");

/// How a person stands, sits or walks.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PostureFile {
    /// What it is.
    #[serde(default, rename = "name")]
    _name: Option<String>,
    /// Whether the figure comes down, or up, to the ground; true where absent.
    ground: Option<bool>,
    #[serde(default)]
    root: Table<RootTable>,
    /// Angles of each joint by its name; those of joints that are absent are 0.
    #[serde(default)]
    joint: Table<BTreeMap<String, Table<BTreeMap<String, f64>>>>,
    /// Points that ends of bones come to, one after the other.
    #[serde(default)]
    reach: Vec<Table<ReachTable>>,
}

/// The pelvis against where it is when the person stands.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct RootTable {
    /// Turns about x, then y, then z [degrees].
    turn_deg: Option<Numbers<3>>,
    move_cm: Option<Numbers<3>>,
}

/// A point that the end of a bone comes to, by turning its limb and, failing that, the trunk.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ReachTable {
    bone: String,
    to_cm: Numbers<3>,
}

/// Reads a posture for a skeleton: a path to a `.toml`, or the name of one of the [`POSES`] that
/// ship; a file `bodies/poses/NAME.toml` in the present folder comes before those.
///
/// The angles come first, then the figure is put on the ground, unless `ground = false`, then the
/// reaches follow in their order: their points are in the room. A reach moves joints of its limb
/// from the angles that were given, and the pelvis stays.
///
/// # Errors
/// [`SceneError`] shows the first name or value that is not allowed: a joint or an angle that the
/// skeleton does not have, an angle beyond its limit, a point that is not reached.
pub fn posture(path: &Path, skeleton: &Skeleton) -> Result<Posture, SceneError> {
    let document = document(path, "bodies/poses", &POSES, "pose")?;
    let file: PostureFile = document.content()?;
    let top = document.top();
    let mut posture = Posture::standing(skeleton);
    posture.root = root(&top.key("root"), &file.root, &skeleton.base())?;
    for (name, angles) in file.joint.iter() {
        let (bone, joint) = named(&top.key("joint"), name, skeleton)?;
        let turn = turned(&top.key("joint").key(name), angles, joint)?;
        if let Some(own) = posture.joints.get_mut(bone) {
            *own = turn;
        }
    }
    if file.ground.unwrap_or(true) {
        posture = skeleton.grounded(&posture);
    }
    for (item, reach) in file.reach.iter().enumerate() {
        posture = reached(&top.key("reach").item(item), reach, skeleton, &posture)?;
    }
    Ok(posture)
}

fn root(at: &At<'_>, table: &RootTable, base: &Vec3) -> Result<Pose, SceneError> {
    let moves = table.move_cm.map_or([0.0; 3], |Numbers(moves)| moves);
    let moves = at.key("move_cm").numbers(moves, &PLACE)?;
    let turns = table.turn_deg.map_or([0.0; 3], |Numbers(turns)| turns);
    let turns = at.key("turn_deg").numbers(turns, &TURN)?;
    let turn = turn_in_order(turns.map(f64::to_radians));
    let origin = base + Vec3::from(moves);
    Ok(Pose::from_parts(origin.into(), turn))
}

/// The joint of a name, and the bone that it turns.
fn named<'s>(
    at: &At<'_>,
    name: &str,
    skeleton: &'s Skeleton,
) -> Result<(usize, &'s Joint), SceneError> {
    let joints = || skeleton.bones().iter().enumerate().skip(1);
    let turning = || joints().filter(|(_, bone)| bone.joint.turns());
    let found = turning().find(|(_, bone)| bone.joint.name == name);
    let known = turning().map(|(_, bone)| bone.joint.name.clone());
    match found {
        Some((index, bone)) => Ok((index, &bone.joint)),
        None => Err(unknown(at, name, known.collect())),
    }
}

fn unknown(at: &At<'_>, key: &str, known: Vec<String>) -> SceneError {
    at.key(key).key_error(Fault::UnknownKey {
        key: key.into(),
        table: at.name(),
        nearest: nearest(key, known.iter().map(String::as_str)),
        known,
    })
}

/// The turn of a joint by its angles in degrees.
fn turned(
    at: &At<'_>,
    table: &BTreeMap<String, f64>,
    joint: &Joint,
) -> Result<Rotation, SceneError> {
    let keys = joint.angles.map(|angle| format!("{angle}_deg"));
    let mut angles = [0.0; 3];
    for (key, degrees) in table {
        let slot = keys.iter().position(|known| known == key);
        let Some(slot) = slot.and_then(|slot| angles.get_mut(slot)) else {
            return Err(unknown(at, key, keys.to_vec()));
        };
        *slot = degrees.to_radians();
    }
    if let Some(broken) = joint.exceeded(angles).next() {
        let allowed = format!("{} to {} degrees", tidy(broken.low), tidy(broken.high));
        return Err(at
            .key(&format!("{}_deg", broken.angle))
            .not_allowed(allowed));
    }
    let [f, a, _] = angles;
    // Beyond half a turn the same turn has other angles, which the limits do not fit.
    if (f * f + a * a).sqrt() > PI {
        let [first, second, _] = keys;
        return Err(at.not_allowed(format!(
            "{first} and {second} whose squares add up to 180² or less"
        )));
    }
    Ok(joint.rotation(angles))
}

/// Degrees without what the way through radians has left.
fn tidy(degrees: f64) -> f64 {
    (degrees * 1e6).round() / 1e6
}

fn reached(
    at: &At<'_>,
    table: &ReachTable,
    skeleton: &Skeleton,
    posture: &Posture,
) -> Result<Posture, SceneError> {
    let bones = || skeleton.bones().iter().enumerate().skip(1);
    let found = bones().find(|(_, bone)| bone.name == table.bone);
    let Some((index, bone)) = found else {
        return Err(at
            .key("bone")
            .not_allowed(names(&table.bone, bones().map(|(_, bone)| bone))));
    };
    let at = at.key("to_cm");
    let point = at.numbers(table.to_cm.0, &PLACE)?;
    let reached = skeleton.reach(posture, index, &point.into());
    if reached.is_there() {
        return Ok(reached.posture);
    }
    Err(at.error(Fault::OutOfReach {
        key: at.name(),
        value: at.written(),
        bone: bone.name.clone(),
        miss: reached.miss,
    }))
}

fn names<'s>(wrong: &str, bones: impl Iterator<Item = &'s Bone>) -> String {
    let names: Vec<&str> = bones.map(|bone| bone.name.as_str()).collect();
    let guess = nearest(wrong, names.iter().copied())
        .map(|guess| format!("; did you mean {guess:?}?"))
        .unwrap_or_default();
    format!("{}{guess}", names.join(", "))
}
