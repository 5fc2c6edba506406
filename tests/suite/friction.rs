//! Where friction gives way.

use crate::specimen::hang;

#[test]
fn an_incline_holds_below_the_angle_of_friction_and_not_above() {
    for friction in [0.1_f64, 0.3, 0.5] {
        let limit = friction.atan().to_degrees();
        for degrees in [limit - 0.2, limit + 0.2] {
            let t = std::time::Instant::now();
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let height = 5.0;
            let text = format!(
                "[cloth]\nfabric = \"c\"\nsize_cm = [8, 8]\nspacing_cm = 1.0\n\
                 x_axis = [{cosine}, 0, {}]\ncentre_cm = [{}, 0, {}]\n\
                 [[body]]\ncuboid = {{ size_cm = [60, 60, 10] }}\nrotate_deg = [0, {degrees}, 0]\n\
                 [contact]\nfriction = {friction}\n",
                -sine,
                (height + 0.03) * sine,
                (height + 0.03) * cosine
            );
            let rest = hang(&text, 60);
            let moved = (rest.positions[40]
                - soen::math::Vec3::new((height + 0.03) * sine, 0.0, (height + 0.03) * cosine))
            .norm();
            println!(
                "{friction} {degrees} {} {moved:e} {:?} {:?} {:?}",
                rest.converged,
                rest.certificate,
                t.elapsed(),
                rest.levels
            );
        }
    }
}

#[test]
fn a_belt_slips_when_its_long_end_is_too_heavy() {
    let only = std::env::var("ONLY").unwrap_or_default();
    for (name, friction) in [
        ("a", 0.1),
        ("a", 0.3),
        ("a", 0.5),
        ("c", 0.1),
        ("c", 0.3),
        ("c", 0.5),
        ("d", 0.1),
        ("d", 0.3),
        ("d", 0.5),
    ] {
        if !only.is_empty() && only != name {
            continue;
        }
        let (mut low, mut high) = (0.9_f64, 1.02_f64);
        for _ in 0..6 {
            let part = 0.5 * (low + high);
            let t = std::time::Instant::now();
            let pi = core::f64::consts::PI;
            let grip = (friction * pi).exp();
            let (radius, short) = (5.0, 10.0);
            let bound = |short: f64| {
                short * grip + radius * 2.0 * friction / (1.0 + friction * friction) * (grip + 1.0)
            };
            let longest = bound(short);
            let long = part * longest;
            let length = short + long + pi * radius;
            let shift = 0.5 * (long - short);
            let pitch = 0.5;
            let text = format!(
                "[cloth]\nfabric = \"{name}\"\nsize_cm = [{length}, {}]\nspacing_cm = {pitch}\n\
             centre_cm = [{shift}, 0, 5.2]\n\
             [[body]]\ncylinder = {{ radius_cm = 4.995, height_cm = 20 }}\nrotate_deg = [90, 0, 0]\n\
             [contact]\nfriction = {friction}\nthickness_cm = 0.01\n",
                1.0 * pitch
            );
            let rest = hang(&text, 250);
            // The material that lies on top.
            let top = (0..rest.positions.len())
                .max_by(|a, b| rest.positions[*a].z.total_cmp(&rest.positions[*b].z))
                .unwrap();
            let material = rest.lattice.coordinates[top].x + shift - rest.positions[top].x;
            let (l1, l2) = (
                0.5 * length - shift + material - 0.5 * pi * radius,
                0.5 * length + shift - material - 0.5 * pi * radius,
            );
            println!(
                "{name} {friction} {part:.4} {} moved {material:.4} {l1:.3} {l2:.3} ratio {:.4} {} {:?}",
                rest.converged,
                l2 / bound(l1),
                rest.levels.last().unwrap().joint_steps,
                t.elapsed()
            );
            if rest.converged {
                low = part
            } else {
                high = part
            }
        }
    }
}
