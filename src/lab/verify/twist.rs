//! Theories of rods: stick and slip, buckling, and twist on the bias.

use super::{Allowed, Comparison, Named, name};
use crate::{
    fabric::{Fabric, Yarn},
    lab::{BiasBend, Buckling, LabError, StickSlip, Watch},
};

/// Compression at which the tip of a weightless elastica slips, by friction: shooting.
const SLIPS: [[f64; 2]; 3] = [
    [0.1, 0.046_874_177_836],
    [0.2, 0.154_867_354_662],
    [0.3, 0.271_563],
];

pub(super) fn compare(fabric: &Named, watch: Watch<'_>) -> Result<Vec<Comparison>, LabError> {
    let mut rows = Vec::new();
    for [friction, reference] in SLIPS {
        let test = StickSlip {
            yarn: Yarn::Warp,
            friction,
            cells: 40,
        };
        rows.push(Comparison {
            test: name("stick–slip", fabric, format!("µ {friction}")),
            quantity: "compression at slip [-]",
            figure: test.run(&fabric.1, watch)?.compression,
            reference,
            allowed: Allowed::Percent(3.0),
            source: "weightless elastica (test of Romero et al. 2021)",
        });
    }
    rows.extend(buckled(fabric, watch)?);
    rows.extend(biased(fabric, watch)?);
    Ok(rows)
}

fn buckled(fabric: &Named, watch: Watch<'_>) -> Result<[Comparison; 2], LabError> {
    let twist = fabric.1.warp.bending;
    let stiff = Fabric {
        twist,
        ..fabric.1.clone()
    };
    let test = Buckling {
        rigid: true,
        ..Buckling::default()
    };
    let stood = test.run(&stiff, watch)?;
    let shorter = 0.75 * stood.critical;
    let limp = Fabric {
        twist: 0.0,
        ..stiff
    };
    let fallen = test.stand(&limp, shorter, watch)?;
    Ok([
        Comparison {
            test: name("strip on edge", fabric, "with twist"),
            quantity: "length at buckling [cm]",
            figure: stood.length,
            reference: stood.critical,
            allowed: Allowed::Percent(5.0),
            source: "q·L³ = 12.854·√(EI·GJ), Michell 1899",
        },
        Comparison {
            test: name("three quarters of it", fabric, "without twist"),
            quantity: "tip beside its plane, over L [-]",
            figure: fallen.off_plane() / shorter,
            reference: 0.005,
            allowed: Allowed::More,
            source: "it has fallen over: nothing but its warping keeps it up",
        },
    ])
}

fn biased(fabric: &Named, watch: Watch<'_>) -> Result<[Comparison; 2], LabError> {
    let test = BiasBend::of(&fabric.1);
    let bent = test.run(&fabric.1, watch)?;
    let mean = 0.5 * (bent.with[0] + bent.with[1]);
    let row = |of: &str, figure, reference, source| Comparison {
        test: name("bias bending", fabric, of),
        quantity: "B45 over mean of both [-]",
        figure,
        reference,
        allowed: Allowed::Shown,
        source,
    };
    let measured = "ten cloths of Wang et al. 2011, mean";
    Ok([
        row("with twist", bent.with[2] / mean, 0.78, measured),
        row(
            "without twist",
            bent.without / mean,
            0.5,
            "cylinder of rods, (B1 + B2)/4",
        ),
    ])
}
