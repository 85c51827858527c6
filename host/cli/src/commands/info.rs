//! `incircle info`: describes a back end.

use incircle::DeviceAddress;
use incircle_protocol::{Identity, RunKind};

use crate::arguments::InfoArguments;
use crate::backend::{self, Board, Choice};
use crate::failure::{counted, failure_of, Failure};
use crate::output;

/// Runs the subcommand: opens the back end, greets it and prints its identity.
pub fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let mut asked = arguments.backend.clone();
    asked.backend.extend(arguments.port.clone().map(DeviceAddress::Serial));
    let mut backend = backend::open_with_room(&Choice::of(&asked, None, "model")?, None, None, None)?;
    let card = backend.card.map_or(String::new(), |registers| registers.to_string());
    let board = backend.board.map_or(String::new(), about_board);
    let session = backend.device.session().map_err(|error| failure_of(&error))?;
    let keeps_meshes = session.keeps_living_meshes();
    let identity = session.identity();
    let [major, minor, patch] = [16, 8, 0].map(|shift| identity.core_version >> shift & 0xff);
    let protocol = identity.protocol_version;
    let protocol = format!("protocol {}.{}", protocol >> 16, protocol & 0xffff);
    let holds = format!("coordinates of {} bits\n{} points", identity.coord_bits, identity.capacity);
    let contexts = identity.contexts as usize;
    output::print(&if backend.name == "cpu" {
        format!("back end cpu\nversion {major}.{minor}.{patch}\n{holds}\n{}\n", counted(contexts, "thread"))
    } else {
        let insertions = counted(contexts, "insertion");
        let engines = match identity.engines {
            1 => String::new(),
            engines => format!("{engines} engines, each with the points and insertions below\n"),
        };
        format!(
            "back end {}\nversion {major}.{minor}.{patch}, {protocol}\n{engines}{holds}\n{insertions} at once\n\
             cavities of up to {} boundary edges\n{}{board}{card}",
            backend.name,
            identity.ring_capacity,
            about_runs(identity, keeps_meshes)
        )
    })
}

/// The line about a mesh that lives: the commands with which the device keeps it, if it has any.
fn about_runs(identity: &Identity, keeps_meshes: bool) -> String {
    let kinds = [
        (RunKind::Locate, "locate"),
        (RunKind::Interpolate, "interpolate"),
        (RunKind::Nearest, "nearest"),
        (RunKind::InsertAs, "insert"),
        (RunKind::Delete, "delete"),
        (RunKind::Move, "move"),
    ];
    if !keeps_meshes {
        return "a mesh that lives: kept by the processor\n".into();
    }
    let taken: Vec<_> = kinds.into_iter().filter(|&(kind, _)| identity.takes(kind)).map(|(_, name)| name).collect();
    format!("a mesh that lives: {}\n", taken.join(", "))
}

/// The lines about a board: its link and its clock.
fn about_board(board: Board) -> String {
    let greeting = board.greeting;
    let link = greeting.link_version;
    format!(
        "link {}.{}, {} bits per second of {}\nreceive buffer of {} bytes\nclock of {} MHz\n",
        link >> 16,
        link & 0xffff,
        board.rate,
        greeting.max_rate,
        greeting.fifo_bytes,
        f64::from(greeting.clock_hz) / 1e6
    )
}
