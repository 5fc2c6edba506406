//! The same solid as a file of every kind.

use super::*;

/// A tetrahedron of volume 1/6 cm³ with a corner off the axes: vertices, faces.
pub(super) fn tetrahedron() -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let vertices = vec![
        [0.25, 0.5, -1.0],
        [1.25, 0.5, -1.0],
        [0.25, 1.5, -1.0],
        [0.25, 0.5, 0.0],
    ];
    (vertices, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
}

pub(super) fn obj() -> Vec<u8> {
    let (vertices, faces) = tetrahedron();
    let mut text = String::from("# r\u{e9}sum\u{e9}\nmtllib none.mtl\no thing\n");
    for [x, y, z] in vertices {
        text += &format!("v {x} {y} {z}\n");
    }
    for ([a, b, c], style) in faces.into_iter().zip(0..) {
        let [a, b, c] = [a + 1, b + 1, c + 1];
        text += &match style {
            0 => format!("f {a}/7 {b}/8 {c}/9\r\n"),
            1 => format!("f {a}//1 {b}//2 {c}//3\n"),
            2 => format!(
                "f -{} -{} \\\n-{} # back from the end\n",
                5 - a,
                5 - b,
                5 - c
            ),
            _ => format!("f {a}/1/1 {b}/1/1 {c}/1/1\n"),
        };
    }
    text.into_bytes()
}

pub(super) fn stl_text() -> Vec<u8> {
    let (vertices, faces) = tetrahedron();
    let mut text = String::from("solid thing\n");
    for face in faces {
        text += " facet normal 0 0 0\n  outer loop\n";
        for [x, y, z] in face.map(|corner| vertices[corner as usize]) {
            text += &format!("   vertex {x:e} {y:e} {z:e}\n");
        }
        text += "  endloop\n endfacet\n";
    }
    (text + "endsolid thing\n").into_bytes()
}

/// With the head that fools readers.
pub(super) fn stl_binary() -> Vec<u8> {
    let (vertices, faces) = tetrahedron();
    let mut bytes = b"solid thing, but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((faces.len() as u32).to_le_bytes());
    for face in faces {
        bytes.extend([0; 12]);
        bytes.extend(
            face.iter()
                .flat_map(|&corner| vertices[corner as usize])
                .flat_map(f32::to_le_bytes),
        );
        bytes.extend([0; 2]);
    }
    bytes
}

/// As text, or with least (`Some(false)`) or greatest (`Some(true)`) bytes first.
pub(super) fn ply(greatest_first: Option<bool>) -> Vec<u8> {
    let (vertices, faces) = tetrahedron();
    let name = match greatest_first {
        None => "ascii",
        Some(false) => "binary_little_endian",
        Some(true) => "binary_big_endian",
    };
    let mut bytes = format!(
        "ply\nformat {name} 1.0\ncomment thing\nelement vertex {}\nproperty float x\n\
         property float y\nproperty uchar red\nproperty float z\nelement face {}\n\
         property list uchar int vertex_indices\nproperty float quality\nelement camera 1\n\
         property list uint short view\nend_header\n",
        vertices.len(),
        faces.len()
    )
    .into_bytes();
    let Some(greatest_first) = greatest_first else {
        for [x, y, z] in vertices {
            bytes.extend(format!("{x} {y} 255 {z}\n").bytes());
        }
        for [a, b, c] in faces {
            bytes.extend(format!("3 {a} {b} {c} nan\n").bytes());
        }
        bytes.extend(b"2 -7 7\n");
        return bytes;
    };
    let mut put = |little: &[u8]| {
        let mut number = little.to_vec();
        if greatest_first {
            number.reverse();
        }
        bytes.extend(number);
    };
    for [x, y, z] in vertices {
        put(&x.to_le_bytes());
        put(&y.to_le_bytes());
        put(&[255]);
        put(&z.to_le_bytes());
    }
    for face in faces {
        put(&[3]);
        face.iter().for_each(|corner| put(&corner.to_le_bytes()));
        put(&f32::NAN.to_le_bytes());
    }
    put(&1_u32.to_le_bytes());
    put(&(-7_i16).to_le_bytes());
    bytes
}

/// Positions and indices one after the other, as both kinds of glTF hold them.
fn gltf_data() -> Vec<u8> {
    let (vertices, faces) = tetrahedron();
    let mut data: Vec<u8> = vertices
        .into_iter()
        .flatten()
        .flat_map(f32::to_le_bytes)
        .collect();
    data.extend(
        faces
            .into_iter()
            .flatten()
            .flat_map(|corner| (corner as u16).to_le_bytes()),
    );
    data
}

/// A node in a node, so that the tetrahedron is doubled, turned a quarter about z, and moved.
fn gltf_json(buffer: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[1]}}],
        "nodes":[{{"mesh":0,"rotation":[0,0,0.70710678,0.70710678]}},
                 {{"children":[0],"scale":[2,2,2],"translation":[10,20,30]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "buffers":[{{{buffer}"byteLength":72}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3",
                       "min":[0.25,0.5,-1],"max":[1.25,1.5,0]}},
                     {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}]}}"#
    )
}

pub(super) fn glb() -> Vec<u8> {
    let mut json = gltf_json("").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let data = gltf_data();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + data.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", data)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

pub(super) fn gltf() -> Vec<u8> {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in gltf_data().chunks(3) {
        let number = three
            .iter()
            .fold(0_u32, |number, &byte| number << 8 | u32::from(byte));
        text.extend((0..4).map(|i| char::from(letters[(number >> (18 - 6 * i) & 63) as usize])));
    }
    gltf_json(&format!(
        r#""uri":"data:application/octet-stream;base64,{text}","#
    ))
    .into_bytes()
}

/// Every file, with its format.
pub(super) fn all() -> Vec<(Format, Vec<u8>)> {
    vec![
        (Format::Obj, obj()),
        (Format::Stl, stl_text()),
        (Format::Stl, stl_binary()),
        (Format::Ply, ply(None)),
        (Format::Ply, ply(Some(false))),
        (Format::Ply, ply(Some(true))),
        (Format::Gltf, glb()),
        (Format::Gltf, gltf()),
    ]
}
