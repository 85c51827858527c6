//! The head of a file: what the file is, which run it belongs to, how much it holds, and two check sums.

use crate::failure::Failure;

/// The number of bytes of a head.
pub const HEAD_BYTES: usize = 76;
/// The version of the files. Another version is refused.
pub const VERSION: u32 = 2;

const MAGIC: [u8; 8] = *b"ICTILES\n";
/// The bytes before the check sum of the head.
const CHECKED: usize = HEAD_BYTES - 4;

/// The content of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Kind {
    /// The manifest of a run.
    Manifest = 1,
    /// The points of a tile.
    Points = 2,
    /// The triangulation of a tile.
    Local = 3,
}

impl Kind {
    /// The name for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Manifest => "a manifest of tiles",
            Self::Points => "the list of the points of a tile",
            Self::Local => "the triangulation of a tile",
        }
    }
}

/// The head of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Head {
    /// The content of the file.
    pub kind: Kind,
    /// The run: a number made of the points and the cuts. Files of different runs do not fit together.
    pub run: u64,
    /// The number of the tile; 0 in a manifest.
    pub tile: u32,
    /// The lengths of the lists in the file. What they count depends on the kind.
    pub counts: [u64; 5],
    /// The check sum (CRC-32) of the bytes behind the head; of a triangulation, of those up to its final triangles.
    pub check: u32,
}

impl Head {
    /// The bytes of the head, little endian.
    pub fn to_bytes(self) -> [u8; HEAD_BYTES] {
        let mut bytes = Vec::with_capacity(HEAD_BYTES);
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((self.kind as u32).to_le_bytes());
        bytes.extend(self.run.to_le_bytes());
        bytes.extend(self.tile.to_le_bytes());
        bytes.extend(self.check.to_le_bytes());
        bytes.extend(self.counts.map(u64::to_le_bytes).as_flattened());
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        let mut head = [0; HEAD_BYTES];
        head.copy_from_slice(&bytes);
        head
    }

    /// Reads a head. A damaged one, one of another version, and one of another kind of file are refused.
    pub fn of_bytes(bytes: &[u8; HEAD_BYTES], kind: Kind) -> Result<Self, Failure> {
        if bytes[..8] != MAGIC {
            return Err(Failure::input(format!(
                "the first bytes are not those of a file of tiles, and {} is needed here: {REMEDY}",
                kind.name()
            )));
        }
        let version = number(bytes, 8);
        if version != VERSION {
            return Err(Failure::input(format!(
                "the file has version {version}, and this program takes version {VERSION}: do all steps with one \
                 version of incircle"
            )));
        }
        if number(bytes, CHECKED) != crc32fast::hash(&bytes[..CHECKED]) {
            return Err(damaged("the check sum of its head is wrong"));
        }
        if number(bytes, 12) != kind as u32 {
            return Err(Failure::input(format!("the file is not {}: {REMEDY}", kind.name())));
        }
        let wide = |at: usize| u64::from(number(bytes, at)) | u64::from(number(bytes, at + 4)) << 32;
        let counts = [32, 40, 48, 56, 64].map(wide);
        Ok(Self { kind, run: wide(16), tile: number(bytes, 24), counts, check: number(bytes, 28) })
    }
}

/// The end of a message about a file that cannot be used.
const REMEDY: &str = "remove the file and do its step again, or remove the folder and begin again";

/// The failure of a damaged file.
pub fn damaged(why: &str) -> Failure {
    Failure::input(format!("the file is damaged or cut off, as {why}: {REMEDY}"))
}

/// The number of 32 bits at a place of a head; 0 beyond its end.
fn number(bytes: &[u8; HEAD_BYTES], at: usize) -> u32 {
    bytes.get(at..).and_then(<[u8]>::first_chunk).map_or(0, |word| u32::from_le_bytes(*word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_read_back_and_every_wrong_bit_is_found() {
        let head = Head { kind: Kind::Local, run: u64::MAX - 1, tile: 7, counts: [1, 2, 3, 4, u64::MAX], check: 99 };
        let bytes = head.to_bytes();
        assert_eq!(Head::of_bytes(&bytes, Kind::Local), Ok(head));
        assert!(Head::of_bytes(&bytes, Kind::Points).is_err());
        for bit in 0..HEAD_BYTES * 8 {
            let mut wrong = bytes;
            wrong[bit / 8] ^= 1 << (bit % 8);
            assert!(Head::of_bytes(&wrong, Kind::Local).is_err(), "bit {bit}");
        }
    }
}
