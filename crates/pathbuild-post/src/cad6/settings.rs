//! The settings of a definition besides its texts.

use pathbuild_diagnostic::Text;
use toml::de::{DeFloat, DeInteger, DeValue};

use crate::Units;

/// The table `[post]`.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) name: Box<str>,
    pub(super) extension: Box<str>,
    pub(super) end_of_line: &'static str,
    pub(super) decimals: usize,
    /// Unit of the output; `None` means that of the program.
    pub(super) units: Option<Units>,
    pub(super) number_lines: bool,
    /// Whether trailing blanks of lines are removed.
    pub(super) trim: bool,
    pub(super) dialect: Option<Box<str>>,
    /// Greatest distance between an arc and the lines that replace it, in mm.
    pub(super) arc_tolerance: f64,
    /// Widest sweep of an arc in degrees; wider arcs are split.
    pub(super) arc_sweep: f64,
    /// Whether the descent from one pass to the next may be replaced by retracting the tool and plunging again.
    pub(super) lift_between_passes: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            name: "".into(),
            extension: "nc".into(),
            end_of_line: "\n",
            decimals: 3,
            units: None,
            number_lines: true,
            trim: true,
            dialect: None,
            arc_tolerance: 0.01,
            arc_sweep: 360.0,
            lift_between_passes: false,
        }
    }
}

/// A key of `[post]`.
pub(super) struct Setting {
    /// The key.
    pub(super) name: &'static str,
    /// Permitted values.
    pub(super) expected: &'static Text,
    /// Applies a value; returns `None` if the value is not permitted.
    pub(super) set: fn(&mut Settings, &DeValue<'_>) -> Option<()>,
    /// Meaning and default, for the book.
    pub(super) about: Text,
}

/// Declares the keys of `[post]`: each with how its value is read, the permitted values, and meaning and default for the book.
macro_rules! settings {
    ($($name:literal $set:expr, $expected_en:literal, $expected_de:literal, $en:literal, $de:literal;)*) => {
        /// All keys of `[post]`.
        pub(super) static SETTINGS: &[Setting] = &[$(Setting {
            name: $name,
            expected: &Text { en: $expected_en, de: $expected_de },
            set: $set,
            about: Text { en: $en, de: $de },
        },)*];
    };
}

settings! {
    "name" |s, v| put(&mut s.name, text(v)), "a text", "ein Text",
        "name of the post", "Name des Postprozessors";
    "description" |_, v| v.as_str().map(drop), "a text", "ein Text",
        "a comment on the definition", "ein Kommentar zur Definition";
    "extension" |s, v| put(&mut s.extension, extension(v)), "a file name's extension", "die Endung eines Dateinamens",
        "extension of the files that are written; `nc` without it",
        "Endung der geschriebenen Dateien; sonst `nc`";
    "end-of-line" |s, v| put(&mut s.end_of_line, end_of_line(v)), "lf or crlf", "lf oder crlf",
        "line ends; `lf` without it", "Zeilenenden; sonst `lf`";
    "decimals" |s, v| put(&mut s.decimals, decimals(v)), "a whole number up to 9", "eine ganze Zahl bis 9",
        "decimals of rounded numbers; 3 without it", "Nachkommastellen gerundeter Zahlen; sonst 3";
    "units" |s, v| put(&mut s.units, units(v).map(Some)), "mm or inch", "mm oder inch",
        "unit of all lengths; that of the program without it",
        "Einheit aller Längen; sonst die des Programms";
    "number-lines" |s, v| put(&mut s.number_lines, v.as_bool()), "true or false", "true oder false",
        "whether `line-number` is called; `true` without it", "ob `line-number` aufgerufen wird; sonst `true`";
    "trim" |s, v| put(&mut s.trim, v.as_bool()), "true or false", "true oder false",
        "whether blanks at line ends are removed; `true` without it",
        "ob Leerzeichen am Zeilenende entfallen; sonst `true`";
    "dialect" |s, v| put(&mut s.dialect, text(v).map(Some)), "a text", "ein Text",
        "the dialect in which the output is read back", "der Dialekt, in dem die Ausgabe zurückgelesen wird";
    "arc-tolerance" |s, v| put(&mut s.arc_tolerance, positive(v)), "mm above 0", "mm über 0",
        "greatest distance of a line from the arc that it stands for; 0.01 without it",
        "größter Abstand einer Strecke vom Bogen, für den sie steht; sonst 0.01";
    "arc-sweep" |s, v| put(&mut s.arc_sweep, sweep(v)), "degrees from 10 to 360", "Grad von 10 bis 360",
        "largest angle of an arc, larger ones are divided; 360 without it",
        "größter Winkel eines Bogens, größere werden geteilt; sonst 360";
    "lift-between-passes" |s, v| put(&mut s.lift_between_passes, v.as_bool()), "true or false", "true oder false",
        "whether the tool may be lifted out between two passes instead of going down in the cut; `false` without it",
        "ob das Werkzeug zwischen zwei Zustellungen herausgehoben werden darf, statt im Schnitt abwärts zu fahren; sonst `false`";
}

fn put<T>(setting: &mut T, value: Option<T>) -> Option<()> {
    *setting = value?;
    Some(())
}

fn text(value: &DeValue<'_>) -> Option<Box<str>> {
    value.as_str().map(Into::into)
}

fn extension(value: &DeValue<'_>) -> Option<Box<str>> {
    crate::extension(value.as_str()?)
}

fn end_of_line(value: &DeValue<'_>) -> Option<&'static str> {
    match value.as_str()?.to_ascii_lowercase().as_str() {
        "lf" | "\n" => Some("\n"),
        "crlf" | "\r\n" => Some("\r\n"),
        _ => None,
    }
}

fn units(value: &DeValue<'_>) -> Option<Units> {
    match value.as_str()? {
        "mm" => Some(Units::Millimetres),
        "inch" => Some(Units::Inches),
        _ => None,
    }
}

fn decimals(value: &DeValue<'_>) -> Option<usize> {
    value.as_integer()?.as_str().parse().ok().filter(|decimals| *decimals <= 9)
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    let text = value.as_float().map(DeFloat::as_str).or_else(|| value.as_integer().map(DeInteger::as_str))?;
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

fn positive(value: &DeValue<'_>) -> Option<f64> {
    number(value).filter(|number| *number > 0.0)
}

fn sweep(value: &DeValue<'_>) -> Option<f64> {
    number(value).filter(|number| (10.0..=360.0).contains(number))
}
