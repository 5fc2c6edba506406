//! Reads a person's measurements.

use super::{document::At, error::SceneError, format::Table, motion::document};
use crate::robot::{
    Girths, InvalidMeasurement, InvalidPerson, Lengths, Measurements, PEOPLE, Robot,
};
use serde::Deserialize;
use std::path::Path;

/// Reads a person's measurements, of whom a body can be built: a path to a `.toml`, or the name of
/// one of the [`PEOPLE`] that ship.
///
/// A file `bodies/NAME.toml` in the present folder comes before the person of that name that ships,
/// so that a copy can be edited.
///
/// # Errors
/// [`SceneError`] where the file is none, a measurement is outside its range, or they do not go
/// together.
///
/// ```
/// let woman = soen::scene::person("woman-158".as_ref())?;
/// assert_eq!(woman.stature, 158.0);
/// # Ok::<(), soen::scene::SceneError>(())
/// ```
pub fn person(path: &Path) -> Result<Measurements, SceneError> {
    let document = document(path, "bodies", &PEOPLE, "person")?;
    let person = document.content::<PersonFile>()?.measurements();
    match Robot::new(&person) {
        Ok(_) => Ok(person),
        Err(error) => Err(refusal(&document.top(), &error)),
    }
}

fn refusal(top: &At<'_>, error: &InvalidPerson) -> SceneError {
    match error {
        InvalidPerson::Measurement(error) => {
            place_of(top, &error.quantity).not_allowed(in_words(error))
        }
        InvalidPerson::Girth { girth, built, .. } => place_of(top, &format!("girths.{girth}"))
            .not_allowed(format!(
                "girths nearer to the others; this one came to {built:.1} cm"
            )),
        other => top.not_allowed(other.to_string()),
    }
}

/// The value of a field such as `girths.bust`, which a file has in centimetres.
fn place_of<'d>(top: &At<'d>, quantity: &str) -> At<'d> {
    match quantity.split_once('.') {
        Some((table, key)) => top.key(table).key(&format!("{key}_cm")),
        None => top.key(&format!("{quantity}_cm")),
    }
}

fn in_words(error: &InvalidMeasurement) -> String {
    let space = if error.because.is_empty() { "" } else { " " };
    format!("{} to {} cm{space}{}", error.low, error.high, error.because)
}

/// A person as a tailor measures one.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PersonFile {
    name: String,
    source: String,
    stature_cm: f64,
    sitting_height_cm: f64,
    shoulder_width_cm: f64,
    hip_width_cm: f64,
    #[serde(default = "yes")]
    head: bool,
    girths: Table<GirthTable>,
    #[serde(default)]
    lengths: Table<LengthTable>,
}

fn yes() -> bool {
    true
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct GirthTable {
    neck_cm: f64,
    bust_cm: f64,
    under_bust_cm: f64,
    waist_cm: f64,
    hip_cm: f64,
    thigh_cm: f64,
    knee_cm: f64,
    calf_cm: f64,
    ankle_cm: f64,
    upper_arm_cm: f64,
    elbow_cm: f64,
    wrist_cm: f64,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct LengthTable {
    head_cm: Option<f64>,
    neck_cm: Option<f64>,
    thorax_cm: Option<f64>,
    lumbar_cm: Option<f64>,
    pelvis_cm: Option<f64>,
    upper_arm_cm: Option<f64>,
    forearm_cm: Option<f64>,
    hand_cm: Option<f64>,
    thigh_cm: Option<f64>,
    shank_cm: Option<f64>,
    foot_cm: Option<f64>,
}

impl PersonFile {
    fn measurements(self) -> Measurements {
        let (girths, lengths) = (&self.girths, &self.lengths);
        Measurements {
            stature: self.stature_cm,
            sitting_height: self.sitting_height_cm,
            shoulder_width: self.shoulder_width_cm,
            hip_width: self.hip_width_cm,
            lengths: Lengths {
                head: lengths.head_cm,
                neck: lengths.neck_cm,
                thorax: lengths.thorax_cm,
                lumbar: lengths.lumbar_cm,
                pelvis: lengths.pelvis_cm,
                upper_arm: lengths.upper_arm_cm,
                forearm: lengths.forearm_cm,
                hand: lengths.hand_cm,
                thigh: lengths.thigh_cm,
                shank: lengths.shank_cm,
                foot: lengths.foot_cm,
            },
            girths: Girths {
                neck: girths.neck_cm,
                bust: girths.bust_cm,
                under_bust: girths.under_bust_cm,
                waist: girths.waist_cm,
                hip: girths.hip_cm,
                thigh: girths.thigh_cm,
                knee: girths.knee_cm,
                calf: girths.calf_cm,
                ankle: girths.ankle_cm,
                upper_arm: girths.upper_arm_cm,
                elbow: girths.elbow_cm,
                wrist: girths.wrist_cm,
            },
            head: self.head,
            name: self.name,
            source: self.source,
        }
    }
}
