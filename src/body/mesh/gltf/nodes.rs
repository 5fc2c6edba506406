use std::collections::BTreeSet;

use nalgebra::{Matrix4, Quaternion, UnitQuaternion, Vector3};
use serde_json::Value;

use super::{
    super::{MeshError, Place},
    json,
};

/// A mesh and where it stands.
pub(super) struct Placed {
    /// Its number in the file.
    pub(super) mesh: usize,
    /// From its coordinates to the scene's.
    pub(super) transform: Matrix4<f64>,
}

/// The meshes of the scene. The format demands a tree of nodes; in a file that breaks the rule
/// each node still comes once.
pub(super) fn placed(document: &Value) -> Result<Vec<Placed>, MeshError> {
    let mut seen = BTreeSet::new();
    let mut waiting: Vec<_> = roots(document)?
        .into_iter()
        .rev()
        .map(|node| (node, Matrix4::identity()))
        .collect();
    let mut placed = Vec::new();
    while let Some((index, parent)) = waiting.pop() {
        if !seen.insert(index) {
            continue;
        }
        let place = Place::Item {
            list: "nodes",
            index,
        };
        let node = json::item(document, "nodes", index)?;
        let transform = parent * own_transform(place, node)?;
        let children = indices(node, "children");
        waiting.extend(children.into_iter().rev().map(|child| (child, transform)));
        if let Some(mesh) = json::number(place, node, "mesh")? {
            // A skinned mesh stands where its joints put it, not its node: its own coordinates
            // are its pose when it was bound to them.
            let is_skinned = node.get("skin").is_some();
            let transform = if is_skinned {
                Matrix4::identity()
            } else {
                transform
            };
            placed.push(Placed { mesh, transform });
        }
    }
    Ok(placed)
}

/// The nodes of the scene to be shown, of the first one, or all that are no node's child.
fn roots(document: &Value) -> Result<Vec<usize>, MeshError> {
    let shown = json::number(Place::File, document, "scene")?.unwrap_or(0);
    if let Some(scene) = json::list(document, "scenes").get(shown) {
        return Ok(indices(scene, "nodes"));
    }
    let nodes = json::list(document, "nodes");
    let children: BTreeSet<usize> = nodes
        .iter()
        .flat_map(|node| indices(node, "children"))
        .collect();
    Ok((0..nodes.len())
        .filter(|node| !children.contains(node))
        .collect())
}

fn indices(of: &Value, key: &str) -> Vec<usize> {
    let whole = |value: &Value| usize::try_from(value.as_u64()?).ok();
    json::list(of, key).iter().filter_map(whole).collect()
}

fn own_transform(place: Place, node: &Value) -> Result<Matrix4<f64>, MeshError> {
    if let Some(columns) = json::numbers::<16>(place, node, "matrix")? {
        return Ok(Matrix4::from_column_slice(&columns));
    }
    let translation = json::numbers(place, node, "translation")?.unwrap_or([0.0; 3]);
    let [x, y, z, w] = json::numbers(place, node, "rotation")?.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale = json::numbers(place, node, "scale")?.unwrap_or([1.0; 3]);
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Ok(Matrix4::new_translation(&Vector3::from(translation))
        * rotation.to_homogeneous()
        * Matrix4::new_nonuniform_scaling(&Vector3::from(scale)))
}
