//! The report of an animation: the proof of each of its frames.

use super::Shot;
use crate::certificate::Equilibrium;
use serde::Serialize;

/// The report as JSON text (`soen-animation/1`), a proof for each frame, by its number and time [s]: which
/// equilibrium it is in, and where that is a dynamic one how fast it goes.
/// Numbers that are not finite are `null`.
#[must_use]
pub fn film_report(
    title: &str,
    fabric: &str,
    wanted: usize,
    takes: &[(usize, f64, &Shot)],
) -> String {
    let certified = takes.iter().filter(|(.., shot)| shot.converged);
    let report = Report {
        format: "soen-animation/1",
        title,
        fabric,
        nodes: takes.first().map_or(0, |(.., shot)| shot.positions.len()),
        frames_wanted: wanted,
        frames_made: takes.len(),
        frames_certified: certified.count(),
        deepest_cm: takes
            .iter()
            .map(|(.., shot)| shot.deepest)
            .fold(0.0, f64::max),
        frames: takes.iter().map(Take::of).collect(),
    };
    // Structs of text and numbers cannot fail to become JSON.
    serde_json::to_string_pretty(&report).unwrap_or_default() + "\n"
}

#[derive(Serialize)]
struct Report<'a> {
    format: &'static str,
    title: &'a str,
    fabric: &'a str,
    nodes: usize,
    frames_wanted: usize,
    frames_made: usize,
    frames_certified: usize,
    deepest_cm: f64,
    frames: Vec<Take>,
}

#[derive(Serialize)]
struct Take {
    frame: usize,
    time_s: f64,
    converged: bool,
    equilibrium: &'static str,
    residual_max: f64,
    remaining_move_cm: f64,
    deepest_cm: f64,
    lowest_cm: f64,
    highest_cm: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    fastest_cm_per_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kinetic_energy_gf_cm: Option<f64>,
}

impl Take {
    fn of((frame, time, shot): &(usize, f64, &Shot)) -> Self {
        let (equilibrium, motion) = match shot.equilibrium {
            Equilibrium::Static => ("static", None),
            Equilibrium::Dynamic {
                fastest,
                kinetic_energy,
            } => ("dynamic", Some((fastest, kinetic_energy))),
        };
        Self {
            frame: *frame,
            time_s: *time,
            converged: shot.converged,
            equilibrium,
            residual_max: shot.residual_max,
            remaining_move_cm: shot.remaining_move,
            deepest_cm: shot.deepest,
            lowest_cm: shot.heights[0],
            highest_cm: shot.heights[1],
            fastest_cm_per_s: motion.map(|(fastest, _)| fastest),
            kinetic_energy_gf_cm: motion.map(|(_, energy)| energy),
        }
    }
}
