//! What a definition sets beside its texts.

use toml::de::{DeFloat, DeInteger, DeValue};

use crate::Units;

/// `[post]`.
#[derive(Clone, Debug)]
pub(super) struct Settings {
    pub(super) name: Box<str>,
    pub(super) extension: Box<str>,
    pub(super) end_of_line: &'static str,
    pub(super) decimals: usize,
    /// `None`: those of the program.
    pub(super) units: Option<Units>,
    pub(super) number_lines: bool,
    /// Blanks at the ends of lines are taken away.
    pub(super) trim: bool,
    pub(super) dialect: Option<Box<str>>,
    /// Greatest distance of a line from the arc that it stands for, mm.
    pub(super) arc_tolerance: f64,
    /// The widest angle of an arc, degrees; wider ones are cut.
    pub(super) arc_sweep: f64,
    /// A way down between two passes may be made by lifting the tool out and coming down again.
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

/// How a key is read.
pub(super) struct Setting {
    /// What it takes.
    pub(super) expected: &'static str,
    /// Sets it; nothing where the value is no such thing.
    pub(super) set: fn(&mut Settings, &DeValue<'_>) -> Option<()>,
}

/// The keys of `[post]`.
pub(super) static SETTINGS: [(&str, Setting); 12] = [
    ("name", Setting { expected: "a text", set: |s, v| put(&mut s.name, text(v)) }),
    // For who reads the file.
    ("description", Setting { expected: "a text", set: |_, v| v.as_str().map(drop) }),
    (
        "extension",
        Setting { expected: "a file name's extension", set: |s, v| put(&mut s.extension, extension(v)) },
    ),
    ("end-of-line", Setting { expected: "lf or crlf", set: |s, v| put(&mut s.end_of_line, end_of_line(v)) }),
    (
        "decimals",
        Setting { expected: "a whole number up to 9", set: |s, v| put(&mut s.decimals, decimals(v)) },
    ),
    ("units", Setting { expected: "mm or inch", set: |s, v| put(&mut s.units, units(v).map(Some)) }),
    (
        "number-lines",
        Setting { expected: "true or false", set: |s, v| put(&mut s.number_lines, v.as_bool()) },
    ),
    ("trim", Setting { expected: "true or false", set: |s, v| put(&mut s.trim, v.as_bool()) }),
    ("dialect", Setting { expected: "a text", set: |s, v| put(&mut s.dialect, text(v).map(Some)) }),
    ("arc-tolerance", Setting { expected: "mm above 0", set: |s, v| put(&mut s.arc_tolerance, positive(v)) }),
    (
        "arc-sweep",
        Setting { expected: "degrees from 10 to 360", set: |s, v| put(&mut s.arc_sweep, sweep(v)) },
    ),
    (
        "lift-between-passes",
        Setting { expected: "true or false", set: |s, v| put(&mut s.lift_between_passes, v.as_bool()) },
    ),
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
