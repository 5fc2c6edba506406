//! `soen lab verify`: every comparison in one table.

use crate::{
    drape::{stopped_by_ctrl_c, try_folder},
    failure::{DONE, Failure},
    say,
};
use soen::{
    fabric::SWATCHES,
    lab::{self, Comparison, Named},
    output, scene,
};
use std::{path::Path, process::ExitCode, sync::atomic::Ordering};

pub(super) fn verify(json: bool, out: Option<&Path>, quick: bool) -> Result<ExitCode, Failure> {
    let fabrics: Result<Vec<Named>, Failure> = SWATCHES
        .iter()
        .map(|(name, _)| Ok(((*name).to_owned(), scene::fabric(name)?)))
        .collect();
    if let Some(out) = out {
        try_folder(out)?;
    }
    let stop = stopped_by_ctrl_c()?;
    if !json {
        say(&head())?;
    }
    let mut closed = None;
    let rows = lab::verify(
        &fabrics?,
        quick,
        &mut |_| !stop.load(Ordering::Relaxed),
        &mut |row| {
            if !json && closed.is_none() {
                closed = say(&line(row)).err();
            }
        },
    );
    let rows = rows?;
    if let Some(failure) = closed {
        return Err(failure);
    }
    let table = output::comparisons(&rows);
    if let Some(out) = out {
        output::write(&out.join("verify.json"), table.as_bytes())?;
        output::write(
            &out.join("verify.md"),
            output::comparison_table(&rows).as_bytes(),
        )?;
    }
    let failed = rows
        .iter()
        .filter(|row| row.passes() == Some(false))
        .count();
    let judged = rows.iter().filter(|row| row.passes().is_some()).count();
    if json {
        say(&table)?;
    } else {
        let shown = rows.len() - judged;
        say(&format!(
            "{} of {judged} pass; {shown} more are shown\n",
            judged - failed
        ))?;
    }
    Ok(if failed == 0 { DONE } else { ExitCode::from(1) })
}

fn head() -> String {
    format!(
        "{:5}{:44}{:46}{:>12}{:>12}{:>9}  {:10}{}\n",
        "", "test", "quantity", "ours", "reference", "off", "allowed", "source"
    )
}

fn line(row: &Comparison) -> String {
    let verdict = match row.passes() {
        Some(true) => "pass",
        Some(false) => "MISS",
        None => "-",
    };
    format!(
        "{verdict:5}{:44}{:46}{:>12.5}{:>12.5}{:>7.2} %  {:10}{}\n",
        row.test,
        row.quantity,
        row.figure,
        row.reference,
        row.difference(),
        row.allowance(),
        row.source
    )
}
