//! Messages about reading drawings as DXF, and about their elements. (PB002, PB007, PB008, PB101 to PB121)

messages! {
    /// A path without a start marker.
    MISSING_START: MissingStart {
        en: "path {name} has no start marker",
        de: "Pfad {name} hat keine Anfangsmarke",
        help_en: "draw a PHANTOM circle of 1 mm diameter on layer {layer}, with the path's parameters as text (LibreCAD turns PHANTOM into CONTINUOUS when it saves)",
        help_de: "auf Layer {layer} einen PHANTOM-Kreis von 1 mm Durchmesser zeichnen, mit den Parametern des Pfads als Text (LibreCAD macht beim Speichern aus PHANTOM CONTINUOUS)",
    }
    /// Note: a start marker on a layer without a path.
    START_ON_OTHER_LAYER: MissingStart {
        en: "layer {layer}, which is not a path layer, has a start marker at {point}: is it on the wrong layer?",
        de: "auf Layer {layer}, der kein Pfadlayer ist, liegt bei {point} eine Anfangsmarke: liegt sie auf dem falschen Layer?",
    }
    /// Note: an end marker on a layer without a path.
    END_MARKER_ON_OTHER_LAYER: MissingEnd {
        en: "layer {layer}, which is not a path layer, has an end marker at {point}: is it on the wrong layer?",
        de: "auf Layer {layer}, der kein Pfadlayer ist, liegt bei {point} eine Endmarke: liegt sie auf dem falschen Layer?",
    }
    /// Note: a text with O and T that belongs to no start marker.
    START_TEXT: MissingStart {
        en: "the text \"{text}\" at {point} has O and T: does the start marker belong there?",
        de: "der Text \"{text}\" bei {point} hat O und T: gehört dort die Anfangsmarke hin?",
    }
    /// Note: a text with O and T on another layer.
    START_TEXT_ON_OTHER_LAYER: MissingPathParameters {
        en: "the text \"{text}\" lies here on layer {layer}: move it to the layer of the start marker",
        de: "der Text \"{text}\" liegt hier auf Layer {layer}: auf den Layer der Anfangsmarke legen",
    }
    /// Note: a text with O and T that belongs to another element, or to none.
    START_TEXT_ELSEWHERE: MissingPathParameters {
        en: "the text \"{text}\" has O and T, but belongs to another element or to none, because its middle is at {point}: move it so that its middle lies on the start marker; written in several lines or smaller, it takes less room",
        de: "der Text \"{text}\" hat O und T, gehört aber zu einem anderen Element oder zu keinem, weil seine Mitte bei {point} liegt: so verschieben, dass seine Mitte auf der Anfangsmarke liegt; mehrzeilig oder kleiner geschrieben braucht er weniger Platz",
    }
    /// Note: a text with a path's name on another layer.
    NAME_ON_OTHER_LAYER: MissingSubpathName {
        en: "the text \"{text}\" lies here on layer {layer}: move it to the layer of the subpath",
        de: "der Text \"{text}\" liegt hier auf Layer {layer}: auf den Layer des Unterpfads legen",
    }
    /// Note: a text with a path's name that belongs to another element.
    NAME_OF_OTHER_ELEMENT: MissingSubpathName {
        en: "the text \"{text}\" touches this segment, but belongs to a nearer element, or to a circle or an arc: move it closer to the segment",
        de: "der Text \"{text}\" berührt dieses Segment, gehört aber zu einem näheren Element oder zu einem Kreis oder Bogen: näher ans Segment schieben",
    }
    /// Note: a circle with a start marker's text, but another diameter.
    MEANT_AS_START: MissingStart {
        en: "the circle at {point} has a text with O and T, but its diameter is {diameter} mm; if it is meant as the start marker, draw it with a diameter of 1 mm",
        de: "der Kreis bei {point} hat einen Text mit O und T, sein Durchmesser ist aber {diameter} mm; ist er als Anfangsmarke gemeint, mit 1 mm Durchmesser zeichnen",
    }
    /// Note: an end marker has the text of a start marker, while the path's start marker has no text.
    SWAPPED_MARKERS: MissingPathParameters {
        en: "the circle at {point} has a text with O and T, but is an end marker (2 mm): are the two markers swapped? A start marker has a diameter of 1 mm, an end marker of 2 mm",
        de: "der Kreis bei {point} hat einen Text mit O und T, ist aber eine Endmarke (2 mm): sind die beiden Marken vertauscht? Eine Anfangsmarke hat 1 mm Durchmesser, eine Endmarke 2 mm",
    }
    /// Note: a circle with a start marker's text, but a line type other than PHANTOM.
    MEANT_AS_PHANTOM_START: MissingStart {
        en: "the circle at {point} has a text with O and T, but its line type is not PHANTOM; if it is meant as the start marker, draw it as a PHANTOM circle of 1 mm",
        de: "der Kreis bei {point} hat einen Text mit O und T, sein Linientyp ist aber nicht PHANTOM; ist er als Anfangsmarke gemeint, als PHANTOM-Kreis mit 1 mm zeichnen",
    }
    /// Note: a circle with an end marker's diameter, but a line type other than PHANTOM.
    MEANT_AS_PHANTOM_END: MissingEnd {
        en: "the circle at {point} has a diameter of 2 mm, but its line type is not PHANTOM: is it meant as the end marker?",
        de: "der Kreis bei {point} hat 2 mm Durchmesser, sein Linientyp ist aber nicht PHANTOM: ist er als Endmarke gemeint?",
    }
    /// Note: a circle with a start marker's diameter, but without its text.
    MEANT_AS_END: MissingEnd {
        en: "the circle at {point} has the diameter of a start marker, 1 mm, but no text with O and T; if it is meant as the end marker, draw it with a diameter of 2 mm",
        de: "der Kreis bei {point} hat den Durchmesser einer Anfangsmarke, 1 mm, aber keinen Text mit O und T; ist er als Endmarke gemeint, mit 2 mm Durchmesser zeichnen",
    }
    /// A path without an end marker.
    MISSING_END: MissingEnd {
        en: "path {name} has no end marker",
        de: "Pfad {name} hat keine Endmarke",
        help_en: "draw a PHANTOM circle of 2 mm diameter on layer {layer} where the path ends (LibreCAD turns PHANTOM into CONTINUOUS when it saves)",
        help_de: "auf Layer {layer} einen PHANTOM-Kreis von 2 mm Durchmesser zeichnen, wo der Pfad endet (LibreCAD macht beim Speichern aus PHANTOM CONTINUOUS)",
    }
    /// Note: the end of the last segment that is reached, where an end marker is missing.
    ENDS_HERE: MissingEnd {
        en: "the segments of the path end at {point}: the end marker belongs there",
        de: "die Segmente des Pfads enden bei {point}: dort gehört die Endmarke hin",
    }
    /// A second start marker.
    TWO_STARTS: TwoStarts {
        en: "path {name} has a second start marker; the first is at {first}",
        de: "Pfad {name} hat eine zweite Anfangsmarke; die erste ist bei {first}",
        help_en: "remove one of the two, or move it to another path's layer",
        help_de: "eine davon entfernen oder auf den Layer eines anderen Pfads legen",
    }
    /// A second circle with a start marker's diameter, in a path that has an end marker.
    SECOND_START_WITHOUT_TEXT: TwoStarts {
        en: "path {name} has a second circle with the diameter of a start marker, 1 mm, but without a text with O and T; the start marker is at {first}",
        de: "Pfad {name} hat einen zweiten Kreis mit dem Durchmesser einer Anfangsmarke, 1 mm, aber ohne Text mit O und T; die Anfangsmarke ist bei {first}",
        help_en: "remove it; or, if it is meant as a turn marker, draw it with a diameter of 1.5 mm",
        help_de: "ihn entfernen; oder, wenn er als Wendemarke gemeint ist, mit 1,5 mm Durchmesser zeichnen",
    }
    /// A second end marker.
    TWO_ENDS: TwoEnds {
        en: "path {name} has a second end marker; the first is at {first}",
        de: "Pfad {name} hat eine zweite Endmarke; die erste ist bei {first}",
        help_en: "remove one of the two, or move it to another path's layer; or, if it is meant as a turn marker, draw it with a diameter of 1.5 mm",
        help_de: "eine davon entfernen oder auf den Layer eines anderen Pfads legen; oder, wenn sie als Wendemarke gemeint ist, mit 1,5 mm Durchmesser zeichnen",
    }
    /// A PHANTOM circle with a meaningless diameter.
    UNKNOWN_SPECIAL_CIRCLE: UnknownSpecialCircle {
        en: "a {line_type} circle with a diameter of {diameter} mm has no meaning",
        de: "ein {line_type}-Kreis mit {diameter} mm Durchmesser hat keine Bedeutung",
        help_en: "correct the diameter; PHANTOM: 1 mm start, 1.5 mm turn marker, 2 mm end, 6 mm Z-probe; DASHDOT: 6 mm Z-probe; DOT: 6 mm Z-probe that is left out",
        help_de: "den Durchmesser berichtigen; PHANTOM: 1 mm Anfang, 1,5 mm Wendemarke, 2 mm Ende, 6 mm Z-Probe; DASHDOT: 6 mm Z-Probe; DOT: 6 mm ausgelassene Z-Probe",
    }
    /// A DASHDOT circle that is no Z-probe, perhaps drawn to embed a closed path.
    UNKNOWN_DASHDOT_CIRCLE: UnknownSpecialCircle {
        en: "a {line_type} circle with a diameter of {diameter} mm has no meaning",
        de: "ein {line_type}-Kreis mit {diameter} mm Durchmesser hat keine Bedeutung",
        help_en: "give a Z-probe a diameter of 6 mm; to embed a path that ends where it starts, draw an arc from 270 to 270 degrees instead of the circle",
        help_de: "einer Z-Probe 6 mm Durchmesser geben; um einen Pfad einzubetten, der endet, wo er anfängt, statt des Kreises einen Bogen von 270 bis 270 Grad zeichnen",
    }
    /// A PHANTOM circle that would be a marker in another unit.
    SPECIAL_CIRCLE_IN_OTHER_UNIT: UnknownSpecialCircle {
        en: "a {line_type} circle with a diameter of {diameter} mm has no meaning; times {factor}, it would be {meant} mm: is the drawing in {unit}?",
        de: "ein {line_type}-Kreis mit {diameter} mm Durchmesser hat keine Bedeutung; mal {factor} wären es {meant} mm: ist die Zeichnung in {unit}?",
        help_en: "scale all of the drawing by {factor} in the CAD program (setting its unit to millimetres changes no length); if only this circle is wrong, correct its diameter",
        help_de: "die ganze Zeichnung im CAD mit {factor} skalieren (ihre Einheit auf Millimeter zu stellen ändert keine Länge); ist nur dieser Kreis falsch, seinen Durchmesser berichtigen",
    }
    /// A line type without a meaning.
    UNKNOWN_LINE_TYPE: UnknownLineType {
        en: "line type {line_type} has no meaning on a path layer; elements with it: {count}",
        de: "Linientyp {line_type} hat auf einem Pfadlayer keine Bedeutung; betroffene Elemente: {count}",
        help_en: "use one of {known} (PHANTOM on circles only, DASHED and HIDDEN on lines and arcs only; each also with 2, X2 or TINY added), or define the name under [line-types] in pathbuild.toml",
        help_de: "einen von {known} verwenden (PHANTOM nur bei Kreisen, DASHED und HIDDEN nur bei Linien und Bögen; jeweils auch mit angehängtem 2, X2 oder TINY) oder den Namen unter [line-types] in pathbuild.toml festlegen",
    }
    /// A line type without a meaning, with a suggestion.
    LINE_TYPE_LIKE_ANOTHER: UnknownLineType {
        en: "line type {line_type} has no meaning on a path layer; elements with it: {count}",
        de: "Linientyp {line_type} hat auf einem Pfadlayer keine Bedeutung; betroffene Elemente: {count}",
        help_en: "if it means {like}, add this line under [line-types] in pathbuild.toml: \"{line_type}\" = \"{like}\"",
        help_de: "wenn {like} gemeint ist, unter [line-types] in pathbuild.toml diese Zeile einfügen: \"{line_type}\" = \"{like}\"",
    }
    /// A line type that is meaningless on this kind of entity.
    LINE_TYPE_ON_ENTITY: UnknownLineType {
        en: "line type {line_type} has no meaning on {element}; elements like this: {count}",
        de: "{element} mit Linientyp {line_type} hat keine Bedeutung; Elemente dieser Art: {count}",
        help_en: "on circles, use CONTINUOUS, DIVIDE, BORDER or CENTER, for markers and probes PHANTOM, DASHDOT or DOT; on lines and arcs, use any line type except PHANTOM",
        help_de: "bei Kreisen CONTINUOUS, DIVIDE, BORDER oder CENTER verwenden, für Marken und Proben PHANTOM, DASHDOT oder DOT; bei Linien und Bögen jeden Linientyp außer PHANTOM",
    }
    /// Support bars on a drilled hole.
    BARS_ON_HOLE: UnknownLineType {
        en: "BORDER and CENTER have no meaning on a drilled hole",
        de: "BORDER und CENTER haben bei einem Bohrloch keine Bedeutung",
        help_en: "use CONTINUOUS (down to B) or DIVIDE (down to D): a circle of the cutter's diameter is drilled and leaves no support bars",
        help_de: "CONTINUOUS (bis B) oder DIVIDE (bis D) verwenden: ein Kreis mit dem Durchmesser des Fräsers wird gebohrt und lässt keine Stützstege",
    }
    /// A text that belongs to no element.
    TEXT_WITHOUT_ELEMENT: TextWithoutElement {
        en: "the text \"{text}\" belongs to no element: the circle around the text is at {centre} with a diameter of {diameter} mm",
        de: "der Text \"{text}\" gehört zu keinem Element: der Kreis um den Text liegt bei {centre} mit {diameter} mm Durchmesser",
        help_en: "move the text over its element, so that this circle touches the element; both must be on exactly the same layer",
        help_de: "den Text über sein Element schieben, sodass dieser Kreis das Element berührt; beide müssen auf genau demselben Layer liegen",
    }
    /// An invisible text, consisting only of blanks, that belongs to no element.
    BLANK_TEXT: TextWithoutElement {
        en: "an invisible text that consists only of blanks belongs to no element: the circle around the text is at {centre}",
        de: "ein unsichtbarer Text, der nur aus Leerzeichen besteht, gehört zu keinem Element: der Kreis um den Text liegt bei {centre}",
        help_en: "delete it",
        help_de: "löschen",
    }
    /// A text that would belong to another element if it were moved slightly.
    NEARLY_OTHER_ELEMENT: DoubtfulText {
        en: "the text \"{text}\" belongs to {element} at {point}, but {other} at {other_point} is only {margin} mm farther away",
        de: "zum Text \"{text}\" gehört {element} bei {point}, aber {other} bei {other_point} ist nur {margin} mm weiter entfernt",
        help_en: "move the text nearer to its element, or put both on a tilde layer of their own (the path's name with ~ and letters added); `text-margin` under [warnings] sets the limit",
        help_de: "den Text näher an sein Element schieben oder beide auf einen eigenen Tilde-Layer legen (Name des Pfads, ~ und Buchstaben); `text-margin` unter [warnings] setzt die Grenze",
    }
    /// A text that belongs to an element because circles precede arcs and arcs precede lines, although an element of another kind is
    /// nearer.
    NEARER_OF_OTHER_KIND: DoubtfulText {
        en: "the text \"{text}\" belongs to {element} at {point}, though {other} at {other_point} is {margin} mm nearer: circles come before arcs, arcs before lines",
        de: "zum Text \"{text}\" gehört {element} bei {point}, obwohl {other} bei {other_point} {margin} mm näher ist: Kreise gehen vor Bögen, Bögen vor Linien",
        help_en: "move the text away from the element that it should not belong to, make it smaller, or put text and element on a tilde layer of their own (the path's name with ~ and letters added)",
        help_de: "den Text von dem Element wegschieben, zu dem er nicht gehören soll, oder ihn verkleinern, oder Text und Element auf einen eigenen Tilde-Layer legen (Name des Pfads, ~ und Buchstaben)",
    }
    /// A text inside a circle that takes it from far away, although the text is just beside another element or just beyond its end.
    NEARER_BESIDE_TEXT: DoubtfulText {
        en: "the text \"{text}\" belongs to {element} at {point}, though {other} at {other_point} is {margin} mm nearer: the text is beside that one or beyond its end",
        de: "zum Text \"{text}\" gehört {element} bei {point}, obwohl {other} bei {other_point} {margin} mm näher ist: der Text liegt daneben oder hinter dessen Ende",
        help_en: "move the text onto its element: to a circle, at its centre or on its edge",
        help_de: "den Text auf sein Element schieben: bei einem Kreis in dessen Mitte oder auf dessen Rand",
    }
    /// A text that is equally near to two elements, and belongs to the first of them in the file.
    FIRST_OF_EQUALS: DoubtfulText {
        en: "the text \"{text}\" is as near to {other} at {other_point} as to {element} at {point}; it belongs to the latter only because the file lists that one first",
        de: "zum Text \"{text}\" gehört {element} bei {point} nur wegen der Reihenfolge in der Datei: {other} bei {other_point} ist genauso nah",
        help_en: "move the text nearer to its element, or put both on a tilde layer of their own (the path's name with ~ and letters added)",
        help_de: "den Text näher an sein Element schieben oder beide auf einen eigenen Tilde-Layer legen (Name des Pfads, ~ und Buchstaben)",
    }
    /// A text whose nearest element has another text, so that it belongs to an element farther away.
    NEARER_HAS_A_TEXT: DoubtfulText {
        en: "the text \"{text}\" belongs to {element} at {point}, though {other} at {other_point} is {margin} mm nearer: that one already has the text \"{other_text}\"",
        de: "zum Text \"{text}\" gehört {element} bei {point}, obwohl {other} bei {other_point} {margin} mm näher ist: dort gibt es schon den Text \"{other_text}\"",
        help_en: "write all letters of an element into one text; if the element is the right one, move the text nearer to it, or put both on a tilde layer of their own (the path's name with ~ and letters added)",
        help_de: "alle Buchstaben eines Elements in einen Text schreiben; ist das Element das richtige, den Text näher daran schieben oder beide auf einen eigenen Tilde-Layer legen (Name des Pfads, ~ und Buchstaben)",
    }
    /// A text that is nearer to an element on another layer of the same path.
    NEARER_ON_OTHER_LAYER: DoubtfulText {
        en: "the text \"{text}\" belongs to {element} at {point}, though {other} at {other_point} on layer {layer} is {margin} mm nearer",
        de: "zum Text \"{text}\" gehört {element} bei {point}, obwohl {other} bei {other_point} auf Layer {layer} {margin} mm näher ist",
        help_en: "move the text to layer {layer}, or away from the element there: text and element must be on exactly the same layer",
        help_de: "den Text auf Layer {layer} legen oder von dem Element dort wegschieben: Text und Element müssen auf genau demselben Layer liegen",
    }
    /// A text with formatting that moves its letters by an unknown distance.
    PLACE_UNKNOWN: DoubtfulText {
        en: "the text \"{text}\" belongs to {element} at {point}, but has {reason} and may be shown in another place",
        de: "zum Text \"{text}\" gehört {element} bei {point}; er hat {reason} und wird vielleicht an anderer Stelle angezeigt",
        help_en: "remove this formatting from the text in the CAD program, or write it as a new text without formatting",
        help_de: "diese Formatierung im CAD aus dem Text entfernen oder ihn ohne Formatierung neu schreiben",
    }
    /// Note: the text lies on a HIDDEN line or arc.
    HIDDEN_TAKES_NO_TEXT: TextWithoutElement {
        en: "the HIDDEN element at {point}, which the text lies on, takes no text: draw it DASHED to give it N or S, or DASHDOT to embed a path with >",
        de: "das Element mit Linientyp HIDDEN bei {point}, auf dem der Text liegt, nimmt keinen Text an: für N und S als DASHED zeichnen, zum Einbetten mit > als DASHDOT",
    }
    /// Note: the text lies on the end marker.
    END_TAKES_NO_TEXT: TextWithoutElement {
        en: "the end marker at {point}, which the text lies on, takes no text",
        de: "die Endmarke bei {point}, auf der der Text liegt, nimmt keinen Text an",
    }
    /// Note: the text lies on a turn marker.
    TURN_TAKES_NO_TEXT: TextWithoutElement {
        en: "the turn marker at {point}, which the text lies on, takes no text",
        de: "die Wendemarke bei {point}, auf der der Text liegt, nimmt keinen Text an",
    }
    /// Note: the nearest element.
    NEAREST_ELEMENT: TextWithoutElement {
        en: "the nearest element is {element} at {point}, {distance} mm away from the text's circle",
        de: "das nächste Element ist {element} bei {point}, {distance} mm vom Kreis des Textes entfernt",
    }
    /// Note: a nearby element that already has another text.
    HAS_A_TEXT: TextWithoutElement {
        en: "{element} at {point} already has a text: write all letters into one text",
        de: "{element} bei {point} hat schon einen Text: alle Buchstaben in einen Text schreiben",
    }
    /// Note: a nearby element that already has the same text.
    HAS_SAME_TEXT: TextWithoutElement {
        en: "{element} at {point} already has the same text: delete one of the two",
        de: "{element} bei {point} hat schon den gleichen Text: einen der beiden löschen",
    }
    /// Note: a nearby part of a polyline that already has a text.
    POLYLINE_HAS_A_TEXT: TextWithoutElement {
        en: "{element} at {point} is part of a polyline, which already has a text: explode the polyline if its parts need different texts",
        de: "{element} bei {point} gehört zu einer Polylinie, die schon einen Text hat: die Polylinie auflösen, wenn ihre Teile verschiedene Texte brauchen",
    }
    /// Note: a nearby element that already has a text of blanks.
    HAS_A_BLANK_TEXT: TextWithoutElement {
        en: "{element} at {point} already has an invisible text that consists only of blanks: delete that text",
        de: "{element} bei {point} hat schon einen unsichtbaren Text, der nur aus Leerzeichen besteht: diesen Text löschen",
    }
    /// Note: the first entity of the path that is left out (PB111). A text on such an entity has no element.
    TEXT_OF_LEFT_OUT: TextWithoutElement {
        en: "{kind} at {point} is left out (PB111), so its text belongs to no element",
        de: "{kind} bei {point} wird ausgelassen (PB111); der Text gehört daher zu keinem Element",
    }
    /// Note: an element near the text, but on another layer.
    NEAR_ON_OTHER_LAYER: TextWithoutElement {
        en: "on layer {layer}, {element} is {distance} mm away from the text's circle: are the two on different layers by mistake?",
        de: "auf Layer {layer} liegt {element} {distance} mm vom Kreis des Textes entfernt: liegen beide versehentlich auf verschiedenen Layern?",
    }
    /// Note: an element on another layer to which the text would belong if it were on that layer.
    ELEMENT_ON_OTHER_LAYER: TextWithoutElement {
        en: "on layer {layer}, the text would belong to {element} at {point}",
        de: "auf Layer {layer} würde {element} bei {point} zum Text gehören",
    }
    /// A circle smaller than the cutter.
    CIRCLE_TOO_SMALL: CircleTooSmall {
        en: "the circle's diameter of {diameter} mm is smaller than the cutter's, O{tool}",
        de: "der Kreisdurchmesser {diameter} mm ist kleiner als der des Fräsers, O{tool}",
        help_en: "draw the circle with the cutter's diameter to drill a hole, or larger to mill it along a helix",
        help_de: "den Kreis zum Bohren mit dem Durchmesser des Fräsers zeichnen, größer zum Fräsen auf einer Helix",
    }
    /// A circle only slightly larger than the cutter.
    NEARLY_DRILLED: NearlyDrilled {
        en: "the circle's diameter of {diameter} mm is only {difference} mm larger than the cutter's, O{tool}: the circle is not drilled, but milled along a helix of {radius} mm radius",
        de: "der Kreisdurchmesser {diameter} mm ist nur {difference} mm größer als der des Fräsers, O{tool}: der Kreis wird nicht gebohrt, sondern auf einer Helix von {radius} mm Radius gefräst",
        help_en: "draw it with a diameter of {tool} mm to drill it; `hole-margin` under [warnings] sets the limit",
        help_de: "zum Bohren mit {tool} mm Durchmesser zeichnen; `hole-margin` unter [warnings] setzt die Grenze",
    }
    /// A parameter text on a layer without a path.
    TEXT_ON_OTHER_LAYER: TextOnOtherLayer {
        en: "the text \"{text}\" has no effect: layer {layer} belongs to no path",
        de: "der Text \"{text}\" hat keine Wirkung: Layer {layer} gehört zu keinem Pfad",
        help_en: "move it over {element} at {point}, on layer {path_layer}; if it is a remark, move it away from the element",
        help_de: "über das Element ({element} bei {point}) auf Layer {path_layer} legen; ist er eine Bemerkung, vom Element wegschieben",
    }
    /// A parameter text in a multileader or dimension.
    LABEL_WITHOUT_EFFECT: TextOnOtherLayer {
        en: "the text \"{text}\" of this {entity} has no effect: only a TEXT or MTEXT gives parameters",
        de: "der Text \"{text}\" des Objekts {entity} hat keine Wirkung: nur TEXT und MTEXT geben Parameter an",
        help_en: "write it as a text over its element, on the layer of the element; if it is a remark, add words, so that it does not look like parameters",
        help_de: "als Text über das Element schreiben, auf dessen Layer; ist er eine Bemerkung, Wörter ergänzen, damit er nicht wie Parameter aussieht",
    }
    /// A Z-probe on a layer without a path.
    PROBE_ON_OTHER_LAYER: TextOnOtherLayer {
        en: "the circle of 6 mm at {point} with the text \"{text}\" is not a probe: layer {layer} belongs to no path",
        de: "der Kreis von 6 mm bei {point} mit dem Text \"{text}\" ist keine Probe: Layer {layer} gehört zu keinem Pfad",
        help_en: "move circle and text to the layer of the path; if the text is a remark, move it off the circle",
        help_de: "Kreis und Text auf den Layer des Pfads legen; ist der Text eine Bemerkung, vom Kreis wegschieben",
    }
    /// A text on a layer without clamps that looks like the height of a clamp.
    HEIGHT_ON_OTHER_LAYER: TextOnOtherLayer {
        en: "the text \"{text}\" looks like the height of a clamp, but `keep-out` does not match layer {layer}: nothing on it is a clamp",
        de: "der Text \"{text}\" sieht aus wie die Höhe eines Spannmittels, `keep-out` passt aber nicht auf Layer {layer}: nichts darauf ist ein Spannmittel",
        help_en: "move the clamp to a layer that matches `keep-out`, or extend `keep-out` to match this layer; if there is no clamp, reword the text",
        help_de: "das Spannmittel auf einen Layer legen, auf den `keep-out` passt, oder `keep-out` um diesen Layer erweitern; ist es kein Spannmittel, den Text anders schreiben",
    }
    /// A layer with a name similar to that of a layer with clamps.
    NEARLY_CLAMP_LAYER: NearlyPathLayer {
        en: "layer {layer} does not match `keep-out`, although a very similar name would: nothing on it is treated as a clamp ({elements})",
        de: "`keep-out` passt nicht auf Layer {layer}, wohl aber auf einen sehr ähnlichen Namen: nichts darauf gilt als Spannmittel ({elements})",
        help_en: "rename the layer, or extend `keep-out` (a regular expression for the whole name, such as 'Clamps.*'); if there are no clamps on the layer, give it a clearly different name",
        help_de: "den Layer umbenennen oder `keep-out` erweitern (ein regulärer Ausdruck für den ganzen Namen, etwa 'Clamps.*'); enthält der Layer keine Spannmittel, ihm einen deutlich anderen Namen geben",
    }
    /// A layer with a name similar to that of a layer with finished parts.
    NEARLY_PART_LAYER: NearlyPathLayer {
        en: "layer {layer} does not match `part`, although a very similar name would: nothing on it is treated as a finished part ({elements})",
        de: "`part` passt nicht auf Layer {layer}, wohl aber auf einen sehr ähnlichen Namen: nichts darauf gilt als fertiges Teil ({elements})",
        help_en: "rename the layer, or extend `part` (a regular expression for the whole name); if there are no finished parts on the layer, give it a clearly different name",
        help_de: "den Layer umbenennen oder `part` erweitern (ein regulärer Ausdruck für den ganzen Namen); enthält der Layer keine fertigen Teile, ihm einen deutlich anderen Namen geben",
    }
    /// A layer with a name similar to that of a path layer.
    NEARLY_PATH_LAYER: NearlyPathLayer {
        en: "layer {layer} belongs to no path, but its name resembles that of path {path}: what is drawn on it has no effect ({elements})",
        de: "Layer {layer} gehört zu keinem Pfad, heißt aber fast wie der Pfad {path}: was darauf liegt, hat keine Wirkung ({elements})",
        help_en: "rename it to {path}, or to {path}~A (only letters after ~); if nothing on it is to be milled, give it a clearly different name",
        help_de: "in {path} umbenennen oder in {path}~A (hinter ~ nur Buchstaben); soll nichts darauf gefräst werden, dem Layer einen deutlich anderen Namen geben",
    }
    /// Note: a character of another alphabet in a layer's name.
    LOOK_ALIKE_IN_NAME: NearlyPathLayer {
        en: "\"{character}\" ({code}) in the name of the layer only looks like \"{plain}\"",
        de: "\"{character}\" ({code}) im Namen des Layers sieht nur aus wie \"{plain}\"",
    }
    /// A milled line of length zero.
    CUT_WITHOUT_LENGTH: LeftoverElement {
        en: "this line has no length: the cutter plunges here without milling anything",
        de: "diese Linie hat keine Länge: der Fräser taucht hier ein und fräst nichts",
        help_en: "delete it; to drill here, draw a circle of the cutter's diameter",
        help_de: "löschen; um hier zu bohren, einen Kreis mit dem Durchmesser des Fräsers zeichnen",
    }
    /// A sweep of length zero.
    SWEEP_WITHOUT_LENGTH: LeftoverElement {
        en: "this sweep has no length and no effect",
        de: "diese Leerfahrt hat keine Länge und keine Wirkung",
        help_en: "delete it",
        help_de: "löschen",
    }
    /// A circle drawn on top of another.
    CIRCLE_TWICE: LeftoverElement {
        en: "a circle of {diameter} mm diameter is drawn twice here: if it is larger than the cutter, it is milled twice; a text belongs to only one of the two",
        de: "hier ist ein Kreis von {diameter} mm Durchmesser doppelt gezeichnet: ist er größer als der Fräser, wird er zweimal gefräst; ein Text gehört nur zu einem der beiden",
        help_en: "delete one of the two",
        help_de: "einen der beiden löschen",
    }
    /// A milled line or arc drawn on top of another.
    CURVE_TWICE: LeftoverElement {
        en: "{element} at {point} is drawn twice: it is milled twice, and a text belongs to only one of the two",
        de: "{element} bei {point} ist doppelt gezeichnet: hier wird zweimal gefräst, und ein Text gehört nur zu einem der beiden",
        help_en: "delete one of the two; if the tool is to come back along it, draw a turn marker at its end (a PHANTOM circle of 1.5 mm)",
        help_de: "eines der beiden löschen; soll der Fräser darauf zurückkommen, am Ende eine Wendemarke zeichnen (PHANTOM-Kreis mit 1,5 mm)",
    }
    /// Several milled lines and arcs drawn on top of others.
    CURVES_TWICE: LeftoverElement {
        en: "lines and arcs that are drawn twice: {count}, the first at {point}",
        de: "doppelt gezeichnete Linien und Bögen: {count}, zuerst bei {point}",
        help_en: "delete the copies; if all of the path is there twice, it was probably pasted twice",
        help_de: "die Kopien löschen; ist alles doppelt, wurde der Pfad wahrscheinlich zweimal eingefügt",
    }
    /// A milled line or arc drawn on top of another of a different line type.
    CURVE_TWICE_OTHERWISE: LeftoverElement {
        en: "{element} at {point} is drawn twice, as {one} and as {other}: the deeper cut removes the mark or the support bars of the other",
        de: "{element} bei {point} ist doppelt gezeichnet, als {one} und als {other}: der tiefere Schnitt entfernt die Markierung oder die Stützstege des anderen",
        help_en: "delete one of the two; if both are wanted, give each a text, and order them with N",
        help_de: "eines der beiden löschen; sind beide gewollt, jedem einen Text geben und sie mit N ordnen",
    }
    /// A path that is embedded twice by segments on top of each other.
    SUBPATH_TWICE: LeftoverElement {
        en: "path {path} is embedded twice, by two segments on top of each other: it is milled twice here",
        de: "Pfad {path} ist doppelt eingebettet, durch zwei aufeinanderliegende Segmente: er wird hier zweimal gefräst",
        help_en: "delete one of the two segments, or move it to where the second one belongs",
        help_de: "eines der beiden Segmente löschen oder dorthin schieben, wo das zweite Teil hingehört",
    }
    /// Two probes at one place.
    PROBE_TWICE: LeftoverElement {
        en: "there is another probe at this place: it is measured twice",
        de: "an dieser Stelle liegt noch eine Probe: hier wird zweimal gemessen",
        help_en: "delete one of the two",
        help_de: "eine der beiden löschen",
    }
    /// A polyline or spline with all points in one place.
    CURVE_WITHOUT_LENGTH: LeftoverElement {
        en: "{entity} has no length: all of its points coincide, so it draws nothing",
        de: "{entity} hat keine Länge: alle Punkte fallen zusammen, sodass nichts zu sehen ist",
        help_en: "delete it, or draw it again",
        help_de: "löschen oder neu zeichnen",
    }
    /// A milled line or arc that is so short that the cutter hardly mills anything.
    CUT_HARDLY_LONG: LeftoverElement {
        en: "{element} here is only {length} mm long: the cutter plunges and mills hardly anything",
        de: "hier ist {element} nur {length} mm lang: der Fräser taucht ein und fräst fast nichts",
        help_en: "delete it and join its neighbours; as long as it is there, it is milled with its own depth or that of the path",
        help_de: "löschen und die Nachbarn verbinden; solange es da ist, gilt hier die Tiefe aus dem eigenen Text oder die des Pfads",
    }
    /// An element outside of the XY plane.
    OFF_PLANE: OffPlane {
        en: "the element is not in the drawing plane: Z is {z} mm; elements outside of the plane: {count}",
        de: "das Element liegt nicht in der Zeichenebene: Z ist {z} mm; Elemente außerhalb der Ebene: {count}",
        help_en: "flatten the drawing (in many CAD programs: FLATTEN, or set Z and elevation to 0); depths are given by texts, never by Z coordinates",
        help_de: "die Zeichnung einebnen (in vielen CAD-Programmen: FLATTEN, oder Z und Erhebung auf 0 setzen); Tiefen werden mit Texten angegeben, nie mit Z-Koordinaten",
    }
    /// A path layer that is frozen or off.
    LAYER_NOT_VISIBLE: LayerNotVisible {
        en: "layer {layer} is frozen or off, but its path is still used",
        de: "Layer {layer} ist gefroren oder ausgeschaltet, sein Pfad gilt trotzdem",
        help_en: "make it visible, or rename it if the path is no longer needed",
        help_de: "sichtbar machen oder umbenennen, wenn der Pfad nicht mehr gebraucht wird",
    }
    /// A turn marker at which the path does not turn back.
    TURN_WITHOUT_EFFECT: TurnMarkerWithoutEffect {
        en: "this turn marker has no effect",
        de: "diese Wendemarke hat keine Wirkung",
        help_en: "remove it, or move it to the tip of a dead end, where no segment continues although others are left",
        help_de: "entfernen oder an die Spitze einer Sackgasse setzen, wo kein Segment weiterführt, obwohl noch welche übrig sind",
    }
    /// Ends that nearly meet and were joined.
    JOINED_ENDS: JoinedEnds {
        en: "two ends {distance} mm apart were joined",
        de: "zwei Enden im Abstand von {distance} mm wurden verbunden",
        help_en: "snap one end to the other with the CAD's object snap; until then, join-tolerance in pathbuild.toml allows the gap",
        help_de: "das eine Ende mit dem Objektfang des CAD auf das andere setzen; join-tolerance in pathbuild.toml erlaubt die Lücke bis dahin",
    }
    /// A layer with clamps that is frozen or off.
    CLAMPS_NOT_VISIBLE: LayerNotVisible {
        en: "a layer with clamps is frozen or off, but its clamps still apply",
        de: "ein Layer mit Spannmitteln ist gefroren oder ausgeschaltet, die Spannmittel gelten trotzdem",
        help_en: "make it visible, or move clamps that no longer exist to a layer that `keep-out` does not match",
        help_de: "sichtbar machen oder Spannmittel, die es nicht mehr gibt, auf einen Layer legen, auf den `keep-out` nicht passt",
    }
    /// A layer with parts that is frozen or off.
    PART_NOT_VISIBLE: LayerNotVisible {
        en: "layer {layer} is frozen or off, but paths are still compared with the parts on it",
        de: "Layer {layer} ist gefroren oder ausgeschaltet, die Pfade werden trotzdem mit den Teilen darauf verglichen",
        help_en: "make it visible, or move outlines that no longer count to a layer that `part` does not match",
        help_de: "sichtbar machen oder Umrisse, die nicht mehr gelten, auf einen Layer legen, auf den `part` nicht passt",
    }
    /// An open outline of a clamp.
    OUTLINE_OPEN: InvalidKeepOut {
        en: "the outline of a clamp is not closed: it ends at {point} and at {other}, {distance} mm apart",
        de: "der Umriss eines Spannmittels ist nicht geschlossen: er endet bei {point} und bei {other}, {distance} mm auseinander",
        help_en: "draw a circle, a closed polyline, or lines and arcs whose ends meet all around; use the CAD's object snap to join them",
        help_de: "einen Kreis, eine geschlossene Polylinie oder Linien und Bögen zeichnen, deren Enden sich rundum treffen; der Objektfang im CAD verbindet sie",
    }
    /// A point at which more than two curves of outlines of clamps end.
    OUTLINE_BRANCHES: InvalidKeepOut {
        en: "more than two lines or arcs of clamps meet at {point}: it is not clear what is inside",
        de: "bei {point} treffen sich mehr als zwei Linien oder Bögen von Spannmitteln: was innen liegt, ist nicht eindeutig",
        help_en: "delete duplicates; draw clamps that touch as separate closed polylines",
        help_de: "doppelt Gezeichnetes löschen; Spannmittel, die sich berühren, als getrennte geschlossene Polylinien zeichnen",
    }
    /// A clamp without a height.
    CLAMP_WITHOUT_TEXT: InvalidKeepOut {
        en: "no text gives the height of this clamp",
        de: "kein Text gibt die Höhe dieses Spannmittels an",
        help_en: "put a text such as Z25 (mm above the plate) inside the outline, on the same layer",
        help_de: "einen Text wie Z25 (mm über der Platte) in den Umriss setzen, auf demselben Layer",
    }
    /// A clamp with several texts.
    CLAMP_WITH_TEXTS: InvalidKeepOut {
        en: "several texts are inside the outline of this clamp or overlap it: {texts}",
        de: "mehrere Texte liegen im Umriss dieses Spannmittels oder überlappen ihn: {texts}",
        help_en: "leave only the text with the height: make texts smaller, move them apart, or move mere notes to another layer",
        help_de: "nur den Text mit der Höhe dort lassen: Texte verkleinern, auseinanderschieben oder bloße Notizen auf einen anderen Layer legen",
    }
    /// A text inside a clamp that does not give a height.
    NO_CLAMP_HEIGHT: InvalidKeepOut {
        en: "the text \"{text}\" does not give the height of this clamp",
        de: "der Text \"{text}\" gibt die Höhe dieses Spannmittels nicht an",
        help_en: "write Z and the height above the plate in mm, greater than 0, and nothing else: Z25",
        help_de: "Z und die Höhe über der Platte in mm schreiben, größer als 0, und sonst nichts: Z25",
    }
    /// A text inside a clamp with a space that does not separate.
    CLAMP_WITH_SPECIAL_SPACE: InvalidKeepOut {
        en: "the text \"{text}\" does not give the height of this clamp: \u{2423} is a special space, which separates nothing",
        de: "der Text \"{text}\" gibt die Höhe dieses Spannmittels nicht an: \u{2423} ist ein besonderes Leerzeichen und trennt nicht",
        help_en: "type Z and the height above the plate in mm, and nothing else: Z25",
        help_de: "nur Z und die Höhe über der Platte in mm schreiben: Z25",
    }
    /// A clamp that is hardly higher than the plate.
    LOW_CLAMP: DoubtfulValue {
        en: "this clamp is only {height} mm high",
        de: "dieses Spannmittel ist nur {height} mm hoch",
        help_en: "check the decimal point: Z is the height of the clamp above the plate in mm, as in Z25",
        help_de: "den Dezimalpunkt prüfen: Z ist die Höhe des Spannmittels über der Platte in mm, wie in Z25",
    }
    /// A text on a layer with clamps that belongs to no clamp.
    TEXT_OUTSIDE_CLAMPS: InvalidKeepOut {
        en: "the text \"{text}\" is on a layer with clamps, but neither inside an outline nor overlapping one",
        de: "der Text \"{text}\" ist auf einem Layer mit Spannmitteln, liegt aber in keinem Umriss und überlappt keinen",
        help_en: "move it into the outline whose height it gives, or to another layer",
        help_de: "in den Umriss schieben, dessen Höhe er angibt, oder auf einen anderen Layer legen",
    }
    /// A curve, block or hatch on a layer with clamps that is left out.
    NO_OUTLINE: InvalidKeepOut {
        en: "this {entity} on a layer with clamps is not read, so the position of the clamp is unknown",
        de: "{entity} auf einem Layer mit Spannmitteln wird nicht gelesen; die Lage des Spannmittels ist daher unbekannt",
        help_en: "draw the outline with lines, arcs, a circle or a closed polyline; ellipses and splines are read if `approximate-curves` is set in pathbuild.toml, blocks if the file contains them and they have the same scale in x and y",
        help_de: "den Umriss mit Linien, Bögen, einem Kreis oder einer geschlossenen Polylinie zeichnen; Ellipsen und Splines werden gelesen, wenn `approximate-curves` in pathbuild.toml gesetzt ist, Blöcke, wenn die Datei sie enthält und sie in x und y denselben Maßstab haben",
    }
    /// A block that is inserted on a layer with clamps, but draws only on other layers.
    CLAMP_ELSEWHERE: InvalidKeepOut {
        en: "block {block} is inserted on a layer with clamps, but its contents lie on other layers ({layers}), so the position of the clamp is unknown",
        de: "Block {block} ist auf einem Layer mit Spannmitteln eingefügt, sein Inhalt liegt aber auf anderen Layern ({layers}); die Lage des Spannmittels ist daher unbekannt",
        help_en: "move the block's contents to layer 0 in the block editor, or explode the block and move its contents to this layer; if the block is no clamp, insert it on another layer",
        help_de: "den Inhalt des Blocks im Blockeditor auf Layer 0 legen oder den Block auflösen und den Inhalt auf diesen Layer legen; ist der Block kein Spannmittel, ihn auf einem anderen Layer einfügen",
    }
    /// An attribute of a block on a layer with clamps, which is not read as a height.
    NO_HEIGHT_TEXT: InvalidKeepOut {
        en: "this {entity} on a layer with clamps is not read, so the height of the clamp may be unknown",
        de: "{entity} auf einem Layer mit Spannmitteln wird nicht gelesen; die Höhe des Spannmittels ist daher vielleicht unbekannt",
        help_en: "write the height as TEXT or MTEXT, in the block or over it, for example Z25; if an attribute of the block gives the height, explode the block",
        help_de: "die Höhe als TEXT oder MTEXT schreiben, im Block oder darüber, zum Beispiel Z25; steht die Höhe in einem Attribut des Blocks, den Block auflösen",
    }
    /// A clamp with too many texts to list all of them.
    CLAMP_WITH_MANY_TEXTS: InvalidKeepOut {
        en: "{count} texts are inside the outline of this clamp or overlap it; the first are {texts}",
        de: "{count} Texte liegen im Umriss dieses Spannmittels oder überlappen ihn; die ersten sind {texts}",
        help_en: "leave only the text with the height: make texts smaller, move them apart, or move mere notes to another layer",
        help_de: "nur den Text mit der Höhe dort lassen: Texte verkleinern, auseinanderschieben oder bloße Notizen auf einen anderen Layer legen",
    }
    /// A search for the elements of texts that was stopped after too many comparisons.
    TEXTS_IN_A_CROWD: LimitReached {
        en: "there are too many elements around the texts of this path: the search for the element of each text was stopped after {limit} comparisons",
        de: "um die Texte dieses Pfads liegen zu viele Elemente: die Suche nach dem Element jedes Textes wurde nach {limit} Vergleichen abgebrochen",
        help_en: "make the texts smaller, or move them away from elements that they do not belong to",
        help_de: "die Texte verkleinern oder von Elementen wegschieben, zu denen sie nicht gehören",
    }
    /// A line at which a group code is expected, but that contains something else.
    BAD_GROUP_CODE: InvalidDxf {
        en: "expected a group code here, not \"{found}\"",
        de: "hier wird ein Gruppencode erwartet, nicht \"{found}\"",
        help_en: "save the drawing again: a line was lost, or a text holds a line break, so that codes and values are out of step from here on",
        help_de: "die Zeichnung noch einmal speichern: eine Zeile fehlt, oder ein Text enthält einen Zeilenumbruch, sodass ab hier Codes und Werte nicht zusammenpassen",
    }
    /// A file that ends inside a section.
    TRUNCATED: InvalidDxf {
        en: "the file is cut off in section {section}",
        de: "die Datei bricht im Abschnitt {section} ab",
        help_en: "save the drawing again; perhaps the CAD is still writing it, or it was copied only in part",
        help_de: "die Zeichnung noch einmal speichern; vielleicht schreibt das CAD noch, oder sie wurde nur teilweise kopiert",
    }
    /// A file that ends before its ENTITIES section.
    NO_ENTITIES: InvalidDxf {
        en: "the file ends before its ENTITIES section",
        de: "die Datei endet vor ihrem Abschnitt ENTITIES",
        help_en: "save the drawing again; perhaps the CAD is still writing it, or it was copied only in part",
        help_de: "die Zeichnung noch einmal speichern; vielleicht schreibt das CAD noch, oder sie wurde nur teilweise kopiert",
    }
    /// A section that is not closed by ENDSEC.
    SECTION_NOT_ENDED: InvalidDxf {
        en: "section {section} has no end: ENDSEC is missing before \"{found}\"",
        de: "der Abschnitt {section} hat kein Ende: vor \"{found}\" fehlt ENDSEC",
        help_en: "save the drawing again; the file is damaged",
        help_de: "die Zeichnung noch einmal speichern; die Datei ist beschädigt",
    }
    /// Content between two sections, where only a section or the end of the file may begin.
    SECTION_EXPECTED: InvalidDxf {
        en: "expected a section or the end of the file here, not \"{found}\"",
        de: "hier wird ein Abschnitt oder das Ende der Datei erwartet, nicht \"{found}\"",
        help_en: "save the drawing again; the file is damaged",
        help_de: "die Zeichnung noch einmal speichern; die Datei ist beschädigt",
    }
    /// A section that follows ENTITIES, although it is only read before ENTITIES.
    SECTION_MISPLACED: InvalidDxf {
        en: "the section {found} comes after ENTITIES, where its contents would be ignored",
        de: "auf den Abschnitt ENTITIES folgt ein Abschnitt {found}; sein Inhalt würde nicht beachtet",
        help_en: "open the drawing in a CAD program and save it again: the order is HEADER, TABLES, BLOCKS, ENTITIES, each at most once",
        help_de: "die Zeichnung in einem CAD-Programm öffnen und neu speichern: die Reihenfolge ist HEADER, TABLES, BLOCKS, ENTITIES, jeder Abschnitt höchstens einmal",
    }
    /// A section that comes twice.
    SECTION_TWICE: InvalidDxf {
        en: "this is a second section {found}; only one is allowed",
        de: "dies ist ein zweiter Abschnitt {found}; erlaubt ist nur einer",
        help_en: "open the drawing in a CAD program and save it again",
        help_de: "die Zeichnung in einem CAD-Programm öffnen und neu speichern",
    }
    /// A group of an entity with something other than a number as its value.
    VALUE_NOT_A_NUMBER: InvalidDxf {
        en: "{entity}: group {code} must be a number, not \"{value}\"",
        de: "{entity}: Gruppe {code} muss eine Zahl sein, nicht \"{value}\"",
        help_en: "draw the entity again, or save the drawing again; the program that wrote the file wrote a broken entity",
        help_de: "das Element neu zeichnen oder die Zeichnung noch einmal speichern; das Programm, von dem die Datei stammt, hat das Element fehlerhaft geschrieben",
    }
    /// A number with a decimal comma in a DXF file.
    DECIMAL_COMMA: InvalidDxf {
        en: "{entity}: \"{value}\" in group {code} has a decimal comma, but DXF numbers need a point",
        de: "{entity}: \"{value}\" in Gruppe {code} hat ein Dezimalkomma, DXF-Zahlen brauchen aber einen Punkt",
        help_en: "set the decimal separator of the system to a point, and save the drawing again; the program that wrote the file uses the system's number format",
        help_de: "im System den Punkt als Dezimalzeichen einstellen und die Zeichnung neu speichern; das Programm, von dem die Datei stammt, verwendet das Zahlenformat des Systems",
    }
    /// A number that is not finite, such as nan, inf or 1e400.
    NUMBER_NOT_FINITE: InvalidDxf {
        en: "{entity}: \"{value}\" in group {code} is not a finite number",
        de: "{entity}: \"{value}\" in Gruppe {code} ist keine endliche Zahl",
        help_en: "draw the entity again; the program that wrote the file wrote a broken entity",
        help_de: "das Element neu zeichnen; das Programm, von dem die Datei stammt, hat es fehlerhaft geschrieben",
    }
    /// An entity that lacks a required group.
    GROUP_MISSING: InvalidDxf {
        en: "{entity}: group {code} is missing",
        de: "{entity}: Gruppe {code} fehlt",
        help_en: "draw the entity again, or save the drawing again; the entity is incomplete",
        help_de: "das Element neu zeichnen oder die Zeichnung noch einmal speichern; das Element ist unvollständig",
    }
    /// A polyline with more or fewer vertices than it states.
    VERTEX_COUNT: InvalidDxf {
        en: "{entity}: group 90 says that there are {stated} vertices, but there are {found}",
        de: "{entity}: laut Gruppe 90 hat die Polylinie {stated} Stützpunkte, es sind aber {found}",
        help_en: "draw the polyline again: an editor or a transfer may have lost vertices",
        help_de: "die Polylinie neu zeichnen: ein Editor oder eine Übertragung hat womöglich Stützpunkte verloren",
    }
    /// A length of an entity that is 0 or negative.
    NOT_POSITIVE: InvalidDxf {
        en: "{entity}: \"{value}\" in group {code} must be greater than 0",
        de: "{entity}: \"{value}\" in Gruppe {code} muss größer als 0 sein",
        help_en: "delete the entity or draw it again; it has no extent",
        help_de: "das Element löschen oder neu zeichnen; es hat keine Ausdehnung",
    }
    /// A coordinate or length that is too large, or a length of zero.
    TOO_LARGE: InvalidDxf {
        en: "{entity} lies or reaches more than 1,000,000 mm from the origin, or its size is 0; elements of this layer with such a problem: {count}",
        de: "{entity} liegt mehr als 1.000.000 mm vom Nullpunkt entfernt, reicht so weit oder hat die Größe 0; Elemente dieses Layers mit einem solchen Problem: {count}",
        help_en: "draw near the origin, at true size: if the whole drawing lies far away (world coordinates), move it; otherwise move the entity or its block, or delete the entity",
        help_de: "nahe am Nullpunkt und in wahrer Größe zeichnen: liegt die ganze Zeichnung so weit entfernt (Weltkoordinaten), sie verschieben; sonst das Element oder seinen Block verschieben oder das Element löschen",
    }
    /// An extrusion direction other than (0,0,1) and (0,0,-1).
    TILTED: OffPlane {
        en: "{entity} lies in a tilted plane",
        de: "{entity} liegt in einer gekippten Ebene",
        help_en: "draw it in the plane of the drawing: in the world coordinate system, with an extrusion of 0,0,1",
        help_de: "in der Zeichenebene zeichnen: im Weltkoordinatensystem, mit der Extrusion 0,0,1",
    }
    /// A file that does not end with EOF.
    NO_END_OF_FILE: NoEndOfFile {
        en: "the file does not end with EOF",
        de: "die Datei endet nicht mit EOF",
        help_en: "save the drawing again; the entities were read, but perhaps the CAD is still writing the file",
        help_de: "die Zeichnung noch einmal speichern; die Elemente wurden gelesen, aber vielleicht schreibt das CAD die Datei noch",
    }
    /// Bytes of a text that are invalid in the encoding of the file.
    UNDECODABLE: DoubtfulEncoding {
        en: "the file is in {encoding}, in which some bytes of this text are invalid",
        de: "die Datei ist in {encoding} kodiert; einige Bytes dieses Textes sind darin ungültig",
        help_en: "save the drawing as R2007 or later; special characters in texts and layer names may be wrong",
        help_de: "die Zeichnung als R2007 oder neuer speichern; Sonderzeichen in Texten und Layernamen können falsch sein",
    }
    /// Bytes of a text that are invalid in a file in UTF-8.
    INVALID_UTF8: DoubtfulEncoding {
        en: "the file is in {encoding}, in which some bytes of this text are invalid",
        de: "die Datei ist in {encoding} kodiert; einige Bytes dieses Textes sind darin ungültig",
        help_en: "save the drawing with another program or as R2004, because this one did not write UTF-8; special characters in texts and layer names may be wrong",
        help_de: "die Zeichnung mit einem anderen Programm oder als R2004 speichern, denn dieses hat kein UTF-8 geschrieben; Sonderzeichen in Texten und Layernamen können falsch sein",
    }
    /// An unknown code page in the header of a drawing, in place of which `ANSI_1252` is used.
    UNKNOWN_CODE_PAGE: DoubtfulEncoding {
        en: "the code page \"{encoding}\" is not known; texts are read as ANSI_1252",
        de: "die Codepage \"{encoding}\" ist nicht bekannt; Texte werden als ANSI_1252 gelesen",
        help_en: "save the drawing as R2007 or later; special characters in texts and layer names may be wrong",
        help_de: "die Zeichnung als R2007 oder neuer speichern; Sonderzeichen in Texten und Layernamen können falsch sein",
    }
    /// An entity that is neither part of the drawing language nor an annotation.
    FOREIGN: UnsupportedCurve {
        en: "{entity} is left out: a path consists of lines, arcs, circles, polylines and texts",
        de: "{entity} wird ausgelassen: ein Pfad besteht aus Linien, Bögen, Kreisen, Polylinien und Texten",
        help_en: "draw it with such elements (many CAD programs can explode it), or move it to a layer that is not a path layer",
        help_de: "mit solchen Elementen zeichnen (viele CAD-Programme können das Objekt auflösen) oder auf einen Layer legen, der kein Pfadlayer ist",
    }
    /// An ELLIPSE or SPLINE that is left out, because `approximate-curves` is not set.
    NOT_APPROXIMATED: UnsupportedCurve {
        en: "{entity} is left out: only lines and arcs are milled",
        de: "{entity} wird ausgelassen: nur Linien und Bögen werden gefräst",
        help_en: "draw it with arcs, or set `approximate-curves` in pathbuild.toml to the largest deviation in mm that is allowed",
        help_de: "mit Bögen zeichnen oder `approximate-curves` in pathbuild.toml auf die größte erlaubte Abweichung in mm setzen",
    }
    /// The first polyline, block or curve that is left out because of `compatible`. Reported once per drawing.
    NOT_COMPATIBLE: UnsupportedCurve {
        en: "polylines, blocks and curves on path layers are left out, as in PathDxf2GCode; the first is {entity}",
        de: "Polylinien, Blöcke und Kurven auf Pfadlayern werden wie in PathDxf2GCode ausgelassen; das erste solche Element: {entity}",
        help_en: "explode them into lines and arcs, or remove `compatible` so that they are milled",
        help_de: "in Linien und Bögen auflösen oder `compatible` weglassen, damit sie gefräst werden",
    }
    /// A three-dimensional polyline or a mesh.
    POLYLINE_NOT_FLAT: UnsupportedCurve {
        en: "{entity} is left out: it is a 3D polyline or a mesh",
        de: "{entity} wird ausgelassen: es ist eine 3D-Polylinie oder ein Netz",
        help_en: "draw it as a 2D polyline, or with lines and arcs",
        help_de: "als 2D-Polylinie zeichnen oder mit Linien und Bögen",
    }
    /// A polyline that is drawn with a width.
    WIDTH_IGNORED: UnsupportedCurve {
        en: "the width of {entity} is ignored: only its centre line counts",
        de: "die Breite von {entity} wird nicht beachtet: es zählt nur die Mittellinie",
        help_en: "set the width to 0 and draw what is meant: the path of the cutter, or the outline",
        help_de: "die Breite auf 0 setzen und zeichnen, was gemeint ist: den Weg des Fräsers oder den Umriss",
    }
    /// A spline given by fit points instead of control points.
    SPLINE_BY_FIT_POINTS: UnsupportedCurve {
        en: "{entity} is left out: it has fit points, but no control points",
        de: "{entity} wird ausgelassen: er hat Anpassungspunkte, aber keine Kontrollpunkte",
        help_en: "draw it as a spline with control points, or as a polyline with arcs",
        help_de: "als Spline mit Kontrollpunkten zeichnen oder als Polylinie mit Bögen",
    }
    /// A spline without valid control points and knots.
    SPLINE_NOT_UNDERSTOOD: UnsupportedCurve {
        en: "{entity} is left out: its control points and knots do not describe a curve",
        de: "{entity} wird ausgelassen: Kontrollpunkte und Knoten beschreiben keine Kurve",
        help_en: "convert it to lines and arcs in the CAD",
        help_de: "im CAD in Linien und Bögen umwandeln",
    }
    /// An INSERT with different scales in X and Y.
    INSERT_SCALED: UnsupportedCurve {
        en: "block {block} is left out: it is inserted with different scales in x and y",
        de: "Block {block} wird ausgelassen: er ist in x und y verschieden skaliert eingefügt",
        help_en: "explode it, or insert it with the same scale in x and y",
        help_de: "auflösen oder in x und y mit demselben Maßstab einfügen",
    }
    /// An INSERT that shows only a part of its block.
    INSERT_CLIPPED: UnsupportedCurve {
        en: "block {block} is left out: it is clipped (XCLIP), so only a part of it is visible",
        de: "Block {block} wird ausgelassen: er ist mit XCLIP (XZUSCHNEIDEN) zugeschnitten, also nur zum Teil sichtbar",
        help_en: "delete the clipping boundary, or explode the block and trim it",
        help_de: "die Zuschneidegrenze löschen oder den Block auflösen und stutzen",
    }
    /// An INSERT of a block that the file does not contain.
    BLOCK_MISSING: UnsupportedCurve {
        en: "block {block} is left out: the file does not contain it",
        de: "Block {block} wird ausgelassen: die Datei enthält ihn nicht",
        help_en: "bind external references before saving, or delete the insertion",
        help_de: "externe Referenzen vor dem Speichern binden oder die Einfügung löschen",
    }
    /// An INSERT on a layer that is read, of a block that draws only on other layers.
    BLOCK_ELSEWHERE: UnsupportedCurve {
        en: "block {block} is inserted on this layer, but its contents lie on other layers ({layers}) and are ignored",
        de: "Block {block} ist auf diesem Layer eingefügt, sein Inhalt liegt aber auf anderen Layern ({layers}) und wird nicht beachtet",
        help_en: "move the block's contents to layer 0 in the block editor, or explode the block and move its contents to this layer; if nothing in it is to be milled, insert it on another layer",
        help_de: "den Inhalt des Blocks im Blockeditor auf Layer 0 legen oder den Block auflösen und den Inhalt auf diesen Layer legen; soll nichts davon gefräst werden, den Block auf einem anderen Layer einfügen",
    }
    /// A block that contains itself or is nested too deeply.
    BLOCK_NESTED: InvalidDxf {
        en: "block {block} is nested too deeply, or contains itself",
        de: "Block {block} ist zu tief verschachtelt oder enthält sich selbst",
        help_en: "explode the insertion",
        help_de: "die Einfügung auflösen",
    }
    /// An inserted block that the file defines twice.
    BLOCK_TWICE: InvalidDxf {
        en: "the file defines block {block} more than once",
        de: "die Datei definiert den Block {block} mehrfach",
        help_en: "rename one of the blocks, or open the drawing in a CAD program and save it again",
        help_de: "einen der Blöcke umbenennen, oder die Zeichnung in einem CAD-Programm öffnen und neu speichern",
    }
    /// Records of a layer that contradict each other.
    LAYER_TWICE: InvalidDxf {
        en: "the file defines layer {layer} more than once, with different line types or visibility (upper and lower case make no difference)",
        de: "die Datei definiert den Layer {layer} mehrfach, mit verschiedenem Linientyp oder verschieden sichtbar (Groß- und Kleinschreibung zählt nicht)",
        help_en: "give the layers different names or the same properties; if the CAD program shows only one, save the drawing again",
        help_de: "den Layern verschiedene Namen oder dieselben Eigenschaften geben; zeigt das CAD-Programm nur einen, die Zeichnung neu speichern",
    }
    /// An entity that is marked invisible.
    INVISIBLE: LayerNotVisible {
        en: "{entity} is marked invisible, but is still used; {alike}: {count}",
        de: "{entity} ist als unsichtbar markiert, gilt aber trotzdem; {alike}: {count}",
        help_en: "show all hidden objects in the CAD and delete what is not meant to be milled",
        help_de: "im CAD alle ausgeblendeten Objekte anzeigen und löschen, was nicht gefräst werden soll",
    }
    /// An entity in a block that is inserted on a frozen layer.
    INSERTED_FROZEN: LayerNotVisible {
        en: "{entity} belongs to a block that is inserted on the frozen layer {layer}, but is still used; {alike}: {count}",
        de: "{entity} gehört zu einem Block, der auf dem gefrorenen Layer {layer} eingefügt ist, gilt aber trotzdem; {alike}: {count}",
        help_en: "thaw the layer, or delete the insertion if it is not meant to be milled",
        help_de: "den Layer auftauen oder die Einfügung löschen, wenn sie nicht gefräst werden soll",
    }
}
