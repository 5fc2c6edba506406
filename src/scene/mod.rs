//! Scene files: a cloth, a body and a start, as people write them (TOML, units in the key names).
//!
//! Reading promises that every value is inside its range, that each file named is there and holds
//! what it should, and that an error shows the place: file, line, column, key, value and what is
//! allowed. Whether a start can be made (a hold outside the cloth, cloth that begins inside a
//! body) only the solver knows; [`Scene::refusal`] turns its answer into such an error.
//!
//! ```
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("flag.toml");
//! std::fs::write(&path, r#"
//! [cloth]
//! fabric = "a"
//! size_cm = [20.0, 30.0]
//! spacing_cm = 1.0
//! [[hold]]
//! edge = "x-min"
//! "#)?;
//! let scene = soen::scene::read(&path)?;
//! assert_eq!(scene.problem.holds.len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod actor;
mod body;
mod build;
mod complaint;
mod document;
mod error;
mod fabric;
mod format;
mod measured;
mod motion;
mod person;
mod posture;

pub use body::InspectedMesh;
pub use error::{Fault, Place, SceneError};
pub use fabric::{fabric, fabric_text};
pub use measured::measured;
pub use motion::{mapping, mapping_for, motion};
pub use person::person;
pub use posture::posture;

use crate::{
    play::{Cast, ENTRANCE, Frames},
    solver::{Problem, Settings, Unsolvable},
};
use body::Solids;
use document::Document;
use format::SceneFile;
use std::path::{Path, PathBuf};

/// A scene file, read and lowered.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What it shows.
    pub title: String,
    /// The fabric as the scene names it.
    pub fabric: String,
    /// The file that the fabric is from; for one that ships, where it would be.
    pub fabric_file: PathBuf,
    /// What the solver takes.
    pub problem: Problem,
    /// When to stop, by the certificate.
    pub settings: Settings,
    /// When to stop, by the clock [s].
    pub max_seconds: f64,
    /// Who and what the cloth may meet; the problem's bodies are these as the cloth is laid on.
    pub cast: Cast,
    /// Which moments of a motion are wanted, if any.
    pub frames: Option<Frames>,
    /// What was found in each mesh file, in the order of the bodies.
    pub meshes: Vec<InspectedMesh>,
    document: Document,
}

/// Reads a scene file and every file that it names.
///
/// # Errors
/// [`SceneError`] shows the first value that is not allowed.
pub fn read(path: &Path) -> Result<Scene, SceneError> {
    let document = Document::open(path)?;
    let file: SceneFile = document.content()?;
    let top = document.top();
    let (cloth, solve) = (top.key("cloth"), top.key("solve"));
    let (material, fabric_file) = fabric::named(&cloth.key("fabric"), &file.cloth.fabric)?;
    let mut solids = Solids::default();
    solids.add_all(&top.key("body"), &file.body)?;
    let (friction, thickness) = build::contact(&top.key("contact"), &file.contact, &material)?;
    let stop = build::stop(&solve, &file.solve)?;
    let at = top.key("animation");
    let frames = file.animation.as_ref();
    let frames = frames.map(|table| actor::frames(&at, table, material.weight));
    let frames = frames.transpose()?;
    let bodies = solids.cast.bodies(-ENTRANCE).map_err(|error| {
        let at = top.key("body");
        let key = at.name();
        at.error(Fault::Part { key, error })
    })?;
    let problem = Problem {
        piece: build::piece(&cloth, &file.cloth)?,
        placement: build::placement(&cloth, &file.cloth)?,
        holds: build::holds(&top.key("hold"), &file.hold)?,
        bodies,
        friction,
        thickness,
        laws: build::laws(&solve, &file.solve)?,
        forces: build::forces(&file.solve),
        seed: file.seed,
        fabric: material,
    };
    let name = path.file_stem().unwrap_or_default();
    Ok(Scene {
        title: file
            .title
            .unwrap_or_else(|| name.to_string_lossy().into_owned()),
        fabric: file.cloth.fabric.clone(),
        fabric_file,
        problem,
        settings: Settings {
            tolerance: stop.tolerance,
            frames: 0,
        },
        max_seconds: stop.max_seconds,
        cast: solids.cast,
        frames,
        meshes: solids.meshes,
        document,
    })
}

impl Scene {
    /// The solver's refusal, with the place of this scene's file that it belongs to.
    #[must_use]
    pub fn refusal(&self, error: Unsolvable) -> SceneError {
        let place = build::place_of(&self.document.top(), &error);
        place.error(Fault::Unsolvable {
            key: place.name(),
            value: place.written(),
            error,
        })
    }
}

/// The JSON Schema of scene files, for editors.
#[must_use]
pub fn schema() -> String {
    let schema = schemars::schema_for!(SceneFile);
    format!("{:#}", schema.as_value())
}
