//! Looks things up in JSON whose shape nobody has checked.

use serde_json::Value;

use super::super::{MeshError, Place, source::malformed};

/// The members of a list; none where it is absent.
pub(super) fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of.get(key)
        .and_then(Value::as_array)
        .map(Vec::as_slice)
        .unwrap_or_default()
}

/// A member that must be there.
pub(super) fn item<'a>(
    document: &'a Value,
    key: &'static str,
    index: usize,
) -> Result<&'a Value, MeshError> {
    let items = list(document, key);
    items.get(index).ok_or_else(|| {
        let expected = format!("one of {} {key}", items.len());
        malformed(Place::File, &format!("{key}[{index}]"), &expected)
    })
}

/// A whole number from 0 on, if it is there.
pub(super) fn number(place: Place, of: &Value, key: &str) -> Result<Option<usize>, MeshError> {
    let Some(value) = of.get(key) else {
        return Ok(None);
    };
    match value
        .as_u64()
        .and_then(|number| usize::try_from(number).ok())
    {
        Some(number) => Ok(Some(number)),
        None => Err(wrong(place, key, value, "a whole number from 0 on")),
    }
}

/// `N` numbers, if they are there.
pub(super) fn numbers<const N: usize>(
    place: Place,
    of: &Value,
    key: &str,
) -> Result<Option<[f64; N]>, MeshError> {
    let Some(value) = of.get(key) else {
        return Ok(None);
    };
    let found: Vec<f64> = list(of, key).iter().filter_map(Value::as_f64).collect();
    match found.try_into() {
        Ok(numbers) => Ok(Some(numbers)),
        Err(_) => Err(wrong(place, key, value, &format!("{N} numbers"))),
    }
}

fn wrong(place: Place, key: &str, value: &Value, expected: &str) -> MeshError {
    malformed(place, &format!("{key}: {value}"), expected)
}
