//! Options that are accepted before and after any command. (book: reference/commands)

use camino::Utf8PathBuf;
use clap::{Args, ValueEnum};
use pathbuild_diagnostic::Lang;
use pathbuild_workspace::config::Overrides;

use super::{Format, ReportFile, SettingArgs};
use crate::printer::{ColorChoice, Verbosity};

/// The common options.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Common options")]
pub struct CommonArgs {
    /// Options that override the configuration.
    #[command(flatten)]
    pub settings: SettingArgs,
    /// Language of messages (also: `PATHBUILD_LANG`)
    #[arg(
        long,
        global = true,
        value_enum,
        hide_possible_values = true,
        value_name = "en|de",
        display_order = 9
    )]
    pub lang: Option<LangArg>,
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
    /// Do not trust the tree: read no file outside of it, and run no command that it names
    #[arg(long, global = true)]
    pub untrusted: bool,
    /// Use no cached results and cache none
    #[arg(long, global = true)]
    pub no_cache: bool,
    /// Directory for cached results, which copies of the tree share (also: `PATHBUILD_CACHE_DIR`)
    #[arg(long, global = true, value_name = "DIR", conflicts_with = "no_cache")]
    pub cache_dir: Option<Utf8PathBuf>,
}

const FORMATS: &str = "full|concise|json|sarif|github|gitlab|junit";

impl CommonArgs {
    /// The values that override the configuration.
    pub fn overrides(&self) -> Overrides {
        Overrides {
            settings: self.settings.0.clone(),
            lang: self.lang.map(Lang::from),
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
