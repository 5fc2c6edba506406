use super::{
    super::{
        MeshError, Place,
        source::{Records, malformed},
    },
    header::{Encoding, Header, Property, Scalar},
};

/// The values after a header, one after the other.
#[derive(Debug)]
pub(super) enum Values<'a> {
    /// Words with white space between, and the line they are in.
    Text { rest: &'a [u8], line: usize },
    /// Bytes.
    Binary {
        records: Records<'a>,
        greatest_first: bool,
    },
}

impl<'a> Values<'a> {
    pub(super) fn new(file: &'a [u8], header: &Header) -> Self {
        let records = Records::from(file, header.bytes);
        match header.encoding {
            Encoding::Text => Self::Text {
                rest: file.get(header.bytes..).unwrap_or_default(),
                line: header.lines + 1,
            },
            Encoding::LittleEndian => Self::Binary {
                records,
                greatest_first: false,
            },
            Encoding::BigEndian => Self::Binary {
                records,
                greatest_first: true,
            },
        }
    }

    /// The place of the next value.
    pub(super) fn place(&mut self) -> Place {
        match self {
            Self::Text { rest, line } => {
                pass_space(rest, line);
                Place::Line(*line)
            }
            Self::Binary { records, .. } => records.place(),
        }
    }

    /// The next value, which may be NaN or infinite.
    pub(super) fn number(&mut self, scalar: Scalar) -> Result<f64, MeshError> {
        match self {
            Self::Text { rest, line } => {
                let word = next_word(rest, line)?;
                word.parse()
                    .map_err(|_| malformed(Place::Line(*line), word, "a number"))
            }
            Self::Binary {
                records,
                greatest_first,
            } => binary_number(records, *greatest_first, scalar),
        }
    }

    /// Hands each value of the next list to `each`.
    pub(super) fn list(
        &mut self,
        property: &Property,
        mut each: impl FnMut(f64) -> Result<(), MeshError>,
    ) -> Result<(), MeshError> {
        let place = self.place();
        let count = self.number(property.counted_by.unwrap_or(Scalar::U8))?;
        if !(0.0..=f64::from(u32::MAX)).contains(&count) || count.fract() != 0.0 {
            return Err(malformed(place, &count.to_string(), "the length of a list"));
        }
        // The greatest is u32::MAX, so nothing is lost.
        let count = count as u32;
        if let Self::Binary { records, .. } = self {
            records.check(count.into(), property.scalar.size())?;
        }
        for _ in 0..count {
            each(self.number(property.scalar)?)?;
        }
        Ok(())
    }
}

/// Passes over white space, counting the lines.
fn pass_space(rest: &mut &[u8], line: &mut usize) {
    while let [byte, tail @ ..] = *rest
        && byte.is_ascii_whitespace()
    {
        *line += usize::from(*byte == b'\n');
        *rest = tail;
    }
}

/// The next word.
fn next_word<'a>(rest: &mut &'a [u8], line: &mut usize) -> Result<&'a str, MeshError> {
    pass_space(rest, line);
    let length = rest
        .iter()
        .position(u8::is_ascii_whitespace)
        .unwrap_or(rest.len());
    if length == 0 {
        let missing = "the last of the values that its header counts".into();
        return Err(MeshError::Unfinished {
            line: *line,
            missing,
        });
    }
    let (word, tail) = rest.split_at_checked(length).unwrap_or((rest, &[]));
    *rest = tail;
    str::from_utf8(word).map_err(|_| {
        malformed(
            Place::Line(*line),
            &String::from_utf8_lossy(word),
            "a number",
        )
    })
}

fn binary_number(
    records: &mut Records<'_>,
    greatest_first: bool,
    scalar: Scalar,
) -> Result<f64, MeshError> {
    Ok(match scalar {
        Scalar::I8 => f64::from(i8::from_le_bytes(records.array()?)),
        Scalar::U8 => f64::from(u8::from_le_bytes(records.array()?)),
        Scalar::I16 => f64::from(i16::from_le_bytes(ordered(records, greatest_first)?)),
        Scalar::U16 => f64::from(u16::from_le_bytes(ordered(records, greatest_first)?)),
        Scalar::I32 => f64::from(i32::from_le_bytes(ordered(records, greatest_first)?)),
        Scalar::U32 => f64::from(u32::from_le_bytes(ordered(records, greatest_first)?)),
        Scalar::F32 => f64::from(f32::from_le_bytes(ordered(records, greatest_first)?)),
        Scalar::F64 => f64::from_le_bytes(ordered(records, greatest_first)?),
    })
}

/// The bytes of a number, least first.
fn ordered<const N: usize>(
    records: &mut Records<'_>,
    greatest_first: bool,
) -> Result<[u8; N], MeshError> {
    let mut bytes = records.array()?;
    if greatest_first {
        bytes.reverse();
    }
    Ok(bytes)
}
