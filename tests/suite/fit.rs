//! `soen fabric fit`: readings with errors of 1 % give the fabric that they were computed from, and
//! each bad sheet gets its message, with exit code 2 and no file lost.

pub(crate) mod slips;

use crate::trial::{Said, Trial};
use slips::{CURVE, FAST, IN_FAST, IN_KES, IN_RECORDS, IN_SHEETS, KES, SHEAR, SHEET, Slip};
use soen::{
    fabric::{Direction, Fabric, SWATCHES, Tension, Yarn},
    scene,
};
use std::fmt::Write;

/// Errors that look normal: sums of twelve even ones.
struct Noise(u64);

impl Noise {
    fn even(&mut self) -> f64 {
        // Knuth's MMIX generator; its upper bits alone are good.
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// The value with an error whose deviation is 1 % of it.
    fn about(&mut self, value: f64) -> f64 {
        let normal = (0..12).map(|_| self.even()).sum::<f64>() - 6.0;
        value * (1.0 + 0.01 * normal)
    }
}

fn power(direction: &Direction) -> (f64, f64) {
    match direction.tension {
        Tension::Power { a, b } => (a, b),
        _ => panic!("{direction:?}"),
    }
}

/// 150 readings in even steps of strain up to 500 gf/cm, where KES-F ends.
fn curve(direction: &Direction, noise: &mut Noise) -> String {
    let (a, b) = power(direction);
    let greatest = 100.0 * (500.0 / a).powf(1.0 / (b + 1.0));
    let mut csv = "strain_percent,tension_gf_per_cm\n".to_owned();
    for k in 1..=150 {
        let percent = greatest * f64::from(k) / 150.0;
        let tension = noise.about(a * (percent / 100.0).powf(b + 1.0));
        writeln!(csv, "{percent:.6},{tension:.6}").unwrap();
    }
    csv
}

/// Out to 8° and back, to −8° and back, under a tenth of KES-F's load, as the paper asks.
fn shear(direction: &Direction, noise: &mut Noise) -> String {
    let mut csv = "displacement_mm;force_n\n".to_owned();
    for (from, to) in [(0.0, 8.0), (8.0, 0.0), (0.0, -8.0), (-8.0, 0.0_f64)] {
        let sign = if to > from { 1.0 } else { -1.0 };
        for k in 1..=32 {
            let tangent = (from + (to - from) * f64::from(k) / 32.0)
                .to_radians()
                .tan();
            let cloth = direction.shear * (tangent + 0.01 * sign);
            let force = noise.about(20.0 * cloth + 20.0 * tangent) * 9.80665e-3;
            writeln!(csv, "{:.5};{force:.8}", 50.0 * tangent).unwrap();
        }
    }
    csv
}

/// Eight strips, both ends, with one side up.
fn overhangs(weight: f64, direction: &Direction, noise: &mut Noise) -> String {
    let length = 2.0 * (direction.bending / weight).cbrt();
    let readings: Vec<_> = (0..16)
        .map(|_| format!("{:.5}", noise.about(length)))
        .collect();
    format!("[{}]", readings.join(", "))
}

/// A sheet and its records, as a laboratory with errors of 1 % would write them.
fn put_sheet(trial: &Trial, fabric: &Fabric, seed: u64) {
    let mut noise = Noise(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
    let mut sheet = format!(
        "name = \"found\"\nsource = \"test\"\nweight_g_per_m2 = {}\nthickness_mm = {}\n\
         friction = {{ body = 0.35, cloth = 0.4 }}\n",
        1e4 * fabric.weight,
        10.0 * fabric.thickness
    );
    for yarn in [Yarn::Warp, Yarn::Weft] {
        let direction = fabric.along(yarn);
        trial.put(
            &format!("{yarn}.csv"),
            curve(direction, &mut noise).as_bytes(),
        );
        trial.put(
            &format!("shear-{yarn}.csv"),
            shear(direction, &mut noise).as_bytes(),
        );
        let face = overhangs(fabric.weight, direction, &mut noise);
        let back = overhangs(fabric.weight, direction, &mut noise);
        sheet += &format!(
            "[{yarn}]\ntension = {{ csv = \"{yarn}.csv\" }}\n\
             bending = {{ overhang_face_cm = {face}, overhang_back_cm = {back} }}\n\
             shear = {{ csv = \"shear-{yarn}.csv\", load_gf = 20.0, gap_cm = 5.0, width_cm = 20.0 }}\n"
        );
    }
    trial.put("sheet.toml", sheet.as_bytes());
}

fn fit(trial: &Trial) -> Said {
    trial.run(&[
        "fabric",
        "fit",
        "sheet.toml",
        "--out",
        "found.toml",
        "--json",
    ])
}

#[test]
fn readings_with_errors_of_1_percent_give_the_five_fabrics_back() {
    for (name, _) in SWATCHES {
        let truth = scene::fabric(name).unwrap();
        for seed in 1..=3 {
            let trial = Trial::new();
            put_sheet(&trial, &truth, seed);
            let said = fit(&trial);
            assert_eq!(said.code, 0, "{name}: {}", said.err);
            let found = scene::fabric(trial.path().join("found.toml").to_str().unwrap()).unwrap();
            assert!((found.weight / truth.weight - 1.0).abs() < 1e-5);
            for yarn in [Yarn::Warp, Yarn::Weft] {
                is_near(
                    found.along(yarn),
                    truth.along(yarn),
                    &format!("{name} {yarn} {seed}"),
                );
            }
        }
    }
}

#[track_caller]
fn is_near(found: &Direction, truth: &Direction, which: &str) {
    let ((a, b), (true_a, true_b)) = (power(found), power(truth));
    assert!(
        (a / true_a - 1.0).abs() < 0.02,
        "{which}: A {a}, not {true_a}"
    );
    assert!((b - true_b).abs() < 0.02, "{which}: B {b}, not {true_b}");
    let bending = found.bending / truth.bending - 1.0;
    assert!(bending.abs() < 0.02, "{which}: bending {bending:+}");
    // Of cloth B's warp, whose shear is 0, no share can be taken.
    let shear = (found.shear - truth.shear).abs();
    assert!(
        shear < (0.02 * truth.shear).max(0.02),
        "{which}: shear {}",
        found.shear
    );
}

#[test]
fn what_is_printed_is_what_is_written() {
    let trial = Trial::new();
    put_sheet(&trial, &scene::fabric("c").unwrap(), 4);
    let said = fit(&trial);
    let report: serde_json::Value = serde_json::from_str(&said.out).unwrap();
    let found = scene::fabric(trial.path().join("found.toml").to_str().unwrap()).unwrap();
    for yarn in [Yarn::Warp, Yarn::Weft] {
        let direction = found.along(yarn);
        let printed = |key: &str| report[yarn.to_string()][key]["value"].as_f64().unwrap();
        let (a, b) = power(direction);
        for (key, written) in [
            ("a_gf_per_cm", a),
            ("b", b),
            ("bending_gf_cm", direction.bending),
            ("shear_gf_per_cm", direction.shear),
        ] {
            assert!((printed(key) / written - 1.0).abs() < 1e-5, "{yarn} {key}");
        }
    }
    let shown = trial.run(&["fabric", "show", "found.toml"]);
    assert_eq!(shown.code, 0, "{}", shown.err);
    for part in [
        "Found in sheet.toml",
        "(1) by robust least squares of relative errors, warp.csv; ",
        "overhangs, (2) at 41.5 degrees; 32 of 32 readings",
        "(3) and (4), shear-weft.csv",
    ] {
        assert!(shown.out.contains(part), "without {part:?}:\n{}", shown.out);
    }
    for yarn in ["warp", "weft"] {
        let svg = std::fs::read_to_string(trial.path().join(format!("found-{yarn}.svg"))).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("tension [gf/cm]"));
    }
    let again = fit(&trial);
    assert_eq!(again.out, said.out, "the same bytes each time");
}

#[test]
fn the_sheet_that_ships_is_cloth_c() {
    let trial = Trial::new();
    let sheet = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/measurements/cloth-c/sheet.toml"
    );
    let said = trial.run(&["fabric", "fit", sheet, "--out", "new/c.toml"]);
    assert_eq!(said.code, 0, "{}", said.err);
    for part in [
        "Cloth C, fitted",
        "warp",
        "± ",
        "of 151 readings",
        "new/c-weft.svg",
    ] {
        assert!(said.out.contains(part), "without {part:?}:\n{}", said.out);
    }
    let found = scene::fabric(trial.path().join("new/c.toml").to_str().unwrap()).unwrap();
    let truth = scene::fabric("c").unwrap();
    is_near(&found.warp, &truth.warp, "warp");
    is_near(&found.weft, &truth.weft, "weft");
}

#[test]
fn a_kes_f_sheet_becomes_the_fabric_computed_by_hand() {
    let trial = Trial::new();
    trial.put("sheet.toml", KES.as_bytes());
    let said = fit(&trial);
    assert_eq!(said.code, 0, "{}", said.err);
    let found = scene::fabric(trial.path().join("found.toml").to_str().unwrap()).unwrap();
    let (a, b) = power(&found.warp);
    // B = 2/0.62 − 2; the law meets 500 gf/cm at 5 %.
    assert!((b - 1.225_81).abs() < 1e-5);
    assert!((a * 0.05_f64.powf(b + 1.0) / 500.0 - 1.0).abs() < 1e-4);
    // LT = 9/(500·6/200) = 0.6.
    assert!((power(&found.weft).1 - (2.0 / 0.6 - 2.0)).abs() < 1e-5);
    assert_eq!(
        (found.warp.bending, found.weight, found.thickness),
        (0.11, 0.021, 0.062)
    );
    assert!((found.warp.shear - 40.107).abs() < 1e-3);
    assert!(said.out.contains("friction is not measured") && said.out.contains("MIU 0.18"));
}

#[test]
fn a_fast_sheet_becomes_the_fabric_computed_by_hand() {
    let trial = Trial::new();
    trial.put("sheet.toml", FAST.as_bytes());
    let said = fit(&trial);
    assert_eq!(said.code, 0, "{}", said.err);
    let found = scene::fabric(trial.path().join("found.toml").to_str().unwrap()).unwrap();
    assert!((found.warp.bending - 0.021 * 1.8_f64.powi(3)).abs() < 1e-6);
    assert_eq!(found.weft.shear, 31.25);
    let (a, b) = power(&found.warp);
    for (strain, load) in [(0.004_f64, 5.0), (0.01, 20.0), (0.03, 100.0)] {
        assert!((a * strain.powf(b + 1.0) / load - 1.0).abs() < 0.05);
    }
}

#[test]
fn slips_in_a_sheet_are_named() {
    check(SHEET, IN_SHEETS);
}

#[test]
fn slips_in_a_record_are_named() {
    check(SHEET, IN_RECORDS);
}

#[test]
fn slips_in_a_kes_f_sheet_are_named() {
    check(KES, IN_KES);
}

#[test]
fn slips_in_a_fast_sheet_are_named() {
    check(FAST, IN_FAST);
}

#[test]
fn the_sheet_without_a_slip_is_taken() {
    let trial = Trial::new();
    put(&trial, SHEET, None);
    let said = fit(&trial);
    assert_eq!(said.code, 0, "{}", said.err);
}

#[test]
fn a_sheet_must_be_there_and_the_fabric_must_be_a_toml() {
    let trial = Trial::new();
    let said = fit(&trial);
    assert_eq!(
        (said.code, said.err.as_str()),
        (
            2,
            "error: sheet.toml: cannot be read: No such file or directory (os error 2)\n"
        )
    );
    put(&trial, SHEET, None);
    for out in ["found.csv", "found", "sheet.toml", "./sheet.toml"] {
        let said = trial.run(&["fabric", "fit", "sheet.toml", "--out", out]);
        assert_eq!(said.code, 2, "{out}: {}", said.err);
        assert!(said.err.starts_with("error: --out is "), "{}", said.err);
    }
    let said = trial.run(&["fabric", "fit", "sheet.toml", "--out", "curve.csv/x.toml"]);
    assert_eq!(said.code, 1, "{}", said.err);
}

fn put(trial: &Trial, sheet: &str, slip: Option<&Slip>) {
    for (name, text) in [
        ("sheet.toml", sheet),
        ("curve.csv", CURVE),
        ("shear.csv", SHEAR),
    ] {
        let text = match slip {
            Some((file, right, wrong, _)) if *file == name => {
                assert!(text.contains(right), "{right:?} is not in {name}");
                text.replacen(right, wrong, 1)
            }
            _ => text.to_owned(),
        };
        trial.put(name, text.as_bytes());
    }
}

/// Each slip gets its words and exit code 2, and what stood at `--out` still stands there.
#[track_caller]
fn check(sheet: &str, slips: &[Slip]) {
    let mut wrong = Vec::new();
    for slip in slips {
        let trial = Trial::new();
        put(&trial, sheet, Some(slip));
        trial.put("found.toml", b"kept");
        let Said { code, out, err } = fit(&trial);
        let (_, _, written, says) = slip;
        let unsaid = says.iter().find(|part| !err.contains(**part));
        let kept = std::fs::read(trial.path().join("found.toml")).unwrap() == b"kept";
        let plotted = trial.path().join("found-warp.svg").exists();
        if code != 2 || unsaid.is_some() || !out.is_empty() || !kept || plotted {
            wrong.push(format!(
                "{written}\n  exit {code}, without {unsaid:?}\n{err}{out}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
