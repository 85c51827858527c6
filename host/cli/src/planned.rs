//! The regions and pieces of a mesh with constraints, for its file and for the report.

use incircle::constraints::{Constrained, Domain};
use serde_json::{json, Value};

use crate::failure::counted;

/// The outcome of snapping the crossings of a set.
#[derive(Clone, Copy, Debug)]
pub struct Snapping {
    pub new_points: usize,
    /// The largest distance that a constraint was moved, in the coordinates of the mesh.
    pub largest_displacement: f64,
}

impl Snapping {
    /// The line of the report for people.
    pub fn line(&self) -> String {
        format!(
            "crossings snapped: {}, largest displacement {:.3e}",
            counted(self.new_points, "new point"),
            self.largest_displacement
        )
    }

    /// The report as a JSON object.
    pub fn to_json(self) -> Value {
        json!({ "new_points": self.new_points, "largest_displacement": self.largest_displacement })
    }
}

/// A constrained mesh with what its file gives its regions.
#[derive(Clone, Debug, Default)]
pub struct Planned {
    pub made: Constrained,
    /// The attribute of each region, by its number; empty if the file gives none.
    pub attributes: Vec<String>,
    pub domain: Domain,
    /// The number of constraints.
    pub constraints: usize,
    /// The outcome of snapping their crossings, if there was any to snap.
    pub snapping: Option<Snapping>,
}

impl Planned {
    /// The attribute that the file of a mesh gives the region of this number, or else that number. `None` if the
    /// triangles are all of the hull and no region is named.
    pub fn attribute(&self, region: u32) -> Option<String> {
        match self.attributes.get(region as usize) {
            Some(attribute) => Some(attribute.clone()),
            None => (self.domain != Domain::All).then(|| region.to_string()),
        }
    }

    /// The line of the report for people.
    pub fn line(&self, of: usize) -> String {
        let made = &self.made;
        format!(
            "{} in {}; domain {}: {} of {of} triangles, {}",
            counted(self.constraints, "constraint"),
            counted(made.pieces.len(), "piece"),
            self.domain,
            made.triangles.len(),
            counted(made.region_count as usize, "region")
        )
    }

    /// The report as a JSON object. Twice the area is a text, because it may have more bits than a JSON number.
    pub fn to_json(&self) -> Value {
        let made = &self.made;
        json!({
            "constraints": self.constraints,
            "pieces": made.pieces.len(),
            "domain": self.domain.name(),
            "triangles": made.triangles.len(),
            "regions": made.region_count,
            "snapping": self.snapping.map(Snapping::to_json),
            "twice_area": made.twice_area.map(|area| area.to_string()),
        })
    }
}
