//! `soen lab …`: the laboratory's instruments on the simulated cloth.

use crate::{
    args::{LabTest, LabWish},
    failure::{DONE, Failure, uncertified},
    progress::Teller,
    say,
};
use soen::{
    fabric::Fabric,
    lab::{self, LabError, Reading},
    output::{self, ClothMesh, View},
    scene,
    solver::Progress,
};
use std::process::ExitCode;

pub(crate) fn lab(wish: &LabWish) -> Result<ExitCode, Failure> {
    let fabric = scene::fabric(&wish.fabric)?;
    let teller = Teller::new();
    let mut watch = |_: &Progress| true;
    let reading = run(&wish.test, &fabric, &mut watch);
    teller.end();
    let reading = reading.map_err(|error| Failure::Input(error.to_string()))?;
    let text = output::reading(&reading, &wish.fabric);
    say(&text)?;
    Ok(if reading.certified { DONE } else { uncertified() })
}
