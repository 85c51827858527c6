//! The mesh of the page: points on the grid, which drift, move and come, and the picture of their mesh.
//!
//! JavaScript names the points in the order in which it gave them. Here they stand along the Hilbert curve, each in a
//! slot, so that what is near in the plane is near in memory: sorting, triangulating and drawing are quicker then.
//! JavaScript sees neither slots nor lists while points drift: it gives places, and gets the pixels of a picture.
#![allow(unsafe_code)] // names of functions that JavaScript calls

use std::cell::RefCell;

use incircle_geometry::cpu::Triangulator;
use incircle_geometry::order::hilbert;
use incircle_geometry::pages::has_room;
use incircle_geometry::{Mesh, Point, Triangulation};

use crate::border::{give, told};
use crate::grid::{grid_point, grid_points};
use crate::light::{place, Light, Place};

/// The most bytes a point that a job needs: the larger of a batch and of a mesh that lives.
const BYTES_OF_A_POINT: usize = 500;
/// Triangulations after which the slots are put along the curve again. Points that drift leave it slowly.
const SORT_EVERY: u32 = 32;

/// The mesh of one set of points.
#[derive(Default)]
struct Plane {
    triangulator: Triangulator,
    /// The mesh, whose indices are slots.
    mesh: Mesh,
    /// The mesh that lives, made at the first change of a single point. Its indices are slots, too.
    living: Option<Triangulation<Point>>,
    /// The name of the point in each slot.
    names: Vec<u32>,
    /// The slot of each point.
    slots: Vec<u32>,
    /// Triangulations since the slots were put along the curve.
    age: u32,
    light: Light,
}

thread_local! {
    static PLANE: RefCell<Plane> = RefCell::default();
}

impl Plane {
    fn triangulate(&mut self, points: &[Point]) -> Result<(), String> {
        let bytes = points.len().saturating_mul(BYTES_OF_A_POINT);
        if !has_room(bytes) {
            return Err(format!("{} points need up to {bytes} bytes: choose fewer", points.len()));
        }
        self.living = None;
        if self.names.len() != points.len() || self.age == SORT_EVERY {
            self.names = hilbert(points);
            self.slots.resize(points.len(), 0);
            for (slot, &name) in (0..).zip(&self.names) {
                self.slots[name as usize] = slot;
            }
            self.age = 0;
        }
        self.age += 1;
        let placed: Vec<Point> = self.names.iter().map(|&name| points[name as usize]).collect();
        self.triangulator.triangulate_into(&placed, &mut self.mesh).map_err(|error| error.to_string())
    }

    /// Changes the mesh that lives, and takes its triangles and its hull.
    fn change(
        &mut self,
        change: impl FnOnce(&mut Self, &mut Triangulation<Point>) -> Result<(), String>,
    ) -> Result<(), String> {
        let mut living = match self.living.take() {
            Some(living) => living,
            None => Triangulation::from(self.mesh.points.iter().copied()).map_err(|error| error.to_string())?,
        };
        let changed = change(self, &mut living);
        self.mesh.triangles.clear();
        self.mesh.triangles.extend(living.triangles());
        self.mesh.hull.clear();
        self.mesh.hull.extend(living.hull());
        self.living = Some(living);
        changed
    }

    fn move_to(&mut self, name: u32, point: Point) -> Result<(), String> {
        let slot = *self.slots.get(name as usize).ok_or_else(|| format!("there is no point {name}"))?;
        self.change(|plane, living| {
            living.move_to(slot, point).map_err(|error| error.to_string())?;
            plane.mesh.points[slot as usize] = point;
            Ok(())
        })
    }

    fn insert(&mut self, point: Point) -> Result<(), String> {
        if !has_room(self.names.len().saturating_mul(BYTES_OF_A_POINT)) {
            return Err("there is no memory for another point".to_owned());
        }
        self.change(|plane, living| {
            // No point is ever deleted from the mesh that lives, so slots and names are counted alike.
            let slot = living.insert(point).map_err(|error| error.to_string())?;
            plane.names.push(slot);
            plane.slots.push(slot);
            plane.mesh.points.push(point);
            Ok(())
        })
    }

    /// The triangles by the names of their points, the smallest first.
    fn named(&self) -> Vec<u32> {
        let named = self.mesh.triangles.iter().flat_map(|corners| {
            let mut names = corners.map(|slot| self.names[slot as usize]);
            let least = (0..3).min_by_key(|&corner| names[corner]).unwrap_or(0);
            names.rotate_left(least);
            names
        });
        named.collect()
    }

    /// Draws all edges, each once, with the grid's origin at a place of the picture and `scale` pixels a step of the
    /// grid.
    fn draw(&mut self, [left, bottom]: [f64; 2], scale: f64) {
        let in_picture =
            |point: &Point| place([left + scale * f64::from(point.x), bottom - scale * f64::from(point.y)]);
        let places: Vec<Place> = self.mesh.points.iter().map(in_picture).collect();
        let light = self.light.of_an_edge(places.len());
        let mut draw = |from: u32, to: u32| self.light.add(light, places[from as usize], places[to as usize]);
        // An edge inside the mesh is in two triangles, in both directions; an edge of the hull is in one.
        for &[a, b, c] in &self.mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                if from < to {
                    draw(from, to);
                }
            }
        }
        let hull = &self.mesh.hull;
        for (&from, &to) in hull.iter().zip(hull.iter().cycle().skip(1)) {
            if from > to {
                draw(from, to);
            }
        }
    }
}

fn with(work: impl FnOnce(&mut Plane) -> Result<f64, String>) -> f64 {
    told(PLANE.with_borrow_mut(work))
}

/// The number of triangles.
fn size(plane: &Plane) -> f64 {
    plane.mesh.triangles.len() as f64
}

/// Triangulates the points in the buffer. Returns the number of triangles. The list has duplicates as pairs.
#[no_mangle]
pub extern "C" fn plane_triangulate() -> f64 {
    with(|plane| {
        plane.triangulate(&grid_points()?)?;
        give(vec![crate::batch::pairs(&plane.mesh.duplicates)]);
        Ok(size(plane))
    })
}

/// Moves a point. Returns the number of triangles.
#[no_mangle]
pub extern "C" fn plane_move(name: u32, x: f64, y: f64) -> f64 {
    with(|plane| plane.move_to(name, grid_point([x, y])?).map(|()| size(plane)))
}

/// Inserts a point, whose name is the number of points before. Returns the number of triangles.
#[no_mangle]
pub extern "C" fn plane_insert(x: f64, y: f64) -> f64 {
    with(|plane| plane.insert(grid_point([x, y])?).map(|()| size(plane)))
}

/// Lists the triangles, counter-clockwise, by the names of their points.
#[no_mangle]
pub extern "C" fn plane_triangles() -> f64 {
    with(|plane| {
        give(vec![plane.named()]);
        Ok(0.0)
    })
}

/// Draws the mesh, and returns the address of the picture: four bytes a pixel, row by row. The grid's origin is at
/// `left` and `bottom`, in pixels, and a step of the grid is `scale` pixels long.
#[no_mangle]
pub extern "C" fn plane_draw(width: usize, height: usize, left: f64, bottom: f64, scale: f64) -> f64 {
    with(|plane| {
        if !plane.light.resize(width, height) {
            return Err(format!("a picture of {width} by {height} pixels is too large: make the window smaller"));
        }
        plane.draw([left, bottom], scale);
        Ok(plane.light.image().as_ptr() as usize as f64)
    })
}
