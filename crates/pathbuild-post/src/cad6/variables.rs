//! The variables available in control texts, and their values. During evaluation, texts contain placeholder characters: at the positions of
//! variables, for bytes (from escape sequences and inserted files), and for texts that must not be evaluated. Placeholders are private-use
//! characters, which definitions must not contain.

use std::borrow::Cow;
use std::collections::BTreeMap;

use pathbuild_diagnostic::Text;

/// A variable set by pathbuild.
#[derive(Debug)]
pub(super) struct Variable {
    /// Name of the variable without tildes.
    pub(super) name: &'static str,
    /// Whether the value of the variable is a text; otherwise it is a number.
    pub(super) is_text: bool,
    pub(super) presence: Presence,
    /// Meaning of the value, for the book.
    pub(super) about: Text,
}

words! {
    /// The control texts in which a variable is available. (book: reference/post-definitions)
    Presence:
    Always "everywhere", "überall";
    FirstMove "from the first move on", "ab der ersten Bewegung";
    Feed "where a feed is given", "wo ein Vorschub vorliegt";
    ToolNumber "where the tool has a number", "wo das Werkzeug eine Nummer hat";
    Speed "where a speed is given", "wo eine Drehzahl vorliegt";
    Contours "from the first contour on", "ab der ersten Kontur";
    Elements "from the first element of a contour on", "ab dem ersten Element einer Kontur";
    Arcs "in `arc` only", "nur in `arc`";
    Holes "from the first hole on", "ab der ersten Bohrung";
    Waits "from the first hole or `dwell` on", "ab der ersten Bohrung oder dem ersten `dwell`";
    Comments "from the first comment on", "ab dem ersten Kommentar";
    Dated "with `--date`", "mit `--date`";
    Never "never: no program has curves", "nie: Kein Programm hat Kurven";
}

impl Variable {
    pub(super) fn by_name(name: &str) -> Option<&'static Self> {
        VARIABLES.iter().find(|variable| variable.name == name)
    }

    /// Returns the reason that a message gives if the variable has no value.
    pub(super) fn reason(&self) -> &'static Text {
        match self.presence {
            Presence::Speed => &Text {
                en: "the tool has no spindle speed (spindle in [tool.NAME])",
                de: "das Werkzeug hat keine Spindeldrehzahl (spindle in [tool.NAME])",
            },
            Presence::Dated => &Text { en: "--date is not given", de: "--date ist nicht angegeben" },
            Presence::ToolNumber => {
                &Text { en: "the program names no tool", de: "das Programm nennt kein Werkzeug" }
            }
            Presence::Feed => {
                &Text { en: "the program has no feed here", de: "das Programm nennt hier keinen Vorschub" }
            }
            Presence::Arcs => {
                &Text { en: "it has a value only in the text arc", de: "sie hat nur im Text arc einen Wert" }
            }
            Presence::Never => &Text {
                en: "it has a value only for curves, and programs contain none",
                de: "sie hat nur bei Kurven einen Wert, und Programme enthalten keine",
            },
            Presence::Holes => &Text {
                en: "it has a value only in the texts cycle and point",
                de: "sie hat nur in den Texten cycle und point einen Wert",
            },
            Presence::Waits => &Text {
                en: "it has a value only in the texts cycle, point and dwell",
                de: "sie hat nur in den Texten cycle, point und dwell einen Wert",
            },
            Presence::Comments => &Text {
                en: "it has a value only in the text comment",
                de: "sie hat nur im Text comment einen Wert",
            },
            Presence::Always | Presence::FirstMove | Presence::Contours | Presence::Elements => {
                &Text { en: "no move has been made yet", de: "es gab noch keine Bewegung" }
            }
        }
    }
}

macro_rules! variables {
    ($($name:literal $kind:ident $presence:ident, $en:literal, $de:literal;)*) => {
        /// All variables set by pathbuild, in the order in which they are documented.
        pub(super) static VARIABLES: &[Variable] = &[$(Variable {
            name: $name,
            is_text: variables!($kind),
            presence: Presence::$presence,
            about: Text { en: $en, de: $de },
        },)*];
    };
    (text) => { true };
    (number) => { false };
}

variables! {
    "X1" number FirstMove, "where the move or hole ends", "wo die Bewegung endet oder die Bohrung liegt";
    "Y1" number FirstMove, "likewise", "ebenso";
    "Z1" number FirstMove, "likewise; of a hole its bottom", "ebenso; bei Bohrungen der Grund";
    "PrevX" number FirstMove, "where the tool was before the move", "wo der Fräser vor der Bewegung stand";
    "PrevY" number FirstMove, "likewise", "ebenso";
    "PrevZ" number FirstMove, "likewise", "ebenso";
    "XIncr" number FirstMove, "the text `(~X1~-~PrevX~)`", "der Text `(~X1~-~PrevX~)`";
    "YIncr" number FirstMove, "the text `(~Y1~-~PrevY~)`", "der Text `(~Y1~-~PrevY~)`";
    "ZIncr" number FirstMove, "the text `(~Z1~-~PrevZ~)`", "der Text `(~Z1~-~PrevZ~)`";
    "ZClearance" number Always,
        "the height of rapid moves in the plane", "die Höhe der Eilgänge in der Ebene";
    "ZWorking" number Always,
        "the height at which a rapid move down ends", "die Höhe, in der der Eilgang abwärts endet";
    "LoweringVel" number Feed, "the feed down", "der Vorschub abwärts";
    "MovingVel" number Feed, "the feed of the element", "der Vorschub des Elements";
    "MachineToolNo" number ToolNumber, "the tool's number", "die Nummer des Werkzeugs";
    "MillingSpindleRate" number Speed, "revolutions per minute", "Umdrehungen pro Minute";
    "MillingSpindleDir" number Always, "0 clockwise, 1 counter-clockwise", "0 im Uhrzeigersinn, 1 gegen ihn";
    "ToolControl1" number Always, "1 with flood or mist", "1 bei Flut- oder Nebelkühlung";
    "ToolControl2" number Always, "1 with mist", "1 bei Nebelkühlung";
    "FirstContourElement" number Elements,
        "1 for the first element of a contour, and where its feed changes",
        "1 beim ersten Element einer Kontur und wo ihr Vorschub wechselt";
    "LastContourElement" number Elements,
        "1 for the last element of a contour", "1 beim letzten Element einer Kontur";
    "UpdateXYPosition" number Contours, "1", "1";
    "UseAuxPoint" number Contours, "0", "0";
    "UpdateCutterRotationOnly" number Contours, "0", "0";
    "LineNumber" number Always,
        "begins at 10; the text `line-number` raises it", "beginnt bei 10; der Text `line-number` erhöht sie";
    "PrgName" text Always, "the program's name", "der Name des Programms";
    "Units" number Always, "0 millimetres, 2 inches", "0 Millimeter, 2 Zoll";
    "ToolChangeCommands" number Always, "1", "1";
    "MachinePosX" number Always, "0", "0";
    "MachinePosY" number Always, "0", "0";
    "XC" number Arcs, "the arc's centre", "der Mittelpunkt des Bogens";
    "YC" number Arcs, "likewise", "ebenso";
    "IRel" number Arcs, "from the arc's start to its centre", "vom Anfang des Bogens zum Mittelpunkt";
    "JRel" number Arcs, "likewise", "ebenso";
    "Radius" number Arcs, "the arc's radius", "der Radius des Bogens";
    "StartAngle" number Arcs, "degrees from 0 to 360", "Grad von 0 bis 360";
    "EndAngle" number Arcs, "likewise", "ebenso";
    "SweepAngle" number Arcs, "degrees, clockwise negative", "Grad, im Uhrzeigersinn negativ";
    "ArcDir" number Arcs, "0 clockwise, 1 counter-clockwise", "0 im Uhrzeigersinn, 1 gegen ihn";
    "XB1" number Never, "a curve's control point", "ein Kontrollpunkt einer Kurve";
    "YB1" number Never, "likewise", "ebenso";
    "XB2" number Never, "likewise", "ebenso";
    "YB2" number Never, "likewise", "ebenso";
    "ElementNo" number Elements,
        "number of the element in its contour, from 1", "Nummer des Elements in seiner Kontur, ab 1";
    "ContourNo" number Contours, "number of the contour, from 1", "Nummer der Kontur, ab 1";
    "ToolChanged" number FirstMove,
        "1 in the first call after a tool change", "1 beim ersten Aufruf nach einem Werkzeugwechsel";
    "ToolDiameter" number Always, "O", "O";
    "PathName" text Always, "the path", "der Pfad";
    "SourceFile" text Always, "the drawing", "die Zeichnung";
    "ToolName" text Always, "the tool's name", "der Name des Werkzeugs";
    "Decimals" number Always, "`[post] decimals`", "`[post] decimals`";
    "Date" text Dated, "the date", "das Datum";
    "PeckDepth" number Holes,
        "depth of each peck, 0 without peck drilling", "Tiefe je Stufe, 0 ohne Bohren in Stufen";
    "DwellTime" number Waits, "seconds", "Sekunden";
    "CommentText" text Comments, "the comment", "der Kommentar";
    "SpinUpTime" number Always,
        "seconds until the spindle turns (`spin-up`)", "Sekunden, bis die Spindel dreht (`spin-up`)";
}

/// Whether a name is one of the parameters that users may set: Q0, Q1 ..., T0, T1 ...
pub(super) fn is_parameter(name: &str) -> bool {
    let digits = name.strip_prefix(['Q', 'T']);
    digits.is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|digit| digit.is_ascii_digit()))
}

/// The values of the variables. A value may refer to other variables.
#[derive(Clone, Debug, Default)]
pub(super) struct Variables {
    values: BTreeMap<Box<str>, Box<str>>,
    /// Names introduced by the definition, with the variables that they stand for.
    aliases: BTreeMap<Box<str>, Box<str>>,
    /// Texts from drawings, file names and options. The values of variables contain a placeholder character for each of these texts, which
    /// are therefore never evaluated.
    texts: Vec<Box<str>>,
    numbers: BTreeMap<Box<str>, usize>,
}

impl Variables {
    /// Creates an empty set of variables. `aliases` are pairs of an alias and the variable it stands for.
    pub(super) fn new<'a>(aliases: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let aliases = aliases.into_iter().map(|(other, own)| (other.into(), own.into())).collect();
        Self { aliases, ..Self::default() }
    }

    /// Returns the variable's own name if `name` is an alias, otherwise `name`.
    pub(super) fn own_name<'a>(&'a self, name: &'a str) -> &'a str {
        self.aliases.get(name).map_or(name, |own| own)
    }

    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.values.get(self.own_name(name)).map(|value| &**value)
    }

    /// Sets a variable to a text that may refer to other variables.
    pub(super) fn assign(&mut self, name: &str, text: &str) {
        let name = self.own_name(name).into();
        self.values.insert(name, text.into());
    }

    /// Removes a variable, given by its own name and not by an alias.
    pub(super) fn remove(&mut self, name: &str) {
        self.values.remove(name);
    }

    pub(super) fn set(&mut self, name: &str, value: f64) {
        self.assign(name, &super::numbers::shortest_text(value));
    }

    /// Sets a variable to a text that is never evaluated.
    pub(super) fn set_text(&mut self, name: &str, text: &str) {
        let number = match self.numbers.get(text) {
            Some(number) => *number,
            None => self.add(text),
        };
        self.assign(name, char_of_text(number).encode_utf8(&mut [0; 4]));
    }

    /// Adds a text and returns its index. If there are more texts than placeholders, the last placeholder is reused.
    fn add(&mut self, text: &str) -> usize {
        if self.texts.len() == MAX_TEXTS {
            self.texts.pop();
        } else {
            self.numbers.insert(text.into(), self.texts.len());
        }
        self.texts.push(text.into());
        self.texts.len() - 1
    }

    /// Returns the text that a placeholder stands for.
    pub(super) fn text(&self, c: char) -> Option<&str> {
        self.texts.get(text_of(c)?).map(|text| &**text)
    }

    /// Replaces the placeholders of a value by their texts. The result is only compared, parsed as a number or used as the name of an inserted file,
    /// never expanded.
    pub(super) fn without_placeholders<'t>(&self, value: &'t str) -> Cow<'t, str> {
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

/// Placeholder at the position of a variable.
pub(super) const VARIABLE_MARK: char = '\u{10FF00}';
/// Placeholder at the position of a variable that does not exist.
pub(super) const UNDEFINED_MARK: char = '\u{10FF01}';
/// First of the placeholder characters that stand for texts.
const FIRST_TEXT: u32 = 0x0010_0000;
/// Number of placeholder characters for texts.
pub(super) const MAX_TEXTS: usize = 0xFE00;
/// First of the 256 placeholder characters that stand for bytes.
const FIRST_BYTE: u32 = 0x0010_FE00;

/// Whether a character is a placeholder for a variable, a text or a byte.
pub(super) fn is_private(c: char) -> bool {
    u32::from(c) >= FIRST_TEXT
}

/// Returns the placeholder of the text with this index.
pub(super) fn char_of_text(index: usize) -> char {
    let index = u32::try_from(index.min(MAX_TEXTS - 1)).unwrap_or(0);
    char::from_u32(FIRST_TEXT + index).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// Returns the index of the text that a placeholder stands for; `None` for other characters.
pub(super) fn text_of(c: char) -> Option<usize> {
    let index = usize::try_from(u32::from(c).checked_sub(FIRST_TEXT)?).ok()?;
    (index < MAX_TEXTS).then_some(index)
}

/// Whether a character marks the position of a variable.
pub(super) fn is_mark(c: char) -> bool {
    c == VARIABLE_MARK
}

/// Returns the placeholder of a byte.
pub(super) fn char_of(byte: u8) -> char {
    char::from_u32(FIRST_BYTE + u32::from(byte)).unwrap_or(char::REPLACEMENT_CHARACTER)
}

/// Returns the byte that a placeholder stands for; `None` for other characters.
pub(super) fn byte_of(c: char) -> Option<u8> {
    u8::try_from(u32::from(c).checked_sub(FIRST_BYTE)?).ok()
}
