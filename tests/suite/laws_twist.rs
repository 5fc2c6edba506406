//! Twist against closed forms: what a height w(x, y) of the cloth comes to as its slopes vanish.

use crate::{
    specimen::{disc, fabric, scene, settled, towel, twisting, weightless},
    trial::SCENE,
};
use soen::{
    fabric::Fabric,
    forces::{Laws, Sheet},
    lattice::{Lattice, Outline, Piece, Twist},
    math::{Vec2, Vec3},
};

fn area(lattice: &Lattice) -> f64 {
    lattice.area.iter().sum()
}

/// The cloth where each node is put by its cloth coordinates.
fn placed(lattice: &Lattice, put: impl Fn(&Vec2) -> Vec3) -> Vec<Vec3> {
    lattice.coordinates.iter().map(put).collect()
}

fn energy(lattice: &Lattice, cloth: &Fabric, laws: Laws, at: &[Vec3]) -> f64 {
    Sheet::new(lattice, cloth, laws, &[]).energy(at)
}

const BENDING: Laws = Laws {
    tension: false,
    bending: true,
    shear: false,
};

/// Cloth that only twist acts on.
fn limp() -> Fabric {
    let mut cloth = weightless(&twisting(&fabric("c")));
    cloth.warp.bending = 0.0;
    cloth.weft.bending = 0.0;
    cloth
}

/// w = τ·x·y has the energy ½·M_TW·τ² per area: on any outline, its triangles included.
#[test]
fn a_twisted_cloth_has_the_energy_of_its_whole_area() {
    let bias = Piece {
        outline: Outline::rectangle(9.0, 6.0).unwrap(),
        grain: 0.6,
        pitch: 0.5,
    };
    let lattices = [
        towel(6.0, 4.0, 1.0),
        towel(5.0, 3.0, 0.7),
        disc(4.3, 0.6),
        bias.cut(0.5).unwrap(),
    ];
    let (cloth, tau) = (limp(), 1e-5);
    for lattice in lattices {
        let at = placed(&lattice, |c| Vec3::new(c.x, c.y, tau * c.x * c.y));
        let expected = 0.5 * cloth.twist * tau * tau * area(&lattice);
        let found = energy(&lattice, &cloth, BENDING, &at);
        assert!((found / expected - 1.0).abs() < 1e-7, "{found}, {expected}");
    }
}

#[test]
fn a_cylinder_about_warp_or_weft_is_not_twisted() {
    let (lattice, cloth, radius) = (towel(6.0, 4.0, 0.5), limp(), 1.5);
    let turned = |way: f64| [radius * (way / radius).sin(), radius * (way / radius).cos()];
    let about_weft = placed(&lattice, |c| Vec3::new(turned(c.x)[0], c.y, turned(c.x)[1]));
    let about_warp = placed(&lattice, |c| Vec3::new(c.x, turned(c.y)[0], turned(c.y)[1]));
    for at in [about_warp, about_weft] {
        assert!(energy(&lattice, &cloth, BENDING, &at) < 1e-28);
        for force in Sheet::new(&lattice, &cloth, BENDING, &[]).forces(&at) {
            assert!(force.norm() < 1e-14, "{force}");
        }
    }
}

/// w = κ·(x + y)²/4 bends the bias by κ, and warp, weft and twist by κ/2 each: so the bias has the
/// modulus (M_BN warp + M_BN weft + M_TW)/4. The ends of a row have no bend; its part is left out.
#[test]
fn the_bias_bends_by_a_quarter_of_the_three_moduli() {
    let (lattice, kappa) = (towel(6.0, 4.0, 0.5), 1e-5);
    let cloth = weightless(&twisting(&fabric("c")));
    let at = placed(&lattice, |c| {
        let along = c.x + c.y;
        Vec3::new(c.x, c.y, 0.25 * kappa * along * along)
    });
    let bends = lattice.bends.iter();
    let bends = bends.map(|bend| cloth.along(bend.yarn).bending * bend.width * bend.length);
    let moduli = bends.sum::<f64>() + cloth.twist * area(&lattice);
    let expected = 0.125 * kappa * kappa * moduli;
    let found = energy(&lattice, &cloth, Laws::default(), &at);
    assert!((found / expected - 1.0).abs() < 1e-4, "{found}, {expected}");
}

/// The gap between the diagonals of a cell off the grain is that of the heights x·y at its nodes.
#[test]
fn a_cell_beside_an_outline_measures_twist_too() {
    let lattice = disc(4.3, 0.6);
    let (mut whole, mut regular) = (0, 0);
    for Twist { nodes, per_gap, .. } in &lattice.twists {
        let corners = nodes.map(|node| lattice.coordinates[node as usize]);
        let [a, b, c, d] = corners.map(|c| Vec3::new(c.x, c.y, 1e-6 * c.x * c.y));
        let normal = (c - a).cross(&(d - b)).normalize();
        let twist = (a - b).dot(&normal) * per_gap;
        assert!((twist / 1e-6 - 1.0).abs() < 1e-6, "{twist}");
        whole += 1;
        regular += i32::from((per_gap * 0.18 - 1.0).abs() < 1e-9);
    }
    assert!(0 < regular && regular < whole, "{regular} of {whole}");
}

/// Twist joins nodes across a cell that nothing else joins where cloth has no shear.
#[test]
fn a_cloth_that_resists_twist_comes_to_rest() {
    for shear in [None, Some(0.0)] {
        let mut scene = scene(SCENE);
        let cloth = &mut scene.problem.fabric;
        cloth.twist = 0.01;
        if let Some(shear) = shear {
            cloth.warp.shear = shear;
            cloth.weft.shear = shear;
        }
        let drape = settled(&scene, &scene.settings, 20_000);
        assert!(drape.converged, "shear {shear:?}: {:?}", drape.certificate);
    }
}
