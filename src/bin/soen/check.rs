//! `soen check SCENE`: what was understood, and whether a drape can begin, solving nothing.

use crate::{
    failure::{DONE, Failure},
    say,
};
use soen::{
    body::Nature,
    lattice::Outline,
    scene::{self, InspectedMesh, Scene},
    solver::{self, ForceModel, Grip, Hold},
};
use std::{fmt::Write, path::Path, process::ExitCode};

pub(crate) fn check(path: &Path) -> Result<ExitCode, Failure> {
    let scene = scene::read(path)?;
    let lattice = solver::prepare(&scene.problem).map_err(|error| scene.refusal(error))?;
    say(&understood(&scene, lattice.coordinates.len()))?;
    Ok(DONE)
}

fn understood(scene: &Scene, nodes: usize) -> String {
    let mut text = String::new();
    let mut line = |key: &str, value: String| {
        // A String takes all that is written.
        let _ = writeln!(text, "{key:11}{value}");
    };
    let problem = &scene.problem;
    let fabric = &problem.fabric;
    line("title", scene.title.clone());
    let file = scene.fabric_file.display();
    line(
        "fabric",
        format!("{} ({}; {file})", fabric.name, fabric.source),
    );
    line("", format!("{} gf/cm²", fabric.weight));
    line("cloth", cloth(&problem.piece.outline));
    let degrees = problem.piece.grain.to_degrees();
    line(
        "",
        format!(
            "grain {degrees}°, spacing {} cm, {nodes} nodes",
            problem.piece.pitch
        ),
    );
    let [x, y, z]: [f64; 3] = problem.placement.centre.into();
    line("", format!("starts flat about ({x}, {y}, {z}) cm"));
    for each in &problem.holds {
        line("hold", hold(each));
    }
    for part in problem.bodies.parts() {
        let nature = match part.nature() {
            Nature::Solid => "solid",
            Nature::Sheet => "open: a sheet with two sides",
        };
        line("body", format!("{}: {nature}", part.name()));
    }
    for mesh in &scene.meshes {
        line("mesh", inspected(mesh));
    }
    line(
        "contact",
        format!(
            "friction {}, thickness {} cm",
            problem.friction, problem.thickness
        ),
    );
    line("solve", solve(scene));
    text
}

fn cloth(outline: &Outline) -> String {
    let (low, high) = outline.bounds();
    let size = high - low;
    format!(
        "{:.4} × {:.4} cm, {:.4} cm² of cloth",
        size.x,
        size.y,
        outline.area()
    )
}

fn hold(hold: &Hold) -> String {
    let mut text = match hold.grip {
        Grip::Point(at) => format!("the node nearest ({}, {}) cm", at.x, at.y),
        Grip::Edge(edge) => format!("edge {edge:?}"),
    };
    if hold.clamp {
        text += ", clamped";
    }
    if hold.carry.norm() > 0.0 {
        let [x, y, z]: [f64; 3] = hold.carry.into();
        text += &format!(", carried by ({x}, {y}, {z}) cm");
    }
    text
}

fn inspected(mesh: &InspectedMesh) -> String {
    let found = &mesh.inspection;
    let mut text = format!(
        "{}: {}: {} vertices, {} faces, {}",
        mesh.part,
        mesh.file.display(),
        found.vertices,
        found.triangles,
        if found.closed { "closed" } else { "open" },
    );
    for (count, what) in [
        (found.holes, "holes"),
        (found.flipped, "faces turned"),
        (found.degenerate, "degenerate faces left out"),
        (found.duplicate, "doubled faces left out"),
    ] {
        if count > 0 {
            text += &format!(", {count} {what}");
        }
    }
    text
}

fn solve(scene: &Scene) -> String {
    let problem = &scene.problem;
    let laws = problem.laws;
    let acting: Vec<&str> = [
        (laws.tension, "tension"),
        (laws.bending, "bending"),
        (laws.shear, "shear"),
    ]
    .into_iter()
    .filter_map(|(acts, law)| acts.then_some(law))
    .collect();
    let forces = match problem.forces {
        ForceModel::Lattice => "lattice",
        ForceModel::Paper => "paper",
    };
    format!(
        "tolerance {}, at most {} s, forces {forces}, laws {}, seed {}",
        scene.settings.tolerance,
        scene.max_seconds,
        acting.join(" "),
        problem.seed
    )
}
