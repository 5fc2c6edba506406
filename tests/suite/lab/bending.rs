//! Strips that bend: cantilevers, heart loops and bending on the bias.

use super::{YARNS, bending_length, go_on, number, relative, rows, yarn};
use crate::{specimen::fabric, trial::Trial};
use soen::{
    fabric::{Fabric, SWATCHES, Tension, Yarn},
    lab::{BiasBend, Cantilever, HeartLoop, elastica::Heavy},
};

/// Tips (reach, drop) [cm]: without and with stretch (b_elastica_cantilever).
const ELASTICA: &str = "
a warp 2  1.72236773546 0.947698178109  1.72445404928 0.95040684236
a warp 4  1.1868438028 3.55996946639  1.18785894207 3.57067414331
a warp 8  0.691974265291 7.7194032746  0.693181363472 7.74897148291
a warp 15  0.487466346275 14.7994606551  0.48861114497 14.8710269098
a weft 2  1.72236773546 0.947698178109  1.72575037708 0.952044442929
a weft 4  1.1868438028 3.55996946639  1.18835389734 3.57564459086
a weft 8  0.691974265291 7.7194032746  0.693647732506 7.76038390297
a weft 15  0.487466346275 14.7994606551  0.488983087446 14.8943098167
c warp 2  1.1681513703 1.50502719965  1.16903776901 1.50857022115
c warp 4  0.634364384067 3.75100136977  0.635017683695 3.76105754933
c warp 8  0.411371654949 7.83152497998  0.412043665157 7.85836452971
c warp 15  0.294528809233 14.8784906593  0.295149733244 14.9423198663
c weft 2  0.900356472542 1.65508748502  0.901494306603 1.66246923109
c weft 4  0.490971715888 3.8037092469  0.492102256771 3.82441546304
c weft 8  0.327001186891 7.86573489397  0.328108861502 7.92107546474
c weft 15  0.235147605495 14.9029074889  0.236176400611 15.0352875407
d warp 2  1.98172205384 0.25229314968  1.98383451997 0.252867883305
d warp 4  2.87163715072 2.58738386594  2.87619668444 2.59860455709
d warp 8  1.65060019582 7.36876907614  1.6533286035 7.40524152658
d warp 15  1.06808708759 14.5648696276  1.07128373966 14.6585767869
d weft 2  1.96559693168 0.345360681038  1.96821839913 0.346355244751
d weft 4  2.46929134939 2.91868678248  2.47335775291 2.93344685931
d weft 8  1.35120256088 7.47265658879  1.35432828383 7.51933703411
d weft 15  0.900887073205 14.6318635602  0.904432734896 14.7540351296";

#[test]
fn the_heavy_elastica_is_where_taylor_series_and_collocation_put_it() {
    for row in rows::<2, 5>(ELASTICA) {
        let ([name, way], [length, rigid_reach, rigid_drop, reach, drop]) = &row;
        let cloth = fabric(name);
        let strip = Heavy::of(&cloth, yarn(way), *length);
        let unstretched = Heavy {
            tension: None,
            ..strip
        };
        let [of_rigid, of_elastic] = [unstretched.tip(), strip.tip()];
        assert!(
            apart(of_rigid, [*rigid_reach, *rigid_drop]) < 1e-9,
            "{row:?}: {of_rigid:?}"
        );
        // The reference's own collocation agrees to this.
        assert!(
            apart(of_elastic, [*reach, *drop]) < 1e-6,
            "{row:?}: {of_elastic:?}"
        );
    }
}

/// From a tip, level and above the root, to one's reach and drop [cm].
fn apart([x, z]: [f64; 2], [reach, drop]: [f64; 2]) -> f64 {
    (x - reach).hypot(z + drop)
}

/// Tips (reach, drop) [cm] of the rod chain at pitch 0.5, 0.25 and 0.1 (b2_chain_discretisation,
/// extensible_half_cell_root) and of the elastica with stretch (b_elastica_cantilever).
const CHAINS: &str = "
a warp 4  1.160984 3.624782  1.181915 3.584414  1.186952 3.572873  1.187859 3.570674
a warp 8  0.651874 7.821583  0.684559 7.768339  0.691914 7.752071  0.693181 7.748971
a weft 4  1.161468 3.629894  1.182420 3.589424  1.187453 3.577851  1.188354 3.575645
a weft 8  0.652274 7.833187  0.685026 7.779808  0.692385 7.763494  0.693648 7.760384
c warp 4  0.586458 3.840814  0.624894 3.783438  0.633563 3.764654  0.635018 3.761058
c warp 8  0.340826 7.949017  0.395956 7.889350  0.409887 7.863453  0.412044 7.858365
c weft 4  0.429547 3.912977  0.478596 3.852225  0.490252 3.828931  0.492102 3.824415
c weft 8  0.245249 8.011554  0.306582 7.958345  0.325366 7.927476  0.328109 7.921075
d warp 4  2.861201 2.629223  2.872539 2.606271  2.875621 2.599833  2.876197 2.598605
d warp 8  1.637785 7.441621  1.649709 7.414344  1.652769 7.406699  1.653329 7.405242
d weft 4  2.455879 2.967183  2.469138 2.941893  2.472696 2.934800  2.473358 2.933447
d weft 8  1.335493 7.562147  1.350037 7.530067  1.353670 7.521054  1.354328 7.519337";

/// The elastica's tip is (4·t − s)/3 of the tips s and t at a pitch and its half, but for what
/// falls with the fourth power of the pitch.
#[test]
fn a_cantilever_bends_as_its_rod_chain_and_extrapolates_to_the_elastica() {
    let trial = Trial::new();
    for ([name, way], [length, numbers @ ..]) in rows::<2, 9>(CHAINS) {
        let [at_half, at_quarter, at_tenth, elastica] =
            [0, 2, 4, 6].map(|k| [numbers[k], numbers[k + 1]]);
        let bend = |pitch: f64, chain: [f64; 2]| {
            let tip = tip(&trial, &name, &way, length, pitch);
            let axes = [tip[0] - chain[0], tip[1] - chain[1]];
            assert!(
                axes.iter().all(|axis| axis.abs() <= 0.005),
                "{name} {way} {length} cm at {pitch}: {tip:?}, chain {chain:?}"
            );
            tip
        };
        let [half, quarter] = [bend(0.5, at_half), bend(0.25, at_quarter)];
        bend(0.1, at_tenth);
        let limit = [0, 1].map(|axis| (4.0 * quarter[axis] - half[axis]) / 3.0);
        let away = (limit[0] - elastica[0]).hypot(limit[1] - elastica[1]);
        assert!(
            away <= 0.005 * length,
            "{name} {way} {length} cm: {limit:?}, elastica {elastica:?}"
        );
    }
}

/// Reach and drop of the tip that the program tells [cm].
#[track_caller]
fn tip(trial: &Trial, name: &str, way: &str, length: f64, pitch: f64) -> [f64; 2] {
    let (length, pitch) = (length.to_string(), pitch.to_string());
    let cantilever = ["lab", "cantilever", "--fabric", name, "--direction", way];
    let sizes = ["--overhang", &length, "--pitch", &pitch, "--json"];
    let said = trial.run(&[&cantilever[..], &sizes].concat());
    assert_eq!(said.code, 0, "{}", said.err);
    ["tip_reach_cm", "tip_drop_cm"].map(|key| number(&said.out, key))
}

/// At L = 2.00034969157 (M/W)^(1/3), for any cloth (b_elastica_cantilever, overhang_41p5): so
/// relation (2) gives back the bending that went in.
#[test]
fn the_tip_meets_the_slope_at_two_bending_lengths() {
    for (name, _) in SWATCHES {
        for yarn in YARNS {
            let cloth = fabric(name);
            let found = Cantilever::overhang(&cloth, yarn, 10, &mut go_on).unwrap();
            let exact = 2.00034969157 * bending_length(&cloth, yarn);
            assert!(found.bent.rest.settled.converged, "{name} {yarn}");
            let error = relative(found.length, exact);
            assert!(error.abs() <= 0.01, "{name} {yarn}: {error}");
            let of_bending = relative(found.bending, cloth.along(yarn).bending);
            assert!(of_bending.abs() <= 0.02, "{name} {yarn}: {of_bending}");
        }
    }
}

/// Height of the heart of a heavy strip that does not stretch, over its bending length, by shooting
/// from its lowest point (Runge–Kutta, 400 steps); without weight it is 0.13386 of the length, which
/// Peirce rounded to 0.1337.
const HEARTS: [(f64, f64); 2] = [(8.0, 2.3683499), (10.0, 3.4849036)];

#[test]
fn a_heart_loop_is_as_high_as_the_heavy_elastica() {
    for yarn in YARNS {
        let cloth = unstretchable(&fabric("c"));
        let unit = bending_length(&cloth, yarn);
        for (times, height) in HEARTS {
            let length = times * unit;
            let pitch = length / 60.0;
            let test = HeartLoop {
                yarn,
                length,
                pitch,
            };
            let heart = test.run(&cloth, &mut go_on).unwrap();
            assert!(heart.rest.settled.converged, "{yarn} {times}");
            let error = relative(heart.height, height * unit);
            assert!(error.abs() <= 0.005, "{yarn} {times}: {error}");
        }
    }
}

fn unstretchable(cloth: &Fabric) -> Fabric {
    let mut cloth = cloth.clone();
    for direction in [&mut cloth.warp, &mut cloth.weft] {
        direction.tension = Tension::Linear { modulus: 1e5 };
    }
    cloth
}

/// Of the elastica with ten bending lengths his relation makes 9.8 % more than its bending: it is
/// for the loops' heights by hand. Cloth that stretches reads a little less.
#[test]
fn peirces_relation_reads_a_tenth_too_much_at_most() {
    for (name, _) in SWATCHES {
        for yarn in YARNS {
            let cloth = fabric(name);
            let mut test = HeartLoop::of(&cloth, yarn);
            test.pitch *= 2.0;
            let heart = test.run(&cloth, &mut go_on).unwrap();
            assert!(heart.rest.settled.converged, "{name} {yarn}");
            let error = relative(heart.bending, cloth.along(yarn).bending);
            assert!((0.0..0.1).contains(&error), "{name} {yarn}: {error}");
        }
    }
}

/// Ten cloths that Wang et al. (2011) measured have 0.78 of the mean on the bias; rods that resist
/// no twist have a half, a cylinder's share.
#[test]
fn cloth_bends_on_the_bias_as_stiffly_as_it_resists_twist() {
    let cloth = fabric("c");
    let test = BiasBend::of(&cloth);
    let bent = test.run(&cloth, &mut go_on).unwrap().reading(&test);
    assert!(bent.certified);
    let with = bent.figure("bias_over_mean").unwrap();
    let without = bent.figure("bias_over_mean_without_twist").unwrap();
    assert!((0.65..=0.80).contains(&with), "{with}");
    assert!((0.40..=0.55).contains(&without), "{without}");
    for (key, yarn) in ["bending_warp_gf_cm", "bending_weft_gf_cm"]
        .into_iter()
        .zip(YARNS)
    {
        let error = relative(bent.figure(key).unwrap(), cloth.along(yarn).bending);
        assert!(error.abs() <= 0.06, "{yarn}: {error}");
    }
}

/// A strip shorter than six bending lengths stands up from its clamp, and would read nonsense.
#[test]
fn a_strip_too_short_or_too_long_for_a_heart_is_refused() {
    let cloth = fabric("c");
    for times in [5.9, 25.1] {
        let mut test = HeartLoop::of(&cloth, Yarn::Warp);
        test.length *= times / 10.0;
        let refused = test.run(&cloth, &mut go_on).unwrap_err().to_string();
        assert!(refused.starts_with("length [cm] is "), "{refused}");
    }
}
