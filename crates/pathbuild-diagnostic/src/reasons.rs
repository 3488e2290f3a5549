//! Reasons why a file cannot be read or written. The system's wording depends on platform and locale; ours does not.

use std::fmt;
use std::io::{Error, ErrorKind};

use crate::message::Value;
use crate::words::{Text, words};

words! {
    /// The file does not exist.
    NO_FILE: "there is no such file", "es gibt sie nicht";
    /// The directory of the file does not exist.
    NO_DIRECTORY: "there is no such directory", "das Verzeichnis gibt es nicht";
    /// A file that its owner protects.
    WRITE_PROTECTED: "it is write-protected", "sie ist schreibgeschützt";
    /// The file would be overwritten.
    IS_THERE: "it is there already", "sie ist schon da";
    /// A report or similar output with the name of a drawing.
    NAME_OF_DRAWING: "it has the name of a drawing, which would be lost", "sie heißt wie eine Zeichnung, die verloren ginge";
    /// A report or similar output with the name of a program.
    NAME_OF_PROGRAM: "it has the name of a G-code program, which would be lost", "sie heißt wie ein G-Code-Programm, das verloren ginge";
    /// A report or similar output with the name of the configuration.
    NAME_OF_CONFIGURATION: "it is the configuration, which would be lost", "sie ist die Konfiguration, die verloren ginge";
    /// A drawing that q-project would overwrite, although it did not write it.
    DRAWN_BY_USER: "the drawing there was not written by q-project, or was edited since", "die Zeichnung dort stammt nicht von q-project oder wurde seither bearbeitet";
    /// A directory instead of a file to read.
    IS_DIRECTORY: "it is a directory", "es ist ein Verzeichnis";
    /// A directory instead of a file to write.
    DIRECTORY_OF_THAT_NAME: "a directory has that name", "ein Verzeichnis heißt so";
    /// R makes the name of a program invalid.
    NO_FILE_NAME: "the name, which includes R, contains a character that file names cannot contain", "der Name, zu dem R gehört, enthält ein Zeichen, das in keinem Dateinamen stehen kann";
    /// A path name that would become a file name such as `CON.1P_Milling.gcode`.
    DEVICE_NAME: "on Windows a file name that begins like this means a device", "unter Windows meint ein Dateiname, der so beginnt, ein Gerät";
    /// A pipe, a socket or a device.
    NOT_REGULAR: "it is not a regular file", "es ist keine gewöhnliche Datei";
    /// A link out of an untrusted repository.
    LEADS_OUT: "it leads out of the repository, which is not trusted", "sie führt aus dem Repository hinaus, dem nicht vertraut wird";
    /// A file outside of the post's directory that it tries to insert.
    LEADS_OUT_OF_POST: "it leads out of the post's directory", "sie führt aus dem Verzeichnis des Postprozessors hinaus";
    /// A file of a control text outside of the post's directory.
    NOT_BELOW_POST: "it does not lie below the post's directory", "sie liegt nicht unterhalb des Verzeichnisses des Postprozessors";
    /// A file of a built-in post, which has no directory.
    NO_DIRECTORY_OF_POST: "this post has no directory", "dieser Postprozessor hat kein Verzeichnis";
    /// A text file that is not UTF-8.
    NOT_UTF_8: "it is not UTF-8", "sie ist nicht in UTF-8";
    /// A cache file of another user.
    NO_OWN_FILE: "it is not a file of this user", "es ist keine Datei dieses Benutzers";
    /// A cache file that is too large.
    NEVER_SO_LARGE: "it is larger than anything that pathbuild keeps", "sie ist größer als alles, was pathbuild aufhebt";
    /// A cache directory that is a link.
    IS_LINK: "it is a link", "es ist eine Verknüpfung";
    /// A cache directory that is a file.
    NO_DIRECTORY_BUT_FILE: "it is not a directory", "es ist kein Verzeichnis";
    /// A cache directory of another user.
    SOMEBODY_ELSES: "it belongs to another user", "es gehört einem anderen Benutzer";
    /// A cache directory with write access for everyone.
    OPEN_TO_ALL: "every user may write to it", "jeder Benutzer darf hineinschreiben";
    /// A cache directory that cannot be inspected.
    NOT_LOOKED_AT: "it cannot be inspected", "es lässt sich nicht einsehen";
    /// A cache directory that contains foreign files.
    HOLDS_OTHERS: "it contains other files, and no CACHEDIR.TAG of pathbuild", "es enthält andere Dateien und keine CACHEDIR.TAG von pathbuild";
    /// A cache directory in an untrusted repository.
    IN_STRANGERS_TREE: "it lies in a directory tree that is not trusted", "es liegt in einem Verzeichnisbaum, dem nicht vertraut wird";
    /// A directory that is not a cache.
    NO_CACHE: "it has no CACHEDIR.TAG of pathbuild, so it is not a cache of pathbuild", "es hat keine CACHEDIR.TAG von pathbuild, ist also kein Cache von pathbuild";
    /// A result that is too large for a cache file.
    TOO_MUCH_TO_KEEP: "there is more to keep than a file can hold", "es ist mehr aufzuheben, als in eine Datei passt";
    /// A cache directory with an unreadable tag.
    TAG_UNREADABLE: "its CACHEDIR.TAG cannot be read", "seine CACHEDIR.TAG ist nicht lesbar";
    /// All names for temporary files are taken.
    TOO_MANY_TEMPORARY: "there are too many temporary files beside it", "daneben liegen zu viele temporäre Dateien";
    /// A drawing that another program is writing.
    CHANGES_WHILE_READ: "it changes while it is being read", "sie ändert sich, während sie gelesen wird";
    /// A picture that is too large for memory.
    PICTURE_TOO_LARGE: "the picture is too large", "das Bild ist zu groß";
    /// A picture format that requires a feature without which the program was built.
    WITHOUT_PICTURES: "this pathbuild was built without the feature `pictures`: .html and .svg are left", "dieses pathbuild wurde ohne das Feature `pictures` gebaut: es bleiben .html und .svg";
    /// Error of the operating system.
    PERMISSION_DENIED: "permission denied", "keine Berechtigung";
    /// Error of the operating system.
    EXISTS: "file exists", "es gibt sie schon";
    /// Error of the operating system.
    NOT_A_DIRECTORY: "not a directory", "ein Teil des Pfades ist kein Verzeichnis";
    /// Error of the operating system.
    DISK_FULL: "no space left on device", "auf dem Datenträger ist kein Platz mehr";
    /// Error of the operating system.
    QUOTA: "disk quota exceeded", "das Kontingent auf dem Datenträger ist erschöpft";
    /// Error of the operating system.
    TOO_LARGE: "file too large", "sie wird für den Datenträger zu groß";
    /// Error of the operating system.
    READ_ONLY: "read-only file system", "der Datenträger ist schreibgeschützt";
    /// Error of the operating system.
    HELD: "another program has it open", "ein anderes Programm hat sie offen";
    /// Error of the operating system.
    BAD_NAME: "the system does not allow this file name", "das System lässt den Dateinamen nicht zu";
}

/// Creates an error with a text of pathbuild, from which [`reason`] returns the text in every language.
pub fn error(kind: ErrorKind, text: &'static Text) -> Error {
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

/// The reason of an IO error: in pathbuild's own words if there are some, otherwise as the system puts it.
pub fn reason(error: &Error) -> Value {
    match error.get_ref() {
        Some(inner) => match inner.downcast_ref::<TextError>() {
            Some(TextError(text)) => Value::Prose(text),
            None => Value::foreign(inner),
        },
        None if is_held(error) => Value::Prose(&HELD),
        None if is_no_name(error) => Value::Prose(&NO_FILE),
        None => by_kind(error.kind()).map_or_else(|| Value::foreign(of_system(error)), Value::Prose),
    }
}

fn by_kind(kind: ErrorKind) -> Option<&'static Text> {
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

/// `ERROR_SHARING_VIOLATION` and `ERROR_LOCK_VIOLATION`: another program has opened the file exclusively.
pub fn is_held(error: &Error) -> bool {
    cfg!(windows) && matches!(error.raw_os_error(), Some(32 | 33))
}

/// `ERROR_INVALID_NAME`: a name that Windows does not allow, for example that of a pattern without matches.
fn is_no_name(error: &Error) -> bool {
    cfg!(windows) && error.raw_os_error() == Some(123)
}

/// The system's wording without the number and the full stop at the end.
fn of_system(error: &Error) -> String {
    let text = error.to_string();
    let end = text.find(" (os error").unwrap_or(text.len());
    text[..end].trim_end_matches('.').to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Lang;

    #[test]
    fn the_systems_words_stand_only_where_there_are_none() {
        let reason_text = |error: Error, lang| reason(&error).render(lang);
        let denied = || Error::from(ErrorKind::PermissionDenied);
        assert_eq!(reason_text(denied(), Lang::En), "permission denied");
        assert_eq!(reason_text(denied(), Lang::De), "keine Berechtigung");
        assert_eq!(reason_text(error(ErrorKind::Other, &IS_LINK), Lang::De), IS_LINK.de);
        assert_eq!(reason_text(Error::other("By a library."), Lang::De), "„By a library.“");
        assert_eq!(reason_text(ErrorKind::TimedOut.into(), Lang::En), "timed out");
        assert_eq!(reason_text(ErrorKind::TimedOut.into(), Lang::De), "„timed out“");
        // A number that no system has.
        let unknown = reason_text(Error::from_raw_os_error(54_321), Lang::En);
        assert!(!unknown.contains("os error") && !unknown.ends_with('.'), "{unknown}");
    }
}
