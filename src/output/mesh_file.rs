//! Skins and figures as mesh files: cm, z up.

use super::BodyMesh;
use crate::{
    body::{Format, Mesh},
    math::{Pose, Vec3},
    robot::Robot,
};
use core::fmt::Write;

/// A mesh as a file of a format; `None` of one that is only read.
#[must_use]
pub fn mesh_file(mesh: &Mesh, format: Format) -> Option<Vec<u8>> {
    match format {
        Format::Obj => Some(obj(mesh).into_bytes()),
        Format::Stl => Some(stl(mesh)),
        Format::Ply => Some(ply(mesh)),
        _ => None,
    }
}

fn obj(mesh: &Mesh) -> String {
    let mut text = "# soen: cm, z up\no skin\n".to_owned();
    surface(&mut text, &mesh.vertices, &mesh.triangles, 1);
    text
}

/// An OBJ file of the bones at `frames` as lines, and of the muscles' meshes.
#[must_use]
pub fn figure_obj(robot: &Robot, frames: &[Pose], muscles: &[BodyMesh]) -> String {
    let title = robot.measurements().name.replace(char::is_control, " ");
    let mut text = format!("# {title}\n# soen: cm, z up\n");
    let mut count = 1;
    for (bone, frame) in robot.skeleton().bones().iter().zip(frames) {
        // A String takes all that is written.
        let _ = writeln!(text, "o bone_{}", bone.name);
        for end in [frame.translation.vector, bone.end(frame)] {
            let _ = writeln!(text, "v {} {} {}", end.x, end.y, end.z);
        }
        let _ = writeln!(text, "l {count} {}", count + 1);
        count += 2;
    }
    for ball in muscles {
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

fn stl(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((mesh.triangles.len() as u32).to_le_bytes());
    for triangle in &mesh.triangles {
        let corner = |index: u32| mesh.vertices.get(index as usize).copied();
        let [a, b, c] = triangle.map(|index| corner(index).unwrap_or_default());
        let normal = (b - a).cross(&(c - a)).try_normalize(1e-12);
        for vector in [normal.unwrap_or_default(), a, b, c] {
            bytes.extend(vector.iter().flat_map(|x| (*x as f32).to_le_bytes()));
        }
        bytes.extend([0, 0]);
    }
    bytes
}

fn ply(mesh: &Mesh) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\ncomment soen: cm, z up\n\
         element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
        mesh.vertices.len(),
        mesh.triangles.len()
    )
    .into_bytes();
    for vertex in &mesh.vertices {
        bytes.extend(vertex.iter().flat_map(|x| x.to_le_bytes()));
    }
    for triangle in &mesh.triangles {
        bytes.push(3);
        bytes.extend(triangle.iter().flat_map(|index| index.to_le_bytes()));
    }
    bytes
}
