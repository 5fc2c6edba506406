//! `soen fabric fit SHEET --out FABRIC.toml`.

use crate::{args::FitWish, failure::Failure, say};
use soen::{
    fabric::{
        Quantity, Yarn,
        fit::{Finding, Measured, MeasuredDirection},
    },
    output, scene,
};
use std::{
    fmt::Write,
    path::{Path, PathBuf},
};

pub(crate) fn fit(wish: &FitWish) -> Result<(), Failure> {
    // The sheet itself would be lost.
    let same = |path: &Path| path.canonicalize().ok();
    let is_sheet = same(&wish.out).is_some_and(|out| Some(out) == same(&wish.sheet));
    if is_sheet || wish.out.extension().is_none_or(|ending| ending != "toml") {
        let out = wish.out.display();
        return Err(Failure::Input(format!(
            "--out is {out}; allowed: a path that ends in .toml and is not the sheet's"
        )));
    }
    let measured = scene::measured(&wish.sheet)?;
    let mut written = Vec::new();
    for yarn in [Yarn::Warp, Yarn::Weft] {
        if let Some(plot) = output::fit_plot(&measured, yarn) {
            let path = beside(&wish.out, yarn);
            output::write(&path, output::plot(&plot).as_bytes())?;
            written.push(path);
        }
    }
    // The fabric last, so that where it stands its plots do too.
    output::write(&wish.out, output::fabric_file(&measured).as_bytes())?;
    written.push(wish.out.clone());
    say(&if wish.json {
        output::fit_report(&measured)
    } else {
        table(&measured, &written)
    })
}

/// `mine.toml` and the warp: `mine-warp.svg`.
fn beside(out: &Path, yarn: Yarn) -> PathBuf {
    let mut name = out.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{yarn}.svg"));
    out.with_file_name(name)
}

fn table(measured: &Measured, written: &[PathBuf]) -> String {
    let fabric = &measured.fabric;
    let mut text = format!(
        "{} ({})\n  {} gf/cm², {} cm thick\n",
        fabric.name, fabric.source, fabric.weight, fabric.thickness
    );
    for found in [&measured.warp, &measured.weft] {
        text += &direction(found);
    }
    for (yarn, doubt) in measured.all_doubts() {
        let yarn = yarn.map_or(String::new(), |yarn| format!("{yarn}: "));
        // A String takes all that is written.
        let _ = writeln!(text, "doubtful: {yarn}{doubt}");
    }
    for path in written {
        let _ = writeln!(text, "written: {}", path.display());
    }
    text
}

fn direction(found: &MeasuredDirection) -> String {
    let mut text = format!("{}\n", found.yarn);
    for (quantity, finding) in found.findings() {
        let _ = writeln!(text, "{}", row(quantity, finding));
    }
    text
}

/// Value ± half of its 95 % interval, unit, and what it rests on.
fn row(quantity: Quantity, finding: &Finding) -> String {
    let name = match quantity {
        Quantity::PowerFactor(_) => "A",
        Quantity::PowerExponent(_) => "B",
        Quantity::Bending(_) => "bending",
        Quantity::Shear(_) => "shear",
        _ => "",
    };
    let estimate = finding.estimate;
    let off = estimate
        .half_width
        .map_or(String::new(), |half| format!("± {}", digits(half, 2)));
    let rests_on = finding.basis.as_ref().map_or(finding.how.clone(), |basis| {
        let [from, to] = basis.range.map(|end| digits(end, 3));
        format!(
            "{} of {} readings, {from} to {to} {}, residual {:.2} %",
            basis.used,
            basis.of,
            basis.unit,
            100.0 * basis.residual
        )
    });
    format!(
        "  {name:8}{:>10} {off:12}{:6}  {rests_on}",
        digits(estimate.value, 4),
        quantity.unit(),
    )
}

/// A number to so many digits.
fn digits(value: f64, count: usize) -> String {
    let places = count.saturating_sub(1);
    let rounded: f64 = format!("{value:.places$e}").parse().unwrap_or(value);
    if (1e-4..1e5).contains(&rounded.abs()) || rounded == 0.0 {
        rounded.to_string()
    } else {
        format!("{rounded:e}")
    }
}
