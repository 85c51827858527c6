//! Coding that takes the zeros out of frames to the device: COBS. Frames to the host come in reverse COBS, which
//! [`decode_reverse_cobs`](incircle_protocol::decode_reverse_cobs) decodes; the tests here send both ways.

/// Most bytes of a piece without a zero.
const PIECE: usize = 254;

/// Appends `bytes` in COBS, without the closing zero.
pub(super) fn encode(bytes: &[u8], out: &mut Vec<u8>) {
    let mut pieces = bytes.split(|&byte| byte == 0).peekable();
    while let Some(piece) = pieces.next() {
        let mut chunks = piece.chunks(PIECE).peekable();
        if chunks.peek().is_none() {
            out.push(1);
        }
        while let Some(chunk) = chunks.next() {
            // A chunk has at most 254 bytes, so this fits a byte.
            out.push(chunk.len() as u8 + 1);
            out.extend_from_slice(chunk);
            // A full piece stands for no zero, so a zero that follows it needs a length byte of its own.
            if chunk.len() == PIECE && chunks.peek().is_none() && pieces.peek().is_some() {
                out.push(1);
            }
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use incircle_protocol::decode_reverse_cobs;
    use proptest::prelude::*;

    /// Length byte of a full piece. Unlike other length bytes, it does not stand for a zero.
    const FULL_PIECE: u8 = 255;

    /// Decodes COBS as a device does.
    pub fn decode(bytes: &[u8]) -> Option<Vec<u8>> {
        let mut out = Vec::new();
        let mut rest = bytes;
        while let Some((&code, after)) = rest.split_first() {
            let length = usize::from(code).checked_sub(1)?;
            out.extend_from_slice(after.get(..length)?);
            rest = &after[length..];
            if code != FULL_PIECE && !rest.is_empty() {
                out.push(0);
            }
        }
        Some(out)
    }

    /// Encodes reverse COBS as a device does, byte by byte, as the page says.
    pub fn encode_reverse(bytes: &[u8], out: &mut Vec<u8>) {
        let mut since = 0;
        for &byte in bytes {
            if byte != 0 {
                out.push(byte);
                since += 1;
                if since == PIECE {
                    out.push(FULL_PIECE);
                    since = 0;
                }
            } else {
                out.push(since as u8 + 1);
                since = 0;
            }
        }
        out.push(since as u8 + 1);
    }

    #[test]
    fn examples() {
        let long: Vec<u8> = (1..=255).collect();
        let cases: [(&[u8], &[u8]); 5] =
            [(b"", &[1]), (&[0], &[1, 1]), (&[1, 2], &[3, 1, 2]), (&[1, 0, 2], &[2, 1, 2, 2]), (&[0, 0], &[1, 1, 1])];
        for (plain, coded) in cases {
            let mut out = Vec::new();
            encode(plain, &mut out);
            assert_eq!(out, coded);
        }
        for (length, first) in [(253, 254), (254, 255), (255, 255)] {
            let mut out = Vec::new();
            encode(&long[..length], &mut out);
            assert_eq!(out[0], first);
            assert_eq!(decode(&out).as_deref(), Some(&long[..length]));
        }
    }

    #[test]
    fn what_is_no_reverse_cobs_is_refused() {
        for mut bytes in
            [vec![], vec![0], vec![3], vec![1, 0, 1], vec![9, 9, 9], vec![1; 254].into_iter().chain([255]).collect()]
        {
            assert_eq!(decode_reverse_cobs(&mut bytes), None, "{bytes:?}");
        }
    }

    proptest! {
        #[test]
        fn both_ways_there_and_back(
            plain in proptest::collection::vec(prop_oneof![Just(0u8), 0u8..=255, Just(7u8)], 0..1200),
        ) {
            let mut out = Vec::new();
            encode(&plain, &mut out);
            prop_assert!(!out.contains(&0));
            prop_assert_eq!(decode(&out), Some(plain.clone()));
            let mut out = Vec::new();
            encode_reverse(&plain, &mut out);
            prop_assert!(!out.contains(&0));
            let start = decode_reverse_cobs(&mut out).expect("sound");
            prop_assert_eq!(&out[start..], &plain[..]);
        }
    }
}
