//! Every scene of `scenes/` is solved as it stands, certified, and looks as it did.

use crate::{picture::assert_picture, solved::solved};
use soen::{
    output::{self, ClothMesh, View},
    scene::Scene,
    snapshot::least_clearance,
    solver::{Grip, Settled},
};
use std::{fs, path::Path};

/// One test for each scene, so that they run side by side.
macro_rules! scenes {
    ($($test:ident $name:literal)*) => {
        /// The scenes by their files' names.
        pub(crate) const SCENES: &[&str] = &[$($name),*];
        $(
            #[test]
            fn $test() {
                check($name);
            }
        )*
    };
}

scenes! {
    a_cape_on_shoulders "cape"
    dress_form "dress-form"
    along_the_warp "fig10-warp"
    on_the_bias "fig11-bias"
    tension_alone_on_a_ball "fig12a-tension-only"
    all_laws_on_a_ball "fig12b-full"
    thin_cloth_on_two_balls "fig12c-two-balls"
    a_poncho_on_a_woman_who_stands "poncho"
    over_a_table "table"
    two_balls "two-balls"
}

#[test]
fn every_scene_has_its_test_and_every_snapshot_its_scene() {
    assert_eq!(stems("scenes", "toml"), SCENES);
    assert_eq!(stems("snapshots", "png"), SCENES);
    let mut texts = stems("snapshots", "snap");
    // Of examples/snapshot_of_a_drape.rs.
    texts.retain(|name| name != "example");
    assert_eq!(texts, SCENES);
}

/// The sorted names of a folder's files with an ending.
fn stems(folder: &str, ending: &str) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let paths = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut stems: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|own| own == ending))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    stems.sort();
    stems
}

fn check(name: &str) {
    let (scene, settled) = solved(name);
    assert!(settled.converged, "{name}: {:?}", settled.certificate);
    assert!(scene.problem.piece.pitch <= 1.0);
    is_outside(scene, settled);
    is_carried(scene, settled);
    is_held(scene, settled);
    soen::assert_drape!(name, &scene.problem, settled);
    assert_picture(name, &picture(scene, settled));
}

/// No node is inside a body, and no point between nodes visibly.
fn is_outside(scene: &Scene, settled: &Settled) {
    let clearance = least_clearance(&scene.problem.bodies, &settled.positions);
    assert!(
        clearance.is_none_or(|clearance| clearance > 0.0),
        "{clearance:?}"
    );
    let at = |node: u32| settled.positions[node as usize];
    // Other points than the certificate's.
    for [a, b, c] in settled.lattice.faces() {
        for (u, v) in [(0.2, 0.2), (0.2, 0.6), (0.6, 0.2), (0.5, 0.5), (0.5, 0.0)] {
            let point = at(a) * (1.0 - u - v) + at(b) * u + at(c) * v;
            let depth = scene.problem.bodies.depth(&point);
            assert!(depth <= 0.05, "{depth} cm inside at {point:?}");
        }
    }
}

/// Where nothing is held, the bodies carry the weight: a reaction inside the cone is no more than
/// √(1 + µ²) times its normal force, and some of what they push is not upward.
fn is_carried(scene: &Scene, settled: &Settled) {
    let problem = &scene.problem;
    if !problem.holds.is_empty() {
        return;
    }
    let weight = problem.fabric.weight * settled.lattice.area.iter().sum::<f64>();
    let pushed: f64 = settled.contact.iter().sum();
    let most = pushed * problem.friction.hypot(1.0);
    assert!(most > 0.999 * weight, "{most} gf carry {weight} gf");
    assert!(settled.contact.iter().all(|normal| *normal >= 0.0));
}

/// What is held by an edge is where it was.
fn is_held(scene: &Scene, settled: &Settled) {
    let (piece, placement) = (&scene.problem.piece, &scene.problem.placement);
    for hold in &scene.problem.holds {
        let Grip::Edge(edge) = hold.grip else {
            continue;
        };
        let nodes = piece.edge_nodes(&settled.lattice, edge);
        assert!(nodes.len() > 5);
        for node in nodes {
            let start = piece.to_outline(settled.lattice.coordinates[node as usize]);
            let start = placement.centre + start.x * placement.x_axis + start.y * placement.y_axis;
            let moved = settled.positions[node as usize] - start - hold.carry;
            assert!(moved.norm() < 1e-9, "{node} by {moved:?}");
        }
    }
}

fn picture(scene: &Scene, settled: &Settled) -> Vec<u8> {
    let cloth = ClothMesh {
        lattice: &settled.lattice,
        positions: &settled.positions,
    };
    let view = View {
        width: 480,
        height: 360,
        ..View::default()
    };
    output::picture(&cloth, &output::body_meshes(&scene.problem.bodies), &view)
}
