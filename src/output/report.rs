//! `report.json`: the certificate and the figures of a drape (design §7).

use crate::{certificate::Equilibrium, math::Vec3, solver::Settled};
use serde::Serialize;

/// What a report says beside the drape itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run<'a> {
    /// The scene's title.
    pub title: &'a str,
    /// The fabric, as the scene names it.
    pub fabric: &'a str,
    /// Wall time [s].
    pub seconds: f64,
    /// Threads that swept.
    pub threads: usize,
}

/// The report as JSON text (`soen-report/1`), keys in the order of the format.
///
/// A number that is not finite is written as `null`, and so is `self_crossings`, which nothing
/// computes yet.
pub fn report(settled: &Settled, run: &Run<'_>) -> String {
    let report = Report::new(settled, run);
    // Structs of text and numbers cannot fail to become JSON.
    serde_json::to_string_pretty(&report).unwrap_or_default() + "\n"
}

#[derive(Serialize)]
struct Report<'a> {
    format: &'static str,
    title: &'a str,
    fabric: &'a str,
    nodes: usize,
    converged: bool,
    certificate: Proof,
    shape: Shape,
    work: Work,
}

#[derive(Serialize)]
struct Proof {
    residual_max: f64,
    residual_rms: f64,
    worst_node_cm: [f64; 3],
    remaining_move_cm: f64,
    touching: usize,
    pulled: usize,
    outside_cone: usize,
    deepest_cm: f64,
    self_crossings: Option<usize>,
    /// Of a cloth in motion; of one at rest nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    equilibrium: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fastest_cm_per_s: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kinetic_energy_gf_cm: Option<f64>,
}

#[derive(Serialize)]
struct Shape {
    lowest_cm: f64,
    highest_cm: f64,
    mean_height_cm: f64,
    energy_gf_cm: f64,
    strain_warp_max: f64,
    strain_weft_max: f64,
    shear_deg_max: f64,
}

#[derive(Serialize)]
struct Work {
    levels: Vec<Level>,
    node_updates: u64,
    seconds: f64,
    threads: usize,
}

#[derive(Serialize)]
struct Level {
    spacing_cm: f64,
    nodes: usize,
    sweeps: usize,
    joint_steps: usize,
}

impl<'a> Report<'a> {
    fn new(settled: &Settled, run: &Run<'a>) -> Self {
        Self {
            format: "soen-report/1",
            title: run.title,
            fabric: run.fabric,
            nodes: settled.positions.len(),
            converged: settled.converged,
            certificate: Proof::new(settled),
            shape: Shape::new(settled),
            work: Work::new(settled, run),
        }
    }
}

impl Proof {
    fn new(settled: &Settled) -> Self {
        let proof = &settled.certificate;
        let motion = match proof.equilibrium {
            Equilibrium::Static => None,
            Equilibrium::Dynamic {
                fastest,
                kinetic_energy,
            } => Some((fastest, kinetic_energy)),
        };
        Self {
            residual_max: proof.residual_max,
            residual_rms: proof.residual_rms,
            worst_node_cm: Vec3::into(proof.worst_node),
            remaining_move_cm: proof.remaining_move,
            touching: proof.touching,
            pulled: proof.pulled,
            outside_cone: proof.outside_cone,
            deepest_cm: proof.deepest,
            self_crossings: None,
            equilibrium: motion.map(|_| "dynamic"),
            fastest_cm_per_s: motion.map(|(fastest, _)| fastest),
            kinetic_energy_gf_cm: motion.map(|(_, energy)| energy),
        }
    }
}

impl Shape {
    fn new(settled: &Settled) -> Self {
        let shape = &settled.shape;
        Self {
            lowest_cm: shape.lowest,
            highest_cm: shape.highest,
            mean_height_cm: shape.mean_height,
            energy_gf_cm: shape.energy,
            strain_warp_max: shape.strain_warp_max,
            strain_weft_max: shape.strain_weft_max,
            shear_deg_max: shape.shear_max.to_degrees(),
        }
    }
}

impl Work {
    fn new(settled: &Settled, run: &Run<'_>) -> Self {
        let levels = settled.levels.iter().map(|level| Level {
            spacing_cm: level.spacing,
            nodes: level.nodes,
            sweeps: level.sweeps,
            joint_steps: level.joint_steps,
        });
        Self {
            levels: levels.collect(),
            node_updates: settled.node_updates,
            seconds: run.seconds,
            threads: run.threads,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        certificate::{Certificate, DrapeShape},
        output::sample,
        solver,
    };

    fn settled() -> Settled {
        let sample::Placed { lattice, positions } = sample::wave(3, 2, 1.0);
        Settled {
            holding: Vec::new(),
            footing: crate::contact::Footing::default(),
            contact: vec![0.0; positions.len()],
            velocities: vec![Vec3::zeros(); positions.len()],
            lattice,
            positions,
            certificate: Certificate {
                residual_max: 6.1e-4,
                residual_rms: f64::NAN,
                worst_node: Vec3::new(0.5, -0.25, f64::INFINITY),
                remaining_move: 0.004,
                touching: 512,
                pulled: 1,
                outside_cone: 2,
                deepest: 0.0,
                equilibrium: Equilibrium::Static,
            },
            converged: false,
            shape: DrapeShape {
                lowest: -12.3,
                highest: 10.1,
                mean_height: 1.9,
                energy: -8123.4,
                strain_warp_max: 0.02,
                strain_weft_max: 0.03,
                shear_max: std::f64::consts::FRAC_PI_6,
            },
            levels: vec![solver::Level {
                spacing: 2.0,
                nodes: 961,
                sweeps: 210,
                joint_steps: 3,
                updates: 3_123_456,
            }],
            node_updates: 3_123_456,
            frames: Vec::new(),
        }
    }

    #[test]
    fn keys_stand_in_the_order_of_the_format() {
        let run = Run {
            title: "a \"title\"",
            fabric: "c",
            seconds: 2.1,
            threads: 2,
        };
        let text = report(&settled(), &run);
        let keys: Vec<&str> = text
            .lines()
            .filter_map(|line| line.trim_start().strip_prefix('"')?.split_once("\": "))
            .map(|(key, _)| key)
            .collect();
        let expected = "format title fabric nodes converged \
            certificate residual_max residual_rms worst_node_cm remaining_move_cm \
            touching pulled outside_cone deepest_cm self_crossings \
            shape lowest_cm highest_cm mean_height_cm energy_gf_cm \
            strain_warp_max strain_weft_max shear_deg_max \
            work levels spacing_cm nodes sweeps joint_steps node_updates seconds threads";
        assert_eq!(keys, expected.split_whitespace().collect::<Vec<_>>());
    }

    #[test]
    fn values_read_back_and_what_is_not_finite_is_null() {
        let run = Run {
            title: "a \"title\"",
            fabric: "c",
            seconds: 2.1,
            threads: 2,
        };
        let read: serde_json::Value = serde_json::from_str(&report(&settled(), &run)).unwrap();
        assert_eq!(read["format"], "soen-report/1");
        assert_eq!(read["title"], "a \"title\"");
        assert_eq!(
            (&read["nodes"], &read["converged"]),
            (&6.into(), &false.into())
        );
        let proof = &read["certificate"];
        assert_eq!(proof["residual_max"], 6.1e-4);
        assert!(proof["residual_rms"].is_null() && proof["self_crossings"].is_null());
        assert_eq!(
            proof["worst_node_cm"],
            serde_json::json!([0.5, -0.25, null])
        );
        let shear = read["shape"]["shear_deg_max"].as_f64().unwrap();
        assert!((shear - 30.0).abs() < 1e-12);
        assert_eq!(read["work"]["levels"][0]["joint_steps"], 3);
        assert_eq!(read["work"]["node_updates"], 3_123_456);
    }
}
