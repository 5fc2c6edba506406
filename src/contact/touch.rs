//! One touch: a point of the cloth on the plane of the nearest surface.

use super::{Friction, Site, Skin};
use crate::math::{Mat3, Vec3};

/// Two normals whose mean is shorter than this have no direction between them.
const LEAST_MIDDLE: f64 = 1e-6;

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
    /// How the normal turned at the last look.
    pub turn: Vec3,
    /// Depth in the skin at a position p is `top − normal·p` [cm].
    pub top: f64,
    /// The normal law.
    pub skin: Skin,
    /// The friction law, its limit as of the last look.
    pub friction: Friction,
    /// Where friction holds on [cm].
    pub anchor: Vec3,
}

/// The normal of a touch that goes on, and its turn. One that turns back is met half way: between
/// two faces of an edge a site would else swing for ever.
pub(super) fn settled_normal(before: &Touch, now: &Vec3) -> (Vec3, Vec3) {
    let turn = now - before.normal;
    if turn.dot(&before.turn) >= 0.0 {
        return (*now, turn);
    }
    // Opposite faces, as of a thin board, have no middle.
    match (before.normal + turn * 0.5).try_normalize(LEAST_MIDDLE) {
        Some(middle) => (middle, middle - before.normal),
        None => (*now, turn),
    }
}

impl Touch {
    /// Slip from the anchor in the tangent plane [cm].
    pub(super) fn slip(&self, here: &Vec3) -> Vec3 {
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

    /// Force [gf] and stiffness [gf/cm] of the site at `here`; `None` where nothing touches.
    #[inline]
    pub(super) fn answer(&self, here: &Vec3) -> Option<(Vec3, Mat3)> {
        let depth = self.top - self.normal.dot(here);
        if depth <= 0.0 && self.friction.limit == 0.0 {
            return None;
        }
        let (_, load, slope) = self.skin.answer(depth);
        let slip = self.slip(here);
        let normal = self.normal * self.normal.transpose();
        Some((
            self.normal * load + self.friction.force(&slip),
            normal * slope + self.friction.stiffness(&slip, &self.normal),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_normal_that_turns_back_is_met_half_way_and_one_that_turns_over_is_followed() {
        let touch = |normal: Vec3, turn: Vec3| Touch {
            number: 0,
            site: Site {
                nodes: [0; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
            },
            part: 0,
            normal,
            turn,
            top: 0.0,
            skin: Skin {
                scale: 1.0,
                depth: 0.004,
            },
            friction: Friction {
                limit: 0.0,
                give: 0.004,
            },
            anchor: Vec3::zeros(),
        };
        let (x, z) = (Vec3::x(), Vec3::z());
        assert_eq!(settled_normal(&touch(z, z - x), &z), (z, Vec3::zeros()));
        let (half, _) = settled_normal(&touch(z, z - x), &x);
        assert!((half - (x + z).normalize()).norm() < 1e-15);
        assert_eq!(settled_normal(&touch(z, z), &-z), (-z, z * -2.0));
    }
}
