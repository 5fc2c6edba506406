//! The studio's light: a lamp as wide as a soft box, and the sky around it.

use super::camera::Camera;
use crate::math::Vec3;
use std::f64::consts::TAU;

/// How many samples in a row and a column the pattern takes to repeat.
pub(super) const PERIOD: usize = 8;

/// Tangent of half the angle at which the lamp is seen: 9°.
const LAMP: f64 = 0.16;

/// Where light comes from.
#[derive(Clone, Debug)]
pub(super) struct Lamp {
    /// Towards its middle.
    pub(super) towards: Vec3,
    /// Directions to its points, one per place in the pattern.
    points: Vec<Vec3>,
    /// Directions to the sky about +z, the more the higher, one per place in the pattern.
    sky: Vec<Vec3>,
}

impl Lamp {
    /// A lamp behind the photographer's left shoulder.
    pub(super) fn beside(camera: &Camera) -> Self {
        let level = Vec3::z().cross(&camera.right);
        let towards = (Vec3::z() * 1.15 - camera.right * 0.80 - level * 0.55).normalize();
        let places = PERIOD * PERIOD;
        let points = (0..places)
            .map(|k| disc(k, places))
            .map(|[x, y]| about(towards, Vec3::new(LAMP * x, LAMP * y, 1.0)).normalize());
        // A disc lifted to the half ball: as many directions as light falls from them.
        let lift =
            |[x, y]: [f64; 2]| Vec3::new(x, y, libm::sqrt(f64::max(1.0 - x * x - y * y, 0.0)));
        let sky = (0..places).map(|k| lift(disc(k, places)));
        Self {
            towards,
            points: points.collect(),
            sky: sky.collect(),
        }
    }

    /// To the point of the lamp that belongs to a sample of the picture.
    pub(super) fn point(&self, x: usize, y: usize) -> Vec3 {
        self.points
            .get(place(x, y))
            .copied()
            .unwrap_or(self.towards)
    }

    /// To the point of the sky over a surface that belongs to a sample of the picture.
    pub(super) fn sky(&self, x: usize, y: usize, normal: Vec3) -> Vec3 {
        about(
            normal,
            self.sky.get(place(x, y)).copied().unwrap_or(Vec3::z()),
        )
    }
}

/// Place in the pattern of a sample: neighbours get places far apart (Bayer's ordered dither: the
/// bits of y and x ⊕ y, from the lowest on, give those of the place from the highest on).
fn place(x: usize, y: usize) -> usize {
    let mut place = 0;
    for bit in 0..3 {
        let (x, y) = ((x >> bit) & 1, (y >> bit) & 1);
        place = 4 * place + 2 * (x ^ y) + y;
    }
    place
}

/// The k-th of n points that fill the unit disc evenly: the sunflower's spiral.
fn disc(k: usize, n: usize) -> [f64; 2] {
    const GOLDEN: f64 = 0.381_966_011_250_105;
    let radius = libm::sqrt((k as f64 + 0.5) / n as f64);
    let angle = TAU * GOLDEN * k as f64;
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}

/// A direction given about +z, turned to be about another.
fn about(axis: Vec3, direction: Vec3) -> Vec3 {
    let other = if axis.x.abs() < 0.6 {
        Vec3::x()
    } else {
        Vec3::y()
    };
    let first = axis.cross(&other).normalize();
    let second = axis.cross(&first);
    first * direction.x + second * direction.y + axis * direction.z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_place_of_the_pattern_is_taken_once_in_any_window() {
        for (left, top) in [(0, 0), (3, 5)] {
            let mut places: Vec<usize> = (0..64)
                .map(|k| place(left + k % PERIOD, top + k / PERIOD))
                .collect();
            places.sort_unstable();
            assert_eq!(places, (0..64).collect::<Vec<_>>());
        }
    }

    #[test]
    fn the_sky_is_weighted_by_height() {
        let camera = Camera::framing(&[Vec3::zeros(), Vec3::x()], [4, 3], false);
        let lamp = Lamp::beside(&camera);
        let normal = Vec3::new(0.6, 0.0, 0.8);
        let sky = (0..64).map(|k| lamp.sky(k % 8, k / 8, normal));
        // The mean direction of cosine-weighted light is 2/3 of the normal.
        let mean = sky.sum::<Vec3>() / 64.0;
        assert!((mean - normal * 2.0 / 3.0).norm() < 0.02, "{mean:?}");
        let points = (0..64).map(|k| lamp.point(k % 8, k / 8));
        assert!((points.sum::<Vec3>().normalize() - lamp.towards).norm() < 0.01);
    }
}
