//! The way to a device: commands go out, answers come back.

use std::time::Instant;

use incircle_protocol::{Command, ANSWER_HEAD_WORDS};

use crate::error::TransportError;

/// What an answer begins with: its header, and the number of words of its payload.
pub type AnswerHead = [u32; ANSWER_HEAD_WORDS];

/// A way to a device.
///
/// The trait is object-safe; `Box<dyn Transport>` is what [`Device::from_transport`](crate::Device::from_transport)
/// takes. A way carries whole commands and whole answers, in their order, and judges no answer: what a device says is
/// checked above it. After an error the streams are out of step, and the session that saw it refuses further work,
/// unless [`recover`](Self::recover) helps.
pub trait Transport {
    /// Short name for reports: `model`, `sim:full`.
    fn name(&self) -> String;

    /// Hands over commands whose answers are received later, or fails by `deadline`. It is one command, all answers to
    /// earlier ones have been received, and this call may wait for the answer, unless the way [takes commands
    /// ahead](Capabilities::takes_ahead).
    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError>;

    /// Receives the answer to the first command whose answer has not been received, or fails by `deadline`. `head` is
    /// what that answer begins with if the device did what it was asked for: then the payload, which is as long as that
    /// says, is filled. Of any other answer the payload is left alone. Gives what the answer begins with;
    /// [`receive_in_pieces`] does all that for a stream of words.
    ///
    /// A way whose device may be reset by others has an error for an answer that must be somebody else's.
    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError>;

    /// What this way can do, and how fast it is.
    fn capabilities(&self) -> Capabilities {
        Capabilities::default()
    }

    /// The clock of the device, where it is counted.
    fn clocks(&self) -> Option<DeviceClocks> {
        None
    }

    /// After an error: brings the device back to where it was after its reset, if that may help, and says whether it
    /// did. Then the job is tried once more, from its `Clear` on, and so is what was sent ahead behind it.
    ///
    /// # Errors
    /// A newer fault, which tells more than the one before.
    fn recover(&mut self, deadline: Instant) -> Result<bool, TransportError> {
        let _ = deadline;
        Ok(false)
    }
}

/// What a way to a device can do. The default suits one that is plain: a command at a time, `Triangles`, and no time
/// lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capabilities {
    /// Commands may be submitted before the answers to earlier ones are received. Only for a way on which
    /// [`submit`](Transport::submit) never waits until answers are received: what comes meanwhile is kept, up to the
    /// answers of two jobs.
    pub takes_ahead: bool,
    /// Meshes are read with `Triangles`, which leaves out the links: half the words. False where a way knows `Read`
    /// alone, as one does that asks again for parts of an answer.
    pub packs_records: bool,
    /// How fast the way is.
    pub pace: Pace,
}

impl Default for Capabilities {
    fn default() -> Self {
        Self { takes_ahead: false, packs_records: true, pace: Pace::default() }
    }
}

/// Clocks of a device since it was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceClocks {
    /// Until now.
    pub now: u64,
    /// Until the word that was received last; `None` before the first. The device may be far ahead of what was
    /// received.
    pub answer: Option<u64>,
}

/// How fast a way to a device is: times and lengths that the library chooses itself follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// How many times slower than a real device it is: 1, or more for a simulation.
    pub slow: u32,
    /// Words that pass in a second; `None` if that is not what takes the time.
    pub words_per_second: Option<u32>,
}

impl Default for Pace {
    fn default() -> Self {
        Self { slow: 1, words_per_second: None }
    }
}

impl Pace {
    /// Items of this many words for about a quarter of a second, so that progress is told and an interrupt heard in
    /// time: at least 64, at most `most`.
    pub(crate) fn chunk(self, most: usize, words: usize) -> usize {
        const LEAST: usize = 64;
        match self.words_per_second {
            Some(rate) => most.min((rate as usize / 4 / words.max(1)).max(LEAST)),
            None => most,
        }
    }
}

/// Receives an answer as [`Transport::receive`] must, from a stream of words: `fill` fills the whole of a list with the
/// next words.
///
/// # Errors
/// Those of `fill`.
pub fn receive_in_pieces(
    head: AnswerHead,
    payload: &mut [u32],
    mut fill: impl FnMut(&mut [u32]) -> Result<(), TransportError>,
) -> Result<AnswerHead, TransportError> {
    let mut came = [0; ANSWER_HEAD_WORDS];
    fill(&mut came)?;
    if came == head && !payload.is_empty() {
        fill(payload)?;
    }
    Ok(came)
}
