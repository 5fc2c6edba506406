//! Reads a table of joint names: one that ships, or a file.

use super::{
    format::{JointNames, NamesFile},
    shipped_or_here,
};
use crate::{
    motion::{BONES, Bvh, MAPPINGS, Mapping, Source},
    scene::{
        complaint::nearest,
        document::{At, Document, beside},
        error::{Fault, SceneError},
    },
};
use std::path::Path;

/// Reads which joint of a capture moves which bone, by the name of a table that ships (`cmu`,
/// `makehuman`, `makehuman-old`), of one in `bodies/motions/names/`, or by a path to a `.toml`.
///
/// # Errors
/// [`SceneError`] where there is no such table, or its file is none.
///
/// ```
/// let names = soen::scene::mapping("cmu")?;
/// assert_eq!(names.source("left_thigh").unwrap().joint, "lfemur");
/// # Ok::<(), soen::scene::SceneError>(())
/// ```
pub fn mapping(name: &str) -> Result<Mapping, SceneError> {
    let found = document(Path::new(""), "names", name).map_err(|fault| SceneError {
        file: name.into(),
        place: None,
        fault: Box::new(fault),
    });
    read(&found?)
}

/// The document of a table of names.
pub(super) fn document(folder: &Path, key: &str, name: &str) -> Result<Document, Fault> {
    if name.contains(['/', '\\']) || name.ends_with(".toml") {
        let path = beside(folder, Path::new(name)).map_err(|tried| Fault::NoSuchFile {
            key: key.into(),
            value: format!("{name:?}"),
            tried,
        })?;
        return Document::open(&path).map_err(|error| *error.fault);
    }
    shipped_or_here("bodies/motions/names", &MAPPINGS, name, key)
}

pub(super) fn read(document: &Document) -> Result<Mapping, SceneError> {
    let file: NamesFile = document.content()?;
    let at = document.top().key("bone");
    let mut bones = Vec::new();
    for (bone, JointNames(names)) in file.bone {
        if !BONES.contains(&bone.as_str()) {
            return Err(at.key(&bone).error(Fault::UnknownKey {
                nearest: nearest(&bone, BONES.into_iter()),
                known: BONES.map(str::to_owned).into(),
                table: at.name(),
                key: bone,
            }));
        }
        let source = Source {
            joint: names.joint,
            end: names.end,
            twist: names.twist,
        };
        bones.push((bone, source));
    }
    let name = file.name;
    Ok(Mapping { name, bones })
}

/// Refuses a table that names a joint which a capture does not have.
pub(super) fn check(at: &At<'_>, mapping: &Mapping, source: &Bvh) -> Result<(), SceneError> {
    let all = source.joints.iter().map(|joint| joint.name.as_str());
    let missing = mapping
        .joints()
        .find(|(_, joint)| source.joint(joint).is_none());
    let Some((bone, joint)) = missing else {
        return Ok(());
    };
    let guess = nearest(joint, all).map(|guess| format!("; did you mean {guess:?}?"));
    Err(at.key("bone").key(bone).error(Fault::NotAllowed {
        key: format!("bone.{bone}"),
        value: format!("{joint:?}"),
        allowed: format!("a joint of the capture{}", guess.unwrap_or_default()),
    }))
}
