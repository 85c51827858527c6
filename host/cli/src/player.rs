//! One script of changes and questions on the processor, or on an opened back end that keeps living meshes.

use std::ops::ControlFlow;

use incircle::{Point, Triangulation};

use crate::arguments::JobArguments;
use crate::backend::Backend;
use crate::failure::{failure_of, Failure};
use crate::interrupt;
use crate::lattice::Numbers;
use crate::progress::CountMeter;
use crate::script::{self, Film, Played, Script};

/// Whether the device takes changes and questions itself. If so, `check_bits` refuses points whose coordinates need
/// more bits than the device has.
pub fn keeps_living_meshes(
    device: &mut Backend,
    check_bits: impl Fn(u32) -> Result<(), Failure>,
) -> Result<bool, Failure> {
    let session = interrupt::working(|| device.device.session()).map_err(|error| failure_of(&error))?;
    let lives = session.keeps_living_meshes();
    if lives {
        check_bits(session.identity().coord_bits)?;
    }
    Ok(lives)
}

/// A script, and what is wanted of it.
pub struct Player<'a> {
    /// The script to carry out.
    pub script: &'a Script,
    /// The film that gets frames.
    pub film: Option<&'a mut Film>,
    /// Whether no progress is shown.
    pub quiet: bool,
}

impl Player<'_> {
    /// Carries out the script on the processor.
    pub fn play(self, numbers: &Numbers<'_>, wants_mesh: bool) -> Result<Played, Failure> {
        let (meter, Self { script, film, .. }) = (self.meter(), self);
        let played = interrupt::working(|| match numbers {
            Numbers::Grid(points) => script::play(script, points, &mut Triangulation::new(), film, wants_mesh, &meter),
            Numbers::Whole(points) => script::play(script, points, &mut Triangulation::new(), film, wants_mesh, &meter),
            Numbers::Doubles(points) => {
                script::play(script, points, &mut Triangulation::new(), film, wants_mesh, &meter)
            }
        });
        interrupt::check()?;
        played
    }

    /// Carries out the script on a device that keeps living meshes.
    pub fn play_on(self, device: &mut Backend, points: &[Point], job: &JobArguments) -> Result<Played, Failure> {
        let (meter, Self { script, film, .. }) = (self.meter(), self);
        let played = interrupt::working(|| {
            let mut session = device.device.session().map_err(|error| failure_of(&error))?;
            let listener = |_| ControlFlow::Continue(());
            let mut mesh = session.living_with(&job.options(&listener)).map_err(|error| failure_of(&error))?;
            script::play(script, points, &mut mesh, film, true, &meter)
        });
        interrupt::check()?;
        played
    }

    fn meter(&self) -> CountMeter {
        CountMeter::new(self.script.commands.len() as u64, "replaying", "commands", self.quiet)
    }
}
