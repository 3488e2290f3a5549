//! Messages about post-processors: their definitions, and errors that occur when they write a program. (PB750 to PB769)

messages! {
    /// A definition that is not UTF-8.
    POST_NOT_UTF8: InvalidPost {
        en: "the definition is not UTF-8 text: this line has a character in another encoding, such as ANSI",
        de: "die Definition ist kein UTF-8-Text: diese Zeile hat ein Zeichen in einer anderen Kodierung, etwa ANSI",
        help_en: "open it in an editor and save it as UTF-8 (in Notepad: File, Save as, Encoding)",
        help_de: "sie in einem Editor öffnen und als UTF-8 speichern (im Windows-Editor: Datei, Speichern unter, Codierung)",
    }
    /// A definition with a byte order mark of UTF-16 that is not valid UTF-16.
    POST_NOT_UTF16: InvalidPost {
        en: "the definition begins like UTF-16 text, but is not valid UTF-16",
        de: "die Definition beginnt wie UTF-16-Text, ist aber kein gültiges UTF-16",
        help_en: "open it in an editor and save it as UTF-8 (in Notepad: File, Save as, Encoding)",
        help_de: "sie in einem Editor öffnen und als UTF-8 speichern (im Windows-Editor: Datei, Speichern unter, Codierung)",
    }
    /// A number format with so few decimals that it rounds coordinates noticeably.
    COARSE_NUMBERS: DoubtfulPost {
        en: "{option} is \"{value}\", which rounds coordinates by up to {error} mm",
        de: "{option} ist \"{value}\" und rundet Koordinaten um bis zu {error} mm",
        help_en: "write three decimals in mm or four in inches, such as NumberFormat 0.0## or decimals = 4",
        help_de: "drei Nachkommastellen in mm oder vier in Zoll schreiben, etwa NumberFormat 0.0## oder decimals = 4",
    }
    /// A number format with so few decimals that rounding would spoil parts.
    NUMBERS_TOO_COARSE: InvalidPost {
        en: "{option} is \"{value}\", which rounds coordinates by up to {error} mm; at most 0.05 mm is permitted",
        de: "{option} ist \"{value}\" und rundet Koordinaten um bis zu {error} mm; erlaubt sind höchstens 0,05 mm",
        help_en: "write three decimals in mm or four in inches, such as NumberFormat 0.0## or decimals = 4",
        help_de: "drei Nachkommastellen in mm oder vier in Zoll schreiben, etwa NumberFormat 0.0## oder decimals = 4",
    }
    /// A number format that writes whole numbers without a decimal point, for a target that may read them as thousandths.
    PATTERN_WITHOUT_POINT: InvalidPost {
        en: "{option} is \"{value}\", which writes whole numbers without a decimal point: some {dialect} controllers read them as thousandths",
        de: "{option} ist \"{value}\" und schreibt ganze Zahlen ohne Dezimalpunkt: manche Steuerungen mit {dialect} lesen sie als Tausendstel",
        help_en: "put a 0 after the point, such as 0.0##",
        help_de: "eine 0 hinter den Punkt setzen, etwa 0.0##",
    }
    /// A macro without `$`, such as `{units}`.
    MACRO_WITHOUT_SIGN: UnknownMacro {
        en: "{macro} in {section} would be written literally",
        de: "{macro} in {section} würde wörtlich geschrieben",
        help_en: "write {nearest}: macros begin with a dollar sign",
        help_de: "{nearest} schreiben: Makros beginnen mit einem Dollarzeichen",
    }
    /// A syntax error in XML or TOML.
    POST_SYNTAX: InvalidPost {
        en: "the definition cannot be read: {reason}",
        de: "die Definition ist nicht lesbar: {reason}",
    }
    /// A definition file that is larger than the limit.
    POST_TOO_LARGE: InvalidPost {
        en: "the definition has {size} bytes; the limit is {limit}",
        de: "die Definition hat {size} Bytes; die Grenze ist {limit}",
    }
    /// An XML file with a root element other than `PostProcessor`.
    POST_WRONG_ROOT: InvalidPost {
        en: "the file contains <{found}>, not <PostProcessor>",
        de: "die Datei enthält <{found}>, nicht <PostProcessor>",
        help_en: "name a CamBam definition, a file whose first element is <PostProcessor>",
        help_de: "die Datei einer CamBam-Definition angeben: sie beginnt mit <PostProcessor>",
    }
    /// An option of a definition with an invalid value.
    POST_OPTION: InvalidPost {
        en: "{option} is \"{value}\", but must be {expected}",
        de: "{option} ist \"{value}\", muss aber {expected} sein",
    }
    /// A macro without its closing brace.
    POST_UNCLOSED_MACRO: InvalidPost {
        en: "a macro in {section} is not closed",
        de: "ein Makro in {section} ist nicht geschlossen",
        help_en: "close it with \"}\"",
        help_de: "es mit \"}\" schließen",
    }
    /// Wrong arguments of a macro, as in `{$spindle(left)}`.
    POST_MACRO_ARGUMENTS: InvalidPost {
        en: "{macro} in {section} has the wrong arguments; it takes {expected}",
        de: "{macro} in {section} hat falsche Argumente; erlaubt: {expected}",
    }
    /// An unknown macro without a similar known one.
    UNKNOWN_MACRO: UnknownMacro {
        en: "unknown macro {macro} in {section}",
        de: "unbekanntes Makro {macro} in {section}",
        help_en: "define it as \"$name=value\" in PostProcessorMacros or in the configuration",
        help_de: "als \"$name=Wert\" in PostProcessorMacros oder in der Konfiguration definieren",
    }
    /// An unknown macro with a similar known one.
    UNKNOWN_MACRO_NEAREST: UnknownMacro {
        en: "unknown macro {macro} in {section}",
        de: "unbekanntes Makro {macro} in {section}",
        help_en: "did you mean {nearest}?",
        help_de: "ist {nearest} gemeint?",
    }
    /// An element that neither CamBam nor pathbuild knows.
    POST_UNKNOWN_ELEMENT: DoubtfulPost {
        en: "<{element}> is not an element of CamBam definitions and is ignored",
        de: "<{element}> ist kein Element von CamBam-Definitionen und wird übergangen",
        help_en: "correct its name, or remove it",
        help_de: "den Namen berichtigen oder es entfernen",
    }
    /// An element that occurs more than once.
    POST_REPEATED_ELEMENT: DoubtfulPost {
        en: "<{element}> occurs again; the last one applies",
        de: "<{element}> kommt noch einmal vor; das letzte gilt",
    }
    /// A malformed line of `PostProcessorMacros`.
    POST_MACRO_LINE: DoubtfulPost {
        en: "\"{text}\" defines no macro and is ignored",
        de: "\"{text}\" definiert kein Makro und wird übergangen",
        help_en: "define a macro as $name=value",
        help_de: "ein Makro als $name=Wert definieren",
    }
    /// A user macro with the name of a built-in one.
    POST_SHADOWED_MACRO: DoubtfulPost {
        en: "{macro} is built in; its definition is ignored",
        de: "{macro} ist eingebaut; die Definition wird übergangen",
        help_en: "give your macro another name",
        help_de: "dem eigenen Makro einen anderen Namen geben",
    }
    /// Macros that contain each other, or are nested more deeply than the limit.
    MACRO_DEPTH: EndlessMacro {
        en: "{section} contains itself, or macros are nested more than {limit} levels deep",
        de: "{section} enthält sich selbst, oder Makros sind mehr als {limit} Ebenen tief verschachtelt",
        help_en: "remove the macro that leads back to {section}, or nest macros less deeply",
        help_de: "das Makro entfernen, das zu {section} zurückführt, oder Makros weniger tief verschachteln",
    }
    /// A section that contains itself, such as `{$mops}` in MOP.
    BLOCK_WITHIN_ITSELF: EndlessMacro {
        en: "{macro} in {section}: this section is itself part of the text that {macro} inserts",
        de: "{macro} in {section}: dieser Abschnitt gehört selbst zu dem Text, den {macro} einsetzt",
        help_en: "use $mops once in PostFile, and $blocks once in MOP",
        help_de: "$mops einmal in PostFile verwenden und $blocks einmal in MOP",
    }
    /// Macros that write far too much text for the number of moves.
    MACRO_SIZE: EndlessMacro {
        en: "the post writes far too much text for the number of moves in the program",
        de: "der Postprozessor schreibt viel zu viel Text für die Zahl der Bewegungen im Programm",
        help_en: "look for macros that insert other macros several times: each level multiplies the text",
        help_de: "nach Makros suchen, die andere mehrmals einsetzen: jede Ebene vervielfacht den Text",
    }
    /// A hole with too many pecks.
    TOO_MANY_PECKS: EndlessMacro {
        en: "the hole at {place} requires more than {limit} pecks",
        de: "die Bohrung bei {place} braucht mehr als {limit} Stufen",
        help_en: "check C, the depth of a peck, at this hole",
        help_de: "C, die Tiefe einer Stufe, bei dieser Bohrung prüfen",
    }
    /// A tolerance for chords that is so small that an arc would become too many lines.
    TOO_MANY_CHORDS: EndlessMacro {
        en: "an arc of radius {radius} requires more than {limit} lines",
        de: "ein Bogen mit Radius {radius} braucht mehr als {limit} Strecken",
        help_en: "raise the post's tolerance for arcs",
        help_de: "die Toleranz für Bögen im Postprozessor erhöhen",
    }
    /// A macro for a value that the program does not have.
    VALUE_MISSING: MissingPostValue {
        en: "{macro} in {section} has no value in {operation}",
        de: "{macro} in {section} hat in {operation} keinen Wert",
    }
    /// A missing value that only the configuration or the definition can provide.
    VALUE_MISSING_OPEN: MissingPostValue {
        en: "{macro} in {section} has no value in {operation}",
        de: "{macro} in {section} hat in {operation} keinen Wert",
        help_en: "write \"{name}\" = \"...\" under [macros] of pathbuild.toml, or ${name}=... in PostProcessorMacros: drawings do not contain this value",
        help_de: "\"{name}\" = \"...\" unter [macros] in pathbuild.toml oder ${name}=... in PostProcessorMacros schreiben: Zeichnungen enthalten diesen Wert nicht",
    }
    /// A text for moves that moves nothing.
    MOTION_EMPTY: InvalidPost {
        en: "{section} writes no move: its text is empty, or only a comment",
        de: "{section} schreibt keine Bewegung: der Text ist leer oder nur ein Kommentar",
        help_en: "write the move, as in the default text, or remove the element so that the default text applies",
        help_de: "die Bewegung schreiben wie im vorgegebenen Text, oder das Element entfernen, dann gilt dieser",
    }
    /// A hole for which nothing is written.
    DRILLING_LOST: LostDrilling {
        en: "the post writes nothing that drills the hole at {place}: {section} is empty",
        de: "der Postprozessor schreibt nichts, was die Bohrung bei {place} ausführt: {section} ist leer",
        help_en: "write the hole as moves (cycles = false), or give the post a text for it",
        help_de: "die Bohrung als Bewegungen schreiben (cycles = false) oder dem Postprozessor einen Text dafür geben",
    }
    /// An arc with different radii at its ends after rounding.
    ARC_ROUNDED: RoundedArc {
        en: "in the output, the arc to {place} has the radius {start} at its start and {end} at its end",
        de: "in der Ausgabe hat der Bogen nach {place} am Anfang den Radius {start} und am Ende {end}",
        help_en: "give the post's number format more decimals",
        help_de: "dem Zahlenformat des Postprozessors mehr Nachkommastellen geben",
    }
    /// An arc that is written as a line, because its radius exceeds `MaximumArcRadius`.
    ARC_FLATTENED: FlattenedArc {
        en: "the arc to {place} has the radius {radius}; the post writes a line that deviates from it by up to {distance} mm",
        de: "der Bogen nach {place} hat den Radius {radius}; der Postprozessor schreibt eine Gerade, die bis zu {distance} mm davon abweicht",
        help_en: "raise MaximumArcRadius in the post",
        help_de: "MaximumArcRadius im Postprozessor erhöhen",
    }
    /// A line of output that is not G-code.
    LINE_UNREADABLE: UnreadableLine {
        en: "the post writes \"{line}\", which is not G-code; its effect on the machine is unknown",
        de: "der Postprozessor schreibt \"{line}\"; das ist kein G-Code, und die Wirkung an der Maschine ist unbekannt",
        help_en: "if that is intended, set SuppressParserErrors in the post",
        help_de: "wenn das so gewollt ist, SuppressParserErrors im Postprozessor setzen",
    }
    /// A cutter diameter that is missing from the tool table.
    TOOL_UNKNOWN: UnknownTool {
        en: "the tool table has no cutter with O = {diameter} for {path}; it is written as tool {index}",
        de: "die Werkzeugtabelle hat keinen Fräser mit O = {diameter} für {path}; er wird als Werkzeug {index} geschrieben",
        help_en: "add it as [tool.NAME] to pathbuild.toml",
        help_de: "als [tool.NAME] in pathbuild.toml aufnehmen",
    }
    /// A tool number that is missing from the tool table.
    TOOL_NUMBER_UNKNOWN: UnknownTool {
        en: "the tool table has no tool with the number {index}: the diameter of T{index} is unknown, and the post writes 0 for it",
        de: "die Werkzeugtabelle hat kein Werkzeug mit der Nummer {index}: der Durchmesser von T{index} ist unbekannt, und der Postprozessor schreibt dafür 0",
        help_en: "add it as [tool.NAME] with `number` to pathbuild.toml",
        help_de: "als [tool.NAME] mit `number` in pathbuild.toml aufnehmen",
    }
    /// A tool number that is missing from the tool table and not written.
    TOOL_NOT_IN_TABLE: UnknownTool {
        en: "T{index} is not in the tool table",
        de: "T{index} ist nicht in der Werkzeugtabelle",
        help_en: "add the tool to the machine's table, and to pathbuild.toml as [tool.NAME] with `number`; or correct T",
        help_de: "das Werkzeug in die Tabelle der Maschine und als [tool.NAME] mit `number` in pathbuild.toml aufnehmen, oder T berichtigen",
    }
    /// A program without operations.
    JOB_EMPTY: NothingToPost {
        en: "the program mills nothing: there is nothing to write",
        de: "das Programm fräst nichts: es gibt nichts zu schreiben",
    }
    /// A coordinate or feed that is NaN or infinite.
    JOB_NOT_FINITE: NothingToPost {
        en: "{operation} has a coordinate or feed that is not a number",
        de: "{operation} hat eine Koordinate oder einen Vorschub, der keine Zahl ist",
        help_en: "look for values in the program that are far too large, or divided by 0",
        help_de: "im Programm nach viel zu großen Werten oder nach Divisionen durch 0 suchen",
    }
    /// An unknown post-processor without a similar known one.
    POST_UNKNOWN: UnknownPost {
        en: "there is no post-processor {name}",
        de: "es gibt keinen Postprozessor {name}",
        help_en: "choose one from `pathbuild post list`, or name a definition file with its extension",
        help_de: "einen aus `pathbuild post list` wählen oder eine Definitionsdatei mit ihrer Endung nennen",
    }
    /// An unknown post-processor with a similar known one.
    POST_UNKNOWN_NEAREST: UnknownPost {
        en: "there is no post-processor {name}",
        de: "es gibt keinen Postprozessor {name}",
        help_en: "did you mean {nearest}?",
        help_de: "ist {nearest} gemeint?",
    }
    /// Note: the definition's command for the finished file was not run.
    POST_BUILD_SKIPPED: DoubtfulPost {
        en: "the post's command \"{command}\" was not run; --run-post-build runs it",
        de: "der Befehl \"{command}\" des Postprozessors wurde nicht ausgeführt; --run-post-build führt ihn aus",
    }
    /// Note: the output was not compared with the program.
    POST_UNCHECKED: DoubtfulPost {
        en: "the output was not compared with the program, because unchecked = true is set",
        de: "die Ausgabe wurde nicht mit dem Programm verglichen, weil unchecked = true gesetzt ist",
        help_en: "check the output on the control before milling, or remove `unchecked` under [post] in pathbuild.toml",
        help_de: "die Ausgabe vor dem Fräsen an der Steuerung prüfen oder `unchecked` unter [post] in pathbuild.toml entfernen",
    }
    /// A text that is written outside of a comment, where the control would execute it.
    TEXT_AMONG_WORDS: RejectedWord {
        en: "{macro} in {section} puts \"{text}\" outside a comment, where the machine would execute it",
        de: "{macro} in {section} setzt \"{text}\" außerhalb eines Kommentars, wo die Maschine es ausführen würde",
        help_en: "write it in a comment in the post, or give the drawing another name",
        help_de: "den Text im Postprozessor in einen Kommentar setzen oder die Zeichnung anders nennen",
    }
    /// A program to be wrapped around a cylinder with a radius of 0 or less.
    NO_RADIUS: NothingToPost {
        en: "{operation} cannot be wrapped round a cylinder: its surface T, which is the radius, is not above 0",
        de: "{operation} lässt sich nicht um einen Zylinder legen: die Oberfläche T, das ist der Radius, liegt nicht über 0",
        help_en: "give the radius with --surface, or write the program from the drawing with emit, which knows T",
        help_de: "den Radius mit --surface angeben oder das Programm mit emit aus der Zeichnung schreiben, die T enthält",
    }
    /// A program wrapped around a cylinder more than once.
    WRAPPED_TWICE: DoubtfulPost {
        en: "wrapped round the cylinder, the program covers {degrees} degrees: it mills some places twice",
        de: "um den Zylinder gelegt, reicht das Programm über {degrees} Grad: es fräst manche Stellen zweimal",
        help_en: "keep the width of the drawing within the circumference, 2 x pi x T",
        help_de: "die Breite der Zeichnung innerhalb des Umfangs halten, 2 x Pi x T",
    }
    /// A word for an axis that is replaced by an angle.
    REPLACED_AXIS_WRITTEN: PostDiffers {
        en: "the post writes \"{line}\" although {angle} replaces {axis}: the machine would move both axes",
        de: "der Postprozessor schreibt \"{line}\", obwohl {angle} an die Stelle von {axis} tritt: die Maschine würde beide Achsen bewegen",
        help_en: "remove {axis} from the post's texts",
        help_de: "{axis} aus den Texten des Postprozessors nehmen",
    }
    /// A cutter without a known spindle speed.
    SPINDLE_UNKNOWN: MissingPostValue {
        en: "no spindle speed is known for {operation} (cutter O = {diameter}): the spindle would not turn",
        de: "für {operation} (Fräser O = {diameter}) ist keine Spindeldrehzahl bekannt: die Spindel stünde still",
        help_en: "add spindle = 12000 to [tool.NAME] with diameter = {diameter} in pathbuild.toml; if the spindle is switched by hand, write spindle = \"manual\" outside all tables",
        help_de: "spindle = 12000 in pathbuild.toml unter [tool.NAME] mit diameter = {diameter} eintragen; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen schreiben",
    }
    /// A tool without a known spindle speed, in a program that states only the number of the tool.
    SPINDLE_UNKNOWN_OF_NUMBER: MissingPostValue {
        en: "no spindle speed is known for {operation} (T{index}): the spindle would not turn",
        de: "für {operation} (T{index}) ist keine Spindeldrehzahl bekannt: die Spindel stünde still",
        help_en: "put S and M3 into the program, or add [tool.NAME] with number = {index}, diameter and spindle to pathbuild.toml; if the spindle is switched by hand, write spindle = \"manual\" outside all tables",
        help_de: "S und M3 in das Programm aufnehmen oder [tool.NAME] mit number = {index}, diameter und spindle in pathbuild.toml eintragen; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen schreiben",
    }
    /// A program without a known spindle speed and without a tool.
    SPINDLE_UNSTATED: MissingPostValue {
        en: "no spindle speed is known for {operation}: the program has no S with M3 or M4, and names no tool",
        de: "für {operation} ist keine Spindeldrehzahl bekannt: das Programm hat kein S mit M3 oder M4 und nennt kein Werkzeug",
        help_en: "put S and M3, or the tool (T1 M6), into the program; if the spindle is switched by hand, write spindle = \"manual\" outside all tables of pathbuild.toml",
        help_de: "S und M3 oder das Werkzeug (T1 M6) in das Programm aufnehmen; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen von pathbuild.toml schreiben",
    }
    /// Different spindle speeds for one tool, with a definition that writes the speed only at tool changes.
    ONE_SPEED_A_TOOL: NothingToPost {
        en: "T{index} runs at {speed} and, in {operation}, at {other} 1/min, but this post writes one speed for each tool",
        de: "T{index} läuft mit {speed} und in {operation} mit {other} 1/min, dieser Postprozessor schreibt aber eine Drehzahl je Werkzeug",
        help_en: "give the second speed a tool number of its own in pathbuild.toml, or write a program for each path",
        help_de: "der zweiten Drehzahl in pathbuild.toml eine eigene Werkzeugnummer geben oder je Pfad ein Programm schreiben",
    }
    /// Missing hexadecimal digits of a byte in a control text.
    BYTE_EXPECTED: InvalidControlText {
        en: "{text}, line {line}, column {column}: two hexadecimal digits are missing here",
        de: "{text}, Zeile {line}, Spalte {column}: hier fehlen zwei hexadezimale Ziffern",
    }
    /// A variable used in the text that assigns it. Variables are replaced before statements run, so the text cannot see the value.
    VARIABLE_UNDEFINED_YET: UnknownMacro {
        en: "{text}, line {line}, column {column}: {name} is assigned in this text, but only later texts see the value",
        de: "{text}, Zeile {line}, Spalte {column}: {name} wird in diesem Text zugewiesen, den Wert sehen aber erst spätere Texte",
        help_en: "assign it in a text that is called earlier, such as program-start",
        help_de: "in einem Text zuweisen, der vorher aufgerufen wird, etwa program-start",
    }
    /// Note: the output does not switch the coolant.
    COOLANT_NOT_WRITTEN: DoubtfulPost {
        en: "the post has no {macro}: the output does not follow the coolant that the program or the tool table sets",
        de: "der Postprozessor hat kein {macro}: die Ausgabe richtet sich nicht nach der Kühlung, die das Programm oder die Werkzeugtabelle bestimmt",
        help_en: "add {macro} to the post, or check how its texts switch the coolant",
        help_de: "{macro} in den Postprozessor aufnehmen oder prüfen, wie seine Texte die Kühlung schalten",
    }
    /// Note: the output does not switch the spindle.
    SPINDLE_NOT_WRITTEN: DoubtfulPost {
        en: "the post has no {macro}: the output does not follow the direction of the spindle that the program or the tool table sets",
        de: "der Postprozessor hat kein {macro}: die Ausgabe richtet sich nicht nach der Drehrichtung, die das Programm oder die Werkzeugtabelle bestimmt",
        help_en: "add {macro} to the post, or check how its texts start the spindle",
        help_de: "{macro} in den Postprozessor aufnehmen oder prüfen, wie seine Texte die Spindel einschalten",
    }
    /// Note: the output does not wait until the spindle is up to speed.
    SPIN_UP_NOT_WRITTEN: DoubtfulPost {
        en: "the post has no {macro}: the output does not wait for the time that `spin-up` under [machine] gives the spindle",
        de: "der Postprozessor hat kein {macro}: die Ausgabe wartet nicht so lange auf die Spindel, wie [machine] spin-up angibt",
        help_en: "add {macro} to the post, after the words that start the spindle",
        help_de: "{macro} in den Postprozessor aufnehmen, hinter den Wörtern, die die Spindel einschalten",
    }
    /// An unknown key in a TOML definition without a similar known one.
    POST_UNKNOWN_KEY: InvalidPost {
        en: "the key {key} is unknown",
        de: "der Schlüssel {key} ist unbekannt",
    }
    /// An unknown key in a TOML definition with a similar known one.
    POST_UNKNOWN_KEY_NEAREST: InvalidPost {
        en: "the key {key} is unknown",
        de: "der Schlüssel {key} ist unbekannt",
        help_en: "did you mean {nearest}?",
        help_de: "ist {nearest} gemeint?",
    }
    /// An `[alias]` for an unknown variable.
    ALIAS_UNKNOWN: DoubtfulControlText {
        en: "pathbuild has no variable {name}, so [alias] cannot give it another name",
        de: "pathbuild hat keine Variable {name}; [alias] kann ihr daher keinen anderen Namen geben",
        help_en: "in [alias], write pathbuild's name on the left and the control texts' name on the right",
        help_de: "in [alias] links den Namen von pathbuild schreiben, rechts den der Steuertexte",
    }
    /// An unknown variable without a similar known one.
    VARIABLE_UNDEFINED: UnknownMacro {
        en: "{text}, line {line}, column {column}: there is no variable {name} here",
        de: "{text}, Zeile {line}, Spalte {column}: die Variable {name} gibt es hier nicht",
    }
    /// A variable that has no value in the text that uses it.
    VARIABLE_WITHOUT_VALUE: UnknownMacro {
        en: "{text}, line {line}, column {column}: {name} has no value here: {reason}",
        de: "{text}, Zeile {line}, Spalte {column}: {name} hat hier keinen Wert: {reason}",
        help_en: "give it a value, or first test whether it exists, with a \"!\" statement",
        help_de: "ihr einen Wert geben oder vorher mit einer Anweisung mit \"!\" prüfen, ob es sie gibt",
    }
    /// An unknown variable with a similar known one.
    VARIABLE_UNDEFINED_NEAREST: UnknownMacro {
        en: "{text}, line {line}, column {column}: there is no variable {name} here",
        de: "{text}, Zeile {line}, Spalte {column}: die Variable {name} gibt es hier nicht",
        help_en: "did you mean {nearest}? Translate names of another program in [alias]",
        help_de: "ist {nearest} gemeint? Namen eines anderen Programms in [alias] übersetzen",
    }
    /// Variables with texts that refer to each other, nested more deeply than the limit.
    VARIABLE_DEPTH: EndlessMacro {
        en: "{text}, line {line}, column {column}: variables in the text of {name} are nested more than {limit} levels deep",
        de: "{text}, Zeile {line}, Spalte {column}: im Text von {name} sind Variablen mehr als {limit} Ebenen tief verschachtelt",
    }
    /// A text that exceeds the limit of its length when variables are replaced.
    TEXT_LENGTH: EndlessMacro {
        en: "{text}, line {line}, column {column}: the text becomes longer than {limit} bytes",
        de: "{text}, Zeile {line}, Spalte {column}: der Text wird länger als {limit} Bytes",
    }
    /// Statements or terms that are nested too deeply.
    TEXT_DEPTH: EndlessMacro {
        en: "{text}, line {line}, column {column}: statements or terms are nested more than {limit} levels deep",
        de: "{text}, Zeile {line}, Spalte {column}: Anweisungen oder Ausdrücke sind mehr als {limit} Ebenen tief verschachtelt",
    }
    /// A `~` that does not begin the name of a variable.
    LONE_TILDE: InvalidControlText {
        en: "{text}, line {line}, column {column}: \"~\" begins no variable",
        de: "{text}, Zeile {line}, Spalte {column}: mit \"~\" beginnt keine Variable",
        help_en: "write a variable as ~Name~, a tilde as \\~",
        help_de: "eine Variable als ~Name~ schreiben, eine Tilde als \\~",
    }
    /// A `}` that closes nothing.
    LONE_BRACE: InvalidControlText {
        en: "{text}, line {line}, column {column}: this brace closes nothing",
        de: "{text}, Zeile {line}, Spalte {column}: diese Klammer schließt nichts",
        help_en: "to write a brace, put a backslash before it",
        help_de: "soll eine Klammer ausgegeben werden, einen Backslash davorsetzen",
    }
    /// A statement without its closing `}`.
    OPEN_BRACE: InvalidControlText {
        en: "{text}, line {line}, column {column}: a statement is not closed",
        de: "{text}, Zeile {line}, Spalte {column}: eine Anweisung ist nicht geschlossen",
    }
    /// Further content in a statement that is already complete.
    STATEMENT_GOES_ON: InvalidControlText {
        en: "{text}, line {line}, column {column}: the statement must end here",
        de: "{text}, Zeile {line}, Spalte {column}: hier muss die Anweisung enden",
    }
    /// A statement with the sign `§`, which is not supported.
    STATEMENT_UNKNOWN: InvalidControlText {
        en: "{text}, line {line}, column {column}: statements with \"§\" are not supported",
        de: "{text}, Zeile {line}, Spalte {column}: Anweisungen mit \"§\" werden nicht unterstützt",
        help_en: "write the text without them; no known manual describes such statements",
        help_de: "den Text ohne sie schreiben; kein bekanntes Handbuch beschreibt solche Anweisungen",
    }
    /// A missing name of a variable after `=` or `!`.
    NAME_EXPECTED: InvalidControlText {
        en: "{text}, line {line}, column {column}: the name of a variable is expected here",
        de: "{text}, Zeile {line}, Spalte {column}: hier wird der Name einer Variablen erwartet",
        help_en: "write the name without tildes",
        help_de: "den Namen ohne Tilden schreiben",
    }
    /// A condition that lacks the statement of a branch.
    BRANCH_EXPECTED: InvalidControlText {
        en: "{text}, line {line}, column {column}: a statement in braces is expected here",
        de: "{text}, Zeile {line}, Spalte {column}: hier wird eine Anweisung in geschweiften Klammern erwartet",
    }
    /// The name of an inserted file that does not end with `*`.
    INSERTION_OPEN: InvalidControlText {
        en: "{text}, line {line}, column {column}: the name of the file to insert does not end with \"*\"",
        de: "{text}, Zeile {line}, Spalte {column}: der Name der einzufügenden Datei endet nicht mit \"*\"",
    }
    /// A term that ends where a value or `)` is expected.
    TERM_ENDS: InvalidControlText {
        en: "{text}, line {line}, column {column}: the term ends where a value or \")\" is expected",
        de: "{text}, Zeile {line}, Spalte {column}: der Ausdruck endet, wo ein Wert oder \")\" erwartet wird",
    }
    /// An unexpected character in a term.
    TERM_UNEXPECTED: InvalidControlText {
        en: "{text}, line {line}, column {column}: \"{found}\" is not expected here",
        de: "{text}, Zeile {line}, Spalte {column}: \"{found}\" wird hier nicht erwartet",
    }
    /// A malformed number in a term.
    TERM_NUMBER: InvalidControlText {
        en: "{text}, line {line}, column {column}: \"{found}\" is not a number",
        de: "{text}, Zeile {line}, Spalte {column}: \"{found}\" ist keine Zahl",
    }
    /// A text in a term, where only numbers are permitted.
    TERM_IS_TEXT: InvalidControlText {
        en: "{text}, line {line}, column {column}: \"{found}\" is a text, not a number",
        de: "{text}, Zeile {line}, Spalte {column}: \"{found}\" ist ein Text, keine Zahl",
        help_en: "write the variable outside of a statement, or in a statement with s",
        help_de: "die Variable außerhalb einer Anweisung schreiben oder in einer Anweisung mit s",
    }
    /// A term without a finite value, for example because of a division by zero.
    TERM_NOT_FINITE: InvalidControlText {
        en: "{text}, line {line}, column {column}: the term has no value, for example because it divides by zero",
        de: "{text}, Zeile {line}, Spalte {column}: der Ausdruck hat keinen Wert, etwa weil er durch null teilt",
    }
    /// A bitwise operator or a binary format for a number that is not an integer.
    TERM_NOT_WHOLE: InvalidControlText {
        en: "{text}, line {line}, column {column}: bitwise operators and binary formats need a whole number",
        de: "{text}, Zeile {line}, Spalte {column}: Bitoperatoren und Binärformate brauchen eine ganze Zahl",
    }
    /// A term with an unknown function.
    TERM_FUNCTION: InvalidControlText {
        en: "{text}, line {line}, column {column}: there is no function {name}",
        de: "{text}, Zeile {line}, Spalte {column}: es gibt keine Funktion {name}",
        help_en: "use one of these: abs sqrt sin cos tan asin acos atan atan2 int round floor ceil min max mod, or pi",
        help_de: "eine von diesen verwenden: abs sqrt sin cos tan asin acos atan atan2 int round floor ceil min max mod, oder pi",
    }
    /// A function of a term with a wrong number of arguments.
    TERM_ARGUMENTS: InvalidControlText {
        en: "{text}, line {line}, column {column}: {name} has the wrong number of arguments",
        de: "{text}, Zeile {line}, Spalte {column}: {name} hat die falsche Zahl von Argumenten",
    }
    /// Two signs before a term, as in `--5`.
    TERM_TWO_SIGNS: DoubtfulControlText {
        en: "{text}, line {line}, column {column}: CAD6 accepts only one sign in front of a term",
        de: "{text}, Zeile {line}, Spalte {column}: CAD6 erlaubt nur ein Vorzeichen vor einem Ausdruck",
    }
    /// A bitwise operator beside a comparison, as in `1 & 2 == 2`: it is not documented which is evaluated first.
    TERM_MIXED_BITS: DoubtfulControlText {
        en: "{text}, line {line}, column {column}: it is not documented whether & | ^ or the comparison is evaluated first",
        de: "{text}, Zeile {line}, Spalte {column}: ob zuerst & | ^ oder der Vergleich berechnet wird, ist nicht dokumentiert",
        help_en: "use parentheses",
        help_de: "Klammern setzen",
    }
    /// A function in a term, which CAD6 may not support.
    TERM_EXTENSION: DoubtfulControlText {
        en: "{text}, line {line}, column {column}: functions are an extension of pathbuild; CAD6 may not know them",
        de: "{text}, Zeile {line}, Spalte {column}: Funktionen sind ein Zusatz von pathbuild; CAD6 kennt sie vielleicht nicht",
    }
    /// A variable that is read after an assignment in the same text.
    READ_AFTER_ASSIGNMENT: DoubtfulControlText {
        en: "{text}, line {line}, column {column}: {name} is assigned before this, but here it still has its old value",
        de: "{text}, Zeile {line}, Spalte {column}: {name} wird davor zugewiesen, hat hier aber noch den alten Wert",
        help_en: "read the new value in a later text: variables are substituted before statements run",
        help_de: "den neuen Wert erst in einem späteren Text lesen: Variablen werden eingesetzt, bevor Anweisungen laufen",
    }
    /// A number without a format, as in `X~X1~`.
    NUMBER_UNFORMATTED: DoubtfulControlText {
        en: "{text}, line {line}, column {column}: {name} is written with all its decimals",
        de: "{text}, Zeile {line}, Spalte {column}: {name} wird mit allen Nachkommastellen geschrieben",
        help_en: "put it into a statement that rounds, such as one with \".\" or \"#\"",
        help_de: "die Variable in eine Anweisung setzen, die rundet, etwa mit \".\" oder \"#\"",
    }
    /// A file to insert that is missing, or not below the directory of the post.
    INSERTION_REFUSED: InjectedFile {
        en: "{text}, line {line}, column {column}: {name} cannot be inserted: {reason}",
        de: "{text}, Zeile {line}, Spalte {column}: {name} kann nicht eingefügt werden: {reason}",
        help_en: "put files to insert into the post's directory or below it",
        help_de: "einzufügende Dateien im Verzeichnis des Postprozessors oder darunter ablegen",
    }
    /// A text without Z for a move that changes Z.
    NO_Z_IN_TEXT: InvalidControlText {
        en: "{operation} goes from Z {from} to Z {to} while it mills, but the text {text} has no ~Z1~",
        de: "{operation} geht beim Fräsen von Z {from} nach Z {to}, aber der Text {text} hat kein ~Z1~",
        help_en: "add ~Z1~ to the text; for a straight plunge between passes, lift-between-passes = true is enough (never with T-slot cutters)",
        help_de: "~Z1~ in den Text aufnehmen; für das senkrechte Eintauchen zwischen zwei Durchgängen genügt lift-between-passes = true (nie bei T-Nutenfräsern)",
    }
    /// A text without Z for a helix.
    NO_Z_IN_ARC: InvalidControlText {
        en: "{operation} has a helix from Z {from} to Z {to}, but the text arc has no ~Z1~",
        de: "{operation} hat eine Helix von Z {from} nach Z {to}, aber der Text arc hat kein ~Z1~",
        help_en: "add Z with ~Z1~ to the text arc; if the control does not support helices, add it to the text line: the helix is then written as lines",
        help_de: "Z mit ~Z1~ in den Text arc aufnehmen; kennt die Steuerung keine Helix, in den Text line: die Helix wird dann in Strecken geschrieben",
    }
    /// A control text that no program needs.
    TEXT_NEVER_CALLED: InvalidControlText {
        en: "{text} is never called: programs contain nothing that needs it",
        de: "{text} wird nie aufgerufen: Programme enthalten nichts, wofür er da ist",
        help_en: "delete it: nothing that it writes gets into a program",
        help_de: "ihn löschen: was er schreibt, kommt in kein Programm",
    }
    /// A control text that is never called, because another one is called in its place.
    TEXT_NOT_CALLED: InvalidControlText {
        en: "{text} is never called, because the definition has {other}",
        de: "{text} wird nie aufgerufen, weil die Definition {other} hat",
        help_en: "delete one of the two; move words that switch spindle or coolant into texts that are called, such as tool-change and program-end",
        help_de: "einen der beiden löschen; Wörter, die Spindel oder Kühlung schalten, in Texte verschieben, die aufgerufen werden, etwa tool-change und program-end",
    }
    /// A control text that the program needs but the definition lacks.
    NO_TEXT_FOR: InvalidControlText {
        en: "{operation} needs the text {text}, which the post does not have",
        de: "{operation} braucht den Text {text}, den der Postprozessor nicht hat",
        help_en: "add this text to the definition",
        help_de: "diesen Text in die Definition aufnehmen",
    }
    /// An unknown dialect without a similar known one.
    DIALECT_UNKNOWN: InvalidPost {
        en: "there is no dialect {name}",
        de: "es gibt keinen Dialekt {name}",
        help_en: "use one of {known}",
        help_de: "einen von {known} verwenden",
    }
    /// An unknown dialect with a similar known one.
    DIALECT_UNKNOWN_NEAREST: InvalidPost {
        en: "there is no dialect {name}; valid ones are {known}",
        de: "es gibt keinen Dialekt {name}; gültig sind {known}",
        help_en: "did you mean {nearest}?",
        help_de: "ist {nearest} gemeint?",
    }
    /// A word or character that the controller does not accept.
    WORD_REJECTED: RejectedWord {
        en: "line {line} of the output: {dialect} does not accept \"{word}\"",
        de: "Zeile {line} der Ausgabe: {dialect} nimmt \"{word}\" nicht an",
        help_en: "change the post's text, or name the dialect that the control really has",
        help_de: "den Text im Postprozessor ändern oder den Dialekt nennen, den die Steuerung wirklich hat",
    }
    /// Two words of a group in one line, such as G0 and G1, in the output of a definition without a dialect.
    WORDS_EXCLUDE: RejectedWord {
        en: "{first} and {second} must not be on the same line: controls refuse the line, or obey only one of the two",
        de: "{first} und {second} dürfen nicht in derselben Zeile stehen: Steuerungen lehnen sie ab oder befolgen nur eines von beiden",
        help_en: "write them on separate lines, or remove one of them",
        help_de: "in getrennte Zeilen schreiben oder eines entfernen",
    }
    /// A repeated letter in the output of a definition without a dialect.
    LETTER_REPEATED: RejectedWord {
        en: "{letter} occurs twice on one line: controls refuse the line, or obey only one of the two",
        de: "{letter} kommt in einer Zeile zweimal vor: Steuerungen lehnen sie ab oder befolgen nur eines von beiden",
        help_en: "remove one, or write it on a line of its own",
        help_de: "eines entfernen oder in eine eigene Zeile schreiben",
    }
    /// P beside G54 to G59 in the output of a definition without a dialect.
    SYSTEM_WITH_P: RejectedWord {
        en: "{word} with P is another coordinate system on some controls, and an error on others",
        de: "{word} mit P ist bei manchen Steuerungen ein anderes Koordinatensystem, bei anderen ein Fehler",
        help_en: "remove P, or name the control in the definition with <Dialect> or dialect = (see program/posts in the book)",
        help_de: "P entfernen oder die Steuerung in der Definition mit <Dialect> oder dialect = nennen (siehe program/posts im Buch)",
    }
    /// A `/` before a line that must not be skipped.
    LINE_SKIPPABLE: RejectedWord {
        en: "`/` begins a line that moves, sets the tool or its length, or switches the spindle: a switch at the machine (block delete) can skip it",
        de: "`/` beginnt eine Zeile, die fährt, das Werkzeug oder dessen Länge setzt oder die Spindel schaltet: ein Schalter an der Maschine (Sätze ausblenden) kann sie überspringen",
        help_en: "remove `/` from the text of the definition",
        help_de: "`/` aus dem Text der Definition entfernen",
    }
    /// A line of output that is longer than the dialect accepts.
    LINE_TOO_LONG: LineTooLong {
        en: "line {line} of the output has {length} characters; {dialect} accepts at most {longest}",
        de: "Zeile {line} der Ausgabe hat {length} Zeichen; {dialect} nimmt höchstens {longest} an",
        help_en: "give the post's number format fewer decimals, or split its texts into several lines",
        help_de: "dem Zahlenformat des Postprozessors weniger Nachkommastellen geben oder seine Texte auf mehrere Zeilen verteilen",
    }
    /// Output that differs from the program when read back.
    POST_DIFFERS: PostDiffers {
        en: "line {line} of the output differs from the program",
        de: "Zeile {line} der Ausgabe weicht vom Programm ab",
        help_en: "check the post's text for this line; if you take responsibility for the output, set unchecked = true in [post] of pathbuild.toml",
        help_de: "den Text im Postprozessor für diese Zeile prüfen; wer selbst für die Ausgabe einsteht, setzt unchecked = true in [post] von pathbuild.toml",
    }
    /// Output that ends before all moves of the program are made.
    MOVES_LOST: PostDiffers {
        en: "the output ends before all moves of the program are complete",
        de: "die Ausgabe endet, bevor alle Bewegungen des Programms ausgeführt sind",
        help_en: "check the post's texts for moves; if you take responsibility for the output, set unchecked = true in [post] of pathbuild.toml",
        help_de: "die Texte für Bewegungen im Postprozessor prüfen; wer selbst für die Ausgabe einsteht, setzt unchecked = true in [post] von pathbuild.toml",
    }
    /// A cut at an unknown position, which cannot be compared.
    CUT_AT_UNKNOWN_PLACE: PostDiffers {
        en: "step {step} of the program cuts from or to an unknown position",
        de: "Schritt {step} des Programms fräst von oder zu einer unbekannten Position",
        help_en: "begin the program with absolute moves in Z, X and Y",
        help_de: "das Programm mit absoluten Bewegungen in Z, X und Y beginnen",
    }
    /// Note: a dwell of another length than in the program.
    DWELL_DIFFERS: PostDiffers {
        en: "the program dwells for {seconds} s, but the output for {found} s",
        de: "das Programm wartet {seconds} s, die Ausgabe aber {found} s",
    }
    /// Note: a dwell of the program that the output lacks.
    DWELL_LOST: PostDiffers {
        en: "the program dwells for {seconds} s here, but the rest of the output has no such dwell",
        de: "das Programm wartet hier {seconds} s, diese Wartezeit fehlt aber im Rest der Ausgabe",
    }
    /// Note: the spindle is not started before the first cut.
    SPINDLE_NOT_STARTED: PostDiffers {
        en: "the tool cuts here, but the output has not switched the spindle on, although the tool has a `spindle` speed; if the spindle is switched by hand, write spindle = \"manual\" outside all tables of pathbuild.toml",
        de: "hier wird gefräst, aber die Ausgabe hat die Spindel nicht eingeschaltet, obwohl `spindle` beim Werkzeug eine Drehzahl angibt; wird die Spindel von Hand geschaltet, spindle = \"manual\" außerhalb aller Tabellen von pathbuild.toml schreiben",
    }
    /// Note: the spindle turns in the wrong direction.
    SPINDLE_OTHER_WAY: PostDiffers {
        en: "here the spindle turns in the direction opposite to the tool's `direction`",
        de: "hier dreht sich die Spindel entgegen der `direction` des Werkzeugs",
    }
    /// Note: the spindle turns at a stop for the operator at which it stands still in the program.
    SPINDLE_TURNS_AT_STOP: PostDiffers {
        en: "the spindle turns at this stop, but in the program it stands still there",
        de: "bei diesem Halt dreht sich die Spindel, im Programm steht sie dort",
    }
    /// Note: the spindle turns at another speed.
    SPINDLE_OTHER_SPEED: PostDiffers {
        en: "the spindle speed is {found} here, but {expected} in the program",
        de: "die Drehzahl ist hier {found}, im Programm aber {expected}",
    }
    /// Note: a cut with another tool than in the program.
    TOOL_OTHER: PostDiffers {
        en: "the output makes this cut with T{found}, but the program uses T{expected}",
        de: "die Ausgabe führt diesen Schnitt mit T{found} aus, das Programm aber mit T{expected}",
    }
    /// Note: a cut before T selects a tool or, if the post writes M6, before M6 inserts the tool.
    TOOL_NOT_SELECTED: PostDiffers {
        en: "the output has not changed to T{expected}, with which the program makes this cut",
        de: "die Ausgabe hat nicht auf T{expected} gewechselt, mit dem das Programm diesen Schnitt macht",
    }
    /// Note: a cut after T alone, on a control that changes tools only by M6 or by hand.
    TOOL_NOT_CHANGED: PostDiffers {
        en: "T alone does not change the tool on this control, and the output does not stop (M0) for T{expected}",
        de: "T allein wechselt auf dieser Steuerung kein Werkzeug, und die Ausgabe hält für T{expected} nicht an (M0)",
    }
    /// Note: a cut with the length of another tool, or with none.
    LENGTH_OTHER: PostDiffers {
        en: "the tool length in effect here is not that of T{expected}",
        de: "hier gilt nicht die Werkzeuglänge von T{expected}",
    }
    /// Note: the beam may be on during a rapid move.
    BEAM_ON: PostDiffers {
        en: "the beam is still on during this rapid move, and the post writes no Z that would raise it",
        de: "der Strahl ist während dieses Eilgangs noch an, und der Postprozessor hebt ihn nicht ab: er schreibt kein Z",
    }
    /// Note: a move to another point than in the program.
    GOES_ELSEWHERE: PostDiffers {
        en: "the tool goes to {found} here, but to {expected} in the program",
        de: "hier fährt das Werkzeug nach {found}, im Programm nach {expected}",
    }
    /// Note: a move to the right point along another curve than in the program.
    GOES_ANOTHER_WAY: PostDiffers {
        en: "the tool goes to {place} as in the program, but by a different route",
        de: "das Werkzeug fährt wie im Programm nach {place}, aber auf anderem Weg",
    }
    /// Note: a rapid move instead of a cut, or the reverse.
    GOES_AT_ANOTHER_PACE: PostDiffers {
        en: "this move is {found}, but in the program it is {expected}",
        de: "diese Bewegung ist {found}, im Programm aber {expected}",
    }
    /// Note: a move with another feed than in the program.
    GOES_WITH_ANOTHER_FEED: PostDiffers {
        en: "the feed is {found} here and {expected} in the program",
        de: "der Vorschub ist hier {found}, im Programm {expected}",
    }
    /// Note: a move after the last cut.
    GOES_TOO_FAR: PostDiffers {
        en: "this is {found} to {place} after the program's last cut",
        de: "nach dem letzten Schnitt des Programms folgt hier noch {found} nach {place}",
    }
    /// Note: a move between two cuts that the program does not contain and that may hit material.
    WAY_NOT_FREE: PostDiffers {
        en: "this is {found} from {from} to {to}; between these two cuts the program makes no such move, or only a higher one",
        de: "das ist {found} von {from} nach {to}; zwischen diesen beiden Schnitten macht das Programm keine solche Bewegung oder nur eine weiter oben",
    }
    /// An M word or an axis with an unknown meaning, because no dialect is named.
    WORD_NOT_FOLLOWED: DoubtfulPost {
        en: "the output contains {word}, whose effect is unknown without a dialect",
        de: "die Ausgabe enthält {word}, dessen Wirkung ohne Dialekt unbekannt ist",
        help_en: "name the dialect of the control in the definition, or with --dialect",
        help_de: "den Dialekt der Steuerung in der Definition oder mit --dialect nennen",
    }
    /// A G or M code that controls interpret differently, with no dialect named.
    DIALECTS_DISAGREE: DoubtfulPost {
        en: "controls disagree on what {words} does, and no dialect is named",
        de: "was {words} bewirkt, ist von Steuerung zu Steuerung verschieden, und kein Dialekt ist genannt",
        help_en: "name the dialect of the control in the definition, or with --dialect",
        help_de: "den Dialekt der Steuerung in der Definition oder mit --dialect nennen",
    }
    /// A work offset in the output, such as G55.
    OFFSET_CHOSEN: DoubtfulPost {
        en: "the output selects a work offset of the machine ({word}), which determines the position of the drawing's zero",
        de: "die Ausgabe wählt eine Nullpunktverschiebung der Maschine ({word}), die die Lage des Zeichnungsnullpunkts bestimmt",
    }
    /// Note: the line of the output that contains the problem. The output is not written, so that no file contains it.
    IN_OUTPUT: PostDiffers {
        en: "in line {line} of the output",
        de: "in Zeile {line} der Ausgabe",
    }
    /// Note: the section and line of the definition that wrote the line of output.
    WRITTEN_BY_LINE: PostDiffers {
        en: "the line comes from {section}, line {at} of the definition",
        de: "die Zeile stammt aus {section}, Zeile {at} der Definition",
    }
    /// Note: the section with the default text that wrote the line of output.
    WRITTEN_BY: PostDiffers {
        en: "the line comes from the default text of {section}, which the definition does not contain",
        de: "die Zeile stammt aus dem vorgegebenen Text von {section}, den die Definition nicht enthält",
    }
    /// A program with several work offsets, to be written through a post.
    JOB_SYSTEM: NothingToPost {
        en: "a post cannot write a program that uses several work offsets",
        de: "ein Programm mit mehreren Nullpunktverschiebungen kann kein Postprozessor schreiben",
        help_en: "split it into one program for each work offset",
        help_de: "es in ein Programm je Nullpunktverschiebung teilen",
    }
    /// A cut from or to an unknown position, for example after G91, in a program to be written through a post.
    JOB_PLACE_UNKNOWN: NothingToPost {
        en: "a cut from or to an unknown position cannot be written through a post",
        de: "einen Schnitt von oder zu einer unbekannten Position kann kein Postprozessor schreiben",
        help_en: "before the first cut, move to X, Y and Z once with absolute coordinates (G90)",
        help_de: "vor dem ersten Schnitt X, Y und Z einmal mit absoluten Koordinaten (G90) anfahren",
    }
    /// A rapid move that counts from an unknown position, such as G91 after a probe, in a program to be written through a post.
    JOB_WAY_UNKNOWN: NothingToPost {
        en: "this move counts from a position that only the machine knows, so it cannot be written through a post",
        de: "diese Bewegung zählt von einer Position aus, die nur die Maschine kennt; das kann kein Postprozessor schreiben",
        help_en: "write the height or place with absolute coordinates (G90)",
        help_de: "die Höhe oder den Ort mit absoluten Koordinaten (G90) schreiben",
    }
    /// A spindle that is switched off for a stop or a dwell, in a program to be written through a definition of CAD6.
    JOB_SPINDLE_OFF: NothingToPost {
        en: "{operation} switches the spindle off before it stops or waits, and this post can only do so at a tool change",
        de: "{operation} schaltet die Spindel vor einem Halt oder einer Wartezeit aus; dieser Postprozessor kann das nur beim Werkzeugwechsel",
        help_en: "split the program at the stop, or use a post in the language of CamBam",
        help_de: "das Programm am Halt teilen oder einen Postprozessor in der Sprache von CamBam verwenden",
    }
    /// A cut with the length of another tool, or without a length where the tool has one, in a program to be written through a post.
    JOB_LENGTH: NothingToPost {
        en: "the tool length offset (H) is not that of the tool that cuts: a post writes one for each tool, with the tool's own number",
        de: "die Werkzeuglänge (H) ist nicht die des Werkzeugs, das fräst: ein Postprozessor schreibt eine je Werkzeug, mit der Nummer des Werkzeugs",
        help_en: "name the tool with T, and write H with the same number once after each tool change",
        help_de: "das Werkzeug mit T nennen und nach jedem Werkzeugwechsel einmal H mit derselben Nummer schreiben",
    }
    /// A zero or a tool length that the program sets at the machine, in a program to be written through a post.
    JOB_ZERO: NothingToPost {
        en: "{word} sets a zero or a tool length at the machine, and a post does not write it: everything after it would be milled somewhere else",
        de: "{word} setzt an der Maschine einen Nullpunkt oder eine Werkzeuglänge, und ein Postprozessor schreibt das nicht: alles danach würde woanders gefräst",
        help_en: "set the zero and the length at the machine before the program starts, and remove the word if the program then counts from there",
        help_de: "Nullpunkt und Länge vor dem Start des Programms an der Maschine setzen und das Wort entfernen, wenn das Programm dann von dort aus zählt",
    }
    /// A value that only the machine knows, such as the height that a probe found.
    JOB_MACHINE_VALUE: NothingToPost {
        en: "only the machine knows {parameter}, so what depends on it cannot be written through a post",
        de: "nur die Maschine kennt {parameter}; was davon abhängt, kann kein Postprozessor schreiben",
        help_en: "measure and calculate in a program of the machine's own: a post can only write numbers",
        help_de: "in einem eigenen Programm der Maschine messen und rechnen: ein Postprozessor kann nur Zahlen schreiben",
    }
    /// M6 without T in the middle of a program.
    JOB_TOOL_UNNAMED: NothingToPost {
        en: "the tool is changed here, but the program does not name the new one",
        de: "hier wird das Werkzeug gewechselt, aber das Programm nennt das neue nicht",
        help_en: "write T with the tool's number before M6",
        help_de: "T und die Nummer des Werkzeugs vor M6 setzen",
    }
    /// A plunge directly after a tool change.
    CUT_AFTER_CHANGE: NothingToPost {
        en: "{operation} continues at Z {z}, below the surface at {surface}, right after the change to T{index}: the new tool would plunge where the old one ended",
        de: "{operation} geht gleich nach dem Wechsel zu T{index} bei Z {z} weiter, unter der Oberfläche bei {surface}: das neue Werkzeug würde eintauchen, wo das alte aufgehört hat",
        help_en: "put a rapid move to a place above the material between the tool change and the next cut",
        help_de: "zwischen Werkzeugwechsel und nächstem Schnitt einen Eilgang über das Material setzen",
    }
    /// A move to a machine position (G28, G30 or G53), in a program to be written through a post.
    JOB_NAMED_PLACE: NothingToPost {
        en: "a move to a position that only the machine knows cannot be written through a post",
        de: "eine Bewegung an eine Position, die nur die Maschine kennt, kann kein Postprozessor schreiben",
        help_en: "remove the move; if the machine needs it, put it into the texts of the post",
        help_de: "die Bewegung entfernen; braucht die Maschine sie, in die Texte des Postprozessors schreiben",
    }
    /// A move that cannot be written through a post: an arc of several turns, or a probing move away from the material.
    JOB_MOVE: NothingToPost {
        en: "a move of this kind (an arc of several turns, probing away from the material) cannot be written through a post",
        de: "eine Bewegung dieser Art (ein Bogen mit mehreren Umläufen, Antasten vom Material weg) kann kein Postprozessor schreiben",
        help_en: "write an arc of several turns as single turns; leave probing to a program of the machine's own",
        help_de: "einen Bogen mit mehreren Umläufen als einzelne Umläufe schreiben; das Antasten einem Programm der Maschine überlassen",
    }
    /// A definition's command that failed or could not be run.
    POST_BUILD_FAILED: PostBuildFailed {
        en: "the post's command \"{command}\" failed: {reason}",
        de: "der Befehl \"{command}\" des Postprozessors ist fehlgeschlagen: {reason}",
        help_en: "correct the command, or run it by hand; the program itself was written",
        help_de: "den Befehl berichtigen oder von Hand ausführen; das Programm selbst wurde geschrieben",
    }
    /// A definition's command that is not run, because the repository is untrusted.
    POST_BUILD_REFUSED: PostBuildFailed {
        en: "the post's command \"{command}\" is not run: the repository is not trusted",
        de: "der Befehl \"{command}\" des Postprozessors wird nicht ausgeführt: dem Repository wird nicht vertraut",
        help_en: "leave out --run-post-build; nothing was written",
        help_de: "--run-post-build weglassen; nichts wurde geschrieben",
    }
    /// A path with probes that is written through a post.
    POST_WITH_PROBES: UncorrectedHeights {
        en: "the path has Z-probes: written through a post, its heights would stay uncorrected",
        de: "der Pfad hat Z-Proben: ein Postprozessor würde seine Höhen unkorrigiert schreiben",
        help_en: "run emit without a post, measure, run `pathbuild adjust`, then `pathbuild post DRAWING_Milling.gcode --post POST`",
        help_de: "emit ohne Postprozessor ausführen, messen, `pathbuild adjust` ausführen, dann `pathbuild post ZEICHNUNG_Milling.gcode --post POST`",
    }
    /// A program with correction formulas that were not applied, to be written through a post.
    POST_UNADJUSTED: UncorrectedHeights {
        en: "the program has correction formulas that have not been worked out: written through a post, its heights would stay uncorrected",
        de: "das Programm hat Korrekturformeln, die noch nicht ausgerechnet sind: ein Postprozessor würde seine Höhen unkorrigiert schreiben",
        help_en: "run `pathbuild adjust` first, and take the _Milling.gcode that it writes",
        help_de: "zuerst `pathbuild adjust` ausführen und die _Milling.gcode nehmen, die es schreibt",
    }
}
