//! The paper's own tests: an S–S curve, overhangs, a shear record.

use super::{
    format::{CurveTable, OverhangTable, RecordTable, RelationWord, StripTable},
    record::Record,
    slips::{digits, looks_like, sized},
    unfit,
};
use crate::{
    fabric::{
        Yarn,
        fit::{
            self, BendingFit, Doubt, Finding, MeasuredCurve, MeasuredDirection, Overhangs,
            PAPER_ANGLE, Range, Relation, ShearRecord,
        },
    },
    scene::{
        document::At,
        error::{Fault, SceneError},
    },
};
use std::ops::RangeInclusive;

/// 1 N [gf].
const NEWTON: f64 = 1000.0 / 9.80665;

pub(super) fn direction(
    at: &At<'_>,
    table: &StripTable,
    yarn: Yarn,
    weight: f64,
) -> Result<MeasuredDirection, SceneError> {
    let ([a, b], curve, mut doubts) = tension(&at.key("tension"), &table.tension, weight)?;
    let (bent, relation) = bending(&at.key("bending"), &table.bending, weight)?;
    let (shear, more) = shear(&at.key("shear"), &table.shear)?;
    doubts.extend(bent.doubts.iter().cloned().chain(more));
    Ok(MeasuredDirection {
        yarn,
        a,
        b,
        bending: bent.finding(&relation),
        shear,
        doubts,
        curve: Some(curve),
    })
}

type Curve = ([Finding; 2], MeasuredCurve, Vec<Doubt>);

fn tension(at: &At<'_>, table: &CurveTable, weight: f64) -> Result<Curve, SceneError> {
    const STRAINS: &[&str] = &["strain", "strain_percent", "elongation_mm", "elongation_cm"];
    const TENSIONS: &[&str] = &[
        "tension_gf_per_cm",
        "tension_n_per_m",
        "force_gf",
        "force_n",
    ];
    let record = Record::open(&at.key("csv").file(&table.csv)?, [STRAINS, TENSIONS])?;
    let [strain, tension] = record.columns();
    let gauge = || needed(at, "gauge_cm", table.gauge_cm, 1.0..=100.0, strain);
    let width = || needed(at, "width_cm", table.width_cm, 0.5..=200.0, tension);
    let factors = [
        match strain {
            "strain" => 1.0,
            "strain_percent" => 0.01,
            "elongation_mm" => 0.1 / gauge()?,
            _ => 1.0 / gauge()?,
        },
        match tension {
            "tension_gf_per_cm" => 1.0,
            "tension_n_per_m" => NEWTON / 100.0,
            "force_gf" => 1.0 / width()?,
            _ => NEWTON / width()?,
        },
    ];
    let points = converted(&record, factors);
    plausible_strains(&record, &points, factors[0])?;
    // The strongest canvas breaks at some 1e5 gf/cm.
    inside(&record, 1, &points, factors[1], -1e3..=1e5)?;
    let percent = |key: &str, value| {
        let at = at.key(key);
        sized(&at, value, 0.0..=100.0, "%", &[]).map(|percent| 0.01 * percent)
    };
    let up_to = table.up_to_strain_percent;
    let range = Range {
        up_to: up_to
            .map(|up_to| percent("up_to_strain_percent", up_to))
            .transpose()?,
        slack: percent("slack_percent", table.slack_percent)?,
    };
    let fit = fit::power_law(&points, &range).map_err(|error| unfit(&at.key("csv"), error))?;
    let findings = fit.findings(&table.csv.display().to_string());
    let mut doubts = fit.doubts;
    // The paper's own measure: what 1 m of the cloth bears where it hangs.
    let (least, worn) = (fit.tensions[0], 100.0 * weight);
    doubts.extend((least > worn).then_some(Doubt::Extrapolated { least, worn }));
    let curve = MeasuredCurve {
        points: points.iter().map(|[s, t]| [s - range.slack, *t]).collect(),
        fates: fit.fates,
        strains: fit.strains,
    };
    Ok((findings, curve, doubts))
}

fn bending(
    at: &At<'_>,
    table: &OverhangTable,
    weight: f64,
) -> Result<(BendingFit, String), SceneError> {
    let sides = [
        ("overhang_face_cm", &table.overhang_face_cm),
        ("overhang_back_cm", &table.overhang_back_cm),
    ];
    for (key, lengths) in sides {
        for (item, length) in lengths.iter().enumerate() {
            let at = at.key(key).item(item);
            sized(&at, *length, 0.3..=40.0, "cm", &[(0.1, "mm"), (100.0, "m")])?;
        }
    }
    let angle = match table.angle_deg {
        Some(degrees) => {
            let radians = [(180.0 / std::f64::consts::PI, "radians")];
            sized(
                &at.key("angle_deg"),
                degrees,
                5.0..=85.0,
                "degrees",
                &radians,
            )?
            .to_radians()
        }
        None => PAPER_ANGLE,
    };
    let at_41_5 = (angle - PAPER_ANGLE).abs() < 0.01;
    let (relation, name) = match table.relation {
        Some(RelationWord::Peirce) => (Relation::Peirce, "Peirce's relation"),
        Some(RelationWord::Exact) => (Relation::Exact, "a heavy strip's own shape"),
        None if !at_41_5 => (Relation::Exact, "a heavy strip's own shape"),
        Some(RelationWord::Paper) | None => (Relation::Paper, "(2)"),
    };
    let test = Overhangs {
        face: &table.overhang_face_cm,
        back: &table.overhang_back_cm,
        angle,
        relation,
        weight,
    };
    let fit = fit::bending(&test).map_err(|error| unfit(&at.key("relation"), error))?;
    Ok((fit, format!("{name} at {:.1} degrees", angle.to_degrees())))
}

fn shear(at: &At<'_>, table: &RecordTable) -> Result<(Finding, Vec<Doubt>), SceneError> {
    let width = sized(
        &at.key("width_cm"),
        table.width_cm,
        0.5..=50.0,
        "cm",
        &[(0.1, "mm")],
    )?;
    let newtons = [(NEWTON, "newtons")];
    let load = sized(
        &at.key("load_gf"),
        table.load_gf,
        0.0..=5000.0,
        "gf",
        &newtons,
    )?;
    let angles = angles(at, table)?;
    let test = ShearRecord {
        readings: &sheared(at, table, width)?,
        load,
        width,
        angles,
    };
    let fit = fit::shear(&test).map_err(|error| unfit(&at.key("csv"), error))?;
    let finding = fit.finding(&table.csv.display().to_string(), angles);
    Ok((finding, fit.doubts))
}

/// Least and greatest angle to use [rad].
fn angles(at: &At<'_>, table: &RecordTable) -> Result<[f64; 2], SceneError> {
    // KES-F takes G over this range, where the branches are straight.
    let (from, to) = (table.from_deg.unwrap_or(0.5), table.to_deg.unwrap_or(5.0));
    for (key, degrees) in [("from_deg", from), ("to_deg", to)] {
        sized(&at.key(key), degrees, 0.0..=30.0, "degrees", &[])?;
    }
    if from >= to {
        return Err(at
            .key("from_deg")
            .not_allowed(format!("below to_deg, {to}")));
    }
    Ok([from, to].map(f64::to_radians))
}

/// Readings of tan θ [-] and force [gf].
fn sheared(at: &At<'_>, table: &RecordTable, width: f64) -> Result<Vec<[f64; 2]>, SceneError> {
    const ANGLES: &[&str] = &["angle_deg", "displacement_mm", "displacement_cm"];
    const FORCES: &[&str] = &["force_gf", "force_n", "force_gf_per_cm"];
    let record = Record::open(&at.key("csv").file(&table.csv)?, [ANGLES, FORCES])?;
    let [angle, force] = record.columns();
    let gap = || needed(at, "gap_cm", table.gap_cm, 0.5..=50.0, angle);
    let factors = [
        match angle {
            "angle_deg" => 1.0,
            "displacement_mm" => 0.1 / gap()?,
            _ => 1.0 / gap()?,
        },
        match force {
            "force_gf" => 1.0,
            "force_n" => NEWTON,
            _ => width,
        },
    ];
    let mut readings = converted(&record, factors);
    inside(&record, 1, &readings, factors[1], -1e5..=1e5)?;
    if angle != "angle_deg" {
        inside(&record, 0, &readings, factors[0], -1.0..=1.0)?;
        return Ok(readings);
    }
    plausible_angles(&record, &readings)?;
    for reading in &mut readings {
        reading[0] = libm::tan(reading[0].to_radians());
    }
    Ok(readings)
}

fn converted(record: &Record, factors: [f64; 2]) -> Vec<[f64; 2]> {
    let [x, y] = factors;
    record.values().map(|[a, b]| [x * a, y * b]).collect()
}

/// The number that a column of a record needs.
fn needed(
    at: &At<'_>,
    key: &'static str,
    value: Option<f64>,
    range: RangeInclusive<f64>,
    column: &str,
) -> Result<f64, SceneError> {
    match value {
        Some(value) => sized(
            &at.key(key),
            value,
            range,
            "cm",
            &[(0.1, "mm"), (100.0, "m")],
        ),
        None => Err(at.error(Fault::MissingKey {
            key: format!("{key} (for the column {column})"),
            table: at.name(),
        })),
    }
}

/// Every value of a column in its range, given in our unit.
fn inside(
    record: &Record,
    which: usize,
    points: &[[f64; 2]],
    factor: f64,
    range: RangeInclusive<f64>,
) -> Result<(), SceneError> {
    let outside = points
        .iter()
        .position(|point| !range.contains(&point[which]));
    outside.map_or(Ok(()), |row| {
        let (low, high) = (digits(range.start() / factor), digits(range.end() / factor));
        let hint = match record.columns()[which] {
            "force_n" => looks_like(
                points[row][which] / factor,
                &(low..=high),
                &[(1.0 / NEWTON, "gf")],
            ),
            _ => String::new(),
        };
        Err(record.not_allowed(row, which, format!("{low} to {high}{hint}")))
    })
}

/// Strains that cloth has, and that a machine can tell: up to 1, the greatest not below 0.002.
fn plausible_strains(record: &Record, points: &[[f64; 2]], factor: f64) -> Result<(), SceneError> {
    let percent = [(0.01, "percent: name the column strain_percent")];
    let strains = points.iter().map(|point| point[0]);
    if let Some(row) = strains
        .clone()
        .position(|strain| !(-0.1..=1.0).contains(&strain))
    {
        let greatest = strains.fold(0.0, f64::max);
        let hint = if record.columns()[0] == "strain" {
            looks_like(greatest, &(0.0..=1.0), &percent)
        } else {
            String::new()
        };
        let (low, high) = (digits(-0.1 / factor), digits(1.0 / factor));
        return Err(record.not_allowed(row, 0, format!("{low} to {high}{hint}")));
    }
    let greatest = (0..points.len()).max_by(|a, b| points[*a][0].total_cmp(&points[*b][0]));
    match greatest {
        Some(row) if points[row][0] < 2e-3 => {
            let hint = if record.columns()[0] == "strain_percent" {
                " (looks like a fraction: name the column strain)"
            } else {
                ""
            };
            let least = digits(2e-3 / factor);
            Err(record.not_allowed(
                row,
                0,
                format!("a greatest strain of {least} or more{hint}"),
            ))
        }
        _ => Ok(()),
    }
}

/// Angles that a shear tester turns to: up to 45°, the greatest not below 0.5°.
fn plausible_angles(record: &Record, readings: &[[f64; 2]]) -> Result<(), SceneError> {
    let size = |row: &usize| readings[*row][0].abs();
    let greatest = (0..readings.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
    match greatest {
        Some(row) if size(&row) > 45.0 => {
            Err(record.not_allowed(row, 0, "-45 to 45 degrees".into()))
        }
        Some(row) if size(&row) < 0.5 => Err(record.not_allowed(
            row,
            0,
            "a greatest angle of 0.5 degrees or more (looks like radians)".into(),
        )),
        _ => Ok(()),
    }
}
