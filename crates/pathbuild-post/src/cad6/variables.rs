//! The variables of control texts: which there are, and what they hold.

use std::collections::BTreeMap;

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
];

/// Those whose text is no number.
pub(super) const TEXTS: &[&str] = &["PrgName", "PathName", "SourceFile", "ToolName", "Date", "CommentText"];

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
}

impl Variables {
    /// No variables; `aliases` are pairs of another name and the one it stands for.
    pub(super) fn new<'a>(aliases: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let aliases = aliases.into_iter().map(|(other, own)| (other.into(), own.into())).collect();
        Self { values: BTreeMap::new(), aliases }
    }

    fn own_name<'a>(&'a self, name: &'a str) -> &'a str {
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
        let mut escaped = String::with_capacity(text.len());
        for c in text.chars() {
            match c {
                '\\' | '~' | '{' | '}' => escaped.extend(['\\', c]),
                c if c.is_control() => escaped.push(' '),
                c => escaped.push(c),
            }
        }
        self.assign(name, &escaped);
    }
}
