//! What may be wrong with a file, and where it says so.

use crate::{
    body::{MeshError, PartError},
    fabric::{InvalidCurve, InvalidFabric, fit::Unfit},
    lattice::OutlineError,
    motion::{BvhError, InvalidMotion, RetargetError},
    solver::Unsolvable,
};
use std::{fmt, path::PathBuf};

/// A file that is no scene, fabric or body, with the place that shows it.
///
/// Printed as `file:line:column: what is wrong`, then the line and a marker under the value.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The file.
    pub file: PathBuf,
    /// Where in it; absent where the file as a whole is at fault.
    pub place: Option<Box<Place>>,
    /// What is wrong.
    pub fault: Box<Fault>,
}

/// A place in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// From 1.
    pub line: usize,
    /// In characters, from 1.
    pub column: usize,
    /// How many characters it takes on its line, 1 or more.
    pub width: usize,
    /// The whole line.
    pub text: String,
}

/// What may be wrong. Keys are written from the file's top: `cloth.spacing_cm`, `hold[1].edge`
/// for the first hold.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// The system does not give it.
    #[error("cannot be read: {reason}")]
    Unreadable {
        /// The system's reason.
        reason: String,
    },
    /// A folder.
    #[error("is a folder; allowed: a file")]
    Folder,
    /// Longer than any such file.
    #[error("is longer than {limit} bytes")]
    TooLong {
        /// Bytes that are read.
        limit: u64,
    },
    /// Nothing, or nothing but blanks.
    #[error("is empty; allowed: a TOML file")]
    Empty,
    /// No text.
    #[error("is binary, not text: byte {offset} is not UTF-8")]
    Binary {
        /// Which byte, from 0.
        offset: usize,
    },
    /// No TOML.
    #[error("not valid TOML: {0}")]
    Syntax(String),
    /// A key that means nothing.
    #[error("unknown key {key:?}{}{}", in_table(table), nearest_key(nearest.as_deref(), known))]
    UnknownKey {
        /// The key.
        key: String,
        /// Its table; empty at the file's top.
        table: String,
        /// The known key that is most like it.
        nearest: Option<String>,
        /// All keys of that table.
        known: Vec<String>,
    },
    /// A key that must be there.
    #[error("missing key {key:?}{}", in_table(table))]
    MissingKey {
        /// The key, or keys to choose from.
        key: String,
        /// Its table; empty at the file's top.
        table: String,
    },
    /// Keys that exclude each other.
    #[error("{found} exclude each other{}; allowed: one of them", in_table(table))]
    TooManyKeys {
        /// The keys found.
        found: String,
        /// Their table.
        table: String,
    },
    /// A value of the wrong type, word or size.
    #[error("{key} is {value}; allowed: {allowed}")]
    NotAllowed {
        /// The key.
        key: String,
        /// As written.
        value: String,
        /// What may stand there.
        allowed: String,
    },
    /// A file that is not there.
    #[error("{key} is {value}: no such file; tried {tried}")]
    NoSuchFile {
        /// The key.
        key: String,
        /// As written.
        value: String,
        /// Where it was sought.
        tried: String,
    },
    /// An outline that bounds no cloth.
    #[error("{key}: {error}")]
    Outline {
        /// The key.
        key: String,
        /// What is wrong with it.
        error: OutlineError,
    },
    /// A measured curve that is none.
    #[error("{key}: {error}")]
    Curve {
        /// The key.
        key: String,
        /// What is wrong with it.
        error: InvalidCurve,
    },
    /// A mesh file that holds no mesh.
    #[error("{key}: {}: {error}", file.display())]
    Mesh {
        /// The key.
        key: String,
        /// The mesh file.
        file: PathBuf,
        /// What is wrong with it.
        error: Box<MeshError>,
    },
    /// A part that is no solid.
    #[error("{key}: {error}")]
    Part {
        /// The key.
        key: String,
        /// What is wrong with it.
        error: PartError,
    },
    /// Body files that name each other in a ring.
    #[error("{key} is {value}: body files nested more than {limit} deep")]
    Nested {
        /// The key.
        key: String,
        /// As written.
        value: String,
        /// How deep they may nest.
        limit: usize,
    },
    /// A point that a bone's end was not brought to.
    #[error(
        "{key} is {value}: {bone} ends {miss:.1} cm from it; allowed: a point within its reach"
    )]
    OutOfReach {
        /// The key.
        key: String,
        /// As written.
        value: String,
        /// The bone.
        bone: String,
        /// How far its end is from the point in the posture that comes nearest [cm].
        miss: f64,
    },
    /// Keys that are no motion.
    #[error("{key}: {error}")]
    Motion {
        /// The key.
        key: String,
        /// What is wrong with them.
        error: InvalidMotion,
    },
    /// A motion capture that is none.
    #[error("{0}")]
    Capture(BvhError),
    /// A motion capture that does not fit the skeleton.
    #[error("{0}")]
    Retarget(RetargetError),
    /// A motion capture whose joints have other names than those that are known.
    #[error(
        "no table of joint names fits joints {joints}, …; allowed: those of {known}, or a motion \
         file with capture = and names = \"mine.toml\""
    )]
    NoNames {
        /// Its first joints.
        joints: String,
        /// The tables that ship.
        known: String,
    },
    /// A record without readings.
    #[error("has no readings; allowed: a header that names the columns, then 4 lines or more")]
    NoReadings,
    /// A record that lacks a column.
    #[error(
        "no column {wanted}; the header has {found}{}",
        nearest.as_ref().map_or(String::new(), |name| format!("; did you mean {name:?}?"))
    )]
    MissingColumn {
        /// Columns to choose from.
        wanted: String,
        /// The columns found.
        found: String,
        /// The one most like a column found.
        nearest: Option<String>,
    },
    /// A line of a record with more or fewer values than the header has columns.
    #[error("{found} values under {header} columns{hint}")]
    Columns {
        /// Values on the line.
        found: usize,
        /// Columns of the header.
        header: usize,
        /// The likely cause.
        hint: &'static str,
    },
    /// A cloth measured along one thread direction.
    #[error(
        "the {present} alone is measured; allowed: warp and weft, cloth hangs by both{}",
        in_table(table)
    )]
    OneDirection {
        /// The direction that is there.
        present: &'static str,
        /// The table that lacks the other.
        table: String,
    },
    /// Readings that give no value.
    #[error("{key}: {error}")]
    Unfit {
        /// The key.
        key: String,
        /// What is wrong with them.
        error: Unfit,
    },
    /// A value that was found in readings, and that no cloth has.
    #[error("what was found is no cloth: {0}")]
    NoCloth(InvalidFabric),
    /// A scene from which no start can be made.
    #[error("{key}{}{error}", after_value(value))]
    Unsolvable {
        /// The key.
        key: String,
        /// As written; empty where it is absent.
        value: String,
        /// Why not.
        error: Unsolvable,
    },
}

impl std::error::Error for SceneError {}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let file = self.file.display();
        let Some(place) = &self.place else {
            return write!(f, "{file}: {}", self.fault);
        };
        let Place { line, column, .. } = place.as_ref();
        writeln!(f, "{file}:{line}:{column}: {}", self.fault)?;
        let (text, before) = place.window();
        let number = line.to_string();
        let margin = number.len();
        writeln!(f, "  {number} | {text}")?;
        let width = place
            .width
            .min(text.chars().count().saturating_sub(before))
            .max(1);
        write!(f, "  {:margin$} | {:before$}{}", "", "", "^".repeat(width))
    }
}

impl Place {
    /// The line, or the part of a long line about the place, and how many characters of it stand
    /// before the place. Tabs and other control characters become blanks, so that the marker
    /// stands below the value.
    fn window(&self) -> (String, usize) {
        const LONGEST: usize = 120;
        const BEFORE: usize = 40;
        let ahead = self.column.saturating_sub(1);
        let skip = if ahead + self.width > LONGEST {
            ahead.saturating_sub(BEFORE)
        } else {
            0
        };
        let blank = |c: char| if c.is_control() { ' ' } else { c };
        let shown = self.text.chars().skip(skip).take(LONGEST).map(blank);
        (
            shown.collect::<String>().trim_end().to_owned(),
            ahead - skip,
        )
    }
}

fn in_table(table: &str) -> String {
    match table {
        "" => String::new(),
        _ if table.contains('[') => format!(" in {table}"),
        _ => format!(" in [{table}]"),
    }
}

fn after_value(value: &str) -> String {
    if value.is_empty() {
        ": ".to_owned()
    } else {
        format!(" is {value}: ")
    }
}

fn nearest_key(nearest: Option<&str>, known: &[String]) -> String {
    match nearest {
        Some(nearest) => format!("; did you mean {nearest:?}?"),
        None => format!("; allowed: {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(column: usize, width: usize, text: &str) -> String {
        let place = Place {
            line: 7,
            column,
            width,
            text: text.into(),
        };
        SceneError {
            file: "scenes/x.toml".into(),
            place: Some(Box::new(place)),
            fault: Box::new(Fault::NotAllowed {
                key: "cloth.spacing_cm".into(),
                value: "-0.5".into(),
                allowed: "0.01 to 50 cm".into(),
            }),
        }
        .to_string()
    }

    #[test]
    fn the_marker_stands_below_the_value() {
        assert_eq!(
            at(14, 4, "spacing_cm = -0.5"),
            "scenes/x.toml:7:14: cloth.spacing_cm is -0.5; allowed: 0.01 to 50 cm\n  \
             7 | spacing_cm = -0.5\n    |              ^^^^"
        );
    }

    #[test]
    fn a_long_line_is_shown_about_the_place() {
        let text = format!("{}-0.5, {}", " ".repeat(5000), "1, ".repeat(5000));
        let message = at(5001, 4, &text);
        assert!(message.lines().all(|line| line.chars().count() < 130));
        let lines: Vec<&str> = message.lines().collect();
        assert_eq!(lines[1].find("-0.5"), lines[2].find("^^^^"));
    }

    #[test]
    fn a_tab_is_one_blank_wide() {
        let message = at(5, 4, "\t x\t-0.5");
        let lines: Vec<&str> = message.lines().collect();
        assert_eq!(lines[1].find("-0.5"), lines[2].find("^^^^"));
    }
}
