//! The forms in which the records of a load are read: whole, or their vertices alone, with ids of as many bits as the
//! job needs.

use std::ops::Range;

use incircle_protocol::{infinite_vertex, Command, Layout, Opcode, RecordRange, ShortIds, FEATURE_SHORT_IDS};

use super::assemble::check_last_half;
use crate::error::DeviceFault;
use crate::transports::Capabilities;

/// The form of the answers to a load's questions for records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ReadForm {
    /// Whole records, with their neighbours.
    Whole,
    /// The vertices, with ids as wide as the device's layout has them.
    Vertices,
    /// The vertices, with short ids.
    Short(ShortIds),
}

impl ReadForm {
    /// The shortest form for a load of `ids` points over this transport, from a device with these features.
    pub(crate) fn of(ids: usize, capabilities: Capabilities, features: u32) -> Self {
        if !capabilities.packs_records {
            return Self::Whole;
        }
        let short = ShortIds::below(u32::try_from(ids).unwrap_or(u32::MAX));
        short.filter(|_| features & FEATURE_SHORT_IDS != 0).map_or(Self::Vertices, Self::Short)
    }

    /// The command that reads these records.
    pub(crate) fn command<P>(self, records: Range<usize>) -> Command<P> {
        let range = RecordRange { first: records.start as u32, count: records.len() as u32 };
        match self {
            Self::Whole => Command::Read(range),
            Self::Vertices => Command::Triangles(range),
            Self::Short(ids) => Command::ShortTriangles(range, ids),
        }
    }

    pub(crate) fn opcode(self) -> Opcode {
        self.command::<()>(0..0).opcode()
    }

    /// The vertices of a record in the words of `records` records, in a form other than `Whole`. The infinite vertex is
    /// that of the device.
    pub(crate) fn vertices(
        self,
        layout: Layout,
        capacity: u32,
        words: &[u32],
        records: usize,
        record: usize,
    ) -> [u32; 3] {
        let Self::Short(ids) = self else { return layout.vertices_from_words(words, record) };
        let infinite = infinite_vertex(capacity);
        let restored = |id| if id == ids.infinite(infinite) { infinite } else { id };
        ids.vertices_from_words(words, records, record).map(restored)
    }

    /// Checks that the bits behind the last of these records, if there are any, are 0.
    pub(crate) fn check_spare(self, layout: Layout, records: &Range<usize>, words: &[u32]) -> Result<(), DeviceFault> {
        match self {
            Self::Whole | Self::Short(ShortIds::Ten) => Ok(()),
            Self::Vertices => check_last_half(layout, records, words),
            Self::Short(ShortIds::Twelve) => {
                let spare = ShortIds::Twelve.spare_bits(records.len());
                match words.last() {
                    Some(&word) if word & spare != 0 => Err(DeviceFault::SpareHalf { record: records.end - 1, word }),
                    _ => Ok(()),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_form_follows_the_job_and_the_device() {
        let plain = Capabilities::default();
        let whole = Capabilities { packs_records: false, ..plain };
        let of = |ids| ReadForm::of(ids, plain, FEATURE_SHORT_IDS);
        let forms = [1023, 1024, 4095, 4096].map(of);
        let [ten, twelve] = [ShortIds::Ten, ShortIds::Twelve].map(ReadForm::Short);
        assert_eq!(forms, [ten, twelve, twelve, ReadForm::Vertices]);
        assert_eq!(ReadForm::of(5, plain, 0), ReadForm::Vertices);
        assert_eq!(ReadForm::of(5, whole, FEATURE_SHORT_IDS), ReadForm::Whole);
    }

    #[test]
    fn bits_behind_the_last_record_are_found() {
        let layout = Layout::of(16, 4096);
        let form = ReadForm::Short(ShortIds::Twelve);
        let mut words = vec![0; ShortIds::Twelve.words(3) as usize];
        ShortIds::Twelve.vertices_to_words([4095, 4095, 4095], &mut words, 3, 2);
        assert_eq!(form.check_spare(layout, &(7..10), &words), Ok(()));
        assert_eq!(form.vertices(layout, 4096, &words, 3, 2), [8191; 3], "the infinite vertex of the device");
        let last = words.len() - 1;
        for bit in [0, 3, 16, 19] {
            let mut wrong = words.clone();
            wrong[last] |= 1 << bit;
            let fault = DeviceFault::SpareHalf { record: 9, word: wrong[last] };
            assert_eq!(form.check_spare(layout, &(7..10), &wrong), Err(fault));
        }
    }
}
