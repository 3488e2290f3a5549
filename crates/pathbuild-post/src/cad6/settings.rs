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

/// All keys of `[post]`.
pub(super) static SETTINGS: &[Setting] = &[
    Setting {
        name: "name",
        expected: &Text { en: "a text", de: "ein Text" },
        set: |s, v| put(&mut s.name, text(v)),
        about: Text { en: "name of the post", de: "Name des Postprozessors" },
    },
    Setting {
        name: "description",
        expected: &Text { en: "a text", de: "ein Text" },
        set: |_, v| v.as_str().map(drop),
        about: Text { en: "a comment on the definition", de: "ein Kommentar zur Definition" },
    },
    Setting {
        name: "extension",
        expected: &Text { en: "a file name's extension", de: "die Endung eines Dateinamens" },
        set: |s, v| put(&mut s.extension, extension(v)),
        about: Text {
            en: "extension of the files that are written; `nc` without it",
            de: "Endung der geschriebenen Dateien; sonst `nc`",
        },
    },
    Setting {
        name: "end-of-line",
        expected: &Text { en: "lf or crlf", de: "lf oder crlf" },
        set: |s, v| put(&mut s.end_of_line, end_of_line(v)),
        about: Text { en: "line ends; `lf` without it", de: "Zeilenenden; sonst `lf`" },
    },
    Setting {
        name: "decimals",
        expected: &Text { en: "a whole number up to 9", de: "eine ganze Zahl bis 9" },
        set: |s, v| put(&mut s.decimals, decimals(v)),
        about: Text {
            en: "decimals of rounded numbers; 3 without it",
            de: "Nachkommastellen gerundeter Zahlen; sonst 3",
        },
    },
    Setting {
        name: "units",
        expected: &Text { en: "mm or inch", de: "mm oder inch" },
        set: |s, v| put(&mut s.units, units(v).map(Some)),
        about: Text {
            en: "unit of all lengths; that of the program without it",
            de: "Einheit aller Längen; sonst die des Programms",
        },
    },
    Setting {
        name: "number-lines",
        expected: &Text { en: "true or false", de: "true oder false" },
        set: |s, v| put(&mut s.number_lines, v.as_bool()),
        about: Text {
            en: "whether `line-number` is called; `true` without it",
            de: "ob `line-number` gerufen wird; sonst `true`",
        },
    },
    Setting {
        name: "trim",
        expected: &Text { en: "true or false", de: "true oder false" },
        set: |s, v| put(&mut s.trim, v.as_bool()),
        about: Text {
            en: "whether blanks at line ends are removed; `true` without it",
            de: "ob Leerzeichen am Zeilenende entfallen; sonst `true`",
        },
    },
    Setting {
        name: "dialect",
        expected: &Text { en: "a text", de: "ein Text" },
        set: |s, v| put(&mut s.dialect, text(v).map(Some)),
        about: Text {
            en: "the dialect in which the output is read back",
            de: "der Dialekt, in dem die Ausgabe zurückgelesen wird",
        },
    },
    Setting {
        name: "arc-tolerance",
        expected: &Text { en: "mm above 0", de: "mm über 0" },
        set: |s, v| put(&mut s.arc_tolerance, positive(v)),
        about: Text {
            en: "greatest distance of a line from the arc that it stands for; 0.01 without it",
            de: "größter Abstand einer Strecke vom Bogen, für den sie steht; sonst 0.01",
        },
    },
    Setting {
        name: "arc-sweep",
        expected: &Text { en: "degrees from 10 to 360", de: "Grad von 10 bis 360" },
        set: |s, v| put(&mut s.arc_sweep, sweep(v)),
        about: Text {
            en: "largest angle of an arc, larger ones are divided; 360 without it",
            de: "größter Winkel eines Bogens, größere werden geteilt; sonst 360",
        },
    },
    Setting {
        name: "lift-between-passes",
        expected: &Text { en: "true or false", de: "true oder false" },
        set: |s, v| put(&mut s.lift_between_passes, v.as_bool()),
        about: Text {
            en: "whether the tool may be lifted out between two passes instead of going down in the cut; `false` without it",
            de: "ob das Werkzeug zwischen zwei Zustellungen herausgehoben werden darf, statt im Schnitt abwärts zu fahren; sonst `false`",
        },
    },
];

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
