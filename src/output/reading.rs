//! What an instrument of the laboratory shows, as JSON and as a plot.

use super::{Mark, Plot, Series};
use crate::lab::{Reading, Trace};
use serde::{Serialize, Serializer, ser::SerializeMap};

/// A reading as JSON text (`soen-lab/1`): one flat object; `words` say what was asked for beside
/// numbers, as the fabric and the direction.
///
/// A number that is not finite is written as `null`.
#[must_use]
pub fn reading(reading: &Reading, words: &[(&str, String)]) -> String {
    // Text and numbers cannot fail to become JSON.
    serde_json::to_string_pretty(&Flat { reading, words }).unwrap_or_default() + "\n"
}

/// The curve of an instrument.
#[must_use]
pub fn curve(title: String, trace: &Trace) -> Plot {
    let lines = trace.lines.iter().map(|(name, points)| Series {
        name: (*name).into(),
        mark: Mark::Line,
        points: points.clone(),
    });
    Plot {
        title,
        x_label: trace.x.into(),
        y_label: trace.y.into(),
        series: lines.collect(),
    }
}

struct Flat<'a> {
    reading: &'a Reading,
    words: &'a [(&'a str, String)],
}

impl Serialize for Flat<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("format", "soen-lab/1")?;
        map.serialize_entry("instrument", self.reading.instrument)?;
        for (key, word) in self.words {
            map.serialize_entry(key, word)?;
        }
        for figure in &self.reading.figures {
            map.serialize_entry(figure.key, &figure.value)?;
        }
        if !self.reading.histogram.is_empty() {
            map.serialize_entry("histogram", &self.reading.histogram)?;
        }
        map.serialize_entry("converged", &self.reading.certified)?;
        if let Some(trace) = &self.reading.trace {
            map.serialize_entry("curve", &Curves(trace))?;
        }
        map.end()
    }
}

struct Curves<'a>(&'a Trace);

impl Serialize for Curves<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("x", self.0.x)?;
        map.serialize_entry("y", self.0.y)?;
        map.serialize_entry("lines", &self.0.lines)?;
        map.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Figure;

    #[test]
    fn a_reading_is_one_flat_object_in_order() {
        let shown = Reading {
            instrument: "cantilever",
            histogram: vec![[7, 4], [8, 6]],
            figures: vec![
                Figure {
                    key: "tip_drop_cm",
                    value: 3.5,
                },
                Figure {
                    key: "nothing",
                    value: f64::NAN,
                },
            ],
            trace: Some(Trace {
                x: "x [cm]",
                y: "y [cm]",
                lines: vec![("strip", vec![[0.0, 0.0], [1.0, -0.5]])],
            }),
            rest: None,
            certified: true,
        };
        let text = reading(&shown, &[("fabric", "c".into())]);
        let keys = [
            "format",
            "instrument",
            "fabric",
            "tip_drop_cm",
            "converged",
            "curve",
        ];
        let places: Vec<_> = keys
            .iter()
            .map(|key| text.find(&format!("\"{key}\"")))
            .collect();
        assert!(places.is_sorted() && places[0].is_some(), "{text}");
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["tip_drop_cm"], 3.5);
        assert_eq!(value["histogram"][1][1], 6);
        assert!(value["nothing"].is_null());
        assert_eq!(value["curve"]["lines"][0][1][1][1], -0.5);
    }
}
