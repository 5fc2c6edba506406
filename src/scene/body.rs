//! Lowers bodies: shapes to parts, body files to the parts they list.

use super::{
    actor,
    document::{Allowed, At, Document, mesh_bytes},
    error::{Fault, SceneError},
    format::{BodyFile, BodyTable, HullTable, Numbers, Table, UnitWord, UpWord},
};
use crate::{
    body::{Format, Inspection, Mesh, Part, Shape, Unit, Up},
    math::{Pose, Vec3, turn_in_order},
    play::{Cast, Member},
};
use std::path::{Path, PathBuf};

/// Body files within body files: enough for a hand on an arm on a trunk, too few for a ring.
const DEEPEST: usize = 8;

const LENGTH: Allowed = Allowed::new(0.01, 1e4, "cm");
const PLACE: Allowed = Allowed::new(-1e5, 1e5, "cm");
const TURN: Allowed = Allowed::new(-3600.0, 3600.0, "degrees");
const SCALE: Allowed = Allowed::new(1e-6, 1e6, "");

/// A mesh that was read for a part.
#[derive(Clone, Debug, PartialEq)]
pub struct InspectedMesh {
    /// The part it belongs to.
    pub part: String,
    /// Its file.
    pub file: PathBuf,
    /// What was found in it.
    pub inspection: Inspection,
}

/// What the bodies of a scene were lowered to.
#[derive(Debug, Default)]
pub(super) struct Solids {
    pub(super) cast: Cast,
    pub(super) meshes: Vec<InspectedMesh>,
}

impl Solids {
    /// Adds the bodies of a list.
    pub(super) fn add_all(
        &mut self,
        at: &At<'_>,
        bodies: &[Table<BodyTable>],
    ) -> Result<(), SceneError> {
        let here = Frame {
            pose: Pose::identity(),
            name: String::new(),
            depth: 0,
        };
        self.add_list(at, bodies, "body", &here)
    }

    fn add_list(
        &mut self,
        at: &At<'_>,
        bodies: &[Table<BodyTable>],
        kind: &str,
        frame: &Frame,
    ) -> Result<(), SceneError> {
        for (item, body) in bodies.iter().enumerate() {
            let own = match &body.name {
                Some(name) => name.clone(),
                None => format!("{kind} {}", item + 1),
            };
            self.add(&at.item(item), body, &frame.within(&own))?;
        }
        Ok(())
    }

    fn add(&mut self, at: &At<'_>, body: &BodyTable, frame: &Frame) -> Result<(), SceneError> {
        let which = at.exactly_one(&[
            ("ball", body.ball.is_some()),
            ("capsule", body.capsule.is_some()),
            ("cuboid", body.cuboid.is_some()),
            ("cylinder", body.cylinder.is_some()),
            ("cone", body.cone.is_some()),
            ("convex_hull", body.convex_hull.is_some()),
            ("mesh", body.mesh.is_some()),
            ("robot", body.robot.is_some()),
            ("file", body.file.is_some()),
        ])?;
        let frame = frame.turned(pose(at, body)?);
        let at = at.key(which);
        if let Some(file) = &body.file {
            return self.add_file(&at, file, &frame);
        }
        if let Some(robot) = &body.robot {
            let actor = actor::actor(&at, robot, frame.name, frame.pose)?;
            self.cast.members.push(Member::Actor(Box::new(actor)));
            return Ok(());
        }
        let shape = match &body.mesh {
            Some(_) => Shape::Mesh(self.mesh(&at, body, &frame.name)?),
            None => shape(&at, body)?,
        };
        let part = Part::new(frame.name, &shape, frame.pose).map_err(|error| {
            let key = at.name();
            at.error(Fault::Part { key, error })
        })?;
        self.cast.members.push(Member::Still(part));
        Ok(())
    }

    fn add_file(&mut self, at: &At<'_>, file: &Path, frame: &Frame) -> Result<(), SceneError> {
        if frame.depth >= DEEPEST {
            return Err(at.error(Fault::Nested {
                key: at.name(),
                value: at.written(),
                limit: DEEPEST,
            }));
        }
        let path = at.file(file)?;
        let document = Document::open(&path)?;
        let content: BodyFile = document.content()?;
        let at = document.top().key("part");
        self.add_list(&at, &content.part, "part", &frame.deeper())
    }

    fn mesh(&mut self, at: &At<'_>, body: &BodyTable, part: &str) -> Result<Mesh, SceneError> {
        let Some(table) = &body.mesh else {
            return Err(at.not_allowed("a mesh"));
        };
        let unit = unit(at, table.unit, table.scale)?;
        let (mesh, file) = read_mesh(at, &table.file, unit, up(table.up))?;
        self.meshes.push(InspectedMesh {
            part: part.to_owned(),
            file,
            inspection: mesh.inspection().clone(),
        });
        Ok(mesh)
    }
}

/// Where a body stands, what it is called and how many files deep it is.
struct Frame {
    pose: Pose,
    name: String,
    depth: usize,
}

impl Frame {
    fn within(&self, name: &str) -> Self {
        let name = if self.name.is_empty() {
            name.to_owned()
        } else {
            format!("{}, {name}", self.name)
        };
        Self { name, ..*self }
    }

    fn turned(&self, own: Pose) -> Self {
        Self {
            pose: self.pose * own,
            name: self.name.clone(),
            depth: self.depth,
        }
    }

    fn deeper(&self) -> Self {
        Self {
            pose: self.pose,
            name: self.name.clone(),
            depth: self.depth + 1,
        }
    }
}

fn pose(at: &At<'_>, body: &BodyTable) -> Result<Pose, SceneError> {
    let place = body.at_cm.map_or([0.0; 3], |Numbers(place)| place);
    let place = at.key("at_cm").numbers(place, &PLACE)?;
    let turns = body.rotate_deg.map_or([0.0; 3], |Numbers(turns)| turns);
    let turns = at.key("rotate_deg").numbers(turns, &TURN)?;
    let turn = turn_in_order(turns.map(f64::to_radians));
    Ok(Pose::from_parts(Vec3::from(place).into(), turn))
}

fn shape(at: &At<'_>, body: &BodyTable) -> Result<Shape, SceneError> {
    let length = |key: &str, value: f64| at.key(key).number(value, &LENGTH);
    if let Some(ball) = &body.ball {
        let radius = length("radius_cm", ball.radius_cm)?;
        return Ok(Shape::Ball { radius });
    }
    if let Some(capsule) = &body.capsule {
        return Ok(Shape::Capsule {
            radius: length("radius_cm", capsule.radius_cm)?,
            length: length("length_cm", capsule.length_cm)?,
        });
    }
    if let Some(cuboid) = &body.cuboid {
        let size = at.key("size_cm").numbers(cuboid.size_cm.0, &LENGTH)?;
        return Ok(Shape::Cuboid { size: size.into() });
    }
    if let Some(round) = body.cylinder.as_ref().or(body.cone.as_ref()) {
        let radius = length("radius_cm", round.radius_cm)?;
        let height = length("height_cm", round.height_cm)?;
        return Ok(match body.cylinder {
            Some(_) => Shape::Cylinder { radius, height },
            None => Shape::Cone { radius, height },
        });
    }
    match &body.convex_hull {
        Some(hull) => convex_hull(at, hull),
        None => Err(at.not_allowed("a shape")),
    }
}

fn convex_hull(at: &At<'_>, hull: &HullTable) -> Result<Shape, SceneError> {
    at.exactly_one(&[
        ("points_cm", hull.points_cm.is_some()),
        ("file", hull.file.is_some()),
    ])?;
    if let Some(file) = &hull.file {
        let missing = || {
            at.error(Fault::MissingKey {
                key: "unit".into(),
                table: at.name(),
            })
        };
        let unit = unit(at, hull.unit.ok_or_else(missing)?, hull.scale)?;
        let (mesh, _) = read_mesh(at, file, unit, up(hull.up))?;
        let points = mesh.vertices;
        return Ok(Shape::ConvexHull { points });
    }
    let mut points = Vec::new();
    for (item, point) in hull.points_cm.iter().flatten().enumerate() {
        let point = at.key("points_cm").item(item).numbers(point.0, &PLACE)?;
        points.push(point.into());
    }
    Ok(Shape::ConvexHull { points })
}

fn read_mesh(at: &At<'_>, file: &Path, unit: Unit, up: Up) -> Result<(Mesh, PathBuf), SceneError> {
    let at = at.key("file");
    let format = Format::of_path(file)
        .ok_or_else(|| at.not_allowed("a file ending in .obj, .stl, .ply, .glb or .gltf"))?;
    let path = at.file(file)?;
    let bytes = mesh_bytes(&path).map_err(|fault| SceneError {
        file: path.clone(),
        place: None,
        fault: Box::new(fault),
    })?;
    match Mesh::read(&bytes, format, unit, up) {
        Ok(mesh) => Ok((mesh, path)),
        Err(error) => Err(at.error(Fault::Mesh {
            key: at.name(),
            file: path,
            error: Box::new(error),
        })),
    }
}

fn unit(at: &At<'_>, unit: UnitWord, scale: Option<f64>) -> Result<Unit, SceneError> {
    let unit = match unit {
        UnitWord::M => Unit::Metre,
        UnitWord::Cm => Unit::Centimetre,
        UnitWord::Mm => Unit::Millimetre,
        UnitWord::In => Unit::Inch,
    };
    match scale {
        None => Ok(unit),
        Some(scale) => {
            let scale = at.key("scale").number(scale, &SCALE)?;
            Ok(Unit::Of(scale * unit.cm()))
        }
    }
}

fn up(word: UpWord) -> Up {
    match word {
        UpWord::Y => Up::Y,
        UpWord::Z => Up::Z,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(degrees: [f64; 3], point: Vec3) -> Vec3 {
        let text = format!("[[body]]\nrotate_deg = {degrees:?}\n");
        let document = Document::new("x.toml".into(), text).unwrap();
        let body = BodyTable {
            rotate_deg: Some(Numbers(degrees)),
            ..empty()
        };
        pose(&document.top(), &body).unwrap() * nalgebra::Point3::from(point)
            - nalgebra::Point3::origin()
    }

    fn empty() -> BodyTable {
        toml::from_str("").unwrap()
    }

    #[test]
    fn turns_go_about_x_then_y_then_z() {
        // y, by 90° about x to z, by 90° about y to x, by 90° about z to y.
        let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()];
        assert!((turned([90.0, 0.0, 0.0], y) - z).norm() < 1e-15);
        assert!((turned([90.0, 90.0, 0.0], y) - x).norm() < 1e-15);
        assert!((turned([90.0, 90.0, 90.0], y) - y).norm() < 1e-15);
        assert!((turned([0.0, 0.0, -90.0], y) - x).norm() < 1e-15);
    }
}
