//! A glTF file in the making: numbers, meshes, nodes and animations, and the GLB container.

use super::{BodyMesh, shell::Shell, weave};
use crate::math::Vec3;
use serde_json::{Map, Value, json};

/// A file in the making.
#[derive(Default)]
pub(super) struct GltfFile {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

/// A mesh to be added.
pub(super) struct Mesh<'a> {
    /// What it is called.
    pub(super) name: &'a str,
    /// Its faces, left out where there are none.
    pub(super) shell: &'a Shell,
    /// Accessors of what vertices have besides place and normal.
    pub(super) attributes: Map<String, Value>,
    /// Accessors of what each morph target adds.
    pub(super) targets: Vec<Value>,
    /// Index in the list of materials.
    pub(super) material: usize,
}

impl GltfFile {
    /// Adds a mesh that stands where its points say; the index of its node.
    pub(super) fn placed_mesh(&mut self, mesh: Mesh<'_>) -> Option<usize> {
        let name = mesh.name.to_owned();
        let mesh = self.mesh(mesh)?;
        Some(self.node(json!({ "name": name, "mesh": mesh })))
    }

    /// Adds a body that stays where it is.
    pub(super) fn body(&mut self, body: &BodyMesh) {
        self.placed_mesh(Mesh {
            name: &body.name,
            shell: &Shell::of_body(body),
            attributes: Map::new(),
            targets: Vec::new(),
            material: BODY,
        });
    }

    /// Adds a node; its index.
    pub(super) fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Lets a property of a node (`translation`, `scale`, `weights`) run through the values of an
    /// accessor at the times of another, straight between them.
    pub(super) fn animate(&mut self, node: usize, property: &str, times: usize, values: usize) {
        self.samplers
            .push(json!({ "input": times, "output": values, "interpolation": "LINEAR" }));
        self.channels.push(json!({
            "sampler": self.samplers.len() - 1,
            "target": { "node": node, "path": property },
        }));
    }

    /// Adds a mesh; one without faces is left out, since glTF has no empty mesh.
    pub(super) fn mesh(&mut self, mesh: Mesh<'_>) -> Option<usize> {
        let (shell, mut attributes) = (mesh.shell, mesh.attributes);
        if shell.triangles.is_empty() {
            return None;
        }
        let position = self.vectors(&shell.vertices, 0.01, true);
        let normal = self.vectors(&shell.normals, 1.0, false);
        attributes.insert("POSITION".into(), position.into());
        attributes.insert("NORMAL".into(), normal.into());
        let bytes: Vec<u8> = shell
            .triangles
            .as_flattened()
            .iter()
            .flat_map(|index| index.to_le_bytes())
            .collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY));
        let indices = self.accessor(json!({
            "bufferView": view, "componentType": UNSIGNED_INT, "type": "SCALAR",
            "count": 3 * shell.triangles.len(),
        }));
        let mut primitive =
            json!({ "attributes": attributes, "indices": indices, "material": mesh.material });
        if !mesh.targets.is_empty() {
            primitive["targets"] = mesh.targets.into();
        }
        self.meshes
            .push(json!({ "name": mesh.name, "primitives": [primitive] }));
        Some(self.meshes.len() - 1)
    }

    /// Adds a vertex attribute of vectors, turned y up and scaled.
    pub(super) fn vectors(&mut self, vectors: &[Vec3], scale: f64, bounds: bool) -> usize {
        self.floats::<3>(vectors.iter().map(|v| y_up(v, scale)), bounds)
    }

    /// Adds a vertex attribute of N floats; its index among the accessors.
    pub(super) fn floats<const N: usize>(
        &mut self,
        rows: impl Iterator<Item = [f32; N]>,
        bounds: bool,
    ) -> usize {
        self.numbers(rows, bounds, Some(ARRAY))
    }

    /// Adds times or values of an animation, N floats each; its index among the accessors.
    pub(super) fn keys<const N: usize>(
        &mut self,
        rows: impl Iterator<Item = [f32; N]>,
        bounds: bool,
    ) -> usize {
        self.numbers(rows, bounds, None)
    }

    fn numbers<const N: usize>(
        &mut self,
        rows: impl Iterator<Item = [f32; N]>,
        bounds: bool,
        target: Option<u32>,
    ) -> usize {
        let (mut least, mut most) = ([f32::INFINITY; N], [f32::NEG_INFINITY; N]);
        let (mut bytes, mut count) = (Vec::new(), 0_usize);
        for row in rows {
            least = std::array::from_fn(|k| least[k].min(row[k]));
            most = std::array::from_fn(|k| most[k].max(row[k]));
            bytes.extend(row.iter().flat_map(|x| x.to_le_bytes()));
            count += 1;
        }
        let view = self.view(&bytes, target);
        let kind = ["", "SCALAR", "VEC2", "VEC3"]
            .get(N)
            .copied()
            .unwrap_or_default();
        let mut accessor =
            json!({ "bufferView": view, "componentType": FLOAT, "type": kind, "count": count });
        if bounds {
            accessor["min"] = json!(least.as_slice());
            accessor["max"] = json!(most.as_slice());
        }
        self.accessor(accessor)
    }

    fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds bytes, from a multiple of 4; their index among the buffer views.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        pad(&mut self.binary, 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.binary.extend(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// The file without a moving part.
    pub(super) fn finish(self) -> Vec<u8> {
        self.finish_film("")
    }

    /// The file, its animation, if there is one, under a title.
    pub(super) fn finish_film(mut self, title: &str) -> Vec<u8> {
        let mut root = json!({ "asset": { "version": "2.0", "generator": "soen" } });
        // glTF forbids empty lists, so a file without meshes is the asset line alone.
        if !self.meshes.is_empty() {
            let image = self.view(&weave::tile(128).to_png(), None);
            pad(&mut self.binary, 0);
            root["scene"] = 0.into();
            root["scenes"] = json!([{ "nodes": (0..self.nodes.len()).collect::<Vec<_>>() }]);
            root["nodes"] = self.nodes.into();
            root["meshes"] = self.meshes.into();
            root["materials"] = materials();
            root["textures"] = json!([{ "source": 0, "sampler": 0 }]);
            root["samplers"] = json!([{ "magFilter": LINEAR, "minFilter": LINEAR_MIPMAP_LINEAR }]);
            root["images"] = json!([{ "bufferView": image, "mimeType": "image/png" }]);
            if !self.channels.is_empty() {
                root["animations"] = json!([{
                    "name": title, "channels": self.channels, "samplers": self.samplers,
                }]);
            }
            root["accessors"] = self.accessors.into();
            root["bufferViews"] = self.views.into();
            root["buffers"] = json!([{ "byteLength": self.binary.len() }]);
        } else {
            self.binary.clear();
        }
        container(root.to_string().into_bytes(), &self.binary)
    }
}

/// Indices in the list of materials.
pub(super) const WOVEN: usize = 0;
pub(super) const PLAIN: usize = 1;
pub(super) const BODY: usize = 2;

fn materials() -> Value {
    let cloth = |name: &str| {
        json!({ "name": name, "doubleSided": true,
                "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.9 } })
    };
    let mut woven = cloth("woven cloth");
    woven["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
    let mut body = cloth("body");
    body["pbrMetallicRoughness"]["baseColorFactor"] = json!([0.55, 0.47, 0.40, 1.0]);
    json!([woven, cloth("cloth"), body])
}

/// The names that glTF gives to numbers.
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;
const ARRAY: u32 = 34962;
const ELEMENT_ARRAY: u32 = 34963;
const LINEAR: u32 = 9729;
const LINEAR_MIPMAP_LINEAR: u32 = 9987;

/// The binary container: a header of 12 bytes, the JSON chunk and the binary chunk.
fn container(mut json: Vec<u8>, binary: &[u8]) -> Vec<u8> {
    pad(&mut json, b' ');
    let chunk = |kind: &[u8; 4], bytes: &[u8]| {
        [&(bytes.len() as u32).to_le_bytes()[..], kind, bytes].concat()
    };
    let mut chunks = chunk(b"JSON", &json);
    if !binary.is_empty() {
        chunks.extend(chunk(b"BIN\0", binary));
    }
    let length = 12 + chunks.len() as u32;
    [
        &b"glTF"[..],
        &2_u32.to_le_bytes(),
        &length.to_le_bytes(),
        &chunks,
    ]
    .concat()
}

/// Fills up to a multiple of 4.
fn pad(bytes: &mut Vec<u8>, with: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), with);
}

/// From z up to y up.
pub(super) fn y_up(v: &Vec3, scale: f64) -> [f32; 3] {
    [v.x, v.z, -v.y].map(|x| (scale * x) as f32)
}
