//! Sheets that are right, the slips that are made in them, and what is said of each.

pub(crate) const KES: &str = r#"name = "suiting"
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

pub(crate) const FAST: &str = r#"name = "suiting"
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

/// The sheet of paper tests that slips are made in.
pub(crate) const SHEET: &str = r#"name = "mine"
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

pub(crate) const CURVE: &str =
    "strain_percent,tension_gf_per_cm\n1.0,1.0\n2.0,5.6\n3.0,15.6\n4.0,31.2\n5.0,52.0\n6.0,88.0\n";
pub(crate) const SHEAR: &str = "angle_deg,force_gf\n1.0,6.6\n2.0,13.3\n3.0,19.9\n4.0,26.6\n5.0,33.2\n4.0,25.6\n3.0,18.9\n2.0,12.3\n1.0,5.6\n";

/// The file, what stands in it, what is written in its place, and what the message must say.
pub(crate) type Slip = (
    &'static str,
    &'static str,
    &'static str,
    &'static [&'static str],
);

pub(crate) const IN_SHEETS: &[Slip] = &[
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
        "csv = \"curve.csv\", slack_percent = -1",
        &["warp.tension.slack_percent is -1; allowed: 0 to 100 %"],
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

pub(crate) const IN_RECORDS: &[Slip] = &[
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
    (
        "curve.csv",
        CURVE,
        "strain_percent;force_n\n1.0;250\n2.0;1400\n3.0;3900\n4.0;7800\n5.0;13000\n",
        &["missing key \"width_cm (for the column force_n)\" in [warp.tension]"],
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

pub(crate) const IN_KES: &[Slip] = &[
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

pub(crate) const IN_FAST: &[Slip] = &[
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
