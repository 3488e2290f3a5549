//! Converts `$INSUNITS` to millimetres. (book: reference/dxf; book: reference/configuration, `units`)

use pathbuild_diagnostic::messages::files::WRONG_UNITS;
use pathbuild_diagnostic::{Diagnostic, Text};

use crate::Units;
use crate::faults::Fatal;
use crate::header::Header;

/// Millimetres per unit of the drawing, or PB113.
pub(crate) fn millimetres(header: &Header<'_>, units: Units) -> Result<f64, Fatal> {
    if units == Units::Millimetres {
        return Ok(1.0);
    }
    let Some(number) = header.units()? else { return Ok(1.0) };
    match (number, unit(number)) {
        (0 | 4, _) => Ok(1.0),
        (_, Some((_, factor))) if units == Units::Drawing => Ok(factor),
        (_, unit) => {
            let name = unit.map_or(&UNKNOWN, |(name, _)| name);
            Err(Box::new(header.at_units(wrong_units(number, name))))
        }
    }
}

fn wrong_units(number: i64, name: &'static Text) -> Diagnostic {
    Diagnostic::new(&WRONG_UNITS).with("unit", name).quoting("number", number.to_string())
}

/// The name of a unit and its length in millimetres.
fn unit(number: i64) -> Option<(&'static Text, f64)> {
    let index = usize::try_from(number).ok()?;
    UNITS.get(index).map(|(name, factor)| (name, *factor))
}

static UNKNOWN: Text = Text { en: "unknown", de: "unbekannt" };

/// By number. The factors are exact by definition; survey units are 1200/3937 of their metric counterparts, rounded to f64.
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
