//! The exchanges that the pages of the serial and the UDP link show, as bytes.

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

/// A datagram that the page of the UDP link shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Datagram {
    /// Letter of the host that sends or receives it.
    pub host: char,
    /// Whether it goes to the device.
    pub goes_to_device: bool,
    /// The payload of UDP: header, words and check sum.
    pub bytes: Vec<u8>,
}

/// The datagrams of the exchange that `protocol/UDP.md` shows, in order. A line such as `A>` or `A<` begins one, and
/// lines that begin with spaces go on with it.
///
/// # Panics
/// Panics if the page shows no exchange, or one in another form.
pub fn exchange_datagrams(page: &str) -> Vec<Datagram> {
    let (_, block) = page.split_once("```datagrams\n").expect("an exchange");
    let block = block.split("```").next().expect("its body");
    let mut datagrams: Vec<Datagram> = Vec::new();
    for line in block.lines().filter(|line| !line.trim().is_empty()) {
        if let Some(rest) = line.strip_prefix("  ") {
            datagrams.last_mut().expect("a datagram before").bytes.extend(bytes(&format!(">{rest}")));
            continue;
        }
        let (host, rest) = line.split_at(1);
        assert!(rest.starts_with(['<', '>']), "neither > nor <: {line}");
        datagrams.push(Datagram {
            host: host.chars().next().expect("a letter"),
            goes_to_device: rest.starts_with('>'),
            bytes: bytes(rest),
        });
    }
    assert!(datagrams.len() >= 16, "only {} datagrams", datagrams.len());
    datagrams
}
