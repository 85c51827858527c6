//! The trait of all transports: commands go out, answers come back.

use std::time::Instant;

use incircle_protocol::{signed_header, Command, ANSWER_HEAD_WORDS};

use crate::error::{ErrorKind, TransportError};

/// The beginning of an answer: its header, and the number of words of its payload.
pub type AnswerHead = [u32; ANSWER_HEAD_WORDS];

/// Carries commands to a device and brings the answers.
///
/// Implement this trait to connect a simulator or another bus, and hand your type to
/// [`Device::from_transport`](crate::Device::from_transport). A plain transport needs a [`name`](Self::name) and two
/// more methods, [`submit`](Self::submit) and [`receive`](Self::receive); [`receive_in_pieces`] does most of the
/// latter.
///
/// A transport carries whole commands and whole answers, in their order, and leaves it to the session to check them.
/// After an error commands and answers are out of step, and the session refuses further work, unless
/// [`recover`](Self::recover) helps.
pub trait Transport {
    /// Short name for reports and errors, such as `model` or `sim:full`.
    fn name(&self) -> String;

    /// Hands commands to the device, or fails by `deadline`. The answers are received later.
    ///
    /// Unless the transport [takes commands ahead](Capabilities::takes_ahead), `commands` is one command, all answers
    /// to earlier ones have been received, and this call may wait for the answer.
    ///
    /// # Errors
    /// [`TransportError::Timeout`] if the deadline passes, or whatever went wrong.
    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError>;

    /// Receives the answer to the oldest command whose answer is outstanding, or fails by `deadline`.
    ///
    /// `head` is the beginning of that answer if the device did what it was asked for, and `payload` has the length
    /// that `head` announces. If the answer begins with `head`, apart from the low half of the header, which names the
    /// engine and the job, `payload` is filled; if not, `payload` is left as it is. The result is the actual beginning.
    /// [`receive_in_pieces`] does all that for a stream of words. The low byte of the header in `head` is the tag of
    /// the job, or 0 if the tag is not known.
    ///
    /// # Errors
    /// [`TransportError::Timeout`] if the deadline passes, or whatever went wrong. A transport whose device others may
    /// reset also fails for an answer that cannot belong to its own command.
    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError>;

    /// Receives the next answer that the device gives, or fails by `deadline`. It is called only if answers may come
    /// [in any order](Capabilities::any_order), as those of several engines do.
    ///
    /// `words_of` tells the number of words of the payload for the beginning of an answer, and `None` for one that no
    /// command has. `payload` gets that length and is filled; in the case of `None` it is emptied, and nothing more is
    /// read. The result is the beginning. [`receive_next_in_pieces`] does all that for a stream of words.
    ///
    /// # Errors
    /// The errors of [`receive`](Self::receive). The default implementation takes answers in order only, and fails.
    fn receive_next(
        &mut self,
        words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
        payload: &mut Vec<u32>,
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        let _ = (words_of, payload, deadline);
        Err(TransportError::other(ErrorKind::Link, "this transport takes the answers of a device in order only"))
    }

    /// The abilities and the pace of this transport. The default suits a plain transport.
    fn capabilities(&self) -> Capabilities {
        Capabilities::default()
    }

    /// Number of commands that were sent again so far, because their answers were lost on the way. The device may have
    /// carried out such a command more than once. The default, 0, suits a transport that loses nothing.
    fn repeats(&self) -> u64 {
        0
    }

    /// The clocks of the device; `None` where they are not counted.
    fn clocks(&self) -> Option<DeviceClocks> {
        None
    }

    /// Tries, after an error of the transport or a wrong answer, to bring the device back to its state after a reset,
    /// if that may help.
    ///
    /// After `true` the session tries the job once more, from its `Clear` on, and everything that was sent ahead behind
    /// it. After `false`, the default, the error stands.
    ///
    /// # Errors
    /// A newer fault that tells more than the error before it.
    fn recover(&mut self, deadline: Instant) -> Result<bool, TransportError> {
        let _ = deadline;
        Ok(false)
    }
}

/// The abilities of a transport.
///
/// The default suits a plain transport: one command at a time, read-out by `Triangles`, and no pace to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Capabilities {
    /// Whether commands may be submitted before the answers to earlier ones are received. Set it only if
    /// [`submit`](Transport::submit) never waits until answers are received. The transport must keep what comes
    /// meanwhile: the answers to [`jobs_ahead`](Self::jobs_ahead) jobs, and on a device of several engines those to two
    /// jobs for each engine and to one more.
    pub takes_ahead: bool,
    /// Most jobs under way at a time on a device of one engine, if commands may be sent ahead: 2 on a bus. More hide
    /// the round trip of a network; the transport must keep the answers of so many.
    pub jobs_ahead: usize,
    /// Whether answers are taken in the order in which they come, by [`receive_next`](Transport::receive_next). Without
    /// it a device of several engines gets one job at a time.
    pub any_order: bool,
    /// Whether meshes are read with `Triangles`, which leaves out the neighbours and so half of the words. Clear it for
    /// a transport that only knows `Read`.
    pub packs_records: bool,
    /// Words of answers that the device keeps for the line while its core goes on, or `usize::MAX` where the core does
    /// not wait for the line. Jobs are put side by side only while their meshes fit, because a core inserts nothing
    /// while its answers wait.
    pub kept_words: usize,
    /// Most words of payload of the answer to a run. Longer runs are sent in pieces.
    pub run_words: usize,
    /// Speed of the transport.
    pub pace: Pace,
}

impl Default for Capabilities {
    fn default() -> Self {
        Self {
            takes_ahead: false,
            jobs_ahead: 2,
            any_order: false,
            packs_records: true,
            kept_words: usize::MAX,
            run_words: usize::MAX,
            pace: Pace::default(),
        }
    }
}

/// Clocks of a device since it was opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceClocks {
    /// Clocks up to now.
    pub now: u64,
    /// Clocks up to the word that was received last; `None` before the first. The device may be far ahead of the words
    /// received.
    pub answer: Option<u64>,
}

/// The speed of a transport. Times and lengths that the library chooses itself follow it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pace {
    /// Factor by which the device is slower than a real one: 1, or more for a simulation.
    pub slow: u32,
    /// Words that pass in a second; `None` if the words are not what takes the time.
    pub words_per_second: Option<u32>,
}

impl Default for Pace {
    fn default() -> Self {
        Self { slow: 1, words_per_second: None }
    }
}

impl Pace {
    /// Number of items of `words` words that pass in about a quarter of a second, so that progress is reported and an
    /// interrupt heard in time: at least 64 and at most `most`.
    pub(crate) fn chunk(self, most: usize, words: usize) -> usize {
        const LEAST: usize = 64;
        match self.words_per_second {
            Some(rate) => most.min((rate as usize / 4 / words.max(1)).max(LEAST)),
            None => most,
        }
    }
}

/// Receives an answer as [`Transport::receive`] must, from a stream of words.
///
/// `fill` fills the whole of a slice with the next words, or fails.
///
/// # Errors
/// The errors of `fill`.
pub fn receive_in_pieces(
    head: AnswerHead,
    payload: &mut [u32],
    mut fill: impl FnMut(&mut [u32]) -> Result<(), TransportError>,
) -> Result<AnswerHead, TransportError> {
    let mut came = [0; ANSWER_HEAD_WORDS];
    fill(&mut came)?;
    if is_begun_as(came, head) && !payload.is_empty() {
        fill(payload)?;
    }
    Ok(came)
}

/// Whether an answer begins as it should, whichever engine gives it and whatever the tag of its job is.
pub(crate) fn is_begun_as([came, came_words]: AnswerHead, [header, words]: AnswerHead) -> bool {
    signed_header(came, 0, 0) == signed_header(header, 0, 0) && came_words == words
}

/// Receives an answer as [`Transport::receive_next`] must, from a stream of words.
///
/// `fill` fills the whole of a slice with the next words, or fails.
///
/// # Errors
/// The errors of `fill`.
pub fn receive_next_in_pieces(
    words_of: &mut dyn FnMut(AnswerHead) -> Option<usize>,
    payload: &mut Vec<u32>,
    mut fill: impl FnMut(&mut [u32]) -> Result<(), TransportError>,
) -> Result<AnswerHead, TransportError> {
    let mut came = [0; ANSWER_HEAD_WORDS];
    fill(&mut came)?;
    payload.clear();
    payload.resize(words_of(came).unwrap_or(0), 0);
    if !payload.is_empty() {
        fill(payload)?;
    }
    Ok(came)
}
