//! Arguments that say which edges must be in a mesh, and which of its triangles are wanted.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use incircle::constraints::Domain;

use crate::values::domain_parser;

/// Constraints, and the domain that they bound.
#[derive(Clone, Debug, Args)]
pub struct PlanArguments {
    /// Edges that must be in the mesh: a CSV file of pairs of point indices, counted from 0
    ///
    /// Constraints may overlap, touch, and pass through points. Two constraints that cross are an error, whose message
    /// has the place of the crossing. A .poly file, and lines and polygons of GeoJSON and WKT, have constraints without
    /// this option.
    #[arg(long, value_name = "EDGES.csv")]
    pub constraints: Option<PathBuf>,
    /// Triangles that are wanted
    ///
    /// Default: 'holes' for a .poly file, 'even-odd' for polygons, 'all' for anything else.
    #[arg(long, value_parser = domain_parser())]
    pub domain: Option<Domain>,
    /// Treatment of constraints that cross
    ///
    /// A place that is a point of the set is no crossing. 'snap' needs points that take at most 24 bits: --quantize
    /// rounds others, and the coordinates of the mesh are then those of the grid.
    #[arg(long, value_enum, default_value = "reject")]
    pub crossings: Crossings,
}

/// The treatment of constraints that cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Crossings {
    /// Crossings are an error, whose message has the place
    Reject,
    /// Crossings become points, rounded to a grid 256 times finer
    Snap,
}

impl PlanArguments {
    /// Whether the arguments ask for constraints or a domain.
    pub fn is_given(&self) -> bool {
        self.constraints.is_some() || self.domain.is_some()
    }
}
