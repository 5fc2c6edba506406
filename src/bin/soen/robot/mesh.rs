//! Skins and figures as mesh files: cm, z up.

use super::Stood;
use crate::failure::Failure;
use soen::{body::Mesh, math::Vec3, output::BodyMesh};
use std::{fmt::Write, path::Path};

/// A format that a skin is written in.
#[derive(Clone, Copy, Debug)]
pub(super) enum Format {
    Obj,
    Stl,
    Ply,
}

impl Format {
    /// The one that a path's ending names.
    pub(super) fn of(path: &Path) -> Result<Self, Failure> {
        use soen::body::Format::{Obj, Ply, Stl};
        match soen::body::Format::of_path(path) {
            Some(Obj) => Ok(Self::Obj),
            Some(Stl) => Ok(Self::Stl),
            Some(Ply) => Ok(Self::Ply),
            _ => Err(Failure::Input(format!(
                "--mesh is {}; allowed: a path that ends in .obj, .stl or .ply",
                path.display()
            ))),
        }
    }

    pub(super) fn bytes(self, skin: &Mesh) -> Vec<u8> {
        match self {
            Self::Obj => obj(skin).into_bytes(),
            Self::Stl => stl(skin),
            Self::Ply => ply(skin),
        }
    }
}

fn obj(skin: &Mesh) -> String {
    let mut text = "# soen robot: cm, z up\no skin\n".to_owned();
    surface(&mut text, &skin.vertices, &skin.triangles, 1);
    text
}

/// The bones as lines and the balls as meshes.
pub(super) fn figure(title: &str, stood: &Stood<'_>, balls: &[BodyMesh]) -> String {
    let title = title.replace(char::is_control, " ");
    let mut text = format!("# {title}\n# soen robot: cm, z up\n");
    let mut count = 1;
    for (bone, frame) in stood.robot.skeleton().bones().iter().zip(&stood.frames) {
        // A String takes all that is written.
        let _ = writeln!(text, "o bone_{}", bone.name);
        for end in [frame.translation.vector, bone.end(frame)] {
            let _ = writeln!(text, "v {} {} {}", end.x, end.y, end.z);
        }
        let _ = writeln!(text, "l {count} {}", count + 1);
        count += 2;
    }
    for ball in balls {
        let _ = writeln!(text, "o {}", ball.name);
        surface(&mut text, &ball.vertices, &ball.triangles, count);
        count += ball.vertices.len();
    }
    text
}

/// Vertices and faces, the first vertex being number `first` of the file.
fn surface(text: &mut String, vertices: &[Vec3], triangles: &[[u32; 3]], first: usize) {
    for v in vertices {
        let _ = writeln!(text, "v {} {} {}", v.x, v.y, v.z);
    }
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| corner as usize + first);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
}

fn stl(skin: &Mesh) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((skin.triangles.len() as u32).to_le_bytes());
    for triangle in &skin.triangles {
        let corner = |index: u32| skin.vertices.get(index as usize).copied();
        let [a, b, c] = triangle.map(|index| corner(index).unwrap_or_default());
        let normal = (b - a).cross(&(c - a)).try_normalize(1e-12);
        for vector in [normal.unwrap_or_default(), a, b, c] {
            bytes.extend(vector.iter().flat_map(|x| (*x as f32).to_le_bytes()));
        }
        bytes.extend([0, 0]);
    }
    bytes
}

fn ply(skin: &Mesh) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment soen robot: cm, z up\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        skin.vertices.len(),
        skin.triangles.len()
    )
    .into_bytes();
    for vertex in &skin.vertices {
        bytes.extend(vertex.iter().flat_map(|x| x.to_le_bytes()));
    }
    for triangle in &skin.triangles {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|index| index.to_le_bytes()));
    }
    bytes
}
