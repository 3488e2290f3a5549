//! Executes all words of a block that cause no move: tools, spindle, coolant, dwells, modes, stops.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message, Text};
use pathbuild_motion::{Action, Axes, Change, Coolant, Corners, Group, Move, ToolLength, Turning};

use super::codes::{self, Command, FeedUnit, Motion, ValueOwner};
use super::execute::{Interpreter, Slot, Values, limits, whole_number};
use super::state::{INCH, StatedLength};
use crate::dialect::{DwellUnit, FeedMode, UnitChange};
use crate::read::{Block, Span};

/// M codes (times ten) that switch or orient the spindle.
pub(super) const SPINDLE: &[u16] = &[30, 40, 50, 190];
pub(super) const STOPS: &[u16] = &[0, 10, 20, 300, 600];
pub(super) const TOOL: &[u16] = &[60, 610];
pub(super) const COOLANT: &[u16] = &[70, 80, 90];
/// M codes that are not executed, although they change the order of lines, the modes, the number of the tool or the feed. Those in [`CALLS`] are
/// executed in dialects with program numbers.
const UNSUPPORTED_M_CODES: &[u16] = &[470, 610, 700, 710, 720, 730, 970, 980, 990, 2200];
/// M codes that call and end subprograms.
pub(super) const CALLS: &[u16] = &[970, 980, 990];

impl Interpreter<'_> {
    pub(super) fn apply_tool_words(&mut self, block: &Block<'_>) {
        let change = self.words.m_code(&[60]);
        let is_value = self.rules.one_command && change.is_none() && !self.words.m_codes.is_empty();
        let tool = if is_value { None } else { self.words.values.take_slot(b'T') };
        let is_named = tool.is_some();
        if let Some(slot) = tool {
            match whole_number(slot.value) {
                Some(number) => {
                    self.state.tool = Some(number);
                    if change.is_none() {
                        self.step(block, Action::SelectTool(number));
                    }
                }
                None => self.report_out_of_range(block, "T", slot, &limits::COUNT),
            }
        }
        let Some((_, span)) = change else { return };
        if self.rules.layers && !is_named {
            return self.report(block, &say::NEEDS, span, |d| {
                d.quoting("word", "M6").with("missing", &limits::NUMBER_OF_LAYER)
            });
        }
        self.step(block, Action::ChangeTool(self.state.tool));
        if matches!(self.state.motion, Motion::Cycle(_)) {
            self.state.change_within_cycle = Some(block.line);
        }
        if self.rules.layers {
            self.enter_layer(block, self.state.tool.unwrap_or(0));
        } else {
            self.state.stated_axes = Axes::NONE;
            self.state.forget_stated_positions();
        }
        let is_turning = self.state.spindle.turning.is_on();
        if is_turning && !self.rules.layers {
            self.state.spindle.turning = Turning::Off;
            self.step(block, Action::Spindle(self.state.spindle));
        }
    }

    /// Changes the layer. Each layer has its own speed, so the speed of the previous layer no longer applies.
    fn enter_layer(&mut self, block: &Block<'_>, layer: u32) {
        self.state.layer = layer;
        let speeds = &self.state.layer_speeds;
        let known = speeds.iter().find(|(other, _)| *other == layer).map(|(_, speed)| *speed);
        if self.state.spindle.speed != known {
            self.state.spindle.speed = known;
            self.step(block, Action::Spindle(self.state.spindle));
        }
    }

    pub(super) fn apply_spindle_and_coolant(&mut self, block: &Block<'_>) {
        let turning = self.words.m_code(SPINDLE).and_then(|(code, _)| match code {
            30 => Some(Turning::Clockwise),
            40 => Some(Turning::CounterClockwise),
            // M19 stops the spindle at an angle, where it stays until M3 or M4.
            50 | 190 => Some(Turning::Off),
            _ => None,
        });
        if let Some(turning) = turning {
            self.state.spindle.turning = turning;
        }
        let has_speed = self.words.values.has(b'S') && !self.rules.one_command;
        if turning.is_some() || has_speed {
            self.step(block, Action::Spindle(self.state.spindle));
        }
        let before = self.state.coolant;
        for &(code, _) in &self.words.m_codes {
            match code {
                70 => self.state.coolant.mist = true,
                80 => self.state.coolant.flood = true,
                90 => self.state.coolant = Coolant::default(),
                _ => {}
            }
        }
        for index in 0..self.words.m_codes.len() {
            let (code, _) = self.words.m_codes[index];
            if !is_executed_m(code) {
                self.step(block, Action::Change(Change::Switch(code)));
            }
        }
        if self.state.coolant != before {
            self.step(block, Action::Coolant(self.state.coolant));
        }
        if let Some((code, span)) =
            self.words.m_codes.iter().find(|(code, _)| self.is_unsupported(*code)).copied()
        {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", codes::name('M', code)));
            self.mark_all_used();
        }
    }

    /// Whether an M code calls or ends a subprogram in this dialect.
    pub(super) fn is_subprogram_code(&self, m_code: u16) -> bool {
        self.rules.program_numbers && CALLS.contains(&m_code)
    }

    fn is_unsupported(&self, m_code: u16) -> bool {
        let words = self.rules.words;
        let is_own = words.own_m_codes && (1000..2000).contains(&m_code) || words.m_own.contains(&m_code);
        let is_inert = words.inert('M', m_code).is_some();
        is_unsupported_m(m_code) && !self.is_subprogram_code(m_code) && !is_inert || is_own
    }

    /// Returns the time in seconds of the block's G4, if any. Removes the letters that state it, so that F and S do not set the feed and the speed.
    pub(super) fn dwell_time(&mut self, block: &Block<'_>) -> Option<f64> {
        let (.., span) = self.words.command_of_group(Group::Dwell)?;
        let rules = &self.rules.dwell;
        let stated = rules.seconds.iter().find_map(|letter| self.words.values.remove(*letter));
        let turns = if rules.counts_turns { self.words.values.remove(b'S') } else { None };
        let time = match (stated, turns) {
            (Some(slot), _) => Some((slot, slot.value)),
            (None, Some(slot)) => Some((slot, self.seconds_of_turns(block, slot))),
            (None, None) => self.words.values.take_slot(b'P').map(|slot| (slot, self.seconds(block, slot))),
        };
        match time {
            Some((slot, time)) if time < 0.0 => self.report_out_of_range(block, "P", slot, &limits::SECONDS),
            Some((_, time)) => return Some(time),
            None => {
                self.report(block, &say::NEEDS, span, |d| d.quoting("word", "G4").quoting("missing", "P"));
            }
        }
        None
    }

    /// Returns the time in seconds that the spindle needs for a number of turns.
    fn seconds_of_turns(&mut self, block: &Block<'_>, turns: Slot) -> f64 {
        let speed = self.state.spindle.speed.filter(|speed| *speed > 0.0);
        if speed.is_none() {
            self.report(block, &say::TURNS_WITHOUT_SPEED, turns.span, |d| d);
        }
        speed.map_or(0.0, |speed| 60.0 * turns.value / speed)
    }

    /// Returns the time in seconds given by P in a dwell or a cycle.
    pub(super) fn seconds(&self, block: &Block<'_>, p: Slot) -> f64 {
        match self.rules.dwell.p {
            DwellUnit::BySetting if self.options.milliseconds => p.value / 1000.0,
            DwellUnit::Seconds | DwellUnit::BySetting => p.value,
            DwellUnit::ByPoint if block.slice(p.span).contains(&b'.') => p.value,
            DwellUnit::ByPoint | DwellUnit::Milliseconds => p.value / 1000.0,
        }
    }

    /// Handles O, the program number, which may occur once at the beginning.
    pub(super) fn program_number(&mut self, block: &Block<'_>) {
        let Some(slot) = self.words.values.take_slot(b'O') else { return };
        let Some(number) = whole_number(slot.value).filter(|number| *number > 0) else {
            return self.report(block, &say::PROGRAM_NUMBER, slot.span, |d| d.with("value", slot.value));
        };
        if self.begins_subprogram {
            return;
        }
        if std::mem::replace(&mut self.state.stated.program_number, true) {
            return self.report(block, &say::NOT_FOLLOWED, slot.span, |d| d.quoting("word", "O"));
        }
        self.main_number = Some(number);
        self.step(block, Action::ProgramNumber(number));
    }

    pub(super) fn apply_modes(&mut self, block: &Block<'_>) {
        for index in 0..self.words.commands.len() {
            let (command, code, span) = self.words.commands[index];
            match command {
                Command::Plane(plane) => {
                    if plane != self.state.plane {
                        self.step(block, Action::Change(Change::Plane(plane)));
                    }
                    self.state.plane = plane;
                    self.state.stated.plane = true;
                }
                Command::Inches(inches) => self.set_units(block, inches, code, span),
                Command::NoEffect(Group::ToolLength) => self.tool_length(block, code, span),
                Command::LengthByNumber => self.length_by_number(block, code, span),
                Command::NoEffect(Group::PathControl) => self.set_corners(block, code),
                Command::Incremental(incremental) => {
                    self.state.incremental = incremental;
                    self.state.stated.distance = true;
                }
                Command::IncrementalCentres(incremental) => {
                    self.state.incremental_centres = incremental;
                    self.state.stated.centres = true;
                }
                Command::RetractToR(to_r) => {
                    self.state.retract_to_r = to_r;
                    self.state.stated.retract_mode = true;
                }
                Command::System(system) => {
                    if let Some(system) = self.numbered_system(block, code, span, Some(system)) {
                        self.select_system(block, system, span);
                    }
                }
                Command::NumberedSystem => {
                    if let Some(system) = self.numbered_system(block, code, span, None) {
                        self.select_system(block, system, span);
                    }
                }
                Command::NotFollowed(group) if group != Group::Motion => {
                    self.report(block, &say::NOT_FOLLOWED, span, |d| {
                        d.quoting("word", codes::name('G', code))
                    });
                    self.mark_all_used();
                }
                _ => {}
            }
        }
    }

    /// Sets the tool length to the numbers in the line. If the tool has cut before, a different length displaces its tip.
    fn length_by_number(&mut self, block: &Block<'_>, code: u16, span: Span) {
        self.check_length_axis(block, span);
        self.tool_length(block, code, span);
        let motion = self.words.command_of_group(Group::Motion);
        if motion.is_some_and(|(command, ..)| command.takes_coordinates()) {
            // The line is reported elsewhere, because two of its words use the coordinates.
            return;
        }
        let given = self.words.values.take_coordinates();
        self.words.values.discard_coordinates();
        let axes = || (0..3).filter(|axis| given[*axis].is_some());
        if axes().any(|axis| self.state.offsets.is_length_unknown(axis)) {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "G43.1"));
        }
        if !self.state.offsets.has_cut_with_length() {
            let known = &mut self.state.position.known;
            *known = axes().fold(*known, |known, axis| known.without(Axes::of(axis)));
        }
        let lengths = given.map(|slot| slot.map(|slot| self.millimetres(slot)));
        self.state.offsets.set_length_along(lengths);
    }

    /// Reports G43.1 unless Z is its only axis. GRBL rejects it ("G43.1 dynamic axis error"); LinuxCNC accepts all axes.
    fn check_length_axis(&mut self, block: &Block<'_>, span: Span) {
        let axes = Values::AXES.map(|axis| self.words.values.has(axis));
        let takes_all = self.rules.words.has_g(432);
        if !takes_all && axes != [false, false, true] {
            self.report(block, &say::NEEDS, span, |d| d.quoting("word", "G43.1").quoting("missing", "Z"));
        }
    }

    /// Executes a word for the tool length, such as G43 or G49. The position of the tool's tip does not depend on the length in H, unless G43.2 adds
    /// a second length.
    fn tool_length(&mut self, block: &Block<'_>, code: u16, span: Span) {
        if code == 432 {
            self.report(block, &say::NOT_FOLLOWED, span, |d| d.quoting("word", "G43.2"));
        }
        let takes_offsets = self.rules.keeps_offsets;
        let entry =
            if takes_offsets || matches!(code, 430 | 432) { self.words.values.take(b'H') } else { None };
        if takes_offsets {
            self.words.values.take(b'D');
        }
        // Some controls apply the length along the axes in the line.
        let is_across =
            [b'X', b'Y'].iter().any(|axis| self.words.values.has(*axis)) && !self.words.values.has(b'Z');
        let length = match (code, entry.map(whole_number)) {
            (430, _) if is_across => ToolLength::Other(code),
            (490, _) => ToolLength::Off,
            (430, None) => ToolLength::OfTool(None),
            (430, Some(Some(number))) => ToolLength::OfTool(Some(number)),
            _ => ToolLength::Other(code),
        };
        if !is_across && matches!(length, ToolLength::Off | ToolLength::OfTool(_)) {
            // The tip's Z changes here although the tool does not move, so Z no longer counts as stated.
            self.state.stated_since_stop = self.state.stated_since_stop.without(Axes::Z);
        }
        if code != 431 {
            self.state.offsets.set_length((code == 490).then_some(0.0));
        }
        self.step(block, Action::Change(Change::ToolLength(length)));
    }

    fn set_corners(&mut self, block: &Block<'_>, code: u16) {
        let corners = if code == 640 {
            let unit = self.state.unit;
            let most = self.words.values.take(b'P').map(|most| most * unit);
            let joined = self.words.values.take(b'Q').map_or(0.0, |joined| joined * unit);
            Corners::Rounded(most.map(|most| most.max(joined)))
        } else {
            Corners::Exact
        };
        self.step(block, Action::Change(Change::Corners(corners)));
    }

    /// Marks the values of the letters D to W as used, so that those of an unsupported command are not reported separately.
    pub(super) fn mark_all_used(&mut self) {
        for letter in b'D'..=b'W' {
            self.words.values.take(letter);
        }
    }

    pub(super) fn apply_stop(&mut self, block: &Block<'_>) {
        match self.words.m_code(STOPS) {
            Some((20 | 300, _)) => {
                self.ended = true;
                self.step(block, Action::End);
            }
            Some((code, _)) => {
                if self.rules.one_command {
                    // S and P of M0 and M1 are the maximum time that the control waits.
                    self.words.values.take(b'S');
                    self.words.values.take(b'P');
                }
                if self.rules.stop_is_complete {
                    self.switch_off(block);
                }
                self.state.forget_stated_positions();
                self.step(block, Action::Stop { optional: code == 10 });
            }
            None => {}
        }
    }

    /// Switches spindle and coolant off if they are on.
    fn switch_off(&mut self, block: &Block<'_>) {
        if self.state.spindle.turning.is_on() {
            self.state.spindle.turning = Turning::Off;
            self.step(block, Action::Spindle(self.state.spindle));
        }
        if std::mem::take(&mut self.state.coolant) != Coolant::default() {
            self.step(block, Action::Coolant(self.state.coolant));
        }
    }

    pub(super) fn check_stop_before_motion(&mut self, block: &Block<'_>) {
        if let Some((code, span)) = self.words.m_code(&[50, 90]) {
            self.report(block, &say::STOP_BEFORE_MOTION, span, |d| d.quoting("word", codes::name('M', code)));
        }
    }
}

pub(super) fn is_unsupported_m(m_code: u16) -> bool {
    UNSUPPORTED_M_CODES.contains(&m_code)
}

/// Whether the interpreter executes an M code: stops, tools, spindle, coolant. All others become a [`Change::Switch`].
pub(super) fn is_executed_m(m_code: u16) -> bool {
    [STOPS, TOOL, COOLANT].iter().any(|group| group.contains(&m_code)) || matches!(m_code, 30 | 40 | 50)
}

const MILLIMETRES: Text = Text { en: "millimetres", de: "Millimeter" };
const INCHES: Text = Text { en: "inches", de: "Zoll" };

impl Interpreter<'_> {
    pub(super) fn set_feed_mode(&mut self, block: &Block<'_>) {
        let Some((Command::FeedMode(unit), code, _)) = self.words.command_of_group(Group::FeedMode) else {
            return;
        };
        if self.rules.feed_mode == FeedMode::ClearsFeed || unit != self.state.feed_unit {
            self.state.feed = 0.0;
            self.state.feed_cleared = Some((block.line, code));
        }
        self.state.feed_unit = unit;
    }

    pub(super) fn set_feed(&mut self, block: &Block<'_>) {
        if self.owner_of_values(block) != ValueOwner::Move {
            return;
        }
        let Some(slot) = self.words.values.take_slot(b'F') else { return };
        if self.rules.layers && self.options.ignore_feed {
            return self.report(block, &say::FEED_IGNORED, slot.span, |d| d);
        }
        let unit = match self.words.command_of_group(Group::Units) {
            Some((Command::Inches(inches), ..)) => unit_of(inches),
            _ => self.state.unit,
        };
        let is_inverse = self.state.feed_unit == FeedUnit::InverseTime;
        self.state.feed = if is_inverse { slot.value } else { slot.value * unit };
        self.state.feed_stated = (!is_inverse).then_some(StatedLength { line: block.line, unit });
        self.state.feed_cleared = None;
        self.state.stated.feed_missing = false;
    }

    pub(super) fn set_speed(&mut self, block: &Block<'_>) {
        let belongs_elsewhere = self.rules.one_command && self.words.m_code(SPINDLE).is_none();
        let Some(slot) = self.words.values.peek(b'S').filter(|_| !belongs_elsewhere) else { return };
        self.words.values.take(b'S');
        if slot.value < 0.0 {
            return self.report_out_of_range(block, "S", slot, &limits::NOT_NEGATIVE);
        }
        // XpertMILL starts the spindle of a layer by the layer's S, and has no M5: with S0, the tool would cut with the spindle stopped.
        if self.rules.layers && slot.value == 0.0 {
            return self.report_out_of_range(block, "S", slot, &limits::POSITIVE);
        }
        self.state.spindle.speed = Some(slot.value);
        if !self.rules.layers {
            return;
        }
        let layer = self.layer_of_block();
        let speeds = &mut self.state.layer_speeds;
        let Some((_, speed)) = speeds.iter_mut().find(|(known, _)| *known == layer) else {
            speeds.push((layer, slot.value));
            return;
        };
        let old = std::mem::replace(speed, slot.value);
        if old != slot.value {
            self.report(block, &say::SPEED_REPLACED, slot.span, |d| {
                d.with("layer", u64::from(layer)).with("old", old).with("new", slot.value)
            });
        }
    }

    /// Returns the layer to which the words of the block apply. M6 selects it before they take effect.
    fn layer_of_block(&self) -> u32 {
        let chosen = self.words.m_code(TOOL).and_then(|_| self.words.values.peek(b'T'));
        chosen.and_then(|slot| whole_number(slot.value)).unwrap_or(self.state.layer)
    }

    pub(super) fn set_units(&mut self, block: &Block<'_>, inches: bool, code: u16, span: Span) {
        let before = std::mem::replace(&mut self.state.unit, unit_of(inches));
        let contradicts = std::mem::replace(&mut self.state.stated.units, true) && before != self.state.unit;
        let is_refused = contradicts && self.rules.units == UnitChange::Refused;
        if is_refused && !std::mem::replace(&mut self.state.stated.other_unit, true) {
            self.report(block, &say::UNIT_IS_SETTING, span, |d| d.quoting("word", codes::name('G', code)));
        }
        let Some(is_inch_in_comment) = self.rules.layers.then(|| unit_in_comment(block)).flatten() else {
            return;
        };
        if is_inch_in_comment != inches {
            let (taken, comment) = if inches { (&INCHES, &MILLIMETRES) } else { (&MILLIMETRES, &INCHES) };
            self.report(block, &say::UNITS_CONTRADICTED, span, |d| {
                d.quoting("word", codes::name('G', code)).with("unit", taken).with("comment", comment)
            });
        }
    }

    /// Records the speed of rapid moves from here on, if it depends on F.
    pub(super) fn record_rapid_feed(&mut self, block: &Block<'_>) {
        let feed = self.state.feed;
        if self.rules.rapids_at_feed && self.state.rapid_feed != Some(feed) {
            self.state.rapid_feed = Some(feed);
            self.step(block, Action::Change(Change::RapidFeed(feed)));
        }
    }

    /// Returns the feed of a cutting or probing move in mm/min. A missing feed is reported and taken as 0.
    pub(super) fn feed(&mut self, block: &Block<'_>, movement: &Move) -> f64 {
        let per_minute = match self.state.feed_unit {
            FeedUnit::PerMinute => self.state.feed,
            FeedUnit::PerTurn => self.state.feed * self.state.spindle.speed.unwrap_or_default(),
            FeedUnit::InverseTime if self.words.values.has(b'F') => self.state.feed * movement.length(),
            FeedUnit::InverseTime => 0.0,
        };
        // With `ignore_feed`, the feeds of the layers apply, which are not in the file.
        let is_layers = self.rules.layers && self.options.ignore_feed;
        if self.state.feed_unit != FeedUnit::InverseTime && !movement.is_standstill() {
            self.check_unit_of_feed(block);
        }
        if per_minute == 0.0 && !movement.is_standstill() && !is_layers {
            self.report_missing_feed(block);
        }
        per_minute
    }

    /// Reports the use of an F that was stated before the unit changed, at most once until the next F.
    fn check_unit_of_feed(&mut self, block: &Block<'_>) {
        let Some(stated) = self.state.feed_stated.filter(|stated| self.may_misread(*stated)) else { return };
        self.state.feed_stated = None;
        self.report_other_unit(block, &say::FEED_IN_OTHER_UNIT, stated, |d| d);
    }

    /// Reports a move that is affected by an offset stated before the unit changed, at most once until the next offset.
    pub(super) fn check_unit_of_shift(&mut self, block: &Block<'_>) {
        let Some(stated) = self.state.shift_stated.filter(|stated| self.may_misread(*stated)) else { return };
        self.state.shift_stated = None;
        self.report_other_unit(block, &say::OFFSET_IN_OTHER_UNIT, stated, |d| d);
    }

    /// Whether the unit has changed since lengths were stated, on a control that may keep their numbers.
    fn may_misread(&self, stated: StatedLength) -> bool {
        stated.unit != self.state.unit && self.rules.units == UnitChange::Unknown
    }

    pub(super) fn report_other_unit(
        &mut self,
        block: &Block<'_>,
        message: &'static Message,
        stated: StatedLength,
        values: impl FnOnce(Diagnostic) -> Diagnostic,
    ) {
        let [unit, other] =
            [stated.unit, self.state.unit].map(|unit| if unit == INCH { &INCHES } else { &MILLIMETRES });
        self.report(block, message, block.span(), |d| {
            values(d.with("line", u64::from(stated.line)).with("unit", unit).with("other", other))
        });
    }

    /// Reports a missing feed once until the next F, because it is a single mistake, however many moves follow.
    fn report_missing_feed(&mut self, block: &Block<'_>) {
        if std::mem::replace(&mut self.state.stated.feed_missing, true) {
            return;
        }
        let whole = block.span();
        match (self.state.feed_unit, self.state.feed_cleared) {
            (FeedUnit::InverseTime, _) => self.report(block, &say::INVERSE_TIME_WITHOUT_FEED, whole, |d| d),
            (FeedUnit::PerTurn, _) if self.state.feed > 0.0 => {
                self.report(block, &say::FEED_PER_TURN_WITHOUT_SPEED, whole, |d| d);
            }
            (_, Some((line, code))) => self.report(block, &say::FEED_CLEARED, whole, |d| {
                d.quoting("word", codes::name('G', code)).with("line", u64::from(line))
            }),
            _ => self.report(block, &say::NO_FEED, whole, |d| d),
        }
    }
}

fn unit_of(inches: bool) -> f64 {
    if inches { INCH } else { 1.0 }
}

/// Returns whether a comment of the block mentions inches (true) or millimetres (false); `None` if none mentions a unit.
fn unit_in_comment(block: &Block<'_>) -> Option<bool> {
    block.comments.iter().find_map(|comment| {
        let text = block.text_of(comment.text).to_lowercase();
        let names = |words: &[&str]| words.iter().any(|word| text.contains(word));
        if names(&["inch", "zoll"]) {
            Some(true)
        } else if names(&["millimet", "mm"]) {
            Some(false)
        } else {
            None
        }
    })
}
