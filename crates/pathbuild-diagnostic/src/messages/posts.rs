//! Post-processors: their definitions, and what goes wrong when a program is written through one. (PB750 to PB766)

messages! {
    /// Bytes that are no text.
    POST_NOT_UTF8: InvalidPost {
        en: "the definition is not UTF-8 text",
        de: "die Definition ist kein UTF-8-Text",
        help_en: "save the file as UTF-8",
        help_de: "die Datei als UTF-8 speichern",
    }
    /// The XML or TOML parser's complaint.
    POST_SYNTAX: InvalidPost {
        en: "the definition cannot be read: {reason}",
        de: "die Definition ist nicht lesbar: {reason}",
    }
    /// Larger than any definition is.
    POST_TOO_LARGE: InvalidPost {
        en: "the definition has {size} bytes; {limit} is the limit",
        de: "die Definition hat {size} Bytes; {limit} ist die Grenze",
    }
    /// XML, but of something else.
    POST_WRONG_ROOT: InvalidPost {
        en: "the file holds <{found}>, not <PostProcessor>",
        de: "die Datei enthält <{found}>, nicht <PostProcessor>",
        help_en: "a CamBam definition begins with <PostProcessor>",
        help_de: "eine CamBam-Definition beginnt mit <PostProcessor>",
    }
    /// An option's value.
    POST_OPTION: InvalidPost {
        en: "{option} is \"{value}\", not {expected}",
        de: "{option} ist »{value}«, nicht {expected}",
    }
    /// `{$` without an end.
    POST_UNCLOSED_MACRO: InvalidPost {
        en: "a macro in {section} is not closed",
        de: "ein Makro in {section} ist nicht geschlossen",
        help_en: "close it with \"}\"",
        help_de: "es mit »}« schließen",
    }
    /// `{$spindle(left)}`.
    POST_MACRO_ARGUMENTS: InvalidPost {
        en: "{macro} in {section} has the wrong arguments; it takes {expected}",
        de: "{macro} in {section} hat falsche Argumente; erlaubt: {expected}",
    }
    /// Nobody knows the name, and nothing is like it.
    UNKNOWN_MACRO: UnknownMacro {
        en: "unknown macro {macro} in {section}",
        de: "unbekanntes Makro {macro} in {section}",
        help_en: "define it as \"$name=value\" in PostProcessorMacros or in the configuration",
        help_de: "als »$name=Wert« in PostProcessorMacros oder in der Konfiguration definieren",
    }
    /// Nobody knows the name, but one is like it.
    UNKNOWN_MACRO_NEAREST: UnknownMacro {
        en: "unknown macro {macro} in {section}",
        de: "unbekanntes Makro {macro} in {section}",
        help_en: "did you mean {nearest}?",
        help_de: "war {nearest} gemeint?",
    }
    /// Not known to CamBam or pathbuild.
    POST_UNKNOWN_ELEMENT: DoubtfulPost {
        en: "<{element}> is not known and left out",
        de: "<{element}> ist unbekannt und wird übergangen",
    }
    /// An element that stands twice.
    POST_REPEATED_ELEMENT: DoubtfulPost {
        en: "<{element}> stands here again; the last one holds",
        de: "<{element}> steht hier noch einmal; das letzte gilt",
    }
    /// A line of `PostProcessorMacros`.
    POST_MACRO_LINE: DoubtfulPost {
        en: "\"{text}\" defines no macro and is left out",
        de: "»{text}« definiert kein Makro und wird übergangen",
        help_en: "a macro is defined as $name=value",
        help_de: "ein Makro wird als $name=Wert definiert",
    }
    /// A user macro with the name of a built-in one.
    POST_SHADOWED_MACRO: DoubtfulPost {
        en: "{macro} is built in; its definition is left out",
        de: "{macro} ist eingebaut; die Definition wird übergangen",
    }
    /// A contains B contains A.
    MACRO_DEPTH: EndlessMacro {
        en: "{section} contains itself, or macros are nested more than {limit} deep",
        de: "{section} enthält sich selbst, oder Makros sind tiefer als {limit} geschachtelt",
    }
    /// Macros that multiply.
    MACRO_SIZE: EndlessMacro {
        en: "the post writes far more text than the program has moves",
        de: "der Postprozessor schreibt weit mehr Text, als das Programm Bewegungen hat",
        help_en: "look for macros that contain others several times",
        help_de: "nach Makros suchen, die andere mehrmals enthalten",
    }
    /// A hole that takes thousands of pecks.
    TOO_MANY_PECKS: EndlessMacro {
        en: "the hole at {place} takes more than {limit} pecks",
        de: "die Bohrung bei {place} braucht mehr als {limit} Stufen",
        help_en: "check C of the hole",
        help_de: "C der Bohrung prüfen",
    }
    /// A chord tolerance that is far too fine.
    TOO_MANY_CHORDS: EndlessMacro {
        en: "an arc of radius {radius} takes more than {limit} lines",
        de: "ein Bogen mit Radius {radius} braucht mehr als {limit} Strecken",
        help_en: "raise the post's tolerance for arcs",
        help_de: "die Toleranz für Bögen im Postprozessor erhöhen",
    }
    /// A number that only some programs have.
    VALUE_MISSING: MissingPostValue {
        en: "{macro} in {section} has no value in {operation}",
        de: "{macro} in {section} hat in {operation} keinen Wert",
    }
    /// Nothing written for it.
    DRILLING_LOST: LostDrilling {
        en: "the post writes nothing that drills the hole at {place}: {section} is empty",
        de: "der Postprozessor schreibt nichts, was die Bohrung bei {place} ausführt: {section} ist leer",
        help_en: "write the hole as moves (cycles = false), or give the post a text for it",
        help_de: "die Bohrung als Bewegungen schreiben (cycles = false), oder dem Postprozessor einen Text dafür geben",
    }
    /// Start and end are at different distances from the centre, as written.
    ARC_ROUNDED: RoundedArc {
        en: "as written, the arc to {place} has the radius {start} at its start and {end} at its end",
        de: "wie geschrieben hat der Bogen nach {place} am Anfang den Radius {start} und am Ende {end}",
        help_en: "give the post's number format more decimals",
        help_de: "dem Zahlenformat des Postprozessors mehr Nachkommastellen geben",
    }
    /// `MaximumArcRadius`.
    ARC_FLATTENED: FlattenedArc {
        en: "the arc to {place} has the radius {radius}; the post writes a line that is up to {distance} mm away",
        de: "der Bogen nach {place} hat den Radius {radius}; der Postprozessor schreibt eine Gerade, bis zu {distance} mm daneben",
        help_en: "raise MaximumArcRadius in the post",
        help_de: "MaximumArcRadius im Postprozessor erhöhen",
    }
    /// No words.
    LINE_UNREADABLE: UnreadableLine {
        en: "the post writes \"{line}\", which is no G-code; what it does to the machine is not followed",
        de: "der Postprozessor schreibt »{line}«, das kein G-Code ist; was es an der Maschine bewirkt, wird nicht verfolgt",
        help_en: "if that is meant, set SuppressParserErrors in the post",
        help_de: "wenn das so gewollt ist, SuppressParserErrors im Postprozessor setzen",
    }
    /// No cutter of that diameter.
    TOOL_UNKNOWN: UnknownTool {
        en: "the tool table has no cutter with O = {diameter} for {path}; it becomes tool {index}",
        de: "die Werkzeugtabelle hat keinen Fräser mit O = {diameter} für {path}; er wird Werkzeug {index}",
        help_en: "add it as [tool.NAME] to pathbuild.toml",
        help_de: "als [tool.NAME] in pathbuild.toml aufnehmen",
    }
    /// Nothing to write.
    JOB_EMPTY: NothingToPost {
        en: "the program has no operations",
        de: "das Programm hat keine Operationen",
    }
    /// NaN or infinity.
    JOB_NOT_FINITE: NothingToPost {
        en: "{operation} has a coordinate or feed that is no number",
        de: "{operation} hat eine Koordinate oder einen Vorschub, der keine Zahl ist",
    }
    /// No such post.
    POST_UNKNOWN: UnknownPost {
        en: "there is no post-processor {name}",
        de: "es gibt keinen Postprozessor {name}",
        help_en: "`pathbuild post list` lists the built-in ones; a file is given with its extension",
        help_de: "`pathbuild post list` zählt die eingebauten auf; eine Datei gibt man mit ihrer Endung an",
    }
    /// As above, but there is one like it.
    POST_UNKNOWN_NEAREST: UnknownPost {
        en: "there is no post-processor {name}",
        de: "es gibt keinen Postprozessor {name}",
        help_en: "did you mean {nearest}?",
        help_de: "war {nearest} gemeint?",
    }
    /// A note: the command after writing.
    POST_BUILD_SKIPPED: DoubtfulPost {
        en: "the post's command \"{command}\" was not run; --run-post-build runs it",
        de: "der Befehl »{command}« des Postprozessors wurde nicht ausgeführt; --run-post-build führt ihn aus",
    }
    /// A note: nothing checked the program.
    POST_WITHOUT_DIALECT: DoubtfulPost {
        en: "the post names no dialect, so its output was not checked; --dialect names one",
        de: "der Postprozessor nennt keinen Dialekt, die Ausgabe wurde nicht geprüft; --dialect nennt einen",
    }
    /// A note: the tool table's coolant comes to nothing.
    COOLANT_NOT_WRITTEN: DoubtfulPost {
        en: "the tool table says what the coolant does, but the post has no {macro} and does not write it",
        de: "die Werkzeugtabelle bestimmt die Kühlung, aber der Postprozessor hat kein {macro} und schreibt sie nicht",
    }
}
