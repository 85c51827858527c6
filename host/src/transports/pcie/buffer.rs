//! Memory for transfers, in whole pages that are used again.

/// Bytes of a page, the unit in which the DMA engine of a card moves memory.
const PAGE: usize = 4096;
/// Most buffers that are kept for later transfers.
const SPARE: usize = 4;

/// A buffer that begins at a page.
#[derive(Debug, Default)]
pub(super) struct PageBuffer {
    memory: Vec<u8>,
    start: usize,
    length: usize,
}

impl PageBuffer {
    /// A buffer of `length` bytes, of any value.
    fn of(length: usize) -> Self {
        let memory = vec![0; length.next_multiple_of(PAGE) + PAGE];
        // The minimum is for interpreters, where `align_offset` may fail: on real memory it is less than a page.
        let start = memory.as_ptr().align_offset(PAGE).min(PAGE);
        Self { memory, start, length }
    }

    fn room(&self) -> usize {
        self.memory.len().saturating_sub(self.start)
    }

    pub fn bytes(&self) -> &[u8] {
        &self.memory[self.start..self.start + self.length]
    }

    /// The bytes of the buffer, to be filled.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.memory[self.start..self.start + self.length]
    }

    /// Shortens the buffer to at most `length` bytes.
    pub fn truncate(&mut self, length: usize) {
        self.length = self.length.min(length);
    }
}

/// Used buffers. Later ones are taken from here, so that a job does not pay for fresh pages.
#[derive(Debug, Default)]
pub(super) struct Pool {
    spare: Vec<PageBuffer>,
}

impl Pool {
    /// A buffer of `length` bytes, of any value.
    pub fn take(&mut self, length: usize) -> PageBuffer {
        match self.spare.iter().position(|buffer| buffer.room() >= length) {
            Some(place) => PageBuffer { length, ..self.spare.swap_remove(place) },
            None => PageBuffer::of(length),
        }
    }

    /// Takes a buffer back.
    pub fn give(&mut self, buffer: PageBuffer) {
        if self.spare.len() >= SPARE {
            // The smallest buffer goes, since it is the cheapest to make again.
            let smallest = (0..self.spare.len()).min_by_key(|&place| self.spare[place].room());
            if let Some(place) = smallest.filter(|&place| self.spare[place].room() < buffer.room()) {
                self.spare[place] = buffer;
            }
            return;
        }
        self.spare.push(buffer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buffers_begin_at_pages_and_are_used_again() {
        let mut pool = Pool::default();
        for length in [0, 1, PAGE - 1, PAGE, 3 * PAGE + 8, 1 << 20] {
            let mut buffer = pool.take(length);
            assert_eq!((buffer.bytes().len(), buffer.bytes().as_ptr() as usize % PAGE), (length, 0));
            buffer.bytes_mut().fill(7);
            buffer.truncate(length / 2);
            assert_eq!(buffer.bytes().len(), length / 2);
            pool.give(buffer);
        }
        let before: Vec<_> = pool.spare.iter().map(|buffer| buffer.memory.as_ptr()).collect();
        let large = pool.take(1 << 20);
        assert!(before.contains(&large.memory.as_ptr()));
        pool.give(large);
        assert_eq!(pool.spare.len(), SPARE);
    }
}
