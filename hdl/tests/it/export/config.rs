//! Parameters that no core can be built with are refused with a sentence.

use incircle_hdl::export::{self, ExportError};
use incircle_protocol::{Config, ConfigError, SMALL};

#[test]
fn bad_parameters_are_refused_with_their_numbers() {
    for (config, sentence) in [
        (Config { points: 1000, ..SMALL }, "cannot hold 1000 points: choose a power of two from 4 to 16384"),
        (Config { points: 2, ..SMALL }, "cannot hold 2 points: choose a power of two from 4 to 16384"),
        (Config { points: 32768, ..SMALL }, "cannot hold 32768 points: choose a power of two from 4 to 16384"),
        (Config { ring: 2, ..SMALL }, "cannot hold 2 edges: choose a number from 3 to 64"),
        (Config { ring: 65, ..SMALL }, "cannot hold 65 edges: choose a number from 3 to 64"),
        (Config { contexts: 0, ..SMALL }, "cannot have 0 contexts: choose a number from 1 to 24"),
        (Config { contexts: 25, ..SMALL }, "cannot have 25 contexts: choose a number from 1 to 24"),
        (Config { engines: 3, ..SMALL }, "cannot have 3 engines: choose 1, 2 or 4"),
    ] {
        let error = export::core(config, false).unwrap_err().to_string();
        assert!(error.contains(sentence), "{error}");
    }
}

#[test]
fn a_core_with_runs_has_one_engine() {
    let refused = |engines| export::core_with_runs(Config { engines, ..SMALL }, false).unwrap_err();
    for engines in [2, 4] {
        let error = refused(engines);
        assert!(matches!(error, ExportError::Config(ConfigError::EnginesForQuestions(given)) if given == engines));
        let sentence =
            format!("a core that answers questions cannot have {engines} engines: choose a configuration of one");
        assert_eq!(error.to_string(), sentence);
    }
    assert!(matches!(refused(3), ExportError::Config(ConfigError::Engines(3))));
}

#[test]
fn a_core_with_deletions_has_a_short_boundary_list() {
    for ring in [2, 33, 65] {
        let error = export::core_with_runs(Config { ring, ..SMALL }, false).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("a core with deletions cannot have a boundary list of {ring} edges: choose a number from 3 to 32")
        );
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
