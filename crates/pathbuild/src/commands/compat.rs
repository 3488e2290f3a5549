//! `pathbuild compat`: translates command lines of the original tools, `PathDxf2GCode` and `PathGCodeAdjustZ`, for existing batch files.
//!
//! | original | pathbuild |
//! | --- | --- |
//! | `/f` `/v` `/s` `/z` | `--feed`, `--rapid`, `--sweep-height`, `--probe-feed` |
//! | `/d` `/n` `/p` `/e` `/l` | `--search`, `--path-pattern`, `--file-pattern`, `--restrict`, `--lang` |
//! | `/c` | `check` in place of `emit` |
//! | `/x REGEX` | `texts --match REGEX`, then the programs; with `/m` `adjust --show REGEX` |
//! | `/m`, or a file `..._Clean.gcode` or `..._Z.txt` | `adjust --max-correction` |
//! | `/h` `/?` | this table, in the language of `/l` |
//!
//! Programs are written with `--compatible`. A value may follow its option or be attached to it, optionally with `=` or `:` between (except
//! for regular expressions, which may begin with these characters). Case is ignored, and `-` may replace `/`. Options with two hyphens are
//! those of pathbuild. On systems other than Windows, `\` in file names is read as `/`.

use std::ffi::OsString;

use camino::Utf8Path;
use pathbuild_db::system::is_drawing;
use pathbuild_diagnostic::Lang;

use super::adjust;
use crate::environment::named_lang;
use crate::german;

/// Options of the original tools with the options of pathbuild that replace them in every command. `/x` and `/m` are not among them, because their
/// replacement depends on the command.
const OPTIONS_WITH_VALUES: &[(char, &str)] = &[
    ('f', "--feed"),
    ('v', "--rapid"),
    ('s', "--sweep-height"),
    ('z', "--probe-feed"),
    ('d', "--search"),
    ('n', "--path-pattern"),
    ('p', "--file-pattern"),
    ('e', "--restrict"),
    ('l', "--lang"),
];

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Translation {
    /// Command lines of pathbuild, without the program's name, to be run in order.
    Commands(Vec<Vec<String>>),
    /// A request for help, with the language given by `/l`, if any.
    Help(Option<Lang>),
}

/// Returns the help printed for `/h`.
pub(crate) fn help(lang: Lang) -> &'static str {
    match lang {
        Lang::En => HELP,
        Lang::De => GERMAN_HELP,
    }
}

const HELP: &str = "\
pathbuild compat [/OPTION[VALUE]]... FILES

  /f /v /s /z        --feed, --rapid, --sweep-height, --probe-feed
  /d /n /p /e /l     --search, --path-pattern, --file-pattern, --restrict, --lang
  /c                 check in place of emit
  /x REGEX           texts --match REGEX, then emit or check; with /m adjust --show REGEX
  /m                 adjust --max-correction
  --OPTION           an option of pathbuild; `-` may replace `/`

`pathbuild compat --print ...` prints the pathbuild command lines instead of running them.
";

const GERMAN_HELP: &str = "\
pathbuild compat [/OPTION[WERT]]... DATEIEN

  /f /v /s /z        --feed, --rapid, --sweep-height, --probe-feed
  /d /n /p /e /l     --search, --path-pattern, --file-pattern, --restrict, --lang
  /c                 check statt emit
  /x REGEX           texts --match REGEX, danach emit oder check; mit /m adjust --show REGEX
  /m                 adjust --max-correction
  --OPTION           eine Option von pathbuild; `-` darf statt `/` stehen

`pathbuild compat --print ...` gibt die Befehlszeilen von pathbuild aus, statt sie auszuführen.
";

/// Translates a command line of the original tools.
///
/// # Errors
/// The reason why the command line is invalid.
pub(crate) fn translate(arguments: &[String], lang: Lang) -> Result<Translation, String> {
    let say = |en: &str, de: &str, argument: &str| {
        let phrase = if lang == Lang::De { de } else { en };
        phrase.replace("{}", argument)
    };
    let mut parsed = CompatArguments::default();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match option(argument) {
            None if argument.starts_with("--") => {
                parsed.own.push(argument.clone());
                let value = takes_value(argument).then(|| rest.next()).flatten();
                parsed.own.extend(value.cloned());
            }
            None => parsed.files.push(with_native_separators(argument)),
            Some(('h' | '?', _)) => return Ok(Translation::Help(named_lang_in(arguments))),
            Some(('c', "")) => parsed.check = true,
            Some((letter, glued)) => {
                let value = if glued.is_empty() {
                    rest.next().map(String::as_str)
                } else {
                    Some(value(letter, glued))
                };
                let value = value
                    .filter(|value| !value.is_empty())
                    .ok_or_else(|| say("{} needs a value", "zu {} fehlt der Wert", argument))?;
                if !parsed.take(letter, value) {
                    return Err(say("unknown option {}", "unbekannte Option {}", argument));
                }
            }
        }
    }
    // An error is needed, because without arguments pathbuild would process the whole library.
    if parsed.files.is_empty() {
        return Err(say("no file is named", "es ist keine Datei genannt", ""));
    }
    if parsed.lacks_correction() {
        return Err(say(
            "{} is missing: the largest allowed difference between a measured and a drawn height in mm, as in /m0.5",
            "{} fehlt: die größte erlaubte Differenz zwischen gemessener und gezeichneter Höhe in mm, etwa /m0.5",
            "/m",
        ));
    }
    Ok(Translation::Commands(parsed.commands()))
}

/// Returns the language of the last `/l` in a command line.
fn named_lang_in(arguments: &[String]) -> Option<Lang> {
    let named = |(at, argument): (usize, &String)| match option(argument)? {
        ('l', "") => named_lang(arguments.get(at + 1)?),
        ('l', glued) => named_lang(value('l', glued)),
        _ => None,
    };
    arguments.iter().enumerate().filter_map(named).next_back()
}

/// Inserts `--` after `compat`, so that options with one hyphen, such as `-v` and `-h`, are treated as options of the original tools.
pub(crate) fn with_separator(mut arguments: Vec<OsString>) -> Vec<OsString> {
    let text = |at: usize| arguments.get(at).and_then(|argument| argument.to_str());
    let Some(mut at) = (1..arguments.len()).find(|at| text(*at).is_none_or(|text| !text.starts_with('-')))
    else {
        return arguments;
    };
    if text(at) != Some("compat") {
        return arguments;
    }
    at += 1;
    while let Some(option) = text(at).filter(|option| option.starts_with("--") && option.len() > 2) {
        at += if takes_value(option) { 2 } else { 1 };
    }
    if text(at).is_some_and(|option| option.starts_with('-') && !option.starts_with("--")) {
        arguments.insert(at, "--".into());
    }
    arguments
}

/// Formats arguments as a command line for a shell, with quotes where necessary.
pub(crate) fn shell_command_line(arguments: &[String]) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,".contains(c);
    let quoted = |word: &String| {
        let needs_none = word.chars().all(is_plain) && !word.is_empty();
        if needs_none { word.clone() } else { format!("'{}'", word.replace('\'', r"'\''")) }
    };
    arguments.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// Replaces `compat` and its arguments by the translated ones. Options before `compat` remain.
pub(crate) fn replace_arguments(
    arguments: &[OsString],
    given: usize,
    translated: &[String],
) -> Vec<OsString> {
    let before = &arguments[..arguments.len() - given];
    let end = before.iter().rposition(|argument| argument == "compat").unwrap_or(before.len());
    before[..end].iter().cloned().chain(translated.iter().map(OsString::from)).collect()
}

#[derive(Default)]
struct CompatArguments {
    check: bool,
    options: Vec<String>,
    shown: Option<String>,
    max_correction: Option<String>,
    /// Options that already have pathbuild's own form.
    own: Vec<String>,
    files: Vec<String>,
}

impl CompatArguments {
    /// Applies an option of the original tools. Returns whether such an option exists.
    fn take(&mut self, letter: char, value: &str) -> bool {
        match letter {
            'x' => self.shown = Some(value.to_owned()),
            'm' => self.max_correction = Some(value.to_owned()),
            'd' => self.options.push(format!("--search={}", with_native_separators(value))),
            _ => {
                let known = OPTIONS_WITH_VALUES.iter().find(|(known, _)| *known == letter);
                let Some((_, name)) = known else { return false };
                self.options.push(format!(
                    "{name}={}",
                    if letter == 'l' { language(value) } else { value.to_owned() }
                ));
            }
        }
        true
    }

    /// Whether the command line adjusts programs, judging by its options and file names.
    fn adjusts(&self) -> bool {
        let is_adjusted = |file: &String| adjust::stem_of_program(file).is_some();
        self.max_correction.is_some() || self.files.iter().any(is_adjusted)
    }

    /// Whether the command line adjusts programs but does not state the largest permitted correction.
    fn lacks_correction(&self) -> bool {
        let is_ours = self.own.iter().any(|option| option.starts_with("--max-correction"));
        self.adjusts() && self.max_correction.is_none() && !is_ours
    }

    fn commands(&self) -> Vec<Vec<String>> {
        if self.adjusts() {
            let most = self.max_correction.iter().map(|value| format!("--max-correction={value}"));
            let shown = self.shown.iter().map(|value| format!("--show={value}"));
            return vec![self.command("adjust", most.chain(shown))];
        }
        let texts =
            self.shown.iter().map(|value| self.command("texts", [format!("--match={value}")].into_iter()));
        let write = self.command(if self.check { "check" } else { "emit" }, std::iter::empty());
        texts.chain([write]).collect()
    }

    fn command(&self, name: &str, own: impl Iterator<Item = String>) -> Vec<String> {
        let options = own.chain(self.options.iter().cloned()).chain(self.own.iter().cloned());
        let end = ["--compatible", "--"].map(str::to_owned);
        std::iter::once(name.to_owned()).chain(options).chain(end).chain(self.files.iter().cloned()).collect()
    }
}

/// Whether the word after an option of pathbuild is its value.
fn takes_value(option: &str) -> bool {
    let name = option.trim_start_matches('-');
    let has = |command: &clap::Command| {
        let named = command.get_arguments().find(|argument| argument.get_long() == Some(name));
        named.is_some_and(|argument| argument.get_action().takes_values())
    };
    let command = german::command(Lang::En);
    let ours = ["emit", "check", "texts", "adjust"];
    has(&command)
        || command
            .get_subcommands()
            .any(|subcommand| ours.contains(&subcommand.get_name()) && has(subcommand))
}

/// Returns the language in the name of a locale such as `de-AT`.
fn language(name: &str) -> String {
    name.split(['-', '_']).next().unwrap_or(name).to_ascii_lowercase()
}

/// Returns the value attached to an option, without a separator before it.
fn value(letter: char, glued: &str) -> &str {
    let is_pattern = matches!(letter, 'x' | 'n' | 'p' | 'e');
    if is_pattern { glued } else { glued.strip_prefix(['=', ':']).unwrap_or(glued) }
}

/// Splits an option into its letter and the attached text. Returns `None` for other arguments, including the name of a drawing that begins
/// with `/` or a hyphen.
fn option(argument: &str) -> Option<(char, &str)> {
    let is_drawing = is_drawing(Utf8Path::new(argument));
    let option = match argument.strip_prefix('-') {
        Some(option) if is_drawing || option.starts_with('-') => return None,
        Some(option) => option,
        None => argument.strip_prefix('/')?,
    };
    if is_drawing && option.contains('/') {
        return None;
    }
    match option.chars().next() {
        Some(letter) => Some((letter.to_ascii_lowercase(), &option[letter.len_utf8()..])),
        // A lone slash is an unknown option, and must not be taken for the root directory.
        None => Some(('/', "-")),
    }
}

fn with_native_separators(name: &str) -> String {
    if cfg!(windows) { name.to_owned() } else { name.replace('\\', "/") }
}
