//! The scenes of `scenes/`, each solved once for all tests.

use crate::scenes::SCENES;
use soen::{
    scene::{self, Scene},
    solver::{Settled, settle},
};
use std::{path::Path, sync::OnceLock, time::Instant};

static SOLVED: [OnceLock<(Scene, Settled)>; SCENES.len()] =
    [const { OnceLock::new() }; SCENES.len()];

/// A scene, and where it came to rest.
pub(crate) fn solved(name: &str) -> &'static (Scene, Settled) {
    let place = SCENES.iter().position(|known| *known == name).unwrap();
    SOLVED[place].get_or_init(|| solve(name))
}

fn solve(name: &str) -> (Scene, Settled) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let scene = scene::read(&folder.join(format!("{name}.toml"))).unwrap();
    let begin = Instant::now();
    let mut watch = |_: &_| begin.elapsed().as_secs_f64() < scene.max_seconds;
    let settled = settle(&scene.problem, &scene.settings, &mut watch).unwrap();
    (scene, settled)
}
