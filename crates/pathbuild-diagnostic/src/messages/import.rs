//! Messages about importing descriptions of machines and tools. (PB612, PB613; book: howto/machine)

messages! {
    /// A file in an unknown format.
    UNKNOWN_FORMAT: UnreadableDescription {
        en: "the file describes neither a machine nor tools in a known format",
        de: "die Datei beschreibt weder Maschine noch Werkzeuge in einem bekannten Format",
        help_en: "give a file in one of these formats: the answer of GRBL or grblHAL to $$, FluidNC's YAML, LinuxCNC's ini file or tool table, or tools of FreeCAD or Fusion 360 (.json, .tools)",
        help_de: "eine Datei in einem dieser Formate angeben: Antwort von GRBL oder grblHAL auf $$, YAML von FluidNC, ini-Datei oder Werkzeugtabelle von LinuxCNC, Werkzeuge von FreeCAD oder Fusion 360 (.json, .tools)",
    }
    /// A description that the system refuses to read.
    DESCRIPTION_UNREADABLE: UnreadableDescription {
        en: "cannot read the file: {reason}",
        de: "die Datei ist nicht lesbar: {reason}",
        help_en: "check the name and permissions of the file, or export the settings again, as text",
        help_de: "Namen und Rechte der Datei prüfen oder die Einstellungen noch einmal als Text exportieren",
    }
    /// A description with a syntax error.
    BROKEN_DESCRIPTION: UnreadableDescription {
        en: "the file is broken here: {reason}",
        de: "die Datei ist hier fehlerhaft: {reason}",
        help_en: "correct the line, or export the settings again",
        help_de: "die Zeile berichtigen oder die Einstellungen noch einmal exportieren",
    }
    /// A tool table of LinuxCNC without the unit of its lengths.
    TABLE_WITHOUT_UNIT: UnreadableDescription {
        en: "the unit of the lengths in this tool table is not known",
        de: "die Einheit der Längen in dieser Werkzeugtabelle ist unbekannt",
        help_en: "name the machine's ini file as well, or give --units mm or --units inch",
        help_de: "auch die ini-Datei der Maschine nennen, oder --units mm bzw. --units inch angeben",
    }
    /// Contradictory statements about the unit of lengths.
    UNITS_CONTRADICT: UnreadableDescription {
        en: "the unit of lengths in this ini file is not that of --units, or of another ini file",
        de: "die Einheit der Längen in dieser ini-Datei ist nicht die von --units oder einer anderen ini-Datei",
        help_en: "leave out --units, and name the ini file of only one machine: its tool tables have the unit of that file",
        help_de: "--units weglassen und die ini-Datei nur einer Maschine nennen: deren Werkzeugtabellen haben die Einheit dieser Datei",
    }
    /// A tool with a corner radius of more than half its diameter.
    CORNER_TOO_ROUND: UnreadableDescription {
        en: "the corner radius of tool {number} ({name}) is {radius} mm, which is more than half of its diameter, {diameter} mm",
        de: "der Eckenradius von Werkzeug {number} ({name}) ist {radius} mm, mehr als die Hälfte seines Durchmessers von {diameter} mm",
        help_en: "correct the tool in the library, and export the library again",
        help_de: "das Werkzeug in der Bibliothek berichtigen und die Bibliothek noch einmal exportieren",
    }
    /// A configuration into which values cannot be inserted automatically.
    NOT_EDITABLE: UnreadableDescription {
        en: "the values cannot be inserted: this file is not valid TOML, or `machine`, `tool` or a tool in it is not a table",
        de: "die Werte lassen sich nicht einsetzen: diese Datei ist kein gültiges TOML, oder `machine`, `tool` oder ein Werkzeug darin ist keine Tabelle",
        help_en: "write the values into the file by hand",
        help_de: "die Werte von Hand in die Datei schreiben",
    }
    /// A value in the description that the key of the configuration does not permit.
    VALUE_NOT_TAKEN: UnusableValue {
        en: "`{name}` is `{value}`, but {expected} is needed; the value is not imported",
        de: "`{name}` ist `{value}`, nötig ist aber {expected}; der Wert wird nicht übernommen",
        help_en: "set the key in pathbuild.toml by hand",
        help_de: "den Schlüssel in pathbuild.toml von Hand setzen",
    }
    /// A key that needs a value for each of three axes, not all of which are described.
    AXES_INCOMPLETE: UnusableValue {
        en: "`{key}` needs X, Y and Z, but there is only {given}",
        de: "`{key}` braucht X, Y und Z, vorhanden ist aber nur {given}",
        help_en: "set the key in pathbuild.toml by hand",
        help_de: "den Schlüssel in pathbuild.toml von Hand setzen",
    }
    /// An entry that occurs twice with different values.
    ENTRY_TWICE: UnusableValue {
        en: "`{name}` is `{value}` here, but the controller takes `{taken}` from line {line}; that value is imported",
        de: "`{name}` ist hier `{value}`, die Steuerung nimmt aber `{taken}` aus Zeile {line}; übernommen wird dieser Wert",
        help_en: "remove one of the two lines",
        help_de: "eine der beiden Zeilen entfernen",
    }
    /// An ini file that includes another one.
    NOT_INCLUDED: UnusableValue {
        en: "the values of the included file are not read: `{line}`",
        de: "die Werte der eingefügten Datei werden nicht gelesen: `{line}`",
        help_en: "in a copy of the file, replace this line by the contents of the included file, and import the copy",
        help_de: "in einer Kopie der Datei diese Zeile durch den Inhalt der eingefügten Datei ersetzen und die Kopie importieren",
    }
    /// Spindle speeds that form no range, because the lowest is not below the highest.
    EMPTY_SPEEDS: UnusableValue {
        en: "the spindle speeds from {from} to {to} are not a range; they are not imported",
        de: "die Drehzahlen von {from} bis {to} ergeben keinen Bereich; sie werden nicht übernommen",
        help_en: "set `spindle-speeds` in pathbuild.toml by hand",
        help_de: "`spindle-speeds` in pathbuild.toml von Hand setzen",
    }
    /// A controller in laser mode, which has no spindle speeds.
    LASER: UnusableValue {
        en: "the controller is in laser mode ($32), so $30 and $31 are not spindle speeds",
        de: "die Steuerung ist im Laserbetrieb ($32), daher sind $30 und $31 keine Drehzahlen",
        help_en: "if the machine has a spindle as well, set `spindle-speeds` by hand",
        help_de: "hat die Maschine auch eine Spindel, `spindle-speeds` von Hand setzen",
    }
    /// A machine with several spindles, so that the speeds are ambiguous.
    SEVERAL_SPINDLES: UnusableValue {
        en: "there are several spindles, so no spindle speeds are imported: {names}",
        de: "es gibt mehrere Spindeln, daher werden keine Drehzahlen übernommen: {names}",
        help_en: "set `spindle-speeds` by hand to the speeds of the milling spindle",
        help_de: "`spindle-speeds` von Hand auf die Drehzahlen der Frässpindel setzen",
    }
    /// An ini file that does not state the unit of its lengths.
    UNIT_MISSING: UnusableValue {
        en: "[TRAJ] has no LINEAR_UNITS, so the unit of the lengths is unknown; no length is imported",
        de: "in [TRAJ] fehlt LINEAR_UNITS, daher ist die Einheit der Längen unbekannt; es wird keine Länge übernommen",
        help_en: "add LINEAR_UNITS = mm or LINEAR_UNITS = inch",
        help_de: "LINEAR_UNITS = mm oder LINEAR_UNITS = inch ergänzen",
    }
    /// Limits of axes that give no valid travel.
    NO_TRAVEL: UnusableValue {
        en: "the limits of the axes give no valid travel; they are not imported",
        de: "die Grenzen der Achsen ergeben keinen gültigen Verfahrweg; sie werden nicht übernommen",
        help_en: "set `travel` in pathbuild.toml by hand",
        help_de: "`travel` in pathbuild.toml von Hand setzen",
    }
    /// A tool with a diameter that is unknown or lacks a unit.
    NO_DIAMETER: UnusableValue {
        en: "the diameter of tool {number} ({name}) or its unit is unknown; the tool is not imported",
        de: "der Durchmesser von Werkzeug {number} ({name}) oder seine Einheit ist unbekannt; das Werkzeug wird nicht übernommen",
        help_en: "set the diameter in the library, and export the library again",
        help_de: "den Durchmesser in der Bibliothek setzen und die Bibliothek noch einmal exportieren",
    }
    /// Two different tools with the same number.
    TOOL_TWICE_AT_LINE: UnusableValue {
        en: "tool {number} ({name}) is described differently in line {line} of {file} ({earlier}); neither is imported",
        de: "Werkzeug {number} ({name}) ist in Zeile {line} von {file} ({earlier}) anders beschrieben; keines von beiden wird übernommen",
        help_en: "give each tool a number of its own in the library, and export the library again",
        help_de: "jedem Werkzeug in der Bibliothek eine eigene Nummer geben und die Bibliothek noch einmal exportieren",
    }
    /// Two different tools with the same number, in a file without known line numbers.
    TOOL_TWICE: UnusableValue {
        en: "tool {number} ({name}) is described differently in {file} ({earlier}); neither is imported",
        de: "Werkzeug {number} ({name}) ist in {file} ({earlier}) anders beschrieben; keines von beiden wird übernommen",
        help_en: "give each tool a number of its own in the library, and export the library again",
        help_de: "jedem Werkzeug in der Bibliothek eine eigene Nummer geben und die Bibliothek noch einmal exportieren",
    }
    /// A tool with a number that the configuration gives to a tool with another name and diameter.
    TOOL_REPLACED: Disagreement {
        en: "T{number} of the machine is {name}, {new} mm in diameter, but [tool.{table}], {old} mm in diameter, has this number: the table's other keys, such as spindle and paths, remain those of the former tool",
        de: "T{number} der Maschine ist {name} mit {new} mm Durchmesser, diese Nummer hat aber [tool.{table}] mit {old} mm Durchmesser: die anderen Schlüssel der Tabelle, etwa spindle und paths, bleiben die des bisherigen Werkzeugs",
        help_en: "if this is another tool, give it a table of its own and change `number` in the old one",
        help_de: "ist es ein anderes Werkzeug, ihm eine eigene Tabelle geben und `number` in der alten ändern",
    }
    /// A tool bit that a library names but that cannot be read.
    BIT_UNREADABLE: UnusableValue {
        en: "the tool bit `{name}` cannot be read: {reason}",
        de: "die Werkzeugdatei `{name}` ist nicht lesbar: {reason}",
        help_en: "put a valid file beside the library, or into the directory Bit beside the library's directory",
        help_de: "eine gültige Datei neben die Bibliothek legen oder in das Verzeichnis Bit neben dem Verzeichnis der Bibliothek",
    }
}
