//! Checks for words that exclude each other in a block, and for unused words.

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Message, Severity};

use super::codes;
use super::execute::Interpreter;
use super::switches::{COOLANT, SPINDLE, STOPS, TOOL};
use crate::read::{At, Block, Span};

/// Groups of M codes of which a line may contain only one.
const M_GROUPS: [&[u16]; 4] = [STOPS, TOOL, SPINDLE, COOLANT];

impl Interpreter<'_> {
    pub(super) fn check_conflicts(&mut self, block: &Block<'_>) {
        for (index, &(command, code, span)) in self.words.commands.iter().enumerate().skip(1) {
            let earlier =
                self.words.commands[..index].iter().find(|(other, ..)| other.group() == command.group());
            if let Some(&(_, first, _)) = earlier {
                self.conflict(block, &say::SAME_GROUP, codes::name('G', first), codes::name('G', code), span);
                break;
            }
        }
        for (index, &(code, span)) in self.words.m_codes.iter().enumerate().skip(1) {
            let excludes =
                |other: u16| M_GROUPS.iter().any(|group| group.contains(&other) && group.contains(&code));
            if let Some(&(first, _)) = self.words.m_codes[..index].iter().find(|(other, _)| excludes(*other))
            {
                self.conflict(block, &say::SAME_GROUP, codes::name('M', first), codes::name('M', code), span);
                break;
            }
        }
        let takers = || self.words.commands.iter().filter(|(command, ..)| command.takes_coordinates());
        if self.words.values.has_coordinates()
            && let (Some(&(first_command, first, _)), Some(&(second_command, second, span))) =
                (takers().next(), takers().nth(1))
            && first_command.group() != second_command.group()
        {
            self.conflict(
                block,
                &say::AXES_WANTED_TWICE,
                codes::name('G', first),
                codes::name('G', second),
                span,
            );
        }
    }

    fn conflict(
        &mut self,
        block: &Block<'_>,
        message: &'static Message,
        first: String,
        second: String,
        span: Span,
    ) {
        let dialect = self.rules.dialect.name();
        self.problems.add(message, At::block(block, span), |d| {
            d.quoting("first", first).quoting("second", second).quoting("dialect", dialect)
        });
    }

    pub(super) fn report_unused(&mut self, block: &Block<'_>) {
        if self.words.values.are_all_used() {
            return;
        }
        let severity = if self.rules.words.lenient { Severity::Warning } else { Severity::Error };
        let unused: Vec<(u8, Span)> = self.words.values.unused().collect();
        for (letter, span) in unused {
            self.report(block, &say::UNUSED, span, |mut diagnostic| {
                diagnostic.severity = severity;
                diagnostic.with("word", char::from(letter))
            });
        }
    }
}
