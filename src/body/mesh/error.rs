use std::fmt;

/// What may be wrong with a mesh or its file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// Nothing in the file.
    #[error("the file is empty")]
    Empty,
    /// No faces.
    #[error("the mesh has no faces; at least one triangle with an area is needed")]
    NoFaces,
    /// Only faces without area.
    #[error("none of the {count} faces has an area")]
    Flat {
        /// Faces read.
        count: usize,
    },
    /// A face names a vertex that is not there.
    #[error("{place}: vertex {index} is named, but there are {count} vertices, {first} to {last}",
        first = from, last = *from + *count as i64 - 1)]
    Index {
        /// Where.
        place: Place,
        /// The number given.
        index: i64,
        /// How many vertices there are.
        count: usize,
        /// The number of the first one.
        from: i64,
    },
    /// A coordinate is NaN or infinite.
    #[error("{place}: coordinate {value} is not finite")]
    NotFinite {
        /// Where.
        place: Place,
        /// The coordinate.
        value: f64,
    },
    /// A coordinate is beyond 10 km.
    #[error(
        "{place}: coordinate {cm:e} cm is beyond {limit:e} cm; is the unit right?",
        limit = super::FARTHEST
    )]
    TooFar {
        /// Where.
        place: Place,
        /// The coordinate [cm].
        cm: f64,
    },
    /// The bytes end early.
    #[error("the file is cut off: {place} needs {needed} bytes, {left} are left")]
    CutOff {
        /// Where.
        place: Place,
        /// Bytes that must follow.
        needed: u64,
        /// Bytes that do follow.
        left: u64,
    },
    /// A text ends early.
    #[error("the file is cut off: it ends in line {line}, before {missing}")]
    Unfinished {
        /// The last line, from 1.
        line: usize,
        /// What must still come.
        missing: String,
    },
    /// Something else stands where a number, word or record must.
    #[error("{place}: found {found:?} where {expected} must stand")]
    Malformed {
        /// Where.
        place: Place,
        /// What stands there, shortened.
        found: String,
        /// What must stand there.
        expected: String,
    },
    /// Allowed by the format, but not read here.
    #[error("{what} is not read; {instead}")]
    Unsupported {
        /// What the file uses.
        what: String,
        /// What to do about it.
        instead: &'static str,
    },
    /// More faces or vertices than are taken.
    #[error("the mesh has {count} faces or corners, more than the {limit} that are taken")]
    TooMany {
        /// How many.
        count: u64,
        /// How many are taken.
        limit: usize,
    },
    /// The file's unit has no length.
    #[error("the unit is {cm} cm long; it must be finite and greater than 0")]
    Unit {
        /// Its length [cm].
        cm: f64,
    },
}

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// A line, from 1.
    Line(usize),
    /// A byte, from 0.
    Byte(usize),
    /// A face, from 1.
    Face(usize),
    /// A vertex, from 1.
    Vertex(usize),
    /// A member of a list of a glTF file, from 0.
    Item {
        /// The list.
        list: &'static str,
        /// Which member.
        index: usize,
    },
    /// The file as a whole.
    File,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
            Self::Face(face) => write!(f, "face {face}"),
            Self::Vertex(vertex) => write!(f, "vertex {vertex}"),
            Self::Item { list, index } => write!(f, "{list}[{index}]"),
            Self::File => write!(f, "the file"),
        }
    }
}
