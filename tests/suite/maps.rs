//! Heat maps from the command line, on cloths whose values are known beforehand.

use crate::{picture::pixels, trial::Trial};
use ply_rs_bw::{
    parser::Parser,
    ply::{DefaultElement, Property},
};
use std::{fmt::Write, fs};

/// Cloth C lying on a table. Nothing pulls at it, so that each point of it is carried by what is
/// right below.
const LYING: &str = r#"[cloth]
fabric = "c"
size_cm = [10.0, 10.0]
spacing_cm = 1.0
centre_cm = [0.0, 0.0, 1.0]
[[body]]
cuboid = { size_cm = [20.0, 20.0, 4.0] }
at_cm = [0.0, 0.0, -2.0]
[contact]
thickness_cm = 0.05
"#;

#[test]
fn a_cloth_that_lies_flat_presses_with_its_weight_at_half_its_thickness() {
    let maps = drape(LYING, &["contact-pressure", "gap"]);
    // 0.014 gf/cm², and 1 gf/cm² is 0.0980665 kPa.
    let pressure = 0.014 * 0.098_066_5;
    for found in maps.column("contact_pressure_kpa") {
        assert!((found / pressure - 1.0).abs() < 1e-3, "{found} kPa");
    }
    // Half the thickness, and up to a fifth of it more on the skin that carries the cloth.
    for (found, height) in maps.column("gap_cm").zip(maps.column("z")) {
        assert!((0.025..0.035).contains(&found), "{found} cm");
        assert!((found - height).abs() < 1e-7, "{found} at {height} cm");
    }
    for name in ["contact-pressure", "gap"] {
        let [low, high] = maps.legend(name);
        assert!(low.iter().all(|channel| *channel < 110), "violet: {low:?}");
        assert!(high[0].min(high[1]) > 200 && high[2] < 130, "{high:?}");
    }
}

/// Every node is held, and carried so that the warp is 3 % longer, the weft 2 % shorter, and the
/// angle between them 80 degrees. (Such a cloth once made the program panic: a joint system without
/// unknowns had a front without columns.)
#[test]
fn a_cloth_that_is_pulled_evenly_shows_strain_and_shear() {
    let (warp, weft) = (1.03, 0.98);
    let (sin, cos) = f64::to_radians(10.0).sin_cos();
    let mut scene = "[cloth]\nfabric = \"c\"\nsize_cm = [4, 4]\nspacing_cm = 2\n".to_owned();
    for (x, y) in (0..9).map(|node| (f64::from(node % 3 - 1) * 2.0, f64::from(node / 3 - 1) * 2.0))
    {
        let (right, up) = (warp * x + weft * sin * y - x, weft * cos * y - y);
        let _ = writeln!(
            scene,
            "[[hold]]\npoint_cm = [{x}, {y}]\nmove_cm = [{right}, {up}, 0]"
        );
    }
    let maps = drape(&scene, &["strain-warp", "strain-weft", "shear"]);
    for (name, expected) in [
        ("strain_warp", 0.03),
        ("strain_weft", -0.02),
        ("shear_deg", 10.0),
    ] {
        for found in maps.column(name) {
            assert!(
                (found / expected - 1.0).abs() < 1e-5,
                "{name}: {found}, not {expected}"
            );
        }
    }
    for name in ["strain-warp", "strain-weft"] {
        let [low, high] = maps.legend(name);
        assert!(
            low[2] > low[0].saturating_add(50),
            "blue at the foot: {low:?}"
        );
        assert!(
            high[0] > high[2].saturating_add(50),
            "orange at the top: {high:?}"
        );
    }
}

/// What `drape` wrote.
struct Maps {
    trial: Trial,
    rows: Vec<DefaultElement>,
}

#[track_caller]
fn drape(scene: &str, names: &[&str]) -> Maps {
    let trial = Trial::new();
    trial.put("scene.toml", scene.as_bytes());
    let options = names.iter().flat_map(|name| ["--map", name]);
    let arguments: Vec<&str> = ["drape", "scene.toml", "--out", "new"]
        .into_iter()
        .chain(options)
        .collect();
    let said = trial.run(&arguments);
    assert_eq!(said.code, 0, "{}{}", said.err, said.out);
    let ply = fs::read(trial.path().join("new/drape.ply")).unwrap();
    let read = Parser::<DefaultElement>::new().read_ply(&mut &ply[..]);
    let rows = read.unwrap().payload.swap_remove("vertex").unwrap();
    Maps { trial, rows }
}

impl Maps {
    /// The values of all nodes in the table for measuring programs.
    fn column(&self, name: &str) -> impl Iterator<Item = f64> {
        self.rows.iter().map(move |row| match row[name] {
            Property::Float(value) => f64::from(value),
            Property::Double(value) => value,
            _ => panic!("{name} is no number"),
        })
    }

    /// The legend's colours at its foot and at its top.
    fn legend(&self, name: &str) -> [[u8; 3]; 2] {
        let path = format!("new/map-{name}.png");
        let png = fs::read(self.trial.path().join(path)).unwrap();
        let (size, channels) = pixels(&png);
        assert_eq!(size, [1200, 900]);
        [682, 217].map(|row| {
            let at = 3 * (row * 1200 + 975);
            [channels[at], channels[at + 1], channels[at + 2]]
        })
    }
}
