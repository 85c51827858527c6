//! The way to a device: two streams of 32-bit words.

use std::time::Instant;

use crate::pcie::PcieFault;
use crate::serial::SerialFault;

/// A way to a device: commands go out as words, answers come back as words.
///
/// The trait is object-safe; `Box<dyn Transport>` is what [`Device::from_transport`](crate::Device::from_transport)
/// takes. An implementation only carries words: everything a device says is checked above it. After an error the
/// stream is out of step, and the session that saw it refuses further work.
pub trait Transport {
    /// Sends all `words`, or fails by `deadline`.
    fn send(&mut self, words: &[u32], deadline: Instant) -> Result<(), TransportError>;

    /// Fills the whole of `words` with the next words of the device, or fails by `deadline`.
    fn receive(&mut self, words: &mut [u32], deadline: Instant) -> Result<(), TransportError>;

    /// Words of commands may be sent before the answers to earlier ones are received. False, unless a way says otherwise: each call of
    /// `send` is one command, whose answer is received before the next. Say true only if `send` never waits until answers are received: what
    /// comes meanwhile is kept, up to the answers of two jobs.
    fn takes_ahead(&self) -> bool {
        false
    }

    /// Clocks of the device since it was made, where they are counted.
    fn clocks(&self) -> Option<u64> {
        None
    }

    /// The clock of the device, counted as [`Transport::clocks`] does, in which it gave the word that was received last. None where that is not
    /// known: the device may be far ahead of what was received.
    fn answer_clock(&self) -> Option<u64> {
        None
    }

    /// Short name for reports: `model`, `sim:full`.
    fn name(&self) -> String;

    /// Meshes are read with `Triangles`, which leaves out the links: half the words. False where this way knows `Read` alone, as one does
    /// that asks again for parts of an answer.
    fn packs_records(&self) -> bool {
        true
    }

    /// How fast this way is, as far as that matters to whoever uses it.
    fn pace(&self) -> Pace {
        Pace::default()
    }

    /// An answer has come to a command that nobody gave, or one that says that what was there is not, as when others reset the device: what
    /// follows in a command is then taken for commands. The error to tell, if that may have happened here and [`recover`](Self::recover) may
    /// help; `None` distrusts the device.
    fn lost_step(&mut self) -> Option<TransportError> {
        None
    }

    /// After an error: brings the device back to where it was after its reset, if that may help, and says whether it did. Then the
    /// job is tried once more, from its `Clear` on, and so is what was sent ahead behind it.
    ///
    /// # Errors
    /// A newer fault, which tells more than the one before.
    fn recover(&mut self, deadline: Instant) -> Result<bool, TransportError> {
        let _ = deadline;
        Ok(false)
    }
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
    /// Items of this many words for about a quarter of a second, so that progress is told and an interrupt heard in time: at least 64,
    /// at most `most`.
    pub(crate) fn chunk(self, most: usize, words: usize) -> usize {
        const LEAST: usize = 64;
        match self.words_per_second {
            Some(rate) => most.min((rate as usize / 4 / words.max(1)).max(LEAST)),
            None => most,
        }
    }
}

/// Why words did not get through.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TransportError {
    /// The deadline passed with this many words of the call done.
    #[error("the deadline passed after {done} of {wanted} words")]
    Timeout {
        /// Words carried before the deadline.
        done: usize,
        /// Words the call asked for.
        wanted: usize,
    },
    /// The device has nothing more to say, and more was expected.
    #[error("the device ended its answer after {done} of {wanted} words")]
    Closed {
        /// Words carried before the end.
        done: usize,
        /// Words the call asked for.
        wanted: usize,
    },
    /// The operating system refused.
    #[error("{0}")]
    Io(#[from] std::io::Error),
    /// The serial link gave up.
    #[error("{0}")]
    Serial(#[from] SerialFault),
    /// The card failed.
    #[error("{0}")]
    Pcie(#[from] PcieFault),
    /// Anything else, in one sentence.
    #[error("{0}")]
    Other(String),
}
