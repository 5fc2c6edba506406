//! A drape as a text that people read in a review: rounded figures, and a digest of all positions
//! that shows a change too small for them.
//!
//! A snapshot records a drape, it does not verify one: assert beside it what must be true of yours.
//! [`assert_drape!`](crate::assert_drape) makes a test of it with the crate `insta`, version 1.49
//! or later, which stands among your own dev-dependencies:
//!
//! ```
//! # let problem = soen::scene::read("scenes/fig10-warp.toml".as_ref())?.problem;
//! # let problem = soen::solver::Problem { piece: soen::lattice::Piece { pitch: 6.0, ..problem.piece }, ..problem };
//! # let settings = soen::solver::Settings { tolerance: 1e-3, frames: 0 };
//! let settled = soen::solver::settle(&problem, &settings, &mut |_| true)?;
//! println!("{}", soen::snapshot::figures(&problem, &settled));
//! # assert!(soen::snapshot::figures(&problem, &settled).contains("nodes                 44\n"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod clearance;
mod digest;
mod shadow;

pub use clearance::least_clearance;
pub use digest::digest;
pub use shadow::{outline_radii, shadow_area};

use crate::solver::{Problem, Settled};

/// The figures of a drape, one a line, each with its unit.
///
/// Nothing in it depends on how long the solver took. A number that is not finite is written as
/// `none`, and no zero has a sign.
#[must_use]
pub fn figures(problem: &Problem, settled: &Settled) -> String {
    let (proof, shape) = (&settled.certificate, &settled.shape);
    let (lattice, at) = (&settled.lattice, settled.positions.as_slice());
    let flat: f64 = lattice.area.iter().sum();
    let mut lines = vec![
        line("nodes", at.len()),
        line("certified", if settled.converged { "yes" } else { "NO" }),
        line("lowest point", with(shape.lowest, 2, " cm")),
        line("highest point", with(shape.highest, 2, " cm")),
        line("mean height", with(shape.mean_height, 2, " cm")),
        line(
            "drape coefficient",
            with(shadow_area(lattice, at) / flat, 3, ""),
        ),
        line(
            "greatest warp strain",
            with(100.0 * shape.strain_warp_max, 2, " %"),
        ),
        line(
            "greatest weft strain",
            with(100.0 * shape.strain_weft_max, 2, " %"),
        ),
        line("greatest shear", with(shape.shear_max.to_degrees(), 1, "°")),
        line("deepest in a body", with(proof.deepest, 2, " cm")),
    ];
    let clearance = least_clearance(&problem.bodies, at);
    lines.extend(clearance.map(|clearance| line("least clearance", with(clearance, 2, " cm"))));
    lines.push(line("digest", format!("{:016x}", digest(at))));
    lines.push("outline radius every 10° [cm]\n".to_owned());
    lines.extend(outline_radii(lattice, at).chunks(9).map(row));
    lines.concat()
}

fn line(name: &str, value: impl core::fmt::Display) -> String {
    format!("{name:22}{value}\n")
}

fn row(radii: &[f64]) -> String {
    let cells = radii
        .iter()
        .map(|radius| format!("{:>7}", with(*radius, 2, "")));
    cells.collect::<String>() + "\n"
}

/// A rounded number and its unit.
fn with(value: f64, digits: usize, unit: &str) -> String {
    if !value.is_finite() {
        return "none".to_owned();
    }
    let text = format!("{value:.digits$}");
    let zero = text.starts_with('-') && text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    format!("{}{unit}", if zero { &text[1..] } else { &text })
}

/// Compares the [`figures`] of a drape with `snapshots/<name>.snap` in your own crate, by `insta`.
///
/// ```ignore
/// let scene = soen::scene::read("scenes/skirt.toml".as_ref())?;
/// let settled = soen::solver::settle(&scene.problem, &scene.settings, &mut |_| true)?;
/// soen::assert_drape!("skirt", &scene.problem, &settled);
/// ```
///
/// # Panics
/// Where they differ or no snapshot is there yet; `INSTA_UPDATE=always cargo test` writes it.
#[macro_export]
macro_rules! assert_drape {
    ($name:expr, $problem:expr, $settled:expr $(,)?) => {{
        let mut settings = ::insta::Settings::clone_current();
        settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        let figures = $crate::snapshot::figures($problem, $settled);
        settings.bind(|| ::insta::assert_snapshot!($name, figures));
    }};
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_zero_has_a_sign_and_nothing_else_is_lost() {
        assert_eq!(with(-0.004, 2, " cm"), "0.00 cm");
        assert_eq!(with(-0.0, 0, ""), "0");
        assert_eq!(with(-0.006, 2, ""), "-0.01");
        assert_eq!(with(-10.0, 1, "°"), "-10.0°");
        assert_eq!(with(f64::NAN, 2, " cm"), "none");
        assert_eq!(with(f64::NEG_INFINITY, 2, " cm"), "none");
    }
}
