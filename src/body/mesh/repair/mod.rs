//! From faces as a file gives them to a mesh: checked, merged, thinned out, wound alike.

mod edges;
mod merge;
mod needles;
mod winding;

use std::collections::BTreeSet;

use super::{
    FARTHEST, Inspection, MOST_FACES, MeshError, Place, inspect,
    source::{Soup, finite},
};
use crate::math::Vec3;

pub(super) use edges::{Edge, edges};
pub(super) use merge::extent;

type Repaired = (Vec<Vec3>, Vec<[u32; 3]>, Inspection);

/// Checks and cleans; the corners, the faces, and what was done.
pub(super) fn repaired(soup: Soup) -> Result<Repaired, MeshError> {
    if soup.triangles.is_empty() {
        return Err(MeshError::NoFaces);
    }
    if soup.triangles.len() > MOST_FACES {
        let count = soup.triangles.len() as u64;
        return Err(MeshError::TooMany {
            count,
            limit: MOST_FACES,
        });
    }
    check_vertices(&soup.vertices)?;
    check_indices(&soup.triangles, soup.vertices.len())?;

    let count = soup.triangles.len();
    let merged = merge::merged(soup);
    let (vertices, tolerance) = (merged.soup.vertices, merged.tolerance);
    let (mut triangles, degenerate) =
        needles::without_needles(&vertices, merged.soup.triangles, tolerance);
    let duplicate = drop_duplicates(&mut triangles);
    if triangles.is_empty() {
        return Err(MeshError::Flat { count });
    }
    let shells = winding::wind_alike(&vertices, &mut triangles);
    let soup = merge::used(Soup {
        vertices,
        triangles,
    });
    let inspection = Inspection {
        degenerate,
        duplicate,
        flipped: shells.flipped,
        components: shells.count,
        ..inspect::inspected(&soup)
    };
    Ok((soup.vertices, soup.triangles, inspection))
}

/// Every corner of a face must be there.
pub(super) fn check_indices(triangles: &[[u32; 3]], count: usize) -> Result<(), MeshError> {
    for (face, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&index| index as usize >= count) {
            let place = Place::Face(face + 1);
            return Err(MeshError::Index {
                place,
                index: index.into(),
                count,
                from: 0,
            });
        }
    }
    Ok(())
}

fn check_vertices(vertices: &[Vec3]) -> Result<(), MeshError> {
    for (vertex, position) in vertices.iter().enumerate() {
        let place = Place::Vertex(vertex + 1);
        for &cm in position.iter() {
            if finite(place, cm)?.abs() > FARTHEST {
                return Err(MeshError::TooFar { place, cm });
            }
        }
    }
    Ok(())
}

/// Leaves out faces with the same corners as an earlier one, whichever way they are wound.
fn drop_duplicates(triangles: &mut Vec<[u32; 3]>) -> usize {
    let before = triangles.len();
    let mut seen = BTreeSet::new();
    triangles.retain(|triangle| {
        let mut corners = *triangle;
        corners.sort_unstable();
        seen.insert(corners)
    });
    before - triangles.len()
}

/// The corner that an index of a checked face names.
pub(super) fn at(vertices: &[Vec3], index: u32) -> Vec3 {
    vertices.get(index as usize).copied().unwrap_or_default()
}
