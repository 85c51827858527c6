//! `incircle info`: describes a back end.

use incircle::DeviceAddress;

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
             cavities of up to {} boundary edges\n{board}{card}",
            backend.name, identity.ring_capacity
        )
    })
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
