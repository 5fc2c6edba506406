//! `soen fabric fit`: readings with errors of 1 % give the fabric that they were computed from, and
//! each bad sheet gets its message, with exit code 2 and no file lost.

use crate::trial::{Said, Trial};
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

const KES: &str = r#"name = "suiting"
source = "test"
weight_mg_per_cm2 = 21.0
thickness_mm = 0.62
[kes.warp]
lt = 0.62
wt_gf_cm_per_cm2 = 7.75
rt_percent = 65.0
emt_percent = 5.0
g_gf_per_cm_deg = 0.7
2hg_gf_per_cm = 0.9
2hg5_gf_per_cm = 1.8
b_gf_cm2_per_cm = 0.11
2hb_gf_cm_per_cm = 0.05
miu = 0.18
[kes.weft]
wt_gf_cm_per_cm2 = 9.0
emt_percent = 6.0
g_gf_per_cm_deg = 0.6
b_gf_cm2_per_cm = 0.08
"#;

const FAST: &str = r#"name = "suiting"
source = "test"
weight_g_per_m2 = 210.0
thickness_mm = 0.62
[fast]
eb5_percent = 4.0
[fast.warp]
e5_percent = 0.4
e20_percent = 1.0
e100_percent = 3.0
bending_length_mm = 18.0
[fast.weft]
e5_percent = 0.5
e20_percent = 1.3
e100_percent = 4.0
bending_length_mm = 16.0
bending_rigidity_micronewton_m = 8.44
"#;

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

/// The sheet of paper tests that slips are made in.
const SHEET: &str = r#"name = "mine"
source = "test"
weight_g_per_m2 = 140.0
thickness_mm = 0.5
friction = { body = 0.35, cloth = 0.4 }
[warp]
tension = { csv = "curve.csv" }
bending = { overhang_face_cm = [1.7, 1.8], overhang_back_cm = [1.7] }
shear = { csv = "shear.csv", load_gf = 20.0, width_cm = 20.0 }
[weft]
tension = { csv = "curve.csv" }
bending = { overhang_face_cm = [1.7], overhang_back_cm = [1.7] }
shear = { csv = "shear.csv", load_gf = 20.0, width_cm = 20.0 }
"#;

const CURVE: &str =
    "strain_percent,tension_gf_per_cm\n1.0,1.0\n2.0,5.6\n3.0,15.6\n4.0,31.2\n5.0,52.0\n6.0,88.0\n";
const SHEAR: &str = "angle_deg,force_gf\n1.0,6.6\n2.0,13.3\n3.0,19.9\n4.0,26.6\n5.0,33.2\n4.0,25.6\n3.0,18.9\n2.0,12.3\n1.0,5.6\n";

/// The file, what stands in it, what is written in its place, and what the message must say.
type Slip = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

const IN_SHEETS: &[Slip] = &[
    (
        "sheet.toml",
        "weight_g_per_m2 = 140.0",
        "weight_gf_per_cm2 = 140.0",
        &[
            "sheet.toml:3:21: weight_gf_per_cm2 is 140.0; allowed: 0.0005 to 0.2 gf/cm² \
             (looks like g/m² or mg/cm²)",
            "^^^^^",
        ],
    ),
    (
        "sheet.toml",
        "weight_g_per_m2 = 140.0",
        "weight_g_per_m2 = 0.014",
        &["allowed: 5 to 2000 g/m² (looks like gf/cm²)"],
    ),
    (
        "sheet.toml",
        "weight_g_per_m2 = 140.0",
        "",
        &["missing key \"one of weight_gf_per_cm2, weight_g_per_m2, weight_mg_per_cm2\""],
    ),
    (
        "sheet.toml",
        "weight_g_per_m2 = 140.0",
        "weight_g_per_m2 = 140.0\nweight_mg_per_cm2 = 14.0",
        &["weight_g_per_m2, weight_mg_per_cm2 exclude each other"],
    ),
    (
        "sheet.toml",
        "thickness_mm = 0.5",
        "thickness_cm = 5.0",
        &["thickness_cm is 5.0; allowed: 0.001 to 1 cm (looks like mm)"],
    ),
    (
        "sheet.toml",
        "thickness_mm = 0.5",
        "thicknes_mm = 0.5",
        &[":4:1: unknown key \"thicknes_mm\"; did you mean \"thickness_mm\"?"],
    ),
    (
        "sheet.toml",
        "thickness_mm = 0.5",
        "thickness_mm = 0,5",
        &["not valid TOML"],
    ),
    (
        "sheet.toml",
        "cloth = 0.4",
        "cloth = nan",
        &["friction.cloth is nan; allowed: 0 to 5"],
    ),
    (
        "sheet.toml",
        "[weft]\ntension = { csv = \"curve.csv\" }\nbending = { overhang_face_cm = [1.7], overhang_back_cm = [1.7] }\nshear = { csv = \"shear.csv\", load_gf = 20.0, width_cm = 20.0 }\n",
        "",
        &["the warp alone is measured; allowed: warp and weft, cloth hangs by both"],
    ),
    (
        "sheet.toml",
        "csv = \"curve.csv\"",
        "csv = \"none.csv\"",
        &["sheet.toml:7:19: warp.tension.csv is \"none.csv\": no such file; tried none.csv"],
    ),
    (
        "sheet.toml",
        "csv = \"curve.csv\"",
        "csv = \"curve.csv\", up_to_strain_percent = 200",
        &["warp.tension.up_to_strain_percent is 200; allowed: 0 to 100 %"],
    ),
    (
        "sheet.toml",
        "csv = \"curve.csv\"",
        "csv = \"curve.csv\", up_to_strain_percent = 3.0",
        &["warp.tension.csv: 3 points that pull"],
    ),
    (
        "sheet.toml",
        "[1.7, 1.8]",
        "[77, 78]",
        &["warp.bending.overhang_face_cm[1] is 77; allowed: 0.3 to 40 cm (looks like mm)"],
    ),
    (
        "sheet.toml",
        "overhang_face_cm = [1.7, 1.8], overhang_back_cm = [1.7]",
        "",
        &["no overhang; allowed: one or more"],
    ),
    (
        "sheet.toml",
        "[1.7, 1.8]",
        "[1.7, -1.8]",
        &["overhang_face_cm[2] is -1.8; allowed"],
    ),
    (
        "sheet.toml",
        "overhang_back_cm = [1.7] }\nshear",
        "overhang_back_cm = [1.7], angle_deg = 0.724 }\nshear",
        &["warp.bending.angle_deg is 0.724; allowed: 5 to 85 degrees (looks like radians)"],
    ),
    (
        "sheet.toml",
        "overhang_back_cm = [1.7] }\nshear",
        "overhang_back_cm = [1.7], angle_deg = 30.0, relation = \"paper\" }\nshear",
        &["warp.bending.relation: the paper's relation (2) holds at 41.5 degrees, not at 30"],
    ),
    (
        "sheet.toml",
        "overhang_back_cm = [1.7] }\nshear",
        "overhang_back_cm = [1.7], relation = \"pierce\" }\nshear",
        &["warp.bending.relation is \"pierce\"; allowed: \"paper\", \"peirce\", \"exact\""],
    ),
    (
        "sheet.toml",
        "load_gf = 20.0",
        "load_gf = 20000.0",
        &["warp.shear.load_gf is 20000.0; allowed: 0 to 5000 gf"],
    ),
    (
        "sheet.toml",
        "load_gf = 20.0",
        "load_gf = 2000.0",
        &[
            "warp.shear.csv: the force rises by",
            "less than the load's own part",
        ],
    ),
    (
        "sheet.toml",
        "width_cm = 20.0 }",
        "width_cm = 200.0 }",
        &["warp.shear.width_cm is 200.0; allowed: 0.5 to 50 cm (looks like mm)"],
    ),
    (
        "sheet.toml",
        "width_cm = 20.0 }",
        "width_cm = 20.0, from_deg = 6.0 }",
        &["warp.shear.from_deg is 6.0; allowed: below to_deg, 5"],
    ),
];

const IN_RECORDS: &[Slip] = &[
    (
        "curve.csv",
        "strain_percent",
        "strain",
        &[
            "curve.csv:3:1: column strain is 2.0; allowed: -0.1 to 1 (looks like percent: name the \
             column strain_percent)",
        ],
    ),
    (
        "curve.csv",
        "tension_gf_per_cm",
        "tension",
        &[
            "curve.csv:1:1: no column tension_gf_per_cm, tension_n_per_m, force_gf, force_n; the \
             header has strain_percent, tension; did you mean \"tension_n_per_m\"?",
        ],
    ),
    (
        "curve.csv",
        "strain_percent",
        "elongation_mm",
        &["missing key \"gauge_cm (for the column elongation_mm)\" in [warp.tension]"],
    ),
    (
        "curve.csv",
        "2.0,5.6",
        "2,0,5,6",
        &["curve.csv:3:1: 4 values under 2 columns (decimal commas? write decimal points)"],
    ),
    (
        "curve.csv",
        "2.0,5.6",
        "\"2,0\",5.6",
        &["column strain_percent is \"2,0\"; allowed: a number with a decimal point"],
    ),
    ("curve.csv", "2.0,5.6", "2.0", &["1 values under 2 columns"]),
    (
        "curve.csv",
        "2.0,5.6",
        "2.0,NaN",
        &["curve.csv:3:5: column tension_gf_per_cm is \"NaN\"; allowed: a finite number"],
    ),
    (
        "curve.csv",
        "2.0,5.6",
        "2.0,five",
        &["is \"five\"; allowed: a number", "3 | 2.0,five", "^^^^"],
    ),
    (
        "curve.csv",
        "\n4.0,31.2\n5.0,52.0\n6.0,88.0",
        "",
        &["warp.tension.csv: 3 points that pull, on the way up and within the range; allowed: 4"],
    ),
    (
        "curve.csv",
        "\n1.0,1.0\n2.0,5.6\n3.0,15.6\n4.0,31.2\n5.0,52.0\n6.0,88.0\n",
        "\n",
        &["curve.csv: has no readings"],
    ),
    ("curve.csv", CURVE, "", &["curve.csv: has no readings"]),
    ("curve.csv", CURVE, "\u{0}", &["curve.csv: is binary"]),
    (
        "curve.csv",
        CURVE,
        "strain_percent,tension_gf_per_cm\n0.01,1.0\n0.02,5.6\n0.03,15.6\n0.04,31.2\n",
        &[
            "column strain_percent is 0.04; allowed: a greatest strain of 0.2 or more",
            "(looks like a fraction: name the column strain)",
        ],
    ),
    (
        "curve.csv",
        CURVE,
        "tension_gf_per_cm,strain_percent\n1.0,1.0\n2.0,5.6\n3.0,15.6\n4.0,31.2\n5.0,52.0\n6.0,88.0\n",
        &[
            "warp.tension.csv: the curve flattens as it rises",
            "exchanged",
        ],
    ),
    (
        "shear.csv",
        "angle_deg",
        "degrees",
        &["shear.csv:1:1: no column angle_deg, displacement_mm, displacement_cm"],
    ),
    (
        "shear.csv",
        "angle_deg",
        "displacement_mm",
        &["missing key \"gap_cm (for the column displacement_mm)\""],
    ),
    (
        "shear.csv",
        SHEAR,
        "angle_deg,force_gf\n1.0,5.6\n2.0,12.3\n3.0,18.9\n4.0,25.6\n5.0,33.2\n4.0,26.6\n3.0,19.9\n2.0,13.3\n1.0,6.6\n",
        &[
            "warp.shear.csv: the hysteresis is -0.0",
            "the way back lies above the way out",
        ],
    ),
    (
        "shear.csv",
        SHEAR,
        "angle_deg,force_gf\n0.017,6.6\n0.035,13.3\n0.052,19.9\n0.07,26.6\n",
        &[
            "column angle_deg is 0.07; allowed: a greatest angle of 0.5",
            "(looks like radians)",
        ],
    ),
    (
        "shear.csv",
        SHEAR,
        "angle_deg,force_gf\n1.0,6.6\n2.0,13.3\n3.0,19.9\n",
        &["warp.shear.csv: 3 readings within the angles; allowed: 4 or more"],
    ),
];

const IN_KES: &[Slip] = &[
    (
        "sheet.toml",
        "lt = 0.62",
        "lt = 0.9",
        &[
            "kes.warp.lt: LT 0.9 and WT 7.75 contradict each other: with EMT 5 %",
            "= 11.250",
        ],
    ),
    (
        "sheet.toml",
        "lt = 0.62\nwt_gf_cm_per_cm2 = 7.75",
        "lt = 1.08",
        &["kes.warp.lt: LT is 1.080; allowed: 0.17 to 1"],
    ),
    (
        "sheet.toml",
        "lt = 0.62\nwt_gf_cm_per_cm2 = 7.75",
        "",
        &["missing key \"one of lt, wt_gf_cm_per_cm2\" in [kes.warp]"],
    ),
    (
        "sheet.toml",
        "2hg_gf_per_cm = 0.9",
        "2hg_gf_per_cm = -0.9",
        &["kes.warp.2hg_gf_per_cm is -0.9; allowed: 0 to 200 gf/cm"],
    ),
    (
        "sheet.toml",
        "2hb_gf_cm_per_cm = 0.05",
        "2hb_gf_cm_per_cm = -0.05",
        &["kes.warp.2hb_gf_cm_per_cm is -0.05; allowed: 0 to 20"],
    ),
    (
        "sheet.toml",
        "rt_percent = 65.0",
        "rt_percent = 165.0",
        &["kes.warp.rt_percent is 165.0; allowed: 0 to 100 %"],
    ),
    (
        "sheet.toml",
        "emt_percent = 5.0",
        "emt_percent = 0.05",
        &["kes.warp.emt_percent is 0.05; allowed: 0.3 to 100 % (looks like a fraction)"],
    ),
    (
        "sheet.toml",
        "emt_percent = 5.0",
        "emt = 5.0",
        &["unknown key \"emt\" in [kes.warp]; did you mean \"emt_percent\"?"],
    ),
    (
        "sheet.toml",
        "[kes.weft]\nwt_gf_cm_per_cm2 = 9.0\nemt_percent = 6.0\ng_gf_per_cm_deg = 0.6\nb_gf_cm2_per_cm = 0.08\n",
        "",
        &["the warp alone is measured; allowed: warp and weft, cloth hangs by both in [kes]"],
    ),
    (
        "sheet.toml",
        "[kes.warp]",
        "[fast]\neb5_percent = 4.0\n[kes.warp]",
        &["kes, fast exclude each other"],
    ),
];

const IN_FAST: &[Slip] = &[
    (
        "sheet.toml",
        "e20_percent = 1.0",
        "e20_percent = 0.3",
        &["fast.warp.e5_percent: E5 0.4 %, E20 0.3 % and E100 3 % contradict each other"],
    ),
    (
        "sheet.toml",
        "micronewton_m = 8.44",
        "micronewton_m = 12.0",
        &[
            "bending rigidity 12 µN·m and bending length 16 mm contradict each other",
            "8.435",
        ],
    ),
    (
        "sheet.toml",
        "bending_length_mm = 18.0",
        "bending_length_mm = 1.8",
        &["fast.warp.bending_length_mm is 1.8; allowed: 5 to 100 mm (looks like cm)"],
    ),
    (
        "sheet.toml",
        "eb5_percent = 4.0",
        "eb5_percent = 0.0",
        &["fast.eb5_percent is 0.0; allowed: 0.05 to 80 %"],
    ),
];

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
