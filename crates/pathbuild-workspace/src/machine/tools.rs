//! Tool tables and libraries: `LinuxCNC`'s `tool.tbl`, Fusion 360's JSON, FreeCAD's tool bits and libraries.
//!
//! Sources: "Tool Table" of the `LinuxCNC` documentation, exported libraries of Fusion 360 (`.json`, also within a `.tools` archive), and
//! `Path_ToolBit` of the FreeCAD documentation.

use pathbuild_diagnostic::messages::configuration::COUNT;
use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Message, Value as MessageValue};
use serde_json::{Map, Value};

use super::entries::rounded;
use super::{DescribedTool, DescribedValue, Description, Entry, LengthUnit, Quantity, broken_description};
use crate::config::is_too_round;

/// A function that returns the text of a tool bit named in a FreeCAD library.
pub(super) type ReadBit<'r> = &'r dyn Fn(&str) -> Result<String, MessageValue>;

/// Whether the text is a tool table of `LinuxCNC`: its first line that is neither empty nor a comment is the entry of a tool.
pub(super) fn is_table(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with(';'));
    lines.next().is_some_and(is_tool)
}

/// Whether a line begins with T and a number.
fn is_tool(line: &str) -> bool {
    let (words, _) = line.split_once(';').unwrap_or((line, ""));
    let first = words.split_whitespace().next().unwrap_or("").to_ascii_uppercase();
    number_after(&first, 'T').is_some()
}

/// Reads a `tool.tbl`. Its lengths are in the unit of the machine, which only the machine's ini file names.
pub(super) fn read_table(text: &str, unit: Option<LengthUnit>) -> Result<Description, Box<Diagnostic>> {
    let Some(unit) = unit else { return Err(Box::new(Diagnostic::new(&say::TABLE_WITHOUT_UNIT))) };
    let mut description = Description::new("LinuxCNC");
    for (index, line) in text.lines().enumerate() {
        let (words, comment) = line.split_once(';').unwrap_or((line, ""));
        if words.trim().is_empty() {
            continue;
        }
        if !is_tool(words) {
            return Err(broken_description(
                "a line of a tool table that does not begin with T and a number",
                index + 1,
            ));
        }
        // LinuxCNC reads small letters too.
        let words = words.to_ascii_uppercase();
        let place = u32::try_from(index + 1).ok();
        let find = |letter| words.split_whitespace().find_map(|word| number_after(word, letter));
        let mut tool = DescribedTool::new(comment.trim(), place);
        tool.number = description.tool_number(
            "T",
            words.split_whitespace().find_map(|word| word.strip_prefix('T')),
            place,
        );
        match find('D').filter(|diameter| *diameter > 0.0) {
            Some(diameter) => tool.set_length("diameter", diameter, unit, "D"),
            None => description.report_missing_diameter(&tool),
        }
        // A tool table does not contain the shape of the tip.
        tool.set_tip(None);
        let others = words.split_whitespace().filter(|word| !word.starts_with(['T', 'D']));
        description.unused.extend(others.map(|word| {
            let (name, value) = word.split_at(word.chars().next().map_or(0, char::len_utf8));
            Entry { name: name.to_owned(), value: value.to_owned(), line: place }
        }));
        description.add(tool);
    }
    Ok(description)
}

fn number_after(word: &str, letter: char) -> Option<f64> {
    word.strip_prefix(letter)?.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Reads a library of Fusion 360, or a tool bit or library of FreeCAD.
pub(super) fn read_json(text: &str, bit: ReadBit<'_>) -> Result<Description, Box<Diagnostic>> {
    let root: Value =
        serde_json::from_str(text).map_err(|error| broken_description(&error.to_string(), error.line()))?;
    if let Some(library) = root.get("data").and_then(Value::as_array) {
        Ok(read_fusion_library(library, &object_lines(text)))
    } else if let Some(list) = root.get("tools").and_then(Value::as_array) {
        read_freecad_library(list, &object_lines(text), bit)
    } else if root.get("parameter").is_some_and(Value::is_object) {
        let mut description = Description::new("FreeCAD");
        read_freecad_bit(&root, None, None, &mut description);
        Ok(description)
    } else {
        Err(Box::new(Diagnostic::new(&say::UNKNOWN_FORMAT)))
    }
}

/// Returns the line of each object in the arrays of the root object.
fn object_lines(text: &str) -> Vec<u32> {
    let (mut lines, mut line, mut depth, mut is_string, mut is_escaped) =
        (Vec::new(), 1_u32, 0_u32, false, false);
    for byte in text.bytes() {
        match byte {
            _ if std::mem::take(&mut is_escaped) => {}
            b'\\' => is_escaped = is_string,
            b'"' => is_string = !is_string,
            b'\n' => line = line.saturating_add(1),
            b'{' | b'[' if !is_string => {
                if byte == b'{' && depth == 2 {
                    lines.push(line);
                }
                depth = depth.saturating_add(1);
            }
            b'}' | b']' if !is_string => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    lines
}

/// Returns the line of an entry of a library; `None` if the file contains objects other than the entries, so that the lines are unclear.
fn line_of(index: usize, library: &[Value], lines: &[u32]) -> Option<u32> {
    lines.get(index).copied().filter(|_| lines.len() == library.len())
}

fn read_fusion_library(library: &[Value], lines: &[u32]) -> Description {
    let mut description = Description::new("Fusion 360");
    for (index, entry) in library.iter().enumerate() {
        let line = line_of(index, library, lines);
        let mut fields = Fields::new(entry);
        let kind = fields.text("type").unwrap_or_default();
        if matches!(&*kind, "holder" | "probe") {
            description.unused.extend(fields.unused());
            continue;
        }
        let mut tool = DescribedTool::new(&fields.text("description").unwrap_or_default(), line);
        let number = fields.take("post-process/number").map(|number| value_as_text(&number));
        tool.number = description.tool_number("post-process/number", number.as_deref(), line);
        let unit = match fields.text("unit").as_deref() {
            Some("inches") => Some(LengthUnit::Inch),
            Some("millimeters") => Some(LengthUnit::Millimetre),
            _ => None,
        };
        let diameter = fields.number("geometry/DC").filter(|diameter| *diameter > 0.0);
        match diameter.zip(unit) {
            Some((diameter, unit)) => {
                tool.set_length("diameter", diameter, unit, "geometry/DC");
                tool.set_length("length", fields.number("geometry/LCF").unwrap_or(0.0), unit, "geometry/LCF");
                let radius = fields.number("geometry/RE");
                let radius = match &*kind {
                    "flat end mill" | "face mill" | "slot mill" => Some(radius.unwrap_or(0.0)),
                    "bull nose end mill" => radius,
                    "ball end mill" => Some(diameter / 2.0),
                    _ => None,
                };
                tool.set_tip(radius.map(|radius| (radius, unit)));
            }
            None => description.report_missing_diameter(&tool),
        }
        tool.set_flutes(fields.number("geometry/NOF"), "geometry/NOF");
        description.unused.extend(fields.unused());
        description.add(tool);
    }
    description
}

fn read_freecad_library(
    list: &[Value],
    lines: &[u32],
    bit: ReadBit<'_>,
) -> Result<Description, Box<Diagnostic>> {
    let mut description = Description::new("FreeCAD");
    for (index, entry) in list.iter().enumerate() {
        let line = line_of(index, list, lines);
        let mut fields = Fields::new(entry);
        let number = fields.take("nr").map(|number| value_as_text(&number));
        let number = description.tool_number("nr", number.as_deref(), line);
        let Some(name) = fields.text("path") else {
            description.unused.extend(fields.unused());
            continue;
        };
        let unreadable = |reason: MessageValue| {
            let problem = Diagnostic::new(&say::BIT_UNREADABLE).quoting("name", name.as_str());
            problem.with("reason", reason)
        };
        match bit(&name) {
            Ok(text) => {
                let bit: Value = serde_json::from_str(&text)
                    .map_err(|error| Box::new(unreadable(MessageValue::foreign(error.to_string()))))?;
                read_freecad_bit(&bit, number, line, &mut description);
            }
            Err(reason) => description.problems.push(unreadable(reason)),
        }
        description.unused.extend(fields.unused());
    }
    Ok(description)
}

fn read_freecad_bit(bit: &Value, number: Option<u32>, line: Option<u32>, description: &mut Description) {
    let mut fields = Fields::new(bit);
    let mut tool =
        DescribedTool { number, ..DescribedTool::new(&fields.text("name").unwrap_or_default(), line) };
    let shape = fields.text("shape-type").or_else(|| fields.text("shape")).unwrap_or_default();
    let shape = shape.to_ascii_lowercase();
    let shape = shape.strip_suffix(".fcstd").unwrap_or(&shape);
    let length =
        |fields: &mut Fields, name: &str| length_with_unit(&fields.text(&format!("parameter/{name}"))?);
    let diameter = length(&mut fields, "Diameter").filter(|(diameter, _)| *diameter > 0.0);
    if let Some((diameter, unit)) = diameter {
        tool.set_length("diameter", diameter, unit, "parameter/Diameter");
        let radius = match shape {
            "endmill" => Some((0.0, unit)),
            "ballend" => Some((diameter / 2.0, unit)),
            // The older name `FlatRadius` is ignored: its meaning differs between versions.
            "bullnose" => length(&mut fields, "CornerRadius"),
            _ => None,
        };
        tool.set_tip(radius);
    } else {
        description.report_missing_diameter(&tool);
    }
    if let Some((height, unit)) = length(&mut fields, "CuttingEdgeHeight") {
        tool.set_length("length", height, unit, "parameter/CuttingEdgeHeight");
    }
    for name in ["attribute/Flutes", "parameter/Flutes"] {
        tool.set_flutes(fields.number(name), name);
    }
    description.unused.extend(fields.unused());
    description.add(tool);
}

/// Reads a length with its unit, such as `5.0000 mm` or `0.25 in`.
fn length_with_unit(text: &str) -> Option<(f64, LengthUnit)> {
    let text = text.trim();
    let digits =
        text.find(|c: char| !c.is_ascii_digit() && !matches!(c, '.' | '-' | '+')).unwrap_or(text.len());
    let (number, unit) = text.split_at(digits);
    let unit = match unit.trim() {
        "mm" => LengthUnit::Millimetre,
        "in" | "\"" => LengthUnit::Inch,
        _ => return None,
    };
    number.parse().ok().filter(|number: &f64| number.is_finite()).map(|number| (number, unit))
}

/// The values of a JSON object by their paths, such as `geometry/DC`. Values are removed when they are used.
struct Fields {
    values: Map<String, Value>,
}

impl Fields {
    fn new(object: &Value) -> Self {
        let mut values = Map::new();
        flatten("", object, &mut values);
        Self { values }
    }

    fn take(&mut self, name: &str) -> Option<Value> {
        self.values.remove(name)
    }

    fn text(&mut self, name: &str) -> Option<String> {
        Some(value_as_text(&self.take(name)?))
    }

    /// Takes a number, which FreeCAD also writes as a string.
    fn number(&mut self, name: &str) -> Option<f64> {
        value_as_text(&self.take(name)?).parse().ok().filter(|number: &f64| number.is_finite())
    }

    fn unused(self) -> impl Iterator<Item = Entry> {
        self.values.into_iter().map(|(name, value)| Entry { name, value: value_as_text(&value), line: None })
    }
}

fn flatten(prefix: &str, value: &Value, values: &mut Map<String, Value>) {
    match value {
        Value::Object(object) => {
            for (name, value) in object {
                let name = if prefix.is_empty() { name.clone() } else { format!("{prefix}/{name}") };
                flatten(&name, value, values);
            }
        }
        value => _ = values.insert(prefix.to_owned(), value.clone()),
    }
}

fn value_as_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

impl DescribedTool {
    fn new(name: &str, line: Option<u32>) -> Self {
        Self { name: name.trim().to_owned(), line, ..Self::default() }
    }

    fn set(&mut self, key: &'static str, value: Quantity, source: &str) {
        self.values.push(DescribedValue { key, value, source: source.to_owned(), is_for_new_tools: false });
    }

    /// Sets a length if it is greater than 0.
    fn set_length(&mut self, key: &'static str, length: f64, unit: LengthUnit, source: &str) {
        if length > 0.0 {
            self.set(key, Quantity::Number(rounded(length * unit.millimetres())), source);
        }
    }

    fn set_flutes(&mut self, flutes: Option<f64>, source: &str) {
        if let Some(flutes) = flutes.filter(|flutes| *flutes > 0.0 && flutes.fract() == 0.0) {
            self.set("flutes", Quantity::Number(flutes), source);
        }
    }

    /// Sets the corner radius, which is 0 for a flat tip. `None` means that the tip has another shape or is unknown, and sets `shape` to "other" for
    /// tools that the configuration does not contain yet.
    fn set_tip(&mut self, radius: Option<(f64, LengthUnit)>) {
        if let Some((radius, unit)) = radius {
            self.set_length("corner-radius", radius, unit, "type");
        } else {
            let (value, source) = (Quantity::Text("other".to_owned()), "type".to_owned());
            self.values.push(DescribedValue { key: "shape", value, source, is_for_new_tools: true });
        }
    }

    fn number_of(&self, key: &str) -> Option<f64> {
        self.values.iter().find_map(|given| match given.value {
            Quantity::Number(number) if given.key == key => Some(number),
            _ => None,
        })
    }

    fn problem(&self, message: &'static Message) -> Diagnostic {
        let problem = Diagnostic::new(message).quoting("name", self.name.as_str());
        problem.with("number", u64::from(self.number.unwrap_or_default())).at_line(self.line, None)
    }
}

impl Description {
    /// Reads the number of a tool; 0 means that the tool has no number.
    fn tool_number(&mut self, name: &str, text: Option<&str>, line: Option<u32>) -> Option<u32> {
        let text = text?;
        match text.parse() {
            Ok(0) => None,
            Ok(number) => Some(number),
            Err(_) => {
                let problem = Diagnostic::new(&say::VALUE_NOT_TAKEN).quoting("name", name);
                let problem = problem.quoting("value", text).with("expected", MessageValue::Prose(&COUNT));
                self.problems.push(problem.at_line(line, None));
                None
            }
        }
    }

    /// Reports a tool without a diameter, or with a diameter in an unknown unit.
    fn report_missing_diameter(&mut self, tool: &DescribedTool) {
        self.problems.push(tool.problem(&say::NO_DIAMETER));
    }

    /// Adds a tool. Leaves it out if it has an impossible corner radius, or no diameter, which the configuration requires.
    fn add(&mut self, mut tool: DescribedTool) {
        let Some(diameter) = tool.number_of("diameter") else { return };
        let radius = tool.number_of("corner-radius").unwrap_or_default();
        if is_too_round(radius, diameter) {
            let problem = tool.problem(&say::CORNER_TOO_ROUND);
            self.problems.push(problem.with("radius", radius).with("diameter", diameter));
            return;
        }
        if let Some(number) = tool.number {
            tool.set("number", Quantity::Number(f64::from(number)), "T");
        }
        tool.values.sort_by_key(|value| value.is_for_new_tools);
        self.tools.push(tool);
    }
}
