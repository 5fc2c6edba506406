//! GLB (glTF 2.0): cloth and bodies for viewers and other programs, in metres, y up.

use super::{BodyMesh, ClothMesh, HeatMap, shell::Shell, weave};
use crate::math::Vec3;
use serde_json::{Map, Value, json};

/// The cloth and the bodies as a GLB file: metres, y up, smooth normals.
///
/// The cloth has a vertex per node, in lattice order, is seen from both sides, and carries a woven
/// check laid by its cloth coordinates. Each map becomes a vertex attribute named after its column
/// (`_STRAIN_WARP`, …); the first also colours the cloth, instead of the check. glTF knows no
/// "no value": such a node gets 0. Bodies are smooth but for creases.
pub fn glb(cloth: &ClothMesh<'_>, bodies: &[BodyMesh], maps: &[HeatMap]) -> Vec<u8> {
    let mut file = Glb::default();
    let shell = Shell::of_cloth(cloth);
    let mut attributes = cloth_attributes(&mut file, cloth, maps);
    let material = if maps.is_empty() { WOVEN } else { PLAIN };
    file.mesh("cloth", &shell, &mut attributes, material);
    for body in bodies {
        file.mesh(&body.name, &Shell::of_body(body), &mut Map::new(), BODY);
    }
    file.finish()
}

/// Indices in the list of materials.
const WOVEN: usize = 0;
const PLAIN: usize = 1;
const BODY: usize = 2;

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

/// Texture coordinates, and values and colours where maps are given.
fn cloth_attributes(file: &mut Glb, cloth: &ClothMesh<'_>, maps: &[HeatMap]) -> Map<String, Value> {
    let nodes = cloth.positions.len();
    let mut attributes = Map::new();
    let repeats = cloth
        .lattice
        .coordinates
        .iter()
        .map(|c| (c / weave::REPEAT).map(|x| x as f32).into());
    let repeats = repeats.chain(std::iter::repeat([0.0; 2])).take(nodes);
    attributes.insert("TEXCOORD_0".into(), file.floats::<2>(repeats, false).into());
    for heat in maps {
        let values = heat.column().map(|x| if x.is_nan() { [0.0] } else { [x] });
        let values = values.chain(std::iter::repeat([0.0])).take(nodes);
        let name = format!("_{}", heat.map.column().to_uppercase());
        attributes.insert(name, file.floats::<1>(values, false).into());
    }
    if let Some(heat) = maps.first() {
        let scale = heat.scale();
        let values = heat
            .values
            .iter()
            .copied()
            .chain(std::iter::repeat(f64::NAN))
            .take(nodes);
        let colours = values.map(|x| scale.colour(x).map(|c| c.clamp(0.0, 1.0) as f32).into());
        attributes.insert("COLOR_0".into(), file.floats::<3>(colours, false).into());
    }
    attributes
}

/// A file in the making.
#[derive(Default)]
struct Glb {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
}

impl Glb {
    /// Adds a mesh; one without faces is left out, since glTF has no empty mesh.
    fn mesh(
        &mut self,
        name: &str,
        shell: &Shell,
        attributes: &mut Map<String, Value>,
        material: usize,
    ) {
        if shell.triangles.is_empty() {
            return;
        }
        let rows = |vectors: &[Vec3], scale: f64| {
            vectors
                .iter()
                .map(|v| y_up(v, scale))
                .collect::<Vec<_>>()
                .into_iter()
        };
        let position = self.floats::<3>(rows(&shell.vertices, 0.01), true);
        let normal = self.floats::<3>(rows(&shell.normals, 1.0), false);
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
        self.meshes.push(json!({ "name": name, "primitives": [
            { "attributes": attributes, "indices": indices, "material": material }] }));
    }

    /// Adds a vertex attribute of N floats; its index among the accessors.
    fn floats<const N: usize>(
        &mut self,
        rows: impl Iterator<Item = [f32; N]>,
        bounds: bool,
    ) -> usize {
        let (mut least, mut most) = ([f32::INFINITY; N], [f32::NEG_INFINITY; N]);
        let (mut bytes, mut count) = (Vec::new(), 0_usize);
        for row in rows {
            least = std::array::from_fn(|k| least[k].min(row[k]));
            most = std::array::from_fn(|k| most[k].max(row[k]));
            bytes.extend(row.iter().flat_map(|x| x.to_le_bytes()));
            count += 1;
        }
        let view = self.view(&bytes, Some(ARRAY));
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

    fn finish(mut self) -> Vec<u8> {
        let mut root = json!({ "asset": { "version": "2.0", "generator": "soen" } });
        // glTF forbids empty lists, so a file without meshes is the asset line alone.
        if !self.meshes.is_empty() {
            let image = self.view(&weave::tile(128).to_png(), None);
            pad(&mut self.binary, 0);
            let nodes: Vec<Value> = self
                .meshes
                .iter()
                .enumerate()
                .map(|(index, mesh)| json!({ "name": mesh["name"], "mesh": index }))
                .collect();
            root["scene"] = 0.into();
            root["scenes"] = json!([{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }]);
            root["nodes"] = nodes.into();
            root["meshes"] = self.meshes.into();
            root["materials"] = materials();
            root["textures"] = json!([{ "source": 0, "sampler": 0 }]);
            root["samplers"] = json!([{ "magFilter": LINEAR, "minFilter": LINEAR_MIPMAP_LINEAR }]);
            root["images"] = json!([{ "bufferView": image, "mimeType": "image/png" }]);
            root["accessors"] = self.accessors.into();
            root["bufferViews"] = self.views.into();
            root["buffers"] = json!([{ "byteLength": self.binary.len() }]);
        } else {
            self.binary.clear();
        }
        container(root.to_string().into_bytes(), &self.binary)
    }
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
fn y_up(v: &Vec3, scale: f64) -> [f32; 3] {
    [v.x, v.z, -v.y].map(|x| (scale * x) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{self, sample};
    use gltf::{Gltf, Semantic};

    fn bodies() -> [BodyMesh; 3] {
        let ball = sample::ball(Vec3::new(0.0, 0.0, -6.0), 5.0, 12);
        let empty = BodyMesh {
            name: "nothing".into(),
            ..BodyMesh::default()
        };
        [
            ball,
            empty,
            sample::cuboid(Vec3::zeros(), Vec3::new(3.0, 2.0, 1.0)),
        ]
    }

    #[test]
    fn an_independent_reader_accepts_cloth_and_bodies() {
        let placed = sample::wave(7, 5, 0.7);
        let cloth = placed.cloth();
        let file = Gltf::from_slice(&glb(&cloth, &bodies(), &[])).unwrap();
        let names: Vec<_> = file
            .nodes()
            .map(|node| node.mesh().unwrap().index())
            .collect();
        assert_eq!(names, [0, 1, 2]);
        let cloth = file.meshes().next().unwrap().primitives().next().unwrap();
        assert!(cloth.material().double_sided());
        assert!(
            cloth
                .material()
                .pbr_metallic_roughness()
                .base_color_texture()
                .is_some()
        );
        let reader = cloth.reader(|_| file.blob.as_deref());
        let read: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let expected: Vec<[f32; 3]> = placed
            .positions
            .iter()
            .map(|p| [0.01 * p.x, 0.01 * p.z, -0.01 * p.y].map(|x| x as f32))
            .collect();
        assert_eq!(read, expected);
        let normals: Vec<[f32; 3]> = reader.read_normals().unwrap().collect();
        assert!(normals.iter().all(|n| n[1] > 0.5), "{normals:?}");
        assert_eq!(
            reader.read_indices().unwrap().into_u32().count(),
            6 * placed.lattice.cells.len()
        );
    }

    #[test]
    fn bounds_lengths_and_indices_hold_for_every_mesh() {
        let placed = sample::wave(7, 5, 0.7);
        let bytes = glb(&placed.cloth(), &bodies(), &[]);
        assert_eq!(bytes.len() % 4, 0);
        let file = Gltf::from_slice(&bytes).unwrap();
        for mesh in file.meshes() {
            let primitive = mesh.primitives().next().unwrap();
            let reader = primitive.reader(|_| file.blob.as_deref());
            let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
            let bounds = primitive.bounding_box();
            for k in 0..3 {
                let least = positions.iter().map(|p| p[k]).fold(f32::INFINITY, f32::min);
                let most = positions
                    .iter()
                    .map(|p| p[k])
                    .fold(f32::NEG_INFINITY, f32::max);
                assert_eq!((least, most), (bounds.min[k], bounds.max[k]));
            }
            let normals: Vec<[f32; 3]> = reader.read_normals().unwrap().collect();
            assert_eq!(normals.len(), positions.len());
            let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            assert!(indices.iter().all(|&i| (i as usize) < positions.len()));
        }
    }

    #[test]
    fn faces_keep_their_outside() {
        let placed = sample::wave(3, 3, 0.7);
        let bytes = glb(&placed.cloth(), &bodies(), &[]);
        let file = Gltf::from_slice(&bytes).unwrap();
        for mesh in file.meshes() {
            let primitive = mesh.primitives().next().unwrap();
            let reader = primitive.reader(|_| file.blob.as_deref());
            let vectors = |list: Vec<[f32; 3]>| -> Vec<_> {
                list.into_iter().map(nalgebra::Vector3::from).collect()
            };
            let positions = vectors(reader.read_positions().unwrap().collect());
            let normals = vectors(reader.read_normals().unwrap().collect());
            let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            for corners in indices.as_chunks::<3>().0 {
                let [a, b, c] = corners.map(|i| positions[i as usize]);
                let outward = (b - a).cross(&(c - a));
                assert!(
                    corners
                        .iter()
                        .all(|&i| outward.dot(&normals[i as usize]) > 0.0)
                );
            }
        }
    }

    #[test]
    fn maps_become_attributes_and_colours() {
        let placed = sample::wave(7, 5, 0.7);
        let cloth = placed.cloth();
        let gap = vec![0.25; 34];
        let maps = [output::Map::Gap, output::Map::Shear]
            .map(|map| HeatMap::of(map, &cloth, None, Some(&gap)).unwrap());
        let file = Gltf::from_slice(&glb(&cloth, &[], &maps)).unwrap();
        let primitive = file.meshes().next().unwrap().primitives().next().unwrap();
        let accessor = primitive.get(&Semantic::Extras("GAP_CM".into())).unwrap();
        assert_eq!(accessor.count(), 35);
        let view = accessor.view().unwrap();
        let bytes = &file.blob.as_deref().unwrap()[view.offset()..view.offset() + view.length()];
        let values: Vec<f32> = bytes
            .as_chunks::<4>()
            .0
            .iter()
            .map(|b| f32::from_le_bytes(*b))
            .collect();
        assert_eq!(values[..34], [0.25; 34]);
        assert_eq!(values[34], 0.0);
        assert!(
            primitive
                .get(&Semantic::Extras("SHEAR_DEG".into()))
                .is_some()
        );
        assert!(primitive.get(&Semantic::Colors(0)).is_some());
    }

    #[test]
    fn a_file_without_faces_is_still_a_file() {
        let mut placed = sample::wave(2, 2, 0.7);
        placed.positions[0].x = f64::NAN;
        let cloth = placed.cloth();
        let file = Gltf::from_slice(&glb(&cloth, &[], &[])).unwrap();
        assert_eq!(file.meshes().count(), 0);
    }
}
