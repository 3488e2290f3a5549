//! Messages about files: reading, writing, limits. (PB001 to PB006, PB113)

messages! {
    /// A file that cannot be opened or read, for a reason that has no message of its own.
    UNREADABLE: UnreadableFile {
        en: "cannot read the file: {reason}",
        de: "die Datei ist nicht lesbar: {reason}",
        help_en: "check the name and the permissions, and that the CAD has not locked the file",
        help_de: "prüfen, ob der Name und die Rechte stimmen und ob das CAD die Datei gesperrt hat",
    }
    /// A drawing that another program changes while it is read.
    CHANGES_WHILE_READ: UnreadableFile {
        en: "cannot read the file: it changes while it is being read",
        de: "die Datei ist nicht lesbar: sie ändert sich, während sie gelesen wird",
        help_en: "run pathbuild again when the program that writes the file has finished",
        help_de: "pathbuild noch einmal aufrufen, wenn das Programm fertig ist, das die Datei schreibt",
    }
    /// A file of ignore rules with a line that is too long.
    LINE_TOO_LONG: UnreadableFile {
        en: "cannot read the file: a line is longer than {limit} bytes",
        de: "die Datei ist nicht lesbar: eine Zeile ist länger als {limit} Bytes",
        help_en: "shorten the line; if the file is not a list of ignore patterns, move it elsewhere",
        help_de: "die Zeile kürzen; enthält die Datei keine Ignore-Muster, sie woanders ablegen",
    }
    /// A directory that the system refuses to list.
    UNLISTABLE: UnreadableFile {
        en: "cannot list the directory: {reason}",
        de: "das Verzeichnis lässt sich nicht auflisten: {reason}",
        help_en: "give the user who runs pathbuild read permission for the directory; until then, drawings in it may be missing",
        help_de: "dem Benutzer, der pathbuild aufruft, das Leserecht für das Verzeichnis geben; bis dahin können Zeichnungen daraus fehlen",
    }
    /// A drawing or directory with a name that is not UTF-8.
    NAME_NOT_UTF_8: UnreadableFile {
        en: "the name {name} in this directory is not valid UTF-8; the file or directory is not read",
        de: "der Name {name} in diesem Verzeichnis ist kein gültiges UTF-8; die Datei oder das Verzeichnis wird nicht gelesen",
        help_en: "rename it, with a name in valid UTF-8",
        help_de: "umbenennen, mit einem Namen in gültigem UTF-8",
    }
    /// A file that does not exist.
    MISSING: UnreadableFile {
        en: "there is no such file",
        de: "diese Datei gibt es nicht",
        help_en: "check the name; relative names refer to the working directory",
        help_de: "den Namen prüfen; relative Namen beziehen sich auf das Arbeitsverzeichnis",
    }
    /// Note: a file with a similar name.
    NEAR_FILE: UnreadableFile {
        en: "did you mean {near}?",
        de: "ist {near} gemeint?",
    }
    /// Note: a file whose name looks the same, but has letters with accents composed of other characters.
    NEAR_FILE_OTHER_CHARACTERS: UnreadableFile {
        en: "did you mean {near}? A letter with an accent consists of other Unicode characters there (NFC or NFD): copy the name of the file",
        de: "ist {near} gemeint? Ein Buchstabe mit Akzent oder Umlautpunkten besteht dort aus anderen Unicode-Zeichen (NFC oder NFD): den Namen der Datei kopieren",
    }
    /// A link to a file that does not exist.
    DANGLING_LINK: UnreadableFile {
        en: "the file that this link points to does not exist",
        de: "die Datei, zu der diese Verknüpfung führt, gibt es nicht",
        help_en: "restore that file, or remove the link",
        help_de: "jene Datei wiederherstellen oder die Verknüpfung entfernen",
    }
    /// A directory instead of a drawing.
    IS_DIRECTORY: UnreadableFile {
        en: "this is a directory, not a drawing",
        de: "das ist ein Verzeichnis, keine Zeichnung",
        help_en: "name a drawing in it, or use `pathbuild check` for the whole directory",
        help_de: "eine Zeichnung darin nennen oder `pathbuild check` für das ganze Verzeichnis",
    }
    /// A drawing of zero bytes.
    EMPTY_FILE: InvalidDxf {
        en: "the file is empty",
        de: "die Datei ist leer",
        help_en: "save the drawing again as DXF",
        help_de: "die Zeichnung noch einmal als DXF speichern",
    }
    /// A file without any DXF structure.
    NOT_DXF: InvalidDxf {
        en: "this is not a DXF file: {found}",
        de: "das ist keine DXF-Datei: {found}",
        help_en: "save the drawing as DXF (ASCII or binary, R10 or later); a DWG file renamed to .dxf is still DWG",
        help_de: "die Zeichnung als DXF speichern (ASCII oder binär, ab R10); eine in .dxf umbenannte DWG-Datei bleibt DWG",
    }
    /// A file that stands for a drawing in Git LFS.
    LFS_POINTER: InvalidDxf {
        en: "this is not the drawing, but a Git LFS pointer to it",
        de: "das ist nicht die Zeichnung, sondern ein Zeiger von Git LFS auf sie",
        help_en: "fetch the drawings with `git lfs pull` (in CI: `lfs: true` of actions/checkout, `git lfs install` for GitLab); a revision that `diff` reads has only the pointers: compare two checked-out directories",
        help_de: "die Zeichnungen mit `git lfs pull` holen (in der CI: `lfs: true` von actions/checkout, `git lfs install` bei GitLab); eine Revision, die `diff` liest, hat nur die Zeiger: zwei ausgecheckte Verzeichnisse vergleichen",
    }
    /// A drawing in other units than configured.
    WRONG_UNITS: WrongUnits {
        en: "the drawing's units are {unit}, not millimetres ($INSUNITS is {number})",
        de: "die Einheit der Zeichnung ist {unit}, nicht Millimeter ($INSUNITS ist {number})",
        help_en: "scale the drawing to millimetres in the CAD program and set its units (the latter alone changes no length), or set `units` in pathbuild.toml: \"drawing\" converts, \"mm\" ignores the header",
        help_de: "die Zeichnung im CAD auf Millimeter skalieren und ihre Einheit umstellen (das Umstellen allein ändert keine Länge) oder `units` in pathbuild.toml setzen: \"drawing\" rechnet um, \"mm\" beachtet den Kopf nicht",
    }
    /// A bug in pathbuild.
    INTERNAL: InternalError {
        en: "internal error: {reason}",
        de: "interner Fehler: {reason}",
        help_en: "please report this bug in pathbuild, with the drawing and the version that `pathbuild --version` prints",
        help_de: "bitte diesen Fehler in pathbuild melden, mit der Zeichnung und der Ausgabe von `pathbuild --version`",
    }
    /// A quantity that exceeds a configured limit.
    LIMIT: LimitReached {
        en: "{what} exceeds the limit of {limit}",
        de: "{what} überschreitet die Grenze von {limit}",
        help_en: "if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A path with more moves in its program than the limit permits.
    TOO_MANY_MOVES: LimitReached {
        en: "this path has {count} moves, which exceeds the limit of {limit}",
        de: "dieser Pfad hat {count} Bewegungen und überschreitet damit die Grenze von {limit}",
        help_en: "check infeed I and depth B (a wrong I gives thousands of passes), or embed fewer paths in one project; if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "Zustellung I und Tiefe B prüfen (ein falsches I ergibt tausende Durchgänge) oder weniger Pfade in einem Projekt einbetten; wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A path with more moves than the limit permits once `z-split` has divided them.
    TOO_MANY_PIECES: LimitReached {
        en: "z-split divides the moves of this path into {count} pieces, which exceeds the limit of {limit}",
        de: "z-split teilt die Bewegungen dieses Pfads in {count} Stücke und überschreitet damit die Grenze von {limit}",
        help_en: "raise `z-split`, which is the length of a piece; if that many are intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "`z-split`, die Länge eines Stücks, erhöhen; sind so viele gewollt, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A program that would take more memory than the limit permits.
    TOO_MUCH_MEMORY: LimitReached {
        en: "this path has {count} moves, which take about {size} bytes of memory; the limit is {limit}",
        de: "dieser Pfad hat {count} Bewegungen, die etwa {size} Bytes Speicher brauchen; die Grenze ist {limit}",
        help_en: "check infeed I and depth B (a wrong I gives thousands of passes); or, if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "Zustellung I und Tiefe B prüfen (ein falsches I ergibt tausende Durchgänge); oder, wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// `.gitignore` and `.ignore` files that together exceed the limit of their size; their directory is skipped.
    TOO_MANY_RULES: LimitReached {
        en: "the .gitignore and .ignore files below {directory} add up to more than {limit} bytes: the directory is skipped",
        de: "die .gitignore- und .ignore-Dateien unter {directory} haben zusammen mehr als {limit} Bytes: das Verzeichnis wird übergangen",
        help_en: "name a deeper directory, or raise `{key}` under [limits] in pathbuild.toml: together, these files may be 16 times as large as that limit",
        help_de: "ein tieferes Verzeichnis nennen oder `{key}` unter [limits] in pathbuild.toml erhöhen: zusammen dürfen diese Dateien 16-mal so groß sein wie diese Grenze",
    }
    /// A line of output that is longer than any reader accepts, including pathbuild itself.
    OUTPUT_LINE_TOO_LONG: LimitReached {
        en: "line {line} of {name} has {length} bytes, which exceeds the limit of {limit}; nothing is written",
        de: "Zeile {line} von {name} hat {length} Bytes und überschreitet damit die Grenze von {limit}; es wird nichts geschrieben",
        help_en: "shorten the comment Q; with many probes, use a `z-model` other than \"plane\": each formula then uses only four probes",
        help_de: "den Kommentar Q kürzen; bei vielen Proben ein anderes `z-model` als \"plane\" wählen: jede Formel verwendet dann nur vier Proben",
    }
    /// A program that is too large to write.
    OUTPUT_TOO_LARGE: LimitReached {
        en: "this program is larger than {limit} bytes; it is not written",
        de: "dieses Programm ist größer als {limit} Bytes; es wird nicht geschrieben",
        help_en: "check infeed I, depth B and the length of comments Q; or, if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "Zustellung I, Tiefe B und die Länge der Kommentare Q prüfen; oder, wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A setup sheet, a probing program or a file of measured values that is too large to write.
    FILE_TOO_LARGE: LimitReached {
        en: "{name} is larger than {limit} bytes; neither it nor the files that belong to it are written",
        de: "{name} ist größer als {limit} Bytes; weder diese Datei noch die zugehörigen werden geschrieben",
        help_en: "if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A program with more embedded paths than the limit permits.
    TOO_MANY_PATHS: LimitReached {
        en: "the number of different embedded paths (each with its values) exceeds the limit of {limit}",
        de: "die Zahl verschiedener eingebetteter Pfade (jeder mit seinen Werten) überschreitet die Grenze von {limit}",
        help_en: "embed fewer paths in one project; or, if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "weniger Pfade in einem Projekt einbetten; oder, wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A directory tree with more entries than the limit permits.
    TOO_MANY_ENTRIES: LimitReached {
        en: "there are more than {limit} files and directories below {directory}: the directory is skipped",
        de: "unter {directory} liegen mehr als {limit} Dateien und Verzeichnisse: das Verzeichnis wird übergangen",
        help_en: "name a deeper directory, exclude what does not belong to the library with an .ignore file, or raise `{key}` under [limits] in pathbuild.toml",
        help_de: "ein tieferes Verzeichnis nennen, mit einer Datei .ignore ausschließen, was nicht zur Bibliothek gehört, oder `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// An output or cache file that the system refuses to remove.
    CANNOT_REMOVE: CannotWrite {
        en: "cannot remove {name}: {reason}",
        de: "{name} kann nicht entfernt werden: {reason}",
        help_en: "check the directory's permissions, and whether another program has the file open",
        help_de: "die Rechte des Verzeichnisses prüfen, und ob ein anderes Programm die Datei geöffnet hat",
    }
    /// A file name that would change the meaning of a make rule.
    UNNAMEABLE: CannotWrite {
        en: "{name} cannot be used in a make rule: it contains one of `= % | * ? [`, begins with `~`, or ends with `)` or `\\`",
        de: "{name} kann in keiner make-Regel stehen: der Name enthält eines von `= % | * ? [`, beginnt mit `~` oder endet mit `)` oder `\\`",
        help_en: "rename the file or the directory, or leave out --deps",
        help_de: "die Datei oder das Verzeichnis umbenennen oder --deps weglassen",
    }
    /// An output file with the name of a drawing, a configuration or a program, which it must not replace.
    WOULD_REPLACE: CannotWrite {
        en: "cannot write {name}: {reason}",
        de: "{name} kann nicht geschrieben werden: {reason}",
        help_en: "give another name; nothing was written",
        help_de: "einen anderen Namen angeben; nichts wurde geschrieben",
    }
    /// A file to be created that already exists.
    ALREADY_THERE: CannotWrite {
        en: "cannot write {name}: {reason}",
        de: "{name} kann nicht geschrieben werden: {reason}",
        help_en: "edit that file, or rename or remove it first; nothing was written",
        help_de: "jene Datei bearbeiten, oder sie zuerst umbenennen oder löschen; nichts wurde geschrieben",
    }
    /// A file to be written into a directory that does not exist.
    DIRECTORY_MISSING: CannotWrite {
        en: "cannot write {name}: there is no such directory",
        de: "{name} kann nicht geschrieben werden: das Verzeichnis gibt es nicht",
        help_en: "create the directory, or correct its name",
        help_de: "das Verzeichnis anlegen oder den Namen berichtigen",
    }
    /// A file to be written into a directory in whose place there is a file.
    DIRECTORY_IS_FILE: CannotWrite {
        en: "cannot write {name}: in place of its directory, there is a file",
        de: "{name} kann nicht geschrieben werden: eine Datei heißt wie das Verzeichnis",
        help_en: "rename that file, or write into another directory",
        help_de: "jene Datei umbenennen oder in ein anderes Verzeichnis schreiben",
    }
    /// A file outside of the untrusted repository.
    WRITTEN_OUTSIDE: CannotWrite {
        en: "cannot write {name}: {reason}",
        de: "{name} kann nicht geschrieben werden: {reason}",
        help_en: "write to a place within the repository; if it is your own, leave out --untrusted, or list it in `[trust] roots` of your config.toml",
        help_de: "einen Ort im Repository angeben; beim eigenen Repository --untrusted weglassen oder es unter `[trust] roots` in der eigenen config.toml aufführen",
    }
    /// An output with a name that no file can have on all systems.
    NAME_NOT_ALLOWED: CannotWrite {
        en: "cannot write {name}: {reason}",
        de: "{name} kann nicht geschrieben werden: {reason}",
        help_en: "correct R or the name after --join, or rename the path or the drawing",
        help_de: "R oder den Namen hinter --join berichtigen, oder den Pfad oder die Zeichnung umbenennen",
    }
    /// A file that cannot be written.
    CANNOT_WRITE: CannotWrite {
        en: "cannot write {name}: {reason}",
        de: "{name} kann nicht geschrieben werden: {reason}",
        help_en: "check the directory's permissions and the free space, and whether another program has the file open; nothing was written under that name",
        help_de: "die Rechte des Verzeichnisses und den freien Speicherplatz prüfen, und ob ein anderes Programm die Datei geöffnet hat; unter diesem Namen wurde nichts geschrieben",
    }
    /// A G-code program with more steps than the limit permits.
    PROGRAM_TOO_LONG: LimitReached {
        en: "this program has more than {count} steps, which take about {size} bytes of memory; the limit is {limit}",
        de: "dieses Programm hat mehr als {count} Schritte, die etwa {size} Bytes Speicher brauchen; die Grenze ist {limit}",
        help_en: "check the repetitions (L or K) and the step Q of drilling cycles; or, if that is intended, raise `{key}` under [limits] in pathbuild.toml",
        help_de: "Wiederholungen (L oder K) und Schrittweite Q der Bohrzyklen prüfen; oder, wenn das so gewollt ist, `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
}
