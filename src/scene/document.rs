//! A TOML file's text, and the place of each of its values.

use super::{
    complaint,
    error::{Fault, Place, SceneError},
};
use serde::de::DeserializeOwned;
use std::{
    fs::File,
    io::{self, Read},
    ops::{Range, RangeInclusive},
    path::{Path, PathBuf},
};
use toml::de::{DeTable, DeValue};

/// A scene of a hundred thousand outline points has a fifth of it.
const LONGEST_TEXT: u64 = 16 << 20;
/// The greatest mesh of 5 million faces has a half of it.
const LONGEST_MESH: u64 = 1 << 30;

/// A file that was read as text.
#[derive(Clone, Debug)]
pub(super) struct Document {
    pub(super) path: PathBuf,
    pub(super) text: String,
}

/// A key of a table or an item of a list.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Step {
    Key(String),
    /// From 0.
    Item(usize),
}

/// A value of a document, by the steps that lead to it.
#[derive(Clone, Debug)]
pub(super) struct At<'d> {
    pub(super) document: &'d Document,
    steps: Vec<Step>,
}

/// Numbers that may stand somewhere, ends included.
#[derive(Clone, Debug)]
pub(super) struct Allowed {
    pub(super) range: RangeInclusive<f64>,
    pub(super) unit: &'static str,
}

impl Document {
    pub(super) fn open(path: &Path) -> Result<Self, SceneError> {
        let whole = |fault| SceneError {
            file: path.into(),
            place: None,
            fault: Box::new(fault),
        };
        let bytes = bytes_of(path, LONGEST_TEXT).map_err(whole)?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let offset = error.utf8_error().valid_up_to();
            whole(Fault::Binary { offset })
        })?;
        Self::new(path.into(), text)
    }

    pub(super) fn new(path: PathBuf, text: String) -> Result<Self, SceneError> {
        let fault = if let Some(offset) = text.find('\0') {
            Fault::Binary { offset }
        } else if text.trim().is_empty() {
            Fault::Empty
        } else {
            return Ok(Self { path, text });
        };
        Err(SceneError {
            file: path,
            place: None,
            fault: Box::new(fault),
        })
    }

    /// The file's content in its own types.
    pub(super) fn content<T: DeserializeOwned>(&self) -> Result<T, SceneError> {
        let syntax = |error: toml::de::Error| {
            let fault = Fault::Syntax(error.message().to_owned());
            self.error_at(error.span(), fault)
        };
        DeTable::parse(&self.text).map_err(syntax)?;
        toml::from_str(&self.text).map_err(|error| {
            let fault = complaint::fault(&error, self);
            self.error_at(error.span(), fault)
        })
    }

    pub(super) fn top(&self) -> At<'_> {
        At {
            document: self,
            steps: Vec::new(),
        }
    }

    /// The folder it is in; empty for the one the program runs in.
    pub(super) fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// What is written at a span, on one line and not too long.
    pub(super) fn written(&self, span: &Range<usize>) -> String {
        const LONGEST: usize = 60;
        let text = self.text.get(span.clone()).unwrap_or_default();
        let words: Vec<&str> = text.split_whitespace().collect();
        let line = words.join(" ");
        if line.chars().count() <= LONGEST {
            line
        } else {
            line.chars().take(LONGEST).chain(['…']).collect()
        }
    }

    /// The steps to the key or value that stands at a span; none for the file as a whole.
    pub(super) fn steps_to(&self, span: &Range<usize>) -> Vec<Step> {
        let mut steps = Vec::new();
        if let Ok(table) = DeTable::parse(&self.text) {
            find_in_table(table.get_ref(), span, &mut steps);
        }
        steps
    }

    fn span_of(&self, steps: &[Step]) -> Option<Range<usize>> {
        self.spans_of(steps).map(|[_, value]| value)
    }

    /// Where the last step's key stands, an item standing for its own, and its value; those of the
    /// nearest table around it where it is absent.
    fn spans_of(&self, steps: &[Step]) -> Option<[Range<usize>; 2]> {
        let table = DeTable::parse(&self.text).ok()?;
        let (mut spans, mut value) = (None, &DeValue::Table(table.into_inner()));
        for step in steps {
            let found = match (value, step) {
                (DeValue::Table(table), Step::Key(key)) => table
                    .get_key_value(key.as_str())
                    .map(|(key, value)| (key.span(), value)),
                (DeValue::Array(list), Step::Item(item)) => {
                    list.get(*item).map(|value| (value.span(), value))
                }
                _ => None,
            };
            let Some((key, found)) = found else { break };
            (spans, value) = (Some([key, found.span()]), found.get_ref());
        }
        spans
    }

    pub(super) fn error_at(&self, span: Option<Range<usize>>, fault: Fault) -> SceneError {
        SceneError {
            file: self.path.clone(),
            place: span.and_then(|span| self.place(span)).map(Box::new),
            fault: Box::new(fault),
        }
    }

    fn place(&self, span: Range<usize>) -> Option<Place> {
        let before = self.text.get(..span.start)?;
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let text = self.text.get(start..)?.lines().next().unwrap_or("");
        let column = self.text.get(start..span.start)?.chars().count();
        let on_line = self.text.get(span)?.lines().next().unwrap_or("");
        Some(Place {
            line: before.matches('\n').count() + 1,
            column: column + 1,
            width: on_line.chars().count().max(1),
            text: text.to_owned(),
        })
    }
}

impl<'d> At<'d> {
    pub(super) fn key(&self, key: &str) -> Self {
        self.then(Step::Key(key.into()))
    }

    pub(super) fn item(&self, item: usize) -> Self {
        self.then(Step::Item(item))
    }

    fn then(&self, step: Step) -> Self {
        let mut next = self.clone();
        next.steps.push(step);
        next
    }

    /// The key from the file's top; items are counted from 1.
    pub(super) fn name(&self) -> String {
        name_of(&self.steps)
    }

    /// The value as it is written; empty where it is absent.
    pub(super) fn written(&self) -> String {
        let span = self.document.span_of(&self.steps);
        span.map_or(String::new(), |span| self.document.written(&span))
    }

    /// An error here or, where nothing is written here, at the nearest table around it.
    pub(super) fn error(&self, fault: Fault) -> SceneError {
        self.document
            .error_at(self.document.span_of(&self.steps), fault)
    }

    /// An error at this key, not at its value.
    pub(super) fn key_error(&self, fault: Fault) -> SceneError {
        let spans = self.document.spans_of(&self.steps);
        self.document.error_at(spans.map(|[key, _]| key), fault)
    }

    pub(super) fn not_allowed(&self, allowed: impl Into<String>) -> SceneError {
        self.error(Fault::NotAllowed {
            key: self.name(),
            value: self.written(),
            allowed: allowed.into(),
        })
    }

    /// The file that a path here names.
    pub(super) fn file(&self, named: &Path) -> Result<PathBuf, SceneError> {
        beside(self.document.folder(), named).map_err(|tried| {
            self.error(Fault::NoSuchFile {
                key: self.name(),
                value: self.written(),
                tried,
            })
        })
    }

    /// The number, when it is allowed.
    pub(super) fn number(&self, value: f64, allowed: &Allowed) -> Result<f64, SceneError> {
        if allowed.range.contains(&value) {
            Ok(value)
        } else {
            Err(self.not_allowed(allowed.to_string()))
        }
    }

    /// The numbers, when each is allowed.
    pub(super) fn numbers<const N: usize>(
        &self,
        values: [f64; N],
        allowed: &Allowed,
    ) -> Result<[f64; N], SceneError> {
        for (item, value) in values.into_iter().enumerate() {
            self.item(item).number(value, allowed)?;
        }
        Ok(values)
    }

    /// The one key that is present among keys that exclude each other.
    pub(super) fn exactly_one(
        &self,
        keys: &[(&'static str, bool)],
    ) -> Result<&'static str, SceneError> {
        let found: Vec<&str> = keys.iter().filter(|key| key.1).map(|key| key.0).collect();
        match found.as_slice() {
            [] => {
                let all: Vec<&str> = keys.iter().map(|key| key.0).collect();
                let all = all.join(", ");
                Err(self.error(Fault::MissingKey {
                    key: format!("one of {all}"),
                    table: self.name(),
                }))
            }
            [_] => Ok(keys.iter().find(|key| key.1).map_or("", |key| key.0)),
            [.., last] => Err(self.key(last).error(Fault::TooManyKeys {
                found: found.join(", "),
                table: self.name(),
            })),
        }
    }
}

impl Allowed {
    pub(super) const fn new(low: f64, high: f64, unit: &'static str) -> Self {
        Self {
            range: low..=high,
            unit,
        }
    }
}

impl std::fmt::Display for Allowed {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (low, high) = (self.range.start(), self.range.end());
        let space = if self.unit.is_empty() { "" } else { " " };
        write!(f, "{low} to {high}{space}{}", self.unit)
    }
}

/// The file that a path names: in a folder or, failing that, from the folder the program runs in.
/// Otherwise where it was sought, in words.
pub(super) fn beside(folder: &Path, named: &Path) -> Result<PathBuf, String> {
    let mut tried = vec![folder.join(named), named.to_owned()];
    if let Some(found) = tried.iter().find(|path| path.exists() && !path.is_dir()) {
        return Ok(found.clone());
    }
    tried.dedup();
    let in_words = |path: PathBuf| {
        let kind = if path.is_dir() { " (a folder)" } else { "" };
        format!("{}{kind}", path.display())
    };
    let tried: Vec<String> = tried.into_iter().map(in_words).collect();
    Err(tried.join(", "))
}

/// A mesh file's bytes.
pub(super) fn mesh_bytes(path: &Path) -> Result<Vec<u8>, Fault> {
    bytes_of(path, LONGEST_MESH)
}

fn bytes_of(path: &Path, limit: u64) -> Result<Vec<u8>, Fault> {
    let read = || -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        File::open(path)?.take(limit + 1).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    if path.is_dir() {
        return Err(Fault::Folder);
    }
    match read() {
        Ok(bytes) if bytes.len() as u64 > limit => Err(Fault::TooLong { limit }),
        Ok(bytes) => Ok(bytes),
        Err(error) => Err(Fault::Unreadable {
            reason: error.to_string(),
        }),
    }
}

/// Steps as a key from the file's top, such as `cloth.size_cm[1]`.
pub(super) fn name_of(steps: &[Step]) -> String {
    let mut name = String::new();
    for step in steps {
        match step {
            Step::Key(key) if name.is_empty() => name.push_str(key),
            Step::Key(key) => name.extend([".", key.as_str()]),
            Step::Item(item) => name.push_str(&format!("[{}]", item + 1)),
        }
    }
    name
}

fn find_in_table(table: &DeTable<'_>, span: &Range<usize>, steps: &mut Vec<Step>) -> bool {
    table.iter().any(|(key, value)| {
        steps.push(Step::Key(key.get_ref().to_string()));
        let found = key.span() == *span
            || value.span() == *span
            || find_in_value(value.get_ref(), span, steps);
        if !found {
            steps.pop();
        }
        found
    })
}

fn find_in_value(value: &DeValue<'_>, span: &Range<usize>, steps: &mut Vec<Step>) -> bool {
    match value {
        DeValue::Table(table) => find_in_table(table, span, steps),
        DeValue::Array(list) => list.iter().enumerate().any(|(item, value)| {
            steps.push(Step::Item(item));
            let found = value.span() == *span || find_in_value(value.get_ref(), span, steps);
            if !found {
                steps.pop();
            }
            found
        }),
        _ => false,
    }
}
