//! Several back ends for one set, from `--backend` given more than once.

use std::time::Duration;

use incircle::{DeviceAddress, Error, ErrorKind, Fleet, TransportError};

use crate::arguments::{BackendArguments, TriangulateArguments};
use crate::backend::{check_sim, open_with_room, Choice};
use crate::failure::{Exit, Failure};
use crate::lattice::Laid;

/// The back ends of a run: the choice of each.
pub struct Several {
    choices: Vec<Choice>,
    timeout: Option<Duration>,
}

impl Several {
    /// The back ends of the arguments; `None` if there are fewer than two. Choices that would concern only one of them
    /// are refused: they belong into its address.
    pub fn of(arguments: &TriangulateArguments) -> Result<Option<Self>, Failure> {
        let BackendArguments { backend, threads, config } = &arguments.backend;
        if backend.len() < 2 {
            return Ok(None);
        }
        if threads.is_some() || config.is_some() || arguments.trace.is_some() {
            return Err(Failure::usage(
                "with several back ends --threads, --config and --trace have no meaning: put the choices into the \
                 addresses, as in cpu?threads=1 or clock?config=quad",
            ));
        }
        let choose = |address: &DeviceAddress| -> Result<Choice, Failure> {
            if matches!(address, DeviceAddress::Sim { .. }) {
                check_sim()?;
            }
            let one = BackendArguments { backend: vec![address.clone()], threads: None, config: None };
            let choice = Choice::for_points(&one, &arguments.grid, "cpu")?;
            choice.check_bits()?;
            Ok(choice)
        };
        let choices = backend.iter().map(choose).collect::<Result<Vec<_>, _>>()?;
        Ok(Some(Self { choices, timeout: arguments.job.timeout }))
    }

    /// Bits of a coordinate that all back ends have.
    pub fn coord_bits(&self) -> u32 {
        self.choices.iter().map(|choice| choice.coord_bits).min().unwrap_or(0)
    }

    /// Refuses points whose lattice one of the back ends cannot hold, as far as that is known before they are open.
    pub fn check_lattice(&self, laid: &Laid<'_>) -> Result<(), Failure> {
        self.choices.iter().try_for_each(|choice| choice.check_lattice(laid))
    }

    /// The fleet of all back ends, for a set of these points.
    pub fn fleet(self, laid: &Laid<'_>) -> Fleet {
        let timeout = self.timeout;
        self.choices.into_iter().fold(Fleet::default(), |fleet, choice| {
            let (name, room) = (choice.address.to_string(), choice.room_for(&laid.numbers));
            fleet.with(name.clone(), move || match open_with_room(&choice, Some(room), None, timeout) {
                Ok(backend) => Ok(backend.device),
                Err(failure) => Err(error_of(&name, failure)),
            })
        })
    }
}

/// The error of the library for a back end that cannot be opened, with the exit code of the failure.
fn error_of(name: &str, failure: Failure) -> Error {
    let kind = match failure.exit {
        Exit::Link => ErrorKind::Link,
        Exit::Device => ErrorKind::Device,
        Exit::Capacity => ErrorKind::Capacity,
        Exit::Usage => ErrorKind::BadChoice,
        _ => ErrorKind::DeviceNotFound,
    };
    let begin = format!("{name} cannot be opened: ");
    let message = failure.message.strip_prefix(&begin).unwrap_or(&failure.message);
    if kind == ErrorKind::DeviceNotFound {
        return Error::Open { device: name.to_owned(), source: message.into() };
    }
    Error::Link { device: name.to_owned(), during: "the opening", source: TransportError::other(kind, message) }
}
