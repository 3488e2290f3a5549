//! Waivers: findings that are accepted for a stated reason, until a date if one is given. Baselines and `severity-in` contain them.
//! (book: howto/ci)

use std::fmt;
use std::str::FromStr;

use camino::{Utf8Path, Utf8PathBuf};
use chrono::{DateTime, Datelike, NaiveDate};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Lang, Message, Text, Value};

/// A day of the Gregorian calendar. Days change at midnight UTC, so that a run has the same result everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Date(NaiveDate);

impl Date {
    /// The day of a time in seconds since 1970-01-01; `None` after the year 9999.
    pub fn of_unix_time(seconds: u64) -> Option<Self> {
        let date = DateTime::from_timestamp(seconds.try_into().ok()?, 0)?.date_naive();
        (date.year() <= 9999).then_some(Self(date))
    }
}

/// Parses `2026-12-31`, in this form only: `chrono` also accepts spaces, signs and single digits.
impl FromStr for Date {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let date = text.parse().map(Self).map_err(|_| ())?;
        if date.to_string() == text { Ok(date) } else { Err(()) }
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The date that a run compares waivers with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunDate {
    /// The date.
    pub date: Date,
    /// Where it comes from.
    pub source: DateSource,
}

/// Where the date of a run comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DateSource {
    /// `--date`, or a caller of the library.
    Given,
    /// The variable `SOURCE_DATE_EPOCH`.
    Epoch,
    /// The system's clock.
    Clock,
}

impl RunDate {
    /// The date with its source, for users: `2026-11-25 (today, UTC)`.
    pub fn text(self, lang: Lang) -> String {
        format!("{} ({})", self.date, self.source.text().in_lang(lang))
    }
}

impl DateSource {
    fn text(self) -> &'static Text {
        match self {
            Self::Given => &messages::DATE_GIVEN,
            Self::Epoch => &messages::DATE_OF_EPOCH,
            Self::Clock => &messages::DATE_OF_CLOCK,
        }
    }
}

/// Why a finding is accepted, and for how long.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Waiver {
    /// The reason; `None` if the entry states none.
    pub reason: Option<Box<str>>,
    /// The last day on which it holds; `None` for always.
    pub until: Option<Date>,
    /// Line of the entry in its file, from 1.
    pub line: u32,
}

impl Waiver {
    /// Whether it states a reason or a date. Other entries are plain settings.
    pub fn is_stated(&self) -> bool {
        self.reason.is_some() || self.until.is_some()
    }

    /// Whether it holds. Without a known date, a waiver that ends does not hold.
    pub fn holds(&self, run: Option<RunDate>) -> bool {
        self.until.is_none_or(|until| run.is_some_and(|run| run.date <= until))
    }

    /// Notes on a finding that the waiver, which is in `file`, no longer covers.
    pub fn note_end(&self, diagnostic: Diagnostic, file: &str, run: Option<RunDate>) -> Diagnostic {
        self.noted(&messages::WAIVER_ENDED, diagnostic, file, run)
    }

    /// Notes on a finding whose severity the waiver sets.
    pub fn note_severity(&self, diagnostic: Diagnostic, file: &str, run: Option<RunDate>) -> Diagnostic {
        self.noted(&messages::SEVERITY_UNTIL, diagnostic, file, run)
    }

    /// Adds the date and the reason to the notes of a finding.
    fn noted(
        &self,
        message: &'static Message,
        mut diagnostic: Diagnostic,
        file: &str,
        run: Option<RunDate>,
    ) -> Diagnostic {
        if let Some(until) = self.until {
            let place = ("place", Value::quoted(format!("{file}:{}", self.line)));
            let until = ("until", Value::quoted(until.to_string()));
            diagnostic = match run {
                Some(run) => {
                    let date = ("date", Value::quoted(run.date.to_string()));
                    diagnostic.note(message, vec![place, until, date, ("source", run.source.text().into())])
                }
                None => diagnostic.note(&messages::WAIVER_WITHOUT_DATE, vec![place, until]),
            };
        }
        match &self.reason {
            Some(reason) => {
                diagnostic.note(&messages::WAIVER_REASON, vec![("reason", Value::quoted(reason))])
            }
            None => diagnostic,
        }
    }

    /// The warning that the waiver, which is in `file`, matches no finding. (PB610)
    pub fn unused(&self, file: &Utf8Path) -> Diagnostic {
        let unused = Diagnostic::new(&messages::UNUSED_WAIVER).in_file(file).at_line(self.line, Some(1));
        match &self.reason {
            Some(reason) => unused.note(&messages::WAIVER_REASON, vec![("reason", Value::quoted(reason))]),
            None => unused,
        }
    }
}

/// A finding that is not reported because it is accepted.
#[derive(Clone, Debug)]
pub struct WaivedFinding {
    /// The finding.
    pub diagnostic: Diagnostic,
    /// The entry that accepts it.
    pub waiver: Waiver,
}

/// The files that a run covered. Only waivers for these files can be reported as matching nothing.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    /// The files that were checked completely.
    pub files: Vec<Utf8PathBuf>,
    /// Whether directories were searched, so that files that no longer exist are noticed.
    pub has_directories: bool,
    /// Whether the whole library was checked, so that patterns are known to match nothing else.
    pub is_library: bool,
}
