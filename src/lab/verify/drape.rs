//! Drape coefficients beside published regressions and gates, and at half the pitch.
//!
//! The regressions want a bending hysteresis and a shear hysteresis that the paper did not measure;
//! their coefficients are from memory of the papers. So they are shown, and the gates are wide.

use super::{Allowed, Comparison, Named};
use crate::{
    fabric::{Fabric, Yarn},
    lab::{Drapemeter, Drapes, LabError, Watch},
};

/// Layings at half the pitch; of cloth that bends over a longer way than this [cm], as paper does,
/// one, for it takes minutes.
const FEW: u32 = 2;
const STIFF: f64 = 3.0;

/// Hands its rows to `add` fabric by fabric, for each takes minutes.
pub(super) fn compare(
    fabrics: &[Named],
    watch: Watch<'_>,
    add: &mut dyn FnMut(Vec<Comparison>),
) -> Result<(), LabError> {
    let mut all = Vec::new();
    for fabric in fabrics {
        let meter = Drapemeter::of(&fabric.1);
        let drapes = meter.run(&fabric.1, watch)?;
        let fine = Drapemeter {
            pitch: 0.5 * meter.pitch,
            seeds: few(&fabric.1),
            ..meter
        };
        let mut rows = of_fabric(fabric, &drapes);
        rows.push(halved(fabric, &drapes, &fine.run(&fabric.1, watch)?));
        add(rows);
        all.push((fabric.1.clone(), drapes));
    }
    add(in_order(fabrics, &all));
    Ok(())
}

fn few(fabric: &Fabric) -> u32 {
    if fabric.bending_length(Yarn::Warp) > STIFF {
        1
    } else {
        FEW
    }
}

fn coefficient(drapes: &Drapes) -> f64 {
    let [mean, _] = drapes.spread(|laying| laying.coefficient);
    mean
}

fn row(
    test: String,
    quantity: &'static str,
    [figure, reference]: [f64; 2],
    allowed: Allowed,
    source: &'static str,
) -> Comparison {
    Comparison {
        test,
        quantity,
        figure,
        reference,
        allowed,
        source,
    }
}

fn of_fabric(fabric: &Named, drapes: &Drapes) -> Vec<Comparison> {
    let (test, mean) = (format!("drapemeter, {}", fabric.0), coefficient(drapes));
    let [_, spread] = drapes.spread(|laying| laying.coefficient);
    let [folds, _] = drapes.spread(|laying| laying.folds.count as f64);
    let shown = |quantity, pair, source| row(test.clone(), quantity, pair, Allowed::Shown, source);
    let mut rows = vec![
        shown(
            "drape coefficient [%]",
            [mean, niwa_seto(&fabric.1)],
            "regression of Niwa & Seto 1986, no hysteresis",
        ),
        shown(
            "drape coefficient [%]",
            [mean, cusick(&fabric.1)],
            "regression of Cusick 1965",
        ),
        shown(
            "folds",
            [folds, matsudaira(&fabric.1)],
            "regression of Yang & Matsudaira, no hysteresis",
        ),
        row(
            test.clone(),
            "spread over seeds [points]",
            [spread, 0.0],
            Allowed::UpTo(5.0),
            "laboratories repeat to a few points",
        ),
    ];
    let gates = [
        ("a", 9.0, 35.0),
        ("b", 9.0, 35.0),
        ("c", 9.0, 35.0),
        ("d", 25.0, 67.0),
    ];
    let gate = gates.into_iter().find(|(name, ..)| *name == fabric.0);
    rows.extend(gate.map(|(_, least, most)| {
        let source = "between a wedge without hoops and the regressions";
        let pair = [mean, least];
        row(
            test,
            "drape coefficient [%]",
            pair,
            Allowed::UpTo(most),
            source,
        )
    }));
    rows
}

fn halved(fabric: &Named, drapes: &Drapes, fine: &Drapes) -> Comparison {
    let first = drapes.layings.iter().take(fine.layings.len());
    let count = first.len().max(1) as f64;
    let coarse = first.map(|laying| laying.coefficient).sum::<f64>() / count;
    row(
        format!("drapemeter at half the pitch, {}", fabric.0),
        "drape coefficient [%]",
        [coefficient(fine), coarse],
        Allowed::Off(2.0),
        "ours at the whole pitch, same seeds",
    )
}

/// C < B, B ≲ A, A < D < washi; more folds in C than in D.
fn in_order(fabrics: &[Named], all: &[(Fabric, Drapes)]) -> Vec<Comparison> {
    let of = |name: &str| {
        let place = fabrics.iter().position(|(known, _)| known == name);
        place.map(|place| &all[place].1)
    };
    let pairs = [
        ("b", "c"),
        ("a", "c"),
        ("d", "a"),
        ("d", "b"),
        ("washi", "d"),
    ];
    let ordered = pairs.into_iter().filter_map(|(more, less)| {
        let pair = [coefficient(of(more)?), coefficient(of(less)?)];
        let test = format!("drapemeter, {more} above {less}");
        let source = "order of bending lengths, physics of all regressions";
        Some(row(
            test,
            "drape coefficient [%]",
            pair,
            Allowed::More,
            source,
        ))
    });
    let mut rows: Vec<Comparison> = ordered.collect();
    if let (Some(c), Some(d)) = (of("c"), of("d")) {
        let folds = |drapes: &Drapes| drapes.spread(|laying| laying.folds.count as f64)[0];
        let test = "drapemeter, c above d".to_owned();
        let source = "limper cloth folds more often";
        rows.push(row(
            test,
            "folds",
            [folds(c), folds(d)],
            Allowed::More,
            source,
        ));
    }
    rows
}

fn bending(fabric: &Fabric) -> f64 {
    0.5 * (fabric.warp.bending + fabric.weft.bending)
}

fn shear(fabric: &Fabric) -> f64 {
    0.5 * (fabric.warp.shear + fabric.weft.shear)
}

/// DC = 5.1 + 115.0·(B/W)^⅓ + 131.1·(2HB/W)^⅓ + 1.2·(G/W)^⅓ with 2HB = 0; B [gf·cm²/cm],
/// W [mg/cm²], G [gf/(cm·deg)].
fn niwa_seto(fabric: &Fabric) -> f64 {
    let weight = 1000.0 * fabric.weight;
    let per_degree = shear(fabric).to_radians();
    5.1 + 115.0 * libm::cbrt(bending(fabric) / weight) + 1.2 * libm::cbrt(per_degree / weight)
}

/// DC = 35.6·C − 3.61·C² − 2.59·A + 0.0461·A² + 17.0: C bending length [cm], A the angle at which
/// 2 gf/cm shear the cloth [°], at most 28.
fn cusick(fabric: &Fabric) -> f64 {
    let length = libm::cbrt(bending(fabric) / fabric.weight);
    let angle = (2.0 / shear(fabric)).to_degrees().min(28.0);
    35.6 * length - 3.61 * length * length - 2.59 * angle + 0.0461 * angle * angle + 17.0
}

/// n = 12.797 − 269.9·(B/W)^⅓ + 38060·B/W − 2.67·G/W + 13.03·√(2HG/W) with 2HG = 0; B [mN·m²/m],
/// W [g/m²], G [N/m/rad].
fn matsudaira(fabric: &Fabric) -> f64 {
    let weight = 1e4 * fabric.weight;
    let stiffness = 9.806_65e-2 * bending(fabric) / weight;
    let shear = 0.980_665 * shear(fabric);
    12.797 - 269.9 * libm::cbrt(stiffness) + 38060.0 * stiffness - 2.67 * shear / weight
}

#[cfg(test)]
mod tests {
    use super::*;

    /// reference.json, h_drape_predictions: fabrics A and C.
    #[test]
    fn the_regressions_give_what_others_computed_by_them() {
        let rows = [
            ("a", 19.0684094475, 18.0578424443, 6.44790161826),
            ("c", 14.6518119847, 22.7862189695, 8.11731024372),
        ];
        for (name, niwa, by_cusick, folds) in rows {
            let fabric = crate::scene::fabric(name).unwrap();
            assert!(
                (niwa_seto(&fabric) - niwa).abs() < 0.01,
                "{name} {}",
                niwa_seto(&fabric)
            );
            assert!(
                (cusick(&fabric) - by_cusick).abs() < 0.01,
                "{name} {}",
                cusick(&fabric)
            );
            assert!(
                (matsudaira(&fabric) - folds).abs() < 0.1,
                "{name} {}",
                matsudaira(&fabric)
            );
        }
    }
}
