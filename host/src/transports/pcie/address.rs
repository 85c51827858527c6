//! Addresses of cards: `pcie:N` for the card of this number, `pcie:DIR` for card 0 in a directory.

use std::fmt;
use std::path::{Path, PathBuf};

/// Beginning of every address of a card.
const PREFIX: &str = "pcie:";
/// Directory in which the driver puts its files.
const DEVICES: &str = "/dev";
/// Most cards of the driver.
const MAX_CARDS: u32 = 256;
/// Text before and after the number in the name of the file with the registers.
const USER_FILE: (&str, &str) = ("xdma", "_user");

/// The address of a card: a directory with three files, and the number in their names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CardAddress {
    /// Directory of the three files.
    pub directory: PathBuf,
    /// Number in the names of the files.
    pub number: u32,
}

impl CardAddress {
    /// The card of this number among the devices of the system.
    pub fn of_number(number: u32) -> Self {
        Self { directory: DEVICES.into(), number }
    }

    /// Card 0 in a directory of its own, as a simulated one.
    pub fn in_directory(directory: impl Into<PathBuf>) -> Self {
        Self { directory: directory.into(), number: 0 }
    }

    /// Parses an address; `None` if it is the address of another kind of device.
    ///
    /// # Errors
    /// A sentence that does not repeat the address.
    pub fn parse(address: &str) -> Option<Result<Self, String>> {
        address.strip_prefix(PREFIX).map(Self::parse_card)
    }

    /// Parses the text behind `pcie:`.
    fn parse_card(text: &str) -> Result<Self, String> {
        if text.is_empty() {
            return Err("no card is named: write \"pcie:0\" or \"pcie:/some/directory\"".to_owned());
        }
        if text.bytes().all(|byte| byte.is_ascii_digit()) {
            let number = text.parse::<u32>().ok().filter(|&number| number < MAX_CARDS);
            let number = number.ok_or_else(|| format!("cards have numbers from 0 to {}", MAX_CARDS - 1))?;
            return Ok(Self::of_number(number));
        }
        Ok(Self::in_directory(text))
    }

    /// Whether this is a card of the driver. Other cards have a directory of their own.
    pub(crate) fn is_of_the_system(&self) -> bool {
        self.directory == Path::new(DEVICES)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.directory.join(format!("xdma{}_{name}", self.number))
    }

    /// The file that takes commands.
    pub fn commands(&self) -> PathBuf {
        self.file("h2c_0")
    }

    /// The file that gives answers.
    pub fn answers(&self) -> PathBuf {
        self.file("c2h_0")
    }

    /// The file with the registers.
    pub fn registers(&self) -> PathBuf {
        self.file("user")
    }
}

impl fmt::Display for CardAddress {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_of_the_system() {
            write!(f, "{PREFIX}{}", self.number)
        } else {
            write!(f, "{PREFIX}{}", self.directory.display())
        }
    }
}

/// A card that the system knows of, as [`cards`] lists them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CardInfo {
    /// Address of the card. Its text is what [`Device::open`](crate::Device::open) takes.
    pub address: CardAddress,
    /// Ids of the card on the bus, such as `PCI 10ee:7024`, or `XDMA` if the system does not tell them.
    pub what: String,
}

/// Lists the cards that the driver XDMA has found, by number. Only its registers say whether a card
/// is an incircle card.
pub fn cards() -> Vec<CardInfo> {
    cards_in(Path::new(DEVICES))
}

fn cards_in(directory: &Path) -> Vec<CardInfo> {
    let entries = std::fs::read_dir(directory).into_iter().flatten().flatten();
    let mut numbers: Vec<u32> = entries.filter_map(|entry| number_of(entry.file_name().to_str()?)).collect();
    numbers.sort_unstable();
    let info = |number| CardInfo {
        address: CardAddress { directory: directory.to_owned(), number },
        what: describe(number).unwrap_or_else(|| "XDMA".to_owned()),
    };
    numbers.into_iter().map(info).collect()
}

/// The number of a card from the name of its file with the registers.
fn number_of(name: &str) -> Option<u32> {
    let number = name.strip_prefix(USER_FILE.0)?.strip_suffix(USER_FILE.1)?;
    number.parse().ok().filter(|&number| number < MAX_CARDS)
}

/// The ids of a card on the bus.
fn describe(number: u32) -> Option<String> {
    let folder = format!("/sys/class/xdma/xdma{number}_user/device");
    let id = |name: &str| {
        let text = std::fs::read_to_string(Path::new(&folder).join(name)).ok()?;
        Some(text.trim().trim_start_matches("0x").to_owned())
    };
    Some(format!("PCI {}:{}", id("vendor")?, id("device")?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_parsed() {
        assert_eq!(CardAddress::parse("serial:/dev/x"), None);
        let card = CardAddress::parse("pcie:3").unwrap().unwrap();
        assert_eq!((card.commands(), card.answers()), ("/dev/xdma3_h2c_0".into(), "/dev/xdma3_c2h_0".into()));
        assert_eq!((card.registers(), card.to_string()), ("/dev/xdma3_user".into(), "pcie:3".to_owned()));
        assert!(card.is_of_the_system());
        for directory in ["/tmp/card", "card", "./0"] {
            let card = CardAddress::parse(&format!("pcie:{directory}")).unwrap().unwrap();
            assert_eq!(card.registers(), Path::new(directory).join("xdma0_user"));
            assert!(!card.is_of_the_system());
            assert_eq!(card.to_string(), format!("pcie:{directory}"));
        }
        for bad in ["pcie:", "pcie:256", "pcie:99999999999"] {
            assert!(!CardAddress::parse(bad).unwrap().unwrap_err().is_empty());
        }
    }

    #[test]
    fn cards_are_found_by_their_registers() {
        let folder = std::env::temp_dir().join(format!("incircle-cards-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        for name in ["xdma1_user", "xdma0_user", "xdma0_h2c_0", "xdma_user", "xdma999_user", "tty"] {
            std::fs::write(folder.join(name), "").unwrap();
        }
        let found: Vec<_> = cards_in(&folder).into_iter().map(|card| card.address.number).collect();
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(found, [0, 1]);
        assert_eq!(cards_in(&folder), []);
    }
}
