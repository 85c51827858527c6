//! Tests that damaged LAS, LAZ and COPC files lead to one clear sentence each, never to a panic, and that a claim of
//! the file alone takes no memory.

use incircle_cli::formats::{PointFormat, Selection};
use incircle_cli::{Failure, Input, PointTable};
use incircle_testkit::SplitMix64;

use super::lidar::{points, AXES};
use crate::common::lidar::{copc, word, write};
use crate::common::{refuse, Scratch};

fn read(bytes: &[u8]) -> Result<PointTable, Failure> {
    PointFormat::Las.read(Input::of_bytes(bytes), &Selection::default())
}

/// A file with other bytes at a place.
fn with(file: &[u8], place: usize, bytes: &[u8]) -> Vec<u8> {
    let mut file = file.to_vec();
    file[place..place + bytes.len()].copy_from_slice(bytes);
    file
}

/// One file of each kind, with its name.
fn samples() -> [(&'static str, Vec<u8>); 5] {
    let points = points(300, 5);
    [
        ("old.las", write(2, 1, false, AXES, &points)),
        ("new.las", write(4, 6, false, AXES, &points)),
        ("old.laz", write(2, 3, true, AXES, &points)),
        ("new.laz", write(4, 8, true, AXES, &points)),
        ("p.copc.laz", copc(&write(4, 6, false, AXES, &points), &[100, 200])),
    ]
}

#[test]
fn headers_that_lie_are_refused() {
    for (name, file) in samples() {
        let minor = file[25];
        refuse(name, b"", &["LASF"]);
        refuse(name, &file[..200], &["ends after 200 bytes"]);
        refuse(name, with(&file, 0, b"LASX"), &["LASF"]);
        refuse(name, with(&file, 25, &[5]), &["LAS 1.5"]);
        refuse(name, with(&file, 94, &100u16.to_le_bytes()), &["header", "100"]);
        refuse(name, with(&file, 96, &9u32.to_le_bytes()), &["begin at byte 9"]);
        refuse(name, with(&file, 96, &u32::MAX.to_le_bytes()), &["begin at byte 4294967295"]);
        refuse(name, with(&file, 100, &u32::MAX.to_le_bytes()), &["record", "of 4294967295"]);
        refuse(name, with(&file, 104, &[11]), &["point format is 11"]);
        refuse(name, with(&file, 104, &[0x40]), &["point format is 64"]);
        refuse(name, with(&file, 105, &19u16.to_le_bytes()), &["19"]);
        for (scale, shown) in [(0.0, "0e0"), (-0.5, "-5e-1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
            refuse(name, with(&file, 139, &f64::to_le_bytes(scale)), &["scale of y", shown]);
        }
        refuse(name, with(&file, 171, &f64::NAN.to_le_bytes()), &["offset of z"]);
        if minor == 4 {
            refuse(name, with(&file, 247, &7u64.to_le_bytes()), &["promises 7", "300"]);
            let file = with(&file, 243, &2u32.to_le_bytes());
            refuse(name, &file, &["extended record"]);
            refuse(name, with(&file, 235, &u64::MAX.to_le_bytes()), &["18446744073709551615"]);
        }
    }
}

/// The file with another number of points in its header.
fn with_count(file: &[u8], count: u64) -> Vec<u8> {
    let short = u32::try_from(count).unwrap_or(0);
    let file = with(file, 107, &short.to_le_bytes());
    if file[25] == 4 {
        with(&file, 247, &count.to_le_bytes())
    } else {
        file
    }
}

#[test]
fn wrong_counts_are_refused() {
    for (name, file) in samples() {
        let most = if file[25] == 4 { u64::MAX } else { u64::from(u32::MAX) };
        for count in [0, 1, 299, 301, 1 << 20, most] {
            refuse(name, with_count(&file, count), &["points"]);
        }
        // A file that ends before its points is refused, however many its header promises.
        let empty = &file[..word(&file, 96)];
        refuse(name, with_count(empty, most), &[]);
    }
    // Bytes behind the points are refused unless the header names their place.
    let (_, file) = &samples()[1];
    let longer = [&file[..], &[0; 92]].concat();
    refuse("new.las", &longer, &["92 bytes after"]);
    let named = with(&with(&longer, 235, &(file.len() as u64).to_le_bytes()), 243, &1u32.to_le_bytes());
    assert_eq!(read(&named).map(|table| table.len()), Ok(300));
    let (named, short) = (with_count(&named, 299), "more than the 299 points");
    refuse("new.las", named, &[short]);
}

/// A cut file is read from the disk, where a place beyond all files is an error of the system, unlike in memory.
#[test]
fn cut_files_are_refused_with_a_sentence_of_the_format() {
    let scratch = Scratch::new();
    for (name, file) in samples() {
        for len in (0..file.len()).step_by(37).chain([file.len() - 1]) {
            let path = scratch.write(name, &file[..len]);
            let input = Input::open(&path, true).expect("the file is there");
            let failure = PointFormat::Las.read(input, &Selection::default()).expect_err(name);
            assert!(failure.message.len() < 400 && !failure.message.contains("os error"), "{len} bytes: {failure}");
        }
    }
}

/// Makes one to four random edits, most of them in the header, the records and the tables.
fn spoil(sample: &[u8], random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = sample.to_vec();
    for _ in 0..=random.below(4) {
        let len = bytes.len() as u64;
        let place = match random.below(3) {
            0 => random.below(len),
            1 => 94 + random.below(700),
            _ => len - 1 - random.below(len.min(200)),
        };
        let place = place.min(len - 1) as usize;
        match random.below(8) {
            0 => bytes.truncate(place.max(1)),
            1 => bytes[place] ^= 1 << random.below(8),
            2 => bytes[place] = 0,
            3 => bytes[place] = 0xff,
            _ => bytes[place] = random.below(256) as u8,
        }
    }
    bytes
}

#[test]
fn spoilt_files_never_panic() {
    let mut random = SplitMix64::new(6);
    let rounds = 1500;
    for (name, sample) in samples() {
        let mut refused = 0;
        for _ in 0..rounds {
            match read(&spoil(&sample, &mut random)) {
                Ok(table) => {
                    assert!(table.len() <= 300, "{name}: {} points", table.len());
                    assert!(table.doubles().iter().flatten().all(|value| value.is_finite()));
                }
                Err(failure) => {
                    refused += 1;
                    let sentence = failure.to_string();
                    assert!(!sentence.contains('\n') && sentence.len() < 400, "{sentence}");
                }
            }
        }
        assert!(refused > rounds / 5, "{name}: only {refused} were refused");
    }
}

#[test]
fn few_bytes_do_not_promise_many_points() {
    let (name, file) = &samples()[3];
    let start = word(file, 96);
    // The size of a chunk stands in the record about the packing, the count of the points in the only chunk itself.
    let size = (227..start).find(|&place| word(file, place) == 50_000).expect("the usual size of a chunk");
    let count = (start + 8..file.len() - 4).find(|&place| word(file, place) == 300).expect("the count");
    let many = u32::MAX - 1;
    let file = with(&with(file, size, &many.to_le_bytes()), count, &many.to_le_bytes());
    refuse(name, with_count(&file, many.into()), &["chunk 1 of", "too few for 4294967294 points"]);
    // A file of one place is packed as tightly as can be.
    let stored = vec![([7, 7, 7], 2); 400_000];
    let packed = write(4, 6, true, AXES, &stored);
    assert!(packed.len() < 60_000, "{} bytes", packed.len());
    assert_eq!(read(&packed).map(|table| table.len()), Ok(400_000));
}

#[test]
fn damage_is_reported_with_its_chunk() {
    let scratch = Scratch::new();
    let [.., (name, file)] = samples();
    // The second chunk has its count behind its first point. The edit makes the count wrong.
    let start = word(&file, 96) + 8;
    let second = (start..file.len() - 4).find(|&place| word(&file, place) == 200).expect("the count");
    scratch.write(name, with(&file, second, &199u32.to_le_bytes()));
    scratch.run(&format!("triangulate {name} -o m.ele")).fails(3, &[name, "chunk 2 of", "199 points", "200"]);
    assert_eq!(scratch.files(), [name]);
}
