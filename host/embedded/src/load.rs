//! The points of a job as the device gets them, and a command with the words of its points.

use incircle_protocol::{Command, Layout, COMMAND_HEAD_WORDS};

use crate::order::{at, place_of};
use crate::Point;

/// The points of a job, which are read from the caller's slices whenever they are sent. So nothing is kept for sending
/// again.
#[derive(Clone, Copy)]
pub(crate) struct Load<'b> {
    pub points: &'b [Point],
    /// Indices of the distinct points, in order.
    pub order: &'b [u16],
    /// Contexts of the core.
    pub contexts: usize,
    pub layout: Layout,
}

impl Load<'_> {
    /// The index of the point that the device has as this vertex; `None` if there is no such vertex.
    pub fn index(&self, vertex: u32) -> Option<u16> {
        let vertex = usize::try_from(vertex).ok().filter(|&vertex| vertex < self.order.len())?;
        let place = place_of(vertex, self.order.len(), self.contexts);
        self.order.get(place).copied()
    }

    fn word(&self, word: usize) -> u32 {
        let width = self.layout.point_words.max(1);
        let place = place_of(word / width, self.order.len(), self.contexts);
        let index = self.order.get(place).copied().unwrap_or_default();
        let [x, y] = at(self.points, index);
        let [first, second] = self.layout.point_to_words(x.into(), y.into());
        if word.is_multiple_of(width) {
            first
        } else {
            second
        }
    }
}

/// A command with its words.
#[derive(Clone, Copy)]
pub(crate) struct Request<'b> {
    pub command: Command<()>,
    head: [u32; COMMAND_HEAD_WORDS],
    head_words: usize,
    points: Option<&'b Load<'b>>,
}

impl<'b> Request<'b> {
    /// A command without points.
    pub fn bare(command: Command<()>) -> Self {
        let (head, head_words) = command.head();
        Self { command, head, head_words, points: None }
    }

    /// The command that inserts all points of a job.
    pub fn insert(load: &'b Load<'b>) -> Self {
        let count = load.order.len() as u32;
        Self { points: Some(load), ..Self::bare(Command::Insert { count, points: () }) }
    }

    /// The command that has the same answer when the first one is lost. Inserting no points brings the report of the
    /// points before them once more.
    pub fn again(&self) -> Request<'static> {
        Request::bare(match self.command {
            Command::Insert { .. } => Command::Insert { count: 0, points: () },
            command => command,
        })
    }

    /// Number of words of the whole command.
    pub fn words(&self) -> usize {
        self.head_words + self.points.map_or(0, |load| load.order.len() * load.layout.point_words)
    }

    /// A byte of the whole command.
    pub fn byte(&self, place: usize) -> u8 {
        let word = place / 4;
        let word = match (self.head.get(word), self.points) {
            (Some(&head), _) if word < self.head_words => head,
            (_, Some(load)) => load.word(word - self.head_words),
            _ => 0,
        };
        (word >> (8 * (place % 4))) as u8
    }
}
