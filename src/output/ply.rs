//! PLY: the cloth with values per vertex, for measuring programs.

use super::{ClothMesh, HeatMap};

/// The cloth as PLY, binary and little-endian: cm, z up, positions as doubles, cloth coordinates
/// `warp_cm` and `weft_cm`, a float column per map (named by [`Map::column`](super::Map::column),
/// `NaN` where a node has no value), and quads.
pub fn ply(cloth: &ClothMesh<'_>, maps: &[HeatMap]) -> Vec<u8> {
    let mut bytes = header(cloth, maps).into_bytes();
    let mut columns: Vec<_> = maps.iter().map(HeatMap::column).collect();
    for (p, c) in cloth.positions.iter().zip(&cloth.lattice.coordinates) {
        for number in p.iter().chain(c) {
            bytes.extend(number.to_le_bytes());
        }
        for column in &mut columns {
            bytes.extend(column.next().unwrap_or(f32::NAN).to_le_bytes());
        }
    }
    for cell in &cloth.lattice.cells {
        bytes.push(4);
        bytes.extend(cell.iter().flat_map(|node| node.to_le_bytes()));
    }
    bytes
}

fn header(cloth: &ClothMesh<'_>, maps: &[HeatMap]) -> String {
    let nodes = cloth.positions.len().min(cloth.lattice.coordinates.len());
    let mut lines = vec![
        "ply".to_owned(),
        "format binary_little_endian 1.0".to_owned(),
        "comment soen: cloth, cm, z up".to_owned(),
        format!("element vertex {nodes}"),
    ];
    lines.extend(
        ["x", "y", "z", "warp_cm", "weft_cm"].map(|name| format!("property double {name}")),
    );
    lines.extend(
        maps.iter()
            .map(|heat| format!("property float {}", heat.map.column())),
    );
    lines.push(format!("element face {}", cloth.lattice.cells.len()));
    lines.push("property list uchar uint vertex_indices".to_owned());
    lines.push("end_header\n".to_owned());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{Map, sample};
    use ply_rs_bw::{
        parser::Parser,
        ply::{DefaultElement, Property},
    };

    #[test]
    fn an_independent_reader_finds_positions_values_and_cells() {
        let placed = sample::wave(7, 5, 0.7);
        let cloth = placed.cloth();
        let gap = vec![0.25; 34];
        let maps =
            [Map::StrainWarp, Map::Gap].map(|m| HeatMap::of(m, &cloth, None, Some(&gap)).unwrap());
        let bytes = ply(&cloth, &maps);
        let read = Parser::<DefaultElement>::new()
            .read_ply(&mut &bytes[..])
            .unwrap();
        let vertices = &read.payload["vertex"];
        assert_eq!(vertices.len(), placed.positions.len());
        for (i, (vertex, p)) in vertices.iter().zip(&placed.positions).enumerate() {
            assert_eq!(
                ["x", "y", "z"].map(|k| vertex[k].clone()),
                [p.x, p.y, p.z].map(Property::Double)
            );
            assert_eq!(
                vertex["weft_cm"],
                Property::Double(placed.lattice.coordinates[i].y)
            );
            let strain = (0.01 * maps[0].values[i]) as f32;
            assert_eq!(vertex["strain_warp"], Property::Float(strain));
        }
        assert_eq!(vertices[33]["gap_cm"], Property::Float(0.25));
        assert!(matches!(vertices[34]["gap_cm"], Property::Float(x) if x.is_nan()));
        let cells: Vec<Property> = read.payload["face"]
            .iter()
            .map(|face| face["vertex_indices"].clone())
            .collect();
        let expected: Vec<Property> = placed
            .lattice
            .cells
            .iter()
            .map(|cell| Property::ListUInt(cell.to_vec()))
            .collect();
        assert_eq!(cells, expected);
    }
}
