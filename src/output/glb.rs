//! GLB (glTF 2.0): cloth and bodies for viewers and other programs, in metres, y up.

use super::{
    BodyMesh, ClothMesh, HeatMap,
    gltf_file::{GltfFile, Mesh, PLAIN, WOVEN},
    shell::Shell,
    weave,
};
use serde_json::{Map, Value};

/// The cloth and the bodies as a GLB file: metres, y up, smooth normals.
///
/// The cloth has a vertex per node, in lattice order, is seen from both sides, and carries a woven
/// check laid by its cloth coordinates. Each map becomes a vertex attribute named after its column
/// (`_STRAIN_WARP`, …); the first also colours the cloth, instead of the check. glTF knows no
/// "no value": such a node gets 0. Bodies are smooth but for creases.
pub fn glb(cloth: &ClothMesh<'_>, bodies: &[BodyMesh], maps: &[HeatMap]) -> Vec<u8> {
    let mut file = GltfFile::default();
    let attributes = cloth_attributes(&mut file, cloth, maps);
    file.placed_mesh(Mesh {
        name: "cloth",
        shell: &Shell::of_cloth(cloth),
        attributes,
        targets: Vec::new(),
        material: if maps.is_empty() { WOVEN } else { PLAIN },
    });
    for body in bodies {
        file.body(body);
    }
    file.finish()
}

/// Texture coordinates, and values and colours where maps are given.
pub(super) fn cloth_attributes(
    file: &mut GltfFile,
    cloth: &ClothMesh<'_>,
    maps: &[HeatMap],
) -> Map<String, Value> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        math::Vec3,
        output::{self, sample},
    };
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
