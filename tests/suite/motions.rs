//! Captures and keyframes on a skeleton.

mod bad;
mod captures;
mod gait;
mod woman;
