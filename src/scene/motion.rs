//! Reads motions: keyframes (TOML), captures (BVH), and captures as a motion file names them.

mod capture;
mod format;
mod keys;
mod names;

pub use capture::mapping_for;
pub use names::mapping;

use super::{
    document::{Document, beside},
    error::{Fault, SceneError},
    fabric::allowed_names_of,
};
use crate::{
    motion::{MOTIONS, Motion},
    skeleton::Skeleton,
};
use format::MotionFile;
use std::path::{Path, PathBuf};

/// Reads a motion of a skeleton: a path to a `.bvh` or `.toml`, or the name of one that ships,
/// `walk`, `run` or `jump`.
///
/// A file `bodies/motions/NAME.toml` in the present folder comes before the motion of that name
/// that ships, so that a copy can be edited. The joints of a `.bvh` are found by the table of names
/// that fits; a motion file may name another and cut a piece out.
///
/// # Errors
/// [`SceneError`] shows the first value that is not allowed, or the line of a capture.
pub fn motion(path: impl AsRef<Path>, skeleton: &Skeleton) -> Result<Motion, SceneError> {
    let path = path.as_ref();
    match Source::find(path)? {
        Source::Capture(path) => capture::plain(&path, skeleton),
        Source::File(document) => read(&document, skeleton),
    }
}

/// What a name or a path leads to.
enum Source {
    Capture(PathBuf),
    File(Document),
}

impl Source {
    fn find(path: &Path) -> Result<Self, SceneError> {
        let ending = path.extension().unwrap_or_default();
        if ending.eq_ignore_ascii_case("bvh") {
            return Ok(Self::Capture(path.into()));
        }
        document(path, "bodies/motions", &MOTIONS, "motion").map(Self::File)
    }
}

/// The file at a path; of a name alone the file of that name in a folder here or, failing that, the
/// text of that name that ships.
pub(super) fn document(
    path: &Path,
    folder: &str,
    shipped: &[(&str, &'static str)],
    key: &str,
) -> Result<Document, SceneError> {
    let name = path.to_string_lossy();
    if path.extension().is_some() || name.contains(['/', '\\']) {
        return Document::open(path);
    }
    shipped_or_here(folder, shipped, &name, key).map_err(|fault| SceneError {
        file: path.into(),
        place: None,
        fault: Box::new(fault),
    })
}

/// The file of a name in a folder here or, failing that, the text of that name that ships.
fn shipped_or_here(
    folder: &str,
    shipped: &[(&str, &'static str)],
    name: &str,
    key: &str,
) -> Result<Document, Fault> {
    let file = Path::new(folder).join(format!("{name}.toml"));
    let known = shipped.iter().find(|(known, _)| *known == name);
    let document = match (beside(Path::new(""), &file), known) {
        (Ok(path), _) => Document::open(&path),
        (Err(_), Some((_, text))) => Document::new(file, (*text).into()),
        (Err(_), None) => {
            let names = shipped.iter().map(|(name, _)| *name);
            return Err(Fault::NotAllowed {
                key: key.into(),
                value: format!("{name:?}"),
                allowed: allowed_names_of(name, names, folder),
            });
        }
    };
    document.map_err(|error| *error.fault)
}

fn read(document: &Document, skeleton: &Skeleton) -> Result<Motion, SceneError> {
    let file: MotionFile = document.content()?;
    let top = document.top();
    let kind = top.exactly_one(&[
        ("key", file.key.is_some()),
        ("capture", file.capture.is_some()),
    ])?;
    let others = [
        ("travel_cm", file.travel_cm.is_some(), "key"),
        ("leg_cm", file.leg_cm.is_some(), "key"),
        ("cycle", file.cycle.is_some(), "key"),
        ("names", file.names.is_some(), "capture"),
        ("from_s", file.from_s.is_some(), "capture"),
        ("to_s", file.to_s.is_some(), "capture"),
        ("within_limits", file.within_limits.is_some(), "capture"),
    ];
    if let Some((key, ..)) = others.iter().find(|(_, there, of)| *there && *of != kind) {
        return Err(top.key(key).error(Fault::TooManyKeys {
            found: format!("{kind}, {key}"),
            table: String::new(),
        }));
    }
    let stem = document.path.file_stem().unwrap_or_default();
    let usual = stem.to_string_lossy().into_owned();
    let name = file.name.clone().unwrap_or(usual);
    match &file.capture {
        Some(capture) => capture::named(&top, &file, capture, name, skeleton),
        None => keys::motion(&top, &file, name, skeleton),
    }
}
