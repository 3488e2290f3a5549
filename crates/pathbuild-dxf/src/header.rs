//! The three variables of the HEADER section that matter: version, code page, units. (book: reference/dxf; book: reference/configuration,
//! `units`)

use std::sync::LazyLock;

use memchr::memmem::Finder;
use pathbuild_diagnostic::messages::files::WRONG_UNITS;
use pathbuild_diagnostic::{Diagnostic, Text};

use crate::Units;
use crate::faults::{self, FatalError};
use crate::number::whole_number;
use crate::pairs::{Keyword, Pair, Pairs, Stop};

/// The HEADER section. All of it may be missing, as in R10 files and in files written by scripts.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Header<'a> {
    version: Option<&'a [u8]>,
    code_page: Option<&'a [u8]>,
    /// The pair of `$INSUNITS` and its position, from which its line can be found: lines are not counted in the header.
    units: Option<(Pair<'a>, Pairs<'a>)>,
}

static VERSION: Keyword = LazyLock::new(|| Finder::new("$ACADVER"));
static CODE_PAGE: Keyword = LazyLock::new(|| Finder::new("$DWGCODEPAGE"));
static UNIT_VARIABLE: Keyword = LazyLock::new(|| Finder::new("$INSUNITS"));

impl<'a> Header<'a> {
    /// Finds the variables in the section that starts here.
    pub(crate) fn find(&mut self, section: &Pairs<'a>) {
        for variable in [&VERSION, &CODE_PAGE, &UNIT_VARIABLE] {
            if let Some(mut pairs) = section.after_next("9", variable) {
                let place = pairs;
                if let Ok(value) = pairs.next() {
                    self.set(variable.needle(), value, place);
                }
            }
        }
    }

    /// Reads variables up to a pair with code 0 and returns that pair.
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
            !release.contains(&b'.') && whole_number(release).is_ok_and(|number| number >= 1021)
        })
    }

    /// Returns the value of `$DWGCODEPAGE`, if the header has it.
    pub(crate) fn code_page(&self) -> Option<&'a [u8]> {
        self.code_page.map(<[u8]>::trim_ascii)
    }

    /// Returns the value of `$INSUNITS`, if the header has it.
    pub(crate) fn units(&self) -> Result<Option<i64>, FatalError> {
        let Some((pair, _)) = self.units else { return Ok(None) };
        whole_number(pair.value).map(Some).map_err(|reason| {
            let diagnostic = faults::bad_value_error("$INSUNITS", pair.code, pair.value, reason);
            Box::new(self.at_units(diagnostic))
        })
    }

    /// Attaches the place of `$INSUNITS` to a diagnostic.
    fn at_units(&self, diagnostic: Diagnostic) -> Diagnostic {
        diagnostic.at_line(self.units.map(|(_, pairs)| pairs.counted_line().saturating_add(1)), None)
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

/// Returns the millimetres per unit of the drawing, or PB113.
pub(crate) fn millimetres(header: &Header<'_>, units: Units) -> Result<f64, FatalError> {
    if units == Units::Millimetres {
        return Ok(1.0);
    }
    let Some(number) = header.units()? else { return Ok(1.0) };
    match (number, unit(number)) {
        (0 | 4, _) => Ok(1.0),
        (_, Some((_, factor))) if units == Units::Drawing => Ok(factor),
        (_, unit) => {
            let name = unit.map_or(&UNKNOWN, |(name, _)| name);
            Err(Box::new(header.at_units(units_error(number, name))))
        }
    }
}

fn units_error(number: i64, name: &'static Text) -> Diagnostic {
    Diagnostic::new(&WRONG_UNITS).with("unit", name).quoting("number", number.to_string())
}

/// Returns the name of a unit and its length in millimetres; `None` for an unknown number.
fn unit(number: i64) -> Option<(&'static Text, f64)> {
    let index = usize::try_from(number).ok()?;
    UNITS.get(index).map(|(name, factor)| (name, *factor))
}

static UNKNOWN: Text = Text { en: "unknown", de: "unbekannt" };

/// The units by their number in `$INSUNITS`, with their lengths in mm: exact by definition, rounded to f64. A US survey foot is 1200/3937 m.
static UNITS: [(Text, f64); 25] = [
    (word("none", "keine"), 1.0),
    (word("inches", "Zoll"), 25.4),
    (word("feet", "Fuß"), 304.8),
    (word("miles", "Meilen"), 1_609_344.0),
    (word("millimetres", "Millimeter"), 1.0),
    (word("centimetres", "Zentimeter"), 10.0),
    (word("metres", "Meter"), 1e3),
    (word("kilometres", "Kilometer"), 1e6),
    (word("microinches", "Mikrozoll"), 25.4e-6),
    (word("mils", "Tausendstel Zoll"), 0.0254),
    (word("yards", "Yard"), 914.4),
    (word("ångströms", "Ångström"), 1e-7),
    (word("nanometres", "Nanometer"), 1e-6),
    (word("micrometres", "Mikrometer"), 1e-3),
    (word("decimetres", "Dezimeter"), 100.0),
    (word("decametres", "Dekameter"), 1e4),
    (word("hectometres", "Hektometer"), 1e5),
    (word("gigametres", "Gigameter"), 1e12),
    (word("astronomical units", "Astronomische Einheiten"), 149_597_870_700_000.0),
    (word("light years", "Lichtjahre"), 9_460_730_472_580_800_000.0),
    (word("parsecs", "Parsec"), 30_856_775_814_913_670_000.0),
    (word("US survey feet", "US-Vermessungsfuß"), 1_200_000.0 / 3937.0),
    (word("US survey inches", "US-Vermessungszoll"), 100_000.0 / 3937.0),
    (word("US survey yards", "US-Vermessungsyard"), 3_600_000.0 / 3937.0),
    (word("US survey miles", "US-Vermessungsmeilen"), 6_336_000_000.0 / 3937.0),
];

const fn word(en: &'static str, de: &'static str) -> Text {
    Text { en, de }
}
