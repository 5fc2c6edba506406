//! glTF 2.0: every triangle of the scene, where its node puts it.
//!
//! The JSON is looked up as it is. The `gltf` crate would type it, but its validation indexes by
//! numbers of the file (a position that names no accessor ends the program), and it refuses
//! positions without bounds, which many programs leave out.

mod accessor;
mod buffers;
mod json;
mod nodes;

use nalgebra::Matrix4;
use serde_json::Value;

use super::{
    MeshError, Place,
    source::{Soup, malformed},
};
use accessor::{indices, positions};
use buffers::Buffers;

/// Reads a .glb, or a .gltf with its buffers inside.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, MeshError> {
    let (text, binary) = buffers::split(bytes)?;
    let document: Value = serde_json::from_slice(text).map_err(|error| {
        let found = String::from_utf8_lossy(text);
        malformed(Place::Line(error.line()), &found, "the JSON of glTF 2.0")
    })?;
    check_version(&document)?;
    let buffers = Buffers::read(&document, binary)?;
    let mut soup = Soup::default();
    for node in nodes::placed(&document)? {
        let mesh = json::item(&document, "meshes", node.mesh)?;
        let place = Place::Item {
            list: "meshes",
            index: node.mesh,
        };
        for primitive in json::list(mesh, "primitives") {
            read_primitive(&mut soup, place, primitive, &node.transform, &buffers)?;
        }
    }
    Ok(soup)
}

fn check_version(document: &Value) -> Result<(), MeshError> {
    match document.pointer("/asset/version").and_then(Value::as_str) {
        Some(version) if version.starts_with("2.") => Ok(()),
        Some(version) => Err(MeshError::Unsupported {
            what: format!("version {version} of glTF"),
            instead: "write it as version 2",
        }),
        None => Err(malformed(Place::File, "", "asset.version, as in all glTF,")),
    }
}

/// How a primitive's corners make triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    List,
    Strip,
    Fan,
}

fn read_primitive(
    soup: &mut Soup,
    place: Place,
    primitive: &Value,
    transform: &Matrix4<f64>,
    buffers: &Buffers<'_>,
) -> Result<(), MeshError> {
    let mode = match json::number(place, primitive, "mode")? {
        None | Some(4) => Mode::List,
        Some(5) => Mode::Strip,
        Some(6) => Mode::Fan,
        // Points and lines have no faces.
        Some(_) => return Ok(()),
    };
    let attributes = primitive.get("attributes").unwrap_or(&Value::Null);
    let Some(accessor) = json::number(place, attributes, "POSITION")? else {
        return Ok(());
    };
    let positions = positions(buffers, accessor)?;
    let order = match json::number(place, primitive, "indices")? {
        Some(accessor) => indices(buffers, accessor)?,
        None => (0..positions.len() as u32).collect(),
    };
    let (first, count) = (soup.vertices.len() as u32, positions.len());
    for position in positions {
        soup.vertex((transform * position.push(1.0)).xyz())?;
    }
    for triangle in triangles(mode, &order) {
        if let Some(&index) = triangle.iter().find(|&&index| index as usize >= count) {
            return Err(MeshError::Index {
                place,
                index: index.into(),
                count,
                from: 0,
            });
        }
        soup.triangle(triangle.map(|index| first + index))?;
    }
    Ok(())
}

fn triangles(mode: Mode, order: &[u32]) -> Vec<[u32; 3]> {
    let steps = || {
        order
            .windows(3)
            .filter_map(|w| <[u32; 3]>::try_from(w).ok())
            .enumerate()
    };
    match (mode, order) {
        (Mode::Strip, _) => steps()
            .map(|(i, [a, b, c])| if i % 2 == 0 { [a, b, c] } else { [b, a, c] })
            .collect(),
        (Mode::Fan, [centre, ..]) => steps().map(|(_, [_, b, c])| [*centre, b, c]).collect(),
        _ => order
            .chunks_exact(3)
            .filter_map(|w| w.try_into().ok())
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_wind_all_their_triangles_alike() {
        let corners = [[0, 0], [1, 0], [0, 1], [1, 1], [0, 2]];
        let normal_z = |[a, b, c]: [u32; 3]| {
            let [a, b, c] = [a, b, c].map(|i| corners[i as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let strip = triangles(Mode::Strip, &[0, 1, 2, 3, 4]);
        assert_eq!(
            strip.into_iter().map(normal_z).collect::<Vec<_>>(),
            [1, 1, 1]
        );
        let fan = triangles(Mode::Fan, &[0, 1, 3, 4]);
        assert_eq!(fan, [[0, 1, 3], [0, 3, 4]]);
        assert_eq!(triangles(Mode::List, &[0, 1, 2, 3]), [[0, 1, 2]]);
    }
}
