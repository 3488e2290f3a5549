//! Messages about parameters and variables. (PB201 to PB212, PB301 to PB305, PB790; book: language/letters, language/variables)

messages! {
    /// A required value that is neither given nor inherited.
    MISSING: MissingParameter {
        en: "{letter} is missing",
        de: "{letter} fehlt",
        help_en: "{element} needs {letter}: write it on the element, or on the path's start marker",
        help_de: "{element} braucht {letter}: ans Element schreiben oder an die Anfangsmarke des Pfads",
    }
    /// A missing letter on several elements of one kind, reported once.
    MISSING_ON_SEVERAL: MissingParameter {
        en: "{letter} is missing here; further elements of this kind without {letter}: {count}",
        de: "{letter} fehlt hier; weitere Elemente dieser Art ohne {letter}: {count}",
        help_en: "{element} needs {letter}: write it on the path's start marker for all of them, or on each element",
        help_de: "{element} braucht {letter}: für alle an die Anfangsmarke des Pfads schreiben oder an jedes Element",
    }
    /// A start marker's text without O or T.
    MISSING_AT_START: MissingParameter {
        en: "{letter} is missing at the path's start",
        de: "{letter} fehlt am Pfadanfang",
        help_en: "write O (cutter diameter) and T (thickness of the material) in the text of the start marker; every path needs both",
        help_de: "O (Fräserdurchmesser) und T (Materialdicke) in den Text der Anfangsmarke schreiben; jeder Pfad braucht beide",
    }
    /// Note: a text with O and T that was probably meant for the start marker, which has the text of the finding instead.
    PATH_TEXT_ELSEWHERE: MissingParameter {
        en: "O and T are in the text \"{text}\" at {point}, but the start marker uses the text of this finding instead: move the text of this finding away from the start marker",
        de: "O und T stehen im Text \"{text}\" bei {point}, die Anfangsmarke verwendet aber den hier gemeldeten Text: den gemeldeten Text von der Anfangsmarke wegschieben",
    }
    /// A missing M where a path is embedded.
    MISSING_MATERIAL: MissingParameter {
        en: "M is missing: no material is given on {where}",
        de: "M fehlt: bei {where} ist kein Material angegeben",
        help_en: "give M both in the embedded path and on the segment (or in the embedding path)",
        help_de: "M sowohl im eingebetteten Pfad als auch am Segment (oder im einbettenden Pfad) angeben",
    }
    /// A letter that the element does not accept.
    UNKNOWN_LETTER: UnknownParameter {
        en: "{element} does not accept \"{letter}\"",
        de: "{element} kennt \"{letter}\" nicht",
        help_en: "use one of {known}; values follow their letter without a space",
        help_de: "einen von {known} verwenden; Werte folgen ihrem Buchstaben ohne Leerzeichen",
    }
    /// A lower-case letter that the element accepts in upper case.
    LOWER_CASE_LETTER: UnknownParameter {
        en: "{element} does not accept \"{letter}\"",
        de: "{element} kennt \"{letter}\" nicht",
        help_en: "write letters in upper case: \"{upper}\"; {element} accepts {known}",
        help_de: "Buchstaben groß schreiben: \"{upper}\"; {element} kennt {known}",
    }
    /// A text in lower case that is valid in upper case.
    LOWER_CASE_TEXT: UnknownParameter {
        en: "the letters of this text are lower case",
        de: "die Buchstaben dieses Textes sind klein geschrieben",
        help_en: "write \"{text}\", with upper-case letters",
        help_de: "\"{text}\" schreiben, mit Großbuchstaben",
    }
    /// A text with commas between its parameters, where spaces are required.
    COMMAS: UnknownParameter {
        en: "parameters are separated by commas here",
        de: "hier sind Parameter durch Kommas getrennt",
        help_en: "separate them with spaces: write \"{text}\"",
        help_de: "mit Leerzeichen trennen: \"{text}\"",
    }
    /// A text that looks like a remark and contains no parameters, on an element that accepts Q.
    REMARK: UnknownParameter {
        en: "\"{text}\" looks like a remark and contains no parameters",
        de: "\"{text}\" sieht nach einer Bemerkung aus und enthält keine Parameter",
        help_en: "move a remark to a layer without a path; Q puts a comment into the program",
        help_de: "eine Bemerkung auf einen Layer legen, der kein Pfadlayer ist; mit Q kommt ein Kommentar ins Programm",
    }
    /// A text that looks like a remark and contains no parameters, on an element that does not accept Q.
    REMARK_WITHOUT_Q: UnknownParameter {
        en: "\"{text}\" looks like a remark and contains no parameters",
        de: "\"{text}\" sieht nach einer Bemerkung aus und enthält keine Parameter",
        help_en: "move a remark to a layer without a path",
        help_de: "eine Bemerkung auf einen Layer legen, der kein Pfadlayer ist",
    }
    /// A word that is not a parameter, among parameters other than Q, on an element that accepts Q.
    WORD: UnknownParameter {
        en: "\"{word}\" is not a parameter: {element} accepts {known}",
        de: "\"{word}\" ist kein Parameter: {element} kennt {known}",
        help_en: "remove it, or put it on a layer without a path; Q puts a comment into the program, for example Q{word}",
        help_de: "entfernen oder auf einen Layer legen, der kein Pfadlayer ist; mit Q kommt ein Kommentar ins Programm, zum Beispiel Q{word}",
    }
    /// A word that is not a parameter, after the comment Q.
    WORD_AFTER_COMMENT: UnknownParameter {
        en: "\"{word}\" is not a parameter: {element} accepts {known}",
        de: "\"{word}\" ist kein Parameter: {element} kennt {known}",
        help_en: "remove it, or join it to the comment without a space, for example Q{comment}_{word}: a comment ends at the first space",
        help_de: "entfernen oder ohne Leerzeichen an den Kommentar anhängen, zum Beispiel Q{comment}_{word}: ein Kommentar endet am ersten Leerzeichen",
    }
    /// A word that is not a parameter, among parameters of an element that does not accept Q.
    WORD_WITHOUT_Q: UnknownParameter {
        en: "\"{word}\" is not a parameter: {element} accepts {known}",
        de: "\"{word}\" ist kein Parameter: {element} kennt {known}",
        help_en: "remove it, or put it on a layer without a path",
        help_de: "entfernen oder auf einen Layer legen, der kein Pfadlayer ist",
    }
    /// A letter of another alphabet that looks like a valid one.
    LOOK_ALIKE_LETTER: UnknownParameter {
        en: "\"{character}\" ({code}) only looks like \"{plain}\"",
        de: "\"{character}\" ({code}) sieht nur aus wie \"{plain}\"",
        help_en: "type \"{meant}\"",
        help_de: "\"{meant}\" eintippen",
    }
    /// A sign that CAD programs draw in place of a code such as `%%c`.
    DRAWN_CODE: UnknownParameter {
        en: "\"{sign}\" is not a parameter; {code} is shown as {shown} here",
        de: "\"{sign}\" ist kein Parameter; {code} wird hier als {shown} angezeigt",
        help_en: "remove it, or put it on a layer without a path: the diameter of a hole is that of its circle, and O that of the cutter",
        help_de: "entfernen oder auf einen Layer legen, der kein Pfadlayer ist: der Durchmesser eines Lochs ist der seines Kreises, O der des Fräsers",
    }
    /// A zero where the letter O is meant.
    ZERO_FOR_O: UnknownParameter {
        en: "{element} does not accept \"0\"",
        de: "{element} kennt \"0\" nicht",
        help_en: "if the zero is meant as the letter O, write \"{meant}\"",
        help_de: "ist die Null als Buchstabe O gemeint, \"{meant}\" schreiben",
    }
    /// The name of a path, with `>`, on an element that embeds nothing.
    NAME_ON_OTHER_ELEMENT: UnknownParameter {
        en: "{element} does not accept \"{letter}\": it embeds no path",
        de: "{element} kennt \"{letter}\" nicht: hier wird kein Pfad eingebettet",
        help_en: "embed a path by a line with line type DASHDOT, or, if it ends where it starts, by an arc from 270 to 270 degrees",
        help_de: "einen Pfad durch eine Linie mit Linientyp DASHDOT einbetten oder, wenn er endet, wo er anfängt, durch einen Bogen von 270 bis 270 Grad",
    }
    /// A path name without `>`.
    NAME_WITHOUT_SIGN: UnknownParameter {
        en: "this is a path's name without \">\" before it",
        de: "das ist ein Pfadname ohne \">\" davor",
        help_en: "write \"{meant}\"",
        help_de: "\"{meant}\" schreiben",
    }
    /// A space between a letter and its number.
    VALUE_APART: UnknownParameter {
        en: "there is a space between a letter and its value",
        de: "zwischen einem Buchstaben und seinem Wert steht ein Leerzeichen",
        help_en: "write \"{meant}\"",
        help_de: "\"{meant}\" schreiben",
    }
    /// A space between `>` and the name.
    NAME_APART_FROM_SIGN: UnknownParameter {
        en: "there is a space between \">\" and the path's name",
        de: "zwischen \">\" und dem Namen des Pfads steht ein Leerzeichen",
        help_en: "write \"{meant}\"",
        help_de: "\"{meant}\" schreiben",
    }
    /// A value that is not greater than another one, although it must be.
    NOT_ABOVE: ParameterOutOfRange {
        en: "{letter} is {value}, but must be greater than {limit_letter}, which is {limit}",
        de: "{letter} ist {value}, muss aber größer als {limit_letter} ({limit}) sein",
        help_en: "correct the heights: all are measured from the plate, S above T above D above B",
        help_de: "die Höhen berichtigen: alle zählen ab der Aufspannplatte, S über T über D über B",
    }
    /// A value that is not less than another one, although it must be.
    NOT_BELOW: ParameterOutOfRange {
        en: "{letter} is {value}, but must be less than {limit_letter}, which is {limit}",
        de: "{letter} ist {value}, muss aber kleiner als {limit_letter} ({limit}) sein",
        help_en: "correct the heights: all are measured from the plate, S above T above D above B",
        help_de: "die Höhen berichtigen: alle zählen ab der Aufspannplatte, S über T über D über B",
    }
    /// Note: two values that differ by so little that programs give the same number for both.
    EQUAL_IN_PROGRAM: ParameterOutOfRange {
        en: "programs have three decimals: rounded to these, the two heights are equal",
        de: "Programme haben drei Nachkommastellen: darauf gerundet sind beide Höhen gleich",
    }
    /// Like [`NOT_ABOVE`], for a letter that has no effect here.
    UNUSED_NOT_ABOVE: ParameterOutOfRange {
        en: "{letter} is {value}, but must be greater than {limit_letter}, which is {limit}",
        de: "{letter} ist {value}, muss aber größer als {limit_letter} ({limit}) sein",
        help_en: "remove it: {letter} has no effect here",
        help_de: "entfernen: {letter} hat hier keine Wirkung",
    }
    /// Like [`NOT_BELOW`], for a letter that has no effect here.
    UNUSED_NOT_BELOW: ParameterOutOfRange {
        en: "{letter} is {value}, but must be less than {limit_letter}, which is {limit}",
        de: "{letter} ist {value}, muss aber kleiner als {limit_letter} ({limit}) sein",
        help_en: "remove it: {letter} has no effect here; line type CONTINUOUS goes down to B, DIVIDE to D",
        help_de: "entfernen: {letter} hat hier keine Wirkung; der Linientyp CONTINUOUS geht bis B, DIVIDE bis D",
    }
    /// A parameter that must be positive, with a value of 0 or less.
    NOT_POSITIVE: ParameterOutOfRange {
        en: "{letter} is {value}, but must be greater than 0",
        de: "{letter} ist {value}, muss aber größer als 0 sein",
        help_en: "write a value above 0, for example {example}",
        help_de: "einen Wert über 0 schreiben, zum Beispiel {example}",
    }
    /// A thickness of 0 or less: heights were probably measured from the surface downwards.
    THICKNESS_NOT_POSITIVE: ParameterOutOfRange {
        en: "{letter} is {value}, but must be greater than 0",
        de: "{letter} ist {value}, muss aber größer als 0 sein",
        help_en: "write the thickness of the material: heights are measured from the plate upwards, not from the surface down; in a sheet of 2 mm, T2 is its surface, B-0.2 cuts through, B1 is a groove of 1 mm, and D1 leaves bars of 1 mm",
        help_de: "die Dicke des Materials schreiben: Höhen zählen von der Platte nach oben, nicht von der Oberfläche nach unten; bei 2 mm Blech ist T2 die Oberfläche, B-0.2 schneidet durch, B1 ist eine Nut von 1 mm Tiefe, und D1 lässt Stege von 1 mm stehen",
    }
    /// A feed that is rounded to zero in a program.
    FEED_ROUNDED_OFF: ParameterOutOfRange {
        en: "{letter} is less than 0.0005 mm/min, which a program with three decimals writes as 0",
        de: "{letter} ist kleiner als 0,0005 mm/min, was ein Programm mit drei Nachkommastellen als 0 schreibt",
        help_en: "write a feed in mm/min, for example {example}",
        help_de: "einen Vorschub in mm/min schreiben, zum Beispiel {example}",
    }
    /// A text value that contains what looks like a further parameter.
    UNSEPARATED_PARAMETER: DoubtfulValue {
        en: "{parameter} belongs to the text of {letter}, \"{value}\", and sets nothing",
        de: "{parameter} gehört zum Text von {letter}, \"{value}\", und bewirkt nichts",
        help_en: "separate parameters by spaces; if {parameter} is part of the text, write it without the sign before it",
        help_de: "Parameter durch Leerzeichen trennen; gehört {parameter} zum Text, das Zeichen davor weglassen",
    }
    /// A text value that goes on after `~` and blanks with what looks like a parameter.
    SWALLOWED_PARAMETER: DoubtfulValue {
        en: "{parameter} belongs to the text of {letter}, \"{value}\", and sets nothing: the line before it ends with ~",
        de: "{parameter} gehört zum Text von {letter}, \"{value}\", und bewirkt nichts: die Zeile davor endet mit ~",
        help_en: "remove the ~ at the end of the line before; if {parameter} is part of the text, begin the next line with it, without a space",
        help_de: "das ~ am Ende der Zeile davor entfernen; gehört {parameter} zum Text, die nächste Zeile ohne Leerzeichen damit beginnen",
    }
    /// Joined paths with different materials (M).
    JOINED_MATERIAL: DoubtfulValue {
        en: "M is {material} here, but {other} in path {path} of the same program",
        de: "M ist hier {material}, in Pfad {path} desselben Programms aber {other}",
        help_en: "join only paths that are milled from one sheet, or give both the same M",
        help_de: "nur Pfade verbinden, die aus demselben Blech gefräst werden, oder beiden dasselbe M geben",
    }
    /// A list of permitted values with the same value twice.
    LISTED_TWICE: DoubtfulValue {
        en: "the values of variable \"{variable}\" contain \"{value}\" twice",
        de: "die Werte der Variable \"{variable}\" enthalten \"{value}\" zweimal",
        help_en: "remove one of them; if the commas are decimal commas, write points: in a list, the comma separates the values",
        help_de: "einen davon entfernen; sind die Kommas Dezimalkommas, Punkte schreiben: in einer Liste trennt das Komma die Werte",
    }
    /// Two probes of a path with the same name (L).
    PROBE_NAME_TWICE: DoubtfulValue {
        en: "L is {label}, as for the probe at {point}: the file for the measured heights has two lines with this name",
        de: "L ist {label} wie bei der Probe bei {point}: die Datei für die gemessenen Höhen hat zwei Zeilen mit diesem Namen",
        help_en: "give each probe a name of its own",
        help_de: "jeder Probe einen eigenen Namen geben",
    }
    /// A path that is joined with itself.
    JOINED_TWICE: DoubtfulValue {
        en: "path {path} is joined with itself: everything is milled twice",
        de: "Pfad {path} wird mit sich selbst verbunden: alles wird zweimal gefräst",
        help_en: "name each path once",
        help_de: "jeden Pfad nur einmal nennen",
    }
    /// Joined paths with different thicknesses (T).
    JOINED_THICKNESS: DoubtfulValue {
        en: "T is {thickness} here, but {other} in path {path} of the same program: rapid moves of one may run through material of the other",
        de: "T ist hier {thickness}, in Pfad {path} desselben Programms aber {other}: Eilgänge des einen können durch Material des anderen führen",
        help_en: "join only paths whose sheets do not overlap on the table, or give both the same T",
        help_de: "nur Pfade verbinden, deren Bleche sich auf dem Tisch nicht überlappen, oder beiden dasselbe T geben",
    }
    /// A sweep height far above the material, such as a spindle speed.
    HIGH_SWEEP: DoubtfulValue {
        en: "S is {value}: sweeps run {clearance} mm above the material",
        de: "S ist {value}: Leerfahrten laufen {clearance} mm über dem Material",
        help_en: "write the height of the sweeps above the plate, for example S{example}; the spindle's speed is not given in the drawing, but as `spindle` of a [tool] in pathbuild.toml",
        help_de: "die Höhe der Leerfahrten über der Platte schreiben, zum Beispiel S{example}; die Drehzahl der Spindel steht nicht in der Zeichnung, sondern als `spindle` eines [tool] in pathbuild.toml",
    }
    /// A bottom (B) far below the plate.
    BELOW_PLATE: DoubtfulValue {
        en: "B is {value}: {depth} mm below the plate",
        de: "B ist {value}: {depth} mm unter der Platte",
        help_en: "check B, and that nothing lies there that must not be milled; set `below-plate` under [warnings] to allow more than {limit} mm",
        help_de: "prüfen, ob B stimmt und dort nichts liegt, das nicht gefräst werden darf; mit `below-plate` unter [warnings] mehr als {limit} mm erlauben",
    }
    /// A bottom below the plate that was probably meant as a depth.
    BELOW_PLATE_BY_DEPTH: DoubtfulValue {
        en: "B is {value}: {depth} mm below the plate",
        de: "B ist {value}: {depth} mm unter der Platte",
        help_en: "for a depth of {depth} mm in T{thickness}, write B{example}: heights are measured from the plate upwards; if {depth} mm below the plate is meant, set `below-plate` under [warnings] to allow more than {limit} mm",
        help_de: "für {depth} mm Tiefe bei T{thickness} B{example} schreiben: Höhen werden von der Platte nach oben gemessen; sind {depth} mm unter der Platte gemeint, mit `below-plate` unter [warnings] mehr als {limit} mm erlauben",
    }
    /// An embedded path that is lowered instead of raised.
    LOWERED: DoubtfulValue {
        en: "H is {value}: the embedded path is milled {depth} mm lower, into the plate",
        de: "H ist {value}: der eingebettete Pfad wird {depth} mm tiefer gefräst, in die Platte",
        help_en: "write the depth as B in the embedded path; H is the height of the shims under the material, and raises the path",
        help_de: "die Tiefe als B im eingebetteten Pfad schreiben; H ist die Höhe der Unterlagen unter dem Material und hebt den Pfad an",
    }
    /// A Z-probe that is lowered instead of raised.
    LOWERED_PROBE: DoubtfulValue {
        en: "H is {value}: the probe expects the surface {depth} mm below T",
        de: "H ist {value}: die Probe erwartet die Oberfläche {depth} mm unter T",
        help_en: "write the height of the surface as T, without H; H is the height of the shims under the material",
        help_de: "die Höhe der Oberfläche als T schreiben, ohne H; H ist die Höhe der Unterlagen unter dem Material",
    }
    /// Sweepless milling that begins above the surface.
    FIRST_DEPTH_IN_AIR: DoubtfulValue {
        en: "W is {value}, above the surface T of {thickness}: the first pass cuts air",
        de: "W ist {value} und liegt über der Oberfläche T von {thickness}: der erste Durchgang fräst in der Luft",
        help_en: "write W{example} to begin within the material: W is the height of the first pass above the plate",
        help_de: "W{example} schreiben, um im Material zu beginnen: W ist die Höhe des ersten Durchgangs über der Platte",
    }
    /// Sweepless milling that begins below the bottom.
    FIRST_DEPTH_BELOW_BOTTOM: DoubtfulValue {
        en: "W is {value}, below the bottom {bottom}: everything is milled in one pass, {depth} mm deep",
        de: "W ist {value} und liegt unter dem Grund {bottom}: alles wird in einem Durchgang von {depth} mm Tiefe gefräst",
        help_en: "write W{example} for a first pass of one infeed: W is the height of the first pass above the plate",
        help_de: "W{example} schreiben, wenn der erste Durchgang eine Zustellung tief sein soll: W ist seine Höhe über der Platte",
    }
    /// Sweepless milling in which the cutter rises.
    RISE_IN_GROOVE: DoubtfulValue {
        en: "the chain is milled with W, so the cutter stays in its groove; but here it rises to {height} by rapid move, and a T-slot cutter would break",
        de: "die Kette wird mit W gefräst, der Fräser bleibt also in seiner Nut; hier fährt er aber im Eilgang auf {height} hinauf, und ein T-Nutenfräser bräche ab",
        help_en: "in a T-slot, give all segments of the chain the same B, without marks and support bars; if the cutter is no T-slot cutter, describe it as [tool.NAME] in pathbuild.toml, or leave out W",
        help_de: "in einer T-Nut allen Segmenten der Kette dasselbe B geben, ohne Markierungen und Stützstege; ist es kein T-Nutenfräser, ihn als [tool.NAME] in pathbuild.toml beschreiben oder W weglassen",
    }
    /// Support bars that end below the plate or hardly above it.
    THIN_BARS: DoubtfulValue {
        en: "D is {value}: the support bars end at this height, measured from the plate, too low to hold anything",
        de: "D ist {value}: die Stützstege enden in dieser Höhe, gemessen ab der Platte, zu niedrig, um etwas zu halten",
        help_en: "write the thickness of the bars, for example D{example}: D is their upper edge, measured from the plate upwards",
        help_de: "die Dicke der Stege schreiben, zum Beispiel D{example}: D ist ihre Oberkante, von der Platte nach oben gemessen",
    }
    /// Support bars so short that they hold nothing.
    SHORT_BARS: DoubtfulValue {
        en: "P is {value}: support bars of this length, in mm along the cut, hold nothing",
        de: "P ist {value}: Stützstege dieser Länge, in mm entlang des Schnitts, halten nichts",
        help_en: "write the length of a bar, for example P1",
        help_de: "die Länge eines Stegs schreiben, zum Beispiel P1",
    }
    /// Parameters of support bars in a path with a closed outline but without any segment for support bars.
    LOST_BARS: LostBars {
        en: "nothing holds the part inside this outline: the path has {letters} for support bars, but no line with line type BORDER or CENTER",
        de: "das Teil in diesem Umriss wird von nichts gehalten: der Pfad hat {letters} für Stützstege, aber keine Linie mit Linientyp BORDER oder CENTER",
        help_en: "give the outline line type BORDER or CENTER (some CAD programs and blocks turn it into CONTINUOUS); if the part is held otherwise, remove {letters}",
        help_de: "dem Umriss den Linientyp BORDER oder CENTER geben (manche CAD-Programme und Blöcke machen CONTINUOUS daraus); wird das Teil anders gehalten, {letters} entfernen",
    }
    /// An infeed greater than the thickness.
    INFEED_ABOVE_THICKNESS: DoubtfulValue {
        en: "I is {value}, more than the thickness T of {thickness}: one pass cuts through all of the material",
        de: "I ist {value}, mehr als die Dicke T von {thickness}: ein Durchgang geht durch das ganze Material",
        help_en: "write the infeed of one pass, for example I{example}; `infeed` under [warnings] allows more",
        help_de: "die Zustellung eines Durchgangs schreiben, zum Beispiel I{example}; `infeed` unter [warnings] erlaubt mehr",
    }
    /// An infeed that exceeds the configured share of the thickness, but not the thickness itself.
    INFEED_ABOVE_SHARE: DoubtfulValue {
        en: "I is {value}, more than {limit} for a thickness T of {thickness}",
        de: "I ist {value}, mehr als {limit} bei einer Dicke T von {thickness}",
        help_en: "write a smaller infeed, for example I{example}; `infeed` under [warnings] allows more",
        help_de: "eine kleinere Zustellung schreiben, zum Beispiel I{example}; `infeed` unter [warnings] erlaubt mehr",
    }
    /// A feed with a decimal separator that was probably meant to separate thousands.
    FEED_WITH_THOUSANDS: DoubtfulValue {
        en: "F{written} is a feed of {value} mm/min: a point or comma begins the decimals",
        de: "F{written} ist ein Vorschub von {value} mm/min: Punkt oder Komma beginnt die Nachkommastellen",
        help_en: "write {meant} if that is meant: a feed has no thousands separator",
        help_de: "wenn das gemeint ist, {meant} schreiben: ein Vorschub hat kein Tausendertrennzeichen",
    }
    /// A whole number with a zero before it, whose decimal point was probably forgotten.
    ZERO_BEFORE_NUMBER: DoubtfulValue {
        en: "{letter}{written} is read as {letter}{value}",
        de: "{letter}{written} wird als {letter}{value} gelesen",
        help_en: "write {meant} if the decimal point is missing, or else {letter}{value}",
        help_de: "{meant} schreiben, wenn der Dezimalpunkt fehlt, sonst {letter}{value}",
    }
    /// A mark that is deeper than the configured share of the thickness.
    DEEP_MARK: DoubtfulValue {
        en: "D is {value}: the mark is {depth} mm deep in material of {thickness} mm",
        de: "D ist {value}: die Markierung ist {depth} mm tief in Material von {thickness} mm",
        help_en: "write D{example} for a mark {usual} mm deep: D is the height of the mark's bottom above the plate, not its depth; `mark-depth` under [warnings] allows deeper marks",
        help_de: "für eine Markierung von {usual} mm Tiefe D{example} schreiben: D ist die Höhe ihres Grundes über der Platte, nicht die Tiefe; `mark-depth` unter [warnings] erlaubt tiefere Markierungen",
    }
    /// Marks with the path's D that are deeper than the configured share of the thickness.
    DEEP_MARKS_OF_PATH: DoubtfulValue {
        en: "marks without D of their own use {value}: they are {depth} mm deep in material of {thickness} mm",
        de: "Markierungen ohne eigenes D verwenden {value}: sie sind {depth} mm tief in Material von {thickness} mm",
        help_en: "if this D is meant for support bars, give each mark a D of its own, such as D{example} for a depth of {usual} mm; `mark-depth` under [warnings] allows deeper marks",
        help_de: "ist dieses D für die Stützstege gedacht, jeder Markierung ein eigenes geben, etwa D{example} für {usual} mm Tiefe; `mark-depth` unter [warnings] erlaubt tiefere Markierungen",
    }
    /// A feed that exceeds the limit of the machine.
    FEED_ABOVE_MACHINE: DoubtfulValue {
        en: "F is {value}, but the machine's maximum feed is {limit}",
        de: "F ist {value}, der maximale Vorschub der Maschine ist aber {limit}",
        help_en: "correct F, or `maximum-feed` under [machine]",
        help_de: "F berichtigen oder `maximum-feed` unter [machine]",
    }
    /// A feed from an option that exceeds the limit of the machine.
    FALLBACK_FEED_ABOVE_MACHINE: DoubtfulValue {
        en: "the path has no F, and the feed {value} used for it exceeds the machine's maximum of {limit}",
        de: "der Pfad hat kein F, und der für ihn geltende Vorschub {value} überschreitet das Maximum der Maschine von {limit}",
        help_en: "lower `feed` (--feed), write F into the path, or correct `maximum-feed` under [machine]",
        help_de: "`feed` (--feed) senken, F in den Pfad schreiben oder `maximum-feed` unter [machine] berichtigen",
    }
    /// A chip load below the limits of the tool.
    CHIP_LOAD_SMALL: DoubtfulChipLoad {
        en: "the chip load of {load} mm per tooth is below {least}: feed {feed} mm/min, {speed} 1/min, flutes: {flutes}",
        de: "der Zahnvorschub von {load} mm liegt unter {least}: Vorschub {feed} mm/min, {speed} 1/min, Schneiden: {flutes}",
        help_en: "raise F, lower the speed, or change `chip-load` of the tool ({least} to {most}); otherwise the tool rubs instead of cutting",
        help_de: "F erhöhen, die Drehzahl senken oder `chip-load` des Werkzeugs ändern ({least} bis {most}); sonst reibt das Werkzeug, statt zu schneiden",
    }
    /// A chip load above the limits of the tool.
    CHIP_LOAD_LARGE: DoubtfulChipLoad {
        en: "the chip load of {load} mm per tooth is above {most}: feed {feed} mm/min, {speed} 1/min, flutes: {flutes}",
        de: "der Zahnvorschub von {load} mm liegt über {most}: Vorschub {feed} mm/min, {speed} 1/min, Schneiden: {flutes}",
        help_en: "lower F, raise the speed, or change `chip-load` of the tool ({least} to {most}); otherwise the tool may break",
        help_de: "F senken, die Drehzahl erhöhen oder `chip-load` des Werkzeugs ändern ({least} bis {most}); sonst kann das Werkzeug brechen",
    }
    /// A cut that is deeper than the cutting edges of its tool are long.
    CUT_DEEPER_THAN_EDGES: CutDeeperThanEdges {
        en: "a cut down to Z{bottom} is {depth} mm deep, but the cutting edges of the tool are only {length} mm long",
        de: "ein Schnitt bis Z{bottom} ist {depth} mm tief, die Schneiden des Werkzeugs sind aber nur {length} mm lang",
        help_en: "use a tool with longer cutting edges, cut less deep, or correct `length` of the tool in pathbuild.toml",
        help_de: "ein Werkzeug mit längeren Schneiden nehmen, weniger tief fräsen oder `length` des Werkzeugs in pathbuild.toml berichtigen",
    }
    /// A default sweep height that is not above T.
    DEFAULT_SWEEP_TOO_LOW: ParameterOutOfRange {
        en: "the sweep height {value} used for this path is not greater than T, which is {limit}",
        de: "die für diesen Pfad geltende Leerfahrthöhe {value} ist nicht größer als T ({limit})",
        help_en: "give the path an S, or raise sweep-height",
        help_de: "dem Pfad ein S geben oder sweep-height erhöhen",
    }
    /// An embedded path without S: its sweep height T + O is not above the material where it is embedded.
    EMBEDDED_SWEEP_TOO_LOW: ParameterOutOfRange {
        en: "this path has no S: where it is embedded, it sweeps at T + O = {value}, which is not above the material there (T{limit})",
        de: "dieser Pfad hat kein S: wo er eingebettet ist, liegen seine Leerfahrten auf T + O = {value} und damit nicht über dem Material (T{limit})",
        help_en: "give the path an S",
        help_de: "dem Pfad ein S geben",
    }
    /// Material or a probe that H raises to the sweep height or above.
    RAISED_INTO_SWEEPS: ParameterOutOfRange {
        en: "the material here reaches up to {limit}, but this path sweeps at {value}: rapid moves would hit it",
        de: "das Material hier reicht bis {limit}, die Leerfahrten dieses Pfads laufen aber auf {value}: Eilgänge würden damit kollidieren",
        help_en: "give this path a greater S, or raise the material less (H)",
        help_de: "diesem Pfad ein größeres S geben oder das Material weniger anheben (H)",
    }
    /// A sweep with an S of its own that is below material or a probe raised by H.
    SWEEP_BELOW_RAISED: ParameterOutOfRange {
        en: "this sweep runs at {value}, but the material of an embedded path, or a probe, reaches up to {limit}: the rapid move may hit it",
        de: "diese Leerfahrt läuft auf {value}, aber das Material eines eingebetteten Pfads oder eine Probe reicht bis {limit}: der Eilgang kann damit kollidieren",
        help_en: "remove S from the sweep, so that the S of the path applies, or give the sweep an S above {limit}",
        help_de: "das S der Leerfahrt weglassen, dann gilt das des Pfads, oder der Leerfahrt ein S über {limit} geben",
    }
    /// A parameter that is given twice in one text.
    TWICE: DuplicateParameter {
        en: "{letter} is given twice",
        de: "{letter} ist zweimal angegeben",
        help_en: "remove one of them; pathbuild does not guess which one you mean",
        help_de: "eines davon entfernen; pathbuild rät nicht, welches gemeint ist",
    }
    /// A variable that is given twice in one text.
    VARIABLE_TWICE: DuplicateParameter {
        en: "variable \"{variable}\" is given twice",
        de: "Variable \"{variable}\" ist zweimal angegeben",
        help_en: "remove one of them; a variable's name is one character",
        help_de: "eine davon entfernen; der Name einer Variablen ist ein Zeichen",
    }
    /// A parameter with a value that is not a number.
    NOT_A_NUMBER: NotANumber {
        en: "{letter} needs a number, not \"{value}\"",
        de: "{letter} braucht eine Zahl, nicht \"{value}\"",
        help_en: "write digits with at most one decimal point or comma, and a sign if needed, for example {letter}{example}",
        help_de: "Ziffern mit höchstens einem Dezimalpunkt oder -komma schreiben, wenn nötig mit Vorzeichen, zum Beispiel {letter}{example}",
    }
    /// A number that is followed by a unit, such as `O3mm`.
    NUMBER_WITH_UNIT: NotANumber {
        en: "\"{letter}{value}\" is not a number",
        de: "\"{letter}{value}\" ist keine Zahl",
        help_en: "write \"{meant}\": lengths are always in mm, feeds in mm/min, and units are never written",
        help_de: "\"{meant}\" schreiben: Längen sind immer in mm, Vorschübe in mm/min, Einheiten werden nicht geschrieben",
    }
    /// A number with a character that looks like another one.
    LOOK_ALIKE: NotANumber {
        en: "\"{letter}{value}\" is not a number: \"{character}\" ({code}) only looks like \"{plain}\"",
        de: "\"{letter}{value}\" ist keine Zahl: \"{character}\" ({code}) sieht nur aus wie \"{plain}\"",
        help_en: "type \"{meant}\"",
        help_de: "\"{meant}\" eintippen",
    }
    /// A number with letters that look like digits.
    LETTERS_FOR_DIGITS: NotANumber {
        en: "\"{letter}{value}\" is not a number: it has a letter in place of a digit",
        de: "\"{letter}{value}\" ist keine Zahl: statt einer Ziffer steht ein Buchstabe",
        help_en: "write \"{meant}\"",
        help_de: "\"{meant}\" schreiben",
    }
    /// Parameters without a space between them.
    RUN_TOGETHER: NotANumber {
        en: "there are no spaces between parameters here",
        de: "hier stehen keine Leerzeichen zwischen Parametern",
        help_en: "separate them with spaces: write \"{text}\"",
        help_de: "mit Leerzeichen trennen: \"{text}\"",
    }
    /// A space other than that of the keyboard, such as a non-breaking one: it does not separate parameters.
    SPECIAL_SPACE: NotANumber {
        en: "{letter} needs a number, not \"{value}\": \u{2423} is a special space, which separates nothing",
        de: "{letter} braucht eine Zahl, nicht \"{value}\": \u{2423} ist ein besonderes Leerzeichen und trennt nicht",
        help_en: "type an ordinary space instead",
        help_de: "dafür ein gewöhnliches Leerzeichen schreiben",
    }
    /// A parameter with a value that is not an integer.
    NOT_AN_INTEGER: NotANumber {
        en: "{letter} needs a whole number, not \"{value}\"",
        de: "{letter} braucht eine ganze Zahl, nicht \"{value}\"",
        help_en: "write a whole number, such as N1, N2, N3: N gives the order where several segments meet",
        help_de: "eine ganze Zahl schreiben, etwa N1, N2, N3: N gibt die Reihenfolge an, wo mehrere Segmente zusammentreffen",
    }
    /// A variable in a value that must be a literal.
    VARIABLE_NOT_ALLOWED: VariableNotAllowed {
        en: "{letter} cannot use a variable",
        de: "{letter} darf keine Variable enthalten",
        help_en: "write the value itself: N, O and @ are needed before variables have values",
        help_de: "den Wert selbst hinschreiben: N, O und @ werden gebraucht, bevor Variablen Werte haben",
    }
    /// A start marker without a text.
    NO_PATH_PARAMETERS: MissingPathParameters {
        en: "the start marker has no text",
        de: "die Anfangsmarke hat keinen Text",
        help_en: "put a text over the start marker with at least O and T: \"O2 T5 I1 B0\"",
        help_de: "einen Text mit mindestens O und T über die Anfangsmarke legen: \"O2 T5 I1 B0\"",
    }
    /// @ together with other letters.
    AT_WITH_OTHERS: InvalidAtReference {
        en: "@ cannot be combined with other parameters",
        de: "@ kann nicht mit anderen Parametern kombiniert werden",
        help_en: "remove the other parameters: with @, the path has exactly those of the path that @ names",
        help_de: "die anderen Parameter entfernen: mit @ hat der Pfad genau die des genannten Pfads",
    }
    /// @ with an unknown path.
    AT_UNKNOWN: InvalidAtReference {
        en: "there is no path {name} with a text on its start marker in this drawing",
        de: "es gibt in dieser Zeichnung keinen Pfad {name} mit einem Text an der Anfangsmarke",
        help_en: "name a path that has parameters of its own ({known}), or write the parameters here",
        help_de: "einen Pfad mit eigenen Parametern nennen ({known}) oder die Parameter hier angeben",
    }
    /// @ with an unknown path, in a drawing where no other path has parameters of its own.
    AT_WITHOUT_LENDER: InvalidAtReference {
        en: "there is no path {name} with a text on its start marker in this drawing",
        de: "es gibt in dieser Zeichnung keinen Pfad {name} mit einem Text an der Anfangsmarke",
        help_en: "write the parameters here; @ can only name a path of the same drawing",
        help_de: "die Parameter hier angeben; @ kann nur einen Pfad derselben Zeichnung nennen",
    }
    /// @ with a path that uses @ itself.
    AT_CHAINED: InvalidAtReference {
        en: "path {name} itself uses @",
        de: "Pfad {name} verwendet selbst @",
        help_en: "name a path that has parameters of its own, or write the parameters here",
        help_de: "einen Pfad mit eigenen Parametern nennen oder die Parameter hier angeben",
    }
    /// An invalid regular expression in E.
    INVALID_REGEX: InvalidRegex {
        en: "E is not a regular expression: {reason}",
        de: "E ist kein regulärer Ausdruck: {reason}",
        help_en: "write a regular expression that matches the names of embedded paths or parts of them, such as E^2050 or E[.]1P",
        help_de: "einen Ausdruck schreiben, der in den Namen eingebetteter Pfade gesucht wird, etwa E^2050 oder E[.]1P",
    }
    /// A letter that is permitted but has no effect.
    WITHOUT_EFFECT: ParameterWithoutEffect {
        en: "{letter} has no effect here",
        de: "{letter} hat hier keine Wirkung",
        help_en: "remove it",
        help_de: "entfernen",
    }
    /// Parameters of a milling segment on a DOT line, which is a subpath that is left out.
    PARAMETERS_ON_DOT: ParameterWithoutEffect {
        en: "the text \"{text}\" has no effect: a DOT line is a subpath that is left out",
        de: "der Text \"{text}\" hat keine Wirkung: eine Linie mit Linientyp DOT ist ein Unterpfad, der ausgelassen wird",
        help_en: "to mill along the line, draw it CONTINUOUS, or BORDER for support bars; to leave it as a sweep, remove the text",
        help_de: "zum Fräsen die Linie als CONTINUOUS zeichnen, mit Stützstegen als BORDER; soll sie eine Leerfahrt bleiben, den Text entfernen",
    }
    /// A variable that no text refers to.
    UNUSED_VARIABLE: ParameterWithoutEffect {
        en: "the variable {variable} has no effect: no text of the path uses it",
        de: "die Variable {variable} hat keine Wirkung: kein Text des Pfads verwendet sie",
        help_en: "write ={variable} where its value belongs, as in B={variable}, or remove the definition",
        help_de: "={variable} schreiben, wo ihr Wert hingehört, wie in B={variable}, oder die Definition entfernen",
    }
    /// W of a path without a milling chain.
    FIRST_DEPTH_WITHOUT_CHAIN: ParameterWithoutEffect {
        en: "{letter} has no effect here: the path has no milling chain",
        de: "{letter} hat hier keine Wirkung: der Pfad hat keine Fräskette",
        help_en: "remove it, or check the line types: only lines and arcs with CONTINUOUS, DIVIDE, BORDER or CENTER form chains",
        help_de: "entfernen oder die Linientypen prüfen: nur Linien und Bögen mit CONTINUOUS, DIVIDE, BORDER oder CENTER bilden Ketten",
    }
    /// A letter that applies only to cuts, in the text of the start marker of a path that only embeds others.
    WITHOUT_EFFECT_ON_EMBEDDED: ParameterWithoutEffect {
        en: "{letter} has no effect here: the path only embeds others, which have their own {letter}",
        de: "{letter} hat hier keine Wirkung: der Pfad bettet nur andere ein, und für diese gilt ihr eigener Wert",
        help_en: "remove it; to change {letter}, write it in the embedded paths",
        help_de: "entfernen; um {letter} zu ändern, den Wert in die eingebetteten Pfade schreiben",
    }
    /// B on a marking segment.
    BOTTOM_OF_MARK: ParameterWithoutEffect {
        en: "{letter} has no effect here: a mark (line type DIVIDE) goes down to D",
        de: "{letter} hat hier keine Wirkung: eine Markierung (Linientyp DIVIDE) geht bis D",
        help_en: "write D{value} if the mark is to end at that height; only line type CONTINUOUS goes down to B",
        help_de: "D{value} schreiben, wenn die Markierung auf dieser Höhe enden soll; bis B geht nur der Linientyp CONTINUOUS",
    }
    /// D on a milling segment.
    DEPTH_OF_MILLING: ParameterWithoutEffect {
        en: "{letter} has no effect here: milling (line type CONTINUOUS) goes down to B",
        de: "{letter} hat hier keine Wirkung: Fräsen (Linientyp CONTINUOUS) geht bis B",
        help_en: "write B{value} if the cut is to end at that height; only a mark (line type DIVIDE) goes down to D",
        help_de: "B{value} schreiben, wenn bis dorthin gefräst werden soll; bis D geht nur eine Markierung (Linientyp DIVIDE)",
    }
    /// C where no hole becomes a canned cycle.
    PECKS_WITHOUT_CYCLES: ParameterWithoutEffect {
        en: "{letter} has no effect: without `cycles = true` in pathbuild.toml, holes are drilled in one stroke",
        de: "{letter} hat keine Wirkung: ohne `cycles = true` in pathbuild.toml werden Löcher in einem Zug gebohrt",
        help_en: "to peck, set `cycles = true` and write the program with a post-processor; otherwise remove it",
        help_de: "zum Bohren in Stufen `cycles = true` setzen und das Programm mit einem Postprozessor schreiben; sonst entfernen",
    }
    /// C in a program with Z-probes, which is native.
    PECKS_WITH_PROBES: ParameterWithoutEffect {
        en: "{letter} has no effect: programs with Z-probes drill holes in one stroke, also after `adjust` and `post`",
        de: "{letter} hat keine Wirkung: Programme mit Z-Proben bohren Löcher in einem Zug, auch nach `adjust` und `post`",
        help_en: "to peck, drill these holes in a path without probes, and write it with a post-processor; otherwise remove it",
        help_de: "zum Bohren in Stufen diese Löcher in einem Pfad ohne Proben bohren und ihn mit einem Postprozessor schreiben; sonst entfernen",
    }
    /// A chain parameter on a segment other than the first.
    WITHOUT_EFFECT_IN_CHAIN: ParameterWithoutEffect {
        en: "{letter} has no effect here: the first segment's {letter} applies to the whole chain",
        de: "{letter} hat hier keine Wirkung: für die ganze Fräskette gilt der Wert des ersten Segments",
        help_en: "write it on the chain's first segment, or on the path's start marker",
        help_de: "ans erste Segment der Kette schreiben oder an die Anfangsmarke des Pfads",
    }
    /// A malformed definition of the values of a variable.
    INVALID_DEFINITION: InvalidVariableDefinition {
        en: "\"{definition}\" does not define the values of a variable",
        de: "\"{definition}\" legt keine Variablenwerte fest",
        help_en: "write a range (:A-0.5~1.2), a list (:BP1,P2,P3) or single characters (:C?PQRS)",
        help_de: "einen Bereich (:A-0.5~1.2), eine Liste (:BP1,P2,P3) oder einzelne Zeichen (:C?PQRS) schreiben",
    }
    /// A definition of a variable with a range from a greater to a lesser number.
    REVERSED_RANGE: InvalidVariableDefinition {
        en: "the range \"{definition}\" ends with a smaller number than it begins with",
        de: "das Ende des Bereichs \"{definition}\" ist kleiner als sein Anfang",
        help_en: "write the smaller number first",
        help_de: "die kleinere Zahl zuerst schreiben",
    }
    /// A definition of a variable with an empty element in its list.
    EMPTY_ELEMENT: InvalidVariableDefinition {
        en: "\"{definition}\" has an empty element",
        de: "\"{definition}\" hat ein leeres Element",
        help_en: "remove the comma, or add the missing value",
        help_de: "das Komma entfernen oder den fehlenden Wert ergänzen",
    }
    /// A path with variables that is emitted on its own.
    MISSING_VALUE: MissingVariableValue {
        en: "variable \"{variable}\" has no value",
        de: "Variable \"{variable}\" hat keinen Wert",
        help_en: "embed the path in a project that sets the variable: :{variable}VALUE; the path defines it as {definition}",
        help_de: "den Pfad in ein Projekt einbetten, das die Variable setzt: :{variable}WERT; der Pfad legt sie als {definition} fest",
    }
    /// A subpath that does not set a variable of the path that it embeds.
    MISSING_VALUE_HERE: MissingVariableValue {
        en: "variable \"{variable}\" of path {name} has no value",
        de: "Variable \"{variable}\" des Pfads {name} hat keinen Wert",
        help_en: "add the value here, for example :{variable}{example}; the path defines the variable as {definition}",
        help_de: "den Wert hier angeben, zum Beispiel :{variable}{example}; der Pfad legt die Variable als {definition} fest",
    }
    /// A subpath that sets a variable of a path without variables.
    VALUE_WITHOUT_VARIABLES: UnknownVariable {
        en: "path {name} has no variable \"{variable}\"",
        de: "Pfad {name} hat keine Variable \"{variable}\"",
        help_en: "remove it: the path defines no variables",
        help_de: "entfernen: der Pfad legt keine Variablen fest",
    }
    /// A subpath that sets an unknown variable.
    VALUE_WITHOUT_DEFINITION: UnknownVariable {
        en: "path {name} has no variable \"{variable}\"",
        de: "Pfad {name} hat keine Variable \"{variable}\"",
        help_en: "use one of the variables of the path: {known}",
        help_de: "eine der Variablen des Pfads verwenden: {known}",
    }
    /// A reference to an unknown variable.
    UNKNOWN_REFERENCE: UnknownVariable {
        en: "there is no variable \"{variable}\" in this path",
        de: "es gibt in diesem Pfad keine Variable \"{variable}\"",
        help_en: "use a variable that the path's start marker defines ({known}); a reference is = and one character",
        help_de: "eine Variable verwenden, die die Anfangsmarke des Pfads festlegt ({known}); ein Verweis ist = und ein Zeichen",
    }
    /// A reference in a path without variables.
    REFERENCE_WITHOUT_VARIABLES: UnknownVariable {
        en: "there is no variable \"{variable}\" in this path",
        de: "es gibt in diesem Pfad keine Variable \"{variable}\"",
        help_en: "write the value itself, or define the variable at the path's start marker, for example :A-0.5~1.2 for =A",
        help_de: "den Wert selbst hinschreiben oder die Variable an der Anfangsmarke des Pfads festlegen, zum Beispiel :A-0.5~1.2 für =A",
    }
    /// An equals sign after a letter: B=2 instead of B2.
    EQUALS_SIGN: UnknownVariable {
        en: "there is no variable \"{variable}\" in this path",
        de: "es gibt in diesem Pfad keine Variable \"{variable}\"",
        help_en: "write \"{meant}\" for the number: values follow their letter directly, and = inserts a variable",
        help_de: "für die Zahl \"{meant}\" schreiben: Werte folgen direkt auf ihren Buchstaben, und = setzt eine Variable ein",
    }
    /// A value that the definition does not permit.
    VALUE_NOT_ALLOWED: VariableValueNotAllowed {
        en: "variable \"{variable}\" cannot be \"{value}\"",
        de: "Variable \"{variable}\" kann nicht \"{value}\" sein",
        help_en: "use a value that path {name} allows: {definition}",
        help_de: "einen Wert verwenden, den Pfad {name} erlaubt: {definition}",
    }
    /// A value with a comma that the definition does not permit, because the comma separates the values of its list.
    VALUE_WITH_COMMA: VariableValueNotAllowed {
        en: "variable \"{variable}\" cannot be \"{value}\"",
        de: "Variable \"{variable}\" kann nicht \"{value}\" sein",
        help_en: "write decimals with a point, here and in path {name}, whose list is {definition}: the comma separates its values",
        help_de: "Dezimalstellen mit Punkt schreiben, hier und in Pfad {name}, dessen Liste {definition} ist: das Komma trennt ihre Werte",
    }
    /// A variable with a value that refers to itself.
    ENDLESS: EndlessVariable {
        en: "the value of \"{variable}\" refers to itself",
        de: "der Wert von \"{variable}\" verweist auf sich selbst",
        help_en: "remove the circular reference: a value may refer to other variables, but not back to itself",
        help_de: "den Zirkelbezug auflösen: ein Wert darf auf andere Variablen verweisen, aber nicht auf sich selbst zurück",
    }
    /// More combinations of values than are checked.
    COMBINATIONS_CUT: LimitReached as Warning {
        en: "{checked} of {all} combinations of the variables' values were checked",
        de: "{checked} von {all} Kombinationen der Variablenwerte wurden geprüft",
        help_en: "check the project if a certain combination matters: projects are checked with the values that they set; here each value occurred in at least one combination",
        help_de: "kommt es auf eine bestimmte Kombination an, das Projekt prüfen: Projekte werden mit den Werten geprüft, die sie setzen; hier kam jeder Wert in mindestens einer Kombination vor",
    }
    /// More values of one variable than combinations are checked.
    VALUES_CUT: LimitReached as Warning {
        en: "{checked} of {all} combinations of the variables' values were checked: not even every value occurred in one of them",
        de: "{checked} von {all} Kombinationen der Variablenwerte wurden geprüft: nicht einmal jeder Wert kam darin vor",
        help_en: "check the projects that embed the path: projects are checked with the values that they set",
        help_de: "die Projekte prüfen, die den Pfad einbetten: Projekte werden mit den Werten geprüft, die sie setzen",
    }
    /// Note: the values of the variables with which the problem occurs.
    WITH_VALUES: VariableValueNotAllowed {
        en: "with {values} in path {name}",
        de: "mit {values} in Pfad {name}",
    }
    /// Note: values of the variables with which the problem occurs, and the number of other combinations with which it occurs.
    WITH_MORE_VALUES: VariableValueNotAllowed {
        en: "with {values} in path {name}, and with {others} more of {all} combinations",
        de: "mit {values} in Pfad {name}, und mit {others} weiteren von {all} Kombinationen",
    }
    /// References that are nested too deeply; they may be cyclic.
    TOO_DEEP: EndlessVariable {
        en: "the value of \"{variable}\" refers to itself, or values refer to others more than {limit} levels deep",
        de: "der Wert von \"{variable}\" verweist auf sich selbst, oder Werte verweisen über mehr als {limit} Stufen auf andere",
        help_en: "remove the circular reference, or replace a long chain of variables with a single value",
        help_de: "den Zirkelbezug auflösen oder eine lange Kette von Variablen durch einen einzigen Wert ersetzen",
    }
}
