//! A picture of the drape, as a photographer would take it: a cloth of checked linen on a warm,
//! matt body, in a studio with a large soft lamp and a backdrop that runs down into the floor.
//!
//! Rays are cast into bounding volume trees, four to a pixel. Each that meets something casts one
//! ray to a point of the lamp and one to a point of the sky; which points, a fixed pattern tells.
//! The means over a whole period of the pattern are then taken between neighbours on the same
//! surface, which gives soft shadows without grain. The same input gives the same bytes.

mod camera;
mod develop;
mod glyphs;
mod lamp;
mod legend;
mod soften;
mod stage;
mod trace;

use super::{BodyMesh, ClothMesh, HeatMap};
use camera::Camera;
use develop::develop;
use soften::soften;
use stage::Stage;

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
}

impl Default for View<'_> {
    fn default() -> Self {
        Self { width: 1200, height: 900, heat: None, caption: None }
    }
}

impl View<'_> {
    /// The greatest width and height; a picture asked for larger is this size, as is one of 0 that
    /// of 1.
    pub const MOST: u32 = 4096;
}

/// Takes a picture of a cloth and bodies; a PNG file.
///
/// The camera stands three quarters to the side and looks down a little; it frames the cloth, and
/// the bodies as far as they reach around it.
pub fn picture(cloth: &ClothMesh<'_>, bodies: &[BodyMesh], view: &View<'_>) -> Vec<u8> {
    let (width, height) = (view.width.clamp(1, View::MOST), view.height.clamp(1, View::MOST));
    let stage = Stage::new(cloth, bodies, view.heat);
    let camera = Camera::framing(&stage.subject(), [width, height], view.heat.is_some());
    let mut samples = stage.expose(&camera);
    soften(&mut samples, 2 * width as usize);
    let mut image = develop(&samples, &camera);
    if let Some(heat) = view.heat {
        legend::draw(&mut image, heat);
    }
    if let Some(caption) = view.caption {
        legend::caption(&mut image, caption);
    }
    image.to_png()
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
mod look {
    use super::*;
    use crate::{math::Vec3, output::{sample, Map}};
    #[test]
    fn look() {
        let size: u32 = std::env::var("W").map_or(800, |w| w.parse().unwrap());
        let view = View { width: size, height: size * 3 / 4, ..View::default() };
        let save = |name: &str, bytes: Vec<u8>| std::fs::write(format!("/tmp/look/{name}.png"), bytes).unwrap();
        let (lattice, positions) = sample::draped(121, 0.5, 12.0);
        let cloth = ClothMesh { lattice: &lattice, positions: &positions };
        let ball = sample::ball(Vec3::new(0.0, 0.0, -12.0), 12.0, 110);
        let t = std::time::Instant::now();
        let p = picture(&cloth, &[ball.clone()], &view);
        eprintln!("{:?} {} nodes {} faces", t.elapsed(), positions.len(), ball.triangles.len());
        save("ball", p);
        let heat = HeatMap::of(Map::Shear, &cloth, None, None).unwrap();
        save("shear", picture(&cloth, &[ball.clone()], &View { heat: Some(&heat), ..view }));
        let heat = HeatMap::of(Map::StrainWarp, &cloth, None, None).unwrap();
        save("strain", picture(&cloth, &[ball], &View { heat: Some(&heat), caption: Some("Not at rest: residual 0.37"), ..view }));
        let (lattice, positions) = sample::wave(41, 31, 0.5);
        let cloth = ClothMesh { lattice: &lattice, positions: &positions };
        let table = sample::cuboid(Vec3::new(-8.0, -6.0, -9.0), Vec3::new(8.0, 6.0, -3.2));
        save("table", picture(&cloth, &[table], &view));
    }
}
