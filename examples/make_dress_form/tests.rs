use soen::body::{Format, Unit, Up};

use super::*;

fn committed() -> Mesh {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/bodies/dress-form.obj");
    Mesh::read(
        &fs::read(path).unwrap(),
        Format::Obj,
        Unit::Centimetre,
        Up::Z,
    )
    .unwrap()
}

#[test]
fn the_form_is_one_clean_closed_shell() {
    let mesh = committed();
    let found = mesh.inspection();
    assert!(found.closed && found.components == 1, "{found}");
    assert_eq!(
        (found.flipped, found.degenerate, found.duplicate),
        (0, 0, 0),
        "{found}"
    );
    assert!((5_000..10_000).contains(&found.triangles), "{found}");
}

#[test]
fn its_girths_are_the_published_ones() {
    let mesh = committed();
    for girth in GIRTHS {
        let measured = tape::girth(&mesh, girth.height_cm);
        assert!(
            (measured - girth.girth_cm).abs() < 0.1,
            "{}: {measured} cm",
            girth.name
        );
    }
}

#[test]
fn the_hip_is_widest_and_the_waist_narrowest() {
    let mesh = committed();
    let at = |height: i32| tape::girth(&mesh, f64::from(height) / 2.0);
    let widest = (2 * 71..2 * 105)
        .max_by(|p, q| at(*p).total_cmp(&at(*q)))
        .unwrap();
    let narrowest = (2 * 80..2 * 112)
        .min_by(|p, q| at(*p).total_cmp(&at(*q)))
        .unwrap();
    assert!((f64::from(widest) / 2.0 - 78.2).abs() < 1.0, "{widest}");
    assert!(
        (f64::from(narrowest) / 2.0 - 98.0).abs() < 1.0,
        "{narrowest}"
    );
}

/// Depth over breadth: hip 0.70, waist 0.75, chest 0.70 to 0.75.
#[test]
fn sections_are_as_deep_as_published() {
    let mesh = committed();
    for (height, low, high) in [(78.2, 0.68, 0.72), (98.0, 0.73, 0.77), (113.8, 0.70, 0.78)] {
        let points = tape::section(&mesh, height);
        let span = |axis: usize| {
            let along = || points.iter().map(|p| p[axis]);
            along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min)
        };
        let ratio = span(1) / span(0);
        assert!((low..high).contains(&ratio), "{height} cm: {ratio}");
    }
}

#[test]
fn shoulders_are_as_broad_as_published() {
    let mesh = committed();
    let upper = mesh.vertices.iter().filter(|v| v.z > 116.0);
    let breadth = 2.0 * upper.map(|v| v.x.abs()).fold(0.0, f64::max);
    assert!((35.0..36.0).contains(&breadth), "{breadth}");
}

#[test]
fn left_and_right_are_alike() {
    let mesh = committed();
    let mean = mesh.vertices.iter().map(|v| v.x).sum::<f64>() / mesh.vertices.len() as f64;
    assert!(mean.abs() < 1e-3, "{mean}");
    let (low, high) = mesh.inspection().extent;
    assert!((low.x + high.x).abs() < 2e-3);
}

/// No crease that would cut cloth: neighbouring faces turn by less than 35 degrees.
#[test]
fn it_is_smooth() {
    let mesh = committed();
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|corner| mesh.vertices[corner as usize]);
        (b - a).cross(&(c - a)).normalize()
    };
    let mut sides = std::collections::BTreeMap::new();
    for triangle in &mesh.triangles {
        let [a, b, c] = *triangle;
        for (p, q) in [(a, b), (b, c), (c, a)] {
            if let Some(other) = sides.insert((p.min(q), p.max(q)), normal(triangle)) {
                let turn = other
                    .dot(&normal(triangle))
                    .clamp(-1.0, 1.0)
                    .acos()
                    .to_degrees();
                assert!(turn < 35.0, "{turn} at {}", mesh.vertices[p as usize]);
            }
        }
    }
}

#[test]
fn its_edges_are_about_a_centimetre_long() {
    let mesh = committed();
    for [a, b, c] in &mesh.triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let length = (mesh.vertices[*p as usize] - mesh.vertices[*q as usize]).norm();
            assert!((0.6..2.1).contains(&length), "{length}");
        }
    }
}

/// The program gives the file, whatever machine it runs on.
#[test]
fn the_file_is_what_the_program_makes() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/bodies/dress-form.obj");
    assert!(fs::read_to_string(path).unwrap() == obj(&dress_form().unwrap()));
}
