//! The exchange that the page of the serial link shows, as bytes.

/// Bytes of a line of the page, without its direction and its comment.
fn bytes(line: &str) -> Vec<u8> {
    let said = line[1..].split(';').next().expect("a first part");
    said.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).expect(line)).collect()
}

/// Steps of the exchange that `protocol/SERIAL.md` shows: bytes to the device, then those that come back.
///
/// # Panics
/// Panics if the page shows no exchange, or one in another form.
pub fn exchange_steps(page: &str) -> Vec<(Vec<u8>, Vec<u8>)> {
    let (_, block) = page.split_once("```line\n").expect("an exchange");
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
