//! From the outline's frame to the yarns' and back.

use crate::{lattice::Piece, math::Vec2};
use std::f64::consts::FRAC_PI_2;

/// A grain this close to a quarter turn is one [rad]: degrees written in decimals reach it.
const QUARTER_TURN_TOLERANCE: f64 = 1e-12;

impl Piece {
    /// Cloth coordinates (warp, weft) of a point of the outline's frame [cm].
    /// Exact where the grain is a multiple of 90°.
    #[must_use]
    pub fn to_cloth(&self, outline: Vec2) -> Vec2 {
        let (sin, cos) = sine_cosine(self.grain);
        turned(outline, cos, -sin)
    }

    /// The point of the outline's frame at cloth coordinates (warp, weft) [cm].
    #[must_use]
    pub fn to_outline(&self, cloth: Vec2) -> Vec2 {
        let (sin, cos) = sine_cosine(self.grain);
        turned(cloth, cos, sin)
    }
}

fn turned(point: Vec2, cos: f64, sin: f64) -> Vec2 {
    Vec2::new(point.x * cos - point.y * sin, point.x * sin + point.y * cos)
}

fn sine_cosine(angle: f64) -> (f64, f64) {
    let quarters = (angle / FRAC_PI_2).round();
    if (angle - quarters * FRAC_PI_2).abs() > QUARTER_TURN_TOLERANCE {
        return libm::sincos(angle);
    }
    match quarters.rem_euclid(4.0) {
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        3.0 => (-1.0, 0.0),
        _ => (0.0, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Outline;

    fn piece(degrees: f64) -> Piece {
        Piece {
            outline: Outline::disc(1.0).unwrap(),
            grain: degrees.to_radians(),
            pitch: 0.1,
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let point = Vec2::new(0.3, 0.7);
        for (degrees, warp, weft) in [
            (0.0, 0.3, 0.7),
            (90.0, 0.7, -0.3),
            (180.0, -0.3, -0.7),
            (270.0, -0.7, 0.3),
            (-90.0, -0.7, 0.3),
            (450.0, 0.7, -0.3),
        ] {
            assert_eq!(piece(degrees).to_cloth(point), Vec2::new(warp, weft));
        }
    }

    #[test]
    fn the_warp_stands_at_the_grain_angle_and_turning_back_is_the_inverse() {
        let bias = piece(30.0);
        let warp = bias.to_outline(Vec2::new(1.0, 0.0));
        assert!((warp.y.atan2(warp.x).to_degrees() - 30.0).abs() < 1e-12);
        let point = Vec2::new(-4.0, 2.5);
        assert!((bias.to_outline(bias.to_cloth(point)) - point).norm() < 1e-14);
    }
}
