//! Reasons why a file cannot be read or written. They replace the system's texts, which depend on platform and locale.

use std::fmt;
use std::io::{Error, ErrorKind};

use crate::Diagnostic;
use crate::message::Value;
use crate::messages::files;
use crate::words::{Text, words};

words! {
    /// The file does not exist.
    NO_FILE: "there is no such file", "es gibt sie nicht";
    /// The directory of the file does not exist.
    NO_DIRECTORY: "there is no such directory", "das Verzeichnis gibt es nicht";
    /// The file is write-protected.
    WRITE_PROTECTED: "it is write-protected", "sie ist schreibgeschützt";
    /// The file exists and must not be overwritten.
    IS_THERE: "it already exists", "es gibt sie schon";
    /// A report or similar output would overwrite a drawing.
    NAME_OF_DRAWING: "it has the name of a drawing, which would be lost", "sie heißt wie eine Zeichnung, die verloren ginge";
    /// A report or similar output would overwrite a program.
    NAME_OF_PROGRAM: "it has the name of a G-code program, which would be lost", "sie heißt wie ein G-Code-Programm, das verloren ginge";
    /// A report or similar output would overwrite the configuration.
    NAME_OF_CONFIGURATION: "it is the configuration, which would be lost", "sie ist die Konfiguration, die verloren ginge";
    /// A report or similar output would overwrite a configuration or a post definition.
    NAME_OF_DEFINITION: "it has the name of a configuration or a post definition, which would be lost", "sie heißt wie eine Konfiguration oder Postprozessor-Definition, die verloren ginge";
    /// A report or similar output would overwrite measured values.
    NAME_OF_VALUES: "it has the name of a file with measured values, which would be lost", "sie heißt wie eine Datei mit Messwerten, die verloren gingen";
    /// A report or similar output would overwrite an ignore file.
    NAME_OF_IGNORE_FILE: "it says which drawings are ignored, and would be lost", "sie sagt, welche Zeichnungen ignoriert werden, und ginge verloren";
    /// A report or similar output would overwrite a post definition or a text that it inserts.
    SOURCE_OF_POST: "it belongs to the post-processor, and would be lost", "sie gehört zum Postprozessor und ginge verloren";
    /// A report or dependency file would overwrite the baseline.
    IS_BASELINE: "it is the baseline, which would be lost", "sie ist die Liste bekannter Befunde, die verloren ginge";
    /// `post --output` would overwrite the program that it reads.
    PROGRAM_THAT_IS_READ: "it is the program to rewrite, which would be lost", "sie ist das Programm, das umgeschrieben wird, und ginge verloren";
    /// `post --output` would overwrite the program of another path.
    PROGRAM_OF_OTHER_PATH: "it is the program of another path, which would be lost", "sie ist das Programm eines anderen Pfades, das verloren ginge";
    /// `--update-baseline` would overwrite a file that is not a baseline.
    NO_BASELINE: "the file there is not a baseline, and would be lost", "die Datei dort ist keine Liste bekannter Befunde und ginge verloren";
    /// q-project would overwrite a drawing that it did not write.
    DRAWN_BY_USER: "the drawing there was not written by q-project, or was edited since", "die Zeichnung dort stammt nicht von q-project oder wurde seither bearbeitet";
    /// A directory is in the place of a file to read.
    IS_DIRECTORY: "it is a directory", "es ist ein Verzeichnis";
    /// A directory is in the place of a file to write.
    DIRECTORY_OF_THAT_NAME: "a directory has that name", "ein Verzeichnis heißt so";
    /// The name of a program, of which R or the argument of `--join` is a part, contains an invalid character.
    NO_FILE_NAME: "the name contains a character that is not allowed in file names", "der Name enthält ein Zeichen, das in Dateinamen nicht erlaubt ist";
    /// The name of a path, such as `CON.1P`, would give a file name that means a device on Windows.
    DEVICE_NAME: "on Windows, a file name that begins like this denotes a device", "unter Windows bezeichnet ein Dateiname, der so beginnt, ein Gerät";
    /// The file is a pipe, a socket or a device.
    NOT_REGULAR: "it is not a regular file", "es ist keine gewöhnliche Datei";
    /// The file is reached through a link out of an untrusted repository.
    LEADS_OUT: "it leads out of the untrusted repository", "sie führt aus dem nicht vertrauenswürdigen Repository hinaus";
    /// A file that the definition inserts is reached through a link out of the post's directory.
    LEADS_OUT_OF_POST: "it leads out of the post's directory", "sie führt aus dem Verzeichnis des Postprozessors hinaus";
    /// A file that a control text inserts is not below the post's directory.
    NOT_BELOW_POST: "it does not lie below the post's directory", "sie liegt nicht unterhalb des Verzeichnisses des Postprozessors";
    /// A built-in post inserts a file, although it has no directory.
    NO_DIRECTORY_OF_POST: "this post has no directory", "dieser Postprozessor hat kein Verzeichnis";
    /// The file is not UTF-8 text.
    NOT_UTF_8: "it is not UTF-8", "sie ist kein UTF-8";
    /// A cache file belongs to another user, or is not a regular file.
    NO_OWN_FILE: "it is not a regular file of this user", "es ist keine gewöhnliche Datei dieses Benutzers";
    /// A cache file is larger than any that pathbuild writes.
    NEVER_SO_LARGE: "it is larger than any file that pathbuild keeps", "sie ist größer als jede Datei, die pathbuild aufhebt";
    /// The cache directory is a link.
    IS_LINK: "it is a link", "es ist eine Verknüpfung";
    /// The cache directory is a file.
    NO_DIRECTORY_BUT_FILE: "it is not a directory", "es ist kein Verzeichnis";
    /// The cache directory belongs to another user.
    OF_OTHER_USER: "it belongs to another user", "es gehört einem anderen Benutzer";
    /// Every user may write to the cache directory.
    OPEN_TO_ALL: "every user may write to it", "jeder Benutzer darf hineinschreiben";
    /// The cache directory cannot be inspected.
    NOT_INSPECTED: "its owner and permissions cannot be read", "sein Besitzer und seine Rechte sind nicht lesbar";
    /// The cache directory contains files that are not pathbuild's.
    HOLDS_OTHERS: "it contains other files, and no CACHEDIR.TAG of pathbuild", "es enthält andere Dateien und keine CACHEDIR.TAG von pathbuild";
    /// The cache directory is in an untrusted repository.
    IN_UNTRUSTED_TREE: "it lies in an untrusted directory tree", "es liegt in einem nicht vertrauenswürdigen Verzeichnisbaum";
    /// The directory given as the cache was not created by pathbuild.
    NO_CACHE: "it has no CACHEDIR.TAG of pathbuild, so it is not a cache of pathbuild", "es hat keine CACHEDIR.TAG von pathbuild, ist also kein Cache von pathbuild";
    /// A result is too large for a cache file.
    RESULT_TOO_LARGE: "the results are too large for one file", "die Ergebnisse sind zu groß für eine Datei";
    /// The tag file of the cache directory cannot be read.
    TAG_UNREADABLE: "its CACHEDIR.TAG cannot be read", "seine CACHEDIR.TAG ist nicht lesbar";
    /// No unused name for a temporary file was found.
    TOO_MANY_TEMPORARY: "there are too many temporary files beside it", "daneben liegen zu viele temporäre Dateien";
    /// A picture is too large for memory.
    PICTURE_TOO_LARGE: "the picture is too large", "das Bild ist zu groß";
    /// A picture format requires a feature that this build lacks.
    WITHOUT_PICTURES: "this pathbuild was built without the feature `pictures`: only .html and .svg can be written", "dieses pathbuild wurde ohne das Feature `pictures` gebaut: nur .html und .svg lassen sich schreiben";
    /// Error of the operating system: missing permission.
    PERMISSION_DENIED: "permission denied", "keine Berechtigung";
    /// Error of the operating system: the file already exists.
    EXISTS: "file exists", "es gibt sie schon";
    /// Error of the operating system: part of the path is not a directory.
    NOT_A_DIRECTORY: "not a directory", "ein Teil des Pfades ist kein Verzeichnis";
    /// Error of the operating system: the disk is full.
    DISK_FULL: "no space left on device", "auf dem Datenträger ist kein Platz mehr";
    /// Error of the operating system: the disk quota is exceeded.
    QUOTA: "disk quota exceeded", "das Kontingent auf dem Datenträger ist erschöpft";
    /// Error of the operating system: the file is too large for the file system.
    TOO_LARGE: "file too large", "sie wird für den Datenträger zu groß";
    /// Error of the operating system: the file system is read-only.
    READ_ONLY: "read-only file system", "der Datenträger ist schreibgeschützt";
    /// Error of the operating system: another program has opened the file exclusively.
    HELD: "another program has it open", "ein anderes Programm hat sie offen";
    /// Error of the operating system: invalid file name.
    BAD_NAME: "the system does not allow this file name", "das System lässt den Dateinamen nicht zu";
}

/// Returns PB004 for a file that cannot be written, with the advice that fits the reason.
pub fn cannot_write(name: &str, reason: impl Into<Value>) -> Diagnostic {
    let reason = reason.into();
    let message = match reason {
        Value::Prose(text) if *text == IS_THERE => &files::ALREADY_THERE,
        Value::Prose(text) if *text == LEADS_OUT => &files::WRITTEN_OUTSIDE,
        Value::Prose(text) if [&NO_FILE, &NO_DIRECTORY].contains(&text) => &files::DIRECTORY_MISSING,
        Value::Prose(text) if [&EXISTS, &NOT_A_DIRECTORY].contains(&text) => &files::DIRECTORY_IS_FILE,
        Value::Prose(text) if [&NO_FILE_NAME, &DEVICE_NAME].contains(&text) => &files::NAME_NOT_ALLOWED,
        _ => &files::CANNOT_WRITE,
    };
    Diagnostic::new(message).quoting("name", name).with("reason", reason)
}

/// Creates an error with a text in both languages, which [`reason`] retrieves.
pub fn text_error(kind: ErrorKind, text: &'static Text) -> Error {
    Error::new(kind, TextError(text))
}

#[derive(Debug)]
struct TextError(&'static Text);

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.en)
    }
}

impl std::error::Error for TextError {}

/// Returns the reason for an IO error: a text in both languages if there is one, otherwise the system's text.
pub fn reason(error: &Error) -> Value {
    match error.get_ref() {
        Some(inner) => match inner.downcast_ref::<TextError>() {
            Some(TextError(text)) => Value::Prose(text),
            None => Value::foreign(inner),
        },
        None if is_opened_exclusively(error) => Value::Prose(&HELD),
        None if is_invalid_name(error) => Value::Prose(&NO_FILE),
        None => text_by_kind(error.kind()).map_or_else(|| Value::foreign(system_text(error)), Value::Prose),
    }
}

fn text_by_kind(kind: ErrorKind) -> Option<&'static Text> {
    Some(match kind {
        ErrorKind::NotFound => &NO_FILE,
        ErrorKind::IsADirectory => &DIRECTORY_OF_THAT_NAME,
        ErrorKind::PermissionDenied => &PERMISSION_DENIED,
        ErrorKind::AlreadyExists => &EXISTS,
        ErrorKind::NotADirectory => &NOT_A_DIRECTORY,
        ErrorKind::StorageFull => &DISK_FULL,
        ErrorKind::QuotaExceeded => &QUOTA,
        ErrorKind::FileTooLarge => &TOO_LARGE,
        ErrorKind::ReadOnlyFilesystem => &READ_ONLY,
        ErrorKind::InvalidFilename => &BAD_NAME,
        _ => return None,
    })
}

/// Whether another program has opened the file exclusively (`ERROR_SHARING_VIOLATION` or `ERROR_LOCK_VIOLATION`).
pub fn is_opened_exclusively(error: &Error) -> bool {
    cfg!(windows) && matches!(error.raw_os_error(), Some(32 | 33))
}

/// Whether Windows does not permit the file name (`ERROR_INVALID_NAME`), for example because it is a pattern without matches.
fn is_invalid_name(error: &Error) -> bool {
    cfg!(windows) && error.raw_os_error() == Some(123)
}

/// Returns the system's text without the error number and the full stop at its end.
fn system_text(error: &Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    text[..end].trim_end_matches('.').to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Lang;

    #[test]
    fn advice_for_a_file_that_cannot_be_written_fits_the_reason() {
        let help = |reason: &'static Text| cannot_write("a.nc", reason).message.help.en;
        for (reason, advice) in [
            (&IS_THERE, "edit that file"),
            (&LEADS_OUT, "write to a place within the repository"),
            (&NO_DIRECTORY, "create the directory"),
            (&NO_FILE, "create the directory"),
            (&EXISTS, "rename that file"),
            (&DEVICE_NAME, "correct R"),
            (&DISK_FULL, "check the directory's permissions and the free space"),
        ] {
            assert!(help(reason).starts_with(advice), "{reason:?}: {}", help(reason));
        }
    }

    #[test]
    fn the_systems_words_stand_only_where_there_are_none() {
        let reason_text = |error: Error, lang| reason(&error).render(lang);
        let denied = || Error::from(ErrorKind::PermissionDenied);
        assert_eq!(reason_text(denied(), Lang::En), "permission denied");
        assert_eq!(reason_text(denied(), Lang::De), "keine Berechtigung");
        assert_eq!(reason_text(text_error(ErrorKind::Other, &IS_LINK), Lang::De), IS_LINK.de);
        assert_eq!(reason_text(Error::other("By a library."), Lang::De), "„By a library.“");
        assert_eq!(reason_text(ErrorKind::TimedOut.into(), Lang::En), "timed out");
        assert_eq!(reason_text(ErrorKind::TimedOut.into(), Lang::De), "„timed out“");
        // An error number that no system uses.
        let unknown = reason_text(Error::from_raw_os_error(54_321), Lang::En);
        assert!(!unknown.contains("os error") && !unknown.ends_with('.'), "{unknown}");
    }
}
