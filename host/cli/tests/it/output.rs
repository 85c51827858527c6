//! Tests that outputs are complete or absent.

use crate::common::Scratch;
#[cfg(unix)]
use std::process::Stdio;

const POINTS: &str = "0,0\n10,0\n0,10\n";

#[test]
fn the_input_is_never_overwritten() {
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    scratch.run("triangulate p.csv -o p.csv").fails(2, &["p.csv", "both the input and the output"]);
    scratch.run("triangulate p.csv -o ./p.csv").fails(2, &["both"]);
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(scratch.path("p.csv"), scratch.path("link.csv")).expect("a link can be made");
        std::fs::hard_link(scratch.path("p.csv"), scratch.path("hard.csv")).expect("a link can be made");
        scratch.run("triangulate p.csv -o link.csv").fails(2, &["both"]);
        scratch.run("triangulate link.csv -o hard.csv").fails(2, &["both"]);
    }
    assert_eq!(scratch.read("p.csv"), POINTS);
}

#[cfg(unix)]
#[test]
fn an_input_that_is_redirected_is_never_overwritten() {
    let scratch = Scratch::new();
    let path = scratch.write("p.csv", POINTS);
    let from_file = |output: &str| {
        let mut command = scratch.command(["triangulate", "-", "-q", "-o", output]);
        let input = std::fs::File::open(&path).expect("it is there");
        crate::common::Run::of(command.stdin(input).output().expect("it runs"))
    };
    from_file("p.csv").fails(2, &["p.csv", "both the input and the output"]);
    std::fs::hard_link(&path, scratch.path("hard.csv")).expect("a link can be made");
    from_file("hard.csv").fails(2, &["hard.csv", "both"]);
    assert_eq!(scratch.read("p.csv"), POINTS);
    from_file("other.csv").ok();
    assert_eq!(scratch.read("other.csv"), "0,1,2\n");
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_nowhere_is_no_output() {
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    std::os::unix::fs::symlink("gone.ele", scratch.path("link.ele")).expect("a link can be made");
    scratch.run("triangulate p.csv -o link.ele").fails(3, &["link.ele", "link to a file that does not exist"]);
    assert_eq!(scratch.files(), ["link.ele", "p.csv"]);
    let link = std::fs::symlink_metadata(scratch.path("link.ele")).expect("it is there");
    assert!(link.file_type().is_symlink());
}

/// The report says that the mesh exists, so the report must come after the mesh.
#[cfg(unix)]
#[test]
fn the_report_comes_when_the_file_is_in_place() {
    use std::io::Read;
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    let run = scratch.command(["triangulate", "p.csv", "-o", "m.ele", "--json"]);
    let start = |mut run: std::process::Command| {
        let child = run.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        child.expect("it starts")
    };
    let mut child = start(run);
    let mut stdout = child.stdout.take().expect("the output is a pipe");
    stdout.read_exact(&mut [0; 1]).expect("the report begins");
    assert_eq!(scratch.read("m.ele"), "1 3 0\n0 0 1 2\n");
    drop(stdout);
    assert_eq!(child.wait().expect("it ends").code(), Some(0));
    // If the reader of the report has closed the pipe already, there is no message, and the mesh stays.
    std::fs::remove_file(scratch.path("m.ele")).expect("it is there");
    let mut run = scratch.command(["triangulate", "-", "-o", "m.ele", "--json"]);
    let mut child = start({
        run.stdin(Stdio::piped());
        run
    });
    drop(child.stdout.take());
    let mut stdin = child.stdin.take().expect("the input is a pipe");
    std::io::Write::write_all(&mut stdin, POINTS.as_bytes()).expect("it reads");
    drop(stdin);
    let run = crate::common::Run::of(child.wait_with_output().expect("it ends"));
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(scratch.read("m.ele"), "1 3 0\n0 0 1 2\n");
    assert_eq!(scratch.files(), ["m.ele", "p.csv"]);
}

#[test]
fn a_failed_run_leaves_an_older_output_alone() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\nx,1\n");
    scratch.write("m.ele", "older");
    scratch.run("triangulate p.csv -o m.ele").fails(3, &["row 2"]);
    assert_eq!(scratch.read("m.ele"), "older");
    scratch.write("p.csv", POINTS);
    scratch.run("triangulate p.csv -o m.ele").ok();
    assert_eq!(scratch.read("m.ele"), "1 3 0\n0 0 1 2\n");
    assert_eq!(scratch.files(), ["m.ele", "p.csv"]);
}

#[test]
fn folders_are_no_outputs() {
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    std::fs::create_dir(scratch.path("folder.ele")).expect("a folder can be made");
    scratch.run("triangulate p.csv -o folder.ele").fails(3, &["folder.ele", "folder"]);
    scratch.run("triangulate p.csv -o none/m.ele").fails(3, &["none/m.ele", "No such file"]);
    scratch.run("generate uniform -n 5 -o none/p.csv").fails(3, &["none/p.csv"]);
    assert_eq!(scratch.files(), ["folder.ele", "p.csv"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_stays_a_device() {
    use std::os::unix::fs::FileTypeExt;
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    scratch.run("triangulate p.csv -o /dev/full --format svg").fails(3, &["/dev/full", "No space left"]);
    scratch.run("generate uniform -n 5 -o /dev/full").fails(3, &["/dev/full", "No space left"]);
    let run = scratch.command(["triangulate", "p.csv", "-o", "-", "--format", "ele"]);
    let device = || Stdio::from(std::fs::File::options().write(true).open("/dev/full").expect("it can be opened"));
    let fails =
        |mut run: std::process::Command| crate::common::Run::of(run.stdout(device()).output().expect("it runs"));
    fails(run).fails(3, &["standard output", "No space left"]);
    // If the report cannot be printed, no output is left behind, whatever its format.
    scratch.write("v.csv", "x,y,z\n0,0,1\n4,0,2\n0,4,3\n");
    for arguments in [
        "triangulate p.csv -o m.ele",
        "triangulate p.csv -o m.svg",
        "voronoi p.csv -o m.svg",
        "voronoi p.csv -o m.geojson",
        "lloyd v.csv -o m.csv --iterations 2",
        "interpolate v.csv -o m.asc --grid 1",
        "interpolate v.csv -o m.geojson --contours 1",
    ] {
        let run = scratch.command(arguments.split(' ').chain(["--json"]));
        fails(run).fails(3, &["standard output"]);
        assert_eq!(scratch.files(), ["p.csv", "v.csv"], "{arguments}");
    }
    // An older file at that place is there again.
    for format in ["ele", "svg"] {
        let file = format!("m.{format}");
        scratch.write(&file, "older");
        let run = scratch.command(["triangulate", "p.csv", "-o", &file, "--json"]);
        fails(run).fails(3, &["standard output"]);
        assert_eq!(scratch.read(&file), "older");
        assert_eq!(scratch.files(), [&file[..], "p.csv", "v.csv"]);
        scratch.run(&format!("triangulate p.csv -o {file} --json")).ok();
        assert_ne!(scratch.read(&file), "older");
        assert_eq!(scratch.files(), [&file[..], "p.csv", "v.csv"]);
        std::fs::remove_file(scratch.path(&file)).expect("the file is there");
    }
    let kind = std::fs::metadata("/dev/full").expect("it is there").file_type();
    assert!(kind.is_char_device());
    scratch.run("triangulate p.csv -o /dev/null --format ele").ok();
    let kind = std::fs::metadata("/dev/null").expect("it is there").file_type();
    assert!(kind.is_char_device());
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_keeps_its_permissions_and_links_are_followed() {
    use std::os::unix::fs::PermissionsExt;
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    let real = scratch.write("real.ele", "");
    std::fs::set_permissions(&real, std::fs::Permissions::from_mode(0o640)).expect("permissions can be set");
    std::os::unix::fs::symlink("real.ele", scratch.path("link.ele")).expect("a link can be made");
    scratch.run("triangulate p.csv -o link.ele").ok();
    assert_eq!(scratch.read("real.ele"), "1 3 0\n0 0 1 2\n");
    let mode = std::fs::metadata(&real).expect("it is there").permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
    let link = std::fs::symlink_metadata(scratch.path("link.ele")).expect("it is there");
    assert!(link.file_type().is_symlink());
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_error() {
    use std::io::Read;
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 50000 -o p.csv").ok();
    let mut command = scratch.command(["triangulate", "p.csv", "-o", "-", "--format", "ele", "-q"]);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
    let mut stdout = child.stdout.take().expect("the output is a pipe");
    stdout.read_exact(&mut [0; 4]).expect("the mesh begins");
    drop(stdout);
    let run = crate::common::Run::of(child.wait_with_output().expect("it ends"));
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
}

/// A time longer than any of these runs takes to start its work, or to end after an interrupt.
#[cfg(target_os = "linux")]
const PATIENCE: std::time::Duration = std::time::Duration::from_secs(60);

/// Waits until a process has its interrupt handler, and either sleeps, if it waits for input, or has worked for a
/// fifth of a second.
#[cfg(target_os = "linux")]
fn wait_until_at_work(process: u32, waits_for_input: bool) {
    let file = |name: &str| std::fs::read_to_string(format!("/proc/{process}/{name}")).unwrap_or_default();
    let handles_interrupts = || {
        let status = file("status");
        let mask = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap_or_default();
        u64::from_str_radix(mask.trim(), 16).is_ok_and(|mask| mask >> (2 - 1) & 1 == 1)
    };
    let is_at_work = || {
        let stat = file("stat");
        let fields: Vec<&str> = stat.rsplit_once(')').map_or(Vec::new(), |(_, rest)| rest.split_whitespace().collect());
        // The fields are the state, and hundredths of a second in the program and in the system.
        let time = |place: usize| fields.get(place).and_then(|ticks| ticks.parse::<u32>().ok()).unwrap_or(0);
        if waits_for_input {
            fields.first() == Some(&"S")
        } else {
            time(11) + time(12) >= 20
        }
    };
    let since = std::time::Instant::now();
    while !(handles_interrupts() && is_at_work()) {
        assert!(since.elapsed() < PATIENCE, "the process is not at work after {:?}", since.elapsed());
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
}

/// Runs that wait for their input and runs that work end soon after an interrupt, with a sentence and without a file.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_leaves_a_sentence_and_no_file() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 2000000 --bits 31 -o big.csv").ok();
    scratch.write("none.ele", "0 3 0\n");
    let runs = [
        (vec!["-INT"], "triangulate - -o m.ele"),
        (vec!["-TERM"], "triangulate - -o m.ele"),
        (vec!["-TERM"], "verify - none.ele"),
        (vec!["-INT"], "verify big.csv none.ele"),
        (vec!["-INT"], "generate uniform -n 50000000 --bits 31 -o g.csv"),
        (vec!["-INT"], "triangulate big.csv -o m.ele"),
        (vec!["-INT", "-TERM"], "triangulate big.csv -o m.ele"),
        (vec!["-INT"], "bench uniform -n 16000 --backend clock --contexts 1 --order input"),
    ];
    for (signals, arguments) in runs {
        let mut command = scratch.command(arguments.split_whitespace());
        let child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        let mut child = child.expect("it starts");
        let waits_for_input = arguments.contains(" - ");
        wait_until_at_work(child.id(), waits_for_input);
        let since = std::time::Instant::now();
        for signal in &signals {
            let status = std::process::Command::new("kill").args([signal, child.id().to_string().as_str()]).status();
            assert!(status.expect("kill runs").success());
        }
        // The input is closed only now, so that the run could not end before.
        let stdin = child.stdin.take();
        let run = crate::common::Run::of(child.wait_with_output().expect("it ends"));
        drop(stdin);
        run.fails(130, &["interrupted"]);
        // A job gets a moment to end by itself, and that moment is longer on a loaded machine.
        assert!(since.elapsed() < PATIENCE, "{arguments}: {:?}", since.elapsed());
        assert_eq!(scratch.files(), ["big.csv", "none.ele"], "{arguments}");
    }
}

/// In a container the next process may have the id of one that was killed and left its working file.
#[cfg(unix)]
#[test]
fn a_file_of_a_killed_process_with_the_same_id_is_no_hindrance() {
    let scratch = Scratch::new();
    let program = env!("CARGO_BIN_EXE_incircle");
    let line = format!("echo half > .p.csv.$$.part && exec '{program}' generate uniform -n 5 -o p.csv");
    let run = std::process::Command::new("sh").args(["-c", &line]).current_dir(scratch.path("")).output();
    crate::common::Run::of(run.expect("the shell starts")).ok();
    assert_eq!(scratch.read("p.csv").lines().count(), 5);
    assert_eq!(scratch.files().len(), 2);
}

/// A folder that takes no new file is told before the work. The kernel's folder takes none from anybody.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_file_is_told_before_the_work() {
    let scratch = Scratch::new();
    // These points are wrong, which the command would tell if it read them first.
    scratch.write("p.csv", "0,0\n1,x\n");
    for options in ["", " --memory 32M --scratch ."] {
        let run = scratch.run(&format!("triangulate p.csv -o /proc/self/m.npy{options}"));
        run.fails(3, &["/proc/self/m.npy cannot be written"]);
        assert_eq!(scratch.files(), ["p.csv"]);
    }
}
