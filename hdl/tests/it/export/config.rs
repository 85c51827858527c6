//! Parameters that no core can be built with are refused with a sentence.

use incircle_hdl::export;
use incircle_protocol::{Config, SMALL};

#[test]
fn bad_parameters_are_refused_with_their_numbers() {
    for (config, sentence) in [
        (Config { points: 1000, ..SMALL }, "a power of two of points, 4 to 16384, not 1000"),
        (Config { points: 2, ..SMALL }, "4 to 16384, not 2"),
        (Config { points: 32768, ..SMALL }, "4 to 16384, not 32768"),
        (Config { ring: 2, ..SMALL }, "3 to 64 edges, not 2"),
        (Config { ring: 65, ..SMALL }, "3 to 64 edges, not 65"),
        (Config { contexts: 0, ..SMALL }, "1 to 24 contexts, not 0"),
        (Config { contexts: 25, ..SMALL }, "1 to 24 contexts, not 25"),
    ] {
        let error = export::core(config, false).unwrap_err().to_string();
        assert!(error.contains(sentence), "{error}");
    }
}

#[test]
fn extreme_parameters_export() {
    for (points, ring) in [(4, 3), (4, 64), (16384, 3), (16384, 64)] {
        for contexts in [1, 24] {
            assert!(export::core(Config { points, ring, contexts, ..SMALL }, true).is_ok());
        }
    }
}
