//! Messages about Z-probes. (PB601 to PB609)

messages! {
    /// A malformed line in a file of measured values.
    NO_PROBE_LINE: InvalidProbeLine {
        en: "this is not a valid probe line",
        de: "das ist keine gültige Messzeile",
        help_en: "a line has the form ([X Y]/T=HEIGHT) #NUMBER=VALUE; enter only the value by hand",
        help_de: "eine Zeile hat die Form ([X Y]/T=HÖHE) #NUMMER=WERT; von Hand nur den Wert eintragen",
    }
    /// A probe without a measured value.
    NO_VALUE: InvalidProbeLine {
        en: "#{probe} has no value",
        de: "#{probe} hat keinen Wert",
        help_en: "enter the measured height after the =",
        help_de: "die gemessene Höhe hinter das = schreiben",
    }
    /// A measured value that is not a number.
    NOT_A_VALUE: InvalidProbeLine {
        en: "the value of #{probe} is not a number: {found}",
        de: "der Wert von #{probe} ist keine Zahl: {found}",
        help_en: "enter the measured height in mm, with a decimal point or comma",
        help_de: "die gemessene Höhe in mm eintragen, mit Punkt oder Komma",
    }
    /// A probe for which the file of measured values has two lines.
    PROBE_TWICE: InvalidProbeLine {
        en: "#{probe} already occurs in line {first}",
        de: "#{probe} steht schon in Zeile {first}",
        help_en: "keep the line with the right value",
        help_de: "die Zeile mit dem richtigen Wert behalten",
    }
    /// A value in the file of measured values that differs from the log.
    VALUE_DIFFERS_FROM_LOG: InvalidProbeLine {
        en: "#{probe} has a value here, but {measured} in the log",
        de: "#{probe} hat hier einen Wert, im Protokoll aber {measured}",
        help_en: "remove the wrong one: the value here, or --log",
        help_de: "das Falsche entfernen: den Wert hier oder --log",
    }
    /// A probe that made no contact, according to the log.
    PROBE_FAILED: InvalidProbeLine {
        en: "this probe made no contact",
        de: "diese Probe hatte keinen Kontakt",
        help_en: "probe again; remove lines of other probes or of earlier runs from the log",
        help_de: "noch einmal messen; aus dem Protokoll Zeilen entfernen, die von anderen Proben oder einem früheren Lauf sind",
    }
    /// A line of a sender's log that is no probe result.
    BROKEN_LOG_LINE: InvalidProbeLine {
        en: "this line is not a probe result",
        de: "diese Zeile ist kein Messergebnis",
        help_en: "a result has the form [PRB:X,Y,Z:1]: measure again if the line was cut off, or remove it",
        help_de: "ein Ergebnis hat die Form [PRB:X,Y,Z:1]: noch einmal messen, wenn die Zeile abgeschnitten ist, oder sie entfernen",
    }
    /// A log with more or fewer results than there are probes.
    LOG_COUNT: InvalidProbeLine {
        en: "the log has {found} probe results, but {file} has {expected} probes",
        de: "das Protokoll hat {found} Messergebnisse, {file} aber {expected} Proben",
        help_en: "the log must have one result [PRB:X,Y,Z:1] for each probe, in the order of the probing run, and no other",
        help_de: "das Protokoll muss für jede Probe genau ein Ergebnis [PRB:X,Y,Z:1] enthalten, in der Reihenfolge des Antastprogramms, und kein anderes",
    }
    /// A result in a log that was measured at another position than that of its probe.
    LOG_ELSEWHERE: InvalidProbeLine {
        en: "this result was measured at {found}, but #{probe} is at {expected}, counted from the first probe",
        de: "dieses Ergebnis wurde bei {found} gemessen, #{probe} liegt aber, von der ersten Probe aus gezählt, bei {expected}",
        help_en: "the log must be that of this drawing's probing run, with its results in the order of the run: measure again",
        help_de: "das Protokoll muss vom Antastprogramm dieser Zeichnung stammen, mit den Ergebnissen in dessen Reihenfolge: noch einmal messen",
    }
    /// A measured height too far from the drawn one.
    TOO_FAR: CorrectionTooLarge {
        en: "#{probe} is {value}, which is {off} mm away from the drawn height {expected}; at most {limit} mm are allowed",
        de: "#{probe} ist {value} und weicht um {off} mm von der gezeichneten Höhe {expected} ab; erlaubt sind höchstens {limit} mm",
        help_en: "measure again; if it is right, correct T in the drawing, or allow more with --max-correction",
        help_de: "noch einmal messen; wenn es stimmt, T in der Zeichnung berichtigen oder mit --max-correction mehr erlauben",
    }
    /// A correction that is too large, although each measured height is near enough.
    HEIGHT_TOO_FAR: CorrectionTooLarge {
        en: "this height would be changed by {off} mm; at most {limit} mm are allowed",
        de: "diese Höhe würde um {off} mm verändert; erlaubt sind höchstens {limit} mm",
        help_en: "it lies far outside the probes: draw probes there, or allow more with --max-correction",
        help_de: "sie liegt weit außerhalb der Proben: dort Proben zeichnen oder mit --max-correction mehr erlauben",
    }
    /// A formula that uses a probe which the file of measured values does not contain.
    UNKNOWN_PROBE: UnknownProbe {
        en: "the formula uses #{probe}, which {file} does not have",
        de: "die Formel verwendet #{probe}, das es in {file} nicht gibt",
        help_en: "both files must come from the same run of emit: emit again, and measure with the new program",
        help_de: "beide Dateien müssen vom selben emit stammen: noch einmal ausgeben und mit dem neuen Programm messen",
    }
    /// A probe in the file of measured values that its program does not have.
    PROBE_OF_OTHER_PROGRAM: UnknownProbe {
        en: "{file} was written without a probe #{probe}",
        de: "{file} wurde ohne die Probe #{probe} geschrieben",
        help_en: "both files must come from the same run of emit: emit again, and measure with the new program",
        help_de: "beide Dateien müssen vom selben emit stammen: noch einmal ausgeben und mit dem neuen Programm messen",
    }
    /// A probe in the program at another position than in the file of measured values.
    OTHER_PROBE: UnknownProbe {
        en: "#{probe} is {here} here, but {file} was written with {there}",
        de: "#{probe} ist hier {here}, aber {file} wurde mit {there} geschrieben",
        help_en: "the drawing has changed since; emit again, and measure with the new program",
        help_de: "die Zeichnung hat sich seither geändert; noch einmal ausgeben und mit dem neuen Programm messen",
    }
    /// A probe with an unknown expected height: its line has an older form, and no formula contains the height.
    NO_EXPECTED_HEIGHT: InvalidProbeLine {
        en: "neither this line nor a formula says how high #{probe} was drawn, so its value cannot be checked",
        de: "weder diese Zeile noch eine Formel sagt, in welcher Höhe #{probe} gezeichnet ist; der Wert lässt sich nicht prüfen",
        help_en: "write the line as ([X Y]/T=HEIGHT) #{probe}=VALUE, or emit again and measure with the new program",
        help_de: "die Zeile als ([X Y]/T=HÖHE) #{probe}=WERT schreiben oder noch einmal ausgeben und mit dem neuen Programm messen",
    }
    /// A formula that lacks a value.
    VALUE_EXPECTED: InvalidFormula {
        en: "the formula needs a number, #51 or a bracket here",
        de: "die Formel braucht hier eine Zahl, #51 oder eine Klammer",
        help_en: "it was damaged or edited: emit again and use the new program",
        help_de: "sie wurde beschädigt oder bearbeitet: noch einmal ausgeben und das neue Programm verwenden",
    }
    /// A formula that lacks an operator.
    OPERATOR_EXPECTED: InvalidFormula {
        en: "the formula is malformed here",
        de: "die Formel ist hier fehlerhaft",
        help_en: "write one of + - * / between values, and close each bracket with one of its kind: ( ) or [ ]",
        help_de: "zwischen Werten steht eines von + - * /, und zu jeder Klammer gehört die passende: ( ) oder [ ]",
    }
    /// An unclosed formula.
    UNCLOSED: InvalidFormula {
        en: "the formula is not closed",
        de: "die Formel ist nicht geschlossen",
        help_en: "its line was cut off: emit again and use the new program",
        help_de: "die Zeile ist abgeschnitten: noch einmal ausgeben und das neue Programm verwenden",
    }
    /// A malformed number in a formula.
    NOT_A_NUMBER: InvalidFormula {
        en: "{found} is not a number",
        de: "{found} ist keine Zahl",
        help_en: "a number has at most one decimal point",
        help_de: "eine Zahl hat höchstens einen Dezimalpunkt",
    }
    /// A formula that is nested too deeply.
    TOO_DEEP: InvalidFormula {
        en: "the formula has more than {limit} nested brackets",
        de: "die Formel hat mehr als {limit} verschachtelte Klammern",
        help_en: "no formula of pathbuild has more than one: emit again and use the new program",
        help_de: "keine Formel von pathbuild hat mehr als eine: noch einmal ausgeben und das neue Programm verwenden",
    }
    /// A formula that divides by zero.
    DIVISION_BY_ZERO: InvalidFormula {
        en: "the formula divides by 0 here",
        de: "die Formel teilt hier durch 0",
        help_en: "it was damaged or edited: emit again and use the new program",
        help_de: "sie wurde beschädigt oder bearbeitet: noch einmal ausgeben und das neue Programm verwenden",
    }
    /// A formula with a value that is too large for a number.
    NOT_FINITE: InvalidFormula {
        en: "the formula's value is too large for a number",
        de: "der Wert der Formel ist zu groß für eine Zahl",
        help_en: "it was damaged or edited: emit again and use the new program",
        help_de: "sie wurde beschädigt oder bearbeitet: noch einmal ausgeben und das neue Programm verwenden",
    }
    /// A program that is already adjusted.
    ADJUSTED_BEFORE: InvalidFormula {
        en: "this program has been adjusted already",
        de: "dieses Programm ist schon angepasst",
        help_en: "adjust starts from _Clean.gcode as emit wrote it: emit again, or fetch the original file",
        help_de: "adjust geht von der _Clean.gcode aus, wie emit sie geschrieben hat: noch einmal ausgeben oder die ursprüngliche Datei holen",
    }
    /// A file with measured values of other probes, which would be overwritten.
    VALUES_PRESENT: ProbeValuesPresent {
        en: "{name} contains measured values that belong to other probes",
        de: "{name} enthält gemessene Werte, die zu anderen Proben gehören",
        help_en: "the drawing's probes have changed since; nothing was written for this path. Measure anew and use --force",
        help_de: "die Proben der Zeichnung haben sich seither geändert; für diesen Pfad wurde nichts geschrieben. Neu messen und --force verwenden",
    }
    /// A path that mills outside of the area that its probes enclose.
    OUTSIDE: OutsideProbes {
        en: "the path mills up to {distance} mm outside the probes, at {at} in the program",
        de: "der Pfad fräst bis zu {distance} mm außerhalb der Proben, bei {at} im Programm",
        help_en: "draw probes at the outer corners of what is milled; outside them heights are only guessed",
        help_de: "Proben an die äußeren Ecken dessen zeichnen, was gefräst wird; außerhalb sind Höhen nur geschätzt",
    }
    /// A measured height that differs strongly from those of the neighbouring probes.
    ODD: OddProbe {
        en: "#{probe} is {off} mm {direction} than expected from its neighbours",
        de: "#{probe} ist {off} mm {direction}, als nach den Nachbarn zu erwarten wäre",
        help_en: "measure this probe again; if the value is right, nothing needs to be done",
        help_de: "diese Probe noch einmal messen; wenn der Wert stimmt, ist nichts zu tun",
    }
    /// A measured height that no formula uses.
    UNUSED: UnusedProbe {
        en: "no formula in {file} uses #{probe}",
        de: "keine Formel in {file} verwendet #{probe}",
        help_en: "the formulas were removed or changed: emit again and use the new program. If the probe lies too far from everything that is milled, remove it from the drawing",
        help_de: "die Formeln wurden entfernt oder geändert: noch einmal ausgeben und das neue Programm verwenden. Liegt die Probe zu weit von allem, was gefräst wird, sie aus der Zeichnung entfernen",
    }
    /// A probe that corrects no height, reported when the program is written.
    WILL_BE_UNUSED: UnusedProbe {
        en: "the probe {probe} corrects no height of this path",
        de: "die Probe {probe} korrigiert keine Höhe dieses Pfads",
        help_en: "others lie nearer to everything that is milled: remove the probe, or move it nearer",
        help_de: "andere liegen näher an allem, was gefräst wird: die Probe entfernen oder näher heran setzen",
    }
    /// A program that was edited after `emit` had written it.
    EDITED_PROGRAM: OldProgram {
        en: "{name} is not what emit writes for {drawing}",
        de: "{name} ist nicht das, was emit für {drawing} schreibt",
        help_en: "it was edited, or written with other options: run emit again, then adjust with the same options (--z-model, --compatible)",
        help_de: "es wurde bearbeitet oder mit anderen Optionen geschrieben: noch einmal emit aufrufen, dann adjust mit denselben Optionen (--z-model, --compatible)",
    }
    /// A program that is older than its drawing.
    OLD_PROGRAM: OldProgram {
        en: "{name} is out of date: {drawing} now produces different moves",
        de: "{name} ist veraltet: {drawing} ergibt jetzt andere Bewegungen",
        help_en: "run emit again, then adjust with the same options (--feed, --sweep-height)",
        help_de: "noch einmal emit aufrufen, dann adjust mit denselben Optionen (--feed, --sweep-height)",
    }
    /// A program that was written with `--compatible`.
    COMPATIBLE_PROGRAM: OldProgram {
        en: "{name} was written with --compatible: without that option, the drawing gives a different program",
        de: "{name} wurde mit --compatible geschrieben: ohne diese Option ergibt die Zeichnung ein anderes Programm",
        help_en: "adjust it with --compatible, or run emit again without it",
        help_de: "adjust mit --compatible aufrufen oder emit noch einmal ohne diese Option",
    }
    /// A program that was written without `--compatible`.
    NOT_COMPATIBLE_PROGRAM: OldProgram {
        en: "{name} was written without --compatible: with that option, the drawing gives a different program",
        de: "{name} wurde ohne --compatible geschrieben: mit dieser Option ergibt die Zeichnung ein anderes Programm",
        help_en: "adjust it without --compatible (`compat` gives that option), or run emit again with it",
        help_de: "adjust ohne --compatible aufrufen (`compat` setzt diese Option) oder emit noch einmal mit ihr",
    }
}

/// Direction in which a probe differs, for [`ODD`].
pub static HIGHER: crate::Text = crate::Text { en: "higher", de: "höher" };
/// Direction in which a probe differs, for [`ODD`].
pub static LOWER: crate::Text = crate::Text { en: "lower", de: "niedriger" };
