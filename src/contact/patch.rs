//! The touches of a patch of a cloth, taken out of the whole's and put back.

use super::{Site, Touch, Touches};
use crate::lattice::Patch;

impl Touches {
    /// The touches of a patch of the cloth, with all they remember.
    #[must_use]
    pub fn of_patch(&self, patch: &Patch) -> Self {
        let mut own = Self::new(&patch.lattice, self.surface);
        for (clearance, node) in own.clearance.iter_mut().zip(&patch.nodes) {
            *clearance = self.clearance[*node as usize];
        }
        for (places, cell) in own.places.iter_mut().zip(&patch.cells) {
            *places = self.places[*cell as usize];
        }
        let sites = self.numbers_of(patch).zip(own.numbers());
        for (there, here) in sites {
            for touch in self.at_site(there) {
                // All nodes of a patch's sites are in it.
                let site = renumbered(&touch.site, |node| patch.number_of(node).unwrap_or(node));
                own.touches.push(Touch {
                    number: here,
                    site,
                    ..*touch
                });
            }
        }
        own.list_by_node(|_| true);
        own
    }

    /// Takes a patch's touches, with all they remember, back into the whole's.
    pub fn adopt(&mut self, own: &Self, patch: &Patch) {
        for (clearance, node) in own.clearance.iter().zip(&patch.nodes) {
            self.clearance[*node as usize] = *clearance;
        }
        for (places, cell) in own.places.iter().zip(&patch.cells) {
            self.places[*cell as usize] = *places;
        }
        let mut replaced = self.numbers_of(patch).peekable();
        self.touches.retain(|touch| {
            while replaced.next_if(|number| *number < touch.number).is_some() {}
            replaced.peek() != Some(&touch.number)
        });
        for (there, here) in self.numbers_of(patch).zip(own.numbers()) {
            for touch in own.at_site(here) {
                let site = renumbered(&touch.site, |node| patch.nodes[node as usize]);
                self.touches.push(Touch {
                    number: there,
                    site,
                    ..*touch
                });
            }
        }
        self.touches.sort_by_key(|touch| (touch.number, touch.part));
        self.list_by_node(|_| true);
    }

    /// The numbers of all sites, in order.
    fn numbers(&self) -> core::ops::Range<u32> {
        let cells = self.places.len() * self.sites_of_cell();
        0..(self.clearance.len() + cells) as u32
    }

    /// The numbers that a patch's sites have in the whole, in order.
    fn numbers_of<'a>(&self, patch: &'a Patch) -> impl Iterator<Item = u32> + use<'a> {
        let (nodes, each) = (self.clearance.len(), self.sites_of_cell());
        let of_cell = move |cell: &u32| {
            let first = nodes + *cell as usize * each;
            (first..first + each).map(|number| number as u32)
        };
        let cells = patch.cells.iter().flat_map(of_cell);
        patch.nodes.iter().copied().chain(cells)
    }

    /// The touches of a site.
    fn at_site(&self, number: u32) -> &[Touch] {
        let first = self.touches.partition_point(|touch| touch.number < number);
        let rest = &self.touches[first..];
        let count = rest
            .iter()
            .take_while(|touch| touch.number == number)
            .count();
        &rest[..count]
    }
}

fn renumbered(site: &Site, number: impl Fn(u32) -> u32) -> Site {
    Site {
        nodes: site.nodes.map(number),
        ..*site
    }
}
