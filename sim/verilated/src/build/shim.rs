//! The code between a Verilated class and Rust. This module reads the ports from Verilator's header, and writes the C++
//! and the Rust that connect them.

use super::error::BuildError;

/// The C++ that all shims share.
pub(super) const HEADER: &str = include_str!("../shim.hpp");

/// A port as Verilator declares it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct DeclaredPort {
    /// Name in C++, for example `points__024valid`.
    member: String,
    /// Name in Verilog, for example `points$valid`.
    name: String,
    /// Number of bits of the port.
    width: u32,
    /// Direction: 0 for an input, 1 for an output, as in `shim.hpp`.
    direction: u32,
}

/// The class name of a model, made unique in a program by the package, since two crates may use the same model name.
pub(super) fn class_name(package: &str, model: &str) -> String {
    format!("V{package}_{model}")
}

/// The ports, sorted by name, from lines such as `VL_IN8(&clock,0,0);` or `VL_OUTW(&sum,99,0,4);`. Verilator lists
/// ports by size, so the order of the Verilog module is lost anyway.
pub(super) fn ports(model: &str, header: &str) -> Result<Vec<DeclaredPort>, BuildError> {
    let mut ports: Vec<DeclaredPort> = header
        .lines()
        .map(str::trim)
        .filter(|line| line.starts_with("VL_IN") || line.starts_with("VL_OUT"))
        .map(|line| {
            port(line).ok_or_else(|| BuildError::Port { model: model.to_string(), declaration: line.to_string() })
        })
        .collect::<Result<_, _>>()?;
    ports.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(ports)
}

fn port(line: &str) -> Option<DeclaredPort> {
    let (kind, rest) = line.split_once("(&")?;
    let direction = match kind.strip_prefix("VL_IN") {
        Some(size) if is_size(size) => 0,
        Some(_) => return None,
        None if is_size(kind.strip_prefix("VL_OUT")?) => 1,
        None => return None,
    };
    let mut fields = rest.strip_suffix(");")?.split(',');
    let member = fields.next()?.to_string();
    let high: u32 = fields.next()?.parse().ok()?;
    let low: u32 = fields.next()?.parse().ok()?;
    let width = high.checked_sub(low)?.checked_add(1)?;
    Some(DeclaredPort { name: verilog_name(&member), member, width, direction })
}

fn is_size(size: &str) -> bool {
    ["", "8", "16", "64", "W"].contains(&size)
}

/// Undoes Verilator's spelling of characters that names in C++ cannot have: `__0` and two hexadecimal digits.
fn verilog_name(member: &str) -> String {
    let mut name = String::new();
    let mut rest = member;
    while let Some(first) = rest.chars().next() {
        let code = rest
            .strip_prefix("__0")
            .and_then(|digits| digits.get(..2))
            .and_then(|digits| u8::from_str_radix(digits, 16).ok());
        let (character, length) = match code {
            Some(code) => (char::from(code), "__0xx".len()),
            None => (first, first.len_utf8()),
        };
        name.push(character);
        rest = rest.get(length..).unwrap_or("");
    }
    name
}

/// The shim of one class. In the unit it stands after the files of the class.
pub(super) fn cpp_unit(class: &str, name: &str, ports: &[DeclaredPort]) -> String {
    let mut table = String::new();
    let mut addresses = String::new();
    for (position, port) in ports.iter().enumerate() {
        table += &format!("    {{\"{}\", {}, {}}},\n", port.name, port.width, port.direction);
        addresses += &format!("    out[{position}] = &model.{};\n", port.member);
    }
    format!(
        "#include \"{class}.h\"\n#include \"shim.hpp\"\n\
         static const verilated_shim::Port {class}_ports[] = {{\n{table}    {{nullptr, 0, 0}}\n}};\n\
         static void {class}_addresses({class}& model, void** out) {{\n{addresses}}}\n\
         extern \"C\" {{\n\
         extern const verilated_shim::Description {class}_description;\n\
         const verilated_shim::Description {class}_description =\n    \
         verilated_shim::Instance<{class}, {class}_addresses>::describe(\"{name}\", {class}_ports, {count});\n\
         }}\n",
        count = ports.len(),
    )
}

/// The Rust side of all models of a crate.
pub(super) fn rust_table(package: &str, names: &[&str]) -> String {
    let mut externs = String::new();
    let mut functions = String::new();
    let mut arms = String::new();
    for name in names {
        let symbol = format!("{}_description", class_name(package, name));
        externs += &format!("        pub static {symbol}: ::verilated::ModelDescription;\n");
        functions += &format!(
            "/// The model `{name}`.\n#[allow(dead_code)]\n\
             pub fn {name}() -> &'static ::verilated::ModelDescription {{\n    \
             // Sound: a constant of this type, made by the build side of `verilated`.\n    \
             #[allow(unsafe_code)]\n    unsafe {{ &linked::{symbol} }}\n}}\n"
        );
        arms += &format!("        \"{name}\" => {name}(),\n");
    }
    format!(
        "#[allow(unsafe_code, non_upper_case_globals)]\nmod linked {{\n    \
         unsafe extern \"C\" {{\n{externs}    }}\n}}\n\
         {functions}\
         /// The model of this name, if there is one.\n#[allow(dead_code)]\n\
         pub fn find(name: &str) -> Option<&'static ::verilated::ModelDescription> {{\n    \
         Some(match name {{\n{arms}        _ => return None,\n    }})\n}}\n\
         /// The names of all models.\n#[allow(dead_code)]\n\
         pub const NAMES: &[&str] = &{names:?};\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_ports_of_every_size() {
        let header = "  VL_IN8(&clock,0,0);\n VL_INW(&wide_a,99,0,4);\n VL_OUT64(&count,39,0);\n \
                      VL_OUT(&a__024b,31,0);\n int x;";
        let ports = ports("m", header).unwrap();
        let found: Vec<_> = ports.iter().map(|p| (p.name.as_str(), p.width, p.direction)).collect();
        assert_eq!(found, [("a$b", 32, 1), ("clock", 1, 0), ("count", 40, 1), ("wide_a", 100, 0)]);
    }

    #[test]
    fn refuses_ports_it_cannot_drive() {
        let error = ports("m", "VL_INOUT8(&pad,0,0);").unwrap_err();
        assert!(error.to_string().contains("pad"), "{error}");
    }

    #[test]
    fn undoes_the_spelling_of_cpp() {
        assert_eq!(verilog_name("points__024valid"), "points$valid");
        assert_eq!(verilog_name("a___05Fb"), "a__b");
        assert_eq!(verilog_name("plain_name"), "plain_name");
    }
}
