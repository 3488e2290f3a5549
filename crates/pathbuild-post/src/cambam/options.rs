//! The elements of a CamBam definition that hold a value instead of a template.

use crate::number::NumberFormat;

/// Every option, with the value that holds when its element is absent.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "the file's elements are independent switches")]
pub(super) struct Options {
    pub(super) number_format: NumberFormat,
    pub(super) end_of_line: Box<str>,
    pub(super) upper_case: bool,
    pub(super) add_line_numbers: bool,
    pub(super) numbering: Numbering,
    /// Arcs are written as lines.
    pub(super) arcs_as_lines: bool,
    /// I and J are absolute.
    pub(super) absolute_centres: bool,
    /// Greatest distance of a line from the arc that it stands for, in the program's unit.
    pub(super) arc_tolerance: f64,
    /// A shorter arc becomes a line; in the program's unit.
    pub(super) least_arc_length: f64,
    /// An arc with a greater radius becomes a line; in the program's unit.
    pub(super) greatest_arc_radius: f64,
    /// Arcs in G18 turn the other way.
    pub(super) invert_arcs: bool,
    /// The way down to the clearance plane is a rapid.
    pub(super) rapid_down: bool,
    /// Nothing is said about lines that are no G-code.
    pub(super) suppress_parser_errors: bool,
    pub(super) rotary: Rotary,
    pub(super) post_build_command: Box<str>,
    pub(super) post_build_arguments: Box<str>,
    /// The dialect that the output is in (pathbuild's own element).
    pub(super) dialect: Option<Box<str>>,
    /// Extension of the file that is written, without point (pathbuild's own element).
    pub(super) extension: Box<str>,
}

/// How lines are numbered.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Numbering {
    pub(super) start: u32,
    pub(super) increment: u32,
    pub(super) prefix: Box<str>,
    pub(super) format: NumberFormat,
    pub(super) space_after: bool,
    /// Lines that begin with one of these get no number, and are not counted.
    pub(super) skip: Box<str>,
}

/// Paths wrapped round a cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rotary {
    pub(super) wrap: bool,
    /// The axis along the cylinder: 0 is X, 1 is Y.
    pub(super) along: usize,
    /// The letter of the angle: 0 is A, 2 is C.
    pub(super) letter: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            number_format: NumberFormat::decimals(1, 4),
            end_of_line: "\r\n".into(),
            upper_case: false,
            add_line_numbers: false,
            numbering: Numbering {
                start: 1,
                increment: 1,
                prefix: "N".into(),
                format: NumberFormat::decimals(0, 0),
                space_after: true,
                skip: "%O(:;".into(),
            },
            arcs_as_lines: false,
            absolute_centres: false,
            arc_tolerance: 0.01,
            least_arc_length: 1e-4,
            greatest_arc_radius: 1e6,
            invert_arcs: false,
            rapid_down: true,
            suppress_parser_errors: false,
            rotary: Rotary { wrap: false, along: 0, letter: 0 },
            post_build_command: "".into(),
            post_build_arguments: "".into(),
            dialect: None,
            extension: "nc".into(),
        }
    }
}

/// Why an option is not set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refusal {
    /// No option has that name.
    Unknown,
    /// The value is not one of these.
    Expected(&'static str),
}

impl Options {
    /// Sets the option that an element holds. Values may be padded with blanks.
    pub(super) fn set(&mut self, element: &str, text: &str) -> Result<(), Refusal> {
        let value = text.trim();
        match element {
            "NumberFormat" => put(&mut self.number_format, pattern(value)),
            "EndOfLine" => put(&mut self.end_of_line, end_of_line(text)),
            "UpperCase" => put(&mut self.upper_case, boolean(value)),
            "AddLineNumbers" => put(&mut self.add_line_numbers, boolean(value)),
            "LineNumberStart" => put(&mut self.numbering.start, count(value)),
            "LineNumberIncrement" => put(&mut self.numbering.increment, count(value)),
            "LineNumberPrefix" => put(&mut self.numbering.prefix, Ok(value.into())),
            "LineNumberFormat" => put(&mut self.numbering.format, pattern(value)),
            "LineNumberSpaceAfter" => put(&mut self.numbering.space_after, boolean(value)),
            "LineNumberSkip" => put(&mut self.numbering.skip, Ok(value.into())),
            "ArcOutput" => put(&mut self.arcs_as_lines, arc_output(value)),
            "ArcCenterMode" => put(&mut self.absolute_centres, centre_mode(value)),
            "ArcToLinesTolerance" => put(&mut self.arc_tolerance, positive(value)),
            "MinimumArcLength" => put(&mut self.least_arc_length, length(value)),
            "MaximumArcRadius" => put(&mut self.greatest_arc_radius, positive(value)),
            // A lathe's programs would need other moves.
            "ClearancePlaneAxis" => choice(value, "Z: lathes are not supported", &[("Z", ())]),
            "InvertArcs" => put(&mut self.invert_arcs, boolean(value)),
            "RapidDownToClearance" => put(&mut self.rapid_down, boolean(value)),
            "SuppressParserErrors" => put(&mut self.suppress_parser_errors, boolean(value)),
            "LatheXMode" => choice(value, "Radius: lathes are not supported", &[("Radius", ())]),
            "LatheToolRadiusOffset" => choice(value, "false: lathes are not supported", &[("false", ())]),
            "RotaryWrap" => put(&mut self.rotary.wrap, boolean(value)),
            // The first is what files have, the second what the manual calls it.
            "AxisOfRotation" | "AxisOfSpin" => {
                put(&mut self.rotary.along, choice(value, "X or Y", &[("X", 0), ("Y", 1)]))
            }
            "RotaryAxis" => {
                put(&mut self.rotary.letter, choice(value, "A, B or C", &[("A", 0), ("B", 1), ("C", 2)]))
            }
            "PostBuildCommand" => put(&mut self.post_build_command, Ok(value.into())),
            "PostBuildCommandArgs" => put(&mut self.post_build_arguments, Ok(value.into())),
            // For who reads the file.
            "Notes" => Ok(()),
            "Dialect" => put(&mut self.dialect, Ok((!value.is_empty()).then(|| value.into()))),
            "FileExtension" => put(&mut self.extension, extension(value)),
            _ => Err(Refusal::Unknown),
        }
    }
}

type Read<T> = Result<T, Refusal>;

fn put<T>(option: &mut T, value: Read<T>) -> Read<()> {
    *option = value?;
    Ok(())
}

/// Case and blanks do not count: files spell `Convert To Lines` in several ways.
fn choice<T: Copy>(value: &str, expected: &'static str, choices: &[(&str, T)]) -> Read<T> {
    let plain = |text: &str| text.replace(' ', "").to_ascii_lowercase();
    let found = choices.iter().find(|(name, _)| plain(name) == plain(value));
    found.map(|(_, choice)| *choice).ok_or(Refusal::Expected(expected))
}

fn boolean(value: &str) -> Read<bool> {
    choice(value, "true or false", &[("true", true), ("false", false)])
}

fn arc_output(value: &str) -> Read<bool> {
    choice(value, "Normal or ConvertToLines", &[("Normal", false), ("ConvertToLines", true)])
}

fn centre_mode(value: &str) -> Read<bool> {
    choice(value, "Absolute or Incremental", &[("Absolute", true), ("Incremental", false)])
}

fn pattern(value: &str) -> Read<NumberFormat> {
    value.parse().map_err(|()| Refusal::Expected("a pattern of 0, # and at most one point"))
}

fn count(value: &str) -> Read<u32> {
    value.parse().map_err(|_| Refusal::Expected("a whole number"))
}

fn length(value: &str) -> Read<f64> {
    let number = value.parse().ok().filter(|length: &f64| length.is_finite() && *length >= 0.0);
    number.ok_or(Refusal::Expected("a number from 0"))
}

fn positive(value: &str) -> Read<f64> {
    length(value).ok().filter(|length| *length > 0.0).ok_or(Refusal::Expected("a number above 0"))
}

/// `\r` and `\n` stand for themselves or for the characters that they name. Signs may stand in front, such as ` *` or `;`, but no words.
fn end_of_line(text: &str) -> Read<Box<str>> {
    let value = text.trim_matches([' ', '\t']).replace("\\r", "\r").replace("\\n", "\n");
    let sign = value.trim_end_matches(['\r', '\n']);
    let end = &value[sign.len()..];
    let is_sign = sign.len() <= 8 && sign.chars().all(|c| c.is_ascii_punctuation() || c == ' ');
    if !is_sign || end.is_empty() || end.len() > 2 {
        return Err(Refusal::Expected("made of \\r and \\n, with at most signs in front"));
    }
    // Blanks in front of a sign belong to it.
    let blanks = if sign.is_empty() { 0 } else { text.len() - text.trim_start_matches([' ', '\t']).len() };
    Ok(format!("{}{value}", " ".repeat(blanks.min(8))).into())
}

fn extension(value: &str) -> Read<Box<str>> {
    crate::extension(value).ok_or(Refusal::Expected("a file name's extension"))
}
