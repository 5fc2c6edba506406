//! `soen lab …`: the laboratory's instruments on the simulated cloth.

pub(crate) mod args;
mod verify;

use crate::{
    drape::{stopped_by_ctrl_c, try_folder},
    failure::{DONE, Failure, uncertified},
    files::{mark, marked},
    progress::Teller,
    say,
};
use args::{Along, LabWish, Specimen, Test};
use soen::{
    fabric::Fabric,
    lab::{
        BiasBend, Buckling, Cantilever, Capstan, Drapemeter, HeartLoop, HungStrip, LabError, Pull,
        Reading, Resolution, ShearFrame, Slope, StickSlip, Watch,
    },
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
        } => show(of, Some(along), |fabric, watch| {
            let (yarn, pitch) = (along.direction.yarn(), of.pitch);
            match *pull {
                None => {
                    let pitch = pitch.unwrap_or(length / 60.0);
                    let strip = HungStrip {
                        yarn,
                        length: *length,
                        pitch,
                    };
                    Ok(strip.run(fabric, watch)?.reading())
                }
                Some(most) => {
                    let pull = Pull::default();
                    let pitch = pitch.unwrap_or(pull.pitch);
                    let size = [*length, pull.size[1]];
                    let cut = along.direction.cut();
                    Ok(Pull {
                        cut,
                        most,
                        pitch,
                        size,
                        ..pull
                    }
                    .run(fabric, watch)?
                    .reading())
                }
            }
        }),
        Test::Cantilever {
            of,
            along,
            overhang,
        } => show(of, Some(along), |fabric, watch| {
            cantilever(fabric, along, *overhang, of.pitch, watch)
        }),
        Test::Shear {
            of,
            along,
            load,
            angle,
        } => show(of, Some(along), |fabric, watch| {
            let along = along.direction.yarn();
            let frame = ShearFrame {
                along,
                most: *angle,
                ..ShearFrame::default()
            };
            let mut frame = frame.taut(fabric);
            frame.load = load.unwrap_or(frame.load);
            frame.pitch = of.pitch.unwrap_or(frame.pitch);
            Ok(frame.run(fabric, watch)?.reading())
        }),
        Test::HeartLoop { of, along, length } => show(of, Some(along), |fabric, watch| {
            let yarn = along.direction.yarn();
            let length = length.unwrap_or(HeartLoop::of(fabric, yarn).length);
            let pitch = of.pitch.unwrap_or(length / 80.0);
            Ok(HeartLoop {
                yarn,
                length,
                pitch,
            }
            .run(fabric, watch)?
            .reading())
        }),
        Test::Drapemeter { of, seeds } => show(of, None, |fabric, watch| {
            let usual = Drapemeter::of(fabric);
            let pitch = of.pitch.unwrap_or(usual.pitch);
            let meter = Drapemeter {
                seeds: *seeds,
                pitch,
                ..usual
            };
            Ok(meter.run(fabric, watch)?.reading())
        }),
        Test::Resolution { of, seeds } => show(of, None, |fabric, watch| {
            let pitch = of.pitch.unwrap_or(1.0);
            let seeds = *seeds;
            Ok(Resolution { pitch, seeds }.run(fabric, watch)?.reading())
        }),
        Test::Slope { of, friction } => show(of, None, |fabric, watch| {
            let friction = friction.unwrap_or(fabric.friction.body);
            let pitch = of.pitch.unwrap_or(1.0);
            let slope = Slope {
                friction,
                size: 8.0,
                pitch,
            };
            Ok(slope.run(fabric, watch)?.reading(&slope))
        }),
        Test::Capstan {
            of,
            along,
            friction,
        } => show(of, Some(along), |fabric, watch| {
            let usual = Capstan::of(fabric, along.direction.yarn());
            let capstan = Capstan {
                friction: friction.unwrap_or(fabric.friction.body),
                pitch: of.pitch.unwrap_or(usual.pitch),
                ..usual
            };
            Ok(capstan.run(fabric, watch)?.reading(&capstan))
        }),
        Test::BiasBend { of, twist } => show(of, None, |fabric, watch| {
            let mut test = BiasBend::of(fabric);
            test.twist = twist.unwrap_or(test.twist);
            if let Some(pitch) = of.pitch {
                test.cells = cells_of(pitch, BiasBend::length(fabric), [4.0, 200.0])?;
            }
            Ok(test.run(fabric, watch)?.reading(&test))
        }),
        Test::Buckling {
            of,
            along,
            twist,
            rigid,
        } => show(of, Some(along), |fabric, watch| {
            let twist = twist.unwrap_or(fabric.twist);
            let (yarn, rigid) = (along.direction.yarn(), *rigid);
            let cloth = Fabric {
                twist,
                ..fabric.clone()
            };
            let mut test = Buckling {
                yarn,
                rigid,
                ..Buckling::default()
            };
            if let Some(pitch) = of.pitch {
                let height = test.slimness * Buckling::critical(&cloth, yarn)?;
                test.cells = cells_of(pitch, height, [1.0, 20.0])?;
            }
            Ok(test.run(&cloth, watch)?.reading())
        }),
        Test::StickSlip {
            of,
            along,
            friction,
        } => show(of, Some(along), |fabric, watch| {
            let yarn = along.direction.yarn();
            let friction = friction.unwrap_or(fabric.friction.body);
            let mut test = StickSlip {
                yarn,
                friction,
                cells: 40,
            };
            if let Some(pitch) = of.pitch {
                test.cells = cells_of(pitch, StickSlip::LENGTH, StickSlip::CELLS)?;
            }
            Ok(test.run(fabric, watch)?.reading(&test))
        }),
        Test::Verify { json, out, quick } => verify::verify(*json, out.as_deref(), *quick),
    }
}

/// Cells of a wished pitch [cm] over a length [cm], where so few and so many are allowed.
fn cells_of(pitch: f64, length: f64, [few, many]: [f64; 2]) -> Result<u32, LabError> {
    let [least, most] = [length / many, length / few];
    if (least..=most).contains(&pitch) {
        Ok((length / pitch).round() as u32)
    } else {
        Err(LabError::NotAllowed {
            what: "pitch [cm]",
            value: pitch,
            allowed: format!("{least:.4} to {most:.4}"),
        })
    }
}

fn cantilever(
    fabric: &Fabric,
    along: &Along,
    overhang: Option<f64>,
    pitch: Option<f64>,
    watch: Watch<'_>,
) -> Result<Reading, LabError> {
    /// Cells along the strip whose slope is looked for.
    const CELLS: u32 = 20;
    /// And at most.
    const MOST: f64 = 200.0;
    let yarn = along.direction.yarn();
    match overhang {
        Some(overhang) => {
            let pitch = pitch.unwrap_or(overhang / 40.0);
            let test = Cantilever {
                yarn,
                overhang,
                pitch,
            };
            Ok(test.run(fabric, watch)?.reading(&test))
        }
        None => {
            let found = Cantilever::overhang(fabric, yarn, CELLS, watch)?;
            match pitch {
                None => Ok(found.reading(fabric, yarn)),
                Some(pitch) => {
                    let cells = cells_of(pitch, found.length, [2.0, MOST])?;
                    let found = Cantilever::overhang(fabric, yarn, cells, watch)?;
                    Ok(found.reading(fabric, yarn))
                }
            }
        }
    }
}

/// Runs an instrument, writes what is wished for and prints what it shows.
fn show(
    of: &Specimen,
    along: Option<&Along>,
    test: impl FnOnce(&Fabric, Watch<'_>) -> Result<Reading, LabError>,
) -> Result<ExitCode, Failure> {
    let fabric = scene::fabric(&of.fabric)?;
    if let Some(out) = &of.out {
        try_folder(out)?;
    }
    let stop = stopped_by_ctrl_c()?;
    let mut teller = Teller::new();
    let reading = test(&fabric, &mut |progress: &Progress| {
        teller.tell(progress);
        !stop.load(Ordering::Relaxed)
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
