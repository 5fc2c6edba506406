//! The certificate is honest: what it says is left to go is what is left.

use crate::specimen::hang_at;

/// Cloth over bodies, held by friction.
const RUBBING: [(&str, &str); 3] = [
    (
        "a ball",
        "[cloth]\nfabric = \"c\"\nsize_cm = [28, 28]\nspacing_cm = 1\ncentre_cm = [0, 0, 10.2]\n\
         [[body]]\nball = { radius_cm = 10 }\n[contact]\nfriction = 0.3\n",
    ),
    (
        "two balls",
        "[cloth]\nfabric = \"a\"\nsize_cm = [28, 24]\nspacing_cm = 1\ncentre_cm = [0, 0, 6.2]\n\
         [[body]]\nball = { radius_cm = 6 }\nat_cm = [-7, 0, 0]\n\
         [[body]]\nball = { radius_cm = 6 }\nat_cm = [7, 0, 0]\n[contact]\nfriction = 0.3\n",
    ),
    (
        "a table's edge",
        "[cloth]\nfabric = \"d\"\nsize_cm = [28, 20]\nspacing_cm = 1\ncentre_cm = [4, 0, 2.1]\n\
         [[body]]\ncuboid = { size_cm = [40, 40, 4] }\nat_cm = [-18, 0, 0]\n\
         [contact]\nfriction = 0.5\n",
    ),
];

/// Cloth that hangs free.
const HANGING: [(&str, &str); 3] = [
    (
        "two corners",
        "[cloth]\nfabric = \"c\"\nsize_cm = [28, 28]\nspacing_cm = 1\n\
         [[hold]]\npoint_cm = [-14, 14]\n[[hold]]\npoint_cm = [14, 14]\n",
    ),
    (
        "a vice",
        "[cloth]\nfabric = \"d\"\nsize_cm = [8, 1]\nspacing_cm = 0.25\n\
         [[hold]]\nedge = \"x-min\"\nclamp = true\n",
    ),
    (
        "two hands",
        "[cloth]\nfabric = \"a\"\nsize_cm = [60, 4]\nspacing_cm = 1\n\
         [[hold]]\nedge = \"x-min\"\n[[hold]]\nedge = \"x-max\"\nmove_cm = [-10, 0, 0]\n",
    ),
];

#[test]
fn cloth_held_by_friction_ends_where_its_certificate_says() {
    RUBBING.iter().for_each(check);
}

#[test]
fn hanging_cloth_ends_where_its_certificate_says() {
    HANGING.iter().for_each(check);
}

/// The same run, stopped at 1e-3 and carried on to 1e-6.
fn check((name, text): &(&str, &str)) {
    let stopped = hang_at(text, 1e-3, 1000);
    let rest = hang_at(text, 1e-6, 1000);
    let nodes = stopped.positions.len();
    assert!(stopped.converged, "{name}: {:?}", stopped.certificate);
    assert!(
        rest.certificate.residual_max <= 1e-6,
        "{name}: {:?}",
        rest.certificate
    );
    assert!(nodes > 100, "{name} has {nodes} nodes");
    let pairs = stopped.positions.iter().zip(&rest.positions);
    let way = pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    let said = stopped.certificate.remaining_move;
    assert!(way <= 2.0 * said, "{name}: {way} cm to go, {said} said");
    assert!(way <= 0.1, "{name}: {way} cm to go");
}
