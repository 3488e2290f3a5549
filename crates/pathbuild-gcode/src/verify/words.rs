//! Checks that a program contains only known words, and compares its modes with those of another program by the same post. (book: program/reading,
//! "Known words"; book: reference/commands, `emit --check --moves`)
//!
//! A word is known if the post of the program writes it, or if the interpreter executes it. Any other word may change where, how deep or how
//! fast the tool cuts without being noticed.

use std::collections::{BTreeMap, BTreeSet};

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Severity};
use pathbuild_motion::{Action, Axes, Change, Corners, Group, Move, Pace, StatedWord, Step, WordEffect};

use crate::dialect::Dialect;
use crate::interpret::{Options, code_name, interpret_each};
use crate::read::Problems;

/// Sample program from which the words of native programs are collected: see [`crate::native`].
const NATIVE_SAMPLE: &[u8] =
    b"G17 G21 G40 G49 G54 G80 G90 G94\nT1\nG00 Z5\nG00 X0 Y0\nF40 G38.3 Z0\nG4 P4\nM30\n";

/// The words that a post writes.
#[derive(Clone, Debug, Default)]
pub struct PostWords {
    /// G and M words other than motions; codes are times ten.
    codes: BTreeSet<(char, u16)>,
    /// The changes that its programs make and later positions do not show: see [`untracked_change`].
    changes: BTreeSet<String>,
    /// The words that the post writes before the first move: codes (times ten) by group.
    pub(super) lead: BTreeMap<Group, u16>,
    /// Whether the post writes T.
    pub(super) chooses_tools: bool,
    /// The words (codes times ten) with which the post moves to machine positions before the first cut.
    first_places: BTreeSet<u16>,
    /// The greatest feed of the post's rapid moves in mm/min, if rapid moves depend on F.
    pub(super) rapid_feed: Option<f64>,
    /// Words that the post writes but the translation by its definition omits.
    omitted: BTreeSet<String>,
    /// The name of the post's definition, if the definition names no dialect.
    definition: Option<String>,
    /// Whether the post lets the control round corners without limit.
    pub(super) rounds_freely: bool,
    /// Whether the post's programs do not wait for the spindle, so that the control or the operator must.
    pub(super) leaves_spin_up: bool,
    /// Whether the post's first move in the plane begins at a height specified by the program; `None` before that move.
    raises_first: Option<bool>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum ReachedPart {
    /// The first move has not been reached.
    #[default]
    Head,
    /// The first cut has not been reached.
    Approach,
    Cutting,
}

impl ReachedPart {
    fn step(&mut self, step: &Step) {
        match &step.action {
            Action::Move(movement) if movement.pace != Pace::Rapid => *self = Self::Cutting,
            Action::Move(_) if *self == Self::Head => *self = Self::Approach,
            _ => {}
        }
    }
}

impl PostWords {
    /// Returns the words of the native program, for dialects that no post writes.
    pub fn native(dialect: Dialect) -> Self {
        let words = Self::of_programs([NATIVE_SAMPLE], Dialect::Native);
        if dialect == Dialect::Native {
            words
        } else {
            Self { lead: BTreeMap::new(), chooses_tools: false, ..words }
        }
    }

    /// Collects the words of programs written by a post. The initial words are taken from the first program.
    pub fn of_programs<T: AsRef<[u8]>>(programs: impl IntoIterator<Item = T>, dialect: Dialect) -> Self {
        let mut words = Self::default();
        for (index, program) in programs.into_iter().enumerate() {
            let mut progress = if index == 0 { ReachedPart::Head } else { ReachedPart::Approach };
            interpret_each(program.as_ref(), dialect, &Options::default(), &mut |step| {
                progress.step(&step);
                words.collect_words(&step, progress);
            });
        }
        words
    }

    fn collect_words(&mut self, step: &Step, progress: ReachedPart) {
        match &step.action {
            Action::Move(movement) if moves_in_plane(movement) => {
                self.raises_first.get_or_insert(movement.from.known.has(Axes::Z));
            }
            Action::Word(word) => {
                self.codes.insert((word.letter, word.code));
                if word.effect == WordEffect::Place && progress != ReachedPart::Cutting {
                    self.first_places.insert(word.code);
                }
                if let Some(group) = word.group.filter(|group| is_retained(*group))
                    && progress == ReachedPart::Head
                {
                    self.lead.insert(group, word.code);
                }
            }
            Action::SelectTool(_) | Action::ChangeTool(_) => self.chooses_tools = true,
            Action::Change(Change::RapidFeed(feed)) => {
                self.rapid_feed = Some(self.rapid_feed.map_or(*feed, |known| known.max(*feed)));
            }
            Action::Change(Change::Corners(Corners::Rounded(None))) => self.rounds_freely = true,
            Action::Change(change) => self.changes.extend(untracked_change(change)),
            _ => {}
        }
    }

    /// Marks these as the words of a post-processor definition that names no dialect. `name` is the name of the definition; `omitted` are the words
    /// of its output that the translation to RS274 omits.
    pub fn of_definition(self, name: &str, omitted: impl IntoIterator<Item = String>) -> Self {
        Self { omitted: omitted.into_iter().collect(), definition: Some(name.to_owned()), ..self }
    }

    /// Sets whether the post's programs do not wait for the spindle.
    pub fn leaving_spin_up(self, leaves_spin_up: bool) -> Self {
        Self { leaves_spin_up, ..self }
    }

    /// Whether these are the words of a definition without a dialect, so that the control is unknown.
    pub(super) fn is_of_definition(&self) -> bool {
        self.definition.is_some()
    }

    fn foreign_word(&self, word: String, dialect: Dialect, is_strict: bool) -> Diagnostic {
        let severity = if is_strict { Severity::Error } else { Severity::Warning };
        let found = match &self.definition {
            Some(name) => Diagnostic::new(&say::FOREIGN_TO_DEFINITION).quoting("post", name.as_str()),
            None => Diagnostic::new(&say::FOREIGN_WORD).quoting("dialect", dialect.name()),
        };
        Diagnostic { severity, ..found.quoting("word", word) }
    }

    /// Whether the post writes a word, with its code multiplied by ten.
    pub fn has(&self, letter: char, code: u16) -> bool {
        self.codes.contains(&(letter, code))
    }
}

/// Whether a move ends at a known X or Y.
fn moves_in_plane(movement: &Move) -> bool {
    !movement.to.known.and(Axes::XY).is_empty()
}

/// Finds an inclined first move in the plane: it also states Z, although the height before it is unknown.
#[derive(Debug, Default)]
pub struct ProgramStart {
    has_moved_in_plane: bool,
    /// Whether a move to a machine position has left X and Y unchanged, so that it is assumed to have raised the cutter.
    has_gone_home: bool,
}

impl ProgramStart {
    /// Processes the next step. Returns the finding about it; nothing if a move to a machine position has raised the cutter before.
    pub fn step(&mut self, step: &Step) -> Option<Diagnostic> {
        let Action::Move(movement) = &step.action else { return None };
        let is_wrong = self.is_diagonal_start(movement) && !self.has_gone_home;
        is_wrong.then(|| Diagnostic::new(&say::START_ASLANT).at_line(step.line, None))
    }

    /// Processes the next move. Returns whether it is the first one in the plane, and goes from an unknown height to a known one.
    fn is_diagonal_start(&mut self, movement: &Move) -> bool {
        self.has_gone_home |= movement.homes_z() && movement.keeps_xy();
        let is_first = moves_in_plane(movement) && !std::mem::replace(&mut self.has_moved_in_plane, true);
        is_first && movement.to.known.has(Axes::Z) && !movement.from.known.has(Axes::Z)
    }
}

/// Whether a control keeps the state of a group from one program to the next. Motions, tool lengths and corners are checked elsewhere.
fn is_retained(group: Group) -> bool {
    !matches!(
        group,
        Group::NonModal
            | Group::Motion
            | Group::ToolLength
            | Group::PathControl
            | Group::MachineCoordinates
            | Group::Dwell
    )
}

/// Rule that finds unknown words: pass every step of a program, then call [`finish`](Self::finish).
#[derive(Debug)]
pub struct WordRules<'w> {
    words: &'w PostWords,
    dialect: Dialect,
    /// Whether the program must agree with a drawing, or with another program.
    is_strict: bool,
    progress: ReachedPart,
    start: ProgramStart,
    /// Words before the first cut that lead to machine positions to which the post's programs do not move before their first cut. They are harmless
    /// in programs that do not cut.
    early_places: Vec<(u32, StatedWord)>,
    found: BTreeSet<(char, u16)>,
    problems: Problems,
}

impl<'w> WordRules<'w> {
    /// Starts a check for a program in this dialect.
    pub fn new(words: &'w PostWords, dialect: Dialect) -> Self {
        Self {
            words,
            dialect,
            is_strict: false,
            progress: ReachedPart::Head,
            start: ProgramStart::default(),
            early_places: Vec::new(),
            found: BTreeSet::new(),
            problems: Problems::default(),
        }
    }

    /// Like [`new`](Self::new), but every unknown word is an error.
    pub(super) fn strict(words: &'w PostWords, dialect: Dialect) -> Self {
        Self { is_strict: true, ..Self::new(words, dialect) }
    }

    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        self.progress.step(step);
        if self.progress == ReachedPart::Cutting {
            for (line, word) in std::mem::take(&mut self.early_places) {
                self.report(line, word);
            }
        }
        if let Action::Move(movement) = &step.action {
            self.check_start(step.line, movement);
        }
        let Action::Word(word) = &step.action else { return };
        if !self.is_known(*word) {
            self.report(step.line, *word);
        } else if self.is_early_place(*word) {
            self.early_places.push((step.line, *word));
        }
    }

    fn report(&mut self, line: u32, word: StatedWord) {
        let is_new = self.found.insert((word.letter, word.code));
        if !is_new && !self.is_strict {
            return;
        }
        self.report_name(line, code_name(word.letter, word.code));
    }

    /// Checks a word that was omitted when the program was translated by the definition of its post.
    pub fn check_omitted_word(&mut self, line: u32, word: &str) {
        if !self.words.omitted.contains(word) {
            self.report_name(line, word.to_owned());
        }
    }

    fn report_name(&mut self, line: u32, word: String) {
        let (words, dialect, is_strict) = (self.words, self.dialect, self.is_strict);
        self.problems.add_at_line(&say::FOREIGN_WORD, line, |_| words.foreign_word(word, dialect, is_strict));
    }

    /// Checks the first move in the plane. In a comparison, it may be inclined if that of the post's programs is, and a move to a machine position
    /// before it does not count as raising the cutter. (Moves at unknown height are checked in [`super::rules`].)
    fn check_start(&mut self, line: u32, movement: &Move) {
        let is_diagonal_start = self.start.is_diagonal_start(movement);
        let raises_first = self.words.raises_first == Some(true);
        let is_wrong = if self.is_strict { raises_first } else { !self.start.has_gone_home };
        if is_diagonal_start && is_wrong {
            let severity = if self.is_strict { Severity::Error } else { Severity::Warning };
            self.problems.add_at_line(&say::START_ASLANT, line, |d| Diagnostic { severity, ..d });
        }
    }

    fn is_early_place(&self, word: StatedWord) -> bool {
        self.is_strict
            && word.effect == WordEffect::Place
            && self.progress != ReachedPart::Cutting
            && !self.words.first_places.contains(&word.code)
    }

    /// Returns all problems, ordered by line.
    pub fn finish(self) -> Vec<Diagnostic> {
        self.problems.into_diagnostics()
    }

    fn is_known(&self, word: StatedWord) -> bool {
        self.words.has(word.letter, word.code)
            || match word.effect {
                WordEffect::Followed => true,
                WordEffect::System => !self.is_strict && (540..600).any(|code| self.words.has('G', code)),
                WordEffect::Place | WordEffect::Call => !self.is_strict,
                WordEffect::NotFollowed => false,
            }
    }
}

/// Reports words by which a program may move differently from another program although both state the same positions: unsupported words, other
/// coordinate systems, machine positions, tool lengths and tool changes, and modes that only the other program states before its first move. `words`
/// are the words of the other program.
pub fn foreign_modes(steps: &[Step], words: &PostWords, dialect: Dialect) -> Vec<Diagnostic> {
    let mut rules = WordRules::strict(words, dialect);
    let mut missing = words.lead.clone();
    let mut problems = Problems::default();
    for step in steps {
        rules.step(step);
        match &step.action {
            Action::Move(_) => report_missing(&mut missing, step.line, &mut problems),
            Action::Word(word) => {
                if let Some(group) = word.group {
                    missing.remove(&group);
                }
                if is_not_shown_by_positions(*word) && !words.has(word.letter, word.code) {
                    let word = code_name(word.letter, word.code);
                    problems.add_at_line(&say::NOT_IN_DRAWING, step.line, |d| d.quoting("word", word));
                }
            }
            Action::Change(change) => {
                let word = untracked_change(change).filter(|word| !words.changes.contains(word));
                if let Some(word) = word {
                    problems.add_at_line(&say::NOT_IN_DRAWING, step.line, |d| d.quoting("word", word));
                }
            }
            _ => {}
        }
    }
    let mut found = rules.finish();
    found.extend(problems.into_diagnostics());
    found.sort_by_key(|problem| problem.place.line);
    found
}

fn report_missing(missing: &mut BTreeMap<Group, u16>, line: u32, problems: &mut Problems) {
    for code in std::mem::take(missing).into_values() {
        problems.add_at_line(&say::MODE_MISSING, line, |d| d.quoting("word", code_name('G', code)));
    }
}

/// Returns the name of a change that later positions do not show: a zero that only the machine knows, or a parameter.
fn untracked_change(change: &Change) -> Option<String> {
    match change {
        Change::Offsets { code, is_followed: false, .. } => Some(code_name('G', *code)),
        Change::Parameter => Some("#".to_owned()),
        _ => None,
    }
}

/// Whether a word changes the tool, its length or the plane, which the positions of straight moves do not show.
fn is_not_shown_by_positions(word: StatedWord) -> bool {
    matches!(word.group, Some(Group::ToolLength | Group::Plane)) || (word.letter, word.code) == ('M', 60)
}
