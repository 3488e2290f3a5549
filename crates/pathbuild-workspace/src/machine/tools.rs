//! Tool tables and libraries: `LinuxCNC`'s `tool.tbl`, Fusion 360's JSON, FreeCAD's tool bits and libraries.
//!
//! Sources: "Tool Table" of the `LinuxCNC` documentation, exported libraries of Fusion 360 (`.json`, also within a `.tools` archive), and
//! `Path_ToolBit` of the FreeCAD documentation.

use pathbuild_diagnostic::messages::configuration::COUNT;
use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Value as Shown};
use serde_json::{Map, Value};

use super::entries::rounded;
use super::{
    DescribedTool, DescribedValue, Description, Entry, LengthUnit, Quantity, Target, broken_description,
};
use crate::config::is_too_round;

/// A function that returns the text of a tool bit named in a FreeCAD library.
pub(super) type ReadBit<'r> = &'r dyn Fn(&str) -> Result<String, Shown>;

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
    let mut tools = Tools::new("LinuxCNC");
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
        let mut tool = ToolDescription::new(comment.trim(), place);
        tool.number =
            tools.tool_number("T", words.split_whitespace().find_map(|word| word.strip_prefix('T')), place);
        match find('D').filter(|diameter| *diameter > 0.0) {
            Some(diameter) => tool.length("diameter", diameter, unit, "D"),
            None => tools.report_missing_diameter(&tool),
        }
        // A tool table does not contain the shape of the tip.
        tool.shape(None);
        let others = words.split_whitespace().filter(|word| !word.starts_with(['T', 'D']));
        tools.unused.extend(others.map(|word| {
            let (name, value) = word.split_at(word.chars().next().map_or(0, char::len_utf8));
            Entry { name: name.to_owned(), value: value.to_owned(), line: place }
        }));
        tools.add(tool);
    }
    Ok(tools.finish())
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
        let mut tools = Tools::new("FreeCAD");
        read_freecad_bit(&root, None, None, &mut tools);
        Ok(tools.finish())
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
    let mut tools = Tools::new("Fusion 360");
    for (index, entry) in library.iter().enumerate() {
        let line = line_of(index, library, lines);
        let mut fields = Fields::new(entry);
        let kind = fields.text("type").unwrap_or_default();
        if matches!(&*kind, "holder" | "probe") {
            tools.unused.extend(fields.unused());
            continue;
        }
        let mut tool = ToolDescription::new(&fields.text("description").unwrap_or_default(), line);
        let number = fields.take("post-process/number").map(|number| value_as_text(&number));
        tool.number = tools.tool_number("post-process/number", number.as_deref(), line);
        let unit = match fields.text("unit").as_deref() {
            Some("inches") => Some(LengthUnit::Inch),
            Some("millimeters") => Some(LengthUnit::Millimetre),
            _ => None,
        };
        let diameter = fields.number("geometry/DC").filter(|diameter| *diameter > 0.0);
        match diameter.zip(unit) {
            Some((diameter, unit)) => {
                tool.length("diameter", diameter, unit, "geometry/DC");
                tool.length("length", fields.number("geometry/LCF").unwrap_or(0.0), unit, "geometry/LCF");
                let radius = fields.number("geometry/RE");
                let radius = match &*kind {
                    "flat end mill" | "face mill" | "slot mill" => Some(radius.unwrap_or(0.0)),
                    "bull nose end mill" => radius,
                    "ball end mill" => Some(diameter / 2.0),
                    _ => None,
                };
                tool.shape(radius.map(|radius| (radius, unit)));
            }
            None => tools.report_missing_diameter(&tool),
        }
        tool.flutes(fields.number("geometry/NOF"), "geometry/NOF");
        tools.unused.extend(fields.unused());
        tools.add(tool);
    }
    tools.finish()
}

fn read_freecad_library(
    list: &[Value],
    lines: &[u32],
    bit: ReadBit<'_>,
) -> Result<Description, Box<Diagnostic>> {
    let mut tools = Tools::new("FreeCAD");
    for (index, entry) in list.iter().enumerate() {
        let line = line_of(index, list, lines);
        let mut fields = Fields::new(entry);
        let number = fields.take("nr").map(|number| value_as_text(&number));
        let number = tools.tool_number("nr", number.as_deref(), line);
        let Some(name) = fields.text("path") else {
            tools.unused.extend(fields.unused());
            continue;
        };
        let unreadable = |reason: Shown| {
            let problem = Diagnostic::new(&say::BIT_UNREADABLE).quoting("name", name.as_str());
            problem.with("reason", reason)
        };
        match bit(&name) {
            Ok(text) => {
                let bit: Value = serde_json::from_str(&text)
                    .map_err(|error| Box::new(unreadable(Shown::foreign(error.to_string()))))?;
                read_freecad_bit(&bit, number, line, &mut tools);
            }
            Err(reason) => tools.problems.push(unreadable(reason)),
        }
        tools.unused.extend(fields.unused());
    }
    Ok(tools.finish())
}

fn read_freecad_bit(bit: &Value, number: Option<u32>, line: Option<u32>, tools: &mut Tools) {
    let mut fields = Fields::new(bit);
    let mut tool =
        ToolDescription { number, ..ToolDescription::new(&fields.text("name").unwrap_or_default(), line) };
    let shape = fields.text("shape-type").or_else(|| fields.text("shape")).unwrap_or_default();
    let shape = shape.to_ascii_lowercase();
    let shape = shape.strip_suffix(".fcstd").unwrap_or(&shape);
    let length =
        |fields: &mut Fields, name: &str| length_with_unit(&fields.text(&format!("parameter/{name}"))?);
    let diameter = length(&mut fields, "Diameter").filter(|(diameter, _)| *diameter > 0.0);
    if let Some((diameter, unit)) = diameter {
        tool.length("diameter", diameter, unit, "parameter/Diameter");
        let radius = match shape {
            "endmill" => Some((0.0, unit)),
            "ballend" => Some((diameter / 2.0, unit)),
            // The older name `FlatRadius` is ignored: its meaning differs between versions.
            "bullnose" => length(&mut fields, "CornerRadius"),
            _ => None,
        };
        tool.shape(radius);
    } else {
        tools.report_missing_diameter(&tool);
    }
    if let Some((height, unit)) = length(&mut fields, "CuttingEdgeHeight") {
        tool.length("length", height, unit, "parameter/CuttingEdgeHeight");
    }
    for name in ["attribute/Flutes", "parameter/Flutes"] {
        tool.flutes(fields.number(name), name);
    }
    tools.unused.extend(fields.unused());
    tools.add(tool);
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

#[derive(Debug, Default)]
struct ToolDescription {
    name: String,
    number: Option<u32>,
    line: Option<u32>,
    values: Vec<(&'static str, Quantity, String)>,
    /// Value of `shape`, set only for tools that the configuration does not contain yet.
    shape: Option<Quantity>,
}

impl ToolDescription {
    fn new(name: &str, line: Option<u32>) -> Self {
        Self { name: name.trim().to_owned(), line, ..Self::default() }
    }

    /// Sets a length if it is greater than 0.
    fn length(&mut self, key: &'static str, length: f64, unit: LengthUnit, source: &str) {
        if length > 0.0 {
            let millimetres = rounded(length * unit.millimetres());
            self.values.push((key, Quantity::Number(millimetres), source.to_owned()));
        }
    }

    fn number_of(&self, key: &str) -> Option<f64> {
        self.values.iter().find_map(|(known, quantity, _)| match quantity {
            Quantity::Number(number) if *known == key => Some(*number),
            _ => None,
        })
    }

    fn flutes(&mut self, flutes: Option<f64>, source: &str) {
        if let Some(flutes) = flutes.filter(|flutes| *flutes > 0.0 && flutes.fract() == 0.0) {
            self.values.push(("flutes", Quantity::Number(flutes), source.to_owned()));
        }
    }

    /// Sets the corner radius, which is 0 for a flat tip. `None` means that the tip has another shape or is unknown, and sets `shape` to "other".
    fn shape(&mut self, radius: Option<(f64, LengthUnit)>) {
        match radius {
            Some((radius, unit)) => self.length("corner-radius", radius, unit, "type"),
            None => self.shape = Some(Quantity::Text("other".to_owned())),
        }
    }
}

struct Tools {
    format: &'static str,
    described: Vec<DescribedTool>,
    unused: Vec<Entry>,
    problems: Vec<Diagnostic>,
}

impl Tools {
    fn new(format: &'static str) -> Self {
        Self { format, described: Vec::new(), unused: Vec::new(), problems: Vec::new() }
    }

    /// Reads the number of a tool; 0 means that the tool has no number.
    fn tool_number(&mut self, name: &str, text: Option<&str>, line: Option<u32>) -> Option<u32> {
        let text = text?;
        match text.parse() {
            Ok(0) => None,
            Ok(number) => Some(number),
            Err(_) => {
                let problem = Diagnostic::new(&say::VALUE_NOT_TAKEN).quoting("name", name);
                let problem = problem.quoting("value", text).with("expected", Shown::Prose(&COUNT));
                self.problems.push(problem.at_line(line, None));
                None
            }
        }
    }

    /// Reports a tool without a diameter, or with a diameter in an unknown unit.
    fn report_missing_diameter(&mut self, tool: &ToolDescription) {
        let problem = Diagnostic::new(&say::NO_DIAMETER).quoting("name", tool.name.as_str());
        let problem = problem.with("number", u64::from(tool.number.unwrap_or_default()));
        self.problems.push(problem.at_line(tool.line, None));
    }

    /// Adds a tool. Leaves it out if it has an impossible corner radius, or no diameter, which the configuration requires.
    fn add(&mut self, tool: ToolDescription) {
        let Some(diameter) = tool.number_of("diameter") else { return };
        let radius = tool.number_of("corner-radius").unwrap_or_default();
        if is_too_round(radius, diameter) {
            let problem = Diagnostic::new(&say::CORNER_TOO_ROUND).quoting("name", tool.name.as_str());
            let problem = problem.with("number", u64::from(tool.number.unwrap_or_default()));
            self.problems
                .push(problem.with("radius", radius).with("diameter", diameter).at_line(tool.line, None));
            return;
        }
        let target = Target::Tool { number: tool.number, name: tool.name.clone() };
        let value = |key, value, source, is_for_new_tools| DescribedValue {
            target: target.clone(),
            key,
            value,
            source,
            is_for_new_tools,
        };
        let number = tool
            .number
            .map(|number| value("number", Quantity::Number(f64::from(number)), "T".to_owned(), false));
        let shape = tool.shape.map(|shape| value("shape", shape, "type".to_owned(), true));
        let values =
            tool.values.into_iter().map(|(key, quantity, source)| value(key, quantity, source, false));
        let values = values.chain(number).chain(shape).collect();
        self.described.push(DescribedTool { number: tool.number, name: tool.name, line: tool.line, values });
    }

    fn finish(self) -> Description {
        let Self { format, described: tools, unused, problems } = self;
        Description { format, values: Vec::new(), tools, unused, problems }
    }
}
