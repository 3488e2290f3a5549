//! Messages about Z-probes. (PB601 to PB609)

messages! {
    /// A malformed line in a file of measured values.
    NO_PROBE_LINE: InvalidProbeLine {
        en: "this is not a valid probe line",
        de: "das ist keine gültige Messzeile",
        help_en: "restore the form ([X Y]/T=HEIGHT) #NUMBER=VALUE; enter only the value by hand",
        help_de: "die Form ([X Y]/T=HÖHE) #NUMMER=WERT wiederherstellen; von Hand nur den Wert eintragen",
    }
    /// A file of measured values in UTF-16, as Notepad saves "Unicode".
    VALUES_IN_UTF_16: InvalidProbeLine {
        en: "this file is in UTF-16",
        de: "diese Datei ist in UTF-16 gespeichert",
        help_en: "open it in an editor and save it as UTF-8 (in Notepad: File, Save as, Encoding)",
        help_de: "sie in einem Editor öffnen und als UTF-8 speichern (im Windows-Editor: Datei, Speichern unter, Codierung)",
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
        en: "the value of #{probe} here differs from {measured} in the log",
        de: "der Wert von #{probe} weicht hier von {measured} im Protokoll ab",
        help_en: "remove the value here if it is wrong, or leave out --log",
        help_de: "den Wert hier entfernen, wenn er falsch ist, sonst --log weglassen",
    }
    /// A probe that made no contact, according to the log.
    PROBE_FAILED: InvalidProbeLine {
        en: "this probe made no contact",
        de: "diese Probe hatte keinen Kontakt",
        help_en: "probe again; remove lines of other probes or of earlier runs from the log",
        help_de: "noch einmal antasten; aus dem Protokoll die Zeilen anderer Proben und früherer Läufe entfernen",
    }
    /// A line of a sender's log that looks like a probe result, but is malformed.
    BROKEN_LOG_LINE: InvalidProbeLine {
        en: "this line is not a probe result",
        de: "diese Zeile ist kein Messergebnis",
        help_en: "measure again if the line was cut off, otherwise remove it: a result has the form [PRB:X,Y,Z:1]",
        help_de: "noch einmal messen, wenn die Zeile abgeschnitten ist, sonst sie entfernen: ein Ergebnis hat die Form [PRB:X,Y,Z:1]",
    }
    /// A log with more or fewer results than there are probes.
    LOG_COUNT: InvalidProbeLine {
        en: "the log does not match {file}: probe results: {found}, probes: {expected}",
        de: "das Protokoll passt nicht zu {file}: Messergebnisse: {found}, Proben: {expected}",
        help_en: "keep exactly one result [PRB:X,Y,Z:1] for each probe in the log, in the order of the probing run",
        help_de: "im Protokoll für jede Probe genau ein Ergebnis [PRB:X,Y,Z:1] lassen, in der Reihenfolge des Antastprogramms",
    }
    /// A result in a log that was measured at another position than that of its probe.
    LOG_ELSEWHERE: InvalidProbeLine {
        en: "this result was measured at {found}, but #{probe} is at {expected}, counted from the first probe",
        de: "dieses Ergebnis wurde bei {found} gemessen, #{probe} liegt aber, von der ersten Probe aus gezählt, bei {expected}",
        help_en: "measure again: the log must come from this drawing's probing run, with its results in the order of the run",
        help_de: "noch einmal messen: das Protokoll muss vom Antastprogramm dieser Zeichnung stammen, mit den Ergebnissen in dessen Reihenfolge",
    }
    /// A result that was measured with another zero than those before it.
    LOG_ZERO_MOVED: InvalidProbeLine {
        en: "this result was measured with another zero than those before it: WCO has changed",
        de: "dieses Ergebnis wurde mit einem anderen Nullpunkt gemessen als die davor: WCO hat sich geändert",
        help_en: "measure all probes again with the zero that the program will use",
        help_de: "alle Proben noch einmal mit dem Nullpunkt messen, mit dem gefräst wird",
    }
    /// A measured height too far from the drawn one.
    TOO_FAR: CorrectionTooLarge {
        en: "#{probe} is {value}, which is {off} mm away from the drawn height {expected}; at most {limit} mm are allowed",
        de: "#{probe} ist {value} und weicht um {off} mm von der gezeichneten Höhe {expected} ab; erlaubt sind höchstens {limit} mm",
        help_en: "measure again; if the value is right, correct T in the drawing, or allow more with --max-correction",
        help_de: "noch einmal messen; wenn der Wert stimmt, T in der Zeichnung berichtigen oder mit --max-correction mehr erlauben",
    }
    /// A correction that is too large, although each measured height is near enough.
    HEIGHT_TOO_FAR: CorrectionTooLarge {
        en: "this height would be changed by {off} mm; at most {limit} mm are allowed",
        de: "diese Höhe würde um {off} mm verändert; erlaubt sind höchstens {limit} mm",
        help_en: "draw probes near this place if it lies far from the existing ones, or allow more with --max-correction",
        help_de: "Proben in der Nähe dieser Stelle zeichnen, falls sie weit von den vorhandenen entfernt liegt, oder mit --max-correction mehr erlauben",
    }
    /// A rapid move at S, which is not corrected, at or below the highest measured height.
    SWEEP_BELOW_MEASURED: CorrectionTooLarge {
        en: "the material was measured up to Z {surface}, but the program makes rapid moves at Z {z} before its first cut and after its last one",
        de: "das Material reicht nach der Messung bis Z {surface}, aber vor dem ersten und nach dem letzten Schnitt fährt das Programm im Eilgang auf Z {z}",
        help_en: "this height is the S of the path, which is not corrected: write a greater S in the drawing, and run `emit` again",
        help_de: "diese Höhe ist das S des Pfads, das nicht korrigiert wird: in der Zeichnung S höher setzen und noch einmal emit aufrufen",
    }
    /// A rapid move that leads over material that was measured as high as the move, or higher.
    SWEEP_INTO_MEASURED: CorrectionTooLarge {
        en: "this rapid move is at Z {z}, but at {at} the material reaches up to Z {surface} according to the probes",
        de: "dieser Eilgang fährt auf Z {z}, aber bei {at} reicht das Material nach den Proben bis Z {surface}",
        help_en: "a rapid move keeps the correction of the place where it begins: write a greater S in the drawing, and run `emit` again",
        help_de: "ein Eilgang behält die Korrektur der Stelle, an der er beginnt: in der Zeichnung S höher setzen und noch einmal emit aufrufen",
    }
    /// Cuts through the material that end above the plate after the correction.
    RAISED_ABOVE_PLATE: CorrectionTooLarge as Warning {
        en: "cuts down to the underside of the sheet (Z {level}) or below it now end above it, up to Z {z}: they may no longer go through",
        de: "Schnitte bis zur Unterseite des Blechs (Z {level}) oder tiefer enden jetzt darüber, bis Z {z}: sie gehen womöglich nicht mehr durch",
        help_en: "if the sheet lies flat on the plate and is thicker than drawn, correct T in the drawing and run `emit` again, or write a lower B; if the sheet bulges, its underside is raised as well and the cuts go through: change nothing",
        help_de: "liegt das Blech eben auf der Platte und ist dicker als gezeichnet, T in der Zeichnung berichtigen und noch einmal emit aufrufen, oder B tiefer setzen; wölbt sich das Blech, liegt auch seine Unterseite höher, und die Schnitte gehen durch: nichts ändern",
    }
    /// Cuts that a correction takes too far below the plate.
    LOWERED_BELOW_PLATE: CorrectionTooLarge as Warning {
        en: "the correction takes cuts down to Z {z}: {depth} mm below the underside of the sheet",
        de: "die Korrektur führt Schnitte bis Z {z} hinunter: {depth} mm unter die Unterseite des Blechs",
        help_en: "if the sheet is thinner than drawn, correct T in the drawing and run `emit` again, or write a higher B; set `below-plate` under [warnings] to allow more than {limit} mm",
        help_de: "ist das Blech dünner als gezeichnet, T in der Zeichnung berichtigen und noch einmal emit aufrufen, oder B höher setzen; mit `below-plate` unter [warnings] mehr als {limit} mm erlauben",
    }
    /// A formula that uses a probe which the file of measured values does not contain.
    UNKNOWN_PROBE: UnknownProbe {
        en: "the formula uses #{probe}, which {file} does not have",
        de: "die Formel verwendet #{probe}, das es in {file} nicht gibt",
        help_en: "run `emit` again, and measure with the new program: both files must come from the same run of emit",
        help_de: "noch einmal emit aufrufen und mit dem neuen Programm messen: beide Dateien müssen vom selben Lauf von emit stammen",
    }
    /// A probe in the file of measured values that its program does not have.
    PROBE_OF_OTHER_PROGRAM: UnknownProbe {
        en: "{file} was written without a probe #{probe}",
        de: "{file} wurde ohne die Probe #{probe} geschrieben",
        help_en: "run `emit` again, and measure with the new program: both files must come from the same run of emit",
        help_de: "noch einmal emit aufrufen und mit dem neuen Programm messen: beide Dateien müssen vom selben Lauf von emit stammen",
    }
    /// A probe in the program at another position than in the file of measured values.
    OTHER_PROBE: UnknownProbe {
        en: "#{probe} is {here} here, but was {there} when {file} was written",
        de: "#{probe} ist hier {here}, war aber {there}, als {file} geschrieben wurde",
        help_en: "run `emit` again, and measure with the new program: the drawing has changed since",
        help_de: "noch einmal emit aufrufen und mit dem neuen Programm messen: die Zeichnung hat sich seither geändert",
    }
    /// A probe with an unknown expected height: its line has an older form, and no formula contains the height.
    NO_EXPECTED_HEIGHT: InvalidProbeLine {
        en: "neither this line nor a formula says how high #{probe} was drawn, so its value cannot be checked",
        de: "weder diese Zeile noch eine Formel sagt, in welcher Höhe #{probe} gezeichnet ist; der Wert lässt sich nicht prüfen",
        help_en: "write the line as ([X Y]/T=HEIGHT) #{probe}=VALUE, or run `emit` again and measure with the new program",
        help_de: "die Zeile als ([X Y]/T=HÖHE) #{probe}=WERT schreiben oder noch einmal emit aufrufen und mit dem neuen Programm messen",
    }
    /// A formula that lacks a value.
    VALUE_EXPECTED: InvalidFormula {
        en: "the formula needs a number, #51 or a bracket here",
        de: "die Formel braucht hier eine Zahl, #51 oder eine Klammer",
        help_en: "run `emit` again and use the new program: the formula was damaged or edited",
        help_de: "noch einmal emit aufrufen und das neue Programm verwenden: die Formel wurde beschädigt oder bearbeitet",
    }
    /// A formula that lacks an operator.
    OPERATOR_EXPECTED: InvalidFormula {
        en: "the formula is malformed here",
        de: "die Formel ist hier fehlerhaft",
        help_en: "write one of + - * / between values, and close each bracket with one of its kind: ( ) or [ ]",
        help_de: "zwischen Werte eines von + - * / schreiben und jede Klammer mit der passenden schließen: ( ) oder [ ]",
    }
    /// An unclosed formula.
    UNCLOSED: InvalidFormula {
        en: "the `)` that closes the formula is missing",
        de: "die schließende Klammer `)` der Formel fehlt",
        help_en: "run `emit` again and use the new program: the line was cut off",
        help_de: "noch einmal emit aufrufen und das neue Programm verwenden: die Zeile ist abgeschnitten",
    }
    /// A malformed number in a formula.
    NOT_A_NUMBER: InvalidFormula {
        en: "{found} is not a number",
        de: "{found} ist keine Zahl",
        help_en: "write a number with at most one decimal point",
        help_de: "eine Zahl mit höchstens einem Dezimalpunkt schreiben",
    }
    /// A formula that is nested too deeply.
    TOO_DEEP: InvalidFormula {
        en: "brackets in the formula are nested more than {limit} levels deep",
        de: "Klammern in der Formel sind mehr als {limit} Ebenen tief verschachtelt",
        help_en: "run `emit` again and use the new program: formulas of pathbuild have only one level",
        help_de: "noch einmal emit aufrufen und das neue Programm verwenden: Formeln von pathbuild haben nur eine Ebene",
    }
    /// A formula that divides by zero.
    DIVISION_BY_ZERO: InvalidFormula {
        en: "the formula divides by 0 here",
        de: "die Formel teilt hier durch 0",
        help_en: "run `emit` again and use the new program: the formula was damaged or edited",
        help_de: "noch einmal emit aufrufen und das neue Programm verwenden: die Formel wurde beschädigt oder bearbeitet",
    }
    /// A formula with a value that is too large for a number.
    NOT_FINITE: InvalidFormula {
        en: "the formula's value is too large for a number",
        de: "der Wert der Formel ist zu groß für eine Zahl",
        help_en: "run `emit` again and use the new program: the formula was damaged or edited",
        help_de: "noch einmal emit aufrufen und das neue Programm verwenden: die Formel wurde beschädigt oder bearbeitet",
    }
    /// A program that is already adjusted.
    ADJUSTED_BEFORE: InvalidFormula {
        en: "this program has been adjusted already",
        de: "dieses Programm ist schon angepasst",
        help_en: "run `emit` again, or use the original file: adjust needs the _Clean.gcode as emit wrote it",
        help_de: "noch einmal emit aufrufen oder die ursprüngliche Datei verwenden: adjust braucht die _Clean.gcode, wie emit sie geschrieben hat",
    }
    /// A file with measured values of other probes, which would be overwritten.
    VALUES_PRESENT: ProbeValuesPresent {
        en: "{name} contains measured values that belong to other probes",
        de: "{name} enthält gemessene Werte, die zu anderen Proben gehören",
        help_en: "use --force and measure again: the drawing's probes have changed since; nothing was written for this path",
        help_de: "--force verwenden und neu messen: die Proben der Zeichnung haben sich seither geändert; für diesen Pfad wurde nichts geschrieben",
    }
    /// A file that is to be overwritten and has lines that `emit` did not write. They may contain measured values.
    OTHER_LINES_PRESENT: ProbeValuesPresent {
        en: "{name} has lines that are not valid probe lines, and may contain measured values",
        de: "{name} hat Zeilen, die keine gültigen Messzeilen sind, und enthält womöglich gemessene Werte",
        help_en: "correct these lines, which `adjust` names; or use --force if the file is not needed; nothing was written for this path",
        help_de: "diese Zeilen berichtigen, die `adjust` nennt, oder --force verwenden, wenn die Datei nicht gebraucht wird; für diesen Pfad wurde nichts geschrieben",
    }
    /// A path that mills outside of the area that its probes enclose.
    OUTSIDE: OutsideProbes {
        en: "the path mills up to {distance} mm outside the probes, at {at} in the program",
        de: "der Pfad fräst bis zu {distance} mm außerhalb der Proben, bei {at} im Programm",
        help_en: "draw probes at the outer corners of the milled area; outside the probes, heights are only guessed",
        help_de: "Proben an die äußeren Ecken des gefrästen Bereichs zeichnen; außerhalb der Proben sind Höhen nur geschätzt",
    }
    /// Probes at one place or on a line, with a model that needs a slope.
    WITHOUT_SLOPE: OutsideProbes {
        en: "the probes lie at one place or on a line: across it, no slope is known, and heights beside it are only guessed",
        de: "die Proben liegen an einer Stelle oder auf einer Linie: quer dazu ist keine Neigung bekannt, und Höhen daneben sind nur geschätzt",
        help_en: "draw at least three probes that are not on a line",
        help_de: "mindestens drei Proben zeichnen, die nicht auf einer Linie liegen",
    }
    /// A cut that ends higher than it should according to the probes, because it keeps the correction of the place where it begins.
    END_TOO_HIGH: OutsideProbes {
        en: "this cut ends {off} mm too high at {at}: it keeps the correction of the place where it begins",
        de: "dieser Schnitt endet bei {at} {off} mm zu hoch: er behält die Korrektur der Stelle, an der er beginnt",
        help_en: "set `z-split`, for example `z-split = 20`, and run `emit` again: cuts are then split, and each piece is corrected at its end",
        help_de: "`z-split` setzen, zum Beispiel `z-split = 20`, und noch einmal emit aufrufen: dann werden Schnitte geteilt und jedes Stück an seinem Ende korrigiert",
    }
    /// A cut that ends lower than it should according to the probes, because it keeps the correction of the place where it begins.
    END_TOO_LOW: OutsideProbes {
        en: "this cut ends {off} mm too low at {at}: it keeps the correction of the place where it begins",
        de: "dieser Schnitt endet bei {at} {off} mm zu tief: er behält die Korrektur der Stelle, an der er beginnt",
        help_en: "set `z-split`, for example `z-split = 20`, and run `emit` again: cuts are then split, and each piece is corrected at its end",
        help_de: "`z-split` setzen, zum Beispiel `z-split = 20`, und noch einmal emit aufrufen: dann werden Schnitte geteilt und jedes Stück an seinem Ende korrigiert",
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
        help_en: "if formulas were removed or changed, run `emit` again and use the new program; if the probe lies too far from everything that is milled, remove it from the drawing",
        help_de: "wurden Formeln entfernt oder geändert, noch einmal emit aufrufen und das neue Programm verwenden; liegt die Probe zu weit von allem, was gefräst wird, sie aus der Zeichnung entfernen",
    }
    /// A probe that corrects no height, reported when the program is written.
    WILL_BE_UNUSED: UnusedProbe as Warning {
        en: "the probe {probe} corrects no height of this path",
        de: "die Probe {probe} korrigiert keine Höhe dieses Pfads",
        help_en: "remove the probe, or move it nearer to what is milled: other probes are nearer everywhere",
        help_de: "die Probe entfernen oder näher an das setzen, was gefräst wird: überall sind andere Proben näher",
    }
    /// A program that was edited after `emit` had written it.
    EDITED_PROGRAM: OldProgram {
        en: "{name} is not what emit writes for {drawing}",
        de: "{name} ist nicht das, was emit für {drawing} schreibt",
        help_en: "run `emit` again, then adjust with the same settings (`z-model`, `compatible`): the program was edited, or written with other settings",
        help_de: "noch einmal emit aufrufen, dann adjust mit denselben Einstellungen (`z-model`, `compatible`): das Programm wurde bearbeitet oder mit anderen Einstellungen geschrieben",
    }
    /// A program that is older than its drawing.
    OLD_PROGRAM: OldProgram {
        en: "{name} is out of date: {drawing} now produces different moves",
        de: "{name} ist veraltet: {drawing} ergibt jetzt andere Bewegungen",
        help_en: "run `emit` again, then adjust with the same options (--feed, --sweep-height)",
        help_de: "noch einmal emit aufrufen, dann adjust mit denselben Optionen (--feed, --sweep-height)",
    }
    /// A program that was written with `--compatible`.
    COMPATIBLE_PROGRAM: OldProgram {
        en: "{name} was written with --compatible: without that option, the drawing gives a different program",
        de: "{name} wurde mit --compatible geschrieben: ohne diese Option ergibt die Zeichnung ein anderes Programm",
        help_en: "run adjust with --compatible, or run `emit` again without that option",
        help_de: "adjust mit --compatible aufrufen oder emit noch einmal ohne diese Option",
    }
    /// A program that was written without `--compatible`.
    NOT_COMPATIBLE_PROGRAM: OldProgram {
        en: "{name} was written without --compatible: with that option, the drawing gives a different program",
        de: "{name} wurde ohne --compatible geschrieben: mit dieser Option ergibt die Zeichnung ein anderes Programm",
        help_en: "run adjust without --compatible (the command `compat` sets that option), or run `emit` again with it",
        help_de: "adjust ohne --compatible aufrufen (der Befehl `compat` setzt diese Option) oder emit noch einmal mit ihr",
    }
}

/// Value of `direction` in [`ODD`] for a probe above the height expected from its neighbours.
pub static HIGHER: crate::Text = crate::Text { en: "higher", de: "höher" };
/// Value of `direction` in [`ODD`] for a probe below the height expected from its neighbours.
pub static LOWER: crate::Text = crate::Text { en: "lower", de: "niedriger" };
