//! A picture of the drape, as a photographer would take it: a cloth of checked linen on a warm,
//! matt body, in a studio with a large soft lamp and a backdrop that runs down into the floor.
//!
//! Rays are cast into bounding volume trees, four to a pixel. Each that meets something casts one
//! ray to a point of the lamp and one to a point of the sky; which points, a fixed pattern tells.
//! The means over a whole period of the pattern are then taken between neighbours on the same
//! surface, which gives soft shadows without grain. The same input gives the same bytes.

mod camera;
mod develop;
mod frame;
mod glyphs;
mod lamp;
mod legend;
mod soften;
mod stage;
mod trace;

use super::{BodyMesh, ClothMesh, HeatMap, png::Image};
use camera::Camera;
use develop::develop;
use soften::soften;
use stage::Stage;

pub use frame::Frame;

/// How a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<'a> {
    /// Pixels in a row, up to [`View::MOST`].
    pub width: u32,
    /// Rows, up to [`View::MOST`].
    pub height: u32,
    /// Shown in colours on the cloth, with a legend, instead of the woven check.
    pub heat: Option<&'a HeatMap>,
    /// A line of text at the foot of the picture (printable ASCII), for a drape that is not at rest.
    pub caption: Option<&'a str>,
    /// What the picture shows, instead of the cloth and what is around it. Pictures of equal frames
    /// have the same camera, floor and light, whatever moves in them.
    pub frame: Option<Frame>,
}

impl Default for View<'_> {
    fn default() -> Self {
        Self {
            width: 1200,
            height: 900,
            heat: None,
            caption: None,
            frame: None,
        }
    }
}

impl View<'_> {
    /// The greatest width and height; a picture asked for larger is this size, as is one of 0 that
    /// of 1.
    pub const MOST: u32 = 2400;
}

/// Takes a picture of a cloth and bodies; a PNG file.
///
/// The camera stands three quarters to the side and looks down a little; it frames the cloth, and
/// the bodies as far as they reach around it, unless the view says what to frame.
pub fn picture(cloth: &ClothMesh<'_>, bodies: &[BodyMesh], view: &View<'_>) -> Vec<u8> {
    picture_pixels(cloth, bodies, view).to_png()
}

/// Takes the same picture as [`picture`], for a film or a sheet.
pub fn picture_pixels(cloth: &ClothMesh<'_>, bodies: &[BodyMesh], view: &View<'_>) -> Image {
    let (width, height) = (
        view.width.clamp(1, View::MOST),
        view.height.clamp(1, View::MOST),
    );
    let stage = Stage::new(cloth, bodies, view.heat, view.frame);
    let camera = Camera::framing(&stage.subject(), [width, height], view.heat.is_some());
    let mut samples = stage.expose(&camera);
    soften(&mut samples, 2 * width as usize);
    let mut image = develop(&samples, &camera, view.heat.is_some());
    if let Some(heat) = view.heat {
        legend::draw(&mut image, heat);
    }
    if let Some(caption) = view.caption {
        legend::caption(&mut image, caption);
    }
    image
}

/// What one ray brought home.
#[derive(Clone, Copy, Debug, Default)]
struct Sample {
    /// What it met.
    on: Met,
    /// The surface's own colour, in linear light.
    colour: [f32; 3],
    /// The surface's normal, towards the camera.
    normal: [f32; 3],
    /// Distance from the camera [cm].
    depth: f32,
    /// Share of the lamp that is seen from there.
    lamp: f32,
    /// Share of the sky that is seen from there.
    sky: f32,
}

/// What a ray met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Met {
    /// The backdrop.
    #[default]
    Nothing,
    /// The floor.
    Floor,
    /// A body.
    Body,
    /// The cloth.
    Cloth,
}

/// Maps rows of an image by their index, in parallel where threads are compiled in; the results
/// stand in order either way.
fn rows<T: Send>(count: usize, row: impl Fn(usize) -> Vec<T> + Send + Sync) -> Vec<T> {
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        let rows: Vec<Vec<T>> = (0..count).into_par_iter().map(row).collect();
        rows.into_iter().flatten().collect()
    }
    #[cfg(not(feature = "threads"))]
    {
        (0..count).flat_map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        math::Vec3,
        output::{Map, png, sample},
    };

    const SMALL: View<'_> = View {
        width: 80,
        height: 60,
        heat: None,
        caption: None,
        frame: None,
    };

    fn draped(view: &View<'_>) -> Vec<u8> {
        let placed = sample::draped(41, 1.5, 12.0);
        let cloth = placed.cloth();
        picture(
            &cloth,
            &[sample::ball(Vec3::new(0.0, 0.0, -12.0), 12.0, 30)],
            view,
        )
    }

    #[test]
    fn a_picture_has_the_size_that_was_asked_for() {
        let image = png::tests::read(&draped(&SMALL));
        assert_eq!((image.width, image.height), (80, 60));
        // The backdrop is grey and bright; the cloth hides it in the middle.
        let spread = |p: [u8; 3]| p.iter().max().unwrap() - p.iter().min().unwrap();
        assert!(image.pixels[0].iter().all(|&x| x > 170) && spread(image.pixels[0]) < 12);
        assert!(image.pixels.iter().any(|&p| spread(p) > 25));
    }

    #[cfg(feature = "threads")]
    #[test]
    fn the_number_of_threads_does_not_show() {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| draped(&SMALL))
        };
        let one = with(1);
        assert!(one == with(2) && one == with(7));
    }

    #[test]
    fn heat_and_caption_change_the_picture() {
        let placed = sample::draped(41, 1.5, 12.0);
        let cloth = placed.cloth();
        let heat = HeatMap::of(Map::Shear, &cloth, None, None).unwrap();
        let plain = draped(&SMALL);
        assert!(
            draped(&View {
                heat: Some(&heat),
                ..SMALL
            }) != plain
        );
        assert!(
            draped(&View {
                caption: Some("not at rest"),
                ..SMALL
            }) != plain
        );
    }

    #[test]
    fn a_frame_keeps_camera_and_floor_while_a_body_moves() {
        let (low, high) = (Vec3::new(-30.0, -30.0, 0.0), Vec3::new(30.0, 30.0, 40.0));
        let placed = sample::wave(2, 2, 1.0);
        let nothing = ClothMesh {
            positions: &[],
            ..placed.cloth()
        };
        let at = |x, frame| {
            let ball = sample::ball(Vec3::new(x, 0.0, 25.0), 4.0, 12);
            picture_pixels(&nothing, &[ball], &View { frame, ..SMALL })
        };
        let frame = Some(Frame { low, high });
        let (here, there) = (at(-15.0, frame), at(15.0, frame));
        // The ball is seen at two places; where neither it nor its shadow is, nothing changed.
        let changed = |p: &(&[u8; 3], &[u8; 3])| p.0 != p.1;
        let changes = here
            .pixels
            .iter()
            .zip(&there.pixels)
            .filter(changed)
            .count();
        assert!((50..1200).contains(&changes), "{changes} of 4800");
        // Without a frame the camera goes with the ball.
        let (here, there) = (at(-15.0, None), at(15.0, None));
        let near = |(a, b): (&[u8; 3], &[u8; 3])| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) < 3);
        let same = here.pixels.iter().zip(&there.pixels).filter(|&p| near(p));
        assert!(same.count() > 4700);
        let broken = Frame { low, high: low };
        assert_eq!(at(-15.0, Some(broken)), here);
    }

    #[test]
    fn nothing_and_broken_shapes_still_give_a_picture() {
        let mut placed = sample::wave(5, 5, 1.0);
        let empty = ClothMesh {
            positions: &[],
            ..placed.cloth()
        };
        assert!(!picture(&empty, &[], &View { width: 0, ..SMALL }).is_empty());
        placed.positions[7] = Vec3::new(f64::NAN, f64::INFINITY, 1e300);
        placed.positions[12] = Vec3::repeat(1e200);
        let broken = placed.cloth();
        let heat = HeatMap {
            map: Map::Gap,
            values: vec![f64::INFINITY, f64::NAN, 1e300],
        };
        assert!(
            !picture(
                &broken,
                &[],
                &View {
                    heat: Some(&heat),
                    ..SMALL
                }
            )
            .is_empty()
        );
    }
}
