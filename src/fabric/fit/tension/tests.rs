use super::*;
use crate::fabric::fit::sample::{CLOTHS, Noise};

/// Even steps of strain up to a tension of 500 gf/cm.
fn record(a: f64, b: f64, count: u32) -> Vec<[f64; 2]> {
    let greatest = libm::pow(500.0 / a, 1.0 / (b + 1.0));
    (1..=count)
        .map(|k| greatest * f64::from(k) / f64::from(count))
        .map(|strain| [strain, a * libm::pow(strain, b + 1.0)])
        .collect()
}

fn noisy(points: &[[f64; 2]], seed: u64) -> Vec<[f64; 2]> {
    let mut noise = Noise::new(seed);
    let spoilt = |[strain, tension]: &[f64; 2]| [*strain, noise.about(*tension, 0.01)];
    points.iter().map(spoilt).collect()
}

fn fit(points: &[[f64; 2]]) -> PowerFit {
    power_law(points, &Range::default()).unwrap()
}

fn is_near(fit: &PowerFit, a: f64, b: f64) -> bool {
    (fit.a.value / a - 1.0).abs() < 0.02 && (fit.b.value - b).abs() < 0.02
}

#[test]
fn a_curve_without_errors_gives_its_law_back() {
    for (name, [a, b, ..]) in CLOTHS {
        let fit = fit(&record(a, b, 30));
        assert!((fit.a.value / a - 1.0).abs() < 1e-6, "{name}: {:?}", fit.a);
        assert!((fit.b.value - b).abs() < 1e-7, "{name}: {:?}", fit.b);
        assert!(fit.residual < 1e-6 && fit.doubts.is_empty(), "{name}");
        assert!(fit.fates.iter().all(|fate| *fate == Fate::Used), "{name}");
    }
}

/// 150 readings, as many as the stiffest of the five takes (module docs).
#[test]
fn readings_with_errors_of_1_percent_give_a_within_2_percent_and_b_within_0_02() {
    for (name, [a, b, ..]) in CLOTHS {
        for seed in 0..20 {
            let fit = fit(&noisy(&record(a, b, 150), seed));
            assert!(
                is_near(&fit, a, b),
                "{name}, {seed}: {:?} {:?}",
                fit.a,
                fit.b
            );
        }
    }
}

#[test]
fn cloth_that_stretches_far_needs_30_readings_only() {
    for seed in 0..20 {
        let fit = fit(&noisy(&record(1.8e3, 1.5, 30), seed));
        assert!(is_near(&fit, 1.8e3, 1.5), "{seed}: {:?} {:?}", fit.a, fit.b);
    }
}

/// An error of 1 % in strain is one of B + 1 per cent in tension: it takes (B + 1)² as many.
#[test]
fn errors_of_1_percent_in_strain_as_well_take_a_dense_record() {
    // The limpest and the stiffest.
    for (name, [a, b, ..]) in [CLOTHS[2], CLOTHS[9]] {
        for seed in 0..3 {
            let mut noise = Noise::new(seed);
            let spoilt = |[strain, tension]: &[f64; 2]| {
                [noise.about(*strain, 0.01), noise.about(*tension, 0.01)]
            };
            let points: Vec<[f64; 2]> = record(a, b, 2500).iter().map(spoilt).collect();
            let fit = fit(&points);
            assert!(
                is_near(&fit, a, b),
                "{name}, {seed}: {:?} {:?}",
                fit.a,
                fit.b
            );
        }
    }
}

#[test]
fn the_interval_holds_19_times_in_20() {
    let (mut a_held, mut b_held) = (0, 0);
    for seed in 0..400 {
        let fit = fit(&noisy(&record(3.1e4, 1.7, 40), seed));
        let held = |one: Estimate, truth: f64| (one.value - truth).abs() <= one.half_width.unwrap();
        a_held += usize::from(held(fit.a, 3.1e4));
        b_held += usize::from(held(fit.b, 1.7));
    }
    assert!(
        (366..=392).contains(&a_held) && (366..=392).contains(&b_held),
        "{a_held} {b_held}"
    );
}

#[test]
fn wrong_readings_are_left_out() {
    for seed in 0..20 {
        let mut points = noisy(&record(3.8e5, 1.8, 150), seed);
        for (place, factor) in [(3, 3.0), (40, 0.2), (41, 1.4), (100, 1.2), (149, 0.6)] {
            points[place][1] *= factor;
        }
        let fit = fit(&points);
        assert!(is_near(&fit, 3.8e5, 1.8), "{seed}: {:?} {:?}", fit.a, fit.b);
        for place in [3, 40, 41, 100, 149] {
            assert_eq!(fit.fates[place], Fate::Outlier, "{seed}: {place}");
        }
    }
}

#[test]
fn digits_that_end_do_not_bend_the_law() {
    // A display of 0.5 gf/cm: the first tenth of the record reads 0, or one step.
    for (name, [a, b, ..]) in CLOTHS {
        let mut points = record(a, b, 200);
        for point in &mut points {
            point[1] = (point[1] / 0.5).round() * 0.5;
        }
        let fit = fit(&points);
        assert!(is_near(&fit, a, b), "{name}: {:?} {:?}", fit.a, fit.b);
    }
}

#[test]
fn the_way_back_is_set_aside() {
    let mut points = record(4.0e4, 1.7, 40);
    let back: Vec<[f64; 2]> = points.iter().rev().map(|[s, t]| [*s, 0.6 * t]).collect();
    points.extend(back.iter().skip(1));
    let fit = fit(&points);
    assert!((fit.b.value - 1.7).abs() < 1e-6);
    assert_eq!(
        fit.fates
            .iter()
            .filter(|fate| **fate == Fate::WayBack)
            .count(),
        39
    );
}

#[test]
fn the_range_is_the_part_over_which_the_law_holds() {
    // Beyond a strain of 0.04 the threads themselves are pulled: the curve goes on straight.
    let bent = |strain: f64| match strain {
        s if s < 0.04 => 3.8e5 * libm::pow(s, 2.8),
        s => 3.8e5 * libm::pow(0.04, 2.8) * (1.0 + 0.3 * (s / 0.04 - 1.0)),
    };
    let points: Vec<[f64; 2]> = (1..=200)
        .map(|k| f64::from(k) * 1e-3)
        .map(|strain| [strain, bent(strain)])
        .collect();
    let narrowed = fit(&points);
    assert!(
        narrowed.strains[1] < 0.06 && narrowed.residual <= 0.05,
        "{narrowed:?}"
    );
    let up_to = |strain| {
        let wish = Range {
            up_to: Some(strain),
            slack: 0.0,
        };
        power_law(&points, &wish)
    };
    let wished = up_to(0.04).unwrap();
    assert!((wished.b.value - 1.8).abs() < 1e-3, "{:?}", wished.b);
    assert_eq!(wished.fates[45], Fate::Outside);
    let wide = up_to(0.07).unwrap();
    assert!(
        matches!(wide.doubts[..], [Doubt::LawDoesNotHold { .. }]),
        "{wide:?}"
    );
    assert!(matches!(up_to(0.2), Err(Unfit::Flattens { .. })));
}

#[test]
fn slack_of_the_machine_is_noticed_and_taken_off() {
    let mut points: Vec<[f64; 2]> = (0..10).map(|k| [f64::from(k) * 5e-4, 0.0]).collect();
    points.extend(
        noisy(&record(3.1e4, 1.7, 100), 1)
            .iter()
            .map(|[s, t]| [s + 0.005, *t]),
    );
    let found = fit(&points);
    let Some(Doubt::Slack { strain, .. }) = found.doubts.first() else {
        panic!("{:?}", found.doubts);
    };
    assert!((strain - 0.005).abs() < 0.002, "{strain}");
    let without = power_law(
        &points,
        &Range {
            up_to: None,
            slack: 0.005,
        },
    )
    .unwrap();
    assert!(
        is_near(&without, 3.1e4, 1.7) && without.doubts.is_empty(),
        "{without:?}"
    );
}

#[test]
fn what_is_no_curve_is_refused() {
    let three = record(4.0e4, 1.7, 3);
    let message = |points: &[[f64; 2]]| {
        power_law(points, &Range::default())
            .unwrap_err()
            .to_string()
    };
    assert!(message(&three).starts_with("3 points that pull"));
    assert!(message(&[]).starts_with("0 points"));
    assert!(message(&[[0.01, 0.0]; 9]).starts_with("0 points"));
    assert!(message(&[[f64::NAN, 1.0]; 9]).starts_with("0 points"));
    assert!(message(&[[0.01, 1.0]; 9]).starts_with("1 points"));
    let exchanged: Vec<[f64; 2]> = record(4.0, 1.7, 30)
        .iter()
        .map(|[s, t]| [0.01 * t, *s])
        .collect();
    assert!(message(&exchanged).contains("exchanged"));
}
