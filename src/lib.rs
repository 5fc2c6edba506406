//! soen
pub mod math;
