//! The post-processor of a run with its settings, the configured tools, and the limits of the machine. (book: program/posts)

use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex, PoisonError};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{join, or_current_directory};
use pathbuild_diagnostic::messages::{posts, posts as messages};
use pathbuild_diagnostic::reasons::LEADS_OUT_OF_POST;
use pathbuild_diagnostic::{Diagnostic, Number, Value};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::CuttingTool;
use pathbuild_gcode::verify::{Machine, PostWords, Travel};
use pathbuild_motion::{Coolant, Turning};
use pathbuild_path::name_regex;
use pathbuild_post::{
    BUILT_IN, Job, Operation, Output, PostDefinition, PostFiles, PostOptions, Tool, ToolEntry, ToolTable,
    TranslatedText, program_number, samples,
};
use pathbuild_view::Tip;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::config::types::NumberRange;
use crate::config::{Origin, Settings, is_file_name, types};
use crate::files::ExtraInput;
use crate::workspace::Workspace;

/// A post-processor: its definition, and everything else that its output depends on besides the program.
#[derive(Debug)]
pub struct PostProcessor {
    post: PostDefinition,
    /// Directory of the definition's files; `None` for a built-in post.
    directory: Option<Utf8PathBuf>,
    /// Text of the definition, followed by the hashes of the files that it inserts.
    definition: Vec<u8>,
    /// File of the definition; `None` for a built-in post.
    file: Option<Utf8PathBuf>,
    /// Files that the definition inserts into programs, relative to its directory.
    insertions: Vec<Utf8PathBuf>,
    /// The configured tools, in the order of the configuration.
    pub tools: ToolTable,
    /// Feed in mm/min for cuts without a feed of their own.
    feed: Option<f64>,
    /// Options for all programs. They do not contain the files that the definition inserts.
    pub(crate) options: PostOptions<'static>,
    system: Arc<dyn System>,
    /// File of the configuration with the tools, if there is one.
    configuration: Option<Utf8PathBuf>,
    /// Whether a program is refused if its definition requests a command, because the run is untrusted.
    runs_no_command: bool,
}

/// Command-line options of a post-processor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PostArguments {
    /// Date that the post-processor may write into programs.
    pub date: Option<Box<str>>,
    /// Name of the dialect of the output, in place of the one that the definition names.
    pub dialect: Option<Box<str>>,
    /// Whether to run the command that the post-processor requests.
    pub run_post_build: bool,
}

/// Upper bound on the number of inserted files that are read in advance, per definition.
const MAX_INSERTIONS: usize = 1000;

/// Name in the configuration that selects native programs instead of a post-processor. (book: program/gcode)
const NATIVE: &str = "native";

impl PostProcessor {
    /// Opens the post-processor named by `--post`, or else by the configuration; `None` means native programs.
    ///
    /// # Errors
    /// If there is no such post, or its definition has errors.
    pub fn for_run(
        context: &Workspace,
        named: Option<&str>,
        arguments: PostArguments,
    ) -> Result<Option<Self>, Vec<Diagnostic>> {
        let configured = &context.settings.general.post;
        let (name, base) = match (named, configured.origin, context.settings.directory()) {
            (Some(name), ..) => (name, &*context.working_directory),
            (None, Origin::File(_), Some(directory)) => (&*configured.value.name, directory),
            (None, ..) => (&*configured.value.name, &*context.working_directory),
        };
        let (settings, system) = (&context.settings, &context.system);
        if name == NATIVE {
            return Ok(None);
        }
        if !is_file_name(name) {
            return Self::built_in(settings, system, name, arguments).map(Some);
        }
        let file = relative(&join(base, name), context);
        let limit = settings.limits.file_size.value;
        let bytes = system
            .read(&file, limit)
            .map_err(|error| vec![error.diagnostic(limit, "file-size").in_file(&file)])?;
        let post = PostDefinition::read(&bytes, &file)?;
        Ok(Some(Self::new(settings, system, (post, bytes, Some(file)), arguments)))
    }

    /// Returns PB766 if the configuration names a built-in post that does not exist.
    pub(crate) fn unknown_name(settings: &Settings) -> Vec<Diagnostic> {
        let name = &*settings.general.post.value.name;
        let is_known = is_file_name(name) || BUILT_IN.iter().any(|post| post.name == name);
        if is_known { Vec::new() } else { pathbuild_post::load(name).err().unwrap_or_default() }
    }

    fn built_in(
        settings: &Settings,
        system: &Arc<dyn System>,
        name: &str,
        arguments: PostArguments,
    ) -> Result<Self, Vec<Diagnostic>> {
        let text = BUILT_IN.iter().find(|post| post.name == name).map_or("", |post| post.text);
        let source = (pathbuild_post::load(name)?, text.as_bytes().to_vec(), None);
        Ok(Self::new(settings, system, source, arguments))
    }

    fn new(
        settings: &Settings,
        shared_system: &Arc<dyn System>,
        (post, definition, file): (PostDefinition, Vec<u8>, Option<Utf8PathBuf>),
        arguments: PostArguments,
    ) -> Self {
        let (general, system) = (&settings.general, &**shared_system);
        let manual_spindle = general.spindle.value == types::SpindleControl::Manual;
        let options = PostOptions {
            date: arguments.date,
            macros: settings.tables.macros.value.clone(),
            cycles: general.cycles.value,
            run_post_build: arguments.run_post_build,
            charset: general.charset.value,
            most_bytes: settings.limits.output_size(),
            dialect: arguments.dialect,
            unchecked: general.post.value.unchecked,
            program_number: general.post.value.program_number,
            manual_spindle,
            needs_speed: !manual_spindle,
            spin_up: settings.machine.spin_up.value,
            milliseconds: settings.machine.dwell.value == types::DwellTime::Milliseconds,
            machine: machine(settings),
            part_tolerance: general.part_tolerance.value,
            ..PostOptions::default()
        };
        let directory = file.as_deref().map(|file| file.parent().unwrap_or(Utf8Path::new("")).to_owned());
        let insertions: Vec<Utf8PathBuf> = post.insertions(&options.macros).into_iter().collect();
        let inserted = |directory| {
            let files = DirectoryFiles { directory, system };
            let hash = |file: &Utf8PathBuf| blake3::hash(&files.read(file).unwrap_or_default());
            // Unreadable or excess files are reported when a program is written.
            insertions.iter().take(MAX_INSERTIONS).flat_map(|file| *hash(file).as_bytes()).collect()
        };
        let inserted = directory.as_deref().map(inserted).unwrap_or_default();
        Self {
            post,
            directory,
            definition: [definition, inserted].concat(),
            file,
            insertions,
            tools: tool_table(settings),
            feed: general.feed.value,
            options,
            system: Arc::clone(shared_system),
            configuration: settings.file.clone(),
            runs_no_command: settings.confined.is_some(),
        }
    }

    /// Returns the file of the definition; `None` if the post is built in.
    pub fn file(&self) -> Option<&Utf8Path> {
        self.file.as_deref()
    }

    /// Returns the files that make up the post-processor: its definition, and the files that it inserts into every program.
    pub fn sources(&self) -> Vec<Utf8PathBuf> {
        let Some(file) = &self.file else { return Vec::new() };
        let directory = file.parent().unwrap_or(Utf8Path::new(""));
        let inserted = self.insertions.iter().map(|file| join(directory, file.as_str()));
        std::iter::once(file.clone()).chain(inserted).collect()
    }

    /// Returns the extension of output files, without the dot.
    pub fn extension(&self) -> &str {
        self.post.extension()
    }

    /// Whether a file has a name that `emit` gives to the programs of this post-processor.
    pub fn has_name_of_program(&self, file: &Utf8Path) -> bool {
        self.has_extension(file) && file.file_stem().is_some_and(|stem| stem.ends_with("_Milling"))
    }

    /// Whether a file has the extension of output files.
    pub fn has_extension(&self, file: &Utf8Path) -> bool {
        file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(self.extension()))
    }

    /// Places a finding about the table of tools in the configuration, so that it is reported once however many paths it concerns.
    pub fn locate(&self, problem: Diagnostic) -> Diagnostic {
        match &self.configuration {
            Some(file) if problem.message == &posts::TOOLS_ALIKE => problem.in_file(file),
            _ => problem,
        }
    }

    /// Returns the dialect in which output is read back, if known.
    pub fn reading_dialect(&self) -> Option<Dialect> {
        self.post.reading_dialect(self.options.dialect.as_deref())
    }

    /// Whether programs of this post-processor start the spindle.
    pub fn starts_spindle(&self) -> bool {
        !self.options.manual_spindle
    }

    /// Whether programs of this post-processor are for controls on which the operator changes the tool and sets Z again.
    pub fn has_manual_changes(&self) -> bool {
        self.reading_dialect().is_some_and(|reader| reader.rules().manual_changes)
    }

    /// Whether programs of this post-processor select the work offset G54, according to the text of its definition.
    pub fn selects_g54(&self) -> bool {
        let has_offsets = |reader: Dialect| reader.rules().words.g.contains(&540);
        self.reading_dialect().is_none_or(has_offsets)
            && self.definition.windows(3).any(|word| word == b"G54")
    }

    /// Returns the number by which the control identifies the program of this name; `None` if the definition writes none.
    pub fn program_number(&self, name: &str) -> Option<u32> {
        const MACRO: &[u8] = b"program.number";
        self.reading_dialect().filter(|reader| reader.rules().program_numbers)?;
        self.definition.windows(MACRO.len()).find(|word| *word == MACRO)?;
        self.options.program_number.or_else(|| program_number(name))
    }

    /// Returns the configured feed in mm/min for cuts without a feed of their own.
    pub fn feed(&self) -> Option<f64> {
        self.feed
    }

    /// Writes the text of a program that will be stored in the file `output`. Adds to `inserted` the files that it inserted or failed to insert, even
    /// if writing fails.
    ///
    /// # Errors
    /// If the post-processor cannot express a part of the program, or writes it incorrectly.
    pub fn write(
        &self,
        job: &Job,
        output: Option<&Utf8Path>,
        inserted: &mut Vec<ExtraInput>,
    ) -> Result<Output, Vec<Diagnostic>> {
        let output = output.map(|output| output.as_str().into());
        self.write_with(job, PostOptions { output, ..self.options.clone() }, inserted)
    }

    /// Returns the words that the post-processor writes in a dialect, collected from sample programs. The samples use every feature, even those that
    /// the configured machine cannot run.
    pub fn words(&self, dialect: Dialect) -> PostWords {
        let written = samples().into_iter().filter_map(|job| {
            let options = PostOptions { unchecked: true, machine: None, ..self.options.clone() };
            let output = self.write_with(&job, options, &mut Vec::new());
            output.ok().map(|output| output.text)
        });
        let leaves_spin_up = !self.post.waits_for_spindle();
        if !self.is_read_by_definition() {
            return PostWords::of_programs(written, dialect).leaving_spin_up(leaves_spin_up);
        }
        let translated: Vec<TranslatedText> = written.map(|text| self.post.translate(&text)).collect();
        let left_out = translated.iter().flat_map(|text| &text.doubtful).map(|word| word.word.clone());
        PostWords::of_programs(translated.iter().map(|text| &text.text), dialect)
            .of_definition(&self.name(), left_out)
            .leaving_spin_up(leaves_spin_up)
    }

    /// Translates a program of this post into the words of RS274 by means of the post's definition; `None` if such programs are read in a dialect.
    pub fn translate(&self, text: &[u8]) -> Option<TranslatedText> {
        self.is_read_by_definition().then(|| self.post.translate(text))
    }

    /// Whether programs of this post are read back with its definition, because no dialect covers its words or its axes are not those of the
    /// drawing.
    fn is_read_by_definition(&self) -> bool {
        self.reading_dialect().is_none() || self.post.has_own_axes()
    }

    /// Whether programs are written without being compared with the drawing.
    pub fn is_unchecked(&self) -> bool {
        self.options.unchecked
    }

    /// Returns the file name of the definition; empty for a built-in post.
    pub fn name(&self) -> String {
        self.file.as_deref().and_then(Utf8Path::file_name).unwrap_or_default().to_owned()
    }

    /// Compares a program with another one of this post. Returns the number of the first line that differs, from 1, and the other program's line.
    /// Empty lines are ignored, and so are comment lines if the other program has comments with the same mark.
    pub fn first_other_line(&self, found: &[u8], expected: &[u8]) -> Option<(u32, String)> {
        self.post.first_other_line(found, expected)
    }

    fn write_with(
        &self,
        job: &Job,
        options: PostOptions<'static>,
        inserted: &mut Vec<ExtraInput>,
    ) -> Result<Output, Vec<Diagnostic>> {
        let system = &*self.system;
        let below = self.directory.as_deref().map(|directory| DirectoryFiles { directory, system });
        let noted = below.map(|below| RecordedFiles { below, read: Mutex::default() });
        let mut options: PostOptions<'_> = options;
        if let Some(noted) = &noted {
            options.files = noted;
        }
        let output = self.post.write(job, &options);
        let noted = noted.map(|noted| noted.read.into_inner().unwrap_or_else(PoisonError::into_inner));
        inserted.extend(noted.into_iter().flatten());
        let output = output?;
        match &output.post_build {
            Some(command) if self.runs_no_command => {
                let refusal = Diagnostic::new(&messages::POST_BUILD_REFUSED);
                Err(vec![refusal.quoting("command", command.join(" "))])
            }
            _ => Ok(output),
        }
    }

    /// Returns the part of a program's cache key that identifies the post-processor.
    pub(crate) fn cache_key(&self) -> String {
        format!("emit {:?} {}", self.file(), blake3::hash(&self.identity()).to_hex())
    }

    /// Returns everything that a program's text depends on besides drawings and general options, for its provenance.
    pub fn identity(&self) -> Vec<u8> {
        let Self { definition, tools, options, .. } = self;
        let PostOptions {
            date,
            macros,
            cycles,
            dialect,
            unchecked,
            program_number,
            manual_spindle,
            spin_up,
            milliseconds,
            ..
        } = options;
        // Programs contain a hash of this text, so changing its format makes all of them out of date.
        let manner = format_args!(
            "Manner {{ unchecked: {unchecked}, program_number: {program_number:?}, manual_spindle: {manual_spindle}, spin_up: {spin_up:?}, milliseconds: {milliseconds} }}"
        );
        let text = format!("{:?}", (tools, macros, cycles, date, dialect, manner));
        [&**definition, text.as_bytes()].concat()
    }
}

/// Returns the words allowed in programs of a dialect: those of the post-processor that wrote the program, if known; else those of the built-in
/// post for the dialect, or of native programs if there is none.
pub fn known_words(
    settings: &Settings,
    system: &Arc<dyn System>,
    writer: Option<&PostProcessor>,
    dialect: Dialect,
) -> PostWords {
    if let Some(post_processor) = writer {
        return post_processor.words(dialect);
    }
    if dialect == Dialect::Native {
        return PostWords::native(dialect);
    }
    PostProcessor::built_in(settings, system, dialect.name(), PostArguments::default())
        .map_or_else(|_| PostWords::native(dialect), |post_processor| post_processor.words(dialect))
}

/// Returns a file name relative to the working directory; unchanged if the file is outside.
fn relative(file: &Utf8Path, context: &Workspace) -> Utf8PathBuf {
    file.strip_prefix(&context.working_directory).unwrap_or(file).to_owned()
}

/// Runs the command in the working directory and waits for it. Its output goes to stderr, since stdout is for results.
///
/// # Errors
/// If the command cannot be started, or exits with a status other than 0.
pub fn run_post_build(command: &[String], file: &Utf8Path) -> Result<(), Box<Diagnostic>> {
    let Some((program, arguments)) = command.split_first() else { return Ok(()) };
    let mut run = Command::new(program);
    run.args(arguments).stdin(Stdio::null()).stdout(std::io::stderr());
    let failed = |reason: Value| {
        let diagnostic = Diagnostic::new(&posts::POST_BUILD_FAILED).quoting("command", command.join(" "));
        Box::new(diagnostic.with("reason", reason).in_file(file))
    };
    match run.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(failed(Value::foreign(status))),
        Err(error) => Err(failed(Value::foreign(error))),
    }
}

/// The files in a directory and below it, for reading only.
#[derive(Debug)]
pub(super) struct DirectoryFiles<'a> {
    pub(super) directory: &'a Utf8Path,
    pub(super) system: &'a dyn System,
}

/// Like [`DirectoryFiles`], but also records which files were read.
#[derive(Debug)]
pub(super) struct RecordedFiles<'a> {
    pub(super) below: DirectoryFiles<'a>,
    pub(super) read: Mutex<Vec<ExtraInput>>,
}

impl PostFiles for RecordedFiles<'_> {
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value> {
        let read = self.below.read(path);
        let hash = read.as_ref().ok().map(|bytes| *blake3::hash(bytes).as_bytes());
        let input = ExtraInput { path: self.below.directory.join(path), hash };
        self.read.lock().unwrap_or_else(PoisonError::into_inner).push(input);
        read
    }
}

const MAX_INSERTED_BYTES: u64 = 1 << 24;

impl PostFiles for DirectoryFiles<'_> {
    fn read(&self, path: &Utf8Path) -> Result<Vec<u8>, Value> {
        let Self { directory, system } = self;
        let base = system.canonical(or_current_directory(directory));
        let file = system.canonical(&directory.join(path));
        if !file.starts_with(&base) && file.is_absolute() {
            return Err(Value::Prose(&LEADS_OUT_OF_POST));
        }
        system.read(&file, MAX_INSERTED_BYTES).map_err(|error| error.reason(MAX_INSERTED_BYTES))
    }
}

/// Returns the limits of the configured machine; `None` if nothing is configured.
pub fn machine(settings: &Settings) -> Option<Machine> {
    let settings = &settings.machine;
    let placed = [settings.x.value, settings.y.value, settings.z.value];
    let travel = if placed.iter().any(Option::is_some) {
        Some(Travel::Placed(placed.map(range_ends)))
    } else {
        settings.travel.value.map(Travel::Size)
    };
    let machine = Machine {
        travel,
        feed: settings.max_feed.value,
        rates: settings.rates.value.map_or([None; 3], |rates| rates.map(Some)),
        spindle: settings.spindle_speeds.value.map(|speeds| (speeds.from, speeds.to)),
    };
    (machine != Machine::default()).then_some(machine)
}

/// Returns the lower and upper end of an axis; infinite if not configured.
fn range_ends(extent: Option<NumberRange>) -> (f64, f64) {
    extent.map_or((f64::NEG_INFINITY, f64::INFINITY), |extent| (extent.from, extent.to))
}

/// Returns the tools of `[tool.NAME]`. Their patterns compile, because the configuration has no errors.
pub fn tool_table(settings: &Settings) -> ToolTable {
    ToolTable { entries: settings.tables.tools.value.iter().map(entry).collect() }
}

/// Returns the shape of the tip of the configured tool for a path; flat if there is none.
pub fn tip(settings: &Settings, path: &str, diameter: f64) -> Tip {
    let tool = tool_table(settings).position(path, diameter);
    tool.map(|tool| settings.tables.tools.value[tool].cutter().into()).unwrap_or_default()
}

fn entry(tool: &types::Tool) -> ToolEntry {
    ToolEntry {
        name: tool.name.clone(),
        diameter: tool.diameter,
        paths: tool.paths.as_deref().and_then(|pattern| name_regex(pattern).ok()),
        index: tool.number,
        spindle: tool.turning(),
        speed: tool.spindle,
        coolant: tool.coolant,
    }
}

/// Adds the table's data about tools to the operations of a job. The job's own spindle, speed and coolant take precedence; without them, the spindle
/// is stopped while probing and in a program that cuts nothing. A tool that is not in the table has the diameter that the program states. Warns about
/// unknown tools.
pub(crate) fn complete_tools(job: &mut Job, table: &ToolTable, stated: &[CuttingTool]) -> Vec<Diagnostic> {
    let (mut unknown, mut reported) = (Vec::new(), FxHashSet::default());
    let mut entries: FxHashMap<u32, &ToolEntry> = FxHashMap::default();
    for entry in &table.entries {
        if let Some(index) = entry.index {
            entries.entry(index).or_insert(entry);
        }
    }
    let has_cuts = job.operations.iter().any(Operation::cuts);
    for operation in &mut job.operations {
        if !operation.tool.is_named {
            continue;
        }
        let index = operation.tool.index;
        let Some(entry) = entries.get(&index) else {
            let mut of_index = stated.iter().filter(|tool| tool.number == Some(index));
            if let Some(cutter) = of_index.find_map(|tool| tool.cutter) {
                operation.tool =
                    Tool::new(index, cutter.diameter, &format!("{} mm", Number(cutter.diameter)));
            }
            let is_known = operation.tool.diameter > 0.0;
            if !(is_known && table.entries.is_empty()) && reported.insert(index) {
                let message = if is_known { &posts::TOOL_NOT_IN_TABLE } else { &posts::TOOL_NUMBER_UNKNOWN };
                unknown.push(Diagnostic::new(message).with("index", u64::from(index)));
            }
            continue;
        };
        operation.tool = Tool::new(index, entry.diameter, &entry.name);
        if !has_cuts || operation.only_probes() {
            operation.spindle = operation.spindle.or(Some(Turning::Off));
            operation.coolant = operation.coolant.or(Some(Coolant::OFF));
            continue;
        }
        operation.spindle = operation.spindle.or(entry.spindle);
        operation.speed = operation.speed.or(entry.speed);
        operation.coolant = operation.coolant.or(entry.coolant);
    }
    unknown
}
