//! What a drape is handed on as: meshes for other programs (OBJ, GLB, PLY), a picture (PNG), heat
//! maps with a legend in physical units, and the report (JSON). What moves is one mesh (GLB) or a
//! film of pictures (animated PNG). Curves become a plot (SVG),
//! and what was found in measurements a fabric file (TOML).
//!
//! Everything is made in memory and returned; [`write()`] alone touches files, and it replaces a
//! file only by a whole one. Nothing here fails for a shape that is not at rest, not even for one
//! whose positions are not finite: cells and bodies that cannot be drawn are left out.
//! The same input gives the same bytes, whatever the number of threads.

mod animation;
mod apng;
mod colour;
mod comparisons;
mod figure;
mod film_report;
mod fitted;
mod glb;
mod gltf_file;
mod heat;
mod mesh_file;
mod obj;
mod picture;
mod plot;
mod ply;
mod png;
mod reading;
mod report;
#[cfg(test)]
mod sample;
mod sheet;
mod shell;
mod shot;
mod weave;
mod write;

pub use animation::{Film, animated_glb};
pub use apng::animated_png;
pub use comparisons::{comparison_table, comparisons};
pub use figure::{bone_meshes, muscle_meshes};
pub use film_report::film_report;
pub use fitted::{fabric_file, fit_plot, fit_report};
pub use glb::glb;
pub use heat::{HeatMap, Map, UnknownMap};
pub use mesh_file::{figure_obj, mesh_file};
pub use obj::obj;
pub use picture::{Frame, View, picture, picture_pixels};
pub use plot::{Mark, Plot, Series, plot};
pub use ply::ply;
pub use png::Image;
pub use reading::{curve, reading};
pub use report::{Run, report};
pub use sheet::contact_sheet;
pub use shot::{Shot, digest};
pub use write::{WriteError, write};

use crate::{body::Bodies, lattice::Lattice, math::Vec3};

/// A cloth in space.
#[derive(Clone, Copy, Debug)]
pub struct ClothMesh<'a> {
    /// Its nodes, cells and cloth coordinates.
    pub lattice: &'a Lattice,
    /// Positions of the nodes [cm], in lattice order.
    pub positions: &'a [Vec3],
}

/// The surface of a body in space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyMesh {
    /// What it is called.
    pub name: String,
    /// Points [cm].
    pub vertices: Vec<Vec3>,
    /// Corners of each face, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// The surfaces of all parts of the bodies, in their order.
#[must_use]
pub fn body_meshes(bodies: &Bodies) -> Vec<BodyMesh> {
    let parts = bodies.parts().iter();
    let meshed = parts.map(|part| {
        let (vertices, triangles) = part.triangles();
        BodyMesh {
            name: part.name().to_owned(),
            vertices,
            triangles,
        }
    });
    meshed.collect()
}
