//! A fabric found in measurements: its file, its report and the plots of its S–S curves.

use super::plot::{Mark, Plot, Series};
use crate::fabric::{
    Direction, Tension, Yarn,
    fit::{Basis, Doubt, Fate, Finding, Measured, MeasuredCurve, MeasuredDirection},
};
use serde::Serialize;
use serde_json::Value;
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
        remark(&mut text, &format!("B ± {}", short(half)));
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

/// The findings as JSON text (`soen-fit/1`), keys in the order of the type below. A number that is
/// not finite is written as `null`.
#[must_use]
pub fn fit_report(measured: &Measured) -> String {
    // Structs of text and numbers cannot fail to become JSON.
    serde_json::to_string_pretty(&Report::new(measured)).unwrap_or_default() + "\n"
}

#[derive(Serialize)]
struct Report<'a> {
    format: &'static str,
    sheet: &'a str,
    name: &'a str,
    source: &'a str,
    weight_gf_per_cm2: f64,
    thickness_cm: f64,
    friction: Coefficients,
    warp: Along<'a>,
    weft: Along<'a>,
    doubts: Vec<String>,
}

#[derive(Serialize)]
struct Coefficients {
    body: f64,
    cloth: f64,
}

#[derive(Serialize)]
struct Along<'a> {
    a_gf_per_cm: Found<'a>,
    b: Found<'a>,
    bending_gf_cm: Found<'a>,
    shear_gf_per_cm: Found<'a>,
    doubts: Vec<String>,
}

#[derive(Serialize)]
struct Found<'a> {
    value: f64,
    half_width_95: Option<f64>,
    how: &'a str,
    basis: Option<RestsOn>,
}

#[derive(Serialize)]
struct RestsOn {
    used: usize,
    of: usize,
    range: [f64; 2],
    range_unit: &'static str,
    residual: f64,
}

impl<'a> Report<'a> {
    fn new(measured: &'a Measured) -> Self {
        let fabric = &measured.fabric;
        Self {
            format: "soen-fit/1",
            sheet: &measured.sheet,
            name: &fabric.name,
            source: &fabric.source,
            weight_gf_per_cm2: fabric.weight,
            thickness_cm: fabric.thickness,
            friction: Coefficients {
                body: fabric.friction.body,
                cloth: fabric.friction.cloth,
            },
            warp: Along::new(&measured.warp),
            weft: Along::new(&measured.weft),
            doubts: in_text(&measured.doubts),
        }
    }
}

impl<'a> Along<'a> {
    fn new(found: &'a MeasuredDirection) -> Self {
        Self {
            a_gf_per_cm: Found::new(&found.a),
            b: Found::new(&found.b),
            bending_gf_cm: Found::new(&found.bending),
            shear_gf_per_cm: Found::new(&found.shear),
            doubts: in_text(&found.doubts),
        }
    }
}

impl<'a> Found<'a> {
    fn new(finding: &'a Finding) -> Self {
        let rests_on = |basis: &Basis| RestsOn {
            used: basis.used,
            of: basis.of,
            range: basis.range,
            range_unit: basis.unit,
            residual: basis.residual,
        };
        Self {
            value: finding.estimate.value,
            half_width_95: finding.estimate.half_width,
            how: &finding.how,
            basis: finding.basis.as_ref().map(rests_on),
        }
    }
}

fn in_text(doubts: &[Doubt]) -> Vec<String> {
    doubts.iter().map(ToString::to_string).collect()
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
