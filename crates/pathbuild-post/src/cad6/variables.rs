//! The variables of control texts: which there are, and what they hold.

use std::borrow::Cow;
use std::collections::BTreeMap;

use pathbuild_diagnostic::Word;

use super::marks::{MOST_TEXTS, char_of_text, is_private, text_of};

/// The names that pathbuild sets, in the order in which they are documented.
pub(super) const KNOWN: &[&str] = &[
    "X1",
    "Y1",
    "Z1",
    "PrevX",
    "PrevY",
    "PrevZ",
    "XIncr",
    "YIncr",
    "ZIncr",
    "ZClearance",
    "ZWorking",
    "LoweringVel",
    "MovingVel",
    "MachineToolNo",
    "MillingSpindleRate",
    "MillingSpindleDir",
    "ToolControl1",
    "ToolControl2",
    "FirstContourElement",
    "LastContourElement",
    "UpdateXYPosition",
    "UseAuxPoint",
    "UpdateCutterRotationOnly",
    "LineNumber",
    "PrgName",
    "Units",
    "ToolChangeCommands",
    "MachinePosX",
    "MachinePosY",
    "XC",
    "YC",
    "IRel",
    "JRel",
    "Radius",
    "StartAngle",
    "EndAngle",
    "SweepAngle",
    "ArcDir",
    "XB1",
    "YB1",
    "XB2",
    "YB2",
    "ElementNo",
    "ContourNo",
    "ToolChanged",
    "ToolDiameter",
    "PathName",
    "SourceFile",
    "ToolName",
    "Decimals",
    "Date",
    "PeckDepth",
    "DwellTime",
    "CommentText",
    "SpinUpTime",
];

/// Those whose text is no number.
pub(super) const TEXTS: &[&str] = &["PrgName", "PathName", "SourceFile", "ToolName", "Date", "CommentText"];

/// Why a variable that pathbuild sets has no value at some places; `None` if it sets no variable of that name.
pub(super) fn reason(name: &str) -> Option<&'static Word> {
    let reason = match name {
        "MillingSpindleRate" => &Word {
            en: "the tool has no spindle speed (spindle in [tool.NAME])",
            de: "das Werkzeug hat keine Spindeldrehzahl (spindle in [tool.NAME])",
        },
        "Date" => &Word { en: "--date is not given", de: "--date ist nicht angegeben" },
        "MachineToolNo" => &Word { en: "the program names no tool", de: "das Programm nennt kein Werkzeug" },
        "MovingVel" | "LoweringVel" => {
            &Word { en: "the program says no feed here", de: "das Programm sagt hier keinen Vorschub" }
        }
        "XC" | "YC" | "IRel" | "JRel" | "Radius" | "StartAngle" | "EndAngle" | "SweepAngle" | "ArcDir" => {
            &Word { en: "only the text arc has it", de: "nur der Text arc hat sie" }
        }
        "XB1" | "YB1" | "XB2" | "YB2" => &Word {
            en: "only curves have it, and no program has any",
            de: "nur Kurven haben sie, und kein Programm hat welche",
        },
        "PeckDepth" => &Word { en: "only cycle and point have it", de: "nur cycle und point haben sie" },
        "DwellTime" => {
            &Word { en: "only cycle, point and dwell have it", de: "nur cycle, point und dwell haben sie" }
        }
        "CommentText" => &Word { en: "only the text comment has it", de: "nur der Text comment hat sie" },
        _ if KNOWN.contains(&name) => {
            &Word { en: "no move has been made yet", de: "es gab noch keine Bewegung" }
        }
        _ => return None,
    };
    Some(reason)
}

/// Whether a name is that of a parameter that every user may set: Q0, Q1 ..., T0, T1 ...
pub(super) fn is_parameter(name: &str) -> bool {
    let digits = name.strip_prefix(['Q', 'T']);
    digits.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit()))
}

/// What the variables hold. A variable's text may name other variables.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
    values: BTreeMap<Box<str>, Box<str>>,
    /// Names of the definition's own, and the variables that they stand for.
    aliases: BTreeMap<Box<str>, Box<str>>,
    /// Texts of drawings, file names and options. In values a character stands for each, so that nothing in them is ever read again.
    texts: Vec<Box<str>>,
    numbers: BTreeMap<Box<str>, usize>,
}

impl Variables {
    /// No variables; `aliases` are pairs of another name and the one it stands for.
    pub(super) fn new<'a>(aliases: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let aliases = aliases.into_iter().map(|(other, own)| (other.into(), own.into())).collect();
        Self { aliases, ..Self::default() }
    }

    /// pathbuild's name of a variable that the definition calls otherwise.
    pub(super) fn own_name<'a>(&'a self, name: &'a str) -> &'a str {
        self.aliases.get(name).map_or(name, |own| own)
    }

    /// The text of a variable, if it exists.
    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.values.get(self.own_name(name)).map(|value| &**value)
    }

    /// Gives a variable a text that may name others.
    pub(super) fn assign(&mut self, name: &str, text: &str) {
        let name = self.own_name(name).into();
        self.values.insert(name, text.into());
    }

    /// Makes a variable undefined.
    pub(super) fn remove(&mut self, name: &str) {
        self.values.remove(name);
    }

    /// Gives a variable a number.
    pub(super) fn set(&mut self, name: &str, value: f64) {
        self.assign(name, &super::numbers::shortest(value));
    }

    /// Gives a variable a text in which nothing has a meaning.
    pub(super) fn set_text(&mut self, name: &str, text: &str) {
        let number = match self.numbers.get(text) {
            Some(number) => *number,
            None => self.add(text),
        };
        self.assign(name, char_of_text(number).encode_utf8(&mut [0; 4]));
    }

    /// The last place is used again when there are more texts than characters.
    fn add(&mut self, text: &str) -> usize {
        if self.texts.len() == MOST_TEXTS {
            self.texts.pop();
        } else {
            self.numbers.insert(text.into(), self.texts.len());
        }
        self.texts.push(text.into());
        self.texts.len() - 1
    }

    /// The text that a character stands for.
    pub(super) fn text(&self, c: char) -> Option<&str> {
        self.texts.get(text_of(c)?).map(|text| &**text)
    }

    /// A value with its texts in it, to be compared or read as a number, never to be expanded.
    pub(super) fn plain<'t>(&self, value: &'t str) -> Cow<'t, str> {
        if !value.contains(is_private) {
            return Cow::Borrowed(value);
        }
        let mut plain = String::new();
        for c in value.chars() {
            match self.text(c) {
                Some(text) => plain.push_str(text),
                None => plain.push(c),
            }
        }
        Cow::Owned(plain)
    }
}
