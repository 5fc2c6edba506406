//! What is found on a body, as a table.

use super::report::{Measured, Report};
use std::{fmt::Write, path::PathBuf};

pub(super) fn table(report: &Report, written: &[PathBuf]) -> String {
    let mut text = format!("{} ({})\n", report.person, report.source);
    // A String takes all that is written.
    let _ = writeln!(text, "{:24}{:>8}{:>8}{:>8}", "", "asked", "built", "off");
    for measured in &report.measurements {
        text += &row(measured, measured.name.replace('_', " "));
    }
    for measured in &report.girths {
        text += &row(
            measured,
            format!("{} girth", measured.name.replace('_', " ")),
        );
    }
    let _ = writeln!(
        text,
        "{} balls; on the trunk they are at most {:.2} cm below the skin",
        report.balls, report.deepest_trunk_dent_cm
    );
    let _ = writeln!(text, "\n{:32}{:>10}    allowed", report.pose, "angle");
    for joint in &report.joints {
        for angle in &joint.angles {
            let name = format!("{} {}", joint.name, angle.name);
            let range = format!("{:.0}° to {:.0}°", angle.least_deg, angle.greatest_deg);
            let _ = writeln!(text, "{name:32}{:>9.1}°    {range}", angle.angle_deg);
        }
    }
    for broken in &report.beyond_limits {
        let _ = writeln!(text, "beyond its limits: {broken}");
    }
    for reach in &report.reaches {
        let [x, y, z] = reach.to_cm;
        let verdict = if reach.reached {
            "reached"
        } else {
            "NOT reached"
        };
        let _ = writeln!(
            text,
            "{verdict}: {} ends {:.3} cm from ({x}, {y}, {z}) cm",
            reach.bone, reach.miss_cm
        );
    }
    for path in written {
        let _ = writeln!(text, "written: {}", path.display());
    }
    text
}

fn row(measured: &Measured, name: String) -> String {
    let Measured {
        asked_cm, built_cm, ..
    } = measured;
    // No negative zero.
    let off = (10.0 * (built_cm - asked_cm)).round() / 10.0 + 0.0;
    format!("{name:24}{asked_cm:8.1}{built_cm:8.1}{off:8.1} cm\n")
}
