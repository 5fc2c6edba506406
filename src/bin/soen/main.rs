//! `soen`: how measured cloth hangs, from the command line.

mod animate;
mod args;
mod check;
mod drape;
mod fabric;
mod failure;
mod files;
mod film;
mod fit;
mod lab;
mod progress;
mod robot;
mod schema;

use args::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::{
    io::{self, Write},
    process::ExitCode,
};

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Drape(wish) => drape::drape(&wish),
        Command::Animate(wish) => animate::animate(&wish),
        Command::Check { scene } => check::check(&scene),
        Command::Fabric { wish } => fabric::fabric(&wish),
        Command::Lab(wish) => lab::lab(&wish),
        Command::Robot(wish) => robot::robot(&wish),
        Command::Schema => schema::schema(),
    };
    done.unwrap_or_else(|failure| {
        // Where standard error is closed too, the exit code is all that is left to say it.
        let _ = writeln!(io::stderr(), "error: {failure}");
        failure.code()
    })
}

/// Prints on standard output.
fn say(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(|error| Failure::System(format!("cannot print: {error}")))
}
