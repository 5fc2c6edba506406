//! The touches of a part of a cloth, taken out of the whole's and put back.

use super::{Site, Touch, Touches};
use crate::lattice::Part;

impl Touches {
    /// The touches of a part of the cloth, with all they remember.
    #[must_use]
    pub fn of_part(&self, part: &Part) -> Self {
        let mut own = Self::new(&part.lattice, self.surface);
        for (clearance, node) in own.clearance.iter_mut().zip(&part.nodes) {
            *clearance = self.clearance[*node as usize];
        }
        for (places, cell) in own.places.iter_mut().zip(&part.cells) {
            *places = self.places[*cell as usize];
        }
        let sites = self.numbers_of(part).zip(own.numbers());
        for (there, here) in sites {
            for touch in self.at_site(there) {
                // All nodes of a part's sites are in the part.
                let site = renumbered(&touch.site, |node| part.number_of(node).unwrap_or(node));
                own.touches.push(Touch {
                    number: here,
                    site,
                    ..*touch
                });
            }
        }
        own.list_by_node();
        own
    }

    /// Takes a part's touches, with all they remember, back into the whole's.
    pub fn adopt(&mut self, own: &Self, part: &Part) {
        for (clearance, node) in own.clearance.iter().zip(&part.nodes) {
            self.clearance[*node as usize] = *clearance;
        }
        for (places, cell) in own.places.iter().zip(&part.cells) {
            self.places[*cell as usize] = *places;
        }
        let mut replaced = self.numbers_of(part).peekable();
        self.touches.retain(|touch| {
            while replaced.next_if(|number| *number < touch.number).is_some() {}
            replaced.peek() != Some(&touch.number)
        });
        for (there, here) in self.numbers_of(part).zip(own.numbers()) {
            for touch in own.at_site(here) {
                let site = renumbered(&touch.site, |node| part.nodes[node as usize]);
                self.touches.push(Touch {
                    number: there,
                    site,
                    ..*touch
                });
            }
        }
        self.touches.sort_by_key(|touch| (touch.number, touch.part));
        self.list_by_node();
    }

    /// The numbers of all sites, in order.
    fn numbers(&self) -> core::ops::Range<u32> {
        let cells = self.places.len() * self.sites_of_cell();
        0..(self.clearance.len() + cells) as u32
    }

    /// The numbers that a part's sites have in the whole, in order.
    fn numbers_of<'a>(&self, part: &'a Part) -> impl Iterator<Item = u32> + use<'a> {
        let (nodes, each) = (self.clearance.len(), self.sites_of_cell());
        let of_cell = move |cell: &u32| {
            let first = nodes + *cell as usize * each;
            (first..first + each).map(|number| number as u32)
        };
        let cells = part.cells.iter().flat_map(of_cell);
        part.nodes.iter().copied().chain(cells)
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
