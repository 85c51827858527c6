extern crate std;

use super::*;
use std::vec;
use std::vec::Vec;

const NARROW: Layout = Layout { point_words: 1, record_words: 3 };
const WIDE: Layout = Layout { point_words: 2, record_words: 6 };
const RANGE: RecordRange = RecordRange { first: 7, count: 11 };

fn commands(layout: Layout) -> [Command<Vec<u32>>; 12] {
    [
        Command::Hello,
        Command::Clear(Clear::one_mesh(3)),
        Command::Clear(Clear::batch(255)),
        Command::Clear(Clear { contexts: 16, meshes: Meshes::SideBySide(4), tag: 0xa5 }),
        Command::insert(vec![0x0400_0000, 0, 5, 6], layout),
        Command::insert(vec![], layout),
        Command::Read(RANGE),
        Command::Counters,
        Command::Latencies,
        Command::Triangles(RANGE),
        Command::run(RunKind::Delete, vec![9, 8], layout),
        Command::run(RunKind::Interpolate, vec![1, 2], layout),
    ]
}

fn words(command: &Command<Vec<u32>>) -> Vec<u32> {
    let mut words = Vec::new();
    command.encode(&mut words);
    words
}

#[test]
fn what_is_written_is_read() {
    for layout in [NARROW, WIDE] {
        for command in commands(layout) {
            let (words, points) = (words(&command), command.points().len());
            assert_eq!((words.len(), points as u64), (command.words(), command.point_words(layout)));
            let mut reader = CommandReader::default();
            let heads = [PADDING].iter().chain(&words[..words.len() - points]);
            let read: Vec<_> = heads.filter_map(|&word| reader.take(word)).collect();
            assert_eq!(read, [Ok(command.bare())]);
            assert_eq!(command.borrowed().map(<[u32]>::to_vec), command);
        }
    }
}

#[test]
fn every_command_has_the_words_of_the_page() {
    let page: [&[u32]; 12] = [
        &[0x0100_0000],
        &[0x0200_0003],
        &[0x0200_01ff],
        &[0x02a5_0910],
        &[0x0300_0000, 4, 0x0400_0000, 0, 5, 6],
        &[0x0300_0000, 0],
        &[0x0400_0000, 7, 11],
        &[0x0500_0000],
        &[0x0600_0000],
        &[0x0700_0000, 7, 11],
        &[0x0c00_0000, 2, 9, 8],
        &[0x0900_0000, 2, 1, 2],
    ];
    assert_eq!(commands(NARROW).map(|command| words(&command)), page);
    assert_eq!(words(&commands(WIDE)[4])[..2], [0x0300_0000, 2]);
}

#[test]
fn every_answer_has_its_length() {
    let lengths = |layout| commands(layout).map(|command| command.payload_words(layout));
    assert_eq!(lengths(NARROW), [7, 0, 0, 0, 5, 5, 33, 25, 128, 17, 4, 20]);
    assert_eq!(lengths(WIDE), [7, 0, 0, 0, 5, 5, 66, 25, 128, 33, 4, 10]);
    let all = RecordRange { first: 0, count: u32::MAX };
    let commands = [Command::<()>::Read(all), Command::Triangles(all)];
    assert_eq!(commands.map(|command| command.payload_words(WIDE)), [6, 3].map(|ids| ids * u64::from(u32::MAX)));
    assert_eq!(answer_head(Opcode::Read, 9), [0x0400_0000, 9]);
}

#[test]
fn a_header_names_its_engine_and_its_job() {
    let header = signed_header(answer_header(3, Status::Stuck), 2, 0xc1);
    assert_eq!(header, 0x0306_02c1);
    assert_eq!((answer_opcode(header), answer_status(header)), (3, 6));
    assert_eq!((answer_engine(header), answer_tag(header)), (2, 0xc1));
    assert_eq!(signed_header(header, 0, 0), answer_header(3, Status::Stuck));
}

#[test]
fn numbers_that_the_word_cannot_name_become_the_largest() {
    let clear = Clear { contexts: 1000, meshes: Meshes::SideBySide(1000), tag: 0 };
    let named = Clear { contexts: 255, meshes: Meshes::SideBySide(MAX_SIDE_BY_SIDE), tag: 0 };
    assert_eq!(Clear::from_word(clear.word()), named);
    // Outside a batch, nothing is said of the meshes.
    assert_eq!(Clear::from_word(0x0200_fe03), Clear::one_mesh(3));
}

#[test]
fn an_unknown_opcode_has_no_arguments() {
    let mut reader = CommandReader::default();
    assert_eq!(reader.take(0x2a00_0000), Some(Err(42)));
    assert_eq!(reader.take(1), Some(Err(0)));
    assert_eq!(reader.take(0x0100_0000), Some(Ok(Command::Hello)));
}
