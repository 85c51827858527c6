//! Checks that the folders of the boards agree with what the command says of them, and the tables
//! in the documents with the reports.

use incircle_hdl::board::{held_text, pages, Board, Report, Summary, BOARDS};
use incircle_protocol::Config;
use std::collections::BTreeSet;

fn file(board: &Board, name: &str) -> String {
    held_text(&board.folder().join(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// The pins that `pins.lpf` names after a keyword, as in `LOCATE COMP "led[0]" SITE "B2";`.
fn constrained(lpf: &str, keyword: &str) -> BTreeSet<String> {
    let lines = lpf.lines().filter_map(|line| line.strip_prefix(keyword)?.split('"').nth(1));
    lines.map(str::to_string).collect()
}

/// The pins of the one module in `top.v`, bit by bit.
fn pins(top: &str) -> BTreeSet<String> {
    let ports = top.lines().filter_map(|line| {
        let line = line.trim().trim_end_matches(',');
        line.strip_prefix("input wire ").or_else(|| line.strip_prefix("output wire "))
    });
    let mut pins = BTreeSet::new();
    for port in ports {
        match port.strip_prefix('[').and_then(|range| range.split_once(":0] ")) {
            None => _ = pins.insert(port.to_string()),
            Some((high, name)) => {
                let high: usize = high.parse().unwrap();
                pins.extend((0..=high).map(|bit| format!("{name}[{bit}]")));
            }
        }
    }
    pins
}

/// Every board with the suffix of each of its links.
fn links() -> impl Iterator<Item = (Board, &'static str)> {
    let serial = BOARDS.into_iter().map(|board| (board, ""));
    serial.chain(BOARDS.into_iter().filter(|board| board.ethernet.is_some()).map(|board| (board, "-udp")))
}

#[test]
fn every_pin_has_a_site_and_a_kind() {
    for (board, link) in links() {
        let (top, lpf) = (file(&board, &format!("top{link}.v")), file(&board, &format!("pins{link}.lpf")));
        let pins = pins(&top);
        assert!(pins.len() >= 6, "{}: {pins:?}", board.name);
        assert_eq!(constrained(&lpf, "LOCATE COMP"), pins, "{}", board.name);
        assert_eq!(constrained(&lpf, "IOBUF PORT"), pins, "{}", board.name);
        let module = format!("module {}{} (", board.top, link.replace('-', "_"));
        assert!(top.contains(&module), "{}: no {module}", board.name);
        let sites: Vec<_> = lpf.lines().filter_map(|line| line.strip_prefix("LOCATE")?.split('"').nth(3)).collect();
        assert_eq!(sites.iter().collect::<BTreeSet<_>>().len(), pins.len(), "{}: one site for two pins", board.name);
        let readme = file(&board, "README.md");
        for (pin, site) in lpf.lines().filter_map(|line| {
            let mut quoted = line.strip_prefix("LOCATE")?.split('"');
            Some((quoted.nth(1)?, quoted.nth(1)?))
        }) {
            assert!(readme.contains(&format!("| `{pin}` | {site} |")), "{}: README on {pin}, {site}", board.name);
        }
    }
}

#[test]
fn the_oscillator_is_constrained_as_the_pll_is_computed() {
    for (board, link) in links() {
        let lpf = file(&board, &format!("pins{link}.lpf"));
        let oscillator = format!("{:.1} MHZ;", f64::from(board.oscillator_hz) / 1e6);
        let phy = "FREQUENCY PORT \"rgmii_rx_clock\" 125.0 MHZ;";
        let lines: Vec<_> = lpf.lines().filter(|line| line.starts_with("FREQUENCY PORT")).collect();
        assert!(lines[0].ends_with(&oscillator), "{}: {lines:?}", board.name);
        let rest: &[&str] = if link.is_empty() { &[] } else { &[phy] };
        assert_eq!(&lines[1..], rest, "{}", board.name);
    }
    for board in BOARDS {
        let clocks = board.clocks(board.most_mhz);
        assert!(clocks.len() > 10 && clocks.is_sorted_by(|a, b| a > b), "{}: {clocks:?}", board.name);
        assert!(clocks.contains(&125), "{}: {clocks:?}", board.name);
        for core in board.cores {
            assert_eq!(board.clocks(core.usual_mhz).first(), Some(&core.usual_mhz), "{}", board.name);
        }
        if let Some(usual_mhz) = board.ethernet.map(|port| port.usual_mhz) {
            assert_eq!(board.clocks(usual_mhz).first(), Some(&usual_mhz), "{}", board.name);
        }
    }
}

#[test]
fn tables_are_what_the_reports_say() {
    for (path, expected) in pages().unwrap() {
        let held = held_text(&path).unwrap();
        assert!(held == expected, "{}: run `cargo run --release -p incircle-hdl -- board --table`", path.display());
    }
}

#[test]
fn reports_are_whole() {
    for (board, core) in BOARDS.into_iter().flat_map(|board| board.cores.iter().map(move |&core| (board, core))) {
        report_is_whole(board, core.config, "", core.usual_mhz);
        if let Some(usual_mhz) = board.ethernet.map(|port| port.usual_mhz) {
            report_is_whole(board, core.config, "-udp", usual_mhz);
        }
    }
}

/// Fails if there is a report on this core behind the link of this suffix, and it lacks something, or is of another
/// clock than the usual one.
fn report_is_whole(board: Board, config: Config, suffix: &str, usual_mhz: u32) {
    let path = board.report(config, suffix).expect("a core of the board");
    if !path.exists() {
        return;
    }
    let report = Report::read(&path).unwrap();
    assert_eq!((report.board.as_str(), report.device.as_str()), (board.name, board.device));
    assert!(report.seeds.len() >= 3, "{}: {} seeds", path.display(), report.seeds.len());
    assert_eq!(report.fmax_mhz, Summary::of(&report.seeds));
    assert_eq!(report.met, report.fmax_mhz.median >= f64::from(report.clock_mhz));
    assert_eq!(report.met, report.bitstream.is_some() && report.picked_seed.is_some());
    assert_eq!(
        (report.met, report.clock_mhz),
        (true, usual_mhz),
        "{}: the clock of the table is the usual one",
        path.display()
    );
    let Config { name, points, contexts, engines, .. } = config;
    assert_eq!(report.configuration, name);
    assert_eq!((report.points, report.contexts, report.engines), (points, contexts, engines), "{}", path.display());
}
