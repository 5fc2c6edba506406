//! Same scene, same seed, same bits: whatever the number of threads, and again.

use crate::specimen::hang;
use soen::solver::Settled;

/// Enough nodes that sweeps, touches and fronts are all shared out over threads.
const SCENE: &str = "[cloth]\nfabric = \"c\"\nsize_cm = [30, 30]\nspacing_cm = 0.75\n\
    centre_cm = [0, 0, 10.2]\n[[body]]\nball = { radius_cm = 10 }\n[contact]\nfriction = 0.3\n";
/// Rounds of sweeps and joint steps: the cloth is on its way, with folds begun.
const ROUNDS: usize = 40;

#[test]
fn one_two_and_seven_threads_give_the_same_bits() {
    let one = bits(&on_threads(1));
    assert!(one == bits(&on_threads(2)), "1 thread and 2");
    assert!(one == bits(&on_threads(7)), "1 thread and 7");
}

#[test]
fn two_runs_give_the_same_bits_and_another_seed_does_not() {
    let first = bits(&hang(SCENE, ROUNDS));
    assert!(first == bits(&hang(SCENE, ROUNDS)), "twice the same");
    let seeded = format!("seed = 2\n{SCENE}");
    assert!(
        first != bits(&hang(&seeded, ROUNDS)),
        "the seed makes no difference"
    );
}

fn on_threads(count: usize) -> Settled {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    pool.unwrap().install(|| hang(SCENE, ROUNDS))
}

/// All that a run is measured by, to the last bit.
fn bits(settled: &Settled) -> Vec<u64> {
    let certificate = &settled.certificate;
    let figures = [
        certificate.residual_max,
        certificate.residual_rms,
        certificate.remaining_move,
        certificate.deepest,
        settled.shape.energy,
    ];
    let positions = settled.positions.iter().flatten();
    let numbers = positions.chain(&settled.contact).chain(&figures);
    numbers.map(|number| number.to_bits()).collect()
}
