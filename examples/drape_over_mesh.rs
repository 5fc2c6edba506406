//! Drapes a disc of cloth over a mesh from a file, OBJ, STL, PLY or GLB:
//! `cargo run --release --example drape_over_mesh -- bodies/dress-form.obj out`.
//!
//! The file is taken to be in cm with z up, a GLB in metres with y up. The disc is as wide as the
//! body twice over and starts flat on top of it.

use soen::{
    body::{Bodies, Format, Mesh, Part, Shape, Unit, Up},
    forces::Laws,
    lattice::{Outline, Piece},
    math::{Pose, Vec3},
    output::{self, ClothMesh, Run, View},
    scene,
    solver::{ForceModel, Placement, Problem, Settings, Settled, settle},
};
use std::{
    env,
    error::Error,
    fs,
    io::{self, Write},
    path::Path,
    time::Instant,
};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [mesh, out] = arguments.as_slice() else {
        return Err("give a mesh file and a folder for the results".into());
    };
    let begin = Instant::now();
    let problem = over(load(Path::new(mesh))?)?;
    let settings = Settings {
        tolerance: 1e-3,
        frames: 0,
    };
    let drape = settle(&problem, &settings, &mut |_| {
        begin.elapsed().as_secs_f64() < 300.0
    })?;
    let report = write(Path::new(out), &problem, &drape, begin)?;
    Ok(io::stdout().write_all(report.as_bytes())?)
}

fn load(path: &Path) -> Result<Bodies, Box<dyn Error>> {
    let format = Format::of_path(path).ok_or("give a mesh as .obj, .stl, .ply, .glb or .gltf")?;
    let (unit, up) = match format {
        Format::Gltf => (Unit::Metre, Up::Y),
        _ => (Unit::Centimetre, Up::Z),
    };
    let mesh = Mesh::read(&fs::read(path)?, format, unit, up)?;
    let part = Part::new("body".into(), &Shape::Mesh(mesh), Pose::identity())?;
    Ok(Bodies::new(vec![part]))
}

/// A disc of cloth C that starts on top of the bodies.
fn over(bodies: Bodies) -> Result<Problem, Box<dyn Error>> {
    let (low, high) = bodies.extent().ok_or("the mesh has no extent")?;
    let radius = (high - low).xy().amax();
    let fabric = scene::fabric("c")?;
    let middle = 0.5 * (low + high);
    Ok(Problem {
        piece: Piece {
            outline: Outline::disc(radius)?,
            grain: 0.0,
            pitch: radius / 40.0,
        },
        placement: Placement {
            centre: Vec3::new(middle.x, middle.y, high.z + 1.0),
            x_axis: Vec3::x(),
            y_axis: Vec3::y(),
            curl: 0.0,
        },
        holds: vec![],
        bodies,
        friction: fabric.friction.body,
        thickness: fabric.thickness,
        laws: Laws::default(),
        forces: ForceModel::Lattice,
        seed: 1,
        fabric,
    })
}

/// Writes the shape, the picture and the report; the report's text.
fn write(
    out: &Path,
    problem: &Problem,
    drape: &Settled,
    begin: Instant,
) -> Result<String, Box<dyn Error>> {
    let cloth = ClothMesh {
        lattice: &drape.lattice,
        positions: &drape.positions,
    };
    let caption = (!drape.converged).then_some("NOT AT REST");
    let view = View {
        caption,
        ..View::default()
    };
    let picture = output::picture(&cloth, &output::body_meshes(&problem.bodies), &view);
    let report = output::report(
        drape,
        &Run {
            title: "a disc over a mesh",
            fabric: "c",
            seconds: begin.elapsed().as_secs_f64(),
            threads: std::thread::available_parallelism()?.get(),
        },
    );
    output::write(
        &out.join("drape.obj"),
        output::obj("a disc over a mesh", &cloth).as_bytes(),
    )?;
    output::write(&out.join("drape.png"), &picture)?;
    output::write(&out.join("report.json"), report.as_bytes())?;
    Ok(report)
}
