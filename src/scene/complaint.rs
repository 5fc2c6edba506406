//! What toml and serde complain of, in our words.
//!
//! serde hands on only text, but in a fixed form: `unknown field`, `missing field`,
//! `unknown variant`, then names in backticks, or a type after `expected`.

use super::{
    document::{Document, Step, name_of},
    error::Fault,
};

/// The fault behind an error of a well-formed file.
pub(super) fn fault(error: &toml::de::Error, document: &Document) -> Fault {
    let (message, span) = (error.message(), error.span().unwrap_or(0..0));
    let mut steps = document.steps_to(&span);
    let names = in_backticks(message);
    if message.starts_with("unknown field") {
        steps.pop();
        return unknown_key(names, name_of(&steps));
    }
    if message.starts_with("missing field") {
        return Fault::MissingKey {
            key: names.into_iter().next().unwrap_or_default(),
            table: name_of(&steps),
        };
    }
    let (_, expected) = message.rsplit_once("expected ").unwrap_or(("", message));
    let allowed = if message.starts_with("unknown variant") {
        let words: Vec<String> = names
            .iter()
            .skip(1)
            .map(|word| format!("{word:?}"))
            .collect();
        words.join(", ")
    } else {
        in_words(expected, &steps)
    };
    Fault::NotAllowed {
        key: name_of(&steps),
        value: document.written(&span),
        allowed,
    }
}

fn unknown_key(names: Vec<String>, table: String) -> Fault {
    let mut names = names.into_iter();
    let key = names.next().unwrap_or_default();
    let known: Vec<String> = names.collect();
    let nearest = nearest(&key, known.iter().map(String::as_str));
    Fault::UnknownKey {
        key,
        table,
        nearest,
        known,
    }
}

/// The word most like another, where one is like it: `spacing` is like `spacing_cm`, a key of
/// another program is like none.
pub(super) fn nearest<'w>(word: &str, known: impl Iterator<Item = &'w str>) -> Option<String> {
    // Jaro–Winkler: "spacing" and "spacing_cm" have 0.94, "colour" and "contact" 0.70.
    const ALIKE: f64 = 0.8;
    known
        .map(|candidate| (strsim::jaro_winkler(word, candidate), candidate))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate.to_owned())
}

fn in_backticks(message: &str) -> Vec<String> {
    let odd = message.split('`').skip(1).step_by(2);
    odd.map(str::to_owned).collect()
}

/// serde's name of a type as a person would write it.
fn in_words(expected: &str, steps: &[Step]) -> String {
    match expected {
        "f64" => "a number".into(),
        "u64" | "u32" => "a whole number, 0 or more".into(),
        "a boolean" => "true or false".into(),
        "a string" | "path string" => "a text in quotes".into(),
        "a sequence" => match steps {
            [Step::Key(key)] => format!("tables, each headed [[{key}]]"),
            _ => "a list".into(),
        },
        other if other.starts_with("struct ") => "a table".into(),
        other if other.starts_with("enum ") || other.contains("enum") => "a text in quotes".into(),
        other => other.into(),
    }
}
