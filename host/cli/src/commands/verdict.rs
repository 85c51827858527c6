//! The result of `incircle verify`, as a sentence or as JSON.

use serde_json::{json, Value};

use crate::failure::{counted, Exit, Failure};
use crate::output;

/// The kind of mesh that is checked, as messages call it.
#[derive(Clone, Copy)]
pub enum Kind {
    /// The mesh of the points.
    Canonical,
    /// The mesh of the points with constraints.
    Constrained,
}

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Canonical => "canonical",
            Self::Constrained => "canonical constrained",
        }
    }
}

/// How a result is told.
#[derive(Clone, Copy)]
pub struct Verdict<'a> {
    /// The kind of mesh.
    pub kind: Kind,
    /// The names of the mesh and of its points.
    pub names: [&'a str; 2],
    /// Whether the result is a JSON object.
    pub json: bool,
    /// Whether only errors are printed.
    pub quiet: bool,
}

/// What was seen in a mesh that is right.
pub struct Seen {
    /// The numbers of points, of triangles, of points on the hull, and of ties.
    pub counts: [usize; 4],
    /// The result as JSON.
    pub report: Value,
}

impl Verdict<'_> {
    /// The failure of a mesh that is not the one of these points.
    pub fn rejected(&self, reason: &str) -> Failure {
        let (kind, [mesh, points]) = (self.kind.name(), self.names);
        let message =
            format!("the triangles of {mesh} are not the {kind} Delaunay triangulation of {points}: {reason}");
        Failure::new(Exit::Rejected, message)
    }

    /// Prints the result. A wrong mesh is a failure.
    pub fn tell(&self, checked: Result<Seen, Failure>) -> Result<(), Failure> {
        let Seen { counts, report } = match checked {
            Ok(seen) => seen,
            Err(failure) => {
                if self.json && failure.exit == Exit::Rejected {
                    output::print(&format!("{}\n", json!({ "valid": false, "reason": failure.message })))?;
                }
                return Err(failure);
            }
        };
        if self.json {
            return output::print(&format!("{report}\n"));
        }
        if self.quiet {
            return Ok(());
        }
        let (kind, [mesh, set], [points, triangles, hull, ties]) = (self.kind.name(), self.names, counts);
        output::print(&format!(
            "the triangles of {mesh} are the {kind} Delaunay triangulation of {set}: {}, {}, {} on the hull, {}\n",
            counted(points, "point"),
            counted(triangles, "triangle"),
            counted(hull, "point"),
            counted(ties, "tie")
        ))
    }
}
