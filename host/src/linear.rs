//! Values between points on any back end that answers questions about places.

use incircle_geometry::interpolate::{edge_value, plane_value};
use incircle_geometry::living::Location;
use incircle_geometry::Point;

use crate::device::LivingMesh;
use crate::error::Error;

/// The linear values at places, where the mesh answers in which triangle each place lies; NaN outside the hull.
///
/// `points` and `values` are those of the mesh, by index. The values have the bits of those that
/// [`Surface`](crate::interpolate::Surface) gives by [`Method::Linear`](crate::interpolate::Method::Linear) for the same
/// points, whatever the mesh: a device says where a place lies, which is exact, and the processor works out the value
/// from the corners.
///
/// One question for each place: O(log n) expected on the processor; a device walks from the place of the question
/// before, so ask for places along a curve.
///
/// ```
/// use incircle::{linear_values, Device, LivingMesh, Point};
///
/// let points = [(0, 0), (8, 0), (0, 8)].map(Point::from);
/// let mut device = Device::open("model")?;
/// let mut session = device.session()?;
/// let mut mesh = session.living()?;
/// mesh.insert_all(&points)?;
/// let found = linear_values(&mut mesh, &points, &[1.0, 9.0, 1.0], &[Point::new(4, 2), Point::new(9, 9)])?;
/// assert!(found[0] == 5.0 && found[1].is_nan());
/// # Ok::<(), incircle::Error>(())
/// ```
///
/// # Errors
/// Those of [`LivingMesh::locate`].
///
/// # Panics
/// If the mesh has a point whose index is not below the number of points or of values.
pub fn linear_values(
    mesh: &mut impl LivingMesh<Point>,
    points: &[Point],
    values: &[f64],
    places: &[Point],
) -> Result<Vec<f64>, Error> {
    let doubles = |point: Point| [f64::from(point.x), f64::from(point.y)];
    let corner = |index: u32| (doubles(points[index as usize]), values[index as usize]);
    let value = |&place: &Point| {
        Ok(match mesh.locate(place)? {
            Location::Vertex(index) => values[index as usize],
            Location::Edge(ends) => edge_value(ends.map(corner), doubles(place)),
            Location::Triangle(corners) => plane_value(corners.map(corner), doubles(place)),
            Location::Outside(_) | Location::None => f64::NAN,
        })
    };
    places.iter().map(value).collect()
}
