//! Strips: elongation, overhang, heart loop.

use super::{Allowed, Comparison, Named, name};
use crate::{
    fabric::Yarn,
    lab::{Cantilever, HeartLoop, HungStrip, LabError, ShearFrame, Watch, elastica},
};

/// Length of the strips [cm] and the pitches of Richardson's extrapolation [cm].
const OVERHANG: f64 = 8.0;
const PITCHES: [f64; 2] = [0.5, 0.25];

pub(super) fn compare(fabric: &Named, watch: Watch<'_>) -> Result<Vec<Comparison>, LabError> {
    let mut rows = Vec::new();
    for yarn in [Yarn::Warp, Yarn::Weft] {
        rows.push(hung(fabric, yarn, watch)?);
        rows.extend(bent(fabric, yarn, watch)?);
        rows.extend(overhang(fabric, yarn, watch)?);
        rows.extend(heart(fabric, yarn, watch)?);
    }
    rows.push(sheared(fabric, watch)?);
    Ok(rows)
}

fn hung(fabric: &Named, yarn: Yarn, watch: Watch<'_>) -> Result<Comparison, LabError> {
    let (length, pitch) = (100.0, 1.0);
    let hung = HungStrip {
        yarn,
        length,
        pitch,
    }
    .run(&fabric.1, watch)?;
    Ok(Comparison {
        test: name("strip of 100 cm", fabric, yarn),
        quantity: "elongation [cm]",
        figure: hung.elongation,
        reference: hung.continuum,
        allowed: Allowed::Percent(0.2),
        source: "closed form, L·(WL/A)^n·(B+1)/(B+2)",
    })
}

/// The tip by Richardson's extrapolation: its error falls with the square of the pitch.
fn bent(fabric: &Named, yarn: Yarn, watch: Watch<'_>) -> Result<[Comparison; 2], LabError> {
    let overhang = OVERHANG;
    let mut tip = |pitch: f64| -> Result<[f64; 2], LabError> {
        let bent = Cantilever {
            yarn,
            overhang,
            pitch,
        }
        .run(&fabric.1, watch)?;
        Ok([bent.tip_reach, bent.tip_drop])
    };
    let [coarse, fine] = [tip(PITCHES[0])?, tip(PITCHES[1])?];
    let [reach, height] = elastica::Heavy::of(&fabric.1, yarn, overhang).tip();
    let row = |axis: usize, quantity, reference, allowed| Comparison {
        test: name("cantilever of 8 cm", fabric, yarn),
        quantity,
        figure: fine[axis] + (fine[axis] - coarse[axis]) / 3.0,
        reference,
        allowed,
        source: "extensible heavy elastica",
    };
    Ok([
        row(1, "tip drop, h → 0 [cm]", -height, Allowed::Percent(0.5)),
        row(
            0,
            "tip reach, h → 0 [cm]",
            reach,
            Allowed::Off(0.005 * overhang),
        ),
    ])
}

fn overhang(fabric: &Named, yarn: Yarn, watch: Watch<'_>) -> Result<[Comparison; 2], LabError> {
    // A fifth of the bending length, as L is two.
    let found = Cantilever::overhang(&fabric.1, yarn, 10, watch)?;
    let bending = fabric.1.along(yarn).bending;
    let length = 2.000_349_691_57 * fabric.1.bending_length(yarn);
    let test = name("cantilever at 41.5°", fabric, yarn);
    Ok([
        Comparison {
            test: test.clone(),
            quantity: "overhang at pitch c/5 [cm]",
            figure: found.length,
            reference: length,
            allowed: Allowed::Percent(1.0),
            source: "heavy elastica, L = 2.00035·c",
        },
        Comparison {
            test,
            quantity: "M_BN by (2), 20 cells [gf·cm]",
            figure: Cantilever::overhang(&fabric.1, yarn, 20, watch)?.bending,
            reference: bending,
            allowed: Allowed::Percent(2.0),
            source: "the fabric's own; (2) is 0.05 % high",
        },
    ])
}

fn heart(fabric: &Named, yarn: Yarn, watch: Watch<'_>) -> Result<Vec<Comparison>, LabError> {
    let test = HeartLoop::of(&fabric.1, yarn);
    let heart = test.run(&fabric.1, watch)?;
    let exact = elastica::Heavy::of(&fabric.1, yarn, test.length);
    let test = name("heart loop of 10 c", fabric, yarn);
    let mut rows: Vec<Comparison> = Vec::new();
    rows.extend(exact.heart().map(|reference| Comparison {
        test: test.clone(),
        quantity: "height of the loop [cm]",
        figure: heart.height,
        reference,
        allowed: Allowed::Percent(1.0),
        source: "extensible heavy elastica",
    }));
    rows.push(Comparison {
        test,
        quantity: "M_BN by Peirce [gf·cm]",
        figure: heart.bending,
        reference: fabric.1.along(yarn).bending,
        allowed: Allowed::Shown,
        source: "Peirce 1930, an approximation",
    });
    Ok(rows)
}

fn sheared(fabric: &Named, watch: Watch<'_>) -> Result<Comparison, LabError> {
    let frame = ShearFrame {
        most: 2.0,
        steps: 2,
        ..ShearFrame::default()
    }
    .taut(&fabric.1);
    Ok(Comparison {
        test: format!("shear frame, {}", fabric.0),
        quantity: "M_SH by (3), (4) [gf/cm]",
        figure: frame.run(&fabric.1, watch)?.shear(),
        reference: 0.5 * (fabric.1.warp.shear + fabric.1.weft.shear),
        allowed: Allowed::Percent(2.0),
        source: "the fabric's own, mean of warp and weft",
    })
}
