//! One round, flat-sided or meshed piece of a body: a parry shape with a pose.

use crate::{
    body::{Mesh, MeshError},
    math::{Pose, Vec3},
};
use parry3d::{
    math::{Pose as ParryPose, Rotation, Vector},
    shape::{SharedShape, TriMeshFlags},
};

/// A shape in its own frame [cm].
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A ball about the origin.
    Ball {
        /// Radius [cm].
        radius: f64,
    },
    /// All points within a radius of a segment along z, centred.
    Capsule {
        /// Radius [cm].
        radius: f64,
        /// Length of the segment, caps not counted [cm].
        length: f64,
    },
    /// A box, centred.
    Cuboid {
        /// Edge lengths along x, y, z [cm].
        size: Vec3,
    },
    /// A cylinder along z, centred.
    Cylinder {
        /// Radius [cm].
        radius: f64,
        /// Height [cm].
        height: f64,
    },
    /// A cone along z, centred, its tip up.
    Cone {
        /// Radius of the foot [cm].
        radius: f64,
        /// Height [cm].
        height: f64,
    },
    /// The convex hull of points.
    ConvexHull {
        /// The points [cm].
        points: Vec<Vec3>,
    },
    /// A triangle mesh: solid where it is closed, a two-sided sheet where it is not.
    Mesh(Mesh),
}

/// Whether a part has an inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Closed: what is inside is pushed out.
    Solid,
    /// Open: cloth stays on the side where it is.
    Sheet,
}

/// A shape that cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PartError {
    /// A length is out of range.
    #[error("{quantity} is {value} cm; allowed: 0.01 to 10000 cm")]
    Length {
        /// Which length.
        quantity: &'static str,
        /// Its value [cm].
        value: f64,
    },
    /// Points that enclose nothing.
    #[error(
        "the convex hull of {0} points has no volume: give at least 4 points, not in one plane"
    )]
    FlatHull(usize),
    /// The mesh is unusable.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The mesh cannot be searched.
    #[error("the mesh cannot be searched: {0}")]
    Unsearchable(String),
}

/// A part of a body, in place.
#[derive(Clone)]
pub struct Part {
    name: String,
    nature: Nature,
    shape: SharedShape,
    pose: ParryPose,
    centre: Vec3,
}

impl core::fmt::Debug for Part {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Part")
            .field("name", &self.name)
            .field("nature", &self.nature)
            .finish()
    }
}

impl Part {
    /// Builds a part.
    ///
    /// # Errors
    /// [`PartError`] where a length is out of range, a hull is flat or a mesh cannot be searched.
    pub fn new(name: String, shape: &Shape, pose: Pose) -> Result<Self, PartError> {
        let pose = parry_pose(&pose) * own_turn(shape);
        let (shape, nature) = parry_shape(shape)?;
        let centre = shape.compute_aabb(&pose).center().into();
        Ok(Self {
            name,
            nature,
            shape,
            pose,
            centre,
        })
    }

    /// Its name in the scene.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The same part under another name.
    #[must_use]
    pub fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    /// Whether it has an inside.
    #[must_use]
    pub fn nature(&self) -> Nature {
        self.nature
    }

    /// The parry shape in its own frame.
    pub(super) fn shape(&self) -> &SharedShape {
        &self.shape
    }

    /// Its pose, in parry's terms.
    pub(super) fn pose(&self) -> &ParryPose {
        &self.pose
    }

    /// The middle of its bounding box [cm].
    pub(super) fn centre(&self) -> Vec3 {
        self.centre
    }

    /// Where a point [cm] that moves with this part is now, by where it was with the part as it
    /// `was`.
    pub(crate) fn carries(&self, was: &Self, point: &Vec3) -> Vec3 {
        let own = was.pose.inverse_transform_point((*point).into());
        (self.pose * own).into()
    }

    /// The same for a direction.
    pub(crate) fn carries_direction(&self, was: &Self, direction: &Vec3) -> Vec3 {
        let own = was.pose.rotation.inverse() * Vector::from(*direction);
        (self.pose.rotation * own).into()
    }

    /// This part half way here from where it `was`: turned by half of the turn, by the shorter way.
    pub(super) fn half_way_from(&self, was: &Self) -> Self {
        let (from, to) = (was.pose.rotation, self.pose.rotation);
        let side = if from.dot(to) < 0.0 { -1.0 } else { 1.0 };
        let sum = Rotation::from_xyzw(
            from.x * side + to.x,
            from.y * side + to.y,
            from.z * side + to.z,
            from.w * side + to.w,
        );
        let middle = (was.pose.translation + self.pose.translation) * 0.5;
        let pose = ParryPose::from_parts(middle, sum.normalize());
        Self {
            centre: self.shape.compute_aabb(&pose).center().into(),
            pose,
            name: self.name.clone(),
            nature: self.nature,
            shape: self.shape.clone(),
        }
    }

    /// Its surface as triangles in space [cm], for pictures and files; round shapes are divided
    /// finely.
    #[must_use]
    pub fn triangles(&self) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let (points, triangles) = surface(&self.shape);
        (
            points
                .into_iter()
                .map(|point| (self.pose * point).into())
                .collect(),
            triangles,
        )
    }
}

fn parry_pose(pose: &Pose) -> ParryPose {
    let turn = pose.rotation.quaternion();
    let turn = Rotation::from_xyzw(turn.i, turn.j, turn.k, turn.w);
    ParryPose::from_parts(pose.translation.vector.into(), turn)
}

fn parry_shape(shape: &Shape) -> Result<(SharedShape, Nature), PartError> {
    let built = match shape {
        Shape::Ball { radius } => SharedShape::ball(length("radius", *radius)?),
        Shape::Capsule {
            radius,
            length: axis,
        } => SharedShape::capsule_z(0.5 * length("length", *axis)?, length("radius", *radius)?),
        Shape::Cuboid { size } => {
            let half = |axis: usize| Ok::<f64, PartError>(0.5 * length("size", size[axis])?);
            SharedShape::cuboid(half(0)?, half(1)?, half(2)?)
        }
        Shape::Cylinder { radius, height } => {
            SharedShape::cylinder(0.5 * length("height", *height)?, length("radius", *radius)?)
        }
        Shape::Cone { radius, height } => {
            SharedShape::cone(0.5 * length("height", *height)?, length("radius", *radius)?)
        }
        Shape::ConvexHull { points } => hull(points)?,
        Shape::Mesh(mesh) => return meshed(mesh),
    };
    Ok((built, Nature::Solid))
}

fn length(quantity: &'static str, value: f64) -> Result<f64, PartError> {
    if (0.01..=1e4).contains(&value) {
        Ok(value)
    } else {
        Err(PartError::Length { quantity, value })
    }
}

/// parry's cylinders and cones stand along y; ours along z.
fn own_turn(shape: &Shape) -> ParryPose {
    match shape {
        Shape::Cylinder { .. } | Shape::Cone { .. } => {
            ParryPose::rotation(Vector::new(core::f64::consts::FRAC_PI_2, 0.0, 0.0))
        }
        _ => ParryPose::IDENTITY,
    }
}

/// A hull as a mesh: parry searches a mesh some ten times faster than a polyhedron.
fn hull(points: &[Vec3]) -> Result<SharedShape, PartError> {
    let flat = || PartError::FlatHull(points.len());
    let points: Vec<Vector> = points.iter().map(|point| Vector::from(*point)).collect();
    let hull = SharedShape::convex_hull(&points).ok_or_else(flat)?;
    let polyhedron = hull.as_convex_polyhedron().ok_or_else(flat)?;
    let (vertices, triangles) = polyhedron.to_trimesh();
    let built = trimesh(vertices, triangles, TriMeshFlags::ORIENTED)?;
    // Points in one plane make a flat polyhedron, which has no inside.
    if built.mass_properties(1.0).mass() > 1e-6 {
        Ok(built)
    } else {
        Err(flat())
    }
}

fn meshed(mesh: &Mesh) -> Result<(SharedShape, Nature), PartError> {
    let closed = mesh.inspection().closed;
    let flags = if closed {
        TriMeshFlags::ORIENTED
    } else {
        TriMeshFlags::empty()
    };
    let vertices = mesh
        .vertices
        .iter()
        .map(|vertex| Vector::from(*vertex))
        .collect();
    let shape = trimesh(vertices, mesh.triangles.to_vec(), flags)?;
    Ok((shape, if closed { Nature::Solid } else { Nature::Sheet }))
}

fn trimesh(
    vertices: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
    flags: TriMeshFlags,
) -> Result<SharedShape, PartError> {
    SharedShape::trimesh_with_flags(vertices, triangles, flags)
        .map_err(|error| PartError::Unsearchable(error.to_string()))
}

/// A shape's surface as triangles in its own frame.
fn surface(shape: &SharedShape) -> (Vec<Vector>, Vec<[u32; 3]>) {
    if let Some(mesh) = shape.as_trimesh() {
        return (mesh.vertices().to_vec(), mesh.indices().to_vec());
    }
    if let Some(ball) = shape.as_ball() {
        return ball.to_trimesh(64, 32);
    }
    if let Some(capsule) = shape.as_capsule() {
        return capsule.to_trimesh(64, 16);
    }
    if let Some(cuboid) = shape.as_cuboid() {
        return cuboid.to_trimesh();
    }
    if let Some(cylinder) = shape.as_cylinder() {
        return cylinder.to_trimesh(96);
    }
    if let Some(cone) = shape.as_cone() {
        return cone.to_trimesh(96);
    }
    (Vec::new(), Vec::new())
}
