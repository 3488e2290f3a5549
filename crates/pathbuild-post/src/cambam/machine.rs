//! The registers and codes of the machine, and its state after the lines written so far.

use pathbuild_motion::{Coolant, Plane, Turning};

use super::section::Section;
use crate::VelocityMode;
use crate::line_words::{LineWords, Word};
use crate::number::NumberFormat;

/// State of the machine as far as it is known. `None` means unknown. At the beginning nothing is known, but coordinates count as absolute.
#[derive(Debug, Default)]
pub(super) struct Machine {
    /// The last number of each register as text, so that two numbers are equal if they would be written in the same way.
    registers: [Option<Box<str>>; Register::ALL.len()],
    /// The active motion or cycle: ten times the number of its G code.
    motion: Option<u32>,
    /// The tool in the spindle, according to the last tool change.
    pub(super) tool: Option<u32>,
    /// The number of the last T word, which M6 inserts.
    selected: Option<u32>,
    pub(super) spindle: Option<Turning>,
    /// The spindle speed, from the last S word.
    pub(super) speed: Option<f64>,
    pub(super) coolant: Option<Coolant>,
    pub(super) velocity: Option<VelocityMode>,
    pub(super) plane: Option<Plane>,
    incremental: bool,
}

impl Machine {
    /// Returns the text last written for a register; `None` if it is unknown.
    pub(super) fn last_text(&self, register: Register) -> Option<&str> {
        self.registers[register as usize].as_deref()
    }

    /// Returns the number last written for a register, in the output unit; `None` if it is unknown.
    pub(super) fn number(&self, register: Register) -> Option<f64> {
        self.last_text(register)?.parse().ok()
    }

    pub(super) fn set(&mut self, register: Register, text: Option<String>) {
        self.registers[register as usize] = text.map(Into::into);
    }

    /// Marks registers as unknown.
    pub(super) fn forget(&mut self, registers: &[Register]) {
        for &register in registers {
            self.set(register, None);
        }
    }

    pub(super) fn is_active(&self, (number, _): Code) -> bool {
        self.motion == Some(number * 10)
    }

    /// Records a tool change. The spindle's state is unknown afterwards, because some controls stop it and others do not.
    pub(super) fn change_tool(&mut self, tool: u32) {
        self.tool = Some(tool);
        self.spindle = None;
    }

    /// Updates the state after a line. `code` is the motion of a macro in that line; it applies even if the macro's section writes other words.
    pub(super) fn read(&mut self, line: &LineWords, code: Option<Code>, format: NumberFormat) {
        if let Some((number, _)) = code {
            self.motion = Some(number * 10);
        }
        let mut moves = AxisWords::default();
        let tenths =
            |letter: char| line.words.iter().filter(move |word| word.letter == letter).filter_map(tenths);
        tenths('G').for_each(|code| self.apply_g_code(code, &mut moves));
        if let Some(speed) = line.words.iter().find(|word| word.letter == 'S') {
            self.speed = Some(speed.number);
        }
        if let Some(tool) = tenths('T').next() {
            self.selected = Some(tool / 10);
        }
        tenths('M').for_each(|code| self.apply_m_code(code));
        moves.is_position_unknown |= self.incremental;
        self.apply_registers(&line.words, &moves, format);
    }

    fn apply_g_code(&mut self, code: u32, moves: &mut AxisWords) {
        match code {
            170 => self.plane = Some(Plane::Xy),
            180 => self.plane = Some(Plane::Zx),
            190 => self.plane = Some(Plane::Yz),
            610 => self.velocity = Some(VelocityMode::ExactStop),
            640 => self.velocity = Some(VelocityMode::ConstantVelocity),
            900 => self.incremental = false,
            910 => self.incremental = true,
            40 | 100 => moves.is_no_position = true,
            280 | 300 => moves.is_intermediate_point = true,
            520 | 530 | 920..=923 => moves.is_position_unknown = true,
            800 => self.motion = None,
            0 | 10 | 20 | 30 | 382..=385 | 730 | 810..=890 => self.motion = Some(code),
            _ => {}
        }
    }

    fn apply_m_code(&mut self, code: u32) {
        match code {
            30 => self.spindle = Some(Turning::Clockwise),
            40 => self.spindle = Some(Turning::CounterClockwise),
            50 => self.spindle = Some(Turning::Off),
            60 => {
                self.tool = self.selected.or(self.tool);
                self.spindle = None;
            }
            70 => self.coolant = Some(Coolant::MIST),
            80 => self.coolant = Some(Coolant::FLOOD),
            90 => self.coolant = Some(Coolant::OFF),
            _ => {}
        }
    }

    /// Updates the registers from the words of a line.
    fn apply_registers(&mut self, words: &[Word], axis_words: &AxisWords, format: NumberFormat) {
        if axis_words.is_intermediate_point {
            self.forget(&Register::AXES);
        }
        let mut moved = false;
        for word in words {
            let Some(register) = Register::of(word.letter) else { continue };
            let is_axis = Register::AXES.contains(&register);
            if is_axis && axis_words.is_no_position {
                continue;
            }
            moved |= is_axis;
            let known = !(is_axis && (axis_words.is_position_unknown || axis_words.is_intermediate_point));
            self.set(register, known.then(|| format.format(word.number)));
        }
        if moved && self.motion.is_some_and(|motion| motion == 730 || (810..=890).contains(&motion)) {
            // The Z of a cycle is the bottom of the hole, where the tool does not stay. The state places the tool at R, although a control may
            // retract it higher (G98).
            let retract = self.last_text(Register::R).map(str::to_owned);
            self.set(Register::Z, retract);
        }
    }
}

/// The meaning of the axis words in a line.
#[derive(Default)]
struct AxisWords {
    /// Whether the axis words are not coordinates of the tool (G4, G10).
    is_no_position: bool,
    /// Whether the axis words are in another coordinate system or relative, so that the position afterwards is unknown.
    is_position_unknown: bool,
    /// Whether the axis words are an intermediate point on the way to a fixed position (G28, G30).
    is_intermediate_point: bool,
}

/// Returns ten times the number of a word, or `None` if no code has such a number.
fn tenths(word: &Word) -> Option<u32> {
    let tenths = (word.number * 10.0).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    (0.0..=1e6).contains(&tenths).then_some(tenths as u32)
}

/// A letter whose last number the writer remembers, as the control does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Register {
    X,
    Y,
    Z,
    A,
    B,
    C,
    F,
    I,
    J,
    K,
    P,
    Q,
    R,
}

impl Register {
    /// All registers, in the order of the variants.
    pub(super) const ALL: [Self; 13] = [
        Self::X,
        Self::Y,
        Self::Z,
        Self::A,
        Self::B,
        Self::C,
        Self::F,
        Self::I,
        Self::J,
        Self::K,
        Self::P,
        Self::Q,
        Self::R,
    ];
    pub(super) const AXES: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Returns the register of a letter, which may be in lower case.
    pub(super) fn of(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|register| register.letter() == letter.to_ascii_uppercase())
    }

    /// Returns the register's letter in upper case.
    pub(super) fn letter(self) -> char {
        char::from(b"XYZABCFIJKPQR"[self as usize])
    }
}

/// The forms of a register macro, which decide when and how its number is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// `{$x}`: the number is always written.
    Always,
    /// `{$_x}`: the number is only written if it differs from the last one written.
    Changed,
    /// `{$-x}`: the number is written with reversed sign.
    Reversed,
    /// `{$+x}`: the number is written without its sign.
    Positive,
}

/// A motion or cycle that has its own section: the number after G, and the section.
pub(super) type Code = (u32, Section);

/// The motions and cycles that have a section of their own.
pub(super) const CODES_WITH_SECTION: [Code; 7] = [
    (0, Section::G0),
    (1, Section::G1),
    (2, Section::G2),
    (3, Section::G3),
    (81, Section::G81),
    (82, Section::G82),
    (83, Section::G83),
];

#[derive(Debug, Default)]
pub(super) struct MoveValues {
    registers: [Option<f64>; Register::ALL.len()],
    /// Values of the arc; `None` for a straight move.
    pub(super) arc: Option<ArcValues>,
}

/// The values of an arc: lengths in the output unit, angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArcValues {
    pub(super) radius: f64,
    pub(super) start: f64,
    pub(super) end: f64,
    /// Angle swept by the arc, positive if clockwise.
    pub(super) sweep: f64,
}

impl MoveValues {
    pub(super) fn get(&self, register: Register) -> Option<f64> {
        self.registers[register as usize]
    }

    pub(super) fn set(&mut self, register: Register, value: Option<f64>) {
        self.registers[register as usize] = value;
    }
}
