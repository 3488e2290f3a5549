//! The state of the machine as the lines written so far leave it.

use pathbuild_motion::{Coolant, Plane, Turning};

use super::registers::{Code, Register};
use crate::job::VelocityMode;
use crate::number::NumberFormat;
use crate::words::{Word, Words};

/// What is known of the machine. `None` is unknown, as everything is at the beginning.
#[derive(Debug, Default)]
pub(super) struct Machine {
    /// The last number of each register as text, so that equal means: would be written the same.
    registers: [Option<Box<str>>; Register::ALL.len()],
    /// The motion or cycle in force: ten times the number behind G.
    motion: Option<u32>,
    /// The tool that was changed to.
    pub(super) tool: Option<u32>,
    /// The T word that no M6 followed yet.
    selected: Option<u32>,
    pub(super) spindle: Option<Turning>,
    /// The last S.
    pub(super) speed: Option<f64>,
    pub(super) coolant: Option<Coolant>,
    pub(super) velocity: Option<VelocityMode>,
    pub(super) plane: Option<Plane>,
    incremental: bool,
}

impl Machine {
    /// The text last written for a register.
    pub(super) fn written(&self, register: Register) -> Option<&str> {
        self.registers[register as usize].as_deref()
    }

    /// The number last written for a register.
    pub(super) fn number(&self, register: Register) -> Option<f64> {
        self.written(register)?.parse().ok()
    }

    /// Sets a register, or makes it unknown.
    pub(super) fn set(&mut self, register: Register, text: Option<String>) {
        self.registers[register as usize] = text.map(Into::into);
    }

    /// Makes registers unknown.
    pub(super) fn forget(&mut self, registers: &[Register]) {
        for &register in registers {
            self.set(register, None);
        }
    }

    /// Whether a motion is in force.
    pub(super) fn is_in(&self, code: Code) -> bool {
        self.motion == Some(code.number() * 10)
    }

    /// Another tool is in. Its spindle stands still on one control and turns on the next.
    pub(super) fn change_tool(&mut self, tool: u32) {
        self.tool = Some(tool);
        self.spindle = None;
    }

    /// Takes note of a line. `code` is the motion that a macro stands for in it, however its section spells it.
    pub(super) fn read(&mut self, line: &Words, code: Option<Code>, format: NumberFormat) {
        if let Some(code) = code {
            self.motion = Some(code.number() * 10);
        }
        let mut moves = Moves::default();
        let tenths =
            |letter: char| line.words.iter().filter(move |word| word.letter == letter).filter_map(tenths);
        tenths('G').for_each(|code| self.general(code, &mut moves));
        if let Some(speed) = line.words.iter().find(|word| word.letter == 'S') {
            self.speed = Some(speed.number);
        }
        if let Some(tool) = tenths('T').next() {
            self.selected = Some(tool / 10);
        }
        tenths('M').for_each(|code| self.miscellaneous(code));
        moves.displaced |= self.incremental;
        self.move_registers(&line.words, &moves, format);
    }

    fn general(&mut self, code: u32, moves: &mut Moves) {
        match code {
            170 => self.plane = Some(Plane::Xy),
            180 => self.plane = Some(Plane::Zx),
            190 => self.plane = Some(Plane::Yz),
            610 => self.velocity = Some(VelocityMode::ExactStop),
            640 => self.velocity = Some(VelocityMode::ConstantVelocity),
            900 => self.incremental = false,
            910 => self.incremental = true,
            40 | 100 => moves.none = true,
            280 | 300 => moves.everywhere = true,
            520 | 530 | 920..=923 => moves.displaced = true,
            800 => self.motion = None,
            0 | 10 | 20 | 30 | 382..=385 | 730 | 810..=890 => self.motion = Some(code),
            _ => {}
        }
    }

    fn miscellaneous(&mut self, code: u32) {
        match code {
            30 => self.spindle = Some(Turning::Clockwise),
            40 => self.spindle = Some(Turning::Counterclockwise),
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

    fn move_registers(&mut self, words: &[Word], moves: &Moves, format: NumberFormat) {
        if moves.everywhere {
            self.forget(&Register::AXES);
        }
        let mut moved = false;
        for word in words {
            let Some(register) = Register::of(word.letter) else { continue };
            let is_axis = Register::AXES.contains(&register);
            if is_axis && moves.none {
                continue;
            }
            moved |= is_axis;
            let known = !(is_axis && (moves.displaced || moves.everywhere));
            self.set(register, known.then(|| format.format(word.number)));
        }
        if moved && self.motion.is_some_and(|motion| motion == 730 || (810..=890).contains(&motion)) {
            // A cycle leaves the tool at R, as far as the post is concerned, wherever the control takes it then.
            let retract = self.written(Register::R).map(str::to_owned);
            self.set(Register::Z, retract);
        }
    }
}

/// What the axis words of a line are.
#[derive(Default)]
struct Moves {
    /// No coordinates of the tool at all (G4, G10).
    none: bool,
    /// Coordinates of another system, or relative ones: where the tool is afterwards is not known.
    displaced: bool,
    /// Points on the way to a fixed place (G28, G30).
    everywhere: bool,
}

/// Ten times a word's number; none for numbers that no code has.
fn tenths(word: &Word) -> Option<u32> {
    let tenths = (word.number * 10.0).round();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
    (0.0..=1e6).contains(&tenths).then_some(tenths as u32)
}
