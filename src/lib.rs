//! soen
pub mod body;
pub mod certificate;
pub mod contact;
pub mod fabric;
pub mod forces;
pub mod lattice;
pub mod math;
pub mod output;
pub mod scene;
pub mod solver;
mod threads;
