//! Pieces of measured cloth for the physical tests, as scenes are read or as bare lattices.

use proptest::{prelude::*, test_runner::RngSeed};
use soen::{
    fabric::{Fabric, Tension},
    lattice::{Lattice, Outline, Piece},
    math::{Mat3, Vec3},
    scene::{self, Scene},
    solver::{Progress, Settings, Settled, settle},
};
use std::fs;

/// The same cases on every machine and in every run.
pub(crate) fn shapes(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// A fabric that ships, by its name.
pub(crate) fn fabric(name: &str) -> Fabric {
    scene::fabric(name).unwrap()
}

/// The fabric under table 1's kind of law, which is stiff at rest too.
pub(crate) fn linear(fabric: &Fabric) -> Fabric {
    let mut linear = fabric.clone();
    linear.warp.tension = Tension::Linear { modulus: 420.0 };
    linear.weft.tension = Tension::Linear { modulus: 370.0 };
    linear
}

/// The fabric with some resistance to twist, of the order of fabric C's to bending.
pub(crate) fn twisting(fabric: &Fabric) -> Fabric {
    Fabric {
        twist: 0.01,
        ..fabric.clone()
    }
}

/// The fabric without weight, so that nothing but the laws pulls.
pub(crate) fn weightless(fabric: &Fabric) -> Fabric {
    Fabric {
        weight: 0.0,
        ..fabric.clone()
    }
}

/// A rectangle on grain, cut at a pitch [cm].
pub(crate) fn towel(warp: f64, weft: f64, pitch: f64) -> Lattice {
    cut(Outline::rectangle(warp, weft).unwrap(), pitch)
}

/// A disc, with its seated nodes and triangles at the edge [cm].
pub(crate) fn disc(radius: f64, pitch: f64) -> Lattice {
    cut(Outline::disc(radius).unwrap(), pitch)
}

fn cut(outline: Outline, pitch: f64) -> Lattice {
    let grain = 0.0;
    let piece = Piece {
        outline,
        grain,
        pitch,
    };
    piece.cut(pitch).unwrap()
}

/// Its nodes in the plane z = 0 [cm].
pub(crate) fn flat(lattice: &Lattice) -> Vec<Vec3> {
    let nodes = lattice.coordinates.iter();
    nodes.map(|at| Vec3::new(at.x, at.y, 0.0)).collect()
}

/// Any shape of a lattice in which nodes stand up to a part of a pitch away from flat, along each
/// axis [cm].
pub(crate) fn crumpled(lattice: &Lattice, part: f64) -> impl Strategy<Value = Vec<Vec3>> + use<> {
    let (flat, reach) = (flat(lattice), part * lattice.pitch);
    let axis = -reach..reach;
    let away = prop::array::uniform3(axis);
    prop::collection::vec(away, flat.len()).prop_map(move |away| {
        let moved = flat.iter().zip(away);
        moved.map(|(at, away)| at + Vec3::from(away)).collect()
    })
}

/// How an energy changes with one coordinate of one node, by central differences: a step to either
/// side, and back.
pub(crate) fn slope(
    there: &mut [Vec3],
    [node, axis]: [usize; 2],
    step: f64,
    energy: impl Fn(&[Vec3]) -> f64,
) -> f64 {
    let here = there[node][axis];
    there[node][axis] = here + step;
    let ahead = energy(there);
    there[node][axis] = here - step;
    let slope = (ahead - energy(there)) / (2.0 * step);
    there[node][axis] = here;
    slope
}

/// The blocks that `fill` hands out, as one full symmetric matrix.
pub(crate) fn whole_matrix(
    nodes: usize,
    fill: impl FnOnce(&mut dyn FnMut(u32, u32, &Mat3)),
) -> nalgebra::DMatrix<f64> {
    let mut whole = nalgebra::DMatrix::zeros(3 * nodes, 3 * nodes);
    fill(&mut |row, column, block| {
        let (r, c) = (3 * row as usize, 3 * column as usize);
        let mut here = whole.fixed_view_mut::<3, 3>(r, c);
        here += block;
        if row != column {
            let mut mirror = whole.fixed_view_mut::<3, 3>(c, r);
            mirror += block.transpose();
        }
    });
    whole
}

/// A scene from its text.
pub(crate) fn scene(text: &str) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    fs::write(&path, text).unwrap();
    scene::read(&path).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Where a scene comes to rest, or where it is after so many rounds on all levels.
pub(crate) fn hang(text: &str, rounds: usize) -> Settled {
    let scene = scene(text);
    settled(&scene, &scene.settings, rounds)
}

/// Where a scene comes to rest at another tolerance.
pub(crate) fn hang_at(text: &str, tolerance: f64, rounds: usize) -> Settled {
    let scene = scene(text);
    let settings = Settings {
        tolerance,
        ..scene.settings
    };
    settled(&scene, &settings, rounds)
}

/// Where a scene comes to rest, or where it is after so many rounds on all levels.
pub(crate) fn settled(scene: &Scene, settings: &Settings, rounds: usize) -> Settled {
    let mut left = rounds;
    let mut watch = |_: &Progress| {
        left = left.saturating_sub(1);
        left > 0
    };
    settle(&scene.problem, settings, &mut watch).unwrap()
}
