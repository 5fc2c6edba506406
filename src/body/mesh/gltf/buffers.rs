use std::borrow::Cow;

use serde_json::Value;

use super::{
    super::{
        MeshError, Place,
        source::{Records, malformed},
    },
    json,
};

const MAGIC: &[u8] = b"glTF";

/// The JSON of a file and, of a .glb, the bytes beside it.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), MeshError> {
    if !bytes.starts_with(MAGIC) {
        return Ok((bytes, None));
    }
    let mut records = Records::from(bytes, MAGIC.len());
    let version = records.u32()?;
    if version != 2 {
        let what = format!("version {version} of glTF");
        return Err(MeshError::Unsupported {
            what,
            instead: "write it as version 2",
        });
    }
    records.u32()?;
    let json = chunk(&mut records, b"JSON")?;
    let binary = if records.left() == 0 {
        None
    } else {
        Some(chunk(&mut records, b"BIN\0")?)
    };
    Ok((json, binary))
}

fn chunk<'a>(records: &mut Records<'a>, kind: &[u8; 4]) -> Result<&'a [u8], MeshError> {
    let length = records.u32()?;
    let place = records.place();
    let found: [u8; 4] = records.array()?;
    if &found != kind {
        let expected = format!("a chunk {:?}", String::from_utf8_lossy(kind));
        return Err(malformed(
            place,
            &String::from_utf8_lossy(&found),
            &expected,
        ));
    }
    records.take(length as usize)
}

/// The bytes of each buffer, beside the document that names them.
pub(super) struct Buffers<'a> {
    pub(super) document: &'a Value,
    bytes: Vec<Cow<'a, [u8]>>,
}

impl<'a> Buffers<'a> {
    /// The buffers of a document; the first may be what a .glb holds beside it.
    pub(super) fn read(document: &'a Value, binary: Option<&'a [u8]>) -> Result<Self, MeshError> {
        let mut bytes = Vec::new();
        for (index, buffer) in json::list(document, "buffers").iter().enumerate() {
            let place = Place::Item {
                list: "buffers",
                index,
            };
            bytes.push(match buffer.get("uri").and_then(Value::as_str) {
                Some(uri) => Cow::Owned(embedded(place, uri)?),
                None if index == 0 => Cow::Borrowed(binary.unwrap_or_default()),
                None => Cow::Borrowed(&[][..]),
            });
        }
        Ok(Self { document, bytes })
    }

    /// The bytes of a view, and how far apart its values begin.
    pub(super) fn view(&self, index: usize) -> Result<(Records<'_>, Option<usize>), MeshError> {
        let place = Place::Item {
            list: "bufferViews",
            index,
        };
        let view = json::item(self.document, "bufferViews", index)?;
        let number = |key| json::number(place, view, key);
        let offset = number("byteOffset")?.unwrap_or(0);
        let length = number("byteLength")?.unwrap_or(0);
        let index = number("buffer")?.unwrap_or(0);
        let buffer = self.bytes.get(index).map(Cow::as_ref).unwrap_or_default();
        let end = offset.saturating_add(length);
        let Some(bytes) = buffer.get(..end) else {
            let (needed, left) = (end as u64, buffer.len() as u64);
            let place = Place::Item {
                list: "buffers",
                index,
            };
            return Err(MeshError::CutOff {
                place,
                needed,
                left,
            });
        };
        Ok((Records::from(bytes, offset), number("byteStride")?))
    }
}

fn embedded(place: Place, uri: &str) -> Result<Vec<u8>, MeshError> {
    let Some(data) = uri.strip_prefix("data:") else {
        let name: String = uri.chars().take(40).collect();
        let what = format!("a buffer in a file of its own, {name:?},");
        return Err(MeshError::Unsupported {
            what,
            instead: "write the mesh as .glb",
        });
    };
    let expected = "base64 after \";base64,\"";
    let (_, text) = data
        .split_once(";base64,")
        .ok_or_else(|| malformed(place, data, expected))?;
    decoded(text).ok_or_else(|| malformed(place, text, expected))
}

/// The bytes of a base64 text (RFC 4648 §4), its padding left out or not.
fn decoded(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    let (mut held, mut bits) = (0_u32, 0);
    for letter in text.trim_end_matches('=').bytes() {
        held = held << 6 | u32::from(sextet(letter)?);
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((held >> bits) as u8);
            held &= (1 << bits) - 1;
        }
    }
    Some(bytes)
}

fn sextet(letter: u8) -> Option<u8> {
    match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_reads_the_vectors_of_rfc_4648() {
        for (text, bytes) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
        ] {
            assert_eq!(decoded(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(decoded("Zm9v Yg"), None);
    }
}
