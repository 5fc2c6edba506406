//! PLY: a header that declares elements and their properties, then their values as text or as
//! bytes. Vertices and faces are read, other elements and properties passed over.

mod header;
mod values;

use super::{
    MeshError,
    source::{Soup, finite, malformed},
};
use crate::math::Vec3;
use header::{Element, Header, Property};
use values::Values;

/// Reads a PLY file.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, MeshError> {
    let header = Header::read(bytes)?;
    let mut values = Values::new(bytes, &header);
    let mut soup = Soup::default();
    for element in &header.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut soup, element, &mut values)?,
            "face" => read_faces(&mut soup, element, &mut values)?,
            "tristrips" => {
                let what = "a PLY file of triangle strips".into();
                return Err(MeshError::Unsupported {
                    what,
                    instead: "write it with faces",
                });
            }
            _ => pass_over(element, &mut values)?,
        }
    }
    Ok(soup)
}

fn read_vertices(
    soup: &mut Soup,
    element: &Element,
    values: &mut Values<'_>,
) -> Result<(), MeshError> {
    let axes = ["x", "y", "z"].map(|axis| element.properties.iter().position(|p| p.name == axis));
    let [Some(x), Some(y), Some(z)] = axes else {
        return Err(malformed(
            element.place,
            &element.name,
            "an element with x, y and z",
        ));
    };
    for _ in 0..element.count {
        let mut position = Vec3::zeros();
        for (index, property) in element.properties.iter().enumerate() {
            let place = values.place();
            let value = first(property, values)?;
            for (axis, of_axis) in [x, y, z].into_iter().enumerate() {
                if of_axis == index
                    && let Some(coordinate) = position.get_mut(axis)
                {
                    *coordinate = finite(place, value)?;
                }
            }
        }
        soup.vertex(position)?;
    }
    Ok(())
}

/// The value of a plain property; that of a list does not matter.
fn first(property: &Property, values: &mut Values<'_>) -> Result<f64, MeshError> {
    match property.counted_by {
        None => values.number(property.scalar),
        Some(_) => values.list(property, |_| Ok(())).map(|()| 0.0),
    }
}

fn read_faces(
    soup: &mut Soup,
    element: &Element,
    values: &mut Values<'_>,
) -> Result<(), MeshError> {
    let is_corners = |p: &Property| {
        p.counted_by.is_some() && matches!(p.name.as_str(), "vertex_indices" | "vertex_index")
    };
    if !element.properties.iter().any(is_corners) {
        let expected = "an element with a list vertex_indices";
        return Err(malformed(element.place, &element.name, expected));
    }
    let mut corners = Vec::new();
    for _ in 0..element.count {
        for property in &element.properties {
            if !is_corners(property) {
                first(property, values)?;
                continue;
            }
            corners.clear();
            let place = values.place();
            values.list(property, |value| {
                // Exact: no `f64` between 0 and 2³² that is whole is lost on the way.
                let index = value as u32;
                if f64::from(index) != value {
                    return Err(malformed(
                        place,
                        &value.to_string(),
                        "the number of a vertex",
                    ));
                }
                corners.push(index);
                Ok(())
            })?;
            soup.polygon(&corners)?;
        }
    }
    Ok(())
}

fn pass_over(element: &Element, values: &mut Values<'_>) -> Result<(), MeshError> {
    // Without properties an element takes no bytes, and its count may say anything.
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            first(property, values)?;
        }
    }
    Ok(())
}
