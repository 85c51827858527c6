//! Writes the Verilog that instantiates memories as block RAM of the ECP5.
//!
//! Inference uses neither the output register inside the block RAM nor its clock enable; the path from the array
//! through the fabric to a register outside would limit the clock. A word is spread over block RAMs side by side, each
//! as wide as the number of words allows, so that no multiplexer follows them.
//!
//! Source: Lattice, ECP5 and ECP5-5G Memory Usage Guide, primitive DP16KD. `testbench/cells/DP16KD.v` states
//! the modes used here.

/// Bits of each word that one block RAM of `2^address_bits` words holds, or `None` if no block RAM is so deep.
fn slice_bits(address_bits: usize) -> Option<usize> {
    match address_bits {
        0..=10 => Some(18),
        11 => Some(9),
        12 => Some(4),
        13 => Some(2),
        14 => Some(1),
        _ => None,
    }
}

/// The 14 address pins. Wide words leave the lowest pins unused, except that the two lowest are byte enables in
/// words of 18 bits.
fn address_pins(address: &str, address_bits: usize, slice_bits: usize) -> String {
    let low = match slice_bits {
        18 => ", 4'b0011",
        9 => ", 3'b000",
        4 => ", 2'b00",
        2 => ", 1'b0",
        _ => "",
    };
    let low_bits = match slice_bits {
        18 => 4,
        9 => 3,
        4 => 2,
        2 => 1,
        _ => 0,
    };
    let high = match 14 - low_bits - address_bits {
        0 => String::new(),
        bits => format!("{{{bits}{{1'b0}}}}, "),
    };
    format!("{{{high}{address}{low}}}")
}

/// Connections of the pins `name0`, `name1` and so on to the bits of a vector, or to nothing, eight pins to a line.
fn pins(name: &str, vector: Option<&str>, bits: usize) -> String {
    let end = |bit| vector.map_or(String::new(), |vector| format!("{vector}[{bit}]"));
    let pins: Vec<_> = (0..bits).map(|bit| format!(".{name}{bit}({})", end(bit))).collect();
    let lines: Vec<_> = pins.chunks(8).map(|line| format!("    {}", line.join(", "))).collect();
    lines.join(",\n")
}

/// The signals of one port of a block RAM, as Verilog expressions.
struct Port<'a> {
    letter: char,
    address: &'a str,
    taken: &'a str,
    given: Option<&'a str>,
    write: &'a str,
    enable: &'a str,
}

impl Port<'_> {
    fn connections(&self) -> String {
        let Self { letter, address, taken, given, write, enable } = self;
        format!(
            "\
    .CLK{letter}(clock), .CE{letter}({enable}), .OCE{letter}({enable}), .WE{letter}({write}), .RST{letter}(1'b0),
    .CS{letter}0(1'b0), .CS{letter}1(1'b0), .CS{letter}2(1'b0),
{},
{},
{}",
            pins(&format!("AD{letter}"), Some(address), 14),
            pins(&format!("DI{letter}"), Some(taken), 18),
            pins(&format!("DO{letter}"), *given, 18),
        )
    }
}

/// The Verilog of one DP16KD; the vectors that it names must be declared around it.
fn block_ram(bits: usize, write_mode_a: &str, a: &Port, b: &Port) -> String {
    format!(
        "\
DP16KD #(
    .DATA_WIDTH_A({bits}), .DATA_WIDTH_B({bits}), .REGMODE_A(\"OUTREG\"), .REGMODE_B(\"OUTREG\"),
    .WRITEMODE_A(\"{write_mode_a}\"), .WRITEMODE_B(\"NORMAL\"), .RESETMODE(\"SYNC\"), .GSR(\"AUTO\"),
    .CSDECODE_A(\"0b000\"), .CSDECODE_B(\"0b000\")
) block_ram (
{},
{}
);
",
        a.connections(),
        b.connections()
    )
}

/// Verilog with both forms of a memory, or with the neutral one alone if no block RAM is so deep.
fn either(primitive: Option<String>, neutral: &str) -> String {
    match primitive {
        Some(primitive) => format!("`ifdef INCIRCLE_ECP5\n{primitive}`else\n{neutral}`endif\n"),
        None => neutral.to_string(),
    }
}

/// The connections of a memory, as Verilog expressions: one port that reads, and one that writes and may also read.
pub(super) struct Memory<'a> {
    pub address_bits: usize,
    pub stored_bits: usize,
    pub write_address: &'a str,
    pub write_data: &'a str,
    pub read_address: &'a str,
    pub read_enable: &'a str,
    /// Value of `read_data`, computed from a word called `word`.
    pub result: &'a str,
    /// Value of `shared_data`, computed from a word called `shared_word`, if the write port also reads.
    pub shared_result: Option<&'a str>,
}

impl Memory<'_> {
    /// Verilog with this memory as DP16KD for the ECP5, and as `neutral` for all other devices.
    pub(super) fn verilog(&self, neutral: &str) -> String {
        either(slice_bits(self.address_bits).map(|bits| self.primitive(bits)), neutral)
    }

    fn primitive(&self, bits: usize) -> String {
        let slices = self.stored_bits.div_ceil(bits);
        let padding = match slices * bits - self.stored_bits {
            0 => String::new(),
            padding => format!("{{{padding}{{1'b0}}}}, "),
        };
        let write = Port {
            letter: 'A',
            address: "write_pins",
            taken: "taken",
            given: self.shared_result.map(|_| "shared_given"),
            write: "write_enable",
            enable: "1'b1",
        };
        let read = Port {
            letter: 'B',
            address: "read_pins",
            taken: "nothing",
            given: Some("given"),
            write: "1'b0",
            enable: self.read_enable,
        };
        let (mut all_shared, mut shared, mut shared_data) = (String::new(), String::new(), String::new());
        if let Some(result) = self.shared_result {
            let (padded, top, last) = (slices * bits - 1, self.stored_bits - 1, bits - 1);
            all_shared = format!("wire [{padded}:0] all_shared;\nwire [{top}:0] shared_word = all_shared[{top}:0];\n");
            shared = format!(
                "wire [17:0] shared_given;\nassign all_shared[slice*{bits} +: {bits}] = shared_given[{last}:0];\n"
            );
            shared_data = format!("always @(*) shared_data = {result};\n");
        }
        format!(
            "\
wire [13:0] write_pins = {write_pins};
wire [13:0] read_pins = {read_pins};
wire [17:0] nothing = 18'b0;
wire [{padded}:0] all_taken = {{{padding}{data}}};
wire [{padded}:0] all_given;
wire [{top}:0] word = all_given[{top}:0];
{all_shared}genvar slice;
generate for (slice = 0; slice < {slices}; slice = slice + 1) begin : slices
wire [17:0] taken = {taken};
wire [17:0] given;
assign all_given[slice*{bits} +: {bits}] = given[{last}:0];
{shared}{block_ram}end endgenerate
always @(*) read_data = {result};
{shared_data}",
            write_pins = address_pins(self.write_address, self.address_bits, bits),
            read_pins = address_pins(self.read_address, self.address_bits, bits),
            padded = slices * bits - 1,
            data = self.write_data,
            top = self.stored_bits - 1,
            taken = match 18 - bits {
                0 => "all_taken[slice*18 +: 18]".to_string(),
                unused => format!("{{{unused}'b0, all_taken[slice*{bits} +: {bits}]}}"),
            },
            last = bits - 1,
            block_ram = block_ram(bits, "NORMAL", &write, &read),
            result = self.result,
        )
    }
}

/// Verilog of lock bits as one DP16KD for the ECP5, and as `neutral` for all other devices: port A reads and then
/// sets, port B clears.
pub(super) fn locks(address_bits: usize, test_address: &str, clear_address: &str, neutral: &str) -> String {
    let bits = 1;
    let test = Port {
        letter: 'A',
        address: "test_pins",
        taken: "locked",
        given: Some("given"),
        write: "test_set",
        enable: "1'b1",
    };
    let clear = Port {
        letter: 'B',
        address: "clear_pins",
        taken: "unlocked",
        given: None,
        write: "clear_enable",
        enable: "1'b1",
    };
    let primitive = slice_bits(address_bits).map(|_| {
        format!(
            "\
wire [13:0] test_pins = {test_pins};
wire [13:0] clear_pins = {clear_pins};
wire [17:0] locked = 18'b1;
wire [17:0] unlocked = 18'b0;
wire [17:0] given;
{block_ram}always @(*) was_set = given[0];
",
            test_pins = address_pins(test_address, address_bits, bits),
            clear_pins = address_pins(clear_address, address_bits, bits),
            block_ram = block_ram(bits, "READBEFOREWRITE", &test, &clear),
        )
    });
    either(primitive, neutral)
}
