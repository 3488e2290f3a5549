//! F, S and units of numbers.

use pathbuild_diagnostic::Text;
use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_motion::{Action, Change, Group, Move};

use super::codes::{self, Command, FeedUnit};
use super::execute::{Interpreter, whole};
use super::limits;
use super::state::INCH;
use super::switches::{SPINDLE, TOOL};
use crate::dialect::FeedMode;
use crate::read::{Block, Span};

const MILLIMETRES: Text = Text { en: "millimetres", de: "Millimeter" };
const INCHES: Text = Text { en: "inches", de: "Zoll" };

impl Interpreter<'_> {
    pub(super) fn feed_mode(&mut self, block: &Block<'_>) {
        let Some((Command::FeedMode(unit), code, _)) = self.words.of_group(Group::FeedMode) else { return };
        if self.rules.feed_mode == FeedMode::ClearsFeed || unit != self.state.feed_unit {
            self.state.feed = 0.0;
            self.state.feed_cleared = Some((block.line, code));
        }
        self.state.feed_unit = unit;
    }

    pub(super) fn set_feed(&mut self, block: &Block<'_>) {
        let Some(slot) = self.words.values.take_slot(b'F') else { return };
        if self.rules.layers && self.options.ignore_feed {
            return self.report(block, &say::FEED_IGNORED, slot.span, |d| d);
        }
        let unit = match self.words.of_group(Group::Units) {
            Some((Command::Inches(inches), ..)) => unit_of(inches),
            _ => self.state.unit,
        };
        self.state.feed =
            if self.state.feed_unit == FeedUnit::InverseTime { slot.value } else { slot.value * unit };
        self.state.feed_cleared = None;
        self.state.stated.feed_missing = false;
    }

    pub(super) fn set_speed(&mut self, block: &Block<'_>) {
        let belongs_elsewhere = self.rules.one_command && self.words.m_code(SPINDLE).is_none();
        let Some(slot) = self.words.values.peek(b'S').filter(|_| !belongs_elsewhere) else { return };
        self.words.values.take(b'S');
        if slot.value < 0.0 {
            return self.out_of_range(block, "S", slot, &limits::NOT_NEGATIVE);
        }
        self.state.spindle.speed = slot.value;
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

    /// The layer that the words of the block belong to; M6 takes effect before them.
    fn layer_of_block(&self) -> u32 {
        let chosen = self.words.m_code(TOOL).and_then(|_| self.words.values.peek(b'T'));
        chosen.and_then(|slot| whole(slot.value)).unwrap_or(self.state.layer)
    }

    pub(super) fn units(&mut self, block: &Block<'_>, inches: bool, code: u16, span: Span) {
        self.state.unit = unit_of(inches);
        self.state.stated.units = true;
        let Some(said) = self.rules.layers.then(|| unit_said(block)).flatten() else { return };
        if said != inches {
            let (taken, comment) = if inches { (&INCHES, &MILLIMETRES) } else { (&MILLIMETRES, &INCHES) };
            self.report(block, &say::UNITS_CONTRADICTED, span, |d| {
                d.quoting("word", codes::name('G', code)).with("unit", taken).with("comment", comment)
            });
        }
    }

    /// Records the speed of rapid moves from here on, if it depends on F.
    pub(super) fn rapid_feed(&mut self, block: &Block<'_>) {
        let feed = self.state.feed;
        if self.rules.rapids_at_feed && self.state.rapid_feed != Some(feed) {
            self.state.rapid_feed = Some(feed);
            self.step(block, Action::Change(Change::RapidFeed(feed)));
        }
    }

    /// The feed of a cutting move in mm/min, or 0 with a report if there is none.
    pub(super) fn feed(&mut self, block: &Block<'_>, movement: &Move) -> f64 {
        let per_minute = match self.state.feed_unit {
            FeedUnit::PerMinute => self.state.feed,
            FeedUnit::PerTurn => self.state.feed * self.state.spindle.speed,
            FeedUnit::InverseTime if self.words.values.has(b'F') => self.state.feed * movement.length(),
            FeedUnit::InverseTime => 0.0,
        };
        // The feeds of the layers apply, which are not in the file.
        let is_layers = self.rules.layers && self.options.ignore_feed;
        if per_minute == 0.0 && !movement.is_nothing() && !is_layers {
            self.report_missing_feed(block);
        }
        per_minute
    }

    /// Reports a missing feed once until the next F, because it is a single mistake, however many moves follow.
    fn report_missing_feed(&mut self, block: &Block<'_>) {
        if std::mem::replace(&mut self.state.stated.feed_missing, true) {
            return;
        }
        let whole = Span::new(0, block.text.len());
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

/// Whether a comment of the block mentions inches (true) or millimetres (false).
fn unit_said(block: &Block<'_>) -> Option<bool> {
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
