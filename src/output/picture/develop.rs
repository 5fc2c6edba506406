//! From what rays brought home to pixels.

use super::{Met, Sample, camera::Camera, lamp::Lamp, rows};
use crate::{
    math::Vec3,
    output::{
        colour::{Rgb, from_srgb, to_srgb},
        png::Image,
    },
};

/// Lights every sample, and takes the mean of the four of each pixel. For a `chart`, shade on the
/// cloth is weak, so that its colours are those of the legend.
pub(super) fn develop(samples: &[Sample], camera: &Camera, chart: bool) -> Image {
    let [width, height] = camera.size.map(|pixels| pixels as usize);
    let studio = Studio::new(camera, if chart { 0.55 } else { 1.0 });
    let pixels = rows(height, |y| {
        let pixel = |x: usize| {
            let light = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(right, down)| {
                let sample = samples.get((2 * y + down) * 2 * width + 2 * x + right);
                let [across, along] = [x as f64 / width as f64, y as f64 / height as f64];
                studio.light(&sample.copied().unwrap_or_default(), across, along)
            });
            to_srgb(light.iter().sum::<Rgb>() / 4.0)
        };
        (0..width).map(pixel).collect()
    });
    Image {
        width: camera.size[0],
        height: camera.size[1],
        pixels,
    }
}

/// Colours of the light, and where the lamp is.
struct Studio {
    lamp: Vec3,
    fill: Vec3,
    lamp_light: Rgb,
    fill_light: Rgb,
    sky_light: Rgb,
    floor_light: Rgb,
    backdrop: [Rgb; 3],
    /// How much of light and shade the cloth shows.
    relief: f64,
}

impl Studio {
    fn new(camera: &Camera, relief: f64) -> Self {
        Self {
            relief,
            lamp: Lamp::beside(camera).towards,
            fill: (camera.right * 0.8 + camera.back * 0.6).normalize(),
            lamp_light: Rgb::new(0.83, 0.79, 0.73),
            fill_light: Rgb::new(0.08, 0.085, 0.10),
            sky_light: Rgb::new(0.40, 0.43, 0.48),
            floor_light: Rgb::new(0.22, 0.20, 0.18),
            backdrop: [[206, 209, 213], [234, 233, 230], [214, 210, 204]].map(from_srgb),
        }
    }

    fn light(&self, sample: &Sample, across: f64, along: f64) -> Rgb {
        let (lamp, sky) = (f64::from(sample.lamp), f64::from(sample.sky));
        let colour = Rgb::from(sample.colour.map(f64::from));
        match sample.on {
            Met::Nothing => self.backdrop(across, along),
            Met::Floor => {
                let lit = 0.56 * lamp + 0.44 * sky;
                let shade = Rgb::new(lit, lit, 0.03 + 0.97 * lit);
                let shade = Rgb::repeat(1.0).lerp(&shade, colour.x);
                self.backdrop(across, along).component_mul(&shade)
            }
            Met::Body | Met::Cloth => {
                let normal = Vec3::from(sample.normal.map(f64::from));
                let relief = if sample.on == Met::Cloth {
                    self.relief
                } else {
                    1.0
                };
                let light = Rgb::repeat(1.0).lerp(&self.falling_on(normal, lamp, sky), relief);
                colour.component_mul(&light)
            }
        }
    }

    /// Light on a matt surface.
    fn falling_on(&self, normal: Vec3, lamp: f64, sky: f64) -> Rgb {
        let height = 0.5 + 0.5 * normal.z;
        let around = self.floor_light.lerp(&self.sky_light, height);
        self.lamp_light * (lamp * normal.dot(&self.lamp).max(0.0))
            + around * sky
            + self.fill_light * ((0.4 + 0.6 * normal.dot(&self.fill)).max(0.0) * sky)
    }

    /// A paper roll lit from the front: brightest behind the subject, darker to the corners.
    fn backdrop(&self, across: f64, along: f64) -> Rgb {
        let [top, middle, foot] = &self.backdrop;
        let roll = |from: &Rgb, to: &Rgb, t: f64| from.lerp(to, t * t * (3.0 - 2.0 * t));
        let paper = if along < 0.55 {
            roll(top, middle, along / 0.55)
        } else {
            roll(middle, foot, (along - 0.55) / 0.45)
        };
        let (x, y) = (across - 0.5, along - 0.5);
        paper * (1.0 - 0.22 * (x * x + 0.6 * y * y))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera() -> Camera {
        Camera::framing(&[Vec3::zeros(), Vec3::repeat(10.0)], [4, 3], false)
    }

    #[test]
    fn a_surface_is_brighter_towards_the_lamp_and_in_its_light() {
        let camera = camera();
        let studio = Studio::new(&camera, 1.0);
        let lit = studio.falling_on(studio.lamp, 1.0, 1.0);
        let shaded = studio.falling_on(studio.lamp, 0.0, 1.0);
        let hidden = studio.falling_on(studio.lamp, 0.0, 0.0);
        assert!(lit.x > 2.0 * shaded.x && shaded.x > hidden.x && hidden.x == 0.0);
        // White paper facing the lamp is not overexposed by much.
        assert!(lit.max() < 1.4, "{lit:?}");
    }

    #[test]
    fn a_floor_without_shadow_is_backdrop() {
        let studio = Studio::new(&camera(), 1.0);
        let floor = |light, colour| {
            let sample = Sample {
                on: Met::Floor,
                colour,
                lamp: light,
                sky: light,
                ..Sample::default()
            };
            studio.light(&sample, 0.3, 0.8)
        };
        let backdrop = studio.light(&Sample::default(), 0.3, 0.8);
        assert!((floor(1.0, [1.0; 3]) - backdrop).amax() < 1e-6);
        assert!((floor(0.0, [0.0; 3]) - backdrop).amax() < 1e-6);
        assert!(floor(0.2, [1.0; 3]).max() < 0.5 * backdrop.max());
    }

    #[test]
    fn a_pixel_is_the_mean_of_its_four_samples() {
        let mut samples = vec![Sample::default(); 48];
        for k in [0, 1, 8, 9] {
            // Black cloth in the first pixel, in three of four samples of the next below.
            samples[k] = Sample {
                on: Met::Cloth,
                ..Sample::default()
            };
        }
        for k in [16, 17, 24] {
            samples[k] = Sample {
                on: Met::Cloth,
                ..Sample::default()
            };
        }
        let image = develop(&samples, &camera(), false);
        assert_eq!(image.pixels[0], [0; 3]);
        let quarter = Studio::new(&camera(), 1.0).light(&Sample::default(), 0.0, 1.0 / 3.0) / 4.0;
        assert_eq!(image.pixels[4], to_srgb(quarter));
    }
}
