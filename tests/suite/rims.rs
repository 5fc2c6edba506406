//! Cloth whose lattice is wide for the sharp rim that it hangs over: between two samples a rim
//! presses where the cloth is creased, on the edges and diagonals of its cells.

use crate::specimen::fabric;
use soen::lab::Drapemeter;

#[test]
fn a_wide_lattice_comes_to_rest_over_a_sharp_rim_however_it_is_laid() {
    let cloth = fabric("d");
    let meter = Drapemeter {
        pitch: 1.5,
        seeds: 8,
        ..Drapemeter::default()
    };
    let drapes = meter.run(&cloth, &mut |_| true).unwrap();
    for (laying, seed) in drapes.layings.iter().zip(1..) {
        let certificate = &laying.rest.settled.certificate;
        assert!(
            laying.rest.settled.converged,
            "seed {seed}: {certificate:?}"
        );
    }
}
