//! Replaces characters that the target does not allow.

use super::{LinePart, Target};
use pathbuild_gcode::dialect::ascii;
use pathbuild_gcode::native::Charset;

/// Replaces characters that the target or the configuration does not allow. Characters that the target would act on are replaced in
/// comments; in code they are kept, so that the check reports them. Lines that are not UTF-8 are not changed.
pub(crate) fn plain(text: &[u8], target: Option<&Target>, charset: Charset) -> Vec<u8> {
    let is_ascii = charset == Charset::Ascii || target.is_some_and(Target::needs_ascii);
    let mut plain = Vec::with_capacity(text.len());
    for line in text.split_inclusive(|&byte| byte == b'\n') {
        match std::str::from_utf8(line) {
            Ok(line) => plain.extend(self::line(line, target, is_ascii).into_bytes()),
            Err(_) => plain.extend_from_slice(line),
        }
    }
    plain
}

fn line(line: &str, target: Option<&Target>, is_ascii: bool) -> String {
    let line = if is_ascii { ascii(line) } else { line.to_owned() };
    let Some(target) = target else { return line };
    let piece = |piece| match piece {
        LinePart::Code(code) => code.to_owned(),
        LinePart::Comment(comment) => harmless(comment, target),
    };
    target.pieces(&line).into_iter().map(piece).collect()
}

fn harmless(comment: &str, target: &Target) -> String {
    let is_round = comment.starts_with('(');
    let replace = |(at, c): (usize, char)| match c {
        '(' if is_round && at > 0 && !target.comments.nested => '[',
        '!' | '?' if target.has_real_time_bytes => '.',
        '~' if target.has_real_time_bytes => '-',
        '%' if !target.percent => '-',
        c => c,
    };
    comment.char_indices().map(replace).collect()
}
