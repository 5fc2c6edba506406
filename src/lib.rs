//! soen
pub mod math;
mod threads;
pub mod fabric;
pub mod lattice;
pub mod body;
pub mod forces;
pub mod contact;
pub mod certificate;
pub mod solver;
pub mod output;
pub mod scene;
