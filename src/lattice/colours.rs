//! Sets of nodes that can be moved in any order.

use crate::lattice::Lattice;

impl Lattice {
    /// Nodes by colour `(i + 2j) mod 5` over the grid, each list in lattice order. Two nodes of one
    /// colour never share a rod, a bend, a corner or a cell: these join nodes at most two steps
    /// apart along one yarn or one step along each.
    #[must_use]
    pub fn colours(&self) -> [Vec<u32>; 5] {
        let mut colours: [Vec<u32>; 5] = Default::default();
        for (node, [i, j]) in (0_u32..).zip(&self.grid) {
            let colour = (i + 2 * j).rem_euclid(5);
            if let Some(nodes) = colours.get_mut(colour.unsigned_abs() as usize) {
                nodes.push(node);
            }
        }
        colours
    }
}

#[cfg(test)]
mod tests {
    use crate::lattice::{Outline, sample::cut};

    #[test]
    fn nodes_of_one_colour_share_nothing() {
        for outline in [Outline::rectangle(7.0, 5.0), Outline::disc(4.0)] {
            let lattice = cut(outline.unwrap(), 0.0, 0.5);
            let mut colour_of = vec![9; lattice.coordinates.len()];
            for (colour, nodes) in lattice.colours().iter().enumerate() {
                for node in nodes {
                    colour_of[*node as usize] = colour;
                }
            }
            assert!(colour_of.iter().all(|colour| *colour < 5));
            let rods = lattice.rods.iter().map(|rod| rod.nodes.to_vec());
            let bends = lattice.bends.iter().map(|bend| bend.nodes.to_vec());
            let corners = lattice.corners.iter().map(|corner| corner.nodes.to_vec());
            let cells = lattice.cells.iter().map(|cell| cell.to_vec());
            for mut group in rods.chain(bends).chain(corners).chain(cells) {
                group.sort_unstable();
                group.dedup();
                let mut colours: Vec<_> = group.iter().map(|n| colour_of[*n as usize]).collect();
                colours.sort_unstable();
                colours.dedup();
                assert_eq!(colours.len(), group.len());
            }
        }
    }
}
