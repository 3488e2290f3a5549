//! Messages about reading the lines and words of G-code. Those about following and verifying a program are in the modules `following` and
//! `verify` and are exported here as well. (PB701 to PB738, PB773 to PB789; book: program/reading)
//!
//! `{dialect}` is the name of the dialect in which the file is read.

pub use super::following::*;
pub use super::verify::*;

messages! {
    /// A coordinate without a decimal point, such as `X10`, which some controllers read as thousandths.
    NO_DECIMAL_POINT: DoubtfulSpelling {
        en: "`{word}` has no decimal point: some {dialect} controllers read it as thousandths",
        de: "`{word}` hat keinen Dezimalpunkt: manche Steuerungen mit {dialect} lesen das als Tausendstel",
        help_en: "write `{word}.`",
        help_de: "`{word}.` schreiben",
    }
    /// Lower-case words such as `g0 f1000`, where only upper case is accepted.
    SMALL_LETTER: UnknownWord {
        en: "common builds of {dialect} do not read lower-case letters: write {letter}",
        de: "gängige Varianten von {dialect} lesen keine Kleinbuchstaben: {letter} schreiben",
        help_en: "write all words in upper case",
        help_de: "alle Wörter in Großbuchstaben schreiben",
    }
    /// A carriage return within a line that ends with a line feed.
    RETURN_IN_LINE: UnknownCharacter {
        en: "the line contains a carriage return (CR) and is ignored",
        de: "die Zeile enthält einen Wagenrücklauf (CR) und bleibt unbeachtet",
        help_en: "end every line with LF or CR LF: some controls end the line at a CR and obey what follows, even in a comment",
        help_de: "alle Zeilen mit LF oder CR LF beenden: manche Steuerungen beenden die Zeile bei CR und führen aus, was folgt, auch in einem Kommentar",
    }
    /// A word that the post does not write and that is not interpreted, in a program read in the post's dialect.
    FOREIGN_WORD: ForeignWord {
        en: "{word} is not checked: the post for {dialect} does not write it, and its effect is not tracked",
        de: "{word} wird nicht geprüft: der Postprozessor für {dialect} schreibt es nicht, und seine Wirkung wird nicht berücksichtigt",
        help_en: "remove it, or check its effect at the control",
        help_de: "das Wort entfernen oder an der Steuerung prüfen, was es bewirkt",
    }
    /// A word that the post does not write and that is not interpreted, in a program read by means of the post's definition.
    FOREIGN_TO_DEFINITION: ForeignWord {
        en: "{word} is not checked: {post} does not write it, and its effect is not tracked",
        de: "{word} wird nicht geprüft: {post} schreibt es nicht, und seine Wirkung wird nicht berücksichtigt",
        help_en: "remove it, or check its effect at the control",
        help_de: "das Wort entfernen oder an der Steuerung prüfen, was es bewirkt",
    }
    /// A word that a post replaces by another one.
    WORD_ALTERED: ForeignWord {
        en: "{word} is written as {written}",
        de: "{word} wird als {written} geschrieben",
        help_en: "check that {written} does what the program needs",
        help_de: "prüfen, ob {written} bewirkt, was das Programm braucht",
    }
    /// A word of the program that the output of a post lacks.
    WORD_LEFT_OUT: ForeignWord {
        en: "the post does not write {word}: it is missing from the output",
        de: "der Postprozessor schreibt {word} nicht: es fehlt in der Ausgabe",
        help_en: "put it into the texts of the post if the machine needs it, for example for clamping or dust extraction",
        help_de: "das Wort in die Texte des Postprozessors aufnehmen, wenn die Maschine es braucht, etwa für Spanner oder Absaugung",
    }
    /// Words on which controls disagree, in a program that does not reveal its dialect.
    DIALECT_NOT_NAMED: UnnamedDialect {
        en: "controls disagree on the meaning of {words}; the program is read as {dialect}",
        de: "die Bedeutung von {words} ist von Steuerung zu Steuerung verschieden; das Programm wird als {dialect} gelesen",
        help_en: "name the control's dialect with --dialect",
        help_de: "den Dialekt der Steuerung mit --dialect nennen",
    }
    /// A line that does not begin with a command.
    NO_COMMAND: UnknownWord {
        en: "the line begins with `{word}`: {dialect} obeys only lines that begin with G, M or T",
        de: "die Zeile beginnt mit `{word}`: {dialect} führt nur Zeilen aus, die mit G, M oder T beginnen",
        help_en: "write the command at the beginning of the line",
        help_de: "den Befehl an den Anfang der Zeile setzen",
    }
    /// Two commands in one line, in a dialect that obeys only the first.
    SECOND_COMMAND: ConflictingWords {
        en: "{dialect} obeys only one command per line: {first}, not {word}",
        de: "{dialect} führt je Zeile nur einen Befehl aus: {first}, nicht {word}",
        help_en: "write {word} on a line of its own",
        help_de: "{word} in eine eigene Zeile schreiben",
    }
    /// Two G words or two M words in one line, in a dialect that obeys only the first.
    SECOND_WORD: ConflictingWords {
        en: "{dialect} obeys only one {letter} word per line: {first}, not {word}",
        de: "{dialect} führt je Zeile nur ein {letter}-Wort aus: {first}, nicht {word}",
        help_en: "write {word} on a line of its own",
        help_de: "{word} in eine eigene Zeile schreiben",
    }
    /// A second M code on a line, for a control that refuses such lines.
    SECOND_M_REFUSED: ConflictingWords {
        en: "{dialect} allows only one M code on a line; here are {first} and {second}",
        de: "{dialect} erlaubt in einer Zeile nur ein M-Wort; hier stehen {first} und {second}",
        help_en: "write {second} on a line of its own",
        help_de: "{second} in eine eigene Zeile schreiben",
    }
    /// A second M code in a line, which older controls ignore.
    SECOND_M_LOST: IgnoredWord {
        en: "older {dialect} controls execute only one M code per line: {first} or {second} is lost",
        de: "ältere Steuerungen von {dialect} führen je Zeile nur ein M-Wort aus: {first} oder {second} geht verloren",
        help_en: "write {second} on a line of its own, or accept this warning with `--accept` if the control takes several (parameter 3404#7)",
        help_de: "{second} in eine eigene Zeile schreiben oder die Warnung mit `--accept` hinnehmen, wenn die Steuerung mehrere annimmt (Parameter 3404#7)",
    }
    /// A file that does not look like G-code.
    NOT_G_CODE: NotGCode {
        en: "this is not G-code: {found}",
        de: "das ist kein G-Code: {found}",
        help_en: "give the name of a program for the machine, a text file with words such as G01 X10",
        help_de: "den Namen eines Programms für die Maschine angeben, einer Textdatei mit Wörtern wie G01 X10",
    }
    /// A program in UTF-16, as Notepad saves "Unicode".
    PROGRAM_IN_UTF_16: NotGCode {
        en: "this file is in UTF-16",
        de: "diese Datei ist in UTF-16 gespeichert",
        help_en: "open it in an editor and save it as ANSI (in Notepad: File, Save as, Encoding), or write the program again",
        help_de: "sie in einem Editor öffnen und als ANSI speichern (im Windows-Editor: Datei, Speichern unter, Codierung) oder das Programm neu schreiben",
    }
    /// A program with the byte order mark that some editors write before UTF-8.
    BYTE_ORDER_MARK: DoubtfulSpelling {
        en: "the program begins with a byte order mark (UTF-8), which controls take for characters of its first line",
        de: "das Programm beginnt mit einem Byte Order Mark (UTF-8), das Steuerungen für Zeichen seiner ersten Zeile halten",
        help_en: "save it as ANSI or as UTF-8 without BOM (in Notepad: File, Save as, Encoding), or write the program again",
        help_de: "es als ANSI oder UTF-8 ohne BOM speichern (im Windows-Editor: Datei, Speichern unter, Codierung) oder das Programm neu schreiben",
    }
    /// An option about the dialect of XpertMILL, for a program in another one.
    OPTION_OF_XPERTMILL: Disagreement {
        en: "`{option}` applies only to xpertmill, but this program is read as {dialect}",
        de: "`{option}` gilt nur für xpertmill, dieses Programm wird aber als {dialect} gelesen",
        help_en: "omit the option, or name the dialect with --dialect xpertmill",
        help_de: "die Option weglassen oder den Dialekt mit --dialect xpertmill nennen",
    }
    /// A program without any text.
    EMPTY_PROGRAM: NotGCode {
        en: "the file is empty",
        de: "die Datei ist leer",
        help_en: "write or copy the program again: it was probably cut off, or the disk was full",
        help_de: "das Programm neu schreiben oder kopieren: wahrscheinlich wurde es abgeschnitten, oder der Datenträger war voll",
    }
    /// A character that cannot begin a word.
    UNKNOWN_CHARACTER: UnknownCharacter {
        en: "no word begins with `{found}`; the line is ignored",
        de: "mit `{found}` beginnt kein Wort; die Zeile bleibt unbeachtet",
        help_en: "remove it, or put the remark into a comment",
        help_de: "das Zeichen entfernen oder die Bemerkung in einen Kommentar setzen",
    }
    /// A character that cannot begin a word and that the dialect ignores.
    UNKNOWN_CHARACTER_PASSED: UnknownCharacter {
        en: "no word begins with `{found}`; the character is ignored",
        de: "mit `{found}` beginnt kein Wort; das Zeichen wird übergangen",
        help_en: "remove it, or put the remark into a comment",
        help_de: "das Zeichen entfernen oder die Bemerkung in einen Kommentar setzen",
    }
    /// A word that lacks its number.
    WORD_WITHOUT_NUMBER: InvalidWord {
        en: "`{letter}` has no number; the line is ignored",
        de: "`{letter}` hat keine Zahl; die Zeile bleibt unbeachtet",
        help_en: "write the number directly after the letter",
        help_de: "die Zahl direkt hinter den Buchstaben schreiben",
    }
    /// A malformed number such as `X1.2.3`.
    NO_NUMBER: InvalidWord {
        en: "`{found}` is not a number; the line is ignored",
        de: "`{found}` ist keine Zahl; die Zeile bleibt unbeachtet",
        help_en: "write digits with at most one point, and a sign if needed",
        help_de: "Ziffern mit höchstens einem Punkt schreiben, wenn nötig mit Vorzeichen",
    }
    /// A number that no letter precedes.
    NUMBER_WITHOUT_LETTER: InvalidWord {
        en: "the number `{found}` has no letter; the line is ignored",
        de: "die Zahl `{found}` hat keinen Buchstaben; die Zeile bleibt unbeachtet",
        help_en: "write the letter of the word before the number; a comment begins with {comment}",
        help_de: "den Buchstaben des Worts davorsetzen; ein Kommentar beginnt mit {comment}",
    }
    /// A block number that is too large, or not at the beginning of its line.
    BLOCK_NUMBER: InvalidWord {
        en: "`{found}` is not a block number for {dialect}",
        de: "`{found}` ist für {dialect} keine Satznummer",
        help_en: "put N first in the line, with a whole number of at most {most}",
        help_de: "N mit einer ganzen Zahl bis {most} an den Anfang der Zeile setzen",
    }
    /// A checksum (`*`) that does not match the rest of its line.
    WRONG_CHECKSUM: InvalidWord {
        en: "the checksum `{found}` is wrong, {expected} would be right: the line was altered and is left out",
        de: "die Prüfsumme `{found}` ist falsch, richtig wäre {expected}: die Zeile wurde verändert und bleibt unbeachtet",
        help_en: "have the program written again, or remove N and the checksum: the host adds its own",
        help_de: "das Programm neu schreiben lassen, oder N und die Prüfsumme entfernen: das sendende Programm fügt eigene an",
    }
    /// A comment that is still open at the end of its line.
    UNCLOSED_COMMENT: InvalidComment {
        en: "the comment is not closed; the line is ignored",
        de: "der Kommentar ist nicht geschlossen; die Zeile bleibt unbeachtet",
        help_en: "put `)` at its end; a comment cannot continue on the next line",
        help_de: "`)` ans Ende setzen; ein Kommentar geht nicht über die Zeile hinaus",
    }
    /// A comment that begins within another comment.
    NESTED_COMMENT: InvalidComment {
        en: "this is a comment within a comment; the line is ignored",
        de: "das ist ein Kommentar in einem Kommentar; die Zeile bleibt unbeachtet",
        help_en: "use `[` and `]` inside comments: {dialect} stops at this line",
        help_de: "in Kommentaren `[` und `]` schreiben: {dialect} bleibt bei dieser Zeile stehen",
    }
    /// An expression that lacks a value.
    VALUE_EXPECTED: InvalidExpression {
        en: "a value is missing here; the line is ignored",
        de: "hier fehlt ein Wert; die Zeile bleibt unbeachtet",
        help_en: "write a number, #n, a function or an expression in [ ]",
        help_de: "eine Zahl, #n, eine Funktion oder einen Ausdruck in [ ] schreiben",
    }
    /// An expression that lacks an operator or a closing bracket.
    OPERATOR_EXPECTED: InvalidExpression {
        en: "an operator or `{bracket}` is missing here; the line is ignored",
        de: "hier fehlt ein Rechenzeichen oder `{bracket}`; die Zeile bleibt unbeachtet",
        help_en: "write the bracket, or one of the operators {operators}",
        help_de: "die Klammer oder eines der Rechenzeichen {operators} schreiben",
    }
    /// An expression that lacks a bracket.
    BRACKET_EXPECTED: InvalidExpression {
        en: "`{bracket}` is missing here; the line is ignored",
        de: "hier fehlt `{bracket}`; die Zeile bleibt unbeachtet",
        help_en: "put expressions in [ ]; write ATAN as ATAN[y]/[x]",
        help_de: "Ausdrücke in [ ] setzen; ATAN als ATAN[y]/[x] schreiben",
    }
    /// A parameter such as `#1` without `=`.
    ASSIGNMENT_EXPECTED: InvalidExpression {
        en: "`=` is missing after the parameter; the line is ignored",
        de: "hinter dem Parameter fehlt `=`; die Zeile bleibt unbeachtet",
        help_en: "write the value after `=`, for example #1=2.5",
        help_de: "den Wert hinter `=` schreiben, zum Beispiel #1=2.5",
    }
    /// Brackets nested more deeply than the limit.
    NESTED_TOO_DEEPLY: InvalidExpression {
        en: "brackets are nested more than {most} levels deep; the line is ignored",
        de: "Klammern sind mehr als {most} Ebenen tief verschachtelt; die Zeile bleibt unbeachtet",
        help_en: "split the expression: assign part of it to a parameter first",
        help_de: "den Ausdruck teilen: einen Teil davon zuerst einem Parameter zuweisen",
    }
    /// A line longer than the control accepts.
    LINE_TOO_LONG: LongLine {
        en: "the line has {length} characters; {dialect} accepts at most {most}",
        de: "die Zeile hat {length} Zeichen; {dialect} nimmt höchstens {most} an",
        help_en: "split the line, or shorten its comments",
        help_de: "die Zeile teilen oder ihre Kommentare kürzen",
    }
    /// A line longer than pathbuild reads.
    LINE_MUCH_TOO_LONG: LongLine {
        en: "the line has {length} characters, more than {most}; it is left out",
        de: "die Zeile hat {length} Zeichen, mehr als {most}; sie bleibt unbeachtet",
        help_en: "check whether this is G-code at all, and whether its line ends were lost",
        help_de: "prüfen, ob das überhaupt G-Code ist und ob seine Zeilenenden verloren gegangen sind",
    }
    /// A space inside a number: `X1 2` means X12.
    BLANK_IN_NUMBER: DoubtfulSpelling {
        en: "spaces have no meaning in G-code: this is read as {letter}{number}",
        de: "Leerzeichen haben in G-Code keine Bedeutung: das wird als {letter}{number} gelesen",
        help_en: "if two words are meant, add the letter of the second one",
        help_de: "wenn zwei Wörter gemeint sind, den Buchstaben des zweiten ergänzen",
    }
    /// A space between letter and number in a dialect that may not accept it.
    BLANK_AFTER_LETTER: DoubtfulSpelling {
        en: "there is a space between letter and number, which {dialect} may not accept",
        de: "zwischen Buchstabe und Zahl steht ein Leerzeichen, das {dialect} vielleicht nicht annimmt",
        help_en: "write the number directly after the letter",
        help_de: "die Zahl direkt hinter den Buchstaben schreiben",
    }
    /// A block number without the checksum that hosts send with it.
    NUMBER_WITHOUT_CHECKSUM: DoubtfulSpelling {
        en: "the line has N but no checksum: {dialect} accepts it from an SD card, but not from a host",
        de: "die Zeile hat N, aber keine Prüfsumme: {dialect} nimmt sie von der SD-Karte an, von einem sendenden Programm aber nicht",
        help_en: "leave N out: hosts number the lines themselves",
        help_de: "N weglassen: sendende Programme nummerieren die Zeilen selbst",
    }
    /// A checksum without the block number that hosts send with it.
    CHECKSUM_WITHOUT_NUMBER: DoubtfulSpelling {
        en: "the line has a checksum but no N: {dialect} accepts it from an SD card, but not from a host",
        de: "die Zeile hat eine Prüfsumme, aber kein N: {dialect} nimmt sie von der SD-Karte an, von einem sendenden Programm aber nicht",
        help_en: "leave the checksum out: hosts add their own",
        help_de: "die Prüfsumme weglassen: sendende Programme fügen eigene an",
    }
    /// A decimal comma such as `X1,5`.
    COMMA_FOR_POINT: DoubtfulSpelling {
        en: "a decimal comma is read as a point",
        de: "ein Dezimalkomma wird als Punkt gelesen",
        help_en: "write a point",
        help_de: "einen Punkt schreiben",
    }
    /// A comment style of another dialect.
    FOREIGN_COMMENT: DoubtfulSpelling {
        en: "{dialect} is not known to accept comments with `{sign}`",
        de: "es ist nicht bekannt, ob {dialect} Kommentare mit `{sign}` annimmt",
        help_en: "begin comments with {comment}",
        help_de: "Kommentare mit {comment} beginnen",
    }
    /// Text after `%`, which is read as a comment.
    TEXT_AFTER_PERCENT: DoubtfulSpelling {
        en: "text after `%` is read as a comment",
        de: "Text hinter `%` wird als Kommentar gelesen",
        help_en: "write `%` on a line of its own",
        help_de: "`%` allein in eine Zeile schreiben",
    }
    /// A character that GRBL obeys immediately.
    REAL_TIME_CHARACTER: RealTimeCharacter {
        en: "{dialect} obeys `{found}` at once, even in a comment: {effect}",
        de: "{dialect} führt `{found}` sofort aus, auch in einem Kommentar: {effect}",
        help_en: "write ASCII only, and no ! ? ~",
        help_de: "nur ASCII schreiben, kein ! ? ~",
    }
    /// Lines after the end of the program, which are not read.
    AFTER_END: AfterProgramEnd {
        en: "the program ends in line {line}; this line and all that follow are not read",
        de: "das Programm endet in Zeile {line}; diese Zeile und alle folgenden werden nicht gelesen",
        help_en: "remove these lines, or the earlier end of the program",
        help_de: "diese Zeilen oder das frühere Programmende entfernen",
    }
    /// Lines after M2 or M30 that the control executes nevertheless.
    RUN_AFTER_END: AfterProgramEnd as Error {
        en: "{dialect} also runs this line and those after it, despite the M2 or M30 in line {line}; they are not checked",
        de: "{dialect} führt auch diese und die folgenden Zeilen aus, trotz M2 oder M30 in Zeile {line}; sie werden nicht geprüft",
        help_en: "remove these lines, or put them into a file of their own; to stop in the middle of a program, use M0",
        help_de: "diese Zeilen entfernen oder in eine eigene Datei schreiben; für einen Halt mitten im Programm M0 verwenden",
    }
    /// A line marked by `/`, which a switch at the machine can skip.
    OPTIONAL_LINE: OptionalLine {
        en: "a switch at the machine (block delete) can skip this line; it is read as if it were run",
        de: "ein Schalter an der Maschine (Sätze ausblenden) kann diese Zeile überspringen; sie wird gelesen, als würde sie ausgeführt",
        help_en: "remove `/`, or the line",
        help_de: "`/` oder die ganze Zeile entfernen",
    }
    /// A `/` that the dialect ignores.
    SLASH_DROPPED: OptionalLine {
        en: "{dialect} ignores `/` and runs the line",
        de: "{dialect} beachtet `/` nicht und führt die Zeile aus",
        help_en: "remove the line if it is not meant to run",
        help_de: "die Zeile entfernen, wenn sie nicht ausgeführt werden soll",
    }
    /// A G or M code that the dialect does not have.
    CODE_NOT_KNOWN: UnknownWord {
        en: "{dialect} does not know {word}",
        de: "{dialect} kennt {word} nicht",
        help_en: "correct the word; if the program is for another control, name that one with --dialect, or write the program for this one with `pathbuild post FILE --dialect DIALECT --post POST`",
        help_de: "das Wort berichtigen; ist das Programm für eine andere Steuerung, diese mit --dialect nennen oder es mit `pathbuild post DATEI --dialect DIALEKT --post POST` für diese hier schreiben",
    }
    /// A word with a letter that the dialect does not have.
    LETTER_NOT_KNOWN: UnknownWord {
        en: "{dialect} does not know the letter {word}",
        de: "{dialect} kennt den Buchstaben {word} nicht",
        help_en: "read the file as another dialect with --dialect, or remove the word",
        help_de: "die Datei mit --dialect als anderen Dialekt lesen oder das Wort entfernen",
    }
    /// `#` or `[ ]` in a dialect that has neither parameters nor expressions.
    UNKNOWN_EXPRESSION: UnknownWord {
        en: "{dialect} has neither parameters nor expressions; the line is ignored",
        de: "{dialect} kennt weder Parameter noch Ausdrücke; die Zeile bleibt unbeachtet",
        help_en: "write numbers, or read the file as another dialect with --dialect",
        help_de: "Zahlen schreiben oder die Datei mit --dialect als anderen Dialekt lesen",
    }
    /// A macro statement of a control whose macros are not interpreted.
    MACRO_NOT_FOLLOWED: WordNotFollowed {
        en: "pathbuild does not interpret macros of {dialect}; the line is ignored",
        de: "pathbuild wertet Makros von {dialect} nicht aus; die Zeile bleibt unbeachtet",
        help_en: "check the program at the control, or write the moves out",
        help_de: "das Programm an der Steuerung prüfen oder die Bewegungen ausschreiben",
    }
    /// `%` in a dialect without this sign.
    UNKNOWN_PERCENT: UnknownWord {
        en: "{dialect} does not know `%`",
        de: "{dialect} kennt `%` nicht",
        help_en: "remove the line, unless your sender removes it",
        help_de: "die Zeile entfernen, wenn das Sendeprogramm sie nicht selbst entfernt",
    }
    /// A second `%`, which has no known meaning for XpertMILL.
    SECOND_PERCENT: DoubtfulSpelling {
        en: "`%` begins a program; its effect on {dialect} anywhere else is not known",
        de: "mit `%` beginnt ein Programm; was {dialect} an anderer Stelle damit macht, ist nicht bekannt",
        help_en: "remove the line",
        help_de: "die Zeile entfernen",
    }
    /// A drilling cycle in a dialect without drilling cycles.
    UNKNOWN_CYCLE: UnknownWord {
        en: "{dialect} does not support the drilling cycle {word}: its moves are missing from the result",
        de: "{dialect} kennt den Bohrzyklus {word} nicht: seine Bewegungen fehlen im Ergebnis",
        help_en: "write the cycle out as moves",
        help_de: "den Zyklus als einzelne Bewegungen schreiben",
    }
    /// A word that common builds of a control ignore.
    OFF_IN_BUILDS: IgnoredWord {
        en: "common builds of {dialect} ignore {word}",
        de: "gängige Varianten von {dialect} übergehen {word}",
        help_en: "write the program without {word}; if the machine's firmware was built to support it, accept this warning with `--accept`",
        help_de: "das Programm ohne {word} schreiben; unterstützt die Firmware der Maschine dieses Wort, die Warnung mit `--accept` hinnehmen",
    }
    /// A word for an axis that is not interpreted.
    AXIS_NOT_FOLLOWED: WordNotFollowed {
        en: "pathbuild does not track the axis {word}",
        de: "die Achse {word} wird nicht verfolgt",
        help_en: "check at the control how this axis moves: only X, Y and Z are read",
        help_de: "an der Steuerung prüfen, wie sich diese Achse bewegt: nur X, Y und Z werden gelesen",
    }
    /// A word that the dialect knows but ignores.
    IGNORED: IgnoredWord {
        en: "{dialect} ignores {word}",
        de: "{dialect} übergeht {word}",
        help_en: "remove it, or do by hand what it is meant to do",
        help_de: "entfernen oder von Hand ausführen, was es bewirken soll",
    }
    /// Two words of the same modal group.
    SAME_GROUP: ConflictingWords {
        en: "{first} and {second} must not be on the same line",
        de: "{first} und {second} dürfen nicht in derselben Zeile stehen",
        help_en: "put them on separate lines",
        help_de: "auf zwei Zeilen verteilen",
    }
    /// A letter that occurs twice in one line.
    LETTER_TWICE: ConflictingWords {
        en: "{letter} occurs twice on one line",
        de: "{letter} kommt in einer Zeile zweimal vor",
        help_en: "put the second one on a line of its own; perhaps a letter is missing between the two",
        help_de: "das zweite in eine eigene Zeile setzen; vielleicht fehlt zwischen beiden ein Buchstabe",
    }
    /// Two words on one line that both use its coordinates.
    AXES_WANTED_TWICE: ConflictingWords {
        en: "{first} and {second} both use the coordinates of this line",
        de: "{first} und {second} verwenden beide die Koordinaten dieser Zeile",
        help_en: "put them on separate lines",
        help_de: "auf zwei Zeilen verteilen",
    }
    /// A word on a line that lacks another word it needs.
    NEEDS: MissingWord {
        en: "{word} needs {missing}",
        de: "{word} braucht {missing}",
        help_en: "add the missing word to the line",
        help_de: "das fehlende Wort in der Zeile ergänzen",
    }
    /// A word with a value outside of the permitted range.
    OUT_OF_RANGE: ValueOutOfRange {
        en: "{word} cannot be {value}",
        de: "{word} kann nicht {value} sein",
        help_en: "the value must be {limits}",
        help_de: "erlaubt: {limits}",
    }
    /// A program number that is 0, negative or not whole. The moves of the program do not depend on it.
    PROGRAM_NUMBER: ValueOutOfRange {
        en: "the program number O cannot be {value}",
        de: "die Programmnummer O kann nicht {value} sein",
        help_en: "write a whole number, 1 or more, as in `O1000`",
        help_de: "eine ganze Zahl ab 1 schreiben, etwa `O1000`",
    }
    /// A word that nothing in its line uses.
    UNUSED: UnusedWord {
        en: "nothing on this line uses {word}",
        de: "nichts in dieser Zeile verwendet {word}",
        help_en: "remove it, or add the G word that it belongs to",
        help_de: "entfernen oder das G-Wort ergänzen, zu dem es gehört",
    }
    /// Note: one more finding of this kind is not shown.
    ONE_MORE: DoubtfulSpelling {
        en: "the same applies to one more line, which is not shown",
        de: "das gilt für eine weitere Zeile, die nicht gezeigt wird",
    }
    /// Note: further findings of this kind are not shown.
    MORE: DoubtfulSpelling {
        en: "the same applies to {count} more lines, which are not shown",
        de: "das gilt für {count} weitere Zeilen, die nicht gezeigt werden",
    }
}
