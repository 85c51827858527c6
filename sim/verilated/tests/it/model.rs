//! The binding on two small models: every kind of port, time, waveforms, seeds, and mistakes of callers.

use std::path::PathBuf;

use verilated::{Direction, Model, TraceError};

mod models {
    verilated::include_models!();
}

fn set(model: &mut Model, port: &str, value: u64) {
    let port = model.port(port).unwrap();
    model.set(port, value);
}

fn get(model: &Model, port: &str) -> u64 {
    model.get(model.port(port).unwrap())
}

fn fresh_file(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    if path.exists() {
        std::fs::remove_file(&path).unwrap();
    }
    path
}

#[test]
fn counts_on_rising_edges() {
    let mut model = Model::new(models::counter());
    set(&mut model, "reset", 1);
    model.clock();
    set(&mut model, "reset", 0);
    set(&mut model, "step", 255);
    set(&mut model, "points$valid", 1);
    for _ in 0..1000 {
        model.clock();
    }
    assert_eq!(get(&model, "count"), 255_000);
    set(&mut model, "points$valid", 0);
    model.clock();
    assert_eq!(get(&model, "count"), 255_000);
    assert_eq!(model.time(), 10_020);
}

#[test]
fn adds_wide_words() {
    let mut model = Model::new(models::wide_adder());
    let [a, b, sum, carry] = ["a", "b", "sum", "carry"].map(|name| model.port(name).unwrap());
    let ones = [u32::MAX, u32::MAX, u32::MAX, 0xf];
    let mut words = [0; 4];
    model.set_wide(a, &ones);
    model.set_wide(b, &[5, 0, 0, 0]);
    model.eval();
    model.get_wide(sum, &mut words);
    assert_eq!((words, model.get(carry)), ([4, 0, 0, 0], 1));
    model.set_wide(b, &[0, 0, 1, 0]);
    model.eval();
    model.get_wide(sum, &mut words);
    assert_eq!(words, [u32::MAX, u32::MAX, 0, 0]);
    model.get_wide(a, &mut words);
    assert_eq!(words, ones);
}

#[test]
fn knows_its_ports() {
    let ports: Vec<_> = models::counter().ports().map(|port| (port.name, port.width, port.direction)).collect();
    let expected = [
        ("clock", 1, Direction::Input),
        ("count", 40, Direction::Output),
        ("points$valid", 1, Direction::Input),
        ("reset", 1, Direction::Input),
        ("state", 16, Direction::Output),
        ("step", 8, Direction::Input),
    ];
    assert_eq!(ports, expected);
    assert_eq!(models::NAMES, ["wide_adder", "counter", "fast_counter"]);
    assert!(models::find("nothing").is_none());
    assert_eq!(models::find("counter").unwrap().name(), "counter");
}

#[test]
fn a_missing_port_is_an_error_that_lists_the_others() {
    let error = Model::new(models::wide_adder()).port("c").unwrap_err();
    assert_eq!(error.to_string(), "model wide_adder has no port \"c\"; its ports are a, b, carry, sum");
}

#[test]
#[should_panic(expected = "port step of 8 bits cannot take the value 0x100")]
fn a_value_too_wide_is_refused() {
    set(&mut Model::new(models::counter()), "step", 256);
}

#[test]
#[should_panic(expected = "port count is an output and cannot be set")]
fn an_output_cannot_be_set() {
    set(&mut Model::new(models::counter()), "count", 0);
}

#[test]
#[should_panic(expected = "port a belongs to model wide_adder, not to counter")]
fn ports_of_another_model_are_refused() {
    let port = Model::new(models::wide_adder()).port("a").unwrap();
    let _ = Model::new(models::counter()).get(port);
}

#[test]
#[should_panic(expected = "port a of 100 bits cannot take the words")]
fn wide_words_keep_their_spare_bits_clear() {
    let mut model = Model::new(models::wide_adder());
    let a = model.port("a").unwrap();
    model.set_wide(a, &[0, 0, 0, 0x10]);
}

#[test]
fn writes_a_waveform() {
    let path = fresh_file("counter.vcd");
    let mut model = Model::new(models::counter());
    model.clock();
    model.trace_to(&path).unwrap();
    assert!(model.is_tracing());
    set(&mut model, "points$valid", 1);
    set(&mut model, "step", 0xa5);
    model.clock();
    model.trace_flush().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    for part in ["points$valid", "#10\n", "#11\n", "#15\n", "#20\n", "b10100101 "] {
        assert!(text.contains(part), "no {part:?} in\n{text}");
    }
    let second = fresh_file("counter_again.vcd");
    model.trace_to(&second).unwrap();
    model.clock();
    model.trace_close();
    model.clock();
    let text = std::fs::read_to_string(&second).unwrap();
    assert!(text.contains("#30\n") && !text.contains("#40\n"), "{text}");
}

#[test]
fn says_why_no_waveform_is_written() {
    let mut model = Model::new(models::wide_adder());
    let error = model.trace_to(fresh_file("adder.vcd")).unwrap_err();
    assert_eq!(error, TraceError::NotBuilt { model: "wide_adder" });
    let mut model = Model::new(models::counter());
    let missing = fresh_file("no_such_folder").join("counter.vcd");
    let error = model.trace_to(&missing).unwrap_err();
    assert_eq!(error, TraceError::File { path: missing });
    assert!(!model.is_tracing());
    model.clock();
}

#[test]
fn says_when_the_disk_is_full() {
    let mut model = Model::new(models::counter());
    model.trace_to("/dev/full").unwrap();
    model.clock();
    assert_eq!(model.trace_flush(), Err(TraceError::Lost));
    model.trace_close();
    model.clock();
    assert_eq!(model.trace_flush(), Ok(()));
}

#[test]
fn random_state_follows_the_seed() {
    let state = |seed| get(&Model::randomized(models::counter(), seed), "state");
    assert_eq!(get(&Model::new(models::counter()), "state"), 0);
    let states: Vec<u64> = (0..20).map(state).collect();
    assert_eq!(states, (0..20).map(state).collect::<Vec<_>>());
    let mut distinct = states.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert!(distinct.len() > 10, "{states:?}");
    let mut model = Model::new(models::counter());
    set(&mut model, "points$valid", 1);
    model.randomize(7);
    assert_eq!(get(&model, "state"), states[7]);
    assert_eq!(get(&model, "points$valid"), 0);
}

#[test]
fn instances_are_independent_and_move_between_threads() {
    let mut models: Vec<_> = (0..4).map(|_| Model::new(models::counter())).collect();
    let counts: Vec<u64> = std::thread::scope(|scope| {
        let handles: Vec<_> = models
            .iter_mut()
            .zip(1..)
            .map(|(model, step)| {
                scope.spawn(move || {
                    set(model, "points$valid", 1);
                    set(model, "step", step);
                    (0..100).for_each(|_| model.clock());
                    get(model, "count")
                })
            })
            .collect();
        handles.into_iter().map(|handle| handle.join().unwrap()).collect()
    });
    assert_eq!(counts, [100, 200, 300, 400]);
}

#[test]
fn fast_clocks_change_no_output() {
    let mut model = Model::new(models::fast_counter());
    set(&mut model, "step", 3);
    model.eval();
    assert_eq!((get(&model, "count"), get(&model, "next")), (0, 3), "no time has passed");
    model.eval();
    model.clock();
    assert_eq!((get(&model, "count"), get(&model, "next")), (3, 6));
    set(&mut model, "step", 200);
    model.clock();
    model.clock();
    assert_eq!(get(&model, "count"), 403, "an edge sees the inputs as they are set");
    set(&mut model, "reset", 1);
    model.clock();
    assert_eq!(get(&model, "count"), 0);
    let path = fresh_file("fast_clocks.vcd");
    model.trace_to(&path).unwrap();
    model.clock();
    drop(model);
    let waveform = std::fs::read_to_string(&path).unwrap();
    assert!(waveform.contains(" step "), "{waveform}");
    assert!(!waveform.contains("held_") && !waveform.contains("apply"), "{waveform}");
}

#[test]
#[should_panic(expected = "only Model::clock drives it")]
fn the_clock_of_fast_clocks_is_not_set() {
    set(&mut Model::new(models::fast_counter()), "clock", 1);
}
