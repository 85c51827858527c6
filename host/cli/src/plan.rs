//! Constraints and domains of the command: reading them, and forcing them into a mesh.

use std::path::{Path, PathBuf};

use incircle::constraints::{constrain, Constrained, Domain, Error, Plan, Snapped};
use incircle::{Duplicate, Mesh, PlanePoint};

use crate::arguments::{PlanArguments, ReadArguments};
use crate::connections::Connections;
use crate::failure::Failure;
use crate::formats::{csv_pairs, node, PlanTable, PointFormat, Ring};
use crate::input::Input;
use crate::lattice::{Laid, Numbers};
use crate::path::{self, check_standard, extension, name};
use crate::planned::Planned;
use crate::points::PointTable;
use crate::source;

/// The constraints, holes and regions that are asked of the mesh of a set.
#[derive(Clone)]
pub struct Request {
    /// The constraints. Those that bound nothing stand at the end.
    constraints: Vec<[u32; 2]>,
    /// The rings of polygons, whose sides come first among the constraints.
    polygons: Vec<Ring>,
    /// The file of `--constraints`, and the number of its first constraint. All others come before that one.
    beside: Option<(String, usize)>,
    /// The number of constraints that bound nothing.
    lines: usize,
    pub domain: Domain,
    /// The number of holes, whose places stand behind the points.
    holes: usize,
    /// The attribute of each region. The places of regions stand behind those of holes.
    attributes: Vec<String>,
    /// The constraint of the files that each constraint is a part of; `None` if each is one of these.
    parts: Option<Vec<u32>>,
    /// Whether crossings were to be snapped, but the points lie on no lattice.
    pub lacks_grid: bool,
}

/// A set of points, and the constraints and the domain that are asked of its mesh.
pub struct PlannedSet {
    /// The points; behind them the places of holes, and then those of regions.
    pub table: PointTable,
    /// The number of points.
    pub points: usize,
    /// `None` if the canonical mesh of the points is all that is asked.
    pub request: Option<Request>,
}

impl PlannedSet {
    /// Whether places of holes or regions stand behind the points.
    pub fn has_marks(&self) -> bool {
        self.table.len() > self.points
    }

    /// The set, of which it is known that its points lie on no lattice, so that crossings cannot be snapped.
    pub fn without_grid(mut self) -> Self {
        self.request.iter_mut().for_each(|request| request.lacks_grid = true);
        self
    }
}

/// Reads a set of points with its constraints.
pub fn read_set(
    paths: &[PathBuf],
    read: &ReadArguments,
    arguments: &PlanArguments,
    quiet: bool,
) -> Result<PlannedSet, Failure> {
    check_standard(paths.iter().chain(&arguments.constraints))?;
    let format = |path: &Path| read.from.or_else(|| PointFormat::of_extension(extension(path)));
    let plan = match paths {
        [path] => match format(path).filter(|format| format.may_constrain()) {
            Some(format) => {
                read.selection(format)?;
                let beside = || read_beside(&node_of(path), quiet);
                let plan = Input::open(path, quiet).and_then(|input| format.read_plan(input, &beside));
                plan.map_err(|failure| failure.in_file(name(path)))?
            }
            None => PlanTable::of_points(source::read_set(paths, read, quiet)?, false),
        },
        _ => PlanTable::of_points(source::read_set(paths, read, quiet)?, false),
    };
    let PlanTable { table, points, rings: mut constraints, polygons, mut lines, holes, attributes, is_poly, .. } = plan;
    let mut beside = None;
    if let Some(path) = &arguments.constraints {
        let own = Input::open(path, quiet).and_then(|input| csv_pairs::read_pairs(&input.into_bytes()?, points));
        beside = Some((name(path), constraints.len() + lines.len()));
        lines.extend(own.map_err(|failure| failure.in_file(name(path)))?);
    }
    let default = match (is_poly, constraints.is_empty()) {
        (true, _) => Domain::Holes,
        (false, false) => Domain::EvenOdd,
        (false, true) => Domain::All,
    };
    // Lines bound a domain only where there is no polygon.
    let free = if constraints.is_empty() { 0 } else { lines.len() };
    constraints.extend(lines);
    let is_asked = is_poly || arguments.is_given() || !constraints.is_empty();
    let domain = arguments.domain.unwrap_or(default);
    let request = is_asked.then_some(Request {
        constraints,
        polygons,
        beside,
        lines: free,
        domain,
        holes,
        attributes,
        parts: None,
        lacks_grid: false,
    });
    Ok(PlannedSet { table, points, request })
}

/// The `.node` file beside a `.poly` file: packed like that one, or else not packed.
fn node_of(path: &Path) -> PathBuf {
    let [packed, plain] = [path, &path::unpacked(path)].map(|path| path::beside(path, "node"));
    if plain.exists() && !packed.exists() {
        plain
    } else {
        packed
    }
}

/// Reads a `.node` file, and the id of its first point.
fn read_beside(path: &Path, quiet: bool) -> Result<(PointTable, u32), Failure> {
    let table = source::read_points(path, &ReadArguments::of_whole_file(), quiet)?;
    let base = Input::open(path, true).and_then(|input| node::first_id(&input.into_bytes()?));
    Ok((table, base.map_err(|failure| failure.in_file(name(path)))?))
}

impl Request {
    /// Asks for all triangles of the hull with these constraints.
    pub fn of_constraints(constraints: Vec<[u32; 2]>) -> Self {
        Self {
            constraints,
            polygons: Vec::new(),
            beside: None,
            lines: 0,
            domain: Domain::All,
            holes: 0,
            attributes: Vec::new(),
            parts: None,
            lacks_grid: false,
        }
    }

    /// The same for a set whose crossings were snapped.
    pub fn snapped(&self, snapped: &Snapped) -> Self {
        let boundary = self.constraints.len() - self.lines;
        Self {
            constraints: snapped.constraints.clone(),
            lines: snapped.of.iter().filter(|&&of| of as usize >= boundary).count(),
            parts: Some(snapped.of.clone()),
            lacks_grid: false,
            ..self.clone()
        }
    }

    /// The constraints. Those that bound nothing stand at the end.
    pub fn constraints(&self) -> &[[u32; 2]] {
        &self.constraints
    }

    /// The number of the constraint of the files that a constraint is a part of.
    pub fn source(&self, number: usize) -> u32 {
        self.parts.as_ref().and_then(|parts| parts.get(number).copied()).unwrap_or(number as u32)
    }

    /// The file of `--constraints`, and the number of its first constraint in the files.
    pub fn beside(&self) -> Option<(&str, usize)> {
        self.beside.as_ref().map(|(name, first)| (name.as_str(), *first))
    }

    /// The rings of all polygons: the sides of each, and whether the ring is the outer one of a polygon.
    pub fn rings(&self) -> impl Iterator<Item = (&[[u32; 2]], bool)> + '_ {
        let mut begin = 0;
        self.polygons.iter().map(move |ring| {
            // Parts are in the order of the constraints that they come from.
            let end = match &self.parts {
                Some(parts) => parts.partition_point(|&of| (of as usize) < ring.end),
                None => ring.end,
            };
            (&self.constraints[std::mem::replace(&mut begin, end)..end], ring.is_outer)
        })
    }

    /// The number of holes.
    pub fn holes(&self) -> usize {
        self.holes
    }

    /// The attributes of regions.
    pub fn attributes(&self) -> &[String] {
        &self.attributes
    }

    /// Whether there are constraints.
    pub fn has_constraints(&self) -> bool {
        !self.constraints.is_empty()
    }

    /// Forces the constraints into the mesh of the first `points` places.
    pub fn force_numbers(
        &self,
        numbers: &Numbers<'_>,
        points: usize,
        mesh: &mut Connections,
    ) -> Result<Constrained, Error> {
        match numbers {
            Numbers::Grid(places) => self.force_in(places, points, mesh),
            Numbers::Whole(places) => self.force_in(places, points, mesh),
            Numbers::Doubles(places) => self.force_in(places, points, mesh),
        }
    }

    /// Forces the constraints into a mesh. The places of holes and regions stand behind the points in `laid`. `file`
    /// names the set in messages.
    pub fn force(
        &self,
        mesh: &mut Connections,
        (set, file): (&PlannedSet, &str),
        laid: &Laid<'_>,
    ) -> Result<Planned, Failure> {
        let made = self.force_numbers(&laid.numbers, set.points, mesh);
        made.map(|made| self.planned(made)).map_err(|error| self.refuse(error, (set, file), laid))
    }

    /// The regions and pieces that constraints made, with the names and numbers of the file.
    pub fn planned(&self, mut made: Constrained) -> Planned {
        let mut constraints = self.constraints.len();
        if let Some(parts) = &self.parts {
            made.pieces = made.pieces.renamed(parts);
            // Every constraint has a part.
            constraints = parts.last().map_or(0, |&last| last as usize + 1);
        }
        let mut attributes = Vec::new();
        if !self.attributes.is_empty() {
            attributes.resize(made.region_count as usize, "0".to_owned());
            // Of several places in one region the first gives the attribute.
            for (&region, attribute) in made.marked.iter().zip(&self.attributes).rev() {
                attributes[region as usize].clone_from(attribute);
            }
        }
        Planned { made, attributes, domain: self.domain, constraints, snapping: None }
    }

    /// The plan in these numbers.
    pub fn plan<'a, P>(&'a self, places: &'a [P], points: usize) -> Plan<'a, P> {
        let marks = places.get(points..).unwrap_or_default();
        let (holes, regions) = marks.split_at(self.holes.min(marks.len()));
        Plan { constraints: &self.constraints, lines: self.lines, domain: self.domain, holes, regions }
    }

    fn force_in<P: PlanePoint>(
        &self,
        places: &[P],
        points: usize,
        mesh: &mut Connections,
    ) -> Result<Constrained, Error> {
        let duplicates = mesh.duplicates.iter().map(|&[index, of]| Duplicate { index, of }).collect();
        let (triangles, hull) = (std::mem::take(&mut mesh.triangles), std::mem::take(&mut mesh.hull));
        let whole = Mesh::new(places[..points].to_vec(), triangles, hull, duplicates);
        let made = constrain(&whole, &self.plan(places, points))?;
        mesh.hull = whole.hull;
        mesh.triangles.clone_from(&made.triangles);
        Ok(made)
    }
}
