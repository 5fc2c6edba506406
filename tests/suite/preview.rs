//! A preview is cheap, and looks like the fine drape.

use crate::{
    solved::solved,
    specimen::{scene, settled},
};
use soen::{math::Vec3, solver::Settled};

/// Heights of a preview's nodes, and of the fine drape's nodes nearest to them in the cloth [cm].
fn heights(coarse: &Settled, fine: &Settled) -> Vec<[f64; 2]> {
    let nodes = coarse.lattice.coordinates.iter().zip(&coarse.positions);
    let pair = |(cloth, at): (&_, &Vec3)| {
        let (node, _) = fine.lattice.nearest_node(*cloth).unwrap();
        [at.z, fine.positions[node as usize].z]
    };
    nodes.map(pair).collect()
}

/// Work in updates of nodes: the factors of a joint step on n nodes take about as long as n^1.5 of them
/// (docs/performance.md: 0.19 s for 16,641 nodes, at 0.11 µs an update).
fn work(settled: &Settled) -> f64 {
    let levels = settled.levels.iter();
    let joint = levels.map(|level| level.joint_steps as f64 * (level.nodes as f64).powf(1.5));
    settled.node_updates as f64 + joint.sum::<f64>()
}

/// Pearson's correlation.
fn correlation(pairs: &[[f64; 2]]) -> f64 {
    let count = pairs.len() as f64;
    let mean = |k: usize| pairs.iter().map(|pair| pair[k]).sum::<f64>() / count;
    let middle = [mean(0), mean(1)];
    let product = |j: usize, k: usize| {
        let products = pairs.iter();
        let products = products.map(|pair| (pair[j] - middle[j]) * (pair[k] - middle[k]));
        products.sum::<f64>()
    };
    product(0, 1) / (product(0, 0) * product(1, 1)).sqrt()
}

#[test]
fn a_preview_takes_a_tenth_of_the_work_and_stands_as_high_as_the_drape() {
    for name in ["fig12b-full", "fig12c-two-balls", "two-balls"] {
        let (scene, fine) = solved(name);
        let mut preview = scene.clone();
        preview.problem = scene.problem.preview();
        let coarse = settled(&preview, &scene.settings, 900);
        assert!(coarse.converged, "{name}: {:?}", coarse.certificate);
        let [little, much] = [work(&coarse), work(fine)];
        assert!(10.0 * little <= much, "{name}: {little} {much}");
        let likeness = correlation(&heights(&coarse, fine));
        // 0.987 is the least seen: the folds of twelve coarse rods are shallower.
        assert!(likeness > 0.98, "{name}: {likeness}");
    }
}

#[test]
fn a_preview_of_a_small_cloth_is_the_cloth() {
    let scene = scene(
        "[cloth]\nfabric = \"c\"\nsize_cm = [9, 9]\nspacing_cm = 1\n[[hold]]\nedge = \"x-min\"\n",
    );
    assert_eq!(scene.problem.preview().piece.pitch, 1.0);
}
