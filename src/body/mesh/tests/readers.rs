//! What each reader makes of good and of bad files.

use super::*;

fn read(format: Format, bytes: &[u8]) -> Result<Mesh, MeshError> {
    Mesh::read(bytes, format, Unit::Centimetre, Up::Z)
}

/// Corners of the faces in space, apart from how they are numbered.
fn corners(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    mesh.triangles
        .iter()
        .map(|t| t.map(|corner| mesh.vertices[corner as usize]))
        .collect()
}

#[test]
fn every_format_gives_the_same_solid() {
    let (vertices, faces) = files::tetrahedron();
    let vertices: Vec<Vec3> = vertices
        .into_iter()
        .map(|v| Vec3::from(v.map(f64::from)))
        .collect();
    let plain = faces
        .iter()
        .map(|face| face.map(|corner| vertices[corner as usize]));
    let plain: Vec<_> = plain.collect();
    for (format, bytes) in files::all() {
        let mesh = read(format, &bytes).unwrap();
        assert!(mesh.inspection().closed, "{format:?}");
        assert_eq!(mesh.inspection().flipped, 0, "{format:?}");
        for (found, expected) in corners(&mesh).iter().zip(&plain) {
            for (found, expected) in found.iter().zip(expected) {
                let node = Vec3::new(
                    10.0 - 2.0 * expected.y,
                    20.0 + 2.0 * expected.x,
                    30.0 + 2.0 * expected.z,
                );
                let expected = if format == Format::Gltf {
                    &node
                } else {
                    expected
                };
                assert!(
                    (found - expected).norm() < 1e-5,
                    "{format:?}: {found} {expected}"
                );
            }
        }
    }
}

/// Readers that others wrote find the same vertices and faces.
#[test]
fn independent_readers_agree() {
    let (vertices, _) = files::tetrahedron();
    let options = tobj::LoadOptions {
        triangulate: true,
        ..Default::default()
    };
    let text = String::from_utf8(files::obj())
        .unwrap()
        .replace("\\\n", "")
        .replace(" # back from the end", "");
    let no_materials = |_: &Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials).unwrap();
    let [model] = models.as_slice() else {
        panic!("{models:?}")
    };
    let place = |corner: &u32| &model.mesh.positions[3 * *corner as usize..][..3];
    let oracle: Vec<_> = model
        .mesh
        .indices
        .iter()
        .flat_map(place)
        .map(|&cm| f64::from(cm))
        .collect();
    let ours = corners(&read(Format::Obj, &files::obj()).unwrap());
    let ours: Vec<_> = ours.iter().flatten().flatten().copied().collect();
    assert_eq!(ours, oracle);

    let text = files::stl_text();
    let oracle = stl_io::read_stl(&mut std::io::Cursor::new(text)).unwrap();
    let ours = read(Format::Stl, &files::stl_binary()).unwrap();
    let oracle: Vec<_> = oracle
        .faces
        .iter()
        .map(|face| face.vertices.map(|corner| oracle.vertices[corner].into()))
        .collect();
    let oracle = oracle
        .into_iter()
        .map(|face: [[f32; 3]; 3]| face.map(|v| Vec3::from(v.map(f64::from))));
    assert_eq!(corners(&ours), oracle.collect::<Vec<_>>());

    let parsed = ::gltf::Gltf::from_slice(&files::glb()).unwrap();
    let buffer = parsed.blob.as_deref();
    let primitive = parsed.meshes().next().unwrap().primitives().next().unwrap();
    let oracle = primitive.reader(|_| buffer);
    assert_eq!(
        oracle.read_positions().unwrap().collect::<Vec<_>>(),
        vertices
    );

    let parser = ply_rs_bw::parser::Parser::<ply_rs_bw::ply::DefaultElement>::new();
    let oracle = parser
        .read_ply(&mut files::ply(Some(true)).as_slice())
        .unwrap();
    assert_eq!(oracle.payload["vertex"].len(), vertices.len());
    for (element, vertex) in oracle.payload["vertex"]
        .iter()
        .zip(&read(Format::Ply, &files::ply(None)).unwrap().vertices)
    {
        let axis = |name: &str| match element[name] {
            ply_rs_bw::ply::Property::Float(value) => f64::from(value),
            _ => panic!("{name}"),
        };
        assert_eq!(Vec3::new(axis("x"), axis("y"), axis("z")), *vertex);
    }
}

#[track_caller]
fn refused(format: Format, bytes: impl AsRef<[u8]>, message: &str) {
    assert_eq!(
        read(format, bytes.as_ref()).unwrap_err().to_string(),
        message
    );
}

#[test]
fn bad_obj_files_are_refused_by_line() {
    use Format::Obj;
    refused(Obj, "", "the file is empty");
    refused(
        Obj,
        "v 0 0 0\n",
        "the mesh has no faces; at least one triangle with an area is needed",
    );
    refused(
        Obj,
        "v 0 0\n",
        r#"line 1: found "" where a number must stand"#,
    );
    refused(
        Obj,
        "\nv 0 0 x\n",
        r#"line 2: found "x" where a number must stand"#,
    );
    refused(Obj, "v 0 inf 0\n", "line 1: coordinate inf is not finite");
    refused(Obj, "v 0 0 NaN\n", "line 1: coordinate NaN is not finite");
    refused(
        Obj,
        "f 1 2\n",
        r#"line 1: found "f 1 2" where a face of at least three vertices must stand"#,
    );
    refused(
        Obj,
        "f 1 2 3.5\n",
        r#"line 1: found "3.5" where the number of a vertex must stand"#,
    );
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    refused(
        Obj,
        format!("{three}f 1 2 3\nf 1 2 4\n"),
        "line 5: vertex 4 is named, but there are 3 vertices, 1 to 3",
    );
    refused(
        Obj,
        format!("{three}f 0 1 2\n"),
        "line 4: vertex 0 is named, but there are 3 vertices, 1 to 3",
    );
    refused(
        Obj,
        format!("{three}f -4 1 2\n"),
        "line 4: vertex -4 is named, but there are 3 vertices, 1 to 3",
    );
    refused(
        Obj,
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n",
        "none of the 2 faces has an area",
    );
    refused(
        Obj,
        "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n",
        "none of the 1 faces has an area",
    );
    refused(
        Obj,
        format!("v 0 0 2e6\n{three}f 1 2 3\n"),
        "vertex 1: coordinate 2e6 cm is beyond 1e6 cm; is the unit right?",
    );
    refused(
        Obj,
        files::stl_binary(),
        "byte 81: found \"\\0\" where the text of an OBJ file must stand",
    );
}

#[test]
fn bad_stl_files_are_refused() {
    use Format::Stl;
    let mut cut = files::stl_binary();
    cut.truncate(200);
    refused(
        Stl,
        cut,
        "the file is cut off: byte 84 needs 200 bytes, 116 are left",
    );
    let mut lying = files::stl_binary();
    lying[80..84].fill(0xff);
    refused(
        Stl,
        lying,
        "the file is cut off: byte 84 needs 214748364750 bytes, 200 are left",
    );
    refused(
        Stl,
        "x",
        "the file is cut off: byte 0 needs 80 bytes, 1 are left",
    );
    let text = String::from_utf8(files::stl_text()).unwrap();
    refused(
        Stl,
        &text[..text.len() - 15],
        "the file is cut off: it ends in line 29, before \"endsolid\"",
    );
    refused(
        Stl,
        text.replacen("   vertex 2.5e-1 5e-1 -1e0\n", "", 1),
        "line 7: found \" endfacet\" where the third vertex of a facet must stand",
    );
    refused(
        Stl,
        "solid a\nendsolid a\n",
        "the mesh has no faces; at least one triangle with an area is needed",
    );
    refused(
        Stl,
        "solid a\nhello\n",
        r#"line 2: found "hello" where a line of an STL file must stand"#,
    );
}

#[test]
fn bad_ply_files_are_refused() {
    use Format::Ply;
    let text = String::from_utf8(files::ply(None)).unwrap();
    refused(
        Ply,
        "solid",
        r#"line 1: found "solid" where "ply" must stand"#,
    );
    refused(
        Ply,
        &text[..text.find("property uchar").unwrap()],
        "the file is cut off: it ends in line 6, before \"end_header\"",
    );
    refused(
        Ply,
        text.replace("element camera 1", "element camera 99999999999999"),
        "the file is cut off: it ends in line 24, before the last of the values that its header counts",
    );
    refused(
        Ply,
        text.replace("element vertex 4", "element vertex many"),
        r#"line 4: found "many" where a count of elements must stand"#,
    );
    refused(
        Ply,
        text.replace("property float x", "property float u"),
        r#"line 4: found "vertex" where an element with x, y and z must stand"#,
    );
    refused(
        Ply,
        text.replace("3 1 2 3 nan", "3 1 2 9 nan"),
        "face 4: vertex 9 is named, but there are 4 vertices, 0 to 3",
    );
    refused(
        Ply,
        text.replace("3 1 2 3 nan", "3 1 2 -3 nan"),
        r#"line 22: found "-3" where the number of a vertex must stand"#,
    );
    refused(
        Ply,
        text.replace("3 1 2 3 nan", "-3 1 2 3 nan"),
        r#"line 22: found "-3" where the length of a list must stand"#,
    );
    let binary = files::ply(Some(false));
    let bytes = binary.len();
    refused(
        Ply,
        &binary[..bytes - 1],
        &format!(
            "the file is cut off: byte {} needs 2 bytes, 1 are left",
            bytes - 2
        ),
    );
    let nothing = "ply\nformat ascii 1.0\nelement void 99999999999999\nend_header\n";
    refused(
        Ply,
        nothing,
        "the mesh has no faces; at least one triangle with an area is needed",
    );
}

#[test]
fn bad_gltf_files_are_refused() {
    use Format::Gltf;
    let text = String::from_utf8(files::gltf()).unwrap();
    let at = text.find("data:").unwrap();
    let end = at + text[at..].find('"').unwrap();
    refused(
        Gltf,
        format!("{}mesh.bin{}", &text[..at], &text[end..]),
        "a buffer in a file of its own, \"mesh.bin\", is not read; write the mesh as .glb",
    );
    refused(
        Gltf,
        text.replace(r#""byteOffset":48"#, r#""byteOffset":99"#),
        "the file is cut off: buffers[0] needs 123 bytes, 72 are left",
    );
    refused(
        Gltf,
        text.replace(r#""count":12"#, r#""count":4294967295"#),
        "the file is cut off: byte 48 needs 8589934590 bytes, 24 are left",
    );
    refused(
        Gltf,
        text.replace(r#""count":4,"#, r#""count":3,"#),
        "meshes[0]: vertex 3 is named, but there are 3 vertices, 0 to 2",
    );
    let mut glb = files::glb();
    let length = glb.len();
    glb.truncate(length - 1);
    assert!(matches!(read(Gltf, &glb), Err(MeshError::CutOff { .. })));
    glb[4] = 1;
    refused(
        Gltf,
        &glb,
        "version 1 of glTF is not read; write it as version 2",
    );
    assert!(matches!(
        read(Gltf, b"{}"),
        Err(MeshError::Malformed { .. })
    ));
    // A length that the crate's own container reader would subtract from.
    assert!(read(Gltf, b"glTF\x02\0\0\0\0\0\0\0").is_err());
}

/// A ring of nodes, each the child of the other, ends.
#[test]
fn nodes_that_go_round_in_a_ring_end() {
    let text = String::from_utf8(files::gltf()).unwrap();
    let ring = text.replace(r#"{"mesh":0,"#, r#"{"mesh":0,"children":[1],"#);
    assert_eq!(
        read(Format::Gltf, ring.as_bytes()).unwrap().triangles.len(),
        4
    );
}
