//! Checksums that hosts append to the lines they send to Marlin: `N5 G1 X2*98`. (book: program/reading)

use memchr::memchr;
use pathbuild_diagnostic::messages::gcode as say;

use super::block::{Span, decode};
use super::line::{Broken, Line};

impl Line<'_> {
    /// Reads a checksum, which is the exclusive or of all bytes before `*` and extends to the end of the line or to a comment.
    pub(super) fn checksum(&mut self) -> Result<(), Broken> {
        let star = self.at;
        let rest = &self.bytes[star + 1..];
        let length = memchr(b';', rest).unwrap_or(rest.len());
        let expected = self.bytes[..star].trim_ascii_start().iter().fold(0, |sum, byte| sum ^ byte);
        let found = decode(rest[..length].trim_ascii()).into_owned();
        self.at = star + 1 + length;
        let span = Span::new(star, star + 1 + rest[..length].trim_ascii_end().len());
        if found.parse() == Ok(expected) {
            self.checks_sum = true;
            return Ok(());
        }
        Err(self.fault(&say::WRONG_CHECKSUM, span, |d| {
            d.quoting("found", found).with("expected", u64::from(expected))
        }))
    }

    /// Warns about a block number without a checksum, and about a checksum without a block number.
    pub(super) fn check_host(&mut self) {
        if !self.spelling().checksums || self.checks_sum == self.out.number.is_some() {
            return;
        }
        let message =
            if self.checks_sum { &say::CHECKSUM_WITHOUT_NUMBER } else { &say::NUMBER_WITHOUT_CHECKSUM };
        self.report(message, Span::new(0, self.bytes.len()), |d| d);
    }
}
