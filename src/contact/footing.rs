//! Where a cloth holds on to bodies, taken along as they move: friction remembers its way.

use super::{
    touch::Touch,
    touches::{Places, Touches},
};
use crate::{body::Bodies, lattice::Lattice, math::Vec3};

/// The touches in which friction acts, and the bodies as they were then.
#[derive(Clone, Debug, Default)]
pub struct Footing {
    bodies: Bodies,
    touches: Vec<Touch>,
    places: Vec<Places>,
}

impl Footing {
    /// The bodies that the cloth lay on.
    #[must_use]
    pub fn bodies(&self) -> &Bodies {
        &self.bodies
    }

    /// Whether it is that of a cloth cut like this.
    #[must_use]
    pub fn fits(&self, lattice: &Lattice) -> bool {
        let nodes = lattice.coordinates.len();
        let known = |touch: &Touch| touch.site.nodes.iter().all(|node| (*node as usize) < nodes);
        self.places.len() == lattice.cells.len() && self.touches.iter().all(known)
    }

    /// The footing after the bodies, part by part the same, have moved: what friction holds on to
    /// goes with its part.
    #[must_use]
    pub fn carried(&self, bodies: &Bodies) -> Self {
        let carry = |touch: &Touch| {
            let (from, to) = self.bodies.part_then_and_now(touch.part as usize, bodies)?;
            let normal = to.carries_direction(from, &touch.normal);
            Some(Touch {
                anchor: to.carries(from, &touch.anchor),
                normal,
                turn: Vec3::zeros(),
                ..*touch
            })
        };
        Self {
            bodies: bodies.clone(),
            touches: self.touches.iter().filter_map(carry).collect(),
            places: self.places.clone(),
        }
    }

    /// How the bodies' motion takes along what lies on them: for every touch where friction holds
    /// on, there before and now [cm], and the load's limit of friction [gf].
    pub fn ways<'a>(&'a self, carried: &'a Self) -> impl Iterator<Item = (Vec3, Vec3, f64)> + 'a {
        let pairs = self.touches.iter().zip(&carried.touches);
        pairs.map(|(from, to)| (from.anchor, to.anchor, to.friction.limit))
    }
}

impl Touches {
    /// Where the cloth holds on. Friction that has reached its limit lets its anchor follow, so that
    /// it can turn round (return mapping).
    #[must_use]
    pub fn footing(&self, at: &[Vec3], bodies: &Bodies) -> Footing {
        let holds = |touch: &&Touch| touch.friction.limit > 0.0;
        let touches = self.list().iter().filter(holds).map(|touch| {
            let here = touch.site.at(at);
            let slip = touch.slip(&here);
            let kept = touch.friction.give / slip.norm().max(touch.friction.give);
            Touch {
                anchor: here - slip * kept,
                ..*touch
            }
        });
        Footing {
            bodies: bodies.clone(),
            touches: touches.collect(),
            places: self.places().to_vec(),
        }
    }

    /// Sets Coulomb friction [-] and keeps every friction force as it is, as far as the new limit
    /// allows: a cloth that is held more firmly for a while, or less, is not pushed by that. While it
    /// is held `firm`ly, limits outlast a moment without load.
    pub fn grip(&mut self, friction: f64, firm: bool, at: &[Vec3]) {
        self.rub(friction);
        self.hold_on(firm);
        for touch in self.list_mut() {
            let here = touch.site.at(at);
            let depth = touch.top - touch.normal.dot(&here);
            let (_, load, _) = touch.skin.answer(depth);
            let force = touch.friction.force(&touch.slip(&here));
            let limit = friction * load;
            touch.friction.limit = limit;
            let share = touch.friction.give / force.norm().max(limit);
            touch.anchor = if limit > 0.0 {
                here + force * share
            } else {
                here
            };
        }
    }

    /// Holds on where a cloth of the same lattice did before.
    pub fn stand_on(&mut self, footing: &Footing) {
        self.take_up(footing.touches.clone(), footing.places.clone());
    }
}
