//! One program of claims about the whole.
//!
//! - `layers`: modules name only what the code map allows.
//! - `cli`: every command, what it prints and how it exits.
//! - `bad_input`, `bad_files`: each slip gets its message and its exit code, and costs no file.
//! - `fuzz`: no bytes make the readers panic.

mod bad_files;
mod bad_input;
mod cli;
mod fuzz;
mod layers;
mod trial;
