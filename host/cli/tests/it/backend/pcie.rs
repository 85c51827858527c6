//! Tests of PCIe back ends without a card: a wrong address, or files that are no card, are named in a sentence. Other
//! tests run jobs with the simulated card.

use crate::common::Scratch;

#[test]
fn addresses_are_checked_before_anything_is_opened() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    for (backend, parts) in [
        ("pcie:", ["no card is named", "pcie:0"]),
        ("pcie:300", ["from 0 to 255", "numbers"]),
        ("pcie", ["'pcie:N'", "pcie:0"]),
    ] {
        let run = scratch.run(&format!("triangulate p.csv -o m.ele --backend {backend}"));
        assert_eq!(run.code, Some(2), "{run:?}");
        assert!(parts.iter().all(|part| run.stderr.contains(part)), "{run:?}");
    }
    scratch.run("triangulate p.csv -o m.ele --backend pcie:7 --config tiny").fails(2, &["--config"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn cards_that_cannot_be_had_end_with_exit_code_4() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    let missing = ["pcie:/nowhere cannot be opened", "there is no /nowhere/xdma0_user"];
    scratch.run("triangulate p.csv -o m.ele --backend pcie:/nowhere").fails(4, &missing);
    scratch.run("bench --backend pcie:/nowhere").fails(4, &missing);
    scratch.run("info --backend pcie:/nowhere").fails(4, &missing);
    // A card that is named by its directory needs no driver, so the advice must not name one.
    let refusal = scratch.run("info --backend pcie:/nowhere");
    assert!(refusal.stderr.contains("serve-pcie") && !refusal.stderr.contains("modprobe"), "{refusal:?}");
    // These files are no card, because they are too short or have other registers.
    for name in ["xdma0_h2c_0", "xdma0_c2h_0", "xdma0_user"] {
        scratch.write(name, "");
    }
    scratch
        .run("info --backend pcie:.")
        .fails(5, &["the reading of a register failed", "the file ends before this register"]);
    scratch.write("xdma0_user", "none".repeat(64));
    scratch.run("info --backend pcie:.").fails(4, &["begin with 0x656e6f6e", "choose another card"]);
}
