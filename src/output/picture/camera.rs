//! Where the camera stands, and which ray belongs to which point of the picture.

use super::trace::Ray;
use crate::math::Vec3;

/// Vertical field of view [rad]: 30°, a portrait lens.
const FIELD: f64 = std::f64::consts::FRAC_PI_6;

/// The camera stands at this angle to the side of −y [rad] …
const AZIMUTH: f64 = 0.52;

/// … and looks down at this angle [rad].
const DOWN: f64 = 0.36;

/// A pinhole camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct Camera {
    /// Where it stands [cm].
    pub(super) eye: Vec3,
    /// To the right in the picture.
    pub(super) right: Vec3,
    /// Upwards in the picture.
    pub(super) up: Vec3,
    /// Towards the camera.
    pub(super) back: Vec3,
    /// Pixels in a row, and rows.
    pub(super) size: [u32; 2],
    /// Half height of what is seen at distance 1.
    pub(super) half: f64,
}

impl Camera {
    /// The camera nearest to points from which all are seen, with a margin around them, and room
    /// at the right for a legend if asked.
    pub(super) fn framing(points: &[Vec3], size: [u32; 2], legend: bool) -> Self {
        let (sin, cos) = (libm::sin(AZIMUTH), libm::cos(AZIMUTH));
        let right = Vec3::new(cos, sin, 0.0);
        let level = Vec3::new(sin, -cos, 0.0);
        let back = level * libm::cos(DOWN) + Vec3::z() * libm::sin(DOWN);
        let up = back.cross(&right);
        let half = libm::tan(0.5 * FIELD);
        let wide = half * f64::from(size[0]) / f64::from(size[1]);
        let room = if legend { 0.52 } else { 0.86 };
        let across = fit(points, right, back, [0.86 * wide, room * wide]);
        // More room below than above: the shadow belongs to the picture.
        let along = fit(points, up, back, [0.80 * half, 0.88 * half]);
        let distance = across[0].max(along[0]).max(1.0);
        let centre =
            |fit: [f64; 5]| 0.5 * ((fit[1] - distance * fit[3]) + (distance * fit[4] - fit[2]));
        let eye = right * centre(across) + up * centre(along) + back * distance;
        Self {
            eye,
            right,
            up,
            back,
            size,
            half,
        }
    }

    /// The ray through a point of the picture, in pixels from its upper left corner.
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let pixel = self.pixel();
        let right = pixel * (x - 0.5 * f64::from(self.size[0]));
        let up = pixel * (0.5 * f64::from(self.size[1]) - y);
        Ray::new(
            self.eye,
            (self.right * right + self.up * up - self.back).normalize(),
        )
    }

    /// Side of a pixel at distance 1.
    pub(super) fn pixel(&self) -> f64 {
        2.0 * self.half / f64::from(self.size[1])
    }
}

/// Along one axis of the picture: the least distance of the camera from the origin at which all
/// points are within the slopes given to either side; with `[distance, most, least, slopes]` such
/// that the camera's place `c` at a distance `d` must keep `most − d·slope₁ ≤ c ≤ d·slope₀ − least`.
fn fit(points: &[Vec3], axis: Vec3, back: Vec3, [low, high]: [f64; 2]) -> [f64; 5] {
    let reach = |side: f64, slope: f64| {
        let reaches = points
            .iter()
            .map(|p| side * p.dot(&axis) + slope * p.dot(&back));
        reaches.reduce(f64::max).unwrap_or(1.0)
    };
    let (most, least) = (reach(1.0, high), reach(-1.0, low));
    [(most + least) / (low + high), most, least, high, low]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where a point is seen, from −1 to 1 across and along the picture.
    fn seen(camera: &Camera, p: Vec3) -> [f64; 2] {
        let from = p - camera.eye;
        let depth = -from.dot(&camera.back);
        let wide = camera.half * f64::from(camera.size[0]) / f64::from(camera.size[1]);
        [
            from.dot(&camera.right) / depth / wide,
            from.dot(&camera.up) / depth / camera.half,
        ]
    }

    #[test]
    fn all_points_are_in_the_picture_and_some_at_its_margin() {
        let points: Vec<Vec3> = (0..50)
            .map(f64::from)
            .map(|k| {
                Vec3::new(
                    30.0 * libm::sin(k),
                    90.0 + 20.0 * libm::cos(3.0 * k),
                    k - 70.0,
                )
            })
            .collect();
        for legend in [false, true] {
            let camera = Camera::framing(&points, [1200, 900], legend);
            let all: Vec<[f64; 2]> = points.iter().map(|&p| seen(&camera, p)).collect();
            let right = if legend { 0.52 } else { 0.86 };
            let inside = |s: &[f64; 2]| {
                s[0] < right + 1e-9
                    && s[0] > -0.86 - 1e-9
                    && s[1] < 0.88 + 1e-9
                    && s[1] > -0.80 - 1e-9
            };
            assert!(all.iter().all(inside), "{all:?}");
            assert!(all.iter().any(|s| s[1] > 0.87) || all.iter().any(|s| s[0] > right - 0.01));
        }
    }

    #[test]
    fn a_ray_goes_through_the_point_that_is_seen_there() {
        let points = [Vec3::new(3.0, 1.0, 2.0), Vec3::new(-9.0, 4.0, 12.0)];
        let camera = Camera::framing(&points, [640, 480], false);
        for p in points {
            let [x, y] = seen(&camera, p);
            let ray = camera.ray(320.0 * (1.0 + x), 240.0 * (1.0 - y));
            assert!((p - camera.eye).cross(&ray.direction).norm() < 1e-9);
        }
    }
}
