//! Bodies with holes, and bodies that nobody here made.

#![expect(
    clippy::print_stderr,
    reason = "a test that did not run, or took minutes, must say so"
)]

use crate::specimen::{scene, settled};
use soen::{
    body::{Bodies, Format, Mesh, Nature, Part, Shape, Unit, Up},
    lattice::Lattice,
    math::{Pose, Vec3},
    scene::Scene,
};
use std::path::{Path, PathBuf};

/// Divisions around and from pole to pole.
const AROUND: u32 = 64;
const DOWN: u32 = 32;

/// A ball of faces [cm]; without the last rings it is open below, and every seventh face may be
/// wound against the others.
fn ball(radius: f64, rings: u32, unclean: bool) -> Mesh {
    let at = |ring: u32, step: u32| {
        let down = core::f64::consts::PI * f64::from(ring) / f64::from(DOWN);
        let around = core::f64::consts::TAU * f64::from(step) / f64::from(AROUND);
        let level = libm::sin(down);
        let point = [
            level * libm::cos(around),
            level * libm::sin(around),
            libm::cos(down),
        ];
        Vec3::from(point) * radius
    };
    let mut corners = Vec::new();
    for ring in 0..rings {
        for step in 0..AROUND {
            let [a, b] = [at(ring, step), at(ring + 1, step)];
            let [c, d] = [at(ring + 1, step + 1), at(ring, step + 1)];
            corners.extend([[a, b, c], [a, c, d]]);
        }
    }
    let faces = (0..corners.len() as u32).map(|face| {
        let first = 3 * face;
        if unclean && face % 7 == 3 {
            [first, first + 2, first + 1]
        } else {
            [first, first + 1, first + 2]
        }
    });
    let faces = faces.collect();
    Mesh::new(corners.into_iter().flatten().collect(), faces).unwrap()
}

fn body(mesh: Mesh) -> Bodies {
    let part = Part::new("body".into(), &Shape::Mesh(mesh), Pose::identity());
    Bodies::new(vec![part.unwrap()])
}

/// Points on the shown triangles between those of the certificate.
fn points(lattice: &Lattice, at: &[Vec3]) -> Vec<Vec3> {
    let of_face = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|node| at[node as usize]);
        [
            (0.0, 0.0),
            (0.2, 0.2),
            (0.2, 0.6),
            (0.6, 0.2),
            (0.5, 0.5),
            (0.5, 0.0),
        ]
        .map(|(u, v)| a * (1.0 - u - v) + b * u + c * v)
    };
    lattice.faces().flat_map(of_face).collect()
}

/// A grid of 4 × 4 points on the two triangles of each cell, its sides included.
fn sixteen_a_cell(lattice: &Lattice, at: &[Vec3]) -> Vec<Vec3> {
    let of_cell = |cell: &[u32; 4]| {
        let [a, b, c, d] = cell.map(|node| at[node as usize]);
        let point = move |k: u32| {
            let [u, v] = [k % 4, k / 4].map(|k| f64::from(k) / 3.0);
            if u >= v {
                a + (b - a) * u + (c - b) * v
            } else {
                a + (c - d) * u + (d - a) * v
            }
        };
        (0..16).map(point)
    };
    lattice.cells.iter().flat_map(of_cell).collect()
}

fn over(bodies: Bodies, text: &str) -> Scene {
    let mut scene = scene(text);
    scene.problem.bodies = bodies;
    scene
}

#[test]
fn cloth_stays_outside_of_a_ball_that_is_open_below() {
    let text = "[cloth]\nfabric = \"c\"\nsize_cm = [30, 30]\nspacing_cm = 1\n\
                centre_cm = [0, 0, 9]\n[[body]]\nball = { radius_cm = 8 }\n";
    let radius = 8.0;
    let hang = |rings, unclean| {
        let bodies = body(ball(radius, rings, unclean));
        let nature = bodies.parts()[0].nature();
        let scene = over(bodies, text);
        let drape = settled(&scene, &scene.settings, 900);
        assert!(drape.converged, "{:?}", drape.certificate);
        (nature, drape)
    };
    let (nature, whole) = hang(DOWN, false);
    assert_eq!(nature, Nature::Solid);
    let (nature, open) = hang(DOWN - 6, true);
    assert_eq!(nature, Nature::Sheet);
    // The nearest point of a face is at its middle: half a division off, along and across.
    let half = 0.5 * core::f64::consts::TAU / f64::from(AROUND);
    let inscribed = radius * libm::cos(half) * libm::cos(half);
    for drape in [&whole, &open] {
        for point in points(&drape.lattice, &drape.positions) {
            assert!(point.norm() >= inscribed - 0.05, "{point:?}");
        }
    }
    // The hole is where no cloth is, so both hang as high.
    let (a, b) = (&whole.shape, &open.shape);
    assert!((a.mean_height - b.mean_height).abs() < 0.1, "{a:?}\n{b:?}");
}

/// The folder of meshes beside the project, where it is.
fn shared() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/bodies");
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("{} is not here: nothing was tried", folder.display());
    None
}

fn read(file: &str, unit: Unit) -> Option<Mesh> {
    let bytes = std::fs::read(shared()?.join(file)).unwrap();
    Some(Mesh::read(&bytes, Format::Obj, unit, Up::Y).unwrap())
}

/// A square of 101 × 101 nodes over a body that nobody here made; `whole` is the body without
/// holes, which says where inside is.
fn over_a_body(file: &str, unit: Unit, height: u32, whole: &str) {
    let (Some(mesh), Some(whole)) = (read(file, unit), read(whole, unit)) else {
        return;
    };
    let scene = over(
        body(mesh),
        &format!(
            "[cloth]\nfabric = \"c\"\nsize_cm = [100, 100]\nspacing_cm = 1\n\
             centre_cm = [0, 0, {height}]\n[[body]]\nball = {{ radius_cm = 8 }}\n\
             [contact]\nfriction = 0.3\nthickness_cm = 0.05\n"
        ),
    );
    let drape = settled(&scene, &scene.settings, usize::MAX);
    let certificate = &drape.certificate;
    let whole = body(whole);
    let deepest = |points: Vec<Vec3>| {
        let depths = points.iter().map(|point| whole.depth(point));
        depths.fold(0.0, f64::max)
    };
    let sixteen = deepest(sixteen_a_cell(&drape.lattice, &drape.positions));
    let others = deepest(points(&drape.lattice, &drape.positions));
    eprintln!("{file}: {certificate:?}");
    eprintln!("in the whole body: 16 points a cell {sixteen:.3} cm, others {others:.3} cm");
    assert!(drape.converged && drape.positions.len() > 10_000);
    assert!(certificate.deepest <= 0.05 && sixteen <= 0.05);
}

macro_rules! bodies {
    ($($test:ident: $file:literal, $unit:expr, $height:literal, $whole:literal;)*) => {$(
        #[test]
        #[ignore = "minutes: cargo test --release -- --ignored"]
        fn $test() {
            over_a_body($file, $unit, $height, $whole);
        }
    )*};
}

const SPOT: Unit = Unit::Of(35.3);

bodies! {
    over_spot: "spot_triangulated.obj", SPOT, 80, "spot_triangulated.obj";
    over_spot_with_a_hole: "spot_unclean.obj", SPOT, 80, "spot_triangulated.obj";
    over_a_woman: "makehuman_female_158cm.obj", Unit::Metre, 170, "makehuman_female_158cm.obj";
    over_a_mean_woman: "mean_female.obj", Unit::Metre, 175, "mean_female.obj";
}
