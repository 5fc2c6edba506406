//! Drapes that mathematics knows, run as scenes. Values are from the continuum and from perfect
//! rod chains, computed without any lattice code (reference.json, by section).

use crate::specimen::{fabric, hang};
use Cut::{Warp, Weft};
use soen::{
    fabric::{Direction, Tension},
    math::Vec3,
    solver::Settled,
};

/// A direction in which a strip is cut: which way its length runs.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cut {
    Warp,
    Weft,
}

impl Cut {
    fn of(self, cloth: &soen::fabric::Fabric) -> &Direction {
        match self {
            Warp => &cloth.warp,
            Weft => &cloth.weft,
        }
    }

    /// The cloth's table of a strip two cells wide, lengthwise along x in space.
    fn strip(self, fabric: &str, length: f64, pitch: f64) -> String {
        let wide = 2.0 * pitch;
        let (size, axes) = match self {
            Warp => ([length, wide], "x_axis = [1, 0, 0]\ny_axis = [0, 1, 0]"),
            Weft => ([wide, length], "x_axis = [0, -1, 0]\ny_axis = [1, 0, 0]"),
        };
        format!(
            "[cloth]\nfabric = \"{fabric}\"\nsize_cm = {size:?}\nspacing_cm = {pitch}\n{axes}\n"
        )
    }

    /// The edges at the strip's start and end.
    fn ends(self) -> [&'static str; 2] {
        match self {
            Warp => ["x-min", "x-max"],
            Weft => ["y-min", "y-max"],
        }
    }
}

/// `T(s) = W·(L − s)` stretches a hanging strip; in a lattice, rod k bears the weight of all below
/// its middle, the last node a half: `Σ b·(W·(L − (k+½)·b)/A)^(1/(B+1))`.
#[test]
fn a_hanging_strip_is_as_long_as_its_own_weight_makes_it() {
    // Elongation of the continuum [cm], by fabric, direction and length [cm] (a_hanging_strip).
    let strips = [
        ("a", Warp, 20.0, 0.107642532204),
        ("a", Warp, 100.0, 0.976858566468),
        ("a", Weft, 20.0, 0.139720996672),
        ("a", Weft, 100.0, 1.13773409109),
        ("c", Warp, 20.0, 0.0951001088929),
        ("c", Warp, 100.0, 0.844856914834),
        ("c", Weft, 20.0, 0.19768260574),
        ("c", Weft, 100.0, 1.79397439753),
        ("d", Warp, 20.0, 0.145493362774),
        ("d", Warp, 100.0, 1.4224948015),
        ("d", Weft, 20.0, 0.191112446909),
        ("d", Weft, 100.0, 1.98596968868),
    ];
    for (name, cut, length, continuum) in strips {
        let [top, _] = cut.ends();
        let pitch = length / 60.0;
        let held = format!("[[hold]]\nedge = \"{top}\"\n");
        let rest = at_rest(&(cut.strip(name, length, pitch) + &held));
        let grown = -rest.shape.lowest - length;
        let column = column_elongation(name, cut, length, pitch);
        let (of_column, of_continuum) = (grown / column - 1.0, grown / continuum - 1.0);
        let strip = format!("{name} {cut:?} {length} cm: {grown} cm");
        assert!(of_column.abs() <= 1e-4, "{strip}, column {column}");
        assert!(of_continuum.abs() <= 2e-3, "{strip}, continuum {continuum}");
    }
}

fn column_elongation(name: &str, cut: Cut, length: f64, pitch: f64) -> f64 {
    let cloth = fabric(name);
    let Tension::Power { a, b } = cut.of(&cloth).tension else {
        panic!("the fabrics of table 2 follow (1)")
    };
    let rods = (length / pitch).round() as usize;
    let strain = |k: usize| {
        let below = length - (k as f64 + 0.5) * pitch;
        (cloth.weight * below / a).powf(1.0 / (b + 1.0))
    };
    (0..rods).map(|k| pitch * strain(k)).sum()
}

/// A strip clamped level bends as a rod chain whose root joint has half a cell.
#[test]
fn a_clamped_strip_bends_as_a_rod_chain_and_nears_the_heavy_elastica() {
    // Tip [x, drop] of the chain at pitch 0.5 and 0.25 (b2_chain_discretisation,
    // extensible_half_cell_root) and of the extensible elastica (b_elastica_cantilever) [cm].
    let strips = [
        (
            "a",
            Warp,
            4.0,
            [
                [1.160984, 3.624782],
                [1.181915, 3.584414],
                [1.187859, 3.570674],
            ],
        ),
        (
            "a",
            Warp,
            8.0,
            [
                [0.651874, 7.821583],
                [0.684559, 7.768339],
                [0.693181, 7.748971],
            ],
        ),
        (
            "a",
            Weft,
            4.0,
            [
                [1.161468, 3.629894],
                [1.182420, 3.589424],
                [1.188354, 3.575645],
            ],
        ),
        (
            "a",
            Weft,
            8.0,
            [
                [0.652274, 7.833187],
                [0.685026, 7.779808],
                [0.693648, 7.760384],
            ],
        ),
        (
            "c",
            Warp,
            4.0,
            [
                [0.586458, 3.840814],
                [0.624894, 3.783438],
                [0.635018, 3.761058],
            ],
        ),
        (
            "c",
            Warp,
            8.0,
            [
                [0.340826, 7.949017],
                [0.395956, 7.889350],
                [0.412044, 7.858365],
            ],
        ),
        (
            "c",
            Weft,
            4.0,
            [
                [0.429547, 3.912977],
                [0.478596, 3.852225],
                [0.492102, 3.824415],
            ],
        ),
        (
            "c",
            Weft,
            8.0,
            [
                [0.245249, 8.011554],
                [0.306582, 7.958345],
                [0.328109, 7.921075],
            ],
        ),
        (
            "d",
            Warp,
            4.0,
            [
                [2.861201, 2.629223],
                [2.872539, 2.606271],
                [2.876197, 2.598605],
            ],
        ),
        (
            "d",
            Warp,
            8.0,
            [
                [1.637785, 7.441621],
                [1.649709, 7.414344],
                [1.653329, 7.405242],
            ],
        ),
        (
            "d",
            Weft,
            4.0,
            [
                [2.455879, 2.967183],
                [2.469138, 2.941893],
                [2.473358, 2.933447],
            ],
        ),
        (
            "d",
            Weft,
            8.0,
            [
                [1.335493, 7.562147],
                [1.350037, 7.530067],
                [1.354328, 7.519337],
            ],
        ),
    ];
    for (name, cut, length, [at_half, at_quarter, elastica]) in strips {
        let of_half = check_tip(name, cut, length, 0.5, at_half, elastica);
        let of_quarter = check_tip(name, cut, length, 0.25, at_quarter, elastica);
        assert!(
            of_quarter <= 0.5 * of_half,
            "{name} {cut:?} {length} cm: from the elastica by {of_half}, then {of_quarter} cm"
        );
    }
}

/// Holds a tip to its chain's [x, drop]; returns how far it is from the elastica's [cm].
fn check_tip(
    name: &str,
    cut: Cut,
    length: f64,
    pitch: f64,
    chain: [f64; 2],
    elastica: [f64; 2],
) -> f64 {
    let [root, _] = cut.ends();
    let held = format!("[[hold]]\nedge = \"{root}\"\nclamp = true\n");
    let rest = at_rest(&(cut.strip(name, length, pitch) + &held));
    let end = end(&rest, cut);
    let tip = [end.x + 0.5 * length, -end.z];
    let away = |[x, drop]: [f64; 2]| (tip[0] - x).hypot(tip[1] - drop);
    let error = away(chain);
    assert!(
        error <= 0.005,
        "{name} {cut:?} {length} cm at {pitch}: {tip:?}, chain {chain:?}"
    );
    away(elastica)
}

/// The middle node of the strip's far end [cm].
fn end(rest: &Settled, cut: Cut) -> Vec3 {
    let along = |node: usize| {
        let [i, j] = rest.lattice.grid[node];
        match cut {
            Warp => (i, (j - 1).abs()),
            Weft => (j, (i - 1).abs()),
        }
    };
    let far = (0..rest.positions.len()).max_by_key(|node| (along(*node).0, -along(*node).1));
    rest.positions[far.unwrap()]
}

/// A strip of 120 cm over a span of 100 cm without bending.
#[test]
fn a_strip_between_two_hands_hangs_in_a_catenary() {
    // Sag [cm] (c_catenary, extensible).
    let strips = [
        ("a", Warp, 30.28528322),
        ("a", Weft, 30.44097478),
        ("c", Warp, 30.14385067),
        ("c", Weft, 31.13335609),
        ("d", Warp, 30.7600072),
        ("d", Weft, 31.3473855),
    ];
    for (name, cut, sag) in strips {
        let [start, end] = cut.ends();
        let held = format!(
            "[[hold]]\nedge = \"{start}\"\n[[hold]]\nedge = \"{end}\"\nmove_cm = [-20, 0, 0]\n\
             [solve]\nlaws = [\"tension\", \"shear\"]\n"
        );
        let rest = at_rest(&(cut.strip(name, 120.0, 1.5) + &held));
        let error = -rest.shape.lowest / sag - 1.0;
        assert!(
            error.abs() <= 1e-3,
            "{name} {cut:?}: sag {}, {sag}",
            -rest.shape.lowest
        );
    }
}

/// What a scene is certified to come to.
fn at_rest(text: &str) -> Settled {
    let rest = hang(text, 1000);
    assert!(rest.converged, "{:?}\n{text}", rest.certificate);
    rest
}
