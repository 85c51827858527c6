//! Divides combinational processes into processes that share nothing.
//!
//! rust-hdl writes all combinational logic of a block as one process, `always @(*)`, and Verilator evaluates most
//! processes as a whole. Two blocks that answer each other within a clock then look like a loop, and Verilator
//! evaluates them again and again until no signal changes. In processes of a few statements there is no loop.
//!
//! Two statements stay in one process if both assign one variable, or if one reads a variable before the other has
//! assigned it for the last time. A process with a line of an unknown form stays as it is.

use std::collections::HashMap;

const PROCESS: &str = "always @(*) begin";

/// A statement of a process, with everything inside it.
#[derive(Default)]
struct Statement<'a> {
    lines: Vec<&'a str>,
    writes: Vec<&'a str>,
    reads: Vec<&'a str>,
}

/// What a line does to the nesting of `begin` and `case`.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Form {
    Nothing,
    Opens,
    /// An `else` and what it opens: the statement before it goes on.
    Continues,
    Closes,
    Stays,
}

/// The text with its processes divided.
pub(super) fn divided(verilog: &str) -> String {
    let lines: Vec<&str> = verilog.lines().collect();
    let mut text = String::with_capacity(verilog.len());
    let mut place = 0;
    while let Some(&line) = lines.get(place) {
        place += 1;
        let body = lines.get(place..).unwrap_or_default();
        match (line.trim() == PROCESS).then(|| statements(body)).flatten() {
            Some((statements, length)) => {
                place += length;
                write_processes(&statements, &mut text);
            }
            None => text.extend([line, "\n"]),
        }
    }
    text
}

/// The statements of the process whose body begins with these lines, and the number of its lines, `end` included.
fn statements<'a>(lines: &[&'a str]) -> Option<(Vec<Statement<'a>>, usize)> {
    let mut statements: Vec<Statement> = Vec::new();
    let mut depth = 1;
    for (place, &line) in lines.iter().enumerate() {
        let form = form_of(line.trim())?;
        match form {
            Form::Nothing => continue,
            Form::Closes if depth == 1 => return Some((statements, place + 1)),
            Form::Opens | Form::Stays if depth == 1 => statements.push(Statement::default()),
            _ => {}
        }
        match form {
            Form::Opens | Form::Continues => depth += 1,
            Form::Closes => depth -= 1,
            _ => {}
        }
        let statement = statements.last_mut()?;
        statement.lines.push(line);
        let text = line.trim();
        match text.ends_with(';') {
            true => {
                let (target, rest) = text.split_at(name_length(text));
                statement.writes.push(target);
                statement.reads.extend(names(rest));
            }
            false => statement.reads.extend(names(text)),
        }
    }
    None
}

/// The form of a trimmed line; `None` if it is unknown.
fn form_of(line: &str) -> Option<Form> {
    if line.is_empty() || line.starts_with("//") {
        return Some(Form::Nothing);
    }
    let opens_if = |text: &str| text.starts_with("if (") && text.ends_with(") begin");
    let else_part = line.strip_prefix("else ");
    if else_part.is_some_and(|rest| rest == "begin" || opens_if(rest)) {
        return Some(Form::Continues);
    }
    if line == "begin" || opens_if(line) || line.starts_with("case (") && line.ends_with(')') {
        return Some(Form::Opens);
    }
    if line == "end" || line == "endcase" {
        return Some(Form::Closes);
    }
    let is_label = line.ends_with(':') && !line.contains(' ');
    (is_label || is_assignment(line)).then_some(Form::Stays)
}

/// Whether the line is `name = value;` or `name[...] = value;`, with nothing behind it.
fn is_assignment(line: &str) -> bool {
    let (name, rest) = line.split_at(name_length(line));
    let value = match rest.strip_prefix('[') {
        Some(range) => range.split_once("] = ").map(|(_, value)| value),
        None => rest.strip_prefix(" = "),
    };
    !name.is_empty() && value.and_then(|value| value.strip_suffix(';')).is_some_and(|value| !value.contains(';'))
}

/// Number of characters of the name with which the text begins; 0 if it begins otherwise.
fn name_length(text: &str) -> usize {
    let begins = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let end = || text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '$').unwrap_or(text.len());
    if begins {
        end()
    } else {
        0
    }
}

/// All names in the text, keywords included: a name that is no variable does no harm. Digits of numbers such as `4'hf`
/// are no names.
fn names(mut text: &str) -> Vec<&str> {
    let mut names = Vec::new();
    while let Some(first) = text.chars().next() {
        let length = name_length(text);
        if length > 0 {
            names.push(text.get(..length).unwrap_or_default());
        }
        let is_number = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '\'';
        let number = if first.is_ascii_digit() { text.find(|c| !is_number(c)).unwrap_or(text.len()) } else { 0 };
        text = text.get(length.max(number).max(first.len_utf8())..).unwrap_or_default();
    }
    names
}

/// Writes one process for each group of statements, in the order of their first statements.
fn write_processes(statements: &[Statement], text: &mut String) {
    let groups = groups(statements);
    for group in 0..statements.len() {
        let members = || statements.iter().zip(&groups).filter(move |(_, &of)| of == group);
        if members().next().is_none() {
            continue;
        }
        text.extend(["    ", PROCESS, "\n"]);
        for line in members().flat_map(|(statement, _)| &statement.lines) {
            text.extend([*line, "\n"]);
        }
        text.push_str("    end\n");
    }
}

/// The group of each statement: the place of the first statement that must share a process with it.
fn groups(statements: &[Statement]) -> Vec<usize> {
    let mut first = HashMap::new();
    let mut last = HashMap::new();
    let mut groups: Vec<usize> = (0..statements.len()).collect();
    for (place, statement) in statements.iter().enumerate() {
        for &name in &statement.writes {
            unite(&mut groups, place, *first.entry(name).or_insert(place));
            last.insert(name, place);
        }
    }
    for (place, statement) in statements.iter().enumerate() {
        for name in &statement.reads {
            if let (Some(&writer), true) = (first.get(name), last.get(name).is_some_and(|&last| place <= last)) {
                unite(&mut groups, place, writer);
            }
        }
    }
    groups
}

/// Makes one group of the groups of two statements.
fn unite(groups: &mut [usize], a: usize, b: usize) {
    let of = |place: usize| groups.get(place).copied().unwrap_or(place);
    let (kept, lost) = (of(a).min(of(b)), of(a).max(of(b)));
    groups.iter_mut().filter(|group| **group == lost).for_each(|group| *group = kept);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The processes of a text that has nothing else, each in one line.
    fn processes(body: &str) -> Vec<String> {
        let text = divided(&format!("    {PROCESS}\n{body}\n    end\n"));
        let one_line = |process: &str| process.split_whitespace().collect::<Vec<_>>().join(" ");
        text.split(PROCESS).skip(1).map(one_line).collect()
    }

    #[test]
    fn statements_without_a_common_variable_part() {
        assert_eq!(processes("a = b;\nc = d & 2'h1;\na$q = c;"), ["a = b; end", "c = d & 2'h1; end", "a$q = c; end"]);
    }

    #[test]
    fn the_assignments_of_one_variable_stay_together_in_order() {
        let body = "a = b;\nc = 1'b0;\nif (d) begin\na = e;\nend\nelse begin\nf[(32'h0)+:(1)] = b;\nend";
        let first = "a = b; if (d) begin a = e; end else begin f[(32'h0)+:(1)] = b; end end";
        assert_eq!(processes(body), [first, "c = 1'b0; end"]);
    }

    #[test]
    fn a_value_between_two_assignments_is_read_in_their_process() {
        assert_eq!(processes("a = b;\nc = a;\na = d;\ne = a;"), ["a = b; c = a; a = d; end", "e = a; end"]);
    }

    #[test]
    fn cases_are_one_statement() {
        let body = "case (s)\nOne:\nbegin\na = b;\nend\ndefault:\nbegin\nc = b;\nend\nendcase\nd = b;";
        let case = "case (s) One: begin a = b; end default: begin c = b; end endcase end";
        assert_eq!(processes(body), [case, "d = b; end"]);
    }

    #[test]
    fn a_process_with_an_unknown_line_stays_as_it_is() {
        for unknown in ["for (i = 0; i < 2; i = i + 1) a = b;", "a <= b;", "end else begin", "a = b; c = d;"] {
            assert_eq!(processes(&format!("a = b;\n{unknown}\nc = d;")).len(), 1, "{unknown}");
        }
    }
}
