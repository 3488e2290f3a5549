//! The elements of a CamBam definition that contain a value instead of a template.

use pathbuild_diagnostic::Text;

use crate::number::NumberFormat;

/// The values of all elements that contain a value. Absent elements have their defaults.
#[derive(Clone, Debug, Default, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "the file's elements are independent switches")]
pub(super) struct Options {
    pub(super) number_format: NumberFormat,
    pub(super) end_of_line: Box<str>,
    pub(super) upper_case: bool,
    pub(super) add_line_numbers: bool,
    pub(super) numbering: Numbering,
    pub(super) arcs_as_lines: bool,
    /// Whether I and J are absolute coordinates of the centre.
    pub(super) absolute_centres: bool,
    /// Maximum distance between an arc and the lines that replace it, in the unit of the program.
    pub(super) arc_tolerance: f64,
    /// Arcs shorter than this are written as lines; in the unit of the program.
    pub(super) least_arc_length: f64,
    /// Arcs with a greater radius are written as lines; in the unit of the program.
    pub(super) greatest_arc_radius: f64,
    /// Whether arcs in G18 are written with the opposite direction.
    pub(super) invert_arcs: bool,
    /// Whether the tool descends to the clearance plane by rapid.
    pub(super) rapid_down: bool,
    /// Whether lines that are not G-code are accepted without a warning.
    pub(super) suppress_parser_errors: bool,
    pub(super) rotary: Rotary,
    pub(super) post_build_command: Box<str>,
    pub(super) post_build_arguments: Box<str>,
    /// Dialect of the output. The element is an extension of pathbuild.
    pub(super) dialect: Option<Box<str>>,
    /// Extension of the output file, without the dot. The element is an extension of pathbuild.
    pub(super) extension: Box<str>,
}

/// Settings for numbering the lines of the output.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Numbering {
    pub(super) start: u32,
    pub(super) increment: u32,
    pub(super) prefix: Box<str>,
    pub(super) format: NumberFormat,
    pub(super) space_after: bool,
    /// Lines that begin with one of these characters get no number and are not counted.
    pub(super) skip: Box<str>,
}

impl Numbering {
    /// Returns what line numbers begin with if it is not N: their prefix or, without a prefix, the first number. `None` if they begin with N.
    pub(super) fn unusual_number_prefix(&self) -> Option<String> {
        match &*self.prefix {
            "N" | "n" => None,
            "" => Some(self.format.format(self.start.into())),
            prefix => Some(prefix.to_owned()),
        }
    }
}

/// Settings for paths wrapped around a cylinder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Rotary {
    pub(super) wrap: bool,
    /// Axis parallel to the cylinder: 0 is X, 1 is Y.
    pub(super) along: usize,
    /// Index of the letter for the angle: 0 is A, 1 is B, 2 is C.
    pub(super) letter: usize,
}

/// The reason why an option could not be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum OptionError {
    /// No element has this name.
    Unknown,
    /// The value is not permitted. The text describes the permitted values.
    Expected(&'static Text),
}

/// An element that contains a value.
#[derive(Debug)]
pub(super) struct ElementOption {
    pub(super) element: &'static str,
    set: fn(&mut Options, &str) -> OptionResult<()>,
    /// Value if the element is absent, as it would be written in the file.
    pub(super) default: &'static str,
    /// Meaning of the value, for the book.
    pub(super) about: Text,
}

/// Permitted values of options that only concern lathes.
const ONLY_Z: Text =
    Text { en: "Z: lathes are not supported", de: "Z: Drehmaschinen werden nicht unterstützt" };
const ONLY_RADIUS: Text =
    Text { en: "Radius: lathes are not supported", de: "Radius: Drehmaschinen werden nicht unterstützt" };
const ONLY_FALSE: Text =
    Text { en: "false: lathes are not supported", de: "false: Drehmaschinen werden nicht unterstützt" };

/// Declares the elements that contain values. Each has its default, the function that reads its value, and its description in the book.
macro_rules! element_options {
    ($($element:literal = $default:literal, $set:expr, $en:literal, $de:literal;)*) => {
        pub(super) static OPTIONS: &[ElementOption] = &[$(ElementOption {
            element: $element,
            set: $set,
            default: $default,
            about: Text { en: $en, de: $de },
        },)*];
    };
}

element_options! {
    "NumberFormat" = "0.0###", |o, v| put(&mut o.number_format, pattern(v)),
        "pattern of all numbers", "Muster aller Zahlen";
    "EndOfLine" = "\\r\\n", |o, v| put(&mut o.end_of_line, end_of_line(v)),
        "line ends", "Zeilenenden";
    "UpperCase" = "false", |o, v| put(&mut o.upper_case, boolean(v)),
        "whether lines are written in capitals", "ob Zeilen in Großbuchstaben geschrieben werden";
    "AddLineNumbers" = "false", |o, v| put(&mut o.add_line_numbers, boolean(v)),
        "whether lines are numbered", "ob Zeilen nummeriert werden";
    "LineNumberStart" = "1", |o, v| put(&mut o.numbering.start, count(v)),
        "first number", "erste Nummer";
    "LineNumberIncrement" = "1", |o, v| put(&mut o.numbering.increment, count(v)),
        "from one number to the next", "von einer Nummer zur nächsten";
    "LineNumberPrefix" = "N", |o, v| put(&mut o.numbering.prefix, line_prefix(v)),
        "text in front of the number", "Text vor der Nummer";
    "LineNumberFormat" = "0", |o, v| put(&mut o.numbering.format, pattern(v)),
        "pattern of the number", "Muster der Nummer";
    "LineNumberSpaceAfter" = "true", |o, v| put(&mut o.numbering.space_after, boolean(v)),
        "whether a blank follows the number", "ob der Nummer ein Leerzeichen folgt";
    "LineNumberSkip" = "%O(:;", |o, v| put(&mut o.numbering.skip, Ok(text(v))),
        "lines that begin with one of these have no number",
        "Zeilen mit einem dieser Anfänge haben keine Nummer";
    "ArcOutput" = "Normal", |o, v| put(&mut o.arcs_as_lines, arc_output(v)),
        "whether arcs become lines", "ob Bögen zu Strecken werden";
    "ArcCenterMode" = "Incremental", |o, v| put(&mut o.absolute_centres, centre_mode(v)),
        "whether I and J are absolute or distances from the start of the arc", "ob I und J absolut oder Abstände vom Bogenanfang sind";
    "ArcToLinesTolerance" = "0.01", |o, v| put(&mut o.arc_tolerance, positive(v)),
        "greatest distance of a line from its arc, in the program's unit; at most 0.05 mm",
        "größter Abstand einer Strecke vom Bogen, in der Einheit des Programms; höchstens 0,05 mm";
    "MinimumArcLength" = "0.0001", |o, v| put(&mut o.least_arc_length, length(v)),
        "shorter arcs become lines", "kürzere Bögen werden Strecken";
    "MaximumArcRadius" = "1000000", |o, v| put(&mut o.greatest_arc_radius, positive(v)),
        "larger arcs become lines", "größere Bögen werden Strecken";
    "ClearancePlaneAxis" = "Z", |_, v| choice(v, &ONLY_Z, &[("Z", ())]),
        "only this value: lathes are not supported", "nur dieser Wert: Drehmaschinen sind nicht vorgesehen";
    "InvertArcs" = "false", |o, v| put(&mut o.invert_arcs, boolean(v)),
        "whether arcs in G18 turn the other way", "ob Bögen in G18 andersherum drehen";
    "RapidDownToClearance" = "true", |o, v| put(&mut o.rapid_down, boolean(v)),
        "whether the tool moves down to the clearance plane by a rapid move",
        "ob der Fräser im Eilgang zur Sicherheitsebene hinunterfährt";
    "SuppressParserErrors" = "false", |o, v| put(&mut o.suppress_parser_errors, boolean(v)),
        "whether lines that are no G-code pass without a warning",
        "ob Zeilen, die kein G-Code sind, ohne Warnung bleiben";
    "LatheXMode" = "Radius", |_, v| choice(v, &ONLY_RADIUS, &[("Radius", ())]),
        "only this value: lathes are not supported", "nur dieser Wert: Drehmaschinen sind nicht vorgesehen";
    "LatheToolRadiusOffset" = "false", |_, v| choice(v, &ONLY_FALSE, &[("false", ())]),
        "only this value: lathes are not supported", "nur dieser Wert: Drehmaschinen sind nicht vorgesehen";
    "RotaryWrap" = "false", |o, v| put(&mut o.rotary.wrap, boolean(v)),
        "whether paths are wrapped round a cylinder", "ob Pfade um einen Zylinder gewickelt werden";
    "AxisOfRotation" = "X", |o, v| put(&mut o.rotary.along, axis(v)),
        "the axis along the cylinder", "die Achse längs des Zylinders";
    "AxisOfSpin" = "X", |o, v| put(&mut o.rotary.along, axis(v)),
        "the same, as the manual calls it", "dasselbe, wie das Handbuch es nennt";
    "RotaryAxis" = "A", |o, v| put(&mut o.rotary.letter, rotary_axis(v)),
        "the letter of the angle", "der Buchstabe des Winkels";
    "PostBuildCommand" = "", |o, v| put(&mut o.post_build_command, Ok(text(v))),
        "program that is run on the file, only with `--run-post-build`",
        "Programm, das die Datei bearbeitet, nur mit `--run-post-build`";
    "PostBuildCommandArgs" = "", |o, v| put(&mut o.post_build_arguments, Ok(text(v))),
        "its arguments; no shell reads them", "seine Argumente; keine Shell liest sie";
    "Notes" = "", |_, _| Ok(()),
        "a comment on the definition", "ein Kommentar zur Definition";
    "Dialect" = "", |o, v| put(&mut o.dialect, Ok(optional_text(v))),
        "the dialect in which the output is read back", "der Dialekt, in dem die Ausgabe zurückgelesen wird";
    "FileExtension" = "nc", |o, v| put(&mut o.extension, extension(v)),
        "extension of the files that are written", "Endung der geschriebenen Dateien";
}

impl ElementOption {
    /// Whether the element is an extension of pathbuild, unknown to CamBam.
    pub(super) fn is_own(&self) -> bool {
        matches!(self.element, "Dialect" | "FileExtension")
    }

    /// Permitted values, or `None` if any text is permitted.
    pub(super) fn expected(&self) -> Option<&'static Text> {
        // No element that restricts its values permits this value.
        match (self.set)(&mut Options::default(), "\u{1}") {
            Err(OptionError::Expected(expected)) => Some(expected),
            Ok(()) | Err(OptionError::Unknown) => None,
        }
    }
}

impl Options {
    /// Returns the options of a definition that contains none of the elements.
    pub(super) fn initial() -> Self {
        let mut options = Self::default();
        for option in OPTIONS {
            // Setting a default cannot fail, because the default is a permitted value.
            _ = (option.set)(&mut options, option.default);
        }
        options
    }

    /// Sets the option of an element. The value may be padded with blanks.
    pub(super) fn set(&mut self, element: &str, text: &str) -> Result<(), OptionError> {
        let option = OPTIONS.iter().find(|option| option.element == element).ok_or(OptionError::Unknown)?;
        (option.set)(self, text)
    }
}

type OptionResult<T> = Result<T, OptionError>;

fn put<T>(option: &mut T, value: OptionResult<T>) -> OptionResult<()> {
    *option = value?;
    Ok(())
}

/// Parses a value that must be one of some choices, ignoring case and blanks, because files write `Convert To Lines` in several ways.
fn choice<T: Copy>(value: &str, expected: &'static Text, choices: &[(&str, T)]) -> OptionResult<T> {
    let plain = |text: &str| text.replace(' ', "").to_ascii_lowercase();
    let found = choices.iter().find(|(name, _)| plain(name) == plain(value.trim()));
    found.map(|(_, choice)| *choice).ok_or(OptionError::Expected(expected))
}

fn text(value: &str) -> Box<str> {
    value.trim().into()
}

/// Parses the letters before line numbers. Other letters are refused because they would be words of the line: with X, the number would be
/// a position.
fn line_prefix(value: &str) -> OptionResult<Box<str>> {
    let prefix = text(value);
    let is_known = matches!(&*prefix, "N" | "n" | ":" | "");
    if is_known { Ok(prefix) } else { Err(OptionError::Expected(&LINE_PREFIXES)) }
}

const LINE_PREFIXES: Text = Text { en: "N, a colon or nothing", de: "N, ein Doppelpunkt oder nichts" };

fn optional_text(value: &str) -> Option<Box<str>> {
    Some(text(value)).filter(|text| !text.is_empty())
}

fn rotary_axis(value: &str) -> OptionResult<usize> {
    choice(value, &Text { en: "A, B or C", de: "A, B oder C" }, &[("A", 0), ("B", 1), ("C", 2)])
}

fn axis(value: &str) -> OptionResult<usize> {
    choice(value, &Text { en: "X or Y", de: "X oder Y" }, &[("X", 0), ("Y", 1)])
}

fn boolean(value: &str) -> OptionResult<bool> {
    choice(value, &Text { en: "true or false", de: "true oder false" }, &[("true", true), ("false", false)])
}

fn arc_output(value: &str) -> OptionResult<bool> {
    choice(
        value,
        &Text { en: "Normal or ConvertToLines", de: "Normal oder ConvertToLines" },
        &[("Normal", false), ("ConvertToLines", true)],
    )
}

fn centre_mode(value: &str) -> OptionResult<bool> {
    choice(
        value,
        &Text { en: "Absolute or Incremental", de: "Absolute oder Incremental" },
        &[("Absolute", true), ("Incremental", false)],
    )
}

fn pattern(value: &str) -> OptionResult<NumberFormat> {
    value.trim().parse().map_err(|()| {
        OptionError::Expected(&Text {
            en: "a pattern of 0, # and at most one point",
            de: "ein Muster aus 0, # und höchstens einem Punkt",
        })
    })
}

fn count(value: &str) -> OptionResult<u32> {
    value
        .trim()
        .parse()
        .map_err(|_| OptionError::Expected(&Text { en: "a whole number", de: "eine ganze Zahl" }))
}

fn length(value: &str) -> OptionResult<f64> {
    let number = value.trim().parse().ok().filter(|length: &f64| length.is_finite() && *length >= 0.0);
    number.ok_or(OptionError::Expected(&Text { en: "a number of at least 0", de: "eine Zahl ab 0" }))
}

fn positive(value: &str) -> OptionResult<f64> {
    length(value)
        .ok()
        .filter(|length| *length > 0.0)
        .ok_or(OptionError::Expected(&Text { en: "a number above 0", de: "eine Zahl über 0" }))
}

/// Parses a line end. `\r` and `\n` may be escape sequences or the characters themselves. Symbols such as ` *` or `;` may precede them,
/// but words may not.
fn end_of_line(text: &str) -> OptionResult<Box<str>> {
    let value = text.trim_matches([' ', '\t']).replace("\\r", "\r").replace("\\n", "\n");
    let sign = value.trim_end_matches(['\r', '\n']);
    let end = &value[sign.len()..];
    let is_sign = sign.len() <= 8 && sign.chars().all(|c| c.is_ascii_punctuation() || c == ' ');
    if !is_sign || end.is_empty() || end.len() > 2 {
        return Err(OptionError::Expected(&Text {
            en: "\\r and \\n, optionally with other characters in front",
            de: "\\r und \\n, davor auch andere Zeichen",
        }));
    }
    // Keep the blanks before a symbol, up to eight.
    let blanks = if sign.is_empty() { 0 } else { text.len() - text.trim_start_matches([' ', '\t']).len() };
    Ok(format!("{}{value}", " ".repeat(blanks.min(8))).into())
}

fn extension(value: &str) -> OptionResult<Box<str>> {
    crate::extension(value.trim()).ok_or(OptionError::Expected(&Text {
        en: "a file name's extension",
        de: "die Endung eines Dateinamens",
    }))
}
