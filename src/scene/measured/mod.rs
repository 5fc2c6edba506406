//! Measurement sheets: what a laboratory read off its instruments, on the way to a fabric.
//!
//! A sheet gives name, source, weight, thickness and, along both thread directions, one of three:
//! the paper's tests (`[warp]`, `[weft]`: S–S curve, overhangs, shear record), a KES-F sheet
//! (`[kes.warp]`, `[kes.weft]`) or a FAST sheet (`[fast.warp]`, `[fast.weft]`). A value outside of
//! its range is refused, and where it would be inside in another unit, that unit is named.

mod format;
mod record;
mod slips;
mod strips;

use super::{
    document::{At, Document},
    error::{Fault, SceneError},
};
use crate::fabric::{
    Fabric, Friction, InvalidFabric, Tension, Yarn,
    fit::{Doubt, FastReadings, Finding, KesReadings, Measured, MeasuredDirection, Unfit},
};
use format::{FastDirectionTable, FastTable, KesDirectionTable, KesTable, SheetFile};
use slips::{Unit, one_of, sized};
use std::path::Path;

/// Reads a measurement sheet and the records it names, and finds the fabric in them.
///
/// # Errors
/// [`SceneError`] where a file is none, a value is outside of what an instrument reads, readings
/// contradict each other, or no law can be found in them.
pub fn measured(path: &Path) -> Result<Measured, SceneError> {
    let document = Document::open(path)?;
    let sheet: SheetFile = document.content()?;
    let top = document.top();
    let kinds = [
        ("kes", sheet.kes.is_some()),
        ("fast", sheet.fast.is_some()),
        ("warp", sheet.warp.is_some() || sheet.weft.is_some()),
    ];
    let weight = weight(&top, &sheet)?;
    let thickness = thickness(&top, &sheet)?;
    top.exactly_one(&kinds)?;
    let directions = if let Some(kes) = &sheet.kes {
        of_kes(&top.key("kes"), kes)?
    } else if let Some(fast) = &sheet.fast {
        of_fast(&top.key("fast"), fast, weight)?
    } else {
        each(both(&top, &sheet.warp, &sheet.weft)?, |yarn, table| {
            strips::direction(&along(&top, yarn), table, yarn, weight)
        })?
    };
    let (friction, doubts) = friction(&top, &sheet)?;
    let [warp, weft] = &directions;
    let cloth = Fabric {
        name: sheet.name,
        source: sheet.source,
        weight,
        thickness,
        friction,
        twist: 0.0,
        warp: warp.direction(),
        weft: weft.direction(),
    };
    let file = path.display().to_string();
    let found = Measured::new(cloth, file, directions, doubts);
    found.map_err(|error: InvalidFabric| document.error_at(None, Fault::NoCloth(error)))
}

fn weight(top: &At<'_>, sheet: &SheetFile) -> Result<f64, SceneError> {
    // From 5 g/m² (silk gauze) to 2 kg/m² (felt).
    one_of(
        top,
        &[
            (
                Unit::new("weight_gf_per_cm2", 1.0, "gf/cm²"),
                sheet.weight_gf_per_cm2,
            ),
            (
                Unit::new("weight_g_per_m2", 1e-4, "g/m²"),
                sheet.weight_g_per_m2,
            ),
            (
                Unit::new("weight_mg_per_cm2", 1e-3, "mg/cm²"),
                sheet.weight_mg_per_cm2,
            ),
        ],
        5e-4..=0.2,
    )
}

fn thickness(top: &At<'_>, sheet: &SheetFile) -> Result<f64, SceneError> {
    one_of(
        top,
        &[
            (Unit::new("thickness_cm", 1.0, "cm"), sheet.thickness_cm),
            (Unit::new("thickness_mm", 0.1, "mm"), sheet.thickness_mm),
        ],
        1e-3..=1.0,
    )
}

fn friction(top: &At<'_>, sheet: &SheetFile) -> Result<(Friction, Vec<Doubt>), SceneError> {
    let Some(table) = &sheet.friction else {
        let assumed = Friction {
            body: 0.35,
            cloth: 0.4,
        };
        return Ok((assumed, vec![Doubt::FrictionAssumed]));
    };
    let at = top.key("friction");
    let checked = |key, value| sized(&at.key(key), value, 0.0..=5.0, "", &[]);
    let measured = Friction {
        body: checked("body", table.body)?,
        cloth: checked("cloth", table.cloth)?,
    };
    Ok((measured, Vec::new()))
}

fn along<'d>(at: &At<'d>, yarn: Yarn) -> At<'d> {
    at.key(&yarn.to_string())
}

/// Both directions, or the message that one is absent.
fn both<'t, T>(
    at: &At<'_>,
    warp: &'t Option<T>,
    weft: &'t Option<T>,
) -> Result<(&'t T, &'t T), SceneError> {
    let one = |present| {
        let table = at.name();
        Err(at
            .key(present)
            .error(Fault::OneDirection { present, table }))
    };
    match (warp, weft) {
        (Some(warp), Some(weft)) => Ok((warp, weft)),
        (Some(_), None) => one("warp"),
        (None, Some(_)) => one("weft"),
        (None, None) => Err(at.error(Fault::MissingKey {
            key: "warp".into(),
            table: at.name(),
        })),
    }
}

/// What is found along each direction.
fn each<T>(
    (warp, weft): (&T, &T),
    find: impl Fn(Yarn, &T) -> Result<MeasuredDirection, SceneError>,
) -> Result<[MeasuredDirection; 2], SceneError> {
    Ok([find(Yarn::Warp, warp)?, find(Yarn::Weft, weft)?])
}

fn of_kes(at: &At<'_>, table: &KesTable) -> Result<[MeasuredDirection; 2], SceneError> {
    each(both(at, &table.warp, &table.weft)?, |yarn, table| {
        kes_direction(&along(at, yarn), table, yarn)
    })
}

fn kes_direction(
    at: &At<'_>,
    table: &KesDirectionTable,
    yarn: Yarn,
) -> Result<MeasuredDirection, SceneError> {
    let readings = kes_readings(at, table)?;
    let key = if table.lt.is_some() {
        "lt"
    } else {
        "wt_gf_cm_per_cm2"
    };
    let (read, doubts) = readings
        .direction()
        .map_err(|error| unfit(&at.key(key), error))?;
    let direction = read.direction();
    let (a, b) = match direction.tension {
        Tension::Power { a, b } => (a, b),
        Tension::Linear { .. } | Tension::Points(_) => (0.0, 0.0),
    };
    Ok(MeasuredDirection {
        yarn,
        a: Finding::given(a, "KES-F: the power law through EMT and LT"),
        b: Finding::given(b, "KES-F: 2/LT − 2"),
        bending: Finding::given(direction.bending, "KES-F: B"),
        shear: Finding::given(direction.shear, "KES-F: G, per radian"),
        doubts,
        curve: None,
    })
}

fn kes_readings(at: &At<'_>, table: &KesDirectionTable) -> Result<KesReadings, SceneError> {
    if table.lt.is_none() && table.wt_gf_cm_per_cm2.is_none() {
        return Err(at.error(Fault::MissingKey {
            key: "one of lt, wt_gf_cm_per_cm2".into(),
            table: at.name(),
        }));
    }
    let checked = |key, value, range, unit| sized(&at.key(key), value, range, unit, &[]);
    let maybe = |key, value: Option<f64>, range, unit| {
        value
            .map(|value| checked(key, value, range, unit))
            .transpose()
    };
    maybe("rt_percent", table.rt_percent, 0.0..=100.0, "%")?;
    let emt_slips = [(100.0, "a fraction")];
    Ok(KesReadings {
        lt: maybe("lt", table.lt, 0.01..=2.0, "")?,
        wt: maybe(
            "wt_gf_cm_per_cm2",
            table.wt_gf_cm_per_cm2,
            0.01..=500.0,
            "gf·cm/cm²",
        )?,
        emt: sized(
            &at.key("emt_percent"),
            table.emt_percent,
            0.3..=100.0,
            "%",
            &emt_slips,
        )?,
        g: checked(
            "g_gf_per_cm_deg",
            table.g_gf_per_cm_deg,
            0.0..=200.0,
            "gf/(cm·degree)",
        )?,
        hg: maybe("2hg_gf_per_cm", table.hg_gf_per_cm, 0.0..=200.0, "gf/cm")?,
        hg5: maybe("2hg5_gf_per_cm", table.hg5_gf_per_cm, 0.0..=200.0, "gf/cm")?,
        b: checked(
            "b_gf_cm2_per_cm",
            table.b_gf_cm2_per_cm,
            0.0..=20.0,
            "gf·cm²/cm",
        )?,
        hb: maybe(
            "2hb_gf_cm_per_cm",
            table.hb_gf_cm_per_cm,
            0.0..=20.0,
            "gf·cm/cm",
        )?,
        miu: maybe("miu", table.miu, 0.0..=2.0, "")?,
    })
}

fn of_fast(
    at: &At<'_>,
    table: &FastTable,
    weight: f64,
) -> Result<[MeasuredDirection; 2], SceneError> {
    let fraction = [(100.0, "a fraction")];
    let bias = sized(
        &at.key("eb5_percent"),
        table.eb5_percent,
        0.05..=80.0,
        "%",
        &fraction,
    )?;
    each(both(at, &table.warp, &table.weft)?, |yarn, table| {
        fast_direction(&along(at, yarn), table, yarn, (bias, weight))
    })
}

fn fast_direction(
    at: &At<'_>,
    table: &FastDirectionTable,
    yarn: Yarn,
    (bias, weight): (f64, f64),
) -> Result<MeasuredDirection, SceneError> {
    let readings = fast_readings(at, table, bias)?;
    let ([a, b], residual) = readings
        .power_law()
        .map_err(|error| unfit(&at.key("e5_percent"), error))?;
    let bending = readings
        .bending(weight)
        .map_err(|error| unfit(&at.key("bending_rigidity_micronewton_m"), error))?;
    let how = format!(
        "FAST-3: (1) through E5, E20, E100, missed by {:.1} %",
        100.0 * residual
    );
    // FAST reads extensions to 0.1 %.
    let holds = residual <= 0.1;
    Ok(MeasuredDirection {
        yarn,
        a: Finding::given(a.value, how.clone()),
        b: Finding::given(b.value, how),
        bending: Finding::given(bending, "FAST-2: W·c³"),
        shear: Finding::given(readings.shear(), "FAST-3: 125/EB5"),
        doubts: (!holds)
            .then_some(Doubt::LawDoesNotHold { residual })
            .into_iter()
            .collect(),
        curve: None,
    })
}

fn fast_readings(
    at: &At<'_>,
    table: &FastDirectionTable,
    bias: f64,
) -> Result<FastReadings, SceneError> {
    let extension = |key, value| sized(&at.key(key), value, 0.0..=80.0, "%", &[]);
    let rigidity = table.bending_rigidity_micronewton_m;
    let rigidity = rigidity.map(|value| {
        let at = at.key("bending_rigidity_micronewton_m");
        sized(&at, value, 0.01..=2000.0, "µN·m", &[])
    });
    Ok(FastReadings {
        extensions: [
            extension("e5_percent", table.e5_percent)?,
            extension("e20_percent", table.e20_percent)?,
            extension("e100_percent", table.e100_percent)?,
        ],
        bias,
        length: sized(
            &at.key("bending_length_mm"),
            table.bending_length_mm,
            5.0..=100.0,
            "mm",
            &[(10.0, "cm")],
        )?,
        rigidity: rigidity.transpose()?,
    })
}

fn unfit(at: &At<'_>, error: Unfit) -> SceneError {
    at.error(Fault::Unfit {
        key: at.name(),
        error,
    })
}
