//! The names of macros and their arguments.

use pathbuild_diagnostic::{Text, nearest};

use super::macros::{Argument, Block, Choice, Macro, State, Value};
use super::registers::{Code, Form, Register};
use super::section::{Section, coolant_section, spindle_section};
use pathbuild_motion::{Coolant, Turning};

/// An error in the arguments of a built-in macro: unexpected, missing, or not supported.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MacroArguments {
    /// The call without `{$` and `}`.
    pub(super) call: Box<str>,
    /// Permitted arguments.
    pub(super) expected: &'static Text,
}

impl Value {
    /// The name of the macro.
    pub(super) fn name(self) -> &'static str {
        FIXED.iter().find(|(_, what)| *what == Macro::Value(self)).map_or("", |(name, _)| name)
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

    /// The built-in name most similar to an undefined one.
    pub(super) fn nearest(name: &str) -> Option<&'static str> {
        nearest(name, FIXED.iter().map(|(name, _)| *name).chain(WITH.iter().map(|with| with.name)))
    }
}

fn without_arguments(name: &str) -> Option<Macro> {
    let fixed = FIXED.iter().find(|(known, _)| *known == name).map(|(_, what)| what.clone());
    fixed.or_else(|| code(name)).or_else(|| register(name))
}

/// Parses `g0`, `_g81`.
fn code(name: &str) -> Option<Macro> {
    let bare = name.strip_prefix('_').unwrap_or(name);
    let number = bare.strip_prefix('g')?;
    let code = Code::ALL.into_iter().find(|code| code.number().to_string() == number)?;
    Some(Macro::Code { code, modal: bare.len() < name.len() })
}

/// Parses `x`, `_x`, `-x`, `+x`.
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

/// A macro with arguments.
pub(super) struct MacroWithArguments {
    pub(super) name: &'static str,
    pub(super) expected: &'static Text,
    read: fn(Option<&str>) -> Option<Macro>,
}

fn with_arguments(name: &str) -> Option<&'static MacroWithArguments> {
    WITH.iter().find(|with| with.name == name)
}

/// All macros with arguments.
pub(super) static WITH: &[MacroWithArguments] = &[
    MacroWithArguments {
        name: "cuttercomp",
        expected: &Text { en: "off, L or R", de: "off, L oder R" },
        read: cutter_compensation,
    },
    MacroWithArguments {
        name: "toolchange",
        expected: &Text { en: "nothing or first", de: "nichts oder first" },
        read: tool_change,
    },
    MacroWithArguments {
        name: "spindle",
        expected: &Text { en: "nothing, up, cw, ccw or off", de: "nichts, up, cw, ccw oder off" },
        read: spindle,
    },
    MacroWithArguments {
        name: "coolant",
        expected: &Text { en: "nothing, flood, mist or off", de: "nichts, flood, mist oder off" },
        read: coolant,
    },
    MacroWithArguments {
        name: "check",
        expected: &Text { en: "three coordinates", de: "drei Koordinaten" },
        read: check,
    },
    MacroWithArguments {
        name: "set",
        expected: &Text {
            en: "x, y or z and a number or NaN, or tool",
            de: "x, y oder z und eine Zahl oder NaN, oder tool",
        },
        read: set,
    },
];

fn cutter_compensation(argument: Option<&str>) -> Option<Macro> {
    Some(Macro::Section(match argument?.to_ascii_lowercase().as_str() {
        "off" => Section::CutterCompOff,
        "l" => Section::CutterCompLeft,
        "r" => Section::CutterCompRight,
        _ => return None,
    }))
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
    if argument.eq_ignore_ascii_case("up") {
        return Some(Macro::SpindleUp);
    }
    Some(Macro::Section(match argument.to_ascii_lowercase().as_str() {
        "cw" => spindle_section(Turning::Clockwise),
        "ccw" => spindle_section(Turning::CounterClockwise),
        "off" => spindle_section(Turning::Off),
        _ => return None,
    }))
}

fn coolant(argument: Option<&str>) -> Option<Macro> {
    let Some(argument) = argument else { return Some(Macro::State(State::Coolant)) };
    Some(Macro::Section(match argument.to_ascii_lowercase().as_str() {
        "flood" => coolant_section(Coolant::FLOOD),
        "mist" => coolant_section(Coolant::MIST),
        "off" => coolant_section(Coolant::OFF),
        _ => return None,
    }))
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
pub(super) static FIXED: &[(&str, Macro)] = &[
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
