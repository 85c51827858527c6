//! Reverse COBS, in which frames come to the host, decoded without memory of its own. `protocol/SERIAL.md` describes
//! it.

/// Length byte of a full piece of 254 bytes. Unlike other length bytes, it does not stand for a zero.
const FULL_PIECE: u8 = 255;

/// Decodes reverse COBS in place, towards the end of `bytes`, and returns the place where the decoded bytes begin.
/// `None` if a length byte is impossible; `bytes` may then hold anything. O(n).
///
/// ```
/// let mut frame = [1, 2, 2, 2]; // the byte 1, the length byte of its zero, the byte 2, the last length byte
/// let start = incircle_protocol::decode_reverse_cobs(&mut frame).unwrap();
/// assert_eq!(frame[start..], [1, 0, 2]);
/// ```
pub fn decode_reverse_cobs(bytes: &mut [u8]) -> Option<usize> {
    let mut read = bytes.len();
    let mut write = bytes.len();
    // The last length byte stands for no zero, since the frame ends there, and its piece is never full.
    let mut is_last = true;
    while read > 0 {
        let code = bytes[read - 1];
        let length = usize::from(code).checked_sub(1)?;
        let start = (read - 1).checked_sub(length)?;
        if is_last && code == FULL_PIECE {
            return None;
        }
        if !is_last && code != FULL_PIECE {
            write -= 1;
            bytes[write] = 0;
        }
        bytes.copy_within(start..read - 1, write - length);
        write -= length;
        read = start;
        is_last = false;
    }
    (!is_last).then_some(write)
}
