//! Writes the program itself, its probing program and its file of values. (book: program/gcode)

use std::fmt::Write;

use pathbuild_diagnostic::messages::files;
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_motion::WrittenArc;
use pathbuild_toolpath::{
    Comment, Correction, ElementKind, Height, OmittedCurves, PlannedMove, ProbePoint, Program, ProgramStep,
    Statistics, Total, Xy, is_doubtful_arc, is_point_arc, is_short_arc,
};

use super::number::{
    FIRST_PARAMETER, Formulas, PrintedArc, push_three_decimals, round_to_three_decimals, three_decimals,
};
use super::program_probe::{PROBE_COMMENT, ProgramProbe};
use crate::dialect::{Charset, Dialect, comment_safe_text};
use crate::statistics::statistics;

/// Options for writing programs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WriteOptions {
    /// Language of comments.
    pub lang: Lang,
    /// Characters allowed in comments.
    pub charset: Charset,
    /// Rapid feed (--rapid) in mm/min, for calculating times.
    pub rapid: f64,
    /// Method by which heights are corrected if there are probes.
    pub correction: Correction,
}

/// Returns the first comments of a program and of its probing program, without comment marks. An empty provenance is left out.
pub(super) fn first_lines(program: &Program, provenance: &str) -> impl Iterator<Item = String> {
    let provenance = (!provenance.is_empty()).then(|| provenance.to_owned());
    provenance.into_iter().chain([title(&program.drawing, &program.path)])
}

impl WriteOptions {
    pub(super) fn comment_style(&self, program: &Program) -> CommentStyle {
        CommentStyle { charset: self.charset, compatible: program.compatible }
    }
}

/// Formats the comment that states from which path of which drawing a file was made. Like every comment, it begins with a word chosen by pathbuild,
/// because LinuxCNC acts on comments that begin with certain words.
pub fn title(drawing: &str, path: &str) -> String {
    format!("{PATH}{path}{OF_DRAWING}{drawing}")
}

/// Returns the comments that list elements drawn on the layers of the paths but missing from the program (PB111). Programs of `PathDxf2GCode` have
/// none.
pub fn left_out_lines(program: &Program, lang: Lang) -> Vec<String> {
    let left_out = program.left_out.iter().filter(|_| !program.compatible);
    let line = |left_out: &OmittedCurves| {
        let entities = left_out.entities.iter().map(|(kind, count)| format!("{count} {}", kind.name()));
        let (entities, path) = (entities.collect::<Vec<_>>().join(", "), &left_out.path);
        match lang {
            Lang::En => format!("Not milled: {entities} of path {path}"),
            Lang::De => format!("Nicht gefräst: {entities} von Pfad {path}"),
        }
    };
    left_out.map(line).collect()
}

/// Returns the name of the drawing in a [`title`].
pub fn drawing_of_title(title: &str) -> Option<&str> {
    split_ignoring_case(title, OF_DRAWING).map(|(_, drawing)| drawing)
}

/// Returns the name of the path in a [`title`].
pub fn path_of_title(title: &str) -> Option<&str> {
    let (path, _) = split_ignoring_case(title, OF_DRAWING)?;
    split_ignoring_case(path, PATH).filter(|(before, _)| before.is_empty()).map(|(_, path)| path)
}

/// Splits a title at the first occurrence of a text, ignoring ASCII case because some posts write the text in upper case.
fn split_ignoring_case<'t>(title: &'t str, text: &str) -> Option<(&'t str, &'t str)> {
    let at = title.to_ascii_lowercase().find(&text.to_ascii_lowercase())?;
    Some((&title[..at], &title[at + text.len()..]))
}

/// Reduces a title, or the drawing's name in it, to the characters that all dialects preserve, so that titles can be compared regardless of the post
/// that wrote them.
pub fn plain_title(text: &str) -> String {
    comment_safe_text(text, None, Charset::Ascii).to_lowercase()
}

/// Whether a title found in a program names the given path and drawing.
pub fn is_title(found: &str, drawing: &str, path: &str) -> bool {
    plain_title(found) == plain_title(&title(drawing, path))
}

/// Whether a title found in a program names the given path, of any drawing.
pub fn is_title_of_path(found: &str, path: &str) -> bool {
    plain_title(found).starts_with(&plain_title(&title("", path)))
}

/// Whether a title found in a program names the given drawing.
pub fn is_title_of(found: &str, drawing: &str) -> bool {
    drawing_of_title(&plain_title(found)).is_some_and(|titled| titled == plain_title(drawing))
}

/// Returns the title of a program that joins paths. It contains neither a comma nor a drawing's name, so that the program is not mistaken for a stale
/// program of a single drawing.
pub fn joined_title<'a>(name: &str, paths: impl Iterator<Item = &'a str>) -> String {
    format!("{PATHS}{}{JOINED_AS}{name}", paths.collect::<Vec<_>>().join(AND)).replace(',', " ")
}

/// Returns the names of the paths in a [`joined_title`], and the name as which they are joined, the latter reduced as by [`plain_title`]; `None` for
/// another title.
pub fn joined_paths(found: &str) -> Option<(Vec<String>, String)> {
    let (paths, name) = split_ignoring_case(found, JOINED_AS)?;
    let (_, paths) = split_ignoring_case(paths, PATHS).filter(|(before, _)| before.is_empty())?;
    Some((paths.split(AND).map(str::to_owned).collect(), plain_title(name)))
}

const PATHS: &str = "Paths ";
const AND: &str = " + ";
const JOINED_AS: &str = " joined as ";
const PATH: &str = "Path ";
const OF_DRAWING: &str = ", drawing ";

/// Returns the lines that set the machine up. Only those of compatible programs have F before G94, which LinuxCNC rejects.
pub(super) fn setup_lines(program: &Program) -> &'static str {
    if program.compatible {
        "F150\nG17 G21 G40 G49 G54 G80 G90 G94\nT1\n"
    } else {
        "G17 G21 G40 G49 G54 G80 G90 G94\nT1\n"
    }
}

/// Whether a text has a title near its beginning, as programs of pathbuild have.
pub fn has_title(text: &[u8]) -> bool {
    let first = text.split(|byte| *byte == b'\n').take(TITLE_LINES).map(<[u8]>::trim_ascii);
    let comments = first.filter_map(|line| line.strip_prefix(b"(")?.strip_suffix(b")"));
    comments.filter_map(|comment| str::from_utf8(comment).ok()).any(|title| path_of_title(title).is_some())
}

/// Number of lines at the start of a program in which the title is searched for.
const TITLE_LINES: usize = 4;

/// Whether a native program is a compatible one: its first line other than comments and `%` is `F150`.
pub fn is_compatible(text: &[u8]) -> bool {
    let mut lines = text.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    lines.find(|line| !matches!(line.first(), None | Some(b'(' | b'%' | b';'))) == Some(b"F150".as_slice())
}

/// Writes a program with LF as line ends. Its statistics count a move that is split for its correction as one. `provenance` is the line that
/// identifies the origin of the program; empty to omit the line.
///
/// # Errors
/// PB005 if the text exceeds `most` bytes.
pub fn write_program(
    program: &Program,
    provenance: &str,
    options: &WriteOptions,
    most: usize,
) -> Result<String, Box<Diagnostic>> {
    let steps = options.correction.steps(program);
    let text = String::with_capacity((64 * steps.len() + 512).min(most));
    let formulas = Formulas::new(program, options.correction);
    let mut writer = Writer { program, options, formulas, text, at: Xy::origin() };
    writer.line("%");
    writer.header(provenance);
    writer.text.push_str(setup_lines(program));
    writer.line(&format!("G00 Z{}", three_decimals(program.start_height())));
    writer.line("G00 X0.000 Y0.000");
    for step in steps.as_ref() {
        match step {
            ProgramStep::Move { to, count } => writer.step(to, count.length),
            ProgramStep::Comment(comment) => writer.program_comment(comment),
        }
        if writer.text.len() > most {
            return Err(output_too_large_error(most));
        }
    }
    writer.line(&format!("G00 Z{}", three_decimals(program.start_height())));
    for line in
        statistics_lines(&statistics(program, options.rapid), options.lang, options.comment_style(program))
    {
        writer.line(&line);
    }
    writer.line("M30\n%");
    writer.text.shrink_to_fit();
    if writer.text.len() <= most { Ok(writer.text) } else { Err(output_too_large_error(most)) }
}

/// Creates PB005: a program exceeds the given number of bytes.
pub fn output_too_large_error(most: usize) -> Box<Diagnostic> {
    Box::new(Diagnostic::new(&files::OUTPUT_TOO_LARGE).with("limit", most).quoting("key", "output-size"))
}

struct Writer<'a> {
    program: &'a Program,
    options: &'a WriteOptions,
    formulas: Option<Formulas<'a>>,
    text: String,
    /// Position of the tool.
    at: Xy,
}

impl Writer<'_> {
    fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn comment(&mut self, text: &str) {
        let line = self.options.comment_style(self.program).comment(text);
        self.line(&line);
    }

    fn header(&mut self, provenance: &str) {
        for line in first_lines(self.program, provenance) {
            self.comment(&line);
        }
        for line in left_out_lines(self.program, self.options.lang) {
            self.comment(&line);
        }
        for (number, probe) in (FIRST_PARAMETER..).zip(&self.program.probes) {
            let entry = ProgramProbe::from(probe);
            self.comment(&format!("{PROBE_COMMENT}{number}: {entry}"));
        }
    }

    fn step(&mut self, to: &PlannedMove, length: f64) {
        match *to {
            PlannedMove::Sweep { to } => {
                self.text.push_str("G00");
                self.xy(to);
            }
            PlannedMove::Lift { z } => {
                self.text.push_str("G00");
                self.z(z);
            }
            PlannedMove::Drill { feed, z } => {
                self.text.push_str("G01");
                if !self.program.compatible {
                    self.word('F', feed);
                }
                self.z(z);
            }
            PlannedMove::Line { feed, to, z } => {
                self.text.push_str("G01");
                self.word('F', feed);
                self.xy(to);
                self.z(z);
            }
            PlannedMove::Arc { feed, clockwise, centre, to, z, is_spiral } => {
                let end = self.arc_end(to, centre, clockwise, length).filter(|_| !is_point_arc(centre));
                let Some(to) = end else {
                    return self.step(&PlannedMove::Line { feed, to, z }, length);
                };
                let centre = self.arc_centre(to, centre);
                self.text.push_str(if clockwise { "G02" } else { "G03" });
                self.word('F', feed);
                if is_spiral {
                    self.text.push_str(" I0");
                } else {
                    self.word('I', centre.x);
                }
                self.word('J', centre.y);
                self.xy(to);
                self.z(z);
            }
        }
        self.text.push('\n');
    }

    /// Returns the end to print for an arc: `to`, or a point near it if rounding would change the arc by almost a turn. `None` if a short arc cannot
    /// be printed as one.
    fn arc_end(&self, to: Xy, centre: Xy, clockwise: bool, length: f64) -> Option<Xy> {
        if !is_doubtful_arc(centre, length) {
            return Some(to);
        }
        let end = PrintedArc::new(self.at, centre, clockwise).end(to, length);
        end.or_else(|| (!is_short_arc(length)).then_some(to))
    }

    /// Returns the centre to print, relative to the position of the tool. Except in compatible programs, it is shifted by up to one unit of the last
    /// digit if that makes the radii at both ends of the printed arc match.
    fn arc_centre(&self, to: Xy, centre: Xy) -> Xy {
        if self.program.compatible {
            return centre;
        }
        let written = WrittenArc {
            from: [self.at.x, self.at.y],
            to: [to.x, to.y],
            centre: [centre.x, centre.y],
            length: &round_to_three_decimals,
            is_absolute: false,
            unit: 1.0,
        };
        let [x, y] = written.centre_correction().unwrap_or_default();
        Xy::new(centre.x + x, centre.y + y)
    }

    fn word(&mut self, letter: char, value: f64) {
        self.text.push(' ');
        self.text.push(letter);
        push_three_decimals(&mut self.text, value);
    }

    fn xy(&mut self, to: Xy) {
        self.at = to;
        self.word('X', to.x);
        self.word('Y', to.y);
    }

    fn z(&mut self, height: Height) {
        self.word('Z', height.z);
        if let Some(formulas) = &self.formulas {
            formulas.push(&mut self.text, height);
        }
    }

    fn program_comment(&mut self, comment: &Comment) {
        let names = &self.program.names;
        let text = match *comment {
            Comment::Question(text) => format!("Q:{}", names.get(text)),
            Comment::StartSubpath(name) => format!("START Subpath {}", names.get(name)),
            Comment::EndSubpath(name) => format!("END Subpath {}", names.get(name)),
            Comment::Element { kind, at, bottom, .. } => {
                format!(
                    "{} [{}|{}] Z{}",
                    self.kind_name(kind),
                    three_decimals(at.x),
                    three_decimals(at.y),
                    three_decimals(bottom)
                )
            }
            Comment::Pass { number, z } => {
                format!("{} {number}: Z{}", self.options.lang.choose("Pass", "Durchgang"), three_decimals(z))
            }
        };
        self.comment(&text);
    }

    fn kind_name(&self, kind: ElementKind) -> &'static str {
        match kind {
            ElementKind::MillingChain => self.options.lang.choose("Milling chain", "Fräskette"),
            ElementKind::DrilledHole => self.options.lang.choose("Drilled hole", "Bohrloch"),
            ElementKind::HelicalCircle => self.options.lang.choose("Helical circle", "Helixkreis"),
            ElementKind::Sweep => self.options.lang.choose("Sweep", "Leerfahrt"),
        }
    }
}

/// The dwell after each probe, P in seconds, so that the user can read the value.
const DWELL: &str = "G04 P4";

/// Writes the probing program, which probes at one point after the other and dwells after each.
pub fn probing_program(program: &Program, provenance: &str, options: &WriteOptions) -> String {
    let clearance = three_decimals(program.sweep_height);
    // If the tool makes no contact, G38.2 raises an alarm; with G38.3, which PathDxf2GCode writes, the machine continues.
    let probing = if program.compatible { "G38.3" } else { "G38.2" };
    let style = options.comment_style(program);
    let mut text = String::from("%\n");
    for line in first_lines(program, provenance) {
        _ = writeln!(text, "{}", style.comment(&line));
    }
    text.push_str(setup_lines(program));
    _ = writeln!(text, "G00 Z{clearance}\nG00 X0.000 Y0.000");
    let mut at = Xy::origin();
    for (index, probe) in program.probes.iter().enumerate() {
        let name = name_and_place(probe, program);
        _ = writeln!(
            text,
            "{}",
            style.comment(&format!("{PROBE_COMMENT}{} {name}", FIRST_PARAMETER + index))
        );
        if !pathbuild_path::approx::is_negligible((probe.at - at).norm()) {
            _ = writeln!(text, "G00 X{} Y{}", three_decimals(probe.at.x), three_decimals(probe.at.y));
        }
        at = probe.at;
        _ = writeln!(text, "G00 Z{}", three_decimals(probe.height + program.tool));
        _ = writeln!(text, "{probing} Z0 F{}\n{DWELL}\nG00 Z{clearance}", three_decimals(probe.feed));
    }
    _ = writeln!(text, "G00 X0.000 Y0.000\nG00 Z{clearance}\nM30\n%");
    text
}

/// Whether a comment in a probing program announces a probe: `Probe #51 [8.000 4.000]/T=2.000 @ [8.000|4.000]`. In the header of a milling program,
/// which lists the probes, a colon follows the number. Posts may write upper case.
pub(crate) fn announces_probe(comment: &str) -> bool {
    comment.trim().split_at_checked(PROBE_COMMENT.len()).is_some_and(|(start, rest)| {
        let name = rest.trim_start_matches(|character: char| character.is_ascii_digit());
        start.eq_ignore_ascii_case(PROBE_COMMENT) && name.starts_with(" [")
    })
}

/// Writes the file of values, with one line per probe and nothing after the `=` yet.
pub fn values_file(program: &Program, options: &WriteOptions) -> String {
    let style = options.comment_style(program);
    let mut text = String::new();
    for (index, probe) in program.probes.iter().enumerate() {
        let name = name_and_place(probe, program);
        _ = writeln!(text, "{} #{}=", style.comment(&name), FIRST_PARAMETER + index);
    }
    text
}

/// Formats the name of a probe in files: its position in the drawing, its label and the expected height.
pub fn probe_name(probe: &ProbePoint) -> String {
    let label = probe.label.as_ref().map(|label| format!("/L:{label}")).unwrap_or_default();
    let (x, y) = (three_decimals(probe.drawn_at.x), three_decimals(probe.drawn_at.y));
    format!("[{x} {y}]{label}/T={}", three_decimals(probe.height))
}

/// Formats the name of a probe and its position in the emitted drawing, because a path that is embedded twice has each of its probes twice.
fn name_and_place(probe: &ProbePoint, program: &Program) -> String {
    let name = probe_name(probe);
    if program.compatible {
        return name;
    }
    format!("{name} @ [{}|{}]", three_decimals(probe.at.x), three_decimals(probe.at.y))
}

/// The characters and the notation with which comments are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CommentStyle {
    pub(super) charset: Charset,
    /// Whether `(` is kept within a comment, as `PathDxf2GCode` does.
    pub(super) compatible: bool,
}

impl CommentStyle {
    pub(super) fn comment(self, text: &str) -> String {
        if !self.compatible {
            return Dialect::Native.comment(text, self.charset);
        }
        let parts: Vec<String> = text
            .split('(')
            .map(|part| comment_safe_text(part, Some(Dialect::Native), self.charset))
            .collect();
        format!("({})", parts.join("("))
    }
}

fn statistics_lines(statistics: &Statistics, lang: Lang, style: CommentStyle) -> Vec<String> {
    let [milling, drilling, sweeps, sum, commands] = labels(lang);
    let totals = [
        (milling, statistics.milling),
        (drilling, statistics.drilling),
        (sweeps, statistics.sweeps),
        (sum, statistics.sum()),
    ];
    let mut lines: Vec<String> =
        totals.iter().map(|(label, total)| style.comment(&total_line(label, total))).collect();
    lines.push(style.comment(&format!("{commands} {}", statistics.commands)));
    lines
}

fn total_line(label: &str, total: &Total) -> String {
    let minutes = total.minutes();
    // If the rapid feed is unknown or some feed is 0, the time is unknown.
    let time = if minutes.is_finite() { format!("   ca.{minutes:3.0} min") } else { String::new() };
    format!("{label:<12} {:5.0} mm{time}", total.length)
}

fn labels(lang: Lang) -> [&'static str; 5] {
    match lang {
        Lang::En => ["Milling length:", "Drill length:", "Sweeps:", "Sum:", "Command count:"],
        Lang::De => ["Fräslänge:", "Bohrungen:", "Leerfahrten:", "Summe:", "Befehlszahl:"],
    }
}

/// Parses the label and the length in mm of a comment that states a length.
pub(crate) fn stated_length(comment: &str) -> Option<(&str, f64)> {
    let (label, rest) = comment.split_once(':')?;
    let (length, _) = rest.split_once(" mm ")?;
    Some((label, length.trim().parse().ok()?))
}

/// Returns the kind of length that a label denotes, in either language: 0 milling, 1 drilling, 2 sweeps, 3 their sum.
pub(crate) fn kind_of_label(label: &str) -> Option<usize> {
    let is_meant = |known: &str| {
        let known = known.trim_end_matches(':');
        known == label || comment_safe_text(known, Some(Dialect::Native), Charset::Ascii) == label
    };
    [Lang::En, Lang::De].iter().find_map(|lang| labels(*lang)[..4].iter().position(|known| is_meant(known)))
}
