//! Messages about reading and interpreting G-code. Those about verifying it are in the module `verify` and are exported here as well.
//! (PB701 to PB738, PB773 to PB789; book: program/reading)
//!
//! `{dialect}` is the name of the dialect in which the file is read.

pub use super::verify::*;

messages! {
    /// A comment that the controller obeys, such as `(LOGOPEN,name)`.
    ACTIVE_COMMENT: ActiveComment {
        en: "{dialect} obeys this comment: {word}",
        de: "{dialect} führt diesen Kommentar aus: {word}",
        help_en: "if it is only a remark, begin it with another word",
        help_de: "ein anderes Wort davorsetzen, wenn es nur eine Bemerkung ist",
    }
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
        de: "{word} ist nicht geprüft: der Postprozessor für {dialect} schreibt es nicht, und seine Wirkung wird nicht berücksichtigt",
        help_en: "remove it, or check its effect at the control",
        help_de: "das Wort entfernen oder an der Steuerung prüfen, was es bewirkt",
    }
    /// A word that the post does not write and that is not interpreted, in a program read by means of the post's definition.
    FOREIGN_TO_DEFINITION: ForeignWord {
        en: "{word} is not checked: {post} does not write it, and its effect is not tracked",
        de: "{word} ist nicht geprüft: {post} schreibt es nicht, und seine Wirkung wird nicht berücksichtigt",
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
        en: "controls disagree on what {words} does; the program is read as {dialect}",
        de: "was {words} bewirkt, ist von Steuerung zu Steuerung verschieden; das Programm wird als {dialect} gelesen",
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
        en: "older controls of {dialect} obey only one M code on a line: {first} or {second} is lost",
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
        en: "no word begins with `{found}`; it is ignored",
        de: "mit `{found}` beginnt kein Wort; es wird übergangen",
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
    RUN_AFTER_END: AfterProgramEnd {
        en: "{dialect} also runs this line and those after it, despite the M2 or M30 in line {line}; they are not checked",
        de: "{dialect} führt auch diese und die folgenden Zeilen aus, trotz M2 oder M30 in Zeile {line}; sie werden nicht geprüft",
        help_en: "remove these lines, or put them into a file of their own; to stop in the middle of a program, use M0",
        help_de: "diese Zeilen entfernen oder in eine eigene Datei schreiben; für einen Halt mitten im Programm M0 verwenden",
    }
    /// A program without M2, M30 or %.
    NO_END: NoProgramEnd {
        en: "the program ends without {words}",
        de: "das Programm endet ohne {words}",
        help_en: "check whether the file was cut off; if not, write M30 on its last line",
        help_de: "prüfen, ob die Datei abgeschnitten ist; wenn nicht, M30 in die letzte Zeile schreiben",
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
        help_en: "read the file as another dialect with --dialect, or write it for this one with `pathbuild post FILE --post {dialect}`",
        help_de: "die Datei mit --dialect als anderen Dialekt lesen oder sie mit `pathbuild post DATEI --post {dialect}` für diesen schreiben",
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
        en: "`%` begins a program; what it does for {dialect} anywhere else is not known",
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
    /// An O word (subroutine or branch) that is not interpreted.
    O_WORD: WordNotFollowed {
        en: "pathbuild does not interpret this O word; the lines below are read once, in the order of the file",
        de: "pathbuild wertet dieses O-Wort nicht aus; die Zeilen darunter werden einmal gelesen, in der Reihenfolge der Datei",
        help_en: "write the moves out, or check the program at the control",
        help_de: "die Bewegungen ausschreiben oder das Programm an der Steuerung prüfen",
    }
    /// A call of a subprogram that the file lacks.
    CALLED_ELSEWHERE: WordNotFollowed {
        en: "the subprogram {name} is not in this file: its moves are not known",
        de: "das Unterprogramm {name} steht nicht in dieser Datei: seine Bewegungen sind unbekannt",
        help_en: "put it after the program in the same file, or check the program at the control",
        help_de: "es in derselben Datei hinter das Programm schreiben oder das Programm an der Steuerung prüfen",
    }
    /// Two subprograms with the same number.
    DEFINED_TWICE: WordNotFollowed {
        en: "the subprogram {name} is in this file twice: which one the control calls depends on its settings",
        de: "das Unterprogramm {name} steht zweimal in dieser Datei: welches die Steuerung aufruft, hängt von ihren Einstellungen ab",
        help_en: "remove one of them, or give it another number",
        help_de: "eines davon entfernen oder anders nummerieren",
    }
    /// A subprogram that calls itself. That call is not interpreted.
    CALLED_BY_ITSELF: WordNotFollowed {
        en: "the subprogram {name} calls itself; this call is left out",
        de: "das Unterprogramm {name} ruft sich selbst auf; dieser Aufruf wird ausgelassen",
        help_en: "write a loop with a number of repetitions instead",
        help_de: "stattdessen eine Schleife mit einer Anzahl von Wiederholungen schreiben",
    }
    /// A subprogram or loop without its last line.
    CALLED_WITHOUT_END: WordNotFollowed {
        en: "{name} has no end in this file",
        de: "{name} hat in dieser Datei kein Ende",
        help_en: "end subprograms with M99 or endsub, `repeat` and `while` loops with `endrepeat` and `endwhile`, `do` loops with `while`, and branches with `endif`",
        help_de: "Unterprogramme mit M99 oder endsub beenden, Schleifen mit endrepeat oder endwhile, do mit while, Verzweigungen mit endif",
    }
    /// A `do` loop that LinuxCNC ends too early, because an earlier `while` loop was left by `break`.
    ENDED_BY_EARLIER_BREAK: WordNotFollowed {
        en: "LinuxCNC ends the do loop {name} here, although its condition holds, because a break left a while loop in line {earlier}",
        de: "LinuxCNC beendet die do-Schleife {name} hier, obwohl ihre Bedingung erfüllt ist, weil ein break in Zeile {earlier} eine while-Schleife verlassen hat",
        help_en: "write a while loop instead of the do loop, or end the earlier loop by its condition",
        help_de: "statt der do-Schleife eine while-Schleife schreiben, oder die frühere Schleife durch ihre Bedingung beenden",
    }
    /// A loop that LinuxCNC repeats once too often, because of an earlier `continue` in a `do` loop.
    REPEATED_BY_EARLIER_CONTINUE: WordNotFollowed {
        en: "LinuxCNC begins the loop {name} again where it should end, because of the continue in a do loop in line {earlier}",
        de: "LinuxCNC beginnt die Schleife {name} erneut, wo sie enden sollte, wegen des continue in einer do-Schleife in Zeile {earlier}",
        help_en: "in line {earlier}, write an if around the rest of the pass instead of continue",
        help_de: "in Zeile {earlier} statt continue den Rest des Durchgangs in ein if setzen",
    }
    /// `break` or `continue` outside of the loop that it names.
    LEFT_WITHOUT_LOOP: WordNotFollowed {
        en: "this word leaves the loop {name}, which is not running here",
        de: "dieses Wort verlässt die Schleife {name}, die hier nicht läuft",
        help_en: "write the number of the surrounding while or do",
        help_de: "die Nummer der umgebenden Schleife mit while oder do angeben",
    }
    /// The end of a subprogram that was not called, in the main program.
    END_WITHOUT_CALL: WordNotFollowed {
        en: "a subprogram ends here, but none was called: some controls begin the program again",
        de: "hier endet ein Unterprogramm, es wurde aber keines aufgerufen: manche Steuerungen beginnen das Programm von vorn",
        help_en: "end the main program with M30",
        help_de: "das Hauptprogramm mit M30 beenden",
    }
    /// Calls and loops that are nested more deeply than the limit.
    CALLS_TOO_DEEP: WordNotFollowed {
        en: "subprograms and loops are nested more than {most} levels deep: this one is left out",
        de: "Unterprogramme und Schleifen sind mehr als {most} Ebenen tief verschachtelt: diese Ebene wird ausgelassen",
        help_en: "nest fewer levels: replace the innermost calls and loops with the moves that they make",
        help_de: "die innersten Bewegungen ausschreiben",
    }
    /// Calls and loops that execute more lines than the limit.
    CALLS_TOO_LONG: WordNotFollowed {
        en: "subprograms and loops execute more than {most} lines: the rest of the program is not read",
        de: "Unterprogramme und Schleifen führen mehr als {most} Zeilen aus: der Rest des Programms wird nicht gelesen",
        help_en: "check how often loops and subprograms are repeated",
        help_de: "prüfen, wie oft Schleifen und Unterprogramme wiederholt werden",
    }
    /// A command that is not interpreted, although it may affect later moves.
    NOT_FOLLOWED: WordNotFollowed {
        en: "pathbuild does not interpret {word}: from here on, the machine may move differently",
        de: "pathbuild wertet {word} nicht aus: ab hier kann sich die Maschine anders bewegen",
        help_en: "check the program at the control, or write the moves out",
        help_de: "das Programm an der Steuerung prüfen oder die Bewegungen ausschreiben",
    }
    /// G28 of Marlin after the first cut, which changes the zero point.
    REFERENCED: WordNotFollowed {
        en: "{dialect} moves to the reference switches at {word} and counts from them afterwards, no longer from the zero of the part",
        de: "{dialect} fährt bei {word} auf die Referenzschalter und zählt danach von ihnen aus, nicht mehr vom Nullpunkt des Werkstücks",
        help_en: "home the machine before you start the program; to park it at the end, raise the cutter and move to a position in the coordinates of the part",
        help_de: "vor dem Programm referenzieren; zum Parken den Fräser anheben und eine Position des Programms anfahren",
    }
    /// A word that common builds of a control ignore.
    OFF_IN_BUILDS: IgnoredWord {
        en: "common builds of {dialect} ignore {word}",
        de: "gängige Varianten von {dialect} übergehen {word}",
        help_en: "write the program without it; if the machine's firmware was built with it, accept this warning with `--accept`",
        help_de: "das Programm ohne dieses Wort schreiben; ist die Firmware der Maschine damit übersetzt, die Warnung mit `--accept` hinnehmen",
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
    /// F words that are ignored because of an option.
    FEED_IGNORED: IgnoredWord {
        en: "F is ignored because of an option: the feeds of the layers apply",
        de: "F wird wie verlangt übergangen: es gelten die Vorschübe der Layer",
    }
    /// A speed that replaces an earlier one of the same layer.
    SPEED_REPLACED: IgnoredWord {
        en: "layer {layer} already has the speed {old}; {new} replaces it",
        de: "Layer {layer} hat schon die Drehzahl {old}; {new} ersetzt sie",
        help_en: "give each layer only one S",
        help_de: "jedem Layer nur ein S geben",
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
    /// Coordinates in a line while no motion mode is active.
    NO_MOTION: MissingWord {
        en: "these coordinates have no motion word: none of G0 to G3 is active here",
        de: "diese Koordinaten haben kein Bewegungswort: hier ist keines von G0 bis G3 aktiv",
        help_en: "write G0 or G1 before them",
        help_de: "G0 oder G1 davorsetzen",
    }
    /// A word with a value outside of the permitted range.
    OUT_OF_RANGE: ValueOutOfRange {
        en: "{word} cannot be {value}",
        de: "{word} kann nicht {value} sein",
        help_en: "the value must be {limits}",
        help_de: "erlaubt: {limits}",
    }
    /// A drilling cycle of more moves than the limit.
    TOO_MANY_STROKES: ValueOutOfRange {
        en: "this line drills with {count} moves; pathbuild interprets at most {most}",
        de: "diese Zeile bohrt mit {count} Bewegungen; pathbuild wertet höchstens {most} aus",
        help_en: "correct the depth, the depth of a peck (Q) or the number of holes",
        help_de: "die Tiefe, die Tiefe je Hub (Q) oder die Zahl der Bohrungen berichtigen",
    }
    /// G53 while G91 is active, which together give no position.
    MACHINE_COORDINATES_RELATIVE: ConflictingWords {
        en: "G53 counts from the machine's zero, but G91 from where the tool is: together they give no position",
        de: "G53 zählt ab Maschinennull, G91 aber ab der Werkzeugposition: zusammen ergeben sie kein Ziel",
        help_en: "switch to G90 first",
        help_de: "vorher auf G90 schalten",
    }
    /// G53 with a motion other than G0 and G1.
    MACHINE_COORDINATES_MOTION: ConflictingWords {
        en: "G53 works only with G0 and G1",
        de: "G53 wirkt nur zusammen mit G0 und G1",
        help_en: "write G0 or G1 on the same line",
        help_de: "G0 oder G1 in dieselbe Zeile schreiben",
    }
    /// A word that nothing in its line uses.
    UNUSED: UnusedWord {
        en: "nothing on this line uses {word}",
        de: "nichts in dieser Zeile verwendet {word}",
        help_en: "remove it, or add the G word that it belongs to",
        help_de: "entfernen oder das G-Wort ergänzen, zu dem es gehört",
    }
    /// An expression without a value, for example because of a division by zero.
    NO_VALUE: CannotEvaluate {
        en: "the expression has no value: {reason}; the line is ignored",
        de: "der Ausdruck hat keinen Wert: {reason}; die Zeile bleibt unbeachtet",
    }
    /// A parameter with a value that only the machine knows.
    MACHINE_VALUE: MachineValue {
        en: "only the machine knows {parameter}; {value} is assumed",
        de: "nur die Maschine kennt {parameter}; {value} wird angenommen",
        help_en: "check at the machine everything that depends on this value",
        help_de: "an der Maschine alles prüfen, was von diesem Wert abhängt",
    }
    /// A work offset with an unknown position, such as that of G55.
    OFFSET_UNKNOWN: UnknownOffset {
        en: "the position of {system} is unknown; it is assumed to be that of {base}",
        de: "die Lage von {system} ist unbekannt; angenommen wird die von {base}",
        help_en: "rely on lengths and on the overall size only if the program stays within one work offset",
        help_de: "sich auf Längen und Abmessungen nur verlassen, wenn das Programm bei einer einzigen Nullpunktverschiebung bleibt",
    }
    /// G10 L2 for the active work offset, which had an unknown position before.
    ORIGIN_UNKNOWN: UnknownOffset {
        en: "G10 L2 counts from the machine's zero, and the previous position of {system} is unknown; it is assumed to be at the machine's zero",
        de: "G10 L2 zählt vom Maschinennullpunkt aus, und die vorige Lage von {system} ist unbekannt; angenommen wird der Maschinennullpunkt",
        help_en: "set the origin with G10 before the first move",
        help_de: "den Nullpunkt mit G10 vor der ersten Bewegung setzen",
    }
    /// G28, G30 or G53 with an unknown target.
    POSITION_UNKNOWN: UnknownOffset {
        en: "the target of {word} is unknown, so the next move begins at an unknown position",
        de: "das Ziel von {word} ist unbekannt; die nächste Bewegung beginnt daher an unbekannter Stelle",
        help_en: "check at the machine that nothing is in the way of the next move: lengths and checks leave out such moves",
        help_de: "an der Maschine prüfen, dass der Weg der nächsten Bewegung frei ist: Längen und Prüfungen lassen solche Bewegungen aus",
    }
    /// A program that does not state its unit.
    UNITS_NOT_STATED: UnitsNotStated {
        en: "there is no {inch} or {mm} before the first move; millimetres are assumed",
        de: "vor der ersten Bewegung fehlt {inch} oder {mm}; Millimeter werden angenommen",
        help_en: "state the unit: the control keeps that of the previous program",
        help_de: "die Einheit angeben: die Steuerung behält sonst die des vorigen Programms",
    }
    /// A cut with an F that was stated before a change of the unit, on a control that may read its number in the new unit.
    FEED_IN_OTHER_UNIT: UnitChanged {
        en: "this cut uses the F of line {line}, which is in {unit}: after the change of the unit, {dialect} may read its number as {other}",
        de: "dieser Schnitt nimmt das F aus Zeile {line}, das in {unit} angegeben ist: nach dem Wechsel der Einheit kann {dialect} die Zahl als {other} lesen",
        help_en: "write F again in the new unit",
        help_de: "F in der neuen Einheit noch einmal angeben",
    }
    /// A move with a G52 or G92 that was stated before a change of the unit, on a control that may read its numbers in the new unit.
    OFFSET_IN_OTHER_UNIT: UnitChanged {
        en: "this move counts from the offset of line {line}, which is in {unit}: after the change of the unit, {dialect} may read its numbers as {other}",
        de: "diese Bewegung zählt ab der Verschiebung aus Zeile {line}, die in {unit} angegeben ist: nach dem Wechsel der Einheit kann {dialect} die Zahlen als {other} lesen",
        help_en: "cancel the offset before the change of the unit, and set it again after it",
        help_de: "die Verschiebung vor dem Wechsel der Einheit aufheben und danach neu setzen",
    }
    /// A hole with an R, Z or Q that was stated before a change of the unit.
    CYCLE_IN_OTHER_UNIT: UnitChanged {
        en: "this hole takes {word} from line {line}, in {unit}: after the change of the unit, controls such as LinuxCNC read the number as {other}",
        de: "diese Bohrung nimmt {word} aus Zeile {line}, in {unit}: nach dem Wechsel der Einheit lesen Steuerungen wie LinuxCNC die Zahl als {other}",
        help_en: "write R, Z and Q again in the new unit",
        help_de: "R, Z und Q in der neuen Einheit noch einmal angeben",
    }
    /// G20 and G21 in one program, for a control on which the unit is a setting of the machine.
    UNIT_IS_SETTING: UnitChanged {
        en: "{word} contradicts the unit before it: {dialect} has one unit, that of Setting 9, and stops with an alarm",
        de: "{word} widerspricht der Einheit davor: {dialect} hat nur eine Einheit, die aus Setting 9, und hält mit einem Alarm an",
        help_en: "write the whole program in one unit",
        help_de: "das ganze Programm in einer Einheit schreiben",
    }
    /// Coordinates after a tool change, without a motion word, while a drilling cycle is on.
    CYCLE_LEFT_ON: CycleLeftOn {
        en: "this line drills: {word} is still on, although line {line} has changed the tool",
        de: "diese Zeile bohrt: {word} gilt noch, obwohl Zeile {line} das Werkzeug gewechselt hat",
        help_en: "write G80 before the tool change, and the cycle again with the R and Z of the new tool if it is to drill",
        help_de: "vor dem Wechsel G80 schreiben, und den Zyklus mit R und Z des neuen Werkzeugs neu, falls es bohren soll",
    }
    /// G53 with a low Z, while the tool is at a known position in the plane and thus may be over the part.
    LOW_MACHINE_HEIGHT: UnknownOffset {
        en: "only the machine knows whether Z {z} of G53 is above the material",
        de: "nur die Maschine weiß, ob Z {z} von G53 über dem Material liegt",
        help_en: "raise the tool with `G53 G0 Z0`; to go down beside the part, move over that place with `G53 G0 X Y` first",
        help_de: "das Werkzeug mit `G53 G0 Z0` heben; ist ein Platz neben dem Teil gemeint, zuerst mit `G53 G0 X Y` dorthin fahren",
    }
    /// A unit that contradicts a comment.
    UNITS_CONTRADICTED: UnitsNotStated {
        en: "{word} is read as {unit}, but the comment says {comment}",
        de: "{word} wird als {unit} gelesen, aber der Kommentar sagt {comment}",
        help_en: "choose the right meaning with `unit-codes`: the table of XpertMILL's import filter contradicts its examples",
        help_de: "mit `unit-codes` die richtige Bedeutung wählen: die Tabelle des Importfilters von XpertMILL widerspricht seinen Beispielen",
    }
    /// A program that does not state a mode such as G90 or G17.
    MODES_NOT_STATED: ModesNotStated {
        en: "there is no {words} before the first move that depends on it; {taken} is assumed",
        de: "vor der ersten Bewegung, die davon abhängt, fehlt {words}; {taken} wird angenommen",
        help_en: "state it: the control keeps what the previous program set",
        help_de: "das Wort angeben: die Steuerung behält sonst, was das vorige Programm gesetzt hat",
    }
    /// Coordinates without a motion word, as XpertMILL accepts them.
    MOTION_NOT_STATED: MotionNotStated {
        en: "these coordinates have no motion word and are read as another {word}; it is not known whether {dialect} does the same",
        de: "diese Koordinaten haben kein Bewegungswort und werden als weiteres {word} gelesen; ob {dialect} das auch tut, ist nicht bekannt",
        help_en: "write the motion word on every line",
        help_de: "das Bewegungswort in jede Zeile schreiben",
    }
    /// A helix in a dialect that may not support it.
    HELIX_DOUBTFUL: DoubtfulArc {
        en: "this is an arc with Z, which {dialect} is not known to accept",
        de: "das ist ein Bogen mit Z; es ist nicht bekannt, ob {dialect} solche Bögen annimmt",
        help_en: "write short lines instead",
        help_de: "stattdessen kurze Strecken schreiben",
    }
    /// A cut while no feed is set.
    NO_FEED: MissingFeed {
        en: "this cutting move has no feed",
        de: "diese Fräsbewegung hat keinen Vorschub",
        help_en: "write F on this line or an earlier one",
        help_de: "F in diese oder eine frühere Zeile schreiben",
    }
    /// A cut without a feed after G94 cleared it.
    FEED_CLEARED: MissingFeed {
        en: "this cutting move has no feed: {word} in line {line} has cleared F",
        de: "diese Fräsbewegung hat keinen Vorschub: {word} in Zeile {line} hat F gelöscht",
        help_en: "write F after {word}",
        help_de: "F nach {word} schreiben",
    }
    /// G93 without F.
    INVERSE_TIME_WITHOUT_FEED: MissingFeed {
        en: "with G93 every cutting move needs its own F",
        de: "mit G93 braucht jede Fräsbewegung ihr eigenes F",
        help_en: "write F on this line, or switch to G94",
        help_de: "F in diese Zeile schreiben oder auf G94 schalten",
    }
    /// A cut with G95 before a spindle speed is set.
    FEED_PER_TURN_WITHOUT_SPEED: MissingFeed {
        en: "with G95 the feed depends on the spindle, and no speed is set",
        de: "mit G95 hängt der Vorschub von der Spindel ab, und es ist keine Drehzahl gesetzt",
        help_en: "set S, or switch to G94",
        help_de: "S setzen oder auf G94 schalten",
    }
    /// An arc with different radii at its ends.
    RADII_DIFFER: ArcRadiiDiffer {
        en: "the arc begins with the radius {start} and ends with {end}: the difference is {difference} mm more than {dialect} accepts",
        de: "der Bogen beginnt mit dem Radius {start} und endet mit {end}: der Unterschied ist {difference} mm größer, als {dialect} zulässt",
        help_en: "write I and J with more decimals, or check the centre",
        help_de: "I und J mit mehr Nachkommastellen schreiben oder den Mittelpunkt prüfen",
    }
    /// An arc with neither centre nor radius.
    ARC_WITHOUT_CENTRE: InvalidArc {
        en: "an arc needs {centre} or R",
        de: "ein Bogen braucht {centre} oder R",
    }
    /// An arc with both centre and radius.
    ARC_WITH_CENTRE_AND_RADIUS: InvalidArc {
        en: "the arc has both R and {centre}, which contradict each other",
        de: "der Bogen hat R und {centre}, die einander widersprechen",
        help_en: "remove R: {centre} are more accurate",
        help_de: "R entfernen: {centre} sind genauer",
    }
    /// An arc without a required axis word.
    ARC_WITHOUT_END: InvalidArc {
        en: "{dialect} requires {axes} in an arc, even when they do not change",
        de: "{dialect} verlangt {axes} in einem Bogen, auch wenn sie sich nicht ändern",
        help_en: "repeat the coordinates",
        help_de: "die Koordinaten wiederholen",
    }
    /// A full circle given by its radius.
    RADIUS_FULL_CIRCLE: InvalidArc {
        en: "an arc with R cannot end where it begins",
        de: "ein Bogen mit R kann nicht enden, wo er beginnt",
        help_en: "write a full circle with {centre}",
        help_de: "einen Vollkreis mit {centre} schreiben",
    }
    /// A radius that is too small for the ends of the arc.
    RADIUS_TOO_SMALL: InvalidArc {
        en: "the radius {radius} is too small: the arc's ends are {chord} apart",
        de: "der Radius {radius} ist zu klein: die Enden des Bogens liegen {chord} auseinander",
        help_en: "make R at least half of that distance",
        help_de: "R mindestens auf die Hälfte dieses Abstands setzen",
    }
    /// An arc given by a radius of 0.
    RADIUS_ZERO: InvalidArc {
        en: "the arc's radius is 0",
        de: "der Radius des Bogens ist 0",
        help_en: "correct I and J: they give the centre as seen from the start of the arc, except with G90.1 or --absolute-arc-centres",
        help_de: "I und J berichtigen: sie geben den Mittelpunkt vom Anfang des Bogens aus an, außer mit G90.1 oder --absolute-arc-centres",
    }
    /// An arc given by its radius that is nearly a half circle, so that the centre is imprecise.
    NEAR_HALF_CIRCLE: DoubtfulArc {
        en: "the centre of this arc with R moves by {shift} mm if R changes by {change} mm, which is the precision of the program's numbers",
        de: "der Mittelpunkt dieses Bogens mit R wandert um {shift} mm, wenn sich R um {change} mm ändert; genauer sind die Zahlen des Programms nicht",
        help_en: "write the arc with I and J, or with more decimals",
        help_de: "den Bogen mit I und J oder mit mehr Nachkommastellen schreiben",
    }
    /// An arc that is nearly a full circle.
    NEAR_FULL_CIRCLE: DoubtfulArc {
        en: "the arc's ends are only {gap} mm apart: it is run as {degrees} degrees, but their last digit decides between a tiny arc and a full circle",
        de: "die Enden des Bogens liegen nur {gap} mm auseinander: er wird mit {degrees} Grad gefahren, aber die letzte Ziffer der Koordinaten entscheidet zwischen winzigem Bogen und Vollkreis",
        help_en: "for a full circle, give the arc the same start and end; otherwise remove the arc",
        help_de: "für einen Vollkreis Anfang und Ende gleich schreiben; sonst den Bogen entfernen",
    }
    /// An arc that turns back at both ends, where an arc in the other direction would continue the neighbouring cuts.
    ARC_DOUBLES_BACK: DoubtfulArc {
        en: "the arc turns back at both of its ends: with {word} it would continue the cuts before and after it",
        de: "der Bogen kehrt an beiden Enden um: mit {word} würde er die Schnitte davor und danach fortsetzen",
        help_en: "check the direction of the arc",
        help_de: "die Richtung des Bogens prüfen",
    }
    /// A stop of the spindle in a line with a move, which the control executes after the stop.
    STOP_BEFORE_MOTION: StopBeforeMotion {
        en: "{word} is obeyed before the move of this line, while the cutter is still in the material",
        de: "{word} wird vor der Bewegung dieser Zeile ausgeführt, während der Fräser noch im Material ist",
        help_en: "put {word} on the next line",
        help_de: "{word} in die nächste Zeile setzen",
    }
    /// A program that would require more cells than the limit to simulate its material.
    TOO_LARGE_TO_FOLLOW: LimitReached {
        en: "tracking the material of this program takes more cells than the limit of {limit}; rapid moves into material are not checked",
        de: "um das Material dieses Programms zu verfolgen, sind mehr als die erlaubten {limit} Zellen nötig; Eilgänge ins Material werden nicht geprüft",
        help_en: "correct numbers that are far too large, or raise `{key}` under [limits] in pathbuild.toml",
        help_de: "viel zu große Zahlen berichtigen oder `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A program that exceeds the limit of pieces into which arcs and ramps are divided to simulate the material.
    TOO_MANY_PIECES: LimitReached {
        en: "to track the material, the arcs and slopes of this program are divided into {count} pieces, which exceeds the limit of {limit}; rapid moves into material are not checked",
        de: "um das Material zu verfolgen, werden die Bögen und schrägen Bewegungen dieses Programms in {count} Stücke geteilt, mehr als die erlaubten {limit}; Eilgänge ins Material werden nicht geprüft",
        help_en: "correct radii and heights that are far too large, or raise `{key}` under [limits] in pathbuild.toml",
        help_de: "viel zu große Radien und Höhen berichtigen oder `{key}` unter [limits] in pathbuild.toml erhöhen",
    }
    /// A probing move that does not go down.
    USELESS_PROBE: UselessProbe {
        en: "the probing move does not go down, so it touches nothing",
        de: "die Antastbewegung führt nicht nach unten und berührt daher nichts",
        help_en: "probe towards the material; G38.4 and G38.5 go away from it",
        help_de: "zum Material hin antasten; G38.4 und G38.5 führen von ihm weg",
    }
    /// A probing move while the spindle turns.
    PROBE_WITH_SPINDLE_ON: ProbeWithSpindleOn {
        en: "the spindle turns during this probing move: the cutter mills the touch plate, or the probe breaks",
        de: "bei dieser Antastbewegung dreht sich die Spindel: der Fräser fräst in die Messplatte, oder der Taster bricht ab",
        help_en: "stop the spindle with M5 first, and start it again after probing",
        help_de: "die Spindel vorher mit M5 anhalten und nach dem Antasten wieder einschalten",
    }
    /// G64 with a P above the limit.
    CORNERS_ROUNDED: RoundedCorners {
        en: "the control may round corners by up to {most} mm (G64 P), which is more than {limit} mm",
        de: "die Steuerung darf Ecken um bis zu {most} mm verrunden (G64 P), das sind mehr als {limit} mm",
        help_en: "write G64 with a P of at most {limit} mm, or G61; if the part permits more, set `part-tolerance` in pathbuild.toml",
        help_de: "G64 mit einem P von höchstens {limit} mm schreiben, oder G61; erlaubt das Teil mehr, `part-tolerance` in pathbuild.toml setzen",
    }
    /// A probing move without length.
    PROBE_WITHOUT_WAY: UselessProbe {
        en: "the probing move ends where it begins",
        de: "die Antastbewegung endet, wo sie beginnt",
        help_en: "probe down to a height below the material's surface",
        help_de: "bis zu einer Höhe unter der Oberfläche des Materials antasten",
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
