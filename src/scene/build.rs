//! Lowers a scene file to what the solver takes.

use super::{
    document::{Allowed, At},
    error::{Fault, SceneError},
    format::{
        ClothTable, ContactTable, EdgeWord, ForcesWord, HoldTable, LawWord, Numbers, SolveTable,
        Table,
    },
};
use crate::{
    fabric::{Fabric, Quantity},
    forces::Laws,
    lattice::{Edge, Outline, OutlineError, Piece},
    math::{Vec2, Vec3},
    solver::{ForceModel, Grip, Hold, Placement, Unsolvable},
};

const SIZE: Allowed = Allowed::new(0.01, 1e4, "cm");
const SPACING: Allowed = Allowed::new(0.01, 50.0, "cm");
const PLACE: Allowed = Allowed::new(-1e5, 1e5, "cm");
const GRAIN: Allowed = Allowed::new(-360.0, 360.0, "degrees");
const TOLERANCE: Allowed = Allowed::new(1e-12, 1.0, "");
const SECONDS: Allowed = Allowed::new(0.0, 1e7, "seconds");

/// Above the residual's own rounding by far, below what a picture shows.
const USUAL_TOLERANCE: f64 = 1e-3;
const USUAL_SECONDS: f64 = 600.0;

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stop {
    pub(super) tolerance: f64,
    pub(super) max_seconds: f64,
}

pub(super) fn piece(at: &At<'_>, cloth: &ClothTable) -> Result<Piece, SceneError> {
    let grain = at.key("grain_deg").number(cloth.grain_deg, &GRAIN)?;
    Ok(Piece {
        pitch: at.key("spacing_cm").number(cloth.spacing_cm, &SPACING)?,
        grain: grain.to_radians(),
        outline: outline(at, cloth)?,
    })
}

fn outline(at: &At<'_>, cloth: &ClothTable) -> Result<Outline, SceneError> {
    let which = at.exactly_one(&[
        ("size_cm", cloth.size_cm.is_some()),
        ("disc_radius_cm", cloth.disc_radius_cm.is_some()),
        ("outline_cm", cloth.outline_cm.is_some()),
    ])?;
    if cloth.holes_cm.is_some() && cloth.outline_cm.is_none() {
        let place = at.key("holes_cm");
        return Err(place.error(Fault::TooManyKeys {
            found: format!("{which}, holes_cm"),
            table: at.name(),
        }));
    }
    let at_outline = at.key(which);
    let refused = |error: OutlineError| {
        let key = at_outline.name();
        at_outline.error(Fault::Outline { key, error })
    };
    if let Some(Numbers(size)) = cloth.size_cm {
        let [width, height] = at_outline.numbers(size, &SIZE)?;
        return Outline::rectangle(width, height).map_err(refused);
    }
    if let Some(radius) = cloth.disc_radius_cm {
        let radius = at_outline.number(radius, &SIZE)?;
        return Outline::disc(radius).map_err(refused);
    }
    let points = ring(&at_outline, cloth.outline_cm.as_deref().unwrap_or_default())?;
    let mut holes = Vec::new();
    for (item, hole) in cloth.holes_cm.iter().flatten().enumerate() {
        holes.push(ring(&at.key("holes_cm").item(item), hole)?);
    }
    Outline::polygon(points, holes).map_err(refused)
}

fn ring(at: &At<'_>, points: &[Numbers<2>]) -> Result<Vec<Vec2>, SceneError> {
    let checked = |(item, point): (usize, &Numbers<2>)| {
        let point = at.item(item).numbers(point.0, &PLACE)?;
        Ok(Vec2::from(point))
    };
    points.iter().enumerate().map(checked).collect()
}

pub(super) fn placement(at: &At<'_>, cloth: &ClothTable) -> Result<Placement, SceneError> {
    let centre = cloth.centre_cm.map_or([0.0; 3], |Numbers(centre)| centre);
    let x_axis = axis(&at.key("x_axis"), cloth.x_axis, Vec3::x())?;
    let y_axis = axis(&at.key("y_axis"), cloth.y_axis, Vec3::y())?;
    if x_axis.dot(&y_axis).abs() > 1e-6 {
        let key = if cloth.y_axis.is_some() {
            "y_axis"
        } else {
            "x_axis"
        };
        return Err(at
            .key(key)
            .not_allowed("x_axis and y_axis at a right angle"));
    }
    Ok(Placement {
        centre: at.key("centre_cm").numbers(centre, &PLACE)?.into(),
        x_axis,
        y_axis,
        curl: 0.0,
    })
}

fn axis(at: &At<'_>, given: Option<Numbers<3>>, usual: Vec3) -> Result<Vec3, SceneError> {
    let Some(Numbers(given)) = given else {
        return Ok(usual);
    };
    let axis = Vec3::from(given);
    let length = axis.norm();
    if (1e-6..=1e6).contains(&length) {
        Ok(axis / length)
    } else {
        Err(at.not_allowed("a direction of length 1e-6 to 1e6"))
    }
}

pub(super) fn holds(at: &At<'_>, tables: &[Table<HoldTable>]) -> Result<Vec<Hold>, SceneError> {
    let tables = tables.iter().enumerate();
    tables
        .map(|(item, table)| hold(&at.item(item), table))
        .collect()
}

fn hold(at: &At<'_>, table: &HoldTable) -> Result<Hold, SceneError> {
    at.exactly_one(&[
        ("point_cm", table.point_cm.is_some()),
        ("edge", table.edge.is_some()),
    ])?;
    let grip = match (table.point_cm, table.edge) {
        (_, Some(edge)) => Grip::Edge(match edge {
            EdgeWord::XMin => Edge::XMin,
            EdgeWord::XMax => Edge::XMax,
            EdgeWord::YMin => Edge::YMin,
            EdgeWord::YMax => Edge::YMax,
        }),
        (point, None) => {
            let point = point.map_or([0.0; 2], |Numbers(point)| point);
            Grip::Point(at.key("point_cm").numbers(point, &PLACE)?.into())
        }
    };
    let carry = table.move_cm.map_or([0.0; 3], |Numbers(carry)| carry);
    Ok(Hold {
        grip,
        clamp: table.clamp,
        carry: at.key("move_cm").numbers(carry, &PLACE)?.into(),
    })
}

/// Friction and thickness of the contact: the scene's or, failing those, the fabric's.
pub(super) fn contact(
    at: &At<'_>,
    table: &ContactTable,
    fabric: &Fabric,
) -> Result<(f64, f64), SceneError> {
    let checked = |key: &str, given: Option<f64>, usual: f64, quantity: Quantity| match given {
        Some(value) if !quantity.range().contains(&value) => {
            Err(at.key(key).not_allowed(quantity.allowed()))
        }
        Some(value) => Ok(value),
        None => Ok(usual),
    };
    Ok((
        checked(
            "friction",
            table.friction,
            fabric.friction.body,
            Quantity::BodyFriction,
        )?,
        checked(
            "thickness_cm",
            table.thickness_cm,
            fabric.thickness,
            Quantity::Thickness,
        )?,
    ))
}

pub(super) fn stop(at: &At<'_>, table: &SolveTable) -> Result<Stop, SceneError> {
    let tolerance = table.tolerance.unwrap_or(USUAL_TOLERANCE);
    let max_seconds = table.max_seconds.unwrap_or(USUAL_SECONDS);
    Ok(Stop {
        tolerance: at.key("tolerance").number(tolerance, &TOLERANCE)?,
        max_seconds: at.key("max_seconds").number(max_seconds, &SECONDS)?,
    })
}

pub(super) fn laws(at: &At<'_>, table: &SolveTable) -> Result<Laws, SceneError> {
    let Some(words) = &table.laws else {
        return Ok(Laws {
            tension: true,
            bending: true,
            shear: true,
        });
    };
    let laws = Laws {
        tension: words.contains(&LawWord::Tension),
        bending: words.contains(&LawWord::Bending),
        shear: words.contains(&LawWord::Shear),
    };
    if words.is_empty() {
        return Err(at
            .key("laws")
            .not_allowed("one or more of \"tension\", \"bending\", \"shear\""));
    }
    Ok(laws)
}

pub(super) fn forces(table: &SolveTable) -> ForceModel {
    match table.forces {
        ForcesWord::Lattice => ForceModel::Lattice,
        ForcesWord::Paper => ForceModel::Paper,
    }
}

/// The place of a scene to which the solver's refusal belongs.
pub(super) fn place_of<'d>(top: &At<'d>, refusal: &Unsolvable) -> At<'d> {
    let cloth = top.key("cloth");
    match refusal {
        Unsolvable::Cut(_) => cloth.key("spacing_cm"),
        Unsolvable::HoldOutside { index, .. } => {
            let hold = top.key("hold").item(index.saturating_sub(1));
            hold.key("point_cm")
        }
        Unsolvable::StartsInside { .. } => cloth.key("centre_cm"),
        Unsolvable::Pace { .. } => top.key("animation"),
        _ => cloth,
    }
}
