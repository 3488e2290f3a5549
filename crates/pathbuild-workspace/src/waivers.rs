//! Waivers: findings that are accepted for a stated reason, some of them only until a date. Baselines and `severity-in` contain them.
//! (book: howto/ci)

use std::fmt;
use std::str::FromStr;

use camino::{Utf8Path, Utf8PathBuf};
use chrono::{DateTime, Datelike, NaiveDate};
use pathbuild_diagnostic::messages::configuration as messages;
use pathbuild_diagnostic::{Diagnostic, Lang, Message, Text, Value};

/// A day of the Gregorian calendar. Days begin at midnight UTC, so that a run has the same result everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Date(NaiveDate);

impl Date {
    /// Returns the day of a time in seconds since 1970-01-01; `None` after the year 9999.
    pub fn of_unix_time(seconds: u64) -> Option<Self> {
        let date = DateTime::from_timestamp(seconds.try_into().ok()?, 0)?.date_naive();
        (date.year() <= 9999).then_some(Self(date))
    }
}

/// Parses `2026-12-31`, and no other form: `chrono` would also accept spaces, signs and single digits.
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

/// The date that waivers are compared with, and its source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunDate {
    /// The day with which the last days of waivers are compared.
    pub date: Date,
    /// Source of the day.
    pub source: DateSource,
}

/// Source of the date of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DateSource {
    /// The option `--date`, or a caller of the library.
    Given,
    /// The environment variable `SOURCE_DATE_EPOCH`.
    Epoch,
    /// The clock of the system, in UTC.
    Clock,
}

impl RunDate {
    /// Returns the date with its source, for users: `2026-11-25 (today, UTC)`.
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

/// The reason why a finding is accepted, and the end of its acceptance.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Waiver {
    /// The reason; `None` if the entry states none.
    pub reason: Option<Box<str>>,
    /// The last day on which the waiver holds; `None` if it has no end.
    pub until: Option<Date>,
    /// Line of the entry in its file, from 1.
    pub line: u32,
}

impl Waiver {
    /// Whether the waiver states a reason or a date. An entry without them is a plain setting.
    pub fn is_stated(&self) -> bool {
        self.reason.is_some() || self.until.is_some()
    }

    /// Whether the waiver holds. If the date of the run is unknown, a waiver with an end does not hold.
    pub fn holds(&self, run: Option<RunDate>) -> bool {
        self.until.is_none_or(|until| run.is_some_and(|run| run.date <= until))
    }

    /// Adds a note to a finding that the waiver, which is in `file`, no longer covers.
    pub fn note_end(&self, diagnostic: Diagnostic, file: &str, run: Option<RunDate>) -> Diagnostic {
        self.with_note(&messages::WAIVER_ENDED, diagnostic, file, run)
    }

    /// Adds a note to a finding that got its severity from this waiver, which is in `file`.
    pub fn note_severity(&self, diagnostic: Diagnostic, file: &str, run: Option<RunDate>) -> Diagnostic {
        self.with_note(&messages::SEVERITY_UNTIL, diagnostic, file, run)
    }

    /// Adds notes to a finding: one with the end of the waiver and the date of the run, and one with the reason, as far as the waiver states them.
    fn with_note(
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
        self.with_reason(diagnostic)
    }

    /// Adds a note with the reason of the waiver, if it states one.
    fn with_reason(&self, diagnostic: Diagnostic) -> Diagnostic {
        let Some(reason) = &self.reason else { return diagnostic };
        diagnostic.note(&messages::WAIVER_REASON, vec![("reason", Value::quoted(reason))])
    }

    /// Returns PB610, the warning that the waiver, which is in `file`, matches no finding.
    pub fn unused_warning(&self, file: &Utf8Path) -> Diagnostic {
        let unused = Diagnostic::new(&messages::UNUSED_WAIVER).in_file(file);
        self.with_reason(unused.at_line(self.line, Some(1)))
    }
}

/// A finding that is not reported because it is accepted.
#[derive(Clone, Debug)]
pub struct WaivedFinding {
    /// The finding that is accepted.
    pub diagnostic: Diagnostic,
    /// The entry that accepts the finding.
    pub waiver: Waiver,
}

/// The files that a run covered. Only a waiver for these files can be reported as matching nothing.
#[derive(Clone, Debug, Default)]
pub struct Coverage {
    /// The files that were checked completely.
    pub files: Vec<Utf8PathBuf>,
    /// Whether the run searched only whole directories, so that files that no longer exist are noticed.
    pub has_directories: bool,
    /// Whether the whole library was checked, so that patterns are known to match nothing else.
    pub is_library: bool,
}
