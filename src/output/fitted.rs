//! A fabric found in measurements: its file, its report and the plots of its S–S curves.

use super::plot::{Mark, Plot, Series};
use crate::fabric::{
    Direction, Quantity, Tension, Yarn,
    fit::{Basis, Fate, Finding, Measured, MeasuredCurve, MeasuredDirection},
};
use serde_json::{Value, json};
use std::fmt::Write;

/// The fabric as a file that scenes take, with what each number rests on beside it.
#[must_use]
pub fn fabric_file(measured: &Measured) -> String {
    let fabric = &measured.fabric;
    let mut text = String::new();
    let version = env!("CARGO_PKG_VERSION");
    remark(
        &mut text,
        &format!(
            "Found in {} by soen {version}; ± is half of the 95 % interval.",
            measured.sheet
        ),
    );
    for doubt in &measured.doubts {
        remark(&mut text, &format!("Doubtful: {doubt}"));
    }
    // A String takes all that is written.
    let _ = write!(
        text,
        "name = {}\nsource = {}\nweight_gf_per_cm2 = {:?}\nthickness_cm = {:?}\n\
         friction = {{ body = {:?}, cloth = {:?} }}\n",
        quoted(&fabric.name),
        quoted(&fabric.source),
        fabric.weight,
        fabric.thickness,
        fabric.friction.body,
        fabric.friction.cloth,
    );
    for (found, direction) in [
        (&measured.warp, &fabric.warp),
        (&measured.weft, &fabric.weft),
    ] {
        text += &table(found, direction);
    }
    text
}

fn table(found: &MeasuredDirection, direction: &Direction) -> String {
    let mut text = format!("\n[{}]\n", found.yarn);
    for doubt in &found.doubts {
        remark(&mut text, &format!("Doubtful: {doubt}"));
    }
    remark(&mut text, &format!("A {}", provenance(&found.a)));
    if let Some(half) = found.b.estimate.half_width {
        remark(&mut text, &format!("B ± {half:.2}"));
    }
    let _ = match direction.tension {
        Tension::Power { a, b } => {
            writeln!(text, "tension = {{ a_gf_per_cm = {a:?}, b = {b:?} }}")
        }
        Tension::Linear { modulus } => {
            writeln!(text, "tension = {{ linear_gf_per_cm = {modulus:?} }}")
        }
        Tension::Points(_) => Ok(()),
    };
    remark(&mut text, &provenance(&found.bending));
    let _ = writeln!(text, "bending_gf_cm = {:?}", direction.bending);
    remark(&mut text, &provenance(&found.shear));
    let _ = writeln!(text, "shear_gf_per_cm = {:?}", direction.shear);
    text
}

/// `± 0.2: how it was found; 40 of 42 readings, 0.5 to 5 degrees, residual 1.0 %`.
fn provenance(finding: &Finding) -> String {
    let mut text = match finding.estimate.half_width {
        Some(half) => format!("± {}: ", short(half)),
        None => String::new(),
    };
    text += &finding.how;
    if let Some(basis) = &finding.basis {
        text += "; ";
        text += &in_words(basis);
    }
    text
}

/// `40 of 42 readings, 0.5 to 5 degrees, residual 1.0 %`.
fn in_words(basis: &Basis) -> String {
    let [from, to] = basis.range.map(short);
    format!(
        "{} of {} readings, {from} to {to} {}, residual {:.2} %",
        basis.used,
        basis.of,
        basis.unit,
        100.0 * basis.residual
    )
}

/// A number to three digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.2e}").parse().unwrap_or(value);
    if (1e-4..1e5).contains(&rounded.abs()) || rounded == 0.0 {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}

/// A line that TOML passes over, whatever was put into it.
fn remark(text: &mut String, words: &str) {
    let blank = |c: char| if c.is_control() { ' ' } else { c };
    let words: String = words.chars().map(blank).collect();
    let _ = writeln!(text, "# {words}");
}

/// A TOML string: JSON's escapes are TOML's, but for one character that TOML wants escaped too.
fn quoted(text: &str) -> String {
    Value::from(text).to_string().replace('\u{7f}', "\\u007f")
}

/// The findings as JSON text (`soen-fit/1`). A number that is not finite is written as `null`.
#[must_use]
pub fn fit_report(measured: &Measured) -> String {
    let fabric = &measured.fabric;
    let report = json!({
        "format": "soen-fit/1",
        "sheet": measured.sheet,
        "name": fabric.name,
        "source": fabric.source,
        "weight_gf_per_cm2": fabric.weight,
        "thickness_cm": fabric.thickness,
        "friction": { "body": fabric.friction.body, "cloth": fabric.friction.cloth },
        "warp": direction_report(&measured.warp),
        "weft": direction_report(&measured.weft),
        "doubts": measured.doubts.iter().map(ToString::to_string).collect::<Vec<_>>(),
    });
    format!("{report:#}\n")
}

fn direction_report(found: &MeasuredDirection) -> Value {
    let mut report = serde_json::Map::new();
    for (quantity, finding) in found.findings() {
        report.insert(key(quantity).into(), finding_report(finding));
    }
    let doubts: Vec<String> = found.doubts.iter().map(ToString::to_string).collect();
    report.insert("doubts".into(), doubts.into());
    report.into()
}

fn key(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::PowerFactor(_) => "a_gf_per_cm",
        Quantity::PowerExponent(_) => "b",
        Quantity::Bending(_) => "bending_gf_cm",
        Quantity::Shear(_) => "shear_gf_per_cm",
        _ => "other",
    }
}

fn finding_report(finding: &Finding) -> Value {
    let mut report = json!({
        "value": finding.estimate.value,
        "half_width_95": finding.estimate.half_width,
        "how": finding.how,
    });
    if let Some(basis) = &finding.basis {
        report["used"] = basis.used.into();
        report["of"] = basis.of.into();
        report["range"] = json!(basis.range);
        report["range_unit"] = basis.unit.into();
        report["residual"] = json!(basis.residual);
    }
    report
}

/// The measured S–S curve of a direction and the law found in it, where a curve was measured.
#[must_use]
pub fn fit_plot(measured: &Measured, yarn: Yarn) -> Option<Plot> {
    let found = match yarn {
        Yarn::Warp => &measured.warp,
        Yarn::Weft => &measured.weft,
    };
    let curve = found.curve.as_ref()?;
    let law = &measured.fabric.along(yarn).tension;
    let series = [
        ("used", Mark::Dots, Fate::Used),
        ("left out: too far off", Mark::Crosses, Fate::Outlier),
        ("outside the range", Mark::Rings, Fate::Outside),
        ("way back", Mark::Rings, Fate::WayBack),
    ];
    let measured_series = series
        .into_iter()
        .map(|(name, mark, fate)| Series {
            name: name.into(),
            mark,
            points: of_fate(curve, fate),
        })
        .filter(|series| !series.points.is_empty());
    let [a, b] = [&found.a, &found.b].map(|one| one.estimate.value);
    let mut all: Vec<Series> = measured_series.collect();
    all.push(Series {
        name: format!("{}·S^{}", short(a), short(b + 1.0)),
        mark: Mark::Line,
        points: drawn_law(curve, law),
    });
    Some(Plot {
        title: format!("{}, {yarn}", measured.fabric.name),
        x_label: "strain [%]".into(),
        y_label: "tension [gf/cm]".into(),
        series: all,
    })
}

fn of_fate(curve: &MeasuredCurve, fate: Fate) -> Vec<[f64; 2]> {
    let pairs = curve.points.iter().zip(&curve.fates);
    pairs
        .filter(|(_, own)| **own == fate)
        .map(|([strain, tension], _)| [100.0 * strain, *tension])
        .collect()
}

/// The law over the range that was used.
fn drawn_law(curve: &MeasuredCurve, law: &Tension) -> Vec<[f64; 2]> {
    let [_, to] = curve.strains;
    (0..=100)
        .map(|k| to * f64::from(k) / 100.0)
        .map(|strain| [100.0 * strain, law.tension(strain, 0.0)])
        .collect()
}
