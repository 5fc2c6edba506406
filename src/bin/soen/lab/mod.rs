//! `soen lab …`: the laboratory's instruments on the simulated cloth.

pub(crate) mod args;
mod instruments;
mod verify;

use crate::{
    drape::{stopped_by_ctrl_c, try_folder},
    failure::{DONE, Failure, uncertified},
    files::{mark, marked},
    progress::Teller,
    say,
};
use args::{Along, LabWish, Specimen, Test};
use instruments::{Found, Trial};
use soen::{
    fabric::Fabric,
    lab::Reading,
    output::{self, ClothMesh, View},
    scene,
    solver::Progress,
};
use std::{path::Path, process::ExitCode, sync::atomic::Ordering};

pub(crate) fn lab(wish: &LabWish) -> Result<ExitCode, Failure> {
    match &wish.test {
        Test::Strip {
            of,
            along,
            length,
            pull,
        } => show(of, Some(along), |trial| match pull {
            None => trial.hung_strip(along, *length),
            Some(most) => trial.pulled_strip(along, *length, *most),
        }),
        Test::Cantilever {
            of,
            along,
            overhang,
        } => show(of, Some(along), |trial| match overhang {
            None => trial.overhang(along),
            Some(overhang) => trial.cantilever(along, *overhang),
        }),
        Test::Shear {
            of,
            along,
            load,
            angle,
        } => show(of, Some(along), |trial| trial.shear(along, *load, *angle)),
        Test::HeartLoop { of, along, length } => {
            show(of, Some(along), |trial| trial.heart_loop(along, *length))
        }
        Test::Drapemeter { of, seeds } => show(of, None, |trial| trial.drapemeter(*seeds)),
        Test::Resolution { of, seeds } => show(of, None, |trial| trial.resolution(*seeds)),
        Test::Slope { of, friction } => show(of, None, |trial| trial.slope(*friction)),
        Test::Capstan {
            of,
            along,
            friction,
        } => show(of, Some(along), |trial| trial.capstan(along, *friction)),
        Test::BiasBend { of, twist } => show(of, None, |trial| trial.bias_bend(*twist)),
        Test::Buckling {
            of,
            along,
            twist,
            rigid,
        } => show(of, Some(along), |trial| {
            trial.buckling(along, *twist, *rigid)
        }),
        Test::StickSlip {
            of,
            along,
            friction,
        } => show(of, Some(along), |trial| trial.stick_slip(along, *friction)),
        Test::Verify { json, out, quick } => verify::verify(*json, out.as_deref(), *quick),
    }
}

/// Runs an instrument, writes what is wished for and prints what it shows.
fn show(
    of: &Specimen,
    along: Option<&Along>,
    test: impl FnOnce(Trial<'_, '_>) -> Found,
) -> Result<ExitCode, Failure> {
    let fabric = scene::fabric(&of.fabric)?;
    if let Some(out) = &of.out {
        try_folder(out)?;
    }
    let stop = stopped_by_ctrl_c()?;
    let mut teller = Teller::new();
    let reading = test(Trial {
        fabric: &fabric,
        of,
        watch: &mut |progress: &Progress| {
            teller.tell(progress);
            !stop.load(Ordering::Relaxed)
        },
    });
    teller.end();
    let reading = reading?;
    let mut words = vec![("fabric", of.fabric.clone())];
    if let Some(along) = along {
        words.push(("direction", along.direction.yarn().to_string()));
    }
    let json = output::reading(&reading, &words);
    if let Some(out) = &of.out {
        write(out, &reading, &json)?;
    }
    say(&if of.json {
        json
    } else {
        table(&reading, &fabric)
    })?;
    Ok(if reading.certified {
        DONE
    } else {
        uncertified()
    })
}

fn write(out: &Path, reading: &Reading, json: &str) -> Result<(), Failure> {
    if let Some(trace) = &reading.trace {
        let title = reading.instrument.to_owned();
        let svg = output::plot(&output::curve(title, trace));
        output::write(&out.join("curve.svg"), svg.as_bytes())?;
        let lines = trace.lines.iter().zip(1..);
        let rows = lines.flat_map(|((name, points), number)| {
            let row = move |[x, y]: &[f64; 2]| format!("{number},{name},{x},{y}\n");
            points.iter().map(row)
        });
        let head = format!("line,name,{},{}\n", trace.x, trace.y);
        let csv: String = core::iter::once(head).chain(rows).collect();
        output::write(&out.join("curve.csv"), csv.as_bytes())?;
    }
    if let Some(rest) = &reading.rest {
        let cloth = ClothMesh {
            lattice: &rest.settled.lattice,
            positions: &rest.settled.positions,
        };
        let bodies = output::body_meshes(&rest.problem.bodies);
        let caption = mark(&rest.settled);
        let obj = output::obj(&marked(reading.instrument, caption), &cloth);
        output::write(&out.join("drape.obj"), obj.as_bytes())?;
        let view = View {
            caption,
            ..View::default()
        };
        output::write(
            &out.join("drape.png"),
            &output::picture(&cloth, &bodies, &view),
        )?;
    }
    Ok(output::write(&out.join("reading.json"), json.as_bytes())?)
}

fn table(reading: &Reading, fabric: &Fabric) -> String {
    let head = format!("{}, {}\n", reading.instrument, fabric.name);
    let rows = reading.figures.iter();
    let rows = rows.map(|figure| format!("  {:34}{:>14.6}\n", figure.key, figure.value));
    let counts = reading.histogram.iter();
    let counts = counts.map(|[folds, times]| format!("  {times} with {folds} folds\n"));
    let verdict = if reading.certified {
        "certified: at rest\n"
    } else {
        "NOT certified: stopped before it was at rest\n"
    };
    head + &rows.chain(counts).collect::<String>() + verdict
}
