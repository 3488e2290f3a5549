//! Messages about pathbuild.toml and the values of options. (PB003, PB526, PB529, PB610; book: reference/configuration)

use crate::words::words;

messages! {
    /// A run that did nothing because its arguments, or the state of the repository, do not allow it.
    REFUSED: InvalidConfiguration {
        en: "nothing was done: {reason}",
        de: "nichts wurde getan: {reason}",
        help_en: "correct this and start pathbuild again",
        help_de: "das beheben und pathbuild noch einmal starten",
    }
    /// A configuration that does not exist or cannot be read.
    CONFIGURATION_UNREADABLE: InvalidConfiguration {
        en: "cannot read the configuration: {reason}",
        de: "die Konfiguration ist nicht lesbar: {reason}",
        help_en: "check the file's name and permissions and, in your editor, its encoding (UTF-8); `pathbuild init` writes a pathbuild.toml where there is none",
        help_de: "Namen und Rechte der Datei und im Editor die Kodierung (UTF-8) prüfen; `pathbuild init` schreibt eine pathbuild.toml, wo es keine gibt",
    }
    /// A configuration that is not valid TOML, with the parser's reason.
    TOML_SYNTAX: InvalidConfiguration {
        en: "this is not valid TOML: {reason}",
        de: "das ist kein gültiges TOML: {reason}",
        help_en: "write texts in double quotes and patterns in single quotes; the file that `pathbuild init` writes shows the form of each key",
        help_de: "Texte in doppelte Anführungszeichen setzen, Muster in einfache; die Datei, die `pathbuild init` schreibt, zeigt die Form jedes Schlüssels",
    }
    /// A key or a table that the file has twice.
    TOML_DUPLICATE: InvalidConfiguration {
        en: "this key or table occurs for the second time",
        de: "dieser Schlüssel oder diese Tabelle kommt zum zweiten Mal vor",
        help_en: "keep one of the two; all keys of a table belong below a single [table]",
        help_de: "nur eines von beiden behalten; alle Schlüssel einer Tabelle gehören unter eine einzige [Tabelle]",
    }
    /// A number with a decimal comma.
    TOML_COMMA: InvalidConfiguration {
        en: "this number has a comma",
        de: "diese Zahl hat ein Komma",
        help_en: "write a point: numbers in this file have a decimal point",
        help_de: "einen Punkt schreiben: Zahlen in dieser Datei haben einen Dezimalpunkt",
    }
    /// A backslash in double quotes that begins no valid escape, with the parser's reason.
    TOML_ESCAPE: InvalidConfiguration {
        en: "in double quotes, a backslash has a special meaning: {reason}",
        de: "in doppelten Anführungszeichen hat ein Backslash eine besondere Bedeutung: {reason}",
        help_en: "write the text in single quotes, or a path with `/`",
        help_de: "den Text in einfache Anführungszeichen setzen oder einen Pfad mit `/` schreiben",
    }
    /// A file or directory with a control character in its name, such as the tab that `"C:\temp"` has.
    CONTROL_CHARACTER: InvalidConfiguration {
        en: "the value of `{key}` contains a control character: in double quotes, a backslash has a special meaning",
        de: "der Wert von `{key}` enthält ein Steuerzeichen: in doppelten Anführungszeichen hat ein Backslash eine besondere Bedeutung",
        help_en: "write the path with `/`, or, on Windows, in single quotes",
        help_de: "den Dateipfad mit `/` schreiben oder unter Windows in einfache Anführungszeichen setzen",
    }
    /// A file or directory name that begins with an abbreviation of shells, such as `~/` or `$HOME/`.
    SHELL_ABBREVIATION: InvalidConfiguration {
        en: "the value of `{key}` begins with {found}, which only a shell replaces: here it would be the name of a directory",
        de: "der Wert von `{key}` beginnt mit {found}, was nur eine Shell ersetzt: hier wäre es der Name eines Verzeichnisses",
        help_en: "write the path in full, or relative to this file; write ./ before it if a directory has this name",
        help_de: "den Dateipfad ausschreiben oder bezogen auf diese Datei angeben; ./ davor schreiben, wenn ein Verzeichnis so heißt",
    }
    /// A file or directory name with a backslash, outside of Windows.
    BACKSLASH_IN_PATH: InvalidConfiguration {
        en: "the value of `{key}` contains a backslash, which separates directories on Windows only: here it would be part of a name",
        de: "der Wert von `{key}` enthält einen Backslash, der nur unter Windows Verzeichnisse trennt: hier wäre er Teil eines Namens",
        help_en: "write / instead: it separates directories on Windows, too",
        help_de: "stattdessen / schreiben: das trennt auch unter Windows Verzeichnisse",
    }
    /// An unknown key that is similar to a known one.
    UNKNOWN_KEY: InvalidConfiguration {
        en: "unknown key `{key}`",
        de: "unbekannter Schlüssel `{key}`",
        help_en: "did you mean `{near}`?",
        help_de: "ist `{near}` gemeint?",
    }
    /// An unknown key that is not similar to any known one.
    UNLIKE_KEY: InvalidConfiguration {
        en: "unknown key `{key}`",
        de: "unbekannter Schlüssel `{key}`",
        help_en: "use one of the keys known here: {known}",
        help_de: "einen der hier bekannten Schlüssel verwenden: {known}",
    }
    /// A key that belongs in another table.
    KEY_OF_TABLE: InvalidConfiguration {
        en: "the key `{key}` is in the wrong place",
        de: "der Schlüssel `{key}` steht an der falschen Stelle",
        help_en: "`{near}` belongs in {table}",
        help_de: "`{near}` gehört in {table}",
    }
    /// A top-level key inside a table.
    KEY_OF_TOP: InvalidConfiguration {
        en: "the key `{key}` is in the wrong place",
        de: "der Schlüssel `{key}` steht an der falschen Stelle",
        help_en: "`{near}` belongs at the top of the file, before the first [table]",
        help_de: "`{near}` gehört an den Anfang der Datei, vor die erste [Tabelle]",
    }
    /// An unknown key that is similar to a key of another table.
    NEAR_KEY_OF_TABLE: InvalidConfiguration {
        en: "unknown key `{key}`",
        de: "unbekannter Schlüssel `{key}`",
        help_en: "did you mean `{near}`? It belongs in {table}",
        help_de: "ist `{near}` gemeint? Das gehört in {table}",
    }
    /// An unknown key that is similar to a top-level one.
    NEAR_KEY_OF_TOP: InvalidConfiguration {
        en: "unknown key `{key}`",
        de: "unbekannter Schlüssel `{key}`",
        help_en: "did you mean `{near}`? It belongs at the top of the file, before the first [table]",
        help_de: "ist `{near}` gemeint? Das gehört an den Anfang der Datei, vor die erste [Tabelle]",
    }
    /// A key that an earlier version had.
    REPLACED_KEY: InvalidConfiguration {
        en: "the key `{key}` no longer exists",
        de: "den Schlüssel `{key}` gibt es nicht mehr",
        help_en: "remove it; `{new} = true` writes programs as PathDxf2GCode does; without that setting, support bars keep their full length",
        help_de: "entfernen; mit `{new} = true` schreibt pathbuild Programme wie PathDxf2GCode; ohne diese Einstellung behalten Stützstege ihre volle Länge",
    }
    /// A layer that is both a path layer and a layer with clamps.
    KEEP_OUT_IS_PATH: InvalidConfiguration {
        en: "layer {layer} matches both `path-pattern` and `keep-out`: it cannot hold a path and clamps",
        de: "auf Layer {layer} passen sowohl `path-pattern` als auch `keep-out`: er kann nicht zugleich Pfad und Spannmittel enthalten",
        help_en: "narrow `keep-out` so that it matches only the names of layers with clamps, or rename the layer",
        help_de: "`keep-out` so einschränken, dass es nur auf die Namen von Layern mit Spannmitteln passt, oder den Layer umbenennen",
    }
    /// A table for a feature that this version does not have.
    NOT_BUILT: InvalidConfiguration {
        en: "`{key}` is not supported",
        de: "`{key}` wird nicht unterstützt",
        help_en: "remove it; this version would ignore it",
        help_de: "entfernen; diese Version würde es nicht beachten",
    }
    /// A table without a required key.
    MISSING_KEY: InvalidConfiguration {
        en: "`{key}` needs the key `{missing}`",
        de: "`{key}` braucht den Schlüssel `{missing}`",
    }
    /// A value with a wrong type or out of range.
    INVALID_VALUE: InvalidConfiguration {
        en: "`{key}` must be {expected}, not {found}",
        de: "`{key}` muss {expected} sein, nicht {found}",
    }
    /// A number with an exponent as the value of an option.
    EXPONENT: InvalidConfiguration {
        en: "`{key}` must be a number without an exponent, not {found}",
        de: "`{key}` muss eine Zahl ohne Exponenten sein, nicht {found}",
        help_en: "write {number}",
        help_de: "{number} schreiben",
    }
    /// A path that leads out of an untrusted repository.
    OUTSIDE: InvalidConfiguration {
        en: "`{key}` leads out of the untrusted repository",
        de: "`{key}` führt aus dem nicht vertrauenswürdigen Repository hinaus",
        help_en: "use a place below {root}; if the repository is your own, leave out --untrusted, or list the repository in `[trust] roots` of your config.toml",
        help_de: "einen Ort unterhalb von {root} verwenden; beim eigenen Repository --untrusted weglassen oder das Repository unter `[trust] roots` in der eigenen config.toml aufführen",
    }
    /// A limit raised by an untrusted repository.
    RAISED_LIMIT: InvalidConfiguration {
        en: "`{key}` is above its default, which is only allowed in trusted repositories",
        de: "`{key}` liegt über der Vorgabe, was nur in vertrauenswürdigen Repositorys erlaubt ist",
        help_en: "lower it to {default} or less",
        help_de: "auf höchstens {default} senken",
    }
    /// A post that an untrusted repository marks as unchecked.
    UNCHECKED_BY_STRANGER: InvalidConfiguration {
        en: "`{key}` is only allowed in trusted repositories",
        de: "`{key}` ist nur in vertrauenswürdigen Repositorys erlaubt",
        help_en: "remove it: output that cannot be read back is then an error",
        help_de: "entfernen: eine Ausgabe, die sich nicht zurücklesen lässt, ist dann ein Fehler",
    }
    /// A tool number that another cutter already has.
    NUMBER_SHARED: InvalidConfiguration {
        en: "`{key}` is {number}, but [{other}], a different cutter, already has this number",
        de: "`{key}` ist {number}, aber [{other}], ein anderer Fräser, hat diese Nummer schon",
        help_en: "give each cutter a number of its own: programs name the tool by its number, and change it where the number changes",
        help_de: "jedem Fräser eine eigene Nummer geben: Programme nennen das Werkzeug mit seiner Nummer und wechseln es, wo sich die Nummer ändert",
    }
    /// Two names of a line type that differ in case only.
    SAME_LINE_TYPE: InvalidConfiguration {
        en: "`{key}` has both {name} and {first}, which differ only in case",
        de: "`{key}` enthält {name} und {first}, die sich nur in der Groß- und Kleinschreibung unterscheiden",
        help_en: "remove one of the two: case makes no difference in the names of line types",
        help_de: "einen der beiden Namen entfernen: bei Linientypen zählt Groß- und Kleinschreibung nicht",
    }
    /// An entry for a name such as BYLAYER, which stands for the line type of the layer or of the block.
    INHERITED_LINE_TYPE: InvalidConfiguration {
        en: "`{key}` has {name}, which stands for the line type of the layer or of the block",
        de: "`{key}` enthält {name}, das für den Linientyp des Layers oder des Blocks steht",
        help_en: "remove the entry, and name the line type of the layer instead",
        help_de: "den Eintrag entfernen und den Linientyp des Layers nennen",
    }
    /// A key that names something other than a directory.
    NO_DIRECTORY: InvalidConfiguration {
        en: "`{key}` names {directory}, which is not a directory",
        de: "`{key}` nennt {directory}, das kein Verzeichnis ist",
        help_en: "correct the name; names in pathbuild.toml are relative to that file, those of options to the working directory",
        help_de: "den Namen berichtigen; Namen in pathbuild.toml beziehen sich auf das Verzeichnis dieser Datei, die von Optionen auf das Arbeitsverzeichnis",
    }
    /// A directory that a revision's configuration names, and that the revision does not have.
    NO_DIRECTORY_IN_REVISION: InvalidConfiguration {
        en: "`{key}` names {directory}, but the revision has no such directory",
        de: "`{key}` nennt {directory}, aber die Revision hat kein solches Verzeichnis",
        help_en: "if its drawings are outside of the repository, or ignored by Git, compare two directories instead of a revision",
        help_de: "wenn seine Zeichnungen außerhalb des Repositorys liegen oder von Git ignoriert werden, zwei Verzeichnisse statt einer Revision vergleichen",
    }
    /// A value that is none of the choices.
    INVALID_CHOICE: InvalidConfiguration {
        en: "{found} is not a valid value of `{key}`",
        de: "{found} ist kein gültiger Wert von `{key}`",
        help_en: "valid values are {choices}",
        help_de: "möglich sind {choices}",
    }
    /// A value that is none of the choices, but similar to one of them.
    NEAR_CHOICE: InvalidConfiguration {
        en: "{found} is not a valid value of `{key}`",
        de: "{found} ist kein gültiger Wert von `{key}`",
        help_en: "did you mean \"{near}\"?",
        help_de: "ist \"{near}\" gemeint?",
    }
    /// The value of a key is not a valid regular expression.
    BROKEN_REGEX: InvalidConfiguration {
        en: "`{key}` is not a regular expression: {reason}",
        de: "`{key}` ist kein regulärer Ausdruck: {reason}",
        help_en: "escape literal characters with a backslash or brackets: [.]",
        help_de: "Zeichen, die wörtlich gemeint sind, mit einem Backslash oder in eckigen Klammern schreiben: [.]",
    }
    /// More patterns than permitted. Without a limit, patterns could take any amount of memory.
    TOO_MANY_PATTERNS: InvalidConfiguration {
        en: "the file has more than {most} {what}",
        de: "die Datei hat mehr als {most} {what}",
        help_en: "combine alternatives into one pattern: a|b; in file patterns they are written in braces, separated by commas",
        help_de: "Alternativen in einem Muster zusammenfassen: a|b; in Dateimustern stehen sie in geschweiften Klammern, durch Kommas getrennt",
    }
    /// The value of a key is not a valid name pattern.
    BROKEN_GLOB: InvalidConfiguration {
        en: "`{key}` is not a valid name pattern: {reason}",
        de: "`{key}` ist kein gültiges Namensmuster: {reason}",
        help_en: "write * for any text, ** also across directories, ? for one character, [a-c] for one of several",
        help_de: "* für beliebigen Text schreiben, ** auch über Verzeichnisse hinweg, ? für ein Zeichen, [a-c] für eines von mehreren",
    }
    /// A restriction of embeddings without the colon between the patterns for parent and child.
    RESTRICT_WITHOUT_COLON: InvalidConfiguration {
        en: "`{key}` must be PARENT:CHILD, two regular expressions separated by a colon",
        de: "`{key}` muss AUSSEN:INNEN sein, zwei reguläre Ausdrücke, durch einen Doppelpunkt getrennt",
        help_en: "write for example \"^8:P$\": paths whose names match ^8 may then embed only paths whose names match P$",
        help_de: "zum Beispiel \"^8:P$\" schreiben: Pfade, deren Namen ^8 entsprechen, dürfen dann nur Pfade einbetten, deren Namen P$ entsprechen",
    }
    /// A severity for an unknown code that is similar to a known one.
    UNKNOWN_CODE: InvalidConfiguration {
        en: "there is no diagnostic {code}",
        de: "es gibt keine Meldung {code}",
        help_en: "did you mean {near}? `pathbuild explain` lists all codes",
        help_de: "ist {near} gemeint? `pathbuild explain` führt alle Codes auf",
    }
    /// A severity for an unknown code that is not similar to any known one.
    UNLIKE_CODE: InvalidConfiguration {
        en: "there is no diagnostic {code}",
        de: "es gibt keine Meldung {code}",
        help_en: "`pathbuild explain` lists all codes",
        help_de: "`pathbuild explain` führt alle Codes auf",
    }
    /// A lower severity for a code that must keep its severity.
    CANNOT_BE_LOWERED: InvalidConfiguration {
        en: "{code} ({name}) cannot be lowered to \"{level}\"",
        de: "{code} ({name}) kann nicht auf \"{level}\" herabgesetzt werden",
        help_en: "correct the drawing or program, or keep known errors in a file with --baseline; a lower severity could let a wrong program through",
        help_de: "die Zeichnung oder das Programm berichtigen oder bekannte Fehler mit --baseline in einer Datei festhalten; ein niedrigerer Schweregrad könnte ein falsches Programm durchlassen",
    }
    /// An argument with another configuration than the first argument.
    OTHER_CONFIGURATION: InvalidConfiguration {
        en: "{argument} belongs to {other}, but this run uses {used}",
        de: "{argument} gehört zu {other}, dieser Lauf verwendet aber {used}",
        help_en: "run once for each configuration, or name the intended one with --config",
        help_de: "für jede Konfiguration einen eigenen Lauf machen oder die gemeinte mit --config nennen",
    }
    /// An argument that has a configuration, although the first argument has none.
    UNEXPECTED_CONFIGURATION: InvalidConfiguration {
        en: "{argument} belongs to {other}, but this run has no configuration, because its first argument has none",
        de: "{argument} gehört zu {other}, dieser Lauf hat aber keine Konfiguration, weil sein erstes Argument keine hat",
        help_en: "run pathbuild separately for each argument, or name the intended configuration with --config",
        help_de: "pathbuild für jedes Argument einzeln aufrufen oder die gemeinte Konfiguration mit --config nennen",
    }
    /// An argument without a configuration, although the first argument has one.
    NO_CONFIGURATION: InvalidConfiguration {
        en: "no pathbuild.toml applies to {argument}, but this run uses {used}",
        de: "für {argument} gilt keine pathbuild.toml, dieser Lauf verwendet aber {used}",
        help_en: "run pathbuild separately for each argument, or name the intended configuration with --config",
        help_de: "pathbuild für jedes Argument einzeln aufrufen oder die gemeinte Konfiguration mit --config nennen",
    }
    /// A configuration in a subdirectory, which has no effect because the run uses another one.
    UNUSED_CONFIGURATION: UnusedConfiguration {
        en: "this configuration does not apply: the run uses {used} here, too",
        de: "diese Konfiguration gilt nicht: der Lauf verwendet auch hier {used}",
        help_en: "run pathbuild on this directory separately, or remove the file",
        help_de: "für dieses Verzeichnis pathbuild einzeln aufrufen oder die Datei entfernen",
    }
    /// A configuration in a subdirectory, which has no effect because the run has no configuration.
    UNUSED_WITHOUT_ANY: UnusedConfiguration {
        en: "this configuration does not apply: the run uses none, because there is no pathbuild.toml in the directory where it starts, or above it",
        de: "diese Konfiguration gilt nicht: der Lauf verwendet keine, weil es in seinem Ausgangsverzeichnis und darüber keine pathbuild.toml gibt",
        help_en: "run pathbuild on this directory separately, or name the intended configuration with --config",
        help_de: "für dieses Verzeichnis pathbuild einzeln aufrufen oder die gemeinte Konfiguration mit --config nennen",
    }
    /// A baseline file that cannot be read.
    BASELINE_UNREADABLE: InvalidConfiguration {
        en: "cannot read the baseline: {reason}",
        de: "die Liste bekannter Befunde ist nicht lesbar: {reason}",
        help_en: "check the file's name; or move the unreadable file away, and write a new baseline with --update-baseline",
        help_de: "den Dateinamen prüfen; oder die unlesbare Datei woanders ablegen und mit --update-baseline eine neue Liste schreiben",
    }
    /// A line of a baseline that does not begin with a fingerprint.
    BASELINE_LINE: InvalidConfiguration {
        en: "this line of the baseline does not begin with a fingerprint of 32 hexadecimal digits",
        de: "diese Zeile der Liste bekannter Befunde beginnt nicht mit einem Kennzeichen aus 32 Hexadezimalziffern",
        help_en: "remove it, or rewrite the file with --update-baseline",
        help_de: "die Zeile entfernen oder die Datei mit --update-baseline neu schreiben",
    }
    /// A baseline entry with an invalid date.
    BASELINE_DATE: InvalidConfiguration {
        en: "`{found}` is not a date",
        de: "`{found}` ist kein Datum",
        help_en: "write year, month and day: until=2026-12-31",
        help_de: "Jahr, Monat und Tag schreiben: until=2026-12-31",
    }
    /// A baseline entry with an invalid depth.
    BASELINE_DEPTH: InvalidConfiguration {
        en: "`{found}` is not a depth in mm",
        de: "`{found}` ist keine Tiefe in mm",
        help_en: "write a number, such as depth=0.05, or remove the line and accept the finding again with --accept",
        help_de: "eine Zahl schreiben, etwa depth=0.05, oder die Zeile entfernen und den Befund mit --accept noch einmal hinnehmen",
    }
    /// A baseline entry with an unreadable reason.
    BASELINE_REASON: InvalidConfiguration {
        en: "the reason is not a text in double quotes",
        de: "der Grund ist kein Text in Anführungszeichen",
        help_en: "write reason=\"...\", with a backslash before each quote inside",
        help_de: "reason=\"...\" schreiben, mit einem Backslash vor jedem Anführungszeichen im Text",
    }
    /// A baseline entry with an invalid severity.
    BASELINE_SEVERITY: InvalidConfiguration {
        en: "`{found}` is not a severity",
        de: "`{found}` ist keine Einstufung",
        help_en: "write severity=warning, or remove the word if the finding is an error",
        help_de: "severity=warning schreiben oder das Wort entfernen, wenn der Befund ein Fehler ist",
    }
    /// A glob of a table `[[severity-in]]` that matches neither a drawing nor a program.
    GLOB_WITHOUT_FILE: GlobWithoutFile {
        en: "`files` ({glob}) matches no drawing and no program, so it sets no severity",
        de: "`files` ({glob}) passt auf keine Zeichnung und kein Programm und legt daher keinen Schweregrad fest",
        help_en: "write the name as seen from pathbuild.toml, with / and without ./: old/** stands for everything in and below the directory old",
        help_de: "den Namen so schreiben, wie er von pathbuild.toml aus heißt, mit / und ohne ./: old/** steht für alles im Verzeichnis old und darunter",
    }
    /// A waiver that matches no finding.
    UNUSED_WAIVER: UnusedWaiver {
        en: "this waiver no longer matches any finding",
        de: "diese Ausnahme trifft auf keinen Befund mehr zu",
        help_en: "remove it, so that it does not hide the same finding later",
        help_de: "sie entfernen, damit sie nicht später denselben Befund verdeckt",
    }
    /// Note: a waiver would apply, but its last day has passed.
    WAIVER_ENDED: InvalidConfiguration {
        en: "{place} accepts this finding only until {until}; the date of this run is {date} ({source})",
        de: "laut {place} ist dieser Befund nur bis {until} hingenommen; das Datum dieses Laufs ist {date} ({source})",
    }
    /// Note: the finding is worse than when it was accepted, for example a tool deeper in the material.
    WAIVER_DEEPER: InvalidConfiguration {
        en: "{place} accepts this finding only up to {accepted} mm; here it is {depth} mm",
        de: "laut {place} ist dieser Befund nur bis {accepted} mm hingenommen; hier sind es {depth} mm",
    }
    /// Note: a finding that was accepted as a warning is an error now.
    WAIVER_OF_WARNING: InvalidConfiguration {
        en: "{place} accepts this finding only as a warning; here it is an error",
        de: "laut {place} ist dieser Befund nur als Warnung hingenommen; hier ist es ein Fehler",
    }
    /// Note: a waiver written by an older version accepts a tool in the material without stating the depth.
    WAIVER_WITHOUT_DEPTH: InvalidConfiguration {
        en: "{place} accepts this finding, but does not state the depth: accept the finding again",
        de: "laut {place} ist dieser Befund hingenommen, aber ohne Angabe der Tiefe: ihn noch einmal hinnehmen",
    }
    /// Note: a waiver with a last day does not apply because the date of the run is unknown.
    WAIVER_WITHOUT_DATE: InvalidConfiguration {
        en: "{place} accepts this finding until {until}, but that does not apply here because this run has no date",
        de: "laut {place} ist dieser Befund bis {until} hingenommen; das gilt hier nicht, weil dieser Lauf kein Datum hat",
    }
    /// Note: the configuration sets a severity until a date.
    SEVERITY_UNTIL: InvalidConfiguration {
        en: "{place} sets this severity until {until}; the date of this run is {date} ({source})",
        de: "{place} legt diesen Schweregrad bis {until} fest; das Datum dieses Laufs ist {date} ({source})",
    }
    /// Note: the reason given for a waiver.
    WAIVER_REASON: InvalidConfiguration {
        en: "the reason was: {reason}",
        de: "der Grund war: {reason}",
    }
}

words! {
    /// Permitted values: any number.
    NUMBER: "a number", "eine Zahl";
    /// Permitted values of measures. Values beyond these bounds can only be mistakes.
    MEASURE: "a number from 0.001 to 1000000", "eine Zahl von 0.001 bis 1000000";
    /// Permitted values of speeds in mm/min or 1/min.
    SPEED: "a number without a thousands separator, such as 1200 instead of 1.200", "eine Zahl ohne Tausendertrennzeichen, etwa 1200 statt 1.200";
    /// Permitted values: numbers greater than 0.
    POSITIVE: "a number greater than 0", "eine Zahl größer als 0";
    /// Permitted values: 0 and greater numbers.
    NOT_NEGATIVE: "a number of at least 0", "eine Zahl von mindestens 0";
    /// Permitted values of a time in seconds for which the machine waits.
    WAIT: "a number of seconds from 0 to 60, such as 3 instead of 3000 ms", "eine Zahl von Sekunden von 0 bis 60, etwa 3 statt 3000 ms";
    /// Permitted values of the length in mm of pieces of moves (`z-split`). 0 means that moves are not divided.
    PIECE: "0 or a number of at least 0.1", "0 oder eine Zahl von mindestens 0.1";
    /// Permitted values of a tolerance of the part check, in mm.
    PART_TOLERANCE: "a number of at least 0.005", "eine Zahl von mindestens 0.005";
    /// Permitted values of a tool's corner radius, which depend on its diameter.
    CORNER_RADIUS: "a number of at most half of `diameter`", "eine Zahl von höchstens der Hälfte von `diameter`";
    /// Permitted values: whole numbers from 1 up.
    COUNT: "a whole number from 1 up", "eine ganze Zahl ab 1";
    /// Permitted values: a list of regular expressions.
    REGEXES: "regular expressions", "reguläre Ausdrücke";
    /// Permitted values: a list of patterns of names.
    GLOBS: "patterns of names", "Namensmuster";
    /// Permitted values: sizes greater than 0.
    SIZE: "a size greater than 0, such as \"256 MiB\"", "eine Größe über 0 wie \"256 MiB\"";
    /// Permitted values: durations.
    DURATION: "a duration such as \"50 ms\"", "eine Dauer wie \"50 ms\"";
    /// Permitted values: any text.
    TEXT: "a text", "ein Text";
    /// Permitted values: dates.
    DATE: "a date such as \"2026-12-31\"", "ein Datum wie \"2026-12-31\"";
    /// Permitted values: an absolute path.
    ABSOLUTE: "an absolute path", "ein absoluter Pfad";
    /// Permitted values: a list of absolute paths.
    ABSOLUTES: "a list of absolute paths", "eine Liste absoluter Pfade";
    /// Permitted values: any text that is not empty.
    NOT_EMPTY: "a text that is not empty", "ein nicht leerer Text";
    /// Permitted values: a list of texts.
    LIST_OF_TEXTS: "a list of texts", "eine Liste von Texten";
    /// Permitted values: true and false.
    SWITCH: "true or false", "true oder false";
    /// Permitted values: a table.
    TABLE: "a table", "eine Tabelle";
    /// Permitted values: a list of tables.
    LIST_OF_TABLES: "a list of tables", "eine Liste von Tabellen";
    /// Permitted values: a number for each of the three axes.
    AXES: "a list of three numbers greater than 0", "eine Liste von drei Zahlen größer als 0";
    /// Permitted values: the lower and the upper end of a range.
    EXTENT: "a list of two numbers, the smaller first", "eine Liste von zwei aufsteigenden Zahlen";
    /// Source of a run's date: the option `--date`.
    DATE_GIVEN: "--date", "--date";
    /// Source of a run's date: the environment variable `SOURCE_DATE_EPOCH`.
    DATE_OF_EPOCH: "SOURCE_DATE_EPOCH", "SOURCE_DATE_EPOCH";
    /// Source of a run's date: the system's clock.
    DATE_OF_CLOCK: "today, UTC", "heute, UTC";
}
