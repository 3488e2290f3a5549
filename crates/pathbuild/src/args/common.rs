//! Options that are accepted before and after any command. Values that the configuration can also set stay text here, so that they are
//! validated in one place. (book: reference/commands, book: reference/configuration)

use camino::Utf8PathBuf;
use clap::{Args, ValueEnum};
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::config::Overrides;

use super::{Format, ReportFile};
use crate::printer::{ColorChoice, Verbosity};

/// The common options.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Common options")]
pub struct CommonArgs {
    /// Milling feed where a path gives none
    #[arg(long, global = true, value_name = "MM/MIN", allow_hyphen_values = true)]
    pub feed: Option<String>,
    /// Speed of rapid moves, for the times shown
    #[arg(long, global = true, value_name = "MM/MIN", allow_hyphen_values = true)]
    pub rapid: Option<String>,
    /// Sweep height of an emitted path that gives none
    #[arg(long, global = true, value_name = "MM", allow_hyphen_values = true)]
    pub sweep_height: Option<String>,
    /// Probing feed where a path gives none
    #[arg(long, global = true, value_name = "MM/MIN", allow_hyphen_values = true)]
    pub probe_feed: Option<String>,
    /// Write programs exactly as `PathDxf2GCode` does
    #[arg(long, global = true)]
    pub compatible: bool,
    /// Look for embedded paths in this directory as well (repeatable)
    #[arg(long, global = true, value_name = "DIR")]
    pub search: Vec<Utf8PathBuf>,
    /// Regular expression for path names
    #[arg(long, global = true, value_name = "REGEX", allow_hyphen_values = true)]
    pub path_pattern: Option<String>,
    /// Regular expression for path names in file names
    #[arg(long, global = true, value_name = "REGEX", allow_hyphen_values = true)]
    pub file_pattern: Option<String>,
    /// A path whose name matches PARENT may embed only paths whose names match CHILD; both are regular expressions (repeatable)
    #[arg(long, global = true, value_name = "PARENT:CHILD", allow_hyphen_values = true)]
    pub restrict: Vec<String>,
    /// Language of messages (also: `PATHBUILD_LANG`)
    #[arg(long, global = true, value_enum, hide_possible_values = true, value_name = "en|de")]
    pub lang: Option<LangArg>,
    /// Write into this directory instead of beside the drawing
    #[arg(long, global = true, value_name = "DIR")]
    pub out_dir: Option<Utf8PathBuf>,
    /// Use this configuration instead of the drawing's pathbuild.toml
    #[arg(long, global = true, value_name = "FILE")]
    pub config: Option<Utf8PathBuf>,
    /// Format of the messages
    #[arg(long, global = true, value_enum, hide_possible_values = true, value_name = FORMATS)]
    pub format: Option<Format>,
    /// Write a report of the findings into a file as well; `-` is standard output (repeatable)
    #[arg(long, global = true, value_name = "FORMAT=FILE", value_parser = ReportFile::parse)]
    pub report: Vec<ReportFile>,
    /// When to use colours
    #[arg(long, global = true, value_enum, hide_possible_values = true, value_name = "auto|always|never")]
    pub color: Option<ColorChoice>,
    /// Print less: no status lines; given twice: results only
    #[arg(short, long, global = true, action = clap::ArgAction::Count, conflicts_with = "verbose")]
    pub quiet: u8,
    /// Print more
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Number of threads
    #[arg(short, long, global = true, value_name = "N", value_parser = jobs)]
    pub jobs: Option<u16>,
    /// Do not trust the tree: read no file outside of it, run no command that it names
    #[arg(long, global = true)]
    pub untrusted: bool,
    /// Use no kept results and keep none
    #[arg(long, global = true)]
    pub no_cache: bool,
    /// Directory for kept results, which copies of the tree share (also: `PATHBUILD_CACHE_DIR`)
    #[arg(long, global = true, value_name = "DIR", conflicts_with = "no_cache")]
    pub cache_dir: Option<Utf8PathBuf>,
}

const FORMATS: &str = "full|concise|json|sarif|github|gitlab|junit";

impl CommonArgs {
    /// The values that override the configuration.
    pub fn overrides(&self) -> Overrides {
        Overrides {
            feed: self.feed.clone(),
            rapid: self.rapid.clone(),
            sweep_height: self.sweep_height.clone(),
            probe_feed: self.probe_feed.clone(),
            search: self.search.clone(),
            path_pattern: self.path_pattern.clone(),
            file_pattern: self.file_pattern.clone(),
            restrict: self.restrict.clone(),
            lang: self.lang.map(Lang::from),
            out_dir: self.out_dir.clone(),
            compatible: self.compatible,
            config: self.config.clone(),
            untrusted: self.untrusted,
            trusted: None,
        }
    }

    /// How much to print.
    pub fn verbosity(&self) -> Verbosity {
        Verbosity::from_counts(self.quiet, self.verbose)
    }
}

/// A language, as written on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum LangArg {
    /// English
    En,
    /// German
    De,
}

impl From<LangArg> for Lang {
    fn from(lang: LangArg) -> Self {
        match lang {
            LangArg::En => Self::En,
            LangArg::De => Self::De,
        }
    }
}

fn jobs(text: &str) -> Result<u16, &'static str> {
    text.parse().ok().filter(|jobs| (1..=1024).contains(jobs)).ok_or("expected a number from 1 to 1024")
}
