//! The macros in CamBam definitions: their names, arguments and meaning.

use pathbuild_diagnostic::{Text, nearest};

use super::machine::{CODES_WITH_SECTION, Code, Form, Register};
use super::section::Section;

/// A parsed macro. Each variant says what the macro expands to.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Macro {
    /// The text of a section, regardless of the state.
    Section(Section),
    /// A number or name of the program, without a letter.
    Value(Value),
    /// A letter with its number.
    Register(Register, Form),
    /// `S` with the spindle speed.
    Speed,
    /// The direction of the spindle with its speed, followed by a dwell until it is reached, if either changes (extension of pathbuild).
    SpindleUp,
    /// The word of a motion or cycle.
    Code {
        code: Code,
        /// Whether the word is omitted if the motion or cycle is already active, as in `{$_g1}`.
        modal: bool,
    },
    /// The section selected by the unit of the program or an option of the definition.
    Choice(Choice),
    /// The words for the state that the operation requires, if the machine is in another state.
    State(State),
    /// A block of entire lines, such as all operations.
    Block(Block),
    /// `{$check(x,y,z)}`: moves there unless the tool is there already.
    Check([Argument; 3]),
    /// `{$set(x,value)}`: sets a register without writing anything. `None` stands for the argument `NaN`, which makes the register
    /// unknown.
    Set(Register, Option<f64>),
    /// `{$set(tool)}`: makes the tool of the operation the current one without writing anything or requiring an M6 (extension of
    /// pathbuild).
    SetTool,
    /// A macro defined by the definition or the configuration.
    User(Box<str>),
}

/// A coordinate passed to `{$check}`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Argument {
    /// Any coordinate: this axis is neither compared nor moved.
    Any,
    /// The coordinate of the current move.
    Own,
    /// A coordinate in the unit of the program.
    Number(f64),
}

impl Value {
    /// Whether the value is a text from the drawing, the configuration or the command line, not a number.
    pub(super) fn is_text(self) -> bool {
        matches!(
            self,
            Self::FileName
                | Self::Date
                | Self::OutFile
                | Self::PartName
                | Self::MopName
                | Self::MopTag
                | Self::ToolName
                | Self::ToolProfile
                | Self::ToolComment
        )
    }

    /// Whether drawings and programs do not always provide the value, so that the definition or the configuration may provide it.
    pub(super) fn may_be_missing(self) -> bool {
        matches!(
            self,
            Self::StockSize(_)
                | Self::StockCorner(_)
                | Self::StockCornerReversed(_)
                | Self::ToolLength
                | Self::ToolProfile
                | Self::ToolComment
                | Self::ToolVeeAngle
        )
    }
}

words! {
    /// The values that macros write without a letter.
    Value:
    FileName "the program's name", "der Name des Programms";
    ProgramNumber "`program-number`, else the first number in the name",
        "`program-number`, sonst die erste Zahl im Namen";
    Date "`--date`, else left out with its line", "`--date`, sonst entfällt es mit seiner Zeile";
    OutFile "the file that is written", "die geschriebene Datei";
    PartName "the requested path", "der angeforderte Pfad";
    MopName "the operation: the path that is embedded", "die Operation: der eingebettete Pfad";
    MopTag "nothing: paths have no tag", "nichts: Pfade haben keine Kennung";
    MopClearancePlane "the height of rapid moves in the plane", "die Höhe der Eilgänge in der Ebene";
    MopRetractHeight "the height at which a rapid move down ends",
        "die Höhe, in der der Eilgang abwärts endet";
    MopPlungeFeedrate "the plunge feed, if one is given", "der Vorschub beim Eintauchen, wenn einer vorliegt";
    MopCutFeedrate "the feed, if one is given", "der Vorschub, wenn einer vorliegt";
    MopDepthIncrement "I, else 0", "I, sonst 0";
    MopDwell "dwell in seconds of the first hole with a dwell, else 0",
        "Wartezeit in Sekunden der ersten Bohrung mit Wartezeit, sonst 0";
    MopHoleDiameter "diameter of a hole: O", "Durchmesser einer Bohrung: O";
    MopPeckDistance "depth of a peck of the first hole drilled in pecks, else 0",
        "Tiefe je Stufe der ersten Bohrung in Stufen, sonst 0";
    MopStockSurface "T", "T";
    MopTargetDepth "the lowest Z that is cut, else T", "das tiefste gefräste Z, sonst T";
    MopFirst(Register) "where the operation begins, if that is known",
        "wo die Operation beginnt, wenn das bekannt ist";
    ToolIndex "the tool's number", "die Nummer des Werkzeugs";
    ToolDiameter "O", "O";
    ToolName "the tool's name", "der Name des Werkzeugs";
    ToolRadius "half of O", "die Hälfte von O";
    ToolLength "length in the tool table", "Länge in der Werkzeugtabelle";
    ToolProfile "profile in the tool table, else `EndMill`", "Form in der Werkzeugtabelle, sonst `EndMill`";
    ToolComment "comment in the tool table, else nothing", "Kommentar in der Werkzeugtabelle, sonst nichts";
    ToolVeeAngle "angle in the tool table", "Winkel in der Werkzeugtabelle";
    MoveAxis(Register) "the value in the current move", "der Wert in der laufenden Bewegung";
    ArcOffset(Register) "from the start of the current arc to its centre",
        "vom Anfang des laufenden Bogens zum Mittelpunkt";
    ArcRadius "radius of the current arc", "Radius des laufenden Bogens";
    ArcStart "start of the current arc in degrees", "Anfang des laufenden Bogens in Grad";
    ArcEnd "end of the current arc in degrees", "Ende des laufenden Bogens in Grad";
    ArcSweep "angle of the current arc in degrees, clockwise positive",
        "Winkel des laufenden Bogens in Grad, im Uhrzeigersinn positiv";
    StockSize(usize) "size of the stock", "Maß des Rohteils";
    StockCorner(usize) "corner of the stock", "Ecke des Rohteils";
    StockCornerReversed(usize) "the same with the opposite sign", "dasselbe mit umgekehrtem Vorzeichen";
}

words! {
    /// Blocks of lines that macros expand to.
    Block:
    Mops "each operation through the section `MOP`", "jede Operation durch den Abschnitt `MOP`";
    Blocks "the moves of the operation", "die Bewegungen der Operation";
    ToolTable "`ToolTableItem` for each tool", "`ToolTableItem` für jedes Werkzeug";
    ToolChange "the section `ToolChange`, unless the tool is already in use",
        "den Abschnitt `ToolChange`, wenn das Werkzeug nicht schon im Einsatz ist";
    FirstToolChange "the same for the first operation's tool",
        "dasselbe für das Werkzeug der ersten Operation";
    Clearance "a rapid move up to the clearance plane, unless the tool is there",
        "einen Eilgang zur Sicherheitsebene, wenn das Werkzeug nicht dort ist";
    FileHeader "custom text before the program; drawings have none",
        "eigener Text vor dem Programm; Zeichnungen haben keinen";
    FileFooter "custom text after the program; drawings have none",
        "eigener Text nach dem Programm; Zeichnungen haben keinen";
    MopHeader "custom text before the operation; drawings have none",
        "eigener Text vor der Operation; Zeichnungen haben keinen";
    MopFooter "custom text after the operation; drawings have none",
        "eigener Text nach der Operation; Zeichnungen haben keinen";
}

words! {
    /// States of the machine that are written only when they change.
    State:
    Velocity "the `VelocityMode...` that the operation needs, if it changes",
        "das `VelocityMode...`, das die Operation braucht, wenn es wechselt";
    WorkPlane "`WorkPlane...`, where it changes", "`WorkPlane...`, wo sie wechselt";
    Spindle "`SpindleCW`, `SpindleCCW` or `SpindleOff`, where it changes",
        "`SpindleCW`, `SpindleCCW` oder `SpindleOff`, wo sich etwas ändert";
    Coolant "`CoolantFlood`, `CoolantMist` or `CoolantOff`, where it changes",
        "`CoolantFlood`, `CoolantMist` oder `CoolantOff`, wo sich etwas ändert";
}

words! {
    /// The criteria by which a macro selects one of two sections.
    Choice:
    Units "`UnitsMM` or `UnitsInches`, by the program", "`UnitsMM` oder `UnitsInches`, nach dem Programm";
    ArcCentre "`ArcCenterAbsolute` or `ArcCenterIncremental`, by the element `ArcCenterMode`",
        "`ArcCenterAbsolute` oder `ArcCenterIncremental`, nach dem Element `ArcCenterMode`";
    LatheX "`XModeRadius`", "`XModeRadius`";
}

/// An error in the arguments of a built-in macro: unexpected, missing, or not supported.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MacroArguments {
    /// The text of the macro without `{$` and `}`.
    pub(super) call: Box<str>,
    /// Permitted arguments, for the message.
    pub(super) expected: &'static Text,
}

impl Value {
    pub(super) fn name(self) -> &'static str {
        MACROS_WITHOUT_ARGUMENTS
            .iter()
            .find(|(_, what)| *what == Macro::Value(self))
            .map_or("", |(name, _)| name)
    }
}

impl Macro {
    /// Parses the text between `{$` and `}`. Names that are not built in are user macros.
    pub(super) fn parse(call: &str) -> Result<Self, MacroArguments> {
        let call = call.trim();
        let (name, arguments) = match call.split_once('(') {
            Some((name, rest)) => (name.trim_end(), Some(rest.strip_suffix(')').unwrap_or(rest).trim())),
            None => (call, None),
        };
        let refuse = |expected| Err(MacroArguments { call: call.into(), expected });
        if let Some(with) = with_arguments(name) {
            return match (with.read)(arguments) {
                Some(what) => Ok(what),
                None => refuse(with.expected),
            };
        }
        match (without_arguments(name), arguments) {
            (Some(_), Some(_)) => refuse(&Text { en: "no arguments", de: "keine Argumente" }),
            (Some(what), None) => Ok(what),
            (None, Some(_)) => Ok(Self::User(call.into())),
            (None, None) => Ok(Self::User(name.into())),
        }
    }

    /// Returns the built-in name most similar to an undefined one.
    pub(super) fn nearest(name: &str) -> Option<&'static str> {
        nearest(
            name,
            MACROS_WITHOUT_ARGUMENTS
                .iter()
                .map(|(name, _)| *name)
                .chain(MACROS_WITH_ARGUMENTS.iter().map(|with| with.name)),
        )
    }
}

fn without_arguments(name: &str) -> Option<Macro> {
    let fixed =
        MACROS_WITHOUT_ARGUMENTS.iter().find(|(known, _)| *known == name).map(|(_, what)| what.clone());
    fixed.or_else(|| code(name)).or_else(|| register(name))
}

/// Parses the name of a motion or cycle, such as `g0` or `_g81`.
fn code(name: &str) -> Option<Macro> {
    let bare = name.strip_prefix('_').unwrap_or(name);
    let number = bare.strip_prefix('g')?;
    let code = CODES_WITH_SECTION.into_iter().find(|(code, _)| code.to_string() == number)?;
    Some(Macro::Code { code, modal: bare.len() < name.len() })
}

/// Parses the name of a register in one of the forms `x`, `_x`, `-x` and `+x`.
fn register(name: &str) -> Option<Macro> {
    let mut letters = name.chars();
    let last = letters.next_back().filter(char::is_ascii_lowercase)?;
    let form = match letters.as_str() {
        "" => Form::Always,
        "_" => Form::Changed,
        "-" => Form::Reversed,
        "+" => Form::Positive,
        _ => return None,
    };
    Register::of(last).map(|register| Macro::Register(register, form))
}

/// A built-in macro that takes arguments.
pub(super) struct MacroWithArguments {
    pub(super) name: &'static str,
    pub(super) expected: &'static Text,
    read: fn(Option<&str>) -> Option<Macro>,
}

fn with_arguments(name: &str) -> Option<&'static MacroWithArguments> {
    MACROS_WITH_ARGUMENTS.iter().find(|with| with.name == name)
}

macro_rules! with_arguments {
    ($($name:literal $read:ident $en:literal, $de:literal;)*) => {
        pub(super) static MACROS_WITH_ARGUMENTS: &[MacroWithArguments] = &[$(MacroWithArguments {
            name: $name,
            expected: &Text { en: $en, de: $de },
            read: $read,
        },)*];
    };
}

with_arguments! {
    "cuttercomp" cutter_compensation "off, L or R", "off, L oder R";
    "toolchange" tool_change "nothing or first", "nichts oder first";
    "spindle" spindle "nothing, up, cw, ccw or off", "nichts, up, cw, ccw oder off";
    "coolant" coolant "nothing, flood, mist or off", "nichts, flood, mist oder off";
    "check" check "three coordinates", "drei Koordinaten";
    "set" set "x, y or z and a number or NaN, or tool", "x, y oder z und eine Zahl oder NaN, oder tool";
}

/// Returns the macro for an argument that must be one of these words, ignoring case.
fn macro_for_word(argument: &str, words: &[(&str, Macro)]) -> Option<Macro> {
    words.iter().find(|(word, _)| word.eq_ignore_ascii_case(argument)).map(|(_, what)| what.clone())
}

fn cutter_compensation(argument: Option<&str>) -> Option<Macro> {
    let words =
        [("off", Section::CutterCompOff), ("l", Section::CutterCompLeft), ("r", Section::CutterCompRight)];
    macro_for_word(argument?, &words.map(|(word, section)| (word, Macro::Section(section))))
}

fn tool_change(argument: Option<&str>) -> Option<Macro> {
    match argument {
        None => Some(Macro::Block(Block::ToolChange)),
        Some("first") => Some(Macro::Block(Block::FirstToolChange)),
        Some(_) => None,
    }
}

fn spindle(argument: Option<&str>) -> Option<Macro> {
    let Some(argument) = argument else { return Some(Macro::State(State::Spindle)) };
    let words = [
        ("up", Macro::SpindleUp),
        ("cw", Macro::Section(Section::SpindleCw)),
        ("ccw", Macro::Section(Section::SpindleCcw)),
        ("off", Macro::Section(Section::SpindleOff)),
    ];
    macro_for_word(argument, &words)
}

fn coolant(argument: Option<&str>) -> Option<Macro> {
    let Some(argument) = argument else { return Some(Macro::State(State::Coolant)) };
    let words =
        [("flood", Section::CoolantFlood), ("mist", Section::CoolantMist), ("off", Section::CoolantOff)];
    macro_for_word(argument, &words.map(|(word, section)| (word, Macro::Section(section))))
}

fn check(arguments: Option<&str>) -> Option<Macro> {
    let mut coordinates = [Argument::Any; 3];
    let mut given = arguments?.split(',');
    for (coordinate, axis) in coordinates.iter_mut().zip(["x", "y", "z"]) {
        *coordinate = match given.next()?.trim() {
            "" => Argument::Any,
            letter if letter == axis => Argument::Own,
            number => Argument::Number(finite(number)?),
        };
    }
    given.next().is_none().then_some(Macro::Check(coordinates))
}

fn set(arguments: Option<&str>) -> Option<Macro> {
    if arguments? == "tool" {
        return Some(Macro::SetTool);
    }
    let (axis, value) = arguments?.split_once(',')?;
    let register =
        Register::AXES.into_iter().find(|r| axis.trim().eq_ignore_ascii_case(&r.letter().to_string()))?;
    let value = match value.trim() {
        "NaN" => None,
        number => Some(finite(number)?),
    };
    Some(Macro::Set(register, value))
}

fn finite(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// All macros without arguments, except registers and codes.
pub(super) static MACROS_WITHOUT_ARGUMENTS: &[(&str, Macro)] = &[
    ("comment", Macro::Section(Section::Comment)),
    ("endcomment", Macro::Section(Section::EndComment)),
    ("header", Macro::Section(Section::Header)),
    ("footer", Macro::Section(Section::Footer)),
    ("distancemode", Macro::Section(Section::DistanceAbsolute)),
    ("spindlecw", Macro::Section(Section::SpindleCw)),
    ("spindleccw", Macro::Section(Section::SpindleCcw)),
    ("spindleoff", Macro::Section(Section::SpindleOff)),
    ("stop", Macro::Section(Section::Stop)),
    ("repeat", Macro::Section(Section::Repeat)),
    ("endrewind", Macro::Section(Section::EndRewind)),
    ("post.toolchange", Macro::Section(Section::ToolChange)),
    ("mops", Macro::Block(Block::Mops)),
    ("blocks", Macro::Block(Block::Blocks)),
    ("tooltable", Macro::Block(Block::ToolTable)),
    ("clearance", Macro::Block(Block::Clearance)),
    ("cbfile.header", Macro::Block(Block::FileHeader)),
    ("cbfile.footer", Macro::Block(Block::FileFooter)),
    ("mop.header", Macro::Block(Block::MopHeader)),
    ("mop.footer", Macro::Block(Block::MopFooter)),
    ("velocitymode", Macro::State(State::Velocity)),
    ("workplane", Macro::State(State::WorkPlane)),
    ("s", Macro::Speed),
    ("units", Macro::Choice(Choice::Units)),
    ("arccentermode", Macro::Choice(Choice::ArcCentre)),
    ("lathexmode", Macro::Choice(Choice::LatheX)),
    ("cbfile.name", Macro::Value(Value::FileName)),
    ("program.number", Macro::Value(Value::ProgramNumber)),
    ("date", Macro::Value(Value::Date)),
    ("outfile", Macro::Value(Value::OutFile)),
    ("part.name", Macro::Value(Value::PartName)),
    ("mop.name", Macro::Value(Value::MopName)),
    ("mop.tag", Macro::Value(Value::MopTag)),
    ("mop.clearanceplane", Macro::Value(Value::MopClearancePlane)),
    ("mop.retractheight", Macro::Value(Value::MopRetractHeight)),
    ("mop.plungefeedrate", Macro::Value(Value::MopPlungeFeedrate)),
    ("mop.cutfeedrate", Macro::Value(Value::MopCutFeedrate)),
    ("mop.depthincrement", Macro::Value(Value::MopDepthIncrement)),
    ("mop.dwell", Macro::Value(Value::MopDwell)),
    ("mop.holediameter", Macro::Value(Value::MopHoleDiameter)),
    ("mop.peckdistance", Macro::Value(Value::MopPeckDistance)),
    ("mop.stocksurface", Macro::Value(Value::MopStockSurface)),
    ("mop.targetdepth", Macro::Value(Value::MopTargetDepth)),
    ("mop.first.x", Macro::Value(Value::MopFirst(Register::X))),
    ("mop.first.y", Macro::Value(Value::MopFirst(Register::Y))),
    ("mop.first.z", Macro::Value(Value::MopFirst(Register::Z))),
    ("tool.index", Macro::Value(Value::ToolIndex)),
    ("tool.diameter", Macro::Value(Value::ToolDiameter)),
    ("tool.name", Macro::Value(Value::ToolName)),
    ("tool.radius", Macro::Value(Value::ToolRadius)),
    ("tool.length", Macro::Value(Value::ToolLength)),
    ("tool.profile", Macro::Value(Value::ToolProfile)),
    ("tool.comment", Macro::Value(Value::ToolComment)),
    ("tool.code", Macro::Value(Value::ToolComment)),
    ("tool.veeangle", Macro::Value(Value::ToolVeeAngle)),
    ("move.x", Macro::Value(Value::MoveAxis(Register::X))),
    ("move.y", Macro::Value(Value::MoveAxis(Register::Y))),
    ("move.z", Macro::Value(Value::MoveAxis(Register::Z))),
    ("move.p", Macro::Value(Value::MoveAxis(Register::P))),
    ("arc.i", Macro::Value(Value::ArcOffset(Register::I))),
    ("arc.j", Macro::Value(Value::ArcOffset(Register::J))),
    ("arc.k", Macro::Value(Value::ArcOffset(Register::K))),
    ("arc.radius", Macro::Value(Value::ArcRadius)),
    ("arc.start", Macro::Value(Value::ArcStart)),
    ("arc.end", Macro::Value(Value::ArcEnd)),
    ("arc.sweep", Macro::Value(Value::ArcSweep)),
    ("stock_width", Macro::Value(Value::StockSize(0))),
    ("stock_length", Macro::Value(Value::StockSize(1))),
    ("stock_height", Macro::Value(Value::StockSize(2))),
    ("stock_x", Macro::Value(Value::StockCorner(0))),
    ("stock_y", Macro::Value(Value::StockCorner(1))),
    ("stock_z", Macro::Value(Value::StockCorner(2))),
    ("-stock_x", Macro::Value(Value::StockCornerReversed(0))),
    ("-stock_y", Macro::Value(Value::StockCornerReversed(1))),
    ("-stock_z", Macro::Value(Value::StockCornerReversed(2))),
];
