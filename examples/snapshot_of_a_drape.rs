//! How to freeze a drape of one's own: `cargo test --example snapshot_of_a_drape` compares it with
//! `snapshots/example.snap`; `cargo run --example snapshot_of_a_drape` prints what is compared.

use soen::{scene, solver::settle};
use std::{
    error::Error,
    io::{self, Write},
};

const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/fig10-warp.toml");

fn main() -> Result<(), Box<dyn Error>> {
    let scene = scene::read(SCENE.as_ref())?;
    let drape = settle(&scene.problem, &scene.settings, &mut |_| true)?;
    let figures = soen::snapshot::figures(&scene.problem, &drape);
    Ok(io::stdout().write_all(figures.as_bytes())?)
}

#[test]
fn my_cloth_hangs_as_it_did() -> Result<(), Box<dyn Error>> {
    let scene = scene::read(SCENE.as_ref())?;
    let drape = settle(&scene.problem, &scene.settings, &mut |_| true)?;
    soen::assert_drape!("example", &scene.problem, &drape);
    Ok(())
}
