//! The commands that a link can send, whatever the link is.

use incircle_protocol::{Command, Layout};

/// Checks that the points or items of a command are laid out for the device, and that the answer to a run has at most
/// `run_words` words of payload.
///
/// # Errors
/// A sentence that says what is wrong with the command.
pub(super) fn check_sendable(
    command: &Command<impl AsRef<[u32]>>,
    layout: Layout,
    run_words: usize,
) -> Result<(), &'static str> {
    let is_laid_out = command.points().len() as u64 == command.point_words(layout);
    match command.bare() {
        Command::Insert { .. } if !is_laid_out => Err("the points of this command are laid out for another device"),
        Command::Run { .. } if !is_laid_out => Err("the items of this command are laid out for another device"),
        Command::Run { .. } if command.payload_words(layout) > run_words as u64 => {
            Err("the answer to this run is longer than the link takes: send the items in shorter runs")
        }
        _ => Ok(()),
    }
}
