//! The three variables of the HEADER section that matter: version, code page, units.

use std::sync::LazyLock;

use memchr::memmem::Finder;
use pathbuild_diagnostic::Diagnostic;

use crate::faults::{self, Fatal};
use crate::number::whole;
use crate::pairs::{Pair, Pairs, Stop};
use crate::sections::Keyword;

/// The HEADER section. All of it may be missing, as in R10 files and those written by scripts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Header<'a> {
    version: Option<&'a [u8]>,
    code_page: Option<&'a [u8]>,
    /// With its position, since lines are not counted in the header.
    units: Option<(Pair<'a>, Pairs<'a>)>,
}

static VERSION: Keyword = LazyLock::new(|| Finder::new("$ACADVER"));
static CODE_PAGE: Keyword = LazyLock::new(|| Finder::new("$DWGCODEPAGE"));
static UNITS: Keyword = LazyLock::new(|| Finder::new("$INSUNITS"));

impl<'a> Header<'a> {
    /// Finds the variables in the section that starts here.
    pub(crate) fn find(&mut self, section: &Pairs<'a>) {
        for variable in [&VERSION, &CODE_PAGE, &UNITS] {
            if let Some(mut pairs) = section.behind("9", variable) {
                let place = pairs;
                if let Ok(value) = pairs.next() {
                    self.set(variable.needle(), value, place);
                }
            }
        }
    }

    /// Reads variables up to a pair with code 0 and returns it.
    pub(crate) fn read_on(&mut self, first: Pair<'a>, pairs: &mut Pairs<'a>) -> Result<Pair<'a>, Stop<'a>> {
        let mut variable: &[u8] = first.trimmed();
        loop {
            let place = *pairs;
            let pair = pairs.next()?;
            match pair.code {
                0 => return Ok(pair),
                9 => variable = pair.value.trim_ascii(),
                999 => {}
                _ => self.set(variable, pair, place),
            }
        }
    }

    /// Whether texts are UTF-8 by definition: R2007 (AC1021) and later.
    pub(crate) fn is_unicode(&self) -> bool {
        let release = self.version.and_then(|version| version.trim_ascii().strip_prefix(b"AC"));
        // Releases before R10 are "AC1.50" to "AC2.22", which do not parse as integers.
        release.is_some_and(|release| {
            !release.contains(&b'.') && whole(release).is_ok_and(|number| number >= 1021)
        })
    }

    /// `$DWGCODEPAGE`.
    pub(crate) fn code_page(&self) -> Option<&'a [u8]> {
        self.code_page.map(<[u8]>::trim_ascii)
    }

    /// `$INSUNITS`.
    pub(crate) fn units(&self) -> Result<Option<i64>, Fatal> {
        let Some((pair, _)) = self.units else { return Ok(None) };
        whole(pair.value).map(Some).map_err(|reason| {
            let diagnostic = faults::bad_value("$INSUNITS", pair.code, pair.value, reason);
            Box::new(self.at_units(diagnostic))
        })
    }

    /// Attaches the place of `$INSUNITS` to a diagnostic.
    pub(crate) fn at_units(&self, diagnostic: Diagnostic) -> Diagnostic {
        match self.units {
            Some((_, pairs)) => diagnostic.at_line(pairs.counted_line().saturating_add(1), None),
            None => diagnostic,
        }
    }

    fn set(&mut self, variable: &[u8], pair: Pair<'a>, place: Pairs<'a>) {
        match variable {
            b"$ACADVER" => self.version = Some(pair.value),
            b"$DWGCODEPAGE" => self.code_page = Some(pair.value),
            b"$INSUNITS" => self.units = Some((pair, place)),
            _ => {}
        }
    }
}
