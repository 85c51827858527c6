//! Encodings of frames without zeros: COBS to the device, reverse COBS to the host. In both directions the device's
//! side needs almost no memory.

/// The length byte of the longest piece without a zero. No zero follows such a piece.
const LONGEST: u8 = 255;

/// Decodes COBS byte by byte. The decoder needs a counter and one flag.
#[derive(Clone, Copy, Debug, Default)]
pub struct CobsDecoder {
    /// Number of bytes of the current piece that are still to come.
    left: u8,
    /// Whether a zero follows the current piece, if another piece follows.
    zero_follows: bool,
}

impl CobsDecoder {
    /// Takes a byte that is not zero, and returns the decoded byte, if there is one.
    pub fn take(&mut self, byte: u8) -> Option<u8> {
        if self.left > 0 {
            self.left -= 1;
            return Some(byte);
        }
        let zero = self.zero_follows.then_some(0);
        self.left = byte - 1;
        self.zero_follows = byte != LONGEST;
        zero
    }

    /// Takes the zero at the end of a frame, and returns whether the last piece was complete. The decoder starts anew.
    pub fn end(&mut self) -> bool {
        let is_whole = self.left == 0;
        *self = Self::default();
        is_whole
    }
}

/// The bytes in COBS, without the zero that ends the frame.
pub fn encode(bytes: &[u8]) -> Vec<u8> {
    let mut encoded = vec![0];
    let mut place = 0;
    for &byte in bytes {
        if encoded.len() - place == usize::from(LONGEST) {
            encoded[place] = LONGEST;
            place = encoded.len();
            encoded.push(0);
        }
        if byte == 0 {
            encoded[place] = (encoded.len() - place) as u8;
            place = encoded.len();
            encoded.push(0);
        } else {
            encoded.push(byte);
        }
    }
    encoded[place] = (encoded.len() - place) as u8;
    encoded
}

/// The bytes from COBS, or `None` if the encoding contains a zero or ends within a piece.
pub fn decode(encoded: &[u8]) -> Option<Vec<u8>> {
    let mut decoder = CobsDecoder::default();
    if encoded.is_empty() || encoded.contains(&0) {
        return None;
    }
    let bytes = encoded.iter().filter_map(|&byte| decoder.take(byte)).collect();
    decoder.end().then_some(bytes)
}

/// Encodes reverse COBS byte by byte. The encoder needs one counter.
#[derive(Clone, Copy, Debug, Default)]
pub struct ReverseEncoder {
    /// Number of bytes since the last length byte.
    run: u8,
}

impl ReverseEncoder {
    /// Adds a byte of the frame, and passes the one or two encoded bytes to `emit`.
    pub fn add(&mut self, byte: u8, mut emit: impl FnMut(u8)) {
        if byte == 0 {
            emit(self.run + 1);
            self.run = 0;
            return;
        }
        emit(byte);
        self.run += 1;
        if self.run == LONGEST - 1 {
            emit(LONGEST);
            self.run = 0;
        }
    }

    /// The last length byte of the frame. The encoder starts anew.
    pub fn end(&mut self) -> u8 {
        let last = self.run + 1;
        self.run = 0;
        last
    }
}

/// The bytes in reverse COBS, without the zero that ends the frame.
pub fn encode_reverse(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ReverseEncoder::default();
    let mut encoded = Vec::with_capacity(bytes.len() + bytes.len() / 254 + 1);
    for &byte in bytes {
        encoder.add(byte, |byte| encoded.push(byte));
    }
    encoded.push(encoder.end());
    encoded
}

/// The bytes from reverse COBS, decoded from the end. `None` if the encoding contains a zero or a length byte
/// points before the start.
pub fn decode_reverse(encoded: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(encoded.len());
    let mut rest = encoded;
    let mut is_last = true;
    while let Some((&length, before)) = rest.split_last() {
        if length == 0 {
            return None;
        }
        // No zero follows the last piece, nor a piece of the greatest length.
        if !is_last && length != LONGEST {
            bytes.push(0);
        }
        is_last = false;
        let start = before.len().checked_sub(usize::from(length) - 1)?;
        let piece = &before[start..];
        if piece.contains(&0) {
            return None;
        }
        bytes.extend(piece.iter().rev());
        rest = &before[..start];
    }
    bytes.reverse();
    (!is_last).then_some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Frames around the greatest length of a piece, with zeros at both ends, and pseudo-random frames.
    fn samples() -> Vec<Vec<u8>> {
        let mut samples = vec![vec![], vec![0], vec![0, 0], vec![1, 0], vec![0, 1], b"123".to_vec()];
        for length in [253, 254, 255, 508, 509, 1037] {
            let ones = vec![1; length];
            samples.push([&ones[..], &[0]].concat());
            samples.push([&[0], &ones[..]].concat());
            samples.push([&ones[..], &[0], &ones[..]].concat());
            samples.push(ones);
        }
        let mut state = 1_u32;
        for length in 0..600 {
            samples.push(
                (0..length)
                    .map(|_| {
                        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                        // Some frames have many zeros, and in others most pieces have none.
                        ((state >> 24) % (2 + length % 200)) as u8
                    })
                    .collect(),
            );
        }
        samples
    }

    #[test]
    fn what_is_encoded_comes_back() {
        for bytes in samples() {
            let encoded = encode(&bytes);
            assert!(!encoded.contains(&0));
            assert_eq!(decode(&encoded).as_ref(), Some(&bytes));
            let reverse = encode_reverse(&bytes);
            assert!(!reverse.contains(&0));
            assert_eq!(decode_reverse(&reverse).as_ref(), Some(&bytes));
        }
    }

    #[test]
    fn it_is_as_the_page_says() {
        assert_eq!(encode(&[0x11, 0x22, 0, 0x33]), [3, 0x11, 0x22, 2, 0x33]);
        assert_eq!(encode_reverse(&[0x11, 0x22, 0, 0x33]), [0x11, 0x22, 3, 0x33, 2]);
        assert_eq!(encode(&[]), [1]);
        assert_eq!(encode_reverse(&[]), [1]);
        let long = vec![7; 254];
        assert_eq!(encode(&long), [&[255][..], &long].concat());
        assert_eq!(encode_reverse(&long), [&long[..], &[255, 1]].concat());
    }

    #[test]
    fn a_frame_that_lies_is_refused() {
        assert_eq!(decode(&[]), None);
        assert_eq!(decode(&[3, 1]), None);
        assert_eq!(decode(&[1, 0, 1]), None);
        assert_eq!(decode_reverse(&[]), None);
        assert_eq!(decode_reverse(&[1, 3]), None);
        assert_eq!(decode_reverse(&[1, 0]), None);
        assert_eq!(decode_reverse(&[0, 2]), None);
    }
}
