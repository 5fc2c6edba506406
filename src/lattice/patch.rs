//! A patch of a lattice as a lattice of its own.

use crate::lattice::Lattice;

/// Some nodes of a lattice with all that acts on them.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// The patch: every rod, bend, corner and cell with a chosen node, and all their nodes, in the
    /// order of the whole.
    pub lattice: Lattice,
    /// The whole's number of each of its nodes.
    pub nodes: Vec<u32>,
    /// The whole's number of each of its cells.
    pub cells: Vec<u32>,
}

impl Patch {
    /// The patch's number of a node of the whole, if it is in the patch.
    #[must_use]
    pub fn number_of(&self, node: u32) -> Option<u32> {
        let number = self.nodes.binary_search(&node).ok()?;
        Some(number as u32)
    }
}

impl Lattice {
    /// The patch around the chosen nodes: what each of them feels in the patch is what it feels in
    /// the whole. `chosen` has one mark for each node.
    #[must_use]
    pub fn patch(&self, chosen: &[bool]) -> Patch {
        let touches = |nodes: &[u32]| nodes.iter().any(|node| chosen[*node as usize]);
        let rods = self.rods.iter().filter(|rod| touches(&rod.nodes));
        let bends = self.bends.iter().filter(|bend| touches(&bend.nodes));
        let corners = self.corners.iter().filter(|corner| touches(&corner.nodes));
        let cells = (0_u32..).zip(&self.cells);
        let (cells, nodes_of_cells) = cells.filter(|(_, cell)| touches(*cell)).unzip();
        let mut lattice = Self {
            pitch: self.pitch,
            rods: rods.copied().collect(),
            bends: bends.copied().collect(),
            corners: corners.copied().collect(),
            cells: nodes_of_cells,
            ..Self::default()
        };
        let mut kept = chosen.to_vec();
        lattice.each_node(|node| kept[*node as usize] = true);
        let nodes: Vec<u32> = (0..)
            .zip(&kept)
            .filter(|(_, kept)| **kept)
            .map(|(node, _)| node)
            .collect();
        lattice.coordinates = of(&self.coordinates, &nodes);
        lattice.grid = of(&self.grid, &nodes);
        lattice.area = of(&self.area, &nodes);
        let mut patch = Patch {
            lattice: Self::default(),
            nodes,
            cells,
        };
        // Every node that the lists name was kept.
        lattice.each_node(|node| *node = patch.number_of(*node).unwrap_or(*node));
        patch.lattice = lattice;
        patch
    }

    /// Every node that a rod, a bend, a corner or a cell names.
    fn each_node(&mut self, mut visit: impl FnMut(&mut u32)) {
        let rods = self.rods.iter_mut().flat_map(|rod| &mut rod.nodes);
        let bends = self.bends.iter_mut().flat_map(|bend| &mut bend.nodes);
        let corners = self.corners.iter_mut().flat_map(|corner| &mut corner.nodes);
        let cells = self.cells.iter_mut().flatten();
        rods.chain(bends)
            .chain(corners)
            .chain(cells)
            .for_each(&mut visit);
    }
}

fn of<T: Clone>(all: &[T], nodes: &[u32]) -> Vec<T> {
    nodes
        .iter()
        .map(|node| all[*node as usize].clone())
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::lattice::{Outline, sample::cut};

    #[test]
    fn a_patch_has_all_that_acts_on_its_nodes() {
        let lattice = cut(Outline::disc(5.0).unwrap(), 20.0, 0.7);
        let middle = |at: &crate::math::Vec2| at.norm() < 2.0;
        let chosen: Vec<bool> = lattice.coordinates.iter().map(middle).collect();
        let patch = lattice.patch(&chosen);
        let here = |node: &u32| patch.nodes[*node as usize];
        for (node, _) in (0_u32..).zip(&chosen).filter(|(_, chosen)| **chosen) {
            let of_whole = |nodes: &[u32]| nodes.contains(&node);
            let of_patch = |nodes: &[u32]| nodes.iter().any(|n| here(n) == node);
            let rods = |all: &crate::lattice::Lattice, is: &dyn Fn(&[u32]) -> bool| {
                [
                    all.rods.iter().filter(|rod| is(&rod.nodes)).count(),
                    all.bends.iter().filter(|bend| is(&bend.nodes)).count(),
                    all.corners.iter().filter(|c| is(&c.nodes)).count(),
                    all.cells.iter().filter(|cell| is(&cell[..])).count(),
                ]
            };
            assert_eq!(rods(&lattice, &of_whole), rods(&patch.lattice, &of_patch));
        }
        for (number, node) in patch.nodes.iter().enumerate() {
            assert_eq!(
                patch.lattice.coordinates[number],
                lattice.coordinates[*node as usize]
            );
        }
        for (cell, whole) in patch.lattice.cells.iter().zip(&patch.cells) {
            assert_eq!(cell.map(|node| here(&node)), lattice.cells[*whole as usize]);
        }
        assert_eq!(lattice.patch(&vec![true; chosen.len()]).lattice, lattice);
    }
}
