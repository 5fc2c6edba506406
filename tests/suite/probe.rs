use crate::{honesty, specimen::scene};
use soen::solver::{Progress, Settings, settle};
#[test]
fn probe() {
    let want = std::env::var("PROBE").unwrap_or_default();
    let tolerance: f64 = std::env::var("TOL")
        .unwrap_or_else(|_| "1e-6".into())
        .parse()
        .unwrap();
    for (name, text) in honesty::RUBBING.iter().chain(&honesty::HANGING) {
        if !name.contains(&want) {
            continue;
        }
        let scene = scene(text);
        let mut left: usize = std::env::var("ROUNDS")
            .unwrap_or_else(|_| "120".into())
            .parse()
            .unwrap();
        let t = std::time::Instant::now();
        let mut watch = |p: &Progress| {
            left -= 1;
            println!(
                "{name} {:?} {} {:e} {:e} {:?}",
                p.level,
                p.sweeps,
                p.residual,
                p.remaining_move,
                t.elapsed()
            );
            left > 0
        };
        let rest = settle(
            &scene.problem,
            &Settings {
                tolerance,
                ..scene.settings
            },
            &mut watch,
        )
        .unwrap();
        println!(
            "{} {:?} {:?}",
            rest.converged, rest.certificate, rest.levels
        );
    }
}
