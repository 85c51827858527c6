//! The exchange in `protocol/SERIAL.md`, as bytes.

/// The page.
pub const PAGE: &str = include_str!("../../../../../protocol/SERIAL.md");

/// The bytes of a line without its direction and its comment.
fn bytes(line: &str) -> Vec<u8> {
    let said = line[1..].split(';').next().expect("a first part");
    said.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).expect(line)).collect()
}

/// Bytes to the device, then those that come back.
pub fn steps() -> Vec<(Vec<u8>, Vec<u8>)> {
    let (_, block) = PAGE.split_once("```line\n").expect("an exchange");
    let block = block.split("```").next().expect("its body");
    let mut steps: Vec<(Vec<u8>, Vec<u8>)> = Vec::new();
    for line in block.lines().filter(|line| !line.trim().is_empty()) {
        match (line.as_bytes()[0], steps.last_mut()) {
            (b'<', Some((_, answer))) => answer.extend(bytes(line)),
            (b'>', Some((sent, answer))) if answer.is_empty() => sent.extend(bytes(line)),
            (b'>', _) => steps.push((bytes(line), Vec::new())),
            _ => panic!("neither > nor <: {line}"),
        }
    }
    assert!(steps.len() >= 8, "only {} steps", steps.len());
    steps
}
