//! Lowers captures: a BVH file, its table of names, and the piece that is wanted.

use super::{
    format::MotionFile,
    names::{check, document, read},
};
use crate::{
    motion::{Bvh, InvalidMotion, MAPPINGS, Mapping, Motion, retarget},
    scene::{
        document::{Allowed, At, Document, mesh_bytes},
        error::{Fault, SceneError},
    },
    skeleton::Skeleton,
};
use std::path::Path;

/// A hundred thousand frames of a hundred channels have half of it.
const LONGEST_CAPTURE: usize = 256 << 20;

const TIME: Allowed = Allowed::new(0.0, 1e7, "s");

/// The table of joint names that ships and fits a capture: the first all of whose joints it has.
#[must_use]
pub fn mapping_for(source: &Bvh) -> Option<Mapping> {
    let shipped = MAPPINGS.iter().filter_map(|(name, text)| {
        let document = Document::new(name.into(), (*text).into()).ok()?;
        read(&document).ok()
    });
    let fits = |mapping: &Mapping| {
        let mut joints = mapping.joints();
        joints.all(|(_, joint)| source.joint(joint).is_some())
    };
    shipped.into_iter().find(fits)
}

/// A BVH file by itself.
pub(super) fn plain(path: &Path, skeleton: &Skeleton) -> Result<Motion, SceneError> {
    let whole = |fault| of_file(path, fault);
    let source = open(path)?;
    let mapping = mapping_for(&source).ok_or_else(|| whole(no_names(&source)))?;
    let made = retarget(&source, &mapping, skeleton);
    let stem = path.file_stem().unwrap_or_default();
    let motion = made.map_err(|error| whole(Fault::Retarget(error)))?;
    Ok(motion.named(stem.to_string_lossy().into_owned()))
}

/// A BVH file as a motion file names it.
pub(super) fn named(
    top: &At<'_>,
    file: &MotionFile,
    capture: &Path,
    name: String,
    skeleton: &Skeleton,
) -> Result<Motion, SceneError> {
    let at = top.key("capture");
    let path = at.file(capture)?;
    let source = open(&path)?;
    let mapping = match &file.names {
        None => mapping_for(&source).ok_or_else(|| of_file(&path, no_names(&source)))?,
        Some(names) => {
            let at = top.key("names");
            let found = document(top.document.folder(), "names", names);
            let document = found.map_err(|fault| at.error(fault))?;
            let mapping = read(&document)?;
            check(&document.top(), &mapping, &source)?;
            mapping
        }
    };
    let made = retarget(&source, &mapping, skeleton);
    let mut motion = made.map_err(|error| of_file(&path, Fault::Retarget(error)))?;
    if file.from_s.is_some() || file.to_s.is_some() {
        motion = piece(top, file, &motion, skeleton)?;
    }
    if file.within_limits == Some(true) {
        motion = motion.within_limits(skeleton);
    }
    Ok(motion.named(name))
}

/// The piece from `from_s` to `to_s`.
fn piece(
    top: &At<'_>,
    file: &MotionFile,
    whole: &Motion,
    skeleton: &Skeleton,
) -> Result<Motion, SceneError> {
    let end = whole.duration();
    let from = top
        .key("from_s")
        .number(file.from_s.unwrap_or(0.0), &TIME)?;
    let to = top.key("to_s").number(file.to_s.unwrap_or(end), &TIME)?;
    // Rounding of a frame's time does not cost the frame.
    let cut = whole.cut(from - 1e-9, to + 1e-9, skeleton);
    cut.map_err(|error: InvalidMotion| {
        let at = match file.to_s {
            Some(_) => top.key("to_s"),
            None => top.key("from_s"),
        };
        match error {
            InvalidMotion::TooFewKeys { .. } => {
                let above = file.to_s.map_or("0", |_| "from_s");
                at.not_allowed(format!("{above} to {end:.3} s, with a frame between"))
            }
            error => at.error(Fault::Motion {
                key: at.name(),
                error,
            }),
        }
    })
}

fn open(path: &Path) -> Result<Bvh, SceneError> {
    let whole = |fault| of_file(path, fault);
    let bytes = mesh_bytes(path).map_err(whole)?;
    if bytes.len() > LONGEST_CAPTURE {
        let limit = LONGEST_CAPTURE as u64;
        return Err(whole(Fault::TooLong { limit }));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        whole(Fault::Binary { offset })
    })?;
    Bvh::parse(&text).map_err(|error| whole(Fault::Capture(error)))
}

fn no_names(source: &Bvh) -> Fault {
    const SHOWN: usize = 6;
    let joints = source.joints.iter().map(|joint| joint.name.as_str());
    let first: Vec<&str> = joints.take(SHOWN).collect();
    Fault::NoNames {
        joints: first.join(", "),
        known: MAPPINGS.map(|(name, _)| name).join(", "),
    }
}

fn of_file(path: &Path, fault: Fault) -> SceneError {
    SceneError {
        file: path.into(),
        place: None,
        fault: Box::new(fault),
    }
}
