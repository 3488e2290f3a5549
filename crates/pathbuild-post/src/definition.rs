//! Post definitions in either language, and the function that writes programs with them.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_diagnostic::messages::posts;
use pathbuild_diagnostic::{Diagnostic, Lang, Message, Note, Value, nearest};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::native::output_too_large_error;
use pathbuild_gcode::verify::{Ends, Tolerance};
use pathbuild_motion::Turning;

use crate::arcs::MAX_CHORD_DISTANCE;
use crate::findings::EngineOutput;
use crate::job::{Job, Operation, Units};
use crate::line_words::{CommentMarks, first_other_line, words};
use crate::number::StatedOption;
use crate::read_back;
use crate::read_back_options::{ReadBackOptions, Wording};
use crate::rs274_translation::TranslatedText;
use crate::target::{self, Target};
use crate::{PostMacro, PostOptions, Row, cad6, cambam};

/// A parsed definition, ready to write programs.
#[derive(Clone, Debug)]
pub struct PostDefinition {
    file: Utf8PathBuf,
    engine: Engine,
    warnings: Vec<Diagnostic>,
}

#[derive(Clone, Debug)]
enum Engine {
    CamBam(Box<cambam::Definition>),
    Cad6(Box<cad6::Definition>),
}

/// The output of a post: the text of a file, with notes and warnings.
#[derive(Clone, Debug)]
pub struct Output {
    /// Content of the file.
    pub text: Vec<u8>,
    /// Extension of the file, without the dot.
    pub extension: Box<str>,
    /// Facts that the user should know but that are not defects.
    pub notes: Vec<Note>,
    /// Doubtful constructs in the definition or the text.
    pub warnings: Vec<Diagnostic>,
    /// The command that the definition asks to run on the file: the program and its arguments, to be started without a shell.
    pub post_build: Option<Vec<String>>,
}

/// Maximum rounding error of coordinates in mm that causes no warning: that of numbers in mm with two decimals.
const MAX_UNREPORTED_ROUNDING: f64 = 0.005 * (1.0 + 1e-6);

/// Maximum rounding error of coordinates in mm that causes no error: that of numbers in mm with one decimal.
const MAX_ROUNDING: f64 = 0.05 * (1.0 + 1e-6);

/// Maximum size in bytes of a definition. Larger ones are refused.
const MAX_DEFINITION_BYTES: usize = 1 << 20;

impl PostDefinition {
    /// Reads a definition. `file` is its origin, for diagnostics.
    ///
    /// # Errors
    /// All errors in the definition, with their lines.
    pub fn read(bytes: &[u8], file: &Utf8Path) -> Result<Self, Vec<Diagnostic>> {
        if bytes.len() > MAX_DEFINITION_BYTES {
            let diagnostic = Diagnostic::new(&posts::POST_TOO_LARGE).with("size", bytes.len());
            return Err(vec![diagnostic.with("limit", MAX_DEFINITION_BYTES).in_file(file)]);
        }
        let text = &*decode(bytes).map_err(|error| vec![error.in_file(file)])?;
        let is_cambam = text.trim_start().starts_with('<') || file.extension() == Some("cbpp");
        let (engine, warnings) = if is_cambam {
            let (definition, warnings) = cambam::Definition::parse(text, file)?;
            (Engine::CamBam(Box::new(definition)), warnings)
        } else {
            let (definition, warnings) = cad6::Definition::parse(text, file)?;
            (Engine::Cad6(Box::new(definition)), warnings)
        };
        Ok(Self { file: file.to_owned(), engine, warnings })
    }

    /// Name of the dialect that the definition declares for its output; `None` if it declares none.
    pub fn dialect(&self) -> Option<&str> {
        match &self.engine {
            Engine::CamBam(definition) => definition.dialect(),
            Engine::Cad6(definition) => definition.dialect(),
        }
    }

    /// Extension of the files that the definition writes, without the dot.
    pub fn extension(&self) -> &str {
        match &self.engine {
            Engine::CamBam(definition) => definition.extension(),
            Engine::Cad6(definition) => definition.extension(),
        }
    }

    /// Returns the files that the control texts insert and whose names are the same for every program, relative to the directory of the definition. A
    /// program may need further files; all of them are read through [`PostOptions::files`].
    pub fn insertions(&self, macros: &[PostMacro]) -> BTreeSet<Utf8PathBuf> {
        match &self.engine {
            Engine::CamBam(_) => BTreeSet::new(),
            Engine::Cad6(definition) => cad6::inserted_files(definition, macros),
        }
    }

    /// Language of the definition.
    pub fn language(&self) -> Language {
        match &self.engine {
            Engine::CamBam(_) => Language::CamBam,
            Engine::Cad6(_) => Language::Cad6,
        }
    }

    /// Returns the dialect in which the output is read back: `named`, or else the one that the definition declares. `None` if neither is given, or if
    /// its name is unknown.
    pub fn reading_dialect(&self, named: Option<&str>) -> Option<Dialect> {
        Target::of(named.or(self.dialect())?).map(|target| target.reader)
    }

    /// Translates a program of this post to the words of RS274, as [`write`](Self::write) does to read a program back if no dialect is
    /// named.
    pub fn translate(&self, text: &[u8]) -> TranslatedText {
        match &self.engine {
            Engine::CamBam(definition) => cambam::translate(definition, text),
            Engine::Cad6(definition) => cad6::translate(definition, text, Units::default()),
        }
    }

    /// Returns the number, from 1, of the first line in which a program of this post differs from the expected one, and the expected line. Empty
    /// lines and comment lines are ignored, the latter only if the expected program has comments with the same mark.
    pub fn first_other_line(&self, found: &[u8], expected: &[u8]) -> Option<(u32, String)> {
        let marks = match &self.engine {
            Engine::CamBam(definition) => definition.comment_marks(),
            Engine::Cad6(definition) => definition.comment_marks(),
        };
        first_other_line(found, expected, &marks)
    }

    /// Whether the axes of the post's programs are not those of the drawing: wrapped around a cylinder, or mirrored.
    pub fn has_own_axes(&self) -> bool {
        matches!(&self.engine, Engine::CamBam(definition) if definition.has_own_axes())
    }

    /// Whether the post's programs can wait until the spindle has reached its speed.
    pub fn waits_for_spindle(&self) -> bool {
        match &self.engine {
            Engine::CamBam(definition) => definition.waits_for_spindle(),
            Engine::Cad6(definition) => definition.uses("SpinUpTime"),
        }
    }

    /// Writes a program.
    ///
    /// # Errors
    /// All undefined macros; otherwise the error that prevents the text from being written, or the errors found when it is read back.
    pub fn write(&self, job: &Job, options: &PostOptions<'_>) -> Result<Output, Vec<Diagnostic>> {
        job.check().map_err(|error| vec![*error])?;
        self.check_spindle(job, options).map_err(|error| vec![*error])?;
        let target = self.target(options)?;
        if !options.unchecked {
            self.check_decimal_points(target.as_ref()).map_err(|error| vec![*error])?;
        }
        let rounding = self.check_rounding(job, options.unchecked).map_err(|error| vec![*error])?;
        let chord = self.check_chord(job);
        let options = &self.supported_options(options, target.as_ref());
        let target = target.as_ref();
        let EngineOutput { text, translation, origins, warnings, notes, follows_coolant, post_build } =
            match &self.engine {
                Engine::CamBam(definition) => cambam::write(definition, &self.file, job, target, options)?,
                Engine::Cad6(definition) => cad6::write(definition, &self.file, job, target, options)?,
            };
        let mut output = Output {
            text: target::with_permitted_characters(&text, target, options.charset),
            extension: self.extension().into(),
            notes,
            warnings: self.warnings.iter().cloned().chain(rounding).chain(chord).chain(warnings).collect(),
            post_build,
        };
        if output.text.len() > options.most_bytes {
            return Err(vec![*output_too_large_error(options.most_bytes)]);
        }
        let refused =
            target.map(|target| target::check(&output.text, target)).filter(|errors| !errors.is_empty());
        let found = match refused {
            Some(errors) => Err(errors),
            None => self.read_back(&output.text, (&translation, follows_coolant), job, target, options),
        };
        if options.unchecked {
            output.notes.push(Note { message: &posts::POST_UNCHECKED, arguments: Vec::new() });
        }
        let placed = |problems: Vec<Diagnostic>, text: &[u8]| {
            let problems = problems.into_iter().map(|problem| read_back::in_output(problem, text, &origins));
            problems.map(|problem| problem.in_file(&self.file)).collect::<Vec<_>>()
        };
        let doubts = found.map_err(|mut errors| {
            self.explain_centres(&mut errors, &output.text, &translation);
            let causes = self.empty_motion().into_iter();
            causes.chain(placed(errors, &output.text)).collect::<Vec<_>>()
        })?;
        output.warnings.extend(placed(doubts, &output.text));
        Ok(output)
    }

    /// Checks that the text makes the machine do what the job describes and complies with the rules of `verify`. If no dialect defines the
    /// meaning of the text's words, or if the definition has its own axes, the translation to RS274 is checked instead. Returns warnings
    /// about doubtful constructs.
    fn read_back(
        &self,
        text: &[u8],
        (translation, follows_coolant): (&TranslatedText, bool),
        job: &Job,
        target: Option<&Target>,
        options: &PostOptions<'_>,
    ) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
        let chord = match &self.engine {
            Engine::CamBam(definition) => definition.chord(job.units),
            Engine::Cad6(definition) => definition.chord(),
        };
        let half = self.rounding_error(job) * (1.0 + 1e-6);
        // Some definitions round feeds to integers.
        let tolerance = Tolerance { place: half, feed: half.max(0.5), chord, ends: Ends::Cutting };
        let target = target.filter(|_| !self.has_own_axes());
        let wording = target.map_or(Wording::Translated(translation), Wording::Control);
        let text = if target.is_some() { text } else { translation.text.as_bytes() };
        let expected = ReadBackOptions {
            wording,
            tolerance: (!options.unchecked).then_some(tolerance),
            machine: options.machine.as_ref(),
            part_tolerance: options.part_tolerance,
            is_manual: options.manual_spindle || target.is_some_and(|target| !target.switches_spindle()),
            is_for_beam: matches!(&self.engine, Engine::CamBam(definition) if definition.is_for_beam()),
            follows_coolant,
            milliseconds: options.milliseconds,
        };
        read_back::check(text, job, &expected)
    }

    /// Adds a note to the first error in an arc if the definition writes absolute centres but its output does not state that.
    fn explain_centres(&self, errors: &mut [Diagnostic], text: &[u8], translation: &TranslatedText) {
        let is_absolute = match &self.engine {
            Engine::CamBam(definition) => definition.writes_absolute_centres(),
            Engine::Cad6(definition) => definition.writes_absolute_centres(),
        };
        if !is_absolute || translation.text.contains("G90.1") {
            return;
        }
        let has_centre = |error: &&mut Diagnostic| {
            let line = error.place.line.and_then(|number| read_back::line_of(text, number));
            let found = words(&line.unwrap_or_default(), &CommentMarks::default());
            found.words.iter().any(|word| matches!(word.letter, 'I' | 'J'))
        };
        if let Some(error) = errors.iter_mut().find(has_centre) {
            error.notes.push(Note { message: &posts::CENTRES_NOT_STATED, arguments: Vec::new() });
        }
    }

    /// Returns the error about a text that should write moves but writes nothing. It is reported only with the errors that follow from it, because a
    /// job may not need the text.
    fn empty_motion(&self) -> Option<Diagnostic> {
        let Engine::CamBam(definition) = &self.engine else { return None };
        let problem = Diagnostic::new(&posts::MOTION_EMPTY).quoting("section", definition.empty_motion()?);
        Some(problem.in_file(&self.file))
    }

    /// Returns half a unit of the last digit in mm: the largest rounding error of a coordinate.
    fn rounding_error(&self, job: &Job) -> f64 {
        let decimals = match &self.engine {
            Engine::CamBam(definition) => definition.decimals(),
            Engine::Cad6(definition) => definition.decimals(),
        };
        0.5 * libm::pow(10.0, -f64::from(decimals)) * self.unit(job)
    }

    /// The output unit in mm: 1 or 25.4.
    fn unit(&self, job: &Job) -> f64 {
        match &self.engine {
            Engine::CamBam(_) => job.units.millimetres(),
            Engine::Cad6(definition) => definition.units().unwrap_or(job.units).millimetres(),
        }
    }

    /// Checks that the spindle turns at a known speed in every operation that cuts, if the definition switches it and the options require a speed;
    /// and that each tool has a single speed, if the definition writes the speed only at tool changes or at the start.
    fn check_spindle(&self, job: &Job, options: &PostOptions<'_>) -> Result<(), Box<Diagnostic>> {
        let is_switched = match &self.engine {
            Engine::CamBam(definition) => definition.switches_spindle(),
            Engine::Cad6(definition) => definition.uses("MillingSpindleDir"),
        };
        let stands = |operation: &&Operation| {
            operation.cuts() && (operation.speed.is_none() || !operation.spindle.is_some_and(Turning::is_on))
        };
        match job.operations.iter().find(stands).filter(|_| options.needs_speed && is_switched) {
            Some(operation) => {
                let tool = &operation.tool;
                let diagnostic = match tool {
                    _ if !tool.is_named => Diagnostic::new(&posts::SPINDLE_UNSTATED),
                    _ if tool.diameter == 0.0 => Diagnostic::new(&posts::SPINDLE_UNKNOWN_OF_NUMBER)
                        .with("index", u64::from(tool.index)),
                    _ if tool.is_for_other_paths => Diagnostic::new(&posts::SPINDLE_UNKNOWN_OF_PATH)
                        .quoting("path", &*operation.part)
                        .with("diameter", tool.diameter),
                    _ => Diagnostic::new(&posts::SPINDLE_UNKNOWN).with("diameter", tool.diameter),
                };
                Err(Box::new(diagnostic.quoting("operation", &*operation.name)))
            }
            None => match &self.engine {
                Engine::Cad6(definition) if definition.has_one_speed_per_tool() => {
                    check_one_speed_per_tool(job)
                }
                _ => Ok(()),
            },
        }
    }

    /// Checks that a CamBam definition writes whole numbers with a decimal point if the target may read them as thousandths without one. Control
    /// texts may format each number differently, so their numbers are checked when the output is read back.
    fn check_decimal_points(&self, target: Option<&Target>) -> Result<(), Box<Diagnostic>> {
        let Some(target) = target.filter(|target| target.needs_decimal_points()) else { return Ok(()) };
        match &self.engine {
            Engine::CamBam(definition) if !definition.always_writes_point() => {
                let problem = self.format_finding(&posts::PATTERN_WITHOUT_POINT);
                Err(Box::new(problem.quoting("dialect", target.reader.name())))
            }
            _ => Ok(()),
        }
    }

    /// Checks how far coordinates are rounded. If the user takes responsibility for the moves, even the coarsest rounding is only a warning.
    fn check_rounding(&self, job: &Job, is_unchecked: bool) -> Result<Option<Diagnostic>, Box<Diagnostic>> {
        let error = self.rounding_error(job);
        if error > MAX_ROUNDING && !is_unchecked {
            return Err(Box::new(self.format_finding(&posts::NUMBERS_TOO_COARSE).with("error", error)));
        }
        Ok((error > MAX_UNREPORTED_ROUNDING)
            .then(|| self.format_finding(&posts::COARSE_NUMBERS).with("error", error)))
    }

    /// Reports a stated distance between arcs and lines that exceeds [`MAX_CHORD_DISTANCE`], which is used instead.
    fn check_chord(&self, job: &Job) -> Option<Diagnostic> {
        let (stated, option) = match &self.engine {
            Engine::CamBam(definition) => (definition.stated_chord(job.units), definition.chord_option()),
            Engine::Cad6(definition) => (definition.stated_chord(), definition.chord_option()),
        };
        let message = &posts::CHORD_LIMITED;
        (option.line.is_some() && stated > MAX_CHORD_DISTANCE)
            .then(|| self.option_finding(message, option).with("limit", MAX_CHORD_DISTANCE))
    }

    /// Creates a finding about the option that determines how numbers are written.
    fn format_finding(&self, message: &'static Message) -> Diagnostic {
        let option = match &self.engine {
            Engine::CamBam(definition) => definition.format_option(),
            Engine::Cad6(definition) => definition.format_option(),
        };
        self.option_finding(message, option)
    }

    fn option_finding(&self, message: &'static Message, option: StatedOption) -> Diagnostic {
        let diagnostic =
            Diagnostic::new(message).quoting("option", option.name).quoting("value", option.value);
        diagnostic.in_file(&self.file).at_line(option.line, option.column)
    }

    /// Returns the control that the output is for, or `None` if neither the options nor the definition name a dialect.
    fn target(&self, options: &PostOptions<'_>) -> Result<Option<Target>, Vec<Diagnostic>> {
        let Some(name) = options.dialect.as_deref().or(self.dialect()) else { return Ok(None) };
        Target::of(name).map(Some).ok_or_else(|| vec![unknown_dialect(name).in_file(&self.file)])
    }

    /// Restricts the options to the capabilities of the target. For a control without cycles, holes are written as moves, unless the
    /// definition leaves the word of the cycle (G81) empty, because it then writes holes in its own way.
    fn supported_options<'o>(&self, options: &PostOptions<'o>, target: Option<&Target>) -> PostOptions<'o> {
        let (writes_cycles, is_wrapped) = match &self.engine {
            Engine::CamBam(definition) => {
                (definition.writes_cycles(), definition.is_wrapped() || definition.is_for_beam())
            }
            Engine::Cad6(_) => (false, false),
        };
        let has_cycles = target.is_none_or(Target::has_cycles);
        // Only lines can be wrapped around a cylinder, and a beam cannot drill.
        let cycles = options.cycles && (has_cycles || !writes_cycles) && !is_wrapped;
        PostOptions { cycles, ..options.clone() }
    }
}

/// Decodes a definition in UTF-8, or in UTF-16, as some editors save XML: with a byte order mark, or beginning with `<` or `[`.
fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, Box<Diagnostic>> {
    let wide = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        let text: Result<String, _> = char::decode_utf16(units).collect();
        text.map(Cow::Owned).map_err(|_| Box::new(Diagnostic::new(&posts::POST_NOT_UTF16)))
    };
    match bytes {
        [0xFF, 0xFE, rest @ ..] => return wide(rest, u16::from_le_bytes),
        [0xFE, 0xFF, rest @ ..] => return wide(rest, u16::from_be_bytes),
        [b'<' | b'[', 0, ..] => return wide(bytes, u16::from_le_bytes),
        [0, b'<' | b'[', ..] => return wide(bytes, u16::from_be_bytes),
        _ => {}
    }
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    std::str::from_utf8(bytes).map(Cow::Borrowed).map_err(|error| {
        let line = 1 + memchr::memchr_iter(b'\n', &bytes[..error.valid_up_to()]).count();
        let line = u32::try_from(line).unwrap_or(u32::MAX);
        Box::new(Diagnostic::new(&posts::POST_NOT_UTF8).at_line(line, None))
    })
}

/// Checks that each tool has a single speed, for definitions that write the speed only at tool changes.
fn check_one_speed_per_tool(job: &Job) -> Result<(), Box<Diagnostic>> {
    let mut first_of = HashMap::new();
    for later in job.operations.iter().filter(|operation| operation.cuts()) {
        let first: &Operation = first_of.entry(later.tool.index).or_insert(later);
        if first.speed == later.speed {
            continue;
        }
        let (operation, other) = if first.speed.is_some() { (first, later) } else { (later, first) };
        if let Some(speed) = operation.speed {
            let diagnostic = match other.speed {
                Some(other) => Diagnostic::new(&posts::ONE_SPEED_A_TOOL).with("other", other),
                None => Diagnostic::new(&posts::SPEED_OF_SOME_OPERATIONS),
            };
            let diagnostic = diagnostic.with("index", u64::from(operation.tool.index)).with("speed", speed);
            return Err(Box::new(diagnostic.quoting("operation", &*other.name)));
        }
    }
    Ok(())
}

fn unknown_dialect(name: &str) -> Diagnostic {
    let nearest = nearest(name, Target::names());
    let diagnostic =
        Diagnostic::new(&posts::DIALECT_UNKNOWN).suggest_nearest(&posts::DIALECT_UNKNOWN_NEAREST, nearest);
    diagnostic.quoting("name", name).with("known", Target::names().into_iter().collect::<Value>())
}

/// Returns the rows of a table of the book, or `None` if there is no such table.
pub fn reference_table(name: &str, lang: Lang) -> Option<Vec<Row>> {
    cad6::reference::table(name, lang).or_else(|| cambam::reference::table(name, lang))
}

/// The language in which a post-processor is defined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// A CamBam definition (.cbpp).
    CamBam,
    /// A TOML file with control texts, as in CAD6.
    Cad6,
    /// The native writer itself. No definition can express its holes without F, its correction formulas or its statistics.
    Native,
}

impl Language {
    /// The name shown in listings.
    pub fn name(self) -> &'static str {
        match self {
            Self::CamBam => "CamBam",
            Self::Cad6 => "control texts",
            Self::Native => "built in",
        }
    }

    /// File extension of a definition, without the dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::CamBam => "cbpp",
            Self::Cad6 => "toml",
            Self::Native => "txt",
        }
    }
}
