//! What the paper says of its figures 10 to 12 is so here, and the README gives the numbers.

use crate::solved::solved;
use std::{fs, path::Path};

/// Sag of a piece held by both short edges, over its span [-].
fn sag(name: &str) -> f64 {
    let (scene, settled) = solved(name);
    let (low, high) = scene.problem.piece.outline.bounds();
    (scene.problem.placement.centre.z - settled.shape.lowest) / (high.x - low.x)
}

/// Mean distance from the ball, by area, of the cloth above its equator [cm]: what hangs free
/// below, the corners of figure 12 a above all, says nothing of the fit.
fn mean_gap(name: &str) -> f64 {
    let (_, settled) = solved(name);
    let cloth = settled.positions.iter().zip(&settled.lattice.area);
    let (mut gaps, mut areas) = (0.0, 0.0);
    for (at, area) in cloth.filter(|(at, _)| at.z > 0.0) {
        gaps += (at.norm() - 10.0) * area;
        areas += area;
    }
    gaps / areas
}

#[test]
fn a_piece_on_the_bias_sags_more_than_one_along_the_warp() {
    let (warp, bias) = (sag("fig10-warp"), sag("fig11-bias"));
    assert!(bias > 1.2 * warp, "{bias} {warp}");
    in_readme(&format!(
        "| 10, along the warp | sags {:.1} % of its span |",
        100.0 * warp
    ));
    in_readme(&format!(
        "| 11, on the bias | sags {:.1} % of its span |",
        100.0 * bias
    ));
}

#[test]
fn cloth_with_tension_alone_lies_closer_to_the_ball() {
    let (tension, full) = (mean_gap("fig12a-tension-only"), mean_gap("fig12b-full"));
    assert!(3.0 * tension < full, "{tension} {full}");
    in_readme(&format!(
        "| 12 a, tension alone | {tension:.2} cm above the ball's upper half on average |"
    ));
    in_readme(&format!(
        "| 12 b, all three laws | {full:.2} cm above the ball's upper half on average |"
    ));
}

#[track_caller]
fn in_readme(line: &str) {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md");
    let readme = fs::read_to_string(readme).unwrap();
    assert!(readme.contains(line), "README.md is without: {line}");
}
