//! The touches of a shape with the bodies, kept up to date as it moves.

use super::{
    Friction, Site, Sites, Skin,
    deepest::{FEATURE_REACH, Sample, nearest_of},
    places::{PLACES, Places},
    sites::corner_of,
    touch::{Settled, Touch},
};
use crate::{
    body::{Bodies, Near},
    lattice::Lattice,
    math::{Mat3, Vec3},
    threads,
};

/// What friction and skin are made of, the same for every touch.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Coulomb friction [-].
    pub friction: f64,
    /// Half the cloth's thickness: a node is kept this far outside [cm].
    pub offset: f64,
    /// Pressure that a skin answers at 0.69 of its depths [gf/cm²].
    pub pressure: f64,
    /// Depth of skin over which the force on nodes grows e-fold [cm].
    pub node_skin: f64,
    /// The same for the samples between them, which have no thickness to yield [cm].
    pub sample_skin: f64,
    /// Samples farther apart than this [cm] take in the edges of the cells.
    pub sample_distance: f64,
}

impl Surface {
    /// How far from a surface a node begins to touch [cm].
    #[must_use]
    pub fn node_reach(&self) -> f64 {
        self.offset + REACH_BEYOND
    }

    /// How far from a surface a sample between nodes begins to touch [cm].
    #[must_use]
    pub fn sample_reach(&self) -> f64 {
        SAMPLE_REACH
    }
}

/// A touch reaches this far beyond half the thickness [cm]: so deep an ordinary load presses.
const REACH_BEYOND: f64 = 0.004;
/// Slip at which friction reaches its limit [cm].
const GIVE: f64 = 0.004;
/// A friction limit that is this part below µ·N stays as it is: were it renewed at every look, load
/// and friction could answer each other for ever.
const LIMIT_KEPT: f64 = 0.001;
/// Samples between nodes begin to touch this far outside [cm]: less than nodes, so that on a
/// smooth body nodes carry and edges and sharp features meet samples.
const SAMPLE_REACH: f64 = 0.005;

/// All touches, in order of site and part.
#[derive(Clone, Debug)]
pub struct Touches {
    pub(super) sites: Sites,
    pub(super) surface: Surface,
    pub(super) pitch: f64,
    pub(super) touches: Vec<Touch>,
    /// Whether limits of friction outlast a moment without load.
    pub(super) firm: bool,
    /// Those that could act, in order.
    awake: Vec<u32>,
    /// For each node, its touches that could act.
    of_node: Vec<Vec<u32>>,
    /// No part was nearer to a node than this [cm] when it stood there.
    pub(super) clearance: Vec<(f64, Vec3)>,
    /// Where features meet each cell.
    pub(super) places: Vec<Places>,
}

impl Touches {
    /// Of a lattice's sites; none are found before the first [`refresh`](Self::refresh).
    #[must_use]
    pub fn new(lattice: &Lattice, surface: Surface) -> Self {
        let sites = Sites::new(lattice, surface.sample_distance);
        let nodes = lattice.coordinates.len();
        Self {
            surface,
            pitch: lattice.pitch,
            touches: Vec::new(),
            firm: false,
            awake: Vec::new(),
            of_node: vec![Vec::new(); nodes],
            clearance: vec![(0.0, Vec3::repeat(f64::INFINITY)); nodes],
            places: vec![[None; PLACES]; sites.cells().len()],
            sites,
        }
    }

    /// Sets Coulomb friction [-] from the next look at the loads on.
    pub fn rub(&mut self, friction: f64) {
        self.surface.friction = friction;
    }

    /// The touches.
    #[must_use]
    pub fn list(&self) -> &[Touch] {
        &self.touches
    }

    /// Looks again which sites are near a body: those that could touch after such moves of the nodes
    /// [cm] as `ways` has them, first of a node itself, then of the samples beside it. Anchors of
    /// touches that go on are kept.
    pub fn refresh(
        &mut self,
        at: &[Vec3],
        bodies: &Bodies,
        ways: impl Fn(usize) -> [f64; 2] + Sync + Send,
    ) {
        if bodies.parts().is_empty() {
            return;
        }
        let nodes = threads::map(at.len(), |node| {
            let reach = self.surface.node_reach() + ways(node)[0];
            let (clearance, nears) = self.look(node, &at[node], bodies, reach);
            let touch = |near: Near| self.touch(node as u32, self.sites.node(node), &near, at);
            (clearance, nears.into_iter().map(touch).collect())
        });
        let mut fresh = Vec::with_capacity(self.touches.len());
        for (node, (clearance, mut touches)) in nodes.into_iter().enumerate() {
            if let Some(clearance) = clearance {
                self.clearance[node] = (clearance, at[node]);
            }
            fresh.append(&mut touches);
        }
        let cells = threads::map(self.places.len(), |cell| {
            let nodes = self.sites.cells()[cell].iter();
            let way = nodes
                .map(|node| ways(*node as usize)[1])
                .fold(0.0, f64::max);
            let reach = self.surface.sample_reach() + way;
            self.look_at_cell(cell, at, bodies, reach)
        });
        for (known, (places, mut touches)) in self.places.iter_mut().zip(cells) {
            fresh.append(&mut touches);
            *known = places;
        }
        self.touches = fresh;
        self.list_awake(|_| true);
    }

    /// What a node has near it, and its clearance if it was measured anew.
    fn look(
        &self,
        node: usize,
        at: &Vec3,
        bodies: &Bodies,
        reach: f64,
    ) -> (Option<f64>, Vec<Near>) {
        let (clear, there) = self.clearance[node];
        // Written so that a clearance never measured (at infinity) does not count.
        if clear - (at - there).norm() > reach {
            return (None, Vec::new());
        }
        let wide = 2.0 * reach + self.pitch;
        let mut nears = bodies.near(at, wide);
        let nearest = nearest_of(&nears, wide);
        nears.retain(|near| near.distance <= reach);
        (Some(nearest), nears)
    }

    /// What the samples of a cell and the places of its features have near them.
    fn look_at_cell(
        &self,
        cell: usize,
        at: &[Vec3],
        bodies: &Bodies,
        reach: f64,
    ) -> (Places, Vec<Touch>) {
        let wide = reach.max(FEATURE_REACH * self.pitch);
        if self.clear_of(cell, at) > wide {
            return ([None; PLACES], Vec::new());
        }
        let nears = |place, reach| {
            let corner = self.sites.cells()[cell][corner_of(place)];
            let point = self.sites.in_cell(cell, place).at(at);
            bodies.near_from(&at[corner as usize], &point, reach)
        };
        let look = |place| (place, nears(place, wide));
        let mut all: Vec<Sample> = self.sites.places().map(look).collect();
        let places = self.remember(cell, &nears, wide, &all);
        all.extend(
            places
                .iter()
                .map(|place| place.map_or(([0.0; 2], Vec::new()), look)),
        );
        let first = self.clearance.len() + cell * self.sites_of_cell();
        let mut found = Vec::new();
        for (k, (place, nears)) in all.into_iter().enumerate() {
            let site = self.sites.in_cell(cell, place);
            let nears = nears.into_iter().filter(|near| near.distance <= reach);
            found.extend(nears.map(|near| self.touch((first + k) as u32, site, &near, at)));
        }
        (places, found)
    }

    fn touch(&self, number: u32, site: Site, near: &Near, at: &[Vec3]) -> Touch {
        let here = site.at(at);
        let key = (number, near.part as u32);
        let before = self
            .touches
            .binary_search_by(|touch| (touch.number, touch.part).cmp(&key));
        let before = before.ok().map(|place| &self.touches[place]);
        let before = before.filter(|touch| touch.site == site);
        let surface = &self.surface;
        let (area, reach, skin) = match self.node_of(number) {
            Some(node) => (
                self.sites.node_area(node),
                surface.node_reach(),
                surface.node_skin,
            ),
            None => (
                self.sites.sample_area(),
                surface.sample_reach(),
                surface.sample_skin,
            ),
        };
        let Settled {
            normal,
            turn,
            swings,
        } = Settled::after(before, &near.normal);
        Touch {
            number: key.0,
            site,
            part: key.1,
            normal,
            turn,
            swings,
            top: normal.dot(&here) - near.distance + reach,
            skin: Skin {
                scale: self.surface.pressure * area,
                depth: skin,
            },
            friction: Friction {
                limit: before.map_or(0.0, |touch| touch.friction.limit),
                give: GIVE,
            },
            anchor: before.map_or(here, |touch| touch.anchor),
        }
    }

    /// The node that a site is, if it is one.
    fn node_of(&self, number: u32) -> Option<usize> {
        let number = number as usize;
        (number < self.clearance.len()).then_some(number)
    }

    /// Samples and remembered places of a cell.
    pub(super) fn sites_of_cell(&self) -> usize {
        self.sites.samples() + PLACES
    }

    /// Lists the touches that could act.
    pub(super) fn list_awake(&mut self, is_awake: impl Fn(usize) -> bool) {
        self.awake.clear();
        for list in &mut self.of_node {
            list.clear();
        }
        for (k, touch) in self.touches.iter().enumerate() {
            if !is_awake(k) {
                continue;
            }
            self.awake.push(k as u32);
            for (node, _) in touch.site.shares() {
                self.of_node[node as usize].push(k as u32);
            }
        }
    }

    fn each_awake(&self) -> impl Iterator<Item = &Touch> {
        self.awake.iter().map(|k| &self.touches[*k as usize])
    }

    /// Leaves out of energy and forces, until the next look, all touches that neither press nor rub
    /// nor would after such moves of their nodes [cm].
    pub fn wake(&mut self, at: &[Vec3], way: impl Fn(usize) -> f64 + Sync + Send) {
        let wakes = threads::map(self.touches.len(), |k| {
            let touch = &self.touches[k];
            if touch.friction.limit > 0.0 {
                return true;
            }
            let clear = touch.normal.dot(&touch.site.at(at)) - touch.top;
            let shares = touch.site.shares();
            clear
                < shares
                    .map(|(node, _)| way(node as usize))
                    .fold(0.0, f64::max)
        });
        self.list_awake(|k| wakes[k]);
    }

    /// Sets every friction limit to µ times the normal force now. Touches that do not press let
    /// go of their anchor. While the cloth is held firmly, what holds on
    /// keeps its limit.
    pub fn look_at_loads(&mut self, at: &[Vec3]) {
        for touch in &mut self.touches {
            let here = touch.site.at(at);
            let (_, load, _) = touch.skin.answer(touch.top - touch.normal.dot(&here));
            if touch.friction.limit == 0.0 {
                touch.anchor = here;
            }
            if self.firm && touch.friction.limit > 0.0 {
                continue;
            }
            let limit = self.surface.friction * load;
            if !(limit * (1.0 - LIMIT_KEPT)..=limit).contains(&touch.friction.limit) {
                touch.friction.limit = limit;
            }
        }
    }

    /// Contact projection: brings sites that a long move took deep into the skin back to where they
    /// press little harder than before. `may_move` says which nodes may be moved for it.
    pub fn bring_back(&self, from: &[Vec3], to: &mut [Vec3], may_move: impl Fn(usize) -> bool) {
        let excess = |touch: &Touch, to: &[Vec3]| {
            let depth = |at: &[Vec3]| touch.top - touch.normal.dot(&touch.site.at(at));
            depth(to) - depth(from).max(0.0) - touch.skin.depth
        };
        let excesses = threads::map(self.awake.len(), |k| {
            excess(&self.touches[self.awake[k] as usize], to)
        });
        if excesses.iter().all(|excess| *excess <= 0.0) {
            return;
        }
        let mut moved = vec![false; to.len()];
        for (touch, before) in self.each_awake().zip(excesses) {
            let nodes = touch.site.nodes;
            let now = if nodes.iter().any(|node| moved[*node as usize]) {
                excess(touch, to)
            } else {
                before
            };
            if now <= 0.0 {
                continue;
            }
            let square: f64 = touch.site.shares().map(|(_, weight)| weight * weight).sum();
            for (node, weight) in touch.site.shares() {
                if may_move(node as usize) {
                    to[node as usize] += touch.normal * (now * weight / square);
                    moved[node as usize] = true;
                }
            }
        }
    }

    /// Energy of all touches [gf·cm].
    #[must_use]
    pub fn energy(&self, at: &[Vec3]) -> f64 {
        threads::sum(self.awake.len(), |k| {
            let touch = &self.touches[self.awake[k] as usize];
            touch.energy(&touch.site.at(at))
        })
    }

    /// Adds the touches' forces to the nodes' [gf].
    pub fn add_forces(&self, at: &[Vec3], forces: &mut [Vec3]) {
        let answers = threads::map(self.awake.len(), |k| {
            let touch = &self.touches[self.awake[k] as usize];
            touch.force(&touch.site.at(at))
        });
        for (touch, force) in self.each_awake().zip(answers) {
            for (node, weight) in touch.site.shares() {
                forces[node as usize] += force * weight;
            }
        }
    }

    /// Hands the touches' stiffness [gf/cm] to `add(row, column, block)`, each pair once.
    pub fn stiffness(&self, at: &[Vec3], add: &mut dyn FnMut(u32, u32, &Mat3)) {
        let blocks = threads::map(self.awake.len(), |k| {
            let touch = &self.touches[self.awake[k] as usize];
            touch.answer(&touch.site.at(at)).map(|(_, block)| block)
        });
        for (touch, block) in self.each_awake().zip(blocks) {
            let Some(block) = block else { continue };
            for (k, (row, one)) in touch.site.shares().enumerate() {
                for (column, other) in touch.site.shares().skip(k) {
                    add(row, column, &(block * (one * other)));
                }
            }
        }
    }

    /// Force on one node [gf] and its own stiffness [gf/cm] from its touches.
    #[must_use]
    pub fn pull(&self, node: usize, at: &[Vec3]) -> (Vec3, Mat3) {
        let (mut force, mut stiffness) = (Vec3::zeros(), Mat3::zeros());
        for k in &self.of_node[node] {
            let touch = &self.touches[*k as usize];
            let here = touch.site.at(at);
            let Some((push, block)) = touch.answer(&here) else {
                continue;
            };
            let weight = touch.site.weight_of(node);
            force += push * weight;
            stiffness += block * (weight * weight);
        }
        (force, stiffness)
    }

    /// Whether a node, or a sample of its cells, is near a body.
    #[must_use]
    pub fn meets(&self, node: usize) -> bool {
        !self.of_node[node].is_empty()
    }

    /// Whether friction acts on a node, by the last look at the loads.
    #[must_use]
    pub fn rubs(&self, node: usize) -> bool {
        let mut touches = self.of_node[node].iter();
        touches.any(|k| self.touches[*k as usize].friction.limit > 0.0)
    }

    /// Force on one node [gf] from its touches after it alone has moved by `way` [cm].
    #[must_use]
    pub fn force_after(&self, node: usize, way: &Vec3, at: &[Vec3]) -> Vec3 {
        let mut force = Vec3::zeros();
        for k in &self.of_node[node] {
            let touch = &self.touches[*k as usize];
            let weight = touch.site.weight_of(node);
            let here = touch.site.at(at) + way * weight;
            if touch.friction.limit > 0.0 || touch.top > touch.normal.dot(&here) {
                force += touch.force(&here) * weight;
            }
        }
        force
    }

    /// Normal force of the bodies on each node [gf].
    #[must_use]
    pub fn loads(&self, at: &[Vec3]) -> Vec<f64> {
        let mut loads = vec![0.0; self.of_node.len()];
        for touch in &self.touches {
            let (_, load, _) = touch
                .skin
                .answer(touch.top - touch.normal.dot(&touch.site.at(at)));
            for (node, weight) in touch.site.shares() {
                loads[node as usize] += load * weight;
            }
        }
        loads
    }
}
