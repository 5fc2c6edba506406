use super::super::{
    MeshError, Place,
    source::{lines, malformed},
};

/// How the values follow the header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    /// One element a line.
    Text,
    /// Bytes, least first.
    LittleEndian,
    /// Bytes, greatest first.
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A value of an element.
#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) scalar: Scalar,
    /// The type of the count before the values of a list.
    pub(super) counted_by: Option<Scalar>,
}

/// A run of things that are alike.
#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    pub(super) place: Place,
}

/// What stands before the values.
#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Where the values begin [byte].
    pub(super) bytes: usize,
    /// Lines of the header.
    pub(super) lines: usize,
}

impl Header {
    pub(super) fn read(bytes: &[u8]) -> Result<Self, MeshError> {
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        let mut length = 0;
        let mut last = 1;
        for (line, text) in lines(bytes) {
            let place = Place::Line(line);
            if line == 1 && text.trim_ascii_end() != "ply" {
                return Err(malformed(place, &text, "\"ply\""));
            }
            let raw = bytes.get(length..).unwrap_or_default();
            length += raw
                .iter()
                .position(|&byte| byte == b'\n')
                .map_or(raw.len(), |at| at + 1);
            last = line;
            let words: Vec<&str> = text.split_ascii_whitespace().collect();
            match words.as_slice() {
                ["format", name, ..] => encoding = Some(Encoding::named(place, name)?),
                ["element", name, count] => elements.push(Element::new(place, name, count)?),
                ["property", words @ ..] => {
                    let property = Property::new(place, words)?;
                    let Some(element) = elements.last_mut() else {
                        return Err(malformed(place, &text, "an element before its properties"));
                    };
                    element.properties.push(property);
                }
                ["end_header"] => {
                    let encoding = encoding
                        .ok_or_else(|| malformed(place, &text, "a line \"format\" before it"))?;
                    return Ok(Self {
                        encoding,
                        elements,
                        bytes: length,
                        lines: line,
                    });
                }
                ["ply" | "comment" | "obj_info", ..] | [] => {}
                _ => return Err(malformed(place, &text, "a line of a PLY header")),
            }
        }
        Err(MeshError::Unfinished {
            line: last,
            missing: "\"end_header\"".into(),
        })
    }
}

impl Encoding {
    fn named(place: Place, name: &str) -> Result<Self, MeshError> {
        match name {
            "ascii" => Ok(Self::Text),
            "binary_little_endian" => Ok(Self::LittleEndian),
            "binary_big_endian" => Ok(Self::BigEndian),
            _ => Err(malformed(
                place,
                name,
                "ascii, binary_little_endian or binary_big_endian",
            )),
        }
    }
}

impl Element {
    fn new(place: Place, name: &str, count: &str) -> Result<Self, MeshError> {
        let count = count
            .parse()
            .map_err(|_| malformed(place, count, "a count of elements"))?;
        Ok(Self {
            name: name.into(),
            count,
            properties: Vec::new(),
            place,
        })
    }
}

impl Property {
    fn new(place: Place, words: &[&str]) -> Result<Self, MeshError> {
        let (counted_by, scalar, name) = match *words {
            ["list", count, scalar, name] => {
                let count = Scalar::named(place, count)?;
                if matches!(count, Scalar::F32 | Scalar::F64) {
                    return Err(malformed(place, name, "a list counted in whole numbers"));
                }
                (Some(count), scalar, name)
            }
            [scalar, name] => (None, scalar, name),
            _ => return Err(malformed(place, &words.join(" "), "a type and a name")),
        };
        Ok(Self {
            name: name.into(),
            scalar: Scalar::named(place, scalar)?,
            counted_by,
        })
    }
}

impl Scalar {
    fn named(place: Place, name: &str) -> Result<Self, MeshError> {
        Ok(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return Err(malformed(place, name, "a type such as float or int")),
        })
    }

    /// Bytes of one.
    pub(super) fn size(self) -> u64 {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}
