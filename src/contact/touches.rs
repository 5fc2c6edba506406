//! The touches of a shape with the bodies, kept up to date as it moves.

use super::{Friction, Site, Sites, Skin};
use crate::{
    body::{Bodies, Near},
    math::{Mat3, Vec3},
    threads,
};

/// A site near one part of a body.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// The site's number.
    pub number: u32,
    /// The site.
    pub site: Site,
    /// The part of the bodies.
    pub part: u32,
    /// Out of the surface, of length 1.
    pub normal: Vec3,
    /// Depth in the skin at a position p is `top − normal·p` [cm].
    pub top: f64,
    /// The normal law.
    pub skin: Skin,
    /// The friction law, its limit as of the last look.
    pub friction: Friction,
    /// Where friction holds on [cm].
    pub anchor: Vec3,
}

/// What friction and skin are made of, the same for every touch.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Coulomb friction [-].
    pub friction: f64,
    /// Half the cloth's thickness: a node is kept this far outside [cm].
    pub offset: f64,
    /// Pressure that a skin answers at 0.69 of its depths [gf/cm²].
    pub pressure: f64,
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

/// Depth of skin over which the force grows e-fold [cm].
const SKIN_DEPTH: f64 = 0.004;
/// A touch reaches this far beyond half the thickness [cm]: so deep an ordinary load presses.
const REACH_BEYOND: f64 = 0.004;
/// Slip at which friction reaches its limit [cm].
const GIVE: f64 = 0.004;
/// Samples between nodes begin to touch this far outside [cm]: less than nodes, so that on a
/// smooth body nodes carry and edges and sharp features meet samples.
const SAMPLE_REACH: f64 = 0.005;

/// All touches, in order of site and part.
#[derive(Clone, Debug)]
pub struct Touches {
    sites: Sites,
    surface: Surface,
    touches: Vec<Touch>,
    /// For each node, its touches.
    of_node: Vec<Vec<u32>>,
    /// No part is nearer to a site than this was when it stood there [cm].
    clearance: Vec<(f64, Vec3)>,
}

impl Touches {
    /// Of a lattice's sites; none are found before the first [`refresh`](Self::refresh).
    #[must_use]
    pub fn new(sites: Sites, surface: Surface, nodes: usize) -> Self {
        let clearance = vec![(0.0, Vec3::repeat(f64::INFINITY)); sites.len()];
        Self {
            sites,
            surface,
            touches: Vec::new(),
            of_node: vec![Vec::new(); nodes],
            clearance,
        }
    }

    /// The touches.
    #[must_use]
    pub fn list(&self) -> &[Touch] {
        &self.touches
    }

    /// Looks again which sites are near a body: nodes that could touch after a move of `way` [cm],
    /// samples after one of `sample_way`. Anchors of touches that go on are kept.
    pub fn refresh(&mut self, at: &[Vec3], bodies: &Bodies, way: f64, sample_way: f64) {
        if bodies.parts().is_empty() {
            return;
        }
        let nodes = at.len();
        let mut found = threads::map(nodes, |node| self.look(node, at, bodies, way));
        for (node, (clearance, _)) in found.iter().enumerate() {
            if let Some(clearance) = clearance {
                self.clearance[node] = *clearance;
            }
        }
        found.extend(threads::map(self.sites.len() - nodes, |sample| {
            self.look(nodes + sample, at, bodies, sample_way)
        }));
        let mut fresh = Vec::with_capacity(self.touches.len());
        for (number, (clearance, nears)) in found.into_iter().enumerate() {
            if let Some(clearance) = clearance {
                self.clearance[number] = clearance;
            }
            for near in nears {
                fresh.push(self.touch(number, &near, at));
            }
        }
        self.touches = fresh;
        self.list_by_node();
    }

    /// What one site has near it, and its clearance if it was measured anew.
    fn look(
        &self,
        number: usize,
        at: &[Vec3],
        bodies: &Bodies,
        way: f64,
    ) -> (Option<(f64, Vec3)>, Vec<Near>) {
        let reach = self.reach(number) + way;
        let here = self.sites.site(number).at(at);
        let (clear, there) = self.clearance[number];
        if !self.sites.is_node(number) && self.clear_of(number, at, &here) > reach {
            return (None, Vec::new());
        }
        // Written so that a clearance never measured (at infinity) does not count.
        if clear - (here - there).norm() > reach {
            return (None, Vec::new());
        }
        let wide = reach + 0.5 + 2.0 * way;
        let mut nears = bodies.near(&here, wide);
        let nearest = nears.iter().map(|near| near.distance).fold(wide, f64::min);
        nears.retain(|near| near.distance <= reach);
        (Some((nearest, here)), nears)
    }

    /// How far a sample is from any surface at least, by what its cell's nodes know [cm].
    fn clear_of(&self, number: usize, at: &[Vec3], here: &Vec3) -> f64 {
        let by_node = |node: u32| {
            let (clear, there) = self.clearance[node as usize];
            let position = at[node as usize];
            clear - (position - there).norm() - (position - here).norm()
        };
        self.sites
            .site(number)
            .nodes
            .into_iter()
            .map(by_node)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// How far from a surface a site begins to touch [cm].
    fn reach(&self, number: usize) -> f64 {
        if self.sites.is_node(number) {
            self.surface.node_reach()
        } else {
            self.surface.sample_reach()
        }
    }

    fn touch(&self, number: usize, near: &Near, at: &[Vec3]) -> Touch {
        let site = self.sites.site(number);
        let here = site.at(at);
        let key = (number as u32, near.part as u32);
        let before = self
            .touches
            .binary_search_by(|touch| (touch.number, touch.part).cmp(&key));
        let before = before.ok().map(|place| &self.touches[place]);
        let skin = Skin {
            scale: self.surface.pressure * self.sites.area(number),
            depth: SKIN_DEPTH,
        };
        Touch {
            number: key.0,
            site,
            part: key.1,
            normal: near.normal,
            top: near.normal.dot(&here) - near.distance + self.reach(number),
            skin,
            friction: Friction {
                limit: before.map_or(0.0, |touch| touch.friction.limit),
                give: GIVE,
            },
            anchor: before.map_or(here, |touch| touch.anchor),
        }
    }

    fn list_by_node(&mut self) {
        for list in &mut self.of_node {
            list.clear();
        }
        for (k, touch) in self.touches.iter().enumerate() {
            for (node, _) in touch.site.shares() {
                self.of_node[node as usize].push(k as u32);
            }
        }
    }

    /// Sets every friction limit to µ times the normal force now. Touches that do not press let
    /// go of their anchor.
    pub fn look_at_loads(&mut self, at: &[Vec3]) {
        for touch in &mut self.touches {
            let here = touch.site.at(at);
            let (_, load, _) = touch.skin.answer(touch.top - touch.normal.dot(&here));
            if touch.friction.limit == 0.0 {
                touch.anchor = here;
            }
            touch.friction.limit = self.surface.friction * load;
        }
    }

    /// Moves the anchors of sliding touches up, so that from here on friction opposes new slip.
    pub fn drag_anchors(&mut self, at: &[Vec3]) {
        for touch in &mut self.touches {
            let slip = touch.slip(&touch.site.at(at));
            let size = slip.norm();
            if size > touch.friction.give {
                touch.anchor += slip * (1.0 - touch.friction.give / size);
            }
        }
    }

    /// Contact projection: brings sites that a long move took deep into the skin back to where they
    /// press little harder than before. `may_move` says which nodes may be moved for it.
    pub fn bring_back(&self, from: &[Vec3], to: &mut [Vec3], may_move: impl Fn(usize) -> bool) {
        for touch in &self.touches {
            let depth = |at: &[Vec3]| touch.top - touch.normal.dot(&touch.site.at(at));
            let excess = depth(to) - depth(from).max(0.0) - touch.skin.depth;
            if excess <= 0.0 {
                continue;
            }
            let square: f64 = touch.site.shares().map(|(_, weight)| weight * weight).sum();
            for (node, weight) in touch.site.shares() {
                if may_move(node as usize) {
                    to[node as usize] += touch.normal * (excess * weight / square);
                }
            }
        }
    }

    /// Energy of all touches [gf·cm].
    #[must_use]
    pub fn energy(&self, at: &[Vec3]) -> f64 {
        self.touches
            .iter()
            .map(|touch| touch.energy(&touch.site.at(at)))
            .sum()
    }

    /// Adds the touches' forces to the nodes' [gf].
    pub fn add_forces(&self, at: &[Vec3], forces: &mut [Vec3]) {
        for touch in &self.touches {
            let force = touch.force(&touch.site.at(at));
            for (node, weight) in touch.site.shares() {
                forces[node as usize] += force * weight;
            }
        }
    }

    /// Hands the touches' stiffness [gf/cm] to `add(row, column, block)`, each pair once.
    pub fn stiffness(&self, at: &[Vec3], add: &mut dyn FnMut(u32, u32, &Mat3)) {
        for touch in &self.touches {
            let Some(block) = touch.stiffness(&touch.site.at(at)) else {
                continue;
            };
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
            let Some(block) = touch.stiffness(&here) else {
                continue;
            };
            let weight: f64 = touch
                .site
                .shares()
                .filter(|(n, _)| *n as usize == node)
                .map(|(_, w)| w)
                .sum();
            force += touch.force(&here) * weight;
            stiffness += block * (weight * weight);
        }
        (force, stiffness)
    }

    /// Whether a node is near a body.
    #[must_use]
    pub fn is_near(&self, node: usize) -> bool {
        !self.of_node[node].is_empty()
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

impl Touch {
    /// Slip from the anchor in the tangent plane [cm].
    fn slip(&self, here: &Vec3) -> Vec3 {
        let way = here - self.anchor;
        way - self.normal * self.normal.dot(&way)
    }

    /// Energy with the site at `here` [gf·cm].
    #[must_use]
    pub fn energy(&self, here: &Vec3) -> f64 {
        let (energy, _, _) = self.skin.answer(self.top - self.normal.dot(here));
        energy + self.friction.energy(&self.slip(here))
    }

    /// Force on the site at `here` [gf].
    #[must_use]
    pub fn force(&self, here: &Vec3) -> Vec3 {
        let (_, load, _) = self.skin.answer(self.top - self.normal.dot(here));
        self.normal * load + self.friction.force(&self.slip(here))
    }

    /// Stiffness of the site at `here` [gf/cm]; `None` where nothing touches.
    fn stiffness(&self, here: &Vec3) -> Option<Mat3> {
        let (_, load, slope) = self.skin.answer(self.top - self.normal.dot(here));
        if load == 0.0 && self.friction.limit == 0.0 {
            return None;
        }
        let normal = self.normal * self.normal.transpose();
        Some(normal * slope + self.friction.stiffness(&self.slip(here), &self.normal))
    }
}
