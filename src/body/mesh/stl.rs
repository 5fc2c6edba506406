//! STL: three corners a facet, as text or as records of 50 bytes.

use super::{
    MeshError, Place,
    source::{Records, Soup, lines, malformed, point},
};

/// Bytes before the facets of a binary file: 80 of anything, 4 of their number.
const HEAD: usize = 84;
/// Bytes of a binary facet: normal, three corners, two spare bytes.
const FACET: usize = 50;

/// Reads an STL file.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, MeshError> {
    if is_text(bytes) {
        read_text(bytes)
    } else {
        read_binary(bytes)
    }
}

/// A binary file may begin with "solid" too, but its length then follows from its count.
fn is_text(bytes: &[u8]) -> bool {
    let mut head = Records::from(bytes, HEAD - 4);
    let counted = head.u32().is_ok_and(|count| {
        (count as usize)
            .checked_mul(FACET)
            .is_some_and(|length| length == head.left())
    });
    !counted && bytes.trim_ascii_start().starts_with(b"solid") && !bytes.contains(&0)
}

fn read_binary(bytes: &[u8]) -> Result<Soup, MeshError> {
    let mut records = Records::from(bytes, 0);
    records.take(HEAD - 4)?;
    let count = records.u32()?;
    records.check(count.into(), FACET as u64)?;
    let mut soup = Soup::default();
    for _ in 0..count {
        records.take(12)?;
        let mut corner = || soup.vertex(records.point()?);
        let corners = [corner()?, corner()?, corner()?];
        soup.triangle(corners)?;
        records.take(2)?;
    }
    Ok(soup)
}

fn read_text(bytes: &[u8]) -> Result<Soup, MeshError> {
    let mut soup = Soup::default();
    let mut corners = Vec::new();
    let (mut last, mut ended) = (1, true);
    for (line, text) in lines(bytes) {
        let place = Place::Line(line);
        let mut words = text.split_ascii_whitespace();
        let Some(word) = words.next() else { continue };
        last = line;
        match word.to_ascii_lowercase().as_str() {
            "solid" => ended = false,
            "endsolid" => ended = true,
            "facet" => corners.clear(),
            "vertex" => corners.push(soup.vertex(point(place, &mut words)?)?),
            "endfacet" if corners.len() == 3 => soup.polygon(&corners)?,
            "endfacet" => return Err(malformed(place, &text, "the third vertex of a facet")),
            "outer" | "endloop" => {}
            _ => return Err(malformed(place, &text, "a line of an STL file")),
        }
    }
    if !ended {
        return Err(MeshError::Unfinished {
            line: last,
            missing: "\"endsolid\"".into(),
        });
    }
    Ok(soup)
}
