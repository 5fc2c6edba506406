//! The files of a drape.

use crate::{args::Wish, failure::Failure};
use soen::{
    math::Vec3,
    output::{self, BodyMesh, ClothMesh, HeatMap, Map, View},
    scene::Scene,
    solver::Settled,
};
use std::path::Path;

/// Width and height of pictures [pixels]. At full size a preview's would take longer than its cloth.
const DRAPE: [u32; 2] = [1200, 900];
const PREVIEW: [u32; 2] = [600, 450];

/// What is written, and where.
pub(crate) struct Files<'a> {
    out: &'a Path,
    title: String,
    caption: Option<&'a str>,
    /// Of pictures.
    size: [u32; 2],
    cloth: ClothMesh<'a>,
    frames: &'a [Vec<Vec3>],
    bodies: Vec<BodyMesh>,
    maps: Vec<HeatMap>,
}

impl<'a> Files<'a> {
    pub(crate) fn new(wish: &'a Wish, scene: &Scene, settled: &'a Settled) -> Self {
        let cloth = ClothMesh {
            lattice: &settled.lattice,
            positions: &settled.positions,
        };
        let mark = mark(settled);
        Self {
            out: &wish.out,
            title: marked(&scene.title, mark),
            caption: mark,
            size: if wish.preview { PREVIEW } else { DRAPE },
            cloth,
            frames: &settled.frames,
            bodies: output::body_meshes(&scene.problem.bodies),
            maps: heat_maps(&wish.maps, scene, settled, &cloth),
        }
    }

    /// Writes all; the report last, so that where it stands the others do too.
    pub(crate) fn write(&self, report: &str) -> Result<(), Failure> {
        self.put(
            "drape.obj",
            output::obj(&self.title, &self.cloth).as_bytes(),
        )?;
        let glb = output::glb(&self.cloth, &self.bodies, &self.maps);
        self.put("drape.glb", &glb)?;
        self.put("drape.png", &self.picture(&self.cloth, None))?;
        for heat in &self.maps {
            let name = format!("map-{}.png", heat.map.key());
            self.put(&name, &self.picture(&self.cloth, Some(heat)))?;
        }
        if !self.maps.is_empty() {
            self.put("drape.ply", &output::ply(&self.cloth, &self.maps))?;
        }
        for (number, positions) in (1..).zip(self.frames) {
            self.write_frame(number, positions)?;
        }
        self.put("report.json", report.as_bytes())
    }

    fn write_frame(&self, number: usize, positions: &[Vec3]) -> Result<(), Failure> {
        let cloth = ClothMesh {
            positions,
            ..self.cloth
        };
        let title = format!("{}, frame {number}", self.title);
        let obj = output::obj(&title, &cloth);
        self.put(&format!("frame-{number:04}.obj"), obj.as_bytes())?;
        let png = self.picture(&cloth, None);
        self.put(&format!("frame-{number:04}.png"), &png)
    }

    fn picture(&self, cloth: &ClothMesh<'_>, heat: Option<&HeatMap>) -> Vec<u8> {
        let view = View {
            heat,
            caption: self.caption,
            width: self.size[0],
            height: self.size[1],
            frame: None,
        };
        output::picture(cloth, &self.bodies, &view)
    }

    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        Ok(output::write(&self.out.join(name), bytes)?)
    }
}

/// What pictures and titles say of a drape that is not at rest.
pub(crate) fn mark(settled: &Settled) -> Option<&'static str> {
    (!settled.converged).then_some("NOT AT REST: stopped before it was certified")
}

/// A title with its mark.
pub(crate) fn marked(title: &str, mark: Option<&str>) -> String {
    match mark {
        None => title.to_owned(),
        Some(mark) => format!("{title} ({mark})"),
    }
}

fn heat_maps(
    wished: &[Map],
    scene: &Scene,
    settled: &Settled,
    cloth: &ClothMesh<'_>,
) -> Vec<HeatMap> {
    let gaps = wished.contains(&Map::Gap).then(|| gaps(scene, cloth));
    let of = |map| HeatMap::of(map, cloth, Some(&settled.contact), gaps.as_deref());
    wished.iter().copied().filter_map(of).collect()
}

/// Distance of each node to the nearest body [cm], negative inside a solid; `NaN` without bodies.
fn gaps(scene: &Scene, cloth: &ClothMesh<'_>) -> Vec<f64> {
    // Farther apart than a scene can place two things [cm].
    const REACH: f64 = 1e6;
    let gap = |at: &Vec3| {
        let near = scene.problem.bodies.near(at, REACH);
        near.iter()
            .map(|near| near.distance)
            .fold(f64::NAN, f64::min)
    };
    cloth.positions.iter().map(gap).collect()
}
