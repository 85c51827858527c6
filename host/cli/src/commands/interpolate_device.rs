//! Linear values where a device says in which triangle each place lies.

use std::ops::ControlFlow;

use incircle::interpolate::Error::NoTriangle;
use incircle::{linear_values, DeviceAddress, LivingMesh, Options, Point};

use crate::arguments::{BackendArguments, InterpolateArguments, MethodName, OutsideName};
use crate::backend::{self, Choice, MODEL_COORD_BITS};
use crate::failure::{failure_of, Failure};
use crate::interrupt;
use crate::lattice::{Laid, Numbers};
use crate::value_places::ValuePlaces;

/// The back end of the arguments, if it is a device. A device gives neither other methods, nor contours, nor values
/// outside the hull.
pub fn choose(arguments: &InterpolateArguments) -> Result<Option<Choice>, Failure> {
    let Some(address) = arguments.backend.as_ref().filter(|address| !matches!(address, DeviceAddress::Cpu { .. }))
    else {
        return Ok(None);
    };
    let is_linear = arguments.method == MethodName::Linear && arguments.contours.is_none();
    if !is_linear || arguments.outside != OutsideName::Nan || arguments.threads.is_some() {
        return Err(Failure::usage(
            "a device gives linear values at places, and nothing outside the hull: leave out --backend, or --method, \
             --contours, --outside and --threads",
        ));
    }
    let backend = BackendArguments { backend: vec![address.clone()], threads: None, config: None };
    let mut choice = Choice::of(&backend, None, "cpu")?;
    if matches!(choice.address, DeviceAddress::Model { coord_bits: None, .. }) {
        choice.coord_bits = MODEL_COORD_BITS;
    }
    Ok(Some(choice))
}

/// The values at places whose table stands behind the points, which have values.
pub fn values(choice: &Choice, laid: &Laid<'_>, values: &[f64], places: &ValuePlaces) -> Result<Vec<f64>, Failure> {
    choice.check_lattice(laid)?;
    let Numbers::Grid(grid) = &laid.numbers else {
        let remedy = "give --backend cpu, which takes any numbers";
        return Err(Failure::input(format!("the points and places lie on no lattice of up to 32 bits: {remedy}")));
    };
    let (points, at) = grid.split_at(values.len());
    if is_on_line(points) {
        return Err(Failure::input(NoTriangle.to_string()));
    }
    let choice = choice.clone().with_runs_for(points.len())?;
    let mut backend = backend::open_with_room(&choice, Some(points.len()), None, None)?;
    let at: Vec<[u32; 2]> = at.iter().map(|&point| point.into()).collect();
    let mut found = Vec::with_capacity(places.len());
    let done = interrupt::working(|| {
        let mut session = backend.device.session()?;
        let listener = |_| ControlFlow::Continue(());
        let mut mesh = session.living_with(&Options::default().progress(&listener))?;
        mesh.insert_all(points)?;
        places.each(&at, |some| {
            let some: Vec<Point> = some.iter().copied().map(Point::from).collect();
            found.extend(linear_values(&mut mesh, points, values, &some)?);
            Ok(())
        })
    });
    interrupt::check()?;
    done.map_err(|error: incircle::Error| failure_of(&error))?;
    Ok(found)
}

/// Whether all points lie on one line, or are fewer than three: then there is no surface, on a device as elsewhere.
fn is_on_line(points: &[Point]) -> bool {
    let Some(&first) = points.first() else { return true };
    let Some(&other) = points.iter().find(|&&point| point != first) else { return true };
    let vector = |to: Point| [(to.x, first.x), (to.y, first.y)].map(|(to, from)| i128::from(to) - i128::from(from));
    let [u, v] = vector(other);
    points.iter().all(|&point| {
        let [x, y] = vector(point);
        u * y == v * x
    })
}
