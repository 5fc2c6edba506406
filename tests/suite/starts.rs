//! Scenes within every allowed range, however odd: each begins to drape, or is refused in words.
//!
//! The same scenes in every run; `PROPTEST_CASES=100000 cargo test --test suite starts` looks on.

use proptest::{prelude::*, test_runner::RngSeed};
use soen::{
    scene,
    solver::{Progress, Settings, prepare, settle},
};
use std::fs;

/// A cloth of more nodes is only prepared.
const MOST_NODES: usize = 250;

/// A length [cm] on a scale where 0.1, 1 and 10 are equally usual, now and then the least or the
/// greatest that is allowed.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![
        30 => (-1.3..2.0f64).prop_map(|power| 10_f64.powf(power)),
        1 => prop::sample::select(&[0.01, 1e4][..]),
    ]
}

/// A place [cm], seldom as far away as is allowed.
fn place() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        8 => Just([0.0; 3]),
        8 => [-20.0..20.0, -20.0..20.0, -20.0..20.0f64],
        8 => whole_place().prop_map(|at| at.map(f64::from)),
        1 => prop::sample::select(&[[1e5, -1e5, 1e5], [0.0, 0.0, -1e5]][..]),
    ]
}

fn whole_place() -> impl Strategy<Value = [i8; 3]> {
    [-5i8..6, -5..6, -5..6]
}

/// Any turns about the three axes [degrees].
fn turns() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        Just([0.0; 3]),
        Just([90.0, 0.0, 45.0]),
        [-360.0..360.0, -360.0..360.0, -360.0..360.0f64]
    ]
}

fn outline() -> impl Strategy<Value = String> {
    let point = [-15.0..15.0, -15.0..15.0f64];
    let star = prop::collection::vec(0.3..12.0f64, 3..9).prop_map(|radii| {
        let turn = core::f64::consts::TAU / radii.len() as f64;
        let around = radii.iter().enumerate();
        let points = around.map(|(k, radius)| {
            let (sin, cos) = (k as f64 * turn).sin_cos();
            [radius * cos, radius * sin]
        });
        format!("outline_cm = {:?}", points.collect::<Vec<_>>())
    });
    prop_oneof![
        [length(), length()].prop_map(|size| format!("size_cm = {size:?}")),
        length().prop_map(|radius| format!("disc_radius_cm = {radius:?}")),
        star.clone(),
        prop::collection::vec(point, 3..6).prop_map(|points| format!("outline_cm = {points:?}")),
        star.prop_map(|ring| ring + "\nholes_cm = [[[-0.2, -0.1], [0.2, -0.1], [0.1, 0.2]]]"),
    ]
}

fn cloth() -> impl Strategy<Value = String> {
    let grain = prop_oneof![
        prop::sample::select(&[0.0, 45.0, 90.0, -180.0][..]),
        -360.0..360.0f64
    ];
    let axes = prop::sample::select(
        &[
            "",
            "x_axis = [0, 1, 0]\ny_axis = [0, 0, 1]\n",
            "x_axis = [0, 0, -1]\ny_axis = [1, 0, 0]\n",
            "x_axis = [0.6, 0, 0.8]\ny_axis = [0, -1, 0]\n",
        ][..],
    );
    let fabric = prop::sample::select(&["a", "b", "c", "d", "washi"][..]);
    (outline(), length(), grain, fabric, place(), axes).prop_map(
        |(outline, spacing, grain, fabric, at, axes)| {
            format!(
                "[cloth]\nfabric = {fabric:?}\n{outline}\nspacing_cm = {spacing:?}\n\
                 grain_deg = {grain:?}\ncentre_cm = {at:?}\n{axes}"
            )
        },
    )
}

fn hold() -> impl Strategy<Value = String> {
    let point = [-8.0..8.0, -8.0..8.0f64].prop_map(|at| format!("point_cm = {at:?}"));
    let edge = prop::sample::select(&["x-min", "x-max", "y-min", "y-max"][..]);
    let grip = prop_oneof![point, edge.prop_map(|edge| format!("edge = {edge:?}"))];
    let carry = prop_oneof![Just([0.0; 3]), [-2.0..2.0, -2.0..2.0, -2.0..2.0f64]];
    (grip, any::<bool>(), carry).prop_map(|(grip, clamp, carry)| {
        format!("[[hold]]\n{grip}\nclamp = {clamp}\nmove_cm = {carry:?}\n")
    })
}

fn body() -> impl Strategy<Value = String> {
    let shape = prop_oneof![
        length().prop_map(|r| format!("ball = {{ radius_cm = {r:?} }}")),
        [length(), length()]
            .prop_map(|[r, l]| format!("capsule = {{ radius_cm = {r:?}, length_cm = {l:?} }}")),
        [length(), length()]
            .prop_map(|[r, h]| format!("cylinder = {{ radius_cm = {r:?}, height_cm = {h:?} }}")),
        [length(), length()]
            .prop_map(|[r, h]| format!("cone = {{ radius_cm = {r:?}, height_cm = {h:?} }}")),
        [length(), length(), length()]
            .prop_map(|size| format!("cuboid = {{ size_cm = {size:?} }}")),
        prop::collection::vec(whole_place(), 4..9)
            .prop_map(|points| format!("convex_hull = {{ points_cm = {points:?} }}")),
        Just("mesh = { file = \"faces.obj\", unit = \"cm\" }".to_owned()),
    ];
    (shape, place(), turns()).prop_map(|(shape, at, turn)| {
        format!("[[body]]\n{shape}\nat_cm = {at:?}\nrotate_deg = {turn:?}\n")
    })
}

/// Any triangles over a few points: holes, flipped, doubled and crossing faces.
fn faces() -> impl Strategy<Value = String> {
    let points = prop::collection::vec(whole_place(), 4..9);
    let corners = [1..9usize, 1..9, 1..9];
    (points, prop::collection::vec(corners, 1..14)).prop_map(|(points, faces)| {
        let count = points.len();
        let vertices = points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
        let faces = faces.iter().map(|face| {
            let [a, b, c] = face.map(|corner| (corner - 1) % count + 1);
            format!("f {a} {b} {c}\n")
        });
        vertices.chain(faces).collect()
    })
}

fn rules() -> impl Strategy<Value = String> {
    let laws = prop::sample::select(
        &[
            "[\"tension\", \"bending\", \"shear\"]",
            "[\"tension\"]",
            "[\"bending\"]",
            "[\"shear\"]",
        ][..],
    );
    let forces = prop::sample::select(&["lattice", "lattice", "paper"][..]);
    (0.0..5.0f64, 0.0001..2.0f64, laws, forces).prop_map(|(friction, thick, laws, forces)| {
        format!(
            "[contact]\nfriction = {friction:?}\nthickness_cm = {thick:?}\n\
             [solve]\nlaws = {laws}\nforces = {forces:?}\n"
        )
    })
}

/// A scene and its mesh file.
fn any_scene() -> impl Strategy<Value = (String, String)> {
    let holds = prop::collection::vec(hold(), 0..4);
    let bodies = prop::collection::vec(body(), 0..3);
    let scene = (cloth(), holds, bodies, rules()).prop_map(|(cloth, holds, bodies, rules)| {
        cloth + &holds.concat() + &bodies.concat() + &rules
    });
    (scene, faces())
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default()
    })]

    #[test]
    fn any_scene_in_range_begins_or_is_refused((text, faces) in any_scene()) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        fs::write(&path, &text).unwrap();
        fs::write(folder.path().join("faces.obj"), faces).unwrap();
        let scene = match scene::read(&path) {
            Ok(scene) => scene,
            Err(error) => {
                prop_assert!(error.to_string().contains("scene.toml"), "{error}\n{text}");
                return Ok(());
            }
        };
        let lattice = match prepare(&scene.problem) {
            Ok(lattice) => lattice,
            Err(error) => {
                let refusal = scene.refusal(error).to_string();
                prop_assert!(refusal.contains("scene.toml:"), "{refusal}\n{text}");
                return Ok(());
            }
        };
        if lattice.coordinates.len() > MOST_NODES {
            return Ok(());
        }
        let mut rounds = 3;
        let mut watch = |_: &Progress| {
            rounds -= 1;
            rounds > 0
        };
        let settings = Settings { frames: 1, ..scene.settings };
        match settle(&scene.problem, &settings, &mut watch) {
            Ok(settled) => {
                prop_assert_eq!(settled.positions.len(), lattice.coordinates.len());
                let mut numbers = settled.positions.iter().flatten();
                prop_assert!(numbers.all(|number| number.is_finite()), "{text}");
            }
            Err(error) => prop_assert!(false, "prepared, and yet: {error}\n{text}"),
        }
    }
}
