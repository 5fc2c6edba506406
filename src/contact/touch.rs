//! One touch: a point of the cloth on the plane of the nearest surface.

use super::{Friction, Site, Skin};
use crate::math::{Mat3, Vec3};

/// Two normals whose mean is shorter than this have no direction between them.
const LEAST_MIDDLE: f64 = 1e-6;
/// A normal that turned back half as often as this, less the times when it went on, is not held back:
/// most swings die down by being met half way.
const SWINGS: u32 = 8;

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
    /// Twice for every time that it turned back, less one for every time that it went on.
    pub swings: u32,
    /// Depth in the skin at a position p is `top − normal·p` [cm].
    pub top: f64,
    /// The normal law.
    pub skin: Skin,
    /// The friction law, its limit as of the last look.
    pub friction: Friction,
    /// Where friction holds on [cm].
    pub anchor: Vec3,
}

/// A normal as a touch takes it at a look.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Settled {
    pub(super) normal: Vec3,
    /// How it turned.
    pub(super) turn: Vec3,
    /// Twice for every time that it turned back, less one for every time that it went on.
    pub(super) swings: u32,
}

impl Settled {
    /// The normal of a touch, that goes on from one before. One that turns back is met half way, and
    /// one that swings on turns less and less: between two faces of an edge a site would else swing
    /// for ever.
    pub(super) fn after(before: Option<&Touch>, now: &Vec3) -> Self {
        let whole = |turn, swings| Self {
            normal: *now,
            turn,
            swings,
        };
        let Some(before) = before else {
            return whole(Vec3::zeros(), 0);
        };
        let turn = now - before.normal;
        let (part, swings) = if turn.dot(&before.turn) < 0.0 {
            (0.5, before.swings.saturating_add(2))
        } else {
            (1.0, before.swings.saturating_sub(1))
        };
        let part = part * (f64::from(SWINGS) / f64::from(swings)).min(1.0);
        if part == 1.0 {
            return whole(turn, swings);
        }
        // Opposite faces, as of a thin board, have no middle.
        match (before.normal + turn * part).try_normalize(LEAST_MIDDLE) {
            Some(middle) => Self {
                normal: middle,
                turn: middle - before.normal,
                swings,
            },
            None => whole(turn, swings),
        }
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

    fn touch(normal: Vec3, turn: Vec3) -> Touch {
        Touch {
            number: 0,
            site: Site {
                nodes: [0; 4],
                weights: [1.0, 0.0, 0.0, 0.0],
            },
            part: 0,
            normal,
            turn,
            swings: 0,
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
        }
    }

    #[test]
    fn a_normal_that_turns_back_is_met_half_way_and_one_that_turns_over_is_followed() {
        let after = |normal: Vec3, turn: Vec3, now: Vec3| {
            let settled = Settled::after(Some(&touch(normal, turn)), &now);
            (settled.normal, settled.turn)
        };
        let (x, z) = (Vec3::x(), Vec3::z());
        assert_eq!(after(z, z - x, z), (z, Vec3::zeros()));
        let (half, _) = after(z, z - x, x);
        assert!((half - (x + z).normalize()).norm() < 1e-15);
        assert_eq!(after(z, z, -z), (-z, z * -2.0));
    }

    /// A site under an edge that is nearer to that face which its normal leans away from: met half
    /// way each time, it would swing between 30° and 60° for ever.
    #[test]
    fn a_normal_between_two_faces_comes_to_rest_between_them() {
        let (x, z) = (Vec3::x(), Vec3::z());
        let mut on = touch(z, z - x);
        let mut lean = Vec::new();
        let mut now = z;
        for look in 0..400 {
            // The cloth yields at every second look.
            if look % 2 == 0 {
                now = if on.normal.z > on.normal.x { x } else { z };
            }
            let settled = Settled::after(Some(&on), &now);
            (on.normal, on.turn, on.swings) = (settled.normal, settled.turn, settled.swings);
            lean.push(on.normal.z - on.normal.x);
        }
        let last = &lean[390..];
        assert!(last.iter().all(|lean| lean.abs() < 0.05), "{last:?}");
        assert!((on.normal.norm() - 1.0).abs() < 1e-15);
    }
}
