//! Wavefront OBJ: the lines that begin with `v` and `f`; everything else is passed over.

use super::{
    MeshError, Place,
    source::{Soup, lines, malformed, point, refuse_binary},
};

/// Reads an OBJ file.
pub(super) fn read(bytes: &[u8]) -> Result<Soup, MeshError> {
    refuse_binary(bytes, "the text of an OBJ file")?;
    let mut soup = Soup::default();
    let mut highest = Highest::default();
    let mut begun = String::new();
    for (line, text) in lines(bytes) {
        // A backslash at the end of a line goes on with it in the next.
        if let Some(part) = text.strip_suffix('\\') {
            begun.push_str(part);
            begun.push(' ');
            continue;
        }
        begun.push_str(&text);
        read_line(&mut soup, &mut highest, line, &begun)?;
        begun.clear();
    }
    highest.check(soup.vertices.len())?;
    Ok(soup)
}

/// The highest vertex that a face names. Faces may stand before their vertices, so it is checked
/// at the end, when the line would be forgotten.
#[derive(Default)]
struct Highest {
    index: u32,
    line: usize,
}

impl Highest {
    fn check(&self, count: usize) -> Result<(), MeshError> {
        if self.line == 0 || (self.index as usize) < count {
            return Ok(());
        }
        let index = i64::from(self.index) + 1;
        Err(MeshError::Index {
            place: Place::Line(self.line),
            index,
            count,
            from: 1,
        })
    }
}

fn read_line(
    soup: &mut Soup,
    highest: &mut Highest,
    line: usize,
    text: &str,
) -> Result<(), MeshError> {
    let place = Place::Line(line);
    let mut words = text.split_ascii_whitespace();
    match words.next() {
        Some("v") => {
            soup.vertex(point(place, &mut words)?)?;
        }
        Some("f") => {
            let words = words.take_while(|word| !word.starts_with('#'));
            let corner = |word| corner(place, word, soup.vertices.len());
            let corners = words.map(corner).collect::<Result<Vec<_>, _>>()?;
            if corners.len() < 3 {
                return Err(malformed(place, text, "a face of at least three vertices"));
            }
            for &index in &corners {
                if highest.line == 0 || index > highest.index {
                    *highest = Highest { index, line };
                }
            }
            soup.polygon(&corners)?;
        }
        _ => {}
    }
    Ok(())
}

/// The vertex, from 0, of a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`: from 1 on, or back from −1.
fn corner(place: Place, word: &str, count: usize) -> Result<u32, MeshError> {
    let digits = word.split('/').next().unwrap_or(word);
    let index: i64 = digits
        .parse()
        .map_err(|_| malformed(place, word, "the number of a vertex"))?;
    let from_zero = if index < 0 {
        index.checked_add(count as i64)
    } else {
        index.checked_sub(1)
    };
    from_zero
        .and_then(|zero| u32::try_from(zero).ok())
        .ok_or(MeshError::Index {
            place,
            index,
            count,
            from: 1,
        })
}
