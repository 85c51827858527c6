//! Tests of the arrays of NumPy, alone and in archives, and of binary PLY.

use std::io::{Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::common::{accept, refuse, Scratch};

const POINTS: [[i8; 3]; 4] = [[0, 0, 7], [4, -1, 8], [0, 4, 9], [4, 5, 10]];
const ELE: &str = "2 3 0\n0 0 1 3\n1 0 3 2\n";

/// A file of version 1.0 with this type, order and shape, as the text of a header has them, and this data.
fn npy(descr: &str, fortran_order: &str, shape: &str, data: impl AsRef<[u8]>) -> Vec<u8> {
    let text = format!("{{'descr': {descr}, 'fortran_order': {fortran_order}, 'shape': {shape}, }}\n");
    let length = u16::try_from(text.len()).expect("a short header").to_le_bytes();
    [b"\x93NUMPY\x01\x00", length.as_slice(), text.as_bytes(), data.as_ref()].concat()
}

/// The bytes of a number of a type such as `f4`, the least significant byte first.
fn number(value: i8, name: &str) -> Vec<u8> {
    let bits = name[1..].parse::<usize>().expect("a size");
    match name {
        "f4" => f32::from(value).to_le_bytes().to_vec(),
        "f8" => f64::from(value).to_le_bytes().to_vec(),
        _ => i64::from(value).to_le_bytes()[..bits].to_vec(),
    }
}

/// The points in an array with `width` columns of this type, such as `>f4`.
fn array(descr: &str, fortran_order: bool, width: usize) -> Vec<u8> {
    let cell = |row: usize, axis: usize| {
        // Unsigned numbers begin at zero.
        let value = POINTS[row][axis] + i8::from(descr.contains('u'));
        let mut bytes = number(value, &descr[1..]);
        if descr.starts_with('>') {
            bytes.reverse();
        }
        bytes
    };
    let data: Vec<u8> = if fortran_order {
        (0..width).flat_map(|axis| (0..4).flat_map(move |row| cell(row, axis))).collect()
    } else {
        (0..4).flat_map(|row| (0..width).flat_map(move |axis| cell(row, axis))).collect()
    };
    let order = if fortran_order { "True" } else { "False" };
    npy(&format!("'{descr}'"), order, &format!("(4, {width})"), data)
}

fn archive(method: CompressionMethod, arrays: &[(&str, &[u8])]) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        let options = SimpleFileOptions::default().compression_method(method);
        writer.start_file(*name, options).expect("a new name");
        writer.write_all(bytes).expect("memory takes all bytes");
    }
    writer.finish().expect("memory takes all bytes").into_inner()
}

#[test]
fn arrays_of_every_type_order_and_width_are_read() {
    let scratch = Scratch::new();
    for name in ["i1", "i2", "i4", "i8", "u1", "u2", "u4", "u8", "f4", "f8"] {
        for (end, fortran_order, width) in [('<', false, 2), ('>', false, 3), ('<', true, 3), ('>', true, 2)] {
            let end = if name.ends_with('1') { '|' } else { end };
            let descr = format!("{end}{name}");
            scratch.write("p.npy", array(&descr, fortran_order, width));
            scratch.run("triangulate p.npy -o m.ele").ok();
            assert_eq!(scratch.read("m.ele"), ELE, "{descr}, {fortran_order}, {width}");
            scratch.run("triangulate p.npy -o m.obj").ok();
            let obj = scratch.read("m.obj");
            let second = match (name.starts_with('u'), width) {
                (true, 2) => "v 5 0 0\n",
                (true, _) => "v 5 0 9\n",
                (false, 2) => "v 4 -1 0\n",
                (false, _) => "v 4 -1 8\n",
            };
            assert!(obj.contains(second), "{descr}, {width}: {obj}");
        }
    }
}

#[test]
fn numbers_are_those_of_the_array() {
    let scratch = Scratch::new();
    let whole = [[i64::MIN, i64::MAX], [9_007_199_254_740_993, 0], [0, 1]];
    let data: Vec<u8> = whole.as_flattened().iter().flat_map(|value| value.to_le_bytes()).collect();
    scratch.write("p.npy", npy("'<i8'", "False", "(3, 2)", data));
    scratch.run("triangulate p.npy -o m.obj").ok();
    let rows = "v -9223372036854775808 9223372036854775807 0\nv 9007199254740993 0 0\nv 0 1 0\n";
    assert!(scratch.read("m.obj").starts_with(rows), "{}", scratch.read("m.obj"));
    // The f32 nearest to 0.1 is not the double nearest to 0.1.
    let data: Vec<u8> = [0.1f32, -0.0, 2.0, 0.0, 0.0, 1.0].iter().flat_map(|value| value.to_be_bytes()).collect();
    scratch.write("p.npy", npy("'>f4'", "False", "(3, 2)", data));
    scratch.run("triangulate p.npy -o m.obj").ok();
    let obj = scratch.read("m.obj");
    assert!(obj.starts_with("# incircle: the coordinates are doubles\nv 0.10000000149011612 0 0\nv 2 0 0\n"), "{obj}");
}

#[test]
fn records_have_fields_by_name() {
    let scratch = Scratch::new();
    let descr = "[('id', '|u1'), ('y', '>f4'), ('', '|V3'), ('x', '<i2'), ('more', '<f8', (2,)), ('z', '|i1')]";
    let record = |[x, y, z]: [i8; 3]| {
        let fields = [vec![9], f32::from(y).to_be_bytes().to_vec(), vec![1; 3], i16::from(x).to_le_bytes().to_vec()];
        [fields.concat(), vec![255; 16], z.to_le_bytes().to_vec()].concat()
    };
    let data = POINTS.map(record).concat();
    scratch.write("p.npy", npy(descr, "False", "(4,)", &data));
    scratch.run("triangulate p.npy -o m.obj").ok();
    let obj = scratch.read("m.obj");
    assert!(obj.starts_with("v 0 0 7\nv 4 -1 8\nv 0 4 9\nv 4 5 10\n"), "{obj}");
    refuse("p.npy", npy("[('a', '<f8'), ('x', '<f8')]", "False", "(1,)", [0; 16]), &["'a', 'x'", "fields x and y"]);
    refuse("p.npy", npy("[('x', '<f8'), ('y', '<f2')]", "False", "(1,)", [0; 10]), &["'<f2'"]);
    refuse("p.npy", npy(descr, "False", "(2, 2)", &data), &["shape (2, 2)", "(n, 2)"]);
    let wide = "[('x', '<f8'), ('y', '<f8'), ('rest', '|V999999999999')]";
    refuse("p.npy", npy(wide, "False", "(1,)", [0; 16]), &["a row of the array"]);
}

#[test]
fn integers_beside_floats_are_not_rounded() {
    let file = |name: &str, integers: [i128; 2]| {
        let record = |integer: i128| [&integer.to_le_bytes()[..8], &0.5f64.to_le_bytes()].concat();
        npy(&format!("[('x', '<{name}'), ('y', '<f8')]"), "False", "(2,)", integers.map(record).concat())
    };
    let held = (1 << 53) + 2;
    accept("p.npy", file("i8", [-held, 1 << 62]), 0);
    accept("p.npy", file("u8", [held, 1 << 63]), 0);
    refuse("p.npy", file("i8", [7, held - 1]), &["point 2, x", "9007199254740993", "both as integers"]);
    refuse("p.npy", file("i8", [1 - held, 7]), &["point 1, x", "-9007199254740993"]);
    refuse("p.npy", file("u8", [7, (1 << 64) - 1]), &["point 2, x", "18446744073709551615"]);
}

#[test]
fn shapes_and_types_that_are_no_points_are_refused() {
    for shape in ["()", "(8,)", "(2, 4)", "(4, 1)", "(1, 4, 2)"] {
        let named = format!("shape {shape}");
        refuse("p.npy", npy("'<f8'", "False", shape, [0; 64]), &[&named, "(n, 2) or (n, 3)", "transpose"]);
    }
    for descr in ["<f2", "<c16", "|b1", "<U3", "|S4", "<M8[s]", "|V8", "<f16"] {
        refuse("p.npy", npy(&format!("'{descr}'"), "False", "(1, 2)", [0; 64]), &[descr, "astype"]);
    }
    refuse("p.npy", npy("'|O'", "False", "(1, 2)", [0; 16]), &["Python objects"]);
    accept("p.npy", npy("'<f8'", "False", "(0, 2)", []), 0);
}

#[test]
fn values_that_are_no_coordinates_are_refused() {
    let data: Vec<u8> = [1.0, 2.0, 3.0, f64::NAN].iter().flat_map(|value| value.to_le_bytes()).collect();
    refuse("p.npy", npy("'<f8'", "False", "(2, 2)", &data), &["point 2, y", "NaN"]);
    let data: Vec<u8> = [1.0f32, f32::NEG_INFINITY, 3.0, 4.0].iter().flat_map(|value| value.to_be_bytes()).collect();
    refuse("p.npy", npy("'>f4'", "True", "(2, 2)", &data), &["point 2, x", "-inf"]);
    let data: Vec<u8> = [1, 2, 1 << 63, 4u64].iter().flat_map(|value| value.to_le_bytes()).collect();
    refuse("p.npy", npy("'<u8'", "False", "(2, 2)", &data), &["point 2, x", "9223372036854775808 is beyond 64 bits"]);
    let data: Vec<u8> = [0.0, 0.0, f64::NAN].iter().flat_map(|value| value.to_le_bytes()).collect();
    refuse("p.npy", npy("'<f8'", "False", "(1, 3)", &data), &["point 1, z", "NaN"]);
}

#[test]
fn headers_that_lie_or_end_are_refused() {
    let whole = array("<f8", false, 2);
    refuse("p.npy", &whole[..whole.len() - 1], &["shape (4, 2) in 64 bytes", "ends after 63"]);
    refuse("p.npy", [whole.as_slice(), b"12"].concat(), &["more than its header promises", "2 bytes"]);
    for (cut, part) in
        [(0, "not an array"), (5, "not an array"), (7, "ends within"), (9, "ends within"), (40, "ends within")]
    {
        refuse("p.npy", &whole[..cut], &[part]);
    }
    refuse("p.npy", b"PK\x03\x04 and more", &["not an array of NumPy"]);
    refuse("p.npy", b"\x93NUMPY\x02\x00\xff\xff\xff\xff", &["4294967295 bytes of text"]);
    refuse("p.npy", b"\x93NUMPY\x07\x00\x04\x00\x00\x00{}  ", &["header", "version"]);
    refuse("p.npy", npy("'<f8'", "False", "(1099511627776, 2)", [0; 16]), &["promises", "17592186044416 bytes"]);
    refuse("p.npy", npy("'<f8'", "False", "(9223372036854775807, 2)", [0; 16]), &["no file can hold"]);
    refuse("p.npy", npy("'<f8'", "False", "(4294967296, 4294967296)", []), &["(4294967296, 4294967296)"]);
    refuse("p.npy", npy("'<f8'", "False", "(99999999999999999999, 2)", []), &["header"]);
    refuse("p.npy", npy("'<f8'", "False", "(-1, 2)", []), &["negative"]);
    refuse("p.npy", npy("'<f8'", "0", "(1, 2)", [0; 16]), &["fortran_order"]);
    refuse("p.npy", npy("'<f8'", "False", &"(".repeat(9000), []), &["nested"]);
    refuse("p.npy", npy("'\u{1b}[2J'", "False", "(1, 2)", []), &["header"]);
}

#[test]
fn arrays_come_from_pipes_and_packed_files() {
    let scratch = Scratch::new();
    let right = array(">i4", true, 3);
    let run = scratch.run_with_input("triangulate - --from npy -o - --format ele", &right).ok();
    assert_eq!(run.stdout, ELE);
    let cut = scratch.run_with_input("triangulate - --from npy -o - --format ele", &right[..right.len() - 4]);
    cut.fails(3, &["in 48 bytes", "ends after 44"]);
    let more = scratch.run_with_input("triangulate - --from npy -o - --format ele", &[right.as_slice(), b"1"].concat());
    more.fails(3, &["more than its header promises"]);
    let huge = npy("'<f8'", "False", "(1152921504606846975, 2)", []);
    let huge = scratch.run_with_input("triangulate - --from npy -o - --format ele", &huge);
    huge.fails(3, &["points", "free memory"]);
    scratch.write("p.npy.zst", zstd::encode_all(right.as_slice(), 0).expect("memory takes all bytes"));
    scratch.run("triangulate p.npy.zst -o m.npy.gz").ok();
    scratch.run("verify p.npy.zst m.npy.gz").ok();
}

#[test]
fn archives_of_arrays_are_read_by_name() {
    let scratch = Scratch::new();
    let (floats, integers) = (array("<f8", false, 2), array(">i2", true, 3));
    for method in [CompressionMethod::Stored, CompressionMethod::Deflated] {
        scratch.write("one.npz", archive(method, &[("arr_0.npy", &floats), ("read.me", b"text")]));
        scratch.run("triangulate one.npz -o m.ele").ok();
        assert_eq!(scratch.read("m.ele"), ELE);
        let both = archive(method, &[("a.npy", &floats), ("sub/b.npy", &integers), ("c.npy", b"text")]);
        scratch.write("all.npz", &both);
        scratch.run("triangulate all.npz --array sub/b -o m.obj").ok();
        assert!(scratch.read("m.obj").starts_with("v 0 0 7\n"));
        scratch.run("verify all.npz --array a m.ele").ok();
        scratch.run("triangulate all.npz -o n.ele").fails(3, &["all.npz", "'a', 'sub/b', 'c'", "--array"]);
        scratch.run("triangulate all.npz --array b -o n.ele").fails(3, &["no array 'b'", "'a', 'sub/b', 'c'"]);
        scratch.run("triangulate all.npz --array c -o n.ele").fails(3, &["array 'c'", "not an array of NumPy"]);
        let run = scratch.run_with_input("triangulate - --from npz --array a -o - --format ele", &both).ok();
        assert_eq!(run.stdout, ELE);
        let mut spoilt = archive(method, &[("arr_0.npy", &floats)]);
        let place = if method == CompressionMethod::Stored { 39 + floats.len() - 9 } else { 39 + 40 };
        spoilt[place] ^= 0x55;
        refuse("p.npz", spoilt, &["p.npz", "array 'arr_0'"]);
    }
    refuse("p.npz", archive(CompressionMethod::Stored, &[("a.txt", b"text")]), &["holds no array"]);
    refuse("p.npz", b"no archive", &["not an archive of arrays"]);
    refuse("p.npz", b"", &["not an archive of arrays"]);
    let names: Vec<String> = (0..300).map(|number| format!("array number {number}.npy")).collect();
    let many: Vec<(&str, &[u8])> = names.iter().map(|name| (name.as_str(), floats.as_slice())).collect();
    refuse("p.npz", archive(CompressionMethod::Stored, &many), &["several arrays", "'array number 0'"]);
}

#[test]
fn an_array_has_a_name_only_in_an_archive() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    scratch.write("p.npy", array("<f8", false, 2));
    for name in ["p.csv", "p.npy"] {
        scratch.run(&format!("triangulate {name} --array a -o m.ele")).fails(2, &["--array", ".npz"]);
    }
    scratch.run("verify p.csv p.npy --array a").fails(2, &["--array"]);
    assert_eq!(scratch.files(), ["p.csv", "p.npy"]);
}

#[test]
fn meshes_are_arrays_of_integers() {
    let scratch = Scratch::new();
    scratch.write("p.npy", array("<f8", false, 2));
    scratch.run("triangulate p.npy -o m.npy").ok();
    let bytes = std::fs::read(scratch.path("m.npy")).expect("the file was written");
    let (head, data) = bytes.split_at(128);
    assert!(head.starts_with(b"\x93NUMPY\x01\x00\x76\x00{'descr': '<u4', 'fortran_order': False, 'shape': (2, 3, ), }"));
    let indices: Vec<u8> = [0u32, 1, 3, 0, 3, 2].iter().flat_map(|index| index.to_le_bytes()).collect();
    assert_eq!(data, indices);
    let mesh = |descr: &str, order: &str, indices: [i8; 6]| {
        let data: Vec<u8> = indices.iter().flat_map(|&index| number(index, &descr[1..])).collect();
        npy(&format!("'{descr}'"), order, "(2, 3)", data)
    };
    for descr in ["|i1", "|u1", "<i2", "<u2", "<i4", "<i8", "<u8"] {
        scratch.write("n.npy", mesh(descr, "False", [0, 1, 3, 0, 3, 2]));
        scratch.run("verify p.npy n.npy").ok();
        scratch.write("n.npy", mesh(descr, "True", [0, 0, 1, 3, 3, 2]));
        scratch.run("verify p.npy n.npy").ok();
    }
    scratch.write("n.npy", mesh("<i8", "False", [0, 1, 2, 1, -1, 2]));
    scratch.run("verify p.npy n.npy").fails(3, &["n.npy", "triangle 2: -1 is not a point index"]);
    scratch.write("n.npy", mesh("<u8", "False", [0, 1, 2, 1, -1, 2]));
    scratch.run("verify p.npy n.npy").fails(3, &["triangle 2: 18446744073709551615"]);
    scratch.write("n.npy", mesh("<f8", "False", [0, 1, 2, 1, 3, 2]));
    scratch.run("verify p.npy n.npy").fails(3, &["floats", "astype"]);
    scratch.run("verify p.npy p.npy").fails(3, &["shape (4, 2)", "triangles have the shape (m, 3)"]);
    scratch.write("n.npy", npy("[('a', '<u4')]", "False", "(1,)", [0; 4]));
    scratch.run("verify p.npy n.npy").fails(3, &["records", "triangles have the shape (m, 3)"]);
    scratch.write("n.npy", mesh("<i2", "False", [0, 1, 2, 1, 2, 3]));
    scratch.run("verify p.npy n.npy").fails(1, &["not the canonical"]);
}

#[test]
fn binary_ply_keeps_coordinates_and_heights() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n0.1,-2,7\n4,0,8.5\n0,4,9\n");
    scratch.run("triangulate p.csv -o m.ply --format ply-binary").ok();
    let bytes = std::fs::read(scratch.path("m.ply")).expect("the file was written");
    let values = [0.1, -2.0, 7.0, 4.0, 0.0, 8.5, 0.0, 4.0, 9.0f64].map(f64::to_le_bytes).concat();
    let face = [vec![3], [0i32, 1, 2].map(i32::to_le_bytes).concat()].concat();
    let head = "ply\nformat binary_little_endian 1.0\n";
    assert!(bytes.starts_with(head.as_bytes()));
    assert!(bytes.ends_with(&[b"end_header\n".as_slice(), &values, &face].concat()));
    scratch.run("verify p.csv m.ply").ok();
    scratch.run("verify p.csv m.ply --format ply-binary").ok();
    scratch.run("triangulate m.ply -o again.ply --format ply-binary").ok();
    assert_eq!(std::fs::read(scratch.path("again.ply")).expect("the file was written"), bytes);
    // The extension alone names the ascii form.
    scratch.run("triangulate p.csv -o ascii.ply").ok();
    assert!(scratch.read("ascii.ply").starts_with("ply\nformat ascii 1.0\n"));
}

#[test]
fn binary_ply_refuses_whole_numbers_that_no_double_holds() {
    let scratch = Scratch::new();
    for (beyond, is_held) in [
        ("9007199254740993", false),
        ("-9007199254740993", false),
        ("9223372036854775807", false),
        ("9007199254740994", true),
        ("-9223372036854775808", true),
    ] {
        scratch.write("p.csv", format!("0,0\n1,{beyond}\n5,5\n"));
        let run = scratch.run("triangulate p.csv -o m.ply --format ply-binary");
        if is_held {
            run.ok();
            scratch.run("verify p.csv m.ply").ok();
            std::fs::remove_file(scratch.path("m.ply")).expect("the file was written");
        } else {
            run.fails(3, &["p.csv", "row 2, column 2", beyond, "ply-binary", "obj"]);
            assert_eq!(scratch.files(), ["p.csv"]);
        }
    }
}

/// The doubles nearest to tenths lie on no common lattice, while the decimals that are written for them do: without the
/// mark the squares of this lattice would be ties in one reading and not in the other.
#[test]
fn doubles_that_were_written_as_text_are_read_as_doubles() {
    let scratch = Scratch::new();
    let tenths = (0..400).flat_map(|k| [f64::from(k / 20) * 0.1, f64::from(k % 20) * 0.3 - 0.7]);
    let bytes: Vec<u8> = tenths.flat_map(f64::to_le_bytes).collect();
    scratch.write("p.npy", npy("'<f8'", "False", "(400, 2)", &bytes));
    scratch.run("triangulate p.npy -o m.npy").ok();
    for name in ["m.obj", "m.ply", "m.json"] {
        scratch.run(&format!("triangulate p.npy -o {name}")).ok();
        scratch.run(&format!("verify {name} {name}")).ok();
        scratch.run(&format!("verify {name} m.npy")).ok();
        scratch.run(&format!("triangulate {name} -o again-{name}")).ok();
        assert!(scratch.read(&format!("again-{name}")) == scratch.read(name), "{name} is another mesh when read again");
    }
}
