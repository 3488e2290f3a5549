//! Why a file cannot be read or written. The system's own words depend on platform and locale; those of the program do not.

use std::io::{Error, ErrorKind};

use crate::message::{Value, Word};
use crate::words::words;

words! {
    /// Nothing has that name.
    NO_FILE: "there is no such file", "es gibt sie nicht";
    /// The directory that it should lie in is missing.
    NO_DIRECTORY: "there is no such directory", "das Verzeichnis gibt es nicht";
    /// It would be overwritten.
    IS_THERE: "it is there already", "sie ist schon da";
    /// A directory where a file was asked for.
    IS_DIRECTORY: "it is a directory", "es ist ein Verzeichnis";
    /// A directory where a file should be written.
    DIRECTORY_OF_THAT_NAME: "a directory has that name", "ein Verzeichnis heißt so";
    /// R of a path is a part of its program's name.
    NO_FILE_NAME: "the name, of which R is a part, holds a character that cannot be in a file's name", "der Name, zu dem R gehört, enthält ein Zeichen, das in keinem Dateinamen stehen kann";
    /// A pipe, a socket, a device.
    NOT_REGULAR: "it is not a regular file", "es ist keine gewöhnliche Datei";
    /// `--untrusted`.
    LEADS_OUT: "it leads out of the repository, which is not trusted", "sie führt aus dem Repository hinaus, dem nicht getraut wird";
    /// Files that posts insert.
    LEADS_OUT_OF_POST: "it leads out of the post's directory", "sie führt aus dem Verzeichnis des Postprozessors hinaus";
    /// Likewise: where control texts point to.
    NOT_BELOW_POST: "it does not lie below the post's directory", "sie liegt nicht unterhalb des Verzeichnisses des Postprozessors";
    /// Built-in posts.
    NO_DIRECTORY_OF_POST: "this post has no directory", "dieser Postprozessor hat kein Verzeichnis";
    /// Texts.
    NOT_UTF_8: "it is not UTF-8", "sie ist nicht in UTF-8";
    /// Files of kept results.
    NO_OWN_FILE: "it is no file of this user", "es ist keine Datei dieses Benutzers";
    /// Likewise.
    NEVER_SO_LARGE: "it is larger than what pathbuild keeps", "sie ist größer als alles, was pathbuild aufhebt";
    /// Directories that are not used, of kept results.
    IS_LINK: "it is a link", "es ist eine Verknüpfung";
    /// Likewise.
    NO_DIRECTORY_BUT_FILE: "it is no directory", "es ist kein Verzeichnis";
    /// Likewise.
    SOMEBODY_ELSES: "it belongs to somebody else", "es gehört jemand anderem";
    /// Likewise.
    OPEN_TO_ALL: "everybody may write into it", "alle dürfen hineinschreiben";
    /// Likewise.
    NOT_LOOKED_AT: "it cannot be looked at", "es lässt sich nicht einsehen";
    /// Likewise.
    HOLDS_OTHERS: "it holds other things and no CACHEDIR.TAG of pathbuild", "es enthält anderes und keine CACHEDIR.TAG von pathbuild";
    /// Likewise.
    IN_STRANGERS_TREE: "it lies in a tree that is not trusted", "es liegt in einem Baum, dem nicht getraut wird";
    /// Likewise.
    NO_CACHE: "it has no CACHEDIR.TAG of pathbuild, so it is no cache of pathbuild", "es hat keine CACHEDIR.TAG von pathbuild, ist also kein Cache von pathbuild";
    /// As systems say it.
    PERMISSION_DENIED: "permission denied", "keine Berechtigung";
    /// Likewise.
    EXISTS: "file exists", "es gibt sie schon";
    /// Likewise.
    NOT_A_DIRECTORY: "not a directory", "ein Teil des Pfades ist kein Verzeichnis";
    /// Likewise.
    DISK_FULL: "no space left on device", "auf dem Datenträger ist kein Platz mehr";
    /// Likewise.
    QUOTA: "disk quota exceeded", "das Kontingent auf dem Datenträger ist erschöpft";
    /// Likewise.
    TOO_LARGE: "file too large", "sie wird für den Datenträger zu groß";
    /// Likewise.
    READ_ONLY: "read-only file system", "der Datenträger ist schreibgeschützt";
    /// Likewise.
    HELD: "another program has it open", "ein anderes Programm hat sie offen";
    /// Likewise.
    BAD_NAME: "the system allows no such file name", "das System lässt den Dateinamen nicht zu";
}

/// What a system's error says, in the program's words where it has some.
pub fn reason(error: &Error) -> Value {
    match error.get_ref() {
        // Somebody in the program said it.
        Some(said) => said.to_string().into(),
        None if is_held(error) => Value::Word(&HELD),
        None if is_no_name(error) => Value::Word(&NO_FILE),
        None => by_kind(error.kind()).map_or_else(|| Value::from(of_system(error)), Value::Word),
    }
}

fn by_kind(kind: ErrorKind) -> Option<&'static Word> {
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

/// `ERROR_SHARING_VIOLATION` and `ERROR_LOCK_VIOLATION`: another program has the file open for itself alone.
pub fn is_held(error: &Error) -> bool {
    cfg!(windows) && matches!(error.raw_os_error(), Some(32 | 33))
}

/// `ERROR_INVALID_NAME`: Windows has no file of such a name, for one of that of a pattern that nothing matches.
fn is_no_name(error: &Error) -> bool {
    cfg!(windows) && error.raw_os_error() == Some(123)
}

/// The system's words without the number and the full stop that follow them.
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
        let said = |error: Error, lang| reason(&error).render(lang);
        let denied = || Error::from(ErrorKind::PermissionDenied);
        assert_eq!(said(denied(), Lang::En), "permission denied");
        assert_eq!(said(denied(), Lang::De), "keine Berechtigung");
        assert_eq!(said(Error::new(ErrorKind::PermissionDenied, "Said by us."), Lang::De), "Said by us.");
        assert_eq!(said(ErrorKind::TimedOut.into(), Lang::De), "timed out");
        // A number that no system has.
        let unknown = said(Error::from_raw_os_error(54_321), Lang::En);
        assert!(!unknown.contains("os error") && !unknown.ends_with('.'), "{unknown}");
    }
}
