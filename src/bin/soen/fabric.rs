//! `soen fabric list`, `soen fabric show NAME` and `soen fabric fit SHEET`.

use crate::{
    args::FabricWish,
    failure::{DONE, Failure},
    fit, say,
};
use soen::{
    fabric::{Direction, Fabric, SWATCHES, Tension},
    scene,
};
use std::process::ExitCode;

pub(crate) fn fabric(wish: &FabricWish) -> Result<ExitCode, Failure> {
    match wish {
        FabricWish::List => say(&list()?)?,
        FabricWish::Show { name } => say(&scene::fabric_text(name)?)?,
        FabricWish::Fit(wish) => fit::fit(wish)?,
    }
    Ok(DONE)
}

fn list() -> Result<String, Failure> {
    let mut text = format!(
        "{:8}{:10}{:>10}{:>14}{:>20}{:>14}\n{:8}{:10}{:>10}{:>14}{:>20}{:>14}\n",
        "name", "", "weight", "", "bending", "shear", "", "", "gf/cm²", "", "gf·cm", "gf/cm"
    );
    for (name, _) in SWATCHES {
        text += &row(name, &scene::fabric(name)?);
    }
    Ok(text)
}

fn row(name: &str, fabric: &Fabric) -> String {
    let Fabric { warp, weft, .. } = fabric;
    let both = |of: fn(&Direction) -> f64| format!("{} / {}", of(warp), of(weft));
    format!(
        "{name:8}{:10}{:>10}{:>14}{:>20}{:>14}\n",
        fabric.name,
        fabric.weight,
        law(&warp.tension),
        both(|direction| direction.bending),
        both(|direction| direction.shear),
    )
}

fn law(tension: &Tension) -> &'static str {
    match tension {
        Tension::Power { .. } => "A·S^(B+1)",
        Tension::Linear { .. } => "M_T·S",
        Tension::Points(_) => "measured",
    }
}
