//! Captures and keyframes on a skeleton.

#![allow(
    clippy::print_stdout,
    reason = "figures are for whoever runs the tests with --nocapture"
)]

mod bad;
mod captures;
mod gait;
