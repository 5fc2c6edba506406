//! Makes `bodies/dress-form.obj`, a tailor's dress form of size 9AR, from published girths.
//!
//! 1. `form` is a smooth solid: rounded sections at levels up the trunk, two mounds, shoulders,
//!    a neck.
//! 2. `surface` covers it with triangles.
//! 3. `tape` measures the girths of what came of it, and the sections of `form` are widened or
//!    narrowed until they are the published ones.
//!
//! Run it in the crate's folder: `cargo run --example make_dress_form`.

mod form;
mod surface;
mod tape;

use std::{fmt::Write, fs, io};

use form::Form;
use soen::body::{Mesh, MeshError};

/// A girth, its level and its source.
pub(crate) struct Girth {
    name: &'static str,
    /// Height above the ground [cm]: a share of the stature.
    height_cm: f64,
    girth_cm: f64,
    source: &'static str,
}

/// A woman of 158 cm, JIS size 9AR.
pub(crate) const GIRTHS: [Girth; 4] = [
    Girth {
        name: "hip",
        height_cm: 78.2,
        girth_cm: 91.0,
        source: "JIS L 4005, 9AR; level 0.495 of the stature",
    },
    Girth {
        name: "waist",
        height_cm: 98.0,
        girth_cm: 64.0,
        source: "JIS L 4005, 9AR; level 0.62 of the stature",
    },
    Girth {
        name: "bust",
        height_cm: 113.8,
        girth_cm: 83.0,
        source: "JIS L 4005, 9AR; level 0.72 of the stature",
    },
    Girth {
        name: "neck",
        height_cm: 135.1,
        girth_cm: 32.0,
        source: "habit of dress forms, mid neck; level 0.855 of the stature",
    },
];

/// Distance between vertices [cm]. The grid that they come from must not just touch the surface
/// somewhere: at 1.35 it does between the shoulder blades, and leaves faces a tenth as large.
const PITCH: f64 = 1.31;

const PATH: &str = "bodies/dress-form.obj";

fn main() -> io::Result<()> {
    let mesh = dress_form().map_err(io::Error::other)?;
    fs::write(PATH, obj(&mesh))
}

/// The form whose girths are the published ones; each round leaves half the error at most.
fn dress_form() -> Result<Mesh, MeshError> {
    let mut form = Form::default();
    loop {
        let (vertices, triangles) = surface::cover(&|p| form.depth(p), PITCH);
        let mesh = Mesh::new(vertices, triangles)?;
        let mut worst: f64 = 0.0;
        for (girth, scale) in GIRTHS.iter().zip(&mut form.scales) {
            let measured = tape::girth(&mesh, girth.height_cm);
            worst = worst.max((measured - girth.girth_cm).abs());
            *scale *= girth.girth_cm / measured;
        }
        if worst < 0.05 {
            return Ok(mesh);
        }
    }
}

/// Rounds to 0.001 cm, so that the file does not depend on a last bit.
fn obj(mesh: &Mesh) -> String {
    let mut text = String::from(
        "# A tailor's dress form, size 9AR: cm, z up, front towards -y, heights above the ground.\n\
         # Made by examples/make_dress_form of soen from published girths:\n",
    );
    for Girth {
        name,
        height_cm,
        girth_cm,
        source,
    } in GIRTHS
    {
        let _ = writeln!(
            text,
            "#   {name} {girth_cm} cm at {height_cm} cm ({source})"
        );
    }
    text += "#   shoulder breadth 35.5 cm (AIST 1997-98, biacromial, women of 155 to 160 cm)\n\
             # Licence: MIT OR Apache-2.0\n";
    for v in &mesh.vertices {
        let _ = writeln!(text, "v {:.3} {:.3} {:.3}", v.x, v.y, v.z);
    }
    for [a, b, c] in &mesh.triangles {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text
}

#[cfg(test)]
mod tests;
