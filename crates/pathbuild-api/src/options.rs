//! Options for opening a library, and for checking drawings, listing paths and writing programs.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::System;
use pathbuild_db::system::{FileKind, FixedDirectorySystem, MemorySystem, OsSystem, clean};
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::config::sections::general::OPTIONS;
use pathbuild_workspace::config::{self, GivenOptions, OptionValues, Overrides};
use pathbuild_workspace::emit::{self, Task};
use pathbuild_workspace::waivers::{Date, DateSource, RunDate};
use pathbuild_workspace::{CacheHome, Inputs, SilentReporter, Workspace};

use crate::{BaselineOptions, Error, Library};

/// Options for opening a library. By default, the library is opened as the command-line program opens it, but without the cache and the user's own
/// configuration.
///
/// ```
/// # use pathbuild_api::{Error, LibraryOptions};
/// # fn main() -> Result<(), Error> {
/// let library = LibraryOptions::new().setting("rapid", "2000").threads(1).open("../../fixtures/library")?;
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug, Default)]
pub struct LibraryOptions {
    config: Option<PathBuf>,
    settings: Vec<(String, String)>,
    untrusted: bool,
    cache: Option<PathBuf>,
    threads: Option<u16>,
    lang: Option<Lang>,
    date: Option<String>,
}

impl LibraryOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Uses this configuration instead of the nearest `pathbuild.toml`.
    pub fn config(mut self, file: impl Into<PathBuf>) -> Self {
        self.config = Some(file.into());
        self
    }

    /// Overrides a key of the configuration, by the name and value of the command-line option: `setting("rapid", "2000")` is `--rapid 2000`.
    /// The value of a switch is `"true"`. An option that may be repeated takes the values of all calls; of any other option, the last call
    /// counts. (book: reference/commands)
    pub fn setting(mut self, name: impl Into<String>, value: impl Into<String>) -> Self {
        self.settings.push((name.into(), value.into()));
        self
    }

    /// Treats the directory as untrusted: files in it cannot make the library read or write anything outside of its repository.
    pub fn untrusted(mut self) -> Self {
        self.untrusted = true;
        self
    }

    /// Caches results in this directory for later processes.
    pub fn cache(mut self, directory: impl Into<PathBuf>) -> Self {
        self.cache = Some(directory.into());
        self
    }

    /// Uses this number of threads instead of one per core.
    pub fn threads(mut self, threads: u16) -> Self {
        self.threads = Some(threads);
        self
    }

    /// Sets the language of [`Error::Refused`] and of comments in programs. The configuration may set another language for comments.
    pub fn lang(mut self, lang: Lang) -> Self {
        self.lang = Some(lang);
        self
    }

    /// Sets the date, such as `2026-12-31`, with which the end of waivers is compared. Without it, no waiver with an end is valid. (The command-line
    /// program uses the present day.) (book: howto/ci)
    pub fn date(mut self, date: impl Into<String>) -> Self {
        self.date = Some(date.into());
        self
    }

    /// Opens the library in a directory.
    ///
    /// # Errors
    /// If there is no such directory, or if the configuration or an option has errors.
    pub fn open(self, directory: impl AsRef<Path>) -> Result<Library, Error> {
        self.open_source(Source::Directory(directory.as_ref().to_owned()))
    }

    /// Opens a library of files in memory, each with its name relative to the library's directory. A file named `pathbuild.toml` is its
    /// configuration. Nothing is read from the disk, and programs are written to memory.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn open_files<N: Into<String>>(
        self,
        files: impl IntoIterator<Item = (N, Vec<u8>)>,
    ) -> Result<Library, Error> {
        let files = files.into_iter().map(|(name, bytes)| (name.into(), bytes)).collect();
        self.open_source(Source::Files(files))
    }

    fn open_source(self, source: Source) -> Result<Library, Error> {
        Library::of_workspace(Arc::new(self.workspace(source)?))
    }

    fn workspace(self, source: Source) -> Result<Workspace, Error> {
        let settings = self.given_options()?;
        let utf8 = |path| utf8(path, self.lang);
        let config = self.config.map(utf8).transpose()?;
        let cache = self.cache.map(utf8).transpose()?.map(CacheHome::Named);
        let (system, directory) = source.open(self.lang)?;
        let run_date = |date| RunDate { date, source: DateSource::Given };
        let date = self.date.as_deref().map(|text| date(text, self.lang).map(run_date)).transpose()?;
        let overrides =
            Overrides { settings, config, date, untrusted: self.untrusted, ..Overrides::default() };
        let (settings, faults) = config::load(&system, &overrides, &Inputs::default(), &directory);
        let system = settings.confine(system);
        let workspace = Workspace {
            settings,
            system,
            own_lang: self.lang,
            system_lang: None,
            working_directory: directory,
            jobs: self.threads,
            cache,
            reporter: Arc::new(SilentReporter),
            is_date_decisive: Arc::default(),
        };
        if faults.is_empty() { Ok(workspace) } else { Err(Error::from_findings(&workspace, faults)) }
    }

    fn given_options(&self) -> Result<GivenOptions, Error> {
        let mut given: Vec<(&'static str, Vec<String>)> = Vec::new();
        for (name, value) in &self.settings {
            let option = OPTIONS.iter().find(|option| option.name == name);
            let option = option.ok_or_else(|| {
                refusal(self.lang, "there is no setting `{}`", "es gibt keine Einstellung `{}`", name)
            })?;
            let values = match option.values {
                OptionValues::Switch if value == "true" => Vec::new(),
                OptionValues::Switch => {
                    let [en, de] = [
                        "`{}` is a switch: its only value is `true`",
                        "`{}` ist ein Schalter: sein einziger Wert ist `true`",
                    ];
                    return Err(refusal(self.lang, en, de, name));
                }
                OptionValues::Texts(_) | OptionValues::Directories => {
                    let earlier = given.iter().find(|(earlier, _)| *earlier == option.name);
                    let earlier = earlier.map(|(_, values)| values.clone()).unwrap_or_default();
                    [earlier, vec![value.clone()]].concat()
                }
                OptionValues::Text(_) | OptionValues::Directory => vec![value.clone()],
            };
            given.retain(|(earlier, _)| *earlier != option.name);
            given.push((option.name, values));
        }
        Ok(given.into_iter().collect())
    }
}

/// Options for checking drawings.
#[derive(Clone, Debug, Default)]
pub struct CheckOptions {
    pub(crate) changed_since: Option<String>,
    pub(crate) has_all_values: bool,
    pub(crate) has_timings: bool,
    pub(crate) baseline: BaselineOptions,
}

impl CheckOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Reports only findings that depend on files changed since this Git revision. The inputs must be directories or the whole library, which must be
    /// on disk.
    pub fn changed_since(mut self, revision: impl Into<String>) -> Self {
        self.changed_since = Some(revision.into());
        self
    }

    /// Checks all combinations of the variables' values instead of one value of each.
    pub fn all_values(mut self) -> Self {
        self.has_all_values = true;
        self
    }

    /// Sets the baseline, and whether it is applied or written.
    pub fn baseline(mut self, baseline: BaselineOptions) -> Self {
        self.baseline = baseline;
        self
    }

    /// Measures the phases, for pathbuild's command line.
    #[doc(hidden)]
    pub fn timings(mut self) -> Self {
        self.has_timings = true;
        self
    }
}

/// Options for listing paths.
#[derive(Clone, Debug, Default)]
pub struct ListOptions {
    pub(crate) post: Option<String>,
}

impl ListOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Compares the programs on disk with those of this post-processor: the name of a built-in one, the file of a definition, or `native`. Without
    /// it, the configuration decides.
    pub fn post(mut self, post: impl Into<String>) -> Self {
        self.post = Some(post.into());
        self
    }
}

/// Options for writing programs: the post-processor, and whether existing files are compared or overwritten.
#[derive(Clone, Debug, Default)]
pub struct EmitOptions {
    pub(crate) request: emit::Request,
}

impl EmitOptions {
    /// Creates the default options.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets the post-processor: the name of a built-in one, the file of a definition, or `native`. Without it, the configuration decides.
    pub fn post(mut self, post: impl Into<String>) -> Self {
        self.request.post = Some(post.into());
        self
    }

    /// Compares the files with those on disk instead of writing them.
    pub fn compare(mut self) -> Self {
        self.request.task = Task::Compare { moves_only: false };
        self
    }

    /// Compares only the moves of the files with those on disk instead of writing them.
    pub fn compare_moves(mut self) -> Self {
        self.request.task = Task::Compare { moves_only: true };
        self
    }

    /// Returns the program in [`OutputFile::text`](crate::OutputFile::text) instead of writing it. The inputs must name a single path.
    pub fn print(mut self) -> Self {
        self.request.task = Task::Print;
        self
    }

    /// Permits overwriting files with measured values.
    pub fn force(mut self) -> Self {
        if let Task::Write { force } = &mut self.request.task {
            *force = true;
        }
        self
    }

    /// Joins all paths, in the order of the inputs, into one program of this name.
    pub fn join(mut self, name: impl Into<String>) -> Self {
        self.request.join = Some(name.into());
        self
    }

    /// Also writes the dependencies of the files into this file, for make and Ninja.
    pub fn deps(mut self, file: impl Into<String>) -> Self {
        self.request.deps = Some(file.into().into());
        self
    }

    /// Removes programs that pathbuild wrote earlier and would no longer write.
    pub fn remove_stale(mut self) -> Self {
        self.request.removes_stale = true;
        self
    }

    /// Sets the date, such as `2026-12-31`, that a post-processor may write into programs.
    pub fn date(mut self, date: impl Into<String>) -> Self {
        self.request.post_arguments.date = Some(date.into().into());
        self
    }

    /// Sets the dialect of the output, for a post-processor that does not name it.
    pub fn dialect(mut self, dialect: impl Into<String>) -> Self {
        self.request.post_arguments.dialect = Some(dialect.into().into());
        self
    }

    /// Lets the post-processor request commands for its output. They are in [`EmitReport::post_builds`](crate::EmitReport::post_builds), and the
    /// caller runs them.
    pub fn post_builds(mut self) -> Self {
        self.request.post_arguments.run_post_build = true;
        self
    }
}

/// Location of a library's files: a directory on disk, or names and contents in memory.
#[derive(Clone, Debug)]
enum Source {
    Directory(PathBuf),
    Files(Vec<(String, Vec<u8>)>),
}

impl Source {
    /// Returns the file system, and the directory to which names are relative.
    fn open(self, lang: Option<Lang>) -> Result<(Arc<dyn System>, Utf8PathBuf), Error> {
        match self {
            Self::Directory(directory) => {
                let directory = std::path::absolute(&directory).unwrap_or(directory);
                let directory = clean(&utf8(directory, lang)?);
                if OsSystem.kind(&directory) != FileKind::Directory {
                    let [en, de] = ["there is no directory {}", "es gibt kein Verzeichnis {}"];
                    return Err(refusal(lang, en, de, directory.as_str()));
                }
                Ok((Arc::new(FixedDirectorySystem::new(OsSystem::shared(), directory.clone())), directory))
            }
            Self::Files(files) => {
                let system = MemorySystem::default();
                for (name, bytes) in files {
                    system.put(clean(Utf8Path::new(&name)), bytes);
                }
                Ok((Arc::new(system), Utf8PathBuf::new()))
            }
        }
    }
}

pub(crate) fn utf8(path: PathBuf, lang: Option<Lang>) -> Result<Utf8PathBuf, Error> {
    let [en, de] = ["{}: the name is not UTF-8", "{}: der Name ist kein UTF-8"];
    Utf8PathBuf::from_path_buf(path).map_err(|path| refusal(lang, en, de, &path.to_string_lossy()))
}

pub(crate) fn date(text: &str, lang: Option<Lang>) -> Result<Date, Error> {
    let [en, de] = ["`{}` is not a date such as 2026-12-31", "`{}` ist kein Datum wie 2026-12-31"];
    text.parse().map_err(|()| refusal(lang, en, de, text))
}

/// Creates a refusal in this language. Before the configuration is read, only a language set by the caller is known.
fn refusal(lang: Option<Lang>, en: &str, de: &str, value: &str) -> Error {
    Error::Refused(lang.unwrap_or_default().choose(en, de).replace("{}", value))
}
