//! The cells as triangles, for meshes and pictures.

use crate::lattice::{Cell, Lattice};

/// The node that a cell has twice and the missing one's place, where it is a triangle.
fn triangle(cell: &Cell) -> Option<[u32; 3]> {
    let [a, b, c, d] = *cell;
    let repeated = [(a == d, [b, c, d]), (b == a, [a, c, d])];
    let further = [(c == b, [a, b, d]), (d == c, [a, b, c])];
    let mut found = repeated.into_iter().chain(further);
    found.find_map(|(same, nodes)| same.then_some(nodes))
}

impl Lattice {
    /// The cells as triangles of nodes, counter-clockwise in cloth coordinates, in lattice order:
    /// two for a whole cell, parted from its first node to its third, one where the outline cuts
    /// a node off. None is degenerate.
    pub fn faces(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.cells.iter().flat_map(|cell| {
            let [a, b, c, d] = *cell;
            let faces = match triangle(cell) {
                Some(face) => [Some(face), None],
                None => [Some([a, b, c]), Some([a, c, d])],
            };
            faces.into_iter().flatten()
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::lattice::{Outline, ring::cross, sample::cut};

    #[test]
    fn faces_cover_the_cloth_and_all_turn_left() {
        let lattice = cut(Outline::rectangle(12.0, 9.0).unwrap(), 35.0, 0.5);
        let mut whole = 0.0;
        for face in lattice.faces() {
            let [a, b, c] = face.map(|node| lattice.coordinates[node as usize]);
            let area = 0.5 * cross(b - a, c - a);
            assert!(area > 1e-3);
            whole += area;
        }
        assert!((whole - 108.0).abs() < 1e-9);
        assert!(lattice.faces().count() < 2 * lattice.cells.len());
    }
}
