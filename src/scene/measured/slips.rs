//! Numbers in the wrong unit: refused, with the unit that they look like.

use crate::scene::{
    document::{Allowed, At},
    error::SceneError,
};
use std::ops::RangeInclusive;

/// A key for a quantity that may be given in several units.
pub(super) struct Unit {
    key: &'static str,
    /// What 1 of it is, in our unit.
    factor: f64,
    unit: &'static str,
}

impl Unit {
    pub(super) fn new(key: &'static str, factor: f64, unit: &'static str) -> Self {
        Self { key, factor, unit }
    }
}

/// The value of the one key that is given, in our unit, when it is in the range there.
pub(super) fn one_of(
    at: &At<'_>,
    units: &[(Unit, Option<f64>)],
    range: RangeInclusive<f64>,
) -> Result<f64, SceneError> {
    let given: Vec<_> = units
        .iter()
        .map(|(unit, value)| (unit.key, value.is_some()))
        .collect();
    let key = at.exactly_one(&given)?;
    let mut value = 0.0;
    let mut slips = Vec::new();
    let mut own = (1.0, "");
    for (unit, given) in units {
        if unit.key == key {
            value = given.unwrap_or(0.0);
            own = (unit.factor, unit.unit);
        } else {
            slips.push((unit.factor, unit.unit));
        }
    }
    let (factor, name) = own;
    let slips: Vec<_> = slips
        .iter()
        .map(|(other, unit)| (other / factor, *unit))
        .collect();
    let range = digits(range.start() / factor)..=digits(range.end() / factor);
    Ok(factor * sized(&at.key(key), value, range, name, &slips)?)
}

/// A division's result without the rounding of its last digits, as it is shown.
pub(super) fn digits(value: f64) -> f64 {
    format!("{value:.6e}").parse().unwrap_or(value)
}

/// The number, when it is in the range. Otherwise an error that names each unit in which it would
/// be: a factor to ours, and its name.
pub(super) fn sized(
    at: &At<'_>,
    value: f64,
    range: RangeInclusive<f64>,
    unit: &'static str,
    slips: &[(f64, &'static str)],
) -> Result<f64, SceneError> {
    if range.contains(&value) {
        return Ok(value);
    }
    let allowed = Allowed { range, unit };
    Err(at.not_allowed(format!(
        "{allowed}{}",
        looks_like(value, &allowed.range, slips)
    )))
}

/// " (looks like …)", where a value would be inside the range in another unit.
pub(super) fn looks_like(
    value: f64,
    range: &RangeInclusive<f64>,
    slips: &[(f64, &'static str)],
) -> String {
    let fitting: Vec<&str> = slips
        .iter()
        .filter(|(factor, _)| range.contains(&(value * factor)))
        .map(|(_, unit)| *unit)
        .collect();
    if fitting.is_empty() {
        String::new()
    } else {
        format!(" (looks like {})", fitting.join(" or "))
    }
}
