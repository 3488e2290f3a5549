//! `pathbuild compat`: the command lines of `PathDxf2GCode` and `PathGCodeAdjustZ`, for batch files that have been in use for years.
//!
//! | theirs | ours |
//! | --- | --- |
//! | `/f` `/v` `/s` `/z` | `--feed`, `--rapid`, `--sweep-height`, `--probe-feed` |
//! | `/d` `/n` `/p` `/e` `/l` | `--search`, `--path-pattern`, `--file-pattern`, `--restrict`, `--lang` |
//! | `/c` | `check` in place of `emit` |
//! | `/x REGEX` | `texts --match REGEX`; with `/m` `adjust --show REGEX` |
//! | `/m` | `adjust --max-correction` |
//! | `/h` `/?` | this table |
//!
//! Programs are those of the original tool: `--compatible`. A value may be glued to its option or follow it. Elsewhere than on Windows, `\` in names of files is read as `/`.

use std::ffi::OsString;

use camino::Utf8Path;

/// Options whose value is passed on.
const VALUES: &[(char, &str)] = &[
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

/// What a command line of theirs comes to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Translated {
    /// A command line of ours, without the program's name.
    Arguments(Vec<String>),
    /// Their help was asked for.
    Help,
}

/// The help that is printed for `/h`.
pub(crate) const HELP: &str = "\
pathbuild compat [/OPTION[VALUE]]... FILES

  /f /v /s /z        --feed, --rapid, --sweep-height, --probe-feed
  /d /n /p /e /l     --search, --path-pattern, --file-pattern, --restrict, --lang
  /c                 check in place of emit
  /x REGEX           texts --match REGEX; with /m adjust --show REGEX
  /m                 adjust --max-correction

`pathbuild compat --print ...` prints the command line that it comes to and does nothing.
";

/// Translates a command line.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn translate(arguments: &[String]) -> Result<Translated, String> {
    let mut read = Read::default();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match option(argument) {
            None => read.files.push(file_name(argument)),
            Some(('h' | '?', _)) => return Ok(Translated::Help),
            Some(('c', "")) => read.check = true,
            Some((letter, glued)) => {
                let value = if glued.is_empty() { rest.next().map(String::as_str) } else { Some(glued) };
                let value = value.ok_or_else(|| format!("/{letter} needs a value"))?;
                read.take(letter, value, argument)?;
            }
        }
    }
    // Without arguments ours would take the whole library.
    if read.files.is_empty() {
        return Err("no file is named".to_owned());
    }
    Ok(Translated::Arguments(read.arguments()))
}

/// The words as one line for a shell.
pub(crate) fn shown(arguments: &[String]) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_=./:,".contains(c);
    let quoted = |word: &String| {
        let needs_none = word.chars().all(is_plain) && !word.is_empty();
        if needs_none { word.clone() } else { format!("'{}'", word.replace('\'', r"'\''")) }
    };
    arguments.iter().map(quoted).collect::<Vec<_>>().join(" ")
}

/// The arguments of the shell with what `compat` was given replaced: options before `compat` stay.
pub(crate) fn spliced(arguments: &[OsString], given: usize, translated: &[String]) -> Vec<OsString> {
    let before = &arguments[..arguments.len() - given];
    let end = before.iter().rposition(|argument| argument == "compat").unwrap_or(before.len());
    before[..end].iter().cloned().chain(translated.iter().map(OsString::from)).collect()
}

#[derive(Default)]
struct Read {
    check: bool,
    options: Vec<String>,
    shown: Option<String>,
    max_correction: Option<String>,
    files: Vec<String>,
}

impl Read {
    fn take(&mut self, letter: char, value: &str, argument: &str) -> Result<(), String> {
        match letter {
            'x' => self.shown = Some(value.to_owned()),
            'm' => self.max_correction = Some(value.to_owned()),
            'd' => self.options.push(format!("--search={}", file_name(value))),
            _ => {
                let known = VALUES.iter().find(|(known, _)| *known == letter);
                let (_, name) = known.ok_or_else(|| format!("unknown option {argument}"))?;
                self.options.push(format!("{name}={value}"));
            }
        }
        Ok(())
    }

    fn arguments(self) -> Vec<String> {
        let (command, shown) = match (&self.max_correction, &self.shown, self.check) {
            (Some(_), ..) => ("adjust", "--show"),
            (None, Some(_), _) => ("texts", "--match"),
            (None, None, true) => ("check", ""),
            (None, None, false) => ("emit", ""),
        };
        let mut arguments = vec![command.to_owned()];
        arguments.extend(self.max_correction.map(|value| format!("--max-correction={value}")));
        arguments.extend(self.shown.map(|value| format!("{shown}={value}")));
        arguments.extend(self.options);
        arguments.extend(["--compatible", "--"].map(str::to_owned));
        arguments.extend(self.files);
        arguments
    }
}

/// The letter of an option and what is glued to it. A drawing whose name begins at the root is none.
fn option(argument: &str) -> Option<(char, &str)> {
    let option = argument.strip_prefix('/')?;
    let is_drawing = Utf8Path::new(argument).extension().is_some_and(|it| it.eq_ignore_ascii_case("dxf"));
    if is_drawing && option.contains('/') {
        return None;
    }
    match option.chars().next() {
        Some(letter) => Some((letter.to_ascii_lowercase(), &option[letter.len_utf8()..])),
        // A lone slash names no option that there is, and must not be taken for the root directory.
        None => Some(('/', "-")),
    }
}

fn file_name(name: &str) -> String {
    if cfg!(windows) { name.to_owned() } else { name.replace('\\', "/") }
}
