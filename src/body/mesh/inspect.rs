use std::fmt;

use super::{
    repair::{Edge, edges, extent},
    source::Soup,
};
use crate::math::Vec3;

/// What was found in a mesh, and what cleaning did to it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Inspection {
    /// Vertices, after merging.
    pub vertices: usize,
    /// Faces, after cleaning.
    pub triangles: usize,
    /// Shells: pieces whose faces hang together by edges.
    pub components: usize,
    /// Whether it encloses a solid: along every edge as many faces run one way as the other.
    /// What is not closed is a sheet with two sides.
    pub closed: bool,
    /// Loops of edges with one face only: holes, and the rims of open sheets.
    pub holes: usize,
    /// Edges with one face only.
    pub boundary_edges: usize,
    /// Edges with more than two faces.
    pub non_manifold_edges: usize,
    /// Faces turned, wound against their neighbours or inward.
    pub flipped: usize,
    /// Faces without area, left out.
    pub degenerate: usize,
    /// Faces given again, left out.
    pub duplicate: usize,
    /// Lowest and highest coordinates [cm].
    pub extent: (Vec3, Vec3),
}

/// Looks at a cleaned mesh; what cleaning did is left at 0.
pub(super) fn inspected(soup: &Soup) -> Inspection {
    let edges = edges(&soup.triangles);
    let boundary: Vec<&Edge> = edges.iter().filter(|edge| edge.sides.len() == 1).collect();
    Inspection {
        vertices: soup.vertices.len(),
        triangles: soup.triangles.len(),
        components: 0,
        closed: edges.iter().all(Edge::balanced),
        holes: loops(&boundary, soup.vertices.len()),
        boundary_edges: boundary.len(),
        non_manifold_edges: edges.iter().filter(|edge| edge.sides.len() > 2).count(),
        flipped: 0,
        degenerate: 0,
        duplicate: 0,
        extent: extent(&soup.vertices),
    }
}

/// Pieces into which boundary edges hang together.
fn loops(boundary: &[&Edge], vertices: usize) -> usize {
    let mut parents: Vec<usize> = (0..vertices).collect();
    let mut unions = 0;
    let mut on_boundary = vec![false; vertices];
    for edge in boundary {
        let [a, b] = edge.ends.map(|end| end as usize);
        for end in [a, b] {
            if let Some(mark) = on_boundary.get_mut(end) {
                *mark = true;
            }
        }
        let (a, b) = (root(&mut parents, a), root(&mut parents, b));
        if a != b
            && let Some(parent) = parents.get_mut(a.max(b))
        {
            *parent = a.min(b);
            unions += 1;
        }
    }
    on_boundary.iter().filter(|&&mark| mark).count() - unions
}

/// The vertex that stands for all that hang together with one; the way there is halved.
fn root(parents: &mut [usize], mut vertex: usize) -> usize {
    while let Some(&parent) = parents.get(vertex)
        && parent != vertex
    {
        let above = parents.get(parent).copied().unwrap_or(parent);
        if let Some(own) = parents.get_mut(vertex) {
            *own = above;
        }
        vertex = above;
    }
    vertex
}

impl fmt::Display for Inspection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = self.extent;
        let size = high - low;
        write!(
            f,
            "{}, {}, {}; {:.1} × {:.1} × {:.1} cm, z from {:.1} to {:.1}; ",
            counted(self.triangles, "face"),
            counted(self.vertices, "vertex"),
            counted(self.components, "shell"),
            size.x,
            size.y,
            size.z,
            low.z,
            high.z,
        )?;
        match (self.closed, self.holes) {
            (true, _) => write!(f, "closed, so solid")?,
            (false, 0) => write!(f, "its faces enclose no solid, so a sheet with two sides")?,
            (false, holes) => write!(
                f,
                "open at {} ({}), so a sheet with two sides",
                counted(holes, "hole or rim"),
                counted(self.boundary_edges, "edge"),
            )?,
        }
        for (count, thing, what) in [
            (self.flipped, "face", "turned"),
            (self.duplicate, "face", "given twice and left out"),
            (self.degenerate, "face", "without area and left out"),
            (self.non_manifold_edges, "edge", "of more than two faces"),
        ] {
            if count > 0 {
                write!(f, "; {} {what}", counted(count, thing))?;
            }
        }
        Ok(())
    }
}

fn counted(count: usize, thing: &str) -> String {
    match (count, thing) {
        (1, _) => format!("1 {thing}"),
        (_, "vertex") => format!("{count} vertices"),
        (_, "hole or rim") => format!("{count} holes or rims"),
        _ => format!("{count} {thing}s"),
    }
}
