//! Two columns of a CSV file: what a machine wrote down.
//!
//! The header names each column with its unit; columns with other names are passed over, and so are
//! blank lines and those that begin with `#`. Columns are parted by commas, semicolons or tabs,
//! whichever the header has; decimals by points.

use crate::scene::{
    complaint::nearest,
    document::Document,
    error::{Fault, SceneError},
};
use std::{ops::Range, path::Path};

/// A record, read and converted.
#[derive(Debug)]
pub(super) struct Record {
    document: Document,
    /// Names of its two columns.
    columns: [&'static str; 2],
    rows: Vec<Row>,
}

#[derive(Debug)]
struct Row {
    values: [f64; 2],
    /// Where they are in the text.
    spans: [Range<usize>; 2],
}

/// A line of the text that is neither blank nor a remark.
struct Line<'t> {
    start: usize,
    text: &'t str,
}

impl Record {
    /// Reads one column out of each of two choices.
    pub(super) fn open(path: &Path, choices: [&[&'static str]; 2]) -> Result<Self, SceneError> {
        let document = Document::open(path).map_err(|mut error| {
            if matches!(*error.fault, Fault::Empty) {
                *error.fault = Fault::NoReadings;
            }
            error
        })?;
        let mut lines = lines(&document.text);
        let none = || document.error_at(None, Fault::NoReadings);
        let header = lines.next().ok_or_else(none)?;
        let layout = Layout::of(&header, choices)
            .map_err(|fault| document.error_at(Some(header.span()), *fault))?;
        let rows: Vec<Row> = lines
            .map(|line| line.row(&document, &layout))
            .collect::<Result<_, _>>()?;
        if rows.is_empty() {
            return Err(none());
        }
        Ok(Self {
            columns: layout.columns,
            document,
            rows,
        })
    }

    pub(super) fn columns(&self) -> [&'static str; 2] {
        self.columns
    }

    pub(super) fn values(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.rows.iter().map(|row| row.values)
    }

    /// A fault at a row's value in one of the two columns.
    pub(super) fn not_allowed(&self, row: usize, which: usize, allowed: String) -> SceneError {
        let span = self.rows.get(row).map(|row| row.spans[which].clone());
        let value = span
            .clone()
            .map_or(String::new(), |span| self.document.written(&span));
        let fault = Fault::NotAllowed {
            key: format!("column {}", self.columns[which]),
            value,
            allowed,
        };
        self.document.error_at(span, fault)
    }
}

/// What the header says.
struct Layout {
    parted_by: u8,
    /// Columns in all.
    width: usize,
    /// The two that are read, and where they are.
    columns: [&'static str; 2],
    places: [usize; 2],
}

impl Layout {
    fn of(header: &Line<'_>, choices: [&[&'static str]; 2]) -> Result<Self, Box<Fault>> {
        let mut marks = [b';', b'\t'].into_iter();
        let mark = marks.find(|&mark| header.text.contains(char::from(mark)));
        let parted_by = mark.unwrap_or(b',');
        let names = fields(header.text, parted_by);
        let [first, second] = choices.map(|choice| column(&names, choice));
        let ((x, at_x), (y, at_y)) = (first?, second?);
        Ok(Self {
            parted_by,
            width: names.len(),
            columns: [x, y],
            places: [at_x, at_y],
        })
    }
}

impl Line<'_> {
    fn span(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    fn row(&self, document: &Document, layout: &Layout) -> Result<Row, SceneError> {
        let fields = fields(self.text, layout.parted_by);
        if fields.len() != layout.width {
            let commas = fields.len() > layout.width && layout.parted_by == b',';
            let fault = Fault::Columns {
                found: fields.len(),
                header: layout.width,
                hint: if commas {
                    " (decimal commas? write decimal points)"
                } else {
                    ""
                },
            };
            return Err(document.error_at(Some(self.span()), fault));
        }
        let spans = layout
            .places
            .map(|place| self.field_span(layout.parted_by, place));
        let mut values = [0.0; 2];
        for which in 0..2 {
            let written = &fields[layout.places[which]];
            values[which] = number(written).map_err(|allowed| {
                let fault = Fault::NotAllowed {
                    key: format!("column {}", layout.columns[which]),
                    value: format!("{written:?}"),
                    allowed: allowed.into(),
                };
                document.error_at(Some(spans[which].clone()), fault)
            })?;
        }
        Ok(Row { values, spans })
    }

    /// Where a field stands; the whole line where quotes hide it.
    fn field_span(&self, parted_by: u8, place: usize) -> Range<usize> {
        if self.text.contains('"') {
            return self.span();
        }
        let mut start = self.start;
        for (number, field) in self.text.split(char::from(parted_by)).enumerate() {
            if number == place {
                let blank = field.len() - field.trim_start().len();
                return start + blank..start + blank + field.trim().len();
            }
            start += field.len() + 1;
        }
        self.span()
    }
}

fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let mut start = 0;
    text.split_inclusive('\n').filter_map(move |whole| {
        let from = start;
        start += whole.len();
        let mark = if from == 0 && whole.starts_with('\u{feff}') {
            3
        } else {
            0
        };
        let text = whole[mark..].trim_end();
        let says = !text.is_empty() && !text.starts_with('#');
        says.then_some(Line {
            start: from + mark,
            text,
        })
    })
}

/// The fields of one line; none where it is no CSV, as with a quote that does not end.
fn fields(line: &str, parted_by: u8) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .delimiter(parted_by)
        .trim(csv::Trim::All)
        .from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    record.map_or(Vec::new(), |record| {
        record.iter().map(str::to_owned).collect()
    })
}

/// The one column of a choice that the header has.
fn column(names: &[String], choice: &[&'static str]) -> Result<(&'static str, usize), Box<Fault>> {
    let found: Vec<(&'static str, usize)> = choice
        .iter()
        .filter_map(|name| Some((*name, names.iter().position(|known| known == name)?)))
        .collect();
    match found[..] {
        [one] => Ok(one),
        [] => Err(Box::new(Fault::MissingColumn {
            wanted: choice.join(", "),
            found: names.join(", "),
            nearest: names
                .iter()
                .find_map(|name| nearest(name, choice.iter().copied())),
        })),
        _ => Err(Box::new(Fault::TooManyKeys {
            found: found.iter().map(|one| one.0).collect::<Vec<_>>().join(", "),
            table: String::new(),
        })),
    }
}

fn number(written: &str) -> Result<f64, &'static str> {
    match written.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err("a finite number"),
        Err(_) if written.replacen(',', ".", 1).parse::<f64>().is_ok() => {
            Err("a number with a decimal point (this looks like a decimal comma)")
        }
        Err(_) => Err("a number"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(text: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.csv");
        std::fs::write(&path, text).unwrap();
        match Record::open(
            &path,
            [&["strain", "strain_percent"], &["tension_gf_per_cm"]],
        ) {
            Ok(record) => format!("{:?}", record.values().collect::<Vec<_>>()),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn remarks_blank_lines_marks_and_other_columns_are_passed_over() {
        let read = "[[0.01, 2.0], [0.02, 5.5]]";
        assert_eq!(
            said(
                "\u{feff}# by hand\ntime_s, strain, tension_gf_per_cm\r\n\r\n0, 0.01, 2\r\n1, 0.02, 5.5\r\n"
            ),
            read
        );
        assert_eq!(said("tension_gf_per_cm;strain\n2;0.01\n5.5;0.02"), read);
        assert_eq!(
            said("strain\ttension_gf_per_cm\n0.01\t2\n0.02\t5.5\n"),
            read
        );
        assert_eq!(
            said("strain,tension_gf_per_cm\n\"0.01\",\"2\"\n0.02,5.5\n"),
            read
        );
    }

    #[test]
    fn a_fault_is_shown_where_it_stands() {
        let message = said("strain,tension_gf_per_cm\n0.01, 2\n0.02, x5\n");
        assert!(
            message.ends_with(
                "x.csv:3:7: column tension_gf_per_cm is \"x5\"; allowed: a number\n  \
                 3 | 0.02, x5\n    |       ^^"
            ),
            "{message}"
        );
    }
}
