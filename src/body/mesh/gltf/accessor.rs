use serde_json::Value;

use super::{
    super::{MeshError, Place, source::Records},
    buffers::Buffers,
    json,
};
use crate::math::Vec3;

/// The positions that an accessor names, three numbers each.
pub(super) fn positions(buffers: &Buffers<'_>, accessor: usize) -> Result<Vec<Vec3>, MeshError> {
    match kind(buffers, accessor)? {
        (FLOAT, "VEC3") => values(buffers, accessor, 12, Records::point),
        _ => Err(unsupported(
            accessor,
            "positions other than three 32-bit floats",
        )),
    }
}

/// The numbers of vertices that an accessor names.
pub(super) fn indices(buffers: &Buffers<'_>, accessor: usize) -> Result<Vec<u32>, MeshError> {
    match kind(buffers, accessor)? {
        (UNSIGNED_BYTE, "SCALAR") => values(buffers, accessor, 1, |records| {
            records.array().map(|bytes| u8::from_le_bytes(bytes).into())
        }),
        (UNSIGNED_SHORT, "SCALAR") => values(buffers, accessor, 2, |records| {
            records
                .array()
                .map(|bytes| u16::from_le_bytes(bytes).into())
        }),
        (UNSIGNED_INT, "SCALAR") => values(buffers, accessor, 4, Records::u32),
        _ => Err(unsupported(
            accessor,
            "indices other than whole numbers from 0 on",
        )),
    }
}

const UNSIGNED_BYTE: usize = 5121;
const UNSIGNED_SHORT: usize = 5123;
const UNSIGNED_INT: usize = 5125;
const FLOAT: usize = 5126;

/// The type of an accessor's numbers, and how many make a value.
fn kind<'a>(buffers: &'a Buffers<'_>, index: usize) -> Result<(usize, &'a str), MeshError> {
    let accessor = json::item(buffers.document, "accessors", index)?;
    let component = json::number(place(index), accessor, "componentType")?.unwrap_or(0);
    Ok((
        component,
        accessor.get("type").and_then(Value::as_str).unwrap_or(""),
    ))
}

/// Each value of an accessor; they must lie within its view.
fn values<'a, T>(
    buffers: &'a Buffers<'_>,
    index: usize,
    size: usize,
    read: impl Fn(&mut Records<'a>) -> Result<T, MeshError>,
) -> Result<Vec<T>, MeshError> {
    let accessor = json::item(buffers.document, "accessors", index)?;
    let number = |key| json::number(place(index), accessor, key);
    let (Some(view), None) = (number("bufferView")?, accessor.get("sparse")) else {
        return Err(unsupported(
            index,
            "values that are sparse, compressed or in no buffer view",
        ));
    };
    let (mut records, stride) = buffers.view(view)?;
    records.take(number("byteOffset")?.unwrap_or(0))?;
    let count = number("count")?.unwrap_or(0);
    records.check(count as u64, size as u64)?;
    let between = stride.unwrap_or(size).saturating_sub(size);
    let mut values = Vec::with_capacity(count);
    for position in 0..count {
        if position > 0 {
            records.take(between)?;
        }
        values.push(read(&mut records)?);
    }
    Ok(values)
}

fn place(index: usize) -> Place {
    Place::Item {
        list: "accessors",
        index,
    }
}

fn unsupported(index: usize, what: &str) -> MeshError {
    let what = format!("{} has {what}, which", place(index));
    MeshError::Unsupported {
        what,
        instead: "write the mesh with plain ones",
    }
}
