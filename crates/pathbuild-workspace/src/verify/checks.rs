//! The checks of a program by `verify`: those that were made, with their values, and those that could not be made. (book: program/reading)

use std::fmt::Write;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Lang, Number, Text};
use pathbuild_gcode::verify::{BlindRapids, Machine};
use serde::{Deserialize, Serialize};

use crate::config::types::Requirement;

/// A check of a program, with its outcome.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckRecord {
    /// The kind of check.
    pub requirement: Requirement,
    /// Whether the check was made; if so, with the values that it used, and if not, with the reason.
    pub outcome: Outcome,
}

/// The outcome of a check.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// The check was made. The check of rapid moves states the values that it was made with.
    Made(Option<RapidValues>),
    /// The check was made with values that may be wrong.
    Assumed(RapidValues, Assumption),
    /// The check was made with these values, except for rapid moves that start at an unknown position.
    Incomplete(RapidValues, BlindRapids),
    /// The check was not made, for this reason.
    NotMade(MissingCheckReason),
}

/// The reason why the values of a check may be wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Assumption {
    /// Only the program itself states the cutter or the material.
    Stock,
    /// The program contains moves that depend on values which only the machine knows, such as the result of a probe.
    MachineValues,
}

/// The values that rapid moves were checked with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RapidValues {
    /// Diameters of the cutters in mm, in the order of use.
    pub cutters: Vec<f64>,
    /// Source of the cutters' diameters.
    pub cutter_origin: ValueSource,
    /// Height in mm of the upper face of the material, where it is highest.
    pub surface: f64,
    /// Whether the upper face has the same height everywhere.
    pub is_level: bool,
    /// Source of the height of the upper face.
    pub surface_origin: ValueSource,
}

/// Source of a value. The sources are ordered from the most to the least reliable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ValueSource {
    /// An option on the command line.
    Option,
    /// The drawing that the program is compared with.
    Drawing,
    /// A table `[tool]` of the configuration.
    Table,
    /// Comments of the program, or the heights at which its plunges begin to cut.
    Program,
}

/// The reason why a check was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MissingCheckReason {
    /// The configuration does not limit the machine.
    NoLimit,
    /// There is no drawing to compare with.
    NoDrawing,
    /// The comparison with the drawing ended at the first move that differs.
    OtherMoves,
    /// With `unchecked = true`, it is unknown whether the output of the definition mills the drawing.
    Unchecked,
    /// The configuration names no layers of clamps.
    NoKeepOut,
    /// The cutter is unknown.
    NoCutter,
    /// The height of the material is unknown.
    NoSurface,
    /// The material of the drawing has several heights, and only a native program shows where each of them applies.
    SeveralSurfaces,
    /// The heights of the program were corrected by probes, and only a native program states by how much.
    MeasuredSurface,
    /// The program makes a cut for which it has set no spindle speed.
    NoSpeed,
    /// The program cuts without limiting the rounding of corners.
    NoCornerLimit,
    /// All cuts end above the surface that an option states.
    NoCutBelow,
    /// The program switches coolant on, and no table `[tool]` says whether it must.
    NoCoolant,
    /// The program contains a line or a word that pathbuild does not read or interpret, so its moves are not known.
    NotFollowed,
    /// The program moves in coordinate systems with unknown positions relative to each other.
    SeveralZeros,
    /// The program moves an axis by a distance (G91) from a position that it has not stated.
    NoPosition,
    /// A limit of `[limits]` is exceeded.
    TooLarge,
    /// Rapid moves have the length of another tool, or none.
    WrongLength,
}

/// The references that a program can be compared with.
#[derive(Clone, Copy, Debug)]
pub(super) struct References {
    /// The reason why not all moves were compared with those of a drawing; `None` if they were.
    pub(super) drawing_doubt: Option<MissingCheckReason>,
    /// Whether the configuration names layers of clamps.
    pub(super) has_keep_out: bool,
    /// Whether pathbuild interprets all words of the program that may move the tool.
    pub(super) are_moves_known: bool,
    /// The reason why the travel that the program needs is not known; `None` if it is.
    pub(super) travel_doubt: Option<MissingCheckReason>,
}

/// Returns the checks of a program. `rapids` is the outcome of the check of rapid moves.
pub(super) fn records(
    rapids: Outcome,
    machine: Option<&Machine>,
    references: References,
    states_speed: bool,
) -> Vec<CheckRecord> {
    let outcome =
        |is_made: bool, reason| if is_made { Outcome::Made(None) } else { Outcome::NotMade(reason) };
    let drawing = references.drawing_doubt.map_or(Outcome::Made(None), Outcome::NotMade);
    let clamps = match references.drawing_doubt {
        Some(MissingCheckReason::NoDrawing) => drawing.clone(),
        _ => outcome(references.has_keep_out, MissingCheckReason::NoKeepOut),
    };
    let limits = |is_limited: fn(&Machine) -> bool| {
        outcome(machine.is_some_and(is_limited), MissingCheckReason::NoLimit)
    };
    let spindle = match limits(|machine| machine.spindle.is_some()) {
        Outcome::Made(_) if !states_speed => Outcome::NotMade(MissingCheckReason::NoSpeed),
        other => other,
    };
    let envelope = match limits(|machine| machine.travel.is_some()) {
        Outcome::Made(_) if !references.are_moves_known => Outcome::NotMade(MissingCheckReason::NotFollowed),
        Outcome::Made(_) => references.travel_doubt.map_or(Outcome::Made(None), Outcome::NotMade),
        other => other,
    };
    let all = [
        (Requirement::Rapids, rapids),
        (Requirement::Envelope, envelope),
        (Requirement::Feeds, limits(|machine| machine.feed.is_some())),
        (Requirement::Spindle, spindle),
        (Requirement::Drawing, drawing),
        (Requirement::Clamps, clamps),
    ];
    all.map(|(requirement, outcome)| CheckRecord { requirement, outcome }).into()
}

/// Returns the record of the check for the rounding of corners. `has_limit` says whether the program limits the rounding.
pub(super) fn corner_record(has_limit: bool) -> CheckRecord {
    let outcome =
        if has_limit { Outcome::Made(None) } else { Outcome::NotMade(MissingCheckReason::NoCornerLimit) };
    CheckRecord { requirement: Requirement::Corners, outcome }
}

/// Returns the record of the comparison of coolant, which could not be made.
pub(super) fn coolant_not_compared() -> CheckRecord {
    CheckRecord {
        requirement: Requirement::Coolant,
        outcome: Outcome::NotMade(MissingCheckReason::NoCoolant),
    }
}

/// Describes the checks of a program in one line.
pub fn summary(records: &[CheckRecord], lang: Lang) -> String {
    let mut checked = vec![lang.choose("words", "Wörter").to_owned()];
    let mut unchecked = Vec::new();
    for record in records {
        let name = requirement_name(record.requirement).in_lang(lang);
        match &record.outcome {
            Outcome::Made(_) | Outcome::Assumed(..) => checked.push(record.text(lang)),
            Outcome::Incomplete(values, blind) => {
                checked.push(format!("{name} {}", describe_cutter(values, lang)));
                unchecked.push(format!(
                    "{} ({})",
                    blind_text(*blind, lang),
                    APPROACH_ABOVE_MATERIAL.in_lang(lang)
                ));
            }
            Outcome::NotMade(reason) => {
                let option = record.option(*reason).in_lang(lang);
                unchecked.push(match record.requirement {
                    Requirement::Rapids => format!("{name} ({}: {option})", reason.text().in_lang(lang)),
                    _ => format!("{name} ({option})"),
                });
            }
        }
    }
    let mut line = format!("{}: {}", lang.choose("checked", "geprüft"), checked.join(", "));
    if !unchecked.is_empty() {
        _ = write!(line, "; {}: {}", lang.choose("not checked", "nicht geprüft"), unchecked.join(", "));
    }
    line
}

impl CheckRecord {
    /// Returns the values with which rapid moves were checked; `None` for other checks, and if the check was not made.
    pub fn values(&self) -> Option<&RapidValues> {
        match &self.outcome {
            Outcome::Made(values) => values.as_ref(),
            Outcome::Assumed(values, _) | Outcome::Incomplete(values, _) => Some(values),
            Outcome::NotMade(_) => None,
        }
    }

    /// Describes the check and the values that it used, or the reason why it was not made.
    pub fn text(&self, lang: Lang) -> String {
        let name = requirement_name(self.requirement).in_lang(lang);
        match (&self.outcome, self.values()) {
            (Outcome::NotMade(reason), _) => format!("{name}: {}", reason.text().in_lang(lang)),
            (Outcome::Incomplete(values, blind), _) => {
                let but = lang.choose("but not", "aber nicht");
                format!("{name} {}, {but} {}", describe_cutter(values, lang), blind_text(*blind, lang))
            }
            (Outcome::Assumed(values, Assumption::MachineValues), _) => {
                format!("{name} {} ({})", describe_cutter(values, lang), MACHINE_VALUES_ASSUMED.in_lang(lang))
            }
            (_, Some(values)) => format!("{name} {}", describe_cutter(values, lang)),
            (_, None) => name.to_owned(),
        }
    }

    /// Returns the option that would make the check possible.
    pub fn option(&self, reason: MissingCheckReason) -> &'static Text {
        match (reason, self.requirement) {
            (MissingCheckReason::NoDrawing, _) => &Text { en: "--against PATH", de: "--against PFAD" },
            (MissingCheckReason::OtherMoves, _) => &Text {
                en: "a program with the moves of the drawing",
                de: "ein Programm mit den Bewegungen der Zeichnung",
            },
            (MissingCheckReason::Unchecked, _) => {
                &Text { en: "a definition without `unchecked`", de: "eine Definition ohne `unchecked`" }
            }
            (MissingCheckReason::NoKeepOut, _) => {
                &Text { en: "keep-out in pathbuild.toml", de: "keep-out in pathbuild.toml" }
            }
            (MissingCheckReason::NoCutter, _) => {
                &Text { en: "--cutter or --against PATH", de: "--cutter oder --against PFAD" }
            }
            (MissingCheckReason::NoSurface | MissingCheckReason::NoCutBelow, _) => {
                &Text { en: "--surface or --against PATH", de: "--surface oder --against PFAD" }
            }
            (MissingCheckReason::SeveralSurfaces, _) => &Text {
                en: "the native program, which shows where each of them counts",
                de: "das native Programm, das zeigt, wo welche Höhe gilt",
            },
            (MissingCheckReason::MeasuredSurface, _) => &Text {
                en: "the native program that adjust wrote, or --surface",
                de: "das native Programm, das adjust geschrieben hat, oder --surface",
            },
            (MissingCheckReason::NotFollowed, _) => &Text {
                en: "a program that is read without errors, such as PB703, PB720 or PB721",
                de: "ein Programm, das sich ohne Fehler wie PB703, PB720 oder PB721 lesen lässt",
            },
            (MissingCheckReason::NoPosition, _) => &Text {
                en: "X, Y and Z in G90 before other moves",
                de: "X, Y und Z in G90 vor anderen Bewegungen",
            },
            (MissingCheckReason::WrongLength, _) => {
                &Text { en: "G43 before Z is stated (PB785)", de: "G43, bevor Z genannt wird (PB785)" }
            }
            (MissingCheckReason::SeveralZeros, _) => &Text {
                en: "one work offset, or G10 L2 for each",
                de: "ein einziger Nullpunkt, oder G10 L2 für jeden",
            },
            (MissingCheckReason::TooLarge, _) => &Text {
                en: "higher verify-cells and verify-pieces under [limits]",
                de: "höhere verify-cells und verify-pieces unter [limits]",
            },
            (MissingCheckReason::NoSpeed, _) => {
                &Text { en: "M3 and S before the first cut", de: "M3 und S vor dem ersten Schnitt" }
            }
            (MissingCheckReason::NoCornerLimit, _) => {
                &Text { en: "G64 P or G61 in the program", de: "G64 P oder G61 im Programm" }
            }
            (MissingCheckReason::NoCoolant, _) => &Text { en: "[tool] coolant", de: "[tool] coolant" },
            (MissingCheckReason::NoLimit, Requirement::Feeds) => {
                &Text { en: "[machine] maximum-feed", de: "[machine] maximum-feed" }
            }
            (MissingCheckReason::NoLimit, Requirement::Spindle) => {
                &Text { en: "[machine] spindle-speeds", de: "[machine] spindle-speeds" }
            }
            (MissingCheckReason::NoLimit, _) => &Text { en: "[machine] travel", de: "[machine] travel" },
        }
    }

    pub(super) fn missing_check_error(&self, required: &[Requirement]) -> Option<Diagnostic> {
        let may_be_assumed = required.contains(&Requirement::AssumedRapids);
        let is_rapids = self.requirement == Requirement::Rapids;
        let is_required = required.contains(&self.requirement) || (is_rapids && may_be_assumed);
        if !is_required {
            return None;
        }
        let (reason, option) = match &self.outcome {
            Outcome::Made(_) => return None,
            Outcome::Incomplete(_, blind) => {
                let problem =
                    Diagnostic::new(&say::CHECK_INCOMPLETE).quoting("check", self.requirement.name());
                let line = u64::from(blind.line);
                return Some(problem.with("count", blind.count).with("line", line).at_line(blind.line, None));
            }
            Outcome::Assumed(..) if may_be_assumed => return None,
            Outcome::Assumed(_, Assumption::Stock) => (
                &Text {
                    en: "only the program itself states cutter or material",
                    de: "nur das Programm selbst nennt Fräser oder Material",
                },
                &Text {
                    en: "--cutter and --surface, --against PATH, or rapids=assumed",
                    de: "--cutter und --surface, --against PFAD oder rapids=assumed",
                },
            ),
            Outcome::Assumed(_, Assumption::MachineValues) => (
                &Text {
                    en: "the program moves by values that only the machine knows",
                    de: "das Programm fährt nach Werten, die nur die Maschine kennt",
                },
                &Text {
                    en: "numbers in place of these values, or rapids=assumed",
                    de: "Zahlen an Stelle dieser Werte, oder rapids=assumed",
                },
            ),
            Outcome::NotMade(reason) => (reason.text(), self.option(*reason)),
        };
        let problem = Diagnostic::new(&say::CHECK_NOT_MADE).quoting("check", self.requirement.name());
        Some(problem.with("reason", reason).with("option", option))
    }
}

impl RapidValues {
    /// Describes the values with their origins, such as `3 mm (--cutter) and material up to Z 0 (--surface)`.
    pub fn in_lang(&self, lang: Lang) -> String {
        let mut diameters: Vec<String> = Vec::new();
        for cutter in &self.cutters {
            let diameter = Number(*cutter).prose(lang);
            if !diameters.contains(&diameter) {
                diameters.push(diameter);
            }
        }
        let name = |origin: ValueSource, option| match origin {
            ValueSource::Option => option,
            ValueSource::Drawing => lang.choose("drawing", "Zeichnung"),
            ValueSource::Table => "[tool]",
            ValueSource::Program => lang.choose("header", "Kopf"),
        };
        let cutter = format!(
            "{} mm ({})",
            diameters.join(lang.choose(", ", " und ")),
            name(self.cutter_origin, "--cutter")
        );
        let material = lang.choose("and material up to", "und Material bis");
        let surface = Number(self.surface).prose(lang);
        format!("{cutter} {material} Z {surface} ({})", name(self.surface_origin, "--surface"))
    }
}

impl MissingCheckReason {
    /// Returns the reason as a phrase.
    pub fn text(self) -> &'static Text {
        match self {
            Self::NoLimit => &Text {
                en: "the machine's limits are not known",
                de: "die Grenzen der Maschine sind nicht bekannt",
            },
            Self::NoDrawing => &Text {
                en: "there is no drawing to compare with",
                de: "es fehlt die Zeichnung zum Vergleich",
            },
            Self::OtherMoves => &Text {
                en: "the moves differ; moves after the first difference were not compared",
                de: "die Bewegungen weichen ab; nach der ersten Abweichung wurden sie nicht mehr verglichen",
            },
            Self::Unchecked => &Text {
                en: "with `unchecked = true`, it is unknown whether the definition's output mills the drawing",
                de: "mit `unchecked = true` ist unbekannt, ob die Ausgabe der Definition die Zeichnung fräst",
            },
            Self::NoKeepOut => &Text {
                en: "the configuration names no layers with clamps",
                de: "die Konfiguration nennt keine Layer mit Spannmitteln",
            },
            Self::NoCutter => &Text { en: "the cutter is not known", de: "der Fräser ist nicht bekannt" },
            Self::NoSurface => &Text {
                en: "the height of the material is not known, so only rapid moves at cutting depth were examined",
                de: "die Höhe des Materials ist nicht bekannt, daher wurden nur Eilgänge in Frästiefe untersucht",
            },
            Self::SeveralSurfaces => &Text {
                en: "the upper face of the drawing's material has several heights (several T, or H), so rapid moves were only compared with those of the drawing",
                de: "die Oberseite des Materials der Zeichnung ist verschieden hoch (mehrere T, oder H), daher wurden Eilgänge nur mit denen der Zeichnung verglichen",
            },
            Self::MeasuredSurface => &Text {
                en: "the heights were corrected by probes, so only rapid moves at cutting depth were examined",
                de: "die Höhen sind nach Proben korrigiert, daher wurden nur Eilgänge in Frästiefe untersucht",
            },
            Self::TooLarge => &Text { en: "the program is too large", de: "das Programm ist zu groß" },
            Self::NoSpeed => &Text {
                en: "the program makes a cut for which it has set no spindle speed",
                de: "das Programm fräst, ohne dafür eine Drehzahl gesetzt zu haben",
            },
            Self::NoCornerLimit => &Text {
                en: "the program does not limit how far the control rounds corners",
                de: "das Programm begrenzt nicht, wie weit die Steuerung Ecken verrundet",
            },
            Self::NoCoolant => &Text {
                en: "the program switches coolant on, and [tool] does not say whether the cutter needs any",
                de: "das Programm schaltet Kühlung ein, und [tool] sagt nicht, ob der Fräser welche braucht",
            },
            Self::NoCutBelow => &Text {
                en: "all cuts end above the material of --surface",
                de: "alle Schnitte enden über dem Material von --surface",
            },
            Self::NotFollowed => &Text {
                en: "the program has lines or words that pathbuild cannot read or interpret, so its moves are not known",
                de: "das Programm hat Zeilen oder Wörter, die pathbuild nicht lesen oder auswerten kann; seine Bewegungen sind daher nicht bekannt",
            },
            Self::NoPosition => &Text {
                en: "the program moves an axis by a distance (G91) from a position that it has not stated",
                de: "das Programm bewegt eine Achse um eine Strecke (G91), deren Anfang es nicht genannt hat",
            },
            Self::WrongLength => &Text {
                en: "rapid moves have the length of another tool, or none",
                de: "Eilgänge haben die Länge eines anderen Werkzeugs oder keine",
            },
            Self::SeveralZeros => &Text {
                en: "only the machine knows where the work offsets of the program lie",
                de: "nur die Maschine weiß, wo die Nullpunkte des Programms liegen",
            },
        }
    }
}

fn describe_cutter(values: &RapidValues, lang: Lang) -> String {
    let against = lang.choose("against a cutter of", "mit einem Fräser von");
    format!("{against} {}", values.in_lang(lang))
}

/// Describes the rapid moves that start at an unknown position, as in `2 rapid moves from unknown positions to below the surface, the first in line
/// 7`.
pub fn blind_text(blind: BlindRapids, lang: Lang) -> String {
    let BlindRapids { count, line } = blind;
    match (lang, count) {
        (Lang::En, 1) => {
            format!("1 rapid move from an unknown position to below the surface, in line {line}")
        }
        (Lang::En, _) => {
            format!(
                "{count} rapid moves from unknown positions to below the surface, the first in line {line}"
            )
        }
        (Lang::De, 1) => format!("1 Eilgang von unbekannter Position unter die Oberfläche, in Zeile {line}"),
        (Lang::De, _) => {
            format!(
                "{count} Eilgänge von unbekannten Positionen unter die Oberfläche, der erste in Zeile {line}"
            )
        }
    }
}

/// Advice for a rapid move that starts at an unknown position.
pub static APPROACH_ABOVE_MATERIAL: Text = Text {
    en: "go to X and Y above the material first, then down",
    de: "zuerst über dem Material nach X und Y fahren, dann hinunter",
};

fn requirement_name(requirement: Requirement) -> Text {
    match requirement {
        Requirement::Rapids | Requirement::AssumedRapids => Text { en: "rapid moves", de: "Eilgänge" },
        Requirement::Envelope => Text { en: "travel", de: "Verfahrwege" },
        Requirement::Feeds => Text { en: "maximum feed", de: "maximaler Vorschub" },
        Requirement::Spindle => Text { en: "spindle speeds", de: "Drehzahlen" },
        Requirement::Drawing => Text { en: "moves of the drawing", de: "Bewegungen der Zeichnung" },
        Requirement::Clamps => Text { en: "clamps", de: "Spannmittel" },
        Requirement::Corners => Text { en: "rounding of corners", de: "Verrunden von Ecken" },
        Requirement::Coolant => Text { en: "coolant", de: "Kühlung" },
    }
}

static MACHINE_VALUES_ASSUMED: Text = Text {
    en: "values that only the machine knows are assumed",
    de: "Werte, die nur die Maschine kennt, sind angenommen",
};
