//! `soen lab`: one slip each gets exit code 2 and a message; what is right gets its files.

use crate::trial::Trial;
use std::fs;

/// What is asked of `soen lab`, and what the message must say.
const SLIPS: &[(&str, &[&str])] = &[
    ("", &["Usage: soen lab"]),
    (
        "cantilver --fabric c",
        &["unrecognized subcommand", "'cantilever'"],
    ),
    ("cantilever", &["--fabric <NAME>"]),
    (
        "cantilever --fabric cc",
        &[
            "fabric is \"cc\"; allowed: a, b, c, d, washi",
            "did you mean \"c\"?",
        ],
    ),
    (
        "cantilever --fabric c --direction bias",
        &["'bias'", "[possible values: warp, weft]"],
    ),
    (
        "cantilever --fabric c --overhang 0",
        &["overhang [cm] is 0; allowed: 0.01 to 1000"],
    ),
    (
        "cantilever --fabric c --overhang=-1",
        &["overhang [cm] is -1; allowed: 0.01 to 1000"],
    ),
    (
        "cantilever --fabric c --overhang nan",
        &["overhang [cm] is NaN; allowed: 0.01 to 1000"],
    ),
    (
        "cantilever --fabric c --overhang 1e9",
        &["overhang [cm] is 1000000000; allowed: 0.01 to 1000"],
    ),
    (
        "cantilever --fabric c --overhang eight",
        &["'eight'", "invalid float"],
    ),
    (
        "cantilever --fabric c --overhang 8 --pitch 9",
        &["pitch [cm] is 9; allowed: 0.008 to 8"],
    ),
    (
        "cantilever --fabric c --overhang 8 --pitch 0",
        &["pitch [cm] is 0; allowed"],
    ),
    (
        "cantilever --fabric c --overhang 8 --pitch 1e-5",
        &["pitch [cm] is 0.00001; allowed"],
    ),
    (
        "cantilever --fabric c --overhang 8 --pitch inf",
        &["pitch [cm] is inf; allowed"],
    ),
    (
        "cantilever --fabric c --pitch 0",
        &["pitch [cm] is 0; allowed: 0.0086 to 0.8586"],
    ),
    (
        "cantilever --fabric c --pitch=-1",
        &["pitch [cm] is -1; allowed"],
    ),
    (
        "cantilever --fabric c --pitch nan",
        &["pitch [cm] is NaN; allowed"],
    ),
    (
        "cantilever --fabric c --pitch 1e-5",
        &["pitch [cm] is 0.00001; allowed"],
    ),
    (
        "cantilever --fabric c --pitch 5",
        &["pitch [cm] is 5; allowed"],
    ),
    (
        "strip --fabric c --length 0",
        &["length [cm] is 0; allowed: 0.1 to 1000"],
    ),
    (
        "strip --fabric c --length 20 --pitch 21",
        &["pitch [cm] is 21; allowed: 0.01 to 20"],
    ),
    (
        "strip --fabric c --pitch 1e-5",
        &["pitch [cm] is 0.00001; allowed: 0.01 to 20"],
    ),
    (
        "strip --fabric c --pull 0",
        &["strain [-] is 0; allowed: 0.000001 to 2"],
    ),
    (
        "strip --fabric c --pull 10",
        &["strain [-] is 10; allowed: 0.000001 to 2"],
    ),
    (
        "strip --fabric c --pull 0.1 --length 0",
        &["length [cm] is 0; allowed"],
    ),
    (
        "strip --fabric c --pull 0.1 --pitch 1e-4",
        &["pitch [cm] is 0.0001; allowed"],
    ),
    (
        "shear --fabric c --load=-1",
        &["load [gf] is -1; allowed: 0 to 100000"],
    ),
    (
        "shear --fabric c --load nan",
        &["load [gf] is NaN; allowed"],
    ),
    (
        "shear --fabric c --angle 0",
        &["angle [deg] is 0; allowed: 0.1 to 30"],
    ),
    (
        "shear --fabric c --angle 90",
        &["angle [deg] is 90; allowed: 0.1 to 30"],
    ),
    (
        "shear --fabric c --pitch 0.001",
        &["pitch [cm] is 0.001; allowed: 0.05 to 5"],
    ),
    (
        "heart-loop --fabric c --length 0",
        &["length [cm] is 0; allowed: 5.1"],
    ),
    (
        "heart-loop --fabric c --length 1e9",
        &["length [cm] is 1000000000; allowed: 5.1"],
    ),
    (
        "heart-loop --fabric c --length 10 --pitch 0.001",
        &["pitch [cm] is 0.001; allowed: 0.01 to 0.5"],
    ),
    (
        "drapemeter --fabric c --seeds 0",
        &["'0'", "0 is not in 1..=1000"],
    ),
    (
        "drapemeter --fabric c --seeds 1 --pitch 0",
        &["pitch [cm] is 0; allowed: 0.075 to 7.5"],
    ),
    (
        "drapemeter --fabric c --seeds 1 --pitch 8",
        &["pitch [cm] is 8; allowed"],
    ),
    (
        "slope --fabric c --friction=-1",
        &["friction [-] is -1; allowed: 0.01 to 2"],
    ),
    (
        "slope --fabric c --friction 0",
        &["friction [-] is 0; allowed"],
    ),
    (
        "slope --fabric c --pitch 1e-3",
        &["pitch [cm] is 0.001; allowed: 0.16 to 4"],
    ),
    (
        "capstan --fabric c --friction=-0.1",
        &["friction [-] is -0.1; allowed: 0.01 to 1"],
    ),
    (
        "capstan --fabric c --pitch 1e-3",
        &["pitch [cm] is 0.001; allowed: 0.05 to 2.5"],
    ),
    (
        "bias-bend --fabric c --twist=-1",
        &["twist modulus [gf·cm] is -1; allowed: 0 to 10000"],
    ),
    (
        "bias-bend --fabric c --twist nan",
        &["twist modulus [gf·cm] is NaN; allowed"],
    ),
    (
        "bias-bend --fabric c --pitch 1e-5",
        &["pitch [cm] is 0.00001; allowed: 0.0080 to 0.4024"],
    ),
    (
        "bias-bend --fabric c --pitch nan",
        &["pitch [cm] is NaN; allowed"],
    ),
    (
        "buckling --fabric c",
        &["twist modulus [gf·cm] is 0; allowed: 0.000000001 to 10000"],
    ),
    (
        "buckling --fabric c --twist=-1",
        &["twist modulus [gf·cm] is -1; allowed"],
    ),
    (
        "buckling --fabric c --twist nan",
        &["twist modulus [gf·cm] is NaN; allowed"],
    ),
    (
        "buckling --fabric c --twist 0.008 --pitch 5",
        &["pitch [cm] is 5; allowed: 0.0099 to 0.1979"],
    ),
    (
        "buckling --fabric c --pitch 0.1",
        &["twist modulus [gf·cm] is 0; allowed: 0.000000001 to 10000"],
    ),
    (
        "stick-slip --fabric c --pitch 2",
        &["pitch [cm] is 2; allowed: 0.1000 to 1.0000"],
    ),
    (
        "stick-slip --fabric c --pitch nan",
        &["pitch [cm] is NaN; allowed"],
    ),
    (
        "resolution --fabric d --pitch 9",
        &["pitch [cm] is 9; allowed: 0.4 to 3"],
    ),
    (
        "resolution --fabric d --pitch nan",
        &["pitch [cm] is NaN; allowed"],
    ),
    (
        "resolution --fabric d --seeds 0",
        &["'0'", "0 is not in 1..=100"],
    ),
    (
        "resolution --fabric no-such-cloth",
        &["fabric is \"no-such-cloth\"; allowed: a, b, c, d, washi"],
    ),
    ("verify --quicker", &["unexpected argument '--quicker'"]),
    (
        "stick-slip --fabric c --friction=-1",
        &["friction [-] is -1; allowed: 0.02 to 0.37"],
    ),
    (
        "stick-slip --fabric c --friction 0.4",
        &["friction [-] is 0.4; allowed"],
    ),
];

#[test]
fn settings_out_of_range_are_shown_with_the_range() {
    let mut wrong = Vec::new();
    for (asked, says) in SLIPS {
        let trial = Trial::new();
        let wish = core::iter::once("lab").chain(asked.split_whitespace());
        let out = (!asked.is_empty()).then_some(["--out", "out", "--json"]);
        let wish: Vec<&str> = wish.chain(out.into_iter().flatten()).collect();
        let said = trial.run(&wish);
        let unsaid = says.iter().find(|part| !said.err.contains(**part));
        if said.code != 2 || unsaid.is_some() || !said.out.is_empty() || !trial.kept() {
            let (code, err) = (said.code, said.err);
            wrong.push(format!("{asked}\n  exit {code}, without {unsaid:?}\n{err}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const READINGS: &[&str] = &[
    "strip --fabric c --length 5 --pitch 0.5",
    "strip --fabric c --pull 0.05 --length 5",
    "cantilever --fabric c --overhang 4 --pitch 0.5",
    "cantilever --fabric c --pitch 0.2",
    "shear --fabric c --angle 1 --pitch 2.5",
    "heart-loop --fabric washi --pitch 1.2",
    "drapemeter --fabric d --seeds 1 --pitch 2",
    "slope --fabric c --pitch 2",
    "buckling --fabric c --twist 0.008 --rigid",
    "buckling --fabric c --twist 0.008 --rigid --pitch 0.06",
    "bias-bend --fabric c --pitch 0.2",
];

#[test]
fn a_folder_that_cannot_be_written_is_named_before_the_work() {
    for asked in [
        "verify",
        "drapemeter --fabric washi",
        "resolution --fabric d",
    ] {
        let trial = Trial::new();
        fs::write(trial.path().join("taken"), "mine").unwrap();
        let wish = core::iter::once("lab").chain(asked.split_whitespace());
        let wish: Vec<&str> = wish.chain(["--out", "taken"]).collect();
        let said = trial.run(&wish);
        assert_ne!(said.code, 0, "{asked}");
        assert!(said.err.contains("taken"), "{asked}: {}", said.err);
        assert!(said.out.is_empty(), "{asked}: {}", said.out);
        let kept = fs::read_to_string(trial.path().join("taken")).unwrap();
        assert_eq!(kept, "mine");
    }
}

#[test]
fn every_reading_is_of_finite_numbers() {
    let trial = Trial::new();
    for asked in READINGS {
        let wish = core::iter::once("lab").chain(asked.split_whitespace());
        let wish: Vec<&str> = wish.chain(["--json"]).collect();
        let said = trial.run(&wish);
        assert_eq!(said.code, 0, "{asked}: {}", said.err);
        check_figures(asked, &said.out);
    }
    assert!(trial.kept());
}

#[test]
fn an_instrument_that_draws_a_curve_writes_it_beside_the_shape() {
    check_files("cantilever --fabric c --overhang 4 --pitch 0.5", true);
    check_files("slope --fabric c --pitch 2", false);
}

#[track_caller]
fn check_files(asked: &str, draws: bool) {
    let trial = Trial::new();
    let wish = core::iter::once("lab").chain(asked.split_whitespace());
    let wish: Vec<&str> = wish.chain(["--out", "new/folder", "--json"]).collect();
    let said = trial.run(&wish);
    assert_eq!(said.code, 0, "{asked}: {}", said.err);
    let folder = trial.path().join("new/folder");
    let read = |name: &str| fs::read(folder.join(name)).unwrap();
    assert_eq!(
        said.out.as_bytes(),
        read("reading.json"),
        "the reading alone"
    );
    assert!(read("drape.png").starts_with(b"\x89PNG"), "{asked}");
    assert!(read("drape.obj").starts_with(b"#"), "{asked}");
    assert_eq!(folder.join("curve.svg").exists(), draws, "{asked}");
    assert_eq!(folder.join("curve.csv").exists(), draws, "{asked}");
    if draws {
        let plot = String::from_utf8(read("curve.svg")).unwrap();
        assert!(plot.starts_with("<svg") && !plot.contains("NaN"), "{asked}");
        check_rows(asked, &String::from_utf8(read("curve.csv")).unwrap());
    }
}

#[track_caller]
fn check_figures(asked: &str, json: &str) {
    let reading: serde_json::Value = serde_json::from_str(json).unwrap();
    assert_eq!(reading["format"], "soen-lab/1", "{asked}");
    let name = asked.split_whitespace().next().unwrap();
    assert_eq!(reading["instrument"], name, "{asked}");
    // What is not finite is written as null.
    assert!(!json.contains("null"), "{asked}: {json}");
    let figures = reading.as_object().unwrap().values();
    let count = figures.filter(|value| value.is_number()).count();
    assert!(count >= 2, "{asked}: {json}");
}

#[track_caller]
fn check_rows(asked: &str, csv: &str) {
    let mut lines = csv.lines();
    assert!(lines.next().unwrap().starts_with("line,name,"), "{asked}");
    let mut count = 0;
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let [_, _, x, y] = cells[..] else {
            panic!("{asked}: {line}")
        };
        let point = [x, y].map(|cell| cell.parse::<f64>().unwrap());
        assert!(point.iter().all(|cell| cell.is_finite()), "{asked}: {line}");
        count += 1;
    }
    assert!(count > 1, "{asked}: {csv}");
}

#[test]
fn a_reading_names_its_numbers_with_units_and_says_it_is_certified() {
    let trial = Trial::new();
    let wish = [
        "lab",
        "cantilever",
        "--fabric",
        "c",
        "--overhang",
        "4",
        "--pitch",
        "0.5",
    ];
    let said = trial.run(&wish);
    assert_eq!(said.code, 0, "{}", said.err);
    for part in ["cantilever, Cloth C", "tip_drop_cm", "certified: at rest"] {
        assert!(said.out.contains(part), "without {part:?}:\n{}", said.out);
    }
    assert!(!said.out.contains("NOT"), "{}", said.out);
}

#[cfg(unix)]
#[test]
fn ctrl_c_stops_an_instrument_and_the_reading_says_so() {
    let trial = Trial::new();
    let said = trial.interrupt(&[
        "lab",
        "drapemeter",
        "--fabric",
        "c",
        "--seeds",
        "1",
        "--pitch",
        "0.2",
        "--out",
        "out",
    ]);
    assert_eq!(said.code, 3, "{}", said.err);
    let out = said.out;
    assert!(out.contains("NOT certified"), "{out}");
    let reading = fs::read_to_string(trial.path().join("out/reading.json")).unwrap();
    let reading: serde_json::Value = serde_json::from_str(&reading).unwrap();
    assert_eq!(reading["converged"], false);
}

/// A slope that was stopped once read the last one on which the cloth was seen to lie, as certified.
#[cfg(unix)]
#[test]
fn ctrl_c_leaves_a_search_without_an_answer() {
    let trial = Trial::new();
    for instrument in ["slope", "capstan", "stick-slip"] {
        let said = trial.interrupt(&["lab", instrument, "--fabric", "c", "--friction", "0.3"]);
        assert_eq!(said.code, 1, "{instrument}: {}", said.err);
        assert!(
            said.err.contains("stopped before it was measured"),
            "{}",
            said.err
        );
        assert_eq!(said.out, "");
    }
}
