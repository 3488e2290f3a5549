//! The elements of a CamBam definition that contain a value instead of a template.

use pathbuild_diagnostic::Text;

use crate::number::NumberFormat;

/// All options, initially with the defaults for absent elements.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::struct_excessive_bools, reason = "the file's elements are independent switches")]
pub(super) struct Options {
    pub(super) number_format: NumberFormat,
    pub(super) end_of_line: Box<str>,
    pub(super) upper_case: bool,
    pub(super) add_line_numbers: bool,
    pub(super) numbering: Numbering,
    /// Whether arcs are written as lines.
    pub(super) arcs_as_lines: bool,
    /// Whether I and J are absolute.
    pub(super) absolute_centres: bool,
    /// Greatest distance between an arc and the lines that replace it, in the unit of the program.
    pub(super) arc_tolerance: f64,
    /// Arcs shorter than this are written as lines; in the unit of the program.
    pub(super) least_arc_length: f64,
    /// Arcs with a greater radius are written as lines; in the unit of the program.
    pub(super) greatest_arc_radius: f64,
    /// Whether arcs in G18 have the opposite direction.
    pub(super) invert_arcs: bool,
    /// Whether the tool descends to the clearance plane by rapid.
    pub(super) rapid_down: bool,
    /// Whether lines that are not G-code are accepted without warning.
    pub(super) suppress_parser_errors: bool,
    pub(super) rotary: Rotary,
    pub(super) post_build_command: Box<str>,
    pub(super) post_build_arguments: Box<str>,
    /// Dialect of the output (an element of pathbuild's own).
    pub(super) dialect: Option<Box<str>>,
    /// Extension of the output file, without the dot (an element of pathbuild's own).
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
    /// Lines that begin with one of these characters get no number and are not counted.
    pub(super) skip: Box<str>,
}

/// Settings for paths wrapped around a cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rotary {
    pub(super) wrap: bool,
    /// The axis parallel to the cylinder: 0 is X, 1 is Y.
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

/// Why an option could not be set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refusal {
    /// There is no such option.
    Unknown,
    /// The value is not one of these.
    Expected(&'static Text),
}

/// An element that contains a value.
#[derive(Debug)]
pub(super) struct ElementOption {
    /// Name of the element.
    pub(super) element: &'static str,
    set: fn(&mut Options, &str) -> OptionResult<()>,
    /// Default if the element is absent, as it would be written.
    pub(super) default: &'static str,
    /// Whether the element is unknown to CamBam.
    pub(super) is_own: bool,
    /// Meaning of the value, for the book.
    pub(super) about: Text,
}

/// All elements that contain values.
pub(super) static OPTIONS: &[ElementOption] = &[
    ElementOption {
        element: "NumberFormat",
        set: |o, v| put(&mut o.number_format, pattern(v.trim())),
        default: "0.0###",
        is_own: false,
        about: Text { en: "pattern of all numbers", de: "Muster aller Zahlen" },
    },
    ElementOption {
        element: "EndOfLine",
        set: |o, v| put(&mut o.end_of_line, end_of_line(v)),
        default: "\\r\\n",
        is_own: false,
        about: Text { en: "line ends", de: "Zeilenenden" },
    },
    ElementOption {
        element: "UpperCase",
        set: |o, v| put(&mut o.upper_case, boolean(v.trim())),
        default: "false",
        is_own: false,
        about: Text { en: "whether lines are written in capitals", de: "ob Zeilen groß geschrieben werden" },
    },
    ElementOption {
        element: "AddLineNumbers",
        set: |o, v| put(&mut o.add_line_numbers, boolean(v.trim())),
        default: "false",
        is_own: false,
        about: Text { en: "whether lines are numbered", de: "ob Zeilen nummeriert werden" },
    },
    ElementOption {
        element: "LineNumberStart",
        set: |o, v| put(&mut o.numbering.start, count(v.trim())),
        default: "1",
        is_own: false,
        about: Text { en: "first number", de: "erste Nummer" },
    },
    ElementOption {
        element: "LineNumberIncrement",
        set: |o, v| put(&mut o.numbering.increment, count(v.trim())),
        default: "1",
        is_own: false,
        about: Text { en: "from one number to the next", de: "von einer Nummer zur nächsten" },
    },
    ElementOption {
        element: "LineNumberPrefix",
        set: |o, v| put(&mut o.numbering.prefix, Ok(v.trim().into())),
        default: "N",
        is_own: false,
        about: Text { en: "text in front of the number", de: "Text vor der Nummer" },
    },
    ElementOption {
        element: "LineNumberFormat",
        set: |o, v| put(&mut o.numbering.format, pattern(v.trim())),
        default: "0",
        is_own: false,
        about: Text { en: "pattern of the number", de: "Muster der Nummer" },
    },
    ElementOption {
        element: "LineNumberSpaceAfter",
        set: |o, v| put(&mut o.numbering.space_after, boolean(v.trim())),
        default: "true",
        is_own: false,
        about: Text { en: "whether a blank follows the number", de: "ob der Nummer ein Leerzeichen folgt" },
    },
    ElementOption {
        element: "LineNumberSkip",
        set: |o, v| put(&mut o.numbering.skip, Ok(v.trim().into())),
        default: "%O(:;",
        is_own: false,
        about: Text {
            en: "lines that begin with one of these have no number",
            de: "Zeilen mit einem dieser Anfänge haben keine Nummer",
        },
    },
    ElementOption {
        element: "ArcOutput",
        set: |o, v| put(&mut o.arcs_as_lines, arc_output(v.trim())),
        default: "Normal",
        is_own: false,
        about: Text { en: "whether arcs become lines", de: "ob Bögen zu Strecken werden" },
    },
    ElementOption {
        element: "ArcCenterMode",
        set: |o, v| put(&mut o.absolute_centres, centre_mode(v.trim())),
        default: "Incremental",
        is_own: false,
        about: Text {
            en: "whether I and J are places or distances",
            de: "ob I und J Orte oder Abstände sind",
        },
    },
    ElementOption {
        element: "ArcToLinesTolerance",
        set: |o, v| put(&mut o.arc_tolerance, positive(v.trim())),
        default: "0.01",
        is_own: false,
        about: Text {
            en: "greatest distance of a line from its arc, in the program's unit",
            de: "größter Abstand einer Strecke vom Bogen, in der Einheit des Programms",
        },
    },
    ElementOption {
        element: "MinimumArcLength",
        set: |o, v| put(&mut o.least_arc_length, length(v.trim())),
        default: "0.0001",
        is_own: false,
        about: Text { en: "shorter arcs become lines", de: "kürzere Bögen werden Strecken" },
    },
    ElementOption {
        element: "MaximumArcRadius",
        set: |o, v| put(&mut o.greatest_arc_radius, positive(v.trim())),
        default: "1000000",
        is_own: false,
        about: Text { en: "larger arcs become lines", de: "größere Bögen werden Strecken" },
    },
    ElementOption {
        element: "ClearancePlaneAxis",
        set: |_, v| {
            choice(
                v.trim(),
                &Text { en: "Z: lathes are not supported", de: "Z: Drehmaschinen werden nicht unterstützt" },
                &[("Z", ())],
            )
        },
        default: "Z",
        is_own: false,
        about: Text {
            en: "only this value: lathes are not supported",
            de: "nur dieser Wert: Drehmaschinen sind nicht vorgesehen",
        },
    },
    ElementOption {
        element: "InvertArcs",
        set: |o, v| put(&mut o.invert_arcs, boolean(v.trim())),
        default: "false",
        is_own: false,
        about: Text {
            en: "whether arcs in G18 turn the other way",
            de: "ob Bögen in G18 andersherum drehen",
        },
    },
    ElementOption {
        element: "RapidDownToClearance",
        set: |o, v| put(&mut o.rapid_down, boolean(v.trim())),
        default: "true",
        is_own: false,
        about: Text {
            en: "whether the tool moves down to the clearance plane by a rapid move",
            de: "ob der Fräser im Eilgang zur Sicherheitsebene hinunterfährt",
        },
    },
    ElementOption {
        element: "SuppressParserErrors",
        set: |o, v| put(&mut o.suppress_parser_errors, boolean(v.trim())),
        default: "false",
        is_own: false,
        about: Text {
            en: "whether lines that are no G-code pass without a warning",
            de: "ob Zeilen, die kein G-Code sind, ohne Warnung bleiben",
        },
    },
    ElementOption {
        element: "LatheXMode",
        set: |_, v| {
            choice(
                v.trim(),
                &Text {
                    en: "Radius: lathes are not supported",
                    de: "Radius: Drehmaschinen werden nicht unterstützt",
                },
                &[("Radius", ())],
            )
        },
        default: "Radius",
        is_own: false,
        about: Text {
            en: "only this value: lathes are not supported",
            de: "nur dieser Wert: Drehmaschinen sind nicht vorgesehen",
        },
    },
    ElementOption {
        element: "LatheToolRadiusOffset",
        set: |_, v| {
            choice(
                v.trim(),
                &Text {
                    en: "false: lathes are not supported",
                    de: "false: Drehmaschinen werden nicht unterstützt",
                },
                &[("false", ())],
            )
        },
        default: "false",
        is_own: false,
        about: Text {
            en: "only this value: lathes are not supported",
            de: "nur dieser Wert: Drehmaschinen sind nicht vorgesehen",
        },
    },
    ElementOption {
        element: "RotaryWrap",
        set: |o, v| put(&mut o.rotary.wrap, boolean(v.trim())),
        default: "false",
        is_own: false,
        about: Text {
            en: "whether paths are wrapped round a cylinder",
            de: "ob Pfade um einen Zylinder gewickelt werden",
        },
    },
    ElementOption {
        element: "AxisOfRotation",
        set: |o, v| put(&mut o.rotary.along, axis(v.trim())),
        default: "X",
        is_own: false,
        about: Text { en: "the axis along the cylinder", de: "die Achse längs des Zylinders" },
    },
    ElementOption {
        element: "AxisOfSpin",
        set: |o, v| put(&mut o.rotary.along, axis(v.trim())),
        default: "X",
        is_own: false,
        about: Text { en: "the same, as the manual calls it", de: "dasselbe, wie das Handbuch es nennt" },
    },
    ElementOption {
        element: "RotaryAxis",
        set: |o, v| {
            put(
                &mut o.rotary.letter,
                choice(
                    v.trim(),
                    &Text { en: "A, B or C", de: "A, B oder C" },
                    &[("A", 0), ("B", 1), ("C", 2)],
                ),
            )
        },
        default: "A",
        is_own: false,
        about: Text { en: "the letter of the angle", de: "der Buchstabe des Winkels" },
    },
    ElementOption {
        element: "PostBuildCommand",
        set: |o, v| put(&mut o.post_build_command, Ok(v.trim().into())),
        default: "",
        is_own: false,
        about: Text {
            en: "program that is run on the file, only with `--run-post-build`",
            de: "Programm, das die Datei bearbeitet, nur mit `--run-post-build`",
        },
    },
    ElementOption {
        element: "PostBuildCommandArgs",
        set: |o, v| put(&mut o.post_build_arguments, Ok(v.trim().into())),
        default: "",
        is_own: false,
        about: Text {
            en: "its arguments; no shell reads them",
            de: "seine Argumente; keine Shell liest sie",
        },
    },
    ElementOption {
        element: "Notes",
        set: |_, _| Ok(()),
        default: "",
        is_own: false,
        about: Text { en: "a comment on the definition", de: "ein Kommentar zur Definition" },
    },
    ElementOption {
        element: "Dialect",
        set: |o, v| put(&mut o.dialect, Ok((!v.trim().is_empty()).then(|| v.trim().into()))),
        default: "",
        is_own: true,
        about: Text {
            en: "the dialect in which the output is read back",
            de: "der Dialekt, in dem die Ausgabe zurückgelesen wird",
        },
    },
    ElementOption {
        element: "FileExtension",
        set: |o, v| put(&mut o.extension, extension(v.trim())),
        default: "nc",
        is_own: true,
        about: Text { en: "extension of the files that are written", de: "Endung der geschriebenen Dateien" },
    },
];

impl ElementOption {
    /// Permitted values, or `None` if any text is permitted.
    pub(super) fn expected(&self) -> Option<&'static Text> {
        // This value is rejected by all elements that restrict their values.
        match (self.set)(&mut Options::default(), "\u{1}") {
            Err(Refusal::Expected(expected)) => Some(expected),
            Ok(()) | Err(Refusal::Unknown) => None,
        }
    }
}

impl Options {
    /// Sets the option of an element. The value may be padded with blanks.
    pub(super) fn set(&mut self, element: &str, text: &str) -> Result<(), Refusal> {
        let option = OPTIONS.iter().find(|option| option.element == element).ok_or(Refusal::Unknown)?;
        (option.set)(self, text)
    }
}

type OptionResult<T> = Result<T, Refusal>;

fn put<T>(option: &mut T, value: OptionResult<T>) -> OptionResult<()> {
    *option = value?;
    Ok(())
}

/// Compares without regard to case and blanks, because files spell `Convert To Lines` in several ways.
fn choice<T: Copy>(value: &str, expected: &'static Text, choices: &[(&str, T)]) -> OptionResult<T> {
    let plain = |text: &str| text.replace(' ', "").to_ascii_lowercase();
    let found = choices.iter().find(|(name, _)| plain(name) == plain(value));
    found.map(|(_, choice)| *choice).ok_or(Refusal::Expected(expected))
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
    value.parse().map_err(|()| {
        Refusal::Expected(&Text {
            en: "a pattern of 0, # and at most one point",
            de: "ein Muster aus 0, # und höchstens einem Punkt",
        })
    })
}

fn count(value: &str) -> OptionResult<u32> {
    value.parse().map_err(|_| Refusal::Expected(&Text { en: "a whole number", de: "eine ganze Zahl" }))
}

fn length(value: &str) -> OptionResult<f64> {
    let number = value.parse().ok().filter(|length: &f64| length.is_finite() && *length >= 0.0);
    number.ok_or(Refusal::Expected(&Text { en: "a number from 0", de: "eine Zahl ab 0" }))
}

fn positive(value: &str) -> OptionResult<f64> {
    length(value)
        .ok()
        .filter(|length| *length > 0.0)
        .ok_or(Refusal::Expected(&Text { en: "a number above 0", de: "eine Zahl über 0" }))
}

/// Parses a line end. `\r` and `\n` may be escape sequences or the characters themselves. They may be preceded by symbols such as ` *` or
/// `;`, but not by words.
fn end_of_line(text: &str) -> OptionResult<Box<str>> {
    let value = text.trim_matches([' ', '\t']).replace("\\r", "\r").replace("\\n", "\n");
    let sign = value.trim_end_matches(['\r', '\n']);
    let end = &value[sign.len()..];
    let is_sign = sign.len() <= 8 && sign.chars().all(|c| c.is_ascii_punctuation() || c == ' ');
    if !is_sign || end.is_empty() || end.len() > 2 {
        return Err(Refusal::Expected(&Text {
            en: "\\r and \\n, optionally with other characters in front",
            de: "\\r und \\n, davor auch andere Zeichen",
        }));
    }
    // Blanks before a symbol are part of it.
    let blanks = if sign.is_empty() { 0 } else { text.len() - text.trim_start_matches([' ', '\t']).len() };
    Ok(format!("{}{value}", " ".repeat(blanks.min(8))).into())
}

fn extension(value: &str) -> OptionResult<Box<str>> {
    crate::extension(value)
        .ok_or(Refusal::Expected(&Text { en: "a file name's extension", de: "die Endung eines Dateinamens" }))
}
