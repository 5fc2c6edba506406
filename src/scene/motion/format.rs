//! Motion files and tables of joint names, as they are written.

use crate::scene::format::{Numbers, Table};
use serde::{
    Deserialize, Deserializer,
    de::{Error, MapAccess, Visitor, value::MapAccessDeserializer},
};
use std::{collections::BTreeMap, fmt, path::PathBuf};

/// A motion: exactly one of key, capture.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionFile {
    /// What it is; the file's name where absent.
    pub(super) name: Option<String>,
    /// Where its angles are from.
    #[serde(default, rename = "source")]
    pub(super) _source: Option<String>,
    /// Postures in time.
    pub(super) key: Option<Vec<Table<KeyTable>>>,
    /// Whether it begins again after the last key, which is the first one again.
    pub(super) cycle: Option<bool>,
    /// How far each round of a cycle takes the root, steadily [cm].
    pub(super) travel_cm: Option<Numbers<3>>,
    /// Hip to ankle of the person it is written for: all lengths become another's by the leg [cm].
    pub(super) leg_cm: Option<f64>,
    /// A BVH file.
    pub(super) capture: Option<PathBuf>,
    /// Its table of joint names: one that ships, or a path to a .toml; the one that fits where absent.
    pub(super) names: Option<String>,
    /// Where the piece of it begins [s].
    pub(super) from_s: Option<f64>,
    /// Where the piece ends [s].
    pub(super) to_s: Option<f64>,
    /// Turns no joint farther than anatomy allows.
    pub(super) within_limits: Option<bool>,
}

/// A posture at a time; joints that are absent are as when standing.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KeyTable {
    pub(super) time_s: f64,
    #[serde(default)]
    pub(super) root: Table<RootTable>,
    /// Joint, then angle [degrees].
    #[serde(default)]
    pub(super) joint: BTreeMap<String, BTreeMap<String, f64>>,
}

/// The pelvis, against standing.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RootTable {
    pub(super) move_cm: Option<Numbers<3>>,
    /// Turns about x, then y, then z [degrees].
    pub(super) turn_deg: Option<Numbers<3>>,
}

/// A table of joint names.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NamesFile {
    pub(super) name: String,
    #[serde(default, rename = "source")]
    pub(super) _source: Option<String>,
    /// For each of our bones what moves it.
    pub(super) bone: BTreeMap<String, JointNames>,
}

/// A joint's name, or a table of names.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct JointTable {
    pub(super) joint: String,
    pub(super) end: Option<String>,
    pub(super) twist: Option<String>,
}

/// [`JointTable`], where a text is its joint alone.
#[derive(Debug)]
pub(super) struct JointNames(pub(super) JointTable);

impl<'de> Deserialize<'de> for JointNames {
    fn deserialize<D: Deserializer<'de>>(names: D) -> Result<Self, D::Error> {
        names.deserialize_any(NamesVisitor)
    }
}

struct NamesVisitor;

impl<'de> Visitor<'de> for NamesVisitor {
    type Value = JointNames;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a joint's name in quotes or a table with joint, end, twist")
    }

    fn visit_str<E: Error>(self, joint: &str) -> Result<JointNames, E> {
        let (joint, end, twist) = (joint.to_owned(), None, None);
        Ok(JointNames(JointTable { joint, end, twist }))
    }

    fn visit_map<A: MapAccess<'de>>(self, keys: A) -> Result<JointNames, A::Error> {
        JointTable::deserialize(MapAccessDeserializer::new(keys)).map(JointNames)
    }
}
