//! Wrong scripts and wrong calls: each ends with one sentence and leaves no file.

use crate::common::Scratch;

/// Replays a script of these bytes, and asserts that it is refused with a sentence that has these parts.
#[track_caller]
fn refuse(script: impl AsRef<[u8]>, parts: &[&str]) {
    let scratch = Scratch::new();
    scratch.write("s.txt", script);
    for options in ["-o m.obj --answers a.txt --film f.svg", "-o - --format csv", "-o m.ele --backend model"] {
        scratch.run(&format!("replay s.txt {options}")).fails(3, &["s.txt: "]).fails(3, parts);
    }
    scratch.write("m.obj", "");
    scratch.run("verify s.txt m.obj --script").fails(3, parts);
    std::fs::remove_file(scratch.path("m.obj")).expect("the file was written");
    assert_eq!(scratch.files(), ["s.txt"]);
}

#[test]
fn wrong_rows_are_named() {
    refuse(
        "# a\n\ninsrt 1 2\n",
        &["row 3: 'insrt' is no command: the commands are insert, delete, move, locate, nearest"],
    );
    refuse("INSERT 1 2\n", &["row 1: 'INSERT' is no command"]);
    refuse("insert,1,2\n", &["row 1: 'insert,1,2' is no command"]);
    refuse("insert 1\n", &["row 1 has 1 value behind 'insert': the command is 'insert X Y'"]);
    refuse("insert\n", &["row 1 has 0 values behind 'insert'"]);
    refuse("insert 1 2 3\n", &["row 1 has 3 values behind 'insert'"]);
    refuse("insert 1 2\nmove 0 1\n", &["row 2 has 2 values behind 'move': the command is 'move I X Y'"]);
    refuse("insert 1 2\ndelete\n", &["row 2 has 0 values behind 'delete': the command is 'delete I'"]);
    refuse("nearest 1 2 3 4 5 6 7\n", &["row 1 has 7 values behind 'nearest'"]);
    refuse("insert 1 2\r\nlocate 1\r\n", &["row 2 has 1 value behind 'locate'"]);
    refuse("insert 1 2 \u{a0}\n", &["row 1 has 3 values"]);
}

#[test]
fn wrong_indices_are_named() {
    refuse(
        "delete 0\n",
        &["row 1, column 2: there is no point 0: before this row the script has 0 insertions, counted"],
    );
    refuse(
        "insert 1 2\n\nmove 1 1 2\n",
        &["row 3, column 2: there is no point 1: before this row the script has 1 insertion,"],
    );
    refuse("insert 1 2\ndelete 0\ndelete 0\n", &["row 3, column 2: point 0 is deleted: its index is never used again"]);
    refuse("insert 1 2\ndelete 0\nmove 0 1 2\n", &["row 3, column 2: point 0 is deleted"]);
    refuse("insert 1 2\ndelete 4294967295\n", &["there is no point 4294967295"]);
    for wrong in ["4294967296", "-1", "1.0", "0x0", "99999999999999999999999999", "nan", "zero", "1e0"] {
        let value = format!("row 2, column 2: '{wrong}' is not an index, a whole number from 0 to 4294967295");
        refuse(format!("insert 1 2\ndelete {wrong}\n"), &[&value]);
    }
}

#[test]
fn wrong_coordinates_are_named() {
    refuse("insert nan 2\n", &["row 1, column 2: 'nan' is not a finite number"]);
    refuse("insert 1 2\nmove 0 1 -inf\n", &["row 2, column 4: '-inf' is not a finite number"]);
    refuse("insert 1 2\nmove 0 x 1\n", &["row 2, column 3: 'x' is not a number"]);
    refuse("locate 1e999 2\n", &["row 1, column 2: '1e999' is not a finite number"]);
    refuse("nearest 1 1,5\n", &["row 1, column 3: '1,5' is not a number"]);
    refuse("insert 9223372036854775808 2\n", &["row 1, column 2: '9223372036854775808' is beyond 64 bits"]);
    refuse("insert 1 2\nmove 0 1 -9223372036854775809\n", &["row 2, column 4: '-9223372036854775809' is beyond"]);
}

#[test]
fn bytes_that_are_no_script_are_refused() {
    refuse("", &["the file is empty: a script without commands is a file with a comment, such as '#'"]);
    refuse(b"\xff\xfei\0n\0", &["the text is UTF-16: save it as UTF-8"]);
    refuse(b"insert 1 2\nins\xffert 1 2\n", &["row 2: 'ins\u{fffd}ert' is no command"]);
    refuse(b"insert 1 \xc3\n", &["row 1, column 3: '\u{fffd}' is not UTF-8 text"]);
    refuse(b"insert 1 2\ndelete \xff\n", &["row 2, column 2: '\u{fffd}' is not an index"]);
    refuse(b"\0\0\0\0", &["row 1: '\\0\\0\\0\\0' is no command"]);
    let long = vec![b'7'; 3_000_000];
    refuse([b"insert 1 ".as_slice(), &long].concat(), &["row 1, column 3: ", "(3000000 bytes)"]);
    refuse([b"insert 1 2\ndelete ".as_slice(), &long].concat(), &["row 2, column 2: ", "(3000000 bytes)"]);
    refuse(&long, &["row 1: ", "(3000000 bytes) is no command"]);
    refuse(b"insert 1 2\ndelete 0".repeat(2), &["row 2 has 3 values behind 'delete'"]);
    refuse([b"locate".as_slice(), &b" 1".repeat(1_000_000)].concat(), &["row 1 has 1000000 values behind 'locate'"]);
}

#[test]
fn unusual_scripts_are_right() {
    let scratch = Scratch::new();
    let long = format!("insert 0.{}1 0\n", "0".repeat(100_000));
    for script in [
        "#",
        "\n\n",
        "# only a comment, also \u{fffd}",
        "\u{feff}insert 1 2",
        "insert 1 2\r\nmove 0 3 4\r\n\r\n",
        "locate 1 2\nnearest 1e308 -1e308\n",
        " \tinsert\t1\t2#x\n",
        "insert 1e300 1e-300\nmove +0 1e-300 1\n",
        &long,
    ] {
        scratch.write("s.txt", script);
        scratch.run("replay s.txt -o m.obj --answers a.txt --film f.svg -q").ok();
        scratch.run("verify s.txt m.obj --script -q").ok();
    }
    // What stands in a comment is not read.
    scratch.write("s.txt", b"insert 1 2 # \xff\xfe\0\n");
    scratch.run("replay s.txt -o m.obj -q").ok();
}

#[test]
fn wrong_calls_end_with_two() {
    let scratch = Scratch::new();
    scratch.write("s.txt", "insert 1 2\n");
    for arguments in [
        "replay s.txt",
        "replay -o m.obj",
        "replay s.txt -o m.obj --frames 5",
        "replay s.txt --film f.svg --frames 0",
        "replay s.txt --film f.svg --frames 601",
        "replay s.txt --answers a.txt --format obj",
    ] {
        let run = scratch.run(arguments);
        assert_eq!(run.code, Some(2), "{arguments}: {run:?}");
    }
    for (arguments, part) in [
        ("replay s.txt -o m.xls", "m.xls"),
        ("replay s.txt -o s.txt --format obj", "s.txt is both the input and the output"),
        ("replay s.txt -o m.obj --answers s.txt", "s.txt is both the input and the output"),
        ("replay s.txt -o m.svg --film m.svg", "two of mesh, answers and film have the same file"),
        ("replay s.txt --answers ./f --film f", "two of mesh, answers and film have the same file"),
        ("replay s.txt -o - --format obj --json", "only one of mesh, answers, film and the report"),
        ("replay s.txt -o - --format obj --answers -", "only one of mesh, answers, film and the report"),
        ("replay s.txt -o m.obj --threads 2", "on one thread"),
        ("replay s.txt -o m.obj --backend cpu?threads=2", "on one thread"),
        ("replay s.txt -o m.obj --order hilbert", "--backend model"),
        ("replay s.txt -o m.obj --backend cpu --backend model", "2 back ends are given"),
        ("replay s.txt -o m.obj --config tiny", "--backend clock"),
    ] {
        scratch.run(arguments).fails(2, &[part]);
    }
    scratch.run("replay none.txt -o m.obj").fails(3, &["none.txt: the file cannot be read"]);
    scratch.run("replay . -o m.obj").fails(3, &["the file cannot be read"]);
    scratch.run("replay s.txt -o m.obj --answers none/a.txt").fails(3, &["none/a.txt cannot be written"]);
    scratch.run("replay s.txt -o m.obj --backend serial:/dev/none").fails(4, &["/dev/none"]);
    scratch.run("replay s.txt -o m.obj --backend model --timeout 0.0000000001 -q");
    assert!(scratch.files().iter().all(|name| name == "s.txt" || name == "m.obj"), "{:?}", scratch.files());
}
