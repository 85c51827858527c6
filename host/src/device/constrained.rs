//! Points and constraints as one job of a session.

use incircle_geometry::constraints::{constrain, Plan, Triangulated};
use incircle_geometry::{Mesh, PlanePoint};

use super::cpu_backend;
use super::session::Session;
use crate::error::ConstrainedError;
use crate::job::{Options, Report, Solution};

impl Session<'_> {
    /// Triangulates points with constraints, and takes the triangles of a domain.
    ///
    /// The result is that of [`triangulate_with`](Self::triangulate_with) and then [`constrain`], byte for byte. Use
    /// this method if the constraints are known before the mesh: the CPU triangulator forces them in before it sorts
    /// its triangles, which takes less time than both steps, and the time counts as
    /// [`Stage::Assemble`](crate::Stage::Assemble). With any other device the host forces them into the mesh of the
    /// device, and the report has no time for that.
    ///
    /// The report counts the triangles of the whole hull, whatever the domain is. [`Options::timeout`] is for the
    /// triangulation, and on the CPU for the forcing of constraints, too. The listener hears of
    /// [`Stage::Assemble`](crate::Stage::Assemble) again from time to time while the CPU triangulator forces
    /// constraints, so that it can end the job. With any other device nothing ends the forcing of constraints.
    ///
    /// Cost: that of `triangulate_with`, then for each constraint the edges that it crosses, and the flips around them.
    ///
    /// ```
    /// use incircle::constraints::{Domain, Plan};
    /// use incircle::{Device, Options};
    ///
    /// // A square with a notch: point 4 lies inside the hull.
    /// let points = [[0, 0], [8, 0], [8, 8], [0, 8], [4, 3]];
    /// let outline = [[0, 1], [1, 2], [2, 4], [4, 3], [3, 0]];
    /// let plan = Plan { domain: Domain::EvenOdd, ..Plan::new(&outline) };
    /// let mut device = Device::open("cpu")?;
    /// let (mesh, report) = device.session()?.triangulate_constrained(&points, &plan, &Options::default())?;
    /// assert_eq!(mesh.made.triangles, [[0, 1, 4], [0, 4, 3], [1, 2, 4]]);
    /// assert_eq!((mesh.hull.len(), report.triangles), (4, 4));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ConstrainedError::Job`] with the errors of `triangulate_with`, and [`ConstrainedError::Plan`] with those of
    /// [`constrain`]. After an error of constraints the session can be used again.
    pub fn triangulate_constrained<P: PlanePoint>(
        &mut self,
        points: &(impl AsRef<[P]> + ?Sized),
        plan: &Plan<'_, P>,
        options: &Options<'_>,
    ) -> Result<(Triangulated, Report), ConstrainedError> {
        let points = points.as_ref();
        if self.backend.is_cpu() {
            let terms = self.terms(points.len(), options);
            let (_, lattice) = self.on_lattice(points, terms)?;
            let (found, report) = cpu_backend::constrain(points, plan, terms)?;
            return Ok((found, Report { lattice, ..report }));
        }
        let Solution { mesh, report } = self.triangulate_with(points, options)?;
        let made = constrain(&mesh, plan)?;
        let Mesh { hull, duplicates, .. } = mesh;
        let mut found = Triangulated::default();
        (found.made, found.hull, found.duplicates) = (made, hull, duplicates);
        Ok((found, report))
    }
}
