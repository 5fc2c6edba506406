//! Wavefront OBJ: the cloth as it was computed, for other programs and for reading back.

use super::ClothMesh;
use std::fmt::Write;

/// The cloth as Wavefront OBJ text: cm, z up, nodes in lattice order, quads counter-clockwise in
/// cloth coordinates, texture coordinates (warp, weft) [cm].
///
/// Numbers have as many digits as it takes to read the same bits back.
pub fn obj(title: &str, cloth: &ClothMesh<'_>) -> String {
    let mut text = String::with_capacity(120 * cloth.positions.len());
    // A line break inside the title would end the comment.
    let title = title.replace(char::is_control, " ");
    // Writing to a String cannot fail.
    let _ = write_obj(&mut text, &title, cloth);
    text
}

fn write_obj(text: &mut String, title: &str, cloth: &ClothMesh<'_>) -> std::fmt::Result {
    writeln!(text, "# {title}")?;
    writeln!(
        text,
        "# soen: cm, z up; vt are cloth coordinates (warp, weft) [cm]"
    )?;
    writeln!(text, "o cloth")?;
    for p in cloth.positions {
        writeln!(text, "v {} {} {}", p.x, p.y, p.z)?;
    }
    for c in &cloth.lattice.coordinates {
        writeln!(text, "vt {} {}", c.x, c.y)?;
    }
    for cell in &cloth.lattice.cells {
        let [a, b, c, d] = cell.map(|node| u64::from(node) + 1);
        writeln!(text, "f {a}/{a} {b}/{b} {c}/{c} {d}/{d}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample;

    /// The numbers of every line that starts with a key.
    fn rows(text: &str, key: &str) -> Vec<Vec<f64>> {
        text.lines()
            .filter_map(|line| line.strip_prefix(key)?.strip_prefix(' '))
            .map(|line| {
                line.split(' ')
                    .map(|number| number.parse().unwrap())
                    .collect()
            })
            .collect()
    }

    #[test]
    fn positions_read_back_to_the_same_bits() {
        let mut placed = sample::wave(7, 5, 0.7);
        placed.positions[3].x = -0.0;
        placed.positions[4].y = f64::MIN_POSITIVE;
        placed.positions[5].z = 1.0 / 3.0e17;
        let text = obj("wave", &placed.cloth());
        let bits: Vec<u64> = rows(&text, "v")
            .concat()
            .iter()
            .map(|x| x.to_bits())
            .collect();
        let expected: Vec<u64> = placed
            .positions
            .iter()
            .flatten()
            .map(|x| x.to_bits())
            .collect();
        assert_eq!(bits, expected);
        let coordinates: Vec<f64> = placed
            .lattice
            .coordinates
            .iter()
            .flatten()
            .copied()
            .collect();
        assert_eq!(rows(&text, "vt").concat(), coordinates);
    }

    #[test]
    fn an_independent_reader_finds_every_cell() {
        let placed = sample::wave(7, 5, 0.7);
        let text = obj("two\nlines", &placed.cloth());
        let options = tobj::LoadOptions {
            single_index: true,
            ..Default::default()
        };
        let (models, _) =
            tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default())).unwrap();
        let mesh = &models[0].mesh;
        assert_eq!(models.len(), 1);
        assert_eq!(models[0].name, "cloth");
        assert_eq!(mesh.face_arities, vec![4; placed.lattice.cells.len()]);
        let corners: Vec<[f32; 3]> = placed
            .lattice
            .cells
            .iter()
            .flatten()
            .map(|&node| placed.positions[node as usize].map(|x| x as f32).into())
            .collect();
        let read: Vec<[f32; 3]> = mesh
            .indices
            .iter()
            .map(|&i| std::array::from_fn(|k| mesh.positions[3 * i as usize + k]))
            .collect();
        assert_eq!(read, corners);
    }
}
