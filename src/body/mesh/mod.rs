//! Triangle meshes from files: read, scaled to cm with z up, cleaned, and told about.
//!
//! Cleaning merges vertices that stand at the same place (files split them by texture
//! coordinates), leaves out faces without area and faces given twice, turns faces wound against
//! their neighbours, and turns closed shells outward. It closes no hole: a mesh with a hole is an
//! open sheet with two sides, so that cloth which starts outside stays outside.
//!
//! The readers are our own, since files are not to be trusted: of the crates at hand, `tobj` reads
//! numbers as `f32` and names no line, `stl_io` takes a binary file whose header begins with
//! "solid " for text, `ply-rs-bw` makes as many elements without properties as a header claims,
//! and `gltf` panics on a position that names no accessor. They are the tests' oracles instead.

mod error;
mod inspect;
mod repair;
mod source;

mod gltf;
mod obj;
mod ply;
mod stl;

pub use error::{MeshError, Place};
pub use inspect::Inspection;

use std::path::Path;

use crate::math::Vec3;
use source::Soup;

/// Most faces taken from a file. A scan of a body has a tenth of it; what asks for more is a
/// glTF file that repeats a mesh at every node.
const MOST_FACES: usize = 5_000_000;

/// Farthest coordinate taken [cm]: ten kilometres. Its fourth power is far from overflow.
const FARTHEST: f64 = 1e6;

/// A triangle mesh [cm], z up, cleaned: finite vertices, indices in range, every face with an
/// area, faces wound alike, closed shells outward.
///
/// Only [`Mesh::new`] and [`Mesh::read`] make one.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Corners [cm], each used by a face.
    pub vertices: Vec<Vec3>,
    /// Corners of each face, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    inspection: Inspection,
}

/// A file format of meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// STL, text or binary.
    Stl,
    /// PLY, text or binary of either byte order.
    Ply,
    /// glTF 2.0, as .glb or as .gltf with its buffers inside.
    Gltf,
}

/// The length that 1 stands for in a file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Unit {
    /// Metre, as glTF prescribes.
    Metre,
    /// Centimetre.
    #[default]
    Centimetre,
    /// Millimetre.
    Millimetre,
    /// Inch, 2.54 cm.
    Inch,
    /// Any other length [cm], greater than 0.
    Of(f64),
}

/// The axis of a file that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Up {
    /// y, as in most modelling programs and in glTF: (x, y, z) becomes (x, −z, y).
    Y,
    /// z, as here.
    #[default]
    Z,
}

impl Mesh {
    /// A mesh from corners [cm] and faces, cleaned.
    ///
    /// # Errors
    /// [`MeshError`] where a corner is not finite or beyond 10 km, an index is out of range, or
    /// no face has an area.
    pub fn new(vertices: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        let soup = Soup {
            vertices,
            triangles,
        };
        let (vertices, triangles, inspection) = repair::repaired(soup)?;
        Ok(Self {
            vertices,
            triangles,
            inspection,
        })
    }

    /// Reads a file's bytes; polygons become fans of triangles, glTF nodes stand where their
    /// transforms put them.
    ///
    /// # Errors
    /// [`MeshError`] where the bytes are not such a file, or not one of a mesh.
    pub fn read(bytes: &[u8], format: Format, unit: Unit, up: Up) -> Result<Self, MeshError> {
        let cm = unit.cm();
        if !(cm.is_finite() && cm > 0.0) {
            return Err(MeshError::Unit { cm });
        }
        if bytes.is_empty() {
            return Err(MeshError::Empty);
        }
        let soup = match format {
            Format::Obj => obj::read(bytes),
            Format::Stl => stl::read(bytes),
            Format::Ply => ply::read(bytes),
            Format::Gltf => gltf::read(bytes),
        }?;
        let vertices = soup.vertices.iter().map(|v| up.turned(v * cm)).collect();
        Self::new(vertices, soup.triangles)
    }

    /// What was found in the mesh and what cleaning did to it.
    #[must_use]
    pub fn inspection(&self) -> &Inspection {
        &self.inspection
    }
}

impl Format {
    /// The format that a path's ending names: obj, stl, ply, glb or gltf, in any case.
    #[must_use]
    pub fn of_path(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "obj" => Some(Self::Obj),
            "stl" => Some(Self::Stl),
            "ply" => Some(Self::Ply),
            "glb" | "gltf" => Some(Self::Gltf),
            _ => None,
        }
    }
}

impl Unit {
    /// Its length [cm].
    #[must_use]
    pub fn cm(self) -> f64 {
        match self {
            Self::Metre => 100.0,
            Self::Centimetre => 1.0,
            Self::Millimetre => 0.1,
            Self::Inch => 2.54,
            Self::Of(cm) => cm,
        }
    }
}

impl Up {
    fn turned(self, v: Vec3) -> Vec3 {
        match self {
            Self::Y => Vec3::new(v.x, -v.z, v.y),
            Self::Z => v,
        }
    }
}

#[cfg(test)]
mod tests;
