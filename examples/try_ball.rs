//! scratch
use soen::{body::*, fabric::*, forces::Laws, lattice::*, math::*, solver::*};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: f64 = a[2].parse().unwrap();
    let d = |a, b, bend, shear| Direction {
        tension: Tension::Power { a, b },
        bending: bend,
        shear,
    };
    let fabric = Fabric {
        name: "c".into(),
        source: String::new(),
        weight: 0.014,
        thickness: 0.05,
        friction: Friction {
            body: 0.3,
            cloth: 0.4,
        },
        warp: d(3.8e5, 1.8, 0.0089, 18.0),
        weft: d(3.1e4, 1.7, 0.0057, 6.0),
    };
    let size = 100.0;
    let ball = Part::new(
        "ball".into(),
        &Shape::Ball { radius: 25.0 },
        Pose::translation(0.0, 0.0, 0.0),
    )
    .unwrap();
    let hang = a[1] == "hang";
    let hold = |x, y| Hold {
        grip: Grip::Point(Vec2::new(x, y)),
        clamp: false,
        carry: Vec3::zeros(),
    };
    let p = Problem {
        fabric,
        piece: Piece {
            outline: Outline::rectangle(size, size).unwrap(),
            grain: 0.0,
            pitch: size / (n - 1.0),
        },
        placement: Placement {
            centre: Vec3::new(0.0, 0.0, 26.0),
            x_axis: Vec3::x(),
            y_axis: Vec3::y(),
        },
        holds: if hang {
            vec![hold(-50.0, 50.0), hold(50.0, 50.0)]
        } else {
            vec![]
        },
        bodies: Bodies::new(if hang { vec![] } else { vec![ball] }),
        friction: 0.3,
        thickness: 0.05,
        laws: Laws::default(),
        forces: ForceModel::Lattice,
        seed: 1,
    };
    let t = std::time::Instant::now();
    let s = settle(
        &p,
        &Settings {
            tolerance: 1e-3,
            frames: 0,
        },
        &mut |_| t.elapsed().as_secs_f64() < 300.0,
    )
    .unwrap();
    println!(
        "{:?}\n{:?}\n{:?} {} s",
        s.certificate,
        s.shape,
        s.levels,
        t.elapsed().as_secs_f64()
    );
}
