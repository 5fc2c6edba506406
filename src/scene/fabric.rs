//! Reads a fabric: one of the names that ship, or a file.

use super::{
    complaint::nearest,
    document::{At, Document, beside},
    error::{Fault, SceneError},
    format::{DirectionTable, FabricFile, TensionTable},
};
use crate::fabric::{
    Curve, Direction, Fabric, Friction, InvalidFabric, Quantity, SWATCHES, Tension, Yarn, swatch,
};
use std::path::{Path, PathBuf};

/// Reads a fabric by a name in `fabrics/`, one of the five that ship, or a path to a `.toml`.
///
/// A file `fabrics/NAME.toml` in the present folder comes before the fabric of that name that
/// ships, so that a copy can be edited.
///
/// # Errors
/// [`SceneError`] where there is no such fabric, or its file is none.
///
/// ```
/// let cloth = soen::scene::fabric("c")?;
/// assert_eq!(cloth.weight, 0.014);
/// # Ok::<(), soen::scene::SceneError>(())
/// ```
pub fn fabric(name: &str) -> Result<Fabric, SceneError> {
    read(&from_here(name)?)
}

/// The text of a fabric's file, named as in [`fabric`], once it has been checked.
///
/// # Errors
/// As [`fabric`].
pub fn fabric_text(name: &str) -> Result<String, SceneError> {
    let document = from_here(name)?;
    read(&document)?;
    Ok(document.text)
}

fn from_here(name: &str) -> Result<Document, SceneError> {
    let source = Source::find(Path::new(""), "fabric", name).map_err(|fault| SceneError {
        file: name.into(),
        place: None,
        fault: Box::new(fault),
    })?;
    source.document()
}

/// The fabric that a value of a scene names, and the file it is from.
pub(super) fn named(at: &At<'_>, name: &str) -> Result<(Fabric, PathBuf), SceneError> {
    let source = Source::find(at.document.folder(), &at.name(), name);
    let document = source.map_err(|fault| at.error(fault))?.document()?;
    Ok((read(&document)?, document.path))
}

/// Where a fabric's text is.
enum Source {
    File(PathBuf),
    /// Where it would be, and its text.
    Shipped(PathBuf, &'static str),
}

impl Source {
    fn find(folder: &Path, key: &str, name: &str) -> Result<Self, Fault> {
        let value = format!("{name:?}");
        if name.contains(['/', '\\']) || name.ends_with(".toml") {
            return match beside(folder, Path::new(name)) {
                Ok(path) => Ok(Self::File(path)),
                Err(tried) => Err(Fault::NoSuchFile {
                    key: key.into(),
                    value,
                    tried,
                }),
            };
        }
        let file = Path::new("fabrics").join(format!("{name}.toml"));
        match (beside(folder, &file), swatch(name)) {
            (Ok(path), _) => Ok(Self::File(path)),
            (Err(_), Some(text)) => Ok(Self::Shipped(file, text)),
            (Err(_), None) => Err(Fault::NotAllowed {
                key: key.into(),
                value,
                allowed: allowed_names(name),
            }),
        }
    }

    fn document(self) -> Result<Document, SceneError> {
        match self {
            Self::File(path) => Document::open(&path),
            Self::Shipped(path, text) => Document::new(path, text.into()),
        }
    }
}

fn allowed_names(wrong: &str) -> String {
    allowed_names_of(wrong, SWATCHES.iter().map(|(name, _)| *name), "fabrics")
}

/// The names that ship, and what else may stand in their place.
pub(super) fn allowed_names_of<'n>(
    wrong: &str,
    names: impl Iterator<Item = &'n str>,
    folder: &str,
) -> String {
    let names: Vec<&str> = names.collect();
    let guess = nearest(wrong, names.iter().copied())
        .map(|guess| format!("; did you mean {guess:?}?"))
        .unwrap_or_default();
    let names = names.join(", ");
    format!("{names}, the name of a file in {folder}/, or a path to a .toml{guess}")
}

fn read(document: &Document) -> Result<Fabric, SceneError> {
    let file: FabricFile = document.content()?;
    let top = document.top();
    let fabric = Fabric {
        name: file.name,
        source: file.source,
        weight: file.weight_gf_per_cm2,
        thickness: file.thickness_cm,
        friction: Friction {
            body: file.friction.body,
            cloth: file.friction.cloth,
        },
        twist: file.twist_gf_cm.unwrap_or(0.0),
        warp: direction(&top.key("warp"), &file.warp)?,
        weft: direction(&top.key("weft"), &file.weft)?,
    };
    fabric.checked().map_err(|InvalidFabric { quantity, .. }| {
        place_of(&top, quantity).not_allowed(quantity.allowed())
    })
}

fn direction(at: &At<'_>, table: &DirectionTable) -> Result<Direction, SceneError> {
    Ok(Direction {
        tension: tension(&at.key("tension"), &table.tension)?,
        bending: table.bending_gf_cm,
        shear: table.shear_gf_per_cm,
    })
}

fn tension(at: &At<'_>, table: &TensionTable) -> Result<Tension, SceneError> {
    // A and B belong together; B alone stands for both.
    let power = if table.b.is_some() && table.a_gf_per_cm.is_none() {
        ("b", true)
    } else {
        ("a_gf_per_cm", table.a_gf_per_cm.is_some())
    };
    at.exactly_one(&[
        power,
        ("linear_gf_per_cm", table.linear_gf_per_cm.is_some()),
        ("points", table.points.is_some()),
    ])?;
    if let Some(modulus) = table.linear_gf_per_cm {
        return Ok(Tension::Linear { modulus });
    }
    if let Some(points) = &table.points {
        let points: Vec<[f64; 2]> = points.iter().map(|point| point.0).collect();
        return Curve::new(&points).map(Tension::Points).map_err(|error| {
            let at = at.key("points");
            let key = at.name();
            at.error(Fault::Curve { key, error })
        });
    }
    let both = |value: Option<f64>, key: &str| {
        value.ok_or_else(|| {
            at.error(Fault::MissingKey {
                key: key.into(),
                table: at.name(),
            })
        })
    };
    Ok(Tension::Power {
        a: both(table.a_gf_per_cm, "a_gf_per_cm")?,
        b: both(table.b, "b")?,
    })
}

fn place_of<'d>(top: &At<'d>, quantity: Quantity) -> At<'d> {
    let along = |yarn: Yarn| top.key(&yarn.to_string());
    match quantity {
        Quantity::Weight => top.key("weight_gf_per_cm2"),
        Quantity::Thickness => top.key("thickness_cm"),
        Quantity::BodyFriction => top.key("friction").key("body"),
        Quantity::ClothFriction => top.key("friction").key("cloth"),
        Quantity::Twist => top.key("twist_gf_cm"),
        Quantity::PowerFactor(yarn) => along(yarn).key("tension").key("a_gf_per_cm"),
        Quantity::PowerExponent(yarn) => along(yarn).key("tension").key("b"),
        Quantity::LinearModulus(yarn) => along(yarn).key("tension").key("linear_gf_per_cm"),
        Quantity::Bending(yarn) => along(yarn).key("bending_gf_cm"),
        Quantity::Shear(yarn) => along(yarn).key("shear_gf_per_cm"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn power(direction: &Direction) -> (f64, f64, f64, f64) {
        match direction.tension {
            Tension::Power { a, b } => (a, b, direction.bending, direction.shear),
            _ => panic!("{direction:?}"),
        }
    }

    #[test]
    fn the_five_fabrics_are_tables_1_and_2() {
        let rows = [
            (
                "a",
                0.0035,
                (4.0e4, 1.7, 0.0060, 1.0),
                (3.8e5, 2.3, 0.0060, 1.0),
            ),
            (
                "b",
                0.0026,
                (1.8e3, 1.5, 0.0057, 0.0),
                (8.1e5, 2.5, 0.0025, 0.5),
            ),
            (
                "c",
                0.014,
                (3.8e5, 1.8, 0.0089, 18.0),
                (3.1e4, 1.7, 0.0057, 6.0),
            ),
            (
                "d",
                0.023,
                (2.7e4, 1.4, 0.18, 84.0),
                (5.6e3, 1.2, 0.13, 64.0),
            ),
            (
                "washi",
                0.0050,
                (5.2e6, 1.9, 0.23, 4500.0),
                (2.4e8, 2.3, 0.66, 11000.0),
            ),
        ];
        assert_eq!(rows.len(), SWATCHES.len());
        for (name, weight, warp, weft) in rows {
            let fabric = fabric(name).unwrap();
            assert_eq!(fabric.weight, weight, "{name}");
            assert_eq!(power(&fabric.warp), warp, "{name} warp");
            assert_eq!(power(&fabric.weft), weft, "{name} weft");
            assert_eq!(fabric.source, "Soen, tables 1 and 2");
            assert_eq!(fabric.twist, 0.0, "the paper's lattice has none");
        }
    }

    fn of(text: &str) -> Result<Fabric, SceneError> {
        read(&Document::new("f.toml".into(), text.into()).unwrap())
    }

    fn with_tension(tension: &str) -> String {
        let text = swatch("c").unwrap();
        text.replace("{ a_gf_per_cm = 3.8e5, b = 1.8 }", tension)
    }

    #[test]
    fn the_other_two_laws_are_read() {
        let linear = of(&with_tension("{ linear_gf_per_cm = 1900.0 }")).unwrap();
        assert_eq!(linear.warp.tension, Tension::Linear { modulus: 1900.0 });
        let points = of(&with_tension("{ points = [[0.0, 0.0], [0.01, 2.1]] }")).unwrap();
        assert!((points.warp.tension.tension(0.01, 0.0) - 2.1).abs() < 1e-12);
    }

    #[test]
    fn twist_is_read_where_it_is_given() {
        let text = swatch("c").unwrap();
        let twisted = text.replace("[warp]", "twist_gf_cm = 0.01\n[warp]");
        assert_eq!(of(&twisted).unwrap().twist, 0.01);
    }

    #[test]
    fn a_value_out_of_range_is_shown_where_it_stands() {
        let error = of(&with_tension("{ a_gf_per_cm = -1.0, b = 1.8 }")).unwrap_err();
        let message = error.to_string();
        assert!(message.contains("warp.tension.a_gf_per_cm is -1.0; allowed: 0.001 to"));
        assert!(message.ends_with("^^^^"), "{message}");
    }

    #[test]
    fn laws_exclude_each_other_and_need_both_numbers() {
        let message = |tension| of(&with_tension(tension)).unwrap_err().to_string();
        assert!(message("{ a_gf_per_cm = 1.0 }").contains("missing key \"b\" in [warp.tension]"));
        assert!(message("{}").contains("missing key \"one of "));
        assert!(
            message("{ linear_gf_per_cm = 1.0, b = 1.0 }").contains("b, linear_gf_per_cm exclude")
        );
        assert!(message("{ points = [[0.1, 1.0], [0.1, 2.0]] }").contains("not above"));
    }

    #[test]
    fn an_unknown_name_is_answered_with_the_known_ones() {
        let message = fabric("wash").unwrap_err().to_string();
        assert!(message.contains("a, b, c, d, washi"), "{message}");
        assert!(message.contains("did you mean \"washi\"?"), "{message}");
    }
}
