//! Messages about the definitions of post-processors. Those about the programs that post-processors write are in the module `posting` and are
//! exported here as well. (PB750 to PB769)

pub use super::posting::*;

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
    /// A permitted distance between arcs and the lines that replace them that is not used in full.
    CHORD_LIMITED: DoubtfulPost {
        en: "{option} is \"{value}\"; lines that replace arcs are nevertheless at most {limit} mm away from them",
        de: "{option} ist \"{value}\"; Strecken, die Bögen ersetzen, weichen dennoch höchstens {limit} mm von ihnen ab",
        help_en: "write at most 0.05, or 0.0019 in inches",
        help_de: "höchstens 0.05 schreiben, in Zoll 0.0019",
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
    /// A syntax error in XML.
    POST_SYNTAX: InvalidPost {
        en: "the definition cannot be read: {reason}",
        de: "die Definition ist nicht lesbar: {reason}",
        help_en: "correct this place: in XML, & is written as &amp; and < as &lt;; `pathbuild post show linuxcnc` shows a valid definition",
        help_de: "die Stelle berichtigen: in XML steht &amp; für & und &lt; für <; `pathbuild post show linuxcnc` zeigt eine gültige Definition",
    }
    /// A syntax error in TOML.
    POST_TOML_SYNTAX: InvalidPost {
        en: "the definition cannot be read: {reason}",
        de: "die Definition ist nicht lesbar: {reason}",
        help_en: "correct this place; `pathbuild post show din` shows a valid definition",
        help_de: "die Stelle berichtigen; `pathbuild post show din` zeigt eine gültige Definition",
    }
    /// A definition file that is larger than the limit.
    POST_TOO_LARGE: InvalidPost {
        en: "the definition has {size} bytes; the limit is {limit}",
        de: "die Definition hat {size} Bytes; die Grenze ist {limit}",
        help_en: "check whether the file is the definition of a post-processor",
        help_de: "prüfen, ob die Datei die Definition eines Postprozessors ist",
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
    /// An unknown macro in the arguments of the definition's command, where only `{$outfile}` and `{$cbfile.name}` are replaced.
    UNKNOWN_COMMAND_MACRO: UnknownMacro {
        en: "unknown macro {macro} in {section}",
        de: "unbekanntes Makro {macro} in {section}",
        help_en: "use one of {known}: a command has no other macros",
        help_de: "eines von {known} verwenden: ein Befehl hat keine anderen Makros",
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
        help_en: "keep only one of them",
        help_de: "nur eines davon behalten",
    }
    /// An element within another one that may contain only text.
    POST_NESTED_ELEMENT: DoubtfulPost {
        en: "<{element}> is within <{outer}>, which contains text only; it is ignored",
        de: "<{element}> steht in <{outer}>, das nur Text enthält, und wird übergangen",
        help_en: "write < as &lt; if it belongs to the text, otherwise move the element out of <{outer}>",
        help_de: "< als &lt; schreiben, wenn es zum Text gehört, sonst das Element aus <{outer}> herausnehmen",
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
    /// A macro for a value that the program does not have.
    VALUE_MISSING: MissingPostValue {
        en: "{macro} in {section} has no value in {operation}",
        de: "{macro} in {section} hat in {operation} keinen Wert",
        help_en: "remove {macro} from {section}, or use it only where it has a value",
        help_de: "{macro} aus {section} entfernen oder nur dort verwenden, wo es einen Wert hat",
    }
    /// A macro for the number of a program with a name from which no number can be derived.
    PROGRAM_NUMBER_MISSING: MissingPostValue {
        en: "{macro} in {section} has no value in {operation}: the name contains no number above 0",
        de: "{macro} in {section} hat in {operation} keinen Wert: der Name enthält keine Zahl über 0",
        help_en: "set `program-number` in [post] of pathbuild.toml",
        help_de: "`program-number` in [post] von pathbuild.toml setzen",
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
    /// An unknown key in a TOML definition without a similar known one.
    POST_UNKNOWN_KEY: InvalidPost {
        en: "the key {key} is unknown",
        de: "der Schlüssel {key} ist unbekannt",
        help_en: "use one of {known}",
        help_de: "einen von {known} verwenden",
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
        help_en: "correct the name, translate it in [alias], or assign the variable in a text that is called earlier, such as program-start",
        help_de: "den Namen berichtigen, in [alias] übersetzen oder die Variable in einem Text zuweisen, der vorher aufgerufen wird, etwa program-start",
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
        help_en: "did you mean {nearest}? If {name} is another program's name for a variable, translate it in [alias]",
        help_de: "ist {nearest} gemeint? Wenn {name} bei einem anderen Programm so heißt, den Namen in [alias] übersetzen",
    }
    /// Variables with texts that refer to each other, nested more deeply than the limit.
    VARIABLE_DEPTH: EndlessMacro {
        en: "{text}, line {line}, column {column}: variables in the text of {name} are nested more than {limit} levels deep",
        de: "{text}, Zeile {line}, Spalte {column}: im Text von {name} sind Variablen mehr als {limit} Ebenen tief verschachtelt",
    }
    /// A text that exceeds the limit of its length when variables are replaced.
    TEXT_LENGTH: EndlessMacro {
        en: "{text}, line {line}, column {column}: replacing the variables makes the text longer than {limit} bytes",
        de: "{text}, Zeile {line}, Spalte {column}: durch das Ersetzen der Variablen wird der Text länger als {limit} Bytes",
        help_en: "look for variables that contain other variables several times: each level multiplies the text",
        help_de: "nach Variablen suchen, die andere Variablen mehrmals enthalten: jede Ebene vervielfacht den Text",
    }
    /// A text in which more variables are replaced than the limit permits.
    VARIABLE_COUNT: EndlessMacro {
        en: "{text}, line {line}, column {column}: more than {limit} variables are replaced in this text",
        de: "{text}, Zeile {line}, Spalte {column}: in diesem Text werden mehr als {limit} Variablen ersetzt",
        help_en: "look for variables that contain other variables several times: each level multiplies the text",
        help_de: "nach Variablen suchen, die andere Variablen mehrmals enthalten: jede Ebene vervielfacht den Text",
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
        help_en: "add the missing brace",
        help_de: "die fehlende Klammer ergänzen",
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
    /// A text that is not a number, in a term or with a format for numbers.
    TERM_IS_TEXT: InvalidControlText {
        en: "{text}, line {line}, column {column}: \"{found}\" is a text, not a number",
        de: "{text}, Zeile {line}, Spalte {column}: \"{found}\" ist ein Text, keine Zahl",
        help_en: "write the variable outside of a statement, or in a statement with the format s",
        help_de: "die Variable außerhalb einer Anweisung schreiben oder in einer Anweisung mit dem Format s",
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
        de: "{text}, Zeile {line}, Spalte {column}: {name} hat die falsche Anzahl von Argumenten",
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
        help_en: "put the variable into a statement that rounds, such as one with \".\" or \"#\"",
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
        en: "{operation} has a helix from Z {from} to Z {to}, but the text `arc` has no ~Z1~",
        de: "{operation} hat eine Helix von Z {from} nach Z {to}, aber der Text `arc` hat kein ~Z1~",
        help_en: "add ~Z1~ to the text `arc`; if the control does not support helices, add it to the text `line`: the helix is then written as lines",
        help_de: "~Z1~ in den Text `arc` aufnehmen; kennt die Steuerung keine Helix, in den Text `line`: die Helix wird dann in Strecken geschrieben",
    }
    /// A control text that no program needs.
    TEXT_NEVER_CALLED: InvalidControlText {
        en: "the text {text} is never called: no program needs it",
        de: "der Text {text} wird nie aufgerufen: kein Programm braucht ihn",
        help_en: "delete the text: nothing that it writes gets into a program",
        help_de: "den Text löschen: was er schreibt, kommt in kein Programm",
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
}
