//! What every reader needs: words and numbers of a text, records of bytes, and a place to put
//! vertices and faces, none of which trusts a count that a header gives.

use super::{MOST_FACES, MeshError, Place};
use crate::math::Vec3;

/// Vertices and faces as a file gives them, in the file's unit and frame.
#[derive(Clone, Debug, Default)]
pub(super) struct Soup {
    pub(super) vertices: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Soup {
    /// Adds a vertex; its number.
    pub(super) fn vertex(&mut self, position: Vec3) -> Result<u32, MeshError> {
        let number = self.vertices.len();
        let most = 3 * MOST_FACES;
        match u32::try_from(number) {
            Ok(index) if number < most => {
                self.vertices.push(position);
                Ok(index)
            }
            _ => Err(MeshError::TooMany {
                count: number as u64 + 1,
                limit: most,
            }),
        }
    }

    /// Adds a polygon as a fan of triangles about its first corner.
    pub(super) fn polygon(&mut self, corners: &[u32]) -> Result<(), MeshError> {
        let [first, rest @ ..] = corners else {
            return Ok(());
        };
        for pair in rest.windows(2) {
            if let [second, third] = pair {
                self.triangle([*first, *second, *third])?;
            }
        }
        Ok(())
    }

    /// Adds a triangle.
    pub(super) fn triangle(&mut self, corners: [u32; 3]) -> Result<(), MeshError> {
        if self.triangles.len() >= MOST_FACES {
            let count = self.triangles.len() as u64 + 1;
            return Err(MeshError::TooMany {
                count,
                limit: MOST_FACES,
            });
        }
        self.triangles.push(corners);
        Ok(())
    }
}

/// The lines of a text, numbered from 1, without their ends; bytes that are no UTF-8 are shown as
/// U+FFFD, since comments are often written in older codes.
pub(super) fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, std::borrow::Cow<'_, str>)> {
    let text = bytes.strip_suffix(b"\n").unwrap_or(bytes);
    let numbered = text.split(|&byte| byte == b'\n').enumerate();
    numbered.map(|(index, line)| {
        (
            index + 1,
            String::from_utf8_lossy(line.strip_suffix(b"\r").unwrap_or(line)),
        )
    })
}

/// Refuses a text that holds a zero byte, which only binary files do.
pub(super) fn refuse_binary(bytes: &[u8], expected: &str) -> Result<(), MeshError> {
    match bytes.iter().position(|&byte| byte == 0) {
        Some(byte) => Err(malformed(Place::Byte(byte), "\0", expected)),
        None => Ok(()),
    }
}

/// Three finite numbers from the words of a line.
pub(super) fn point<'a>(
    place: Place,
    words: &mut impl Iterator<Item = &'a str>,
) -> Result<Vec3, MeshError> {
    let mut next = || number(place, words.next().unwrap_or(""));
    Ok(Vec3::new(next()?, next()?, next()?))
}

/// A finite number.
pub(super) fn number(place: Place, word: &str) -> Result<f64, MeshError> {
    let value: f64 = word
        .parse()
        .map_err(|_| malformed(place, word, "a number"))?;
    finite(place, value)
}

/// A number, if it is finite.
pub(super) fn finite(place: Place, value: f64) -> Result<f64, MeshError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(MeshError::NotFinite { place, value })
    }
}

/// Says that something else stands where `expected` must.
pub(super) fn malformed(place: Place, found: &str, expected: &str) -> MeshError {
    let found = found.chars().take(40).collect();
    MeshError::Malformed {
        place,
        found,
        expected: expected.into(),
    }
}

/// Reads records off the front of some bytes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Records<'a> {
    bytes: &'a [u8],
    /// Where in the file the bytes begin.
    at: usize,
}

impl<'a> Records<'a> {
    /// The bytes of a file from `at` on; none where it ends before.
    pub(super) fn from(file: &'a [u8], at: usize) -> Self {
        Self {
            bytes: file.get(at..).unwrap_or_default(),
            at,
        }
    }

    /// How many bytes are left.
    pub(super) fn left(&self) -> usize {
        self.bytes.len()
    }

    /// The place of the next record.
    pub(super) fn place(&self) -> Place {
        Place::Byte(self.at)
    }

    /// Says how much is missing, unless `count` records of `size` bytes are left.
    pub(super) fn check(&self, count: u64, size: u64) -> Result<(), MeshError> {
        let left = self.bytes.len() as u64;
        let needed = count.saturating_mul(size);
        if needed <= left {
            return Ok(());
        }
        Err(MeshError::CutOff {
            place: self.place(),
            needed,
            left,
        })
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], MeshError> {
        self.check(count as u64, 1)?;
        let (head, tail) = self
            .bytes
            .split_at_checked(count)
            .unwrap_or((self.bytes, &[]));
        self.bytes = tail;
        self.at += head.len();
        Ok(head)
    }

    /// The next `N` bytes.
    pub(super) fn array<const N: usize>(&mut self) -> Result<[u8; N], MeshError> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N)?);
        Ok(array)
    }

    /// The next number of four bytes, least byte first.
    pub(super) fn u32(&mut self) -> Result<u32, MeshError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    /// Three finite `f32`, least byte first.
    pub(super) fn point(&mut self) -> Result<Vec3, MeshError> {
        let mut next = || finite(self.place(), f64::from(f32::from_le_bytes(self.array()?)));
        Ok(Vec3::new(next()?, next()?, next()?))
    }
}
