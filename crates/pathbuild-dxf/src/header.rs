//! The three variables of the HEADER section that matter: version, code page, units.

use std::sync::LazyLock;

use memchr::memmem::Finder;
use pathbuild_diagnostic::Diagnostic;

use crate::faults;
use crate::number::whole;
use crate::pairs::{Pair, Pairs, Stop};
use crate::sections::Keyword;

/// What the header says; all of it may be missing, as in files of R10 and of scripts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Header<'a> {
    version: Option<Pair<'a>>,
    code_page: Option<Pair<'a>>,
    units: Option<Pair<'a>>,
}

static VERSION: Keyword = LazyLock::new(|| Finder::new("$ACADVER"));
static CODE_PAGE: Keyword = LazyLock::new(|| Finder::new("$DWGCODEPAGE"));
static UNITS: Keyword = LazyLock::new(|| Finder::new("$INSUNITS"));

impl<'a> Header<'a> {
    /// Finds the variables in the section that begins here.
    pub(crate) fn find(&mut self, section: &Pairs<'a>) {
        for variable in [&VERSION, &CODE_PAGE, &UNITS] {
            let mut pairs = *section;
            if let (Some(_), Ok(value)) = (pairs.find("9", variable), pairs.next()) {
                self.set(variable.needle(), value);
            }
        }
    }

    /// Reads variables up to a pair with code 0, which is returned.
    pub(crate) fn read_on(&mut self, first: Pair<'a>, pairs: &mut Pairs<'a>) -> Result<Pair<'a>, Stop<'a>> {
        let mut variable: &[u8] = b"";
        let mut pair = first;
        loop {
            match pair.code {
                0 => return Ok(pair),
                9 => variable = pair.value.trim_ascii(),
                999 => {}
                _ => self.set(variable, pair),
            }
            pair = pairs.next()?;
        }
    }

    /// Whether texts are UTF-8 by definition: R2007 (AC1021) and later.
    pub(crate) fn is_unicode(&self) -> bool {
        let release = self.version.as_ref().and_then(|pair| pair.trimmed().strip_prefix(b"AC"));
        // Releases before R10 are "AC1.50" to "AC2.22", which is no whole number.
        release.is_some_and(|release| {
            !release.contains(&b'.') && whole(release).is_ok_and(|number| number >= 1021)
        })
    }

    /// `$DWGCODEPAGE`.
    pub(crate) fn code_page(&self) -> Option<&'a [u8]> {
        self.code_page.map(|pair| pair.value.trim_ascii())
    }

    /// `$INSUNITS` and the line of its value.
    pub(crate) fn units(&self) -> Result<Option<(i64, u32)>, Box<Diagnostic>> {
        let Some(pair) = self.units else { return Ok(None) };
        let line = pair.line.saturating_add(1);
        match whole(pair.value) {
            Ok(number) => Ok(Some((number, line))),
            Err(reason) => Err(Box::new(
                faults::bad_value("$INSUNITS", pair.code, pair.value, reason).at_line(line, None),
            )),
        }
    }

    fn set(&mut self, variable: &[u8], pair: Pair<'a>) {
        match variable {
            b"$ACADVER" => self.version = Some(pair),
            b"$DWGCODEPAGE" => self.code_page = Some(pair),
            b"$INSUNITS" => self.units = Some(pair),
            _ => {}
        }
    }
}
