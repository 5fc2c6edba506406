use std::{fs, path::PathBuf};

use super::*;

mod files;
mod fuzz;
mod readers;

/// A mesh that nobody here wrote; `None`, said aloud, where the folder is not beside the crate.
#[expect(clippy::print_stderr, reason = "a test that did not run must say so")]
fn real(name: &str, unit: Unit) -> Option<Mesh> {
    let folder = PathBuf::from(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../shared/data/bodies"
    ));
    let path = folder.join(name);
    let Ok(bytes) = fs::read(&path) else {
        eprintln!("skipped: {} is absent", path.display());
        return None;
    };
    Some(Mesh::read(&bytes, Format::of_path(&path).unwrap(), unit, Up::Y).unwrap())
}

#[test]
fn spot_is_closed_once_its_texture_seams_are_merged() {
    let Some(mesh) = real("spot_triangulated.obj", Unit::Of(35.3)) else {
        return;
    };
    let found = mesh.inspection();
    assert!(found.closed, "{found}");
    assert_eq!(
        (found.triangles, found.vertices, found.components),
        (5856, 2930, 1),
        "{found}"
    );
    assert_eq!(
        (found.flipped, found.degenerate, found.duplicate),
        (0, 0, 0),
        "{found}"
    );
}

#[test]
fn what_was_done_to_unclean_spot_is_found() {
    let Some(mesh) = real("spot_unclean.obj", Unit::Of(35.3)) else {
        return;
    };
    let found = mesh.inspection();
    assert!(!found.closed, "{found}");
    assert_eq!(
        (found.holes, found.components, found.non_manifold_edges),
        (1, 1, 0),
        "{found}"
    );
    assert_eq!(
        (found.flipped, found.duplicate, found.degenerate),
        (40, 25, 1),
        "{found}"
    );
}

#[test]
fn both_women_are_single_closed_shells_standing_on_the_ground() {
    for (name, stature, triangles) in [
        ("makehuman_female_158cm.obj", 158.0, 26_756),
        ("mean_female.obj", 166.2, 47_500),
    ] {
        let Some(mesh) = real(name, Unit::Metre) else {
            return;
        };
        let found = mesh.inspection();
        assert!(found.closed, "{name}: {found}");
        assert_eq!(
            (found.components, found.triangles),
            (1, triangles),
            "{name}: {found}"
        );
        let (low, high) = found.extent;
        assert!(low.z.abs() < 0.5, "{name}: {found}");
        assert!((high.z - stature).abs() < 2.0, "{name}: {found}");
    }
}

#[test]
fn y_up_faces_the_front_and_keeps_the_hand() {
    let turned = [Vec3::x(), Vec3::y(), Vec3::z()].map(|axis| Up::Y.turned(axis));
    assert_eq!(turned, [Vec3::x(), Vec3::z(), -Vec3::y()]);
    assert_eq!(turned[0].cross(&turned[1]), turned[2]);
}

/// A box of 1 × 2 × 3 cm whose faces are quads, as text.
fn obj_box() -> String {
    let mut text = String::from("# a box\n");
    for corner in 0..8 {
        let [x, y, z] = [corner & 1, (corner >> 1) & 1, (corner >> 2) & 1];
        text += &format!("v {x} {} {}\n", 2 * y, 3 * z);
    }
    for quad in [
        "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
    ] {
        text += &format!("f {quad}\n");
    }
    text
}

fn read_obj(text: &str) -> Result<Mesh, MeshError> {
    Mesh::read(text.as_bytes(), Format::Obj, Unit::Centimetre, Up::Z)
}

/// The volume enclosed [cm³].
fn volume(mesh: &Mesh) -> f64 {
    let corner = |index: u32| mesh.vertices[index as usize];
    let sixth = |t: &[u32; 3]| corner(t[0]).dot(&corner(t[1]).cross(&corner(t[2]))) / 6.0;
    mesh.triangles.iter().map(sixth).sum()
}

#[test]
fn a_box_of_quads_is_a_solid_of_twelve_triangles() {
    let mesh = read_obj(&obj_box()).unwrap();
    assert!(mesh.inspection().closed);
    assert_eq!(mesh.triangles.len(), 12);
    assert!((volume(&mesh) - 6.0).abs() < 1e-12);
    assert_eq!(
        mesh.inspection().to_string(),
        "12 faces, 8 vertices, 1 shell; 1.0 × 2.0 × 3.0 cm, z from 0.0 to 3.0; closed, so solid"
    );
}

#[test]
fn units_scale_the_volume_by_their_cube() {
    let text = obj_box();
    for (unit, cm) in [
        (Unit::Metre, 100.0_f64),
        (Unit::Millimetre, 0.1),
        (Unit::Inch, 2.54),
        (Unit::Of(35.3), 35.3),
    ] {
        let mesh = Mesh::read(text.as_bytes(), Format::Obj, unit, Up::Y).unwrap();
        let expected = 6.0 * cm.powi(3);
        assert!((volume(&mesh) / expected - 1.0).abs() < 1e-12, "{unit:?}");
    }
    let zero = Mesh::read(text.as_bytes(), Format::Obj, Unit::Of(0.0), Up::Z);
    assert_eq!(zero, Err(MeshError::Unit { cm: 0.0 }));
}

/// Whatever faces are turned, outside is outside again.
#[test]
fn every_way_of_flipping_a_box_is_mended() {
    let whole = read_obj(&obj_box()).unwrap();
    for pattern in 0..1_u32 << 12 {
        let mut triangles = whole.triangles.clone();
        for (face, corners) in triangles.iter_mut().enumerate() {
            if pattern >> face & 1 == 1 {
                corners.swap(0, 1);
            }
        }
        let mended = Mesh::new(whole.vertices.clone(), triangles).unwrap();
        assert!(mended.inspection().closed, "{pattern:b}");
        assert_eq!(
            mended.inspection().flipped,
            pattern.count_ones() as usize,
            "{pattern:b}"
        );
        assert!((volume(&mended) - 6.0).abs() < 1e-12, "{pattern:b}");
    }
}

#[test]
fn leaving_faces_out_opens_holes_that_are_counted() {
    let whole = read_obj(&obj_box()).unwrap();
    // Quads 0 and 1 are opposite each other: below and above.
    let open = Mesh::new(whole.vertices.clone(), whole.triangles[4..].to_vec()).unwrap();
    let found = open.inspection();
    assert_eq!(
        (found.closed, found.holes, found.boundary_edges),
        (false, 2, 8),
        "{found}"
    );
    assert_eq!(found.components, 1);
}

#[test]
fn two_boxes_that_share_an_edge_are_two_solids() {
    let one = read_obj(&obj_box()).unwrap();
    let mut vertices = one.vertices.clone();
    vertices.extend(one.vertices.iter().map(|v| v + Vec3::new(1.0, 2.0, 0.0)));
    let mut triangles = one.triangles.clone();
    triangles.extend(one.triangles.iter().map(|t| t.map(|corner| corner + 8)));
    let both = Mesh::new(vertices, triangles).unwrap();
    let found = both.inspection();
    assert_eq!(
        (found.vertices, found.components, found.non_manifold_edges),
        (14, 2, 1),
        "{found}"
    );
    assert!(found.closed, "{found}");
    assert!((volume(&both) - 12.0).abs() < 1e-12);
}

/// The band's faces hang together with one seam where no winding fits.
#[test]
fn a_moebius_band_is_an_open_sheet() {
    let count = 12;
    let mut vertices = Vec::new();
    for i in 0..count {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(count);
        for side in [-1.0, 1.0] {
            let (out, up) = ((angle / 2.0).cos() * side, (angle / 2.0).sin() * side);
            let radius = 5.0 + out;
            vertices.push(Vec3::new(radius * angle.cos(), radius * angle.sin(), up));
        }
    }
    let mut triangles = Vec::new();
    for i in 0..count as u32 {
        let [a, b] = [2 * i, 2 * i + 1];
        let [c, d] = if i + 1 == count as u32 {
            [1, 0]
        } else {
            [a + 2, b + 2]
        };
        triangles.extend([[a, c, b], [b, c, d]]);
    }
    let mesh = Mesh::new(vertices, triangles).unwrap();
    let found = mesh.inspection();
    assert_eq!(
        (found.closed, found.holes, found.components),
        (false, 1, 1),
        "{found}"
    );
}

#[test]
fn a_stray_vertex_is_no_part_of_the_mesh() {
    let mesh = read_obj(&format!("{}v 900 900 900\n", obj_box())).unwrap();
    assert_eq!(mesh.inspection().extent.1, Vec3::new(1.0, 2.0, 3.0));
}

#[test]
fn formats_are_named_by_endings() {
    let format = |name: &str| Format::of_path(Path::new(name));
    assert_eq!(format("a/b.OBJ"), Some(Format::Obj));
    assert_eq!(format("b.stl"), Some(Format::Stl));
    assert_eq!(format("b.ply"), Some(Format::Ply));
    assert_eq!([format("b.glb"), format("b.gltf")], [Some(Format::Gltf); 2]);
    assert_eq!([format("b.fbx"), format("obj")], [None, None]);
}
